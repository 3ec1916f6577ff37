/* measures.c - numbers of the paper measured on the runs: the two patterns, curves over the drive; and what all
 * measures share. */
#include "base/constants.h"
#include "paper/dry.h"
#include "paper/measures_parts.h"

#include <complex.h>
#include <stdlib.h>

/* ------------------------------------------------------------------ what all measures share */

int fst_measure_is_viscous(const fst_measuring *m, const fst_paper_run *run)
{
    if (run->params.friction_law == FST_FRICTION_VISCOUS)
        return 1;
    char law[64];
    (void)fst_params_get(&run->params, fst_param_find("friction.law"), law, sizeof law);
    NOTE("not measured: the equation takes −mγV for the friction, and here it is %s", law);
    return 0;
}

fst_run_list fst_runs_between(const fst_measuring *m, double low, double high)
{
    static const fst_scan both[] = {FST_SCAN_COMPARISON, FST_SCAN_SLOW};
    fst_run_list list = {.count = 0};
    for (int s = 0; s < 2; ++s)
        for (int i = 0; i < m->paper->counts[both[s]] && list.count < FST_MOST_LISTED; ++i) {
            const fst_paper_run *run = &run_of(m, both[s])[i];
            if (!(run->result.frequency_hz < low || run->result.frequency_hz > high))
                list.runs[list.count++] = run;
        }
    return list;
}

fst_run_list fst_counter_rotating_runs(const fst_measuring *m)
{
    fst_run_list list = {.count = 0};
    for (int i = 0; i < m->paper->counts[FST_SCAN_COMPARISON] && list.count < FST_MOST_LISTED; ++i) {
        const fst_paper_run *run = &run_of(m, FST_SCAN_COMPARISON)[i];
        if (fst_paper_counter_rotates(run) && run->result.omega >= 0.2 && run->result.omega <= 0.41)
            list.runs[list.count++] = run;
    }
    return list;
}

fst_path fst_path_of(const fst_paper_run *run)
{
#define COLUMN(name) .name = fst_collected(&run->trajectory, #name)
    return (fst_path){.rows = run->trajectory.rows,
                      COLUMN(t),
                      COLUMN(x),
                      COLUMN(y),
                      COLUMN(X),
                      COLUMN(Y),
                      COLUMN(r),
                      COLUMN(alpha),
                      COLUMN(Phi),
                      COLUMN(nX),
                      COLUMN(nY),
                      COLUMN(nZ),
                      COLUMN(n_r),
                      COLUMN(n_alpha),
                      COLUMN(n_z),
                      COLUMN(angle),
                      COLUMN(slip),
                      COLUMN(friction_power)};
#undef COLUMN
}

size_t fst_turning_point(const fst_path *path, size_t row)
{
    const double *r = path->r;
    while (row + 1 < path->rows && !(r[row] > r[row - 1] && r[row] >= r[row + 1]))
        ++row;
    return row + 1 < path->rows ? row : path->rows;
}

/* Where |B| is greatest on the magnet's axis: d(B^2)/dX = 2 B.(dB/dX) changes its sign there. */
double fst_maximum_on_axis(const fst_params *params)
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

double fst_measure_in(const fst_measuring *m, fst_scan scan,
                      double (*measure)(const fst_measuring *m, const fst_model *model))
{
    fst_model *model = NULL;
    if (fst_model_new(&run_of(m, scan)->params, &model, NULL) != FST_OK)
        return NAN;
    const double value = measure(m, model);
    fst_model_free(model);
    return value;
}

/* ------------------------------------------------------------------ formulas */

/* The mean angle Phi, modulo pi, of the local extremes of r (sign +1: maxima, -1: minima), in degrees from -90
 * to 90.  A parabola through three samples places each extreme. */
static double extreme_bead_angle(const fst_paper_run *run, double sign)
{
    const fst_table *table = &run->trajectory;
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

static double not_negative(double degrees, double turn)
{
    return degrees < 0.0 ? degrees + turn : degrees;
}

static const fst_paper_exact *orbits_of(const fst_measuring *m)
{
    return &m->paper->exact[m->dynamics];
}

static double slip_share(const fst_run_result *result)
{
    return 100.0 * fabs(result->mean_v_alpha / (result->mean_r * result->mean_alpha_dot));
}

/* mu B0 in J: kappa m R^2 gamma^2. */
static double energy_scale(const fst_params *p)
{
    return p->model_kappa * p->bead_mass * p->bead_radius * p->bead_radius * p->friction_gamma *
           p->friction_gamma;
}

/* The frequency (Hz) at which friction on a bead that goes with the magnet is mu B0/l. */
static double pulled_along(const fst_params *p)
{
    return energy_scale(p) / p->magnet_half_length / (p->bead_mass * p->friction_gamma * p->bead_radius) /
           (2.0 * FST_PI);
}

static double cube(double length)
{
    return length * length * length;
}

/* The moment of a bead whose remanence is 1 T, in A m^2. */
static double moment_of_one_tesla(const fst_params *p)
{
    return 4.0 * FST_PI / 3.0 * cube(p->bead_radius) / (4e-7 * FST_PI);
}

#include "paper/formulas.def"

/* ------------------------------------------------------------------ the two patterns */

MEASURE(fold15_festoons)
{
    const fst_path path = fst_path_of(run_of(m, FST_SCAN_FOLD15));
    const size_t first = fst_turning_point(&path, 1);
    size_t last = first;
    int count = 0;
    for (size_t row; last < path.rows && (row = fst_turning_point(&path, last + 1)) < path.rows; ++count)
        last = row;
    NOTE("a(1 + ω/|⟨α′⟩|); counted on the path: %.3f turning points a revolution",
         last < path.rows ? 2.0 * FST_PI * count / fabs(path.alpha[last] - path.alpha[first]) : NAN);
    return run_of(m, FST_SCAN_FOLD15)->result.festoons;
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
    const fst_table *table = &run_of(m, FST_SCAN_FOLD15)->trajectory;
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

/* ------------------------------------------------------------------ over the drive */

MEASURE(halving)
{
    const fst_paper_exact *exact = orbits_of(m);
    double line = fst_paper_halving_line(m->paper, m->dynamics);
    if (isfinite(exact->halving))
        NOTE("the pitchfork of the periodic orbits, %.9f; without them, where a straight line through ⟨n_z⟩² "
             "of settled runs vanishes: %.5f",
             exact->halving, line);
    else
        NOTE("where a straight line through ⟨n_z⟩² of settled runs vanishes; the orbits: %s", exact->missing);
    return fst_paper_halving_drive(m->paper, m->dynamics);
}

MEASURE(onset)
{
    for (int i = 0; i < m->paper->counts[FST_SCAN_COMPARISON]; ++i) {
        const fst_paper_run *run = &run_of(m, FST_SCAN_COMPARISON)[i];
        if (!fst_paper_counter_rotates(run))
            continue;
        NOTE("first run from the rolling start that counter-rotates; they are a quarter of a hertz apart");
        return run->result.frequency_hz;
    }
    return NAN;
}

/* Of a bead that rubs dry, from the runs: there is no branch of locked states. */
static double dry_corotation(const fst_measuring *m)
{
    const fst_paper_run *runs = run_of(m, FST_SCAN_SLOW);
    const int count = m->paper->counts[FST_SCAN_SLOW];
    int next = 0;
    while (next < count && fst_outcome(&runs[next].result) == FST_OUTCOME_WITH)
        ++next;
    if (next == 0 || next == count)
        return NAN;
    const double with = runs[next - 1].result.frequency_hz, other = runs[next].result.frequency_hz;
    NOTE("released at rest, the bead goes with the magnet at %.2f Hz; at the next drive, %.2f Hz: %s", with,
         other, fst_outcome_names[fst_outcome(&runs[next].result)]);
    return 0.5 * (with + other);
}

MEASURE(corotation)
{
    if (m->paper->mu > 0.0)
        return dry_corotation(m);
    const double hertz = run_of(m, FST_SCAN_SLOW)->params.friction_gamma / (2.0 * FST_PI);
    const fst_paper_bracket locked = m->paper->changes[FST_CHANGE_LOCKED][m->dynamics],
                            swinging = m->paper->changes[FST_CHANGE_COROTATION][m->dynamics];
    const double end = 0.5 * (locked.low + locked.high) * hertz,
                 crossing = 0.5 * (swinging.low + swinging.high) * hertz;
    if (isfinite(orbits_of(m)->locked_end))
        NOTE("the last locked state loses its stability there, in a Hopf point of the branch (ω = %.9f); "
             "beyond, the bead swings about the magnet while it goes round with it, up to %.4f Hz, where that "
             "orbit passes the axis",
             0.5 * (locked.low + locked.high), crossing);
    else
        NOTE("released at rest, ⟨α′⟩ = ω and r and Φ constant up to here (± %.2f Hz: by bisection of settled "
             "runs); beyond, the bead swings about the magnet while it goes round with it, up to %.2f ± %.2f "
             "Hz. The orbits: %.200s",
             0.5 * (locked.high - locked.low) * hertz, crossing, 0.5 * (swinging.high - swinging.low) * hertz,
             orbits_of(m)->missing);
    return end;
}

MEASURE(irregular)
{
    const fst_run_list list = fst_runs_between(m, 7.0, 10.0);
    int undecided = 0, gone = 0, chaotic = 0;
    for (int i = 0; i < list.count; ++i) {
        const fst_regime regime = list.runs[i]->result.regime;
        undecided += regime == FST_REGIME_UNDECIDED;
        gone += regime == FST_REGIME_EJECTED || regime == FST_REGIME_LIFTED;
        chaotic += regime == FST_REGIME_CHAOTIC;
    }
    if (m->paper->mu > 0.0) {
        NOTE("%d of %d runs between 7 and 10 Hz leave the plate, %d are chaotic on it; undecided ones, most of "
             "which roll ever longer, are not counted",
             gone, list.count, chaotic);
        undecided = 0;
    } else
        NOTE("%d of %d runs between 7 and 10 Hz are chaotic, undecided (%d) or end off the plate; the others "
             "are locked, swing about the magnet or counter-rotate",
             gone + chaotic + undecided, list.count, undecided);
    return list.count > 0 ? 100.0 * (gone + chaotic + undecided) / list.count : NAN;
}

/* The counter-rotating run with the least |alpha'|; -1: there is none. */
static int top_of_the_bell(const fst_measuring *m)
{
    const fst_paper_run *runs = run_of(m, FST_SCAN_COMPARISON);
    int best = -1;
    for (int i = 0; i < m->paper->counts[FST_SCAN_COMPARISON]; ++i)
        if (fst_paper_counter_rotates(&runs[i]) &&
            (best < 0 || runs[i].result.mean_alpha_dot > runs[best].result.mean_alpha_dot))
            best = i;
    return best;
}

/* The slope of alpha' jumps at the period halving, which is close by, so a parabola through three points would
 * pretend to more than they tell. */
MEASURE(bell)
{
    const int best = top_of_the_bell(m);
    if (best < 0)
        return NAN;
    const fst_run_result *top = &run_of(m, FST_SCAN_COMPARISON)[best].result;
    NOTE("⟨α′⟩ = %.4f γ there; the runs are about a quarter of a hertz apart", top->mean_alpha_dot);
    return top->frequency_hz;
}

/* Runs on either side of the top of the bell at which |alpha'| does not fall away from it. */
MEASURE(bell_shape)
{
    const fst_paper_run *runs = run_of(m, FST_SCAN_COMPARISON);
    const int best = top_of_the_bell(m);
    double before = NAN, left = NAN;
    int wrong = 0;
    for (int i = 0; i < m->paper->counts[FST_SCAN_COMPARISON]; ++i) {
        const double now = fst_paper_counter_rotates(&runs[i]) ? runs[i].result.mean_alpha_dot : NAN;
        wrong += i <= best ? now < before : now > before;
        left = isnan(left) ? now : left;
        before = now;
    }
    NOTE("⟨α′⟩ = %.4f at the left end, %.4f at the top, %.4f at the drive 0.5", left,
         best < 0 ? -INFINITY : runs[best].result.mean_alpha_dot, before);
    return wrong;
}

MEASURE(inversion)
{
    const fst_run_list list = fst_runs_between(m, 10.0, INFINITY);
    int others = 0, undecided = 0;
    for (int i = 0; i < list.count; ++i) {
        const fst_regime regime = list.runs[i]->result.regime;
        undecided += regime == FST_REGIME_UNDECIDED;
        others += regime != FST_REGIME_COUNTER_ROTATING && regime != FST_REGIME_UNDECIDED;
    }
    NOTE("of %d runs from 10 Hz on, from the rolling start and released at rest%s", list.count,
         undecided ? "; some are undecided" : "");
    return others == 0 && undecided > 0 ? NAN : (double)others;
}

MEASURE(slowness)
{
    const fst_run_list list = fst_counter_rotating_runs(m);
    double least = INFINITY, greatest = 0.0;
    for (int i = 0; i < list.count; ++i) {
        const double ratio = list.runs[i]->result.omega / fabs(list.runs[i]->result.mean_alpha_dot);
        least = fmin(least, ratio);
        greatest = fmax(greatest, ratio);
    }
    NOTE("from %.1f to %.1f between the drives 0.2 and 0.41", least, greatest);
    return greatest > 0.0 ? sqrt(least * greatest) : NAN;
}

static int by_size(const void *one, const void *other)
{
    const double a = *(const double *)one, b = *(const double *)other;
    return (a > b) - (a < b);
}

MEASURE(drifting)
{
    const fst_run_list list = fst_counter_rotating_runs(m);
    double degrees[FST_MOST_LISTED];
    int open = 0, known = 0;
    for (int i = 0; i < list.count; ++i) {
        const double festoons = list.runs[i]->result.festoons, off = fabs(festoons - round(festoons));
        if (isnan(festoons)) /* the symmetry is not known */
            continue;
        open += off > 0.01;
        degrees[known++] = 360.0 * off / festoons;
    }
    qsort(degrees, (size_t)known, sizeof degrees[0], by_size);
    NOTE("%d of %d runs; half of them drift by over %.1f degrees a revolution", open, known,
         known > 0 ? degrees[known / 2] : NAN);
    return known > 0 ? 100.0 * open / known : NAN;
}

/* The highest drive up to which all runs go with the magnet, and the lowest from which all go against it; runs
 * that do not tell are left out. */
MEASURE(suddenness)
{
    const fst_run_list list = fst_runs_between(m, 0.0, INFINITY);
    double with_to = 0.0, against_from = INFINITY, first_other = INFINITY, last_other = 0.0;
    for (int i = 0; i < 2 * list.count; ++i) { /* where the others are, then what lies beside them */
        const fst_run_result *result = &list.runs[i % list.count]->result;
        const fst_dry_outcome outcome = fst_outcome(result);
        const double hertz = result->frequency_hz;
        if (isnan(result->mean_alpha_dot) && result->regime == FST_REGIME_UNDECIDED)
            continue;
        if (i < list.count && outcome != FST_OUTCOME_WITH)
            first_other = fmin(first_other, hertz);
        if (i < list.count && outcome != FST_OUTCOME_AGAINST)
            last_other = fmax(last_other, hertz);
        if (i >= list.count && hertz < first_other)
            with_to = fmax(with_to, hertz);
        if (i >= list.count && hertz > last_other)
            against_from = fmin(against_from, hertz);
    }
    NOTE("up to %.2f Hz all runs go with the magnet, from %.2f Hz on all go against it", with_to, against_from);
    return 100.0 * (against_from - with_to) / (0.5 * (against_from + with_to));
}

/* ------------------------------------------------------------------ free rolling and the balance of energy */

/* By how much a mean is off its value for free rolling, in %, by the paper's Eq. (15) with the <r> of the run;
 * NAN where the bead does not counter-rotate. */
static double off_rolling(const fst_paper_run *run, int of_phi)
{
    const fst_run_result *at = &run->result;
    const double eps = eps_of(&run->params), value = of_phi ? at->mean_phi_dot : at->mean_alpha_dot;
    const double rolling = (of_phi ? at->mean_r : -eps) * at->omega / (at->mean_r - eps);
    return fst_paper_counter_rotates(run) ? 100.0 * fabs(value / rolling - 1.0) : NAN;
}

/* The greatest of these, among the first `count` runs, and at which drive. */
static double greatest_off_rolling(const fst_paper_run *const *runs, int count, int of_phi, double *where)
{
    double greatest = NAN;
    *where = NAN;
    for (int i = 0; i < count; ++i) {
        const double off = off_rolling(runs[i], of_phi);
        if (!isfinite(off) || off <= greatest)
            continue;
        greatest = off;
        *where = runs[i]->result.omega;
    }
    return greatest;
}

static double rolling_fast(const fst_measuring *m, int of_phi)
{
    fst_run_list list = {.count = 0};
    for (; list.count < m->paper->counts[FST_SCAN_FAST] && list.count < FST_MOST_LISTED; ++list.count)
        list.runs[list.count] = &run_of(m, FST_SCAN_FAST)[list.count];
    double where;
    const double greatest = greatest_off_rolling(list.runs, list.count, of_phi, &where);
    NOTE("greatest deviation for drives from 0.5 to 2, found at %.3g", where);
    return greatest > 0.0 ? greatest : NAN;
}

MEASURE(rolling_alpha)
{
    return rolling_fast(m, 0);
}

MEASURE(rolling_phi)
{
    return rolling_fast(m, 1);
}

MEASURE(rolling_below)
{
    const fst_run_list list = fst_counter_rotating_runs(m);
    double where;
    const double greatest = greatest_off_rolling(list.runs, list.count, 0, &where);
    NOTE("greatest deviation of ⟨α′⟩ for drives from 0.2 to 0.41, found at %.3g", where);
    return greatest;
}

MEASURE(asymptotic_rolling)
{
    const fst_paper_run *first = run_of(m, FST_SCAN_ASYMPTOTIC), *last = last_of(m, FST_SCAN_ASYMPTOTIC);
    const double fold = orbits_of(m)->fold;
    NOTE("deviation of ⟨α′⟩ at the drive %g%s; at %g it is %.1f %%, with ⟨r⟩ = %.2f. There is no limit: the "
         "bead circles ever further out, and at ω = %.4f (%.0f Hz) its orbit ends in a fold",
         last->result.omega, fst_paper_counter_rotates(last) ? "" : ", where no such motion exists",
         first->result.omega, off_rolling(first, 0), first->result.mean_r, fold,
         fold * last->params.friction_gamma / (2.0 * FST_PI));
    return off_rolling(last, 0);
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

static negligible friction_negligible(const fst_measuring *m)
{
    static const fst_scan beyond[2] = {FST_SCAN_ASYMPTOTIC, FST_SCAN_FAST};
    negligible found = {NAN, NAN};
    int still = 1; /* whether friction is negligible from this drive upwards */
    for (int s = 0; s < 2; ++s) {
        for (int i = m->paper->counts[beyond[s]] - 1; i >= 0; --i) {
            const fst_paper_run *run = &run_of(m, beyond[s])[i];
            const int small = friction_part(run) < 0.1;
            still = still && small;
            found.from = still ? run->result.frequency_hz : found.from;
            found.first = small ? run->result.frequency_hz : found.first;
        }
    }
    return found;
}

VISCOUS(asymptotic_frequency, ASYMPTOTIC, friction_negligible(m).from, "%s",
        isfinite(measured_value) ? "looked for up to 149 Hz"
                                 : "up to 149 Hz there is no such drive, or the motion has ended before");
VISCOUS(asymptotic_first, ASYMPTOTIC, friction_negligible(m).first,
        "friction's part is on its way through zero there, and grows again beyond");

MEASURE(energy)
{
    double greatest = 0.0;
    for (int i = 0; i < m->paper->counts[FST_SCAN_TABLE]; ++i) {
        const fst_run_result *result = &run_of(m, FST_SCAN_TABLE)[i].result;
        double share = fabs(result->mean_drive_power / result->mean_friction_power - 1.0);
        greatest = isfinite(share) ? fmax(greatest, share) : INFINITY;
    }
    NOTE("|⟨drive power⟩/⟨friction power⟩ − 1|, greatest of the five drives of Table 1");
    return greatest;
}
