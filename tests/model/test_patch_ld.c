/* A contact that is a disc, in long double: its series, its derivatives against differences, and its energy.
 * tests: model/contact/patch.inl
 * labels: long-double */
#include "physics_ld.h"

#include "model/tangent.inl"

typedef fst_modes_long_double modes_ld;
static const modes_ld SLIPS = {.contact = FST_MODE_SLIP, .slow_2 = 1e-12L};
static const modes_ld STICKS = {.contact = FST_MODE_STICK, .slow_2 = 1e-12L};

/* Where the series takes over, it and the closed form are one function. */
static void test_the_series(void **unused)
{
    (void)unused;
    for (int i = 0; i <= 20; ++i) {
        const long double nu = 2.5L + 0.05L * i;
        const fst_shares_long_double series = fst_hertz_far_long_double(nu, 1.0L);
        const fst_shares_long_double closed = fst_hertz_middle_long_double(nu, 1.0L);
        CHECK_CLOSE_LD(series.grip, closed.grip, 1e-15);
        CHECK_CLOSE_LD(series.twist, closed.twist, 1e-15);
        CHECK_CLOSE_LD(series.across, closed.across, 5e-15);
        CHECK_CLOSE_LD(series.bend, closed.bend, 5e-15);
        CHECK_CLOSE_LD(series.twist_p, closed.twist_p, 5e-15);
    }
}

/* ------------------------------------------------------------------ derivatives */

static fst_params disc_of(int which)
{
    fst_params p = bead_at(0.31, which & 1 ? FST_DYNAMICS_FARAGO2020 : FST_DYNAMICS_RIGID);
    p.friction_law = FST_FRICTION_COULOMB;
    p.friction_mu = 0.4;
    p.friction_rolling_resistance = 0.01;
    p.contact_patch = FST_PATCH_HERTZ;
    if (which & 2)
        p.contact_modulus = 2e3; /* so soft that the disc is as large as the bead: every term counts */
    else
        p.contact_radius = 7e-3;
    if (which == 3 || which == 6)
        p.bead_inertia = 2.0 / 3.0;
    if (which & 4) {
        p.friction_mu_static = 0.6;
        p.friction_stribeck_speed = 0.8;
    }
    return p;
}

/* A state in which the bead presses on the plate, is not a bead at the joint nu = 1 of two branches, and whose w
 * is not small. */
static int is_smooth_state(const world_ld *c, const long double *y, fst_contact_long_double *at)
{
    fst_pull_long_double pull;
    fst_magnetic_pull_long_double(c, &SLIPS, y, &pull);
    *at = fst_contact_of_long_double(c, &SLIPS, y, &pull);
    const long double radius = fst_patch_radius_long_double(&c->law.coulomb.patch, at->load);
    const long double nu =
        sqrtl(at->slip[0] * at->slip[0] + at->slip[1] * at->slip[1]) / (radius * fabsl(at->pivot) + 1e-30L);
    return at->load > 0.05L && fabsl(at->pivot) > 0.2L && nu > 0.1L && fabsl(nu - 1) > 0.15L;
}

static void check_tangent(const world_ld *c, const modes_ld *m, const long double *y, const long double *along)
{
    const long double d = 1e-3L;
    long double dy[FST_NUMBERS], change[FST_NUMBERS], expected[FST_NUMBERS] = {0};
    fst_rhs_and_tangent_long_double(c, m, c->omega, y, along, dy, change);
    for (int k = 1; k <= 4; ++k)
        for (int sign = -1; sign <= 1; sign += 2) {
            long double moved[FST_NUMBERS], there[FST_NUMBERS];
            fst_pull_long_double pull;
            for (int i = 0; i < FST_STATE_SIZE; ++i)
                moved[i] = y[i] + sign * k * d * along[i];
            fst_rhs_long_double(c, m, c->omega, moved, there, &pull);
            for (int i = 0; i < FST_STATE_SIZE; ++i)
                expected[i] += sign * DIFFERENCE_WEIGHTS[k - 1] * there[i] / d;
        }
    for (int i = 0; i < FST_STATE_SIZE; ++i)
        CHECK_CLOSE_LD(change[i], expected[i], 1e-12);
}

static void test_tangents(void **unused)
{
    (void)unused;
    uint64_t seed = 7;
    for (int which = 0; which < 8; ++which) {
        const fst_params p = disc_of(which);
        const world_ld c = world_of(&p);
        int inside = 0, outside = 0;
        while (inside < 10 || outside < 10) {
            double state[FST_STATE_SIZE], direction[FST_STATE_SIZE];
            long double y[FST_NUMBERS], along[FST_NUMBERS];
            random_state(&seed, state);
            random_state(&seed, direction);
            for (int i = 0; i < FST_STATE_SIZE; ++i) {
                y[i] = state[i];
                along[i] = 0.1 * direction[i];
            }
            fst_contact_long_double at;
            if (!is_smooth_state(&c, y, &at))
                continue;
            const long double radius = fst_patch_radius_long_double(&c.law.coulomb.patch, at.load);
            if (hypotl(at.slip[0], at.slip[1]) < radius * fabsl(at.pivot))
                ++inside;
            else
                ++outside;
            check_tangent(&c, &SLIPS, y, along);
            check_tangent(&c, &STICKS, y, along);
        }
    }
}

/* Energy: d/dt (kinetic + magnetic) = power of the drive - f.V - rolling - pivoting, none of which gives. */
static void test_energy_at_states(void **unused)
{
    (void)unused;
    uint64_t seed = 91;
    for (int which = 0; which < 8; ++which) {
        const fst_params p = disc_of(which);
        const world_ld c = world_of(&p);
        for (int trial = 0; trial < 40; ++trial) {
            double state[FST_STATE_SIZE];
            long double y[FST_NUMBERS], dy[FST_NUMBERS], change = 0;
            random_state(&seed, state);
            for (int i = 0; i < FST_STATE_SIZE; ++i)
                y[i] = state[i];
            fst_pull_long_double pull;
            fst_seen_long_double seen;
            fst_rhs_long_double(&c, &SLIPS, c.omega, y, dy, &pull);
            fst_see_long_double(&c, &SLIPS, c.omega, y, &pull, &seen);
            for (int k = 1; k <= 4; ++k)
                for (int sign = -1; sign <= 1; sign += 2) {
                    long double moved[FST_NUMBERS];
                    fst_pull_long_double there;
                    for (int i = 0; i < FST_STATE_SIZE; ++i)
                        moved[i] = y[i] + sign * k * 1e-3L * dy[i];
                    fst_magnetic_pull_long_double(&c, &SLIPS, moved, &there);
                    change += sign * DIFFERENCE_WEIGHTS[k - 1] *
                              fst_energy_long_double(&c, &SLIPS, moved, &there) / 1e-3L;
                }
            CHECK_CLOSE_LD(change,
                           seen.drive_power - seen.friction_power - seen.rolling_power - seen.pivoting_power,
                           1e-12);
            CHECK_WITHIN((double)seen.friction_power, 0, INFINITY);
            CHECK_WITHIN((double)seen.pivoting_power, 0, INFINITY);
        }
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_the_series),
        cmocka_unit_test(test_tangents),
        cmocka_unit_test(test_energy_at_states),
    };
    return cmocka_run_group_tests_name("patch_ld", tests, NULL, NULL);
}
