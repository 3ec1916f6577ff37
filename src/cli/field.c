/* field.c - festoon field: the magnet's field at a point, or drawn as a map. */
#include <string.h>

#include "cli/command.h"

static const option options[] = {
    SCENE_OPTIONS,
    JSON_OPTION,
    {"at", '\0', "X,Y",
     "the field and its gradient where the bead's centre is: in l, or with units as in 10mm,5mm"},
    {"output", 'o', "FIG", "draw the map of the field to FIG.svg, .pdf or .png"},
    UNITS_OPTION,
    {NULL, '\0', NULL, NULL},
};

/* What is smaller than the rounding errors of the sum over the lines is shown as the zero that it is. */
static double above_rounding(double value, double greatest)
{
    return fabs(value) <= 1e-15 * greatest ? 0.0 : value;
}

static void print_text(FILE *out, const fst_model *model, double x, double y)
{
    double b[3], grad[3][3];
    static const char *const axes[] = {"X", "Y", "Z"};
    const fst_groups groups = fst_model_groups(model);
    const double mm = 1e3 * groups.length_unit;
    fst_field(model, x, y, b, grad);
    double most = 0.0, steepest = 0.0;
    for (int i = 0; i < 3; ++i) {
        most = fmax(most, fabs(b[i]));
        for (int k = 0; k < 3; ++k)
            steepest = fmax(steepest, fabs(grad[i][k]));
    }
    (void)fprintf(
        out,
        "at X = %g, Y = %g l (%g mm, %g mm), magnet's frame, at the height of a bead's centre on the plate\n",
        x, y, mm * x, mm * y);
    (void)fprintf(out, "   %16s   %s\n", "B (B0)", "dB/dX, dB/dY, dB/dZ (B0/l)");
    for (int i = 0; i < 3; ++i)
        (void)fprintf(out, "%s  %16.9g   %16.9g %16.9g %16.9g\n", axes[i], above_rounding(b[i], most),
                      above_rounding(grad[i][0], steepest), above_rounding(grad[i][1], steepest),
                      above_rounding(grad[i][2], steepest));
    (void)fprintf(out, "|B| = %.9g B0\n", sqrt(b[0] * b[0] + b[1] * b[1] + b[2] * b[2]));
    if (!isnan(groups.field_unit))
        (void)fprintf(out, "B0 = %.6g mT\n", 1e3 * groups.field_unit);
}

/* Read X,Y: each a number in l, or a length with its unit. */
static fst_status read_place(const char *text, double length_unit, double at[2], fst_error *error)
{
    const char *comma = strchr(text, ',');
    for (int i = 0; i < 2 && comma; ++i) {
        char word[64];
        const char *from = i ? comma + 1 : text;
        const size_t length = i ? strlen(from) : (size_t)(comma - text);
        fst_error ignored;
        (void)snprintf(word, sizeof word, "%.*s", (int)(length < 63 ? length : 63), from);
        if (fst_parse_value(word, FST_UNIT_NUMBER, &at[i], &ignored) == FST_OK)
            continue;
        if (fst_parse_value(word, FST_UNIT_LENGTH, &at[i], &ignored) != FST_OK)
            comma = NULL;
        at[i] /= length_unit;
    }
    return comma ? FST_OK
                 : fail(error, FST_BAD_INPUT, "--at",
                        "\"%.60s\" must be X,Y: two numbers in l or two lengths with units, as in 0.5,-0.2 or "
                        "10mm,5mm",
                        text);
}

static fst_status print_point(const arguments *given, const fst_params *params, FILE *out, fst_error *error)
{
    double at[2] = {0.0, 0.0};
    fst_model *model = NULL;
    fst_status status = fst_model_new(params, &model, error);
    if (status == FST_OK)
        status = read_place(option_value(given, "at"), fst_model_groups(model).length_unit, at, error);
    static const double farthest = 1e50; /* further away, powers of the distance leave the range of a double */
    if (status == FST_OK && !(fabs(at[0]) < farthest && fabs(at[1]) < farthest))
        status = fail(error, FST_BAD_INPUT, "", "--at %g,%g is out of range: up to %g", at[0], at[1], farthest);
    if (status == FST_OK && option_value(given, "json"))
        status = print_and_free(fst_field_json(model, at[0], at[1]), out, error);
    else if (status == FST_OK)
        print_text(out, model, at[0], at[1]);
    fst_model_free(model);
    return status;
}

static fst_status perform(const arguments *given, FILE *out, fst_error *error)
{
    fst_params params;
    const char *at = option_value(given, "at"), *figure = option_value(given, "output");
    if (!at && !figure)
        return fail(error, FST_BAD_INPUT, "", "say where with --at X,Y, or draw a map with -o FIG.svg");
    if (option_value(given, "json") && !at)
        return fail(error, FST_BAD_INPUT, "", "--json prints the field at a point: give one with --at X,Y");
    if (option_value(given, "units") && !figure)
        return fail(error, FST_BAD_INPUT, "--units", "it concerns the map: give -o FIG.svg");
    fst_shown_units units;
    fst_status status = read_units(given, &units, error);
    if (status == FST_OK)
        status = read_scene(given, operand(given), &params, error);
    if (status == FST_OK && at)
        status = print_point(given, &params, out, error);
    if (status == FST_OK && figure)
        status =
            fst_figure_field(&params, units == FST_SHOWN_AS_GIVEN ? FST_SHOWN_SCALED : units, figure, error);
    if (status == FST_OK && figure)
        tell_written(figure, "");
    return status;
}

const command field_command = {
    .name = "field",
    .synopsis = "[SCENE.yaml] [--set KEY=VALUE]... --at X,Y [--json] | -o FIG.(svg|pdf|png)",
    .summary = "The magnet's field and its gradient at a point, or drawn as a map",
    .details = "Positions without a unit are in l (half length of the magnet's lines); they are in the "
               "magnet's frame, at the height of the\n"
               "bead's centre; fields in B0.\n",
    .options = options,
    .most_operands = 1,
    .perform = perform,
};
