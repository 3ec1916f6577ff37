/* read_tracker.c - tables in which each row is a moment, and tracks stand side by side: what Tracker (Open
 * Source Physics) writes as text, and DLTdv's points.
 *
 *   mass_A                      ,mass_A,,,,mass_C           pt1_cam1_X,pt1_cam1_Y,pt2_cam1_X,...
 *   t      x      y             t,x,y,vx,vy,x,y             12.5,80.1,NaN,...
 *   0      1,2    -3            0,1.2,-3,...
 *
 * Tracker's first line has the names of tracks above the first column of each; the unit of length is nowhere.
 * DLTdv writes a row a frame, in pixels of which the first is 1; y points up in version 5, whose origin is at
 * the bottom left, and down in version 8.
 */
#include "tracks/read_formats.h"

#include <stdlib.h>
#include <string.h>

#include "base/error.h"
#include "base/text.h"

enum { MOST_TRACKS = FST_TEXT_CELLS / 2 };

typedef struct layout {
    fst_text_table table;
    fst_text_column time; /* without a place: the row is the frame */
    int count;
    struct {
        fst_text_column x, y;
        char name[TRACK_NAME_SIZE];
    } tracks[MOST_TRACKS];
} layout;

static void add_track(layout *l, int place, const char *name, int length)
{
    if (l->count == MOST_TRACKS)
        return;
    l->tracks[l->count].x = (fst_text_column){.names = "x", .kind = FST_UNIT_NUMBER, .place = place};
    l->tracks[l->count].y = (fst_text_column){.names = "y", .kind = FST_UNIT_NUMBER, .place = 0};
    (void)snprintf(l->tracks[l->count++].name, TRACK_NAME_SIZE, "%.*s", length, name);
}

/* Tracker's columns t, x and y, and the names in the line above; the cells become those of that line. */
static fst_status find_tracker(layout *l, size_t header)
{
    fst_text_table *table = &l->table;
    if (header + 1 >= table->text->count)
        return fst_text_fail(table->text->path, header + 1, table->error, "the names of columns are missing");
    fst_status status = fst_text_split(table, header + 2, '\0');
    for (int i = 0; i < table->count && status == FST_OK; ++i) {
        if (fst_text_is_named(table->cells[i], "t"))
            l->time.place = i + 1;
        if (fst_text_is_named(table->cells[i], "x"))
            add_track(l, i + 1, "", 0);
        if (fst_text_is_named(table->cells[i], "y") && l->count > 0)
            l->tracks[l->count - 1].y.place = i + 1;
    }
    if (status == FST_OK && !l->time.place)
        return fst_text_fail(table->text->path, header + 2, table->error, "no column is called t");
    if (status == FST_OK)
        status = fst_text_split(table, header + 1, table->separator);
    for (int k = 0; k < l->count && status == FST_OK; ++k) {
        int named = l->tracks[k].x.place < table->count ? l->tracks[k].x.place - 1 : table->count - 1;
        while (named > 0 && !table->cells[named][0])
            --named;
        (void)snprintf(l->tracks[k].name, TRACK_NAME_SIZE, "%s", table->cells[named]);
        if (!l->tracks[k].y.place)
            return fst_text_fail(table->text->path, header + 2, table->error,
                                 "track \"%.40s\" has a column x, but none called y", l->tracks[k].name);
    }
    table->line = header + 2;
    return status;
}

/* DLTdv's columns: "pt1_cam1_X" and behind it "pt1_cam1_Y" are the track "pt1_cam1". */
static fst_status find_dltdv(layout *l, size_t header)
{
    const fst_status status = fst_text_split(&l->table, header + 1, '\0');
    for (int i = 0; i + 1 < l->table.count && status == FST_OK; ++i) {
        const char *x = l->table.cells[i], *y = l->table.cells[i + 1], *last = strrchr(x, '_');
        const size_t length = last ? (size_t)(last - x) : 0;
        if (length == 0 || length >= TRACK_NAME_SIZE || strncmp(x, "pt", 2) != 0 || fst_lower(last[1]) != 'x' ||
            last[2] || strncmp(x, y, length + 1) != 0 || fst_lower(y[length + 1]) != 'y' || y[length + 2])
            continue;
        add_track(l, i + 1, x, (int)length);
        l->tracks[l->count - 1].y.place = i + 2;
    }
    return status;
}

static fst_status take_row(layout *l, double frame, track_raw *raw)
{
    double t;
    fst_status status = fst_text_value(&l->table, &l->time, &t);
    if (status == FST_OK && isnan(t) && l->time.place)
        return fst_text_fail_cell(&l->table, &l->time, NULL, "is empty");
    for (int k = 0; k < l->count && status == FST_OK; ++k) {
        track_spot spot = {
            .frame = l->time.place ? NAN : frame, .t = t, .x = NAN, .y = NAN, .line = l->table.line};
        if (l->tracks[k].x.place <= l->table.count)
            status = fst_text_value(&l->table, &l->tracks[k].x, &spot.x);
        if (status == FST_OK && l->tracks[k].y.place <= l->table.count)
            status = fst_text_value(&l->table, &l->tracks[k].y, &spot.y);
        if (status == FST_OK)
            status = track_raw_name(raw, l->tracks[k].name, &spot.track, l->table.error);
        if (status == FST_OK)
            status = track_raw_add(raw, spot, l->table.error);
    }
    return status;
}

static fst_status read_rows(layout *l, track_raw *raw)
{
    int more = 1;
    l->table.ragged = 1;
    for (double frame = 1.0;; frame += 1.0) {
        fst_status status = fst_text_row(&l->table, &more);
        if (status == FST_OK && more)
            status = take_row(l, frame, raw);
        if (status != FST_OK || !more)
            return status;
    }
}

static fst_status read_layout(const fst_text *text, size_t header, fst_status (*find)(layout *, size_t),
                              track_raw *raw, fst_error *error)
{
    layout *l = malloc(sizeof *l);
    if (!l)
        return fst_fail(error, FST_NO_MEMORY, text->path, "no memory for this file");
    fst_text_begin(&l->table, text, error);
    l->time = (fst_text_column){.names = "t", .kind = FST_UNIT_NUMBER, .place = 0};
    l->count = 0;
    fst_status status = find(l, header);
    if (status == FST_OK)
        status = read_rows(l, raw);
    fst_text_end(&l->table);
    free(l);
    return status;
}

fst_status track_read_tracker(const fst_text *text, size_t header, int variant, track_raw *raw,
                              fst_error *error)
{
    (void)variant;
    return read_layout(text, header, find_tracker, raw, error);
}

fst_status track_read_dltdv(const fst_text *text, size_t header, int variant, track_raw *raw, fst_error *error)
{
    raw->y_down = variant == 8;
    (void)snprintf(raw->length_unit, sizeof raw->length_unit, "px");
    (void)snprintf(raw->remark, sizeof raw->remark, "y as in version %d", variant);
    return read_layout(text, header, find_dltdv, raw, error);
}
