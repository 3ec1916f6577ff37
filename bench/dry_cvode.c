/* dry_cvode.c - the job of dry_peers.h by CVODE's BDF method on the regularised law f = mu N V/sqrt(V^2 +
 * v_s^2).
 *
 * The mean of r is an eleventh unknown, r' of its integral; Newton's iteration gets the exact Jacobian.
 */
#define _GNU_SOURCE /* dladdr */
#include "dry_peers.h"

#include <dlfcn.h>
#include <math.h>
#include <string.h>

#include <cvode/cvode.h>
#include <nvector/nvector_serial.h>
#include <sundials/sundials_types.h>
#include <sunlinsol/sunlinsol_dense.h>
#include <sunmatrix/sunmatrix_dense.h>

#include "model/tangent.inl"

enum { UNKNOWNS = FST_STATE_SIZE + 1 };

typedef struct regularised {
    const fst_world_double *c; /* without friction */
    double mu, width2;
} regularised;

int dry_cvode_is_optimised(void)
{
    Dl_info found;
    void *create = NULL;
    void *(*const function)(int, SUNContext) = CVodeCreate;
    memcpy(&create, &function, sizeof create);
    return dladdr(create, &found) && strstr(found.dli_fname, "cvode-optimised");
}

/* -f on the velocity v, and what it does to W. */
static void add_friction(const fst_world_double *c, const double f[2], double *dy)
{
    dy[FST_VX] -= f[0];
    dy[FST_VY] -= f[1];
    dy[FST_WX] -= c->traction * f[1];
    dy[FST_WY] += c->traction * f[0];
}

static int rhs(realtype t, N_Vector at, N_Vector rate, void *data)
{
    (void)t;
    const regularised *law = data;
    const double *y = N_VGetArrayPointer(at);
    double *dy = N_VGetArrayPointer(rate);
    fst_pull_double pull;
    fst_rhs_double(law->c, NULL, law->c->omega, y, dy, &pull);
    const fst_contact_double contact = fst_contact_of_double(law->c, NULL, y, &pull);
    const double *v = contact.slip;
    const double each = law->mu * contact.load / sqrt(v[0] * v[0] + v[1] * v[1] + law->width2);
    const double f[2] = {each * v[0], each * v[1]};
    add_friction(law->c, f, dy);
    dy[FST_STATE_SIZE] = sqrt(y[FST_X] * y[FST_X] + y[FST_Y] * y[FST_Y]);
    return 0;
}

static int jacobian(realtype t, N_Vector at, N_Vector rate, SUNMatrix matrix, void *data, N_Vector a,
                    N_Vector b, N_Vector d)
{
    (void)t, (void)rate, (void)a, (void)b, (void)d;
    const regularised *law = data;
    const double *y = N_VGetArrayPointer(at), omega = law->c->omega;
    const double r = sqrt(y[FST_X] * y[FST_X] + y[FST_Y] * y[FST_Y]);
    fst_linear_double l;
    double dy[FST_STATE_SIZE], axis[FST_STATE_SIZE] = {0}, column[FST_STATE_SIZE], force[3], turning[3], dv[2];
    fst_linearise_double(law->c, NULL, omega, y, &l, dy);
    const double *v = l.contact.slip, load = l.contact.load;
    const double q2 = v[0] * v[0] + v[1] * v[1] + law->width2, q = sqrt(q2);
    for (int j = 0; j < FST_STATE_SIZE; ++j) {
        axis[j] = 1.0;
        fst_change_along_double(law->c, omega, y, &l, axis, column);
        fst_pull_change_double(law->c, &l, y, axis, force, turning);
        fst_slip_double(law->c, axis, dv);
        axis[j] = 0.0;
        const double along = (v[0] * dv[0] + v[1] * dv[1]) / q2;
        double f[2];
        for (int i = 0; i < 2; ++i)
            f[i] = law->mu / q * (-force[2] * v[i] + load * (dv[i] - along * v[i]));
        add_friction(law->c, f, column);
        for (int i = 0; i < FST_STATE_SIZE; ++i)
            SM_ELEMENT_D(matrix, i, j) = column[i];
        SM_ELEMENT_D(matrix, FST_STATE_SIZE, j) = j == FST_X ? y[FST_X] / r : j == FST_Y ? y[FST_Y] / r : 0.0;
    }
    for (int i = 0; i < UNKNOWNS; ++i)
        SM_ELEMENT_D(matrix, i, FST_STATE_SIZE) = 0.0;
    return 0;
}

static int place_x(realtype t, N_Vector at, realtype *out, void *data)
{
    (void)t, (void)data;
    *out = N_VGetArrayPointer(at)[FST_X];
    return 0;
}

/* From passage to passage of X = 0, upwards. */
static int integrate(void *solver, N_Vector y, double t_most, double *mean_r, double *t)
{
    double t_first = 0.0, integral_first = 0.0;
    for (int passages = 1; passages <= DRY_DISCARD + DRY_TURNS; ++passages) {
        if (CVode(solver, t_most, y, t, CV_NORMAL) != CV_ROOT_RETURN)
            return 0;
        const double integral = N_VGetArrayPointer(y)[FST_STATE_SIZE];
        if (passages == DRY_DISCARD) {
            t_first = *t;
            integral_first = integral;
        }
        *mean_r = (integral - integral_first) / (*t - t_first);
    }
    return 1;
}

int dry_by_cvode(const dry_job *job, const dry_setting *setting, double *mean_r, double *periods)
{
    regularised law = {&job->smooth->world, job->mu, setting->width * setting->width};
    SUNContext context = NULL;
    double t = 0.0;
    int upwards = 1;
    if (SUNContext_Create(NULL, &context) != 0)
        return 0;
    N_Vector y = N_VNew_Serial(UNKNOWNS, context);
    memcpy(N_VGetArrayPointer(y), job->start, sizeof job->start);
    N_VGetArrayPointer(y)[FST_STATE_SIZE] = 0.0;
    void *solver = CVodeCreate(CV_BDF, context);
    SUNMatrix matrix = SUNDenseMatrix(UNKNOWNS, UNKNOWNS, context);
    SUNLinearSolver linear = SUNLinSol_Dense(y, matrix, context);
    const int good =
        CVodeInit(solver, rhs, 0, y) == CV_SUCCESS &&
        CVodeSetErrFile(solver, NULL) == CV_SUCCESS && /* the table says what failed */
        CVodeSStolerances(solver, setting->step, setting->step) == CV_SUCCESS &&
        CVodeSetUserData(solver, &law) == CV_SUCCESS && CVodeSetMaxNumSteps(solver, 100000000) == CV_SUCCESS &&
        CVodeSetLinearSolver(solver, linear, matrix) == CV_SUCCESS &&
        CVodeSetJacFn(solver, jacobian) == CV_SUCCESS && CVodeRootInit(solver, 1, place_x) == CV_SUCCESS &&
        CVodeSetRootDirection(solver, &upwards) == CV_SUCCESS &&
        integrate(solver, y, 4.0 * (DRY_DISCARD + DRY_TURNS) * job->drive_period, mean_r, &t);
    *periods = t / job->drive_period;
    SUNLinSolFree(linear);
    SUNMatDestroy(matrix);
    CVodeFree(&solver);
    N_VDestroy(y);
    SUNContext_Free(&context);
    return good;
}
