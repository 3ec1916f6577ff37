/* text_table.h - tables of text from any program: the one reader of maps, measured points, tracks and
 * trajectories.  A dialect that is read here is read everywhere.
 *
 * Tables differ in what does not matter: UTF-8, UTF-16 or Latin-1, byte order marks, line ends, what stands
 * between cells (commas, semicolons, tabs, blanks), decimal commas, signs of minus, quotes, comments (# or %),
 * how names are spelt and where their units stand: "x [mm]", "x (mm)", "x/mm", "x_mm".  A reader of a format
 * lists the columns that it wants, and asks for their numbers row by row.
 */
#ifndef FST_IO_TEXT_TABLE_H
#define FST_IO_TEXT_TABLE_H

#include <stddef.h>

#include <festoon/festoon.h>

/* ---------------------------------------------------------------- lines */

/* A text file in memory, as lines of UTF-8 without line ends and byte order mark; a zero byte became '?'. */
typedef struct fst_text {
    const char *path; /* the caller's */
    char *bytes;      /* `size` of them; each line end became zeros */
    size_t size;
    char **lines; /* line i of the file is lines[i - 1]; blank lines are there, as "" */
    size_t count;
} fst_text;

/* Read a file of at most `most` bytes, or a text in memory, which is copied.  Free it with fst_text_free(),
 * also after a failure. */
fst_status fst_text_read(fst_text *text, const char *path, size_t most, fst_error *error);
fst_status fst_text_take(fst_text *text, const char *path, const char *bytes, size_t size, fst_error *error);
void fst_text_free(fst_text *text);

/* Whether a line is blank or a comment. */
int fst_text_says_nothing(const char *line);

/* Fail with "FILE:LINE" (lines count from 1) and a sentence. */
fst_status fst_text_fail(const char *path, size_t line, fst_error *error, const char *format, ...)
    __attribute__((format(printf, 4, 5)));

/* ---------------------------------------------------------------- cells */

typedef enum {
    FST_TEXT_NUMBER,  /* a finite number */
    FST_TEXT_NOTHING, /* an empty cell, or "NaN": nothing was seen */
    FST_TEXT_WORD     /* no number */
} fst_text_kind;

/* What a cell holds; *value is NAN where it is not a number. */
fst_text_kind fst_text_number(const char *cell, double *value);

/* Whether the name of a column ("X [mm]") is one of "x|pos x|xpos": capitals, blanks and underscores do not
 * matter.  A name that ends in * is the beginning of one. */
int fst_text_is_named(const char *cell, const char *names);

/* The most cells of a line: one that has more is refused. */
enum { FST_TEXT_CELLS = 1024, FST_TEXT_UNIT = 32 };

/* A column that is wanted. */
typedef struct fst_text_column {
    const char *names;        /* as above; messages use the first of them */
    fst_unit kind;            /* its unit must be one of this kind, and its numbers come out in SI.
                                 FST_UNIT_NUMBER: numbers as they stand, whatever their unit */
    int needed;               /* a table without it is refused */
    int repeats;              /* it may be there twice, and the last one counts */
    int way, twice;           /* how plainly it is named; so more than once */
    int place;                /* of its cells in a row, from 1; 0: the table has no such column */
    char unit[FST_TEXT_UNIT]; /* as the head writes it, "": it does not */
} fst_text_column;

typedef struct fst_text_table {
    const fst_text *text;
    fst_error *error;
    int ragged;  /* a row may have more or fewer cells than the head */
    size_t line; /* at which the reader is, from 1 */
    char separator;
    char *cells[FST_TEXT_CELLS]; /* of this line, without the blanks and the quotes around them */
    int count;
    char *memory; /* of the cells */
    size_t room;
    const fst_text_column *wanted;
    int columns, wanted_count; /* columns of the head */
} fst_text_table;

/* Begin to read at the first line.  The text stays the caller's. */
void fst_text_begin(fst_text_table *table, const fst_text *text, fst_error *error);
void fst_text_end(fst_text_table *table);

/* Read the head, the first line that is not a comment, or the last comment before it that has the needed columns,
 * as numpy writes it: find the wanted columns and check their units.  `example`: a head, for messages.  The
 * cells of the head are there until the first row is read; `wanted` must stay. */
fst_status fst_text_head(fst_text_table *table, fst_text_column *wanted, int count, const char *example);

/* Go on to the next row; *more is 0 behind the last. */
fst_status fst_text_row(fst_text_table *table, int *more);

/* The number of a column in this row; NAN where nothing stands there, or there is no such column. */
fst_status fst_text_value(const fst_text_table *table, const fst_text_column *column, double *value);

/* The cell of a column in this row, "" where there is none. */
const char *fst_text_cell(const fst_text_table *table, const fst_text_column *column);

/* Cut any line (from 1) of the text into cells, at a separator (' ': any run of blanks and tabs) or, with '\0',
 * at its own. */
fst_status fst_text_split(fst_text_table *table, size_t line, char separator);

/* Fail with "FILE:LINE" and "column 2 (x): ..." with or without a quoted text before the sentence. */
fst_status fst_text_fail_cell(const fst_text_table *table, const fst_text_column *column, const char *quoted,
                              const char *sentence);

#endif
