/* events.c - where in the last step something happens: zeros and extremes of functions of the state.
 *
 * An event is a sign change of a function along the trajectory: X on the section, plate radius minus r at the
 * edge, the normal load where the bead lifts off.  Its place is the fraction x of the step, 0 to 1, found on
 * the dense output to rounding.  A function that has one sign at both ends of the step may still dip below zero
 * in between:
 *
 *       f                      The values at the places of the path (path.h), which cost nothing, tell most
 *       |o               o     steps that hold no dip: those whose least value lies above zero by half of the
 *       |  o           o       spread or more.  In the others the function is sampled at 16 places, and the
 *     --|------o---o------x    neighbourhood of each low one is searched.
 *       |        v
 *
 * Where the values at the places rise all the time, or fall all the time, and the slope at the lower end hides
 * no dip beside it, the ends tell it all.  Contacts, which have an event in every sixth step or so, look at
 * that first.
 */
#include "ode/flow.h"

#include <string.h>

#include "base/bracket.h"

double fst_section_function(const fst_flow *flow, const double *state, const fst_pull_double *p)
{
    (void)flow;
    (void)p;
    return state[FST_X];
}

double fst_radial_function(const fst_flow *flow, const double *state, const fst_pull_double *p)
{
    (void)flow;
    (void)p;
    return state[FST_X] * state[FST_VX] + state[FST_Y] * state[FST_VY];
}

double fst_edge_function(const fst_flow *flow, const double *state, const fst_pull_double *p)
{
    (void)p;
    const double edge = flow->groups.plate_radius;
    return edge - sqrt(state[FST_X] * state[FST_X] + state[FST_Y] * state[FST_Y]);
}

double fst_map_function(const fst_flow *flow, const double *state, const fst_pull_double *p)
{
    (void)p;
    return flow->groups.map_radius - hypot(state[FST_X], state[FST_Y]);
}

double fst_load_function(const fst_flow *flow, const double *state, const fst_pull_double *p)
{
    (void)state;
    if (fst_flow_world(flow)->kinds.flies)
        return 1.0; /* a bead that flies is not an event for who follows it */
    return fst_load_double(fst_flow_world(flow), p->force);
}

double fst_flow_function_at(fst_flow *flow, double x, fst_state_function function)
{
    if (x == 1.0)
        return function(flow, flow->step.end, FST_PATH_PULL(&flow->step, FST_PATH_END));
    if (function == fst_section_function || function == fst_radial_function) {
        double place[4]; /* n need not be normalised for these */
        fst_flow_components_at(flow, x, FST_X, function == fst_section_function ? 1 : 4, place);
        return function(flow, place, NULL);
    }
    fst_motion_double motion;
    fst_pull_double p;
    fst_flow_motion_at(flow, x, &motion);
    if (flow->step.context.outside) {
        double unused[3];
        fst_outside_pull(&flow->step.context, motion.numbers, &p, unused);
    } else {
        fst_magnetic_pull_double(fst_flow_world(flow), &motion.modes, motion.numbers, &p);
    }
    return function(flow, motion.numbers, &p);
}

void fst_flow_path_range(const fst_flow *flow, fst_state_function function, double *least, double *greatest)
{
    *least = INFINITY;
    *greatest = -INFINITY;
    for (int n = 0; n < FST_PATH_PLACES; ++n) {
        const double value = function(flow, FST_PATH_STATE(&flow->step, n), FST_PATH_PULL(&flow->step, n));
        *least = value < *least ? value : *least;
        *greatest = value > *greatest ? value : *greatest;
    }
}

double fst_flow_locate(fst_flow *flow, fst_state_function function, double lo, double hi, double f_lo,
                       double f_hi)
{
    /* Illinois' rule, with a bisection now and then, should it be slow. */
    fst_bracket z = {lo, hi, f_lo, f_hi, 0};
    for (int i = 0; i < 200 && z.hi - z.lo > 1e-16; ++i) {
        const double x = i % 8 == 7 ? 0.5 * (z.lo + z.hi) : fst_bracket_next(&z);
        if (x == z.lo || x == z.hi)
            break;
        const double f = fst_flow_function_at(flow, x, function);
        if (f == 0)
            return x;
        fst_bracket_take(&z, x, f);
    }
    return fabs(z.f_lo) < fabs(z.f_hi) ? z.lo : z.hi;
}

/* A bracketed minimum search: best point x, second best w, third v, in [lo, hi]. */
typedef struct minimum {
    double lo, hi, x, w, v, fx, fw, fv;
} minimum;

/* The next point to try: the vertex of the parabola through x, w, v where it falls inside and moves less than
 * half the step before last, else a golden section (R. P. Brent, 1973). */
static double next_trial(const minimum *m, double *last, double *before_last)
{
    const double golden = 0.381966011250105151795;
    double p = 0, q = 0;
    if (m->w != m->x && m->v != m->x && m->v != m->w) {
        const double r = (m->x - m->w) * (m->fx - m->fv);
        q = (m->x - m->v) * (m->fx - m->fw);
        p = (m->x - m->v) * q - (m->x - m->w) * r;
        q = 2.0 * (q - r);
        if (q > 0)
            p = -p;
        q = fabs(q);
    }
    const double allowed = *before_last;
    *before_last = *last;
    if (q > 0 && fabs(p) < fabs(0.5 * q * allowed) && p > q * (m->lo - m->x) && p < q * (m->hi - m->x)) {
        *last = p / q;
    } else {
        *before_last = m->x < 0.5 * (m->lo + m->hi) ? m->hi - m->x : m->lo - m->x;
        *last = golden * *before_last;
    }
    return m->x + *last;
}

static void take_trial(minimum *m, double u, double fu)
{
    if (fu <= m->fx) {
        if (u < m->x)
            m->hi = m->x;
        else
            m->lo = m->x;
        m->v = m->w, m->fv = m->fw;
        m->w = m->x, m->fw = m->fx;
        m->x = u, m->fx = fu;
        return;
    }
    if (u < m->x)
        m->lo = u;
    else
        m->hi = u;
    if (fu <= m->fw || m->w == m->x) {
        m->v = m->w, m->fv = m->fw;
        m->w = u, m->fw = fu;
    } else if (fu <= m->fv || m->v == m->x || m->v == m->w) {
        m->v = u, m->fv = fu;
    }
}

double fst_flow_extreme(fst_flow *flow, fst_step_function function, const void *what, double sign, double lo,
                        double hi, double *value)
{
    const double start = lo + 0.381966011250105151795 * (hi - lo);
    const double f_start = -sign * function(flow, start, what);
    minimum m = {lo, hi, start, start, start, f_start, f_start, f_start};
    double last = 0, before_last = 0;
    for (int i = 0; i < 60 && m.hi - m.lo > 1e-7; ++i) {
        double u = next_trial(&m, &last, &before_last);
        /* Points closer than this to the best one cannot be told apart by their values. */
        if (fabs(u - m.x) < 2e-8)
            u = m.x + (u < m.x ? -2e-8 : 2e-8);
        if (u <= m.lo || u >= m.hi)
            break;
        take_trial(&m, u, -sign * function(flow, u, what));
    }
    *value = -sign * m.fx;
    return m.x;
}

static double state_function_at(fst_flow *flow, double x, const void *function)
{
    return fst_flow_function_at(flow, x, *(const fst_state_function *)function);
}

/* The values of a function at the places of the path but the last guess of the end, with their nodes. */
enum { VALUES = FST_PATH_PLACES - 1 };
typedef struct profile {
    double node[VALUES], f[VALUES];
} profile;

static void take_profile(const fst_flow *flow, fst_state_function function, profile *p)
{
    for (int i = 0; i < VALUES; ++i) {
        const int n = i < VALUES - 1 ? i : FST_PATH_END;
        p->node[i] = FST_PATH_NODE[n];
        p->f[i] = function(flow, FST_PATH_STATE(&flow->step, n), FST_PATH_PULL(&flow->step, n));
    }
}

/* The polynomial through the values, and its slope, at x (Neville's scheme). */
static double interpolate(const profile *p, double x, double *slope)
{
    double f[VALUES], df[VALUES] = {0.0};
    memcpy(f, p->f, sizeof f);
    for (int order = 1; order < VALUES; ++order)
        for (int i = 0; i + order < VALUES; ++i) {
            const double left = x - p->node[i], right = x - p->node[i + order];
            const double inverse = 1.0 / (p->node[i + order] - p->node[i]);
            df[i] = (left * df[i + 1] + f[i + 1] - right * df[i] - f[i]) * inverse;
            f[i] = (left * f[i + 1] - right * f[i]) * inverse;
        }
    *slope = df[0];
    return f[0];
}

/* Whether the values never rise, or never fall, and do not hide a dip below zero: it would lie between the two
 * at the lower end, and the slope there would tell it. */
static int tells_all(const profile *p)
{
    enum { LAST = VALUES - 1 };
    int rises = 0, falls = 0;
    double slope;
    for (int i = 1; i < VALUES; ++i) {
        rises |= p->f[i] > p->f[i - 1];
        falls |= p->f[i] < p->f[i - 1];
    }
    if ((rises && falls) || !(p->f[0] > 0))
        return 0;
    if (falls && p->f[LAST] < 0)
        return 1;
    (void)interpolate(p, falls ? p->node[LAST] : p->node[0], &slope);
    return falls ? p->f[LAST] > fmax(slope, 0.0) * (p->node[LAST] - p->node[LAST - 1])
                 : p->f[0] > fmax(-slope, 0.0) * (p->node[1] - p->node[0]);
}

/* The zero of a function that falls through it all along the step: where the polynomial through the values has
 * it, then by secants on the dense output.  They need no bracket but to know that they went astray. */
static double locate_fall(fst_flow *flow, fst_state_function function, const profile *p)
{
    enum { ROUNDS = 8, LAST = VALUES - 1 };
    const double near = 1e-9; /* so small a correction is right to 1e-13 */
    int after = 1;
    while (after < LAST && p->f[after] >= 0)
        ++after;
    double lo = p->node[after - 1], hi = p->node[after], slope;
    double x = lo + (hi - lo) * p->f[after - 1] / (p->f[after - 1] - p->f[after]);
    for (int i = 0; i < ROUNDS; ++i) {
        const double value = interpolate(p, x, &slope), change = slope < 0 ? -value / slope : 0.0;
        x = fmin(fmax(x + change, lo), hi);
        if (fabs(change) < near)
            break;
    }
    double f = fst_flow_function_at(flow, x, function);
    for (int i = 0; i < ROUNDS && slope < 0; ++i) {
        const double change = -f / slope, next = x + change;
        if (!(next >= 0 && next <= 1))
            break;
        if (fabs(change) < near)
            return next;
        const double f_next = fst_flow_function_at(flow, next, function);
        slope = (f_next - f) / change;
        x = next;
        f = f_next;
    }
    return fst_flow_locate(flow, function, 0.0, 1.0, p->f[0], p->f[LAST]);
}

int fst_flow_becomes_negative(fst_flow *flow, fst_state_function function, double *x)
{
    profile p;
    take_profile(flow, function, &p);
    if (!tells_all(&p))
        return fst_flow_first_negative(flow, function, 0.0, x);
    const int falls = p.f[VALUES - 1] < 0;
    if (falls)
        *x = locate_fall(flow, function, &p);
    return falls;
}

int fst_flow_first_negative(fst_flow *flow, fst_state_function function, double lo, double *x)
{
    double least, greatest;
    fst_flow_path_range(flow, function, &least, &greatest);
    if (least - 0.5 * (greatest - least) > 0)
        return 0;
    enum { PIECES = 16 };
    double at[PIECES + 1], f[PIECES + 1];
    for (int i = 0; i <= PIECES; ++i) {
        at[i] = i == PIECES ? 1.0 : lo + (1.0 - lo) * i / PIECES;
        f[i] = fst_flow_function_at(flow, at[i], function);
        flow->contact.dip = fmin(flow->contact.dip, f[i]);
    }
    if (f[0] < 0) {
        *x = lo;
        return 1;
    }
    for (int i = 0; i <= PIECES; ++i) {
        const int before = i > 0 ? i - 1 : 0, after = i < PIECES ? i + 1 : PIECES;
        if (f[i] < 0) {
            *x = fst_flow_locate(flow, function, at[before], at[i], f[before], f[i]);
            return 1;
        }
        if (f[i] <= f[before] && f[i] <= f[after]) { /* a dip: it may go below zero beside this place */
            double bottom;
            const double place =
                fst_flow_extreme(flow, state_function_at, &function, -1.0, at[before], at[after], &bottom);
            flow->contact.dip = fmin(flow->contact.dip, bottom);
            if (bottom < 0) {
                *x = fst_flow_locate(flow, function, at[before], place, f[before], bottom);
                return 1;
            }
        }
    }
    return 0;
}
