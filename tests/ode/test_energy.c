/* Energy along trajectories: the balance d(energy) = (drive - friction) dt, integrated with the steps' own
 * stages, and its means on closed orbits.  (The balance at a state is in test_energy_ld.c.)
 * tests: ode/path.inl observe/quadrature.c model/drive.inl
 * labels: numbers */
#include "physics.h"

#include "observe/quadrature.h"

static const double TABLE_1[] = {0.21, 0.25, 0.2845, 0.352, 0.405};

/* Greatest defect of the energy balance since the start, at the ends of steps and inside them. */
static double worst_defect(const fst_model *model, const double *start, double tolerance, double t_end)
{
    fst_flow *flow = flow_of(model, tolerance, start);
    fst_quadrature q;
    fst_quadrature_begin(&q, flow);
    const double energy = fst_observe(model, start).energy;
    double worst = 0;
    while (flow->t.high < t_end) {
        assert_int_equal(fst_flow_step(flow, t_end, NULL), FST_OK);
        fst_quadrature_step(&q, flow, 0);
        static const double places[] = {0.37, 0.81, 1.0};
        for (int i = 0; i < 3; ++i) {
            double integrals[FST_Q_COUNT], phi, state[FST_STATE_SIZE];
            fst_quadrature_at(&q, flow, places[i], integrals, &phi);
            fst_flow_at(flow, places[i], state);
            const double work = integrals[FST_Q_DRIVE_POWER] - integrals[FST_Q_FRICTION_POWER];
            worst = fmax(worst, fabs(fst_observe(model, state).energy - energy - work));
        }
    }
    fst_flow_free(flow);
    return worst;
}

static void test_balance_along_the_way(void **unused)
{
    (void)unused;
    for (int material = 0; material < 3; ++material)
        for (int dynamics = 0; dynamics < 2; ++dynamics)
            for (int law = 0; law < 2; ++law) {
                fst_params p = bead_at(0.405, (fst_dynamics)dynamics);
                p.bead_material = material;
                p.friction_law = law;
                p.bead_a = 1e-3;
                p.bead_b = 1e-3;
                fst_model *model = model_of(&p);
                double start[FST_STATE_SIZE];
                start_of(&p, model, start);
                CHECK_WITHIN(worst_defect(model, start, 1e-12, 10 * TWO_PI / 0.405), 0, 1e-11);
                fst_model_free(model);
            }
}

/* Without friction `rigid` keeps the Jacobi integral E - omega L_z; the printed equations do not. */
static void test_jacobi_integral(void **unused)
{
    (void)unused;
    for (int dynamics = 0; dynamics < 2; ++dynamics) {
        const fst_params p = frictionless_bead((fst_dynamics)dynamics);
        fst_model *model = model_of(&p);
        const double eps = fst_model_groups(model).eps;
        double state[FST_STATE_SIZE], first = NAN, worst = 0;
        start_of(&p, model, state);
        fst_flow *flow = flow_of(model, 1e-12, state);
        for (int i = 0; i <= 100; ++i) {
            advance_to(flow, i, 0);
            const fst_flow_info info = fst_flow_get(flow);
            const double *y = info.state;
            const double angular = y[FST_X] * y[FST_VY] - y[FST_Y] * y[FST_VX] + 0.4 * eps * eps * y[FST_WZ];
            const double jacobi = fst_observe(model, y).energy - 0.3 * angular;
            if (i == 0)
                first = jacobi;
            worst = fmax(worst, fabs(jacobi - first));
        }
        if (dynamics == FST_DYNAMICS_RIGID)
            CHECK_WITHIN(worst, 0, 1e-13);
        else
            CHECK_WITHIN(worst, 1e-5, 1);
        fst_flow_free(flow);
        fst_model_free(model);
    }
}

/* Table 1's runs, both dynamics: what the drive puts in, friction takes out, on closed orbits; and the residual
 * of the balance between any two marks of the window is below 1e-10 of the work. */
static void test_closed_orbits(void **unused)
{
    (void)unused;
    for (int dynamics = 0; dynamics < 2; ++dynamics)
        for (int i = 0; i < 5; ++i) {
            fst_params p = bead_at(TABLE_1[i], (fst_dynamics)dynamics);
            p.run_periods = 260;
            const fst_run_result r = run_of(&p);
            CHECK_WITHIN(r.energy_residual, 0, 1e-10);
            const int relaxing = dynamics == FST_DYNAMICS_FARAGO2020 && i == 2;
            CHECK_CLOSE(r.mean_drive_power / r.mean_friction_power, 1, relaxing ? 1e-8 : 1e-10);
            /* Averaged momentum balances: Eqs. (12) and (13) in their exact forms. */
            CHECK_CLOSE(r.eq21_centrifugal + r.eq21_magnetic + r.eq21_friction, 0, relaxing ? 1e-9 : 1e-12);
            CHECK_CLOSE(r.eq22_magnetic + r.eq22_friction, 0, relaxing ? 1e-9 : 1e-12);
        }
}

/* Other materials; the paramagnet's averaged balances, Eq. (16): <V^2> = a omega <dB^2/dalpha> and
 * a <dB^2/dalpha> = <r V_alpha>. */
static void test_other_materials(void **unused)
{
    (void)unused;
    fst_params p = bead_at(0.405, FST_DYNAMICS_RIGID);
    p.bead_material = FST_MATERIAL_MIXED;
    p.bead_a = 1e-3;
    p.bead_b = -1e-3;
    p.run_periods = 260;
    const fst_run_result mixed = run_of(&p);
    assert_int_equal(mixed.regime, FST_REGIME_COUNTER_ROTATING);
    CHECK_WITHIN(mixed.energy_residual, 0, 1e-10);
    CHECK_CLOSE(mixed.mean_drive_power / mixed.mean_friction_power, 1, 1e-9);
    p.bead_material = FST_MATERIAL_PARAMAGNETIC;
    p.bead_a = 3e-3;
    p.run_periods = 500;
    p.run_discard = 100;
    const fst_run_result para = run_of(&p);
    assert_int_not_equal(para.regime, FST_REGIME_COUNTER_ROTATING);
    CHECK_WITHIN(para.energy_residual, 0, 1e-10);
    CHECK_CLOSE(para.mean_drive_power / para.mean_friction_power, 1, 0.01);
    CHECK_CLOSE(-para.eq22_friction / para.eq22_magnetic, 1, 0.02);
    CHECK_CLOSE(para.mean_drive_power, 0.405 * para.eq22_magnetic, 1e-12);
}

/* A locked bead neither takes up nor loses energy: the residual is undefined or small, never a large number. */
static void test_locked_bead(void **unused)
{
    (void)unused;
    const fst_params p = bead_at(0.0825, FST_DYNAMICS_RIGID);
    const fst_run_result r = run_of(&p);
    assert_int_equal(r.regime, FST_REGIME_LOCKED);
    CHECK_CLOSE(r.mean_friction_power, 0, 1e-12);
    CHECK_CLOSE(r.mean_drive_power, 0, 1e-12);
    if (!isnan(r.energy_residual))
        CHECK_WITHIN(r.energy_residual, 0, 1e-10);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_balance_along_the_way), cmocka_unit_test(test_jacobi_integral),
        cmocka_unit_test(test_closed_orbits),         cmocka_unit_test(test_other_materials),
        cmocka_unit_test(test_locked_bead),
    };
    return cmocka_run_group_tests_name("energy", tests, NULL, NULL);
}
