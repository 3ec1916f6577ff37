/* family.c - setups that differ in one parameter, and tangent vectors carried along by the flow.
 *
 * Whatever is followed over a parameter p is a family: the same scene, with another value in one field.  A
 * setup is one member: a model, and, unless p is the drive's rate, whose derivative is known exactly, the
 * worlds of two neighbours, from which the derivative of the equations by p is taken as a difference.
 *
 * Newton's method and multipliers need to know how the end y(T) of a motion changes with its start and with p.
 * A bundle carries that along with the state: ten tangent vectors ("columns") that obey the equations
 * linearised about the moving state,
 *
 *       y' = f(y, p)                     start                          end
 *       t' = J(y) t                        y *------------------------->* y(T)
 *       s' = J(y) s + f_p                    |                           \
 *                                        t_i v                            v t_i(T)
 *
 *       t_i(T): how the end moves when the start moves along t_i
 *
 * Nine columns t begin as a basis of the directions in which a state can move (|n| = 1 leaves nine of ten); the
 * tenth, s, begins as zero and gathers what a change of p does on the way.  State and columns are one system of
 * 110 numbers, stepped by the same method as a run, with step sizes that keep the state exact first and the
 * columns less.
 */
#include "orbit/family.h"

#include <stdio.h>
#include <string.h>

#include "base/error.h"
#include "model/modes.h"
#include "model/worlds.h"
#include "model/tangent.inl"
#include "ode/flow.h"

/* ------------------------------------------------------------------ the state with its tangents */

/* What a try of a step costs, in evaluations of the equations alone: twelve stages, each with the changes of
 * all columns. */
enum { TRY_WORK = 50 };
static const double FIRST_SIZE = 0.1; /* of a step; the controller mends it within a few */

typedef struct bundle_context {
    const fst_setup *setup;
} bundle_context;

static void bundle_rhs(const bundle_context *context, const double *y, double *dy);

#define STEP_DIM FST_BUNDLE_SIZE
#define STEP_NAME(name) fst_bundle_##name##_double
#define STEP_CONTEXT bundle_context
#define STEP_RHS(context, drive, y, dy) ((void)(drive), bundle_rhs(context, y, dy))

#include "ode/dop853.inl"

/* The field at the place serves all columns. */
static void bundle_rhs(const bundle_context *context, const double *y, double *dy)
{
    const fst_setup *setup = context->setup;
    const fst_world_double *c = &setup->model.world;
    const double *columns = y + FST_STATE_SIZE;
    double *changes = dy + FST_STATE_SIZE;
    double tangent[FST_STATE_SIZE], change[FST_STATE_SIZE], by[FST_STATE_SIZE] = {0};
    fst_linear_double linear;
    fst_linearise_double(c, NULL, c->omega, y, &linear,
                         dy); /* of laws without modes: fst_dry_carry() has others */
    if (setup->differs)
        fst_setup_by_parameter(setup, y, by);
    for (int column = 0; column < FST_COLUMNS; ++column) {
        for (int i = 0; i < FST_STATE_SIZE; ++i)
            tangent[i] = columns[i * FST_COLUMNS + column];
        fst_change_along_double(c, c->omega, y, &linear, tangent, change);
        for (int i = 0; i < FST_STATE_SIZE; ++i)
            changes[i * FST_COLUMNS + column] = change[i];
    }
    for (int i = 0; i < FST_STATE_SIZE; ++i)
        changes[i * FST_COLUMNS + FST_COLUMNS - 1] += by[i];
}

/* A tried step is accepted: its end is the start of the next. */
static void accept_step(fst_bundle_step_double *s)
{
    (void)fst_renormalise_double(s->end);
    memcpy(s->y, s->end, sizeof s->y);
    fst_bundle_begin_double(s);
}

static fst_status carry_failed(double t, const double *y, int finite, fst_error *error)
{
    char where[96];
    (void)snprintf(where, sizeof where, "t = %.6g, X = %.6g, Y = %.6g", t, y[FST_X], y[FST_Y]);
    return fst_fail(error, finite ? FST_STEP_UNDERFLOW : FST_NOT_FINITE, where,
                    "the variational equations could not be integrated beyond %s", where);
}

fst_status fst_carry(const fst_setup *setup, double tolerance, double duration, double y[FST_STATE_SIZE],
                     double tangent[FST_STATE_SIZE][FST_COLUMNS], fst_error *error)
{
    if (setup->model.world.kinds.dry)
        return fst_dry_carry(setup, tolerance, duration, y, tangent, error);
    fst_bundle_step_double s;
    double atol[FST_BUNDLE_SIZE];
    s.context.setup = setup;
    s.omega = setup->model.world.omega;
    s.ramp = 0.0;
    memcpy(s.y, y, FST_STATE_SIZE * sizeof *y);
    memcpy(s.y + FST_STATE_SIZE, tangent, sizeof(double[FST_STATE_SIZE][FST_COLUMNS]));
    /* The error is a mean over all components; the state, a tenth of them, must not hide among the tangents. */
    for (int i = 0; i < FST_BUNDLE_SIZE; ++i)
        atol[i] = i < FST_STATE_SIZE ? 0.3 * tolerance : 10.0 * tolerance;
    fst_bundle_begin_double(&s);
    fst_step_control_double control = fst_begin_control_double(FIRST_SIZE, INFINITY);
    double t = 0.0;
    fst_plan_step_double(&control, REAL_EVERYWHERE, duration);
    while (t < duration) {
        const fst_status status = fst_watch_count(setup->watch, TRY_WORK, error);
        if (status != FST_OK)
            return status;
        s.h = control.size;
        fst_bundle_try_step_double(&s);
        const double e = fst_bundle_step_error_double(&s, 0.3 * tolerance, atol),
                     factor = fst_step_factor_double(e);
        if (!(e <= 1.0)) {
            if (fst_reject_step_double(&control, REAL_EVERYWHERE, e, factor, t) > 0)
                return carry_failed(t, s.y, isfinite(e), error);
            continue;
        }
        t = control.lands > 0 ? duration : t + control.size;
        accept_step(&s);
        fst_accept_step_double(&control, REAL_EVERYWHERE, factor, FST_GROW_AFTER_REJECTION);
        fst_plan_step_double(&control, REAL_EVERYWHERE, duration - t);
    }
    memcpy(y, s.y, FST_STATE_SIZE * sizeof *y);
    memcpy(tangent, s.y + FST_STATE_SIZE, sizeof(double[FST_STATE_SIZE][FST_COLUMNS]));
    return FST_OK;
}

void fst_tangent_basis(const double *y, double basis[FST_STATE_SIZE][FST_TANGENT_SIZE])
{
    static const int along_axis[FST_STATE_SIZE] = {0, 1, 2, 3, -1, -1, -1, 6, 7, 8};
    const double *n = y + FST_NX;
    memset(basis, 0, sizeof(double[FST_STATE_SIZE][FST_TANGENT_SIZE]));
    for (int i = 0; i < FST_STATE_SIZE; ++i)
        if (along_axis[i] >= 0)
            basis[i][along_axis[i]] = 1.0;
    /* u = (the axis least along n) x n, and n x u. */
    int axis = 0;
    for (int i = 1; i < 3; ++i)
        if (fabs(n[i]) < fabs(n[axis]))
            axis = i;
    const int k = (axis + 1) % 3, l = (axis + 2) % 3;
    const double length = sqrt(n[k] * n[k] + n[l] * n[l]);
    double u[3] = {0, 0, 0};
    u[k] = -n[l] / length;
    u[l] = n[k] / length;
    for (int i = 0; i < 3; ++i) {
        basis[FST_NX + i][4] = u[i];
        basis[FST_NX + i][5] = n[(i + 1) % 3] * u[(i + 2) % 3] - n[(i + 2) % 3] * u[(i + 1) % 3];
    }
}

void fst_tangent_part(double basis[FST_STATE_SIZE][FST_TANGENT_SIZE], const double *v, double *part)
{
    for (int j = 0; j < FST_TANGENT_SIZE; ++j) {
        part[j] = 0.0;
        for (int i = 0; i < FST_STATE_SIZE; ++i)
            part[j] += basis[i][j] * v[i];
    }
}

/* ------------------------------------------------------------------ the parameter */

/* The value of a parameter in a scene where it may only follow from others. */
static double value_in(const fst_family *family, const char *key, const fst_groups *groups)
{
    const struct {
        const char *key;
        double value;
    } derived[] = {{"drive.omega", groups->omega}, {"model.eps", groups->eps},
                   {"model.h", groups->h},         {"model.lambda", groups->lambda},
                   {"model.kappa", groups->kappa}, {"bead.a", groups->a},
                   {"bead.b", groups->b}};
    for (size_t i = 0; i < sizeof derived / sizeof *derived; ++i)
        if (strcmp(derived[i].key, key) == 0)
            return derived[i].value;
    return fst_family_value(family);
}

fst_status fst_family_begin(fst_family *family, const fst_params *params, const char *key, fst_error *error)
{
    const fst_status status = key ? fst_check_no_world(params, error) : FST_OK;
    return status == FST_OK ? fst_family_begin_in_world(family, params, key, error) : status;
}

fst_status fst_family_begin_in_world(fst_family *family, const fst_params *params, const char *key,
                                     fst_error *error)
{
    memset(family, 0, sizeof *family);
    family->params = *params;
    family->key = -1;
    family->scale = 1.0;
    fst_family_tighten(family, 1e-13);
    fst_status status = fst_params_settle(&family->params, error);
    if (status != FST_OK)
        return status;
    family->params.run_rtol = family->tolerance; /* a slip that is nothing to a coarse run is one here */
    if (key) {
        family->key = fst_param_find(key);
        const fst_param_info *info = fst_param_at(family->key);
        if (!info || info->kind != FST_KIND_REAL)
            return fst_fail(error, FST_BAD_INPUT, key,
                            "%s is not a parameter with real values: fst_param_at() lists them", key);
        /* Setting it once clears the other forms of the quantity. */
        fst_model *model = NULL;
        status = fst_field_model_new(params, NAN, &model, error);
        if (status != FST_OK)
            return status;
        const fst_groups groups = fst_model_groups(model);
        const double value = value_in(family, key, &groups);
        family->has_s2 = model->has_s2;
        fst_model_free(model);
        if (isfinite(value)) {
            char text[32];
            (void)snprintf(text, sizeof text, "%.17g", value);
            status = fst_params_set(&family->params, key, text, error);
            if (status != FST_OK)
                return status;
        }
    }
    return fst_lapack_load(&family->lapack, error);
}

void fst_family_tighten(fst_family *family, double tolerance)
{
    family->tolerance = tolerance;
    family->residual = fmin(1e-12, fmax(10.0 * tolerance, 1e-13));
    family->location = fmin(1e-13, 0.1 * tolerance);
}

double fst_family_scale(const char *key, double from, double to)
{
    /* the states themselves vary by several times omega */
    return strcmp(key, "drive.omega") == 0 ? 1.0 : fmax(fabs(from), fabs(to));
}

fst_params fst_family_params(const fst_family *family, double value)
{
    fst_params params = family->params;
    if (family->key >= 0)
        memcpy((char *)&params + fst_param_at(family->key)->offset, &value, sizeof value);
    return params;
}

double fst_family_value(const fst_family *family)
{
    double value = 0.0;
    if (family->key >= 0)
        memcpy(&value, (const char *)&family->params + fst_param_at(family->key)->offset, sizeof value);
    return value;
}

/* The family's parameters keep the map of a measured field. */
static fst_status model_at(const fst_family *family, double value, fst_model *out, fst_error *error)
{
    const fst_params params = fst_family_params(family, value);
    const fst_status status = fst_model_fill(&params, NAN, out, error);
    if (status == FST_OK)
        fst_field_map_free(out->map);
    return status;
}

fst_status fst_family_setup(const fst_family *family, double value, fst_setup *setup, fst_error *error)
{
    if (family->made && family->made_at == value) {
        *setup = *family->made;
        return FST_OK;
    }
    memset(setup, 0, sizeof *setup);
    fst_status status = model_at(family, value, &setup->model, error);
    setup->watch = family->watch;
    setup->differs = family->key >= 0;
    if (status != FST_OK || !setup->differs)
        return status;
    const char *key = fst_param_at(family->key)->key;
    if (value != 0.0 && (strcmp(key, "drive.omega") == 0 || strcmp(key, "drive.frequency") == 0)) {
        setup->exact = setup->model.groups.omega / value;
        return FST_OK;
    }
    fst_model below, above;
    const double step = 1e-5 * (fabs(value) > 0 ? fabs(value) : family->scale);
    status = model_at(family, value - step, &below, error);
    if (status == FST_OK)
        status = model_at(family, value + step, &above, error);
    if (status != FST_OK)
        return status;
    setup->below = below.world;
    setup->above = above.world;
    setup->spread = 2.0 * step;
    return FST_OK;
}

void fst_setup_by_parameter(const fst_setup *setup, const double *y, double *by)
{
    memset(by, 0, FST_STATE_SIZE * sizeof *by);
    if (!setup->differs)
        return;
    if (setup->exact != 0.0) {
        fst_rhs_by_omega_double(y, by);
        for (int i = 0; i < FST_STATE_SIZE; ++i)
            by[i] *= setup->exact;
        return;
    }
    const fst_motion_double at = fst_motion_at(&setup->model.world, y, setup->model.params.run_rtol);
    fst_pull_double pull;
    double below[FST_STATE_SIZE];
    fst_rhs_double(&setup->below, &at.modes, setup->below.omega, at.numbers, below, &pull);
    fst_rhs_double(&setup->above, &at.modes, setup->above.omega, at.numbers, by, &pull);
    for (int i = 0; i < FST_STATE_SIZE; ++i)
        by[i] = (by[i] - below[i]) / setup->spread;
}
