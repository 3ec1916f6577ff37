/* lab.c - libfestoon as a WebAssembly module: what the page calls, over the public header alone.
 *
 * WebAssembly passes numbers and addresses only, so a text is the address of a UTF-8 string that ends with a
 * zero byte, and a list of numbers is the address of doubles.  A struct `lab` is one bead: its parameters, a
 * motion that is shown, and the result of its last run.  A page, or a worker of it, may have several.
 */
#include "lab.h"

/* ---------------------------------------------------------------- memory, version, tables */

EXPORT(lab_alloc) void *lab_alloc(size_t size)
{
    return malloc(size);
}

EXPORT(lab_release) void lab_release(void *memory)
{
    free(memory);
}

static void forget_flow(lab *l)
{
    fst_flow_free(l->flow);
    fst_model_free(l->model);
    l->flow = NULL;
    l->model = NULL;
}

EXPORT(lab_new) lab *lab_new(void)
{
    lab *l = calloc(1, sizeof *l);
    if (l)
        l->params = fst_default_params();
    return l;
}

EXPORT(lab_free) void lab_free(lab *l)
{
    forget_flow(l);
    fst_beads_free(&l->beads);
    fst_grid_free(l->grid);
    for (int i = 0; i < 2; ++i)
        fst_field_map_free(l->maps[i].map);
    free(l);
}

EXPORT(lab_version) const char *lab_version(void)
{
    return fst_version();
}

EXPORT(lab_results_version) int lab_results_version(void)
{
    return FST_RESULTS_VERSION;
}

EXPORT(lab_param_count) int lab_param_count(void)
{
    return fst_param_count();
}

/* A text of a row of params.def; "" where it has none. */
EXPORT(lab_param_text) const char *lab_param_text(int index, int which)
{
    const fst_param_info *info = fst_param_at(index);
    const char *texts[] = {info->key,
                           info->kind >= FST_KIND_CHOICE ? "" : fst_unit_name(info->unit),
                           info->kind >= FST_KIND_CHOICE ? "" : fst_unit_accepted(info->unit),
                           info->names,
                           info->doc,
                           fst_param_other_form(info->key)};
    return texts[which] ? texts[which] : "";
}

EXPORT(lab_param_number) double lab_param_number(int index, int which)
{
    const fst_param_info *info = fst_param_at(index);
    const double numbers[] = {info->kind, info->initial, info->least, info->greatest};
    return numbers[which];
}

/* The place of a key in the table, the rows of lists included, or -1. */
EXPORT(lab_param_find) int lab_param_find(const char *key)
{
    return fst_param_find(key);
}

EXPORT(lab_result_count) int lab_result_count(void)
{
    return fst_result_count();
}

EXPORT(lab_result_info) const char *lab_result_info(int index, int which)
{
    const fst_result_info *info = fst_result_at(index);
    const char *texts[] = {info->name, info->unit, info->doc};
    return texts[which];
}

/* ---------------------------------------------------------------- parameters */

/* Which of the two texts of the last error: 0 where, 1 the sentence. */
EXPORT(lab_error) const char *lab_error(const lab *l, int which)
{
    return which ? l->error.sentence : l->error.where;
}

EXPORT(lab_reset) void lab_reset(lab *l)
{
    l->params = fst_default_params();
}

/* Keep the parameters as they are now, and bring them back where the scene that was to take their place is bad. */
EXPORT(lab_keep) void lab_keep(lab *l)
{
    l->kept = l->params;
}

EXPORT(lab_undo) void lab_undo(lab *l)
{
    l->params = l->kept;
}

EXPORT(lab_set) int lab_set(lab *l, const char *key, const char *text)
{
    return (int)fst_params_set(&l->params, key, text, &l->error);
}

/* The value as a scene would say it. */
EXPORT(lab_get) const char *lab_get(lab *l, int index)
{
    (void)fst_params_get(&l->params, index, l->text, sizeof l->text);
    return l->text;
}

EXPORT(lab_value) double lab_value(const lab *l, int index)
{
    const fst_param_info *info = fst_param_at(index);
    const char *at = (const char *)&l->params + info->offset;
    double real;
    int integer;
    if (info->kind == FST_KIND_REAL) {
        memcpy(&real, at, sizeof real);
        return real;
    }
    memcpy(&integer, at, sizeof integer);
    return integer;
}

/* The rows that may say something of these parameters: those of the table, and behind them those of lists. */
EXPORT(lab_row_count) int lab_row_count(const lab *l)
{
    return fst_params_row_count(&l->params);
}

/* What a row behind the table belongs to, a coil's with the vectors; src/core.js has the same numbers. */
enum { OF_NOTHING, OF_PART, OF_VECTOR, OF_BEAD };

/* What a row belongs to.  The table has a row for every part and coil that a scene may have; the rows of those that this
 * scene does not have belong to nothing. */
EXPORT(lab_row_of) int lab_row_of(const lab *l, int index)
{
    const int part = fst_param_part(index);
    if (part >= 0)
        return part < l->params.magnet_part_count ? OF_PART : OF_NOTHING;
    if (fst_param_bead(index) >= 0)
        return OF_BEAD;
    return fst_param_coil(index) < l->params.coil_count ? OF_VECTOR : OF_NOTHING;
}

/* Settle what follows from other values, as `festoon run` does, and check all together, the start included. */
EXPORT(lab_check) int lab_check(lab *l)
{
    double state[FST_STATE_SIZE];
    l->params.run_discard = fst_run_discard(&l->params);
    fst_status status = fst_params_check_effects(&l->params, &l->error);
    fst_model *model = NULL;
    if (status == FST_OK)
        status = lab_lend_map(l);
    if (status == FST_OK && lab_is_recorded(l))
        return (int)lab_check_recorded(l);
    if (status == FST_OK)
        status = fst_model_new(&l->params, &model, &l->error);
    if (status == FST_OK)
        status = fst_start_state(&l->params, model, state, &l->error);
    fst_model_free(model);
    return (int)status;
}

/* What contradicts a real bead, or "". */
EXPORT(lab_warning) const char *lab_warning(lab *l)
{
    if (!fst_bead_contradiction(&l->params, l->text, sizeof l->text))
        l->text[0] = '\0';
    return l->text;
}

/* The scaled groups in the order of `festoon run --json`, with the number of lines at the end; NULL: lab_error.
 */
EXPORT(lab_groups) const double *lab_groups(lab *l)
{
    fst_model *model;
    if (fst_field_model_new(&l->params, NAN, &model, &l->error) != FST_OK)
        return NULL;
    const fst_groups g = fst_model_groups(model);
    fst_model_free(model);
    const double numbers[] = {g.eps,         g.inertia,   g.h,     g.lambda,     g.kappa,
                              g.a,           g.b,         g.omega, g.gravity,    g.plate_radius,
                              g.length_unit, g.time_unit, g.mass,  g.field_unit, g.lines};
    memcpy(l->numbers, numbers, sizeof numbers);
    return l->numbers;
}

/* ---------------------------------------------------------------- runs and grids */

static fst_status tell(void *user, double fraction, const char *what, fst_error *error)
{
    (void)user;
    (void)what;
    if (lab_tell(fraction) == 0)
        return FST_OK;
    memset(error, 0, sizeof *error);
    error->code = FST_INTERRUPTED;
    strcpy(error->sentence, "stopped");
    return FST_INTERRUPTED;
}

EXPORT(lab_run) int lab_run(lab *l)
{
    const fst_progress progress = {NULL, tell};
    fst_run_options options = fst_default_run_options();
    options.progress = &progress;
    if (lab_is_recorded(l))
        return (int)lab_run_recorded(l, &progress);
    return (int)fst_run(&l->params, &options, &l->result, &l->error);
}

EXPORT(lab_result) double lab_result(const lab *l, int index)
{
    double value;
    memcpy(&value, (const char *)&l->result + fst_result_at(index)->offset, sizeof value);
    return value;
}

EXPORT(lab_result_text) const char *lab_result_text(const lab *l, int which)
{
    const char *texts[] = {fst_regime_name(l->result.regime), l->result.reason,
                           fst_symmetry_name(l->result.symmetry),
                           fst_dynamics_name((fst_dynamics)l->params.model_dynamics)};
    return texts[which] ? texts[which] : "";
}

/* never_slips, returns, calls of the equations of motion, accepted and rejected steps, then the final state. */
EXPORT(lab_result_rest) const double *lab_result_rest(lab *l)
{
    const fst_run_result *r = &l->result;
    const double numbers[] = {r->never_slips, (double)r->returns, (double)r->rhs_calls, (double)r->accepted,
                              (double)r->rejected};
    memcpy(l->numbers, numbers, sizeof numbers);
    memcpy(l->numbers + 5, r->final_state, sizeof r->final_state);
    return l->numbers;
}

/* A grid along one axis, written as for `festoon sweep --over`.  Returns its points, or minus the status. */
EXPORT(lab_grid) int lab_grid(lab *l, const char *axis)
{
    fst_grid_free(l->grid);
    l->grid = NULL;
    const fst_status status = fst_grid_new(&l->params, &axis, 1, 0, &l->grid, &l->error);
    return status == FST_OK ? (int)fst_grid_points(l->grid) : -(int)status;
}

EXPORT(lab_grid_value) double lab_grid_value(const lab *l, int point)
{
    return fst_grid_value(l->grid, 0, point);
}

/* The parameters become those of a point of the grid. */
EXPORT(lab_grid_take) int lab_grid_take(lab *l, int point)
{
    return (int)fst_grid_params(l->grid, point, &l->params, &l->error);
}

/* ---------------------------------------------------------------- the motion that is shown */

static int begin_flow(lab *l, fst_model *model, const double *state, double ramp)
{
    fst_flow_options options = fst_default_flow_options();
    fst_flow *flow;
    options.rtol = l->params.run_rtol;
    for (int i = 0; i < FST_STATE_SIZE; ++i)
        options.atol[i] = l->params.run_rtol;
    options.ramp = ramp;
    const fst_status status = fst_flow_new(model, &options, state, &flow, &l->error);
    if (status != FST_OK) {
        fst_model_free(model);
        return (int)status;
    }
    forget_flow(l);
    l->model = model;
    l->flow = flow;
    l->before = 0;
    const fst_groups groups = fst_model_groups(model);
    l->time_unit = groups.time_unit;
    l->length_unit = groups.length_unit;
    return FST_OK;
}

/* The shortest turn that brings the bead's axis, which is z of the bead, to n. */
static void put_upright(double turn[4], const double n[3])
{
    const double x = turn[0], y = turn[1], z = turn[2], w = turn[3];
    const double a[3] = {2 * (x * z + w * y), 2 * (y * z - w * x), 1 - 2 * (x * x + y * y)};
    double q[4] = {a[1] * n[2] - a[2] * n[1], a[2] * n[0] - a[0] * n[2], a[0] * n[1] - a[1] * n[0],
                   1 + a[0] * n[0] + a[1] * n[1] + a[2] * n[2]};
    if (q[3] < 1e-9) { /* opposite: half a turn about an axis across */
        const double across[4] = {1 - 2 * (y * y + z * z), 2 * (x * y + w * z), 2 * (x * z - w * y), 0};
        memcpy(q, across, sizeof q);
    }
    const double p[4] = {q[3] * x + q[0] * w + q[1] * z - q[2] * y, q[3] * y - q[0] * z + q[1] * w + q[2] * x,
                         q[3] * z + q[0] * y - q[1] * x + q[2] * w, q[3] * w - q[0] * x - q[1] * y - q[2] * z};
    const double size = sqrt(p[0] * p[0] + p[1] * p[1] + p[2] * p[2] + p[3] * p[3]);
    for (int i = 0; i < 4; ++i)
        turn[i] = p[i] / size;
}

/* The bead turns by the vector `by`, in the laboratory. */
static void turn_by(double turn[4], const double by[3])
{
    const double angle = sqrt(by[0] * by[0] + by[1] * by[1] + by[2] * by[2]);
    const double s = angle > 1e-12 ? sin(angle / 2) / angle : 0.5, w = cos(angle / 2);
    const double q[3] = {s * by[0], s * by[1], s * by[2]};
    const double old[4] = {turn[0], turn[1], turn[2], turn[3]};
    turn[0] = w * old[0] + q[0] * old[3] + q[1] * old[2] - q[2] * old[1];
    turn[1] = w * old[1] - q[0] * old[2] + q[1] * old[3] + q[2] * old[0];
    turn[2] = w * old[2] + q[0] * old[1] - q[1] * old[0] + q[2] * old[3];
    turn[3] = w * old[3] - q[0] * old[0] - q[1] * old[1] - q[2] * old[2];
}

/* The friction force on the bead per mass, in components of the turning frame: what the bead's acceleration has
 * beside the magnetic force.  A permanent moment alone is known so well; for other beads, against the slip. */
static void friction_force(const lab *l, const fst_groups *g, const fst_flow_info *info,
                           const fst_observation *o, double force[2])
{
    const double *y = info->state;
    double rate[FST_STATE_SIZE], b[3], grad[3][3], slip[2];
    fst_slip(l->model, y, slip);
    if (g->material != FST_MATERIAL_HARD || !o->sticks) {
        for (int i = 0; i < 2; ++i)
            force[i] = o->slip_norm > 0 ? -o->friction * slip[i] / o->slip_norm : 0;
        return;
    }
    fst_rhs(l->model, y, rate);
    fst_field(l->model, y[FST_X], y[FST_Y], b, grad);
    const double turning[2] = {-g->omega * y[FST_VY], g->omega * y[FST_VX]};
    for (int i = 0; i < 2; ++i) {
        const double pull = grad[i][0] * y[FST_NX] + grad[i][1] * y[FST_NY] + grad[i][2] * y[FST_NZ];
        force[i] = rate[FST_VX + i] + turning[i] - g->kappa * g->eps * g->eps * pull;
    }
}

static void to_laboratory(const double c, const double s, const double *from, double *to)
{
    to[0] = c * from[0] - s * from[1];
    to[1] = s * from[0] + c * from[1];
}

void lab_turn(double turn[4], const double by[3], const double n[3])
{
    turn_by(turn, by);
    put_upright(turn, n);
}

/* Turn the bead from the row before to this one. */
static void roll_on(lab *l, const fst_flow_info *info, double c, double s, const double n[3])
{
    double w[3] = {0, 0, info->state[FST_WZ]}, by[3];
    to_laboratory(c, s, info->state + FST_WX, w);
    for (int i = 0; i < 3; ++i)
        by[i] = 0.5 * (w[i] + l->w_before[i]) * (info->t - l->before);
    lab_turn(l->turn, by, n);
    memcpy(l->w_before, w, sizeof w);
    l->before = info->t;
}

static void fill_row(lab *l, double *row)
{
    const fst_flow_info info = fst_flow_get(l->flow);
    const fst_groups g = fst_model_groups(l->model);
    const fst_observation o = fst_observe(l->model, info.state);
    const double turns = l->turns + info.drive_turns,
                 rest = 6.283185307179586476925287 * (turns - floor(turns));
    const double c = cos(rest), s = sin(rest), *y = info.state;
    double b[3], grad[3][3], force[2];
    memset(row, 0, COLUMNS * sizeof *row);
    row[COLUMN_TIME] = l->seconds + info.t * l->time_unit;
    row[COLUMN_TURNS] = turns;
    row[COLUMN_OMEGA] = info.omega;
    to_laboratory(c, s, y + FST_X, row + COLUMN_X);
    row[COLUMN_R] = o.r;
    row[COLUMN_PHI] = l->phi + info.bead_angle;
    row[COLUMN_ALPHA] = row[COLUMN_PHI] + 6.283185307179586476925287 * turns;
    to_laboratory(c, s, y + FST_NX, row + COLUMN_N);
    row[COLUMN_N + 2] = y[FST_NZ];
    fst_field(l->model, y[FST_X], y[FST_Y], b, grad);
    to_laboratory(c, s, b, row + COLUMN_B);
    row[COLUMN_B + 2] = b[2];
    memcpy(row + COLUMN_N_LOCAL, o.n, sizeof o.n);
    row[COLUMN_FIELD] = o.b_norm;
    row[COLUMN_ANGLE] = o.angle;
    memcpy(row + COLUMN_SLIP, o.slip, sizeof o.slip);
    row[COLUMN_SLIP_SIZE] = o.slip_norm;
    row[COLUMN_SPIN] = o.spin;
    const double weight = g.gravity > 0 ? g.gravity : 1;
    row[COLUMN_LOAD] = o.load / weight;
    row[COLUMN_ENERGY] = o.energy;
    row[COLUMN_FRICTION] = o.friction / weight;
    row[COLUMN_FRICTION_USE] = o.friction_use;
    row[COLUMN_STICKS] = o.sticks;
    row[COLUMN_SPEED] = sqrt(y[FST_VX] * y[FST_VX] + y[FST_VY] * y[FST_VY]);
    friction_force(l, &g, &info, &o, force);
    to_laboratory(c, s, force, row + COLUMN_FORCE);
    for (int i = 0; i < 2; ++i)
        row[COLUMN_FORCE + i] /= weight;
    roll_on(l, &info, c, s, row + COLUMN_N);
    memcpy(row + COLUMN_TURN, l->turn, sizeof l->turn);
    row[COLUMN_Z] = g.eps;
    row[COLUMN_MAGNET] = turns;
}

/* The motion begins at start.*; `ramp` is the change of omega in a unit of time.  Returns a status. */
EXPORT(lab_start) int lab_start(lab *l, double ramp)
{
    double state[FST_STATE_SIZE];
    fst_model *model;
    fst_status status = fst_model_new(&l->params, &model, &l->error);
    if (status != FST_OK)
        return (int)status;
    status = fst_start_state(&l->params, model, state, &l->error);
    if (status != FST_OK) {
        fst_model_free(model);
        return (int)status;
    }
    const int begun = begin_flow(l, model, state, ramp);
    if (begun != FST_OK)
        return begun;
    l->seconds = l->turns = l->phi = 0;
    memcpy(l->turn, (const double[]){0, 0, 0, 1}, sizeof l->turn);
    memcpy(l->w_before, state + FST_WX, sizeof l->w_before);
    fill_row(l, l->rows[0]);
    return FST_OK;
}

/* The motion goes on from where it is with the parameters of now: the bead keeps its place and its velocities.
 */
EXPORT(lab_change) int lab_change(lab *l, double ramp)
{
    if (!l->flow)
        return lab_start(l, ramp);
    fst_model *model;
    const fst_status status = fst_model_new(&l->params, &model, &l->error);
    if (status != FST_OK)
        return (int)status;
    fst_flow_info info = fst_flow_get(l->flow);
    const fst_groups g = fst_model_groups(model);
    const double length = l->length_unit / g.length_unit, rate = g.time_unit / l->time_unit;
    const double seconds = l->seconds + info.t * l->time_unit;
    for (int i = 0; i < 2; ++i) {
        info.state[FST_X + i] *= length;
        info.state[FST_VX + i] *= length * rate;
    }
    for (int i = 0; i < 3; ++i) {
        info.state[FST_WX + i] *= rate;
        l->w_before[i] *= rate;
    }
    /* Unwrapped, the new flow begins with the angle in its first turn: what it was ahead by stays in `phi`. */
    const double phi = l->phi + info.bead_angle - atan2(info.state[FST_Y], info.state[FST_X]);
    const int begun = begin_flow(l, model, info.state, ramp);
    if (begun == FST_OK) {
        l->seconds = seconds;
        l->turns += info.drive_turns;
        l->phi = phi;
    }
    return begun;
}

/* Go on for `seconds`, in `count` rows.  Returns the number of rows, or minus the status; fewer rows than
 * `count` where the bead left the plate, by lab_stop(). */
EXPORT(lab_go) int lab_go(lab *l, double seconds, int count)
{
    const double from = fst_flow_get(l->flow).t, span = seconds / l->time_unit;
    count = count < 1 ? 1 : count > ROWS ? ROWS : count;
    for (int i = 0; i < count; ++i) {
        fst_stop stop;
        const fst_status status = fst_flow_next(l->flow, from + span * (i + 1) / count,
                                                FST_AT_EDGE | FST_AT_LIFT_OFF, &stop, &l->error);
        if (status != FST_OK)
            return -(int)status;
        fill_row(l, l->rows[i]);
        if (stop != FST_AT_TIME) {
            l->numbers[0] = stop;
            return i + 1;
        }
    }
    l->numbers[0] = FST_AT_TIME;
    return count;
}

/* Why lab_go() ended: FST_AT_TIME, FST_AT_EDGE or FST_AT_LIFT_OFF. */
EXPORT(lab_stop) int lab_stop(const lab *l)
{
    return (int)l->numbers[0];
}

EXPORT(lab_rows) const double *lab_rows(const lab *l)
{
    return l->rows[0];
}

EXPORT(lab_columns) int lab_columns(void)
{
    return COLUMNS;
}

/* A recorded motion takes the place of the one that is shown. */
EXPORT(lab_forget) void lab_forget(lab *l)
{
    forget_flow(l);
}

/* The field at a place of the magnet's frame, for the parameters of the motion; NULL: lab_error. */
EXPORT(lab_field) const double *lab_field(lab *l, double x, double y)
{
    double grad[3][3];
    fst_model *own = NULL;
    if (!l->model && fst_field_model_new(&l->params, NAN, &own, &l->error) != FST_OK)
        return NULL;
    fst_field(own ? own : l->model, x, y, l->numbers, grad);
    fst_model_free(own);
    return l->numbers;
}

/* ---------------------------------------------------------------- for tests: the flow itself */

/* Go on to the next crossing of the section, or to the time `until`.  Returns a status. */
EXPORT(lab_flow_section) int lab_flow_section(lab *l, double until, int section)
{
    fst_stop stop;
    return (int)fst_flow_next(l->flow, until, section ? FST_AT_SECTION : 0, &stop, &l->error);
}

/* The state at which a motion starts, before anything is done with it. */
EXPORT(lab_start_state) const double *lab_start_state(lab *l)
{
    fst_model *model;
    if (fst_model_new(&l->params, &model, &l->error) != FST_OK)
        return NULL;
    const fst_status status = fst_start_state(&l->params, model, l->numbers, &l->error);
    fst_model_free(model);
    return status == FST_OK ? l->numbers : NULL;
}

/* State, time in two parts, step, drift of |n|. */
EXPORT(lab_flow_info) const double *lab_flow_info(lab *l)
{
    const fst_flow_info info = fst_flow_get(l->flow);
    memcpy(l->numbers, info.state, sizeof info.state);
    l->numbers[10] = info.t;
    l->numbers[11] = info.t_low;
    l->numbers[12] = info.step;
    l->numbers[13] = info.norm_drift;
    return l->numbers;
}

/* The Jacobian at the state of the flow: 100 numbers, row by row. */
EXPORT(lab_flow_jacobian) const double *lab_flow_jacobian(lab *l)
{
    fst_jacobian(l->model, fst_flow_get(l->flow).state, (double(*)[FST_STATE_SIZE])l->rows[0], NULL);
    return l->rows[0];
}
