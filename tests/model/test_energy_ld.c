/* Energy in long double: at every state, for every material, friction law and dynamics,
 *
 *     d/dt (kinetic + magnetic energy) = power of the drive - f.V,
 *
 * and without friction `rigid` conserves the Jacobi integral E - omega L_z, L_z = e.(x x v) + (2/5) eps^2 W_z:
 * the drive's power is omega times the magnet's torque on the bead, and nothing else changes L_z.  farago2020
 * loses (2/5) eps^2 (W.n)(W x n)_z of it: the printed equations turn no energy over, but do not keep angular
 * momentum.
 * tests: model/drive.inl model/observe.inl model/contact/viscous.inl model/contact/none.inl
 *   model/contact/contacts.inl
 * labels: long-double */
#include "physics_ld.h"

static long double energy_at(const world_ld *c, const long double *y)
{
    fst_pull_long_double pull;
    fst_magnetic_pull_long_double(c, NULL, y, &pull);
    return fst_energy_long_double(c, NULL, y, &pull);
}

static long double angular_momentum(const world_ld *c, const long double *y)
{
    return y[FST_X] * y[FST_VY] - y[FST_Y] * y[FST_VX] + 0.4L * c->eps * c->eps * y[FST_WZ];
}

/* The derivative of a function of the state along the flow. */
static long double along_flow(const world_ld *c, const long double *y,
                              long double (*function)(const world_ld *, const long double *))
{
    long double dy[FST_NUMBERS], moved[FST_NUMBERS], derivative = 0;
    fst_pull_long_double pull;
    fst_rhs_long_double(c, NULL, c->omega, y, dy, &pull);
    const long double d = 1e-3L;
    for (int k = 1; k <= 4; ++k)
        for (int sign = -1; sign <= 1; sign += 2) {
            for (int i = 0; i < FST_STATE_SIZE; ++i)
                moved[i] = y[i] + sign * k * d * dy[i];
            derivative += sign * DIFFERENCE_WEIGHTS[k - 1] * function(c, moved) / d;
        }
    return derivative;
}

static void test_balances(void **unused)
{
    (void)unused;
    uint64_t seed = 61;
    double lost_most = 0;
    for (int which = 0; which < CASES; ++which) {
        const fst_params p = params_of_case(which);
        const world_ld c = world_of(&p);
        for (int trial = 0; trial < 50; ++trial) {
            double state[FST_STATE_SIZE];
            random_state(&seed, state);
            long double y[FST_NUMBERS];
            for (int i = 0; i < FST_STATE_SIZE; ++i)
                y[i] = (i >= FST_WX ? 0.5L : 1) * state[i];
            fst_pull_long_double pull;
            fst_seen_long_double seen;
            fst_magnetic_pull_long_double(&c, NULL, y, &pull);
            fst_see_long_double(&c, NULL, c.omega, y, &pull, &seen);
            const long double change = along_flow(&c, y, energy_at);
            CHECK_CLOSE_LD(change, seen.drive_power - seen.friction_power, 1e-13);
            if (p.friction_law != FST_FRICTION_NONE)
                continue;
            const long double jacobi = change - c.omega * along_flow(&c, y, angular_momentum);
            const long double *n = y + FST_NX, *w = y + FST_WX;
            const long double wxn_z = w[0] * n[1] - w[1] * n[0];
            const long double lost =
                c.kinds.gyroscopic_term_lost ? 0.4L * c.eps * c.eps * seen.spin * wxn_z : 0;
            CHECK_CLOSE_LD(jacobi, -c.omega * lost, 1e-13);
            lost_most = fmax(lost_most, (double)fabsl(lost));
        }
    }
    CHECK_WITHIN(lost_most, 1e-4, INFINITY);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(test_balances)};
    return cmocka_run_group_tests_name("energy_ld", tests, NULL, NULL);
}
