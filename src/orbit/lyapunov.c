/* lyapunov.c - the spectrum of Lyapunov exponents, by the variational equations and repeated orthogonalisation.
 */
#include "orbit/solution.h"

#include <string.h>

#include "base/error.h"

#define TWO_PI 6.283185307179586476925287

enum {
    N = FST_TANGENT_SIZE,
    BLOCKS = 16,
    ALIGNING = 20 /* drive periods in which the vectors turn into place */
};

/* Of the work of a time in which the tangents are carried, a time in which they are not. */
#define DISCARD_WORK 0.1

/* What is carried along. */
typedef struct spectrum {
    fst_setup setup;
    double tolerance;
    double y[FST_STATE_SIZE], tangent[FST_STATE_SIZE][FST_COLUMNS];
    double growth[N];  /* sums of logarithms */
    double divergence; /* integral of the trace of the Jacobian */
    double time;
    const fst_progress *progress;
    double passed, whole; /* of the work: the time since the start, and all of it */
} spectrum;

/* Make the columns orthonormal (modified Gram-Schmidt, twice against rounding), and note how they grew. */
static void orthonormalise(spectrum *s)
{
    const double *n = s->y + FST_NX;
    for (int c = 0; c < N; ++c) {
        double total = 1.0, outward = 0.0;
        /* Rounding along n, where nothing shrinks, would in time overgrow what does. */
        for (int i = 0; i < 3; ++i)
            outward += n[i] * s->tangent[FST_NX + i][c];
        for (int i = 0; i < 3; ++i)
            s->tangent[FST_NX + i][c] -= outward * n[i];
        for (int pass = 0; pass < 2; ++pass) {
            for (int before = 0; before < c; ++before) {
                double along = 0.0;
                for (int i = 0; i < FST_STATE_SIZE; ++i)
                    along += s->tangent[i][c] * s->tangent[i][before];
                for (int i = 0; i < FST_STATE_SIZE; ++i)
                    s->tangent[i][c] -= along * s->tangent[i][before];
            }
            double length = 0.0;
            for (int i = 0; i < FST_STATE_SIZE; ++i)
                length += s->tangent[i][c] * s->tangent[i][c];
            length = sqrt(length);
            for (int i = 0; i < FST_STATE_SIZE; ++i)
                s->tangent[i][c] /= length;
            total *= length;
        }
        s->growth[c] += log(total);
    }
}

/* Trace of the Jacobian in the tangent space. */
static double divergence_at(const spectrum *s)
{
    double jacobian[FST_STATE_SIZE][FST_STATE_SIZE], trace = 0.0;
    fst_jacobian(&s->setup.model, s->y, jacobian, NULL);
    for (int i = 0; i < FST_STATE_SIZE; ++i)
        trace += jacobian[i][i];
    return trace; /* along n the flow neither stretches nor shrinks: |n| is kept */
}

/* On for one span, in pieces short enough for the columns to stay apart. */
static fst_status go_on(spectrum *s, double span, double piece, fst_error *error)
{
    const int pieces = (int)ceil(span / piece);
    for (int i = 0; i < pieces; ++i) {
        const double before = divergence_at(s);
        fst_status status = fst_tell(s->progress, s->passed / s->whole, error);
        if (status == FST_OK)
            status = fst_carry(&s->setup, s->tolerance, span / pieces, s->y, s->tangent, error);
        if (status != FST_OK)
            return status;
        s->divergence += 0.5 * (before + divergence_at(s)) * (span / pieces);
        orthonormalise(s);
        s->passed += span / pieces;
    }
    s->time += span;
    return FST_OK;
}

static void start_tangents(spectrum *s)
{
    double basis[FST_STATE_SIZE][N];
    fst_tangent_basis(s->y, basis);
    memset(s->tangent, 0, sizeof s->tangent);
    /* A fixed mixture of the axes: along them some columns would keep out of some directions for ever. */
    for (int c = 0; c < N; ++c)
        for (int j = 0; j < N; ++j)
            for (int i = 0; i < FST_STATE_SIZE; ++i)
                s->tangent[i][c] += basis[i][j] * ((j == c ? 1.0 : 0.0) + 0.3 * sin(1.0 + 7.0 * c + 3.0 * j));
    orthonormalise(s);
    memset(s->growth, 0, sizeof s->growth);
}

/* Standard errors from the blocks, and whether every sign is decided.  One exponent belongs to the flow
 * direction and is zero: the one nearest to it is taken for it. */
static void judge(fst_lyapunov *out, double block[BLOCKS][FST_EIGENVALUE_COUNT], double speed, double time)
{
    out->error = 0.0;
    for (int c = 0; c < N; ++c) {
        double sum = 0.0, sum2 = 0.0;
        for (int b = 0; b < BLOCKS; ++b)
            sum += block[b][c];
        out->exponents[c] = sum / BLOCKS;
        for (int b = 0; b < BLOCKS; ++b)
            sum2 += (block[b][c] - out->exponents[c]) * (block[b][c] - out->exponents[c]);
        out->errors[c] = sqrt(sum2 / (BLOCKS - 1) / BLOCKS);
        out->error = fmax(out->error, out->errors[c]);
    }
    out->flow_direction = -1;
    for (int c = 0; c < N && speed > 1e-6; ++c)
        if (out->flow_direction < 0 || fabs(out->exponents[c]) < fabs(out->exponents[out->flow_direction]))
            out->flow_direction = c;
    out->converged = out->error < 0.05;
    for (int c = 0; c < N; ++c) {
        const double size = fabs(out->exponents[c]), error = fmax(out->errors[c], 1e-9);
        /* A neutral direction may grow like the time: by its logarithm, which is no exponent. */
        const int grows = out->exponents[c] > 0 && size * time < 2.0 * log(1.0 + time);
        const int decided = size > 4.0 * error && !grows;
        if (c == out->flow_direction ? size > fmax(4.0 * error, 1e-3) : !decided)
            out->converged = 0;
    }
}

static fst_status measure(spectrum *s, double duration, double period, fst_lyapunov *out, fst_error *error)
{
    double block[BLOCKS][FST_EIGENVALUE_COUNT];
    const double piece = 0.5; /* gamma^-1: the fastest direction shrinks by e^-2 meanwhile */
    fst_status status = go_on(s, ALIGNING * period, piece, error);
    memset(s->growth, 0, sizeof s->growth);
    s->divergence = s->time = 0.0;
    for (int b = 0; b < BLOCKS && status == FST_OK; ++b) {
        double before[N];
        memcpy(before, s->growth, sizeof before);
        for (int part = 0; part < FST_LYAPUNOV_TRACE / BLOCKS && status == FST_OK; ++part) {
            status = go_on(s, duration / FST_LYAPUNOV_TRACE, piece, error);
            const int row = out->trace_count++;
            out->trace_time[row] = s->time;
            for (int c = 0; c < N; ++c)
                out->trace[row][c] = s->growth[c] / s->time;
        }
        for (int c = 0; c < N; ++c)
            block[b][c] = (s->growth[c] - before[c]) / (duration / BLOCKS);
    }
    if (status != FST_OK)
        return status;
    double speed = 0.0, rate[FST_STATE_SIZE];
    fst_setup_rhs(&s->setup, s->y, rate);
    for (int i = 0; i < FST_STATE_SIZE; ++i)
        speed = fmax(speed, fabs(rate[i]));
    judge(out, block, speed, s->time);
    out->divergence = s->divergence / s->time;
    out->time = s->time;
    return FST_OK;
}

/* What is left out: from the start to the end of run.discard, in stretches between which the caller is told. */
static fst_status discard(spectrum *s, const fst_family *family, double period, fst_error *error)
{
    const double stretch = 250.0, periods = family->params.run_discard;
    double start[FST_STATE_SIZE];
    fst_model *model = NULL;
    fst_flow *flow = NULL;
    fst_stop stop = FST_STOP_TIME;
    fst_status status = fst_start_state(&family->params, &s->setup.model, start, error);
    if (status == FST_OK)
        status = fst_solution_flow(family, 0.0, start, s->tolerance, &model, &flow, error);
    if (status != FST_OK)
        return status;
    for (double done = 0.0; status == FST_OK && stop == FST_STOP_TIME && done < periods;) {
        done = fmin(done + stretch, periods);
        status = fst_tell(s->progress, s->passed / s->whole, error);
        if (status == FST_OK)
            status = fst_flow_advance(flow, done * period, 1u << FST_STOP_EDGE, &stop, error);
        s->passed = DISCARD_WORK * done * period;
    }
    memcpy(s->y, fst_flow_get(flow).state, sizeof s->y);
    fst_flow_free(flow);
    fst_model_free(model);
    return status == FST_OK && stop == FST_STOP_EDGE
               ? fst_fail(
                     error, FST_NO_CONVERGENCE, "lyapunov",
                     "the bead passed the plate's edge (r = %.6g) during the discard: there is no motion to "
                     "measure",
                     s->setup.model.groups.plate_radius)
               : status;
}

fst_status fst_lyapunov_find(const fst_params *params, const fst_progress *progress, fst_lyapunov *out,
                             fst_error *error)
{
    memset(out, 0, sizeof *out);
    fst_family family;
    spectrum s;
    memset(&s, 0, sizeof s);
    memset(&family, 0, sizeof family);
    family.params = *params;
    family.key = -1;
    s.tolerance = fmax(params->run_rtol, 1e-10);
    s.progress = progress;
    fst_status status = fst_family_setup(&family, 0.0, &s.setup, error);
    if (status != FST_OK)
        return status;
    const double period = TWO_PI / s.setup.model.groups.omega;
    const double measured = params->run_periods - params->run_discard;
    s.whole = (DISCARD_WORK * params->run_discard + ALIGNING + measured) * period;
    status = discard(&s, &family, period, error);
    if (status != FST_OK)
        return status;
    start_tangents(&s);
    return measure(&s, measured * period, period, out, error);
}
