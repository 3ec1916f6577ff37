/* read_imagej.c - ImageJ's Manual Tracking and MTrackJ.
 *
 *   [Nb]  Track n°  Slice n°  X  Y  Distance  Velocity  Pixel Value      tabs or commas, Latin-1, slices from
 * 1, pixels
 *
 *   MTrackJ 1.5.1 Data File
 *   ...
 *   Track 1
 *   Point 1 111.3 126.1 1.0 1.0 1.0                                       ID x y z t c; t is the frame, from 1;
 * pixels
 *
 * y points down in both.
 */
#include "track/read_formats.h"

#include <ctype.h>
#include <string.h>

#include "base/text.h"

enum { TRACK, SLICE, X, Y, ROLES };

/* Read the columns of a row by their roles.  `at` has the columns. */
static fst_status take_row(const track_text *text, size_t line, const track_cells *cells, const int at[ROLES],
                           track_raw *raw, fst_error *error)
{
    static const char *const names[ROLES] = {"track", "slice", "X", "Y"};
    double values[ROLES];
    char quoted[FST_QUOTE_SIZE];
    for (int k = 0; k < ROLES; ++k) {
        const char *cell = at[k] < cells->count ? cells->cell[at[k]] : "";
        if (track_number(cell, &values[k]) != TRACK_NUMBER)
            return track_fail_line(text->path, line, error, "column %d (%s): %s is no number", at[k] + 1,
                                   names[k], fst_quote(cell, quoted));
    }
    track_spot spot = {.frame = values[SLICE], .t = NAN, .x = values[X], .y = values[Y], .line = line};
    const fst_status status = track_raw_name(raw, cells->cell[at[TRACK]], &spot.track, error);
    return status == FST_OK ? track_raw_add(raw, spot, error) : status;
}

fst_status track_read_imagej(const track_text *text, size_t header, track_raw *raw, fst_error *error)
{
    static const char *const begins[ROLES] = {"track n", "slice n", "x", "y"};
    track_cells cells = {.count = 0};
    const char separator = track_separator_of(text->lines[header]);
    int at[ROLES] = {-1, -1, -1, -1};
    raw->y_down = 1;
    (void)snprintf(raw->length_unit, sizeof raw->length_unit, "px");
    fst_status status = track_split(&cells, text->lines[header], separator, error);
    for (int i = 0; i < cells.count && status == FST_OK; ++i) {
        track_column column;
        track_column_of(cells.cell[i], &column);
        for (int k = 0; k < ROLES; ++k)
            if (k < X ? strncmp(column.name, begins[k], 7) == 0 : strcmp(column.name, begins[k]) == 0)
                at[k] = i;
    }
    for (int k = 0; k < ROLES && status == FST_OK; ++k)
        if (at[k] < 0)
            status =
                track_fail_line(text->path, header + 1, error, "a table of Manual Tracking has a column \"%s\"",
                                k < X ? (k == TRACK ? "Track n" : "Slice n") : (k == X ? "X" : "Y"));
    for (size_t i = header + 1; i < text->count && status == FST_OK; ++i) {
        if (!text->lines[i][strspn(text->lines[i], " \t")])
            continue;
        status = track_split(&cells, text->lines[i], separator, error);
        if (status == FST_OK)
            status = take_row(text, i + 1, &cells, at, raw, error);
    }
    track_cells_free(&cells);
    return status;
}

/* ---------------------------------------------------------------- MTrackJ */

static fst_status take_point(const track_text *text, size_t line, const track_cells *cells, int track,
                             track_raw *raw, fst_error *error)
{
    double values[4]; /* x y z t; the channel c is passed over */
    if (cells->count < 6)
        return track_fail_line(text->path, line, error, "a point has %d numbers; ID x y z t c were expected",
                               cells->count - 1);
    for (int k = 0; k < 4; ++k)
        if (track_number(cells->cell[k + 2], &values[k]) != TRACK_NUMBER)
            return track_fail_line(text->path, line, error, "\"%.40s\" is no number", cells->cell[k + 2]);
    if (track < 0)
        return track_fail_line(text->path, line, error, "a point that belongs to no track");
    return track_raw_add(raw, (track_spot){track, values[3], NAN, values[0], values[1], line}, error);
}

fst_status track_read_mtrackj(const track_text *text, size_t header, track_raw *raw, fst_error *error)
{
    track_cells cells = {.count = 0};
    char cluster[32] = "", name[TRACK_NAME_SIZE];
    int track = -1;
    fst_status status = FST_OK;
    raw->y_down = 1;
    (void)snprintf(raw->length_unit, sizeof raw->length_unit, "px");
    for (size_t i = header + 1; i < text->count && status == FST_OK; ++i) {
        status = track_split(&cells, text->lines[i], ' ', error);
        if (status != FST_OK || cells.count < 2)
            continue;
        if (strcmp(cells.cell[0], "Cluster") == 0) {
            (void)snprintf(cluster, sizeof cluster, "%.30s", cells.cell[1]);
        } else if (strcmp(cells.cell[0], "Track") == 0) {
            const int first = !cluster[0] || strcmp(cluster, "1") == 0;
            (void)snprintf(name, sizeof name, "%s%s%.30s", first ? "" : cluster, first ? "" : ".",
                           cells.cell[1]);
            status = track_raw_name(raw, name, &track, error);
        } else if (strcmp(cells.cell[0], "Point") == 0) {
            status = take_point(text, i + 1, &cells, track, raw, error);
        }
    }
    track_cells_free(&cells);
    return status;
}
