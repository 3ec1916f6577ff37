/* work.h - a track while it is measured: what is known of its motion so far.
 *
 *   clean.c     places that no bead can have been at              fst_track --> rows of seen places
 *   geometry.c  centre, tilt, rate of turning, festoons           rows --> r, alpha, and a model of both
 *   drive.c     the drive, the symmetry, whether the clock is right
 *   errors.c    what would have come out with other turns
 *   measure.c   these in their order, and what is said of them
 */
#ifndef FST_TRACK_WORK_H
#define FST_TRACK_WORK_H

#include <festoon/festoon_tools.h>

#include "track/regress.h"

enum { TRACK_HARMONICS = FST_WAVE_LIMIT };

/* Columns of the model of r: the constant, the harmonics of f0 (cos, sin each), then these. */
enum { TRACK_CENTRE_X, TRACK_CENTRE_Y, TRACK_TILT_C, TRACK_TILT_S, TRACK_SLOPE, TRACK_GEOMETRY };

typedef struct track_work {
    fst_track *track;
    size_t count;          /* rows that are seen and not rejected */
    size_t *row;           /* of the track */
    double *t;             /* s, from the middle of the film; frames where there is no clock */
    double *x, *y;         /* in the picture */
    double *r, *alpha;     /* on the plate, about the centre; alpha unwrapped */
    double *r_off, *a_off; /* residuals of the models of r and alpha */
    double fps;            /* frames in a unit of t */
    double centre[2], stretch[3];
    double bead;                  /* turns of the bead in a unit of t, counter-clockwise positive, as filmed */
    double f0;                    /* the frequency of which r has the harmonics; 0: r does not oscillate */
    int harmonics;                /* how many are fitted */
    int skipped[TRACK_HARMONICS]; /* harmonics that cannot be told from others at this frame rate */
    double peak;                  /* the strongest line of r; 0: none beyond the noise */
    int half;                     /* there is a line at half that frequency too */
    const fst_progress *progress; /* NULL: nobody is told */
    double rounds;                /* of the regression so far */
    double gain;                  /* by how much r oscillates more since an exposure was undone */
    track_fit radial, angular;
} track_work;

fst_status track_work_begin(track_work *work, fst_track *track, fst_error *error);
void track_work_free(track_work *work);
/* Take the rows of the track that are seen. */
void track_work_take(track_work *work);

/* Mark places far outside of all others, or far from both neighbours by how fast the bead moves; returns how
 * many. */
size_t track_reject_jumps(fst_track *track, const track_work *work);
/* Take back places that were rejected, but lie where the model of the motion has the bead; returns how many. */
size_t track_take_back(fst_track *track, track_work *work);
/* Mark places far from the model of the motion; returns how many. */
size_t track_reject_far(fst_track *track, const track_work *work);

/* Find centre, tilt, rates and festoons.  FST_NO_CONVERGENCE: the bead rests or makes no turn. */
fst_status track_find_motion(track_work *work, fst_error *error);
/* The same once more with f0 known. */
fst_status track_refine_motion(track_work *work, fst_error *error);
/* Put row `i` of the track at the place `at` of the work's arrays, with r and alpha by the present centre and
 * models. */
void track_place_row(track_work *work, size_t at, size_t i);
/* Whether r oscillates with k f0, beyond the noise. */
int track_has_line(const track_work *work, int k);
/* The frequency at which a film of so many frames a second shows another one. */
double track_folded(double frequency, double fps);
double track_duration(const track_work *work);
/* A row of the model of r, and of alpha (the first columns: 1, harmonics; then t). */
int track_radial_row(const track_work *work, size_t i, double *row);
int track_angular_row(const track_work *work, size_t i, double *row);

/* What the rates tell of the drive. */
typedef struct track_drive {
    fst_motion motion;
    int symmetry;                       /* a; 0: unknown */
    int relative;                       /* 1: the bead goes round with the magnet, -1: against it */
    double radial;                      /* f_r in Hz, as it is and not as the film shows it; NAN: unknown */
    double drive_apart, festoons_apart; /* how far another reading of a folded line puts them; 0: none does */
    int clock_follows;                  /* the file has no clock, and the drive gave it one */
} track_drive;

/* Compare rates and drive: f0, symmetry and sense follow, and the clock is corrected where only another one
 * agrees. Warnings go into `measured`. */
fst_status track_find_drive(track_work *work, const fst_measure_options *options, track_drive *drive,
                            fst_measurement *measured, fst_error *error);

/* What an exposure must leave of an oscillation so that the rest can be restored. */
#define TRACK_LEAST_KEPT 0.3

/* Undo what an exposure of so many seconds blurs. */
void track_sharpen(track_work *work, double exposure, fst_measurement *measured);

/* Fill in all means and errors. */
fst_status track_find_errors(const track_work *work, const track_drive *drive, fst_measurement *measured,
                             fst_error *error);

void track_warn(fst_measurement *measured, const char *format, ...) __attribute__((format(printf, 2, 3)));

#endif
