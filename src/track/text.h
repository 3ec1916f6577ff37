/* text.h - tables of text that other programs wrote: lines, cells, numbers and names of columns with units.
 *
 * Such files differ in everything that does not matter: byte order marks, line ends, Latin-1 or UTF-8, what
 * stands between cells, decimal commas, the sign of minus.  Here all of that becomes the same, so that a reader
 * of a format sees its columns alone.
 */
#ifndef FST_TRACK_TEXT_H
#define FST_TRACK_TEXT_H

#include <stddef.h>

#include <festoon/festoon.h>

/* A text file in memory, as lines of UTF-8 without line ends, byte order mark and zero bytes. */
typedef struct track_text {
    const char *path; /* the caller's */
    char *bytes;      /* `size` of them; each line end became zeros */
    size_t size;
    char **lines; /* line i of the file is lines[i - 1]; blank lines are there, as "" */
    size_t count;
} track_text;

/* Read a file, in UTF-8, Latin-1 or UTF-16 (by its byte order mark).  Free it with track_text_free(), also
 * after a failure. */
fst_status track_text_read(track_text *text, const char *path, fst_error *error);
/* The same from memory; the bytes are copied. */
fst_status track_text_take(track_text *text, const char *path, const char *bytes, size_t size,
                           fst_error *error);
void track_text_free(track_text *text);

/* Fail with "FILE:LINE" (lines count from 1) and a sentence. */
fst_status track_fail_line(const char *path, size_t line, fst_error *error, const char *format, ...)
    __attribute__((format(printf, 4, 5)));

/* The cells of a line. */
enum { TRACK_MOST_CELLS = 256 };
typedef struct track_cells {
    char *cell[TRACK_MOST_CELLS]; /* without the blanks and the quotes around them */
    int count;
    char *memory;
    size_t room;
} track_cells;
void track_cells_free(track_cells *cells);

/* Split a line at `separator`, but not within double quotes; cells beyond TRACK_MOST_CELLS are dropped.  A
 * separator ' ' means any run of blanks and tabs.  Begin with {0}; a second call reuses the memory. */
fst_status track_split(track_cells *cells, const char *line, char separator, fst_error *error);

/* The character that separates the cells of a line of names: the most frequent of tab, semicolon and comma
 * outside of quotes and brackets; ' ' where there is none of them. */
char track_separator_of(const char *line);

typedef enum {
    TRACK_NUMBER,  /* a finite number */
    TRACK_NOTHING, /* an empty cell, or "NaN": nothing was seen */
    TRACK_WORD     /* no number */
} track_value_kind;

/* Read a cell as a number: a point or a comma as decimal sign (a comma within a cell can be nothing else,
 * because the line was split already), '-' or U+2212 as minus, in the exponent too, and non-breaking blanks
 * around it. */
track_value_kind track_number(const char *cell, double *value);

/* The name of a column, taken apart: "x [mm]", "x (mm)" or "x_mm": the name in small letters, and the unit
 * as it stands, "" where there is none. */
typedef struct track_column {
    char name[64], unit[32];
} track_column;
void track_column_of(const char *cell, track_column *column);

#endif
