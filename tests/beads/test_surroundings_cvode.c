/* An independent integrator on the equations of the laboratory's frame: CVODE's (SUNDIALS) Adams method against the
 * flow of beads, with a turning magnet, a part and a coil that stand still, and the field of the Earth.
 * tests: beads/flow.c model/surroundings.c
 * labels: cvode */
#include "keys.h"
#include "some_beads.h"

#include <cvode/cvode.h>
#include <nvector/nvector_serial.h>
#include <sundials/sundials_types.h>
#include <sunnonlinsol/sunnonlinsol_fixedpoint.h>

enum { NUMBERS = FST_BEAD_NUMBERS + BEADS_INTEGRALS };

static int rhs(realtype t, N_Vector y, N_Vector dy, void *user)
{
    beads_flow *flow = user;
    double full[NUMBERS] = {0};
    beads_look look;
    memcpy(full, N_VGetArrayPointer(y), FST_BEAD_NUMBERS * sizeof *full);
    full[FST_BEAD_NUMBERS + BEADS_TIME] = t;
    double rates[NUMBERS];
    beads_look_at(&flow->world, &flow->modes, full, &look);
    beads_derivatives(&flow->world, &flow->modes, &look, full, rates);
    memcpy(N_VGetArrayPointer(dy), rates, FST_BEAD_NUMBERS * sizeof *rates);
    return 0;
}

static void test_against_cvode(void **unused)
{
    (void)unused;
    static const char *const keys[][2] = {
        {"magnet.b0", "7.3 mT"},          {"field.uniform[0]", "50 uT"}, {"field.uniform[2]", "-40 uT"},
        {"coils[0].radius", "80 mm"},     {"coils[0].axis[0]", "1"},     {"coils[0].ac", "40 A"},
        {"coils[0].frequency", "5 Hz"},   {"coils[0].current", "10 A"},  {"drive.frequency", "12 Hz"},
        {"coils[0].centre[2]", "-20 mm"},
    };
    fst_params p = fst_default_params();
    fst_model *model = NULL;
    double start[FST_BEAD_NUMBERS];
    assert_int_equal(fst_field_model_new(&p, NAN, &model, NULL), FST_OK);
    place_bead(p, model, 40, start);
    fst_model_free(model);
    for (size_t i = 0; i < sizeof keys / sizeof *keys; ++i)
        set(&p, keys[i][0], keys[i][1]);
    assert_int_equal(fst_field_model_new(&p, NAN, &model, NULL), FST_OK);
    beads_world world = paper_beads(1, model, 0);
    world.surrounded = 1;
    assert_int_equal(fst_make_surroundings(model, &world.around, NULL), FST_OK);
    assert_true(world.around.laboratory);
    beads_flow *flow = begin_beads(&world, start, 1e-13);
    beads_flow *other = begin_beads(&world, start, 1e-13);
    const double t = 40;
    go_to(flow, t);
    SUNContext context;
    assert_int_equal(SUNContext_Create(NULL, &context), 0);
    N_Vector y = N_VNew_Serial(FST_BEAD_NUMBERS, context);
    memcpy(N_VGetArrayPointer(y), other->step.y, sizeof start);
    void *solver = CVodeCreate(CV_ADAMS, context);
    SUNNonlinearSolver fixed_point = SUNNonlinSol_FixedPoint(y, 0, context);
    assert_int_equal(CVodeInit(solver, rhs, 0, y), CV_SUCCESS);
    assert_int_equal(CVodeSStolerances(solver, 1e-13, 1e-13), CV_SUCCESS);
    assert_int_equal(CVodeSetUserData(solver, other), CV_SUCCESS);
    assert_int_equal(CVodeSetMaxNumSteps(solver, 1000000), CV_SUCCESS);
    assert_int_equal(CVodeSetNonlinearSolver(solver, fixed_point), CV_SUCCESS);
    assert_int_equal(CVodeSetStopTime(solver, t), CV_SUCCESS);
    double reached = 0;
    assert_true(CVode(solver, t, y, &reached, CV_NORMAL) >= 0);
    CHECK_CLOSE(greatest_difference(flow->step.y, N_VGetArrayPointer(y), FST_BEAD_NUMBERS), 0, 1e-9);
    SUNNonlinSolFree(fixed_point);
    CVodeFree(&solver);
    N_VDestroy(y);
    SUNContext_Free(&context);
    free(flow);
    free(other);
    fst_model_free(model);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(test_against_cvode)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
