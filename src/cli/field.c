/* field.c - festoon field: the magnet's field at a point, or drawn as a map. */
#include <string.h>

#include "cli/command.h"
#include "cli/groups.h"
#include "cli/terminal.h"

static const option options[] = {
    SCENE_OPTIONS,
    JSON_OPTION,
    {"at", '\0', "X,Y", "the field and its gradient at this place: in l, or with units as in 10mm,5mm"},
    {"height", '\0', "H",
     "in l or with a unit, above the magnet's mid-plane (real magnets: reference plane); otherwise at the "
     "bead's centre"},
    {"time", '\0', "T",
     "the field at a point after this time (s), of all that makes one, on the laboratory's axes"},
    {"output", 'o', "FIG", "draw the map of the field to FIG.svg, .pdf or .png"},
    {"quantity", '\0', FST_WORDS(FST_FIELDS),
     "what the map shows: |B| (the default), a component of B, or the force or the load of a bead"},
    {"csv", '\0', "FILE", "write the map of the field to FILE.csv, which magnet.shape: grid reads back"},
    {"radius", '\0', "R", "how far from the axis the map of --csv goes along X and Y (60mm)"},
    {"spacing", '\0', "D", "from one sample of --csv to the next (1mm)"},
    {"smooth", '\0', NULL,
     "the field of charges fitted to the scene's noisy map (magnet.shape: grid), with errors"},
    {"noise", '\0', "B", "of a component of that map, as in 0.05mT; --smooth estimates it unless given"},
    {"draws", '\0', "N",
     "beside FILE.csv of --smooth also write FILE-1.csv to FILE-N.csv, fields drawn from all that the noise "
     "allows"},
    {"probe", '\0', NULL, "--smooth also fits how the probe's axes are turned, and their offsets"},
    UNITS_JSON_OPTION,
    LOOK_OPTIONS,
    {NULL, '\0', NULL, NULL},
};

/* What is smaller than the rounding errors of the sum over the lines is shown as the zero that it is. */
static double above_rounding(double value, double greatest)
{
    return fabs(value) <= 1e-15 * greatest ? 0.0 : value;
}

/* What the magnet does there to a bead that lies still, its moment along the field. */
static void print_pull(FILE *out, const fst_model *model, const double at[2], fst_shown_units units,
                       const fst_scales *scales)
{
    double force[3], load;
    const char *name;
    const double unit = fst_unit_shown("l gamma^2", units, scales, &name);
    double b[3], grad[3][3], error[3];
    fst_field_pull(model, at[0], at[1], force, &load);
    const double most = fmax(fabs(force[0]), fmax(fabs(force[1]), fabs(force[2])));
    (void)fprintf(out,
                  "on a bead with its moment along B: force %.9g %.9g %.9g %s, load on the plate %.9g %s\n",
                  unit * above_rounding(force[0], most), unit * above_rounding(force[1], most),
                  unit * above_rounding(force[2], most), name, unit * load, name);
    if (fst_field_error(model, at[0], at[1], b, grad, error))
        (void)fprintf(out, "+- force %.3g %.3g %.3g %s, load %.3g %s\n", unit * error[0], unit * error[1],
                      unit * error[2], name, unit * error[2], name);
}

/* The errors of a smoothed map's field. */
static void print_errors(FILE *out, const fst_model *model, const double at[2], double field, double slope)
{
    double b[3], grad[3][3], force[3];
    if (!fst_field_error(model, at[0], at[1], b, grad, force))
        return;
    for (int i = 0; i < 3; ++i)
        (void)fprintf(out, "+- %c%14.3g   %16.3g %16.3g %16.3g\n", "XYZ"[i], field * b[i], slope * grad[i][0],
                      slope * grad[i][1], slope * grad[i][2]);
}

/* `whose` height it is, told in mm; NULL: of a bead on the flat plate. */
static void print_text(FILE *out, const fst_model *model, const double at[2], const char *whose,
                       const char *frame, fst_shown_units units)
{
    double b[3], grad[3][3];
    static const char *const axes[] = {"X", "Y", "Z"};
    const fst_groups groups = fst_model_groups(model);
    const fst_scales scales = {groups.length_unit, groups.time_unit, groups.mass, groups.field_unit};
    const char *tesla, *metre;
    const double field = fst_unit_shown("B0", units, &scales, &tesla);
    const double slope = field / fst_unit_shown("l", units, &scales, &metre);
    const double mm = 1e3 * groups.length_unit;
    fst_field(model, at[0], at[1], b, grad);
    double most = 0.0, steepest = 0.0;
    for (int i = 0; i < 3; ++i) {
        most = fmax(most, fabs(b[i]));
        for (int k = 0; k < 3; ++k)
            steepest = fmax(steepest, fabs(grad[i][k]));
    }
    (void)fprintf(out, "at X = %g, Y = %g l (%g mm, %g mm), %s, at the height ", at[0], at[1], mm * at[0],
                  mm * at[1], frame);
    if (whose)
        (void)fprintf(out, "of %s%g mm over the magnet's %s\n", whose,
                      mm * fst_field_height(model, at[0], at[1]),
                      groups.shape == FST_MAGNET_LINES ? "mid-plane" : "reference plane");
    else
        (void)fprintf(out, "of a bead's centre on the plate\n");
    (void)fprintf(out, "   %13s (%s)   dB/dX, dB/dY, dB/dZ (%s/%s)\n", "B", tesla, tesla, metre);
    for (int i = 0; i < 3; ++i)
        (void)fprintf(out, "%s  %16.9g   %16.9g %16.9g %16.9g\n", axes[i], field * above_rounding(b[i], most),
                      slope * above_rounding(grad[i][0], steepest),
                      slope * above_rounding(grad[i][1], steepest),
                      slope * above_rounding(grad[i][2], steepest));
    print_errors(out, model, at, field, slope);
    (void)fprintf(out, "|B| = %.9g %s\n", field * sqrt(b[0] * b[0] + b[1] * b[1] + b[2] * b[2]), tesla);
    print_pull(out, model, at, units, &scales);
    if (!isnan(groups.field_unit))
        (void)fprintf(out, "B0 = %.6g mT\n", 1e3 * groups.field_unit);
    else if (units == FST_SHOWN_LAB || units == FST_SHOWN_SI)
        (void)fprintf(out, "B0 is not known in tesla: give bead.moment or magnet.b0\n");
}

/* A number in l, or a length with its unit. */
static fst_status read_length(const char *text, double length_unit, double *value)
{
    fst_error ignored;
    if (fst_parse_value(text, FST_UNIT_NUMBER, value, &ignored) == FST_OK)
        return FST_OK;
    const fst_status status = fst_parse_value(text, FST_UNIT_LENGTH, value, &ignored);
    *value /= length_unit;
    return status;
}

/* Read X,Y: each a number in l, or a length with its unit. */
static fst_status read_place(const char *text, double length_unit, double at[2], fst_error *error)
{
    const char *comma = strchr(text, ',');
    for (int i = 0; i < 2 && comma; ++i) {
        char word[64];
        const char *from = i ? comma + 1 : text;
        const size_t length = i ? strlen(from) : (size_t)(comma - text);
        (void)snprintf(word, sizeof word, "%.*s", (int)(length < 63 ? length : 63), from);
        if (read_length(word, length_unit, &at[i]) != FST_OK)
            comma = NULL;
    }
    return comma ? FST_OK
                 : fail(error, FST_BAD_INPUT, "--at",
                        "\"%.60s\" must be X,Y: two numbers in l or two lengths with units, as in 0.5,-0.2 or "
                        "10mm,5mm",
                        text);
}

static const double farthest = 1e50; /* further away, powers of the distance leave the range of a double */

/* --height in l; NAN where it is not given.  Real magnets may be asked below their reference plane too. */
static fst_status read_height(const char *height, const fst_params *params, double *h, fst_error *error)
{
    *h = NAN;
    if (!height)
        return FST_OK;
    const int real = fst_magnet_in_tesla(params);
    if (read_length(height, params->magnet_half_length, h) != FST_OK || !(*h > 0 || real) || !isfinite(*h))
        return fail(
            error, FST_BAD_INPUT, "--height",
            "\"%.60s\" must be a height over the magnet's %s: a %snumber in l or a length with its unit, as in "
            "18.7mm",
            height, real ? "reference plane" : "mid-plane", real ? "" : "positive ");
    return fabs(*h) < farthest ? FST_OK
                               : fail(error, FST_BAD_INPUT, "--height", "\"%.60s\" is out of range: up to %g l",
                                      height, farthest);
}

static int is_known(const fst_model *model, const double at[2])
{
    double b[3], grad[3][3];
    fst_field(model, at[0], at[1], b, grad);
    return isfinite(b[0]);
}

static const char *why_unknown(const fst_model *model, const double at[2])
{
    if (isnan(fst_field_height(model, at[0], at[1])))
        return "where no bead's centre can be in the bowl: give --height";
    return fst_model_map(model) ? "beyond the map of magnet.file, where the field is not known"
                                : "on a wire or a line of the magnet, where the field is not finite";
}

/* There is no field to tell in or on a part of the magnet. */
static fst_status check_outside(const fst_params *params, const fst_model *model, const double at[2],
                                fst_error *error)
{
    const double mm = 1e3 * params->magnet_half_length, height = fst_field_height(model, at[0], at[1]);
    const int part = fst_field_inside(model, at[0], at[1]);
    if (part < 0)
        return FST_OK;
    char key[48], kind[32];
    (void)snprintf(key, sizeof key, "magnet.parts[%d].kind", part);
    (void)fst_params_get(params, fst_param_find(key), kind, sizeof kind);
    return fail(
        error, FST_BAD_INPUT, "--at",
        "the place %g mm, %g mm at the height %g mm lies in or on magnet.parts[%d], a %s: the field is known "
        "outside of the magnet",
        mm * at[0], mm * at[1], mm * height, part, kind);
}

static fst_status print_point(const arguments *given, const fst_params *params, double h, fst_shown_units units,
                              FILE *out, fst_error *error)
{
    const char *time = option_value(given, "time");
    const int in_si = fst_key_of_surroundings(params) || time;
    char frame[96];
    double at[2] = {0.0, 0.0}, seconds = 0.0;
    fst_model *model = NULL;
    const int shape = option_value(given, "height") ? FST_PLATE_NONE : params->plate_shape;
    const char *whose = shape == FST_PLATE_FLAT   ? NULL
                        : shape == FST_PLATE_BOWL ? "a bead's centre in the bowl, "
                                                  : "";
    fst_status status = fst_field_model_new(params, h, &model, error);
    if (status == FST_OK)
        status = read_place(option_value(given, "at"), fst_model_groups(model).length_unit, at, error);
    if (status == FST_OK && !(fabs(at[0]) < farthest && fabs(at[1]) < farthest))
        status = fail(error, FST_BAD_INPUT, "", "--at %g,%g is out of range: up to %g", at[0], at[1], farthest);
    if (status == FST_OK && time &&
        (fst_parse_value(time, FST_UNIT_TIME, &seconds, error) != FST_OK || !(fabs(seconds) < 1e9)))
        status = fail(error, FST_BAD_INPUT, "--time", "\"%.40s\" must be a time, as in 0.2 or 20ms", time);
    if (status == FST_OK && time)
        status = fst_field_model_at(model, seconds * params->friction_gamma, error);
    if (status == FST_OK)
        status = check_outside(params, model, at, error);
    if (status == FST_OK && !is_known(model, at))
        status = fail(error, FST_BAD_INPUT, "--at", "%g,%g lies %s", at[0], at[1], why_unknown(model, at));
    if (status == FST_OK && option_value(given, "json"))
        status = print_and_free(fst_field_json(model, at[0], at[1], in_si ? FST_SHOWN_SI : units), out, error);
    (void)snprintf(frame, sizeof frame,
                   in_si ? "at the time %g s of all that makes a field, laboratory's axes" : "magnet's frame",
                   seconds);
    if (status == FST_OK && !option_value(given, "json"))
        print_text(out, model, at, whose, frame, units);
    fst_model_free(model);
    return status;
}

/* The length of an option in m, or the usual one. */
static fst_status read_metres(const arguments *given, const char *name, double length_unit, double *value,
                              fst_error *error)
{
    const char *text = option_value(given, name);
    if (!text)
        return FST_OK;
    if (read_length(text, length_unit, value) != FST_OK || !(*value > 0) || !isfinite(*value))
        return fail(error, FST_BAD_INPUT, name,
                    "\"%.60s\" must be a positive length: with its unit as in 1mm, or a number in l", text);
    *value *= length_unit;
    return FST_OK;
}

static fst_status write_map(const arguments *given, const fst_params *params, double height, const char *path,
                            fst_error *error)
{
    double radius = 0.06, spacing = 1e-3;
    fst_model *model = NULL;
    if (option_value(given, "smooth")) /* as far as the map goes */
        radius = fst_field_map_describe(params->magnet_map).radius;
    fst_status status = read_metres(given, "radius", params->magnet_half_length, &radius, error);
    if (status == FST_OK)
        status = read_metres(given, "spacing", params->magnet_half_length, &spacing, error);
    if (status == FST_OK)
        status = fst_field_model_new(params, height, &model, error);
    if (status == FST_OK) {
        progress_line line;
        const fst_progress progress = {&line, progress_tell};
        progress_begin(&line);
        status = fst_field_map_write(path, model, radius, spacing, &progress, error);
        progress_end(&line);
    }
    fst_model_free(model);
    if (status == FST_OK)
        tell_written(path, "");
    return status;
}

/* --draws: FILE-1.csv and so on beside FILE.csv, each a map over which runs show what the noise does to them. */
static void name_draw(const char *path, int draw, char name[SHOWN_SIZE])
{
    const size_t length = strlen(path), ending = ends_in(path, ".csv") ? 4 : 0;
    (void)snprintf(name, SHOWN_SIZE, "%.*s-%d.csv", (int)(length - ending), path, draw);
}

/* How many they are.  None of them may replace the measured map. */
static fst_status read_draws(const arguments *given, const fst_params *params, const char *path, double *draws,
                             fst_error *error)
{
    char name[SHOWN_SIZE];
    const value_option row = {"draws", VALUE_WHOLE, draws, 1, 10000};
    fst_status status = read_values(given, &row, 1, error);
    for (int i = 1; i <= *draws && status == FST_OK; ++i) {
        name_draw(path, i, name);
        status = check_spared("--draws", name, params->magnet_file, error);
    }
    return status;
}

static fst_status write_draws(const arguments *given, fst_params *params, double height, const char *path,
                              double draws, const fst_field_map *smooth, fst_error *error)
{
    char name[SHOWN_SIZE];
    fst_status status = FST_OK;
    for (int i = 1; i <= draws && status == FST_OK; ++i) {
        fst_field_map *drawn = NULL;
        name_draw(path, i, name);
        status = fst_field_map_draw(smooth, (uint64_t)i, NULL, &drawn, error);
        params->magnet_map = drawn;
        if (status == FST_OK)
            status = write_map(given, params, height, name, error);
        fst_field_map_free(drawn);
    }
    params->magnet_map = smooth;
    return status;
}

/* How well charges fit a map. */
static void print_fit(FILE *out, const fst_map_fit *fit)
{
    char sentence[256];
    const int wrong = fit->verdict == FST_NOISE_TOO_SMALL || fit->verdict == FST_NOISE_TOO_LARGE;
    fst_map_fit_sentence(fit, sentence, sizeof sentence);
    const char *advice = strstr(sentence, "probe") ? " (--probe fits a turned one)"
                         : wrong                   ? " (leave --noise away: the fit then finds the likeliest)"
                                                   : "";
    (void)fprintf(
        out,
        "%d charges from %.4g mm below the map on; what is left: %.4g mT rms; noise %.4g mT; chi^2 of %.0f "
        "degrees of freedom: %.4g each\n",
        fit->charges, 1e3 * fit->depth, 1e3 * fit->rms, 1e3 * fit->noise, fit->free, fit->chi2);
    if (sentence[0])
        (void)fprintf(out, "%s%s\n", sentence, advice);
    for (int i = 0; i < 3 && fit->turned_error[0] > 0; ++i)
        (void)fprintf(out, "probe, axis %c: turned by %.4f +- %.4f deg, offset %.4g +- %.2g mT\n", "xyz"[i],
                      360.0 / TWO_PI * fit->turned[i], 360.0 / TWO_PI * fit->turned_error[i],
                      1e3 * fit->offset[i], 1e3 * fit->offset_error[i]);
}

/* --smooth: the charges' map in place of the scene's. */
static fst_status smooth_map(const arguments *given, fst_params *params, double height, fst_field_map **smooth,
                             fst_error *error)
{
    const double usual = params->magnet_depth + params->bead_radius;
    fst_smoothing how = {.noise = NAN, .lies = usual, .probe = option_value(given, "probe") != NULL};
    how.height = isnan(height) ? usual : height * params->magnet_half_length;
    const char *noise = option_value(given, "noise");
    if (!params->magnet_map)
        return fail(error, FST_BAD_INPUT, "--smooth", "the scene has no map: it is for magnet.shape: grid");
    fst_status status = noise ? fst_parse_value(noise, FST_UNIT_FIELD, &how.noise, error) : FST_OK;
    if (status != FST_OK)
        return fail(error, FST_BAD_INPUT, "--noise", "\"%.40s\" must be a field with its unit, as in 0.05mT",
                    noise);
    progress_line line;
    const fst_progress progress = {&line, progress_tell};
    progress_begin(&line);
    status = fst_field_map_smooth(params->magnet_map, &how, &progress, smooth, error);
    progress_end(&line);
    params->magnet_map = status == FST_OK ? *smooth : params->magnet_map;
    return status;
}

/* Options that ask for what others must give. */
static fst_status check_asked(const arguments *given, const char *at, const char *figure, const char *csv,
                              fst_error *error)
{
    if (!at && !figure && !csv)
        return fail(error, FST_BAD_INPUT, "",
                    "say where with --at X,Y, draw a map with -o FIG.svg, or write one with --csv FILE.csv");
    if (option_value(given, "time") && (!at || figure || csv))
        return fail(error, FST_BAD_INPUT, "--time",
                    "it is the time of a field at a point, with --at X,Y; figures and tables are those of the "
                    "time 0: leave %s",
                    !at      ? "it out, or give a point"
                    : figure ? "-o or --time out"
                             : "--csv or --time out");
    if (option_value(given, "json") && !at)
        return fail(error, FST_BAD_INPUT, "", "--json prints the field at a point: give one with --at X,Y");
    if ((option_value(given, "radius") || option_value(given, "spacing")) && !csv)
        return fail(error, FST_BAD_INPUT, "--csv",
                    "--radius and --spacing are those of a written map: give --csv");
    if (option_value(given, "quantity") && !figure)
        return fail(error, FST_BAD_INPUT, "--quantity", "it is that of a map: give -o FIG.svg");
    if ((option_value(given, "noise") || option_value(given, "probe") || option_value(given, "draws")) &&
        !option_value(given, "smooth"))
        return fail(error, FST_BAD_INPUT, "--smooth",
                    "--noise, --probe and --draws are of a fit to a map: give --smooth");
    if (option_value(given, "draws") && !csv)
        return fail(error, FST_BAD_INPUT, "--draws", "drawn fields are written: give --csv FILE.csv");
    return FST_OK;
}

static fst_status perform(const arguments *given, FILE *out, fst_error *error)
{
    fst_params params;
    fst_field_map *smooth = NULL;
    const char *at = option_value(given, "at"), *figure = option_value(given, "output");
    const char *csv = option_value(given, "csv");
    fst_shown_units units = FST_SHOWN_SCALED;
    int quantity = FST_FIELD_STRENGTH;
    double draws = 0.0;
    fst_field_options map = fst_default_field_options();
    fst_status status = check_asked(given, at, figure, csv, error);
    if (status == FST_OK)
        status = read_units(given, &units, error);
    if (status == FST_OK)
        status = read_choice("--quantity", option_value(given, "quantity"), "quantity", FST_WORDS(FST_FIELDS),
                             &quantity, error);
    map.quantity = (fst_field_quantity)quantity;
    if (status == FST_OK)
        status = read_scene(given, operand(given), &params, error);
    if (status == FST_OK && option_value(given, "draws"))
        status = read_draws(given, &params, csv, &draws, error);
    if (status == FST_OK)
        status = read_height(option_value(given, "height"), &params, &map.height, error);
    if (status == FST_OK && option_value(given, "smooth"))
        status = smooth_map(given, &params, map.height, &smooth, error);
    if (status == FST_OK && smooth && !option_value(given, "json")) {
        const fst_map_fit fit = fst_field_map_describe(smooth).fit;
        print_fit(out, &fit);
    }
    if (units == FST_SHOWN_AS_GIVEN)
        units = FST_SHOWN_SCALED;
    if (status == FST_OK && at)
        status = print_point(given, &params, map.height, units, out, error);
    map.units = units;
    if (status == FST_OK && figure)
        status = read_look(given, &map.title, map.size, error);
    if (status == FST_OK && figure)
        status = fst_figure_field_map(&params, &map, figure, error);
    if (status == FST_OK && figure)
        tell_written(figure, "");
    if (status == FST_OK && csv)
        status = write_map(given, &params, map.height, csv, error);
    if (status == FST_OK)
        status = write_draws(given, &params, map.height, csv, draws, smooth, error);
    fst_field_map_free(smooth);
    return status;
}

const command field_command = {
    .name = "field",
    .synopsis = "[SCENE.yaml] --at X,Y | -o FIG | --csv FILE [options]",
    .summary = "The magnet's field and its gradient at a point, or drawn as a map",
    .details = "Places without a unit are in l (half the length of the magnet's lines), in the magnet's frame. "
               " Parts that "
               "stand still,\n"
               "coils, field.uniform and a wave count as they are at the time 0, on the same axes.  Fields are "
               "in B0,\n"
               "with --units lab or si in mT or tesla, where magnet.b0 or bead.moment gives B0 (real magnets "
               "always do); --json\n"
               "then has both.  Force and load are those of a bead at rest, its moment along B.\n",
    .options = options,
    .most_operands = 1,
    .perform = perform,
};
