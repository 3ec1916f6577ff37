/* csv.c - trajectories as text: writing them, and reading them back. */
#include "io/csv.h"

#include <stdlib.h>
#include <string.h>

#include "base/error.h"
#include "base/number.h"
#include "base/text.h"

/* The lines that the reader recognises. */
#define FIRST_LINE "# festoon trajectory"
#define BEADS_LINE "# festoon trajectory of beads"
#define OTHER_UNITS_LINE "# festoon trajectory for other programs, in the units of its columns"
#define SCENE_LINE "# scene:"
#define SCENE_INDENT "#   "
#define RESULT_LINE "# result = "
#define COMPLETE_LINE "# complete = "

/* ---------------------------------------------------------------- writing */

void fst_csv_begin(FILE *out, int of_beads, const char *scene, const fst_column_info *const *columns, int count,
                   const char *const *units)
{
    (void)fprintf(out, "%s\n# version = %s\n%s\n",
                  units      ? OTHER_UNITS_LINE
                  : of_beads ? BEADS_LINE
                             : FIRST_LINE,
                  fst_version(), SCENE_LINE);
    while (*scene) {
        size_t length = strcspn(scene, "\n");
        (void)fprintf(out, "%s%.*s\n", SCENE_INDENT, (int)length, scene);
        scene += length;
        scene += *scene == '\n';
    }
    for (int i = 0; i < count; ++i)
        (void)fprintf(out, "%s%s [%s]", i ? "," : "", columns[i]->name, units ? units[i] : columns[i]->unit);
    (void)fputc('\n', out);
}

void fst_csv_row(FILE *out, const double *values, int count)
{
    fst_c_locale locale = fst_c_locale_enter();
    for (int i = 0; i < count; ++i)
        (void)fprintf(out, "%s%.17g", i ? "," : "", values[i]);
    fst_c_locale_leave(locale);
    (void)fputc('\n', out);
}

void fst_csv_end(FILE *out, const char *result, int complete)
{
    if (result)
        (void)fprintf(out, RESULT_LINE "%s\n", result);
    (void)fprintf(out, "%s%s\n", COMPLETE_LINE, complete ? "true" : "false");
}

/* ---------------------------------------------------------------- reading */

typedef struct csv_reader {
    const fst_text *text;
    const fst_column_info *const *infos;
    int needed, count; /* columns that must be there; all */
    int gaps;          /* a cell may say that there is no number */
    fst_text_table rows;
    fst_text_column *columns;
    size_t ended; /* the line that says whether the run was complete, from 1; 0: there is none */
    size_t room;  /* rows for which there is memory */
    double **data;
    size_t *read; /* rows so far */
    fst_error *error;
} csv_reader;

static int begins(const char *line, const char *word)
{
    return strncmp(line, word, strlen(word)) == 0;
}

/* The scene, of the lines behind the one that announces it. */
static fst_status read_scene(const fst_text *text, size_t line, fst_params *params, fst_bead_params **beads,
                             fst_error *error)
{
    char *scene = malloc(FST_SCENE_SIZE_LIMIT + 1);
    size_t length = 0;
    if (!scene)
        return fst_fail(error, FST_NO_MEMORY, text->path, "out of memory");
    for (; line < text->count && text->lines[line][0] == '#'; ++line) {
        if (!begins(text->lines[line], SCENE_INDENT))
            continue;
        const char *from = text->lines[line] + strlen(SCENE_INDENT);
        const size_t more = strlen(from);
        if (length + more + 1 > FST_SCENE_SIZE_LIMIT) {
            free(scene);
            return fst_text_fail(text->path, line + 1, error, "the scene in this file is too long");
        }
        memcpy(scene + length, from, more);
        length += more;
        scene[length++] = '\n';
    }
    const fst_status status = fst_scene_parse_beads(scene, length, text->path, params, beads, error);
    free(scene);
    return status;
}

int fst_csv_of_beads(const fst_text *text)
{
    return text->count > 0 && strcmp(text->lines[0], BEADS_LINE) == 0;
}

static fst_status check_first_line(const fst_text *text, int of_beads, fst_error *error)
{
    const char *first = text->count ? text->lines[0] : "";
    if (strcmp(first, OTHER_UNITS_LINE) == 0)
        return fst_fail(
            error, FST_BAD_INPUT, text->path,
            "this trajectory was written for other programs, in units of the laboratory or SI; one in "
            "scaled units can be read");
    if (!of_beads && fst_csv_of_beads(text))
        return fst_fail(error, FST_BAD_INPUT, text->path,
                        "this is a trajectory of several beads or of a world, and one of a bead on the plate "
                        "is wanted here");
    if (strcmp(first, of_beads ? BEADS_LINE : FIRST_LINE) != 0)
        return fst_fail(error, FST_BAD_INPUT, text->path,
                        "this is not a trajectory of festoon: it begins neither as HDF5 nor with \"%s\"",
                        of_beads ? BEADS_LINE : FIRST_LINE);
    return FST_OK;
}

fst_status fst_csv_comments(const fst_text *text, int of_beads, fst_params *params, fst_bead_params **beads,
                            size_t *ended, int *complete, fst_error *error)
{
    size_t scene = 0;
    const fst_status status = check_first_line(text, of_beads, error);
    if (status != FST_OK)
        return status;
    *ended = 0;
    for (size_t i = 0; i < text->count; ++i) {
        if (!scene && strcmp(text->lines[i], SCENE_LINE) == 0)
            scene = i + 1;
        if (strcmp(text->lines[i], COMPLETE_LINE "true") == 0 ||
            strcmp(text->lines[i], COMPLETE_LINE "false") == 0) {
            *ended = i + 1;
            *complete = strcmp(text->lines[i], COMPLETE_LINE "true") == 0;
        }
    }
    if (!scene)
        return fst_text_fail(text->path, text->count, error,
                             "the scene is missing in the head of this trajectory");
    return read_scene(text, scene, params, beads, error);
}

const char *fst_csv_result(const fst_text *text)
{
    const size_t length = strlen(RESULT_LINE);
    for (size_t i = text->count; i-- > 0;)
        if (strncmp(text->lines[i], RESULT_LINE, length) == 0)
            return text->lines[i] + length;
    return NULL;
}

/* Find the columns; a file may lack all of those that need not be there. */
static fst_status read_names(csv_reader *reader)
{
    int later = 0;
    for (int i = 0; i < reader->count; ++i)
        reader->columns[i] = (fst_text_column){
            .names = reader->infos[i]->name, .kind = FST_UNIT_NUMBER, .needed = i < reader->needed};
    fst_status status = fst_text_head(&reader->rows, reader->columns, reader->count, "t [1/gamma], ...");
    for (int i = reader->needed; i < reader->count; ++i)
        later += reader->columns[i].place != 0;
    for (int i = 0; i < reader->count && status == FST_OK; ++i) {
        const fst_column_info *info = reader->infos[i];
        const int there = reader->columns[i].place != 0;
        if (there ? strcmp(reader->columns[i].unit, info->unit) != 0 : later != 0)
            status = fst_text_fail(reader->text->path, reader->rows.line, reader->error,
                                   "the column \"%s [%s]\" is missing here", info->name, info->unit);
    }
    return status;
}

static fst_status make_room(csv_reader *reader)
{
    if (*reader->read < reader->room)
        return FST_OK;
    size_t room = reader->room ? 2 * reader->room : 1024;
    for (int i = 0; i < reader->count; ++i) {
        double *longer = realloc(reader->data[i], room * sizeof *longer);
        if (!longer)
            return fst_fail(reader->error, FST_NO_MEMORY, reader->text->path, "out of memory after %zu rows",
                            *reader->read);
        reader->data[i] = longer;
    }
    reader->room = room;
    return FST_OK;
}

static fst_status read_row(csv_reader *reader)
{
    fst_status status = make_room(reader);
    for (int i = 0; i < reader->count && status == FST_OK; ++i) {
        const char *cell = fst_text_cell(&reader->rows, &reader->columns[i]);
        double value = 0.0;
        const fst_text_kind kind = reader->columns[i].place ? fst_text_number(cell, &value) : FST_TEXT_NUMBER;
        if (kind != FST_TEXT_NUMBER && !(reader->gaps && kind == FST_TEXT_NOTHING)) {
            char quoted[FST_QUOTE_SIZE];
            status = fst_text_fail(
                reader->text->path, reader->rows.line, reader->error,
                "the column %s holds %s, which is not a finite number, as every one of a trajectory must be",
                reader->infos[i]->name, fst_quote(cell, quoted));
        }
        reader->data[i][*reader->read] = value;
    }
    *reader->read += status == FST_OK;
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

fst_status fst_csv_rows(const fst_text *text, size_t ended, const fst_column_info *const *columns, int needed,
                        int count, int gaps, double **data, size_t *rows, fst_error *error)
{
    csv_reader reader = {.text = text,
                         .infos = columns,
                         .needed = needed,
                         .count = count,
                         .gaps = gaps,
                         .ended = ended,
                         .data = data,
                         .read = rows,
                         .error = error};
    reader.columns = calloc((size_t)count, sizeof *reader.columns);
    if (!reader.columns)
        return fst_fail(error, FST_NO_MEMORY, text->path, "out of memory");
    fst_text_begin(&reader.rows, text, error);
    fst_status status = read_names(&reader);
    if (status == FST_OK)
        status = read_rows(&reader);
    fst_text_end(&reader.rows);
    free(reader.columns);
    return status;
}

fst_status fst_csv_read(const fst_text *text, fst_table *table, fst_error *error)
{
    const fst_column_info *columns[FST_COLUMN_COUNT];
    size_t ended = 0;
    for (int i = 0; i < FST_COLUMN_COUNT; ++i)
        columns[i] = fst_column_at(i);
    const fst_status status = fst_csv_comments(text, 0, &table->params, NULL, &ended, &table->complete, error);
    if (status != FST_OK)
        return status;
    return fst_csv_rows(text, ended, columns, FST_COLUMNS_BEFORE_FLIGHTS, FST_COLUMN_COUNT, 0, table->columns,
                        &table->rows, error);
}
