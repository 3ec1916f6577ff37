/* read_columns.c - tables in which each row is a place of a bead: festoon's own CSV, any table that names its
 * columns, trackpy's, TrackMate's table of spots, and ImageJ's Manual Tracking.
 *
 *   frame,t [s],x [mm],y [mm]        t;x (cm);y (cm)        Time [ms]  X [px]  Y [px]  track
 *
 * An empty cell, or NaN, is a frame in which the bead was lost.  TrackMate writes up to three lines of names
 * and units below its head, and spots that belong to no track.
 */
#include "tracks/raw.h"

#include <string.h>

#include "base/error.h"
#include "base/grow.h"
#include "base/text.h"
#include "tracks/read_formats.h"

/* The columns of a turning are those of fst_turning in its order (track.c writes them), or none is taken. */
enum { FRAME, TIME, X, Y, NAME, DOUBTS, TURNING, NUMBERS = 11, ROLES = TURNING + NUMBERS };
_Static_assert(sizeof(fst_turning) == NUMBERS * sizeof(double), "a turning has so many numbers");

/* A format: the names of its columns, its unit of length where the head says none, and the way of its y. */
typedef struct style {
    const char *names[ROLES];
    const char *length_unit, *time_unit;
    int y_down, spots; /* spots: TrackMate's lines of units, and spots of no track */
} style;

#define USUAL_NAMES                                                                                            \
    {                                                                                                          \
        "frame|frames|frame number|image", "t|time|timestamp", "x|pos x|position x|xpos",                      \
            "y|pos y|position y|ypos", "track|particle|object|track id", "doubts", "nx", "ny", "nz",           \
            "n_error", "wx", "wy", "wz", "w_error", "slip_x", "slip_y", "slip_error"                           \
    }

static const style styles[] = {
    [TRACK_ANY_COLUMNS] = {USUAL_NAMES, "", "s", 0, 0},
    [TRACK_TRACKPY] = {USUAL_NAMES, "px", "s", 1, 0},
    [TRACK_TRACKMATE] = {{"FRAME", "POSITION_T", "POSITION_X", "POSITION_Y", "TRACK_ID", ""}, "", "sec", 1, 1},
    [TRACK_IMAGEJ] = {{"slice n*", "", "x", "y", "track n*", ""}, "px", "s", 1, 0},
};

typedef struct reader {
    fst_text_table table;
    fst_text_column columns[ROLES];
    const style *style;
    track_raw *raw;
} reader;

/* Check the units in the head and note them. */
static fst_status take_units(reader *r)
{
    const char *x = r->columns[X].unit, *y = r->columns[Y].unit, *path = r->table.text->path;
    fst_error *error = r->table.error;
    char quoted[FST_QUOTE_SIZE];
    if (!r->columns[FRAME].place && !r->columns[TIME].place)
        return fst_text_fail(path, r->table.line, error,
                             "there is neither a column t [s] nor a column frame: when was the bead at these "
                             "places?");
    if (strcmp(x, y) != 0)
        return fst_text_fail(path, r->table.line, error,
                             "x is in [%s] and y in [%s]: one unit was expected for both", x, y);
    if (x[0] && !track_is_pixel(x) && track_length_unit(x) == 0.0)
        return fst_text_fail(path, r->table.line, error,
                             "%s is not a unit of length that is known; these are: px %s", fst_quote(x, quoted),
                             fst_unit_accepted(FST_UNIT_LENGTH));
    (void)snprintf(r->raw->length_unit, sizeof r->raw->length_unit, "%s", x[0] ? x : r->style->length_unit);
    char *t = r->columns[TIME].unit;
    if (!r->columns[TIME].place || !t[0])
        (void)snprintf(t, FST_TEXT_UNIT, "%s", r->style->time_unit);
    r->raw->time_unit = track_time_unit(t);
    if (r->raw->time_unit == 0.0)
        return fst_text_fail(path, r->table.line, error,
                             "%s is not a unit of time that is known; these are: s ms us min",
                             fst_quote(t, quoted));
    return FST_OK;
}

/* Whether this row is one of TrackMate's names and units, as "(micron)"; keep the units of the last one. */
static int is_of_units(reader *r)
{
    double number;
    if (fst_text_number(fst_text_cell(&r->table, &r->columns[FRAME]), &number) == FST_TEXT_NUMBER)
        return 0;
    const int roles[] = {X, TIME};
    char *const units[] = {r->raw->length_unit, r->columns[TIME].unit};
    for (int i = 0; i < 2; ++i) {
        const char *cell = fst_text_cell(&r->table, &r->columns[roles[i]]);
        const char *from = cell + strspn(cell, "([ ");
        if (cell[0])
            (void)snprintf(units[i], FST_TEXT_UNIT, "%.*s", (int)strcspn(from, ")] "), from);
    }
    return 1;
}

/* How the bead turns, where the table and the row say it. */
static fst_status take_turning(reader *r, track_spot *spot)
{
    double numbers[NUMBERS];
    int known = 0;
    for (int i = 0; i < NUMBERS; ++i) {
        if (!r->columns[TURNING + i].place)
            return FST_OK;
        const fst_status status = fst_text_value(&r->table, &r->columns[TURNING + i], &numbers[i]);
        if (status != FST_OK)
            return status;
        known += isfinite(numbers[i]);
    }
    if (known == 0)
        return FST_OK;
    if (!fst_grow(&r->raw->turnings, (size_t)r->raw->turned, sizeof *r->raw->turnings))
        return fst_fail(r->table.error, FST_NO_MEMORY, "", "no memory for more than %d turnings",
                        r->raw->turned);
    memcpy(&r->raw->turnings[r->raw->turned], numbers, sizeof numbers);
    spot->turning = ++r->raw->turned;
    return FST_OK;
}

static fst_status take_row(reader *r)
{
    track_spot spot = {.line = r->table.line};
    const char *name = fst_text_cell(&r->table, &r->columns[NAME]);
    double *const values[] = {&spot.frame, &spot.t, &spot.x, &spot.y};
    fst_status status = FST_OK;
    if (r->style->spots && (!name[0] || strcmp(name, "None") == 0))
        return FST_OK;
    for (int role = FRAME; role <= Y && status == FST_OK; ++role)
        status = fst_text_value(&r->table, &r->columns[role], values[role]);
    const int key = r->columns[FRAME].place ? FRAME : TIME;
    if (status == FST_OK && isnan(*values[key]))
        status = fst_text_fail_cell(&r->table, &r->columns[key], NULL, "is empty");
    double doubts = NAN;
    if (status == FST_OK)
        status = fst_text_value(&r->table, &r->columns[DOUBTS], &doubts);
    if (status == FST_OK && !(isnan(doubts) || (doubts >= 0.0 && doubts < 1e9 && doubts == floor(doubts))))
        status = fst_text_fail_cell(&r->table, &r->columns[DOUBTS], NULL, "is not a whole number from 0 on");
    spot.doubts = isnan(doubts) ? 0 : (int)doubts;
    if (status == FST_OK)
        status = take_turning(r, &spot);
    if (status == FST_OK)
        status = track_raw_name(r->raw, name, &spot.track, r->table.error);
    return status == FST_OK ? track_raw_add(r->raw, spot, r->table.error) : status;
}

/* TrackMate writes frames for times where it knows no interval. */
static void take_clock(reader *r)
{
    r->raw->time_unit = track_time_unit(r->columns[TIME].unit);
    for (size_t i = 0; i < r->raw->count && r->raw->time_unit == 0.0; ++i)
        r->raw->spots[i].t = NAN;
    r->raw->time_unit = r->raw->time_unit > 0.0 ? r->raw->time_unit : 1.0;
}

/* A number behind such words in the comments before the head, from 0 to `most`, which is not reached. */
static fst_status take_comment(reader *r, const char *words, double most, const char *expected, double *value)
{
    const fst_text *text = r->table.text;
    const size_t size = strlen(words);
    for (size_t i = 0; i + 1 < r->table.line; ++i)
        if (strncmp(text->lines[i], words, size) == 0 &&
            !(fst_text_number(text->lines[i] + size, value) == FST_TEXT_NUMBER && *value >= 0.0 &&
              *value < most))
            return fst_text_fail(text->path, i + 1, r->table.error, "%s", expected);
    return FST_OK;
}

/* festoon's own comments: the relative error of the scale, and the harmonics of the turning. */
static fst_status take_comments(reader *r)
{
    double rhythm = 0.0;
    fst_status status =
        take_comment(r, TRACK_SCALE_ERROR, 1.0,
                     "the relative error of the scale is a number from 0 to 1, as 0.004", &r->raw->scale_error);
    if (status == FST_OK)
        status = take_comment(r, TRACK_RHYTHM, 1000.0, "the rhythm is a number of harmonics, as 3", &rhythm);
    r->raw->rhythm = (int)rhythm;
    return status;
}

fst_status track_read_columns(const fst_text *text, size_t header, int variant, track_raw *raw,
                              fst_error *error)
{
    (void)header;
    reader r = {.style = &styles[variant], .raw = raw};
    int more = 1, units = r.style->spots;
    /* pandas writes an index called frame beside the column of this name; a table of `festoon run` has nX and n_x, and
     * no turning, because it says no errors. */
    for (int role = 0; role < ROLES; ++role)
        r.columns[role] = (fst_text_column){.names = r.style->names[role] ? r.style->names[role] : "",
                                            .kind = FST_UNIT_NUMBER,
                                            .needed = role == X || role == Y,
                                            .repeats = role == FRAME || role >= TURNING};
    raw->y_down = r.style->y_down;
    fst_text_begin(&r.table, text, error);
    r.table.ragged = 1;
    fst_status status = fst_text_head(&r.table, r.columns, ROLES, "t [s],x [mm],y [mm]");
    if (status == FST_OK)
        status = take_units(&r);
    raw->is_whole = r.columns[NAME].place && r.columns[DOUBTS].place;
    if (status == FST_OK)
        status = take_comments(&r);
    while (status == FST_OK) {
        status = fst_text_row(&r.table, &more);
        if (status != FST_OK || !more)
            break;
        units = units && is_of_units(&r);
        if (!units)
            status = take_row(&r);
    }
    if (status == FST_OK && r.style->spots)
        take_clock(&r);
    fst_text_end(&r.table);
    return status;
}
