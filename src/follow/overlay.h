/* overlay.h - what was found, over what was filmed: a film of every frame, and one picture. */
#ifndef FST_FOLLOW_OVERLAY_H
#define FST_FOLLOW_OVERLAY_H

#include "host/whole_file.h"
#include "io/ffmpeg.h"
#include "follow/bead.h"
#include "follow/plane.h"

enum { FOLLOW_CROPS = 8, FOLLOW_CROP_SIZE = 96, FOLLOW_TRAIL = 64 };

/* A picture of four bytes a pixel: blue, green, red, unused. */
typedef struct follow_canvas {
    int width, height;
    unsigned char *pixels;
} follow_canvas;

typedef struct follow_overlay {
    fst_process process;
    fst_whole_file film, picture;
    const char *film_path, *picture_path; /* the caller's; NULL: not wanted */
    const char *format;
    follow_canvas canvas;
    int frames, started, beads;
    follow_place trail[FST_TRACKED_BEADS][FOLLOW_TRAIL]; /* the last places, a ring */
    /* For the picture: enlarged pieces of frames around the bead, evenly over the film. */
    unsigned char crops[FOLLOW_CROPS][FOLLOW_CROP_SIZE * FOLLOW_CROP_SIZE];
    double crop_scale;
    int crop_count, total;
} follow_overlay;

/* Begin; nothing is written where both paths are NULL. */
fst_status follow_overlay_begin(follow_overlay *overlay, const follow_still *still, const follow_look *look,
                                double fps, int total, int beads, const char *film, const char *picture,
                                fst_error *error);

/* One frame, with the place of each bead that was found in it. */
fst_status follow_overlay_frame(follow_overlay *overlay, const follow_still *still, const unsigned char *frame,
                                int index, const follow_look *look, const follow_place *places,
                                fst_error *error);

/* Finish both, but leave them without their names yet.  columns[] and rows[] are those of each bead.  `rim` (may be NULL) is the plate's edge. */
fst_status follow_overlay_finish(follow_overlay *overlay, const follow_still *still, const follow_look *look,
                                 double *const *columns, double *const *rows, int count,
                                 const follow_ellipse *rim, fst_error *error);

/* Give them their names. */
fst_status follow_overlay_commit(follow_overlay *overlay, fst_error *error);

/* Free everything; what has no name yet is gone. */
void follow_overlay_free(follow_overlay *overlay);

#endif
