/* measures_motion.c - what the paper says about the motion, read off trajectories and off the probes of the
 * period halving. */
#include "base/constants.h"
#include "paper/dry.h"
#include "paper/measures_parts.h"

#include <complex.h>
#include <stdlib.h>

static int rising(const void *one, const void *other)
{
    const double a = *(const double *)one, b = *(const double *)other;
    return (a > b) - (a < b);
}

/* ------------------------------------------------------------------ where friction acts */

typedef struct piece {
    double distance, path, loss;
} piece;

static int nearer(const void *one, const void *other)
{
    double a = ((const piece *)one)->distance, b = ((const piece *)other)->distance;
    return (a > b) - (a < b);
}

/* Pieces of the path between the first and the last turning point (where r is greatest), each with the time to
 * the nearest turning point, its length, and the energy that friction took on it, those nearest to a turning
 * point first; free() it.  NULL: no memory, or no pieces. */
static piece *cut_at_turning_points(const fst_measuring *m, size_t *count)
{
    const fst_path p = fst_path_of(run_of(m, FST_SCAN_FOLD4));
    piece *pieces = malloc((p.rows + 1) * sizeof *pieces);
    *count = 0;
    size_t before = fst_turning_point(&p, 1);
    for (size_t row = before; pieces && row < p.rows; before = row) {
        row = fst_turning_point(&p, row + 1);
        for (size_t i = before; row < p.rows && i < row; ++i)
            pieces[(*count)++] = (piece){fmin(p.t[i] - p.t[before], p.t[row] - p.t[i]),
                                         hypot(p.x[i + 1] - p.x[i], p.y[i + 1] - p.y[i]),
                                         p.friction_power[i] * (p.t[i + 1] - p.t[i])};
    }
    if (*count == 0) {
        free(pieces);
        return NULL;
    }
    qsort(pieces, *count, sizeof *pieces, nearer);
    return pieces;
}

static int lossier(const void *one, const void *other)
{
    double a = ((const piece *)one)->loss, b = ((const piece *)other)->loss;
    return (a < b) - (a > b);
}

/* What the quarter of the time next to the turning points has, and the quarter of the path; the pieces last
 * equally long. */
MEASURE(turning_times)
{
    size_t count;
    piece *pieces = cut_at_turning_points(m, &count);
    double path = 0.0, loss = 0.0, near_path = 0.0, near_loss = 0.0;
    double in_time[2] = {NAN, NAN}, in_path[2] = {NAN, NAN}; /* path and loss; time and loss */
    if (!pieces)
        return NAN;
    for (size_t i = 0; i < count; ++i) {
        path += pieces[i].path;
        loss += pieces[i].loss;
    }
    for (size_t i = 0; i < count; ++i) {
        const int near = near_path < 0.25 * path;
        near_path += pieces[i].path;
        near_loss += pieces[i].loss;
        if (4 * i < count) {
            in_time[0] = near_path / path;
            in_time[1] = near_loss / loss;
        }
        if (near) {
            in_path[0] = (double)(i + 1) / (double)count;
            in_path[1] = near_loss / loss;
        }
    }
    free(pieces);
    NOTE("next to the points of greatest r, where %.0f %% of the path are; the quarter of the path next to "
         "them, in which the bead spends %.0f %% of the time, has %.0f %% of the loss",
         100.0 * in_time[0], 100.0 * in_path[0], 100.0 * in_path[1]);
    return 100.0 * in_time[1];
}

MEASURE(turning_points)
{
    size_t count;
    piece *pieces = cut_at_turning_points(m, &count);
    double all = 0.0, lossiest = 0.0, both = 0.0;
    if (!pieces)
        return NAN;
    const double half = pieces[count / 2].distance;
    qsort(pieces, count, sizeof *pieces, lossier);
    for (size_t i = 0; i < count; ++i) {
        const double in_quarter = 4 * i < count ? pieces[i].loss : 0.0;
        all += pieces[i].loss;
        lossiest += in_quarter;
        both += pieces[i].distance < half ? in_quarter : 0.0;
    }
    free(pieces);
    NOTE("the quarter of the time with the greatest loss has %.0f %% of it; on the turning points themselves "
         "friction is weak, it peaks just before and after",
         100.0 * lossiest / all);
    return 100.0 * both / all;
}

MEASURE(friction_follows_angle)
{
    const fst_path path = fst_path_of(run_of(m, FST_SCAN_FOLD4));
    fst_scatter points = {0};
    for (size_t row = 0; row < path.rows; ++row)
        fst_scatter_add(&points, path.angle[row], path.slip[row]);
    return fst_scatter_correlation(&points) * fst_scatter_correlation(&points);
}

MEASURE(corner_nz)
{
    const fst_path path = fst_path_of(run_of(m, FST_SCAN_FOLD4));
    double sum = 0.0;
    int corners = 0;
    for (size_t row = fst_turning_point(&path, 1); row < path.rows;
         row = fst_turning_point(&path, row + 1), ++corners)
        sum += path.n_z[row];
    NOTE("mean of n_z at the %d points of greatest r; the conjugate motion has it negative", corners);
    return corners > 0 ? fabs(sum / corners) : NAN;
}

MEASURE(rare_moments)
{
    const fst_path path = fst_path_of(run_of(m, FST_SCAN_FOLD4));
    size_t high = 0;
    for (size_t row = 0; row < path.rows; ++row)
        high += path.angle[row] > 0.5 * run_of(m, FST_SCAN_FOLD4)->result.max_angle_deg;
    return 100.0 * (double)high / (double)path.rows;
}

/* The share of the time, the largest angles first, that holds half of the mean square of the angle. */
MEASURE(half_of_the_angle)
{
    const fst_path path = fst_path_of(run_of(m, FST_SCAN_FOLD4));
    double *squares = malloc((path.rows + 1) * sizeof *squares), all = 0.0, held = 0.0;
    size_t row = 0;
    if (!squares)
        return NAN;
    for (; row < path.rows; ++row) {
        squares[row] = path.angle[row] * path.angle[row];
        all += squares[row];
    }
    qsort(squares, path.rows, sizeof *squares, rising);
    for (row = 0; row < path.rows && held < 0.5 * all; ++row)
        held += squares[path.rows - 1 - row];
    free(squares);
    return 100.0 * (double)row / (double)path.rows;
}

/* ------------------------------------------------------------------ corotation */

static int by_power(const void *one, const void *other)
{
    const fst_paper_run *const *a = one, *const *b = other;
    return rising(&(*a)->result.mean_friction_power, &(*b)->result.mean_friction_power);
}

/* The locked runs, the one with the least friction first. */
static fst_run_list locked_runs(const fst_measuring *m)
{
    fst_run_list list = {.count = 0};
    for (int i = 0; i < m->paper->counts[FST_SCAN_SLOW] && list.count < FST_MOST_LISTED; ++i)
        if (run_of(m, FST_SCAN_SLOW)[i].result.regime == FST_REGIME_LOCKED)
            list.runs[list.count++] = &run_of(m, FST_SCAN_SLOW)[i];
    qsort(list.runs, (size_t)list.count, sizeof list.runs[0], by_power);
    return list;
}

/* Friction's power in that run over that at 10.7 Hz, in %. */
static double over_four(const fst_measuring *m, const fst_paper_run *run)
{
    return 100.0 * run->result.mean_friction_power / run_of(m, FST_SCAN_FOLD4)->result.mean_friction_power;
}

MEASURE(slow_friction)
{
    const fst_run_list list = locked_runs(m);
    int slipping = 0;
    if (list.count == 0)
        return NAN;
    for (int i = 0; i < list.count; ++i)
        slipping += list.runs[i]->result.rms_slip > 1e-6;
    NOTE("%d of %d locked runs, 1 to 12 Hz, lose more than rounding: on the magnet's axis the spin about n "
         "takes the value at which the contact is at rest",
         slipping, list.count);
    return over_four(m, list.runs[list.count / 2]);
}

MEASURE(most_slow_friction)
{
    const fst_run_list list = locked_runs(m);
    if (list.count == 0)
        return NAN;
    const fst_run_result *most = &list.runs[list.count - 1]->result;
    NOTE("locked at %.1f Hz, Φ = %+.1f deg, where the contact slips at %.3f ℓγ", most->frequency_hz,
         FST_DEGREES * atan2(most->final_state[FST_Y], most->final_state[FST_X]), most->rms_slip);
    return over_four(m, list.runs[list.count - 1]);
}

MEASURE(unlocking)
{
    const fst_paper_exact *exact = &m->paper->exact[m->dynamics];
    const double hertz = run_of(m, FST_SCAN_SLOW)->params.friction_gamma / (2.0 * FST_PI);
    if (exact->missing[0])
        NOTE("%s", exact->missing);
    else
        NOTE("the last locked state loses its stability at %.4f Hz; with γ greater by %.0f %% and the same "
             "field, bead and magnet at %.4f Hz, where the paper's balance has %.2f Hz",
             hertz * exact->locked_end, 100.0 * (FST_MORE_FRICTION - 1.0), hertz * exact->locked_end_rubbed,
             hertz * exact->locked_end / FST_MORE_FRICTION);
    return -log(exact->locked_end_rubbed / exact->locked_end) / log(FST_MORE_FRICTION);
}

MEASURE(locked_again)
{
    int others = 0, all = 0, undecided = 0;
    for (int i = 0; i < m->paper->counts[FST_SCAN_SLOW]; ++i) {
        const fst_run_result *result = &run_of(m, FST_SCAN_SLOW)[i].result;
        if (result->frequency_hz >= 7.0)
            continue;
        ++all;
        undecided += isnan(result->mean_alpha_dot) && result->regime == FST_REGIME_UNDECIDED;
        others += fst_outcome(result) != FST_OUTCOME_WITH;
    }
    NOTE("of %d runs from rest under 7 Hz; what they lie below is no chaos here (see chaos)", all);
    return others > 0 && others == undecided ? NAN : (double)others;
}

MEASURE(not_at_rest)
{
    int others = 0;
    double from = NAN, to = NAN;
    for (int i = 0; i < m->paper->counts[FST_SCAN_SLOW]; ++i) {
        const fst_run_result *result = &run_of(m, FST_SCAN_SLOW)[i].result;
        if (result->frequency_hz >= 7.0 || result->regime == FST_REGIME_LOCKED)
            continue;
        ++others;
        from = isnan(from) ? result->frequency_hz : from;
        to = result->frequency_hz;
    }
    if (others > 0)
        NOTE("they swing about the magnet, or roll on under it, from %.1f to %.1f Hz", from, to);
    return others;
}

/* ------------------------------------------------------------------ the shape of the path */

/* The amplitude of the part of x + iy that turns at `rate`, over `rows` samples. */
static double turning_part(const fst_path *p, size_t rows, double rate)
{
    double complex sum = 0.0;
    for (size_t i = 0; i < rows; ++i)
        sum += (p->x[i] + I * p->y[i]) * cexp(-I * rate * (p->t[i] - p->t[0]));
    return cabs(sum) / (double)rows;
}

/* In the laboratory the path is a sum of circular motions at alpha' + k (omega - alpha').  A trochoid has two
 * of them: the bead's own circling and the strongest of the others, which turn against it. */
typedef struct circles {
    double own, other; /* their radii */
    double rate;       /* of the other */
    double rest;       /* mean square of the path less that of its own circling */
    int k;             /* of the other */
} circles;

static circles circles_of(const fst_paper_run *run)
{
    const fst_path p = fst_path_of(run);
    const double circling = run->result.mean_alpha_dot, meeting = run->result.omega - circling;
    circles found = {NAN, NAN, NAN, NAN, 0};
    if (p.rows < 2)
        return found;
    /* The samples over whole meetings of bead and magnet, two at a time, which suits both S1 and S2. */
    double turn = 2.0 * FST_PI / meeting, last = turn * floor((p.t[p.rows - 1] - p.t[0]) / turn), all = 0.0;
    size_t rows = 0;
    for (; rows < p.rows && p.t[rows] - p.t[0] < last; ++rows)
        all += p.x[rows] * p.x[rows] + p.y[rows] * p.y[rows];
    found.own = turning_part(&p, rows, circling);
    found.other = 0.0;
    for (int k = 1; k <= 4; ++k) {
        double part = turning_part(&p, rows, circling + k * meeting);
        found.k = part > found.other ? k : found.k;
        found.other = fmax(found.other, part);
    }
    found.rate = circling + found.k * meeting;
    found.rest = all / (double)rows - found.own * found.own;
    return found;
}

MEASURE(trochoid)
{
    const circles few = circles_of(run_of(m, FST_SCAN_FOLD4));
    const circles many = circles_of(run_of(m, FST_SCAN_FOLD15));
    NOTE("at the drive 0.215 it turns at ⟨α′⟩ + k(ω − ⟨α′⟩), k = %d; at 0.4, k = %d, the share is %.2f", few.k,
         many.k, many.other * many.other / many.rest);
    return few.other * few.other / few.rest;
}

/* The smaller over the greater of the two circles' speeds. */
static double cusped(const fst_paper_run *run)
{
    const circles both = circles_of(run);
    const double own = both.own * fabs(run->result.mean_alpha_dot), other = both.other * both.rate;
    return fmin(own, other) / fmax(own, other);
}

MEASURE(cusps)
{
    NOTE("at the drive 0.215; at 0.4, where the festoons are many, %.2f", cusped(run_of(m, FST_SCAN_FOLD15)));
    return cusped(run_of(m, FST_SCAN_FOLD4));
}

/* The length of the path of one revolution, from whole meetings of bead and magnet, two at a time. */
static double revolution(const fst_paper_run *run)
{
    const fst_path p = fst_path_of(run);
    const double circling = run->result.mean_alpha_dot, meeting = run->result.omega - circling;
    double length = 0.0;
    if (p.rows < 2)
        return NAN;
    const double turn = 4.0 * FST_PI / meeting, last = turn * floor((p.t[p.rows - 1] - p.t[0]) / turn);
    for (size_t row = 1; row < p.rows && p.t[row] - p.t[0] <= last; ++row)
        length += hypot(p.x[row] - p.x[row - 1], p.y[row] - p.y[row - 1]);
    return length / last * 2.0 * FST_PI / fabs(circling);
}

MEASURE(shortcuts)
{
    const fst_paper_run *run = run_of(m, FST_SCAN_FOLD4);
    const double length = revolution(run), eps = eps_of(&run->params), r = run->result.mean_r;
    const double rolling = eps * run->result.omega * r / (r - eps), circling = fabs(run->result.mean_alpha_dot);
    NOTE("the path is %.2f of that circle. |⟨α′⟩| is %.2f times that of a bead rolling on it, since it moves "
         "%.2f times as fast",
         length / (2.0 * FST_PI * r), circling * r / rolling, circling * length / (2.0 * FST_PI) / rolling);
    return 100.0 * (1.0 - length / (2.0 * FST_PI * r));
}

NOTED(shortcuts_within, FOLD4, 100.0 * (1.0 - revolution(run) / (2.0 * FST_PI * at->max_r)), "r = %.3f",
      at->max_r);

/* ------------------------------------------------------------------ the symmetry S2 */

/* A column at the bead angle `at`, by a polynomial through six samples of it around `row`. */
static double at_angle(const double *bead_angle, const double *column, size_t row, double at)
{
    enum { POINTS = 6 };
    double sum = 0.0;
    for (size_t i = row - POINTS / 2; i < row + POINTS / 2; ++i) {
        double weight = 1.0;
        for (size_t j = row - POINTS / 2; j < row + POINTS / 2; ++j)
            weight *= j == i ? 1.0 : (at - bead_angle[j]) / (bead_angle[i] - bead_angle[j]);
        sum += weight * column[i];
    }
    return sum;
}

/* The root mean square of u(Phi + pi) + u(Phi) over that of u, for the columns of a vector. */
static double not_reversed(const fst_table *table, const char *const *names, int count)
{
    const double *bead_angle = fst_collected(table, "Phi");
    double off = 0.0, all = 0.0;
    size_t later = 0;
    for (size_t row = 0; row < table->rows; row += 7) {
        const double half = bead_angle[row] - FST_PI; /* Phi falls where the bead circles against the magnet */
        while (later < table->rows && bead_angle[later] > half)
            ++later;
        if (later < 3 || later + 3 > table->rows)
            continue;
        for (int i = 0; i < count; ++i) {
            const double *column = fst_collected(table, names[i]);
            const double sum = at_angle(bead_angle, column, later, half) + column[row];
            off += sum * sum;
            all += column[row] * column[row];
        }
    }
    return all > 0.0 ? sqrt(off / all) : NAN;
}

MEASURE(s2_in_the_frame)
{
    static const char *const place[] = {"X", "Y"}, *const moment[] = {"nX", "nY", "nZ"};
    const fst_table *table = &run_of(m, FST_SCAN_FOLD15)->trajectory;
    const double of_r = not_reversed(table, place, 2), of_n = not_reversed(table, moment, 3);
    NOTE("r is reversed to %.0e, n to %.2f: its upright part changes its sign, its part in the plane does not",
         of_r, of_n);
    return fmax(of_r, of_n);
}

MEASURE(s2_in_components)
{
    static const char *const place[] = {"X", "Y"}, *const moment[] = {"n_r", "n_alpha", "n_z"};
    const fst_table *table = &run_of(m, FST_SCAN_FOLD15)->trajectory;
    NOTE("e_r and e_α turn round with the bead, so that all three components change their signs");
    return fmax(not_reversed(table, place, 2), not_reversed(table, moment, 3));
}

/* ------------------------------------------------------------------ the assumptions of section VI */

MEASURE(theta)
{
    const fst_path path = fst_path_of(run_of(m, FST_SCAN_FOLD15));
    double sum = 0.0;
    for (size_t row = 0; row < path.rows; ++row)
        sum += path.n_r[row] * path.n_r[row];
    NOTE("Eq. (12) as printed lacks it: see the exact magnetic term");
    return sqrt(sum / (double)path.rows);
}

MEASURE(phase_lock)
{
    const fst_path path = fst_path_of(run_of(m, FST_SCAN_FOLD15));
    double complex sum = 0.0;
    for (size_t row = 0; row < path.rows; ++row)
        sum += cexp(I * (atan2(path.n_alpha[row], -path.n_z[row]) + path.Phi[row]));
    const double complex mean = sum / (double)path.rows;
    const double degrees = FST_DEGREES * carg(mean);
    NOTE("circular mean of φ + Φ at the drive 0.4, its scatter %.1f degrees",
         FST_DEGREES * sqrt(-2.0 * log(cabs(mean))));
    return degrees < 0.0 ? degrees + 360.0 : degrees;
}

/* ------------------------------------------------------------------ the period halving */

/* The exponent with which a quantity grows with the distance from the threshold. */
static double exponent(const fst_measuring *m, size_t offset, int first, int count)
{
    double x[FST_HALVING_POINTS], y[FST_HALVING_POINTS];
    for (int i = 0; i < count; ++i) {
        const fst_halving_point *point = &m->paper->halving[m->dynamics].points[first + i];
        x[i] = point->omega;
        y[i] = *(const double *)(const void *)((const char *)point + offset);
    }
    return fst_power_exponent(x, y, count, fst_paper_halving_drive(m->paper, m->dynamics));
}

MEASURE(halving_nz)
{
    NOTE("⟨n_z⟩² of settled runs vanishes at ω = %.5f on a straight line; the exponent is fitted with the "
         "threshold of the orbits",
         fst_paper_halving_line(m->paper, m->dynamics));
    return exponent(m, offsetof(fst_halving_point, mean_nz), 0, FST_HALVING_BELOW);
}

MEASURE(halving_p)
{
    const fst_halving_point *points = m->paper->halving[m->dynamics].points;
    enum { NEAREST = 4 };
    int first = 0;
    while (first + 1 < FST_HALVING_BELOW && isnan(points[first].order))
        ++first;
    NOTE("p falls from %.1f to %.2f over %d drives below the threshold, at which r swings twice a turn; over "
         "the nearest %d of them the exponent is %.2f. p is a ratio of swings: a term linear in ⟨n_z⟩ joins "
         "the square root at once",
         points[first].order, points[FST_HALVING_BELOW - 1].order, FST_HALVING_BELOW - first, NEAREST,
         exponent(m, offsetof(fst_halving_point, order), FST_HALVING_BELOW - NEAREST, NEAREST));
    return exponent(m, offsetof(fst_halving_point, order), 0, FST_HALVING_BELOW);
}

MEASURE(halving_relaxation)
{
    const fst_halving_point *points = m->paper->halving[m->dynamics].points;
    double below = exponent(m, offsetof(fst_halving_point, relaxation), 0, FST_HALVING_BELOW);
    double above = exponent(m, offsetof(fst_halving_point, relaxation), FST_HALVING_BELOW, FST_HALVING_ABOVE);
    NOTE("exponent %.2f under and %.2f over the threshold; up to %.0f/γ, %.1f s", below, above,
         points[FST_HALVING_BELOW].relaxation,
         points[FST_HALVING_BELOW].relaxation / run_of(m, FST_SCAN_FOLD15)->params.friction_gamma);
    return 0.5 * (below + above);
}
