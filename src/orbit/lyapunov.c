/* lyapunov.c - the spectrum of Lyapunov exponents, by the variational equations and repeated orthogonalisation.
 *
 * Nine tangent vectors are carried along with the state (family.c), as many as there are directions.  All of
 * them would turn into the direction that grows fastest; so after each short piece of time they are made
 * orthonormal again, in their order, and their lengths just before show how much they grew:
 *
 *      t_2 |           t_2 /            | t_2
 *          |     -->      /  t_1  -->   |            log of both lengths, summed up: exponents times time
 *          '---- t_1     '------        '---- t_1
 *       orthonormal      carried        orthonormal
 *
 * The first vector then grows at the greatest rate, the first two span areas that grow at the sum of the two
 * greatest, and so on.  A piece is so short that the fastest shrinking direction is not lost in rounding.
 *
 * First the state alone goes on to the end of run.discard, then the vectors turn into place for some drive
 * periods.  The rates and their errors come from growth.c; an error cannot be smaller than what may remain of
 * the turning into place.  Two exponents too close to be separated in the time get wider errors.
 *
 * Under dry friction the vectors follow one flow through its changes of mode (ode/neighbours.c).  In the air two
 * more numbers, height and climb, and their differences are part of the state: there are eleven directions, and the
 * nine vectors show the nine greatest exponents.  A bead that bounces is made orthonormal at each impact, too.
 *
 * The mean divergence of the equations is measured beside them: the exponents must add up to it.  If the bead
 * moves in the turning frame, one exponent belongs to the direction of the flow and must be zero.
 */
#include "orbit/solution.h"

#include <string.h>

#include "base/constants.h"
#include "base/dot.h"
#include "base/error.h"
#include "base/watch.h"
#include "ode/flight.h"
#include "ode/neighbours.h"
#include "study/growth.h"

enum {
    N = FST_TANGENT_SIZE,
    ALIGNING = 20 /* drive periods in which the vectors turn into place */
};
/* Error of the logarithm of a growth that may remain, unseen, from a column's turning into its direction. */
static const double TURNING = 0.1;
/* Difference of two exponents times the time: below, they are a pair. */
static const double UNRESOLVED = 4.0;
static const double SHARED = 3.0; /* what each is off by, in differences seen */
static const double PIECE = 0.5;  /* gamma^-1: the fastest direction shrinks by e^-2 meanwhile */

/* What is left of a column whose direction a contact at rest has taken, in lengths of what it was: rounding. */
static const double LOST = 1e-11;

/* Of the work of a time in which the tangents are carried, a time in which they are not. */
static const double DISCARD_WORK = 0.1;

/* What is carried along. */
typedef struct spectrum {
    fst_setup setup;
    double tolerance;
    double y[FST_STATE_SIZE];
    fst_neighbours bundle; /* its first N are the columns */
    int numbers;           /* of a column */
    fst_model *model;      /* under dry friction: the motion that the columns follow */
    fst_flow *flow;
    double end;          /* of the piece, in the flow's time */
    int lost[N];         /* under dry friction: at least once nothing was left of the column */
    double logarithm[N]; /* by which the columns grew in this piece */
    double sum[N];       /* and since the measurement began */
    fst_growth growth[N], divergence;
    fst_growth_clock clock;
    int flew; /* at least once */
    const fst_progress *progress;
    double passed, whole; /* of the work: the time since the start, and all of it */
} spectrum;

/* Take the part along n out of a tangent vector. */
static void take_out_n(const spectrum *s, double *v)
{
    const double *n = s->y + FST_NX, outward = fst_dot(n, v + FST_NX, 3);
    for (int i = 0; i < 3; ++i)
        v[FST_NX + i] -= outward * n[i];
}

/* The same with the parts along the first columns; what is left has the square of this length. */
static double take_out_columns(const spectrum *s, int columns, double *v)
{
    for (int before = 0; before < columns; ++before) {
        const double along = fst_dot(v, s->bundle.d[before], s->numbers);
        for (int i = 0; i < s->numbers; ++i)
            v[i] -= along * s->bundle.d[before][i];
    }
    return fst_dot(v, v, s->numbers);
}

/* Dry friction: a contact that came to rest has left nothing of column c that the ones before do not have.  Its
 * exponent is minus infinity; any direction across them, of length 1, takes its place. */
static void lose_direction(spectrum *s, int c, double *v)
{
    double square = 0.0;
    s->lost[c] = 1;
    /* Of nine axes, less at most eight columns, one is far enough across. */
    for (int axis = 0; axis < FST_STATE_SIZE && !(square > 0.05); ++axis) {
        memset(v, 0, FST_NUMBERS * sizeof *v);
        v[axis] = 1.0;
        for (int pass = 0; pass < 2; ++pass) {
            take_out_n(s, v);
            square = take_out_columns(s, c, v);
        }
    }
    for (int i = 0; i < s->numbers; ++i)
        v[i] /= sqrt(square);
}

/* Make the columns orthonormal (modified Gram-Schmidt, twice against rounding), and note how they grew. */
static void orthonormalise(spectrum *s)
{
    for (int c = 0; c < N; ++c) {
        double total = 1.0, *v = s->bundle.d[c];
        const double whole = sqrt(fst_dot(v, v, s->numbers));
        take_out_n(s, v); /* rounding along n, where nothing shrinks, would in time overgrow what does */
        for (int pass = 0; pass < 2; ++pass) {
            const double length = sqrt(take_out_columns(s, c, v));
            if (pass == 0 && s->setup.model.world.kinds.dry && !(length > LOST * fmax(1.0, whole))) {
                lose_direction(s, c, v);
                break;
            }
            for (int i = 0; i < s->numbers; ++i)
                v[i] /= length;
            total *= length;
        }
        s->logarithm[c] += log(total);
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

/* On with the state and the columns. */
static fst_status carry(spectrum *s, double piece, fst_error *error)
{
    double tangent[FST_STATE_SIZE][FST_COLUMNS] = {{0.0}};
    for (int i = 0; i < FST_STATE_SIZE; ++i)
        for (int c = 0; c < N; ++c)
            tangent[i][c] = s->bundle.d[c][i];
    const fst_status status = fst_carry(&s->setup, s->tolerance, piece, s->y, tangent, error);
    for (int i = 0; i < FST_STATE_SIZE; ++i)
        for (int c = 0; c < N; ++c)
            s->bundle.d[c][i] = tangent[i][c];
    return status;
}

/* The same under dry friction.  Many impacts within a piece would leave nothing of some columns. */
static fst_status carry_dry(spectrum *s, double piece, fst_error *error)
{
    fst_flow *flow = s->flow;
    s->end += piece;
    while (fst_twofold_difference((fst_twofold){s->end, 0.0}, flow->t) > 0.0) {
        const fst_status status = fst_dry_step(&s->setup, &s->bundle, flow, s->end, error);
        if (status != FST_OK)
            return status;
        memcpy(s->y, flow->step.end, sizeof s->y);
        if (!fst_flight_is_on(flow))
            continue;
        s->flew = 1;
        if (fst_contact_changes(flow))
            orthonormalise(s);
    }
    fst_neighbours_at_equal_times(&s->bundle, flow);
    return FST_OK;
}

/* On for one piece, short enough for the columns to stay apart. */
static fst_status go_on(spectrum *s, double piece, fst_error *error)
{
    fst_status status = fst_tell(s->progress, s->passed / s->whole, NULL, error);
    memset(s->logarithm, 0, sizeof s->logarithm);
    if (status == FST_OK)
        status = s->flow ? carry_dry(s, piece, error) : carry(s, piece, error);
    if (status != FST_OK)
        return status;
    orthonormalise(s);
    s->passed += piece;
    return FST_OK;
}

/* Count `pieces` in a double: a run of 1e9 slow periods has more of them than any integer. */
static fst_status align(spectrum *s, double duration, fst_error *error)
{
    const double pieces = ceil(duration / PIECE);
    fst_status status = FST_OK;
    for (double i = 0.0; i < pieces && status == FST_OK; ++i)
        status = go_on(s, duration / pieces, error);
    memset(s->lost, 0, sizeof s->lost); /* what rested once at the start need not rest again */
    return status;
}

/* On for one piece whose growth counts. */
static fst_status measure_piece(spectrum *s, double piece, fst_error *error)
{
    const double before = divergence_at(s);
    const fst_status status = go_on(s, piece, error);
    if (status != FST_OK)
        return status;
    if (hypot(s->y[FST_X], s->y[FST_Y]) > s->setup.model.groups.map_radius)
        return fst_fail(
            error, FST_NO_CONVERGENCE, "lyapunov",
            "the bead left the disc that the map of magnet.file covers (r = %.6g): the field beyond is not "
            "known",
            s->setup.model.groups.map_radius);
    fst_growth_pass(&s->clock, piece);
    fst_growth_add(&s->divergence, &s->clock, 0.5 * (before + divergence_at(s)) * piece);
    for (int c = 0; c < N; ++c) {
        fst_growth_add(&s->growth[c], &s->clock, s->logarithm[c]);
        s->sum[c] += s->logarithm[c];
    }
    return FST_OK;
}

static void start_tangents(spectrum *s)
{
    double basis[FST_STATE_SIZE][N];
    fst_tangent_basis(s->y, basis);
    /* A fixed mixture of the axes: along them some columns would keep out of some directions for ever. */
    for (int c = 0; c < N; ++c)
        for (int j = 0; j < N; ++j)
            for (int i = 0; i < FST_STATE_SIZE; ++i)
                s->bundle.d[c][i] += basis[i][j] * ((j == c ? 1.0 : 0.0) + 0.3 * sin(1.0 + 7.0 * c + 3.0 * j));
    if (s->flow)
        fst_neighbours_start(&s->bundle, s->flow);
    orthonormalise(s);
}

/* Put the exponents in order, the greatest first; columns of one pair may come out either way round. */
static void conclude(const spectrum *s, fst_lyapunov *out)
{
    for (int c = 0; c < N; ++c) {
        fst_growth_rate rate = fst_growth_conclude(&s->growth[c]);
        if (s->lost[c])
            rate = (fst_growth_rate){.value = -INFINITY, .error = 0.0};
        int place = c;
        for (; place > 0 && out->exponents[place - 1] < rate.value; --place) {
            out->exponents[place] = out->exponents[place - 1];
            out->errors[place] = out->errors[place - 1];
        }
        out->exponents[place] = rate.value;
        out->errors[place] = fmax(rate.error, TURNING / s->clock.duration);
    }
}

/* Two directions that shrink at nearly the same rate separate only after the time 1/(difference).
 * Before, their columns share the two rates in some proportion, the same in every part of the time:
 * each is off by a part of the true difference, of which the seen one is a part too. */
static void widen_pairs(fst_lyapunov *out)
{
    double widened[N];
    for (int c = 0; c < N; ++c) {
        widened[c] = out->errors[c];
        for (int other = c - 1; other <= c + 1; other += 2) {
            if (other < 0 || other >= N)
                continue;
            const double gap = fabs(out->exponents[c] - out->exponents[other]);
            if (gap * out->time < UNRESOLVED)
                widened[c] = fmax(widened[c], fmin(SHARED * gap, 1.0 / out->time));
        }
    }
    memcpy(out->errors, widened, sizeof widened);
}

/* Whether every sign is decided.  One exponent belongs to the flow direction and is zero: the one nearest to it
 * is taken for it. */
static void judge(fst_lyapunov *out, double speed)
{
    out->error = 0.0;
    for (int c = 0; c < N; ++c)
        out->error = fmax(out->error, out->errors[c]);
    out->flow_direction = -1;
    for (int c = 0; c < N && speed > 1e-6; ++c)
        if (out->flow_direction < 0 || fabs(out->exponents[c]) < fabs(out->exponents[out->flow_direction]))
            out->flow_direction = c;
    out->converged = out->error < 0.05;
    for (int c = 0; c < N; ++c) {
        const double size = fabs(out->exponents[c]), error = fmax(out->errors[c], 1e-9);
        /* A neutral direction may grow like the time: by its logarithm, which is not an exponent. */
        const int grows = out->exponents[c] > 0 && size * out->time < 2.0 * log(1.0 + out->time);
        const int decided = size > 4.0 * error && !grows;
        if (c == out->flow_direction ? size > fmax(4.0 * error, 1e-3) : !decided)
            out->converged = 0;
    }
}

static fst_status measure(spectrum *s, double duration, double period, fst_lyapunov *out, fst_error *error)
{
    const double pieces = ceil(duration / FST_LYAPUNOV_TRACE / PIECE);
    const double piece = duration / FST_LYAPUNOV_TRACE / pieces;
    fst_status status = align(s, ALIGNING * period, error);
    s->clock.duration = duration;
    for (int row = 0; row < FST_LYAPUNOV_TRACE && status == FST_OK; ++row) {
        for (double i = 0.0; i < pieces && status == FST_OK; ++i)
            status = measure_piece(s, piece, error);
        out->trace_count = row + 1;
        out->trace_time[row] = s->clock.passed;
        for (int c = 0; c < N; ++c)
            out->trace[row][c] = s->lost[c] ? -INFINITY : s->sum[c] / s->clock.passed;
    }
    if (status != FST_OK)
        return status;
    double speed = 0.0, rate[FST_STATE_SIZE];
    fst_rhs(&s->setup.model, s->y, rate);
    for (int i = 0; i < FST_STATE_SIZE; ++i)
        speed = fmax(speed, fabs(rate[i]));
    out->time = duration;
    out->divergence = fst_growth_conclude(&s->divergence).value;
    for (int c = 0; c < N; ++c)
        if (s->lost[c]) /* what comes to rest contracts all volumes to nothing */
            out->divergence = -INFINITY;
        else if (s->flew && isfinite(out->divergence)) /* impacts contract them too */
            out->divergence = NAN;
    conclude(s, out);
    widen_pairs(out);
    judge(out, speed);
    return FST_OK;
}

/* Steps to the end of run.discard; the caller hears of progress between them. */
static fst_status steps_until(spectrum *s, fst_flow *flow, double end, fst_error *error)
{
    const fst_twofold until = {end, 0.0};
    double x;
    for (uint64_t steps = 0; fst_twofold_difference(until, flow->t) > 0; ++steps) {
        s->passed = DISCARD_WORK * flow->t.high;
        fst_status status = steps % 64 == 0 ? fst_tell(s->progress, s->passed / s->whole, NULL, error) : FST_OK;
        if (status == FST_OK)
            status = fst_flow_step(flow, end, error);
        if (status != FST_OK)
            return status;
        if (fst_flow_first_negative(flow, fst_edge_function, 0.0, &x))
            return fst_fail(
                error, FST_NO_CONVERGENCE, "lyapunov",
                "the bead passed the plate's edge (r = %.6g) during the discard: there is no motion to measure",
                s->setup.model.groups.plate_radius);
    }
    s->passed = DISCARD_WORK * end;
    return FST_OK;
}

static void free_motion(spectrum *s)
{
    fst_flow_free(s->flow);
    fst_model_free(s->model);
    s->flow = NULL;
    s->model = NULL;
}

/* What is left out: from the start to the end of run.discard.  Under dry friction the motion goes on from there. */
static fst_status discard(spectrum *s, const fst_family *family, double duration, fst_error *error)
{
    double start[FST_STATE_SIZE];
    fst_status status = fst_start_state(&family->params, &s->setup.model, start, error);
    if (status == FST_OK)
        status = fst_solution_flow(family, 0.0, start, s->tolerance, &s->model, &s->flow, error);
    if (status != FST_OK)
        return status;
    status = steps_until(s, s->flow, duration, error);
    memcpy(s->y, fst_flow_get(s->flow).state, sizeof s->y);
    s->end = duration;
    if (!s->setup.model.world.kinds.dry)
        free_motion(s);
    return status;
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
    s.tolerance = fmax(params->run_rtol, FST_DEFAULT_RTOL);
    s.progress = progress;
    fst_status status = fst_family_setup(&family, 0.0, &s.setup, error);
    if (status != FST_OK)
        return status;
    const double period = fst_drive_period_double(s.setup.model.groups.omega);
    const double discarded = fst_run_discard(params), measured = fst_run_periods(params) - discarded;
    s.whole = (DISCARD_WORK * discarded + ALIGNING + measured) * period;
    s.bundle.count = N;
    s.bundle.parameter = -1;
    s.numbers = s.setup.model.world.kinds.dry ? FST_NUMBERS : FST_STATE_SIZE;
    status = discard(&s, &family, discarded * period, error);
    if (status == FST_OK) {
        start_tangents(&s);
        status = measure(&s, measured * period, period, out, error);
    }
    free_motion(&s);
    return status;
}
