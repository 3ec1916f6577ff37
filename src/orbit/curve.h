/* curve.h - curves of equilibria or orbits over a parameter, point by point, with the special points between.
 */
#ifndef FST_ORBIT_CURVE_H
#define FST_ORBIT_CURVE_H

#include "orbit/special.h"

typedef struct fst_curve {
    const fst_family *family;
    double from, to; /* of the parameter */
    double longest_step;
    fst_curve_sink sink;
    fst_curve_end end; /* why it ended */
} fst_curve;

/* The curve on from `start` (corrected, with its tangent; its sign is the way), until it leaves the range,
 * ends, or cannot be followed: curve->end.  `start` itself is not reported.  Fails only where the sink does,
 * where memory or parameters do, or with what the family's watch answers. */
fst_status fst_curve_follow(fst_curve *curve, const fst_node *start, int sign, fst_error *error);

#endif
