/* measures_reading.c - the second readings of claims that can be read in two ways (readings.def). */
#include "paper/measures_parts.h"

#include <stdlib.h>

MEASURE(field_deviation)
{
    NO_NOTE;
    const fst_run_result *result = single(paper, FST_SCAN_FOLD4, dynamics);
    return 100.0 * result->std_b / result->mean_b;
}

static int greater_first(const void *one, const void *other)
{
    const double a = *(const double *)one, b = *(const double *)other;
    return (a < b) - (a > b);
}

/* The share of the time, the largest angles first, that holds half of the mean square of the angle. */
MEASURE(half_of_the_angle)
{
    NO_NOTE;
    const fst_table *table = &fst_paper_single(paper, FST_SCAN_FOLD4, dynamics)->trajectory;
    const double *angle = fst_collected(table, "angle");
    double *squares = malloc((table->rows + 1) * sizeof *squares), all = 0.0, held = 0.0;
    size_t row = 0;
    if (!squares)
        return NAN;
    for (; row < table->rows; ++row) {
        squares[row] = angle[row] * angle[row];
        all += squares[row];
    }
    qsort(squares, table->rows, sizeof *squares, greater_first);
    for (row = 0; row < table->rows && held < 0.5 * all; ++row)
        held += squares[row];
    free(squares);
    return 100.0 * (double)row / (double)table->rows;
}

/* The whole force on the bead, with its upright part, as a mean near the ends and near the middle. */
MEASURE(whole_force_at_ends)
{
    const fst_table *table = &fst_paper_single(paper, FST_SCAN_FOLD15, dynamics)->trajectory;
    const double *x = fst_collected(table, "X"), *y = fst_collected(table, "Y"), *r = fst_collected(table, "r");
    const double *n[3] = {fst_collected(table, "nX"), fst_collected(table, "nY"), fst_collected(table, "nZ")};
    fst_model *model = model_of(paper, FST_SCAN_FOLD15, dynamics);
    double sum[2] = {0.0, 0.0};
    int count[2] = {0, 0};
    if (!model)
        return NAN;
    const fst_groups groups = fst_model_groups(model);
    for (size_t row = 0; row < table->rows; ++row) {
        double b[3], g[3][3], square = 0.0;
        const double along = fabs(x[row]) / r[row];
        const int across = along < sin(FST_PI / 8.0);
        if (!across && along < cos(FST_PI / 8.0))
            continue;
        fst_field(model, x[row], y[row], b, g);
        for (int i = 0; i < 3; ++i) {
            const double force = n[0][row] * g[0][i] + n[1][row] * g[1][i] + n[2][row] * g[2][i];
            square += force * force;
        }
        sum[across] += groups.kappa * groups.eps * groups.eps * sqrt(square);
        ++count[across];
    }
    fst_model_free(model);
    const double ends = sum[0] / count[0], middle = sum[1] / count[1];
    (void)snprintf(note, size,
                   "%.3f near the ends, %.3f near the middle: most of it presses the bead on the plate", ends,
                   middle);
    return 100.0 * (ends / middle - 1.0);
}

/* The square of the radial part. */
MEASURE(orthoradial_energy)
{
    const double share = fst_measure_orthoradial(paper, dynamics, note, size) / 100.0;
    fst_model *model = model_of(paper, FST_SCAN_FOLD4, dynamics);
    double b[3], g[3][3];
    if (!model)
        return NAN;
    const double r = fst_measure_field_maximum(paper, dynamics, note, size);
    fst_field(model, r, 0.0, b, g);
    fst_model_free(model);
    (void)snprintf(note, size,
                   "the same circle; at the maximum itself, r = %.3f, the radial part is %.0f %% of the field",
                   r, 100.0 * fabs(b[0]) / sqrt(b[0] * b[0] + b[1] * b[1] + b[2] * b[2]));
    return 100.0 * share * share;
}

/* The appendix' field of a circle: the mean of B.(sin(Phi) e_alpha + cos(Phi) e_z). */
static double structured_field(const fst_model *model, double r)
{
    enum { ANGLES = 180 };
    double sum = 0.0;
    for (int i = 0; i < ANGLES; ++i) {
        double turn = 2.0 * FST_PI * i / ANGLES, c = cos(turn), s = sin(turn), b[3], g[3][3];
        fst_field(model, r * c, r * s, b, g);
        sum += ((b[1] * c - b[0] * s) * s + b[2] * c) / ANGLES;
    }
    return fabs(sum);
}

MEASURE(force_beyond_own_maximum)
{
    fst_model *model = model_of(paper, FST_SCAN_FOLD4, dynamics);
    if (!model)
        return NAN;
    double greatest = 0.0, best = 0.3;
    for (int i = 0; i <= 240; ++i) {
        const double r = 0.3 + 5e-3 * i, here = structured_field(model, r);
        best = here > greatest ? r : best;
        greatest = fmax(greatest, here);
    }
    int outwards = 0, radii = 0;
    for (double r = best + 0.01; r < 1.505; r += 0.01, ++radii)
        outwards += !(fst_ansatz_force(model, r, -1) < 0.0);
    fst_model_free(model);
    (void)snprintf(note, size, "of %d radii; B̂(r) is greatest near r = %.2f", radii, best);
    return outwards;
}
