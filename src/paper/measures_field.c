/* measures_field.c - statements about the field, and about the forces along a path. */
#include "base/constants.h"
#include "paper/dry.h"
#include "paper/measures_parts.h"

#include <stdlib.h>

/* ------------------------------------------------------------------ the field */

/* Add weight times B(x, 0) at `up` above the bead's centre; the height is a parameter of the model. */
static int add_field(const fst_params *scene, const double place[3], double weight, double sum[3])
{
    fst_params params = *scene;
    fst_model *model = NULL;
    double b[3], gradient[3][3];
    params.model_h = (params.magnet_depth + params.bead_radius) / params.magnet_half_length + place[2];
    if (fst_model_new(&params, &model, NULL) != FST_OK)
        return 0;
    fst_field(model, place[0], place[1], b, gradient);
    fst_model_free(model);
    for (int i = 0; i < 3; ++i)
        sum[i] += weight * b[i];
    return 1;
}

/* The mean of B over the ball, on three shells, by Gauss's rule in z (six points) and twelve points round.  On
 * each shell it is exact to the eleventh degree; the error falls as (eps/h)^12. */
MEASURE(ball_mean)
{
    static const double zs[6] = {-0.932469514203152, -0.661209386466265, -0.238619186083197,
                                 0.238619186083197,  0.661209386466265,  0.932469514203152};
    static const double zw[6] = {0.171324492379170, 0.360761573048139, 0.467913934572691,
                                 0.467913934572691, 0.360761573048139, 0.171324492379170};
    static const double ss[3] = {0.112701665379258, 0.5, 0.887298334620742};
    static const double sw[3] = {5.0 / 18.0, 8.0 / 18.0, 5.0 / 18.0};
    const fst_params *p = &fst_paper_single(paper, FST_SCAN_FOLD4, dynamics)->params;
    double eps = p->bead_radius / p->magnet_half_length, centre[3] = {0}, mean[3] = {0}, all = 0.0, off = 0.0;
    const double place[3] = {0.9, 0.0, 0.0};
    int good = add_field(p, place, 1.0, centre);
    for (int i = 0; i < 3 * 6 * 12 && good; ++i) {
        double s = ss[i / 72], z = zs[i / 12 % 6], turn = 2.0 * FST_PI * (i % 12) / 12.0;
        double weight = sw[i / 72] * s * s * zw[i / 12 % 6], flat = s * eps * sqrt(1.0 - z * z);
        const double here[3] = {0.9 + flat * cos(turn), flat * sin(turn), s * eps * z};
        good = add_field(p, here, weight, mean);
        all += weight;
    }
    for (int i = 0; i < 3; ++i)
        off += (mean[i] / all - centre[i]) * (mean[i] / all - centre[i]);
    (void)snprintf(
        note, size,
        "no approximation: each component of B is harmonic, so that its mean over the ball is its value at "
        "the centre (216 points of the ball at r = 0.9)");
    return good ? sqrt(off / (centre[0] * centre[0] + centre[1] * centre[1] + centre[2] * centre[2])) : NAN;
}

/* The magnetic averages of Eqs. (12), (13) and (14) on a circle of radius r for phi = rate Phi + chi, and
 * the mean of n.B. */
static void averages_at(const fst_model *model, double r, double rate, double chi, double terms[4])
{
    enum { ANGLES = 256 };
    for (int k = 0; k < 4; ++k)
        terms[k] = 0.0;
    for (int i = 0; i < ANGLES; ++i) {
        double turn = 2.0 * FST_PI * i / ANGLES, c = cos(turn), s = sin(turn), moment = chi + rate * turn, b[3],
               g[3][3];
        fst_field(model, r * c, r * s, b, g);
        const double n[3] = {-sin(moment) * s, sin(moment) * c, -cos(moment)};
        for (int k = 0; k < 3; ++k) {
            terms[0] += n[k] * (g[k][0] * c + g[k][1] * s) / ANGLES;
            terms[1] += n[k] * r * (g[k][1] * c - g[k][0] * s) / ANGLES;
            terms[3] += n[k] * b[k] / ANGLES;
        }
        terms[2] += ((b[1] * c - b[0] * s) * cos(moment) + b[2] * sin(moment)) / ANGLES;
    }
}

/* The paper's choice, phi = -Phi + chi. */
static void averages(const fst_model *model, double r, double chi, double terms[4])
{
    averages_at(model, r, -1.0, chi, terms);
}

/* The mean radial force is A cos(chi) + B sin(chi).  Compare it at each other whole rate with that at -1. */
MEASURE(resonance)
{
    fst_model *model = model_of(paper, FST_SCAN_FOLD15, dynamics);
    double size_of[7], greatest = 0.0, r = single(paper, FST_SCAN_FOLD15, dynamics)->mean_r;
    int worst = 0;
    if (!model)
        return NAN;
    for (int rate = -3; rate <= 3; ++rate) {
        double in_phase[4], quarter[4];
        averages_at(model, r, rate, 0.0, in_phase);
        averages_at(model, r, rate, 0.5 * FST_PI, quarter);
        size_of[rate + 3] = hypot(in_phase[0], quarter[0]);
    }
    for (int rate = -3; rate <= 3; ++rate) {
        if (rate == 1 || rate == -1 || size_of[rate + 3] <= greatest)
            continue;
        greatest = size_of[rate + 3];
        worst = rate;
    }
    fst_model_free(model);
    (void)snprintf(
        note, size,
        "φ = kΦ + χ on the circle r = %.3f, k from −3 to 3 save ±1; greatest for k = %d. Even and broken k "
        "give nothing, by the magnet's symmetry",
        r, worst);
    return greatest / size_of[2];
}

/* How much of the field on the circle r = 0.9 has the structure that the appendix assumes: the mean of
 * B.(sin(Phi) e_alpha + cos(Phi) e_z) over the root mean square of B, with the better sign of the magnet. */
MEASURE(field_structure)
{
    enum { ANGLES = 360 };
    fst_model *model = model_of(paper, FST_SCAN_FOLD15, dynamics);
    double along = 0.0, square = 0.0, r = 0.9;
    if (!model)
        return NAN;
    for (int i = 0; i < ANGLES; ++i) {
        double turn = 2.0 * FST_PI * i / ANGLES, c = cos(turn), s = sin(turn), b[3], g[3][3];
        fst_field(model, r * c, r * s, b, g);
        along += ((b[1] * c - b[0] * s) * s + b[2] * c) / ANGLES;
        square += (b[0] * b[0] + b[1] * b[1] + b[2] * b[2]) / ANGLES;
    }
    fst_model_free(model);
    (void)snprintf(note, size,
                   "on the circle r = 0.9: mean of the field along that direction over its root mean square");
    return fabs(along) / sqrt(square);
}

MEASURE(sine_law)
{
    fst_model *model = model_of(paper, FST_SCAN_FOLD15, dynamics);
    double amplitude[4], quarter[4], now[4], worst = 0.0, r = single(paper, FST_SCAN_FOLD15, dynamics)->mean_r;
    if (!model)
        return NAN;
    averages(model, r, 0.0, amplitude);
    averages(model, r, 0.5 * FST_PI, quarter);
    for (int i = 0; i < 24; ++i) {
        double chi = 2.0 * FST_PI * i / 24.0 + 0.1;
        averages(model, r, chi, now);
        worst = fmax(worst, fabs(now[0] - amplitude[0] * cos(chi)) / fabs(amplitude[0]));
        for (int k = 1; k < 3; ++k)
            worst = fmax(worst, fabs(now[k] - quarter[k] * sin(chi)) / fabs(quarter[k]));
    }
    fst_model_free(model);
    (void)snprintf(note, size, "on the circle r = %.3f, 24 phases χ", r);
    return worst;
}

MEASURE(least_energy)
{
    NO_NOTE;
    fst_model *model = model_of(paper, FST_SCAN_FOLD15, dynamics);
    double at_pi[4], at_zero[4], r = single(paper, FST_SCAN_FOLD15, dynamics)->mean_r;
    if (!model)
        return NAN;
    averages(model, r, FST_PI, at_pi);
    averages(model, r, 0.0, at_zero);
    fst_model_free(model);
    /* The energy is -n.B. -1: it changes its sign between 0 and pi; it is negative at pi if n.B is positive
     * there. */
    return at_pi[3] > 0.0 ? at_pi[3] / at_zero[3] : NAN;
}

/* ------------------------------------------------------------------ the model's magnet */

/* The field of dipoles along one line, integrated by Gauss's rule with five points on each of 40 pieces, to
 * compare with that of the charges at its ends. */
MEASURE(line_of_dipoles)
{
    static const double nodes[5] = {-0.906179845938664, -0.538469310105683, 0.0, 0.538469310105683,
                                    0.906179845938664};
    static const double weights[5] = {0.236926885056189, 0.478628670499366, 0.568888888888889,
                                      0.478628670499366, 0.236926885056189};
    enum { PIECES = 40 };
    fst_params params = fst_paper_single(paper, FST_SCAN_FOLD4, dynamics)->params;
    fst_model *model = NULL;
    double worst = 0.0;
    params.magnet_lines = 1;
    NO_NOTE;
    if (fst_model_new(&params, &model, NULL) != FST_OK)
        return NAN;
    double h = fst_model_groups(model).h;
    for (int place = 0; place < 12; ++place) {
        double x = 0.15 * place, y = 0.1 * place - 0.4, b[3], grad[3][3], sum[3] = {0.0, 0.0, 0.0}, off = 0.0;
        for (int i = 0; i < 5 * PIECES; ++i) {
            double at = -1.0 + (2 * (i / 5) + 1 + nodes[i % 5]) / PIECES, weight = weights[i % 5] / PIECES;
            const double d[3] = {x - at, y, h};
            double square = d[0] * d[0] + d[1] * d[1] + d[2] * d[2], cube = square * sqrt(square);
            for (int k = 0; k < 3; ++k) /* the field of a dipole along the line */
                sum[k] += weight * (3.0 * d[0] * d[k] / square - (k == 0)) / cube;
        }
        fst_field(model, x, y, b, grad);
        for (int k = 0; k < 3; ++k) /* one line has the strength of all five */
            off += (5.0 * sum[k] - b[k]) * (5.0 * sum[k] - b[k]);
        worst = fmax(worst, sqrt(off / (b[0] * b[0] + b[1] * b[1] + b[2] * b[2])));
    }
    fst_model_free(model);
    return worst;
}

/* ------------------------------------------------------------------ corotation */

MEASURE(slow_pole)
{
    const fst_paper_run *run = &paper->scans[FST_SCAN_SLOW][dynamics][0];
    double maximum =
        0.5e-3 * fst_measure_maxima_distance(paper, dynamics, note, size) / run->params.magnet_half_length;
    (void)snprintf(note, size, "at the drive %g: r = %.4f, the maximum lies at %.4f", run->result.omega,
                   run->result.mean_r, maximum);
    return fabs(run->result.mean_r - maximum);
}

MEASURE(slow_parallel)
{
    NO_NOTE;
    return paper->scans[FST_SCAN_SLOW][dynamics][0].result.max_angle_deg;
}

static int by_power(const void *one, const void *other)
{
    const fst_run_result *const *a = one, *const *b = other;
    const double x = (*a)->mean_friction_power, y = (*b)->mean_friction_power;
    return (x > y) - (x < y);
}

/* The locked runs, the one with the least friction first. */
enum { MOST_LOCKED = 64 };
static int locked_runs(const fst_paper_state *paper, fst_dynamics dynamics,
                       const fst_run_result *runs[MOST_LOCKED])
{
    int count = 0;
    for (int i = 0; i < paper->counts[FST_SCAN_SLOW] && count < MOST_LOCKED; ++i)
        if (paper->scans[FST_SCAN_SLOW][dynamics][i].result.regime == FST_REGIME_LOCKED)
            runs[count++] = &paper->scans[FST_SCAN_SLOW][dynamics][i].result;
    qsort(runs, (size_t)count, sizeof runs[0], by_power);
    return count;
}

MEASURE(slow_friction)
{
    const fst_run_result *runs[MOST_LOCKED];
    const int count = locked_runs(paper, dynamics, runs);
    int slipping = 0;
    if (count == 0)
        return NAN;
    for (int i = 0; i < count; ++i)
        slipping += runs[i]->rms_slip > 1e-6;
    (void)snprintf(note, size,
                   "%d of %d locked runs, 1 to 12 Hz, lose more than rounding: on the magnet's axis the spin "
                   "about n takes "
                   "the value at which the contact is at rest",
                   slipping, count);
    return 100.0 * runs[count / 2]->mean_friction_power /
           single(paper, FST_SCAN_FOLD4, dynamics)->mean_friction_power;
}

MEASURE(most_slow_friction)
{
    const fst_run_result *runs[MOST_LOCKED];
    const int count = locked_runs(paper, dynamics, runs);
    if (count == 0)
        return NAN;
    const fst_run_result *most = runs[count - 1];
    (void)snprintf(note, size, "locked at %.1f Hz, Φ = %+.1f deg, where the contact slips at %.3f ℓγ",
                   most->frequency_hz, FST_DEGREES * atan2(most->final_state[FST_Y], most->final_state[FST_X]),
                   most->rms_slip);
    return 100.0 * most->mean_friction_power / single(paper, FST_SCAN_FOLD4, dynamics)->mean_friction_power;
}

MEASURE(slow_drag)
{
    const fst_run_result *slowest = &paper->scans[FST_SCAN_SLOW][dynamics][0].result;
    (void)snprintf(note, size,
                   "at %.2f Hz, where friction takes %.0e ℓ²γ³ of power. A bead that stays parallel to the "
                   "field is free to "
                   "spin about its axis, and rolls without any slip",
                   slowest->frequency_hz, slowest->mean_friction_power);
    return 100.0 * slowest->rms_slip / (slowest->omega * slowest->mean_r);
}

MEASURE(unlocking)
{
    const fst_paper_exact *exact = &paper->exact[dynamics];
    const double hertz =
        fst_paper_single(paper, FST_SCAN_SLOW, dynamics)->params.friction_gamma / (2.0 * FST_PI);
    if (exact->missing[0])
        (void)snprintf(note, size, "%s", exact->missing);
    else
        (void)snprintf(
            note, size,
            "the last locked state loses its stability at %.4f Hz; with γ greater by %.0f %% and the same "
            "field, bead and magnet at %.4f Hz, where the paper's balance has %.2f Hz",
            hertz * exact->locked_end, 100.0 * (FST_MORE_FRICTION - 1.0), hertz * exact->locked_end_rubbed,
            hertz * exact->locked_end / FST_MORE_FRICTION);
    return -log(exact->locked_end_rubbed / exact->locked_end) / log(FST_MORE_FRICTION);
}

MEASURE(locked_again)
{
    int others = 0, all = 0, undecided = 0;
    for (int i = 0; i < paper->counts[FST_SCAN_SLOW]; ++i) {
        const fst_run_result *result = &paper->scans[FST_SCAN_SLOW][dynamics][i].result;
        if (result->frequency_hz >= 7.0)
            continue;
        ++all;
        undecided += isnan(result->mean_alpha_dot) && result->regime == FST_REGIME_UNDECIDED;
        others += fst_outcome(result) != FST_OUTCOME_WITH;
    }
    (void)snprintf(note, size,
                   "of %d runs from rest under 7 Hz; what they lie below is no chaos here (see chaos)", all);
    return others > 0 && others == undecided ? NAN : (double)others;
}

MEASURE(not_at_rest)
{
    int others = 0;
    double from = NAN, to = NAN;
    for (int i = 0; i < paper->counts[FST_SCAN_SLOW]; ++i) {
        const fst_run_result *result = &paper->scans[FST_SCAN_SLOW][dynamics][i].result;
        if (result->frequency_hz >= 7.0 || result->regime == FST_REGIME_LOCKED)
            continue;
        ++others;
        from = isnan(from) ? result->frequency_hz : from;
        to = result->frequency_hz;
    }
    if (others > 0)
        (void)snprintf(note, size, "they swing about the magnet, or roll on under it, from %.1f to %.1f Hz",
                       from, to);
    return others;
}

/* ------------------------------------------------------------------ the assumptions of section VI */

MEASURE(theta)
{
    const fst_table *table = &fst_paper_single(paper, FST_SCAN_FOLD15, dynamics)->trajectory;
    const double *n_r = fst_collected(table, "n_r");
    double sum = 0.0;
    for (size_t i = 0; i < table->rows; ++i)
        sum += n_r[i] * n_r[i];
    (void)snprintf(note, size, "Eq. (12) as printed lacks it: see the exact magnetic term");
    return sqrt(sum / (double)table->rows);
}

MEASURE(steady_radius)
{
    NO_NOTE;
    const fst_run_result *result = single(paper, FST_SCAN_FOLD15, dynamics);
    return result->std_r / result->mean_r;
}

/* The magnet's force on the bead of a sample, along the turning axes. */
static void pull_at(const fst_model *model, const fst_table *table, size_t row, double pull[2])
{
    double b[3], g[3][3];
    fst_groups groups = fst_model_groups(model);
    const double n[3] = {fst_collected(table, "nX")[row], fst_collected(table, "nY")[row],
                         fst_collected(table, "nZ")[row]};
    fst_field(model, fst_collected(table, "X")[row], fst_collected(table, "Y")[row], b, g);
    for (int i = 0; i < 2; ++i)
        pull[i] = groups.kappa * groups.eps * groups.eps * (n[0] * g[0][i] + n[1] * g[1][i] + n[2] * g[2][i]);
}

/* The mean size of the magnet's force where the bead is within pi/8 of an end of the magnet, and of its middle,
 * and how strongly it pulls inwards at both. */
typedef struct pulls {
    double force[2], inwards[2];
    int count[2];
} pulls;

static pulls pulls_of(const fst_paper_state *paper, fst_dynamics dynamics)
{
    const fst_table *table = &fst_paper_single(paper, FST_SCAN_FOLD15, dynamics)->trajectory;
    const double *x = fst_collected(table, "X"), *y = fst_collected(table, "Y"), *r = fst_collected(table, "r");
    fst_model *model = model_of(paper, FST_SCAN_FOLD15, dynamics);
    pulls sum = {{0.0, 0.0}, {0.0, 0.0}, {0, 0}};
    for (size_t row = 0; model && row < table->rows; ++row) {
        double pull[2], along = fabs(x[row]) / r[row];
        int across = along < sin(FST_PI / 8.0);
        if (!across && along < cos(FST_PI / 8.0))
            continue;
        pull_at(model, table, row, pull);
        sum.force[across] += hypot(pull[0], pull[1]);
        sum.inwards[across] -= (pull[0] * x[row] + pull[1] * y[row]) / r[row];
        ++sum.count[across];
    }
    fst_model_free(model);
    for (int i = 0; i < 2; ++i) {
        sum.force[i] /= sum.count[i];
        sum.inwards[i] /= sum.count[i];
    }
    return sum;
}

MEASURE(force_at_ends)
{
    pulls mean = pulls_of(paper, dynamics);
    (void)snprintf(note, size, "|F| = %.4f within π/8 of an end of the magnet, %.4f as near to its middle",
                   mean.force[0], mean.force[1]);
    return 100.0 * (mean.force[0] / mean.force[1] - 1.0);
}

MEASURE(pull_weakens)
{
    pulls mean = pulls_of(paper, dynamics);
    (void)snprintf(
        note, size,
        "pull inwards %+.2g at the ends of the magnet, %+.2g at its middle: the other way round. The bead is "
        "driven faster than it could swing by itself, so that r is greatest where the pull is",
        mean.inwards[0], mean.inwards[1]);
    return 100.0 * (mean.inwards[0] - mean.inwards[1]) / fmax(fabs(mean.inwards[0]), fabs(mean.inwards[1]));
}

MEASURE(modulation)
{
    const fst_table *table = &fst_paper_single(paper, FST_SCAN_FOLD15, dynamics)->trajectory;
    fst_model *model = model_of(paper, FST_SCAN_FOLD15, dynamics);
    const double *r = fst_collected(table, "r"), *x = fst_collected(table, "X"), *y = fst_collected(table, "Y");
    double n = (double)table->rows, sr = 0, sf = 0, srr = 0, sff = 0, srf = 0;
    for (size_t row = 0; model && row < table->rows; ++row) {
        double pull[2];
        pull_at(model, table, row, pull);
        double radial = (pull[0] * x[row] + pull[1] * y[row]) / r[row];
        sr += r[row];
        sf += radial;
        srr += r[row] * r[row];
        sff += radial * radial;
        srf += r[row] * radial;
    }
    fst_model_free(model);
    double together = n * srf - sr * sf,
           squared = together * together / ((n * srr - sr * sr) * (n * sff - sf * sf));
    (void)snprintf(note, size, "correlation %+.2f of r with the radial force, outwards positive",
                   together > 0.0 ? sqrt(squared) : -sqrt(squared));
    return squared;
}

/* Taken over the samples with r in the topmost tenth of its range. */
MEASURE(friction_outside)
{
    const fst_paper_run *run = fst_paper_single(paper, FST_SCAN_FOLD4, dynamics);
    const fst_table *table = &run->trajectory;
    fst_model *model = model_of(paper, FST_SCAN_FOLD4, dynamics);
    const double *r = fst_collected(table, "r"), *slip = fst_collected(table, "slip");
    double limit = run->result.max_r - 0.1 * (run->result.max_r - run->result.min_r), friction = 0.0, all = 0.0;
    double inside_friction = 0.0, inside_all = 0.0;
    for (size_t row = 0; model && row < table->rows; ++row) {
        double pull[2];
        pull_at(model, table, row, pull);
        double force = hypot(pull[0], pull[1]);
        *(r[row] > limit ? &friction : &inside_friction) += slip[row];
        *(r[row] > limit ? &all : &inside_all) += slip[row] + force;
    }
    fst_model_free(model);
    (void)snprintf(
        note, size,
        "|V| over |V| + |F|, where r is in the topmost tenth of its range; outside of these samples %.0f %%",
        100.0 * inside_friction / inside_all);
    return 100.0 * friction / all;
}
