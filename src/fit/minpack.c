/* minpack.c - least squares by the module that calls cminpack. */
#include "fit/minpack.h"

#include <stdlib.h>
#include <string.h>

#include "base/error.h"
#include "host/module.h"

fst_status fst_minpack_load(const fst_minpack **minpack, fst_error *error)
{
    int found = 0;
    *minpack = fst_module_table(FST_MINPACK_MODULE, FST_MINPACK_MODULE_SYMBOL, &found);
    if (!*minpack)
        return fst_fail(error, FST_UNAVAILABLE, FST_MINPACK_MODULE,
                        "this festoon has no cminpack, which fits parameters: install libcminpack-dev and "
                        "build festoon again");
    if (strcmp((*minpack)->version, fst_version()) != 0)
        return fst_fail(error, FST_UNAVAILABLE, FST_MINPACK_MODULE,
                        "%s belongs to festoon %s, not to %s: install festoon again", FST_MINPACK_MODULE,
                        (*minpack)->version, fst_version());
    return FST_OK;
}

/* What MINPACK carries to the function: where x = 0 is, and what went wrong. */
typedef struct course {
    const fit_least_squares *least;
    const double *origin;
    fst_status status;
    fst_error *error;
} course;

static int ask(void *user, int m, int n, const double *x, double *f, double *jacobian, int stride, int task)
{
    course *c = user;
    double v[FIT_MOST_UNKNOWNS];
    (void)m;
    (void)stride;
    for (int k = 0; k < n; ++k)
        v[k] = c->origin[k] + x[k];
    c->status = task == 1 ? c->least->residuals(c->least->user, v, f, c->error)
                          : c->least->derivatives(c->least->user, v, jacobian, c->error);
    return c->status == FST_OK ? 0 : -1;
}

fst_status fit_least(const fit_least_squares *least, double *v, double *f, fst_error *error)
{
    const int m = least->m, n = least->n;
    double x[FIT_MOST_UNKNOWNS] = {0.0}, origin[FIT_MOST_UNKNOWNS];
    int places[FIT_MOST_UNKNOWNS];
    double *work = calloc(FIT_SEARCH_WORK(m, n), sizeof *work);
    if (!work)
        return fst_fail(error, FST_NO_MEMORY, "fst_fit", "out of memory");
    memcpy(origin, v, (size_t)n * sizeof *v);
    course c = {least, origin, FST_OK, error};
    /* Unknowns are logarithms or of order one: the first step changes a parameter by a third at most. */
    const fit_search search = {ask, &c, m, n, x, f, work, places, 0.3, least->tolerance, least->most_calls};
    (void)least->minpack->least_squares(&search);
    for (int k = 0; k < n; ++k)
        v[k] = origin[k] + x[k];
    free(work);
    return c.status;
}
