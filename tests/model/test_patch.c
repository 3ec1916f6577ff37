/* A contact that is a disc: the closed form of its friction against the integral over the disc, what a bead on
 * it does against what is known exactly, and how it tends to a point.  Its derivatives: test_patch_ld.c.
 * tests: model/contact/patch.inl model/disc.c */
#include "physics.h"

#include "base/constants.h"
#include "ode/flow.h"

/* ------------------------------------------------------------------ the closed form */

/* Force and torque of a disc of radius 1 that slips at nu and pivots at 1, under mu N = 1, by summing up the
 * friction of its pieces, 3/(2 pi) sqrt(1 - r^2) each.  In polar coordinates about the point that is at rest,
 * at the distance nu from the middle of the disc, a piece at (rho, phi) moves across the radius; the disc
 * reaches there from rho_1 to rho_2, between which 1 - r^2 = (rho_2 - rho) (rho - rho_1). */
static void add_pieces(int pieces, double nu, double phi, double weight, double *force, double *torque)
{
    const double middle = nu * cos(phi), half = sqrt(fmax(0, 1 - nu * nu * sin(phi) * sin(phi)));
    const double first = fmax(middle - half, 0.0), last = middle + half;
    for (int i = 0; i < pieces; ++i) {
        /* From inside, rho = last (1 - u^2); from outside, rho = middle + half sin(psi): smooth. */
        double rho, size;
        if (nu < 1) {
            const double u = (i + 0.5) / pieces;
            rho = last * (1 - u * u);
            size = 2 * last * u / pieces;
        } else {
            const double psi = FST_PI * ((i + 0.5) / pieces - 0.5);
            rho = middle + half * sin(psi);
            size = half * cos(psi) * FST_PI / pieces;
        }
        const double part = weight * size * rho * 1.5 / FST_PI *
                            sqrt(fmax(0, (last - rho) * (rho - (nu < 1 ? middle - half : first))));
        *force += part * cos(phi);
        *torque += part * (rho - nu * cos(phi));
    }
}

static void sum_over_disc(int pieces, double nu, double *force, double *torque)
{
    enum { RAYS = 400 };
    *force = *torque = 0;
    for (int i = 0; i < RAYS; ++i)
        if (nu < 1) {
            add_pieces(pieces, nu, FST_TWO_PI * (i + 0.5) / RAYS, FST_TWO_PI / RAYS, force, torque);
        } else { /* from outside only |sin(phi)| < 1/nu meets the disc: nu sin(phi) = sin(chi) */
            const double chi = FST_PI * ((i + 0.5) / RAYS - 0.5), phi = asin(sin(chi) / nu);
            add_pieces(pieces, nu, phi, cos(chi) / (nu * cos(phi)) * FST_PI / RAYS, force, torque);
        }
}

static void test_the_disc_summed_up(void **unused)
{
    (void)unused;
    static const double places[] = {0.1, 0.35, 0.6, 0.85, 1.2, 1.7, 2.3, 2.6, 4.0, 12.0};
    for (size_t i = 0; i < sizeof places / sizeof *places; ++i) {
        double force[2], torque[2];
        sum_over_disc(400, places[i], &force[0], &torque[0]);
        sum_over_disc(800, places[i], &force[1], &torque[1]);
        /* The sums err by the square of their step at most, which is taken out. */
        const fst_shares_double shares = fst_hertz_shares_double(places[i] * 0.3, 0.3);
        CHECK_CLOSE(shares.grip * places[i] * 0.3, force[1] + (force[1] - force[0]) / 3, 1e-9);
        CHECK_CLOSE(shares.twist, torque[1] + (torque[1] - torque[0]) / 3, 1e-9);
    }
}

static void test_branches_meet(void **unused)
{
    (void)unused;
    const fst_shares_double near = fst_hertz_near_double(1.0, 1.0), at = fst_hertz_middle_double(1.0, 1.0);
    CHECK_CLOSE(near.grip, at.grip, 4e-16);
    CHECK_CLOSE(near.twist, at.twist, 4e-16);
    CHECK_CLOSE(near.across, at.across, 2e-15);
    CHECK_CLOSE(near.bend, at.bend, 2e-15);
}

/* Known limits: pivoting alone, sliding alone. */
static void test_limits(void **unused)
{
    (void)unused;
    CHECK_CLOSE(fst_hertz_shares_double(0.0, 2.0).twist, 3 * FST_PI / 16, 1e-15);
    CHECK_CLOSE(fst_hertz_shares_double(1e-9, 2.0).grip, 3 * FST_PI / 16, 1e-15);
    CHECK_CLOSE(fst_hertz_shares_double(1e3, 1e-9).grip * 1e3, 1.0, 1e-15);
    CHECK_CLOSE(fst_hertz_shares_double(1e3, 1.0).twist, 0.2e-3, 1e-9);
}

static void test_angle_and_cube_root(void **unused)
{
    (void)unused;
    for (int i = 1; i <= 2000; ++i) {
        const double sine = i / 2000.0, cosine = sqrt(1 - sine * sine);
        const long double exact = atan2l((long double)sine, (long double)cosine);
        CHECK_CLOSE((double)(fst_angle_of_double(sine, cosine) - exact), 0, 9e-16 * (double)exact);
        const double x = exp(-60 + 0.05 * i);
        const long double root = cbrtl((long double)x);
        CHECK_CLOSE((double)(fst_cube_root_double(x) - root), 0, 3e-16 * (double)root);
    }
}

/* ------------------------------------------------------------------ motion */

static fst_flow *flow_of_bead(const fst_params *p, double rtol, const double *state)
{
    fst_model *model = model_of(p);
    fst_flow *flow = flow_of(model, rtol, state);
    fst_model_free(model);
    return flow;
}

static void go_to(fst_flow *flow, double t)
{
    assert_int_equal(advance_to(flow, t, 0), FST_AT_TIME);
}

/* A bead that only pivots, without a magnet, stops after 2 eps^2 |w|/(5 (3 pi/16) mu N a), and then rests. */
static void test_pivoting_alone(void **unused)
{
    (void)unused;
    for (int turn = -1; turn <= 1; turn += 2)
        for (int follows = 0; follows <= 1; ++follows) {
            fst_params p = bead_at(0.3, FST_DYNAMICS_RIGID);
            p.friction_law = FST_FRICTION_COULOMB;
            p.model_kappa = 0;
            p.contact_patch = FST_PATCH_HERTZ;
            if (follows)
                p.contact_modulus = 51e9;
            else
                p.contact_radius = 0.2e-3;
            fst_model *model = model_of(&p);
            const fst_groups g = fst_model_groups(model);
            fst_model_free(model);
            const double newtons = p.bead_mass * p.plate_gravity;
            const double radius =
                follows ? cbrt(0.75 * newtons * p.bead_radius / p.contact_modulus) : p.contact_radius;
            const double speed = 0.01,
                         torque = 3 * FST_PI / 16 * p.friction_mu * g.gravity * radius / g.length_unit;
            const double stop = 0.4 * g.eps * g.eps * speed / torque;
            double state[FST_STATE_SIZE] = {0};
            state[FST_X] = 0.5;
            state[FST_NX] = 1;
            state[FST_WZ] = turn * speed;
            fst_flow *flow = flow_of_bead(&p, 1e-10, state);
            go_to(flow, 0.5 * stop);
            CHECK_CLOSE(flow->step.end[FST_WZ], 0.5 * turn * speed, 1e-10);
            go_to(flow, 0.999 * stop);
            CHECK_CLOSE(flow->step.end[FST_WZ], 0.001 * turn * speed, 1e-9);
            go_to(flow, 1.01 * stop);
            assert_int_equal(fst_contact_mode(flow), FST_MODE_STICK);
            CHECK_SAME_BITS(flow->step.end[FST_WZ], 0.0);
            const uint64_t steps = flow->accepted;
            go_to(flow, stop + 1000);
            CHECK_WITHIN((double)(flow->accepted - steps), 1, 2000);
            fst_flow_free(flow);
        }
}

/* A bead that slips and pivots without a magnet: the contact's power is what its energy loses, to the end. */
static void test_slides_and_pivots_to_rest(void **unused)
{
    (void)unused;
    fst_params p = bead_at(0.3, FST_DYNAMICS_RIGID);
    p.friction_law = FST_FRICTION_COULOMB;
    p.model_kappa = 0;
    p.contact_patch = FST_PATCH_HERTZ;
    p.contact_radius = 1e-3;
    double state[FST_NUMBERS] = {0};
    state[FST_X] = 0.2;
    state[FST_NX] = 1;
    state[FST_VX] = 0.01;
    state[FST_WZ] = 0.5;
    fst_flow *flow = flow_of_bead(&p, 1e-10, state);
    const fst_world_double *c = fst_flow_world(flow);
    fst_pull_double pull;
    fst_pull_at_double(c, state, c->height, &pull);
    const double before = fst_energy_double(c, fst_flow_modes(flow), state, &pull);
    double lost = 0;
    fst_error error;
    while (fst_contact_mode(flow) == FST_MODE_SLIP) {
        assert_int_equal(fst_flow_step(flow, 1e5, &error), FST_OK);
        double power[FST_PATH_PLACES];
        for (int place = 0; place < FST_PATH_PLACES; ++place) {
            const fst_bead_step_double *s = &flow->step;
            fst_seen_double seen;
            fst_see_double(c, fst_flow_modes(flow), 0.3, FST_PATH_STATE(s, place), FST_PATH_PULL(s, place),
                           &seen);
            power[place] = (seen.friction_power + seen.pivoting_power) *
                           (fst_contact_mode(flow) == FST_MODE_SLIP ? FST_PATH_PACE(s, place) : 1);
        }
        lost += fst_path_integral_double(&flow->step, power, 1);
    }
    const double after = fst_energy_double(c, fst_flow_modes(flow), flow->step.end, &pull);
    CHECK_WITHIN(before - after, 1e-4, 1);
    CHECK_CLOSE(lost / (before - after), 1.0, 1e-7);
    assert_int_equal(flow->contact.captures + (flow->contact.slip.next == FST_MODE_STICK), 1);
    fst_flow_free(flow);
}

/* What a disc does differently from a point, by radii that are halved, at the end of a part of a turn. */
static void check_tends_to_a_point(fst_start_spin spin, double mu, double turns, double order)
{
    fst_params p = bead_at(0.215, FST_DYNAMICS_RIGID);
    p.friction_law = FST_FRICTION_COULOMB;
    p.friction_mu = mu;
    p.start_spin = (int)spin;
    fst_model *model = model_of(&p);
    double start[FST_STATE_SIZE], off[3];
    start_of(&p, model, start);
    fst_model_free(model);
    start[FST_VY] += spin == FST_SPIN_REST ? 0.1 : 0.0;
    start[FST_WZ] = 0.3;
    const double until = turns * TWO_PI / 0.215;
    fst_flow *point = flow_of_bead(&p, 1e-12, start);
    go_to(point, until);
    p.contact_patch = FST_PATCH_HERTZ;
    for (int i = 0; i < 3; ++i) {
        p.contact_radius = 4e-6 / (1 << i);
        fst_flow *disc = flow_of_bead(&p, 1e-12, start);
        go_to(disc, until);
        off[i] = greatest_difference(disc->step.end, point->step.end, FST_STATE_SIZE);
        fst_flow_free(disc);
    }
    fst_flow_free(point);
    CHECK_WITHIN(off[2], 1e-9, 1e-2);
    CHECK_WITHIN(log2(off[0] / off[1]), order - 0.03, order + 0.03);
    CHECK_WITHIN(log2(off[1] / off[2]), order - 0.03, order + 0.03);
}

/* A bead that slips all the time feels the square of the radius; one that creeps where a point would stick, the
 * radius.  One that was released since feels its power 4/5: as |A| passes (7/2) mu N at a time t = 0, the slip
 * of a point is s ~ t^2, and the disc's friction is less by about N (a w/s)^2, which matters down to s ~
 * a^(4/5), t ~ a^(2/5), where the creep goes over into slip; the integral of it is a^(4/5). */
static void test_tends_to_a_point(void **unused)
{
    (void)unused;
    check_tends_to_a_point(FST_SPIN_REST, 0.2, 1.0, 2.0);
    check_tends_to_a_point(FST_SPIN_ROLLING, 1.5, 0.3, 1.0);
    check_tends_to_a_point(FST_SPIN_ROLLING, 0.2, 0.04, 0.8);
}

/* The state after some motion converges with the tolerance. */
static void test_converges(void **unused)
{
    (void)unused;
    fst_params p = bead_at(0.215, FST_DYNAMICS_RIGID);
    p.friction_law = FST_FRICTION_COULOMB;
    p.start_spin = FST_SPIN_REST;
    p.contact_patch = FST_PATCH_HERTZ;
    p.contact_modulus = 51e9;
    fst_model *model = model_of(&p);
    double start[FST_STATE_SIZE];
    start_of(&p, model, start);
    fst_model_free(model);
    start[FST_VY] += 0.1;
    start[FST_WZ] = 0.3;
    fst_flow *exact = flow_of_bead(&p, 1e-13, start);
    go_to(exact, 50);
    for (int i = 0; i < 3; ++i) {
        const double rtol = i == 0 ? 1e-8 : i == 1 ? 1e-10 : 1e-12;
        fst_flow *flow = flow_of_bead(&p, rtol, start);
        go_to(flow, 50);
        for (int k = 0; k < FST_STATE_SIZE; ++k)
            CHECK_CLOSE(flow->step.end[k], exact->step.end[k], 100 * rtol);
        fst_flow_free(flow);
    }
    fst_flow_free(exact);
}

/* ------------------------------------------------------------------ input */

static void check_refused(const char *key, const char *text, const char *sentence)
{
    fst_params p = fst_default_params();
    fst_error error = {FST_OK, "", ""};
    p.friction_law = FST_FRICTION_COULOMB;
    p.contact_patch = FST_PATCH_HERTZ;
    fst_model *model = NULL;
    fst_status status = key ? fst_params_set(&p, key, text, &error) : FST_OK;
    if (status == FST_OK)
        status = fst_model_new(&p, &model, &error);
    assert_int_equal(status, FST_BAD_INPUT);
    CHECK_CONTAINS(error.sentence, sentence);
}

static void test_bad_input(void **unused)
{
    (void)unused;
    check_refused(NULL, NULL, "contact.patch needs the size of the disc");
    check_refused("contact.radius", "-1 um", "out of range");
    check_refused("contact.modulus", "-51 GPa", "out of range");
    check_refused("contact.modulus", "51 GP", "unknown unit");
    check_refused("contact.patch", "hertzian", "nearest is hertz");
    fst_params p = fst_default_params();
    fst_error error = {FST_OK, "", ""};
    fst_model *model;
    fst_params large = p;
    large.friction_law = FST_FRICTION_COULOMB;
    large.contact_patch = FST_PATCH_HERTZ;
    large.contact_radius = large.bead_radius;
    char sentence[512];
    assert_true(fst_bead_contradiction(&large, sentence, sizeof sentence) > 0);
    CHECK_CONTAINS(sentence, "contact.radius is 2.5 mm and bead.radius 2.5 mm");
    large.contact_radius = 0.99 * large.bead_radius;
    assert_int_equal(fst_bead_contradiction(&large, sentence, sizeof sentence), 0);
    p.contact_radius = 1e-5;
    p.contact_modulus = 5e10;
    assert_int_equal(fst_model_new(&p, &model, &error), FST_BAD_INPUT);
    CHECK_CONTAINS(error.sentence, "both given");
    /* Setting one takes back the other. */
    assert_int_equal(fst_params_set(&p, "contact.radius", "16 um", &error), FST_OK);
    assert_true(isnan(p.contact_modulus));
    assert_int_equal(fst_params_set(&p, "contact.modulus", "51 GPa", &error), FST_OK);
    CHECK_CLOSE(p.contact_modulus, 51e9, 0);
    assert_true(isnan(p.contact_radius));
    /* A size that plays no part is a mistake, but for other laws, which know nothing of it. */
    assert_int_equal(fst_params_check_effects(&p, &error), FST_OK);
    p.friction_law = FST_FRICTION_COULOMB;
    assert_int_equal(fst_params_check_effects(&p, &error), FST_BAD_INPUT);
    CHECK_CONTAINS(error.sentence, "has no effect with contact.patch point: choose hertz");
    p.contact_patch = FST_PATCH_HERTZ;
    assert_int_equal(fst_params_check_effects(&p, &error), FST_OK);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_the_disc_summed_up),
        cmocka_unit_test(test_branches_meet),
        cmocka_unit_test(test_limits),
        cmocka_unit_test(test_angle_and_cube_root),
        cmocka_unit_test(test_pivoting_alone),
        cmocka_unit_test(test_slides_and_pivots_to_rest),
        cmocka_unit_test(test_tends_to_a_point),
        cmocka_unit_test(test_converges),
        cmocka_unit_test(test_bad_input),
    };
    return cmocka_run_group_tests_name("patch", tests, NULL, NULL);
}
