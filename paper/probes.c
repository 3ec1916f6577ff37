/* probes.c - the period halving seen by long runs close to it, and beads set on the corotating motion. */
#include "paper/probes.h"

#include "base/constants.h"
#include "base/error.h"

#include <stdlib.h>

/* A model and a flow on it, made and freed together. */
typedef struct probe {
    fst_model *model;
    fst_flow *flow;
    fst_groups groups;
    double period; /* the period of the drive */
} probe;

static fst_status probe_begin(probe *p, const fst_params *params, fst_error *error)
{
    *p = (probe){.model = NULL};
    fst_status status = fst_model_new(params, &p->model, error);
    if (status == FST_OK) {
        p->groups = fst_model_groups(p->model);
        p->period = 2.0 * FST_PI / p->groups.omega;
    }
    return status;
}

static fst_status probe_start(probe *p, const fst_params *params, const double *state, fst_error *error)
{
    fst_flow_options options = fst_default_flow_options();
    options.rtol = params->run_rtol;
    for (int i = 0; i < FST_STATE_SIZE; ++i)
        options.atol[i] = params->run_rtol;
    return fst_flow_new(p->model, &options, state, &p->flow, error);
}

static void probe_end(probe *p)
{
    fst_flow_free(p->flow);
    fst_model_free(p->model);
}

/* ------------------------------------------------------------------ the period halving */

enum {
    MOST_RETURNS = 16384,
    LOOKED_AT = 24 /* drive periods at the end over which p and <n_z> are taken */
};

/* Half returns of the bead to Phi = pi/2 or -pi/2.  Under S2 n_z changes its sign from one to the next, so the
 * sum of two successive values is zero.  That sum measures the asymmetry without integrals. */
typedef struct returns {
    double t[MOST_RETURNS], asymmetry[MOST_RETURNS];
    int count;
    double last_nz;
} returns;

static void take_return(returns *all, const fst_flow_info *info)
{
    double nz = info->state[FST_NZ];
    if (isfinite(all->last_nz) && all->count < MOST_RETURNS) {
        all->t[all->count] = info->t;
        all->asymmetry[all->count++] = fabs(nz + all->last_nz);
    }
    all->last_nz = nz;
}

/* The rate of settling, by least squares through the logarithm of the distance from the last value, where the
 * distance is small enough to be linear and large enough to be seen. */
static double relaxation_time(const returns *all)
{
    if (all->count < 32)
        return NAN;
    double settled = all->asymmetry[all->count - 1];
    fst_scatter points = {0};
    for (int i = 0; i < all->count * 3 / 4; ++i) {
        const double distance = fabs(all->asymmetry[i] - settled);
        if (distance > 1e-7 && distance < 2e-2)
            fst_scatter_add(&points, all->t[i], log(distance));
    }
    const double slope = fst_scatter_slope(&points);
    return points.n >= 8.0 && slope < 0.0 ? -1.0 / slope : NAN;
}

/* Whether the asymmetry did not change over the last eighth of the time. */
static int is_settled(const returns *all)
{
    if (all->count < 32)
        return 0;
    double last = all->asymmetry[all->count - 1], before = all->asymmetry[all->count - 1 - all->count / 8];
    return fabs(last - before) < 1e-4 * last + 1e-6;
}

/* Find successive extremes of r in some turns of Phi, each by a parabola through three values, and p from them.
 * NAN where r swings only once a turn: there are no two swings whose ratio p could be. */
static double order_parameter(const double *r, int count, double turns)
{
    double extremes[256];
    int found = 0;
    for (int i = 1; i + 1 < count && found < 256; ++i) {
        double before = r[i] - r[i - 1], after = r[i + 1] - r[i];
        if (before * after > 0.0 || before == after)
            continue;
        double shift = 0.5 * (before + after) / (before - after);
        double value = r[i] + 0.25 * shift * (r[i + 1] - r[i - 1]);
        if (found > 0 || before > 0.0) /* begin with a maximum */
            extremes[found++] = value;
    }
    double sum = 0.0;
    int pairs = 0;
    for (int i = 0; i + 3 < found; i += 2, pairs++) {
        double one = extremes[i] - extremes[i + 1], other = extremes[i + 2] - extremes[i + 3];
        sum += fmax(one, other) / fmin(one, other) - 1.0;
    }
    return pairs > 0 && found > 3.0 * turns ? sum / pairs : NAN;
}

/* Follow the end of the motion in small steps: r, and n_z averaged over whole returns. */
static fst_status watch_end(probe *p, double t0, fst_halving_point *point, double *r_of_t, int kept,
                            fst_error *error)
{
    enum { COUNT = FST_HALVING_PARTS * LOOKED_AT };
    double r[COUNT], nz_sum = 0.0, step = p->period / FST_HALVING_PARTS, first_bead_angle = 0.0;
    double partial = 0.0, weight = 0.0, nz_before = 0.0, turns = 0.0;
    fst_status status = FST_OK;
    for (int i = 0; i < COUNT && status == FST_OK; ++i) {
        fst_stop stop;
        status = fst_flow_next(p->flow, t0 + (i + 1) * step, 0, &stop, error);
        fst_flow_info info = fst_flow_get(p->flow);
        r[i] = hypot(info.state[FST_X], info.state[FST_Y]);
        if (i == 0)
            first_bead_angle = info.bead_angle;
        else
            partial += 0.5 * (nz_before + info.state[FST_NZ]);
        nz_before = info.state[FST_NZ];
        /* Only whole turns of Phi count; the last complete one is kept. */
        turns = fabs(info.bead_angle - first_bead_angle) / (2.0 * FST_PI);
        if (i > 0 && floor(turns) > weight) {
            weight = floor(turns);
            nz_sum = partial / i;
        }
    }
    if (status != FST_OK)
        return status;
    point->mean_nz = fabs(nz_sum);
    point->order = order_parameter(r, COUNT, turns);
    for (int i = 0; i < kept && i < COUNT; ++i)
        r_of_t[i] = r[i];
    return FST_OK;
}

fst_status fst_probe_halving(const fst_params *params, double periods, fst_halving_point *point, double *r_of_t,
                             int count, fst_error *error)
{
    probe p;
    double state[FST_STATE_SIZE];
    returns *all = calloc(1, sizeof *all);
    if (!all)
        return fst_fail(error, FST_NO_MEMORY, "fst_probe_halving", "no memory for the returns");
    all->last_nz = NAN;
    fst_status status = probe_begin(&p, params, error);
    if (status == FST_OK)
        status = fst_start_state(params, p.model, state, error);
    if (status == FST_OK)
        status = probe_start(&p, params, state, error);
    double end = periods * p.period;
    fst_stop stop = FST_AT_SECTION;
    while (status == FST_OK && stop == FST_AT_SECTION) {
        status = fst_flow_next(p.flow, end, FST_AT_SECTION, &stop, error);
        if (status == FST_OK && stop == FST_AT_SECTION) {
            fst_flow_info info = fst_flow_get(p.flow);
            take_return(all, &info);
        }
    }
    *point = (fst_halving_point){.omega = p.groups.omega, .relaxation = relaxation_time(all)};
    if (status == FST_OK)
        status = watch_end(&p, end, point, r_of_t, count, error);
    if (!is_settled(all))
        point->mean_nz = point->order = NAN;
    probe_end(&p);
    free(all);
    return status;
}

double fst_scatter_slope(const fst_scatter *points)
{
    return (points->n * points->xy - points->x * points->y) / (points->n * points->xx - points->x * points->x);
}

double fst_scatter_correlation(const fst_scatter *points)
{
    return (points->n * points->xy - points->x * points->y) /
           sqrt((points->n * points->xx - points->x * points->x) *
                (points->n * points->yy - points->y * points->y));
}

double fst_power_exponent(const double *x, const double *y, int count, double x0)
{
    fst_scatter points = {0};
    for (int i = 0; i < count; ++i)
        if (y[i] > 0.0 && x[i] != x0)
            fst_scatter_add(&points, log(fabs(x[i] - x0)), log(y[i]));
    return points.n >= 3.0 ? fst_scatter_slope(&points) : NAN;
}

double fst_line_zero(const double *x, const double *y, int count)
{
    fst_scatter points = {0};
    for (int i = 0; i < count; ++i)
        fst_scatter_add(&points, x[i], y[i]);
    return (points.x - points.y / fst_scatter_slope(&points)) / points.n;
}

/* ------------------------------------------------------------------ rapid corotation */

void fst_ansatz_state(const fst_model *model, double r, double bead_angle, double state[FST_STATE_SIZE])
{
    fst_groups g = fst_model_groups(model);
    double c = cos(bead_angle), s = sin(bead_angle), moment_angle = bead_angle + FST_PI,
           rate = g.omega / (r + g.eps);
    double v = r * g.eps * rate, w = -r * rate; /* v_alpha + eps W_r = 0 */
    const double start[FST_STATE_SIZE] = {
        r * c, r * s, -v * s, v * c, -sin(moment_angle) * s, sin(moment_angle) * c, -cos(moment_angle),
        w * c, w * s, 0.0};
    for (int i = 0; i < FST_STATE_SIZE; ++i)
        state[i] = start[i];
}

fst_status fst_probe_ansatz(const fst_params *params, double r, double bead_angle, double periods,
                            double *speed, double *survived, fst_error *error)
{
    probe p;
    double state[FST_STATE_SIZE], before = 0.0, middle = 0.0;
    fst_status status = probe_begin(&p, params, error);
    if (status == FST_OK) {
        fst_ansatz_state(p.model, r, bead_angle, state);
        status = probe_start(&p, params, state, error);
    }
    double wanted = p.groups.eps * p.groups.omega / (r + p.groups.eps) * p.period;
    *survived = periods;
    *speed = NAN;
    before = status == FST_OK ? fst_flow_get(p.flow).alpha : 0.0;
    for (int k = 0; k < (int)periods && status == FST_OK; ++k) {
        fst_stop stop;
        status = fst_flow_next(p.flow, (k + 1) * p.period, FST_AT_EDGE, &stop, error);
        if (status != FST_OK)
            break;
        fst_flow_info info = fst_flow_get(p.flow);
        double now = hypot(info.state[FST_X], info.state[FST_Y]);
        int off = now < 0.5 * r || now > 2.0 * r || info.alpha - before < 0.5 * wanted;
        if (off && *survived > k + 1.0)
            *survived = k + 1.0;
        before = info.alpha;
        if (k == (int)periods / 2)
            middle = info.alpha;
        if (stop == FST_AT_EDGE) /* it left the plate, where its speed means nothing */
            break;
        if (k + 1 == (int)periods)
            *speed = (info.alpha - middle) / ((k - (int)periods / 2) * wanted);
    }
    probe_end(&p);
    return status;
}
