/* Which modes a bead has that is put down in a state (model/modes.c): each of the answers, on both sides of the
 * place where it changes into the next one.
 * tests: model/modes.c model/disc.c model/contact/modes.inl model/contact/coulomb.inl
 *   model/contact/rolling.inl */
#include "physics.h"

#include "model/disc.h"
#include "model/modes.h"

static const double RTOL = 1e-6;

/* A bead that neither moves nor turns, with its moment upright along the field but for a small angle; where
 * `away`, in the other direction, so that the magnet lifts it. */
static void state_at_rest(int away, double *state)
{
    const fst_params p = bead_at(0.3, FST_DYNAMICS_RIGID);
    fst_model *model = model_of(&p);
    double b[3], grad[3][3];
    fst_field(model, 0.71, 0.3, b, grad);
    fst_model_free(model);
    b[2] *= 1.05;
    const double size = sqrt(dot(b, b));
    memset(state, 0, FST_STATE_SIZE * sizeof *state);
    state[FST_X] = 0.71;
    state[FST_Y] = 0.3;
    for (int i = 0; i < 3; ++i)
        state[FST_NX + i] = (away ? -b[i] : b[i]) / size;
}

/* The modes of a state under the parameters. */
static fst_motion_double motion_of(const fst_params *p, const double *state, double rtol)
{
    fst_model *model = model_of(p);
    const fst_motion_double motion = fst_motion_at(&model->world, state, rtol);
    fst_model_free(model);
    assert_memory_equal(motion.numbers, state, FST_STATE_SIZE * sizeof *state);
    return motion;
}

static int contact_of(const fst_params *p, const double *state, double rtol)
{
    return (int)motion_of(p, state, rtol).modes.contact;
}

static int rolling_of(const fst_params *p, const double *state, double rtol)
{
    return (int)motion_of(p, state, rtol).modes.rolling;
}

/* The coefficient of friction that just holds the contact of a bead that may roll. */
static double just_enough(const double *state)
{
    fst_params p = bead_at(0.3, FST_DYNAMICS_RIGID);
    p.friction_law = FST_FRICTION_COULOMB;
    fst_model *model = model_of(&p);
    const fst_world_double *c = &model->world;
    const fst_modes_double m = fst_new_modes_double();
    fst_pull_double pull;
    fst_magnetic_pull_double(c, &m, state, &pull);
    const fst_contact_double at = fst_contact_of_double(c, &m, state, &pull);
    const double mu = hypot(at.push[0], at.push[1]) / (c->yielding * at.load);
    fst_model_free(model);
    CHECK_WITHIN(mu, 1e-3, 0.5);
    return mu;
}

static fst_params rubbing_bead(double mu, double mu_static)
{
    fst_params p = bead_at(0.3, FST_DYNAMICS_RIGID);
    p.friction_law = FST_FRICTION_COULOMB;
    p.friction_mu = mu;
    p.friction_mu_static = mu_static;
    return p;
}

/* Static friction holds a contact or not; one that it cannot hold slips at once if friction then falls. */
static void test_sticks_or_slips(void **unused)
{
    (void)unused;
    double state[FST_STATE_SIZE];
    state_at_rest(0, state);
    const double mu = just_enough(state);
    const struct {
        double sliding, holding;
        int mode;
    } cases[] = {{1 + 1e-9, NAN, FST_MODE_STICK},   {1 - 1e-9, NAN, FST_MODE_ONSET},
                 {0.5, 1 + 1e-9, FST_MODE_STICK},   {0.5, 1 - 1e-9, FST_MODE_SLIP},
                 {0.995, 1 - 1e-9, FST_MODE_ONSET}, {0.985, 1 - 1e-9, FST_MODE_SLIP}};
    for (size_t i = 0; i < sizeof cases / sizeof *cases; ++i) {
        fst_params p = rubbing_bead(cases[i].sliding * mu, cases[i].holding * mu);
        assert_int_equal(contact_of(&p, state, RTOL), cases[i].mode);
        assert_int_equal(rolling_of(&p, state, RTOL), FST_ROLL_ROLLS);
        if (cases[i].mode != FST_MODE_SLIP)
            continue;
        p.friction_stribeck_speed = 0.05; /* friction falls, but not at once */
        assert_int_equal(contact_of(&p, state, RTOL), FST_MODE_ONSET);
    }
}

/* A slip of a thousandth of the tolerance is none, but rounding is one at no tolerance; the law `rolling` knows
 * none, and other laws know no modes. */
static void test_slip_that_is_nothing(void **unused)
{
    (void)unused;
    double state[FST_STATE_SIZE];
    state_at_rest(0, state);
    fst_params p = rubbing_bead(2 * just_enough(state), NAN);
    static const struct {
        double rtol, slip;
    } cases[] = {{1e-6, 1e-9}, {1e-10, 1e-13}, {1e-15, 1e-14}};
    for (size_t i = 0; i < sizeof cases / sizeof *cases; ++i) {
        state[FST_VX] = 0.99 * cases[i].slip;
        assert_int_equal(contact_of(&p, state, cases[i].rtol), FST_MODE_STICK);
        state[FST_VX] = 1.01 * cases[i].slip;
        assert_int_equal(contact_of(&p, state, cases[i].rtol), FST_MODE_SLIP);
    }
    state[FST_VX] = 1e-3;
    p.friction_law = FST_FRICTION_ROLLING;
    p.friction_rolling_resistance = 0.01;
    assert_int_equal(contact_of(&p, state, RTOL), FST_MODE_STICK);
    p = bead_at(0.3, FST_DYNAMICS_RIGID);
    const fst_modes_double viscous = motion_of(&p, state, RTOL).modes, none = fst_new_modes_double();
    assert_memory_equal(&viscous, &none, sizeof none);
}

/* Where the magnet lifts it a bead flies, if it may; then it does not rest, though it does not turn. */
static void test_flies(void **unused)
{
    (void)unused;
    double state[FST_STATE_SIZE];
    for (int lifted = 0; lifted < 2; ++lifted) {
        state_at_rest(lifted, state);
        fst_params p = rubbing_bead(0.5, NAN);
        p.model_kappa = 20;
        p.friction_rolling_resistance = 0.5;
        assert_true(contact_of(&p, state, RTOL) != FST_MODE_FLIGHT);
        p.impact_restitution = 0.5;
        assert_int_equal(contact_of(&p, state, RTOL) == FST_MODE_FLIGHT, lifted);
        assert_int_equal(rolling_of(&p, state, RTOL) == FST_ROLL_ROLLS, lifted);
    }
}

/* The resistance of the plate that just holds a bead whose contact sticks, in friction.rolling_resistance. */
static double just_resists(const double *state, double mu)
{
    fst_params p = rubbing_bead(mu, NAN);
    p.friction_rolling_resistance = 1;
    fst_model *model = model_of(&p);
    const fst_world_double *c = &model->world;
    fst_modes_double m = fst_new_modes_double();
    m.contact = FST_MODE_STICK;
    m.rolling = FST_ROLL_RESTS;
    fst_pull_double pull;
    fst_magnetic_pull_double(c, &m, state, &pull);
    const fst_contact_double at = fst_contact_of_double(c, &m, state, &pull);
    const double part = hypot(at.balance[0], at.balance[1]) / (c->resistance.arm * at.load);
    fst_model_free(model);
    CHECK_WITHIN(part, 1e-3, 0.9);
    return part;
}

/* A bead at rest rests where the resistance holds it, and starts to roll where it does not; but a slip and a
 * rotation do not begin at once. */
static void test_rests_or_rolls(void **unused)
{
    (void)unused;
    double state[FST_STATE_SIZE];
    state_at_rest(0, state);
    const double strong = 0.9, part = just_resists(state, strong);
    fst_params p = rubbing_bead(strong, NAN);
    p.friction_rolling_resistance = (1 + 1e-9) * part;
    assert_int_equal(rolling_of(&p, state, RTOL), FST_ROLL_RESTS);
    p.friction_rolling_resistance = (1 - 1e-9) * part;
    assert_int_equal(rolling_of(&p, state, RTOL), FST_ROLL_STARTS);
    assert_int_equal(contact_of(&p, state, RTOL), FST_MODE_STICK);
    p.friction_mu = 1e-4;
    p.friction_rolling_resistance = 1e-4;
    assert_int_equal(contact_of(&p, state, RTOL), FST_MODE_ONSET);
    assert_int_equal(rolling_of(&p, state, RTOL), FST_ROLL_ROLLS);
}

/* The rotation that is nothing follows the tolerance and the square of the resistance's strength. */
static void test_rotation_that_is_nothing(void **unused)
{
    (void)unused;
    double state[FST_STATE_SIZE], nothing[2];
    state_at_rest(0, state);
    const double strong = 0.9, part = just_resists(state, strong);
    for (int i = 0; i < 2; ++i) {
        fst_params p = rubbing_bead(strong, NAN);
        p.friction_rolling_resistance = (1.1 + i) * part;
        fst_model *model = model_of(&p);
        nothing[i] = fst_rotation_of_rest(&model->world, RTOL);
        CHECK_CLOSE(fst_rotation_of_rest(&model->world, 10 * RTOL) / nothing[i], 10, 1e-12);
        fst_model_free(model);
        state[FST_WX] = 0.99 * nothing[i];
        assert_int_equal(rolling_of(&p, state, RTOL), FST_ROLL_RESTS);
        state[FST_WX] = 1.01 * nothing[i];
        assert_int_equal(rolling_of(&p, state, RTOL), FST_ROLL_ROLLS);
    }
    CHECK_CLOSE(nothing[1] / nothing[0], pow(2.1 / 1.1, 2), 1e-12);
}

/* A disc is held where it neither slips nor pivots, and what that is follows the tolerance. */
static void test_disc(void **unused)
{
    (void)unused;
    double state[FST_STATE_SIZE];
    state_at_rest(0, state);
    fst_params p = rubbing_bead(0.9, NAN);
    p.contact_patch = FST_PATCH_HERTZ;
    p.contact_radius = 1e-4;
    static const double tolerances[2] = {1e-8, 1e-11};
    for (int i = 0; i < 2; ++i) {
        const double slow = sqrt(fst_disc_slow_2(tolerances[i]));
        assert_true(motion_of(&p, state, tolerances[i]).modes.slow_2 == fst_disc_slow_2(tolerances[i]));
        state[FST_WZ] = 0.99 * slow;
        assert_int_equal(contact_of(&p, state, tolerances[i]), FST_MODE_STICK);
        state[FST_WZ] = 1.01 * slow;
        assert_int_equal(contact_of(&p, state, tolerances[i]), FST_MODE_SLIP);
    }
}

/* The grip is k mu N - |A|, with a slack for rounding alone, and nothing holds a bead that has lost the plate.
 */
static void test_grip(void **unused)
{
    (void)unused;
    const fst_params p = rubbing_bead(0.2, 0.25);
    fst_model *model = model_of(&p);
    const fst_world_double *c = &model->world;
    fst_contact_double at = {.load = 2};
    const double most = 3.5 * 0.25 * at.load;
    static const struct {
        double part;
        int held;
    } pushes[] = {{0.5, 1}, {1 + 5e-14, 1}, {1 + 5e-13, 0}, {2, 0}};
    for (size_t i = 0; i < sizeof pushes / sizeof *pushes; ++i) {
        at.push[0] = 0.6 * pushes[i].part * most;
        at.push[1] = -0.8 * pushes[i].part * most;
        assert_int_equal(fst_static_grip_double(c, &at) >= 0, pushes[i].held);
        CHECK_CLOSE(fst_static_grip_double(c, &at), (1 - pushes[i].part) * most, 1e-12);
    }
    at.load = -2;
    CHECK_CLOSE(fst_static_grip_double(c, &at), -2 * most, 1e-14);
    fst_model_free(model);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_sticks_or_slips),
        cmocka_unit_test(test_slip_that_is_nothing),
        cmocka_unit_test(test_flies),
        cmocka_unit_test(test_rests_or_rolls),
        cmocka_unit_test(test_rotation_that_is_nothing),
        cmocka_unit_test(test_disc),
        cmocka_unit_test(test_grip),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
