/* csv.c - trajectories as text: writing them, and reading them back. */
#include "io/csv.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/error.h"
#include "base/number.h"

/* The lines that the reader recognises. */
#define FIRST_LINE "# festoon trajectory"
#define OTHER_UNITS_LINE "# festoon trajectory for other programs, in the units of its columns"
#define SCENE_LINE "# scene:"
#define SCENE_INDENT "#   "
#define COMPLETE_LINE "# complete = "

/* ---------------------------------------------------------------- writing */

static void write_head(FILE *out, const char *first_line, const char *scene,
                       const char *const units[FST_COLUMN_COUNT])
{
    (void)fprintf(out, "%s\n# version = %s\n%s\n", first_line, fst_version(), SCENE_LINE);
    while (*scene) {
        size_t length = strcspn(scene, "\n");
        (void)fprintf(out, "%s%.*s\n", SCENE_INDENT, (int)length, scene);
        scene += length;
        scene += *scene == '\n';
    }
    for (int i = 0; i < fst_column_count(); ++i) {
        const fst_column_info *info = fst_column_at(i);
        (void)fprintf(out, "%s%s [%s]", i ? "," : "", info->name, units ? units[i] : info->unit);
    }
    (void)fputc('\n', out);
}

void fst_csv_begin(FILE *out, const char *scene)
{
    write_head(out, FIRST_LINE, scene, NULL);
}

void fst_csv_begin_in(FILE *out, const char *scene, const char *const units[FST_COLUMN_COUNT])
{
    write_head(out, OTHER_UNITS_LINE, scene, units);
}

void fst_csv_row(FILE *out, const double values[FST_COLUMN_COUNT])
{
    fst_c_locale locale = fst_c_locale_enter();
    for (int i = 0; i < FST_COLUMN_COUNT; ++i)
        (void)fprintf(out, "%s%.17g", i ? "," : "", values[i]);
    fst_c_locale_leave(locale);
    (void)fputc('\n', out);
}

void fst_csv_end(FILE *out, const char *result, int complete)
{
    if (result)
        (void)fprintf(out, "# result = %s\n", result);
    (void)fprintf(out, "%s%s\n", COMPLETE_LINE, complete ? "true" : "false");
}

/* ---------------------------------------------------------------- reading */

typedef struct csv_reader {
    FILE *in;
    const char *path;
    char *line; /* LONGEST_LINE bytes, without the newline */
    int number; /* of the present line, from 1 */
    char *scene;
    size_t scene_length;
    size_t room; /* rows for which there is memory */
    int columns; /* of the file: an older one lacks the last */
    fst_table *table;
    fst_error *error;
} csv_reader;

/* Longer than any line: a row takes about 1000 bytes, the result about 5000. */
#define LONGEST_LINE 65536

static fst_status fail_line(csv_reader *reader, const char *sentence)
{
    char where[256];
    (void)snprintf(where, sizeof where, "%.200s:%d", reader->path, reader->number);
    return fst_fail(reader->error, FST_BAD_INPUT, where, "%s", sentence);
}

/* Read the next line: 1, or 0 at the end of the file or where its last line has no newline. */
static int next_line(csv_reader *reader)
{
    if (!fgets(reader->line, LONGEST_LINE, reader->in))
        return 0;
    ++reader->number;
    size_t length = strlen(reader->line);
    if (length == 0 || reader->line[length - 1] != '\n')
        return 0;
    reader->line[length - 1] = '\0';
    return 1;
}

static fst_status keep_scene_line(csv_reader *reader)
{
    const char *text = reader->line + strlen(SCENE_INDENT);
    size_t length = strlen(text);
    if (reader->scene_length + length > FST_SCENE_SIZE_LIMIT)
        return fail_line(reader, "the scene in this file is too long");
    char *longer = realloc(reader->scene, reader->scene_length + length + 2);
    if (!longer)
        return fst_fail(reader->error, FST_NO_MEMORY, reader->path, "out of memory");
    reader->scene = longer;
    memcpy(longer + reader->scene_length, text, length);
    memcpy(longer + reader->scene_length + length, "\n", 2);
    reader->scene_length += length + 1;
    return FST_OK;
}

/* The commented lines before the column names. */
static fst_status read_head(csv_reader *reader)
{
    const int is_text = next_line(reader);
    if (is_text && strcmp(reader->line, OTHER_UNITS_LINE) == 0)
        return fst_fail(
            reader->error, FST_BAD_INPUT, reader->path,
            "this trajectory was written for other programs, in units of the laboratory or SI; one in "
            "scaled units can be read");
    if (!is_text || strcmp(reader->line, FIRST_LINE) != 0)
        return fst_fail(reader->error, FST_BAD_INPUT, reader->path,
                        "this is no trajectory of festoon: it begins neither as HDF5 nor with \"%s\"",
                        FIRST_LINE);
    int in_scene = 0;
    while (next_line(reader) && reader->line[0] == '#') {
        if (in_scene && strncmp(reader->line, SCENE_INDENT, strlen(SCENE_INDENT)) == 0) {
            fst_status status = keep_scene_line(reader);
            if (status != FST_OK)
                return status;
        }
        in_scene = in_scene || strcmp(reader->line, SCENE_LINE) == 0;
    }
    if (!in_scene)
        return fail_line(reader, "the scene is missing in the head of this trajectory");
    return fst_scene_parse(reader->scene ? reader->scene : "", reader->scene_length, reader->path,
                           &reader->table->params, reader->error);
}

/* Check the line of column names, which read_head() has left in reader->line. */
static fst_status check_names(csv_reader *reader)
{
    const char *at = reader->line;
    reader->columns = FST_COLUMN_COUNT;
    for (int i = 0; i < reader->columns; ++i) {
        char expected[96], sentence[160];
        const fst_column_info *info = fst_column_at(i);
        const int is_old_end = i + 1 == FST_COLUMNS_BEFORE_FLIGHTS;
        const int length = snprintf(expected, sizeof expected, "%s [%s]", info->name, info->unit);
        if (is_old_end && strcmp(at, expected) == 0)
            reader->columns = FST_COLUMNS_BEFORE_FLIGHTS;
        (void)snprintf(expected + length, sizeof expected - (size_t)length, "%s",
                       i + 1 < reader->columns ? "," : "");
        if (strncmp(at, expected, strlen(expected)) != 0) {
            (void)snprintf(sentence, sizeof sentence, "the column \"%s [%s]\" is missing here", info->name,
                           info->unit);
            return fail_line(reader, sentence);
        }
        at += strlen(expected);
    }
    return *at ? fail_line(reader, "there are more columns than a trajectory has") : FST_OK;
}

static fst_status make_room(csv_reader *reader)
{
    if (reader->table->rows < reader->room)
        return FST_OK;
    size_t room = reader->room ? 2 * reader->room : 1024;
    for (int i = 0; i < FST_COLUMN_COUNT; ++i) {
        double *longer = realloc(reader->table->columns[i], room * sizeof *longer);
        if (!longer)
            return fst_fail(reader->error, FST_NO_MEMORY, reader->path, "out of memory after %zu rows",
                            reader->table->rows);
        reader->table->columns[i] = longer;
    }
    reader->room = room;
    return FST_OK;
}

static fst_status read_row(csv_reader *reader)
{
    fst_status status = make_room(reader);
    if (status != FST_OK)
        return status;
    const char *at = reader->line;
    for (int i = 0; i < reader->columns; ++i) {
        char *end, sentence[160];
        const double value = strtod(at, &end);
        if (end == at || *end != (i + 1 < reader->columns ? ',' : '\0')) {
            (void)snprintf(sentence, sizeof sentence, "this is no row of %d numbers: the column %s is wrong",
                           reader->columns, fst_column_at(i)->name);
            return fail_line(reader, sentence);
        }
        if (!isfinite(value)) {
            (void)snprintf(
                sentence, sizeof sentence,
                "the column %s holds \"%.*s\", which is not finite, as every number of a trajectory must be",
                fst_column_at(i)->name, (int)(end - at < 24 ? end - at : 24), at);
            return fail_line(reader, sentence);
        }
        reader->table->columns[i][reader->table->rows] = value;
        at = end + 1;
    }
    for (int i = reader->columns; i < FST_COLUMN_COUNT; ++i)
        reader->table->columns[i][reader->table->rows] = 0.0;
    ++reader->table->rows;
    return FST_OK;
}

/* Read the rows, then the commented end, which says whether the run was complete. */
static fst_status read_rows(csv_reader *reader)
{
    int ended = 0;
    while (next_line(reader)) {
        if (reader->line[0] != '#') {
            fst_status status =
                ended ? fail_line(reader, "there is a row after the end of this trajectory") : read_row(reader);
            if (status != FST_OK)
                return status;
        } else if (strncmp(reader->line, COMPLETE_LINE, strlen(COMPLETE_LINE)) == 0) {
            ended = 1;
            reader->table->complete = strcmp(reader->line + strlen(COMPLETE_LINE), "true") == 0;
        }
    }
    if (!ended || !feof(reader->in))
        return fail_line(reader, "this trajectory is cut off: the line \"" COMPLETE_LINE "...\" is missing");
    return FST_OK;
}

fst_status fst_csv_read(FILE *in, const char *path, fst_table *table, fst_error *error)
{
    csv_reader reader = {.in = in, .path = path, .table = table, .error = error};
    reader.line = malloc(LONGEST_LINE);
    if (!reader.line)
        return fst_fail(error, FST_NO_MEMORY, path, "out of memory");
    fst_c_locale locale = fst_c_locale_enter();
    fst_status status = read_head(&reader);
    if (status == FST_OK)
        status = check_names(&reader);
    if (status == FST_OK)
        status = read_rows(&reader);
    fst_c_locale_leave(locale);
    free(reader.line);
    free(reader.scene);
    return status;
}
