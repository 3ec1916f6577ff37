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
#include "base/dot.h"
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

/* How fast an arrow turns in the laboratory. */
static double rate_of(const fit_path *path, int j)
{
    return FST_TWO_PI * (path->drive_hz + j / path->period);
}

/* What is left of a slope that changes by `angle` from frame to frame, where each is that of a polynomial over a window, as
 * in the turning of a track.  Odd powers of the place in the window, made orthogonal after Gram and Schmidt, give it. */
static double window_keeps(double angle)
{
    enum { SIDE = FST_TURNING_WINDOW / 2, POWERS = (FST_TURNING_ORDER + 1) / 2 };
    double p[POWERS][SIDE], slope[POWERS], size[POWERS], sum = 0.0;
    for (int j = 0; j < POWERS; ++j) {
        slope[j] = j == 0 ? 1.0 / SIDE : 0.0;
        for (int k = 0; k < SIDE; ++k)
            p[j][k] = pow((k + 1.0) / SIDE, 2 * j + 1);
        for (int i = 0; i < j; ++i) {
            const double part = fst_dot(p[j], p[i], SIDE) / size[i];
            slope[j] -= part * slope[i];
            for (int k = 0; k < SIDE; ++k)
                p[j][k] -= part * p[i][k];
        }
        size[j] = fst_dot(p[j], p[j], SIDE);
        for (int k = 0; k < SIDE; ++k)
            sum += slope[j] / size[j] * p[j][k] * sin(angle * (k + 1));
    }
    return fabs(angle) < 1e-8 ? 1.0 : sum / angle;
}

fst_status fit_path_make(const fst_params *params, const fst_orbit *orbit, double step, fit_path *path,
                         fst_error *error)
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
    path->drive_hz = params->drive_frequency;
    for (int j = -FIT_MODES; j <= FIT_MODES && status == FST_OK; ++j) {
        const double kept = window_keeps(step * rate_of(path, j));
        double complex sum = 0.0, slips = 0.0;
        for (int i = 0; i < SAMPLES; ++i) {
            const double complex arrow = cexp(-I * (FST_TWO_PI * (double)((j * i) % SAMPLES) / SAMPLES));
            sum += z[i] * arrow;
            slips += slip[i] * arrow;
        }
        const double complex place = sum * (groups.length_unit / SAMPLES);
        path->terms[FIT_PATH_PLACE][j + FIT_MODES] = place;
        path->terms[FIT_PATH_VELOCITY][j + FIT_MODES] = kept * I * rate_of(path, j) * place;
        path->terms[FIT_PATH_SLIP][j + FIT_MODES] =
            kept * slips * (groups.length_unit / groups.time_unit / SAMPLES);
    }
    return status;
}

static double sinc(double x)
{
    return fabs(x) < 1e-8 ? 1.0 : sin(x) / x;
}

double complex fit_path_at(const fit_path *path, fit_path_kind kind, double turn, double phase, double exposure,
                           double t)
{
    const double complex arrow = cexp(I * FST_TWO_PI * (t / path->period + phase));
    double complex power = cexp(-I * FST_TWO_PI * FIT_MODES * (t / path->period + phase)), sum = 0.0;
    for (int j = -FIT_MODES; j <= FIT_MODES; ++j) {
        const double blur = exposure > 0.0 ? sinc(0.5 * exposure * rate_of(path, j)) : 1.0;
        sum += blur * path->terms[kind][j + FIT_MODES] * power;
        power *= arrow;
    }
    return sum * cexp(I * (turn + FST_TWO_PI * path->drive_hz * t));
}
