/* tracks.h - where a filmed bead was, frame by frame: reading and writing tracks; festoon_tools.h includes it.
 *
 * A track is what an experiment gives: a place for each frame of a film.  It is made by the program that
 * follows a bead in a film, ours or another one, and is the material from which numbers are measured.
 */
#ifndef FESTOON_TRACKS_H
#define FESTOON_TRACKS_H

#include <festoon/festoon.h>

#ifdef __cplusplus
extern "C" {
#endif

/* What is known of a frame. */
typedef enum {
    FST_FRAME_SEEN,    /* the bead was found: x and y are its place */
    FST_FRAME_LOST,    /* it was not: x and y are NAN */
    FST_FRAME_REJECTED /* a place is there, but the bead cannot have been at it; means leave it out */
} fst_frame_flag;

enum { FST_LENGTH_UNIT_SIZE = 8, FST_TRACKED_BEADS = 4 };

/* W and v of a frame come of it and its neighbours, so many frames in all, in which rotations and places are polynomials of
 * this order in time: what changes within half of them is lost, unless it repeats itself over the whole film. */
enum { FST_TURNING_WINDOW = 11, FST_TURNING_ORDER = 7 };

/* How a bead with marks turns in a frame, in the axes of the track, z being up from the plate.  NAN: not known.  An error is
 * one standard deviation. */
typedef struct fst_turning {
    double n[3];       /* from the middle of the bead to that of its mark, of length 1 */
    double n_error;    /* of its direction, each way, rad */
    double w[3];       /* W, rad/s */
    double w_error;    /* of a component */
    double slip[2];    /* V = v - R W x e, the velocity of the lowest point, length_unit/s */
    double slip_error; /* of a component */
} fst_turning;

/* A track: one row a frame, in the order of time.  Frames that a file leaves out have no row; their number
 * shows in `frame`, which rises by one from a frame of the film to the next.  The axes are those of the picture
 * as a person sees it: x to the right, y up; where the origin is depends on the file and means nothing.  Begin
 * with {0}; free with fst_track_free(). */
typedef struct fst_track {
    size_t rows, capacity;
    int64_t *frame;       /* number of the frame in the film; it begins with 0, 1 or anything else */
    double *t;            /* s; rises strictly.  NAN in all rows: the file has no clock (frames alone) */
    double *x, *y;        /* in length_unit, NAN where lost */
    unsigned char *flag;  /* fst_frame_flag */
    int *doubts;          /* how often until here the bead may have exchanged its name with another one's */
    fst_turning *turning; /* NULL: how the bead turns was not looked at */
    int rhythm; /* W and slip are so many harmonics of a motion that repeats itself; 0: those of the windows */
    char length_unit[FST_LENGTH_UNIT_SIZE]; /* "px", or a unit of params.def: "mm" */
    double
        scale_error; /* relative standard deviation of the length of a pixel, which all lengths share; 0: unknown,
                           or none */
    double fps;      /* frames a second: of the file's clock, or as it was given; NAN: unknown */
    int steady;      /* the times are those of a clock of constant frame rate, up to the digits written */
} fst_track;

FST_API void fst_track_free(fst_track *track);

/* Add a row; x = NAN means lost.  FST_NO_MEMORY is the only failure. */
FST_API fst_status fst_track_append(fst_track *track, int64_t frame, double t, double x, double y,
                                    fst_error *error);

/* Make room for the turning in each row, not known.  FST_NO_MEMORY is the only failure. */
FST_API fst_status fst_track_add_turning(fst_track *track, fst_error *error);

/* Write a track as festoon's own CSV, whole or not at all: where the scale has an error, a comment
 * `# scale_error: 0.004`, where there is a rhythm, `# rhythm: 3`; columns `frame,t [s],x [mm],y [mm]` with the track's
 * unit of length, a row a frame, empty cells where the bead was lost.  Rejected places are written as they are.
 * Without a clock there is no column `t [s]`.  A track with turning has columns for it, and empty cells where it is not
 * known. */
FST_API fst_status fst_track_write(const char *path, const fst_track *track, fst_error *error);

/* Write the tracks of one to four beads of a film, which have the same frames.  Of several the columns `track`, which counts
 * from 1, and `doubts` follow, and a frame has a row for each bead. */
FST_API fst_status fst_tracks_write(const char *path, const fst_track *tracks, int count, fst_error *error);

/* How a file of tracks is to be read.  What stays as fst_default_track_options() makes it follows from the
 * file. */
typedef struct fst_track_options {
    uint32_t cookie;
    const char *format;     /* one of fst_track_formats(), NULL: recognised by the header */
    const char *name;       /* which track of several: its name, number or id; NULL: the longest */
    double fps;             /* frames a second, instead of the file's clock; NAN: that clock */
    double scale;           /* metres that one unit of length of the file is; NAN: as the file says */
    double scale_error;     /* its relative standard deviation; 0: none, or unknown */
    const char *scale_unit; /* the unit in which the track is wanted then ("mm"); NULL: "mm" */
    double from, to;        /* the first and the last frame that are taken, by the file's numbers; NAN: all */
} fst_track_options;
FST_API fst_track_options fst_default_track_options(void);

/* The names of the formats, separated by '|'. */
FST_API const char *fst_track_formats(void);

/* Read the tracks of all beads of a film that fst_tracks_write() wrote; of any other file, or where options->name is given,
 * the one track that fst_track_read() reads.  `count` becomes their number; tracks[] is {0} behind them. */
FST_API fst_status fst_tracks_read(const char *path, const fst_track_options *options,
                                   fst_track tracks[FST_TRACKED_BEADS], int *count, char **understood,
                                   fst_error *error);

/* Read a track.  `understood` (may be NULL) becomes a text for a person: format, track, number of frames,
 * clock, unit, where y points; free() it.  FST_BAD_INPUT: the format is unknown, or a line is wrong;
 * error->where is "FILE:LINE" and the sentence says what was expected. */
FST_API fst_status fst_track_read(const char *path, const fst_track_options *options, fst_track *track,
                                  char **understood, fst_error *error);

/* ------------------------------------------------------------------ measuring */

enum { FST_WARNING_LIMIT = 24, FST_WARNING_SIZE = 360, FST_WAVE_LIMIT = 8 };

typedef struct fst_measure_options {
    uint32_t cookie;
    double drive;                 /* Hz; negative where the magnet turns clockwise in the film; NAN: unknown */
    double exposure;              /* s that a frame was exposed; NAN: unknown, nothing is corrected */
    const fst_progress *progress; /* NULL: nobody is told */
} fst_measure_options;
FST_API fst_measure_options fst_default_measure_options(void);

/* How the bead goes round in the film. */
typedef enum { FST_MOTIONS(FST_ROW_ENUM) FST_MOTION_COUNT } fst_motion;
FST_API const char *fst_motion_name(fst_motion motion);

/* What was measured of a track.  A number that is unknown or has no meaning here is NAN. */
typedef struct fst_measurement {
#define FST_MEASURED(name, unit, doc) double name;
#include <festoon/measure.def>
#undef FST_MEASURED
    double centre[2], centre_error[2]; /* of the path, in the file's axes with y up */
    double stretch[3]; /* xx, xy, yy of the symmetric matrix that undoes the tilt: (x, y) - centre times it is
                          the place on the plate */
    int64_t frames, lost; /* frames from the first to the last; how many of them are missing or were rejected */
    int64_t rejected, repeated; /* of these, rejected ones; frames that repeat the one before exactly */
    int64_t left_out; /* frames at the beginning of which no number is, because the motion had not settled */
    /* What was fitted to the distance from the centre: wave_mean and the sum over k = 1, 2, ... of wave_cos[k -
     * 1] cos + wave_sin[k - 1] sin of 2 pi k wave_hz (t - wave_origin), t being the track's time (its frame
     * where it has none). */
    double wave_mean, wave_hz, wave_origin, wave_cos[FST_WAVE_LIMIT], wave_sin[FST_WAVE_LIMIT];
    int filmed_sense; /* 1: the bead circles counter-clockwise in the film, -1: clockwise */
    int symmetry;     /* a: 2 where r oscillates twice in a turn against the magnet (S2), 1 (S1), 0: unknown */
    fst_motion motion;
    char length_unit[FST_LENGTH_UNIT_SIZE];
    int warning_count;
    char warnings[FST_WARNING_LIMIT][FST_WARNING_SIZE];
} fst_measurement;

/* One row of measure.def. */
typedef struct fst_measured_info {
    const char *name, *unit, *doc; /* unit "length": the track's */
    size_t offset;                 /* of the double in fst_measurement */
} fst_measured_info;
FST_API int fst_measured_count(void);
FST_API const fst_measured_info *fst_measured_at(int index);

/* Measure a track: mean radius and its deviation, frequencies, festoons, the drive from the track itself, each
 * with an error.  Rows that cannot belong to the motion become FST_FRAME_REJECTED, and where the clock was
 * corrected the track's times and frame rate are corrected too.  FST_NO_CONVERGENCE: the bead rests, or goes
 * round too little for anything to be measured. */
FST_API fst_status fst_measure_track(fst_track *track, const fst_measure_options *options,
                                     fst_measurement *measured, fst_error *error);

/* What the angle between two beads does. */
typedef enum { FST_PAIRINGS(FST_ROW_ENUM) FST_PAIRING_COUNT } fst_pairing;
FST_API const char *fst_pairing_name(fst_pairing pairing);

/* Two beads of one film.  The angle is that from the first to the second one about the common centre, on the plate,
 * counter-clockwise in the film.  NAN: unknown, or without a meaning; errors of less than eight turns. */
typedef struct fst_pair {
    int beads[2];                          /* from 0 */
    double angle_deg, angle_deg_error;     /* its mean, -180 to 180; NAN where one bead goes past the other */
    double angle_spread_deg;               /* its standard deviation over the film */
    double drift_deg_s, drift_deg_s_error; /* by which it grows, degrees a second */
    double mean_distance, least_distance;  /* between the centres, in the tracks' unit */
    int64_t frames;                        /* in which both were seen, once the motion has settled */
    fst_pairing pairing;
    char reason[96]; /* why numbers are missing; "" */
} fst_pair;
enum { FST_TRACKED_PAIRS = FST_TRACKED_BEADS * (FST_TRACKED_BEADS - 1) / 2 };

/* Several beads of one film. */
typedef struct fst_beads_measurement {
    int count, pair_count;
    fst_measurement beads[FST_TRACKED_BEADS];
    char reasons[FST_TRACKED_BEADS][FST_WARNING_SIZE]; /* why a bead was not measured: it rests, ...; "" */
    int64_t
        uncertain_from[FST_TRACKED_BEADS]; /* the first frame from which on it may be another bead; -1: none */
    fst_pair pairs[FST_TRACKED_PAIRS];
    int groups
        [FST_TRACKED_BEADS]; /* of each bead: the first one with which it orbits, the angle being steady */
    int grouped;             /* 0: the film does not tell the groups */
} fst_beads_measurement;

/* Measure the tracks of the beads of one film as fst_measure_track() does, and each pair.  A bead of which nothing can be
 * measured has a reason; FST_NO_CONVERGENCE: all have. */
FST_API fst_status fst_measure_tracks(fst_track *tracks, int count, const fst_measure_options *options,
                                      fst_beads_measurement *measured, fst_error *error);

/* The same as JSON, in which beads count from 1; free() it.  NULL: no memory. */
FST_API char *fst_beads_measurement_json(const fst_beads_measurement *measured);

/* Draw a measured track: the path on the plate, the path in the frame that turns with the magnet, r against
 * alpha, and what the fit leaves of r over time.  `compare` (NULL: nothing) is a scene whose path, at the drive
 * of the track, is laid over both paths; of a track in px it is drawn with the same <r>.  FST_BAD_INPUT: the
 * bead does not turn against or with the magnet, so that no path can be laid over it.  FST_NO_CONVERGENCE: the
 * scene's bead does not turn. */
FST_API fst_status fst_figure_measurement(const fst_track *track, const fst_measurement *measured,
                                          const fst_params *compare, const char *out,
                                          const fst_progress *progress, fst_error *error);

/* The places of a measured track as that figure shows them: about the centre that was found, without the tilt
 * of the camera; lost frames are left out. */
typedef struct fst_placed_track {
    size_t count;
    size_t *row;             /* of the track */
    double *t;               /* s, or frames since the first one */
    double *x, *y;           /* on the plate, in measured->length_unit */
    double *seen_x, *seen_y; /* from the turning magnet; NAN: how it turns is not known */
    double *r, *fitted;      /* the distance from the centre, and what was fitted to it */
    const char *clock;       /* "s" or "frames" */
    void *memory;            /* of fst_placed_track_free() */
} fst_placed_track;
FST_API fst_status fst_place_track(const fst_track *track, const fst_measurement *measured,
                                   fst_placed_track *placed, fst_error *error);
FST_API void fst_placed_track_free(fst_placed_track *placed);

/* What was fitted to the distance from the centre, at a time of a placed track. */
FST_API double fst_fitted_radius(const fst_measurement *measured, double t);

/* Lay up to FST_CHARTS_OVER tables of measured points with their errors over the curves of as many sweeps over
 * the drive (databases) or branches over the drive (JSON), a panel for each quantity.  Of the options (NULL:
 * all zeros) count the keys (names of fst_measured; none: all that was measured), the units (as given: mm and
 * Hz), title and size.  chi^2 is the sum over all measured numbers of these for which there is a curve at
 * their frequency (of a branch: the nearest stable one; of a sweep: a run, or two neighbours of one regime, none
 * of them undecided), and `counted` says how many these are; `left_out`
 * names the others with the reason, each on a line, as many as have room; `fits` (NULL: not wanted) has room
 * for result_count * point_count, those of result m and table p at m * point_count + p. FST_BAD_INPUT: scaled
 * units, and two results differ in l or gamma. */
struct fst_sweep_figure;
typedef struct fst_points_fit {
    double chi2;
    int counted, all;
    char left_out[2048];
} fst_points_fit;
FST_API fst_status fst_figure_points(const char *const *results, int result_count, const char *const *points,
                                     int point_count, const struct fst_sweep_figure *options, const char *out,
                                     fst_points_fit *fits, fst_error *error);

/* A measurement as JSON; free() it.  NULL: no memory. */
FST_API char *fst_measurement_json(const fst_measurement *measured);

#ifdef __cplusplus
}
#endif

#endif
