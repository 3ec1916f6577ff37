/* map_write.c - writing a map of a model's field, as map_csv.c reads it. */
#include <festoon/festoon_tools.h>

#include <math.h>
#include <stdio.h>

#include "base/error.h"
#include "base/number.h"
#include "base/watch.h"
#include "host/whole_file.h"

/* A value in SI in thousandths of its unit.  The digits are shifted, so that 0.009 m are 9 mm and not
 * 9.000000000000002. */
static double milli(double value)
{
    char text[40];
    (void)fst_number_write(text, sizeof text, value);
    return fst_number_read(text, fst_number_length(text), 3);
}

static void write_number(FILE *out, double value, const char *behind)
{
    char text[40];
    (void)fst_number_write(text, sizeof text, value);
    (void)fprintf(out, "%s%s", text, behind);
}

/* The errors of B, of a smoothed map alone, in columns that readers of maps pass over. */
static void write_errors(FILE *out, const fst_model *model, double x, double y, double unit, double slope)
{
    double b[3], grad[3][3], force[3], square = 0.0;
    if (!fst_field_error(model, x, y, b, grad, force))
        return;
    for (int k = 0; k < 3; ++k) {
        for (int i = 0; i < 3; ++i)
            square += grad[k][i] * grad[k][i];
        (void)fprintf(out, ",%.3g", b[k] * unit);
    }
    (void)fprintf(out, ",%.3g", slope * sqrt(square / 9.0));
}

static void write_head(FILE *out, const fst_model *model)
{
    const fst_field_map *map = fst_model_map(model);
    const fst_map_fit fit = map ? fst_field_map_describe(map).fit : (fst_map_fit){.charges = 0};
    (void)fprintf(
        out,
        "# The field at the time 0 of all that makes one, on the magnet's axes, z over its reference plane\n");
    if (fit.charges)
        (void)fprintf(
            out,
            "# of %d charges from %.4g mm below a map on, noise %.4g mT, chi^2 of %.0f degrees of freedom: "
            "%.4g each\n",
            fit.charges, 1e3 * fit.depth, 1e3 * fit.noise, fit.free, fit.chi2);
    (void)fprintf(out, "x [mm],y [mm],z [mm],Bx [mT],By [mT],Bz [mT]%s\n",
                  fit.charges ? ",eBx [mT],eBy [mT],eBz [mT],e_slope [mT/mm]" : "");
}

fst_status fst_field_map_write(const char *path, const fst_model *model, double radius, double spacing,
                               const fst_progress *progress, fst_error *error)
{
    const fst_groups g = fst_model_groups(model);
    const double steps = floor(radius / spacing * (1.0 + 1e-12));
    fst_whole_file file;
    if (!(spacing > 0) || !(steps >= 4 && steps <= 2000))
        return fst_fail(
            error, FST_BAD_INPUT, path,
            "a map of %.6g mm about the axis in steps of %.6g mm has %.0f steps each way: 4 to 2000 are "
            "possible",
            1e3 * radius, 1e3 * spacing, steps);
    if (!isfinite(g.field_unit))
        return fst_fail(error, FST_BAD_INPUT, path, "B0 is not known in tesla: give bead.moment or magnet.b0");
    if (steps * spacing > g.map_radius * g.length_unit * (1.0 + 1e-9))
        return fst_fail(error, FST_BAD_INPUT, path, "the magnet's own map ends %.6g mm from the axis",
                        1e3 * g.map_radius * g.length_unit);
    const double edge = steps * spacing / g.length_unit;
    if (isnan(fst_field_height(model, edge, edge)))
        return fst_fail(error, FST_BAD_INPUT, path,
                        "no bead's centre can be %.6g mm from the axis, at the map's corner, in the bowl",
                        1e3 * hypot(edge, edge) * g.length_unit);
    fst_status status = fst_whole_file_open(&file, path, error);
    if (status != FST_OK)
        return status;
    const int most = (int)steps;
    write_head(file.stream, model);
    for (int j = -most; j <= most && status == FST_OK; ++j) {
        for (int i = -most; i <= most; ++i) {
            double b[3], grad[3][3];
            const double x = i * spacing / g.length_unit, y = j * spacing / g.length_unit;
            const double height = fst_field_height(model, x, y) * g.length_unit;
            const double place[3] = {i * milli(spacing), j * milli(spacing), milli(height)};
            fst_field(model, x, y, b, grad);
            if (!isfinite(b[0]) && status == FST_OK)
                status = fst_fail(error, FST_BAD_INPUT, path,
                                  "the map's place %g mm, %g mm at the height %g mm lies in or on a part of "
                                  "the magnet or a wire, where no "
                                  "field is told: choose another height, or a smaller radius",
                                  place[0], place[1], place[2]);
            for (int k = 0; k < 3; ++k)
                write_number(file.stream, place[k], ",");
            for (int k = 0; k < 3; ++k)
                write_number(file.stream, milli(b[k] * g.field_unit), k < 2 ? "," : "");
            write_errors(file.stream, model, x, y, 1e3 * g.field_unit, g.field_unit / g.length_unit);
            (void)fputc('\n', file.stream);
        }
        if (status == FST_OK)
            status = fst_tell(progress, (j + most) / (2.0 * most + 1.0), "writing the map", error);
    }
    if (status == FST_OK)
        return fst_whole_file_commit(&file, error);
    fst_whole_file_discard(&file);
    return status;
}
