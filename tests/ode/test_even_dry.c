/* Dry friction under a constant force, and in an even field (tests/even): exact thresholds, motions, capture.
 * tests: ode/onset.c ode/slip.c ode/creep.c model/contact/lag.inl
 * labels: even */
#include "physics.h"

#include "model/model.h"
#include "ode/flow.h"

/* A bead on which a constant force acts, F along X and nothing else, in a frame at rest. */
static fst_model *pulled(double force, double mu, double mu_static)
{
    fst_params p = bead_at(0.3, FST_DYNAMICS_RIGID);
    fst_error error;
    if (fst_params_set(&p, "magnet.shape", "even", &error) != FST_OK)
        fail_msg("%s", error.sentence);
    p.plate_gravity *= 100; /* so that slips are over before the bead turns round many times */
    p.bead_material = FST_MATERIAL_PARAMAGNETIC;
    p.bead_a = 0.5;
    p.own_slope = force; /* F = 2 a G B */
    p.friction_law = FST_FRICTION_COULOMB;
    p.friction_mu = mu;
    p.friction_mu_static = mu_static;
    fst_model *model = model_of(&p);
    model->groups.omega = model->world.omega = 0.0;
    return model;
}

static double weight(const fst_model *model)
{
    return fst_model_groups(model).gravity;
}

/* Rolls with (5/7) F up to F = (7/2) mu_s N, else slides with F - mu N, which is more. */
static void test_constant_force(void **unused)
{
    (void)unused;
    static const double part[] = {0.1, 0.9, 1 - 1e-9, 1 + 1e-9, 1.0001, 1.2, 3.0};
    static const double start[FST_STATE_SIZE] = {0.2, -0.1, 0, 0, 0, 0, 1, 0, 0, 0.4};
    for (int k = 0; k < 7; ++k)
        for (int is_static = 0; is_static < 2; ++is_static) {
            fst_model *model = pulled(0.0, 0.2, 0.2);
            const double eps = fst_model_groups(model).eps, g = weight(model), mu_s = is_static ? 0.3 : 0.2;
            const double force = part[k] * 3.5 * mu_s * g, t = 7.5;
            fst_model_free(model);
            model = pulled(force, 0.2, mu_s);
            double end[FST_STATE_SIZE];
            state_after(model, 1e-12, start, t, end);
            const int rolls = part[k] < 1;
            const double rate = rolls ? 5.0 / 7 * force : force - 0.2 * g;
            CHECK_CLOSE(end[FST_VX], rate * t, 2e-12);
            CHECK_CLOSE(end[FST_X], 0.2 + 0.5 * rate * t * t, 1e-11);
            CHECK_CLOSE(end[FST_VY], 0, 1e-14);
            CHECK_CLOSE(end[FST_WY], rolls ? rate * t / eps : 2.5 / eps * 0.2 * g * t, 1e-11);
            CHECK_CLOSE(end[FST_WZ], 0.4, 1e-15);
            fst_model_free(model);
        }
}

/* In some mode; where the push is nearly as strong as friction, a slip ends in a creep. */
static int slips(const fst_flow *flow)
{
    return fst_contact_mode(flow) == FST_MODE_SLIP || fst_contact_mode(flow) == FST_MODE_CREEP;
}

/* A slip of V0 at the angle d from A, under c = (7/2) mu N:
 * - while it lasts c s + A.V falls at the rate c^2 - A^2, and s sin(d) tan(d/2)^(-c/A) is constant;
 * - it ends after t* = (c s0 + A.V0)/(c^2 - A^2), when the plate has pushed by (2/7) (A t* + V0). */
static void check_capture(double part, double angle)
{
    const double s0 = 0.1, mu = 0.25;
    fst_model *model = pulled(0.0, mu, NAN);
    const double eps = fst_model_groups(model).eps, c = 3.5 * mu * weight(model), a = part * c;
    fst_model_free(model);
    model = pulled(a, mu, NAN);
    const double start[FST_STATE_SIZE] = {0, 0, s0 * cos(angle), s0 * sin(angle), 0, 0, 1, 0, 0, 0};
    const double ends = (c * s0 + a * s0 * cos(angle)) / (c * c - a * a);
    const double late = 1e-9 + 3e-12 / (c - a); /* what an error of 1e-12 of the slip makes of it */
    const double invariant = s0 * sin(angle) * pow(tan(0.5 * angle), -c / a);
    fst_flow *flow = flow_of(model, 1e-12, start);
    double at = 0;
    while (slips(flow)) {
        at = flow->t.high;
        CHECK_WITHIN(at, 0, ends + late);
        assert_int_equal(fst_flow_step(flow, INFINITY, NULL), FST_OK);
        const double *y = flow->step.end, v[2] = {y[FST_VX] - eps * y[FST_WY], y[FST_VY] + eps * y[FST_WX]};
        const double s = hypot(v[0], v[1]), t = flow->t.high;
        if (!slips(flow))
            break;
        CHECK_CLOSE(c * s + a * v[0] + (c * c - a * a) * t, c * s0 + a * s0 * cos(angle), 1e-10 * c);
        if (s > 0.01) {
            const double d = atan2(v[1], v[0]);
            CHECK_CLOSE(s * sin(d) * pow(tan(0.5 * d), -c / a) / invariant, 1, 1e-10 * (1 + c / a) / sin(d));
        }
    }
    CHECK_CLOSE(at, ends, late);
    fst_flow_free(flow);
    /* At an instant after it rolls with (5/7) A: the impulse shows in v. */
    double end[FST_STATE_SIZE];
    state_after(model, 1e-12, start, 1.5 * ends, end);
    const double v[2] = {s0 * cos(angle), s0 * sin(angle)};
    CHECK_CLOSE(end[FST_VX], v[0] + a * ends - 2.0 / 7 * (a * ends + v[0]) + 5.0 / 7 * a * 0.5 * ends, 3e-11);
    CHECK_CLOSE(end[FST_VY], v[1] * 5.0 / 7, 3e-11);
    fst_model_free(model);
}

static void test_capture(void **unused)
{
    (void)unused;
    static const double parts[] = {0.05, 0.4, 0.5, 0.9, 0.99}, angles[] = {0.02, 0.7, 1.6, 2.9, 3.1};
    for (int i = 0; i < 5; ++i)
        for (int j = 0; j < 5; ++j)
            check_capture(parts[i], angles[j]);
}

/* A push beyond the cone: a slip against it passes through rest, after s0/(c + A), and goes on along it with
 * s' = A - c; one beside it never comes to rest. */
static void test_no_capture_beyond_the_cone(void **unused)
{
    (void)unused;
    const double mu = 0.25, s0 = 0.1;
    fst_model *model = pulled(0.0, mu, NAN);
    const double c = 3.5 * mu * weight(model), a = 1.3 * c;
    fst_model_free(model);
    model = pulled(a, mu, NAN);
    for (int i = 0; i < 3; ++i) {
        const double beside = i == 0 ? 0 : i == 1 ? 1e-9 : 1e-3, turns = s0 / (c + a), t = 2.5 * turns;
        const double start[FST_STATE_SIZE] = {0, 0, -s0, beside * s0, 0, 0, 1, 0, 0, 0};
        double end[FST_STATE_SIZE];
        state_after(model, 1e-12, start, t, end);
        const fst_observation o = fst_observe(model, end);
        CHECK_CLOSE(o.slip_norm, (a - c) * (t - turns), i == 2 ? 1e-2 * s0 : 1e-8);
    }
    fst_model_free(model);
}

/* ------------------------------------------------------------------ an even vertical field */

static fst_params in_even_field(fst_friction_law law, fst_dynamics dynamics)
{
    fst_params p = bead_at(0.3, dynamics);
    fst_error error;
    if (fst_params_set(&p, "magnet.shape", "even", &error) != FST_OK)
        fail_msg("%s", error.sentence);
    p.friction_law = (int)law;
    p.friction_mu = 10;
    p.own_field = 0.02;
    return p;
}

/* The complete elliptic integral of the first kind, of the modulus k, by the arithmetic-geometric mean. */
static double elliptic_k(double k)
{
    double a = 1, b = sqrt(1 - k * k);
    for (int i = 0; i < 30; ++i) {
        const double mean = 0.5 * (a + b);
        b = sqrt(a * b);
        a = mean;
    }
    return TWO_PI / 4 / a;
}

/* n tilted by `angle` from the field, in a plane at 0.6 rad to X; the bead at rest. */
static void tilted(double angle, double *state)
{
    const double s = sin(angle);
    const double start[FST_STATE_SIZE] = {0.3, -0.2, 0, 0, s * cos(0.6), s * sin(0.6), cos(angle), 0, 0, 0};
    memcpy(state, start, sizeof start);
}

/* a'' = -q sin a with q = (5/7) kappa b while rolling, (5/2) kappa b without friction: after the period
 * 4 K(sin(a0/2))/sqrt(q) the bead is back where it was, and after half of it n is mirrored. */
static void test_tilt(void **unused)
{
    (void)unused;
    static const fst_friction_law laws[] = {FST_FRICTION_ROLLING, FST_FRICTION_COULOMB, FST_FRICTION_NONE};
    static const double angles[] = {0.3, 1.2, 2.6};
    for (int i = 0; i < 3; ++i)
        for (int j = 0; j < 3; ++j)
            for (int dynamics = 0; dynamics < 2; ++dynamics) {
                const fst_params p = in_even_field(laws[i], (fst_dynamics)dynamics);
                fst_model *model = model_of(&p);
                const fst_groups g = fst_model_groups(model);
                const double q = (i < 2 ? 5.0 / 7 : 5.0 / 2) * g.kappa * p.own_field;
                const double period = 4 * elliptic_k(sin(0.5 * angles[j])) / sqrt(q);
                double start[FST_STATE_SIZE], end[FST_STATE_SIZE];
                tilted(angles[j], start);
                state_after(model, 1e-12, start, period, end);
                turn_state(end, g.omega * period, end);
                CHECK_CLOSE(greatest_difference(end, start, FST_STATE_SIZE), 0, 3e-10);
                state_after(model, 1e-12, start, 0.5 * period, end);
                turn_state(end, g.omega * 0.5 * period, end);
                CHECK_CLOSE(end[FST_NX], -start[FST_NX], 1e-10);
                CHECK_CLOSE(end[FST_NY], -start[FST_NY], 1e-10);
                CHECK_CLOSE(hypot(end[FST_X] - 0.3, end[FST_Y] + 0.2), i < 2 ? 2 * g.eps * angles[j] : 0,
                            1e-10);
                fst_model_free(model);
            }
}

/* |f| = (5/7) kappa eps b sin a: the bead rolls for ever if that never passes mu_s N, and is then what it is
 * under the law rolling; otherwise it loses energy. */
static void test_tilt_at_the_cone(void **unused)
{
    (void)unused;
    for (int side = -1; side <= 1; side += 2) {
        fst_params p = in_even_field(FST_FRICTION_COULOMB, FST_DYNAMICS_RIGID);
        const double angle = 0.8;
        fst_model *model = model_of(&p);
        const fst_groups g = fst_model_groups(model);
        fst_model_free(model);
        p.friction_mu = 5.0 / 7 * g.kappa * g.eps * p.own_field * sin(angle) / g.gravity * (1 - side * 1e-5);
        p.friction_mu_static = NAN;
        model = model_of(&p);
        double start[FST_STATE_SIZE];
        tilted(angle, start);
        fst_flow *flow = flow_of(model, 1e-12, start);
        int slipped = 0;
        while (flow->t.high < 200) {
            assert_int_equal(fst_flow_step(flow, 200, NULL), FST_OK);
            slipped += fst_contact_mode(flow) != FST_MODE_STICK;
        }
        assert_int_equal(slipped > 0, side > 0);
        const double lost = fst_observe(model, start).energy - fst_observe(model, flow->step.end).energy;
        if (side < 0)
            CHECK_CLOSE(lost, 0, 1e-14);
        else
            CHECK_WITHIN(lost, 1e-14, 1e-6);
        fst_flow_free(flow);
        fst_model_free(model);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_constant_force),
        cmocka_unit_test(test_capture),
        cmocka_unit_test(test_no_capture_beyond_the_cone),
        cmocka_unit_test(test_tilt),
        cmocka_unit_test(test_tilt_at_the_cone),
    };
    return cmocka_run_group_tests_name("even_dry", tests, NULL, NULL);
}
