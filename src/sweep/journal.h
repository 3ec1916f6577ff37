/* journal.h - the database of a sweep: SQLite, one row a point, committed in batches.
 *
 * The file is made whole (beside its place, then renamed) with its identity inside: scene, axes, seed,
 * direction of carrying, form of arithmetic.  From then on it only grows, by transactions.  It is written from
 * one thread of one process, which holds a lock on it.  Every row has a checksum; docs/sweeps.md says what that
 * and all the rest promises.
 */
#ifndef FST_SWEEP_JOURNAL_H
#define FST_SWEEP_JOURNAL_H

#include <festoon/festoon_tools.h>

/* What a sweep is: two sweeps with the same identity have the same rows. */
typedef struct fst_sweep_identity {
    const fst_grid *grid;
    uint64_t seed;
    fst_carry carry;
    fst_arithmetic arithmetic;
    uint64_t fingerprint; /* of a short fixed run in this arithmetic */
} fst_sweep_identity;

/* A hash of all that must agree for rows to belong into one database. */
uint64_t fst_journal_identity_hash(const fst_sweep_identity *identity);

/* A finished point. */
typedef struct fst_sweep_record {
    int64_t point;
    int carried;       /* started from its neighbour's end */
    fst_status status; /* other than FST_OK: the run failed, and the reason is in result.reason */
    int dynamics;      /* fst_dynamics */
    fst_run_result result;
} fst_sweep_record;

typedef struct fst_journal fst_journal;

/* Open the database of a sweep, making it where there is none.  Of a damaged one the sound rows are kept.
 * FST_BAD_INPUT: a foreign file or log, a database whose record of what it is is damaged, or one made by other
 * parameters (the sentence says which); nothing is written then.  FST_IO: another command is at work on it (the
 * sentence says which), no permission, full disk. */
fst_status fst_journal_open(const char *path, const fst_sweep_identity *identity, fst_journal **journal,
                            fst_error *error);

/* Whether the database was found damaged and replaced by one with its sound rows, and how many rows are known
 * to be lost. */
int fst_journal_repaired(const fst_journal *journal, int64_t *lost);

/* Add a row to the present transaction, beginning one where there is none; a point that is there is left as it
 * is. */
fst_status fst_journal_add(fst_journal *journal, const fst_sweep_record *record, fst_error *error);

/* Begin a transaction unless one is open. */
fst_status fst_journal_begin(fst_journal *journal, fst_error *error);

/* The database and its path, for what is kept beside the rows in the same transactions. */
struct sqlite3 *fst_journal_database(const fst_journal *journal);
const char *fst_journal_path(const fst_journal *journal);

/* Make safe what was added.  FST_IO, too: the file has been deleted, renamed or replaced. */
fst_status fst_journal_commit(fst_journal *journal, fst_error *error);

/* Number of rows. */
fst_status fst_journal_count(fst_journal *journal, int64_t *rows, fst_error *error);

/* Points from *next on that have no row: at most `room` of them; *next moves behind what was looked at, and is
 * the number of points when all were. */
fst_status fst_journal_missing(fst_journal *journal, int64_t *next, int64_t *points, int room, int *found,
                               fst_error *error);

/* The end state of a point and whether it can be carried on from (the motion is still on the plate); *there is
 * 0 where the point has no row. */
fst_status fst_journal_end_state(fst_journal *journal, int64_t point, int *there, int *usable,
                                 double state[FST_STATE_SIZE], fst_error *error);

/* Finish the present transaction and close; the file is then a single one again. */
fst_status fst_journal_close(fst_journal *journal, fst_error *error);

#endif
