/* read_tracker.c - what Tracker (Open Source Physics) writes as text:
 *
 *   mass_A                      ,mass_A,,,,mass_C
 *   t      x      y             t,x,y,vx,vy,x,y
 *   0      1,2    -3            0,1.2,-3,...
 *
 * The first line has the names of tracks above the first column of each.  Decimal signs and separators are
 * those of the user's language.  The unit of length is nowhere.
 */
#include "track/read_formats.h"

#include <string.h>

#include "base/text.h"

enum { MOST_TRACKS = 64 };

typedef struct layout {
    int time, count;
    int x[MOST_TRACKS], y[MOST_TRACKS];
    char name[MOST_TRACKS][TRACK_NAME_SIZE];
} layout;

static fst_status find_layout(const track_text *text, size_t header, const track_cells *names,
                              const track_cells *cells, layout *found, fst_error *error)
{
    found->time = -1;
    found->count = 0;
    for (int i = 0; i < cells->count; ++i) {
        track_column column;
        track_column_of(cells->cell[i], &column);
        if (strcmp(column.name, "t") == 0)
            found->time = i;
        if (strcmp(column.name, "x") == 0 && found->count < MOST_TRACKS) {
            int named = i < names->count ? i : names->count - 1;
            while (named > 0 && !names->cell[named][0])
                --named;
            found->x[found->count] = i;
            found->y[found->count] = -1;
            (void)snprintf(found->name[found->count++], TRACK_NAME_SIZE, "%s",
                           named >= 0 ? names->cell[named] : "");
        }
        if (strcmp(column.name, "y") == 0 && found->count > 0)
            found->y[found->count - 1] = i;
    }
    if (found->time < 0)
        return track_fail_line(text->path, header + 2, error, "no column is called t");
    for (int k = 0; k < found->count; ++k)
        if (found->y[k] < 0)
            return track_fail_line(text->path, header + 2, error,
                                   "track \"%.40s\" has a column x, but none called y", found->name[k]);
    return FST_OK;
}

/* A cell's number; NAN where it is empty or not there. */
static fst_status cell_number(const track_text *text, size_t line, const track_cells *cells, int at,
                              double *value, fst_error *error)
{
    char quoted[FST_QUOTE_SIZE];
    *value = NAN;
    if (at < cells->count && track_number(cells->cell[at], value) == TRACK_WORD)
        return track_fail_line(text->path, line, error, "column %d: %s is no number", at + 1,
                               fst_quote(cells->cell[at], quoted));
    return FST_OK;
}

static fst_status take_row(const track_text *text, size_t line, const track_cells *cells, const layout *found,
                           track_raw *raw, fst_error *error)
{
    double t, x, y;
    fst_status status = cell_number(text, line, cells, found->time, &t, error);
    if (status == FST_OK && isnan(t))
        return track_fail_line(text->path, line, error, "column %d (t) is empty", found->time + 1);
    for (int k = 0; k < found->count && status == FST_OK; ++k) {
        track_spot spot = {.frame = NAN, .t = t, .line = line};
        status = cell_number(text, line, cells, found->x[k], &x, error);
        if (status == FST_OK)
            status = cell_number(text, line, cells, found->y[k], &y, error);
        if (status == FST_OK)
            status = track_raw_name(raw, found->name[k], &spot.track, error);
        spot.x = x;
        spot.y = y;
        if (status == FST_OK)
            status = track_raw_add(raw, spot, error);
    }
    return status;
}

fst_status track_read_tracker(const track_text *text, size_t header, track_raw *raw, fst_error *error)
{
    track_cells names = {.count = 0}, cells = {.count = 0};
    layout found;
    if (header + 1 >= text->count)
        return track_fail_line(text->path, header + 1, error, "the names of columns are missing");
    const char separator = track_separator_of(text->lines[header + 1]);
    fst_status status = track_split(&names, text->lines[header], separator, error);
    if (status == FST_OK)
        status = track_split(&cells, text->lines[header + 1], separator, error);
    if (status == FST_OK)
        status = find_layout(text, header, &names, &cells, &found, error);
    for (size_t i = header + 2; i < text->count && status == FST_OK; ++i) {
        if (!text->lines[i][strspn(text->lines[i], " \t")])
            continue;
        status = track_split(&cells, text->lines[i], separator, error);
        if (status == FST_OK)
            status = take_row(text, i + 1, &cells, &found, raw, error);
    }
    track_cells_free(&names);
    track_cells_free(&cells);
    return status;
}
