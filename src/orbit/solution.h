/* solution.h - equilibria and periodic orbits of one family, by Newton's method.
 *
 * A periodic orbit is a chain of `segments` states, each carried by the flow to the next in equal times; the
 * last one's image is the first (S1), or its image under S2 (S2: `period` is then half a turn).  An equilibrium
 * has no segments and one state.  Corrections live in the tangent space of each state, so |n| = 1 needs no
 * equation and leaves no multiplier.
 */
#ifndef FST_ORBIT_SOLUTION_H
#define FST_ORBIT_SOLUTION_H

#include "orbit/family.h"

enum {
    FST_SEGMENTS = 4,
    FST_UNKNOWNS = FST_SEGMENTS * FST_TANGENT_SIZE + 2,
    FST_MULTIPLIERS = FST_TANGENT_SIZE,
    FST_FLOW_STEP_WORK = 14 /* of a step of a flow with its dense output, in evaluations of the equations */
};

/* A direction in the space of states, period and parameter. */
typedef struct fst_direction {
    double y[FST_SEGMENTS][FST_STATE_SIZE];
    double period, value;
} fst_direction;

typedef struct fst_solution {
    int segments;   /* 0: an equilibrium */
    int symmetric;  /* the chain closes by S2 */
    int on_section; /* the first state lies on X = 0, and corrections keep it there */
    double y[FST_SEGMENTS][FST_STATE_SIZE];
    double period; /* of the chain */
    double value;  /* of the free parameter */

    /* What Newton's last iteration found. */
    double residual; /* greatest component */
    int iterations;
    fst_direction tangent; /* of the curve of solutions, where the parameter is free */
    double map[FST_TANGENT_SIZE]
              [FST_TANGENT_SIZE]; /* the chain's derivative, or the Jacobian, in the basis at y[0] */
    int sticks;                   /* an orbit under dry friction: the contact comes to rest on it */
    double trivial_error;         /* |M f - f|/|f|: how well the flow direction is mapped onto itself */
    int multipliers;              /* 8 for orbits, 9 eigenvalues for equilibria */
    double re[FST_MULTIPLIERS], im[FST_MULTIPLIERS];
} fst_solution;

static inline int fst_states_of(const fst_solution *s)
{
    return s->segments > 0 ? s->segments : 1;
}

/* The product by which arcs are measured: mean over the states, period over 20, parameter over its scale. */
double fst_direction_product(const fst_family *family, const fst_solution *of, const fst_direction *a,
                             const fst_direction *b);

/* From one solution to another (tangent components alone matter). */
void fst_direction_between(const fst_solution *from, const fst_solution *to, fst_direction *out);

/* out = a u + b v */
void fst_direction_combine(fst_direction *out, double a, const fst_direction *u, double b,
                           const fst_direction *v);

static inline void fst_direction_scale(fst_direction *direction, double factor)
{
    fst_direction_combine(direction, factor, direction, 0.0, direction);
}

/* s moved by `length` along a direction, n kept on the unit sphere. */
void fst_solution_move(fst_solution *s, const fst_direction *direction, double length);

/* Newton's method from the guess `s`.  Where `across` is NULL the parameter stays; else it is free, and
 * corrections stay perpendicular to `across`, along which the tangent then points.  FST_NO_CONVERGENCE: the
 * guess was not good enough; s is then undefined. */
fst_status fst_solution_correct(const fst_family *family, fst_solution *s, const fst_direction *across,
                                fst_error *error);

/* One iteration of it by a rough integration, for a guess that is no better; an equilibrium is left as it is.
 */
fst_status fst_solution_approach(const fst_family *family, fst_solution *s, const fst_direction *across,
                                 fst_error *error);

/* Multipliers (or eigenvalues) of a corrected solution, the flow direction of an orbit split off. */
fst_status fst_solution_spectrum(const fst_family *family, fst_solution *s, fst_error *error);

/* The matrix behind the spectrum, by rows, in an orthonormal basis of the tangent space (basis[i][j]: component
 * i of vector j): the Jacobian (9 x 9) of an equilibrium; of an orbit the derivative (8 x 8) of the return to
 * the section across the flow, whose basis are all vectors but the first, which lies along the flow. */
fst_status fst_solution_section(const fst_family *family, const fst_solution *s, double *matrix,
                                double basis[FST_STATE_SIZE][FST_TANGENT_SIZE], fst_error *error);

/* The eigenvector of the multiplier nearest to re + i im, as directions of the first state: real and imaginary
 * part (imaginary may be NULL). */
fst_status fst_solution_eigenvector(const fst_family *family, const fst_solution *s, double re, double im,
                                    double real[FST_STATE_SIZE], double imaginary[FST_STATE_SIZE],
                                    fst_error *error);

/* Whether it attracts: multipliers within the unit circle, eigenvalues on the left. */
int fst_solution_is_stable(const fst_solution *s);

/* Whether a chain with its spectrum is an orbit: an equilibrium, too, comes back to itself after any time, but
 * has no flow direction. */
int fst_solution_moves(const fst_family *family, const fst_solution *s);

/* The time in which a small disturbance falls by e; NAN: it does not. */
double fst_solution_relaxation(const fst_solution *s);

/* Carry such a flow on to a time; stops with what the family's watch answers. */
fst_status fst_solution_advance(const fst_family *family, fst_flow *flow, double time, fst_error *error);

/* Fill in the states of a chain of `segments` from the first one and the period. */
fst_status fst_solution_chain(const fst_family *family, fst_solution *s, int segments, fst_error *error);

/* A bead in the air is not a state of a chain: the first one of an orbit on which the bead flies moves to the middle
 * of the longest time on the plate. */
fst_status fst_solution_keep_to_plate(const fst_family *family, fst_solution *s, fst_error *error);

/* A flow from `state` in the setup of a solution; the caller frees it and the model. */
fst_status fst_solution_flow(const fst_family *family, double value, const double *state, double tolerance,
                             fst_model **model, fst_flow **flow, fst_error *error);

#endif
