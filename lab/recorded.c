/* recorded.c - several beads, or one in a world: a run of them as rows of the motion, and its result.
 *
 * Such a run is computed from its beginning to its end, and its contacts cannot be taken up in the middle.  So a worker
 * records it, and the page shows what is recorded.
 */
#include "lab.h"

static const double FULL = 6.283185307179586476925287;

/* A sample is there: lab_rows() has a row for each bead.  What the page answers other than 0 ends the recording. */
__attribute__((import_module("lab"), import_name("take"))) int lab_take(int beads);

EXPORT(lab_is_recorded) int lab_is_recorded(const lab *l)
{
    return l->params.bead_count > 0 || fst_key_of_world(&l->params) != NULL;
}

EXPORT(lab_bead_count) int lab_bead_count(const lab *l)
{
    return l->params.bead_count ? l->params.bead_count : 1;
}

static fst_status bead_params(lab *l, int bead, fst_params *own)
{
    *own = l->params;
    return l->params.bead_count ? fst_params_of_bead(&l->params, bead, own, &l->error) : FST_OK;
}

static fst_status run(lab *l, const fst_params *params, const fst_beads_options *options)
{
    fst_beads_free(&l->beads);
    return params->bead_count ? fst_beads_run_scene(params, options, &l->beads, &l->error)
                              : fst_world_run(params, options, &l->world, &l->error);
}

/* Whether they can begin a run: one of no length finds out. */
fst_status lab_check_recorded(lab *l)
{
    fst_params shortest = l->params;
    const fst_beads_options usual = fst_default_beads_options();
    shortest.run_periods = 1e-3;
    shortest.run_discard = 0.0;
    shortest.run_duration = NAN;
    if (l->params.bead_count > FST_BEADS_MOST) {
        memset(&l->error, 0, sizeof l->error);
        l->error.code = FST_BAD_INPUT;
        strcpy(l->error.sentence, "the page shows eight beads at most: run more of them with festoon run");
        return FST_BAD_INPUT;
    }
    return run(l, &shortest, &usual);
}

fst_status lab_run_recorded(lab *l, const fst_progress *progress)
{
    fst_beads_options options = fst_default_beads_options();
    options.progress = progress;
    const fst_status status = run(l, &l->params, &options);
    if (status == FST_OK && !l->params.bead_count)
        l->result = l->world.run;
    return status;
}

/* ---------------------------------------------------------------- the recording */

typedef struct recorder {
    lab *l;
    fst_model *models[FST_BEADS_MOST];
    double turns[FST_BEADS_MOST][4], w_before[FST_BEADS_MOST][3], before, omega, plate;
    int count, laboratory;
} recorder;

/* v, turned about the vertical by an angle. */
static void turned(double angle, const double v[3], double out[3])
{
    const double c = cos(angle), s = sin(angle), x = v[0], y = v[1];
    out[0] = c * x - s * y;
    out[1] = s * x + c * y;
    out[2] = v[2];
}

/* What the field does not tell: the moment along r, alpha and z, and on a flat plate the slip. */
static void fill_seen(const recorder *r, int bead, const double turning[FST_BEAD_NUMBERS], double *row)
{
    double state[FST_STATE_SIZE];
    memcpy(state, turning, 2 * sizeof *state);
    memcpy(state + FST_VX, turning + 3, 2 * sizeof *state);
    memcpy(state + FST_NX, turning + 6, 6 * sizeof *state);
    const fst_observation o = fst_observe(r->models[bead], state);
    row[COLUMN_R] = o.r;
    memcpy(row + COLUMN_N_LOCAL, o.n, sizeof o.n);
    row[COLUMN_SPIN] = o.spin;
    if (r->l->params.plate_shape != FST_PLATE_FLAT)
        return;
    memcpy(row + COLUMN_SLIP, o.slip, sizeof o.slip);
    row[COLUMN_SLIP_SIZE] = o.slip_norm;
}

/* The field of everything but the beads, in the laboratory. */
static fst_status fill_field(const recorder *r, double t, const double place[3], double *row)
{
    double b[3], grad[3][3];
    const fst_status status = fst_field_at(
        &r->l->params, t, (const double[3]){place[0], place[1], place[2] + r->plate}, b, grad, &r->l->error);
    memcpy(row + COLUMN_B, b, sizeof b);
    row[COLUMN_FIELD] = sqrt(b[0] * b[0] + b[1] * b[1] + b[2] * b[2]);
    const double *n = row + COLUMN_N, along = n[0] * b[0] + n[1] * b[1] + n[2] * b[2];
    const double share = row[COLUMN_FIELD] > 0 ? along / row[COLUMN_FIELD] : 1;
    row[COLUMN_ANGLE] = acos(share > 1 ? 1 : share < -1 ? -1 : share);
    return status;
}

static void fill_touches(const recorder *r, const fst_beads_sample *sample, int bead, double *row)
{
    const double gravity = fabs(fst_model_groups(r->models[bead]).gravity);
    for (int k = 0; k < sample->touch_count; ++k) {
        const int *two = sample->touches[k].beads;
        if (two[1] < 0 && two[0] == bead)
            row[COLUMN_LOAD] = sample->touches[k].force / (gravity > 0 ? gravity : 1);
        else if (two[1] >= 0 && (two[0] == bead || two[1] == bead))
            row[COLUMN_TOUCHES] += 1 << (two[0] == bead ? two[1] : two[0]);
    }
}

static fst_status fill_row(recorder *r, const fst_beads_sample *sample, int bead, double *row)
{
    const double *given = sample->states + FST_BEAD_NUMBERS * bead;
    const double angle = FULL * (sample->drive_turns - floor(sample->drive_turns)), alpha = row[COLUMN_ALPHA];
    double lab_state[FST_BEAD_NUMBERS], turning[FST_BEAD_NUMBERS], by[3];
    for (int v = 0; v < FST_BEAD_NUMBERS; v += 3) {
        turned(r->laboratory ? 0.0 : angle, given + v, lab_state + v);
        turned(r->laboratory ? -angle : 0.0, given + v, turning + v);
    }
    memset(row, 0, COLUMNS * sizeof *row);
    const fst_groups g = fst_model_groups(r->models[0]);
    row[COLUMN_TIME] = sample->t * g.time_unit;
    row[COLUMN_TURNS] = sample->t * r->omega / FULL;
    row[COLUMN_MAGNET] = sample->drive_turns;
    row[COLUMN_OMEGA] = r->omega;
    memcpy(row + COLUMN_X, lab_state, 2 * sizeof *row);
    row[COLUMN_Z] = lab_state[2] - (r->plate > 0 ? 0.0 : r->l->params.magnet_depth / g.length_unit);
    row[COLUMN_ALPHA] = alpha + remainder(atan2(lab_state[1], lab_state[0]) - alpha, FULL);
    row[COLUMN_PHI] = row[COLUMN_ALPHA] - FULL * sample->drive_turns;
    memcpy(row + COLUMN_N, lab_state + 6, 3 * sizeof *row);
    row[COLUMN_SPEED] = sqrt(given[3] * given[3] + given[4] * given[4] + given[5] * given[5]);
    fill_seen(r, bead, turning, row);
    fill_touches(r, sample, bead, row);
    for (int i = 0; i < 3; ++i)
        by[i] = 0.5 * (lab_state[9 + i] + r->w_before[bead][i]) * (sample->t - r->before);
    memcpy(r->w_before[bead], lab_state + 9, sizeof r->w_before[bead]);
    lab_turn(r->turns[bead], by, row + COLUMN_N);
    memcpy(row + COLUMN_TURN, r->turns[bead], sizeof r->turns[bead]);
    return fill_field(r, sample->t, lab_state, row);
}

static fst_status take(void *user, const fst_beads_sample *sample, fst_error *error)
{
    recorder *r = user;
    fst_status status = FST_OK;
    for (int bead = 0; bead < r->count && status == FST_OK; ++bead)
        status = fill_row(r, sample, bead, r->l->rows[bead]);
    r->before = sample->t;
    if (status == FST_OK && lab_take(r->count) != 0) {
        error->code = FST_INTERRUPTED;
        status = FST_INTERRUPTED;
    }
    return status;
}

static fst_status begin(lab *l, recorder *r)
{
    fst_params own;
    fst_status status = FST_OK;
    *r = (recorder){.l = l, .count = lab_bead_count(l)};
    memset(l->rows, 0, sizeof *l->rows * FST_BEADS_MOST);
    for (int bead = 0; bead < r->count && status == FST_OK; ++bead) {
        status = bead_params(l, bead, &own);
        if (status == FST_OK)
            status = fst_field_model_new(&own, NAN, &r->models[bead], &l->error);
        r->turns[bead][3] = 1.0;
    }
    if (status != FST_OK)
        return status;
    const fst_groups g = fst_model_groups(r->models[0]);
    r->omega = g.omega;
    r->plate = l->params.plate_shape == FST_PLATE_NONE ? 0.0 : g.h - g.eps;
    r->laboratory = fst_frame_of_world(&l->params) == FST_FRAME_LABORATORY;
    return FST_OK;
}

static int end(recorder *r, fst_status status)
{
    for (int bead = 0; bead < r->count; ++bead)
        fst_model_free(r->models[bead]);
    return (int)status;
}

/* Record the run: lab_take() hears of every sample.  Returns a status, FST_INTERRUPTED where it ended the recording. */
EXPORT(lab_record) int lab_record(lab *l)
{
    recorder r;
    fst_beads_options options = fst_default_beads_options();
    fst_status status = begin(l, &r);
    options.sample = take;
    options.user = &r;
    if (status == FST_OK)
        status = run(l, &l->params, &options);
    return end(&r, status);
}

/* Record what a file holds: `count` samples of a time (1/gamma), turns of the magnet, and twelve numbers of each bead in
 * the frame of the scene's run.  One bead on a plate, of which the page computes the motion itself, is taken too.  Loads
 * and contacts are left 0. */
EXPORT(lab_replay) int lab_replay(lab *l, const double *samples, int count)
{
    recorder r;
    fst_status status = begin(l, &r);
    for (int i = 0; i < count && status == FST_OK; ++i) {
        const double *own = samples + (size_t)i * (size_t)(2 + FST_BEAD_NUMBERS * r.count);
        const fst_beads_sample sample = {
            .t = own[0], .drive_turns = own[1], .count = r.count, .states = own + 2};
        status = take(&r, &sample, &l->error);
    }
    return end(&r, status);
}

/* The radius of a bead, l. */
EXPORT(lab_radius) double lab_radius(lab *l, int bead)
{
    fst_params own;
    return bead_params(l, bead, &own) != FST_OK ? 0.0
           : isnan(own.model_eps)               ? own.bead_radius / own.magnet_half_length
                                                : own.model_eps;
}

/* ---------------------------------------------------------------- the result */

/* Of a world: its frame; then final_time, the end on the laboratory's axes, scaled and in SI, and in its frame,
 * mean_height, mean_medium_power and mean_velocity. */
EXPORT(lab_world_frame) const char *lab_world_frame(const lab *l)
{
    return l->world.frame == FST_FRAME_LABORATORY ? "laboratory" : "turning";
}

EXPORT(lab_world_numbers) const double *lab_world_numbers(lab *l)
{
    double *out = l->rows[0];
    out[0] = l->world.final_time;
    memcpy(out + 1, l->world.final_lab, sizeof l->world.final_lab);
    memcpy(out + 13, l->world.final_lab_si, sizeof l->world.final_lab_si);
    memcpy(out + 25, l->world.final_state, sizeof l->world.final_state);
    out[37] = l->world.mean_height;
    out[38] = l->world.mean_medium_power;
    out[39] = l->world.mean_velocity;
    return out;
}

/* Of several: 0 the sentence, 1 the outcome, 2 its reason; from 3 on the regimes of the beads; from 20 on the kinds of
 * the groups. */
EXPORT(lab_beads_text) const char *lab_beads_text(lab *l, int which)
{
    const fst_beads_result *b = &l->beads;
    if (which == 0) {
        fst_beads_sentence(b, l->text, sizeof l->text);
        return l->text;
    }
    return which == 1    ? fst_beads_outcome_name(b->outcome)
           : which == 2  ? b->reason
           : which >= 20 ? fst_bead_group_name(b->groups[which - 20].kind)
                         : fst_regime_name(b->beads[which - 3].regime);
}

EXPORT(lab_event_name) const char *lab_event_name(int kind)
{
    return kind < FST_BEAD_EVENTS ? fst_bead_event_name((fst_bead_event_kind)kind) : "";
}

/* count, groups, contacts; omega, periods, powers of drive, plate, pairs and impacts, energy_residual, restitution; then
 * the counts of events; of each bead mean_r, mean_alpha_dot, mean_load_weights, ejected_at and the end; of each group the count, mean_r, centre_rate,
 * axis_rate and the members; of each contact a, b (-1: the plate) and the force. */
EXPORT(lab_beads_numbers) const double *lab_beads_numbers(lab *l)
{
    const fst_beads_result *b = &l->beads;
    const double first[] = {b->count,        b->group_count,     b->touch_count, b->omega,
                            b->periods,      b->drive_power,     b->plate_power, b->pair_power,
                            b->impact_power, b->energy_residual, b->restitution};
    double *out = l->rows[0];
    memcpy(out, first, sizeof first);
    out += sizeof first / sizeof *first;
    for (int i = 0; i < FST_BEAD_EVENTS; ++i)
        *out++ = (double)b->counts[i];
    for (int i = 0; i < b->count; ++i) {
        const fst_bead_result *bead = &b->beads[i];
        *out++ = bead->mean_r;
        *out++ = bead->mean_alpha_dot;
        *out++ = bead->mean_load_weights;
        *out++ = bead->ejected_at;
        memcpy(out, bead->final_state, sizeof bead->final_state);
        out += FST_BEAD_NUMBERS;
    }
    for (int i = 0; i < b->group_count; ++i) {
        const fst_bead_group *group = &b->groups[i];
        const double numbers[] = {group->count, group->mean_r, group->centre_rate, group->axis_rate};
        memcpy(out, numbers, sizeof numbers);
        out += 4;
        for (int k = 0; k < group->count; ++k)
            *out++ = group->members[k];
    }
    for (int i = 0; i < b->touch_count; ++i) {
        *out++ = b->touches[i].beads[0];
        *out++ = b->touches[i].beads[1];
        *out++ = b->touches[i].force;
    }
    return l->rows[0];
}
