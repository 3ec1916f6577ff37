/* means.c - from marks to means, and to errors of means that cover.
 *
 * The mean of any quantity between two marks is the difference of its integrals there over the time between
 * them. Between the first and the latest mark of a series this is the mean that is reported; between
 * neighbouring kept marks it is the mean of a block, and the blocks show how far the mean may be off:
 *
 *     kept marks   |-----------|-----------|-----------|-----------|---...
 *     block means       m1          m2          m3          m4
 *
 *     scatter      twice the deviation of the blocks over the root of their number
 *     drift        three times the way that a mean which still moves has to go: drift_error()
 *     approach     what blocks that came closer to the last one have added: approach_error()
 *     unseen       what all blocks may lack alike, because they end within a swing: unseen_of()
 *     tolerance    what the integration may have lost
 *     joined       of chaos: the scatter of blocks that are joined by two or four
 *     halves       likewise: what the means of the window's halves differ by
 *
 * The error is the largest of these: a limit that the mean of a motion without end is to keep, and two
 * standard errors where chance alone moves the blocks.  Chance moves three thirds the same way in one window of
 * three, and then a series through them may end anywhere: of chaos a drift counts where it is more than chance
 * brings about, and as no more than the range of the blocks.  Whether a drift means that a motion has not
 * settled is not decided here, but in study/drift.c.
 */
#include "observe/means.h"

#include <math.h>
#include <stddef.h>
#include <string.h>

#include "base/constants.h"
#include "base/elementary.h"

static const double ROUNDING = 1e-12; /* of a share of time */
/* Standard deviations of a mean over blocks that scatter. */
static const double SCATTERS = 2.0;
/* The end of a drift, extrapolated, is missed by a hair each second time, and by more where the blocks are few.
 */
static const double MARGIN = 3.0;
/* Standard deviations by which the last third of chaos differs from the first where it drifts. */
static const double DRIFTS = 2.0;
/* What blocks that come closer have added is known but for how far the last one was from the end. */
static const double HAIR = 1.5;
/* A swing cut off anywhere shifts the mean over a block by so many of its standard deviations: a square wave.
 */
static const double PART = 0.5;
/* A state that differs may shift means by so many times as much. */
static const double SHIFT = 2.0;
/* The integration may have lost so many times its tolerance. */
static const double LOST = 4.0;
/* Where nothing damps what it lost, it has lost as much again after so many turns. */
static const double TURNS = 400.0;

/* sqrt(<u^2> - <u>^2) from <(u - u0)^2> and <u> - u0, never the root of a negative rounding error. */
static double deviation(double mean_square, double mean_difference)
{
    const double variance = mean_square - mean_difference * mean_difference;
    return variance > 0 ? sqrt(variance) : 0.0;
}

void fst_means_between(const fst_window *w, const fst_mark *first, const fst_mark *last, fst_ramp_point *means)
{
    const double time = fst_time_between(first, last);
    means->omega = 0.5 * (first->omega + last->omega); /* on a ramp the mean drive is the one in the middle */
    means->frequency_hz = means->omega / (FST_TWO_PI * w->groups.time_unit);
    means->mean_r = fst_mean_between(first, last, FST_Q_R);
    means->std_r =
        deviation(fst_mean_between(first, last, FST_Q_R2), means->mean_r - w->quadrature.sums.r_reference);
    means->mean_alpha_dot =
        means->omega + (last->bead_angle - first->bead_angle) / time; /* alpha = Phi + drive phase */
    means->mean_phi_dot = (last->moment_angle - first->moment_angle) / time;
    means->mean_nz = fst_mean_between(first, last, FST_Q_N_Z);
}

/* Error of a mean whose blocks drift the same way: the distance to where a geometric series through the means
 * of the window's thirds would end. 0 where there is no such drift, or no more than `chance`, the deviation of a
 * block, brings about. */
static double drift_error(const double *blocks, int count, double mean_value, double chance)
{
    const int third = count / 3;
    double sums[3] = {0, 0, 0};
    for (int i = 0; i < 3 * third; ++i)
        sums[i / third] += (blocks[i] - mean_value) / third;
    const double first_step = sums[1] - sums[0], second_step = sums[2] - sums[1];
    if (third < 1 || !(first_step * second_step > 0) ||
        fabs(sums[2] - sums[0]) < DRIFTS * chance * sqrt(2.0 / third))
        return 0.0;
    const double ratio = fmin(second_step / first_step, 0.995); /* 1 and above: it does not say where it ends */
    return fabs(sums[2] + second_step * ratio / (1.0 - ratio));
}

/* What blocks that come closer to the last ones, in whatever way, have added to the mean: the mean distance of
 * the blocks from the last.  0 where the second half of them is no closer than the first. */
static double approach_error(const double *blocks, int count)
{
    double halves[2] = {0.0, 0.0};
    for (int i = 0; i < count; ++i)
        halves[i >= count / 2] += fabs(blocks[i] - blocks[count - 1]) / count;
    return halves[1] < 0.5 * halves[0] ? HAIR * (halves[0] + halves[1]) : 0.0;
}

/* Two standard errors by the scatter of blocks that are joined by two or by four: chaos may go on in the next block
 * with what it did in one, and then single blocks scatter too little for their number. */
static double joined_scatter(const double *blocks, int count)
{
    enum { LEAST_GROUPS = 8 };
    double most = 0.0;
    for (int size = 2; count / size >= LEAST_GROUPS; size *= 2) {
        const int groups = count / size;
        double sum = 0.0, sum2 = 0.0;
        for (int i = 0; i < groups; ++i) {
            double group = 0.0;
            for (int k = 0; k < size; ++k)
                group += (blocks[i * size + k] - blocks[0]) / size;
            sum += group;
            sum2 += group * group;
        }
        most = fmax(most, (sum2 - sum * sum / groups) / (groups - 1) / groups);
    }
    return SCATTERS * sqrt(most);
}

/* Error of a mean from the blocks between the kept marks: their scatter, or the rest of a drift, or what it
 * is at least, whichever is largest; `pick` is the offset of the block's mean. */
static double error_of(const fst_window *w, const fst_mark_series *series, int chaotic, double least,
                       size_t pick)
{
    const int count = series->count - 1;
    if (count < 2)
        return NAN;
    double blocks[FST_MARKS], sum = 0.0, sum2 = 0.0, lowest = INFINITY, highest = -INFINITY;
    for (int i = 0; i < count; ++i) {
        fst_ramp_point means;
        fst_means_between(w, &series->kept[i], &series->kept[i + 1], &means);
        memcpy(&blocks[i], (const char *)&means + pick, sizeof *blocks);
        sum += blocks[i] - blocks[0];
        sum2 += (blocks[i] - blocks[0]) * (blocks[i] - blocks[0]);
        lowest = fmin(lowest, blocks[i]);
        highest = fmax(highest, blocks[i]);
    }
    const double variance = (sum2 - sum * sum / count) / (count - 1), mean_value = blocks[0] + sum / count;
    const double scatter = SCATTERS * (variance > 0 ? sqrt(variance / count) : 0.0);
    const double chance = chaotic && variance > 0 ? sqrt(variance) : 0.0;
    const double drift = MARGIN * drift_error(blocks, count, mean_value, chance);
    const double way = fmax(drift, approach_error(blocks, count));
    const double more = chaotic ? fmax(joined_scatter(blocks, count), fmin(way, highest - lowest)) : way;
    return fmax(fmax(scatter, more), least);
}

/* What a mean over the blocks of a series may lack beside what they show, because of what they do not end with:
 * each of them may lack the same. */
typedef struct unseen {
    double r, nz, alpha_dot;
} unseen;

static unseen unseen_of(const fst_window *w, const fst_mark_series *series, const fst_run_result *result)
{
    const fst_mark *first = &series->kept[0], *last = &series->latest;
    const double blocks = fmax(series->count - 1, 1.0), omega = w->groups.omega;
    const double range = w->greatest_bead_angle - w->least_bead_angle;
    unseen cut = {PART * result->std_r / blocks,
                  PART * deviation(fst_mean_between(first, last, FST_Q_N_ZZ), result->mean_nz) / blocks,
                  fmin(range, 0.5 * FST_TWO_PI) / fst_time_between(first, last)};
    if (series == &w->periods)
        return cut;
    double farthest = 0.0; /* a block's motion differs as much as the states at its ends */
    for (int i = series->count / 2; i < series->count; ++i) /* what comes closer before is seen in blocks */
        farthest = fmax(farthest, SHIFT * fst_state_distance(series->kept[i].state, last->state));
    cut.r = fmin(cut.r, farthest / blocks);
    cut.nz = fmin(cut.nz, farthest / blocks);
    cut.alpha_dot = fmin(cut.alpha_dot, omega * farthest / blocks);
    return cut;
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
                            (to->integrals[FST_Q_FRICTION_POWER] - from->integrals[FST_Q_FRICTION_POWER]) -
                            (to->integrals[FST_Q_ROLLING_POWER] - from->integrals[FST_Q_ROLLING_POWER]) -
                            (to->integrals[FST_Q_PIVOTING_POWER] - from->integrals[FST_Q_PIVOTING_POWER]) -
                            (to->impact_loss - from->impact_loss);
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
            covariance[i][j] =
                fst_mean_between(first, last, second[i][j]) -
                fst_mean_between(first, last, FST_Q_N_R + i) * fst_mean_between(first, last, FST_Q_N_R + j);
    if (!(covariance[0][0] + covariance[1][1] + covariance[2][2] > 1e-12))
        return NAN; /* n stands still: no plane */
    least_eigenvector(covariance, normal);
    const double sine = fabs(normal[2]);
    return FST_DEGREES * fst_asin(sine < 1 ? sine : 1.0);
}

int fst_never_slips(const fst_window *w, const fst_mark_series *series)
{
    const fst_mark *first = &series->kept[0], *last = &series->latest;
    return w->dry && last->captures == first->captures &&
           fst_mean_between(first, last, FST_Q_STICKING) > 1.0 - ROUNDING;
}

/* What a contact with dry friction does, which slips and sticks.  Whether it slips is not known where it nearly lets go
 * without a slip, nor where its slips take less than what the integration may have lost. */
static void fill_contact(const fst_window *w, const fst_mark_series *series, double lost,
                         fst_run_result *result)
{
    const fst_mark *first = &series->kept[0], *last = &series->latest;
    const int64_t captures = last->captures - first->captures;
    const double sticking = fst_mean_between(first, last, FST_Q_STICKING),
                 slip2 = fst_mean_between(first, last, FST_Q_SLIP2);
    const int never_slips = fst_never_slips(w, series);
    const double rubbed = result->mean_friction_power * fst_time_between(first, last);
    const int as_well = never_slips ? last->touches > first->touches : rubbed < lost * fabs(last->energy);
    result->never_slips = as_well && sticking > 0.5 ? -1 : never_slips;
    result->sticking = never_slips ? 1.0 : sticking;
    result->mean_rolling_power = fst_mean_between(first, last, FST_Q_ROLLING_POWER);
    result->mean_pivoting_power = fst_mean_between(first, last, FST_Q_PIVOTING_POWER);
    if (!never_slips && slip2 > 0)
        result->effective_rate = result->mean_friction_power / slip2;
    result->flying = fst_mean_between(first, last, FST_Q_FLYING);
    result->mean_impact_power = (last->impact_loss - first->impact_loss) / fst_time_between(first, last);
    if (series == &w->returns.marks && !w->returns.of_cycles)
        result->impacts_per_return = (double)(last->impacts - first->impacts) / (double)(series->offered - 1);
    if (series == &w->returns.marks && !w->returns.of_cycles)
        result->captures_per_return = (double)captures / (double)(series->offered - 1);
}

static void fill_errors(const fst_window *w, const fst_mark_series *series, const fst_params *params,
                        int chaotic, fst_run_result *result)
{
    const unseen lacks = unseen_of(w, series, result);
    const double turns = series->latest.t.high / w->period;
    const double lost = LOST * params->run_rtol * (fst_never_slips(w, series) ? 1.0 + turns / TURNS : 1.0);
    result->mean_r_error = error_of(w, series, chaotic, fmax(lacks.r, lost * fabs(result->mean_r)),
                                    offsetof(fst_ramp_point, mean_r));
    result->mean_alpha_dot_error = error_of(w, series, chaotic, fmax(lacks.alpha_dot, lost * w->groups.omega),
                                            offsetof(fst_ramp_point, mean_alpha_dot));
    result->mean_nz_error =
        error_of(w, series, chaotic, fmax(lacks.nz, lost), offsetof(fst_ramp_point, mean_nz));
    if (result->mean_nz_error > 1.0 + fabs(result->mean_nz)) /* n is a unit vector */
        result->mean_nz_error = 1.0 + fabs(result->mean_nz);
}

void fst_means_fill(const fst_window *w, const fst_mark_series *series, const fst_params *params,
                    fst_run_result *result)
{
    const fst_mark *first = &series->kept[0], *last = &series->latest;
    const fst_groups *g = &w->groups;
    fst_ramp_point means;
    fst_means_between(w, first, last, &means);
    result->mean_r = means.mean_r;
    result->std_r = means.std_r;
    result->mean_alpha_dot = means.mean_alpha_dot;
    result->mean_phi_dot = means.mean_phi_dot;
    result->mean_nz = means.mean_nz;
    fill_errors(w, series, params, 0, result);
    result->mean_b = fst_mean_between(first, last, FST_Q_B);
    result->std_b =
        deviation(fst_mean_between(first, last, FST_Q_B2), result->mean_b - w->quadrature.sums.b_reference);
    result->mean_friction_power = fst_mean_between(first, last, FST_Q_FRICTION_POWER);
    result->mean_drive_power = fst_mean_between(first, last, FST_Q_DRIVE_POWER);
    result->energy_residual = energy_residual(series, last);
    if (w->dry)
        fill_contact(w, series, LOST * params->run_rtol, result);
    result->rms_slip = sqrt(fst_mean_between(first, last, FST_Q_SLIP2));
    result->tilt_deg = tilt(first, last);
    const double impulse = last->impulse - first->impulse;
    double load = fst_mean_between(first, last, FST_Q_LOAD);
    if (impulse > 0)
        load += impulse / fst_time_between(first, last);
    if (g->gravity > 0)
        result->mean_load_weights = load / g->gravity;
    result->dry_friction_rate = params->friction_mu * load / (g->eps * g->omega) / g->time_unit;
    result->eq21_centrifugal = fst_mean_between(first, last, FST_Q_CENTRIFUGAL);
    result->eq21_magnetic = fst_mean_between(first, last, FST_Q_FORCE_R);
    result->eq21_magnetic_printed = fst_mean_between(first, last, FST_Q_FORCE_R_PRINTED);
    result->eq21_friction = -fst_mean_between(first, last, FST_Q_SLIP_R);
    result->eq21_spin = fst_mean_between(first, last, FST_Q_SPIN_TERM);
    result->eq22_magnetic = fst_mean_between(first, last, FST_Q_TORQUE_ALPHA);
    result->eq22_friction = -fst_mean_between(first, last, FST_Q_R_SLIP_ALPHA);
    result->eq23_magnetic = fst_mean_between(first, last, FST_Q_EQ23);
    result->mean_v_alpha = fst_mean_between(first, last, FST_Q_SLIP_ALPHA);
    result->window_periods = fst_twofold_difference(last->t, first->t) / w->period;
    fst_extremes_fill(w->extremes, g->gravity, result);
}

void fst_means_of_chaos(const fst_window *w, const fst_mark_series *series, const fst_params *params,
                        fst_run_result *result)
{
    fst_ramp_point first, second;
    const fst_mark *middle = &series->kept[series->count / 2];
    if (series->count < 3)
        return;
    fill_errors(w, series, params, 1, result);
    fst_means_between(w, &series->kept[0], middle, &first);
    fst_means_between(w, middle, &series->latest, &second);
    result->mean_r_error = fmax(result->mean_r_error, fabs(second.mean_r - first.mean_r));
    result->mean_alpha_dot_error =
        fmax(result->mean_alpha_dot_error, fabs(second.mean_alpha_dot - first.mean_alpha_dot));
    result->mean_nz_error =
        fmin(fmax(result->mean_nz_error, fabs(second.mean_nz - first.mean_nz)), 1.0 + fabs(result->mean_nz));
}
