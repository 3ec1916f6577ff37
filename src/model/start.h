/* start.h - the numbers with which a bead begins, in three dimensions. */
#ifndef FST_MODEL_START_H
#define FST_MODEL_START_H

#include <festoon/festoon.h>

/* On the magnet's axes, which are the laboratory's at t = 0; scaled. */
typedef struct fst_start_numbers {
    double x[3]; /* the third: the height of the centre over that of the bead at rest on the plate */
    double v[3], n[3], w[3];
} fst_start_numbers;

/* Of settled parameters, for a bead whose centre at rest is `height` over the magnet's reference plane.
 * FST_BAD_INPUT: such a start does not exist. */
fst_status fst_start(const fst_params *params, const fst_model *model, double height, fst_start_numbers *start,
                     fst_error *error);

#endif
