/* columns.h - the columns of the table `rows` of a sweep: point, axes, the keys of a run, and a checksum. */
#ifndef FST_SWEEP_COLUMNS_H
#define FST_SWEEP_COLUMNS_H

#include "sweep/database.h"
#include "sweep/journal.h"

/* The names of the components of a state, as in the columns final_X and so on. */
extern const char *const fst_state_names[FST_STATE_SIZE];

/* The number of columns that are exported: all except the checksum, which is the last one. */
int fst_sweep_column_count(const fst_grid *grid);

/* Texts of SQL, which the caller frees (NULL: no memory): the definitions of the columns; the statement that
 * inserts a row; the statement that reads rows from a point on, with the checksum last; and the statement that
 * reads of a point, ?1, that runs for ?2 drive periods, whether its end state may be carried on, and that
 * state. */
char *fst_sweep_columns_sql(const fst_grid *grid);
char *fst_sweep_insert_sql(const fst_grid *grid);
char *fst_sweep_select_sql(void);
char *fst_sweep_state_sql(const fst_grid *grid);

/* Bind a record and its checksum, which begins with `seed`, to the inserting statement; SQLite's code. */
int fst_sweep_bind(sqlite3_stmt *insert, const fst_grid *grid, uint64_t seed, const fst_sweep_record *record);

/* The place of a key among the columns of a row that is read; 0, the point's, where rows do not have it. */
int fst_sweep_place(sqlite3_stmt *row, const char *key);

/* The same.  FST_BAD_INPUT: rows do not have it. */
fst_status fst_sweep_find(sqlite3_stmt *row, const char *key, const char *where, int *place, fst_error *error);

/* A value of a row that was read as a number, names of lists by their index; NAN: undefined. */
double fst_sweep_number(sqlite3_stmt *row, int column);

/* Write a text without control characters as a field of CSV. */
void fst_sweep_write_quoted(FILE *out, const char *tame);

/* Whether rows of some sweep have this key.  FST_BAD_INPUT: no; the sentence names the nearest one, of the rows of `grid`
 * unless it is NULL. */
fst_status fst_sweep_check_key(const fst_grid *grid, const char *key, const char *where, fst_error *error);

/* The checksum of the first `count` values of a row that was read. */
uint64_t fst_sweep_row_checksum(sqlite3_stmt *row, int count, uint64_t seed);

/* Whether a row that was read belongs to this grid and has the right checksum. */
int fst_sweep_row_is_sound(sqlite3_stmt *row, const fst_grid *grid, uint64_t seed);

#endif
