/* minpack_module.c - festoon-minpack.so: the one call of cminpack. */
#include "fit/minpack.h"

#include <cminpack.h>

static int least_squares(const fit_search *s)
{
    const int m = s->m, n = s->n;
    double *jacobian = s->work, *scale = jacobian + (size_t)m * (size_t)n, *rest = scale + n;
    int calls = 0, jacobians = 0;
    /* The unknowns are logarithms or of order one: they need no scaling among each other. */
    for (int j = 0; j < n; ++j)
        scale[j] = 1.0;
    return lmder(s->function, s->user, m, n, s->x, s->f, jacobian, m, s->tolerance, 1e-8, 0.0, s->most_calls,
                 scale, 2, s->first_step, 0, &calls, &jacobians, s->places, rest, rest + n, rest + 2 * n,
                 rest + 3 * n, rest + 4 * n);
}

FST_API extern const fst_minpack fst_minpack_module;
const fst_minpack fst_minpack_module = {
    .version = FST_VERSION_STRING,
    .least_squares = least_squares,
};
