/* branches.h - what tests of branches share: a scene, following a branch, and finding a special point on it. */
#ifndef FST_TESTS_BRANCHES_H
#define FST_TESTS_BRANCHES_H

#include "numeric.h"

#include <stdio.h>

#include <festoon/festoon.h>

/* The paper's scene with another drive and dynamics. */
static inline fst_params scene_of(double omega, const char *dynamics)
{
    fst_params params = fst_default_params();
    fst_error error;
    char text[32];
    (void)snprintf(text, sizeof text, "%.17g", omega);
    assert_int_equal(fst_params_set(&params, "model.dynamics", dynamics, &error), FST_OK);
    assert_int_equal(fst_params_set(&params, "drive.omega", text, &error), FST_OK);
    return params;
}

/* Options of a branch over omega. */
static inline fst_branch_options over_omega(fst_branch_kind kind, double from, double to)
{
    fst_branch_options o = fst_default_branch_options();
    o.kind = kind;
    o.from = from;
    o.to = to;
    return o;
}

static inline fst_branch followed(const fst_params *params, const fst_branch_options *options)
{
    fst_branch branch;
    fst_error error;
    if (fst_branch_follow(params, options, &branch, &error) != FST_OK)
        fail_msg("%s", error.sentence);
    return branch;
}

/* The special point of this type nearest to a value, at most 1e-3 away. */
static inline const fst_special *special_near(const fst_branch *branch, fst_special_type type, double value)
{
    const fst_special *nearest = NULL;
    for (size_t i = 0; i < branch->special_count; ++i) {
        const fst_special *s = &branch->specials[i];
        if (s->type == type && fabs(s->value - value) < (nearest ? fabs(nearest->value - value) : 1e-3))
            nearest = s;
    }
    if (!nearest)
        fail_msg("no %s near %g", fst_special_name(type), value);
    return nearest;
}

#endif
