/* made_tracks.h - tracks of beads that the library itself moved, as a camera would have seen them.
 *
 * A motion is computed once; films of it differ in frame rate, noise, tilt, exposure and the rest.
 */
#ifndef FST_TESTS_MADE_TRACKS_H
#define FST_TESTS_MADE_TRACKS_H

#include <festoon/festoon_tools.h>

/* A motion after it has settled, in mm and s, with the numbers that a film of it should show. */
typedef struct made_motion {
    double *t, *x, *y, *vx, *vy;
    size_t count, capacity;
    double drive, mean_r, std_r, bead, festoons; /* Hz, mm, mm, Hz */
    fst_regime regime;
    double time_unit, length_unit;
} made_motion;

/* Follow the bead of `params` for its run.periods. */
void made_motion_follow(made_motion *motion, const fst_params *params);
void made_motion_free(made_motion *motion);

typedef struct made_film {
    double fps, seconds;
    double start;       /* s after the motion's begin */
    double scale;       /* px in a mm */
    double noise;       /* px */
    double tilt, along; /* degrees; direction in the picture that the tilt leaves alone */
    double exposure;    /* s */
    double lost, wild;  /* share of frames that are missing, and of places that are anywhere */
    double clock;       /* times are this many times too long; NAN: there are none */
    int mirrored;
    uint64_t seed;
} made_film;

/* A film without any fault: 240 frames a second, 4 px in a mm, 0.2 px of noise. */
made_film made_film_plain(void);

/* Film a motion.  Free the track with fst_track_free(). */
void made_track(const made_motion *motion, const made_film *film, fst_track *track);

/* Evenly distributed in [0, 1); normally distributed with deviation 1. */
double made_chance(uint64_t *seed);
double made_normal(uint64_t *seed);

#endif
