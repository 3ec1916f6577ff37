/* overlay.h - what was found, over what was filmed: a film of every frame, and one picture. */
#ifndef FST_TRACK_OVERLAY_H
#define FST_TRACK_OVERLAY_H

#include "host/whole_file.h"
#include "io/ffmpeg.h"
#include "track/follow.h"
#include "track/plane.h"

enum { TRACK_CROPS = 8, TRACK_CROP_SIZE = 96, TRACK_TRAIL = 64 };

/* A picture of four bytes a pixel: blue, green, red, unused. */
typedef struct track_canvas {
    int width, height;
    unsigned char *pixels;
} track_canvas;

typedef struct track_overlay {
    fst_ffmpeg process;
    fst_whole_file film, picture;
    const char *film_path, *picture_path; /* the caller's; NULL: not wanted */
    const char *format;
    track_canvas canvas;
    int frames, started;
    track_place trail[TRACK_TRAIL]; /* the last places, a ring */
    /* For the picture: enlarged pieces of frames around the bead, evenly over the film. */
    unsigned char crops[TRACK_CROPS][TRACK_CROP_SIZE * TRACK_CROP_SIZE];
    double crop_scale;
    track_place crop_places[TRACK_CROPS];
    int crop_count, total;
} track_overlay;

/* Begin; nothing is written where both paths are NULL. */
fst_status track_overlay_begin(track_overlay *overlay, const track_still *still, const track_look *look,
                               double fps, int total, const char *film, const char *picture, fst_error *error);

/* One frame, with the place that was found in it. */
fst_status track_overlay_frame(track_overlay *overlay, const track_still *still, const unsigned char *frame,
                               int index, const track_look *look, const track_place *place, fst_error *error);

/* Finish both, but leave them without their names yet.  `rim` (may be NULL) is the plate's edge. */
fst_status track_overlay_finish(track_overlay *overlay, const track_still *still, const track_look *look,
                                const double *columns, const double *rows, int count, const track_ellipse *rim,
                                fst_error *error);

/* Give them their names. */
fst_status track_overlay_commit(track_overlay *overlay, fst_error *error);

/* Free everything; what has no name yet is gone. */
void track_overlay_free(track_overlay *overlay);

#endif
