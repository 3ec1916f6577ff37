/* sphere.h - the surface of the bead: how dark each place of it is, learnt from all frames in which it was seen.
 *
 * The surface lies in a cubic grid around the bead, because a grid of longitudes and latitudes would have poles.  Each
 * node holds a sum of what was seen near it and the sum of the weights; only nodes near the surface are ever used.
 */
#ifndef FST_FOLLOW_SPHERE_H
#define FST_FOLLOW_SPHERE_H

enum { FOLLOW_SPHERE_CELLS = 33 };

typedef struct follow_node {
    float sum, weight;
} follow_node;

typedef struct follow_sphere {
    follow_node *nodes; /* (FOLLOW_SPHERE_CELLS + 1)^3 */
} follow_sphere;

/* Returns 0 where there is no memory.  Free `nodes`. */
int follow_sphere_begin(follow_sphere *sphere);
void follow_sphere_clear(follow_sphere *sphere);

/* A value was seen at a point of the unit sphere. */
void follow_sphere_add(follow_sphere *sphere, const double point[3], double value, double weight);

/* Add what the sphere leaves of all that was seen: a mean over the cells around a point is blurred. */
void follow_sphere_sharpen(follow_sphere *sphere, const follow_sphere *rest);

/* The value at a point, and its gradient in space (NULL: not wanted).  Returns 0 where nothing was seen there. */
int follow_sphere_at(const follow_sphere *sphere, const double point[3], double *value, double slope[3]);

/* Whether most of it was seen, and about half of that is dark. */
int follow_sphere_is_half(const follow_sphere *sphere);

/* The axis of the marks: the middle of the darker half where about half of the surface is dark, and of the larger spot
 * otherwise, a spot being what less of the surface is.  Returns 0 where a part of the surface was never seen. */
int follow_sphere_axis(const follow_sphere *sphere, double axis[3]);

#endif
