/* read.c - fst_track_read(): which format a file has, by how it begins, and the reader of that format. */
#include <stdlib.h>
#include <string.h>

#include "base/constants.h"
#include "base/error.h"
#include "base/text.h"
#include "host/regular_file.h"
#include "track/raw.h"
#include "track/read_formats.h"

enum { OPTIONS_COOKIE = 0x5452414b };

typedef enum {
    FORMAT_FESTOON,
    FORMAT_GENERIC,
    FORMAT_TRACKER,
    FORMAT_TRK,
    FORMAT_TRACKPY,
    FORMAT_TRACKMATE,
    FORMAT_TRACKMATE_XML,
    FORMAT_IMAGEJ,
    FORMAT_MTRACKJ,
    FORMAT_DLTDV5,
    FORMAT_DLTDV8,
    FORMAT_BLENDER,
    FORMAT_TRAJECTORY,
    FORMAT_COUNT
} format;

static const struct {
    const char *name, *shown;
} formats[FORMAT_COUNT] = {
    [FORMAT_FESTOON] = {"festoon", "festoon's own table"},
    [FORMAT_GENERIC] = {"generic", "a table with named columns"},
    [FORMAT_TRACKER] = {"tracker", "Tracker, text"},
    [FORMAT_TRK] = {"trk", "Tracker, project"},
    [FORMAT_TRACKPY] = {"trackpy", "trackpy"},
    [FORMAT_TRACKMATE] = {"trackmate", "TrackMate, table of spots"},
    [FORMAT_TRACKMATE_XML] = {"trackmate-xml", "TrackMate, XML"},
    [FORMAT_IMAGEJ] = {"imagej", "ImageJ, Manual Tracking"},
    [FORMAT_MTRACKJ] = {"mtrackj", "MTrackJ"},
    [FORMAT_DLTDV5] = {"dltdv5", "DLTdv 5"},
    [FORMAT_DLTDV8] = {"dltdv8", "DLTdv 8"},
    [FORMAT_BLENDER] = {"blender", "Blender, by tools/blender-export.py"},
    [FORMAT_TRAJECTORY] = {"trajectory", "a trajectory that festoon made"},
};

fst_track_options fst_default_track_options(void)
{
    return (fst_track_options){.cookie = OPTIONS_COOKIE, .fps = NAN, .scale = NAN};
}

const char *fst_track_formats(void)
{
    return "festoon|generic|tracker|trk|trackpy|trackmate|trackmate-xml|imagej|mtrackj|dltdv5|dltdv8|blender|"
           "trajectory";
}

static fst_status named_format(const char *name, format *found, fst_error *error)
{
    char nearest[32], quoted[FST_QUOTE_SIZE];
    for (int i = 0; i < FORMAT_COUNT; ++i)
        if (strcmp(formats[i].name, name) == 0) {
            *found = (format)i;
            return FST_OK;
        }
    if (strcmp(name, "dltdv") == 0) {
        *found = FORMAT_DLTDV8;
        return FST_OK;
    }
    (void)fst_nearest_name(name, fst_track_formats(), nearest, sizeof nearest);
    return fst_fail(error, FST_BAD_INPUT, "fst_track_options.format",
                    "there is no format %s; the nearest is %s", fst_quote(name, quoted), nearest);
}

/* ---------------------------------------------------------------- recognising */

/* The first line that is neither blank nor a comment; text->count where there is none. */
static size_t first_line(const track_text *text)
{
    size_t i = 0;
    while (i < text->count && (!text->lines[i][strspn(text->lines[i], " \t")] || text->lines[i][0] == '#'))
        ++i;
    return i;
}

/* Whether one of the cells of a line is called `name`, or begins with it. */
static int has_cell(const track_cells *cells, const char *name, int begins)
{
    for (int i = 0; i < cells->count; ++i) {
        track_column column;
        track_column_of(cells->cell[i], &column);
        if (begins ? strncmp(column.name, name, strlen(name)) == 0 : strcmp(column.name, name) == 0)
            return 1;
    }
    return 0;
}

static fst_status line_cells(const track_text *text, size_t line, track_cells *cells, fst_error *error)
{
    cells->count = 0;
    return line < text->count
               ? track_split(cells, text->lines[line], track_separator_of(text->lines[line]), error)
               : FST_OK;
}

/* What an XML file is, by words near its beginning. */
static format xml_format(const track_text *text)
{
    for (size_t i = 0; i < text->count && i < 200; ++i)
        if (strstr(text->lines[i], "opensourcephysics"))
            return FORMAT_TRK;
    return FORMAT_TRACKMATE_XML;
}

static fst_status recognise(const track_text *text, size_t header, format *found, fst_error *error)
{
    const char *line = text->lines[header], *first = line + strspn(line, " \t");
    track_cells cells = {.count = 0}, next = {.count = 0};
    fst_status status = line_cells(text, header, &cells, error);
    if (status == FST_OK)
        status = line_cells(text, header + 1, &next, error);
    const int has_xy = has_cell(&cells, "x", 0) && has_cell(&cells, "y", 0);
    *found = FORMAT_GENERIC;
    if (*first == '<')
        *found = xml_format(text);
    else if (strncmp(first, "MTrackJ", 7) == 0)
        *found = FORMAT_MTRACKJ;
    else if (has_cell(&cells, "position_x", 0) && has_cell(&cells, "track_id", 0))
        *found = FORMAT_TRACKMATE;
    else if (has_cell(&cells, "track n", 1) && has_cell(&cells, "slice n", 1))
        *found = FORMAT_IMAGEJ;
    else if (has_cell(&cells, "pt1_cam1_", 1) || (has_cell(&cells, "pt", 1) && strstr(line, "_cam")))
        *found = FORMAT_DLTDV8;
    else if (has_xy && has_cell(&cells, "mass", 0) && has_cell(&cells, "frame", 0))
        *found = FORMAT_TRACKPY;
    else if (!has_xy && has_cell(&next, "t", 0) && has_cell(&next, "x", 0) && has_cell(&next, "y", 0))
        *found = FORMAT_TRACKER;
    else if (strncmp(line, "frame,", 6) == 0 && has_xy)
        *found = FORMAT_FESTOON;
    track_cells_free(&cells);
    track_cells_free(&next);
    return status;
}

/* ---------------------------------------------------------------- reading */

static fst_status read_as(format which, const track_text *text, size_t header, track_raw *raw, fst_error *error)
{
    switch (which) {
    case FORMAT_TRACKER:
        return track_read_tracker(text, header, raw, error);
    case FORMAT_TRK:
        return track_read_trk(text, raw, error);
    case FORMAT_TRACKMATE:
        return track_read_trackmate_csv(text, header, raw, error);
    case FORMAT_TRACKMATE_XML:
        return track_read_trackmate_xml(text, raw, error);
    case FORMAT_IMAGEJ:
        return track_read_imagej(text, header, raw, error);
    case FORMAT_MTRACKJ:
        return track_read_mtrackj(text, header, raw, error);
    case FORMAT_DLTDV5:
    case FORMAT_DLTDV8:
        return track_read_dltdv(text, header, which == FORMAT_DLTDV8, raw, error);
    case FORMAT_TRACKPY:
        raw->y_down = 1;
        (void)snprintf(raw->length_unit, sizeof raw->length_unit, "px");
        return track_read_columns(text, header, raw, error);
    case FORMAT_FESTOON:
    case FORMAT_GENERIC:
    case FORMAT_BLENDER:
    case FORMAT_TRAJECTORY:
    case FORMAT_COUNT:
        break;
    }
    return track_read_columns(text, header, raw, error);
}

/* A trajectory that the program made itself: its samples are places, in l and 1/gamma. */
static fst_status read_trajectory(const char *path, track_raw *raw, fst_error *error)
{
    fst_table table;
    fst_model *model = NULL;
    int at[3] = {-1, -1, -1};
    static const char *const names[3] = {"t", "x", "y"};
    fst_status status = fst_trajectory_read(path, &table, error);
    if (status != FST_OK)
        return status;
    for (int i = 0; i < fst_column_count(); ++i)
        for (int k = 0; k < 3; ++k)
            if (strcmp(fst_column_at(i)->name, names[k]) == 0)
                at[k] = i;
    status = fst_model_new(&table.params, &model, error);
    if (status == FST_OK) {
        const fst_groups groups = fst_model_groups(model);
        int track;
        (void)snprintf(raw->length_unit, sizeof raw->length_unit, "mm");
        raw->time_unit = groups.time_unit;
        status = track_raw_name(raw, "bead", &track, error);
        for (size_t i = 0; i < table.rows && status == FST_OK; ++i)
            status = track_raw_add(raw,
                                   (track_spot){track, NAN, table.columns[at[0]][i],
                                                1e3 * groups.length_unit * table.columns[at[1]][i],
                                                1e3 * groups.length_unit * table.columns[at[2]][i], 0},
                                   error);
    }
    fst_model_free(model);
    fst_table_free(&table);
    return status;
}

/* Whether a file is HDF5, or begins as a trajectory does. */
static int is_trajectory(const track_text *text)
{
    return (text->size > 8 && memcmp(text->bytes, "\xc2\x89HDF", 5) == 0) ||
           (text->count > 0 && strcmp(text->lines[0], "# festoon trajectory") == 0);
}

fst_status track_read_text(const track_text *text, const fst_track_options *options, track_raw *raw,
                           fst_error *error)
{
    const size_t header = first_line(text);
    track_raw_begin(raw, "");
    format which = is_trajectory(text) ? FORMAT_TRAJECTORY : FORMAT_GENERIC;
    if (header == text->count && which != FORMAT_TRAJECTORY)
        return fst_fail(error, FST_BAD_INPUT, text->path, "the file is empty");
    fst_status status = options->format              ? named_format(options->format, &which, error)
                        : which == FORMAT_TRAJECTORY ? FST_OK
                                                     : recognise(text, header, &which, error);
    track_raw_begin(raw, formats[which].shown);
    if (status != FST_OK)
        return status;
    return which == FORMAT_TRAJECTORY ? read_trajectory(text->path, raw, error)
                                      : read_as(which, text, header, raw, error);
}

fst_status fst_track_read(const char *path, const fst_track_options *options, fst_track *track,
                          char **understood, fst_error *error)
{
    track_text text;
    track_raw raw;
    *track = (fst_track){0};
    if (options->cookie != OPTIONS_COOKIE)
        return fst_fail(error, FST_BAD_INPUT, "fst_track_read",
                        "the options were not made by fst_default_track_options()");
    track_raw_begin(&raw, "");
    fst_status status = track_text_read(&text, path, error);
    if (status == FST_OK)
        status = track_read_text(&text, options, &raw, error);
    if (status == FST_OK)
        status = track_choose(&raw, path, options, track, understood, error);
    track_raw_free(&raw);
    track_text_free(&text);
    return status;
}
