/* read.c - fst_track_read(): which format a file has, by how it begins, and the reader of that format. */
#include <stdlib.h>
#include <string.h>

#include "base/constants.h"
#include "base/error.h"
#include "base/text.h"
#include "io/columns.h"
#include "tracks/raw.h"
#include "tracks/read_formats.h"

enum { OPTIONS_COOKIE = 0x5452414b };

/* A day of film at 200 frames a second takes about as many bytes. */
#define LONGEST_FILE ((size_t)256 << 20)

/* The formats: its name and what a person calls it, its reader, and which of the reader's variants it is. */
#define FORMATS(ROW)                                                                                           \
    ROW(FESTOON, "festoon", "festoon's own table", track_read_columns, TRACK_ANY_COLUMNS)                      \
    ROW(GENERIC, "generic", "a table with named columns", track_read_columns, TRACK_ANY_COLUMNS)               \
    ROW(TRACKER, "tracker", "Tracker, text", track_read_tracker, 0)                                            \
    ROW(TRK, "trk", "Tracker, project", track_read_trk, 0)                                                     \
    ROW(TRACKPY, "trackpy", "trackpy", track_read_columns, TRACK_TRACKPY)                                      \
    ROW(TRACKMATE, "trackmate", "TrackMate, table of spots", track_read_columns, TRACK_TRACKMATE)              \
    ROW(TRACKMATE_XML, "trackmate-xml", "TrackMate, XML", track_read_trackmate_xml, 0)                         \
    ROW(IMAGEJ, "imagej", "ImageJ, Manual Tracking", track_read_columns, TRACK_IMAGEJ)                         \
    ROW(MTRACKJ, "mtrackj", "MTrackJ", track_read_mtrackj, 0)                                                  \
    ROW(DLTDV5, "dltdv5", "DLTdv 5", track_read_dltdv, 5)                                                      \
    ROW(DLTDV8, "dltdv8", "DLTdv 8", track_read_dltdv, 8)                                                      \
    ROW(BLENDER, "blender", "Blender, by tools/blender-export.py", track_read_columns, TRACK_ANY_COLUMNS)      \
    ROW(TRAJECTORY, "trajectory", "a trajectory that festoon made", read_trajectory, 0)

#define ROW_ENUM(NAME, ...) FORMAT_##NAME,
typedef enum { FORMATS(ROW_ENUM) FORMAT_COUNT } format;

static track_reader read_trajectory;

static const struct {
    const char *name, *shown;
    track_reader *read;
    int variant;
} formats[FORMAT_COUNT] = {
#define ROW_FORMAT(NAME, ...) {__VA_ARGS__},
    FORMATS(ROW_FORMAT)};

fst_track_options fst_default_track_options(void)
{
    return (fst_track_options){.cookie = OPTIONS_COOKIE, .fps = NAN, .scale = NAN, .from = NAN, .to = NAN};
}

const char *fst_track_formats(void)
{
#define ROW_WORD(NAME, name, ...) "|" name
    return &FORMATS(ROW_WORD)[1];
}

static fst_status named_format(const char *name, format *found, fst_error *error)
{
    char suggestion[FST_SUGGESTION_SIZE], quoted[FST_QUOTE_SIZE];
    for (int i = 0; i < FORMAT_COUNT; ++i)
        if (strcmp(formats[i].name, name) == 0) {
            *found = (format)i;
            return FST_OK;
        }
    if (strcmp(name, "dltdv") == 0) {
        *found = FORMAT_DLTDV8;
        return FST_OK;
    }
    return fst_fail(error, FST_BAD_INPUT, "fst_track_options.format", "there is no format %s; %s",
                    fst_quote(name, quoted), fst_suggest_name(name, fst_track_formats(), suggestion));
}

/* ---------------------------------------------------------------- recognising */

/* The first line that is neither blank nor a comment; text->count where there is none. */
static size_t first_line(const fst_text *text)
{
    size_t i = 0;
    while (i < text->count && fst_text_says_nothing(text->lines[i]))
        ++i;
    return i;
}

/* Whether one of the cells of the line that was cut is called so; "name*": begins so. */
static int has_cell(const fst_text_table *line, const char *name)
{
    for (int i = 0; i < line->count; ++i)
        if (fst_text_is_named(line->cells[i], name))
            return 1;
    return 0;
}

/* What an XML file is, by words near its beginning. */
static format xml_format(const fst_text *text)
{
    for (size_t i = 0; i < text->count && i < 200; ++i)
        if (strstr(text->lines[i], "opensourcephysics"))
            return FORMAT_TRK;
    return FORMAT_TRACKMATE_XML;
}

/* What a table is, by the names of its columns. */
static fst_status table_format(fst_text_table *line, size_t header, format *found)
{
    const char *text = line->text->lines[header];
    const fst_status status = fst_text_split(line, header + 1, '\0');
    if (status != FST_OK)
        return status;
    const int has_xy = has_cell(line, "x") && has_cell(line, "y");
    if (has_cell(line, "position_x") && has_cell(line, "track_id"))
        *found = FORMAT_TRACKMATE;
    else if (has_cell(line, "track n*") && has_cell(line, "slice n*"))
        *found = FORMAT_IMAGEJ;
    else if (has_cell(line, "pt1_cam1_*") || (has_cell(line, "pt*") && strstr(text, "_cam")))
        *found = FORMAT_DLTDV8;
    else if (has_xy && has_cell(line, "mass") && has_cell(line, "frame"))
        *found = FORMAT_TRACKPY;
    else if (has_xy && strncmp(text, "frame,", 6) == 0)
        *found = FORMAT_FESTOON;
    else if (!has_xy && header + 1 < line->text->count && fst_text_split(line, header + 2, '\0') == FST_OK &&
             has_cell(line, "t") && has_cell(line, "x") && has_cell(line, "y"))
        *found = FORMAT_TRACKER;
    return FST_OK;
}

static fst_status recognise(const fst_text *text, size_t header, format *found, fst_error *error)
{
    const char *first = text->lines[header] + strspn(text->lines[header], " \t");
    fst_text_table line;
    *found = *first == '<'                       ? xml_format(text)
             : strncmp(first, "MTrackJ", 7) == 0 ? FORMAT_MTRACKJ
                                                 : FORMAT_GENERIC;
    if (*found != FORMAT_GENERIC)
        return FST_OK;
    fst_text_begin(&line, text, error);
    const fst_status status = table_format(&line, header, found);
    fst_text_end(&line);
    return status;
}

/* ---------------------------------------------------------------- reading */

/* A trajectory that the program made itself: its samples are places, in l and 1/gamma. */
static fst_status read_trajectory(const fst_text *text, size_t header, int variant, track_raw *raw,
                                  fst_error *error)
{
    (void)header, (void)variant;
    fst_table table;
    fst_model *model = NULL;
    fst_status status = fst_trajectory_read(text->path, &table, error);
    if (status != FST_OK)
        return status;
    status = fst_model_new(&table.params, &model, error);
    if (status == FST_OK) {
        const fst_groups groups = fst_model_groups(model);
        const double millimetres = 1e3 * groups.length_unit;
        int track;
        (void)snprintf(raw->length_unit, sizeof raw->length_unit, "mm");
        raw->time_unit = groups.time_unit;
        status = track_raw_name(raw, "bead", &track, error);
        for (size_t i = 0; i < table.rows && status == FST_OK; ++i)
            status = track_raw_add(raw,
                                   (track_spot){track, NAN, table.columns[FST_COLUMN_t][i],
                                                millimetres * table.columns[FST_COLUMN_x][i],
                                                millimetres * table.columns[FST_COLUMN_y][i], 0, 0, 0},
                                   error);
    }
    fst_model_free(model);
    fst_table_free(&table);
    return status;
}

/* Whether a file is HDF5, or begins as a trajectory does. */
static int is_trajectory(const fst_text *text)
{
    return (text->size > 8 && memcmp(text->bytes, "\xc2\x89HDF", 5) == 0) ||
           (text->count > 0 && strcmp(text->lines[0], "# festoon trajectory") == 0);
}

fst_status track_read_text(const fst_text *text, const fst_track_options *options, track_raw *raw,
                           fst_error *error)
{
    const size_t header = first_line(text);
    track_raw_begin(raw, "");
    format which = is_trajectory(text) ? FORMAT_TRAJECTORY : FORMAT_GENERIC;
    if (header == text->count && which != FORMAT_TRAJECTORY)
        return fst_fail(error, FST_BAD_INPUT, text->path, "the file is empty");
    if (text->count > 0 && strcmp(text->lines[0], "# festoon trajectory of beads") == 0)
        return fst_fail(
            error, FST_BAD_INPUT, text->path,
            "this is a trajectory of several beads, or of one in a world, which has X_0, Y_0 and so on, mostly "
            "on axes that turn with the magnet, and not x and y of a track: the run itself tells the means "
            "of each bead, and its film can be tracked");
    fst_status status = options->format              ? named_format(options->format, &which, error)
                        : which == FORMAT_TRAJECTORY ? FST_OK
                                                     : recognise(text, header, &which, error);
    track_raw_begin(raw, formats[which].shown);
    return status == FST_OK ? formats[which].read(text, header, formats[which].variant, raw, error) : status;
}

/* Make tracks of what was read: of all beads, if they belong together and are wanted, or of one. */
static fst_status choose(const track_raw *raw, const char *path, const fst_track_options *options, int all,
                         fst_track *tracks, int *count, char **understood, fst_error *error)
{
    const int several = all && raw->is_whole && !options->name && raw->name_count > 1;
    *count = 1;
    if (!several)
        return track_choose(raw, path, options, -1, tracks, understood, error);
    if (raw->name_count > FST_TRACKED_BEADS)
        return fst_fail(
            error, FST_BAD_INPUT, path,
            "there are %d tracks with a column doubts, which only films of up to %d beads have: say "
            "which track is wanted",
            raw->name_count, FST_TRACKED_BEADS);
    fst_status status = FST_OK;
    for (*count = 0; *count < raw->name_count && status == FST_OK; ++*count)
        status =
            track_choose(raw, path, options, *count, &tracks[*count], *count == 0 ? understood : NULL, error);
    for (int i = 0; i < *count && status != FST_OK; ++i)
        fst_track_free(&tracks[i]);
    return status;
}

static fst_status read_tracks(const char *path, const fst_track_options *options, int all, fst_track *tracks,
                              int *count, char **understood, fst_error *error)
{
    fst_text text;
    track_raw raw;
    for (int i = 0; i < (all ? FST_TRACKED_BEADS : 1); ++i)
        tracks[i] = (fst_track){0};
    if (options->cookie != OPTIONS_COOKIE)
        return fst_fail(error, FST_BAD_INPUT, "fst_track_read",
                        "the options were not made by fst_default_track_options()");
    track_raw_begin(&raw, "");
    fst_status status = fst_text_read(&text, path, LONGEST_FILE, error);
    if (status == FST_OK)
        status = track_read_text(&text, options, &raw, error);
    if (status == FST_OK)
        status = choose(&raw, path, options, all, tracks, count, understood, error);
    track_raw_free(&raw);
    fst_text_free(&text);
    return status;
}

fst_status fst_tracks_read(const char *path, const fst_track_options *options,
                           fst_track tracks[FST_TRACKED_BEADS], int *count, char **understood, fst_error *error)
{
    return read_tracks(path, options, 1, tracks, count, understood, error);
}

fst_status fst_track_read(const char *path, const fst_track_options *options, fst_track *track,
                          char **understood, fst_error *error)
{
    int count;
    return read_tracks(path, options, 0, track, &count, understood, error);
}
