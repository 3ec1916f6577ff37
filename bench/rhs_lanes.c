/* rhs_lanes.c - the right-hand side in lanes on its own; compiled for each form of them, RHS_LANES being the
 * function's name. */
#include "rhs_lanes.h"

#include "base/wide.h"

#include "base/twofold.inl"
#include "model/bodies.inl"

/* As a step has it: not inlined, its results in memory; in the fast forms with the pull at the next stage. */
static __attribute__((noinline)) void evaluate(const FN(world) * c, const REAL *y, REAL *dy, FN(pull) * pull,
                                               FN(pull) * next)
{
#ifdef REAL_FORCES_AHEAD
    FN(kinematics)(c->omega, y, dy);
    FN(pull_and_dynamics)(c, NULL, y, next, c->omega, y, pull, dy);
#else
    (void)next;
    FN(rhs)(c, NULL, c->omega, y, dy, pull);
#endif
}

void RHS_LANES(const fst_params *params, const fst_groups *groups, const double *state, int times)
{
    const FN(world) c = FN(make_world)(params, groups);
    REAL y[FST_STATE_SIZE], dy[FST_STATE_SIZE];
    FN(pull) pull[2];
    for (int k = 0; k < FST_STATE_SIZE; ++k)
        y[k] = REAL_OF(state[k]);
    FN(rhs)(&c, NULL, c.omega, y, dy, &pull[0]);
    for (int i = 0; i < times; ++i) {
        evaluate(&c, y, dy, &pull[i % 2], &pull[(i + 1) % 2]);
        __asm__ volatile("" : : "m"(dy), "m"(pull));
    }
}
