/* some_beads.h - worlds of equal beads, and their motion, for tests. */
#ifndef FST_TESTS_SOME_BEADS_H
#define FST_TESTS_SOME_BEADS_H

#include <stdlib.h>

#include "beads/flow.h"
#include "physics.h"

#define CHI 1.243e-3 /* at a remanence of 1.2 T */
#define TURN (2.0 * 3.14159265358979323846)

/* The numbers of bead i of a state. */
static inline double *bead_of(double *state, int i)
{
    return state + FST_BEAD_NUMBERS * i;
}

/* Two beads of the radius eps that touch beside the axis and move along y, with poles that lie nearly across. */
static inline void put_pair_across(double *state, double eps)
{
    for (int i = 0; i < 2; ++i) {
        double *bead = bead_of(state, i);
        bead[0] = i ? eps : -eps;
        bead[BEADS_V + 1] = 0.1;
        bead[BEADS_N] = -sqrt(0.99);
        bead[BEADS_N + 1] = 0.1;
    }
}

/* Beads of the paper's size and mass without magnet, plate, gravity and friction. */
static inline beads_world free_beads(int count)
{
    beads_world world = {.count = count};
    const double eps = 2.5 / 23;
    for (int i = 0; i < count; ++i)
        world.body[i] =
            (beads_body){.radius = eps, .mass = 1.0, .inertia = 0.4 * eps * eps, .dipole = sqrt(CHI)};
    world.plate = NAN;
    world.plate_radius = INFINITY;
    world.bounce_least = 1e-4;
    beads_number_contacts(&world, 0.0, 0.0);
    return world;
}

/* The paper's beads on its plate above its magnet. */
static inline beads_world paper_beads(int count, const fst_model *model, double pair_rate)
{
    beads_world world = free_beads(count);
    const fst_groups g = fst_model_groups(model);
    for (int i = 0; i < count; ++i)
        world.body[i].strength = g.kappa * (g.eps * g.eps);
    world.plate = g.h - g.eps;
    world.plate_radius = g.plate_radius;
    world.gravity = g.gravity;
    world.omega = g.omega;
    world.field = beads_model_field;
    world.source = model;
    beads_number_contacts(&world, 1.0, pair_rate);
    return world;
}

/* The start of one bead, as start.r, start.phi and start.spin say, as numbers of one of several. */
static inline void place_bead(fst_params params, const fst_model *model, double phi, double *bead)
{
    double one[FST_STATE_SIZE];
    params.start_phi = phi;
    start_of(&params, model, one);
    memset(bead, 0, FST_BEAD_NUMBERS * sizeof *bead);
    memcpy(bead, one + FST_X, 2 * sizeof *bead);
    memcpy(bead + BEADS_V, one + FST_VX, 2 * sizeof *bead);
    memcpy(bead + BEADS_N, one + FST_NX, 6 * sizeof *bead);
}

static inline fst_params at_30_hz(void)
{
    fst_params params = fst_default_params();
    params.drive_frequency = 30;
    return params;
}

/* A flow that begins there; free it. */
static inline beads_flow *begin_beads(const beads_world *world, const double *state, double rtol)
{
    beads_flow *flow = malloc(sizeof *flow);
    fst_error error = {FST_OK, "", ""};
    assert_non_null(flow);
    if (beads_begin(flow, world, state, rtol, &error) != FST_OK)
        fail_msg("beads_begin: %s", error.sentence);
    return flow;
}

static inline void go_to(beads_flow *flow, double limit)
{
    fst_error error = {FST_OK, "", ""};
    if (beads_go_to(flow, limit, &error) != FST_OK)
        fail_msg("beads_go_to: %s", error.sentence);
}

#endif
