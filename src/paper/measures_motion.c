/* measures_motion.c - what the paper says about the motion, read off trajectories and probes. */
#include "base/constants.h"
#include "paper/measures_parts.h"

#include <complex.h>
#include <stdlib.h>

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
 * the nearest turning point, its length, and the energy that friction took on it; free() it. */
static piece *cut_at_turning_points(const fst_table *table, size_t *count)
{
    const double *r = fst_collected(table, "r"), *t = fst_collected(table, "t");
    const double *x = fst_collected(table, "x"), *y = fst_collected(table, "y");
    const double *power = fst_collected(table, "friction_power");
    piece *pieces = malloc((table->rows + 1) * sizeof *pieces);
    *count = 0;
    size_t before = 0;
    for (size_t row = 1; pieces && row + 1 < table->rows; ++row) {
        if (!(r[row] > r[row - 1] && r[row] >= r[row + 1]))
            continue;
        for (size_t i = before; before > 0 && i < row; ++i)
            pieces[(*count)++] = (piece){fmin(t[i] - t[before], t[row] - t[i]),
                                         hypot(x[i + 1] - x[i], y[i + 1] - y[i]), power[i] * (t[i + 1] - t[i])};
        before = row;
    }
    return pieces;
}

static int lossier(const void *one, const void *other)
{
    double a = ((const piece *)one)->loss, b = ((const piece *)other)->loss;
    return (a < b) - (a > b);
}

/* Shares of the path and of the loss; the pieces last equally long. */
typedef struct shares {
    double path, loss, path_quarter, path_quarter_time;
} shares;

/* What the quarter of the time next to the turning points has, and the quarter of the path. */
static shares next_to_turning_points(piece *pieces, size_t count)
{
    double path = 0.0, loss = 0.0, near_path = 0.0, near_loss = 0.0;
    shares found = {NAN, NAN, NAN, NAN};
    qsort(pieces, count, sizeof *pieces, nearer);
    for (size_t i = 0; i < count; ++i) {
        path += pieces[i].path;
        loss += pieces[i].loss;
    }
    for (size_t i = 0; i < count; ++i) {
        if (4 * i < count)
            found.path = (near_path + pieces[i].path) / path;
        if (4 * i < count)
            found.loss = (near_loss + pieces[i].loss) / loss;
        if (near_path < 0.25 * path) {
            found.path_quarter = (near_loss + pieces[i].loss) / loss;
            found.path_quarter_time = (double)(i + 1) / (double)count;
        }
        near_path += pieces[i].path;
        near_loss += pieces[i].loss;
    }
    return found;
}

MEASURE(turning_times)
{
    size_t count;
    piece *pieces =
        cut_at_turning_points(&fst_paper_single(paper, FST_SCAN_FOLD4, dynamics)->trajectory, &count);
    if (!pieces || count == 0) {
        free(pieces);
        return NAN;
    }
    const shares near = next_to_turning_points(pieces, count);
    free(pieces);
    (void)snprintf(note, size,
                   "next to the points of greatest r, where %.0f %% of the path are; the quarter of the path "
                   "next to them, in "
                   "which the bead spends %.0f %% of the time, has %.0f %% of the loss",
                   100.0 * near.path, 100.0 * near.path_quarter_time, 100.0 * near.path_quarter);
    return 100.0 * near.loss;
}

MEASURE(turning_points)
{
    size_t count;
    piece *pieces =
        cut_at_turning_points(&fst_paper_single(paper, FST_SCAN_FOLD4, dynamics)->trajectory, &count);
    double all = 0.0, lossiest = 0.0, both = 0.0;
    if (!pieces || count == 0) {
        free(pieces);
        return NAN;
    }
    qsort(pieces, count, sizeof *pieces, nearer);
    const double half = pieces[count / 2].distance;
    qsort(pieces, count, sizeof *pieces, lossier);
    for (size_t i = 0; i < count; ++i) {
        const double in_quarter = 4 * i < count ? pieces[i].loss : 0.0;
        all += pieces[i].loss;
        lossiest += in_quarter;
        both += pieces[i].distance < half ? in_quarter : 0.0;
    }
    free(pieces);
    (void)snprintf(note, size,
                   "the quarter of the time with the greatest loss has %.0f %% of it; on the turning points "
                   "themselves friction "
                   "is weak, it peaks just before and after",
                   100.0 * lossiest / all);
    return 100.0 * both / all;
}

MEASURE(friction_follows_angle)
{
    NO_NOTE;
    const fst_table *table = &fst_paper_single(paper, FST_SCAN_FOLD4, dynamics)->trajectory;
    const double *a = fst_collected(table, "angle"), *v = fst_collected(table, "slip");
    double n = (double)table->rows, sa = 0, sv = 0, saa = 0, svv = 0, sav = 0;
    for (size_t i = 0; i < table->rows; ++i) {
        sa += a[i];
        sv += v[i];
        saa += a[i] * a[i];
        svv += v[i] * v[i];
        sav += a[i] * v[i];
    }
    double together = n * sav - sa * sv;
    return together * together / ((n * saa - sa * sa) * (n * svv - sv * sv));
}

MEASURE(corner_nz)
{
    const fst_table *table = &fst_paper_single(paper, FST_SCAN_FOLD4, dynamics)->trajectory;
    const double *r = fst_collected(table, "r"), *nz = fst_collected(table, "n_z");
    double sum = 0.0;
    int corners = 0;
    for (size_t row = 1; row + 1 < table->rows; ++row) {
        if (!(r[row] > r[row - 1] && r[row] >= r[row + 1]))
            continue;
        sum += nz[row];
        ++corners;
    }
    (void)snprintf(note, size,
                   "mean of n_z at the %d points of greatest r; the conjugate motion has it negative", corners);
    return corners > 0 ? fabs(sum / corners) : NAN;
}

MEASURE(conjugate)
{
    const fst_run_result *one = single(paper, FST_SCAN_FOLD4, dynamics);
    const fst_run_result *other = single(paper, FST_SCAN_CONJUGATE, dynamics);
    (void)snprintf(note, size, "⟨n_z⟩ = %+.6f and %+.6f, ⟨r⟩ = %.6f and %.6f", one->mean_nz, other->mean_nz,
                   one->mean_r, other->mean_r);
    return other->mean_nz / one->mean_nz;
}

MEASURE(fluctuation)
{
    const fst_run_result *few = single(paper, FST_SCAN_FOLD4, dynamics);
    const fst_run_result *many = single(paper, FST_SCAN_FOLD15, dynamics);
    (void)snprintf(note, size, "δr = %.4f and %.4f", few->std_r, many->std_r);
    return 100.0 * (1.0 - many->std_r / few->std_r);
}

MEASURE(circling_estimate)
{
    const fst_paper_run *run = fst_paper_single(paper, FST_SCAN_FOLD15, dynamics);
    (void)snprintf(note, size, "|⟨α′⟩| at the drive 0.4 over ωR/⟨r⟩; with R/(⟨r⟩ − R), exact rolling, %.3f",
                   fabs(run->result.mean_alpha_dot) * (run->result.mean_r - eps_of(run)) /
                       (eps_of(run) * run->result.omega));
    return fabs(run->result.mean_alpha_dot) * run->result.mean_r / (eps_of(run) * run->result.omega);
}

MEASURE(strict_corotation)
{
    NO_NOTE;
    const fst_run_result *slow = &paper->scans[FST_SCAN_SLOW][dynamics][0].result;
    return slow->mean_alpha_dot / slow->omega;
}

/* ------------------------------------------------------------------ the shape of the path */

/* The amplitude of the part of x + iy that turns at `rate`, over `rows` samples. */
static double turning_part(const double *x, const double *y, const double *t, size_t rows, double rate)
{
    double complex sum = 0.0;
    for (size_t i = 0; i < rows; ++i)
        sum += (x[i] + I * y[i]) * cexp(-I * rate * (t[i] - t[0]));
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
    const fst_table *table = &run->trajectory;
    const double *x = fst_collected(table, "x"), *y = fst_collected(table, "y"), *t = fst_collected(table, "t");
    const double circling = run->result.mean_alpha_dot, meeting = run->result.omega - circling;
    circles found = {NAN, NAN, NAN, NAN, 0};
    if (table->rows < 2)
        return found;
    /* The samples over whole meetings of bead and magnet, two at a time, which suits both S1 and S2. */
    double turn = 2.0 * FST_PI / meeting, last = turn * floor((t[table->rows - 1] - t[0]) / turn), all = 0.0;
    size_t rows = 0;
    for (; rows < table->rows && t[rows] - t[0] < last; ++rows)
        all += x[rows] * x[rows] + y[rows] * y[rows];
    found.own = turning_part(x, y, t, rows, circling);
    found.other = 0.0;
    for (int k = 1; k <= 4; ++k) {
        double part = turning_part(x, y, t, rows, circling + k * meeting);
        found.k = part > found.other ? k : found.k;
        found.other = fmax(found.other, part);
    }
    found.rate = circling + found.k * meeting;
    found.rest = all / (double)rows - found.own * found.own;
    return found;
}

MEASURE(trochoid)
{
    const circles few = circles_of(fst_paper_single(paper, FST_SCAN_FOLD4, dynamics));
    const circles many = circles_of(fst_paper_single(paper, FST_SCAN_FOLD15, dynamics));
    (void)snprintf(
        note, size,
        "at the drive 0.215 it turns at ⟨α′⟩ + k(ω − ⟨α′⟩), k = %d; at 0.4, k = %d, the share is %.2f", few.k,
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
    (void)snprintf(note, size, "at the drive 0.215; at 0.4, where the festoons are many, %.2f",
                   cusped(fst_paper_single(paper, FST_SCAN_FOLD15, dynamics)));
    return cusped(fst_paper_single(paper, FST_SCAN_FOLD4, dynamics));
}

MEASURE(rare_moments)
{
    NO_NOTE;
    const fst_paper_run *run = fst_paper_single(paper, FST_SCAN_FOLD4, dynamics);
    const double *angle = fst_collected(&run->trajectory, "angle");
    size_t high = 0;
    for (size_t i = 0; i < run->trajectory.rows; ++i)
        high += angle[i] > 0.5 * run->result.max_angle_deg;
    return 100.0 * (double)high / (double)run->trajectory.rows;
}

/* ------------------------------------------------------------------ phases */

static double complex mean_phase(const fst_paper_state *paper, fst_dynamics dynamics)
{
    const fst_table *table = &fst_paper_single(paper, FST_SCAN_FOLD15, dynamics)->trajectory;
    const double *a = fst_collected(table, "n_alpha"), *z = fst_collected(table, "n_z");
    const double *bead_angle = fst_collected(table, "Phi");
    double complex sum = 0.0;
    for (size_t row = 0; row < table->rows; ++row)
        sum += cexp(I * (atan2(a[row], -z[row]) + bead_angle[row]));
    return sum / (double)table->rows;
}

MEASURE(phase_lock)
{
    double complex mean = mean_phase(paper, dynamics);
    (void)snprintf(note, size, "circular mean of φ + Φ at the drive 0.4, its scatter %.1f degrees",
                   FST_DEGREES * sqrt(-2.0 * log(cabs(mean))));
    double degrees = FST_DEGREES * carg(mean);
    return degrees < 0.0 ? degrees + 360.0 : degrees;
}

MEASURE(frequency_lock)
{
    NO_NOTE;
    const fst_run_result *result = single(paper, FST_SCAN_FOLD15, dynamics);
    return (result->mean_phi_dot + result->mean_alpha_dot) / result->omega;
}

MEASURE(turning_rate)
{
    NO_NOTE;
    const fst_run_result *result = single(paper, FST_SCAN_FOLD15, dynamics);
    return result->mean_phi_dot / result->omega;
}

MEASURE(slip_formula)
{
    const fst_paper_run *run = fst_paper_single(paper, FST_SCAN_FOLD15, dynamics);
    const fst_run_result *result = &run->result;
    double rolling = result->mean_r * result->mean_alpha_dot, turning = eps_of(run) * result->mean_phi_dot;
    (void)snprintf(note, size, "⟨V_α⟩ = %+.2e, ⟨r⟩⟨α′⟩ + ε⟨φ′⟩ = %+.2e; their difference over ⟨r⟩|⟨α′⟩|",
                   result->mean_v_alpha, rolling + turning);
    return 100.0 * fabs((result->mean_v_alpha - rolling - turning) / rolling);
}

MEASURE(third_balance)
{
    const fst_run_result *result = single(paper, FST_SCAN_FOLD15, dynamics);
    if (!is_viscous(fst_paper_single(paper, FST_SCAN_FOLD15, dynamics), note, size))
        return NAN;
    (void)snprintf(note, size, "magnetic %+.2e, ⟨V_α⟩ = %+.2e", result->eq23_magnetic, result->mean_v_alpha);
    return 100.0 * fabs(result->eq23_magnetic / result->mean_v_alpha - 1.0);
}

MEASURE(rolling_on_average)
{
    const fst_run_result *result = single(paper, FST_SCAN_FOLD15, dynamics);
    const fst_run_result *fast = single(paper, FST_SCAN_ASYMPTOTIC, dynamics);
    (void)snprintf(note, size, "|⟨V_α⟩|/(⟨r⟩|⟨α′⟩|) at the drive 0.4; %.2g %% at the drive %g",
                   100.0 * fabs(fast->mean_v_alpha / (fast->mean_r * fast->mean_alpha_dot)), fast->omega);
    return 100.0 * fabs(result->mean_v_alpha / (result->mean_r * result->mean_alpha_dot));
}

MEASURE(spin_share)
{
    const fst_run_result *result = single(paper, FST_SCAN_FOLD15, dynamics);
    (void)snprintf(note, size, "ε⟨ψ′ sin θ sin φ⟩ = %+.2e, −⟨V_r⟩ = %+.2e at the drive 0.4", result->eq21_spin,
                   result->eq21_friction);
    return 100.0 * fabs(result->eq21_spin / result->eq21_friction);
}

MEASURE(dropped_part)
{
    const fst_run_result *result = single(paper, FST_SCAN_FOLD15, dynamics);
    if (!is_viscous(fst_paper_single(paper, FST_SCAN_FOLD15, dynamics), note, size))
        return NAN;
    (void)snprintf(note, size, "as printed %+.2e, exact %+.2e; the exact terms sum to %.0e",
                   result->eq21_magnetic_printed, result->eq21_magnetic,
                   fabs(result->eq21_centrifugal + result->eq21_magnetic + result->eq21_friction));
    return 100.0 * fabs(result->eq21_magnetic_printed / result->eq21_magnetic - 1.0);
}

/* ------------------------------------------------------------------ far beyond */

/* The deviation of <alpha'> from free rolling, in %; NAN where the bead does not counter-rotate. */
static double off_rolling(const fst_paper_run *run)
{
    double rolling = -eps_of(run) * run->result.omega / (run->result.mean_r - eps_of(run));
    return fst_paper_counter_rotates(run) ? 100.0 * fabs(run->result.mean_alpha_dot / rolling - 1.0) : NAN;
}

MEASURE(asymptotic_rolling)
{
    const fst_paper_run *runs = paper->scans[FST_SCAN_ASYMPTOTIC][dynamics];
    const fst_paper_run *last = &runs[paper->counts[FST_SCAN_ASYMPTOTIC] - 1];
    double fold = paper->exact[dynamics].fold;
    (void)snprintf(
        note, size,
        "deviation of ⟨α′⟩ at the drive %g%s; at %g it is %.1f %%, with ⟨r⟩ = %.2f. There is no limit: "
        "the bead circles ever further out, and at ω = %.4f (%.0f Hz) its orbit ends in a fold",
        last->result.omega, fst_paper_counter_rotates(last) ? "" : ", where no such motion exists",
        runs[0].result.omega, off_rolling(&runs[0]), runs[0].result.mean_r, fold,
        fold * last->params.friction_gamma / (2.0 * FST_PI));
    return off_rolling(last);
}

/* The share of friction in the radial balance; infinite where the bead does not counter-rotate. */
static double friction_part(const fst_paper_run *run)
{
    return fst_paper_counter_rotates(run) ? fabs(run->result.eq21_friction / run->result.eq21_magnetic)
                                          : INFINITY;
}

/* The lowest drive from which friction stays under a tenth of the magnetic term, and the first at which it is.
 */
typedef struct negligible {
    double from, first;
} negligible;

static negligible friction_negligible(const fst_paper_state *paper, fst_dynamics dynamics)
{
    static const fst_scan beyond[2] = {FST_SCAN_ASYMPTOTIC, FST_SCAN_FAST};
    negligible found = {NAN, NAN};
    int still = 1; /* whether friction is negligible from this drive upwards */
    for (int s = 0; s < 2; ++s) {
        for (int i = paper->counts[beyond[s]] - 1; i >= 0; --i) {
            const fst_paper_run *run = &paper->scans[beyond[s]][dynamics][i];
            const int small = friction_part(run) < 0.1;
            still = still && small;
            found.from = still ? run->result.frequency_hz : found.from;
            found.first = small ? run->result.frequency_hz : found.first;
        }
    }
    return found;
}

MEASURE(asymptotic_frequency)
{
    if (!is_viscous(fst_paper_single(paper, FST_SCAN_ASYMPTOTIC, dynamics), note, size))
        return NAN;
    (void)snprintf(note, size, "up to 149 Hz there is no such drive, or the motion has ended before");
    const double from = friction_negligible(paper, dynamics).from;
    if (isfinite(from))
        (void)snprintf(note, size, "looked for up to 149 Hz");
    return from;
}

MEASURE(asymptotic_first)
{
    if (!is_viscous(fst_paper_single(paper, FST_SCAN_ASYMPTOTIC, dynamics), note, size))
        return NAN;
    (void)snprintf(note, size, "friction's part is on its way through zero there, and grows again beyond");
    return friction_negligible(paper, dynamics).first;
}

MEASURE(rolling_below)
{
    double greatest = NAN, where = NAN;
    for (int i = 0; i < paper->counts[FST_SCAN_COMPARISON]; ++i) {
        const fst_paper_run *run = &paper->scans[FST_SCAN_COMPARISON][dynamics][i];
        double off = off_rolling(run);
        if (run->result.omega < 0.2 || run->result.omega > 0.41 || !(off > greatest || isnan(greatest)))
            continue;
        greatest = off;
        where = run->result.omega;
    }
    (void)snprintf(note, size, "greatest deviation of ⟨α′⟩ for drives from 0.2 to 0.41, found at %.3g", where);
    return greatest;
}

/* ------------------------------------------------------------------ the period halving */

/* The exponent with which a quantity grows with the distance from the threshold. */
static double exponent(const fst_paper_state *paper, fst_dynamics dynamics, size_t offset, int first, int count)
{
    double x[FST_HALVING_POINTS], y[FST_HALVING_POINTS];
    for (int i = 0; i < count; ++i) {
        const fst_halving_point *point = &paper->halving[dynamics].points[first + i];
        x[i] = point->omega;
        y[i] = *(const double *)(const void *)((const char *)point + offset);
    }
    return fst_power_exponent(x, y, count, fst_paper_halving_drive(paper, dynamics));
}

MEASURE(halving_nz)
{
    (void)snprintf(
        note, size,
        "⟨n_z⟩² of settled runs vanishes at ω = %.5f on a straight line; the exponent is fitted with the "
        "threshold of the orbits",
        fst_paper_halving_line(paper, dynamics));
    return exponent(paper, dynamics, offsetof(fst_halving_point, mean_nz), 0, FST_HALVING_BELOW);
}

MEASURE(halving_p)
{
    const fst_halving_point *points = paper->halving[dynamics].points;
    enum { NEAREST = 4 };
    int first = 0;
    while (first + 1 < FST_HALVING_BELOW && isnan(points[first].order))
        ++first;
    (void)snprintf(
        note, size,
        "p falls from %.1f to %.2f over %d drives below the threshold, at which r swings twice a turn; over "
        "the "
        "nearest %d of them the exponent is %.2f. p is a ratio of swings: a term linear in ⟨n_z⟩ joins the "
        "square root at once",
        points[first].order, points[FST_HALVING_BELOW - 1].order, FST_HALVING_BELOW - first, NEAREST,
        exponent(paper, dynamics, offsetof(fst_halving_point, order), FST_HALVING_BELOW - NEAREST, NEAREST));
    return exponent(paper, dynamics, offsetof(fst_halving_point, order), 0, FST_HALVING_BELOW);
}

MEASURE(halving_relaxation)
{
    const fst_halving_point *points = paper->halving[dynamics].points;
    double below = exponent(paper, dynamics, offsetof(fst_halving_point, relaxation), 0, FST_HALVING_BELOW);
    double above = exponent(paper, dynamics, offsetof(fst_halving_point, relaxation), FST_HALVING_BELOW,
                            FST_HALVING_ABOVE);
    (void)snprintf(note, size, "exponent %.2f under and %.2f over the threshold; up to %.0f/γ, %.1f s", below,
                   above, points[FST_HALVING_BELOW].relaxation,
                   points[FST_HALVING_BELOW].relaxation /
                       fst_paper_single(paper, FST_SCAN_FOLD15, dynamics)->params.friction_gamma);
    return 0.5 * (below + above);
}
