/* world_orbit.c - motions that repeat themselves with the drive's period, of one bead in three dimensions.
 *
 * The map P takes a state at the start of a period to its end; its fixed point is found by Newton's method on the
 * directions in which the bead can move (beads_lock.c), DP by differences of whole periods; its eigenvalues are the
 * multipliers.  Everything that changes with time must have the period: a coil whose frequency is not a multiple of it has
 * none in common with the drive.
 */
#include "orbit/world_orbit.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/constants.h"
#include "base/error.h"
#include "base/watch.h"
#include "beads/impact.h"
#include "beads/setup.h"
#include "model/params.h"
#include "model/worlds.h"

static const double SAME_RATE = 1e-9, AT_UNIT = 1e-6;

/* The state after so long. */
static fst_status go(world_strobe *s, const double *y, double duration, fst_error *error)
{
    fst_status status = beads_begin(&s->flow, &s->world, y, s->rtol, error);
    while (status == FST_OK && s->flow.t.high < duration) {
        status = beads_go(&s->flow, duration, error);
        if (status == FST_OK)
            status = fst_tell(s->progress, 0.0, NULL, error);
    }
    if (status == FST_OK && s->flow.modes.gone[0])
        return fst_fail(error, FST_NO_CONVERGENCE, "orbit",
                        "the bead leaves at t = %.6g, so nothing repeats itself: choose another start",
                        s->flow.ejected[0]);
    return status;
}

/* A beads_map: the state after a period. */
static fst_status after(void *user, const double *y, double *out, fst_error *error)
{
    world_strobe *s = user;
    double start[BEADS_NUMBERS];
    memcpy(start, y, FST_BEAD_NUMBERS * sizeof *start);
    beads_project(&s->world, &s->modes, start);
    const fst_status status = go(s, start, s->repeat.period, error);
    if (status == FST_OK && s->flow.modes.contact[0] != s->modes.contact[0])
        return fst_fail(error, FST_NO_CONVERGENCE, "orbit",
                        "the contact opens or closes within a period, and is another one at its end");
    memcpy(out, s->flow.step.y, FST_BEAD_NUMBERS * sizeof *out);
    return status;
}

/* The period of all that changes. */
static fst_status find_period(world_strobe *s, fst_error *error)
{
    const fst_surroundings *around = &s->world.around;
    const int moves = s->model->world.kinds.pieces > 0 || around->drive.kind == FST_WAVEFORM_WAVE;
    double rate = moves || !s->world.surrounded ? s->world.omega : 0.0;
    if (s->world.surrounded && !isfinite(fst_waveform_period(&around->drive)))
        return fst_fail(
            error, FST_BAD_INPUT, "drive.waveform",
            "an orbit repeats itself with the drive, and this drive does not: choose drive.waveform "
            "steady, oscillating or wave");
    for (int i = 0; s->world.surrounded && i < around->loop_count; ++i) {
        const fst_loop *loop = &around->loops[i];
        if (loop->ac == 0.0 || loop->rate == 0.0)
            continue;
        rate = rate > 0 ? rate : loop->rate;
        if (fabs(loop->rate / rate - round(loop->rate / rate)) > SAME_RATE)
            return fst_fail(error, FST_BAD_INPUT, "coils",
                            "coils[%d].frequency is not a multiple of %s, so nothing repeats itself", i,
                            moves ? "drive.frequency" : "that of the first coil with an alternating current");
    }
    if (!(rate > 0))
        return fst_fail(error, FST_BAD_INPUT, "drive.waveform",
                        "nothing changes here, so that there is no period");
    s->repeat = (beads_repeat){after, s, FST_TWO_PI / rate};
    return FST_OK;
}

fst_status world_strobe_set(world_strobe *s, const fst_params *params, const fst_beads_options *options,
                            double state[BEADS_NUMBERS], fst_error *error)
{
    fst_model_free(s->model);
    s->model = NULL;
    s->progress = options->progress;
    s->rtol = fmin(params->run_rtol, 1e-12);
    const char *key = fst_key_of_surroundings(params) ? NULL : fst_key_of_world(params);
    fst_status status =
        !key ? FST_OK
             : fst_fail(error, FST_BAD_INPUT, key,
                        "%s asks for a bead in three dimensions, which kind driven does not follow in "
                        "the magnet's frame: set world.frame to laboratory",
                        key);
    if (status == FST_OK && !s->lapack)
        status = fst_lapack_load(&s->lapack, error);
    if (status == FST_OK)
        status = beads_set_up(params, 1, options, &s->model, &s->world, state, error);
    if (status == FST_OK && !isnan(s->world.plate))
        s->world.plate_radius = INFINITY; /* an orbit goes on beyond the plate's edge */
    return status == FST_OK ? find_period(s, error) : status;
}

fst_status world_strobe_find(world_strobe *s, const fst_params *params, const double *state, beads_lock *lock,
                             fst_error *error)
{
    memset(lock, 0, sizeof *lock);
    const fst_status status = go(s, state, s->repeat.period * ceil(fst_run_discard(params)), error);
    if (status != FST_OK)
        return status;
    memcpy(lock->state, s->flow.step.y, FST_BEAD_NUMBERS * sizeof *lock->state);
    lock->modes = s->modes = s->flow.modes;
    fst_error why;
    const fst_status found = beads_lock_correct(s->lapack, &s->repeat, &s->world, lock, &why);
    const int carried = s->world.surrounded && s->world.around.drive.kind == FST_WAVEFORM_WAVE;
    return found == FST_NO_CONVERGENCE ? fst_fail(error, found, "orbit", "%s: %s", why.sentence,
                                                  carried ? "a bead that a wave carries along, as most waves "
                                                            "do, never comes back to where it was; "
                                                            "a run tells its velocity"
                                                          : "make run.discard larger, or choose another start")
           : found != FST_OK           ? fst_fail(error, found, why.where, "%s", why.sentence)
                                       : FST_OK;
}

void world_multiplier(const beads_lock *lock, double period, int i, double *re, double *im)
{
    const double size = exp(lock->re[i] * period), angle = lock->im[i] * period;
    *re = size * cos(angle);
    *im = size * sin(angle);
}

static int by_size(const void *a, const void *b)
{
    const double *x = a, *y = b, p = hypot(x[0], x[1]), q = hypot(y[0], y[1]);
    return p != q ? (p < q) - (p > q) : (x[1] < y[1]) - (x[1] > y[1]);
}

static void tell(const world_strobe *s, const beads_lock *lock, fst_world_orbit *orbit)
{
    orbit->period = s->repeat.period;
    orbit->frame = s->world.surrounded && s->world.around.laboratory ? FST_FRAME_LABORATORY : FST_FRAME_TURNING;
    orbit->count = lock->size;
    for (int i = 0; i < lock->size; ++i)
        world_multiplier(lock, orbit->period, i, &orbit->multipliers[i][0], &orbit->multipliers[i][1]);
    qsort(orbit->multipliers, (size_t)lock->size, sizeof *orbit->multipliers, by_size);
    orbit->stable = hypot(orbit->multipliers[0][0], orbit->multipliers[0][1]) < 1.0 + AT_UNIT;
    orbit->residual = lock->residual;
    memcpy(orbit->state, lock->state, sizeof orbit->state);
    orbit->state[2] += isnan(s->world.plate) ? 0.0 : s->world.body[0].radius;
}

fst_status fst_world_orbit_find(const fst_params *params, const fst_beads_options *options,
                                fst_world_orbit *orbit, fst_error *error)
{
    double state[BEADS_NUMBERS];
    beads_lock lock;
    memset(orbit, 0, sizeof *orbit);
    world_strobe *s = calloc(1, sizeof *s);
    if (!s)
        return fst_fail(error, FST_NO_MEMORY, "orbit", "out of memory");
    fst_status status = world_strobe_set(s, params, options, state, error);
    if (status == FST_OK)
        status = world_strobe_find(s, params, state, &lock, error);
    if (status == FST_OK)
        tell(s, &lock, orbit);
    fst_model_free(s->model);
    free(s);
    return status;
}
