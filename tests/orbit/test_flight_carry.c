/* Tangents carried through flights: lift-off, impacts with restitution and friction, and the last touch, against
 * central differences of the flow; for many restitutions and coefficients of friction.
 * tests: ode/neighbours.c orbit/dry_carry.c model/tangent.inl model/source/local_field.inl */
#include "branches.h"

#include <string.h>

#include "ode/flight.h"
#include "ode/neighbours.h"
#include "orbit/family.h"

#define TOLERANCE 1e-13

typedef struct flight_case {
    double restitution, mu, mu_static, frequency;
    const char *key;   /* the parameter of the last column */
    const char *other; /* a key of the scene, and its value */
    const char *value;
    double climb;  /* the bead is thrown up from its start at this speed; 0: the magnet lifts it */
    double after;  /* how long the motion goes on after its first touch */
    double within; /* error of the columns over their size */
} flight_case;

static fst_flow *flow_in(const fst_params *params, const double *start, double climb)
{
    fst_model *model;
    fst_flow *flow = NULL;
    fst_error error;
    fst_flow_options o = fst_default_flow_options();
    o.rtol = TOLERANCE;
    for (int i = 0; i < FST_STATE_SIZE; ++i)
        o.atol[i] = TOLERANCE;
    if (fst_model_new(params, &model, &error) != FST_OK ||
        fst_flow_new(model, &o, start, &flow, &error) != FST_OK)
        fail_msg("%s", error.sentence);
    fst_model_free(model);
    if (climb > 0.0) {
        flow->step.context.modes.contact = FST_MODE_FLIGHT;
        fst_flight_begin(flow->step.end, climb);
        fst_bead_flow_restart(flow);
    }
    return flow;
}

static void step(fst_flow *flow, double until)
{
    fst_error error;
    if (fst_flow_step(flow, until, &error) != FST_OK)
        fail_msg("%s", error.sentence);
}

/* What a motion did. */
typedef struct way {
    int captures, releases, lifts, lands, mode;
} way;

static void note(way *did, const fst_flow *flow, int before)
{
    const int now = fst_contact_mode(flow), next = flow->contact.slip.next;
    did->captures += now == FST_MODE_SLIP && next == FST_MODE_STICK;
    did->releases += now == FST_MODE_STICK && next >= 0;
    did->lifts += now != FST_MODE_FLIGHT && next == FST_MODE_FLIGHT;
    did->lands += before == FST_MODE_FLIGHT && now != FST_MODE_FLIGHT;
    did->mode = now;
}

static void end_of(const fst_params *params, const double *start, double climb, double duration, double *end,
                   way *did)
{
    fst_flow *flow = flow_in(params, start, climb);
    memset(did, 0, sizeof *did);
    while (flow->t.high < duration) {
        const int before = fst_contact_mode(flow);
        step(flow, duration);
        note(did, flow, before);
    }
    memcpy(end, flow->step.end, FST_NUMBERS * sizeof *end);
    fst_flow_free(flow);
}

/* The numbers at the end (not the clock): their derivative along a direction of the start, or by the parameter
 * (NULL), by central differences of fourth order. */
static void by_differences(const fst_family *family, double value, const double *start, double climb,
                           const double *along, double h, double duration, const way *did, double *derivative)
{
    static const double weight[4] = {1.0 / 12.0, -8.0 / 12.0, 8.0 / 12.0, -1.0 / 12.0}, at[4] = {-2, -1, 1, 2};
    memset(derivative, 0, FST_NUMBERS * sizeof *derivative);
    for (int k = 0; k < 4; ++k) {
        double y[FST_STATE_SIZE], end[FST_NUMBERS];
        way other;
        const fst_params params = fst_family_params(family, along ? value : value + at[k] * h);
        for (int i = 0; i < FST_STATE_SIZE; ++i)
            y[i] = start[i] + (along ? at[k] * h * along[i] : 0.0);
        end_of(&params, y, climb, duration, end, &other);
        if (memcmp(&other, did, sizeof other) != 0)
            fail_msg("a neighbour changes its mode otherwise");
        for (int i = 0; i < FST_NUMBERS; ++i)
            derivative[i] += i == FST_STEP_TIME ? 0.0 : weight[k] * end[i] / h;
    }
}

/* A bead on its way up: a state shortly before it leaves the plate, and the time from there to `after` its first
 * touch. */
static double before_lift_off(const fst_params *params, double climb, double after, double *begin)
{
    fst_model *model;
    fst_error error;
    double start[FST_STATE_SIZE], t[2] = {0.0, 0.0};
    if (fst_model_new(params, &model, &error) != FST_OK ||
        fst_start_state(params, model, start, &error) != FST_OK)
        fail_msg("%s", error.sentence);
    fst_model_free(model);
    fst_flow *flow = flow_in(params, start, climb);
    while (flow->contact.impacts == 0 && flow->t.high < 400.0) {
        if (!fst_flight_is_on(flow) && flow->t.high > t[1] + 0.1) {
            t[0] = t[1];
            t[1] = flow->t.high;
        }
        step(flow, 400.0);
    }
    assert_true(flow->contact.impacts > 0);
    const double touch = flow->t.high;
    fst_flow_free(flow);
    if (climb > 0.0) {
        memcpy(begin, start, sizeof start);
        return touch + after;
    }
    flow = flow_in(params, start, climb);
    while (flow->t.high < t[0])
        step(flow, t[0]);
    memcpy(begin, flow->step.end, FST_STATE_SIZE * sizeof *begin);
    fst_flow_free(flow);
    return touch + after - t[0];
}

static double column_error(const flight_case *k, double h)
{
    fst_params params = scene_of(0.2151, "rigid");
    fst_family family;
    fst_setup setup;
    fst_error error;
    way did;
    double begin[FST_STATE_SIZE], basis[FST_STATE_SIZE][FST_TANGENT_SIZE], end[FST_NUMBERS], greatest = 0.0;
    params.friction_law = FST_FRICTION_COULOMB;
    params.friction_mu = k->mu;
    params.friction_mu_static = k->mu_static;
    params.impact_restitution = k->restitution;
    params.drive_omega = NAN;
    params.drive_frequency = k->frequency;
    if (k->other && strcmp(k->value, "hertz") == 0)
        params.contact_radius = 5e-4;
    if (k->other && strcmp(k->value, "mixed") == 0)
        params.bead_a = params.bead_b = 0.01;
    if ((k->other && fst_params_set(&params, k->other, k->value, &error) != FST_OK) ||
        fst_family_begin(&family, &params, k->key, &error) != FST_OK)
        fail_msg("%s", error.sentence);
    const double value = fst_family_value(&family);
    if (fst_family_setup(&family, value, &setup, &error) != FST_OK)
        fail_msg("%s", error.sentence);
    const double duration = before_lift_off(&family.params, k->climb, k->after, begin);
    end_of(&family.params, begin, k->climb, duration, end, &did);
    fst_tangent_basis(begin, basis);
    fst_neighbours b = {.count = FST_COLUMNS,
                        .parameter = FST_COLUMNS - 1,
                        .exact = setup.exact,
                        .spread = setup.spread,
                        .below = setup.below,
                        .above = setup.above};
    for (int c = 0; c < FST_TANGENT_SIZE; ++c)
        for (int i = 0; i < FST_STATE_SIZE; ++i)
            b.d[c][i] = basis[i][c];
    fst_flow *flow = flow_in(&family.params, begin, k->climb);
    fst_neighbours_start(&b, flow);
    while (flow->t.high < duration) {
        step(flow, duration);
        fst_neighbours_follow(&b, flow);
    }
    fst_neighbours_at_equal_times(&b, flow);
    printf("e %.2f mu %.2f by %s: %d impacts, %d lifts, %d lands, %d captures, %d releases, %.3g long, ends in "
           "mode %d at height %.2g\n",
           k->restitution, k->mu, k->key, (int)flow->contact.impacts, did.lifts, did.lands, did.captures,
           did.releases, duration, did.mode, end[FST_HEIGHT]);
    assert_true((did.lifts > 0 || k->climb > 0.0) && flow->contact.impacts > 0);
    fst_flow_free(flow);
    for (int c = 0; c < FST_COLUMNS; ++c) {
        double along[FST_STATE_SIZE], numeric[FST_NUMBERS], size = 1.0, off = 0.0;
        const int state = c < FST_TANGENT_SIZE;
        for (int i = 0; i < FST_STATE_SIZE; ++i)
            along[i] = state ? basis[i][c] : 0.0;
        by_differences(&family, value, begin, k->climb, state ? along : NULL, state ? h : h * fabs(value),
                       duration, &did, numeric);
        for (int i = 0; i < FST_NUMBERS; ++i) {
            if (i == FST_STEP_TIME)
                continue;
            size = fmax(size, fabs(numeric[i]));
            off = fmax(off, fabs(numeric[i] - b.d[c][i]));
        }
        greatest = fmax(greatest, off / size);
    }
    return greatest;
}

static void columns_against_differences(void **unused)
{
    (void)unused;
    static const flight_case cases[] = {
        {0.0, 0.05, NAN, 90, "friction.mu", NULL, NULL, 0, 0.3, 1e-8},
        {0.5, 0.05, NAN, 90, "impact.restitution", NULL, NULL, 0, 0.3, 1e-8},
        {0.8, 0.05, NAN, 90, "drive.omega", NULL, NULL, 0, 0.3, 1e-8},
        {1.0, 0.05, NAN, 90, "model.kappa", NULL, NULL, 0, 0.3, 1e-8},
        {0.5, 0.2, NAN, 80, "model.eps", NULL, NULL, 0, 1.0, 2e-7},
        {0.3, 0.2, NAN, 80, "model.h", NULL, NULL, 0, 1.0, 1e-7},
        {0.7, 0.1, NAN, 80, "friction.mu", NULL, NULL, 0, 3.0, 1e-7},
        {0.0, 0.5, NAN, 80, "friction.mu", NULL, NULL, 0, 1.0, 1e-8},
        {0.5, 0.5, NAN, 80, "model.eps", NULL, NULL, 0, 1.0, 2e-7},
        {0.5, 1.5, NAN, 8, "impact.restitution", NULL, NULL, 0.02, 1.5, 1e-7},
        {0.0, 1.5, NAN, 8, "model.eps", NULL, NULL, 0.02, 1.5, 2e-7},
        {0.3, 0.3, NAN, 8, "friction.mu", NULL, NULL, 0.02, 1.5, 1e-7},
        {0.6, 0.3, NAN, 20, "model.eps", NULL, NULL, 0.05, 1.5, 2e-7},
        {0.4, 0.2, 0.3, 8, "friction.mu_static", NULL, NULL, 0.02, 2.5, 1e-7},
        {0.4, 0.2, 0.3, 8, "friction.mu", "friction.stribeck_speed", "5mm/s", 0.02, 1.0, 1e-7},
        {0.4, 0.2, NAN, 20, "friction.rolling_resistance", "friction.rolling_resistance", "0.01", 0.02, 1.0,
         1e-7},
        {0.4, 0.2, NAN, 20, "friction.mu", "contact.patch", "hertz", 0.02, 1.0, 1e-7},
        {0.4, 0.2, NAN, 20, "friction.mu", "bead.material", "mixed", 0.02, 1.0, 1e-7},
        {0.4, 0.2, NAN, 20, "drive.omega", "model.dynamics", "farago2020", 0.02, 1.0, 1e-7},
    };
    for (size_t i = 0; i < sizeof cases / sizeof *cases; ++i) {
        const double off = column_error(&cases[i], 3e-5);
        if (!(off <= cases[i].within))
            fail_msg("e %g, mu %g: the columns differ by %.3g", cases[i].restitution, cases[i].mu, off);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(columns_against_differences)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
