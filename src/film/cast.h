/* cast.h - the beads of a film: of a trajectory of one, or of a list, in a world or not. */
#ifndef FST_FILM_CAST_H
#define FST_FILM_CAST_H

#include <festoon/bead_files.h>

#include "film/motion.h"

typedef struct fst_film_cast {
    int count;
    fst_film_motion *motions;   /* of each bead */
    fst_film_bead *beads;       /* as they are at the moment */
    fst_params params;          /* of the first bead, settled */
    double omega;               /* of the drive, at the first row, gamma */
    const fst_beads_table *all; /* NULL: a trajectory of one bead */
    fst_table *tables;          /* of a list: the table of each bead, of the rows that are shown */
    double *periods;            /* the clock of a drive that does not turn the magnet steadily */
    size_t first;               /* row of `all` where the tables begin */
    double (*colours)[3];
    int (*touches)[2]; /* room for the pairs that touch */
} fst_film_cast;

/* Begin with a trajectory of one bead, or with one of a list, as fst_film_motion_begin() does; trails of several have no
 * column.  Free the cast in any case. */
fst_status fst_film_cast_one(fst_film_cast *cast, const fst_table *table, const fst_film_options *options,
                             fst_error *error);
fst_status fst_film_cast_list(fst_film_cast *cast, const fst_beads_table *all, const fst_film_options *options,
                              fst_error *error);
void fst_film_cast_free(fst_film_cast *cast);

/* The same without colours, for a camera. */
fst_status fst_film_cast_table(fst_film_cast *cast, const fst_table *table, double from, double to,
                               fst_error *error);
fst_status fst_film_cast_tables(fst_film_cast *cast, const fst_beads_table *all, double from, double to,
                                fst_error *error);

/* Go on to a moment, in drive periods, and show all in a frame. */
void fst_film_cast_to(fst_film_cast *cast, double periods, fst_film_frame *frame);

#endif
