/* checkpoints.h - images of runs that are not over, beside the rows of a sweep's database.
 *
 * Table `checkpoints`: the point, the size of its image, a checksum of image, point and size that begins with
 * the sweep's identity, and the image.  It is made when the first image comes, written in the transactions of
 * the rows, and gone when the sweep is whole.  An image whose checksum is another one is not there.
 */
#ifndef FST_SWEEP_CHECKPOINTS_H
#define FST_SWEEP_CHECKPOINTS_H

#include "sweep/journal.h"

/* The text by which the table is made, and known when a database is opened. */
#define FST_CHECKPOINTS_TABLE                                                                                  \
    "CREATE TABLE checkpoints(point INTEGER PRIMARY KEY, size INTEGER NOT NULL, checksum INTEGER NOT NULL, "   \
    "image BLOB NOT NULL)"

typedef struct fst_checkpoints fst_checkpoints;

/* The images of a journal, which must stay open longer; `identity` is its fst_journal_identity_hash(). */
fst_status fst_checkpoints_open(fst_journal *journal, uint64_t identity, fst_checkpoints **checkpoints,
                                fst_error *error);

/* Add or replace an image in the present transaction; one of a point that has a row is left out. */
fst_status fst_checkpoints_put(fst_checkpoints *checkpoints, int64_t point, const void *image, size_t size,
                               fst_error *error);

/* The image of a point, to be freed; NULL: there is none, or it is damaged. */
void *fst_checkpoints_get(fst_checkpoints *checkpoints, int64_t point, size_t *size);

/* The point has a row now (in the same transaction). */
fst_status fst_checkpoints_drop(fst_checkpoints *checkpoints, int64_t point, fst_error *error);

/* The sweep is whole: nothing of this is needed any more. */
fst_status fst_checkpoints_drop_all(fst_checkpoints *checkpoints, fst_error *error);

void fst_checkpoints_close(fst_checkpoints *checkpoints);

#endif
