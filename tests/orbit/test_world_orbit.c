/* Motions with the drive's period: of what is at rest in the turning frame, in the laboratory's, the multipliers are
 * exponentials of the eigenvalues, and branches have the same special points; of a bead under a swinging magnet they are
 * those of differences of whole periods.
 *
 * tests: orbit/world_orbit.c orbit/world_branch.c */
#include <stdio.h>

#include <festoon/beads.h>

#include "beads/impact.h"
#include "beads/setup.h"
#include "levitators.h"
#include "some_beads.h"

static void set_number(fst_params *p, const char *key, double value)
{
    char text[40];
    (void)snprintf(text, sizeof text, "%.17g", value);
    set(p, key, text);
}

/* Start at a place at rest in the turning frame, and tell of it in the laboratory's. */
static fst_params at_place(fst_params p, const fst_levitation *place)
{
    static const char *const keys[] = {"start.position", "start.velocity", "start.n", "start.angular_velocity"};
    const double units[] = {p.magnet_half_length, p.magnet_half_length * p.friction_gamma, 1.0,
                            p.friction_gamma};
    for (int i = 0; i < FST_BEAD_NUMBERS; ++i) {
        char key[40];
        (void)snprintf(key, sizeof key, "%s[%d]", keys[i / 3], i % 3);
        set_number(&p, key, place->state[i] * units[i / 3]);
    }
    set(&p, "world.frame", "laboratory");
    set(&p, "run.discard", "1");
    return p;
}

static fst_levitation stable_place(const fst_params *p, double side)
{
    fst_levitation_list list;
    fst_levitation found = {.height_mm = NAN};
    assert_int_equal(fst_levitation_find(p, NULL, &list, NULL), FST_OK);
    for (size_t i = 0; i < list.count && isnan(found.height_mm); ++i)
        if (list.states[i].stable && side * list.states[i].state[2] > 0)
            found = list.states[i];
    fst_levitation_free(&list);
    assert_true(found.stable);
    return found;
}

static fst_world_orbit orbit_of(const fst_params *p)
{
    const fst_beads_options options = fst_default_beads_options();
    fst_world_orbit orbit;
    fst_error error = {FST_OK, "", ""};
    if (fst_world_orbit_find(p, &options, &orbit, &error) != FST_OK)
        fail_msg("%s", error.sentence);
    return orbit;
}

static void test_multipliers_are_exponentials(void **unused)
{
    (void)unused;
    const fst_params p = levitator("5", "-9.81");
    const fst_levitation place = stable_place(&p, 1);
    const fst_params there = at_place(p, &place);
    const fst_world_orbit orbit = orbit_of(&there);
    assert_int_equal(orbit.count, FST_LEVITATION_DIRECTIONS);
    assert_int_equal(orbit.frame, FST_FRAME_LABORATORY);
    assert_true(orbit.stable);
    CHECK_CLOSE(greatest_difference(orbit.state, place.state, FST_BEAD_NUMBERS), 0, 1e-8);
    const double period = orbit.period / p.friction_gamma;
    CHECK_CLOSE(period, 1.0 / 200, 1e-15);
    for (int i = 0; i < orbit.count; ++i) { /* each has its exponential among them */
        double nearest = INFINITY;
        for (int k = 0; k < FST_LEVITATION_DIRECTIONS; ++k) {
            const double size = exp(place.eigenvalue_re[k] * period), angle = place.eigenvalue_im[k] * period;
            nearest = fmin(nearest, hypot(orbit.multipliers[i][0] - size * cos(angle),
                                          orbit.multipliers[i][1] - size * sin(angle)));
        }
        CHECK_CLOSE(nearest, 0, 1e-8);
    }
}

/* A straight rotor and a uniform field along the axis hold a bead above it upright, where the repulsion carries it,
 *
 *     3 K^2/(I w^2 z^7) + 36 K^2/(m w^2 z^9) = m g
 *
 * but it runs away sideways. */
static void test_straight_rotor(void **unused)
{
    (void)unused;
    fst_params p = levitator("5", "9.81");
    set(&p, "magnet.parts[0].rotation[0]", "0");
    set(&p, "field.uniform[2]", "10 mT");
    const double r[2] = {9.5e-3, 6.35e-3}, mu_0 = 2e-7 * TWO_PI, w = TWO_PI * 200;
    const double m = 7500 * 2 * TWO_PI / 3 * r[1] * r[1] * r[1], inertia = 0.4 * m * r[1] * r[1];
    double moment[2], near = 0.02, far = 0.1;
    for (int i = 0; i < 2; ++i)
        moment[i] = 2 * TWO_PI / 3 * r[i] * r[i] * r[i] * 1.2 / mu_0;
    const double k = mu_0 / (2 * TWO_PI) * moment[0] * moment[1];
    for (int i = 0; i < 60; ++i) {
        const double z = 0.5 * (near + far);
        const double lift = 3 * k * k / (w * w * pow(z, 7)) * (1 / inertia + 12 / (m * z * z));
        *(lift > m * 9.81 ? &near : &far) = z;
    }
    fst_levitation guess = {.height_mm = near * 1e3};
    const double circle = -3 * k / (m * w * w * pow(near, 4));
    guess.state[0] = circle / p.magnet_half_length;
    guess.state[2] = near / p.magnet_half_length;
    guess.state[4] = w / p.friction_gamma * guess.state[0];
    guess.state[8] = 1.0; /* so the field is: its pole down, as the moment of the sphere would turn */
    guess.state[6] = -k / (inertia * w * w * near * near * near);
    guess.state[11] = 0.0;
    const fst_params there = at_place(p, &guess);
    const fst_world_orbit orbit = orbit_of(&there);
    const double z = orbit.state[2] * p.magnet_half_length;
    CHECK_CLOSE(z / near, 1, 0.02);
    assert_false(orbit.stable);
    const double growth = log(hypot(orbit.multipliers[0][0], orbit.multipliers[0][1])) * 200;
    CHECK_CLOSE(growth, 23.3430, 1e-3); /* per second: by the program of test_levitation.c's swings */
}

/* The value of the only special point of a branch of a kind. */
static double special_of(const fst_params *p, fst_branch_kind kind, double from, double to,
                         fst_special_type type, double side)
{
    fst_branch branch;
    fst_error error = {FST_OK, "", ""};
    fst_branch_options options = fst_default_branch_options();
    options.kind = kind;
    options.key = "drive.frequency";
    options.from = from;
    options.to = to;
    if (fst_branch_follow(p, &options, &branch, &error) != FST_OK)
        fail_msg("%s", error.sentence);
    double value = NAN;
    for (size_t i = 0; i < branch.special_count; ++i)
        if (branch.specials[i].type == type && side * branch.specials[i].at.levitation.state[2] > 0) {
            assert_true(isnan(value));
            value = branch.specials[i].value;
        }
    for (size_t i = 0; i < branch.point_count; ++i)
        CHECK_WITHIN(branch.points[i].value, from, to);
    fst_branch_free(&branch);
    return value;
}

/* A Hopf point is one of Neimark and Sacker for a motion, and a fold a fold. */
static void test_branches_agree(void **unused)
{
    (void)unused;
    for (int above = 0; above < 2; ++above) {
        fst_params p = levitator("5", above ? "9.81" : "-9.81");
        set(&p, "drive.frequency", above ? "160 Hz" : "164 Hz");
        const fst_levitation place = stable_place(&p, 1);
        const double from = above ? 157 : 161, to = from + 4;
        const double hertz =
            special_of(&p, FST_BRANCH_LEVITATING, from, to, above ? FST_SPECIAL_HOPF : FST_SPECIAL_FOLD, 1);
        p = at_place(p, &place);
        CHECK_CLOSE(special_of(&p, FST_BRANCH_DRIVEN, from, to,
                               above ? FST_SPECIAL_NEIMARK_SACKER : FST_SPECIAL_FOLD, 1),
                    hertz, 1e-5);
    }
}

/* D and D^2 have the traces of the multipliers, D by differences in all twelve numbers. */
static void test_differences(void **unused)
{
    (void)unused;
    fst_params p = fst_default_params();
    set(&p, "drive.waveform", "oscillating");
    set(&p, "drive.amplitude", "30");
    set(&p, "magnet.b0", "7.3 mT");
    set(&p, "run.discard", "60");
    const fst_world_orbit orbit = orbit_of(&p);
    assert_int_equal(orbit.count, 9);
    assert_true(orbit.stable);
    const fst_beads_options options = fst_default_beads_options();
    fst_model *model;
    beads_world world;
    double unused_start[BEADS_NUMBERS], state[FST_BEAD_NUMBERS], d[FST_BEAD_NUMBERS][FST_BEAD_NUMBERS];
    assert_int_equal(beads_set_up(&p, 1, &options, &model, &world, unused_start, NULL), FST_OK);
    memcpy(state, orbit.state, sizeof state);
    state[2] -= world.body[0].radius;
    const double step = 3e-5;
    for (int k = 0; k < FST_BEAD_NUMBERS; ++k) {
        double end[2][FST_BEAD_NUMBERS];
        for (int side = 0; side < 2; ++side) {
            double at[BEADS_NUMBERS];
            memcpy(at, state, sizeof state);
            at[k] += side ? step : -step;
            at[2] = at[5] = 0; /* the contact stays closed, and the moment a unit */
            const double length = sqrt(dot(at + BEADS_N, at + BEADS_N));
            for (int m = 0; m < 3; ++m)
                at[BEADS_N + m] /= length;
            beads_flow *flow = begin_beads(&world, at, 1e-12);
            go_to(flow, orbit.period);
            memcpy(end[side], flow->step.y, sizeof end[side]);
            free(flow);
        }
        for (int i = 0; i < FST_BEAD_NUMBERS; ++i)
            d[i][k] = (end[1][i] - end[0][i]) / (2 * step);
    }
    double traces[2] = {0, 0}, sums[2] = {0, 0};
    for (int i = 0; i < FST_BEAD_NUMBERS; ++i) {
        traces[0] += d[i][i];
        for (int k = 0; k < FST_BEAD_NUMBERS; ++k)
            traces[1] += d[i][k] * d[k][i];
    }
    for (int i = 0; i < orbit.count; ++i) {
        const double re = orbit.multipliers[i][0], im = orbit.multipliers[i][1];
        sums[0] += re;
        sums[1] += re * re - im * im;
    }
    assert_true(fabs(sums[0]) > 0.1);
    for (int i = 0; i < 2; ++i)
        CHECK_CLOSE(traces[i], sums[i], 1e-6);
    fst_model_free(model);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_multipliers_are_exponentials),
        cmocka_unit_test(test_straight_rotor),
        cmocka_unit_test(test_branches_agree),
        cmocka_unit_test(test_differences),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
