/* points.c - the table of measured points: reading it without trusting it, and writing it.
 *
 * Whatever a person may get wrong in such a table is said with its line and column: nothing is guessed, because
 * a number in a wrong column or unit would still give parameters, only wrong ones.
 */
#include <festoon/fit.h>

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/error.h"
#include "base/number.h"
#include "base/text.h"
#include "base/units.h"
#include "host/regular_file.h"
#include "host/whole_file.h"

enum {
    FREQUENCY_COLUMNS = 2, /* frequency and its error; those of the quantities follow, each with its error */
    KNOWN_COLUMNS = FREQUENCY_COLUMNS + 2 * FST_MEASURED_COUNT,
    MOST_CELLS = 64,
    MOST_ROWS = 100000,
    LONGEST_FILE = 16 * 1024 * 1024
};

static const char *const names[FST_MEASURED_COUNT] = {"mean_r", "std_r", "bead_frequency"};

const char *fst_measured_name(fst_measured what)
{
    return names[what];
}

fst_unit fst_measured_unit(fst_measured what)
{
    return what == FST_MEASURED_BEAD_FREQUENCY ? FST_UNIT_FREQUENCY : FST_UNIT_LENGTH;
}

void fst_points_free(fst_points *points)
{
    free(points->rows);
    *points = (fst_points){0};
}

/* ------------------------------------------------------------------ columns */

static fst_unit unit_of(int known)
{
    return known < FREQUENCY_COLUMNS ? FST_UNIT_FREQUENCY
                                     : fst_measured_unit((fst_measured)((known - FREQUENCY_COLUMNS) / 2));
}

static void name_of(int known, char name[32])
{
    const char *stem = known < FREQUENCY_COLUMNS ? "frequency" : names[(known - FREQUENCY_COLUMNS) / 2];
    (void)snprintf(name, 32, "%s%s", stem, known % 2 ? "_error" : "");
}

/* Where a column's number belongs in a row. */
static double *place_of(fst_point *row, int known)
{
    if (known < FREQUENCY_COLUMNS)
        return known ? &row->frequency_error : &row->frequency;
    const int what = (known - FREQUENCY_COLUMNS) / 2;
    return known % 2 ? &row->error[what] : &row->value[what];
}

/* ------------------------------------------------------------------ lines and cells */

/* A file on its way through the reader.  Lines and cells are cut out of `text` in place. */
typedef struct reader {
    const char *path;
    char *at; /* the rest of the text */
    int line;
    char separator;
    int columns, known[MOST_CELLS]; /* which known column each of the file's is */
    char where[256];
    fst_error *error;
} reader;

static fst_status wrong_line(reader *r, const char *sentence)
{
    (void)snprintf(r->where, sizeof r->where, "%.200s:%d", r->path, r->line);
    return fst_fail(r->error, FST_BAD_INPUT, r->where, "%s", sentence);
}

/* Complain about a cell; `column` counts from 0. */
static fst_status wrong_cell(reader *r, int column, const char *cell, const char *what)
{
    char quoted[FST_QUOTE_SIZE], name[32], sentence[400];
    name_of(r->known[column], name);
    (void)snprintf(sentence, sizeof sentence, "column %d (%s): %s%s%s", column + 1, name,
                   cell ? fst_quote(cell, quoted) : "", cell ? " " : "", what);
    return wrong_line(r, sentence);
}

/* The next line that says something, or NULL at the end. */
static char *next_line(reader *r)
{
    while (r->at && *r->at) {
        char *line = r->at, *end = strpbrk(line, "\r\n");
        r->line += 1;
        r->at = end;
        if (end) {
            r->at += end[0] == '\r' && end[1] == '\n' ? 2 : 1;
            *end = '\0';
        }
        size_t length;
        const char *trimmed = fst_trim(line, &length);
        if (length > 0 && *trimmed != '#')
            return line;
    }
    return NULL;
}

/* Cut a line into its cells; a cell in double quotes loses them.  Returns how many there are, or -1. */
static int cut(char *line, char separator, char *cells[MOST_CELLS])
{
    int count = 0;
    for (char *at = line; at;) {
        if (count == MOST_CELLS)
            return -1;
        char *end = strchr(at, separator);
        if (end)
            *end++ = '\0';
        size_t length;
        char *cell = at + (fst_trim(at, &length) - at);
        cell[length] = '\0';
        if (length >= 2 && cell[0] == '"' && cell[length - 1] == '"') {
            cell[length - 1] = '\0';
            cell += 1;
        }
        cells[count++] = cell;
        at = end;
    }
    return count;
}

/* ------------------------------------------------------------------ the header */

static fst_status unknown_column(reader *r, int column, const char *name)
{
    char all[256] = "", nearest[32], quoted[FST_QUOTE_SIZE], sentence[400];
    for (int k = 0; k < KNOWN_COLUMNS; ++k) {
        char known[32];
        name_of(k, known);
        const size_t used = strlen(all);
        (void)snprintf(all + used, sizeof all - used, "%s%s", used ? "|" : "", known);
    }
    fst_nearest_name(name, all, nearest, sizeof nearest);
    (void)snprintf(sentence, sizeof sentence,
                   "column %d: there is no column %s; the nearest is %s. The first line names the columns with "
                   "their units, as in \"frequency [Hz],mean_r [mm],mean_r_error [mm]\"",
                   column + 1, fst_quote(name, quoted), nearest);
    return wrong_line(r, sentence);
}

/* Read "mean_r [mm]": which column this is, and in which unit; `cell` is cut, its unit left in *unit. */
static fst_status read_column(reader *r, int column, char *cell, const char **unit)
{
    char *open = strchr(cell, '['), *close = open ? strchr(open, ']') : NULL, name[32];
    if (open)
        *open = '\0';
    size_t length;
    char *word = cell + (fst_trim(cell, &length) - cell);
    word[length] = '\0';
    int known = 0;
    for (name_of(known, name); strcmp(word, name) != 0; name_of(known, name))
        if (++known == KNOWN_COLUMNS)
            return unknown_column(r, column, word);
    for (int c = 0; c < column; ++c)
        if (r->known[c] == known) {
            r->known[column] = known;
            return wrong_cell(r, column, NULL, "this column is there twice");
        }
    r->known[column] = known;
    char sentence[200];
    const fst_unit kind = unit_of(known);
    (void)snprintf(sentence, sizeof sentence, "has no unit; write %s [%s] (units here: %s)", name,
                   kind == FST_UNIT_LENGTH ? "mm" : "Hz", fst_unit_accepted(kind));
    if (!open || !close || close[1])
        return wrong_cell(r, column, NULL, sentence);
    *close = '\0';
    *unit = open + 1;
    double one;
    char value[80];
    fst_error why;
    (void)snprintf(value, sizeof value, "1 %.64s", *unit);
    size_t unit_length;
    (void)fst_trim(*unit, &unit_length);
    if (unit_length == 0)
        return wrong_cell(r, column, NULL, sentence);
    if (fst_parse_value(value, kind, &one, &why) != FST_OK) {
        (void)snprintf(sentence, sizeof sentence, "is no unit of this column (units here: %s)",
                       fst_unit_accepted(kind));
        return wrong_cell(r, column, *unit, sentence);
    }
    return FST_OK;
}

/* Every quantity has its error beside it. */
static fst_status check_columns(reader *r)
{
    int place[KNOWN_COLUMNS], quantities = 0;
    char sentence[300], name[32];
    for (int k = 0; k < KNOWN_COLUMNS; ++k)
        place[k] = -1;
    for (int c = 0; c < r->columns; ++c)
        place[r->known[c]] = c;
    if (place[0] < 0)
        return wrong_line(r, "the column \"frequency [Hz]\", how often the magnet turns, is missing");
    for (int k = FREQUENCY_COLUMNS; k < KNOWN_COLUMNS; k += 2) {
        name_of(k, name);
        quantities += place[k] >= 0;
        if ((place[k] >= 0) == (place[k + 1] >= 0))
            continue;
        if (place[k] >= 0)
            (void)snprintf(sentence, sizeof sentence,
                           "has no column %s_error beside it: without errors nothing can be said about the "
                           "parameters",
                           name);
        else
            (void)snprintf(sentence, sizeof sentence, "belongs to %s, and there is no such column", name);
        return wrong_cell(r, place[k] >= 0 ? place[k] : place[k + 1], NULL, sentence);
    }
    return quantities
               ? FST_OK
               : wrong_line(r,
                            "there is no column of a measured quantity: mean_r, std_r or bead_frequency, each "
                            "with its error");
}

static fst_status read_header(reader *r, char units[MOST_CELLS][16], fst_points *points)
{
    char *line = next_line(r), *cells[MOST_CELLS];
    if (!line)
        return fst_fail(r->error, FST_BAD_INPUT, r->path,
                        "it is empty; the first line names the columns, as in \"frequency [Hz],mean_r "
                        "[mm],mean_r_error [mm]\"");
    r->separator = strchr(line, ';') ? ';' : strchr(line, '\t') ? '\t' : ',';
    r->columns = cut(line, r->separator, cells);
    if (r->columns < 0)
        return wrong_line(r, "it has more than 64 columns");
    for (int c = 0; c < r->columns; ++c) {
        const char *unit = "";
        const fst_status status = read_column(r, c, cells[c], &unit);
        if (status != FST_OK)
            return status;
        (void)snprintf(units[c], 16, "%s", unit);
        if (r->known[c] >= FREQUENCY_COLUMNS && r->known[c] % 2 == 0)
            points->column[(r->known[c] - FREQUENCY_COLUMNS) / 2] = c + 1;
    }
    return check_columns(r);
}

/* ------------------------------------------------------------------ rows */

static fst_status read_cell(reader *r, int column, char *cell, const char *unit, double *value)
{
    *value = NAN;
    if (!cell[0])
        return FST_OK;
    for (char *comma = strchr(cell, ','); comma && r->separator != ','; comma = NULL)
        *comma = '.';
    if (strncmp(cell, "\xE2\x88\x92", 3) == 0) { /* the minus sign of typesetters */
        cell += 2;
        *cell = '-';
    }
    char text[160];
    const size_t length = strlen(cell);
    if (length > 100 || fst_number_length(cell) != length)
        return wrong_cell(r, column, cell,
                          "is no decimal number; leave the cell empty where nothing was measured");
    (void)snprintf(text, sizeof text, "%s %s", cell, unit);
    fst_error why;
    if (fst_parse_value(text, unit_of(r->known[column]), value, &why) != FST_OK)
        return wrong_cell(r, column, cell, "is too large for a number");
    if (r->known[column] % 2 && !(*value > 0.0))
        return wrong_cell(r, column, cell, "is no error: it must be greater than 0");
    return FST_OK;
}

/* What a row says must be possible, and each of its numbers needs its error. */
static fst_status check_row(reader *r, fst_point *row)
{
    if (isnan(row->frequency))
        return wrong_line(r, "the frequency is empty; each row says how often the magnet turned");
    for (int c = 0; c < r->columns; ++c) {
        const int known = r->known[c];
        const double value = *place_of(row, known);
        if (known == 0 && !(fabs(value) >= 1e-6 && fabs(value) <= 1e6))
            return wrong_cell(r, c, NULL, "the magnet must turn, from 1e-6 to 1e6 times a second");
        if (known < FREQUENCY_COLUMNS || known % 2)
            continue;
        const int missing = isnan(*place_of(row, known + 1));
        if (isnan(value) != missing)
            return wrong_cell(r, c, NULL,
                              missing ? "the error of this number is empty; leave out both or none"
                                      : "the number is empty, but its error is there; leave out both or none");
        const int what = (known - FREQUENCY_COLUMNS) / 2;
        if ((what == FST_MEASURED_MEAN_R && value <= 0.0) || (what == FST_MEASURED_STD_R && value < 0.0))
            return wrong_cell(r, c, NULL, "a distance is never negative");
    }
    return FST_OK;
}

static fst_status read_row(reader *r, char *line, char units[MOST_CELLS][16], fst_point *row)
{
    char *cells[MOST_CELLS], sentence[200];
    *row = (fst_point){NAN, NAN, {NAN, NAN, NAN}, {NAN, NAN, NAN}, r->line};
    const int count = cut(line, r->separator, cells);
    if (count != r->columns) {
        char name[32] = "";
        if (count >= 0 && count < r->columns)
            name_of(r->known[count], name);
        if (name[0])
            (void)snprintf(sentence, sizeof sentence,
                           "the row ends before column %d (%s): it has %d cells, the first line %d", count + 1,
                           name, count, r->columns);
        else
            (void)snprintf(sentence, sizeof sentence,
                           "the row goes on after column %d, the last of the first line", r->columns);
        return wrong_line(r, sentence);
    }
    fst_status status = FST_OK;
    for (int c = 0; c < count && status == FST_OK; ++c)
        status = read_cell(r, c, cells[c], units[c], place_of(row, r->known[c]));
    return status == FST_OK ? check_row(r, row) : status;
}

static fst_status read_rows(reader *r, char units[MOST_CELLS][16], fst_points *points)
{
    size_t capacity = 0;
    for (char *line = next_line(r); line; line = next_line(r)) {
        if (points->count == MOST_ROWS)
            return wrong_line(r, "there are more than 100000 rows");
        if (points->count == capacity) {
            capacity = capacity ? 2 * capacity : 16;
            fst_point *more = realloc(points->rows, capacity * sizeof *more);
            if (!more)
                return fst_fail(r->error, FST_NO_MEMORY, r->path, "out of memory");
            points->rows = more;
        }
        const fst_status status = read_row(r, line, units, &points->rows[points->count]);
        if (status != FST_OK)
            return status;
        points->count += 1;
    }
    if (points->count == 0)
        return wrong_line(r, "no row follows the names of the columns");
    return FST_OK;
}

fst_status fst_points_read(const char *path, fst_points *points, fst_error *error)
{
    char *text = NULL, units[MOST_CELLS][16];
    size_t size = 0;
    *points = (fst_points){0};
    fst_status status = fst_read_regular(path, LONGEST_FILE, &text, &size, error);
    if (status != FST_OK)
        return status;
    reader r = {.path = path, .at = text, .error = error};
    if (memchr(text, '\0', size))
        status = fst_fail(error, FST_BAD_INPUT, path, "it is no text");
    else if (strncmp(text, "\xEF\xBB\xBF", 3) == 0) /* the mark that some editors put before UTF-8 */
        r.at += 3;
    if (status == FST_OK)
        status = read_header(&r, units, points);
    if (status == FST_OK)
        status = read_rows(&r, units, points);
    free(text);
    if (status != FST_OK)
        fst_points_free(points);
    return status;
}

/* ------------------------------------------------------------------ a track as a row */

fst_status fst_point_of(const fst_measurement *m, double drive, fst_point *row, fst_error *error)
{
    double length;
    char one[16];
    (void)snprintf(one, sizeof one, "1 %s", m->length_unit);
    if (fst_parse_value(one, FST_UNIT_LENGTH, &length, NULL) != FST_OK)
        return fst_fail(error, FST_BAD_INPUT, "fst_point_of",
                        "a table of points needs lengths, not pixels: give fst_track_options.scale");
    /* The drive of the track goes with the bead's rate by the same clock. */
    const int told = isfinite(m->drive_from_track_hz);
    if (!told && isnan(drive))
        return fst_fail(error, FST_BAD_INPUT, "fst_point_of",
                        "the track does not tell the drive: give fst_measure_options.drive");
    const double values[FST_MEASURED_COUNT][2] = {{length * m->mean_r, length * m->mean_r_error},
                                                  {length * m->std_r, length * m->std_r_error},
                                                  {m->bead_frequency_hz, m->bead_frequency_hz_error}};
    *row = (fst_point){.frequency = told ? m->drive_from_track_hz : fabs(drive),
                       .frequency_error = told ? m->drive_from_track_hz_error : NAN};
    for (int q = 0; q < FST_MEASURED_COUNT; ++q) {
        const int whole = isfinite(values[q][0]) && values[q][1] > 0;
        row->value[q] = whole ? values[q][0] : NAN;
        row->error[q] = whole ? values[q][1] : NAN;
    }
    return FST_OK;
}

/* ------------------------------------------------------------------ writing */

/* Write a number in a unit that is 10^-shift of the SI unit, so that it is read back to the same bits: the
 * digits of the SI value with another exponent, where the plain form would round twice. */
static void write_number(FILE *out, double value, int shift)
{
    char text[48], plain[48];
    if (isnan(value))
        return;
    (void)fst_number_write(text, sizeof text, value);
    const double shifted = fst_number_read(text, strlen(text), shift);
    const double near[] = {shifted, nextafter(shifted, INFINITY), nextafter(shifted, -INFINITY)};
    for (int i = 0; i < 3; ++i) {
        (void)fst_number_write(plain, sizeof plain, near[i]);
        if (fst_number_read(plain, strlen(plain), -shift) == value) {
            (void)fputs(plain, out);
            return;
        }
    }
    const char *exponent = strchr(text, 'e');
    const int digits = (int)(exponent ? exponent - text : (long)strlen(text));
    (void)fprintf(out, "%.*se%d", digits, text, (exponent ? atoi(exponent + 1) : 0) + shift);
}

static void write_rows(FILE *out, const fst_points *points, const int *written)
{
    const char *before = "";
    for (int k = 0; k < KNOWN_COLUMNS; ++k) {
        char name[32];
        name_of(k, name);
        if (written[k]) {
            (void)fprintf(out, "%s%s [%s]", before, name, unit_of(k) == FST_UNIT_LENGTH ? "mm" : "Hz");
            before = ",";
        }
    }
    (void)fputc('\n', out);
    for (size_t i = 0; i < points->count; ++i) {
        fst_point row = points->rows[i];
        before = "";
        for (int k = 0; k < KNOWN_COLUMNS; ++k) {
            if (!written[k])
                continue;
            (void)fputs(before, out);
            write_number(out, *place_of(&row, k), unit_of(k) == FST_UNIT_LENGTH ? 3 : 0);
            before = ",";
        }
        (void)fputc('\n', out);
    }
}

fst_status fst_points_write(const char *path, const fst_points *points, fst_error *error)
{
    int written[KNOWN_COLUMNS];
    fst_whole_file file;
    for (int k = 0; k < KNOWN_COLUMNS; ++k)
        written[k] = k != 1; /* the error of the frequency only where one is known */
    for (size_t i = 0; i < points->count; ++i)
        written[1] |= isfinite(points->rows[i].frequency_error);
    fst_status status = fst_whole_file_open(&file, path, error);
    if (status != FST_OK)
        return status;
    write_rows(file.stream, points, written);
    return fst_whole_file_commit(&file, error);
}
