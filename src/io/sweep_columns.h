/* sweep_columns.h - the columns of a sweep's table `rows`: point, axes, and the keys of a run. */
#ifndef FST_IO_SWEEP_COLUMNS_H
#define FST_IO_SWEEP_COLUMNS_H

#include "io/database.h"
#include "io/journal.h"

/* Names of the components of a state, as in the columns final_X, ... */
extern const char *const fst_state_names[FST_STATE_SIZE];

/* The definitions of the columns, the statement that inserts a row, and the one that reads whether a point's
 * end may be carried on and its state; to be freed.  NULL: no memory. */
char *fst_sweep_columns_sql(const fst_grid *grid);
char *fst_sweep_insert_sql(const fst_grid *grid);
char *fst_sweep_state_sql(void);

/* Bind a record to the inserting statement. */
void fst_sweep_bind(sqlite3_stmt *insert, const fst_grid *grid, const fst_sweep_record *record);

#endif
