/* rhythm.h - what of a filmed bead's motion repeats itself.
 *
 * Seen from the magnet a settled motion repeats itself.  Seen from the plate, velocity and W_x + i W_y are then sums of
 * arrows that turn at the rates w_b + j w_r, and W_z is one of waves at j w_r: w_b is the rate at which the bead goes
 * round, w_r that at which its distance from the centre swings, and j is a whole number.
 */
#ifndef FST_FOLLOW_RHYTHM_H
#define FST_FOLLOW_RHYTHM_H

#include "follow/turning.h"

enum {
    FOLLOW_LINES = 16,
    FOLLOW_ARROWS = 2 * (2 * FOLLOW_LINES + 1),
    FOLLOW_WAVES = 3 * (2 * FOLLOW_LINES + 1)
};

typedef struct follow_rhythm {
    int lines;       /* the greatest j; 0: nothing repeats itself */
    double start;    /* s, the time from which phases count */
    double rates[2]; /* w_b, w_r, rad/s */
    double later[2]; /* s: by how much later a frame shows the bead a mm to the right, and up; shutters roll */
    double place[FOLLOW_ARROWS + 2], rate[FOLLOW_WAVES];
    double missing; /* of a component of the slip, in lines that it does not have: mm/s */
} follow_rhythm;

/* The usual time from a frame to the next (s); `room` is for as many numbers as there are frames. */
double follow_usual_step(const follow_turning *turning, double *room);

/* Where places repeat themselves, they tell how the camera's shutter rolls: let the times of frames be those at which
 * they show the bead. */
void follow_rhythm_shutter(follow_turning *turning, double usual);

/* Find it in the good frames, which usually are `usual` (s) apart. */
void follow_rhythm_find(const follow_turning *turning, double usual, follow_rhythm *rhythm);

/* Find it before any rotation is known: by the W that takes each face to the next one, from where rolling would have it.
 * follow_light_begin() comes first.  Returns whether places repeat themselves. */
int follow_rhythm_begin(follow_turning *turning, double usual, follow_rhythm *rhythm);

/* The place (mm), the velocity (mm/s) and W (rad/s) of what repeats itself. */
void follow_rhythm_place(const follow_rhythm *rhythm, double time, double place[2], double velocity[2]);
void follow_rhythm_rate(const follow_rhythm *rhythm, double time, double rate[3]);

/* The turning of the bead from one time to another. */
void follow_rhythm_turning(const follow_rhythm *rhythm, double from, double to, double turn[3][3]);

#endif
