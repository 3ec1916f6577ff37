/* disc.h - a magnetic disc that rolls upright at a fixed distance from the axis: does it go round with the magnet? */
#ifndef FST_PAPER_DISC_H
#define FST_PAPER_DISC_H

#include <festoon/festoon.h>

/* Where discs are tried: at the distance of the paper's bead at 10.7 Hz, and over the ends of the magnet's lines. */
enum { FST_DISC_PLACES = 2 };
extern const double fst_disc_radii[FST_DISC_PLACES];

/* A disc at the radius r, in a drive omega (gamma), without friction: what moves it is the magnet alone. */
typedef struct fst_disc {
    const fst_model *model;
    double r, omega;
} fst_disc;

/* The angular acceleration alpha'' of the disc at the angle `psi` from the magnet's axis, whose moment stands at the angle
 * `phi` over its path. */
double fst_disc_acceleration(const fst_disc *disc, double psi, double phi);

/* Its corotation: u = phi - psi and alpha' where v = phi + psi is a multiple of a whole turn, and the trace of what a
 * small disturbance becomes a turn of v later (stable: between -2 and 2). */
typedef struct fst_disc_orbit {
    double u, rate, trace;
} fst_disc_orbit;

/* Improve a guess by Newton's method; 0: it does not converge. */
int fst_disc_find(const fst_disc *disc, fst_disc_orbit *orbit);

/* The least drive at which the disc's corotation is stable, coming down from `from`, gamma; NAN: it is not found there.
 * `orbit`, unless NULL, becomes the orbit at that drive. */
double fst_disc_least_drive(const fst_model *model, double r, double from, fst_disc_orbit *orbit);

#endif
