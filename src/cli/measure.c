/* measure.c - festoon measure: from the track of a filmed bead to numbers with errors. */
#include <stdlib.h>
#include <string.h>

#include "cli/command.h"
#include "cli/terminal.h"

static const option options[] = {
    JSON_OPTION,
    {"output", 'o', "POINTS.csv", "a table of points for festoon fit, a row a track, or a bead"},
    {"drive", '\0', "F",
     "how often the magnet turned, as 10.7Hz, with a minus where it turned clockwise in the film; of several "
     "tracks one "
     "for each: F,F,..."},
    {"exposure", '\0', "T", "how long a frame was exposed, as 2ms: what that blurs is corrected"},
    TRACK_OPTIONS,
    {"format", '\0', "NAME", "the file's format, instead of what its header says"},
    {"only", '\0', "NAME", "only this track of several (otherwise the longest, or of track --beads all)"},
    {"figure", '\0', "FIG", "draw path, r against alpha and residuals to FIG.svg, .pdf or .png (of one track)"},
    {"compare", '\0', "SCENE.yaml",
     "in the figure lay the path of this scene, at the track's drive, over the track"},
    SCENE_OPTIONS,
    {NULL, '\0', NULL, NULL},
};

static fst_status read_options(const arguments *given, fst_track_options *how, fst_measure_options *what,
                               char unit[FST_LENGTH_UNIT_SIZE], fst_error *error)
{
    const char *scale = option_value(given, "scale");
    *how = fst_default_track_options();
    *what = fst_default_measure_options();
    how->format = option_value(given, "format");
    how->name = option_value(given, "only");
    const value_option rows[] = {{"fps", FST_UNIT_NUMBER, &how->fps, 0, 0},
                                 {"from", VALUE_WHOLE, &how->from, 0, MOST_FRAMES},
                                 {"to", VALUE_WHOLE, &how->to, 0, MOST_FRAMES},
                                 {"exposure", VALUE_TIME, &what->exposure, 0, 0}};
    fst_status status = read_values(given, rows, sizeof rows / sizeof *rows, error);
    if (status == FST_OK && scale)
        status = read_track_scale(scale, how, unit, error);
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

/* A length has an error of its own, and one by the scale, which all of them share. */
static void print_length(FILE *out, const char *name, double value, double error, const fst_measurement *m)
{
    print_value(out, name, value, error, m->length_unit);
    if (!isnan(value) && !isnan(m->scale_error))
        (void)fprintf(out, "  %-24s +- %.2g %s by the scale, which is known to %.2g %%\n", "",
                      value * m->scale_error, m->length_unit, 100.0 * m->scale_error);
}

/* Two drives are one if they are as near as this. */
#define OF_DRIVE 0.02

/* Frames, and the clock on which all rates rest where no drive checks it; `drive` is the given one, or NAN. */
static void print_frames(FILE *out, const fst_measurement *m, const arguments *given, double drive)
{
    const int checked = fabs(m->drive_from_track_hz - fabs(drive)) < OF_DRIVE * fabs(drive);
    (void)fprintf(out, "  %-24s %lld, of which %lld are lost; ", "frames", (long long)m->frames,
                  (long long)m->lost);
    if (isnan(m->fps))
        (void)fputs("no clock\n", out);
    else if (checked)
        (void)fprintf(out, "%.6g a second\n", m->fps);
    else
        (void)fprintf(out, "all rates rest on the %.6g a second that %s (--drive %s them)\n", m->fps,
                      option_value(given, "fps") ? "were given" : "the file's clock says",
                      isnan(drive) ? "checks" : "could not check");
}

static void print_measurement(FILE *out, const fst_measurement *m, const arguments *given, double drive)
{
    print_length(out, "<r>", m->mean_r, m->mean_r_error, m);
    print_length(out, "delta r", m->std_r, m->std_r_error, m);
    print_value(out, "bead", m->bead_frequency_hz, m->bead_frequency_hz_error, "Hz");
    print_value(out, "festoons N", m->festoons, m->festoons_error, "");
    print_value(out, "drive, from the track", m->drive_from_track_hz, m->drive_from_track_hz_error, "Hz");
    print_value(out, "tilt of the camera", m->tilt_deg, m->tilt_deg_error, "degrees");
    (void)fprintf(out, "  %-24s %.6g, %.6g %s\n", "centre", m->centre[0], m->centre[1], m->length_unit);
    print_frames(out, m, given, drive);
    for (int i = 0; i < m->warning_count; ++i)
        (void)fprintf(out, "  warning: %s\n", m->warnings[i]);
}

static void print_pair(FILE *out, const fst_pair *p, const char *unit)
{
    (void)fprintf(out, "\nbeads %d and %d: the angle between them is %s%s%s%s\n", p->beads[0] + 1,
                  p->beads[1] + 1, fst_pairing_name(p->pairing), p->reason[0] ? " (" : "", p->reason,
                  p->reason[0] ? ")" : "");
    print_value(out, "angle", p->angle_deg, p->angle_deg_error, "degrees");
    print_value(out, "its drift", p->drift_deg_s, p->drift_deg_s_error, "degrees/s");
    if (!isnan(p->angle_spread_deg))
        (void)fprintf(out, "  %-24s %.6g degrees\n", "its spread", p->angle_spread_deg);
    if (p->frames > 0)
        (void)fprintf(out, "  %-24s %.6g %s, at least %.6g, in %lld frames\n", "distance", p->mean_distance,
                      unit, p->least_distance, (long long)p->frames);
}

/* Who orbits with whom. */
static void print_groups(FILE *out, const fst_beads_measurement *m)
{
    (void)fprintf(out, "\n%-26s", "groups");
    for (int group = 0; group < m->count && m->grouped; ++group)
        for (int i = 0, size = 0; i < m->count; ++i)
            if (m->groups[i] == group)
                (void)fprintf(out, "%s%d", size++ > 0 ? " " : group > 0 ? " | " : "", i + 1);
    (void)fprintf(out, "%s\n", m->grouped ? "" : "unknown");
}

/* Everything that is asked of the tracks, one after the other. */
typedef struct job {
    const arguments *given;
    fst_track_options how;
    fst_measure_options what;
    char unit[FST_LENGTH_UNIT_SIZE];
    double drives[OPERAND_LIMIT]; /* Hz; one for all tracks, or one for each */
    int drive_count;
    fst_point rows[FST_TRACKED_BEADS * OPERAND_LIMIT];
    size_t row_count;
    fst_beads_measurement found; /* of the present track */
    FILE *out;
} job;

/* "10.7Hz", or as many as there are tracks: "10.7Hz,12Hz".  In "10,7Hz" the comma is a decimal one. */
static fst_status read_drives(job *j, fst_error *error)
{
    const char *text = option_value(j->given, "drive");
    char word[64];
    while (text && j->drive_count < OPERAND_LIMIT) {
        const size_t length = strcspn(text, ",");
        (void)snprintf(word, sizeof word, "%.*s", (int)(length < 63 ? length : 63), text);
        if (text[length] && strspn(word, "+-.0123456789") == length)
            return fail(
                error, FST_BAD_INPUT, "--drive",
                "%s stands before a comma without a unit: a decimal point is meant, as in 10.7Hz, or several "
                "drives, each with its unit, as in 10Hz,7Hz",
                word);
        const fst_status status =
            read_unit("--drive", word, FST_UNIT_FREQUENCY, &j->drives[j->drive_count++], error);
        if (status != FST_OK)
            return status;
        text = text[length] ? text + length + 1 : NULL;
    }
    if (j->drive_count > 1 && j->drive_count != j->given->operand_count)
        return fail(error, FST_BAD_INPUT, "--drive", "%d drives for %d track%s: one for all, or one for each",
                    j->drive_count, j->given->operand_count, j->given->operand_count > 1 ? "s" : "");
    return FST_OK;
}

/* A measurement as a row of the table of points. */
static fst_status take_point(job *j, int index, const fst_measurement *m, fst_error *error)
{
    const char *path = j->given->operands[index];
    char text[SHOWN_SIZE];
    fst_point *row = &j->rows[j->row_count++];
    const fst_status status = fst_point_of(m, j->drive_count > 0 ? j->what.drive : NAN, row, error);
    if (status != FST_OK) {
        (void)snprintf(error->where, sizeof error->where, "%.255s", path);
        return status;
    }
    for (int q = 0; q < FST_MEASURED_COUNT; ++q)
        if (isnan(row->value[q]))
            (void)fprintf(stderr, "%s: %s is left out of the table, because it has no error\n",
                          shown(path, text), fst_measured_name((fst_measured)q));
    return FST_OK;
}

/* A track, or the tracks of several beads of one film. */
static void print_track(const job *j, int index)
{
    const fst_beads_measurement *m = &j->found;
    const int several = j->given->operand_count > 1 || m->count > 1;
    char text[SHOWN_SIZE];
    for (int bead = 0; bead < m->count; ++bead) {
        if (several)
            (void)fprintf(j->out, "%s%s", index + bead > 0 ? "\n" : "", shown(j->given->operands[index], text));
        if (m->count > 1)
            (void)fprintf(j->out, ", bead %d", bead + 1);
        if (several)
            (void)fputc('\n', j->out);
        if (m->reasons[bead][0])
            (void)fprintf(j->out, "  not measured: %s\n", m->reasons[bead]);
        else
            print_measurement(j->out, &m->beads[bead], j->given, j->drive_count > 0 ? j->what.drive : NAN);
    }
    for (int i = 0; i < m->pair_count; ++i)
        print_pair(j->out, &m->pairs[i], m->beads[0].length_unit);
    if (m->count > 1)
        print_groups(j->out, m);
}

static fst_status print_result(const job *j, int index, fst_error *error)
{
    const int several = j->given->operand_count > 1;
    if (!option_value(j->given, "json")) {
        print_track(j, index);
        return FST_OK;
    }
    if (several)
        (void)fputs(index == 0 ? "[\n" : ",\n", j->out);
    const fst_status status = print_and_free(j->found.count > 1 ? fst_beads_measurement_json(&j->found)
                                                                : fst_measurement_json(&j->found.beads[0]),
                                             j->out, error);
    if (several && index + 1 == j->given->operand_count)
        (void)fputs("]\n", j->out);
    return status;
}

static fst_status draw_figure(const job *j, const fst_track *track, const fst_measurement *measured,
                              fst_error *error)
{
    const char *to = option_value(j->given, "figure"), *scene = option_value(j->given, "compare");
    fst_params params;
    progress_line line;
    const fst_progress progress = {&line, progress_tell};
    fst_status status = scene ? read_scene(j->given, scene, &params, error) : FST_OK;
    if (status != FST_OK)
        return status;
    progress_begin(&line);
    status = fst_figure_measurement(track, measured, scene ? &params : NULL, to, &progress, error);
    progress_end(&line);
    if (status == FST_OK)
        tell_written(to, "");
    return status;
}

static fst_status measure_track(job *j, int index, fst_error *error)
{
    fst_track tracks[FST_TRACKED_BEADS];
    int count = 0;
    char *understood = NULL, text[SHOWN_SIZE];
    const char *path = j->given->operands[index], *to = option_value(j->given, "output");
    if (j->drive_count > 0)
        j->what.drive = j->drives[j->drive_count > 1 ? index : 0];
    fst_status status = fst_tracks_read(path, &j->how, tracks, &count, &understood, error);
    if (status == FST_OK && understood)
        (void)fprintf(stderr, "%s: %s\n", shown(path, text), understood);
    if (status == FST_OK && count > 1 && option_value(j->given, "figure"))
        status = fail(error, FST_BAD_INPUT, "--figure", "a figure is of one track: say which by --only");
    if (status == FST_OK) {
        progress_line line;
        const fst_progress progress = {&line, progress_tell};
        j->what.progress = &progress;
        progress_begin(&line);
        status = fst_measure_tracks(tracks, count, &j->what, &j->found, error);
        progress_end(&line);
    }
    if (status != FST_OK && !error->where[0])
        (void)snprintf(error->where, sizeof error->where, "%.255s", path);
    if (status == FST_OK)
        status = print_result(j, index, error);
    if (status == FST_OK && option_value(j->given, "figure"))
        status = draw_figure(j, &tracks[0], &j->found.beads[0], error);
    for (int bead = 0; bead < count && status == FST_OK && to; ++bead)
        if (!j->found.reasons[bead][0])
            status = take_point(j, index, &j->found.beads[bead], error);
    free(understood);
    for (int bead = 0; bead < FST_TRACKED_BEADS; ++bead)
        fst_track_free(&tracks[bead]);
    return status;
}

static fst_status write_points(job *j, const char *to, fst_error *error)
{
    const fst_points points = {.rows = j->rows, .count = j->row_count};
    const fst_status status = fst_points_write(to, &points, error);
    if (status == FST_OK)
        tell_written(to, "");
    return status;
}

static fst_status perform(const arguments *given, FILE *out, fst_error *error)
{
    const char *to = option_value(given, "output");
    if (given->operand_count == 0)
        return fail(error, FST_BAD_INPUT, "", "a track is missing: a file with the places of a filmed bead");
    if (to && !ends_in(to, ".csv"))
        return fail(error, FST_BAD_INPUT, "-o", "the table of points is a file that ends in .csv");
    if (option_value(given, "figure") && given->operand_count > 1)
        return fail(error, FST_BAD_INPUT, "--figure", "a figure is of one track, not of %d",
                    given->operand_count);
    if (option_value(given, "compare") && !option_value(given, "figure"))
        return fail(error, FST_BAD_INPUT, "--compare",
                    "a scene is laid over the track in a figure: add --figure FIG.svg");
    if (option_value(given, "set") && !option_value(given, "compare"))
        return fail(error, FST_BAD_INPUT, "--set", "it belongs to the scene of --compare");
    job *j = calloc(1, sizeof *j);
    if (!j)
        return fail(error, FST_NO_MEMORY, "", "out of memory");
    j->given = given;
    j->out = out;
    fst_status status = read_options(given, &j->how, &j->what, j->unit, error);
    if (status == FST_OK)
        status = read_drives(j, error);
    for (int i = 0; i < given->operand_count && status == FST_OK; ++i)
        status = measure_track(j, i, error);
    if (status == FST_OK && to)
        status = write_points(j, to, error);
    free(j);
    return status;
}

const command measure_command = {
    .name = "measure",
    .synopsis = "TRACK... [--drive 10.7Hz] [-o POINTS.csv] [options]",
    .summary = "Radius, frequency, festoons and drive of a filmed bead, from its track",
    .details = "The format is recognised, and what was understood is printed: festoon, generic (any table with "
               "columns t [s] or\n"
               "frame, x [mm], y [mm]), tracker, trk, trackpy, trackmate, trackmate-xml, imagej, mtrackj, "
               "dltdv5, dltdv8,\n"
               "blender, trajectory.  Where drive and festoons show that the clock is wrong, it is corrected, "
               "and a warning says\n"
               "so.  Film ten turns at least, with 120 or 240 frames a second, exposed for 1/500 s or less.\n",
    .options = options,
    .most_operands = OPERAND_LIMIT,
    .has_helpers = 1,
    .perform = perform,
};
