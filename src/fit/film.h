/* film.h - one film as a problem of least squares: places of the bead, and its slip, against the model's path.
 *
 * Beside the parameters a few numbers are unknown of which nobody wants to know: the centre of the picture, the
 * angle of the magnet and the place on the orbit at the beginning, the exact frequency of the drive, the camera's
 * tilt where there is one, and, if they are known only roughly, the exposure, the scale and the bead's radius.
 */
#ifndef FST_FIT_FILM_H
#define FST_FIT_FILM_H

#include <festoon/festoon_tools.h>

#include "fit/path.h"
#include "fit/report.h"

/* The unknowns behind the parameters. */
enum {
    FIT_DRIVE,
    FIT_CENTRE_X,
    FIT_CENTRE_Y,
    FIT_TURN,
    FIT_PHASE,
    FIT_EXPOSURE,
    FIT_SCALE,
    FIT_TILT_X,
    FIT_TILT_Y,
    FIT_RADIUS,
    FIT_NUISANCES
};

typedef struct fit_film {
    fit_space space;
    const fst_minpack *minpack;
    const fst_progress *outer; /* the caller's; NULL: nobody is told */
    fst_progress progress;     /* ours, told by all parts of the search */
    double rounds;             /* over all frames so far */
    int frames, used;          /* all; those of the present window */
    int rhythm;                /* harmonics that the slip has; 0: a window made it */
    double step;               /* s, from one to the next; 0: no window smoothed the slip */
    int *row;                  /* of the track */
    double *t;
    double complex *z;
    double *weight;       /* 0: left out */
    double complex *slip; /* as measured, m/s */
    double *slip_error;   /* NAN: it was not */
    int *slip_at, slips;  /* the frames whose slip is fitted, and how many there are */
    double noise;         /* m, of a place ... */
    double slip_scale;    /* ... and by how much the errors of the slip are multiplied, in residuals */
    double drive, sense, turn, phase;
    int contrary; /* how the bead goes round by its festoons, -1: against the magnet, if the film shows the other; else 0 */
    double complex centre;
    double exposure[2];                 /* and its error; 0: exact */
    double scale_error;                 /* relative, of all lengths of the film; 0: none */
    double complex tilt;                /* what it does: z becomes (1 + |tilt|) z + tilt conj(z) on the plate */
    int nuisances, slot[FIT_NUISANCES]; /* how many are sought, and which unknown each is; -1: it is held */
    fst_orbit orbit;                    /* the latest that was found, its path, and where */
    fit_path path;
    double path_at[FIT_MOST], path_drive; /* 0: none yet */
    double found_drive, drive_error;      /* Hz, as reported */
} fit_film;

/* Keep the frames from where the motion has settled.  FST_BAD_INPUT: the track is in pixels.  Free after a failure too.
 */
fst_status fit_film_take(fit_film *f, const fst_track *track, const fst_measurement *seen, fst_error *error);
void fit_film_free(fit_film *f);

/* Let the caller know that frame after frame is being worked at. */
fst_status fit_film_ask(const fit_film *f, int frame, fst_error *error);

/* The nuisance parameter k at the unknowns; how many there are, parameters included. */
double fit_film_nuisance(const fit_film *f, const double *v, int k);
static inline int fit_film_unknowns(const fit_film *f)
{
    return f->space.count + f->nuisances;
}

/* The model's path there. */
fst_status fit_film_path(fit_film *f, const double *v, fit_path *path, fst_error *error);

/* A place of the film on the plate. */
double complex fit_film_on_plate(double complex tilt, double complex z);

/* The slip that would have been measured in a frame (m/s). */
double complex fit_film_slip(const fit_film *f, const fit_path *path, const double *v, int i);

/* Residuals at the unknowns: two a frame; two of each slip; then the priors of the parameters and of the unknowns. */
int fit_film_residual_count(const fit_film *f);
fst_status fit_film_residuals(fit_film *f, const double *v, double *r, fst_error *error);
fst_status fit_film_derivatives(fit_film *f, const double *v, double *jacobian, fst_error *error);

/* Search from v on for the least sum of their squares; the residuals there are left in r, if that is not NULL. */
fst_status fit_film_solve(fit_film *f, double *v, double *r, fst_error *error);

/* How much the variance of a mean of so many pairs of residuals exceeds that of white noise: neighbours may be alike. */
double fit_film_redness(const double *r, int count);

#endif
