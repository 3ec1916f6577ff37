/* still.h - the picture without the bead: what stays while the bead goes round.
 *
 * Each pixel's level is the median over some 41 frames at random times.  Regular times would meet a bead that
 * circles regularly in the same places again and again.  The choice of times depends on the film's length
 * alone, so the same film gives the same track.
 */
#ifndef FST_TRACK_STILL_H
#define FST_TRACK_STILL_H

#include "track/film_source.h"

enum { TRACK_SAMPLES = 41, TRACK_LEAST_FRAMES = 5 };

typedef struct track_still {
    int width, height;
    float *level;           /* gray levels */
    double noise;           /* deviation of a pixel where nothing moves, in gray levels */
    unsigned char *samples; /* the frames it was made of, one after another */
    float *gains;           /* of each row of each sample */
    int count;
} track_still;

/* Read the samples and make the picture of them.  Free with track_still_free(), after a failure too. */
fst_status track_still_make(track_still *still, const track_source *source, const fst_progress *progress,
                            fst_error *error);
void track_still_drop_samples(track_still *still);
void track_still_free(track_still *still);

/* How much brighter each row of a frame is than the still picture: factors, which lamps and the camera's
 * exposure change from frame to frame, and a rolling shutter under lamps that flicker from row to row. */
void track_still_gains(const track_still *still, const unsigned char *frame, float *gains);

#endif
