/* identity.h - the identity of a sweep: what it is a sweep of, as the table `festoon` of its database says.
 *
 * The table has a line for each thing that must be the same for two rows to belong together (scene, axes, seed,
 * carrying, arithmetic), the mark of the file, and a checksum of these lines.  The checksum of each row begins
 * with that checksum, so a row of another database is never taken for a row of this one, however it came into
 * the file.
 */
#ifndef FST_SWEEP_IDENTITY_H
#define FST_SWEEP_IDENTITY_H

#include "sweep/database.h"
#include "sweep/journal.h"

/* The lines of the table: keys in rising order, and their texts. */
enum { FST_IDENTITY_LIMIT = 32 };
typedef struct fst_identity_lines {
    char keys[FST_IDENTITY_LIMIT][24];
    char *values[FST_IDENTITY_LIMIT];
    int count;
} fst_identity_lines;

/* Read the lines and check them.  FST_BAD_INPUT: damaged. */
fst_status fst_identity_read(sqlite3 *database, const char *path, fst_identity_lines *lines, fst_error *error);
void fst_identity_free(fst_identity_lines *lines);

/* The text of a key, or NULL. */
const char *fst_identity_text(const fst_identity_lines *lines, const char *key);

/* The checksum of the lines, with which the checksum of each row begins.  The line `refine` is left out: it may
 * change (refined.c). */
uint64_t fst_identity_checksum(const fst_identity_lines *lines);

/* The grid that scene and axes describe. */
fst_status fst_identity_grid(const fst_identity_lines *lines, const char *path, fst_grid **grid,
                             fst_error *error);

/* Write all lines of a new database with this mark. */
fst_status fst_identity_write(sqlite3 *database, const char *path, const fst_sweep_identity *identity,
                              const char *mark, fst_error *error);

/* Compare with a wanted sweep.  FST_BAD_INPUT: another one; the sentence says what differs.  Scenes are
 * compared by their parameters, so a program that knows more keys goes on with an older sweep if these have
 * their defaults. `other` is the file whose sweep is wanted, of which this one may be another shard; NULL: it is
 * that of a command. */
fst_status fst_identity_compare(const fst_identity_lines *lines, const char *path,
                                const fst_sweep_identity *identity, const char *other, fst_error *error);

/* The sweep of which the lines tell, over their grid.  FST_BAD_INPUT: they name no shard that can be. */
fst_status fst_identity_of(const fst_identity_lines *lines, const char *path, const fst_grid *grid,
                           fst_sweep_identity *identity, fst_error *error);

#endif
