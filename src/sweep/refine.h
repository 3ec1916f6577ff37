/* refine.h - which points of a grid a refined sweep computes.
 *
 * The points follow from the values of rows alone: the same rows give the same points, in whatever order they
 * come.  refine.c explains the scheme.
 */
#ifndef FST_SWEEP_REFINE_H
#define FST_SWEEP_REFINE_H

#include <festoon/festoon_tools.h>

typedef struct fst_refinement fst_refinement;

/* Begin with the coarsest points.  A cell is divided where the values of its corners differ by more than `step`
 * or some of them are undefined.  FST_BAD_INPUT: the grid cannot be refined, or not so often. */
fst_status fst_refinement_new(const fst_grid *grid, int levels, double step, fst_refinement **refinement,
                              fst_error *error);
void fst_refinement_free(fst_refinement *refinement);

/* Take a point that is wanted, each of them once; 0: no other one is known to be. */
int fst_refinement_next(fst_refinement *refinement, int64_t *point);

/* Whether there is a point to be taken. */
int fst_refinement_has_next(const fst_refinement *refinement);

/* The value of a point that was taken (NAN: undefined).  Others may be wanted then. */
fst_status fst_refinement_note(fst_refinement *refinement, int64_t point, double value, fst_error *error);

/* Points that are wanted so far, how many of them have values, and about how many there will be in the end.  It
 * is over when the first two are equal.  `undefined`: how many of the values are NAN. */
typedef struct fst_refinement_counts {
    int64_t wanted, known, expected, undefined;
} fst_refinement_counts;
fst_refinement_counts fst_refinement_count(const fst_refinement *refinement);

/* An undivided cell: the points of its corners, and how many points lie along each of its edges.  The corners
 * are numbered in binary: bit a tells whether it is the upper one along the a-th refined axis. */
enum { FST_REFINED_AXES = 3 };
typedef struct fst_refined_cell {
    int axes;
    int64_t corners[1 << FST_REFINED_AXES];
    double values[1 << FST_REFINED_AXES];
    int64_t lengths[FST_REFINED_AXES], strides[FST_REFINED_AXES];
} fst_refined_cell;

/* Tell the undivided cells all of whose corners have values, coarse ones first. */
void fst_refinement_tell_cells(const fst_refinement *refinement,
                               void (*tell)(void *user, const fst_refined_cell *cell), void *user);

#endif
