/* physics.h - what the physics tests share: beads, random states, trajectories. */
#ifndef FST_TESTS_PHYSICS_H
#define FST_TESTS_PHYSICS_H

#include <string.h>

#include <festoon/festoon.h>

#include "numeric.h"

#define TWO_PI 6.283185307179586476925287
#define DEGREES 57.29577951308232087680

/* Fail unless least <= actual <= greatest. */
#define CHECK_WITHIN(actual, least, greatest)                                                                  \
    do {                                                                                                       \
        const double check_actual = (actual), check_least = (least), check_greatest = (greatest);              \
        if (!(check_actual >= check_least && check_actual <= check_greatest))                                  \
            fail_msg("%s = %.17g, expected from %.17g to %.17g", #actual, check_actual, check_least,           \
                     check_greatest);                                                                          \
    } while (0)

/* The paper's bead at a scaled drive. */
static inline fst_params bead_at(double omega, fst_dynamics dynamics)
{
    fst_params p = fst_default_params();
    p.drive_omega = omega;
    p.model_dynamics = (int)dynamics;
    return p;
}

/* Every material, friction law and dynamics in turn, cases 0 to 11, with numbers for which every term counts.
 */
enum { CASES = 12 };
static inline fst_params params_of_case(int which)
{
    fst_params p = bead_at(0.31, which & 1 ? FST_DYNAMICS_FARAGO2020 : FST_DYNAMICS_RIGID);
    p.friction_law = which & 2 ? FST_FRICTION_NONE : FST_FRICTION_VISCOUS;
    p.bead_material = which / 4;
    p.bead_a = 2.3e-3;
    p.bead_b = -1.7e-3;
    return p;
}

/* The paper's bead without friction, far enough inside to stay on the plate. */
static inline fst_params frictionless_bead(fst_dynamics dynamics)
{
    fst_params p = bead_at(0.3, dynamics);
    p.friction_law = FST_FRICTION_NONE;
    p.start_r = 0.8;
    return p;
}

static inline fst_model *model_of(const fst_params *p)
{
    fst_model *model;
    fst_error error = {FST_OK, "", ""};
    if (fst_model_new(p, &model, &error) != FST_OK)
        fail_msg("fst_model_new: %s", error.sentence);
    return model;
}

static inline void start_of(const fst_params *p, const fst_model *model, double *state)
{
    fst_error error = {FST_OK, "", ""};
    if (fst_start_state(p, model, state, &error) != FST_OK)
        fail_msg("fst_start_state: %s", error.sentence);
}

/* A trajectory with the same relative and absolute tolerance of every component. */
static inline fst_flow *flow_of(const fst_model *model, double tolerance, const double *state)
{
    fst_flow_options options = fst_default_flow_options();
    options.rtol = tolerance;
    for (int i = 0; i < FST_STATE_SIZE; ++i)
        options.atol[i] = tolerance;
    fst_flow *flow;
    fst_error error = {FST_OK, "", ""};
    if (fst_flow_new(model, &options, state, &flow, &error) != FST_OK)
        fail_msg("fst_flow_new: %s", error.sentence);
    return flow;
}

/* Goes on to t_end or to the first event; returns why it stopped. */
static inline fst_stop advance_to(fst_flow *flow, double t_end, unsigned events)
{
    fst_stop stop;
    fst_error error = {FST_OK, "", ""};
    if (fst_flow_next(flow, t_end, events, &stop, &error) != FST_OK)
        fail_msg("fst_flow_next: %s", error.sentence);
    return stop;
}

/* The state after the time t, by a trajectory of its own. */
static inline void state_after(const fst_model *model, double tolerance, const double *start, double t,
                               double *state)
{
    fst_flow *flow = flow_of(model, tolerance, start);
    assert_int_equal(advance_to(flow, t, 0), FST_AT_TIME);
    const fst_flow_info info = fst_flow_get(flow);
    memcpy(state, info.state, sizeof info.state);
    fst_flow_free(flow);
}

static inline fst_run_result run_of(const fst_params *p)
{
    const fst_run_options options = fst_default_run_options();
    fst_run_result result;
    fst_error error = {FST_OK, "", ""};
    if (fst_run(p, &options, &result, &error) != FST_OK)
        fail_msg("fst_run: %s: %s", error.where, error.sentence);
    return result;
}

/* Pseudorandom numbers, the same on every machine: splitmix64. */
static inline double uniform(uint64_t *seed, double least, double greatest)
{
    uint64_t z = (*seed += 0x9e3779b97f4a7c15u);
    z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9u;
    z = (z ^ (z >> 27)) * 0x94d049bb133111ebu;
    z ^= z >> 31;
    return least + (greatest - least) * ((double)(z >> 11) / 9007199254740992.0);
}

static inline void random_unit(uint64_t *seed, double n[3])
{
    double norm2;
    do {
        for (int i = 0; i < 3; ++i)
            n[i] = uniform(seed, -1.0, 1.0);
        norm2 = n[0] * n[0] + n[1] * n[1] + n[2] * n[2];
    } while (norm2 < 0.01 || norm2 > 1.0);
    for (int i = 0; i < 3; ++i)
        n[i] /= sqrt(norm2);
}

/* A state of ordinary size: r up to about 2, |n| = 1. */
static inline void random_state(uint64_t *seed, double *state)
{
    for (int i = 0; i < FST_STATE_SIZE; ++i)
        state[i] = uniform(seed, -1.0, 1.0) * (i >= FST_WX ? 3.0 : i <= FST_Y ? 1.5 : 1.0);
    random_unit(seed, state + FST_NX);
}

static inline double greatest_difference(const double *a, const double *b, int count)
{
    double greatest = 0.0;
    for (int i = 0; i < count; ++i) {
        const double d = fabs(a[i] - b[i]);
        if (!(d <= greatest))
            greatest = d;
    }
    return greatest;
}

static inline void cross(const double a[3], const double b[3], double axb[3])
{
    axb[0] = a[1] * b[2] - a[2] * b[1];
    axb[1] = a[2] * b[0] - a[0] * b[2];
    axb[2] = a[0] * b[1] - a[1] * b[0];
}

static inline double dot(const double a[3], const double b[3])
{
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

/* Turns a vector by `angle` about the unit vector `axis` (Rodrigues). */
static inline void turn_about(const double axis[3], double angle, const double u[3], double turned[3])
{
    double axu[3];
    cross(axis, u, axu);
    const double along = dot(axis, u) * (1.0 - cos(angle));
    for (int i = 0; i < 3; ++i)
        turned[i] = cos(angle) * u[i] + sin(angle) * axu[i] + along * axis[i];
}

/* The components of a state along axes turned by -angle: with angle = omega t, from the magnet's axes to the
 * laboratory's. */
static inline void turn_state(const double *state, double angle, double *turned)
{
    static const int horizontal[] = {FST_X, FST_VX, FST_NX, FST_WX};
    const double c = cos(angle), s = sin(angle);
    memmove(turned, state, FST_STATE_SIZE * sizeof *state);
    for (int i = 0; i < 4; ++i) {
        const double x = state[horizontal[i]], y = state[horizontal[i] + 1];
        turned[horizontal[i]] = c * x - s * y;
        turned[horizontal[i] + 1] = s * x + c * y;
    }
}

#endif
