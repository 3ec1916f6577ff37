/* dry_peers.h - the job that all who integrate dry friction do, and others' ways to do it.
 *
 * The bead of the paper with `coulomb`, mu = 0.2, at 10.7 Hz, from a state on its periodic motion, in which it
 * sticks for three eighths of the time: the mean of r over whole turns of Phi.  Every solver has a short run up
 * first, because its own periodic motion is not quite the exact one.
 */
#ifndef FST_BENCH_DRY_PEERS_H
#define FST_BENCH_DRY_PEERS_H

#include "model/model.h"

enum { DRY_DISCARD = 4, DRY_TURNS = 12 }; /* turns of Phi: run up, mean */

typedef struct dry_job {
    fst_params params;
    fst_model *model;  /* `coulomb` */
    fst_model *smooth; /* the same without friction, for those who bring their own */
    double mu, drive_period, start[FST_STATE_SIZE];
} dry_job;

/* How a peer does it: what `step` and `width` mean is its own. */
typedef struct dry_setting {
    int solver, early; /* Siconos: SICONOS_FRICTION_3D_...; whether forces are those of a step's beginning */
    double step;       /* Siconos: h; CVODE: relative and absolute tolerance; festoon: run.rtol */
    double width;      /* CVODE: v_s of the regularised law */
} dry_setting;

/* The mean of r, and the drive periods that were integrated; 0 if it could not be done. */
typedef int dry_peer(const dry_job *job, const dry_setting *setting, double *mean_r, double *periods);
dry_peer dry_by_siconos, dry_by_cvode;

/* Whether the CVODE that runs was built with optimisation (optimised_cvode.cmake): Debian's was not, so that
 * its times would say nothing about the method. */
int dry_cvode_is_optimised(void);

#endif
