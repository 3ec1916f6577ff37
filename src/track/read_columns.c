/* read_columns.c - festoon's own CSV, and any table that names its columns: t or frame, x, y, and perhaps
 * track.
 *
 *   frame,t [s],x [mm],y [mm]        t;x (cm);y (cm)        Time [ms]  X [px]  Y [px]  track
 *
 * Units stand in brackets behind the names.  Other columns are passed over.  An empty cell, or NaN, is a frame
 * in which the bead was lost.
 */
#include "track/raw.h"

#include <string.h>

#include "base/error.h"
#include "base/text.h"

enum { FRAME, TIME, X, Y, NAME, ROLES };

static const struct {
    int role;
    const char *name;
} names[] = {
    {FRAME, "frame"},
    {FRAME, "frames"},
    {FRAME, "frame number"},
    {FRAME, "frame_number"},
    {FRAME, "image"},
    {FRAME, "#frame"},
    {TIME, "t"},
    {TIME, "time"},
    {TIME, "#t"},
    {TIME, "timestamp"},
    {X, "x"},
    {X, "pos x"},
    {X, "pos_x"},
    {X, "position x"},
    {X, "xpos"},
    {X, "#x"},
    {Y, "y"},
    {Y, "pos y"},
    {Y, "pos_y"},
    {Y, "position y"},
    {Y, "ypos"},
    {NAME, "track"},
    {NAME, "particle"},
    {NAME, "object"},
    {NAME, "track_id"},
};

static const char *const role_names[ROLES] = {"frame", "t", "x", "y", "track"};

/* The columns by their roles; -1 where there is none. */
typedef struct columns {
    int at[ROLES];
    track_column head[ROLES];
} columns;

static int role_of(const char *name)
{
    for (size_t i = 0; i < sizeof names / sizeof *names; ++i)
        if (strcmp(names[i].name, name) == 0)
            return names[i].role;
    return -1;
}

static fst_status find_columns(const track_text *text, size_t line, const track_cells *cells, columns *found,
                               fst_error *error)
{
    for (int role = 0; role < ROLES; ++role)
        found->at[role] = -1;
    for (int i = 0; i < cells->count; ++i) {
        track_column column;
        track_column_of(cells->cell[i], &column);
        const int role = role_of(column.name);
        if (role < 0)
            continue;
        if (found->at[role] >= 0 && role != FRAME) /* pandas writes an index called frame beside the column */
            return track_fail_line(text->path, line, error,
                                   "columns %d and %d both give %s: one of each was expected",
                                   found->at[role] + 1, i + 1, role_names[role]);
        found->at[role] = i;
        found->head[role] = column;
    }
    for (int role = X; role <= Y; ++role)
        if (found->at[role] < 0)
            return track_fail_line(
                text->path, line, error,
                "no column is called %s; a table of a track has the columns t [s] (or frame), "
                "x [mm] and y [mm]",
                role_names[role]);
    if (found->at[FRAME] < 0 && found->at[TIME] < 0)
        return track_fail_line(text->path, line, error,
                               "there is neither a column t [s] nor a column frame: when was the bead at these "
                               "places?");
    return FST_OK;
}

/* Check the units in the head and note them. */
static fst_status take_units(const track_text *text, size_t line, const columns *found, track_raw *raw,
                             fst_error *error)
{
    const char *x = found->head[X].unit, *y = found->head[Y].unit, *t = found->head[TIME].unit;
    char quoted[FST_QUOTE_SIZE];
    if (strcmp(x, y) != 0)
        return track_fail_line(text->path, line, error,
                               "x is in [%s] and y in [%s]: one unit was expected for both", x, y);
    if (x[0] && !track_is_pixel(x) && track_length_unit(x) == 0.0)
        return track_fail_line(text->path, line, error,
                               "%s is no unit of length that is known; these are: px %s", fst_quote(x, quoted),
                               fst_unit_accepted(FST_UNIT_LENGTH));
    if (x[0])
        (void)snprintf(raw->length_unit, sizeof raw->length_unit, "%s", x);
    if (found->at[TIME] < 0 || !t[0])
        return FST_OK;
    raw->time_unit = track_time_unit(t);
    if (raw->time_unit == 0.0)
        return track_fail_line(text->path, line, error,
                               "%s is no unit of time that is known; these are: s ms us min",
                               fst_quote(t, quoted));
    return FST_OK;
}

/* Read a cell of a role; a role without a column is NAN. */
static fst_status number_of(const track_text *text, size_t line, const track_cells *cells, const columns *found,
                            int role, double *value, fst_error *error)
{
    const int at = found->at[role];
    char quoted[FST_QUOTE_SIZE];
    *value = NAN;
    if (at < 0)
        return FST_OK;
    if (at >= cells->count)
        return track_fail_line(text->path, line, error, "%d cells, but %s is column %d", cells->count,
                               role_names[role], at + 1);
    if (track_number(cells->cell[at], value) == TRACK_WORD)
        return track_fail_line(text->path, line, error, "column %d (%s): %s is no number", at + 1,
                               role_names[role], fst_quote(cells->cell[at], quoted));
    return FST_OK;
}

static fst_status take_row(const track_text *text, size_t line, const track_cells *cells, const columns *found,
                           track_raw *raw, fst_error *error)
{
    track_spot spot = {.line = line};
    const char *name = "";
    double *const values[] = {&spot.frame, &spot.t, &spot.x, &spot.y};
    fst_status status = FST_OK;
    for (int role = FRAME; role <= Y && status == FST_OK; ++role)
        status = number_of(text, line, cells, found, role, values[role], error);
    if (status != FST_OK)
        return status;
    const int key = found->at[FRAME] >= 0 ? FRAME : TIME;
    if (isnan(*values[key]))
        return track_fail_line(text->path, line, error, "column %d (%s) is empty", found->at[key] + 1,
                               role_names[key]);
    if (found->at[NAME] >= 0 && found->at[NAME] < cells->count)
        name = cells->cell[found->at[NAME]];
    status = track_raw_name(raw, name, &spot.track, error);
    return status == FST_OK ? track_raw_add(raw, spot, error) : status;
}

fst_status track_read_columns(const track_text *text, size_t header, track_raw *raw, fst_error *error)
{
    const char separator = track_separator_of(text->lines[header]);
    track_cells cells = {.count = 0};
    columns found;
    fst_status status = track_split(&cells, text->lines[header], separator, error);
    if (status == FST_OK)
        status = find_columns(text, header + 1, &cells, &found, error);
    if (status == FST_OK)
        status = take_units(text, header + 1, &found, raw, error);
    for (size_t i = header + 1; i < text->count && status == FST_OK; ++i) {
        const char *line = text->lines[i];
        if (!line[strspn(line, " \t")] || line[0] == '#')
            continue;
        status = track_split(&cells, line, separator, error);
        if (status == FST_OK)
            status = take_row(text, i + 1, &cells, &found, raw, error);
    }
    track_cells_free(&cells);
    return status;
}
