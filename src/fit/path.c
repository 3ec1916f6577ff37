/* path.c - the model's path in the laboratory as a sum of turning arrows.
 *
 * Seen from the magnet the bead's path closes after a period: a Fourier series in complex numbers, z = X + iY.
 * In the laboratory all of it turns with the magnet, so each term is an arrow of constant length that turns at
 * f + j/P, and what a camera makes of it in an exposure T is exact: each arrow becomes shorter by sinc(pi T (f
 * + j/P)).
 */
#include "fit/path.h"

#include <math.h>

#include "base/constants.h"
#include "base/error.h"

enum { SAMPLES = 256 };

static fst_status sample(const fst_model *model, const fst_orbit *orbit, double complex z[SAMPLES],
                         double complex slip[SAMPLES], fst_error *error)
{
    fst_flow *flow = NULL;
    fst_flow_options options = fst_default_flow_options();
    fst_status status = fst_flow_new(model, &options, orbit->state, &flow, error);
    for (int i = 0; i < SAMPLES && status == FST_OK; ++i) {
        const fst_flow_info now = fst_flow_get(flow);
        fst_stop stop;
        z[i] = now.state[FST_X] + now.state[FST_Y] * I;
        double contact[2];
        fst_slip(model, now.state, contact);
        slip[i] = contact[0] + contact[1] * I;
        status = fst_flow_next(flow, orbit->means.period * (i + 1) / SAMPLES, 0, &stop, error);
    }
    fst_flow_free(flow);
    return status;
}

fst_status fit_path_make(const fst_params *params, const fst_orbit *orbit, fit_path *path, fst_error *error)
{
    double complex z[SAMPLES], slip[SAMPLES];
    fst_model *model = NULL;
    fst_status status = fst_model_new(params, &model, error);
    if (status != FST_OK)
        return status;
    const fst_groups groups = fst_model_groups(model);
    status = sample(model, orbit, z, slip, error);
    fst_model_free(model);
    path->period = orbit->means.period * groups.time_unit;
    for (int j = -FIT_MODES; j <= FIT_MODES && status == FST_OK; ++j) {
        double complex sum = 0.0, slips = 0.0;
        for (int i = 0; i < SAMPLES; ++i) {
            const double complex arrow = cexp(-I * (FST_TWO_PI * (double)((j * i) % SAMPLES) / SAMPLES));
            sum += z[i] * arrow;
            slips += slip[i] * arrow;
        }
        path->terms[j + FIT_MODES] = sum * (groups.length_unit / SAMPLES);
        path->slip[j + FIT_MODES] = slips * (groups.length_unit / groups.time_unit / SAMPLES);
    }
    return status;
}

static double sinc(double x)
{
    return fabs(x) < 1e-8 ? 1.0 : sin(x) / x;
}

static double complex sum_of(const fit_path *path, const double complex terms[FIT_PATH_TERMS], double drive_hz,
                             double turn, double phase, double exposure, double t)
{
    const double complex arrow = cexp(I * FST_TWO_PI * (t / path->period + phase));
    double complex power = cexp(-I * FST_TWO_PI * FIT_MODES * (t / path->period + phase)), sum = 0.0;
    for (int j = -FIT_MODES; j <= FIT_MODES; ++j) {
        const double blur =
            exposure > 0.0 ? sinc(0.5 * FST_TWO_PI * exposure * (drive_hz + j / path->period)) : 1.0;
        sum += blur * terms[j + FIT_MODES] * power;
        power *= arrow;
    }
    return sum * cexp(I * (turn + FST_TWO_PI * drive_hz * t));
}

double complex fit_path_at(const fit_path *path, double drive_hz, double turn, double phase, double exposure,
                           double t)
{
    return sum_of(path, path->terms, drive_hz, turn, phase, exposure, t);
}

double complex fit_path_slip_at(const fit_path *path, double drive_hz, double turn, double phase, double t)
{
    return sum_of(path, path->slip, drive_hz, turn, phase, 0.0, t);
}
