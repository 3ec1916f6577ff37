/* An independent integrator on the same right-hand side: CVODE's (SUNDIALS) Adams and BDF methods at rtol =
 * 1e-12, the latter with the library's Jacobian, against the library's own flow after eight drive periods.
 * tests: ode/dop853.inl model/tangent.inl
 * labels: cvode */
#include "physics.h"

#include <cvode/cvode.h>
#include <nvector/nvector_serial.h>
#include <sundials/sundials_types.h>
#include <sunlinsol/sunlinsol_dense.h>
#include <sunmatrix/sunmatrix_dense.h>

static int rhs(realtype t, N_Vector y, N_Vector dy, void *model)
{
    (void)t;
    fst_rhs(model, N_VGetArrayPointer(y), N_VGetArrayPointer(dy));
    return 0;
}

static int jacobian(realtype t, N_Vector y, N_Vector dy, SUNMatrix matrix, void *model, N_Vector a, N_Vector b,
                    N_Vector c)
{
    (void)t, (void)dy, (void)a, (void)b, (void)c;
    double j[FST_STATE_SIZE][FST_STATE_SIZE];
    fst_jacobian(model, N_VGetArrayPointer(y), j, NULL);
    for (int i = 0; i < FST_STATE_SIZE; ++i)
        for (int k = 0; k < FST_STATE_SIZE; ++k)
            SM_ELEMENT_D(matrix, i, k) = j[i][k];
    return 0;
}

/* The state after t by CVODE; its Newton iteration uses the library's Jacobian. */
static void cvode_state(fst_model *model, int method, const double *start, double t, double *end)
{
    SUNContext context;
    assert_int_equal(SUNContext_Create(NULL, &context), 0);
    N_Vector y = N_VNew_Serial(FST_STATE_SIZE, context);
    memcpy(N_VGetArrayPointer(y), start, FST_STATE_SIZE * sizeof *start);
    void *solver = CVodeCreate(method, context);
    SUNMatrix matrix = SUNDenseMatrix(FST_STATE_SIZE, FST_STATE_SIZE, context);
    SUNLinearSolver linear = SUNLinSol_Dense(y, matrix, context);
    assert_int_equal(CVodeInit(solver, rhs, 0, y), CV_SUCCESS);
    assert_int_equal(CVodeSStolerances(solver, 1e-12, 1e-13), CV_SUCCESS);
    assert_int_equal(CVodeSetUserData(solver, model), CV_SUCCESS);
    assert_int_equal(CVodeSetMaxNumSteps(solver, 1000000), CV_SUCCESS);
    assert_int_equal(CVodeSetLinearSolver(solver, linear, matrix), CV_SUCCESS);
    assert_int_equal(CVodeSetJacFn(solver, jacobian), CV_SUCCESS);
    assert_int_equal(CVodeSetStopTime(solver, t), CV_SUCCESS);
    double reached = 0;
    assert_true(CVode(solver, t, y, &reached, CV_NORMAL) >= 0);
    assert_true(reached == t);
    memcpy(end, N_VGetArrayPointer(y), FST_STATE_SIZE * sizeof *end);
    SUNLinSolFree(linear);
    SUNMatDestroy(matrix);
    CVodeFree(&solver);
    N_VDestroy(y);
    SUNContext_Free(&context);
}

static void test_against_cvode(void **unused)
{
    (void)unused;
    for (int which = 0; which < 6; ++which) {
        fst_params p = bead_at(0.405, which & 1 ? FST_DYNAMICS_FARAGO2020 : FST_DYNAMICS_RIGID);
        p.bead_material = which / 2;
        p.bead_a = 1e-3;
        p.bead_b = 1e-3;
        fst_model *model = model_of(&p);
        const double t = 8 * TWO_PI / 0.405;
        double start[FST_STATE_SIZE], ours[FST_STATE_SIZE], theirs[FST_STATE_SIZE];
        start_of(&p, model, start);
        state_after(model, 1e-13, start, t, ours);
        cvode_state(model, CV_ADAMS, start, t, theirs);
        CHECK_CLOSE(greatest_difference(ours, theirs, FST_STATE_SIZE), 0, 1e-8);
        cvode_state(model, CV_BDF, start, t, theirs);
        CHECK_CLOSE(greatest_difference(ours, theirs, FST_STATE_SIZE), 0, 1e-8);
        fst_model_free(model);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(test_against_cvode)};
    return cmocka_run_group_tests_name("cvode", tests, NULL, NULL);
}
