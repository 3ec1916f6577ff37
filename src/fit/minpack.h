/* minpack.h - least squares by Levenberg and Marquardt's method, from cminpack: a module, festoon-minpack.so,
 * so that festoon can be built without it. */
#ifndef FST_FIT_MINPACK_H
#define FST_FIT_MINPACK_H

#include <festoon/festoon.h>

#define FST_MINPACK_MODULE_SYMBOL "fst_minpack_module"

/* What is sought by fit_least(): the v with the least sum of squares of m residuals over n unknowns. */
typedef struct fit_least_squares {
    const struct fst_minpack *minpack;
    void *user;
    /* The residuals at v into f; their derivatives into jacobian[i + m k], at a v at which they were asked for
     * before. */
    fst_status (*residuals)(void *user, const double *v, double *f, fst_error *error);
    fst_status (*derivatives)(void *user, const double *v, double *jacobian, fst_error *error);
    int m, n;
    double tolerance; /* relative, of the sum of squares */
    int most_calls;
} fit_least_squares;

enum { FIT_MOST_UNKNOWNS = 24 };

/* Search from v on, which becomes the place of the least sum; the residuals there are left in f. */
fst_status fit_least(const fit_least_squares *least, double *v, double *f, fst_error *error);

/* ------------------------------------------------------------------ the module */

/* `task` 1: the residuals at x into f; 2: their derivatives.  A negative answer ends the search. */
typedef int fit_function(void *user, int m, int n, const double *x, double *f, double *jacobian, int stride,
                         int task);

/* Sought: the least sum of squares of m residuals over n unknowns. */
typedef struct fit_search {
    fit_function *function;
    void *user;
    int m, n;
    double *x, *f;     /* n unknowns; m residuals, as the search leaves them */
    double *work;      /* FIT_SEARCH_WORK(m, n) doubles */
    int *places;       /* n */
    double first_step; /* the longest first step, in units of the unknowns */
    double tolerance;  /* relative, of the sum of squares */
    int most_calls;
} fit_search;
#define FIT_SEARCH_WORK(m, n) ((size_t)(m) * (size_t)(n) + 6u * (size_t)(n) + (size_t)(m))

typedef struct fst_minpack {
    const char *version; /* FST_VERSION_STRING at the module's build: another version is refused */
    /* Returns MINPACK's `info`: 1 to 4 and 6 to 8 converged, 5 too many calls, negative what the function said.
     */
    int (*least_squares)(const fit_search *search);
} fst_minpack;

/* The loaded table.  FST_UNAVAILABLE: the module is missing or belongs to another version. */
fst_status fst_minpack_load(const fst_minpack **minpack, fst_error *error);

#endif
