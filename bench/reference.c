/* reference.c - end states in long double, against which the errors of all integrators are measured. */
#include "reference.h"

#include <stddef.h>
#include <string.h>

#include "base/real_long_double.h"

#include "base/twofold.inl"
#include "model/bodies.inl"
#include "ode/bead_step.inl"
#include "ode/step_control.inl"

int reference_state(const fst_params *params, const fst_groups *groups, const double state[FST_STATE_SIZE],
                    long double t_end, long double tolerance, double end[FST_STATE_SIZE])
{
    fst_bead_step_long_double s;
    long double atol[FST_STATE_SIZE], t = 0, lost = 0, h = 1e-3L;
    memset(&s, 0, sizeof s);
    s.context.world = fst_make_world_long_double(params, groups);
    s.omega = s.context.world.omega;
    s.ramp = 0;
    for (int i = 0; i < FST_STATE_SIZE; ++i) {
        s.y[i] = state[i];
        atol[i] = tolerance;
    }
    fst_begin_steps_long_double(&s);
    while (t < t_end) {
        const int lands = h >= t_end - t;
        s.h = lands ? t_end - t : h;
        fst_bead_try_step_long_double(&s);
        const long double error = fst_bead_step_error_long_double(&s, tolerance, atol);
        h = s.h * fst_step_factor_long_double(error);
        if (h < 1e-12L)
            return 0;
        if (error > 1)
            continue;
        (void)fst_finish_step_long_double(&s);
        fst_next_step_long_double(&s, s.omega);
        const long double step = s.h - lost, sum = t + step; /* compensated time */
        lost = (sum - t) - step;
        t = lands ? t_end : sum;
    }
    for (int i = 0; i < FST_STATE_SIZE; ++i)
        end[i] = (double)s.y[i];
    return 1;
}
