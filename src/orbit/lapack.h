/* lapack.h - the linear algebra that this room takes from LAPACK.
 *
 * LAPACK is heavy to load (with its Fortran run time longer than a whole `festoon run`), so what calls it is a
 * module, festoon-lapack.so, that is loaded when an orbit is first sought.
 */
#ifndef FST_ORBIT_LAPACK_H
#define FST_ORBIT_LAPACK_H

#include <festoon/festoon.h>

/* The module's one symbol is a table of this type, named FST_LAPACK_MODULE_SYMBOL. */
#define FST_LAPACK_MODULE_SYMBOL "fst_lapack_module"
typedef struct fst_lapack {
    const char *version; /* FST_VERSION_STRING at the module's build: another version is refused */

    /* Solve a x = b for `columns` right-hand sides; a is n x n and b n x columns, both by rows; both are
     * overwritten, b by x.  0, or non-zero where a is singular. */
    int (*solve)(int n, int columns, double *a, double *b);

    /* The shortest x with the least |a x - b|, a n x n by rows; both are overwritten, b by x.  Singular values
     * below `least` of the greatest count as zero; *rank: how many do not.  0 on success. */
    int (*shortest)(int n, double *a, double *b, double least, int *rank);

    /* Eigenvalues of a (n x n by rows, overwritten); `vectors` (n x n by rows, or NULL) receives the right
     * eigenvectors as columns, a complex pair as real and imaginary part.  0 on success. */
    int (*eigen)(int n, double *a, double *re, double *im, double *vectors);
} fst_lapack;

/* The loaded table.  FST_UNAVAILABLE: the module is missing or belongs to another version. */
fst_status fst_lapack_load(const fst_lapack **lapack, fst_error *error);

#endif
