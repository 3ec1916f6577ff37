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

MEASURE(turning_points)
{
    size_t count;
    piece *pieces =
        cut_at_turning_points(&fst_paper_single(paper, FST_SCAN_FOLD4, dynamics)->trajectory, &count);
    double path = 0.0, loss = 0.0, near_path = 0.0, near_loss = 0.0, near_time = 0.0;
    for (size_t i = 0; pieces && i < count; ++i) {
        path += pieces[i].path;
        loss += pieces[i].loss;
    }
    if (pieces)
        qsort(pieces, count, sizeof *pieces, nearer);
    size_t i = 0;
    for (; pieces && i < count && near_path < 0.25 * path; ++i) {
        near_path += pieces[i].path;
        near_loss += pieces[i].loss;
        near_time = (double)(i + 1) / (double)count;
    }
    free(pieces);
    (void)snprintf(
        note, size,
        "in the quarter of the path next to the points of greatest r, where the bead lingers for %.0f %% of "
        "the time; on the points themselves friction is weak, it peaks just before and after",
        100.0 * near_time);
    return loss > 0.0 ? 100.0 * near_loss / loss : NAN;
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

/* In the laboratory the path is a sum of circular motions at alpha' + k (omega - alpha').  A hypotrochoid has
 * two of them.  This is the share of the strongest one that turns against the bead, among all except the bead's
 * own circling. */
static double trochoid_share(const fst_paper_run *run, int *best)
{
    const fst_table *table = &run->trajectory;
    const double *x = fst_collected(table, "x"), *y = fst_collected(table, "y"), *t = fst_collected(table, "t");
    double circling = run->result.mean_alpha_dot, meeting = run->result.omega - circling, all = 0.0, most = 0.0;
    if (table->rows < 2)
        return NAN;
    /* The samples over whole meetings of bead and magnet, two at a time, which suits both S1 and S2. */
    double turn = 2.0 * FST_PI / meeting, last = turn * floor((t[table->rows - 1] - t[0]) / turn);
    size_t rows = 0;
    for (; rows < table->rows && t[rows] - t[0] < last; ++rows)
        all += x[rows] * x[rows] + y[rows] * y[rows];
    double own = turning_part(x, y, t, rows, circling);
    for (int k = 1; k <= 4; ++k) {
        double part = turning_part(x, y, t, rows, circling + k * meeting);
        *best = part > most ? k : *best;
        most = fmax(most, part);
    }
    return most * most / (all / (double)rows - own * own);
}

MEASURE(trochoid)
{
    int few = 0, many = 0;
    double share = trochoid_share(fst_paper_single(paper, FST_SCAN_FOLD4, dynamics), &few);
    double other = trochoid_share(fst_paper_single(paper, FST_SCAN_FOLD15, dynamics), &many);
    (void)snprintf(
        note, size,
        "share of one circular motion against the bead's in what the path adds to its circling, drive "
        "0.215; it turns at ⟨α′⟩ + k(ω − ⟨α′⟩), k = %d. At 0.4, k = %d, %.2f",
        few, many, other);
    return share;
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

MEASURE(asymptotic_frequency)
{
    static const fst_scan beyond[2] = {FST_SCAN_ASYMPTOTIC, FST_SCAN_FAST};
    if (!is_viscous(fst_paper_single(paper, FST_SCAN_ASYMPTOTIC, dynamics), note, size))
        return NAN;
    double from = NAN, first = NAN;
    int negligible = 1; /* whether friction is negligible from this drive upwards */
    for (int s = 0; s < 2; ++s) {
        for (int i = paper->counts[beyond[s]] - 1; i >= 0; --i) {
            const fst_paper_run *run = &paper->scans[beyond[s]][dynamics][i];
            int small = friction_part(run) < 0.1;
            negligible = negligible && small;
            from = negligible ? run->result.frequency_hz : from;
            first = small ? run->result.frequency_hz : first;
        }
    }
    (void)snprintf(note, size,
                   "lowest drive from which friction stays under a tenth of the magnetic term, up to 149 Hz; "
                   "first under a tenth, on its way through zero, at %.0f Hz",
                   first);
    return from;
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
    const fst_halving_point *points = paper->halving[dynamics].points;
    (void)snprintf(
        note, size,
        "⟨n_z⟩² of settled runs vanishes at ω = %.5f on a straight line, the exponent is fitted with the "
        "threshold of the orbits; p falls from %.1f to %.2f on the way: it is a ratio, in which a term "
        "linear in n_z joins the square root at once",
        fst_paper_halving_line(paper, dynamics), points[0].order, points[FST_HALVING_BELOW - 1].order);
    return exponent(paper, dynamics, offsetof(fst_halving_point, mean_nz), 0, FST_HALVING_BELOW);
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
