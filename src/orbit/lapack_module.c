/* lapack_module.c - festoon-lapack.so: the few calls of LAPACK, by LAPACKE. */
#include "orbit/lapack.h"

#include <lapacke.h>

enum { LARGEST = 64 }; /* systems of this room have at most 38 unknowns */

static int solve(int n, int columns, double *a, double *b)
{
    lapack_int pivots[LARGEST];
    if (n > LARGEST)
        return -1;
    return (int)LAPACKE_dgesv(LAPACK_ROW_MAJOR, n, columns, a, n, pivots, b, columns);
}

static int eigen(int n, double *a, double *re, double *im, double *vectors)
{
    return (int)LAPACKE_dgeev(LAPACK_ROW_MAJOR, 'N', vectors ? 'V' : 'N', n, a, n, re, im, NULL, n, vectors, n);
}

FST_API extern const fst_lapack fst_lapack_module;
const fst_lapack fst_lapack_module = {
    .version = FST_VERSION_STRING,
    .solve = solve,
    .eigen = eigen,
};
