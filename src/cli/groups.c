/* groups.c - printing the scaled groups of a model. */
#include "cli/groups.h"

void print_groups(FILE *out, const fst_groups *groups)
{
    (void)fprintf(out, "  eps = %.6g  h = %.6g  ", groups->eps, groups->h);
    if (groups->shape == FST_MAGNET_LINES)
        (void)fprintf(out, "lambda = %.6g (%d line%s)  ", groups->lambda, groups->lines,
                      groups->lines == 1 ? "" : "s");
    (void)fprintf(out, "kappa = %.6g  omega = %.6g\n", groups->kappa, groups->omega);
    if (groups->a != 0.0 || groups->b != 0.0)
        (void)fprintf(out, "  a = %.6g  b = %.6g\n", groups->a, groups->b);
    (void)fprintf(out, "  units: l = %.6g mm  1/gamma = %.6g ms  mass %.6g g", 1e3 * groups->length_unit,
                  1e3 * groups->time_unit, 1e3 * groups->mass);
    if (!isnan(groups->field_unit))
        (void)fprintf(out, "  B0 = %.6g mT", 1e3 * groups->field_unit);
    (void)fprintf(out, "\n  drive %.6g Hz  weight g = %.6g l gamma^2  plate %.6g l\n",
                  groups->omega / (TWO_PI * groups->time_unit), groups->gravity, groups->plate_radius);
}
