/* read_dltdv.c - DLTdv's points: columns pt1_cam1_X, pt1_cam1_Y, ..., a row a frame, NaN where a point was not
 * seen.
 *
 * The first pixel is 1.  y points up in version 5, whose origin is at the bottom left, and down in version 8.
 */
#include "track/read_formats.h"

#include <ctype.h>
#include <string.h>

#include "base/text.h"

/* Take a column's name apart: "pt1_cam1_X" is the track "pt1_cam1" and the axis 'x'.  Returns 0 where it is
 * none. */
static int take_apart(const char *cell, char name[TRACK_NAME_SIZE], char *axis)
{
    const char *last = strrchr(cell, '_');
    if (strncmp(cell, "pt", 2) != 0 || !last || !last[1] || last[2] || (size_t)(last - cell) >= TRACK_NAME_SIZE)
        return 0;
    *axis = (char)tolower((unsigned char)last[1]);
    (void)snprintf(name, TRACK_NAME_SIZE, "%.*s", (int)(last - cell), cell);
    return *axis == 'x' || *axis == 'y';
}

fst_status track_read_dltdv(const track_text *text, size_t header, int y_down, track_raw *raw, fst_error *error)
{
    track_cells heads = {.count = 0}, cells = {.count = 0};
    const char separator = track_separator_of(text->lines[header]);
    char name[TRACK_NAME_SIZE], other[TRACK_NAME_SIZE], axis, second, quoted[FST_QUOTE_SIZE];
    double frame = 0.0;
    raw->y_down = y_down;
    (void)snprintf(raw->length_unit, sizeof raw->length_unit, "px");
    (void)snprintf(raw->remark, sizeof raw->remark, "y as in version %s", y_down ? "8" : "5");
    fst_status status = track_split(&heads, text->lines[header], separator, error);
    for (size_t i = header + 1; i < text->count && status == FST_OK; ++i) {
        if (!text->lines[i][strspn(text->lines[i], " \t")])
            continue;
        status = track_split(&cells, text->lines[i], separator, error);
        frame += 1.0;
        for (int k = 0; k + 1 < heads.count && status == FST_OK; ++k) {
            if (!take_apart(heads.cell[k], name, &axis) || axis != 'x' ||
                !take_apart(heads.cell[k + 1], other, &second) || second != 'y' || strcmp(name, other) != 0)
                continue;
            track_spot spot = {.frame = frame, .t = NAN, .line = i + 1};
            double *const values[] = {&spot.x, &spot.y};
            for (int j = 0; j < 2 && status == FST_OK; ++j) {
                const char *cell = k + j < cells.count ? cells.cell[k + j] : "";
                if (track_number(cell, values[j]) == TRACK_WORD)
                    status = track_fail_line(text->path, i + 1, error, "column %d (%s): %s is no number",
                                             k + j + 1, heads.cell[k + j], fst_quote(cell, quoted));
            }
            if (status == FST_OK)
                status = track_raw_name(raw, name, &spot.track, error);
            if (status == FST_OK)
                status = track_raw_add(raw, spot, error);
        }
    }
    track_cells_free(&heads);
    track_cells_free(&cells);
    return status;
}
