/* checkpoints.h - images of unfinished runs, beside the rows of a sweep's database.
 *
 * The table `checkpoints` holds for a point the size of its image, a checksum, and the image.  The checksum
 * begins with the sweep's identity and covers point, size and image.  The table is made when the first image
 * comes, written in the same transactions as the rows, and dropped when the sweep is whole.  An image whose
 * checksum is wrong is told, and its run begins anew.
 */
#ifndef FST_SWEEP_CHECKPOINTS_H
#define FST_SWEEP_CHECKPOINTS_H

#include "sweep/journal.h"

/* The text that makes the table.  The definition in a database that is opened must be the same text. */
#define FST_CHECKPOINTS_TABLE                                                                                  \
    "CREATE TABLE checkpoints(point INTEGER PRIMARY KEY, size INTEGER NOT NULL, checksum INTEGER NOT NULL, "   \
    "image BLOB NOT NULL)"

typedef struct fst_checkpoints fst_checkpoints;

/* Open the images of a journal, which must stay open longer.  `identity` is its fst_journal_identity_hash(). */
fst_status fst_checkpoints_open(fst_journal *journal, uint64_t identity, fst_checkpoints **checkpoints,
                                fst_error *error);

/* Add or replace an image in the present transaction.  Nothing is written for a point that has a row. */
fst_status fst_checkpoints_put(fst_checkpoints *checkpoints, int64_t point, const void *image, size_t size,
                               fst_error *error);

/* The image of a point, which the caller frees; NULL: there is none, or it is damaged. */
void *fst_checkpoints_get(fst_checkpoints *checkpoints, int64_t point, size_t *size);

/* How many images are damaged, or stand beside another point: their runs begin anew. */
int64_t fst_checkpoints_damaged(fst_checkpoints *checkpoints);

/* Remove the image of a point whose row was written in the same transaction. */
fst_status fst_checkpoints_drop(fst_checkpoints *checkpoints, int64_t point, fst_error *error);

/* Drop the table: the sweep is whole. */
fst_status fst_checkpoints_drop_all(fst_checkpoints *checkpoints, fst_error *error);

void fst_checkpoints_close(fst_checkpoints *checkpoints);

#endif
