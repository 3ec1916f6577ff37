/* scale.h - a scale in words, applied to a film: the map from pixels to millimetres, and how wrong it may be. */
#ifndef FST_FOLLOW_SCALE_H
#define FST_FOLLOW_SCALE_H

#include "follow/blobs.h"
#include "follow/plate.h"
#include "follow/rim.h"

/* What is known of a film when its scale is wanted. */
typedef struct follow_view {
    const char *path;
    const follow_still *still;
    const follow_look *look;
    const follow_sizes *sizes;
    double middle[2], reach; /* of the bead's path, pixels */
    double distance;         /* m from the camera to the plate; NAN: unknown */
} follow_view;

/* Refuse points outside of the picture. */
fst_status follow_scale_check(const follow_scale *scale, const follow_still *still, fst_error *error);

/* Make the plane of a scale, in millimetres; `step` is what a pixel is in the middle of the path, in the
 * direction that is not foreshortened, `error_share` its relative standard deviation.  `rim` (begun with taken = -1) becomes the plate's edges, where they are asked
 * for.  FST_BAD_INPUT: the film does not show what the scale names. */
fst_status follow_scale_apply(const follow_scale *scale, const follow_view *view, follow_rim *rim,
                              follow_plane *plane, double *step, double *error_share, fst_error *error);

#endif
