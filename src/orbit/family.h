/* family.h - a setup with one free parameter, and the motion of a bundle of tangent vectors in it. */
#ifndef FST_ORBIT_FAMILY_H
#define FST_ORBIT_FAMILY_H

#include "base/watch.h"
#include "model/model.h"
#include "orbit/lapack.h"

enum {
    FST_TANGENT_SIZE = 9,               /* dimension of the space of states: |n| = 1 */
    FST_COLUMNS = FST_TANGENT_SIZE + 1, /* tangents carried along: a basis, and the parameter's */
    FST_BUNDLE_SIZE = FST_STATE_SIZE * (1 + FST_COLUMNS)
};

struct fst_setup;

/* The setups that differ in one parameter. */
typedef struct fst_family {
    fst_params params;
    int key;          /* row of params.def that is free; -1: none */
    double scale;     /* of the parameter, for the length of arcs */
    double tolerance; /* of integration, relative and absolute */
    double residual;  /* at which a solution counts as found */
    double location;  /* value of a test at which a special point counts as found */
    const fst_lapack *lapack;
    fst_watch *watch;             /* NULL: no reports, and the work cannot be stopped */
    const struct fst_setup *made; /* a setup that was made already, of the value `made_at` (NULL: none) */
    double made_at;
    int has_s2; /* where a parameter is free: whether S2 maps the magnet onto itself */
} fst_family;

/* One of them: the world, and two neighbours for the derivative by the parameter.  The drive's omega and its
 * frequency need none, for their derivative is exact; that of the others enters Newton's matrix alone, and so
 * bears on the number of iterations, not on the result. */
typedef struct fst_setup {
    fst_model model;
    double exact; /* the parameter sets omega alone: their ratio; else 0 */
    int differs;  /* the derivative by the parameter is wanted */
    fst_world_double below, above;
    double spread;    /* of the parameter between them */
    fst_watch *watch; /* the family's */
    int *sticks;      /* set to 1 where the contact comes to rest on a way (NULL: nobody asks) */
} fst_setup;

/* A family over `key` (NULL: none free); clears the other forms of the quantity.  FST_BAD_INPUT: no such key,
 * or one that is not a real number; FST_UNAVAILABLE: no LAPACK. */
fst_status fst_family_begin(fst_family *family, const fst_params *params, const char *key, fst_error *error);

/* The same of beads in any world. */
fst_status fst_family_begin_in_world(fst_family *family, const fst_params *params, const char *key,
                                     fst_error *error);

/* Every tolerance from that of the integration: residuals of 1e-12, or down to 1e-13 where the integration is
 * more exact than that; tests of special points down to a tenth of it.  (A residual of 1e-14 is what rounding
 * leaves.) */
void fst_family_tighten(fst_family *family, double tolerance);

/* The scale of a parameter for the length of arcs, on a range of it. */
double fst_family_scale(const char *key, double from, double to);

/* Whether the contact may come to rest and slip again on a way: then the flow is not smooth. */
static inline int fst_family_rests(const fst_family *family)
{
    const fst_friction_law law = (fst_friction_law)family->params.friction_law;
    return fst_law_in_effect(&family->params, law) == FST_FRICTION_COULOMB;
}

/* The parameters and the setup at a value of the free parameter. */
fst_params fst_family_params(const fst_family *family, double value);
fst_status fst_family_setup(const fst_family *family, double value, fst_setup *setup, fst_error *error);

/* The parameter's value in family->params. */
double fst_family_value(const fst_family *family);

/* The derivative of d(state)/dt by the free parameter. */
void fst_setup_by_parameter(const fst_setup *setup, const double *y, double *by);

/* Carry a state and FST_COLUMNS tangent vectors (tangent[i][c]: component i of column c) over `duration`.  The
 * last column is the derivative by the free parameter.  FST_STEP_UNDERFLOW, FST_NOT_FINITE, and
 * what the watch answers. */
fst_status fst_carry(const fst_setup *setup, double tolerance, double duration, double y[FST_STATE_SIZE],
                     double tangent[FST_STATE_SIZE][FST_COLUMNS], fst_error *error);

/* The same under the laws whose contact can stick, through its changes of mode (dry_carry.c). */
fst_status fst_dry_carry(const fst_setup *setup, double tolerance, double duration, double y[FST_STATE_SIZE],
                         double tangent[FST_STATE_SIZE][FST_COLUMNS], fst_error *error);

struct fst_neighbours;

/* One step of that: the flow goes on, no further than to the time `until`, with its neighbours. */
fst_status fst_dry_step(const fst_setup *setup, struct fst_neighbours *b, fst_flow *flow, double until,
                        fst_error *error);

/* An orthonormal basis of the tangent space at y: basis[i][j] is component i of vector j.  Seven vectors lie
 * along the axes; two span the plane across n. */
void fst_tangent_basis(const double *y, double basis[FST_STATE_SIZE][FST_TANGENT_SIZE]);

/* The components of v in such a basis. */
void fst_tangent_part(double basis[FST_STATE_SIZE][FST_TANGENT_SIZE], const double *v, double *part);

#endif
