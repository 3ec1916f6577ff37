/* criticality.c - the motion beside an equilibrium, and the return beside an orbit, for their normal forms. */
#include <string.h>

#include "base/dot.h"
#include "base/error.h"
#include "ode/flow.h"
#include "orbit/normal_form.h"

/* Coordinates beside a state: along the tangent basis for an equilibrium; for an orbit along the eight vectors
 * of it that span the section across the flow. */
typedef struct beside {
    const fst_family *family;
    const fst_solution *s;
    fst_setup setup;
    double basis[FST_STATE_SIZE][FST_TANGENT_SIZE]; /* orthonormal; of an orbit, the first is along the flow */
    double flow[FST_STATE_SIZE];                    /* the unit vector along it */
} beside;

/* The state at these coordinates: n leaves its tangent plane to stay on the sphere, at right angles to it. */
static void state_at(const beside *b, const double *x, double y[FST_STATE_SIZE])
{
    const int first = b->s->segments > 0;
    const double *n = b->s->y[0] + FST_NX;
    double across2 = 0.0, along;
    memcpy(y, b->s->y[0], FST_STATE_SIZE * sizeof *y);
    for (int k = 0; k < FST_STATE_SIZE; ++k) {
        double moved = 0.0;
        for (int j = first; j < FST_TANGENT_SIZE; ++j)
            moved += b->basis[k][j] * x[j - first];
        y[k] += moved;
        if (k >= FST_NX && k < FST_NX + 3)
            across2 += moved * moved;
    }
    along = sqrt(1.0 - across2) - 1.0;
    for (int i = 0; i < 3; ++i)
        y[FST_NX + i] += along * n[i];
}

static fst_status field_at(void *user, const double *x, double *out, fst_error *error)
{
    beside *b = user;
    double y[FST_STATE_SIZE], rate[FST_STATE_SIZE];
    (void)error;
    state_at(b, x, y);
    fst_rhs(&b->setup.model, y, rate);
    fst_tangent_part(b->basis, rate, out);
    return FST_OK;
}

/* The return to the section through the first state: the flow for the period, then on (or back) to the section
 * by Newton's method on the time. */
static fst_status return_at(void *user, const double *x, double *out, fst_error *error)
{
    enum { MOST_LANDINGS = 12 };
    beside *b = user;
    const fst_solution *s = b->s;
    double y[FST_STATE_SIZE], rate[FST_STATE_SIZE], end[FST_STATE_SIZE], moved[FST_STATE_SIZE];
    double part[FST_TANGENT_SIZE];
    double time = s->period, off = 1.0;
    fst_status status = FST_OK;
    state_at(b, x, y);
    for (int i = 0; i < MOST_LANDINGS && fabs(off) > 1e-14; ++i) {
        fst_model *model;
        fst_flow *flow;
        status = fst_solution_flow(b->family, s->value, y, 1e-14, &model, &flow, error);
        if (status == FST_OK)
            status = fst_solution_advance(b->family, flow, time, error);
        if (status == FST_OK)
            memcpy(end, flow->step.end, sizeof end);
        fst_flow_free(flow);
        fst_model_free(model);
        if (status != FST_OK)
            return status;
        fst_rhs(&b->setup.model, end, rate);
        if (s->symmetric) {
            fst_apply_s2(end, end);
            fst_apply_s2(rate, rate);
        }
        for (int k = 0; k < FST_STATE_SIZE; ++k)
            moved[k] = end[k] - s->y[0][k];
        off = fst_dot(b->flow, moved, FST_STATE_SIZE);
        time -= off / fst_dot(b->flow, rate, FST_STATE_SIZE);
    }
    fst_tangent_part(b->basis, moved, part);
    memcpy(out, part + 1, sizeof part - sizeof *part);
    return FST_OK;
}

fst_status fst_pair_coefficient(const fst_family *family, const fst_solution *s, double frequency,
                                double *coefficient, double *spread, fst_error *error)
{
    beside b = {.family = family, .s = s};
    double matrix[FST_TANGENT_SIZE * FST_TANGENT_SIZE];
    fst_local_map map = {.user = &b, .reach = 2e-3};
    fst_status status = fst_family_setup(family, s->value, &b.setup, error);
    if (status == FST_OK)
        status = fst_solution_section(family, s, matrix, b.basis, error);
    if (status != FST_OK)
        return status;
    if (s->segments > 0) {
        for (int k = 0; k < FST_STATE_SIZE; ++k)
            b.flow[k] = b.basis[k][0];
        map.size = FST_TANGENT_SIZE - 1;
        map.is_map = 1;
        map.at = return_at;
    } else {
        map.size = FST_TANGENT_SIZE;
        map.at = field_at;
    }
    return fst_cubic_coefficient(family->lapack, &map, matrix, frequency, coefficient, spread, error);
}

int fst_pair_criticality(const fst_family *family, const fst_solution *s, double frequency)
{
    double coefficient, spread;
    fst_error ignored;
    if (fst_family_rests(family) && s->segments > 0)
        return 0; /* a return that rests somewhere need not have the second and third derivatives */
    if (fst_pair_coefficient(family, s, frequency, &coefficient, &spread, &ignored) != FST_OK ||
        !(fabs(coefficient) > 4.0 * spread))
        return 0;
    return coefficient < 0 ? 1 : -1;
}
