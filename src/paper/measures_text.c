/* measures_text.c - sentences of the text about paths, symmetry and order. */
#include "paper/dry.h"
#include "paper/measures_parts.h"

#include <stdlib.h>

/* ------------------------------------------------------------------ festoons as shortcuts */

/* The length of the path of one revolution, from whole meetings of bead and magnet, two at a time. */
static double revolution(const fst_paper_run *run)
{
    const fst_table *table = &run->trajectory;
    const double *x = fst_collected(table, "x"), *y = fst_collected(table, "y"), *t = fst_collected(table, "t");
    const double circling = run->result.mean_alpha_dot, meeting = run->result.omega - circling;
    double length = 0.0;
    if (table->rows < 2)
        return NAN;
    const double turn = 4.0 * FST_PI / meeting, last = turn * floor((t[table->rows - 1] - t[0]) / turn);
    for (size_t row = 1; row < table->rows && t[row] - t[0] <= last; ++row)
        length += hypot(x[row] - x[row - 1], y[row] - y[row - 1]);
    return length / last * 2.0 * FST_PI / fabs(circling);
}

MEASURE(shortcuts)
{
    const fst_paper_run *run = fst_paper_single(paper, FST_SCAN_FOLD4, dynamics);
    const double length = revolution(run), eps = eps_of(run), r = run->result.mean_r;
    const double rolling = eps * run->result.omega * r / (r - eps), circling = fabs(run->result.mean_alpha_dot);
    (void)snprintf(note, size,
                   "the path is %.2f of that circle. |⟨α′⟩| is %.2f times that of a bead rolling on it, since "
                   "it moves %.2f "
                   "times as fast",
                   length / (2.0 * FST_PI * r), circling * r / rolling,
                   circling * length / (2.0 * FST_PI) / rolling);
    return 100.0 * (1.0 - length / (2.0 * FST_PI * r));
}

MEASURE(shortcuts_within)
{
    const fst_paper_run *run = fst_paper_single(paper, FST_SCAN_FOLD4, dynamics);
    (void)snprintf(note, size, "r = %.3f", run->result.max_r);
    return 100.0 * (1.0 - revolution(run) / (2.0 * FST_PI * run->result.max_r));
}

/* ------------------------------------------------------------------ over the drive */

static int by_size(const void *one, const void *other)
{
    const double a = *(const double *)one, b = *(const double *)other;
    return (a > b) - (a < b);
}

MEASURE(drifting)
{
    enum { MOST = 128 };
    double degrees[MOST];
    int all = 0, open = 0;
    for (int i = 0; i < paper->counts[FST_SCAN_COMPARISON] && all < MOST; ++i) {
        const fst_paper_run *run = &paper->scans[FST_SCAN_COMPARISON][dynamics][i];
        if (!fst_paper_counter_rotates(run) || run->result.omega < 0.2 || run->result.omega > 0.41)
            continue;
        const double off = fabs(run->result.festoons - round(run->result.festoons));
        open += off > 0.01;
        degrees[all++] = 360.0 * off / run->result.festoons;
    }
    qsort(degrees, (size_t)all, sizeof degrees[0], by_size);
    (void)snprintf(note, size, "%d of %d runs; half of them drift by over %.1f degrees a revolution", open, all,
                   all > 0 ? degrees[all / 2] : NAN);
    return all > 0 ? 100.0 * open / all : NAN;
}

/* The highest drive up to which all runs go with the magnet, and the lowest from which all go against it; runs
 * that do not tell are left out. */
MEASURE(suddenness)
{
    static const fst_scan both[] = {FST_SCAN_SLOW, FST_SCAN_COMPARISON};
    double with_to = 0.0, against_from = INFINITY, first_other = INFINITY, last_other = 0.0;
    for (int s = 0; s < 4; ++s) /* where the others are, then what lies beside them */
        for (int i = 0; i < paper->counts[both[s % 2]]; ++i) {
            const fst_run_result *result = &paper->scans[both[s % 2]][dynamics][i].result;
            const fst_dry_outcome outcome = fst_outcome(result);
            const double hertz = result->frequency_hz;
            if (isnan(result->mean_alpha_dot) && result->regime == FST_REGIME_UNDECIDED)
                continue;
            if (s < 2 && outcome != FST_OUTCOME_WITH)
                first_other = fmin(first_other, hertz);
            if (s < 2 && outcome != FST_OUTCOME_AGAINST)
                last_other = fmax(last_other, hertz);
            if (s >= 2 && hertz < first_other)
                with_to = fmax(with_to, hertz);
            if (s >= 2 && hertz > last_other)
                against_from = fmin(against_from, hertz);
        }
    (void)snprintf(note, size, "up to %.2f Hz all runs go with the magnet, from %.2f Hz on all go against it",
                   with_to, against_from);
    return 100.0 * (against_from - with_to) / (0.5 * (against_from + with_to));
}

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
    const fst_table *table = &fst_paper_single(paper, FST_SCAN_FOLD15, dynamics)->trajectory;
    const double of_r = not_reversed(table, place, 2), of_n = not_reversed(table, moment, 3);
    (void)snprintf(
        note, size,
        "r is reversed to %.0e, n to %.2f: its upright part changes its sign, its part in the plane does not",
        of_r, of_n);
    return fmax(of_r, of_n);
}

MEASURE(s2_in_components)
{
    static const char *const place[] = {"X", "Y"}, *const moment[] = {"n_r", "n_alpha", "n_z"};
    const fst_table *table = &fst_paper_single(paper, FST_SCAN_FOLD15, dynamics)->trajectory;
    (void)snprintf(note, size,
                   "e_r and e_α turn round with the bead, so that all three components change their signs");
    return fmax(not_reversed(table, place, 2), not_reversed(table, moment, 3));
}

/* ------------------------------------------------------------------ arithmetic */

/* The pulsation from the moment and the field in SI units, which are set here so that the model has to make
 * kappa of them. */
MEASURE(kappa_ratio)
{
    fst_params params = fst_paper_single(paper, FST_SCAN_FOLD4, dynamics)->params;
    const double energy = params.model_kappa * params.bead_mass * params.bead_radius * params.bead_radius *
                          params.friction_gamma * params.friction_gamma;
    const double moment = 0.05, field = energy / moment;
    char text[2][40];
    fst_model *model = NULL;
    (void)snprintf(text[0], sizeof text[0], "%.17g", moment);
    (void)snprintf(text[1], sizeof text[1], "%.17g", field);
    params.model_kappa = NAN;
    if (fst_params_set(&params, "bead.moment", text[0], NULL) != FST_OK ||
        fst_params_set(&params, "magnet.b0", text[1], NULL) != FST_OK ||
        fst_model_new(&params, &model, NULL) != FST_OK)
        return NAN;
    const double kappa = fst_model_groups(model).kappa;
    double b[3], g[3][3];
    fst_field(model, fst_measure_field_maximum(paper, dynamics, note, size), 0.0, b, g);
    fst_model_free(model);
    const double strength = sqrt(b[0] * b[0] + b[1] * b[1] + b[2] * b[2]);
    const double pulsation =
        sqrt(moment * field / (params.bead_mass * params.bead_radius * params.bead_radius)) /
        params.friction_gamma;
    (void)snprintf(note, size,
                   "a free bead at the field's maximum swings faster: its field is %.2f B₀ and its inertia "
                   "(2/5)mR², so that the "
                   "square is %.1f κ",
                   strength, 2.5 * strength);
    return pulsation * pulsation / kappa;
}
