/* file.h - an open database of a sweep, and its rows, each of them checked. */
#ifndef FST_SWEEP_FILE_H
#define FST_SWEEP_FILE_H

#include <sys/stat.h>

#include "sweep/database.h"
#include "sweep/identity.h"

typedef struct fst_sweep_file {
    const char *name; /* as it was given, for messages */
    char *path;       /* from the root on */
    struct stat there;
    sqlite3 *database;
    fst_identity_lines lines;
    fst_grid *grid;
    uint64_t seed; /* of the checksums of rows */
    char mark[FST_MARK_SIZE];
    fst_log_state log;
    char finding[160]; /* what is wrong with the structure of the database; empty if nothing */
    int opened;        /* wholly */
} fst_sweep_file;

/* Open and check all but the rows.  With `locked` the caller holds the lock of the file and may write.
 * FST_BAD_INPUT: no database of a sweep, of another format, with other tables than ours, a log of another
 * database, a damaged record of what the sweep is.  Closed by fst_sweep_file_close(), also on failure. */
fst_status fst_sweep_file_open(const char *name, int locked, fst_sweep_file *file, fst_error *error);

/* Also of one that was filled with zeros. */
void fst_sweep_file_close(fst_sweep_file *file);

/* Whether the path still leads to the file that was opened. */
int fst_sweep_file_is_there(const char *path, const struct stat *opened);

/* The statement that makes the tables of a new database. */
char *fst_sweep_file_tables(const fst_grid *grid, const char *mark);

/* ------------------------------------------------------------------ rows */

enum { FST_LOST_RANGES = 12 };

/* Points whose rows are there but cannot be trusted, or cannot be read. */
typedef struct fst_lost_points {
    int64_t count;
    int64_t outside; /* rows of no point of the grid */
    struct {
        int64_t first, last;
    } ranges[FST_LOST_RANGES];
    int range_count; /* further ones are only counted */
} fst_lost_points;

typedef struct fst_sweep_rows {
    const fst_sweep_file *file;
    sqlite3_stmt *row; /* the present one */
    int64_t next;      /* rows of lesser points have been read */
    int begun;
    int64_t sound; /* number of rows so far */
    fst_lost_points lost;
} fst_sweep_rows;

/* Rows in the order of their points.  fst_sweep_rows_end() is for a failure too. */
fst_status fst_sweep_rows_begin(fst_sweep_rows *rows, const fst_sweep_file *file, fst_error *error);

/* Go to the next sound row; *more is 0 behind the last.  What is damaged is passed over and noted. */
fst_status fst_sweep_rows_next(fst_sweep_rows *rows, int *more, fst_error *error);
void fst_sweep_rows_end(fst_sweep_rows *rows);

/* Whether, all rows having been read, nothing is wrong with the file. */
int fst_sweep_rows_are_whole(const fst_sweep_rows *rows);

/* FST_BAD_INPUT: what is damaged, with the points that are lost, and what to do. */
fst_status fst_sweep_rows_fail(const fst_sweep_rows *rows, const char *others, fst_error *error);

#endif
