/* journal.h - the journal of a sweep: an SQLite database with one row a point, committed in batches.
 *
 * The file appears whole (made beside its place, then renamed) with its identity inside: scene, axes, seed,
 * direction of carrying, form of arithmetic.  Then it only grows, by transactions.  One thread of one process
 * writes it and holds a lock on it.  Every row has a checksum.  journal.c explains the scheme, docs/sweeps.md
 * the promises.
 */
#ifndef FST_SWEEP_JOURNAL_H
#define FST_SWEEP_JOURNAL_H

#include <festoon/festoon_tools.h>

#include "sweep/bead_columns.h"

/* What a sweep is: two sweeps with the same identity have the same rows. */
typedef struct fst_sweep_identity {
    const fst_grid *grid;
    uint64_t seed;
    fst_carry carry;
    fst_arithmetic arithmetic;
    uint64_t fingerprint;  /* of a short fixed run in this arithmetic (fingerprint.c) */
    int64_t shard, shards; /* which share of the tasks it has (chains.c); 0 of 1: all */
} fst_sweep_identity;

/* A hash of everything that must be the same for rows to belong into one database. */
uint64_t fst_journal_identity_hash(const fst_sweep_identity *identity);

typedef struct fst_journal fst_journal;

/* Open the database of a sweep, or make it where there is none.  A damaged one is replaced by one with its
 * sound rows.  FST_BAD_INPUT, and nothing is written: a foreign file or log, a damaged identity, or a sweep
 * with other parameters (the sentence says which).  FST_IO: another command is at work on the file (the
 * sentence says which), no permission, full disk. */
fst_status fst_journal_open(const char *path, const fst_sweep_identity *identity, fst_journal **journal,
                            fst_error *error);

struct fst_refining;

/* Note how the sweep is refined (refined.h), and prepare for fst_journal_value(). */
fst_status fst_journal_refine(fst_journal *journal, const struct fst_refining *refining, fst_error *error);

/* The key by which the sweep is refined at a point; *there is 0 where the point has no row. */
fst_status fst_journal_value(fst_journal *journal, int64_t point, int *there, double *value, fst_error *error);

/* Whether the database was damaged and was replaced, and how many rows are known to be lost. */
int fst_journal_repaired(const fst_journal *journal, int64_t *lost);

/* Add a row to the present transaction, or begin one.  A point that has a row keeps it. */
fst_status fst_journal_add(fst_journal *journal, const fst_sweep_record *record, fst_error *error);

/* Begin a transaction unless one is open. */
fst_status fst_journal_begin(fst_journal *journal, fst_error *error);

/* The database and its path, for tables that are written in the same transactions as the rows. */
struct sqlite3 *fst_journal_database(const fst_journal *journal);
const char *fst_journal_path(const fst_journal *journal);

/* Commit what was added: it is then on the disk.  Also FST_IO where the file was deleted, renamed
 * or replaced. */
fst_status fst_journal_commit(fst_journal *journal, fst_error *error);

/* The reason of the first row, where there are rows and all tell of runs that failed; else an empty text. */
fst_status fst_journal_all_failed(fst_journal *journal, char *reason, size_t size, fst_error *error);

/* The number of rows. */
fst_status fst_journal_count(fst_journal *journal, int64_t *rows, fst_error *error);

/* Find at most `room` points of the sweep, or of its shard, without a row, beginning at *next.  *next moves behind the
 * last point looked at; it is the number of points when all were looked at. */
fst_status fst_journal_missing(fst_journal *journal, int64_t *next, int64_t *points, int room, int *found,
                               fst_error *error);

/* The end state of a point, and whether a run may start from it (it went on to its end, or settled). *there is
 * 0 where the point has no row. */
fst_status fst_journal_end_state(fst_journal *journal, int64_t point, int *there, int *usable,
                                 double state[FST_BEAD_NUMBERS], fst_error *error);

/* Commit and close.  The log is gone then, and the database is one file again. */
fst_status fst_journal_close(fst_journal *journal, fst_error *error);

#endif
