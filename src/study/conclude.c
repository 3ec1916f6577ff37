/* conclude.c - from what a run carries to its result: window, means, extremes. */
#include "study/run_state.h"

#include <stdio.h>
#include <string.h>

#include "base/error.h"
#include "study/regime.h"

#define TWO_PI 6.283185307179586476925287
#define DEGREES 57.29577951308232087680

static const fst_result_info RESULTS[] = {
#define FST_RESULT(name, unit, doc) {#name, unit, doc, offsetof(fst_run_result, name)},
#include <festoon/run.def>
#undef FST_RESULT
};

int fst_result_count(void)
{
    return (int)(sizeof RESULTS / sizeof *RESULTS);
}

const fst_result_info *fst_result_at(int index)
{
    return index >= 0 && index < fst_result_count() ? &RESULTS[index] : NULL;
}

const char *fst_regime_name(fst_regime regime)
{
    static const char *const names[] = {"undecided",  "locked",  "librating", "counter-rotating",
                                        "corotating", "chaotic", "ejected",   "lifted"};
    return (unsigned)regime < sizeof names / sizeof *names ? names[regime] : "undecided";
}

const char *fst_symmetry_name(fst_symmetry symmetry)
{
    return symmetry == FST_SYMMETRY_S1 ? "S1" : symmetry == FST_SYMMETRY_S2 ? "S2" : NULL;
}

void fst_result_clear(fst_run_result *result)
{
    memset(result, 0, sizeof *result);
#define FST_RESULT(name, unit, doc) result->name = NAN;
#include <festoon/run.def>
#undef FST_RESULT
}

/* Mean of one integrand between two marks. */
static double mean(const fst_mark *first, const fst_mark *last, int which)
{
    return (last->integrals[which] - first->integrals[which]) / fst_twofold_difference(last->t, first->t);
}

/* sqrt(<u^2> - <u>^2) from <(u - u0)^2> and <u> - u0, never the root of a negative rounding error. */
static double deviation(double mean_square, double mean_difference)
{
    const double variance = mean_square - mean_difference * mean_difference;
    return variance > 0 ? sqrt(variance) : 0.0;
}

static double mean_alpha_dot(const fst_run_state *run, const fst_mark *first, const fst_mark *last)
{
    /* alpha = Phi + drive phase; on a ramp the mean drive is the one in the middle. */
    const double omega = 0.5 * (fst_flow_omega(run->flow, first->t) + fst_flow_omega(run->flow, last->t));
    return omega + (last->big_phi - first->big_phi) / fst_twofold_difference(last->t, first->t);
}

void fst_means_between(const fst_run_state *run, const fst_mark *first, const fst_mark *last,
                       fst_ramp_point *means)
{
    means->omega = 0.5 * (fst_flow_omega(run->flow, first->t) + fst_flow_omega(run->flow, last->t));
    means->frequency_hz = means->omega / (TWO_PI * run->model->groups.time_unit);
    means->mean_r = mean(first, last, FST_Q_R);
    means->std_r = deviation(mean(first, last, FST_Q_R2), means->mean_r - run->q.r_reference);
    means->mean_alpha_dot = mean_alpha_dot(run, first, last);
    means->mean_phi_dot = (last->small_phi - first->small_phi) / fst_twofold_difference(last->t, first->t);
    means->mean_nz = mean(first, last, FST_Q_N_Z);
}

/* Error of a mean whose blocks drift the same way: the distance to where a geometric series through the means
 * of the window's thirds would end. 0 where there is no such drift. */
static double drift_error(const double *blocks, int count, double mean_value)
{
    const int third = count / 3;
    double sums[3] = {0, 0, 0};
    for (int i = 0; i < 3 * third; ++i)
        sums[i / third] += (blocks[i] - mean_value) / third;
    const double first_step = sums[1] - sums[0], second_step = sums[2] - sums[1];
    if (third < 1 || !(first_step * second_step > 0))
        return 0.0;
    const double ratio = fmin(second_step / first_step, 0.995); /* 1 and above: it does not say where it ends */
    return fabs(sums[2] + second_step * ratio / (1.0 - ratio));
}

/* Error of a mean from the blocks between the kept marks: their scatter, or what is left of a drift, or the
 * integration's tolerance, whichever is largest; `pick` is the block's mean. */
static double standard_error(const fst_run_state *run, const fst_mark_series *series,
                             double (*pick)(const fst_ramp_point *))
{
    const int count = series->count - 1;
    if (count < 2)
        return NAN;
    double blocks[FST_MARKS], sum = 0.0, sum2 = 0.0;
    for (int i = 0; i < count; ++i) {
        fst_ramp_point means;
        fst_means_between(run, &series->kept[i], &series->kept[i + 1], &means);
        blocks[i] = pick(&means);
        sum += blocks[i] - blocks[0];
        sum2 += (blocks[i] - blocks[0]) * (blocks[i] - blocks[0]);
    }
    const double variance = (sum2 - sum * sum / count) / (count - 1), mean_value = blocks[0] + sum / count;
    const double scatter = variance > 0 ? sqrt(variance / count) : 0.0;
    return fmax(fmax(scatter, drift_error(blocks, count, mean_value)),
                run->params->run_rtol * fabs(mean_value));
}

static double pick_r(const fst_ramp_point *p)
{
    return p->mean_r;
}

static double pick_alpha_dot(const fst_ramp_point *p)
{
    return p->mean_alpha_dot;
}

static double pick_nz(const fst_ramp_point *p)
{
    return p->mean_nz;
}

/* Greatest defect of dE = (drive - friction) dt between kept marks, over the work done in the window, or over
 * the energy where that is larger: a locked bead that rolls does next to no work. */
static double energy_residual(const fst_mark_series *series, const fst_mark *last)
{
    const fst_mark *first = &series->kept[0];
    double worst = 0.0;
    for (int i = 0; i < series->count; ++i) {
        const fst_mark *from = &series->kept[i], *to = i + 1 < series->count ? &series->kept[i + 1] : last;
        const double work = (to->integrals[FST_Q_DRIVE_POWER] - from->integrals[FST_Q_DRIVE_POWER]) -
                            (to->integrals[FST_Q_FRICTION_POWER] - from->integrals[FST_Q_FRICTION_POWER]);
        const double defect = fabs((to->energy - from->energy) - work);
        worst = defect > worst ? defect : worst;
    }
    const double done = last->integrals[FST_Q_FRICTION_POWER] - first->integrals[FST_Q_FRICTION_POWER];
    const double scale = done > fabs(last->energy) ? done : fabs(last->energy);
    return scale > 0 ? worst / scale : NAN;
}

/* Unit vector of the least eigenvalue of a symmetric 3 x 3 matrix, by Jacobi rotations. */
static void least_eigenvector(double a[3][3], double vector[3])
{
    double v[3][3] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
    for (int sweep = 0; sweep < 30; ++sweep)
        for (int p = 0; p < 2; ++p)
            for (int q = p + 1; q < 3; ++q) {
                if (a[p][q] == 0.0)
                    continue;
                const double theta = (a[q][q] - a[p][p]) / (2.0 * a[p][q]);
                const double t = (theta >= 0 ? 1.0 : -1.0) / (fabs(theta) + sqrt(theta * theta + 1.0));
                const double c = 1.0 / sqrt(t * t + 1.0), s = t * c;
                for (int k = 0; k < 3; ++k) {
                    const double kp = a[k][p], kq = a[k][q];
                    a[k][p] = c * kp - s * kq, a[k][q] = s * kp + c * kq;
                }
                for (int k = 0; k < 3; ++k) {
                    const double pk = a[p][k], qk = a[q][k];
                    a[p][k] = c * pk - s * qk, a[q][k] = s * pk + c * qk;
                    const double vp = v[k][p], vq = v[k][q];
                    v[k][p] = c * vp - s * vq, v[k][q] = s * vp + c * vq;
                }
            }
    int least = 0;
    for (int i = 1; i < 3; ++i)
        if (a[i][i] < a[least][least])
            least = i;
    for (int k = 0; k < 3; ++k)
        vector[k] = v[k][least];
}

/* Angle between the best-fit plane of n(t) in (r, alpha, z) and the vertical, deg. */
static double tilt(const fst_mark *first, const fst_mark *last)
{
    static const int second[3][3] = {{FST_Q_N_RR, FST_Q_N_RALPHA, FST_Q_N_RZ},
                                     {FST_Q_N_RALPHA, FST_Q_N_ALPHAALPHA, FST_Q_N_ALPHAZ},
                                     {FST_Q_N_RZ, FST_Q_N_ALPHAZ, FST_Q_N_ZZ}};
    double covariance[3][3], normal[3];
    for (int i = 0; i < 3; ++i)
        for (int j = 0; j < 3; ++j)
            covariance[i][j] = mean(first, last, second[i][j]) -
                               mean(first, last, FST_Q_N_R + i) * mean(first, last, FST_Q_N_R + j);
    if (!(covariance[0][0] + covariance[1][1] + covariance[2][2] > 1e-12))
        return NAN; /* n stands still: no plane */
    least_eigenvector(covariance, normal);
    const double sine = fabs(normal[2]);
    return DEGREES * asin(sine < 1 ? sine : 1.0);
}

static void fill_means(const fst_run_state *run, const fst_mark_series *series, fst_run_result *result)
{
    const fst_mark *first = &series->kept[0], *last = &series->latest;
    const fst_groups *g = &run->model->groups;
    fst_ramp_point means;
    fst_means_between(run, first, last, &means);
    result->mean_r = means.mean_r;
    result->std_r = means.std_r;
    result->mean_alpha_dot = means.mean_alpha_dot;
    result->mean_phi_dot = means.mean_phi_dot;
    result->mean_nz = means.mean_nz;
    result->mean_r_error = standard_error(run, series, pick_r);
    result->mean_alpha_dot_error = standard_error(run, series, pick_alpha_dot);
    result->mean_nz_error = standard_error(run, series, pick_nz);
    result->mean_b = mean(first, last, FST_Q_B);
    result->std_b = deviation(mean(first, last, FST_Q_B2), result->mean_b - run->q.b_reference);
    result->mean_friction_power = mean(first, last, FST_Q_FRICTION_POWER);
    result->mean_drive_power = mean(first, last, FST_Q_DRIVE_POWER);
    result->energy_residual = energy_residual(series, last);
    result->rms_slip = sqrt(mean(first, last, FST_Q_SLIP2));
    result->tilt_deg = tilt(first, last);
    const double load = mean(first, last, FST_Q_LOAD);
    if (g->gravity > 0)
        result->mean_load_weights = load / g->gravity;
    result->dry_friction_rate = run->params->friction_mu * load / (g->eps * g->omega) / g->time_unit;
    result->eq21_centrifugal = mean(first, last, FST_Q_CENTRIFUGAL);
    result->eq21_magnetic = mean(first, last, FST_Q_FORCE_R);
    result->eq21_magnetic_printed = mean(first, last, FST_Q_FORCE_R_PRINTED);
    result->eq21_friction = -mean(first, last, FST_Q_SLIP_R);
    result->eq21_spin = mean(first, last, FST_Q_SPIN_TERM);
    result->eq22_magnetic = mean(first, last, FST_Q_TORQUE_ALPHA);
    result->eq22_friction = -mean(first, last, FST_Q_R_SLIP_ALPHA);
    result->eq23_magnetic = mean(first, last, FST_Q_EQ23);
    result->mean_v_alpha = mean(first, last, FST_Q_SLIP_ALPHA);
    result->window_periods = fst_twofold_difference(last->t, first->t) / run->drive_period;
}

static void fill_extremes(const fst_run_state *run, fst_run_result *result)
{
    const fst_extreme *e = run->q.extreme;
    const double gravity = run->model->groups.gravity;
    if (!(e[FST_TRACK_R].greatest > 0))
        return;
    result->min_r = e[FST_TRACK_R].least;
    result->max_r = e[FST_TRACK_R].greatest;
    result->min_b = e[FST_TRACK_B].least;
    result->max_b = e[FST_TRACK_B].greatest;
    result->max_angle_deg = DEGREES * fst_angle_of_gap(e[FST_TRACK_GAP].greatest);
    result->max_slip = sqrt(e[FST_TRACK_SLIP].greatest);
    if (gravity > 0) {
        result->min_load_weights = e[FST_TRACK_LOAD].least / gravity;
        result->max_load_weights = e[FST_TRACK_LOAD].greatest / gravity;
    }
}

static void fill_end(fst_run_state *run, fst_run_result *result)
{
    const fst_flow *flow = run->flow;
    const double x = run->ended ? run->end_fraction : 1.0;
    const fst_twofold t = fst_flow_time(flow, x);
    if (x == 1.0)
        memcpy(result->final_state, flow->step.end, sizeof result->final_state);
    else
        fst_flow_at(run->flow, x, result->final_state);
    double whole, rest;
    fst_flow_drive_turns(flow, t, &whole, &rest);
    result->end_time = t.high;
    const int all_done = t.high == run->t_end && run->ramp_rate == 0.0;
    result->periods = all_done ? run->params->run_periods : whole + rest;
    result->omega = fst_flow_omega(flow, t);
    const int as_given = isnan(run->params->drive_omega) && run->ramp_rate == 0.0;
    result->frequency_hz =
        as_given ? run->params->drive_frequency : result->omega / (TWO_PI * run->model->groups.time_unit);
    result->norm_drift = flow->norm_drift;
    result->accepted = flow->accepted;
    result->rejected = flow->rejected;
    result->rhs_calls += flow->rhs_calls;
}

void fst_fill_window(const fst_run_state *run, const fst_mark_series *series, fst_run_result *result)
{
    fill_means(run, series, result);
    fill_extremes(run, result);
}

fst_status fst_run_conclude(fst_run_state *run, fst_run_result *result, fst_error *error)
{
    fill_end(run, result);
    if (run->ended) {
        result->regime = run->end_regime;
        const double r = sqrt(result->final_state[FST_X] * result->final_state[FST_X] +
                              result->final_state[FST_Y] * result->final_state[FST_Y]);
        (void)snprintf(result->reason, sizeof result->reason,
                       "%s at t = %.10g, after %.6g drive periods, at r = %.6g",
                       run->end_regime == FST_REGIME_EJECTED ? "the bead passed the plate's edge"
                                                             : "the normal load on the plate fell to zero",
                       result->end_time, result->periods, r);
        return FST_OK;
    }
    if (run->ramp_rate != 0.0) {
        fst_ramp_conclude(run, result);
        return FST_OK;
    }
    const fst_mark_series *series = fst_window_of(run);
    if (series->offered < 2) {
        (void)snprintf(
            result->reason, sizeof result->reason,
            "the run is too short: %.6g drive periods and %.6g of them discarded leave no two whole ones for "
            "the means; raise run.periods or lower run.discard",
            run->params->run_periods, run->t_discard / run->drive_period);
        return FST_OK;
    }
    fst_fill_window(run, series, result);
    result->returns = run->returns.crossings;
    const fst_status status = fst_decide_regime(run, result, error);
    if (status != FST_OK)
        return status;
    const int turning =
        result->regime == FST_REGIME_COUNTER_ROTATING || result->regime == FST_REGIME_COROTATING;
    if (turning) {
        const double a = result->symmetry == FST_SYMMETRY_S2 ? 2.0 : 1.0;
        result->festoons = a * (1.0 + result->omega / fabs(result->mean_alpha_dot));
        result->period = TWO_PI / fabs(result->omega - result->mean_alpha_dot);
    }
    return FST_OK;
}
