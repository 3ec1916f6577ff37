/* exponent.c - largest Lyapunov exponent across the flow, by the variational equations. */
#include "study/run_state.h"

#include <string.h>

#include "base/error.h"
#include "model/jacobian.inl"

/* State and one tangent vector; the tangent's derivative is the Jacobian times it. */
#define STEP_DIM (2 * FST_STATE_SIZE)
#define STEP_NAME(name) fst_tangent_##name##_double
#define STEP_CONTEXT fst_coefficients_double
#define STEP_RHS(s, drive, j) tangent_rhs(&(s)->context, drive, (s)->stage[(j)-1], (s)->k[(j)-1])

static void tangent_rhs(const fst_coefficients_double *c, double omega, const double *y, double *dy)
{
    fst_pull_double p;
    double jacobian[FST_STATE_SIZE][FST_STATE_SIZE];
    fst_rhs_double(c, omega, y, dy, &p);
    fst_jacobian_double(c, omega, y, jacobian);
    for (int i = 0; i < FST_STATE_SIZE; ++i) {
        double sum = 0.0;
        for (int k = 0; k < FST_STATE_SIZE; ++k)
            sum += jacobian[i][k] * y[FST_STATE_SIZE + k];
        dy[FST_STATE_SIZE + i] = sum;
    }
}

#include "ode/dop853.inl"

static double dot(const double *a, const double *b, int n)
{
    double sum = 0.0;
    for (int i = 0; i < n; ++i)
        sum += a[i] * b[i];
    return sum;
}

/* Take out of the tangent vector what is no growth across the flow: along |n|, and along the flow itself.
 * Returns its length, and scales it to 1. */
static double project(double *y, const double *flow_direction)
{
    double *tangent = y + FST_STATE_SIZE;
    const double *n = y + FST_NX;
    const double along_n = dot(tangent + FST_NX, n, 3) / dot(n, n, 3);
    for (int i = 0; i < 3; ++i)
        tangent[FST_NX + i] -= along_n * n[i];
    const double speed2 = dot(flow_direction, flow_direction, FST_STATE_SIZE);
    if (speed2 > 0) {
        const double along = dot(tangent, flow_direction, FST_STATE_SIZE) / speed2;
        for (int i = 0; i < FST_STATE_SIZE; ++i)
            tangent[i] -= along * flow_direction[i];
    }
    const double length = sqrt(dot(tangent, tangent, FST_STATE_SIZE));
    for (int i = 0; i < FST_STATE_SIZE; ++i)
        tangent[i] /= length;
    return length;
}

/* Adaptive steps from s->y to the time `duration` later; *h is the step size carried along. */
static fst_status integrate(fst_tangent_step_double *s, double duration, double rtol, const double *atol,
                            double *h, uint64_t *rhs_calls, fst_error *error)
{
    double t = 0.0;
    while (t < duration) {
        const int lands = *h * 1.01 >= duration - t;
        s->h = lands ? duration - t : *h;
        fst_tangent_try_step_double(s);
        *rhs_calls += 12;
        const double e = fst_tangent_step_error_double(s, rtol, atol);
        if (!(e <= 1.0)) {
            *h = s->h * (isfinite(e) ? fst_step_factor_double(e) : 0.1);
            if (!(*h > 1e-12))
                return fst_fail(
                    error, FST_STEP_UNDERFLOW, "Lyapunov exponent",
                    "the step size underflowed while the Lyapunov exponent was computed; try a larger "
                    "run.rtol");
            continue;
        }
        t = lands ? duration : t + s->h;
        (void)fst_renormalise_double(s->end);
        memcpy(s->y, s->end, sizeof s->y);
        tangent_rhs(&s->context, s->omega, s->y, s->k[0]);
        const double proposal = s->h * fst_step_factor_double(e);
        *h = lands && proposal < *h ? *h : proposal;
    }
    return FST_OK;
}

fst_status fst_largest_exponent(const fst_run_state *run, const double state[FST_STATE_SIZE], double duration,
                                double *exponent, double *standard_error, uint64_t *rhs_calls, fst_error *error)
{
    enum { BLOCKS = 22, ALIGNING = 2, PIECES = 16 }; /* the first blocks turn the vector into place */
    fst_tangent_step_double s;
    memset(&s, 0, sizeof s);
    s.context = run->flow->step.context.coefficients;
    s.omega = s.context.omega;
    memcpy(s.y, state, FST_STATE_SIZE * sizeof *state);
    for (int i = 0; i < FST_STATE_SIZE; ++i) /* any direction will do; this one is nothing special */
        s.y[FST_STATE_SIZE + i] = 1.0 / (1.0 + i);
    double atol[STEP_DIM], h = 0.1, sum = 0.0, sum2 = 0.0;
    const double rtol = run->params->run_rtol > 1e-9 ? run->params->run_rtol : 1e-9;
    for (int i = 0; i < STEP_DIM; ++i)
        atol[i] = i < FST_STATE_SIZE ? rtol : 1e-6;
    tangent_rhs(&s.context, s.omega, s.y, s.k[0]);
    (void)project(s.y, s.k[0]);
    const double block = duration / BLOCKS;
    for (int b = 0; b < BLOCKS; ++b) {
        double growth = 0.0;
        for (int piece = 0; piece < PIECES; ++piece) {
            tangent_rhs(&s.context, s.omega, s.y, s.k[0]);
            const fst_status status = integrate(&s, block / PIECES, rtol, atol, &h, rhs_calls, error);
            if (status != FST_OK)
                return status;
            growth += log(project(s.y, s.k[0]));
        }
        if (b >= ALIGNING) {
            sum += growth / block;
            sum2 += (growth / block) * (growth / block);
        }
    }
    const int n = BLOCKS - ALIGNING;
    *exponent = sum / n;
    const double variance = (sum2 - sum * sum / n) / (n - 1);
    *standard_error = variance > 0 ? sqrt(variance / n) : 0.0;
    return FST_OK;
}
