/* file.h - an open database of a sweep, and its rows, each of which is checked. */
#ifndef FST_SWEEP_FILE_H
#define FST_SWEEP_FILE_H

#include <sys/stat.h>

#include "sweep/database.h"
#include "sweep/identity.h"

typedef struct fst_sweep_file {
    const char *name; /* the name that the user gave, for messages */
    char *path;       /* the absolute path */
    struct stat there;
    sqlite3 *database;
    fst_identity_lines lines;
    fst_grid *grid;
    fst_sweep_identity identity;
    uint64_t seed; /* the checksums of rows begin with this */
    char mark[FST_MARK_SIZE];
    fst_log_state log;
    char finding[160]; /* what is wrong with the structure of the database; "": nothing */
    int opened;        /* all steps went well */
    int at_work;       /* another process had its lock when it was opened */
    int is_left;       /* a log is left as it is when the file is closed */
} fst_sweep_file;

/* Open a database and check everything except its rows.  With `locked` the caller holds the lock of the file
 * and may write.  FST_BAD_INPUT: no database of a sweep, another format, other tables than ours, the log of
 * another database, a damaged identity.  fst_sweep_file_close() closes it, also after a failure or of a file
 * that was filled with zeros. */
fst_status fst_sweep_file_open(const char *name, int locked, fst_sweep_file *file, fst_error *error);

/* Also for a file that was filled with zeros. */
void fst_sweep_file_close(fst_sweep_file *file);

/* The statements that make the tables of a new database; the caller frees them. */
char *fst_sweep_file_tables(const fst_grid *grid, const char *mark);

/* ------------------------------------------------------------------ rows */

enum { FST_LOST_RANGES = 12 };

/* Points whose rows exist but cannot be read or trusted. */
typedef struct fst_lost_points {
    int64_t count;
    int64_t outside; /* rows that belong to no point of the grid */
    struct {
        int64_t first, last;
    } ranges[FST_LOST_RANGES];
    int range_count; /* further ranges are only counted */
} fst_lost_points;

/* Add the points from `first` to `last`, which lie behind those added before; and write which there are, as "3, 7-12 and
 * 5 more". */
void fst_lost_points_add(fst_lost_points *lost, int64_t first, int64_t last);
void fst_lost_points_name(const fst_lost_points *lost, char *text, size_t size);

typedef struct fst_sweep_rows {
    const fst_sweep_file *file;
    sqlite3_stmt *row; /* the present row */
    int64_t next;      /* every row of a lesser point has been read */
    int begun;
    int64_t sound; /* sound rows so far */
    fst_lost_points lost;
    const fst_progress *progress; /* asked now and then whether to go on; NULL unless set after the beginning */
} fst_sweep_rows;

/* Read rows in the order of their points.  Call fst_sweep_rows_end() after a failure too. */
fst_status fst_sweep_rows_begin(fst_sweep_rows *rows, const fst_sweep_file *file, fst_error *error);

/* Go to the next sound row; *more is 0 behind the last one.  Damage is passed over and noted. */
fst_status fst_sweep_rows_next(fst_sweep_rows *rows, int *more, fst_error *error);
void fst_sweep_rows_end(fst_sweep_rows *rows);

/* What a reader of all points does at each: tell the progress, at every thousandth. */
fst_status fst_sweep_rows_tell(const fst_sweep_rows *rows, int64_t point, fst_error *error);

/* Whether nothing is wrong with the file, after all rows were read. */
int fst_sweep_rows_are_whole(const fst_sweep_rows *rows);

/* FST_BAD_INPUT with a sentence that says what is damaged, which points are lost, and what to do. */
fst_status fst_sweep_rows_fail(const fst_sweep_rows *rows, const char *others, fst_error *error);

#endif
