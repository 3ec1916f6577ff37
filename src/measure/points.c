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
#include "host/whole_file.h"
#include "io/text_table.h"

enum {
    FREQUENCY_COLUMNS = 2, /* frequency and its error; those of the quantities follow, each with its error */
    PAIRED_COLUMNS = FREQUENCY_COLUMNS + 2 * FST_MEASURED_COUNT,
    SCALE_COLUMN = PAIRED_COLUMNS, /* the last: the relative error of the scale of all lengths of a row */
    KNOWN_COLUMNS,
    MOST_ROWS = 100000,
    LONGEST_FILE = 16 * 1024 * 1024
};

#define EXAMPLE "frequency [Hz],mean_r [mm],mean_r_error [mm]"

static const char *const names[] = {FST_MEASURED_QUANTITIES(FST_ROW_NAME)};

const char *fst_measured_name(fst_measured what)
{
    return names[what];
}

fst_unit fst_measured_unit(fst_measured what)
{
#define KIND(NAME, name, doc, unit) FST_UNIT_##unit,
    static const fst_unit kinds[] = {FST_MEASURED_QUANTITIES(KIND)};
#undef KIND
    return kinds[what];
}

void fst_points_free(fst_points *points)
{
    free(points->rows);
    *points = (fst_points){0};
}

/* ------------------------------------------------------------------ columns */

/* The known columns: frequency and quantities, each with its error behind it. */
static const fst_text_column known_columns[KNOWN_COLUMNS] = {
    {"frequency", FST_UNIT_FREQUENCY, .needed = 1},
    {"frequency_error", FST_UNIT_FREQUENCY, .needed = 0},
#define COLUMNS(NAME, name, doc, unit)                                                                         \
    {name, FST_UNIT_##unit, .needed = 0}, {name "_error", FST_UNIT_##unit, .needed = 0},
    FST_MEASURED_QUANTITIES(COLUMNS)
#undef COLUMNS
        {"scale_error", FST_UNIT_NUMBER, .needed = 0},
};

/* Where a column's number belongs in a row. */
static double *place_of(fst_point *row, int known)
{
    if (known == SCALE_COLUMN)
        return &row->scale_error;
    if (known < FREQUENCY_COLUMNS)
        return known ? &row->frequency_error : &row->frequency;
    const int what = (known - FREQUENCY_COLUMNS) / 2;
    return known % 2 ? &row->error[what] : &row->value[what];
}

/* ------------------------------------------------------------------ the head */

/* A file on its way through the reader. */
typedef struct reader {
    fst_text_table table;
    fst_text_column columns[KNOWN_COLUMNS];
} reader;

static fst_status wrong_line(const reader *r, const char *sentence)
{
    return fst_text_fail(r->table.text->path, r->table.line, r->table.error, "%s", sentence);
}

/* Nothing is passed over: a number in a misspelt column would be missed. */
static fst_status refuse_unknown_columns(const reader *r)
{
    for (int cell = 0; cell < r->table.columns; ++cell) {
        char all[256] = "", suggestion[FST_SUGGESTION_SIZE], quoted[FST_QUOTE_SIZE], name[FST_QUOTE_SIZE];
        int known = 0;
        for (int k = 0; k < KNOWN_COLUMNS; ++k) {
            const size_t used = strlen(all);
            (void)snprintf(all + used, sizeof all - used, "%s%s", used ? "|" : "", r->columns[k].names);
            known = known || r->columns[k].place == cell + 1;
        }
        if (known)
            continue;
        (void)snprintf(name, sizeof name, "%.*s", (int)strcspn(r->table.cells[cell], "[(/ "),
                       r->table.cells[cell]);
        return fst_text_fail(r->table.text->path, r->table.line, r->table.error,
                             "column %d: there is no column %s; %s. The first line names the "
                             "columns with their units, as in \"" EXAMPLE "\"",
                             cell + 1, fst_quote(name, quoted), fst_suggest_name(name, all, suggestion));
    }
    return FST_OK;
}

/* Every quantity has its error beside it. */
static fst_status check_columns(const reader *r)
{
    char sentence[300];
    int quantities = 0;
    for (int k = FREQUENCY_COLUMNS; k < PAIRED_COLUMNS; k += 2) {
        const fst_text_column *value = &r->columns[k], *its_error = &r->columns[k + 1];
        quantities += value->place > 0;
        if (value->place && !its_error->place) {
            (void)snprintf(
                sentence, sizeof sentence,
                "has no column %s beside it: without errors nothing can be said about the parameters",
                its_error->names);
            return fst_text_fail_cell(&r->table, value, NULL, sentence);
        }
        if (its_error->place && !value->place) {
            (void)snprintf(sentence, sizeof sentence, "belongs to %s, and there is no such column",
                           value->names);
            return fst_text_fail_cell(&r->table, its_error, NULL, sentence);
        }
    }
    (void)snprintf(sentence, sizeof sentence,
                   "there is no column of a measured quantity (%s), each of which comes with its error",
                   FST_WORDS(FST_MEASURED_QUANTITIES));
    return quantities ? FST_OK : wrong_line(r, sentence);
}

/* ------------------------------------------------------------------ rows */

/* What a row says must be possible, and each of its numbers needs its error. */
static fst_status check_row(const reader *r, fst_point *row)
{
    const fst_text_column *columns = r->columns;
    if (isnan(row->frequency))
        return wrong_line(r, "the frequency is empty; each row says how often the magnet turned");
    if (!(fabs(row->frequency) >= 1e-6 && fabs(row->frequency) <= 1e6))
        return fst_text_fail_cell(&r->table, &columns[0], NULL,
                                  "the magnet must turn, from 1e-6 to 1e6 times a second");
    for (int k = 0; k < PAIRED_COLUMNS; k += 2) {
        const double value = *place_of(row, k), its_error = *place_of(row, k + 1);
        if (its_error <= 0.0)
            return fst_text_fail_cell(&r->table, &columns[k + 1], fst_text_cell(&r->table, &columns[k + 1]),
                                      "is not an error: it must be greater than 0");
        if (k >= FREQUENCY_COLUMNS && isnan(value) != isnan(its_error))
            return fst_text_fail_cell(
                &r->table, &columns[k], NULL,
                isnan(its_error) ? "the error of this number is empty; leave out both or none"
                                 : "the number is empty, but its error is there; leave out both or none");
    }
    if (row->scale_error <= 0.0 || row->scale_error >= 1.0)
        return fst_text_fail_cell(&r->table, &columns[SCALE_COLUMN],
                                  fst_text_cell(&r->table, &columns[SCALE_COLUMN]),
                                  "is not a relative error: more than 0 and less than 1, as 0.004");
    if (row->value[FST_MEASURED_MEAN_R] <= 0.0 || row->value[FST_MEASURED_STD_R] < 0.0) {
        const int what = row->value[FST_MEASURED_MEAN_R] <= 0.0 ? FST_MEASURED_MEAN_R : FST_MEASURED_STD_R;
        return fst_text_fail_cell(&r->table, &columns[FREQUENCY_COLUMNS + 2 * what], NULL,
                                  "a distance is never negative");
    }
    return FST_OK;
}

static fst_status read_row(const reader *r, fst_point *row)
{
    fst_status status = FST_OK;
    row->line = (int)r->table.line;
    for (int k = 0; k < KNOWN_COLUMNS && status == FST_OK; ++k)
        status = fst_text_value(&r->table, &r->columns[k], place_of(row, k));
    return status == FST_OK ? check_row(r, row) : status;
}

static fst_status read_rows(reader *r, fst_points *points)
{
    size_t capacity = 0;
    int more;
    for (;;) {
        fst_status status = fst_text_row(&r->table, &more);
        if (status == FST_OK && !more && points->count == 0)
            return wrong_line(r, "no row follows the names of the columns");
        if (status != FST_OK || !more)
            return status;
        if (points->count == MOST_ROWS)
            return wrong_line(r, "there are more than 100000 rows");
        if (points->count == capacity) {
            capacity = capacity ? 2 * capacity : 16;
            fst_point *longer = realloc(points->rows, capacity * sizeof *longer);
            if (!longer)
                return fst_fail(r->table.error, FST_NO_MEMORY, r->table.text->path, "out of memory");
            points->rows = longer;
        }
        status = read_row(r, &points->rows[points->count]);
        if (status != FST_OK)
            return status;
        points->count += 1;
    }
}

fst_status fst_points_read(const char *path, fst_points *points, fst_error *error)
{
    fst_text text = {.path = NULL};
    reader r;
    *points = (fst_points){0};
    memcpy(r.columns, known_columns, sizeof known_columns);
    fst_text_begin(&r.table, &text, error);
    fst_status status = fst_text_read(&text, path, LONGEST_FILE, error);
    if (status == FST_OK)
        status = fst_text_head(&r.table, r.columns, KNOWN_COLUMNS, EXAMPLE);
    if (status == FST_OK)
        status = refuse_unknown_columns(&r);
    if (status == FST_OK)
        status = check_columns(&r);
    for (int q = 0; q < FST_MEASURED_COUNT && status == FST_OK; ++q)
        points->column[q] = r.columns[FREQUENCY_COLUMNS + 2 * q].place;
    if (status == FST_OK)
        status = read_rows(&r, points);
    fst_text_end(&r.table);
    fst_text_free(&text);
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
                       .frequency_error = told ? m->drive_from_track_hz_error : NAN,
                       .scale_error = m->scale_error};
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
    int power;
    for (int k = 0; k < KNOWN_COLUMNS; ++k) {
        if (written[k]) {
            (void)fprintf(out, "%s%s [%s]", before, known_columns[k].names,
                          fst_unit_customary(known_columns[k].kind, &power));
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
            (void)fst_unit_customary(known_columns[k].kind, &power);
            write_number(out, *place_of(&row, k), power);
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
        written[k] = k != 1 && k != SCALE_COLUMN; /* errors of frequency and scale only where one is known */
    for (size_t i = 0; i < points->count; ++i) {
        written[1] |= isfinite(points->rows[i].frequency_error);
        written[SCALE_COLUMN] |= points->rows[i].scale_error > 0.0;
    }
    fst_status status = fst_whole_file_open(&file, path, error);
    if (status != FST_OK)
        return status;
    write_rows(file.stream, points, written);
    return fst_whole_file_commit(&file, error);
}
