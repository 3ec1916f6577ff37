/* film_tracks.h - from a film of a bead to its track; festoon_tools.h includes it. */
#ifndef FESTOON_FILM_TRACKS_H
#define FESTOON_FILM_TRACKS_H

#include <festoon/festoon.h>
#include <festoon/tracks.h>

#ifdef __cplusplus
extern "C" {
#endif

/* How a film is tracked.  What stays as fst_default_film_track_options() makes it follows from the film. */
typedef struct fst_film_track_options {
    uint32_t cookie;
    double fps; /* frames a second, instead of the film's clock; NAN: that clock */
    const char
        *scale;      /* "bead 5 mm", "plate 460 mm", "X1,Y1:X2,Y2=50mm", four points, or several with ; between
                            them, which are compared, and of which the first is taken; NULL: pixels */
    double distance; /* m from the camera to the plate, by which the bead's height over the plate is
                            allowed for; NAN: it is not */
    double turning;  /* m, the diameter of a bead with marks whose turning is wanted, with a scale and a
                        distance; NAN: it is not */
    int beads;       /* how many are followed, 1 to FST_TRACKED_BEADS */
    const char *csv; /* the tracks as a file, festoon\'s own CSV; NULL: none */
    const char *overlay;          /* a film, .mp4 or .mov, that shows what was found; NULL: none */
    const char *picture;          /* a picture, .png, of the same, also where no scale was found; NULL: none */
    const fst_progress *progress; /* NULL: nobody is told */
} fst_film_track_options;
FST_API fst_film_track_options fst_default_film_track_options(void);

/* An ellipse in the still picture that an edge of brightness follows. */
typedef struct fst_plate_edge {
    double diameter[2]; /* the longer and the shorter one, pixels */
    double error;       /* how far the edge is from the ellipse, pixels */
    double share;       /* of the ellipse, along which there is an edge */
    double contrast;    /* the mean step of brightness there, gray levels */
} fst_plate_edge;

/* A scale that was given. */
enum { FST_FILM_SCALES = 4, FST_FILM_SCALE_TEXT = 64 };
typedef struct fst_film_scale {
    char text[FST_FILM_SCALE_TEXT];
    double value; /* mm a pixel in the middle of the path, in the direction that no tilt foreshortens */
    double error; /* a standard deviation, relative */
} fst_film_scale;

/* Whether two scales of a film contradict each other: by more than twice their joint error. */
FST_API int fst_film_scales_differ(const fst_film_scale *one, const fst_film_scale *other);

/* A frame from which on beads may have exchanged their names: each could be where another one was found. */
typedef struct fst_name_doubt {
    int frame;
    double t;       /* s */
    unsigned beads; /* bit k: bead k, from 0 */
} fst_name_doubt;
enum { FST_PLATE_EDGES = 6, FST_NAME_DOUBTS = 32 };

/* What is known of a tracked film. */
typedef struct fst_film_track_report {
    int width, height;       /* of its pictures, after turning them as the film says */
    int frames, lost, twins; /* all frames; frames that lack a bead; frames that repeat the one before */
    int first_lost, missing; /* the first lost frame (-1: none); frames that the clock leaves room for */
    double fps, least_step, most_step; /* mean frames a second; shortest and longest time between frames, s */
    double tick;                       /* of the film's clock, s; 0: unknown */
    /* Slow motion: frames a second at which a phone says that it took the film, which gives the times, and at which
     * the file stores it.  0: the times are the file's. */
    double taken_fps, stored_fps;
    double diameter, diameter_error; /* of the bead without its shadow, pixels */
    double shadow;                   /* how dark its shadow is, in parts of its contrast; 0: there is none */
    double noise, contrast;          /* of a pixel, gray levels; of the bead, gray levels */
    double
        shake; /* pixels that the camera moved, rms; the track is on the plate, without it; 0: it stood still */
    double roll;   /* degrees (rms) by which it turned about its own axis, which the track has; 0: not seen */
    double jitter; /* pixels by which places scatter about a smooth path; NAN: too few frames */
    double scale;  /* mm a pixel in the middle of the path; NAN: no scale */
    double scale_error; /* its relative error, a standard deviation; where another scale contradicts
                                             * it, by how much, 0.99 at most */
    fst_film_scale scales[FST_FILM_SCALES]; /* all that were given, the first being the one taken */
    int scale_count;
    double plate[2];  /* the longer and the shorter diameter of the plate's edge, pixels; NAN: not asked */
    double rim_error; /* how far its points are from the ellipse, pixels */
    /* Edges that may be the plate's, the steepest first: of these the outermost is taken that is at least a quarter as steep
     * as the first. */
    fst_plate_edge edges[FST_PLATE_EDGES];
    int edge_count, edge_taken;             /* no plate is asked for: 0, -1 */
    int beads, doubt_count;                 /* how many beads; how often names may have been exchanged */
    fst_name_doubt doubts[FST_NAME_DOUBTS]; /* the first of these */
    int turned, slips;                      /* frames in which n is known, and in which W and the slip are */
    double slip,
        slipping; /* mean |V| over mean |v|; in which part of these frames |V| is more than twice its error;
                              NAN: no slip is known */
    double
        turned_share; /* of what changes on the bead, that its turning explains: 0, it has no marks that can be
                            followed; NAN: not asked */
    char format[64], codec[64]; /* the file's, for a person */
    char remark[256];           /* what else a person should know; "" */
} fst_film_track_report;

/* Track the beads of a film (whatever ffmpeg reads of mp4, mov, webm, gif, avi, ...) or of a folder of images,
 * which needs `fps`; `track` has room for options->beads tracks.  Several beads are of about one size; the first frame that
 * shows all of them gives them their order, from the left to the right, and each keeps its place in it, but for what
 * report->doubts tells.  Frames count from 0; times are those of the film; y points up in the picture.  Without a
 * scale the unit is px: (0, 0) is the centre of the pixel at the bottom left.  Memory does not grow with the
 * film, but for the track itself.  FST_BAD_INPUT: it is not a film, another number of beads moves, the scale does
 * not fit. FST_UNAVAILABLE: there is no ffmpeg.  The files appear only where the call succeeds. */
FST_API fst_status fst_film_track(const char *film, const fst_film_track_options *options, fst_track *track,
                                  fst_film_track_report *report, fst_error *error);

#ifdef __cplusplus
}
#endif
#endif
