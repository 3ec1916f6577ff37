/* fit.c - festoon fit: the parameters of the model from a table of measured points. */
#include <stdlib.h>
#include <string.h>

#include "cli/command.h"
#include "cli/terminal.h"

static const option options[] = {
    SCENE_OPTIONS,
    JSON_OPTION,
    {"free", '\0', "KEY,KEY", "the parameters that are sought, such as model.kappa,friction.gamma"},
    {"given", '\0', "KEY=V+-S",
     "what is known otherwise, such as \"magnet.depth=16.2+-0.2 mm\" (again for more keys)"},
    {"output", 'o', "FIG.svg", "draw the points over the model's curves (svg, pdf, png)"},
    {"rivals", '\0', NULL, "fit the other friction law and the other dynamics too, and compare them (AICc)"},
    {"bootstrap", '\0', "N",
     "draw the numbers anew N times, and fit each time: errors from the points themselves"},
    {"track", '\0', "TRACK.csv",
     "fit the places of one film, not a table; --drive, --exposure, --fps, --from, --to and --scale go with "
     "it"},
    {"drive", '\0', "F",
     "how often the magnet turned, as 10.7Hz, with a minus where it turned clockwise in the film"},
    {"exposure", '\0', "T[+-S]", "how long a frame was exposed, as 2ms, or 2+-0.5ms to seek it too"},
    TRACK_OPTIONS,
    {NULL, '\0', NULL, NULL},
};

enum { MOST_KEYS = 64 };

/* The words of the options, cut at commas. */
typedef struct wishes {
    char text[2048];
    const char *keys[MOST_KEYS], *given[MOST_KEYS];
} wishes;

/* The lists --free and --given; `how` points into `out`. */
static fst_status read_wishes(const arguments *given, wishes *out, fst_fit_options *how, fst_error *error)
{
    const char *text = option_value(given, "free");
    how->free = out->keys;
    how->given = out->given;
    how->free_count = how->given_count = 0;
    if (!text)
        return fail(error, FST_BAD_INPUT, "",
                    "say which parameters are sought: --free model.kappa,friction.gamma");
    if (strlen(text) >= sizeof out->text)
        return fail(error, FST_BAD_INPUT, "--free", "this list is too long");
    (void)snprintf(out->text, sizeof out->text, "%s", text);
    for (char *word = out->text; word;) {
        char *comma = strchr(word, ',');
        if (comma)
            *comma++ = '\0';
        word += strspn(word, " ");
        word[strcspn(word, " ")] = '\0';
        if (!word[0])
            return fail(error, FST_BAD_INPUT, "--free",
                        "\"%.60s\" must be keys separated by commas, as in model.kappa,friction.gamma", text);
        if (how->free_count == MOST_KEYS)
            return fail(error, FST_BAD_INPUT, "--free", "there are more than %d keys", MOST_KEYS);
        out->keys[how->free_count++] = word;
        word = comma;
    }
    for (int i = 0; i < given->option_count; ++i)
        if (strcmp(given->options[i].row->name, "given") == 0) {
            if (how->given_count == MOST_KEYS)
                return fail(error, FST_BAD_INPUT, "--given", "there are more than %d keys", MOST_KEYS);
            out->given[how->given_count++] = given->options[i].value;
        }
    return FST_OK;
}

/* ------------------------------------------------------------------ the report */

/* A value with its error in the unit that people use. */
static void print_value(FILE *out, double value, double error, fst_unit unit)
{
    int power;
    const char *name = fst_unit_customary(unit, &power);
    const double factor = pow(10.0, power);
    const int digits = isfinite(error) && error > 0 ? (int)fmax(0.0, 1.0 - floor(log10(factor * error))) : 6;
    (void)fprintf(out, "%.*f", digits < 12 ? digits : 12, factor * value);
    if (isfinite(error))
        (void)fprintf(out, " +- %.*f", digits < 12 ? digits : 12, factor * error);
    if (strcmp(name, "1") != 0)
        (void)fprintf(out, " %s", name);
    if (isfinite(error) && value != 0.0)
        (void)fprintf(out, "  (%.2g %%)", 100.0 * fabs(error / value));
}

static void print_end(FILE *out, double value, fst_unit unit)
{
    int power;
    (void)fst_unit_customary(unit, &power);
    if (isfinite(value))
        (void)fprintf(out, "%.5g", pow(10.0, power) * value);
    else
        (void)fprintf(out, "not found");
}

static void print_parameters(FILE *out, const fst_fit *fit)
{
    for (int i = 0; i < fit->count; ++i) {
        const fst_fit_parameter *p = &fit->parameters[i];
        (void)fprintf(out, "  %-22s ", p->key);
        print_value(out, p->value, p->error, p->unit);
        (void)fprintf(out, "\n  %-22s   68 %% interval from ", "");
        print_end(out, p->interval[0], p->unit);
        (void)fprintf(out, " to ");
        print_end(out, p->interval[1], p->unit);
        if (isfinite(p->bootstrap_error))
            (void)fprintf(out, "; bootstrap +- %.3g",
                          p->bootstrap_error * (p->unit == FST_UNIT_LENGTH ? 1e3 : 1.0));
        if (isfinite(p->prior[0]))
            (void)fprintf(out, "; given");
        (void)fprintf(out, "\n");
    }
    if (isnan(fit->kappa_gamma2))
        return;
    const double relative = fit->kappa_gamma2_error / fit->kappa_gamma2;
    (void)fprintf(out, "  %-22s %.6g +- %.2g 1/s^2  (%.2g %%)\n", "kappa gamma^2", fit->kappa_gamma2,
                  fit->kappa_gamma2_error, 100.0 * relative);
}

static void print_correlation(FILE *out, const fst_fit *fit)
{
    if (fit->count < 2)
        return;
    (void)fprintf(out, "\ncorrelation\n");
    for (int i = 0; i < fit->count; ++i) {
        (void)fprintf(out, "  %-22s", fit->parameters[i].key);
        for (int j = 0; j <= i; ++j)
            (void)fprintf(out, " %6.3f", fit->correlation[i][j]);
        (void)fprintf(out, "\n");
    }
}

static void print_outliers(FILE *out, const fst_fit *fit)
{
    if (fit->outlier_count)
        (void)fprintf(out, "\nleft out as outliers\n");
    for (size_t i = 0; i < fit->outlier_count; ++i) {
        const fst_fit_outlier *o = &fit->outliers[i];
        int power;
        const char *unit = fst_unit_customary(fst_measured_unit(o->what), &power);
        const double factor = pow(10.0, power);
        (void)fprintf(
            out,
            "  line %d, column %d (%s): %.6g %s, where %.6g were to be expected: %.1f standard deviations\n",
            o->line, o->column, fst_measured_name(o->what), factor * o->value, unit, factor * o->expected,
            fabs(o->deviation));
    }
}

static void print_choice(FILE *out, const char *key, int index)
{
    size_t length;
    const char *name = fst_name_at(fst_param_at(fst_param_find(key))->names, index, &length);
    (void)fprintf(out, "  %-12.*s", (int)length, name);
}

static void print_rivals(FILE *out, const fst_fit *fit)
{
    double least = INFINITY;
    for (int i = 0; i < fit->rival_count; ++i)
        if (fit->rivals[i].fitted)
            least = fmin(least, fit->rivals[i].aicc);
    if (fit->rival_count)
        (void)fprintf(out, "\n  %-12s  %-12s%12s %12s  (AICc above the best; 10 and more is decisive)\n",
                      "friction", "dynamics", "chi^2", "AICc");
    for (int i = 0; i < fit->rival_count; ++i) {
        const fst_fit_rival *r = &fit->rivals[i];
        print_choice(out, "friction.law", r->law);
        print_choice(out, "model.dynamics", r->dynamics);
        if (r->fitted)
            (void)fprintf(out, "%12.5g %12.5g\n", r->chi2, r->aicc - least);
        else
            (void)fprintf(out, "%12s\n", "no such fit");
    }
}

/* How the magnet of a film turned. */
static void print_drive(FILE *out, const fst_fit *fit)
{
    if (fit->drive == 0.0)
        return;
    (void)fprintf(out, "  %-22s ", "drive");
    print_value(out, fit->drive, fit->drive_error, FST_UNIT_FREQUENCY);
    if (isfinite(fit->drive_given))
        (void)fprintf(out, ", sought from the %.6g Hz given\n", fit->drive_given);
    else
        (void)fprintf(out, ", as the track told it\n");
}

static void print_fit(FILE *out, const fst_fit *fit)
{
    (void)fprintf(out, "%d numbers, chi^2 = %.5g with %d degrees of freedom\n\n", fit->points, fit->chi2,
                  fit->dof);
    print_parameters(out, fit);
    print_drive(out, fit);
    print_correlation(out, fit);
    print_outliers(out, fit);
    print_rivals(out, fit);
    (void)fprintf(out, "\n%s\n", fit->weakest);
    for (const char *at = fit->remarks; *at;) {
        const size_t length = strcspn(at, "\n");
        (void)fprintf(out, "note: %.*s\n", (int)length, at);
        at += length + (at[length] == '\n');
    }
}

/* ------------------------------------------------------------------ doing it */

/* Options of the other kind of data would be without effect. */
static fst_status check_kind(const arguments *given, const char *const *others, const char *these,
                             const char *data, fst_error *error)
{
    for (; *others; ++others)
        if (option_value(given, *others))
            return fail(error, FST_BAD_INPUT, "", "--%s belongs to %s; this is a %s", *others, these, data);
    return FST_OK;
}

static fst_status fit_table(const arguments *given, const char *table, const fst_params *params, FILE *out,
                            fst_error *error)
{
    static wishes wanted;
    fst_points points;
    fst_fit fit;
    fst_fit_options how = fst_default_fit_options();
    const char *figure = option_value(given, "output");
    static const char *const of_tracks[] = {"drive", "exposure", "fps", "from", "to", "scale", NULL};
    fst_status status = check_kind(given, of_tracks, "tracks", "table", error);
    if (status == FST_OK)
        status = read_wishes(given, &wanted, &how, error);
    double bootstrap = 0.0;
    const value_option row = {"bootstrap", VALUE_WHOLE, &bootstrap, 10, 100000};
    if (status == FST_OK)
        status = read_values(given, &row, 1, error);
    how.bootstrap = (int)bootstrap;
    if (status == FST_OK)
        status = fst_points_read(table, &points, error);
    if (status != FST_OK)
        return status;
    progress_line line;
    const fst_progress progress = {&line, progress_tell};
    how.rivals = option_value(given, "rivals") != NULL;
    how.curve_points = figure ? 81 : 0;
    how.progress = &progress;
    progress_begin(&line);
    status = fst_fit_points(params, &points, &how, &fit, error);
    progress_end(&line);
    if (status == FST_OK && figure)
        status = fst_figure_fit(&points, &fit, figure, error);
    if (status == FST_OK && figure)
        tell_written(figure, "");
    if (status == FST_OK && option_value(given, "json"))
        status = print_and_free(fst_fit_json(params, &fit), out, error);
    else if (status == FST_OK)
        print_fit(out, &fit);
    fst_fit_free(&fit);
    fst_points_free(&points);
    return status;
}

/* "2 ms" or "2+-0.5 ms"; seconds and milliseconds. */
static fst_status read_exposure(const char *text, fst_fit_options *how, fst_error *error)
{
    char *end, *unit;
    how->exposure = strtod(text, &end);
    how->exposure_error = 0.0;
    if (end != text && strncmp(end, "+-", 2) == 0) {
        const char *from = end + 2;
        how->exposure_error = strtod(from, &end);
        if (end == from || !(how->exposure_error > 0.0))
            end = (char *)(uintptr_t)text;
    }
    unit = end + strspn(end, " ");
    const double factor = strcmp(unit, "ms") == 0 ? 1e-3 : strcmp(unit, "s") == 0 ? 1.0 : 0.0;
    if (end == text || factor == 0.0 || !(how->exposure >= 0.0) || !(how->exposure * factor < 1.0))
        return fail(error, FST_BAD_INPUT, "--exposure",
                    "\"%.40s\" must be a time such as \"2 ms\" or \"2+-0.5 ms\"", text);
    how->exposure *= factor;
    how->exposure_error *= factor;
    return FST_OK;
}

static fst_status read_track_wishes(const arguments *given, fst_fit_options *how, fst_track_options *file,
                                    char unit[FST_LENGTH_UNIT_SIZE], fst_error *error)
{
    const char *exposure = option_value(given, "exposure"), *scale = option_value(given, "scale");
    const value_option rows[] = {{"drive", FST_UNIT_FREQUENCY, &how->drive, 0, 0},
                                 {"fps", FST_UNIT_NUMBER, &file->fps, 0, 0},
                                 {"from", VALUE_WHOLE, &file->from, 0, MOST_FRAMES},
                                 {"to", VALUE_WHOLE, &file->to, 0, MOST_FRAMES}};
    fst_status status = exposure ? read_exposure(exposure, how, error) : FST_OK;
    if (status == FST_OK && scale)
        status = read_track_scale(scale, file, unit, error);
    return status == FST_OK ? read_values(given, rows, sizeof rows / sizeof *rows, error) : status;
}

/* The track of a film of one bead: others would pull at it, and the model has one. */
static fst_status read_one_bead(const char *path, const fst_track_options *how, fst_track *track,
                                char **understood, fst_error *error)
{
    fst_track tracks[FST_TRACKED_BEADS];
    int count;
    const fst_status status = fst_tracks_read(path, how, tracks, &count, understood, error);
    if (status != FST_OK)
        return status;
    *track = tracks[0];
    for (int i = 1; i < count; ++i)
        fst_track_free(&tracks[i]);
    if (count == 1)
        return FST_OK;
    fst_track_free(track);
    return fail(error, FST_BAD_INPUT, path, "the film has %d beads, which pull at each other: a fit is of one",
                count);
}

static fst_status fit_film(const arguments *given, const fst_params *params, FILE *out, fst_error *error)
{
    static const char *const of_tables[] = {"output", "rivals", "bootstrap", NULL};
    static wishes wanted;
    fst_track track = {0};
    fst_fit fit;
    char *understood = NULL, unit[FST_LENGTH_UNIT_SIZE];
    fst_fit_options how = fst_default_fit_options();
    fst_track_options file = fst_default_track_options();
    fst_status status = check_kind(given, of_tables, "tables", "track", error);
    if (status == FST_OK)
        status = read_wishes(given, &wanted, &how, error);
    if (status == FST_OK)
        status = read_track_wishes(given, &how, &file, unit, error);
    if (status == FST_OK)
        status = read_one_bead(option_value(given, "track"), &file, &track, &understood, error);
    if (status == FST_OK && understood)
        (void)fprintf(stderr, "%s\n", understood);
    progress_line line;
    const fst_progress progress = {&line, progress_tell};
    how.progress = &progress;
    if (status == FST_OK) {
        progress_begin(&line);
        status = fst_fit_track(params, &track, &how, &fit, error);
        progress_end(&line);
    }
    free(understood);
    fst_track_free(&track);
    if (status != FST_OK)
        return status;
    if (option_value(given, "json"))
        status = print_and_free(fst_fit_json(params, &fit), out, error);
    else
        print_fit(out, &fit);
    fst_fit_free(&fit);
    return status;
}

static fst_status perform(const arguments *given, FILE *out, fst_error *error)
{
    const char *table = NULL, *scene = NULL;
    fst_params params;
    for (int i = 0; i < given->operand_count; ++i) {
        const char **place =
            ends_in(given->operands[i], ".yaml") || ends_in(given->operands[i], ".yml") ? &scene : &table;
        if (*place)
            return fail(error, FST_BAD_INPUT, given->operands[i], "there is a %s already",
                        place == &scene ? "scene" : "table");
        *place = given->operands[i];
    }
    const char *track = option_value(given, "track");
    if (track && table)
        return fail(error, FST_BAD_INPUT, "", "fit either a table or, with --track, a track");
    if (!table && !track)
        return fail(error, FST_BAD_INPUT, "",
                    "a table of points is missing: festoon measure A B ... -o POINTS.csv makes one");
    const fst_status status = read_scene(given, scene, &params, error);
    if (status != FST_OK)
        return status;
    return track ? fit_film(given, &params, out, error) : fit_table(given, table, &params, out, error);
}

const command fit_command = {
    .name = "fit",
    .synopsis = "DATA.csv|--track TRACK.csv [SCENE.yaml] --free KEY,KEY [options]",
    .summary = "Find parameters of the model from measured points, with their errors",
    .details =
        "The table has a line of column names with units, in any order; cells may be empty (docs/fit.md):\n"
        "  frequency [Hz],mean_r [mm],mean_r_error [mm],std_r [mm],\n"
        "  std_r_error [mm],bead_frequency [Hz],bead_frequency_error [Hz]\n",
    .options = options,
    .most_operands = 2,
    .has_helpers = 1,
    .perform = perform,
};
