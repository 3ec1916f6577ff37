/* path.h - the places of a step that lie on the trajectory.
 *
 * The method evaluates the equations at sixteen stages.  Some of its early stages are rough guesses; the nine
 * that carry weight in the step and in its dense output approximate the trajectory well, and these are the
 * "places of the path".  Here they are in the order of their nodes, the fractions of the step at which they
 * lie:
 *
 *     place    0      1     2     3     4     5     6    7,8
 *     node     0     1/4  4/13   1/3   3/5 127/195 6/7    1
 *              |------|-----|-----|-----|-----|-----|-----|
 *            start                                       end
 *
 * Place 7 is the method's last guess of the end, place 8 the end itself.  Whatever is integrated over the step
 * is evaluated at places 0 to 7 and summed with the method's own weights (path.inl); extremes and events are
 * looked for between the places.  Three more, 9 to 11, exist once the dense output is formed: an integral up to
 * a place inside the step needs them too.
 *
 * Nobody outside this room needs to know which stage a place is: ask for its state, its slope (the derivative
 * there) and its pull (the magnet's force) by the macros below, which take a bead's step of any kind of number.
 */
#ifndef FST_ODE_PATH_H
#define FST_ODE_PATH_H

enum { FST_PATH_START = 0, FST_PATH_END = 8, FST_PATH_PLACES = 9, FST_DENSE_PLACES = 12 };

static const int FST_PATH_STAGE_[FST_DENSE_PLACES] = {0, 6, 7, 5, 9, 8, 10, 11, 12, 13, 14, 15};

#define FST_PATH_STATE(step, place) ((step)->stage[FST_PATH_STAGE_[place]])
#define FST_PATH_SLOPE(step, place) ((step)->k[FST_PATH_STAGE_[place]])
#define FST_PATH_PULL(step, place) (&(step)->context.pull[FST_PATH_STAGE_[place]])
#define FST_PATH_PACE(step, place)                                                                             \
    (FST_PATH_SLOPE(step, place)[FST_STEP_TIME])                          /* dt/dtheta, see bead_step.inl */
#define FST_DENSE_ROW(step) ((int)(sizeof(step)->y / sizeof(step)->y[0])) /* numbers between its coefficients */

/* What the motion depends on and never changes, and its modes within the step. */
#define FST_WORLD_OF_STEP(step) step.context.world
#define FST_WORLD(step) (&(step)->context.world)
#define FST_MODES(step) MODES_OF(&(step)->context)

/* Their nodes. */
static const double FST_PATH_NODE[FST_DENSE_PLACES] = {
    0.0, 0.25, 4.0 / 13.0, 1.0 / 3.0, 0.6, 127.0 / 195.0, 6.0 / 7.0, 1.0, 1.0, 0.1, 0.2, 7.0 / 9.0};

/* For a parabola through a place and the two beside it (observe/peaks.inl): the distance to the place before
 * over that to the place after, which is negative.  At the ends, where there are no two beside: the distance to
 * the next place of another node over that to the one beyond. */
static const double FST_PATH_RATIO[FST_PATH_PLACES] = {13.0 / 16.0,    -13.0 / 3.0,   -9.0 / 4.0,
                                                       -5.0 / 52.0,    -26.0 / 5.0,   -70.0 / 281.0,
                                                       -281.0 / 195.0, 195.0 / 476.0, 195.0 / 476.0};

#endif
