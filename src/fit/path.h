/* path.h - the model's path in the laboratory as a sum of turning arrows, for comparison with a track. */
#ifndef FST_FIT_PATH_H
#define FST_FIT_PATH_H

#include <complex.h>

#include <festoon/fit.h>
#include <festoon/tracks.h>

enum { FIT_MODES = 40, FIT_PATH_TERMS = 2 * FIT_MODES + 1 };

typedef enum fit_path_kind { FIT_PATH_PLACE, FIT_PATH_VELOCITY, FIT_PATH_SLIP, FIT_PATH_KINDS } fit_path_kind;

/* In the frame of the magnet an orbit is periodic: z = sum of c_j exp(i j w t). */
typedef struct fit_path {
    double complex terms[FIT_PATH_KINDS][FIT_PATH_TERMS]; /* c_(j - FIT_MODES); m and m/s */
    double drive_hz, period;                              /* how often the magnet turns; s */
} fit_path;

/* The path of an orbit of this setup, velocity and slip as they are told of a film (fst_turning) whose frames are `step` (s)
 * apart; 0: as they are.  FST_STEP_UNDERFLOW and the like as of a run. */
fst_status fit_path_make(const fst_params *params, const fst_orbit *orbit, double step, fit_path *path,
                         fst_error *error);

/* The place, the velocity or the slip V at the time t in the laboratory, averaged over the exposure that begins half of it
 * earlier: the magnet at the angle `turn` at t = 0, the orbit at the part `phase` of its period. */
double complex fit_path_at(const fit_path *path, fit_path_kind kind, double turn, double phase, double exposure,
                           double t);

#endif
