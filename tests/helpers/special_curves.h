/* special_curves.h - curves of special points over omega and kappa, compared with the same points found over
 * omega alone. */
#ifndef FST_TESTS_SPECIAL_CURVES_H
#define FST_TESTS_SPECIAL_CURVES_H

#include "branches.h"

static inline fst_params scene_at(double omega, double kappa)
{
    fst_params params = scene_of(omega, "rigid");
    fst_error error;
    char text[32];
    (void)snprintf(text, sizeof text, "%.17g", kappa);
    assert_int_equal(fst_params_set(&params, "model.kappa", text, &error), FST_OK);
    return params;
}

/* The curves of one type that pass kappa = 1.5 between two values of omega. */
static inline fst_branch curve(fst_branch_kind kind, fst_special_type type, double from, double to,
                               double kappa_from, double kappa_to)
{
    const fst_params params = scene_at(fmin(fmax(0.3, from), to), 1.5);
    fst_branch_options o = over_omega(kind, from, to);
    o.second_key = "model.kappa";
    o.second_from = kappa_from;
    o.second_to = kappa_to;
    o.special = type;
    return followed(&params, &o);
}

/* The special point near `omega` that a branch over omega finds, at another kappa. */
static inline double at_kappa(fst_branch_kind kind, fst_special_type type, double kappa, double omega,
                              double from, double to)
{
    const fst_params params = scene_at(fmin(fmax(0.3, from), to), kappa);
    const fst_branch_options o = over_omega(kind, from, to);
    fst_branch branch = followed(&params, &o);
    const double found = special_near(&branch, type, omega)->value;
    fst_branch_free(&branch);
    return found;
}

static inline const fst_branch_point *point_at(const fst_branch *b, double kappa)
{
    for (size_t i = 0; i < b->point_count; ++i)
        if (fabs(b->points[i].second - kappa) < 1e-7)
            return &b->points[i];
    fail_msg("no point at kappa = %g", kappa);
    return NULL;
}

/* At both ends of the range of kappa, the curve has the omega that a branch over omega alone finds there. */
#define CHECK_ENDS(b, kind, type, from, to, kappa_from, kappa_to, tolerance)                                   \
    do {                                                                                                       \
        for (int end_ = 0; end_ < 2; ++end_) {                                                                 \
            const fst_branch_point *p_ = point_at(b, end_ ? (kappa_to) : (kappa_from));                        \
            CHECK_CLOSE(p_->value, at_kappa(kind, type, p_->second, p_->value, from, to), tolerance);          \
        }                                                                                                      \
    } while (0)

/* The least distance of a multiplier from a real number. */
static inline double nearest_multiplier(const fst_branch_point *p, double value)
{
    double nearest = INFINITY;
    for (int m = 0; m < p->multipliers; ++m)
        nearest = fmin(nearest, hypot(p->multiplier_re[m] - value, p->multiplier_im[m]));
    return nearest;
}

/* The least distance of a complex pair from the border of stability: the imaginary axis for an equilibrium, the
 * unit circle for an orbit. */
static inline double least_real_part_of_pairs(const fst_branch_point *p)
{
    double least = INFINITY;
    for (int m = 0; m < p->multipliers; ++m)
        if (fabs(p->multiplier_im[m]) > 1e-3)
            least = fmin(least, p->multipliers == FST_EIGENVALUE_COUNT
                                    ? fabs(p->multiplier_re[m])
                                    : fabs(hypot(p->multiplier_re[m], p->multiplier_im[m]) - 1.0));
    return least;
}

#endif
