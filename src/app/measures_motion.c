/* measures_motion.c - what the paper says about the motion, read off trajectories and probes. */
#include "app/measures.h"

#include "app/collect.h"

#include <complex.h>
#include <stdio.h>
#include <stdlib.h>

#define PI 3.14159265358979323846
#define DEGREES (180.0 / PI)
#define MEASURE(name)                                                                                          \
    double fst_measure_##name(const fst_paper_state *paper, fst_dynamics dynamics, char *note, size_t size)
#define NO_NOTE ((void)note, (void)size)

static const fst_run_result *single(const fst_paper_state *paper, fst_scan scan, fst_dynamics dynamics)
{
    return &fst_paper_single(paper, scan, dynamics)->result;
}

static double eps_of(const fst_paper_run *run)
{
    return run->params.bead_radius / run->params.magnet_half_length;
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

/* Pieces of the path between the first and the last turning point (greatest r), each with the time to the
 * nearest of them, its length and what friction took on it; free() it. */
static piece *cut_at_turning_points(const fst_table *table, size_t *count)
{
    const double *r = fst_collected(table, "r"), *t = fst_collected(table, "t");
    const double *x = fst_collected(table, "x"), *y = fst_collected(table, "y");
    const double *power = fst_collected(table, "friction_power");
    piece *pieces = malloc((table->rows + 1) * sizeof *pieces);
    *count = 0;
    size_t before = 0;
    for (size_t row = 1; pieces && row + 1 < table->rows; row++) {
        if (!(r[row] > r[row - 1] && r[row] >= r[row + 1]))
            continue;
        for (size_t i = before; before > 0 && i < row; i++)
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
    for (size_t i = 0; pieces && i < count; i++) {
        path += pieces[i].path;
        loss += pieces[i].loss;
    }
    if (pieces)
        qsort(pieces, count, sizeof *pieces, nearer);
    size_t i = 0;
    for (; pieces && i < count && near_path < 0.25 * path; i++) {
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
    for (size_t i = 0; i < table->rows; i++) {
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
    for (size_t row = 1; row + 1 < table->rows; row++) {
        if (!(r[row] > r[row - 1] && r[row] >= r[row + 1]))
            continue;
        sum += nz[row];
        corners++;
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

/* ------------------------------------------------------------------ phases */

static double complex mean_phase(const fst_paper_state *paper, fst_dynamics dynamics)
{
    const fst_table *table = &fst_paper_single(paper, FST_SCAN_FOLD15, dynamics)->trajectory;
    const double *a = fst_collected(table, "n_alpha"), *z = fst_collected(table, "n_z");
    const double *phi = fst_collected(table, "Phi");
    double complex sum = 0.0;
    for (size_t row = 0; row < table->rows; row++)
        sum += cexp(I * (atan2(a[row], -z[row]) + phi[row]));
    return sum / (double)table->rows;
}

MEASURE(phase_lock)
{
    double complex mean = mean_phase(paper, dynamics);
    (void)snprintf(note, size, "circular mean of φ + Φ at the drive 0.4, its scatter %.1f degrees",
                   DEGREES * sqrt(-2.0 * log(cabs(mean))));
    double degrees = DEGREES * carg(mean);
    return degrees < 0.0 ? degrees + 360.0 : degrees;
}

MEASURE(frequency_lock)
{
    NO_NOTE;
    const fst_run_result *result = single(paper, FST_SCAN_FOLD15, dynamics);
    return (result->mean_phi_dot + result->mean_alpha_dot) / result->omega;
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
    (void)snprintf(note, size, "as printed %+.2e, exact %+.2e; the exact terms sum to %.0e",
                   result->eq21_magnetic_printed, result->eq21_magnetic,
                   fabs(result->eq21_centrifugal + result->eq21_magnetic + result->eq21_friction));
    return 100.0 * fabs(result->eq21_magnetic_printed / result->eq21_magnetic - 1.0);
}

/* ------------------------------------------------------------------ far beyond */

MEASURE(asymptotic_rolling)
{
    double worst = 0.0, where = 0.0, radius = 0.0;
    for (int i = 0; i < paper->counts[FST_SCAN_ASYMPTOTIC]; i++) {
        const fst_paper_run *run = &paper->scans[FST_SCAN_ASYMPTOTIC][dynamics][i];
        double eps = eps_of(run), rolling = -eps * run->result.omega / (run->result.mean_r - eps);
        double deviation = 100.0 * fabs(run->result.mean_alpha_dot / rolling - 1.0);
        if (!fst_paper_counter_rotates(run) || deviation < worst)
            continue;
        worst = deviation;
        where = run->result.frequency_hz;
        radius = run->result.mean_r;
    }
    double gamma = fst_paper_single(paper, FST_SCAN_ASYMPTOTIC, dynamics)->params.friction_gamma;
    double fold = paper->exact[dynamics].fold;
    (void)snprintf(
        note, size,
        "deviation of ⟨α′⟩ at %.0f Hz, where ⟨r⟩ = %.2f; there is no limit ω to infinity: the bead circles "
        "ever further out, and at ω = %.4f (%.0f Hz) the orbit ends in a fold, beyond which the magnet "
        "no longer holds it",
        where, radius, fold, fold * gamma / (2.0 * PI));
    return worst > 0.0 ? worst : NAN;
}

MEASURE(asymptotic_frequency)
{
    double crossing = NAN;
    for (int i = 0; i < paper->counts[FST_SCAN_FAST]; i++) {
        const fst_run_result *result = &paper->scans[FST_SCAN_FAST][dynamics][i].result;
        if (!isfinite(crossing) && fabs(result->eq21_friction) < 0.1 * fabs(result->eq21_magnetic))
            crossing = result->frequency_hz;
    }
    (void)snprintf(note, size,
                   "first drive of the fast scan at which friction is under a tenth of the magnetic term");
    return crossing;
}

/* ------------------------------------------------------------------ the period halving */

/* The exponent with which a quantity goes with the distance from the threshold. */
static double exponent(const fst_paper_state *paper, fst_dynamics dynamics, size_t offset, int first, int count)
{
    double x[FST_HALVING_POINTS], y[FST_HALVING_POINTS];
    for (int i = 0; i < count; i++) {
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
