/* measures.c - numbers of the paper measured on the runs: the field's maxima, the two patterns, r against Phi,
 * curves over the drive, balances. */
#include "base/constants.h"
#include "paper/measures_parts.h"

#include <complex.h>

/* ------------------------------------------------------------------ the field */

/* Where |B| is greatest on the magnet's axis: d(B^2)/dX = 2 B.(dB/dX) changes its sign there. */
static double maximum_on_axis(const fst_params *params)
{
    fst_model *model = NULL;
    if (fst_model_new(params, &model, NULL) != FST_OK)
        return NAN;
    double rising = 0.3, falling = 2.0;
    for (int i = 0; i < 60; ++i) {
        double b[3], gradient[3][3], middle = 0.5 * (rising + falling);
        fst_field(model, middle, 0.0, b, gradient);
        double slope = b[0] * gradient[0][0] + b[1] * gradient[1][0] + b[2] * gradient[2][0];
        *(slope > 0.0 ? &rising : &falling) = middle;
    }
    fst_model_free(model);
    return rising;
}

MEASURE(field_maximum)
{
    (void)snprintf(note, size, "on the magnet's axis");
    return maximum_on_axis(&fst_paper_single(paper, FST_SCAN_FOLD15, dynamics)->params);
}

MEASURE(maxima_distance)
{
    fst_params params = fst_paper_single(paper, FST_SCAN_FOLD15, dynamics)->params;
    double unit = 2e3 * params.magnet_half_length;
    double at_centre = unit * maximum_on_axis(&params);
    params.model_h = params.magnet_depth / params.magnet_half_length;
    (void)snprintf(note, size, "at the height of the bead's centre; on the plate's surface %.1f mm",
                   unit * maximum_on_axis(&params));
    return at_centre;
}

/* The length of the lines for which the maxima are 41 mm apart at the bead's height, with all other lengths as
 * they are in millimetres. */
MEASURE(fitted_length)
{
    fst_params params = fst_paper_single(paper, FST_SCAN_FOLD15, dynamics)->params;
    double low = 15e-3, high = 30e-3, at_length[2];
    for (int at_plate = 0; at_plate < 2; ++at_plate) {
        double below = low, above = high;
        for (int i = 0; i < 40; ++i) {
            double height = params.magnet_depth + (at_plate ? 0.0 : params.bead_radius);
            params.magnet_half_length = 0.5 * (below + above);
            params.model_h = height / params.magnet_half_length;
            double apart = 2.0 * params.magnet_half_length * maximum_on_axis(&params);
            *(apart < 41e-3 ? &below : &above) = params.magnet_half_length;
        }
        at_length[at_plate] = 1e3 * below;
    }
    (void)snprintf(note, size, "for maxima at that height; on the plate's surface %.2f mm", at_length[1]);
    return at_length[0];
}

/* ------------------------------------------------------------------ the two patterns */

MEASURE(fold4_festoons)
{
    const fst_run_result *result = single(paper, FST_SCAN_FOLD4, dynamics);
    (void)snprintf(note, size, "no whole number: the pattern drifts by %.0f degrees a revolution",
                   360.0 * fabs(result->festoons - round(result->festoons)) / result->festoons);
    return result->festoons;
}

MEASURE(fold4_angle)
{
    NO_NOTE;
    return single(paper, FST_SCAN_FOLD4, dynamics)->max_angle_deg;
}

MEASURE(fold4_nz)
{
    double mean = single(paper, FST_SCAN_FOLD4, dynamics)->mean_nz;
    (void)snprintf(note, size, "the conjugate motion, with all poles exchanged, has %+.3f", -mean);
    return fabs(mean);
}

MEASURE(fold4_field)
{
    const fst_run_result *result = single(paper, FST_SCAN_FOLD4, dynamics);
    double under = 100.0 * (1.0 - result->min_b / result->mean_b),
           over = 100.0 * (result->max_b / result->mean_b - 1.0);
    (void)snprintf(
        note, size,
        "the extremes lie %.0f %% under and %.0f %% over the mean; the standard deviation is %.1f %%", under,
        over, 100.0 * result->std_b / result->mean_b);
    return fmax(under, over);
}

MEASURE(fold15_festoons)
{
    const fst_table *table = &fst_paper_single(paper, FST_SCAN_FOLD15, dynamics)->trajectory;
    const double *r = fst_collected(table, "r"), *alpha = fst_collected(table, "alpha");
    double first = NAN, last = NAN;
    int count = -1;
    for (size_t row = 1; row + 1 < table->rows; ++row) {
        if (!(r[row] > r[row - 1] && r[row] >= r[row + 1]))
            continue;
        first = count < 0 ? alpha[row] : first;
        last = alpha[row];
        ++count;
    }
    (void)snprintf(note, size, "a(1 + ω/|⟨α′⟩|); counted on the path: %.3f turning points a revolution",
                   2.0 * FST_PI * count / fabs(last - first));
    return single(paper, FST_SCAN_FOLD15, dynamics)->festoons;
}

MEASURE(fold15_angle)
{
    NO_NOTE;
    return single(paper, FST_SCAN_FOLD15, dynamics)->max_angle_deg;
}

MEASURE(fold15_tilt)
{
    NO_NOTE;
    return single(paper, FST_SCAN_FOLD15, dynamics)->tilt_deg;
}

MEASURE(fold15_symmetry)
{
    const fst_run_result *result = single(paper, FST_SCAN_FOLD15, dynamics);
    (void)snprintf(note, size, "%s", result->reason);
    return result->symmetry == FST_SYMMETRY_NONE ? NAN : result->symmetry == FST_SYMMETRY_S1 ? 1.0 : 2.0;
}

/* Eigenvalues of a symmetric 3 x 3 matrix, least first (the trigonometric solution of the cubic). */
static void eigenvalues(double a[3][3], double values[3])
{
    double mean = (a[0][0] + a[1][1] + a[2][2]) / 3.0;
    double off = a[0][1] * a[0][1] + a[0][2] * a[0][2] + a[1][2] * a[1][2], spread = 2.0 * off;
    for (int i = 0; i < 3; ++i)
        spread += (a[i][i] - mean) * (a[i][i] - mean);
    double p = sqrt(spread / 6.0);
    if (!(p > 0.0)) {
        values[0] = values[1] = values[2] = mean;
        return;
    }
    double b[3][3];
    for (int i = 0; i < 3; ++i)
        for (int j = 0; j < 3; ++j)
            b[i][j] = (a[i][j] - (i == j ? mean : 0.0)) / p;
    double half = 0.5 * (b[0][0] * (b[1][1] * b[2][2] - b[1][2] * b[2][1]) -
                         b[0][1] * (b[1][0] * b[2][2] - b[1][2] * b[2][0]) +
                         b[0][2] * (b[1][0] * b[2][1] - b[1][1] * b[2][0]));
    double angle = acos(fmax(-1.0, fmin(1.0, half))) / 3.0;
    values[2] = mean + 2.0 * p * cos(angle);
    values[0] = mean + 2.0 * p * cos(angle + 2.0 * FST_PI / 3.0);
    values[1] = 3.0 * mean - values[0] - values[2];
}

MEASURE(fold15_roundness)
{
    NO_NOTE;
    const fst_table *table = &fst_paper_single(paper, FST_SCAN_FOLD15, dynamics)->trajectory;
    const double *n[3] = {fst_collected(table, "n_r"), fst_collected(table, "n_alpha"),
                          fst_collected(table, "n_z")};
    double mean[3] = {0}, covariance[3][3] = {{0}}, widths[3];
    if (table->rows == 0)
        return NAN;
    for (size_t row = 0; row < table->rows; ++row)
        for (int i = 0; i < 3; ++i)
            mean[i] += n[i][row] / (double)table->rows;
    for (size_t row = 0; row < table->rows; ++row)
        for (int i = 0; i < 3; ++i)
            for (int j = 0; j < 3; ++j)
                covariance[i][j] += (n[i][row] - mean[i]) * (n[j][row] - mean[j]) / (double)table->rows;
    eigenvalues(covariance, widths);
    return sqrt(widths[1] / widths[2]);
}

/* ------------------------------------------------------------------ r against Phi */

/* The mean angle Phi, modulo pi, of the local extremes of r (sign +1: maxima, -1: minima), in degrees from -90
 * to 90.  A parabola through three samples places each extreme. */
static double extreme_bead_angle(const fst_table *table, double sign)
{
    const double *r = fst_collected(table, "r"), *bead_angle = fst_collected(table, "Phi");
    double complex sum = 0.0;
    for (size_t row = 1; row + 1 < table->rows; ++row) {
        double before = sign * (r[row] - r[row - 1]), after = sign * (r[row + 1] - r[row]);
        if (!(before >= 0.0 && after < 0.0))
            continue;
        double shift = 0.5 * (before + after) / (before - after);
        double place = bead_angle[row] + shift * 0.5 * (bead_angle[row + 1] - bead_angle[row - 1]);
        sum += cexp(2.0 * I * place);
    }
    return cabs(sum) > 0.0 ? 0.5 * carg(sum) * FST_DEGREES : NAN;
}

MEASURE(least_radius)
{
    const fst_run_result *result = single(paper, FST_SCAN_FOLD15, dynamics);
    (void)snprintf(note, size, "at the drive 0.4; greatest r is %.3f", result->max_r);
    return result->min_r;
}

MEASURE(least_radius_phi)
{
    NO_NOTE;
    return extreme_bead_angle(&fst_paper_single(paper, FST_SCAN_FOLD15, dynamics)->trajectory, -1.0);
}

MEASURE(greatest_radius_phi)
{
    NO_NOTE;
    double degrees = extreme_bead_angle(&fst_paper_single(paper, FST_SCAN_FOLD15, dynamics)->trajectory, 1.0);
    return degrees < 0.0 ? degrees + 180.0 : degrees;
}

/* ------------------------------------------------------------------ over the drive */

MEASURE(halving)
{
    const fst_paper_exact *exact = &paper->exact[dynamics];
    double line = fst_paper_halving_line(paper, dynamics);
    if (isfinite(exact->halving))
        (void)snprintf(
            note, size,
            "the pitchfork of the periodic orbits, %.9f; without them, where a straight line through "
            "⟨n_z⟩² of settled runs vanishes: %.5f",
            exact->halving, line);
    else
        (void)snprintf(note, size,
                       "where a straight line through ⟨n_z⟩² of settled runs vanishes; the orbits: %s",
                       exact->missing);
    return fst_paper_halving_drive(paper, dynamics);
}

MEASURE(halving_branch)
{
    const fst_paper_exact *exact = &paper->exact[dynamics];
    (void)snprintf(note, size, "%s", exact->missing);
    return isfinite(exact->halving) ? (double)exact->criticality : NAN;
}

MEASURE(two_poles)
{
    const fst_paper_exact *exact = &paper->exact[dynamics];
    (void)snprintf(note, size, "%s",
                   exact->missing[0] ? exact->missing : "at the drive 0.02, above one pole and the other");
    return exact->locked_minima;
}

MEASURE(damping)
{
    const fst_paper_exact *exact = &paper->exact[dynamics];
    (void)snprintf(
        note, size, "%s",
        exact->missing[0]
            ? exact->missing
            : "−Re λ/|λ| of the least damped swing about a pole at κ = 0.015, drive 0.001; 1 would be "
              "overdamped. A bead that rolls does not rub: the weaker the field, the less a swing slips");
    return exact->damping;
}

MEASURE(onset)
{
    for (int i = 0; i < paper->counts[FST_SCAN_COMPARISON]; ++i) {
        const fst_paper_run *run = &paper->scans[FST_SCAN_COMPARISON][dynamics][i];
        if (!fst_paper_counter_rotates(run))
            continue;
        (void)snprintf(note, size,
                       "first run from the rolling start that counter-rotates; they are a quarter of a "
                       "hertz apart");
        return run->result.frequency_hz;
    }
    return NAN;
}

MEASURE(corotation)
{
    const fst_paper_run *run = fst_paper_single(paper, FST_SCAN_SLOW, dynamics);
    double hertz = run->params.friction_gamma / (2.0 * FST_PI);
    fst_paper_bracket locked = paper->changes[FST_CHANGE_LOCKED][dynamics],
                      swinging = paper->changes[FST_CHANGE_COROTATION][dynamics];
    const double end = 0.5 * (locked.low + locked.high) * hertz,
                 crossing = 0.5 * (swinging.low + swinging.high) * hertz;
    if (isfinite(paper->exact[dynamics].locked_end))
        (void)snprintf(note, size,
                       "the last locked state loses its stability there, in a Hopf point of the branch (ω = "
                       "%.9f); beyond, the bead swings about the magnet while it goes round with it, up to "
                       "%.4f Hz, where that orbit passes the axis",
                       0.5 * (locked.low + locked.high), crossing);
    else
        (void)snprintf(
            note, size,
            "released at rest, ⟨α′⟩ = ω and r and Φ constant up to here (± %.2f Hz: by bisection of "
            "settled runs); beyond, the bead swings about the magnet while it goes round with it, up to "
            "%.2f ± %.2f Hz. The orbits: %.200s",
            0.5 * (locked.high - locked.low) * hertz, crossing, 0.5 * (swinging.high - swinging.low) * hertz,
            paper->exact[dynamics].missing);
    return end;
}

MEASURE(irregular)
{
    int all = 0, irregular = 0, undecided = 0;
    static const fst_scan both[] = {FST_SCAN_COMPARISON, FST_SCAN_SLOW};
    for (int s = 0; s < 2; ++s) {
        for (int i = 0; i < paper->counts[both[s]]; ++i) {
            const fst_run_result *result = &paper->scans[both[s]][dynamics][i].result;
            if (result->frequency_hz < 7.0 || result->frequency_hz > 10.0)
                continue;
            ++all;
            undecided += result->regime == FST_REGIME_UNDECIDED;
            irregular += result->regime == FST_REGIME_CHAOTIC || result->regime == FST_REGIME_UNDECIDED ||
                         result->regime == FST_REGIME_EJECTED || result->regime == FST_REGIME_LIFTED;
        }
    }
    (void)snprintf(note, size,
                   "%d of %d runs between 7 and 10 Hz are chaotic, undecided (%d) or end off the plate; the "
                   "others are locked, swing about the magnet or counter-rotate",
                   irregular, all, undecided);
    return all > 0 ? 100.0 * irregular / all : NAN;
}

MEASURE(bell)
{
    int count = paper->counts[FST_SCAN_COMPARISON], best = -1;
    const fst_paper_run *runs = paper->scans[FST_SCAN_COMPARISON][dynamics];
    for (int i = 0; i < count; ++i)
        if (fst_paper_counter_rotates(&runs[i]) &&
            (best < 0 || runs[i].result.mean_alpha_dot > runs[best].result.mean_alpha_dot))
            best = i;
    if (best < 0)
        return NAN;
    (void)snprintf(note, size, "⟨α′⟩ = %.4f γ there; the runs are about a quarter of a hertz apart",
                   runs[best].result.mean_alpha_dot);
    /* The slope of alpha' jumps at the period halving, which is close by, so a parabola through three points
     * would pretend to more than they tell. */
    return runs[best].result.frequency_hz;
}

/* Runs on either side of the top of the bell at which |alpha'| does not fall away from it. */
MEASURE(bell_shape)
{
    const fst_paper_run *runs = paper->scans[FST_SCAN_COMPARISON][dynamics];
    double before = NAN, top = -INFINITY, left = NAN;
    int count = paper->counts[FST_SCAN_COMPARISON], wrong = 0, best = 0;
    for (int i = 0; i < count; ++i)
        if (fst_paper_counter_rotates(&runs[i]) && runs[i].result.mean_alpha_dot > top) {
            top = runs[i].result.mean_alpha_dot;
            best = i;
        }
    for (int i = 0; i < count; ++i) {
        double now = fst_paper_counter_rotates(&runs[i]) ? runs[i].result.mean_alpha_dot : NAN;
        wrong += i <= best ? now < before : now > before;
        left = isnan(left) ? now : left;
        before = now;
    }
    (void)snprintf(note, size, "⟨α′⟩ = %.4f at the left end, %.4f at the top, %.4f at the drive 0.5", left, top,
                   before);
    return wrong;
}

MEASURE(inversion)
{
    static const fst_scan both[] = {FST_SCAN_COMPARISON, FST_SCAN_SLOW};
    int all = 0, others = 0, undecided = 0;
    for (int s = 0; s < 2; ++s)
        for (int i = 0; i < paper->counts[both[s]]; ++i) {
            const fst_paper_run *run = &paper->scans[both[s]][dynamics][i];
            if (run->result.frequency_hz < 10.0)
                continue;
            ++all;
            undecided += run->result.regime == FST_REGIME_UNDECIDED;
            others +=
                run->result.regime != FST_REGIME_COUNTER_ROTATING && run->result.regime != FST_REGIME_UNDECIDED;
        }
    (void)snprintf(note, size, "of %d runs from 10 Hz on, from the rolling start and released at rest%s", all,
                   undecided ? "; some are undecided" : "");
    return others == 0 && undecided > 0 ? NAN : (double)others;
}

MEASURE(slowness)
{
    double least = INFINITY, greatest = 0.0;
    for (int i = 0; i < paper->counts[FST_SCAN_COMPARISON]; ++i) {
        const fst_paper_run *run = &paper->scans[FST_SCAN_COMPARISON][dynamics][i];
        if (!fst_paper_counter_rotates(run) || run->result.omega < 0.2 || run->result.omega > 0.41)
            continue;
        double ratio = run->result.omega / fabs(run->result.mean_alpha_dot);
        least = fmin(least, ratio);
        greatest = fmax(greatest, ratio);
    }
    (void)snprintf(note, size, "from %.1f to %.1f between the drives 0.2 and 0.41", least, greatest);
    return greatest > 0.0 ? sqrt(least * greatest) : NAN;
}

/* ------------------------------------------------------------------ free rolling and balances */

/* The greatest relative deviation of a mean from its value for free rolling over the fast scan, in %, by the
 * paper's Eq. (15) with the <r> of the run. */
static double rolling_deviation(const fst_paper_state *paper, fst_dynamics dynamics, int of_phi, char *note,
                                size_t size)
{
    double greatest = 0.0, where = NAN;
    for (int i = 0; i < paper->counts[FST_SCAN_FAST]; ++i) {
        const fst_paper_run *run = &paper->scans[FST_SCAN_FAST][dynamics][i];
        const fst_run_result *result = &run->result;
        double eps = run->params.bead_radius / run->params.magnet_half_length;
        double rolling = (of_phi ? result->mean_r : -eps) * result->omega / (result->mean_r - eps);
        double value = of_phi ? result->mean_phi_dot : result->mean_alpha_dot;
        if (!fst_paper_counter_rotates(run) || !isfinite(value))
            continue;
        double deviation = 100.0 * fabs(value / rolling - 1.0);
        if (deviation > greatest) {
            greatest = deviation;
            where = result->omega;
        }
    }
    (void)snprintf(note, size, "greatest deviation for drives from 0.5 to 2, found at %.3g", where);
    return greatest > 0.0 ? greatest : NAN;
}

MEASURE(rolling_alpha)
{
    return rolling_deviation(paper, dynamics, 0, note, size);
}

MEASURE(rolling_phi)
{
    return rolling_deviation(paper, dynamics, 1, note, size);
}

MEASURE(friction_share)
{
    const fst_run_result *result = single(paper, FST_SCAN_FOLD15, dynamics);
    if (!is_viscous(fst_paper_single(paper, FST_SCAN_FOLD15, dynamics), note, size))
        return NAN;
    const fst_run_result *fast =
        &paper->scans[FST_SCAN_FAST][dynamics][paper->counts[FST_SCAN_FAST] - 1].result;
    (void)snprintf(note, size, "at the drive 0.4; %.0f %% at the drive %.3g",
                   100.0 * fabs(fast->eq21_friction / fast->eq21_magnetic), fast->omega);
    return 100.0 * fabs(result->eq21_friction / result->eq21_magnetic);
}

MEASURE(energy)
{
    double greatest = 0.0;
    for (int i = 0; i < paper->counts[FST_SCAN_TABLE]; ++i) {
        const fst_run_result *result = &paper->scans[FST_SCAN_TABLE][dynamics][i].result;
        double share = fabs(result->mean_drive_power / result->mean_friction_power - 1.0);
        greatest = isfinite(share) ? fmax(greatest, share) : INFINITY;
    }
    (void)snprintf(note, size, "|⟨drive power⟩/⟨friction power⟩ − 1|, greatest of the five drives of Table 1");
    return greatest;
}
