/* node.c - points of a curve of solutions. */
#include "orbit/node.h"

#include <string.h>

#include "base/constants.h"
#include "base/error.h"

/* ------------------------------------------------------------------ what a solution looks like */

static void see_equilibrium(const fst_setup *setup, const fst_solution *s, fst_branch_point *p)
{
    const fst_observation o = fst_observe(&setup->model, s->y[0]);
    p->mean_r = p->min_r = o.r;
    p->mean_alpha_dot = p->omega;
    p->mean_nz = s->y[0][FST_NZ];
    p->slip = o.slip_norm;
    p->bead_angle_deg = o.r > 1e-9 ? atan2(o.sin_bead_angle, o.cos_bead_angle) * FST_DEGREES : NAN;
}

fst_status fst_node_make(const fst_family *family, const fst_solution *s, fst_node *node, fst_error *error)
{
    fst_setup setup;
    memset(node, 0, sizeof *node);
    node->s = *s;
    node->closest = NAN;
    fst_status status = fst_solution_spectrum(family, &node->s, error);
    if (status == FST_OK)
        status = fst_family_setup(family, s->value, &setup, error);
    if (status != FST_OK)
        return status;
    fst_branch_point *p = &node->seen;
    p->value = s->value;
    p->omega = setup.model.groups.omega;
    p->mean_r = p->mean_alpha_dot = p->mean_nz = p->festoons = p->period = p->min_r = p->bead_angle_deg =
        p->slip = p->second = NAN;
    p->swing_ratio = p->levitation.height_mm = p->levitation.tilt_deg = p->levitation.circle_mm =
        p->levitation.gap_mm = NAN;
    p->relaxation_time = fst_solution_relaxation(&node->s);
    p->stable = fst_solution_is_stable(&node->s);
    p->multipliers = node->s.multipliers;
    memcpy(p->multiplier_re, node->s.re, (size_t)p->multipliers * sizeof *p->multiplier_re);
    memcpy(p->multiplier_im, node->s.im, (size_t)p->multipliers * sizeof *p->multiplier_im);
    memcpy(p->state, s->y[0], sizeof p->state);
    if (s->segments == 0) {
        see_equilibrium(&setup, s, p);
        node->floats = setup.model.world.kinds.dry && fst_observe(&setup.model, s->y[0]).load <= 0.0;
        return FST_OK;
    }
    fst_description d;
    status = fst_describe_orbit(family, s, 0, &d, error);
    if (status != FST_OK)
        return status;
    node->closest = d.closest;
    node->captures = d.captures + d.flights;
    node->shortest = d.shortest;
    p->mean_r = d.means.mean_r;
    p->min_r = fabs(d.closest);
    p->mean_alpha_dot = d.means.mean_alpha_dot;
    p->mean_nz = d.means.mean_nz;
    p->festoons = d.means.festoons;
    p->period = d.means.period;
    p->swing_ratio = d.swing_ratio;
    p->symmetry = d.means.symmetry;
    p->turns = d.turns;
    if (d.has_section)
        memcpy(p->state, d.section, sizeof p->state);
    return FST_OK;
}

fst_status fst_node_ahead(const fst_family *family, const fst_node *from, double length, fst_node *out,
                          fst_error *error)
{
    fst_solution s = from->s;
    s.on_section = 0;
    fst_solution_move(&s, &from->s.tangent, length);
    const fst_status status = fst_solution_correct(family, &s, &from->s.tangent, error);
    return status == FST_OK ? fst_node_make(family, &s, out, error) : status;
}

/* ------------------------------------------------------------------ between two nodes */

static double hermite(double a, double ta, double b, double tb, double h, double x)
{
    const double d = b - a, rest = 1.0 - x;
    return a + x * d + x * rest * (rest * (h * ta - d) - x * (h * tb - d));
}

void fst_solution_between(const fst_node *a, const fst_node *b, double x, fst_solution *s)
{
    const fst_direction *ta = &a->s.tangent, *tb = &b->s.tangent;
    const double h = b->length;
    fst_direction step;
    memset(&step, 0, sizeof step);
    *s = a->s;
    for (int i = 0; i < fst_states_of(s); ++i)
        for (int k = 0; k < FST_STATE_SIZE; ++k)
            step.y[i][k] = hermite(a->s.y[i][k], ta->y[i][k], b->s.y[i][k], tb->y[i][k], h, x) - a->s.y[i][k];
    step.period = hermite(a->s.period, ta->period, b->s.period, tb->period, h, x) - a->s.period;
    step.value = hermite(a->s.value, ta->value, b->s.value, tb->value, h, x) - a->s.value;
    s->on_section = 0;
    fst_solution_move(s, &step, 1.0);
}

fst_status fst_node_between(const fst_family *family, const fst_node *a, const fst_node *b, double x,
                            fst_node *out, fst_error *error)
{
    fst_solution s;
    fst_direction way;
    fst_direction_between(&a->s, &b->s, &way);
    fst_solution_between(a, b, x, &s);
    const fst_status status = fst_solution_correct(family, &s, &way, error);
    return status == FST_OK ? fst_node_make(family, &s, out, error) : status;
}
