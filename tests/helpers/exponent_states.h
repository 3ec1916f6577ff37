/* exponent_states.h - Lyapunov exponents of many regular motions beside their exact values: the logarithms of
 * an orbit's multipliers over its period, and the real parts of a locked state's eigenvalues.
 *
 * The scenes are points of Halton's sequence: drives 0.05 to 1 and kappa 0.75 to 3 (both in logarithms), both
 * dynamics, everything else as by default.
 */
#ifndef FST_TESTS_EXPONENT_STATES_H
#define FST_TESTS_EXPONENT_STATES_H

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "numeric.h"
#include "study/exponent.h"

/* The exact values for a motion: its exponents from the greatest down, including the zero along the flow of an
 * orbit, as many as are not lost in the rounding of the multipliers; the greatest across the flow; and a state
 * on the motion. */
typedef struct known_exponents {
    int count, is_orbit;
    double exponents[FST_EIGENVALUE_COUNT], across_flow, state[FST_STATE_SIZE];
} known_exponents;

static inline double halton_point(int index, int base)
{
    double value = 0.0, place = 1.0;
    for (int left = index + 1; left > 0; left /= base) {
        place /= base;
        value += place * (left % base);
    }
    return value;
}

static inline fst_params exponent_scene(int index)
{
    fst_params params = fst_default_params();
    params.drive_omega = 0.05 * pow(20.0, halton_point(index, 2));
    params.drive_frequency = NAN;
    params.model_kappa = 0.75 * pow(4.0, halton_point(index, 3));
    params.model_dynamics = index % 2 ? FST_DYNAMICS_FARAGO2020 : FST_DYNAMICS_RIGID;
    return params;
}

static inline int falling(const void *a, const void *b)
{
    const double x = *(const double *)a, y = *(const double *)b;
    return (x < y) - (x > y);
}

static inline int known_of_orbit(const fst_params *params, known_exponents *known)
{
    fst_orbit orbit;
    if (fst_orbit_find(params, NULL, &orbit, NULL) != FST_OK || !orbit.stable)
        return 0;
    /* With the symmetry S2 the multipliers are those of half the period. Multipliers below 1e-9 are rounding
     * errors. */
    const double time = orbit.means.symmetry == FST_SYMMETRY_S2 ? 0.5 * orbit.means.period : orbit.means.period;
    known->is_orbit = 1;
    known->across_flow = -INFINITY;
    memcpy(known->state, orbit.state, sizeof known->state);
    for (int i = 0; i < FST_MULTIPLIER_COUNT; ++i) {
        const double size = hypot(orbit.multiplier_re[i], orbit.multiplier_im[i]);
        if (size < 1e-9)
            continue;
        known->exponents[known->count] = log(size) / time;
        known->across_flow = fmax(known->across_flow, known->exponents[known->count++]);
    }
    known->exponents[known->count++] = 0.0;
    return 1;
}

static inline double distance_of(const double *a, const double *b)
{
    double greatest = 0.0;
    for (int i = 0; i < FST_STATE_SIZE; ++i)
        greatest = fmax(greatest, fabs(a[i] - b[i]));
    return greatest;
}

/* The locked state in which a run ended. */
static inline int known_of_locked(const fst_params *params, const double *state, known_exponents *known)
{
    fst_locked_list list;
    if (fst_locked_find(params, NULL, &list, NULL) != FST_OK)
        return 0;
    for (size_t i = 0; i < list.count; ++i) {
        if (distance_of(list.states[i].state, state) > 1e-5 || !list.states[i].stable)
            continue;
        known->count = FST_EIGENVALUE_COUNT;
        memcpy(known->exponents, list.states[i].eigenvalue_re, sizeof known->exponents);
        memcpy(known->state, state, sizeof known->state);
    }
    fst_locked_free(&list);
    return known->count > 0;
}

/* 0 if no exact exponents are known for the motion of this scene, or if it has not settled. */
static inline int exponents_known(const fst_params *params, known_exponents *known)
{
    fst_run_options options = fst_default_run_options();
    fst_run_result result;
    memset(known, 0, sizeof *known);
    if (fst_run(params, &options, &result, NULL) != FST_OK)
        return 0;
    int found = 0;
    if (result.regime == FST_REGIME_LOCKED)
        found = known_of_locked(params, result.final_state, known);
    else if (result.regime == FST_REGIME_COUNTER_ROTATING || result.regime == FST_REGIME_COROTATING ||
             result.regime == FST_REGIME_LIBRATING)
        found = known_of_orbit(params, known);
    qsort(known->exponents, (size_t)known->count, sizeof known->exponents[0], falling);
    return found;
}

/* The exponent that a run of this scene computes if its regime needs one: over the default window. */
static inline fst_exponent exponent_across_flow(const fst_params *params, const double *state)
{
    fst_model *model = NULL;
    assert_int_equal(fst_model_new(params, &model, NULL), FST_OK);
    const fst_groups groups = fst_model_groups(model);
    fst_exponent asked, *list[1] = {&asked};
    memset(&asked, 0, sizeof asked);
    asked.world = &model->world;
    memcpy(asked.state, state, sizeof asked.state);
    asked.duration =
        (params->run_periods - fst_run_discard(params)) * 6.283185307179586476925287 / groups.omega;
    asked.rtol = params->run_rtol;
    assert_int_equal(fst_largest_exponents(&fst_tangents_scalar, list, 1, NULL, NULL), FST_OK);
    assert_false(asked.failed);
    fst_model_free(model);
    return asked;
}

/* How often error bars cover the exact value. */
typedef struct coverage {
    int all, within_one, within_three;
    double greatest; /* the greatest deviation, in units of the error */
} coverage;

static inline void cover(coverage *c, double value, double error, double truth)
{
    const double deviation = fabs(value - truth) / error;
    ++c->all;
    c->within_one += deviation <= 1.0;
    c->within_three += deviation <= 3.0;
    c->greatest = fmax(c->greatest, deviation);
}

#endif
