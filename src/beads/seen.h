/* seen.h - what is seen of beads that move, whichever method moves them, and what is told of a window of time. */
#ifndef FST_BEADS_SEEN_H
#define FST_BEADS_SEEN_H

#include "beads/groups.h"

/* The beads at one moment, and what has added up since the start. */
typedef struct beads_seen {
    const beads_world *world;
    const double *y; /* twelve numbers a bead */
    const int *gone;
    const double *ejected; /* when, or NAN */
    const double *turned;  /* angle about the axis, in the turning frame, unwrapped */
    const double *r, *load, *height,
        *work; /* integrals over time: of each bead; BEADS_DRIVE, BEADS_PLATE, BEADS_PAIR */
    double time, impacts;
} beads_seen;

/* How far the axes on which angles are counted turn from one moment to the other. */
double beads_frame_turned(const beads_world *world, double from, double to);

/* The groups of a state, followed over the time after it. */
typedef struct beads_groups {
    int count, *members;
    fst_bead_group *group;
    double *numbers; /* of each group, in threes: angle of the centre, integral of its r, angle of the axis
                        (of a single bead, of its moment in the plane of x and z) */
} beads_groups;

/* The same numbers at a moment, kept. */
typedef struct beads_moment {
    double time, impacts, work[BEADS_R];
    /* Of each bead: r, load, height, turned, x; behind these those of the groups; behind these, of the middle, the swings after
     * it. */
    double *numbers;
} beads_moment;

/* Room for what is told of `count` beads.  FST_NO_MEMORY; free it in either case. */
fst_status beads_make_room(int count, beads_groups *groups, beads_moment moments[3], fst_error *error);
void beads_free_room(beads_groups *groups, beads_moment moments[3]);

/* Where the centres and axes of groups are. */
void beads_find_centres(const beads_seen *seen, const beads_groups *groups, double *centres);
enum { BEADS_CENTRE = 6 }; /* numbers of each: x, y, r, dr/dt, and the axis in the plane */

/* Add what the step of the length h did, which began with `before`. */
void beads_follow(const beads_seen *seen, const double *before, double h, beads_groups *groups);

void beads_keep(const beads_seen *seen, const beads_groups *groups, beads_moment *moment);

/* Behind the middle of the window, after each step: how far r and angle swing about their ways at the mean rates of its
 * first half. */
void beads_follow_swings(const beads_seen *seen, beads_moment at[3]);

/* Tell beads, groups and powers of the window, and decide what it is.  The groups of the result are found. */
void beads_conclude(const beads_seen *seen, const beads_groups *groups, const beads_moment at[3],
                    fst_beads_result *result);

#endif
