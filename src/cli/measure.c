/* measure.c - festoon measure: from the track of a filmed bead to numbers with errors. */
#include <stdlib.h>
#include <string.h>

#include "cli/command.h"

static const option options[] = {
    JSON_OPTION,
    {"drive", '\0', "10.7Hz", "the magnet's drive, with a minus where it turns clockwise in the film"},
    {"fps", '\0', "F", "frames a second, instead of the file's clock"},
    {"scale", '\0', "0.123mm", "the length of one unit of the file (of a pixel, mostly)"},
    {"format", '\0', "NAME", "the file's format, instead of what its header says"},
    {"track", '\0', "NAME", "which track of several (otherwise the longest)"},
    {"exposure", '\0', "2ms", "how long a frame was exposed: what that blurs is corrected"},
    {NULL, '\0', NULL, NULL},
};

/* A number with a unit of time. */
static fst_status read_time(const char *name, const char *text, double *seconds, fst_error *error)
{
    char *end;
    *seconds = strtod(text, &end);
    end += strspn(end, " ");
    const double unit = strcmp(end, "ms") == 0   ? 1e-3
                        : strcmp(end, "us") == 0 ? 1e-6
                        : strcmp(end, "s") == 0  ? 1.0
                                                 : 0.0;
    if (end == text || unit == 0.0 || !isfinite(*seconds))
        return fail(error, FST_BAD_INPUT, name, "\"%.40s\" is no time: a number with s, ms or us was expected",
                    text);
    *seconds *= unit;
    return FST_OK;
}

/* A value with a unit; errors name the option. */
static fst_status read_unit(const char *name, const char *text, fst_unit unit, double *value, fst_error *error)
{
    const fst_status status = fst_parse_value(text, unit, value, error);
    if (status != FST_OK)
        (void)snprintf(error->where, sizeof error->where, "%s", name);
    return status;
}

static fst_status read_scale(const char *text, fst_track_options *how, char unit[FST_LENGTH_UNIT_SIZE],
                             fst_error *error)
{
    char *end;
    const double number = strtod(text, &end);
    end += strspn(end, " ");
    if (end != text && (strcmp(end, "px") == 0)) {
        how->scale = number;
        how->scale_unit = "px";
        return FST_OK;
    }
    if (end == text || !*end)
        return fail(error, FST_BAD_INPUT, "--scale", "\"%.40s\": a length with a unit was expected (px %s)",
                    text, fst_unit_accepted(FST_UNIT_LENGTH));
    const fst_status status = read_unit("--scale", text, FST_UNIT_LENGTH, &how->scale, error);
    (void)snprintf(unit, FST_LENGTH_UNIT_SIZE, "%.7s", end);
    how->scale_unit = unit;
    return status;
}

static fst_status read_options(const arguments *given, fst_track_options *how, fst_measure_options *what,
                               char unit[FST_LENGTH_UNIT_SIZE], fst_error *error)
{
    const char *drive = option_value(given, "drive"), *fps = option_value(given, "fps");
    const char *scale = option_value(given, "scale"), *exposure = option_value(given, "exposure");
    *how = fst_default_track_options();
    *what = fst_default_measure_options();
    how->format = option_value(given, "format");
    how->name = option_value(given, "track");
    fst_status status = drive ? read_unit("--drive", drive, FST_UNIT_FREQUENCY, &what->drive, error) : FST_OK;
    if (status == FST_OK && fps)
        status = read_numbers("--fps", fps, &how->fps, 1, error);
    if (status == FST_OK && scale)
        status = read_scale(scale, how, unit, error);
    if (status == FST_OK && exposure)
        status = read_time("--exposure", exposure, &what->exposure, error);
    return status;
}

static void print_value(FILE *out, const char *name, double value, double error, const char *unit)
{
    if (isnan(value))
        (void)fprintf(out, "  %-24s unknown\n", name);
    else if (isnan(error))
        (void)fprintf(out, "  %-24s %.6g %s, without an error\n", name, value, unit);
    else
        (void)fprintf(out, "  %-24s %.6g +- %.2g %s\n", name, value, error, unit);
}

static void print_measurement(FILE *out, const fst_measurement *m)
{
    print_value(out, "<r>", m->mean_r, m->mean_r_error, m->length_unit);
    print_value(out, "delta r", m->std_r, m->std_r_error, m->length_unit);
    print_value(out, "bead", m->bead_frequency_hz, m->bead_frequency_hz_error, "Hz");
    print_value(out, "festoons N", m->festoons, m->festoons_error, "");
    print_value(out, "drive, from the track", m->drive_from_track_hz, m->drive_from_track_hz_error, "Hz");
    print_value(out, "tilt of the camera", m->tilt_deg, m->tilt_deg_error, "degrees");
    (void)fprintf(out, "  %-24s %.6g, %.6g %s\n", "centre", m->centre[0], m->centre[1], m->length_unit);
    (void)fprintf(out, "  %-24s %lld, of which %lld are lost; %.6g a second\n", "frames", (long long)m->frames,
                  (long long)m->lost, m->fps);
    for (int i = 0; i < m->warning_count; ++i)
        (void)fprintf(out, "  warning: %s\n", m->warnings[i]);
}

static fst_status perform(const arguments *given, FILE *out, fst_error *error)
{
    fst_track_options how;
    fst_measure_options what;
    fst_measurement measured;
    fst_track track = {0};
    char unit[FST_LENGTH_UNIT_SIZE], *understood = NULL;
    const char *path = operand(given);
    if (!path)
        return fail(error, FST_BAD_INPUT, "", "a track is missing: a file with the places of a filmed bead");
    fst_status status = read_options(given, &how, &what, unit, error);
    if (status == FST_OK)
        status = fst_track_read(path, &how, &track, &understood, error);
    if (status == FST_OK && understood)
        (void)fprintf(stderr, "%s\n", understood);
    if (status == FST_OK)
        status = fst_measure_track(&track, &what, &measured, error);
    if (status == FST_OK && option_value(given, "json"))
        status = print_and_free(fst_measurement_json(&measured), out, error);
    else if (status == FST_OK)
        print_measurement(out, &measured);
    free(understood);
    fst_track_free(&track);
    return status;
}

const command measure_command = {
    .name = "measure",
    .synopsis = "TRACK [--drive 10.7Hz] [--fps F] [--scale 0.123mm] [--format NAME] [--json]",
    .summary = "Radius, frequency, festoons and drive of a filmed bead, from its track",
    .details = "",
    .options = options,
    .most_operands = 1,
    .perform = perform,
};
