/* Symmetries of the motion: the magnet turned by half a turn, the mirror, shifts of time, scales of unit.
 * tests: model/model.c model/dynamics.inl */
#include "physics.h"

#include "model/model.h"

/* M = diag(1, -1, 1): (x, v, n, W) -> (M x, M v, M n, -M W). */
static void mirror(const double *state, double *image)
{
    static const double sign[FST_STATE_SIZE] = {1, -1, 1, -1, 1, -1, 1, -1, 1, -1};
    for (int i = 0; i < FST_STATE_SIZE; ++i)
        image[i] = sign[i] * state[i];
}

/* A model whose magnet turns the other way, which no parameter can express. */
static fst_model reversed(const fst_model *model)
{
    fst_model back = *model;
    back.groups.omega = -model->groups.omega;
    back.world.omega = -model->world.omega;
    return back;
}

/* S2 and the mirror map the equations of motion onto themselves, for every material, friction law and dynamics;
 * either of them applied twice changes nothing. */
static void test_equations(void **unused)
{
    (void)unused;
    uint64_t seed = 101;
    for (int which = 0; which < CASES; ++which) {
        const fst_params p = params_of_case(which);
        fst_model *model = model_of(&p);
        const fst_model back = reversed(model);
        for (int trial = 0; trial < 50; ++trial) {
            double y[FST_STATE_SIZE], dy[FST_STATE_SIZE], image[FST_STATE_SIZE], d_image[FST_STATE_SIZE],
                expected[FST_STATE_SIZE], twice[FST_STATE_SIZE];
            random_state(&seed, y);
            fst_rhs(model, y, dy);
            fst_apply_s2(y, image);
            fst_rhs(model, image, d_image);
            fst_apply_s2(dy, expected);
            CHECK_CLOSE(greatest_difference(d_image, expected, FST_STATE_SIZE), 0, 2e-12);
            fst_apply_s2(image, twice);
            assert_true(greatest_difference(twice, y, FST_STATE_SIZE) == 0);
            mirror(y, image);
            fst_rhs(&back, image, d_image);
            mirror(dy, expected);
            CHECK_CLOSE(greatest_difference(d_image, expected, FST_STATE_SIZE), 0, 2e-12);
            const fst_observation a = fst_observe(model, y), b = fst_observe(&back, image);
            CHECK_CLOSE(a.load, b.load, 1e-14);
            CHECK_CLOSE(a.energy, b.energy, 1e-13);
            CHECK_CLOSE(a.drive_power, b.drive_power, 1e-14);
            CHECK_CLOSE(a.friction_power, b.friction_power, 1e-14);
        }
        fst_model_free(model);
    }
}

/* The same for trajectories, in each dynamics: the image of a trajectory's end is the end of the image. */
static void test_trajectories(void **unused)
{
    (void)unused;
    for (int dynamics = 0; dynamics < 2; ++dynamics) {
        const fst_params p = bead_at(0.25, (fst_dynamics)dynamics);
        fst_model *model = model_of(&p);
        const fst_model back = reversed(model);
        const double t = 20 * TWO_PI / 0.25;
        double start[FST_STATE_SIZE], end[FST_STATE_SIZE], image[FST_STATE_SIZE], end_of_image[FST_STATE_SIZE],
            image_of_end[FST_STATE_SIZE];
        start_of(&p, model, start);
        state_after(model, 1e-12, start, t, end);
        fst_apply_s2(start, image);
        state_after(model, 1e-12, image, t, end_of_image);
        fst_apply_s2(end, image_of_end);
        CHECK_CLOSE(greatest_difference(end_of_image, image_of_end, FST_STATE_SIZE), 0, 1e-10);
        mirror(start, image);
        state_after(&back, 1e-12, image, t, end_of_image);
        mirror(end, image_of_end);
        CHECK_CLOSE(greatest_difference(end_of_image, image_of_end, FST_STATE_SIZE), 0, 1e-10);
        fst_model_free(model);
    }
}

/* The motion depends on the state alone: a trajectory that is taken up later goes on as it would have. In the
 * laboratory this means that the whole motion may be turned by omega t. */
static void test_shift_of_time(void **unused)
{
    (void)unused;
    for (int dynamics = 0; dynamics < 2; ++dynamics) {
        const fst_params p = bead_at(0.25, (fst_dynamics)dynamics);
        fst_model *model = model_of(&p);
        double start[FST_STATE_SIZE], half[FST_STATE_SIZE], whole[FST_STATE_SIZE], again[FST_STATE_SIZE];
        start_of(&p, model, start);
        state_after(model, 1e-12, start, 217.3, half);
        state_after(model, 1e-12, half, 311.1, again);
        state_after(model, 1e-12, start, 217.3 + 311.1, whole);
        CHECK_CLOSE(greatest_difference(again, whole, FST_STATE_SIZE), 0, 2e-10);
        fst_model_free(model);
    }
}

/* The paper's reversal of polarity: a start half a turn further round the magnet is the image under S2, and
 * leads to the conjugate orbit, which differs in the sign of <n_z>. An orbit with the symmetry S2 is its own
 * conjugate. */
static void test_polarity_reversal(void **unused)
{
    (void)unused;
    static const double drives[] = {0.215, 0.4};
    for (int k = 0; k < 2; ++k) {
        fst_params p = bead_at(drives[k], FST_DYNAMICS_FARAGO2020);
        p.run_periods = 300;
        const fst_run_result orbit = run_of(&p);
        p.start_phi += 180;
        const fst_run_result conjugate = run_of(&p);
        assert_int_equal(orbit.symmetry, k == 0 ? FST_SYMMETRY_S1 : FST_SYMMETRY_S2);
        assert_int_equal(conjugate.symmetry, orbit.symmetry);
        CHECK_CLOSE(conjugate.mean_nz, -orbit.mean_nz, 1e-10);
        CHECK_WITHIN(fabs(orbit.mean_nz), k == 0 ? 0.2 : 0, k == 0 ? 0.3 : 1e-10);
        CHECK_CLOSE(conjugate.mean_r, orbit.mean_r, 1e-10);
        CHECK_CLOSE(conjugate.festoons, orbit.festoons, 1e-9);
        CHECK_CLOSE(conjugate.max_b, orbit.max_b, 1e-9);
        CHECK_CLOSE(conjugate.mean_phi_dot, orbit.mean_phi_dot, 1e-10);
    }
}

/* SI and scaled parameters describe the same motion: a bead given by scaled keys (the same bits), and a setup
 * ten times as large in every respect. */
static void test_units_do_not_matter(void **unused)
{
    (void)unused;
    const fst_params si = bead_at(0.3, FST_DYNAMICS_RIGID);
    fst_model *model_si = model_of(&si);
    const fst_groups same = fst_model_groups(model_si);
    fst_model_free(model_si);
    fst_params scaled = si;
    scaled.model_eps = same.eps;
    scaled.model_h = same.h;
    scaled.model_lambda = same.lambda;
    fst_params large = si; /* lengths x 10, times x 2: kappa = mu B0/(m R^2 gamma^2) is kept by mu B0 */
    large.bead_radius *= 10;
    large.magnet_half_length *= 10;
    large.magnet_width *= 10;
    large.magnet_depth *= 10;
    large.plate_radius *= 10;
    large.plate_gravity *= 10.0 / 4;
    large.friction_gamma /= 2;
    large.bead_mass = 3;
    large.bead_moment = 7;
    large.magnet_b0 = 1.5 * 3 * 25e-3 * 25e-3 * 156.25 * 156.25 / 7;
    large.drive_omega = NAN;
    large.drive_frequency = 0.3 * 156.25 / TWO_PI;
    const fst_params *const ways[] = {&si, &scaled, &large};
    double end[3][FST_STATE_SIZE];
    fst_groups g[3];
    for (int i = 0; i < 3; ++i) {
        fst_model *model = model_of(ways[i]);
        double start[FST_STATE_SIZE];
        start_of(ways[i], model, start);
        g[i] = fst_model_groups(model);
        state_after(model, 1e-12, start, 300, end[i]);
        fst_model_free(model);
        CHECK_CLOSE(g[i].eps, g[0].eps, 2e-17);
        CHECK_CLOSE(g[i].h, g[0].h, 2e-16);
        CHECK_CLOSE(g[i].lambda, g[0].lambda, 1e-16);
        CHECK_CLOSE(g[i].kappa, g[0].kappa, 1e-15);
        CHECK_CLOSE(g[i].omega, g[0].omega, 1e-16);
        CHECK_CLOSE(g[i].gravity, g[0].gravity, 2e-18);
        CHECK_CLOSE(g[i].plate_radius, g[0].plate_radius, 4e-15);
        CHECK_CLOSE(greatest_difference(end[i], end[0], FST_STATE_SIZE), 0, 1e-10);
    }
    assert_memory_equal(end[1], end[0], sizeof end[0]);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_equations),           cmocka_unit_test(test_trajectories),
        cmocka_unit_test(test_shift_of_time),       cmocka_unit_test(test_polarity_reversal),
        cmocka_unit_test(test_units_do_not_matter),
    };
    return cmocka_run_group_tests_name("symmetry", tests, NULL, NULL);
}
