/* parts_field.c - the field of a magnet in lanes; compiled for each form of them, PARTS_FIELD being the
 * function's name. */
#include "parts_field.h"

#include "base/wide.h"

#include "base/constants.h"
#include "base/elementary.h"
#include "model/kinds.h"

#include "model/source/sources.inl"

enum { PLACES = 512 };

/* As a right-hand side has it: not inlined, and B and G u its only product. */
static __attribute__((noinline)) void pull(const fst_kinds *kinds, const FN(source_numbers) * source, REAL x,
                                           REAL y, REAL z, const REAL u[3], REAL b[3], REAL gu[3])
{
#ifdef FIELD_KEEPS_GRADIENT
    FN(gradient) g;
    FN(source_field)(source, kinds, x, y, z, b, &g);
    FN(times_gradient)(&g, u, gu);
#else
    FN(source_along)(source, kinds, x, y, z, u, b, gu);
#endif
}

double PARTS_FIELD(const fst_params *params, const fst_groups *groups, int rounds)
{
    static REAL x[PLACES], y[PLACES];
    for (int i = 0; i < PLACES; ++i)
        for (int lane = 0; lane < FST_LANES; ++lane) {
            const int n = FST_LANES * i + lane; /* within the magnet's outline, evenly */
            x[i][lane] = -1.5 + 3.0 * ((n * 0.61803398874989485) - (int)(n * 0.61803398874989485));
            y[i][lane] = -1.5 + 3.0 * ((n * 0.41421356237309505) - (int)(n * 0.41421356237309505));
        }
    fst_kinds kinds = {.source = params->magnet_shape};
    fst_count_pieces(&kinds, params, groups);
    const FN(source_numbers) source = FN(make_source_numbers)(&kinds, params, groups);
    const REAL u[3] = {R(0.6), R(-0.48), R(0.64)};
    volatile double seen;
    double least = 1e300;
    for (int round = 0; round < rounds; ++round) {
        REAL sum = R(0.0);
        const double began = parts_now();
        for (int i = 0; i < PLACES; ++i) {
            REAL b[3], gu[3];
            pull(&kinds, &source, x[i], y[i], REAL_OF(groups->h), u, b, gu);
            sum = sum + ((b[0] + b[1]) + (b[2] + gu[0])) + (gu[1] + gu[2]);
        }
        const double seconds = (parts_now() - began) / (PLACES * FST_LANES);
        least = seconds < least ? seconds : least;
        seen = sum[0];
    }
    (void)seen;
    return least;
}
