/* winding.h - how often a point has gone round the origin: an unwrapped angle without accumulated error.
 *
 * The angle is 2 pi times an integer plus the angle of the last point.  The integer changes only when the path
 * crosses the negative x axis, which the signs of the coordinates decide.
 */
#ifndef FST_BASE_WINDING_H
#define FST_BASE_WINDING_H

#include <math.h>
#include <stdint.h>

#include "base/constants.h"
#include "base/elementary.h"

typedef struct fst_winding {
    int64_t turns;
    double x, y;
} fst_winding;

/* Go on to (x, y) along a straight line. */
static inline void fst_winding_advance(fst_winding *w, double x, double y)
{
    const double cross = w->x * y - w->y * x;
    if (w->y >= 0 && y < 0 && cross > 0)
        w->turns += 1;
    else if (w->y < 0 && y >= 0 && cross < 0)
        w->turns -= 1;
    w->x = x;
    w->y = y;
}

/* Whether the straight line to (x, y) passes the origin within a quarter of its length.  The curved path that
 * it stands for may then pass on the other side. */
static inline int fst_winding_is_doubtful(const fst_winding *w, double x, double y)
{
    const double dx = x - w->x, dy = y - w->y, length2 = dx * dx + dy * dy;
    const double along0 = w->x * dx + w->y * dy, along1 = x * dx + y * dy;
    if (along0 > 0 || along1 < 0) /* the nearest point of the line is one of its ends */
        return 0;
    const double cross = w->x * y - w->y * x;
    return 16.0 * (cross * cross) < length2 * length2;
}

/* The unwrapped angle, rad. */
static inline double fst_winding_angle(const fst_winding *w)
{
    /* y = -0 counts as +0: both lie on the same side of the half-axis. */
    return FST_TWO_PI * (double)w->turns + fst_atan2(w->y + 0.0, w->x);
}

#endif
