/* two_neighbours.c - how the neighbours of a motion change, two at a time in registers of two doubles. */
#include "ode/two_neighbours.h"

#include <stddef.h>
#include <string.h>

#define FST_DRY_LANES
#include "base/real_two.h"

#include "base/twofold.inl"
#include "model/bodies.inl"
#include "model/tangent.inl"

#include "ode/carried.inl"

/* A state that was linearised, as two neighbours see it. */
typedef struct view {
    FN(world) world; /* but for its source */
    FN(modes) modes;
    FN(linear) linear;
    REAL omega, pace, y[FST_STATE_SIZE], f[FST_STATE_SIZE];
} view;

/* What is copied whole has numbers alone: a register in the one struct for each in the other. */
_Static_assert(sizeof(FN(modes)) == 2 * sizeof(fst_modes_double), "modes are numbers");
_Static_assert(sizeof(FN(coulomb)) == 2 * sizeof(fst_coulomb_double), "a law is numbers");
_Static_assert(offsetof(FN(linear), contact) == 2 * offsetof(fst_linear_double, contact),
               "so is what is linear");
_Static_assert(offsetof(FN(world), source) - offsetof(FN(world), eps) ==
                   2 * (offsetof(fst_world_double, source) - offsetof(fst_world_double, eps)),
               "and the world, but for its source");

/* Each of some numbers twice. */
static void twice(const void *from, size_t bytes, void *to)
{
    const double *number = from;
    REAL *two = to;
    for (size_t i = 0; i < bytes / sizeof *number; ++i)
        two[i] = REAL_OF(number[i]);
}

static void see_contact(view *v, const fst_contact_double *at)
{
    FN(contact) *two = &v->linear.contact;
    twice(at->slip, sizeof at->slip, two->slip);
    twice(at->push, sizeof at->push, two->push);
    twice(at->modes, sizeof *at->modes, &v->modes);
    two->load = REAL_OF(at->load);
    two->time = REAL_OF(at->time);
    two->share = REAL_OF(at->share);
    two->modes = &v->modes;
    two->patch = FST_PATCH_POINT;
}

static void change_two(const view *v, const double *seen[2], double *k[2])
{
    REAL tangent[FST_STATE_SIZE], change[FST_STEP_TIME + 1];
    for (int i = 0; i < FST_STATE_SIZE; ++i)
        tangent[i] = (REAL){seen[0][i], seen[1][i]};
    FN(neighbour_slope)(&v->world, &v->modes, v->omega, v->y, &v->linear, v->f, v->pace, tangent, change);
    for (int lane = 0; lane < 2; ++lane) {
        for (int i = 0; i <= FST_STEP_TIME; ++i)
            k[lane][i] = change[i][lane];
        k[lane][FST_HEIGHT] = k[lane][FST_CLIMB] = 0.0;
    }
}

void fst_slopes_of_two(const fst_world_double *c, double omega, const double *y,
                       const fst_linear_double *linear, const double *f, int count, double seen[][FST_NUMBERS],
                       double k[][FST_NUMBERS])
{
    view v;
    v.world.kinds = c->kinds;
    twice(&c->eps, offsetof(fst_world_double, source) - offsetof(fst_world_double, eps), &v.world.eps);
    twice(&c->law.coulomb, sizeof c->law.coulomb, &v.world.law.coulomb);
    twice(linear, offsetof(fst_linear_double, contact), &v.linear);
    see_contact(&v, &linear->contact);
    twice(y, sizeof v.y / 2, v.y);
    twice(f, sizeof v.f / 2, v.f);
    v.omega = REAL_OF(omega);
    v.pace = FN(pace)(&v.world, &v.modes, v.y);
    for (int first = 0; first < count; first += 2) {
        const int second = first + 1 < count ? first + 1 : first; /* the last may be its own fellow */
        change_two(&v, (const double *[]){seen[first], seen[second]}, (double *[]){k[first], k[second]});
    }
}
