/* beads_lock.h - equilibria of several beads, or of one without a plate, in the turning frame. */
#ifndef FST_ORBIT_BEADS_LOCK_H
#define FST_ORBIT_BEADS_LOCK_H

#include "beads/manifold.h"
#include "orbit/lapack.h"

/* What is solved for in the place of equilibria: motions that repeat themselves.  Their eigenvalues are the exponents
 * log(mu)/period of the multipliers mu. */
typedef struct beads_repeat {
    beads_map *after; /* the state after a period */
    void *user;
    double period;
} beads_repeat;

/* An equilibrium: the beads turn with the magnet, in one state of their contacts. */
typedef struct beads_lock {
    double state[BEADS_NUMBERS];
    beads_modes modes; /* none of the contacts grazes */
    double residual;   /* greatest component of d(state)/dt, in the units of manifold.h */
    int iterations;
    int size;                                    /* directions in which the beads can move: 11 for a free one */
    int free;                                    /* along so many of them lies a continuum of equilibria */
    double re[BEADS_NUMBERS], im[BEADS_NUMBERS]; /* `size` eigenvalues, by falling real part */
    int unstable;                                /* of them on the right; of a continuum, whose are 0, none */
} beads_lock;

/* A world over one parameter, for equilibria that are followed. */
typedef struct beads_free_world {
    /* The world at a value, into *world, which stays valid until the next call. */
    fst_status (*at)(void *user, double value, beads_world *world, fst_error *error);
    void *user;
    double scale; /* of the parameter, for the length of arcs */
} beads_free_world;

/* Newton's method on the directions of the closed contacts, from lock->state and lock->modes, whose gaps and
 * moments need not be exact; then the eigenvalues.  Of a continuum the state nearest to the start is found.
 * FST_NO_CONVERGENCE: the guess was not good enough, or there is none.  `repeat` unless it is NULL: of a motion that
 * repeats itself. */
fst_status beads_lock_correct(const fst_lapack *lapack, const beads_repeat *repeat, const beads_world *world,
                              beads_lock *lock, fst_error *error);

/* The same with the parameter free, *value: corrections are across `way`, a direction of the state's numbers and,
 * behind them, of the parameter over its scale.  Then `way` lies along the curve, with unit length. */
fst_status beads_lock_across(const fst_lapack *lapack, const beads_repeat *repeat, const beads_free_world *over,
                             double *value, beads_lock *lock, double way[BEADS_NUMBERS + 1], fst_error *error);

/* The least load or force of a pressing contact, in units of the first bead's mass, and the least gap of an open one;
 * which: the contact, or -1 where there is none. */
double beads_lock_least_force(const beads_world *world, const beads_lock *lock, int *which);
double beads_lock_least_gap(const beads_world *world, const beads_lock *lock, int *which);

#endif
