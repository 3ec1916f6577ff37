/* special_curve.h - the curve along which a special point moves when a second parameter changes. */
#ifndef FST_ORBIT_SPECIAL_CURVE_H
#define FST_ORBIT_SPECIAL_CURVE_H

#include "orbit/node.h"

/* Follow the special point `start`, of the type options->special over the first parameter, both ways through
 * the ranges of both; points go into `out` as branch number `branch`.  The present part of the watch is this
 * curve.
 */
fst_status fst_special_curve_follow(const fst_branch_options *options, const fst_params *params,
                                    const fst_node *start, int branch, fst_watch *watch, fst_branch *out,
                                    fst_error *error);

#endif
