/* work.h - a track while it is measured: what is known of its motion so far.
 *
 *   clock.c     whether the film is slowed in parts
 *   clean.c     places that no bead can have been at              fst_track --> rows of seen places
 *   geometry.c  centre, tilt, rate of turning, festoons           rows --> r, alpha, and a model of both
 *   winding.c   how often the bead goes round, from place to place
 *   settle.c    what of the film comes before the motion has settled
 *   drive.c     the drive, the symmetry, whether the clock is right
 *   errors.c    what would have come out with other turns
 *   measure.c   these in their order, and what is said of them
 *   pairs.c     the same of several beads, and the angles between them
 */
#ifndef FST_MEASURE_WORK_H
#define FST_MEASURE_WORK_H

#include <festoon/festoon_tools.h>

#include "io/json_writer.h"
#include "measure/regress.h"

enum { MEASURE_HARMONICS = FST_WAVE_LIMIT };

/* Columns of the model of r: the constant, the harmonics of f0 (cos, sin each), then these. */
enum { MEASURE_CENTRE_X, MEASURE_CENTRE_Y, MEASURE_TILT_C, MEASURE_TILT_S, MEASURE_SLOPE, MEASURE_GEOMETRY };

/* What of a radius the centre of a bead may be off by in the same way in each turn: a tenth of a pixel of a path that is 100
 * pixels wide.  Festoons are four times that up to a drive of 30 Hz. */
#define MEASURE_OF_PIXELS 2e-3

typedef struct measure_work {
    fst_track *track;
    size_t first;          /* row of the track from which the motion has settled */
    int drifts;            /* it has not settled to the end of the film */
    size_t count;          /* rows from there on that are seen and not rejected */
    size_t *row;           /* of the track */
    double *t;             /* s, from the middle of the film; frames where there is no clock */
    double *x, *y;         /* in the picture */
    double *r, *alpha;     /* on the plate, about the centre; alpha unwrapped */
    double *r_off, *a_off; /* residuals of the models of r and alpha */
    double *scratch;       /* room for two numbers a row */
    double fps;            /* frames in a unit of t */
    double centre[2], stretch[3];
    int followed;  /* alpha is unwrapped from place to place: no step is large */
    double bead;   /* turns of the bead in a unit of t, counter-clockwise positive, as filmed */
    double f0;     /* the frequency of which r has the harmonics; 0: r does not oscillate */
    int rolls;     /* the model of alpha has the columns of a shutter that rolls */
    int harmonics; /* how many are fitted */
    int skipped[MEASURE_HARMONICS]; /* 0: the harmonic can be seen; 1: the frame rate hides it; 1 + k: it shows
                                       it in the place of the k-th */
    double peak;                    /* the strongest line of r; 0: none beyond the noise */
    double
        unsure; /* the amplitude of a line that may be but errors of places, which repeat in each turn; 0: none */
    int half;   /* there is a line at half that frequency too */
    const fst_progress *progress; /* NULL: nobody is told */
    double rounds;                /* of the regression so far */
    double gain;                  /* by how much r oscillates more since an exposure was undone */
    double exposure;              /* that was undone, 0 if none */
    measure_regression radial, angular;
} measure_work;

fst_status measure_work_begin(measure_work *work, fst_track *track, fst_error *error);
void measure_work_free(measure_work *work);
/* Take the rows of the track from work->first on that are seen. */
void measure_work_take(measure_work *work);

/* Where a film is slowed in parts, take its clock away from the track, with a warning. */
fst_status measure_forget_slowed_clock(fst_track *track, fst_measurement *measured, fst_error *error);

/* Mark places far outside of all others, or far from both neighbours by how fast the bead moves; returns how
 * many. */
size_t measure_reject_jumps(fst_track *track, const measure_work *work);
/* Take back places that were rejected, but lie where the model of the motion has the bead; returns how many. */
size_t measure_take_back(fst_track *track, measure_work *work);
/* Mark places far from the model of the motion; returns how many. */
size_t measure_reject_far(fst_track *track, const measure_work *work);

/* Find centre, tilt, rates and festoons.  FST_NO_CONVERGENCE: the bead rests or makes no turn. */
fst_status measure_find_motion(measure_work *work, fst_error *error);
/* The same once more, with the harmonics of work->f0 (none where it is 0). */
fst_status measure_refine_motion(measure_work *work, fst_error *error);
/* Put row `i` of the track at the place `at` of the work's arrays, with r and alpha by the present centre and
 * models. */
void measure_place_row(measure_work *work, size_t at, size_t i);
/* Unwrap alpha from place to place, so that the film's middle lies nearest to this angle.  0: a step is too large for that,
 * and alpha is as it was. */
int measure_follow(measure_work *work, double middle);
/* Whether work->bead is the bead's rate. */
typedef enum {
    MEASURE_RATE_SURE,
    MEASURE_RATE_IRREGULAR, /* it is, but the motion does not repeat itself: its r has no rate that tells of the drive */
    MEASURE_RATE_UNKNOWN /* the bead could not be followed, and its places tell of no rate or of another one */
} measure_rate;
measure_rate measure_look_at_rate(const measure_work *work);
/* The slowest line of r that is looked for: slower ones are those of centre and tilt, or the film's length. */
double measure_least_line(const measure_work *work);
/* The amplitude of k f0 in r, 0 where the model lacks it, and the least one that would stand out of the noise. */
double measure_line_size(const measure_work *work, int k, double *least);
/* Whether r oscillates with k f0, beyond the noise. */
int measure_has_line(const measure_work *work, int k);
/* Whether the noise could hide an oscillation with k f0 that is not small beside that with `behind` f0. */
int measure_may_hide_line(const measure_work *work, int k, int behind);
/* Whether what is seen with f0 may be one of its multiples, which the frame rate shows there. */
int measure_line_is_blended(const measure_work *work);
/* Whether k f0 fades away in the film: less than half is left in its last third of what the first has. */
int measure_line_dies(const measure_work *work, int k);
/* Whether the frame rate maps a frequency onto zero, onto the lines by which centre and tilt show, or onto half of
 * itself, where it shows but one phase. */
int measure_stands(const measure_work *work, double frequency);
/* The frequency at which a film of so many frames a second shows another one. */
double measure_folded(double frequency, double fps);
double measure_duration(const measure_work *work);
/* Whether two rows are of neighbouring frames. */
int measure_neighbours(const measure_work *work, size_t i);
/* By how much residuals that hang together widen variances: 1 where they do not, (1 + rho)/(1 - rho) where each is
 * rho of the one before. */
double measure_hanging_together(const measure_work *work, const double *off);
/* A row of the model of r, and of alpha (the first columns: 1, harmonics; then t). */
int measure_radial_row(const measure_work *work, size_t i, double *row);
int measure_angular_row(const measure_work *work, size_t i, double *row);

/* Leave out the beginning of the film until the motion has settled, and find the motion of the rest. */
fst_status measure_settle(measure_work *work, fst_error *error);
void measure_tell_settled(const measure_work *work, fst_measurement *measured);

/* What the rates tell of the drive. */
typedef struct measure_drive {
    fst_motion motion;
    int symmetry;      /* a, by which f_drive follows */
    int unsure;        /* a is 2, but the noise may hide that it is 1, or a was 1 and may become 2 */
    int fades;         /* the second of these */
    int relative;      /* 1: the bead goes round with the magnet, -1: against it */
    double radial;     /* f_r in Hz, as it is and not as the film shows it; NAN: unknown */
    double fastest;    /* the most Hz that the oscillation of r may have, which the frame rate may hide */
    int folded;        /* the line of r may be a folded one: drive, festoons and symmetry are not known */
    int standing;      /* festoons may look like the mean of r, or like a tilt */
    int bead_folded;   /* so may the bead's own rate be */
    int clock_set;     /* the clock was corrected */
    int clock_wrong;   /* it is wrong, and was not corrected */
    int clock_follows; /* the file has no clock, and the drive gave it one */
} measure_drive;

/* Compare rates and drive: f0, symmetry and sense follow, and the clock is corrected where only another one
 * agrees. Warnings go into `measured`. */
fst_status measure_find_drive(measure_work *work, const fst_measure_options *options, measure_drive *drive,
                              fst_measurement *measured, fst_error *error);

/* What an exposure must leave of an oscillation so that the rest can be restored. */
#define MEASURE_LEAST_KEPT 0.3

/* What an exposure of so many seconds leaves of an oscillation. */
double measure_kept(double frequency, double exposure);
/* Undo what work->exposure blurs.  Returns whether it has left too little of the festoons. */
int measure_sharpen(measure_work *work);

/* Fill in all means and errors. */
fst_status measure_find_errors(const measure_work *work, const measure_drive *drive, fst_measurement *measured,
                               fst_error *error);

/* The first frame from which on a track may be that of another bead; -1: there is none. */
int64_t measure_first_doubt(const fst_track *track);

/* The members of a measurement, into an object that is open. */
void measure_write(fst_json *json, const fst_measurement *measured);

void measure_warn(fst_measurement *measured, const char *format, ...) __attribute__((format(printf, 2, 3)));

#endif
