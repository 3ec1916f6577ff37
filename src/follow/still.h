/* still.h - the picture without the bead: what stays while the bead goes round.
 *
 * Each pixel's level is the median over some 41 frames at random times.  Regular times would meet a bead that
 * circles regularly in the same places again and again.  The choice of times depends on the film's length
 * alone, so the same film gives the same track.
 */
#ifndef FST_FOLLOW_STILL_H
#define FST_FOLLOW_STILL_H

#include "follow/shake.h"
#include "follow/source.h"

enum { FOLLOW_SAMPLES = 41, FOLLOW_LEAST_FRAMES = 5 };

typedef struct follow_still {
    int width, height;
    float *level; /* gray levels */
    double noise; /* deviation of a pixel where nothing moves, in gray levels */
    double shake; /* pixels that the camera moved (rms) while it filmed the samples, which then were shifted
                               back; 0: it stood still */
    double
        roll; /* rad (rms) by which the camera turned about its axis, which is not turned back; 0: not seen */
    double unsteady; /* what shifting back left of it: more than a part of a pixel, or INFINITY, means that it
                        failed; NAN: the picture is too plain to tell */
    int margin; /* pixels all around that the shake takes out of some frames: nothing is looked for there */
    unsigned char *samples; /* the frames it was made of, one after another */
    float *gains;           /* of each row of each sample */
    int count;
} follow_still;

/* Read the samples and make the picture of them.  Free with follow_still_free(), after a failure too. */
fst_status follow_still_make(follow_still *still, const follow_source *source, const fst_progress *progress,
                             fst_error *error);
void follow_still_drop_samples(follow_still *still);
void follow_still_free(follow_still *still);

/* Shift a frame of a camera that shook back; `room` has gains of all rows, `shift` where it was before. */
void follow_still_steady(const follow_still *still, follow_shake *shake, unsigned char *frame, float *room,
                         double shift[2]);

/* How much brighter each row of a frame is than the still picture: factors, which lamps and the camera's
 * exposure change from frame to frame, and a rolling shutter under lamps that flicker from row to row. */
void follow_still_gains(const follow_still *still, const unsigned char *frame, float *gains);

#endif
