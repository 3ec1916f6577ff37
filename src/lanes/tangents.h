/* tangents.h - steps of several beads and a tangent vector of each, behind plain doubles.
 *
 * As with fst_lane_engine, an engine is one body (tangents.inl) compiled for one width and form of arithmetic,
 * value i of lane l lying at [i * width + l]; a width of 1 is the scalar form.
 */
#ifndef FST_LANES_TANGENTS_H
#define FST_LANES_TANGENTS_H

#include "model/model.h"

enum { FST_TANGENT_DIM = 2 * FST_STATE_SIZE };

typedef struct fst_tangent_engine {
    int width;
    size_t bytes; /* to be aligned to 64 and zeroed */

    /* Put a bead and a vector into a lane; their errors count in units of the tolerances there. */
    void (*load)(void *memory, int lane, const fst_world_double *world, const double y[FST_TANGENT_DIM],
                 double rtol, const double atol[FST_TANGENT_DIM]);

    /* The present states and vectors, and their derivatives as of the last evaluate(). */
    void (*view)(void *memory, double **y, const double **slope);
    void (*evaluate)(void *memory);

    /* Try a step of a size h of its own in every lane: its error over its tolerance, and step_factor() of it.
     */
    void (*try_steps)(void *memory, const double *h, double *errors, double *factors);

    /* Make the ends of the last steps of these lanes, one bit each, the present states, and evaluate(). */
    void (*accept)(void *memory, unsigned lanes);
} fst_tangent_engine;

extern const fst_tangent_engine fst_tangents_scalar;

#endif
