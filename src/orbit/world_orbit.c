/* world_orbit.c - motions that repeat themselves with the drive's period, of one bead in three dimensions.
 *
 * The map P takes a state at the start of a period to its end; its fixed point is found by Newton's method on the
 * directions in which the bead can move (beads/manifold.h),
 *
 *     (DP - 1) step = y - P(y),
 *
 * DP by differences of whole periods, and its eigenvalues are the multipliers.  Everything that changes with time must
 * have the period: a coil whose frequency is no multiple of it has none in common with the drive.
 */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/error.h"
#include "base/watch.h"
#include "beads/impact.h"
#include "beads/manifold.h"
#include "beads/setup.h"
#include "model/params.h"
#include "model/worlds.h"
#include "orbit/lapack.h"

static const double FOUND = 1e-10, REACH = 1e-3, SAME_RATE = 1e-9, AT_UNIT = 1e-6;
enum { ITERATIONS = 30 };

typedef struct strobe {
    const fst_lapack *lapack;
    const fst_progress *progress;
    beads_world world;
    beads_modes modes;
    beads_flow flow;
    double period, rtol;
} strobe;

/* The state after a period, or after as many as `limit` has. */
static fst_status go(strobe *s, const double *y, double limit, double *out, fst_error *error)
{
    fst_status status = beads_begin(&s->flow, &s->world, y, s->rtol, error);
    while (status == FST_OK && s->flow.t.high < limit) {
        status = beads_go(&s->flow, limit, error);
        if (status == FST_OK)
            status = fst_tell(s->progress, 0.0, NULL, error);
    }
    if (status == FST_OK && s->flow.modes.gone[0])
        return fst_fail(error, FST_NO_CONVERGENCE, "orbit",
                        "the bead leaves at t = %.6g, so nothing repeats itself: choose another start",
                        s->flow.ejected[0]);
    memcpy(out, s->flow.step.y, FST_BEAD_NUMBERS * sizeof *out);
    return status;
}

static fst_status map(void *user, const double *y, double *out, fst_error *error)
{
    strobe *s = user;
    return go(s, y, s->period, out, error);
}

/* The period of all that changes. */
static fst_status find_period(const fst_model *model, strobe *s, fst_error *error)
{
    const fst_surroundings *around = &s->world.around;
    const int moves = model->world.kinds.pieces > 0 || around->drive.kind == FST_WAVEFORM_WAVE;
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
                            "coils[%d].frequency is no multiple of %s, so nothing repeats itself", i,
                            moves ? "drive.frequency" : "that of the first coil with an alternating current");
    }
    if (!(rate > 0))
        return fst_fail(error, FST_BAD_INPUT, "drive.waveform",
                        "nothing changes here, so that there is no period");
    s->period = FST_TWO_PI / rate;
    return FST_OK;
}

static int by_size(const void *a, const void *b)
{
    const double *x = a, *y = b, p = hypot(x[0], x[1]), q = hypot(y[0], y[1]);
    return p != q ? (p < q) - (p > q) : (x[1] < y[1]) - (x[1] > y[1]);
}

static fst_status find_multipliers(strobe *s, int size, double *matrix, fst_world_orbit *orbit,
                                   fst_error *error)
{
    double re[FST_BEAD_NUMBERS], im[FST_BEAD_NUMBERS];
    if (s->lapack->eigen(size, matrix, re, im, NULL) != 0)
        return fst_fail(error, FST_NO_CONVERGENCE, "orbit", "the multipliers were not found");
    orbit->count = size;
    for (int i = 0; i < size; ++i) {
        orbit->multipliers[i][0] = re[i];
        orbit->multipliers[i][1] = im[i];
    }
    qsort(orbit->multipliers, (size_t)size, sizeof *orbit->multipliers, by_size);
    orbit->stable = hypot(orbit->multipliers[0][0], orbit->multipliers[0][1]) < 1.0 + AT_UNIT;
    return FST_OK;
}

/* One step of Newton's method from y, which it moves; the matrix becomes DP. */
static fst_status step(strobe *s, double *y, beads_manifold *m, double *matrix, double *residual,
                       fst_error *error)
{
    double end[FST_BEAD_NUMBERS], off[FST_BEAD_NUMBERS], right[FST_BEAD_NUMBERS];
    double left[FST_BEAD_NUMBERS * FST_BEAD_NUMBERS];
    fst_status status = map(s, y, end, error);
    if (status != FST_OK)
        return status;
    s->modes = s->flow.modes;
    beads_span(&s->world, &s->modes, y, NULL, m);
    *residual = 0.0;
    for (int i = 0; i < FST_BEAD_NUMBERS; ++i) {
        off[i] = y[i] - end[i];
        *residual = fmax(*residual, fabs(off[i]) / m->unit[i]);
    }
    status = beads_derivative(m, map, s, y, REACH, matrix, error);
    if (status != FST_OK || *residual < FOUND)
        return status;
    beads_components(m, off, right);
    memcpy(left, matrix, (size_t)(m->size * m->size) * sizeof *left);
    for (int i = 0; i < m->size; ++i)
        left[i * m->size + i] -= 1.0;
    int rank;
    if (s->lapack->shortest(m->size, left, right, 1e-12, &rank) != 0)
        return fst_fail(error, FST_NO_CONVERGENCE, "orbit", "Newton's matrix is no matrix");
    beads_vector(m, right, off);
    for (int i = 0; i < FST_BEAD_NUMBERS; ++i)
        y[i] += off[i];
    beads_project(&s->world, &s->modes, y);
    return FST_OK;
}

static fst_status find(strobe *s, const fst_params *p, double *y, fst_world_orbit *orbit, fst_error *error)
{
    beads_manifold *m = malloc(sizeof *m);
    double matrix[FST_BEAD_NUMBERS * FST_BEAD_NUMBERS];
    fst_status status = m ? FST_OK : fst_fail(error, FST_NO_MEMORY, "orbit", "out of memory");
    if (status == FST_OK)
        status = go(s, y, s->period * ceil(fst_run_discard(p)), y, error);
    orbit->residual = INFINITY;
    for (int i = 0; i < ITERATIONS && status == FST_OK && !(orbit->residual < FOUND); ++i)
        status = step(s, y, m, matrix, &orbit->residual, error);
    if (status == FST_OK && !(orbit->residual < FOUND))
        status =
            fst_fail(error, FST_NO_CONVERGENCE, "orbit",
                     "Newton's method found no motion that repeats itself with the drive (residual %.3g): make "
                     "run.discard larger, or choose another start",
                     orbit->residual);
    if (status == FST_OK)
        status = find_multipliers(s, m->size, matrix, orbit, error);
    free(m);
    return status;
}

fst_status fst_world_orbit_find(const fst_params *params, const fst_beads_options *options,
                                fst_world_orbit *orbit, fst_error *error)
{
    fst_model *model = NULL;
    double y[BEADS_NUMBERS];
    memset(orbit, 0, sizeof *orbit);
    fst_status status = fst_key_of_surroundings(params) ? FST_OK : fst_check_no_world(params, error);
    if (status != FST_OK)
        return status;
    strobe *s = calloc(1, sizeof *s);
    if (!s)
        return fst_fail(error, FST_NO_MEMORY, "orbit", "out of memory");
    s->progress = options->progress;
    s->rtol = fmin(params->run_rtol, 1e-12);
    status = fst_lapack_load(&s->lapack, error);
    if (status == FST_OK)
        status = beads_set_up(params, 1, options, &model, &s->world, y, error);
    if (status == FST_OK)
        status = find_period(model, s, error);
    if (status == FST_OK)
        status = find(s, params, y, orbit, error);
    orbit->period = s->period;
    orbit->frame = s->world.surrounded && s->world.around.laboratory ? FST_FRAME_LABORATORY : FST_FRAME_TURNING;
    memcpy(orbit->state, y, sizeof orbit->state);
    orbit->state[2] += isnan(s->world.plate) ? 0.0 : s->world.body[0].radius;
    fst_model_free(model);
    free(s);
    return status;
}
