/* csv.c - trajectories as text: writing them, and reading them back. */
#include "io/csv.h"

#include <stdlib.h>
#include <string.h>

#include "base/error.h"
#include "base/number.h"
#include "base/text.h"

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
    const fst_text *text;
    fst_text_table rows;
    fst_text_column columns[FST_COLUMN_COUNT];
    size_t ended; /* the line that says whether the run was complete, from 1; 0: there is none */
    size_t room;  /* rows for which there is memory */
    fst_table *table;
    fst_error *error;
} csv_reader;

static int begins(const char *line, const char *word)
{
    return strncmp(line, word, strlen(word)) == 0;
}

/* The scene, of the lines behind the one that announces it. */
static fst_status read_scene(const csv_reader *reader, size_t line)
{
    const fst_text *text = reader->text;
    char *scene = malloc(FST_SCENE_SIZE_LIMIT + 1);
    size_t length = 0;
    if (!scene)
        return fst_fail(reader->error, FST_NO_MEMORY, text->path, "out of memory");
    for (; line < text->count && text->lines[line][0] == '#'; ++line) {
        if (!begins(text->lines[line], SCENE_INDENT))
            continue;
        const char *from = text->lines[line] + strlen(SCENE_INDENT);
        const size_t more = strlen(from);
        if (length + more + 1 > FST_SCENE_SIZE_LIMIT) {
            free(scene);
            return fst_text_fail(text->path, line + 1, reader->error, "the scene in this file is too long");
        }
        memcpy(scene + length, from, more);
        length += more;
        scene[length++] = '\n';
    }
    const fst_status status = fst_scene_parse(scene, length, text->path, &reader->table->params, reader->error);
    free(scene);
    return status;
}

/* The comments: what the file is, its scene, and its end. */
static fst_status read_comments(csv_reader *reader)
{
    const fst_text *text = reader->text;
    const char *first = text->count ? text->lines[0] : "";
    size_t scene = 0;
    if (strcmp(first, OTHER_UNITS_LINE) == 0)
        return fst_fail(
            reader->error, FST_BAD_INPUT, text->path,
            "this trajectory was written for other programs, in units of the laboratory or SI; one in "
            "scaled units can be read");
    if (strcmp(first, FIRST_LINE) != 0)
        return fst_fail(reader->error, FST_BAD_INPUT, text->path,
                        "this is no trajectory of festoon: it begins neither as HDF5 nor with \"%s\"",
                        FIRST_LINE);
    for (size_t i = 0; i < text->count; ++i) {
        if (!scene && strcmp(text->lines[i], SCENE_LINE) == 0)
            scene = i + 1;
        if (strcmp(text->lines[i], COMPLETE_LINE "true") == 0 ||
            strcmp(text->lines[i], COMPLETE_LINE "false") == 0) {
            reader->ended = i + 1;
            reader->table->complete = strcmp(text->lines[i], COMPLETE_LINE "true") == 0;
        }
    }
    if (!scene)
        return fst_text_fail(text->path, text->count, reader->error,
                             "the scene is missing in the head of this trajectory");
    return read_scene(reader, scene);
}

/* Find the columns; a trajectory of before beads could fly lacks all of the last ones. */
static fst_status read_names(csv_reader *reader)
{
    fst_text_column *last = &reader->columns[FST_COLUMNS_BEFORE_FLIGHTS];
    int flights = 0;
    for (int i = 0; i < FST_COLUMN_COUNT; ++i)
        reader->columns[i] = (fst_text_column){
            .names = fst_column_at(i)->name, .kind = FST_UNIT_NUMBER, .needed = i < FST_COLUMNS_BEFORE_FLIGHTS};
    fst_status status = fst_text_head(&reader->rows, reader->columns, FST_COLUMN_COUNT, "t [1/gamma], ...");
    for (int i = 0; i < FST_COLUMN_COUNT - FST_COLUMNS_BEFORE_FLIGHTS; ++i)
        flights += last[i].place != 0;
    for (int i = 0; i < FST_COLUMN_COUNT && status == FST_OK; ++i) {
        const fst_column_info *info = fst_column_at(i);
        const int there = reader->columns[i].place != 0;
        if (there ? strcmp(reader->columns[i].unit, info->unit) != 0 : flights != 0)
            status = fst_text_fail(reader->text->path, reader->rows.line, reader->error,
                                   "the column \"%s [%s]\" is missing here", info->name, info->unit);
    }
    return status;
}

static fst_status make_room(csv_reader *reader)
{
    if (reader->table->rows < reader->room)
        return FST_OK;
    size_t room = reader->room ? 2 * reader->room : 1024;
    for (int i = 0; i < FST_COLUMN_COUNT; ++i) {
        double *longer = realloc(reader->table->columns[i], room * sizeof *longer);
        if (!longer)
            return fst_fail(reader->error, FST_NO_MEMORY, reader->text->path, "out of memory after %zu rows",
                            reader->table->rows);
        reader->table->columns[i] = longer;
    }
    reader->room = room;
    return FST_OK;
}

static fst_status read_row(csv_reader *reader)
{
    fst_status status = make_room(reader);
    for (int i = 0; i < FST_COLUMN_COUNT && status == FST_OK; ++i) {
        const char *cell = fst_text_cell(&reader->rows, &reader->columns[i]);
        double value = 0.0;
        if (reader->columns[i].place && fst_text_number(cell, &value) != FST_TEXT_NUMBER) {
            char quoted[FST_QUOTE_SIZE];
            status = fst_text_fail(
                reader->text->path, reader->rows.line, reader->error,
                "the column %s holds %s, which is no finite number, as every one of a trajectory must be",
                fst_column_at(i)->name, fst_quote(cell, quoted));
        }
        reader->table->columns[i][reader->table->rows] = value;
    }
    reader->table->rows += status == FST_OK;
    return status;
}

static fst_status read_rows(csv_reader *reader)
{
    for (;;) {
        int more;
        fst_status status = fst_text_row(&reader->rows, &more);
        if (status == FST_OK && !more && !reader->ended)
            return fst_text_fail(reader->text->path, reader->text->count, reader->error,
                                 "this trajectory is cut off: the line \"" COMPLETE_LINE "...\" is missing");
        if (status != FST_OK || !more)
            return status;
        if (reader->ended && reader->rows.line > reader->ended)
            return fst_text_fail(reader->text->path, reader->rows.line, reader->error,
                                 "there is a row after the end of this trajectory");
        status = read_row(reader);
        if (status != FST_OK)
            return status;
    }
}

fst_status fst_csv_read(const fst_text *text, fst_table *table, fst_error *error)
{
    csv_reader reader = {.text = text, .table = table, .error = error};
    fst_text_begin(&reader.rows, text, error);
    fst_status status = read_comments(&reader);
    if (status == FST_OK)
        status = read_names(&reader);
    if (status == FST_OK)
        status = read_rows(&reader);
    fst_text_end(&reader.rows);
    return status;
}
