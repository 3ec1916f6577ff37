/* paramagnet.c - following beads that the field magnetises: do they circle against the magnet, do the paper's
 * identities hold, and how much remanence do they need? */
#include "paper/paramagnet.h"

#include "base/constants.h"
#include "base/error.h"
#include "base/watch.h"

#include <stdio.h>
#include <stdlib.h>

static const double STANDS = 1e-4; /* a mean |alpha'| below this, in units of omega, is not circling */

typedef struct followed {
    fst_model *model;
    fst_flow *flow;
    fst_groups groups;
    double period;
} followed;

static fst_status begin(followed *bead, const fst_params *params, fst_error *error)
{
    double state[FST_STATE_SIZE];
    *bead = (followed){.model = NULL};
    fst_status status = fst_model_new(params, &bead->model, error);
    if (status == FST_OK)
        status = fst_start_state(params, bead->model, state, error);
    if (status != FST_OK)
        return status;
    bead->groups = fst_model_groups(bead->model);
    bead->period = 2.0 * FST_PI / bead->groups.omega;
    fst_flow_options options = fst_default_flow_options();
    options.rtol = params->run_rtol;
    for (int i = 0; i < FST_STATE_SIZE; ++i)
        options.atol[i] = params->run_rtol;
    return fst_flow_new(bead->model, &options, state, &bead->flow, error);
}

static void end(followed *bead)
{
    fst_flow_free(bead->flow);
    fst_model_free(bead->model);
}

static const unsigned leaving = FST_AT_EDGE | FST_AT_LIFT_OFF;

/* ------------------------------------------------------------------ one bead, followed */

/* Go on to t1, and say how the bead circled between the middle of that time and its end. */
static fst_status fate_until(followed *bead, double t1, fst_fate *fate, double *mean_alpha_dot,
                             fst_error *error)
{
    fst_flow_info info = fst_flow_get(bead->flow);
    double middle = 0.5 * (info.t + t1), at_middle = 0.0;
    fst_stop stop;
    fst_status status = fst_flow_next(bead->flow, middle, leaving, &stop, error);
    if (status == FST_OK && stop == FST_AT_TIME) {
        at_middle = fst_flow_get(bead->flow).alpha;
        status = fst_flow_next(bead->flow, t1, leaving, &stop, error);
    }
    *mean_alpha_dot = NAN;
    *fate = FST_FATE_AWAY;
    if (status != FST_OK || stop != FST_AT_TIME)
        return status;
    *mean_alpha_dot = (fst_flow_get(bead->flow).alpha - at_middle) / (t1 - middle);
    double share = *mean_alpha_dot / bead->groups.omega;
    *fate = share < -STANDS ? FST_FATE_COUNTER : share > STANDS ? FST_FATE_WITH : FST_FATE_STANDING;
    return FST_OK;
}

fst_status fst_fate_of(const fst_params *params, double periods, fst_fate *fate, double *mean_alpha_dot,
                       fst_error *error)
{
    followed bead;
    fst_status status = begin(&bead, params, error);
    if (status == FST_OK)
        status = fate_until(&bead, periods * bead.period, fate, mean_alpha_dot, error);
    end(&bead);
    return status;
}

/* ------------------------------------------------------------------ the search */

/* Halton's sequence: the digits of `index` in a prime base, mirrored at the point. */
static double halton(int index, int base)
{
    double value = 0.0, place = 1.0;
    for (int left = index + 1; left > 0; left /= base) {
        place /= base;
        value += place * (left % base);
    }
    return value;
}

fst_status fst_search_params(int index, fst_dynamics dynamics, fst_params *params, fst_error *error)
{
    char text[32];
    *params = fst_default_params();
    params->model_dynamics = (int)dynamics;
    params->bead_material = FST_MATERIAL_PARAMAGNETIC;
    (void)snprintf(text, sizeof text, "%.6g", 0.02 * pow(100.0, halton(index, 2)));
    fst_status status = fst_params_set(params, "drive.omega", text, error);
    params->bead_a = 1e-5 * pow(3000.0, halton(index, 3));
    params->start_r = 0.2 + 1.4 * halton(index, 5);
    params->start_phi = 360.0 * halton(index, 7);
    params->start_spin = halton(index, 11) < 0.75 ? FST_SPIN_ROLLING : FST_SPIN_REST;
    params->run_rtol = 1e-8;
    return status;
}

fst_status fst_search_one(int index, fst_dynamics dynamics, fst_search_entry *entry, fst_error *error)
{
    enum { FIRST_PERIODS = 150, DOUBLINGS = 10 };
    followed bead;
    fst_params params;
    fst_status status = fst_search_params(index, dynamics, &params, error);
    if (status != FST_OK)
        return status;
    status = begin(&bead, &params, error);
    entry->periods = FIRST_PERIODS;
    if (status == FST_OK)
        status = fate_until(&bead, FIRST_PERIODS * bead.period, &entry->first, &entry->mean_alpha_dot, error);
    entry->last = entry->first;
    for (int i = 0; i < DOUBLINGS && status == FST_OK && entry->last == FST_FATE_COUNTER; ++i) {
        entry->periods *= 2.0;
        status = fate_until(&bead, entry->periods * bead.period, &entry->last, &entry->mean_alpha_dot, error);
    }
    end(&bead);
    return status;
}

/* ------------------------------------------------------------------ the identities */

/* What friction and the field give to each balance, which is averaged, and that of which only the change
 * matters. */
typedef struct moment_in_time {
    double friction[FST_BALANCE_COUNT], field;
    double content[FST_BALANCE_COUNT], alpha;
} moment_in_time;

static void look(const followed *bead, moment_in_time *now)
{
    fst_flow_info info = fst_flow_get(bead->flow);
    const double *s = info.state, eps = bead->groups.eps, a = bead->groups.a;
    double x = s[FST_X], y = s[FST_Y], b[3], g[3][3], b2 = 0.0, along = 0.0;
    fst_field(bead->model, x, y, b, g);
    for (int i = 0; i < 3; ++i) {
        b2 += b[i] * b[i];
        along += 2.0 * b[i] * (g[i][1] * x - g[i][0] * y);
    }
    double slip[2];
    fst_slip(bead->model, s, slip);
    double v2 = s[FST_VX] * s[FST_VX] + s[FST_VY] * s[FST_VY];
    double w2 = s[FST_WX] * s[FST_WX] + s[FST_WY] * s[FST_WY] + s[FST_WZ] * s[FST_WZ];
    now->alpha = info.alpha;
    now->friction[FST_BALANCE_ENERGY] = slip[0] * slip[0] + slip[1] * slip[1];
    now->field = a * along;
    now->friction[FST_BALANCE_MOMENT] = x * slip[1] - y * slip[0];
    now->friction[FST_BALANCE_KINETIC] = s[FST_VX] * slip[0] + s[FST_VY] * slip[1];
    now->content[FST_BALANCE_ENERGY] = 0.5 * v2 + 0.2 * eps * eps * w2 - a * b2;
    now->content[FST_BALANCE_MOMENT] = x * s[FST_VY] - y * s[FST_VX];
    now->content[FST_BALANCE_KINETIC] = 0.5 * v2 - a * b2;
    now->friction[FST_BALANCE_ROLLING] = 0.4 * (s[FST_VX] * slip[1] - s[FST_VY] * slip[0]);
    /* Friction does not change p = v - (2 eps/5) e x W: dp/dt is the magnet's force. */
    double p_x = s[FST_VX] + 0.4 * eps * s[FST_WY], p_y = s[FST_VY] - 0.4 * eps * s[FST_WX];
    now->content[FST_BALANCE_ROLLING] = x * p_y - y * p_x;
}

/* Add `weight` times the quantities that are averaged. */
static void accumulate(moment_in_time *sum, const moment_in_time *now, double weight)
{
    for (int b = 0; b < FST_BALANCE_COUNT; ++b)
        sum->friction[b] += weight * now->friction[b];
    sum->field += weight * now->field;
}

static fst_status look_at(followed *bead, double t, moment_in_time *now, fst_error *error)
{
    fst_stop stop;
    fst_status status = fst_flow_next(bead->flow, t, 0, &stop, error);
    if (status == FST_OK)
        look(bead, now);
    return status;
}

/* Means over `panels` panels of length `panel` from t0, by Gauss's rule with five points; the flow lands on
 * each. */
static fst_status average(followed *bead, double t0, int panels, double panel, moment_in_time *mean,
                          fst_error *error)
{
    static const double nodes[5] = {-0.90617984593866399280, -0.53846931010568309104, 0.0,
                                    0.53846931010568309104, 0.90617984593866399280};
    static const double weights[5] = {0.23692688505618908751, 0.47862867049936646804, 0.56888888888888888889,
                                      0.47862867049936646804, 0.23692688505618908751};
    *mean = (moment_in_time){0};
    moment_in_time now;
    fst_status status = FST_OK;
    for (int i = 0; i < 5 * panels && status == FST_OK; ++i) {
        double t = t0 + panel * (i / 5 + 0.5 * (1.0 + nodes[i % 5]));
        status = look_at(bead, t, &now, error);
        if (status == FST_OK)
            accumulate(mean, &now, 0.5 * weights[i % 5] / panels);
    }
    return status;
}

static fst_status balances_over(const fst_params *params, double discard, double periods, int panels_per_period,
                                fst_balances *balances, fst_error *error)
{
    if (params->friction_law != FST_FRICTION_VISCOUS)
        return fst_fail(error, FST_BAD_INPUT, "friction.law",
                        "the balances of a paramagnetic bead take V for the friction force, which it is on a "
                        "viscous plate alone: expected friction.law = viscous");
    followed bead;
    moment_in_time first = {0}, mean = {0}, last = {0};
    int panels = (int)ceil(periods * panels_per_period);
    fst_status status = begin(&bead, params, error);
    double t0 = discard * bead.period, panel = bead.period / panels_per_period, time = panels * panel;
    if (status == FST_OK)
        status = look_at(&bead, t0, &first, error);
    if (status == FST_OK)
        status = average(&bead, t0, panels, panel, &mean, error);
    if (status == FST_OK)
        status = look_at(&bead, t0 + time, &last, error);
    *balances = (fst_balances){.mean_alpha_dot = (last.alpha - first.alpha) / time, .periods = periods};
    for (int b = 0; b < FST_BALANCE_COUNT; ++b) {
        const double factor = b == FST_BALANCE_ENERGY || b == FST_BALANCE_KINETIC ? bead.groups.omega : 1.0;
        balances->of[b] =
            (fst_balance){mean.friction[b], factor * mean.field, (last.content[b] - first.content[b]) / time};
    }
    end(&bead);
    return status;
}

fst_status fst_paramagnet_balances(const fst_params *params, double discard, double periods,
                                   fst_balances *balances, fst_error *error)
{
    enum {
        PANELS = 240
    }; /* panels per drive period: by the printed equations the moment turns over in bursts */
    return balances_over(params, discard, periods, PANELS, balances, error);
}

fst_status fst_paramagnet_means(const fst_params *params, double discard, double periods,
                                fst_balances *balances, fst_error *error)
{
    enum { PANELS = 24 };
    return balances_over(params, discard, periods, PANELS, balances, error);
}

static double scale_of(const fst_balance *balance)
{
    return fmax(fabs(balance->friction), fabs(balance->field));
}

double fst_balance_residual(const fst_balance *balance)
{
    return fabs(balance->friction + balance->boundary - balance->field) / scale_of(balance);
}

double fst_balance_boundary(const fst_balance *balance)
{
    return fabs(balance->boundary) / scale_of(balance);
}

int fst_balances_settled(const fst_balances *balances)
{
    static const double STATIONARY = 0.05;
    return fst_balance_boundary(&balances->of[FST_BALANCE_MOMENT]) < STATIONARY &&
           fst_balance_boundary(&balances->of[FST_BALANCE_KINETIC]) < STATIONARY;
}

/* ------------------------------------------------------------------ how much remanence */

/* How a run of the same length ends.  An irregular motion goes against the magnet for a while too, and the sign
 * of its mean is chance. */
static fst_status confirm(const fst_params *tried, double periods, int *does, fst_error *error)
{
    fst_params params = *tried;
    fst_run_result result;
    params.run_periods = periods;
    params.run_discard = 0.75 * periods;
    const fst_run_options options = fst_default_run_options();
    const fst_status status = fst_run(&params, &options, &result, error);
    *does = status == FST_OK && result.regime == FST_REGIME_COUNTER_ROTATING;
    return status;
}

/* Whether the bead counter-rotates from any of the starts, and still does after four times as long. */
static fst_status counter_rotates(const fst_params *params, const fst_kappa_scan *scan, double kappa, int *does,
                                  fst_error *error)
{
    fst_params tried = *params;
    fst_status status = FST_OK;
    tried.model_kappa = kappa;
    *does = 0;
    for (int start = 0; start < scan->starts && status == FST_OK && !*does; ++start) {
        followed bead;
        fst_fate fate = FST_FATE_AWAY;
        double speed;
        /* Half a turn further, a start is the image of this one under S2 and gives the same motion. */
        tried.start_phi = params->start_phi + 180.0 * start / scan->starts;
        status = fst_tell(scan->progress, 0.0, NULL, error);
        if (status != FST_OK)
            return status;
        status = begin(&bead, &tried, error);
        if (status == FST_OK)
            status = fate_until(&bead, scan->periods * bead.period, &fate, &speed, error);
        if (status == FST_OK && fate == FST_FATE_COUNTER)
            status = fate_until(&bead, 4.0 * scan->periods * bead.period, &fate, &speed, error);
        *does = status == FST_OK && fate == FST_FATE_COUNTER;
        end(&bead);
        if (*does)
            status = confirm(&tried, 4.0 * scan->periods, does, error);
    }
    return status;
}

fst_status fst_least_kappa(const fst_params *params, const fst_kappa_scan *scan, fst_least_found *least,
                           fst_error *error)
{
    const double step = log(scan->high / scan->low) / (scan->points - 1);
    double below = NAN;
    int does = 0;
    fst_status status = FST_OK;
    *least = (fst_least_found){NAN, NAN};
    for (int i = 0; i < scan->points && status == FST_OK && !does; ++i) {
        const double kappa = i + 1 < scan->points ? scan->low * exp(step * i) : scan->high;
        status = counter_rotates(params, scan, kappa, &does, error);
        *(does ? &least->kappa : &below) = kappa;
    }
    for (int i = 0; i < scan->halvings && status == FST_OK && does && below > 0.0; ++i) {
        const double middle = sqrt(below * least->kappa);
        int here;
        status = counter_rotates(params, scan, middle, &here, error);
        *(here ? &least->kappa : &below) = middle;
    }
    least->below = does ? below : NAN;
    return status;
}
