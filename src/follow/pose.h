/* pose.h - one frame of a bead that turns, against what is known of its surface and of the light. */
#ifndef FST_FOLLOW_POSE_H
#define FST_FOLLOW_POSE_H

#include "follow/turning.h"

#define FOLLOW_INNER 0.88 /* radii within which the surface is seen well */

/* What a point of a face shows, in levels of the plate behind. */
double follow_seen(const follow_turning *t, const follow_turn *f, int k);

/* Prepare for a frame: where on the front of the bead its points are, and the light there. */
void follow_face(follow_turning *t, const follow_turn *f);

/* The place on the bead of a point of its front. */
void follow_on_bead(const double turn[3][3], const double facing[3], double point[3]);

/* A square in sigma^2, cut off as outliers are. */
double follow_bound(double square);

/* Of the frame that was prepared: improve a pose in a few steps, by what is expected of it too; or try rotations up to
 * `reach` (rad) around it first. */
void follow_refine(const follow_turning *t, const follow_turn *f, int steps, follow_pose *pose);
void follow_search(const follow_turning *t, const follow_turn *f, double reach, follow_pose *pose);

/* Move the centre of the frame to where its pose and its light fit best. */
void follow_recentre(follow_turning *t, follow_turn *f, int steps);

/* Add the face of the frame to the surface; or what the surface leaves of it to `rest`. */
void follow_show(follow_turning *t, const follow_turn *f);
void follow_show_rest(follow_turning *t, const follow_turn *f);

/* What a frame alone knows of its rotation, once neither the gain nor the shift is known. */
void follow_known(follow_turning *t, follow_turn *f);

/* How the light changes to the right and up at each point. */
void follow_slopes(follow_turning *t);

/* The error (rad) of a direction n by what is known of a rotation; where n is 0, about that of the rotation itself. */
double follow_unsure(const double known[3][3], const double n[3]);

/* What is known of a turning that is made of two, of which one and the other are known: (A^-1 + B^-1)^-1 = A (A + B)^-1 B.
 * Returns 0 where that cannot be told. */
int follow_known_together(const double one[3][3], const double other[3][3], double both[3][3]);

/* The light before the surface is known: what marks change is in proportion to the mean.  Returns the usual spread, in
 * gray levels.  Then learn it from all good frames: a straight line of what was seen over what the surface has there. */
double follow_light_begin(follow_turning *t);
void follow_light_learn(follow_turning *t);

/* The surface, from all good frames. */
void follow_surface_learn(follow_turning *t);

/* The light is learnt up to a shift of all frames: let their mean be that of the outlines. */
void follow_centre(follow_turning *t);

/* Which part of the variance of all faces is explained.  Sigma of each point becomes what is left there. */
double follow_explain(follow_turning *t);

/* Few frames show both halves of a painted bead, so that passes hardly turn the halves against each other about n.  Turn them
 * as explains most: at the top of a parabola through three tries.  Returns whether it is worth more passes. */
int follow_untwist(follow_turning *t);

#endif
