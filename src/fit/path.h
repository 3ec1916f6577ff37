/* path.h - the model's path in the laboratory as a sum of turning arrows, for comparison with a track. */
#ifndef FST_FIT_PATH_H
#define FST_FIT_PATH_H

#include <complex.h>

#include <festoon/fit.h>

enum { FIT_MODES = 40, FIT_PATH_TERMS = 2 * FIT_MODES + 1 };

/* In the frame of the magnet an orbit is periodic: z = sum of c_j exp(i j w t). */
typedef struct fit_path {
    double complex terms[FIT_PATH_TERMS]; /* c_(j - FIT_MODES), m */
    double complex slip[FIT_PATH_TERMS];  /* the same of the slip V, m/s */
    double period;                        /* s */
} fit_path;

/* The path of an orbit of this setup.  FST_STEP_UNDERFLOW and the like as of a run. */
fst_status fit_path_make(const fst_params *params, const fst_orbit *orbit, fit_path *path, fst_error *error);

/* The place at the time t in the laboratory, averaged over the exposure that begins half of it earlier: the
 * magnet at the angle `turn` at t = 0, the orbit at the part `phase` of its period. */
double complex fit_path_at(const fit_path *path, double drive_hz, double turn, double phase, double exposure,
                           double t);

/* The slip V at the time t, in the laboratory. */
double complex fit_path_slip_at(const fit_path *path, double drive_hz, double turn, double phase, double t);

#endif
