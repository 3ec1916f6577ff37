/* The derivative of the equations of motion along a vector is the Jacobian times the vector, for every
 * material, friction law and dynamics: against a Jacobian written by hand, entry by entry (jacobian_ld.h),
 * which is itself held against differences of the right-hand side; and fst_jacobian() has the columns.
 * tests: model/tangent.inl
 * labels: long-double */
#include "jacobian_ld.h"

#include "model/tangent.inl"

/* Column j of the derivative of the right-hand side, by differences. */
static void difference_column(const world_ld *c, const long double *y, int j, long double *column)
{
    const long double d = 4e-3L;
    for (int i = 0; i < FST_STATE_SIZE; ++i)
        column[i] = 0;
    for (int k = 1; k <= 4; ++k)
        for (int sign = -1; sign <= 1; sign += 2) {
            long double moved[FST_NUMBERS], dy[FST_NUMBERS];
            memcpy(moved, y, sizeof moved);
            moved[j] += sign * k * d;
            fst_pull_long_double pull;
            fst_rhs_long_double(c, NULL, c->omega, moved, dy, &pull);
            for (int i = 0; i < FST_STATE_SIZE; ++i)
                column[i] += sign * DIFFERENCE_WEIGHTS[k - 1] * dy[i] / d;
        }
}

/* The derivative along a vector is the Jacobian times it, and the state's own is the right-hand side's, to
 * rounding (2^-64 = 5.4e-20): what rounds is of the size of the products that are summed. */
static void check_along(const world_ld *c, const long double *y,
                        long double jacobian[FST_STATE_SIZE][FST_STATE_SIZE], const long double *along)
{
    long double dy[FST_NUMBERS], change[FST_NUMBERS], expected_dy[FST_NUMBERS];
    fst_pull_long_double pull;
    fst_rhs_and_tangent_long_double(c, NULL, c->omega, y, along, dy, change);
    fst_rhs_long_double(c, NULL, c->omega, y, expected_dy, &pull);
    long double speed = 0, scale = 0, expected[FST_NUMBERS] = {0};
    for (int i = 0; i < FST_STATE_SIZE; ++i) {
        long double products = 0;
        for (int k = 0; k < FST_STATE_SIZE; ++k) {
            expected[i] += jacobian[i][k] * along[k];
            products += fabsl(jacobian[i][k] * along[k]);
        }
        scale = products > scale ? products : scale;
        speed = fabsl(expected_dy[i]) > speed ? fabsl(expected_dy[i]) : speed;
    }
    for (int i = 0; i < FST_STATE_SIZE; ++i) {
        CHECK_CLOSE_LD(change[i] / scale, expected[i] / scale, 1e-17);
        CHECK_CLOSE_LD(dy[i] / speed, expected_dy[i] / speed, 1e-17);
    }
}

/* Along the axes, where no other entry hides one, and along a vector of all. */
static void check_all_along(const world_ld *c, const long double *y,
                            long double jacobian[FST_STATE_SIZE][FST_STATE_SIZE])
{
    for (int axis = 0; axis <= FST_STATE_SIZE; ++axis) {
        long double along[FST_NUMBERS];
        for (int i = 0; i < FST_STATE_SIZE; ++i)
            along[i] = axis == FST_STATE_SIZE ? cosl(1.0L + 3.0L * i) : axis == i ? 1.0L : 0.0L;
        check_along(c, y, jacobian, along);
    }
}

static void check_at(const fst_params *p, const fst_model *model, const double *state)
{
    const world_ld c = world_of(p);
    long double y[FST_NUMBERS], exact[FST_STATE_SIZE][FST_STATE_SIZE];
    for (int i = 0; i < FST_STATE_SIZE; ++i)
        y[i] = state[i];
    double jacobian[FST_STATE_SIZE][FST_STATE_SIZE];
    fst_jacobian(model, state, jacobian, NULL);
    fst_jacobian_by_hand_long_double(&c, c.omega, y, exact);
    check_all_along(&c, y, exact);
    for (int j = 0; j < FST_STATE_SIZE; ++j) {
        long double column[FST_NUMBERS];
        difference_column(&c, y, j, column);
        for (int i = 0; i < FST_STATE_SIZE; ++i) {
            if (fabsl(exact[i][j] - column[i]) > 2e-12L || fabs(jacobian[i][j] - (double)exact[i][j]) > 1e-12)
                print_error("entry %d, %d\n", i, j);
            CHECK_CLOSE_LD(exact[i][j], column[i], 2e-12);
            CHECK_CLOSE_LD(jacobian[i][j], exact[i][j], 1e-12);
        }
    }
}

static void test_jacobian_entry_by_entry(void **unused)
{
    (void)unused;
    uint64_t seed = 31;
    for (int which = 0; which < CASES; ++which) {
        const fst_params p = params_of_case(which);
        fst_model *model = model_of(&p);
        for (int trial = 0; trial < 20; ++trial) {
            double state[FST_STATE_SIZE];
            random_state(&seed, state);
            check_at(&p, model, state);
        }
        fst_model_free(model);
    }
}

/* Also for the fewest and the most lines, and at |n| other than 1, where an integrator's stages lie. */
static void test_other_magnets(void **unused)
{
    (void)unused;
    uint64_t seed = 32;
    static const int numbers[] = {1, 2, 99};
    for (int number = 0; number < 3; ++number) {
        fst_params p = params_of_case(9);
        p.magnet_lines = numbers[number];
        fst_model *model = model_of(&p);
        double state[FST_STATE_SIZE];
        random_state(&seed, state);
        for (int i = 0; i < 3; ++i)
            state[FST_NX + i] *= 1.1;
        check_at(&p, model, state);
        fst_model_free(model);
    }
}

/* Hollow beads, and one whose mass lies in the middle. */
static void test_other_inertias(void **unused)
{
    (void)unused;
    uint64_t seed = 34;
    static const double inertias[] = {0.01, 0.25, 2.0 / 3.0};
    for (int i = 0; i < 3; ++i)
        for (int which = 0; which < CASES; ++which) {
            fst_params p = params_of_case(which);
            p.bead_inertia = inertias[i];
            fst_model *model = model_of(&p);
            double state[FST_STATE_SIZE];
            random_state(&seed, state);
            check_at(&p, model, state);
            fst_model_free(model);
        }
}

/* The right-hand side is linear in omega: its derivative is a difference over any distance. */
static void test_by_omega(void **unused)
{
    (void)unused;
    uint64_t seed = 33;
    for (int which = 0; which < CASES; ++which) {
        fst_params p = params_of_case(which);
        fst_model *model = model_of(&p);
        p.drive_omega += 0.5;
        fst_model *faster = model_of(&p);
        double state[FST_STATE_SIZE], slow[FST_STATE_SIZE], fast[FST_STATE_SIZE], by_omega[FST_STATE_SIZE];
        random_state(&seed, state);
        fst_rhs(model, state, slow);
        fst_rhs(faster, state, fast);
        double jacobian[FST_STATE_SIZE][FST_STATE_SIZE];
        fst_jacobian(model, state, jacobian, by_omega);
        for (int i = 0; i < FST_STATE_SIZE; ++i)
            CHECK_CLOSE(by_omega[i], 2.0 * (fast[i] - slow[i]), 1e-12);
        fst_model_free(faster);
        fst_model_free(model);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_jacobian_entry_by_entry),
        cmocka_unit_test(test_other_magnets),
        cmocka_unit_test(test_other_inertias),
        cmocka_unit_test(test_by_omega),
    };
    return cmocka_run_group_tests_name("jacobian_ld", tests, NULL, NULL);
}
