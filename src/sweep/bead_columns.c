/* bead_columns.c - rows of a sweep that are not runs of a bead on the plate: of several beads (outcome, the largest group,
 * powers, counts), of worlds (what fst_world_run() tells), and of the places where a bead floats. */
#include "sweep/bead_columns.h"

#include <math.h>
#include <stddef.h>
#include <stdio.h>
#include <string.h>

#include "base/error.h"
#include "base/watch.h"

/* ------------------------------------------------------------------ columns */

#define OF(field) offsetof(fst_sweep_record, field)
#define BEADS(name, kind, names, unit, field)                                                                  \
    {FST_ROWS_OF_BEADS, name, FST_BEAD_##kind, names, unit, OF(beads.field)},
#define WORLD(name, kind, names, unit, field)                                                                  \
    {FST_ROWS_OF_WORLDS, name, FST_BEAD_##kind, names, unit, OF(field)},
#define FLOATS(name, kind, names, field)                                                                       \
    {FST_ROWS_OF_LEVITATION, name, FST_BEAD_##kind, names, "1", OF(levitation.field)},
#define COUNT(NAME, name, doc) BEADS(name, COUNT, NULL, "1", counts[FST_##NAME])
#define FINAL(name, unit, k) WORLD("final_" name, REAL, NULL, unit, world.final_state[k])
#define SIDE(name, k)                                                                                          \
    FLOATS(name, NAME, FST_WORDS(FST_FLOATINGS), side[k].word)                                                 \
    FLOATS(name "_height_mm", REAL, NULL, side[k].height_mm)                                                   \
    FLOATS(name "_tilt_deg", REAL, NULL, side[k].tilt_deg)                                                     \
    FLOATS(name "_gap_mm", REAL, NULL, side[k].gap_mm)                                                         \
    FLOATS(name "_growth_per_s", REAL, NULL, side[k].growth_per_s)

/* A line a column. */
/* clang-format off */
static const fst_bead_column columns[] = {
    BEADS("outcome", NAME, FST_WORDS(FST_BEADS_OUTCOMES), "1", outcome)
    BEADS("groups", INT, NULL, "1", group_count)
    BEADS("largest_kind", NAME, FST_WORDS(FST_BEAD_GROUPS), "1", largest_kind)
    BEADS("largest_beads", INT, NULL, "1", largest_count)
    BEADS("mean_r", REAL, NULL, "l", mean_r)
    BEADS("centre_rate", REAL, NULL, "gamma", centre_rate)
    BEADS("axis_rate", REAL, NULL, "gamma", axis_rate)
    BEADS("drive_power", REAL, NULL, "l^2 gamma^3", drive_power)
    BEADS("plate_power", REAL, NULL, "l^2 gamma^3", plate_power)
    BEADS("pair_power", REAL, NULL, "l^2 gamma^3", pair_power)
    BEADS("impact_power", REAL, NULL, "l^2 gamma^3", impact_power)
    BEADS("energy_residual", REAL, NULL, "l^2 gamma^2", energy_residual)
    FST_BEAD_EVENT_LIST(COUNT)
    BEADS("periods", REAL, NULL, "1", periods)
    BEADS("method", NAME, FST_WORDS(FST_BEADS_METHODS), "1", method)
    BEADS("rhs_calls", COUNT, NULL, "1", rhs_calls)
    BEADS("steps_accepted", COUNT, NULL, "1", accepted)
    BEADS("steps_rejected", COUNT, NULL, "1", rejected)
    WORLD("carried", INT, NULL, "1", carried)
    WORLD("regime", NAME, FST_WORDS(FST_REGIMES), "1", result.regime)
    WORLD("frame", NAME, FST_WORDS(FST_FRAMES), "1", world.frame)
    WORLD("omega", REAL, NULL, "gamma", result.omega)
    WORLD("frequency_hz", REAL, NULL, "1", result.frequency_hz)
    WORLD("mean_r", REAL, NULL, "l", result.mean_r)
    WORLD("mean_r_error", REAL, NULL, "l", result.mean_r_error)
    WORLD("mean_height", REAL, NULL, "l", world.mean_height)
    WORLD("mean_alpha_dot", REAL, NULL, "gamma", result.mean_alpha_dot)
    WORLD("mean_alpha_dot_error", REAL, NULL, "gamma", result.mean_alpha_dot_error)
    WORLD("mean_load_weights", REAL, NULL, "m g", result.mean_load_weights)
    WORLD("mean_drive_power", REAL, NULL, "l^2 gamma^3", result.mean_drive_power)
    WORLD("mean_friction_power", REAL, NULL, "l^2 gamma^3", result.mean_friction_power)
    WORLD("mean_medium_power", REAL, NULL, "l^2 gamma^3", world.mean_medium_power)
    WORLD("mean_velocity", REAL, NULL, "l gamma", world.mean_velocity)
    WORLD("mean_velocity_error", REAL, NULL, "l gamma", world.mean_velocity_error)
    WORLD("mean_impact_power", REAL, NULL, "l^2 gamma^3", result.mean_impact_power)
    WORLD("energy_residual", REAL, NULL, "1", result.energy_residual)
    WORLD("end_time", REAL, NULL, "1/gamma", result.end_time)
    WORLD("periods", REAL, NULL, "1", result.periods)
    WORLD("window_periods", REAL, NULL, "1", result.window_periods)
    WORLD("rhs_calls", COUNT, NULL, "1", result.rhs_calls)
    WORLD("steps_accepted", COUNT, NULL, "1", result.accepted)
    WORLD("steps_rejected", COUNT, NULL, "1", result.rejected)
    FINAL("X", "l", 0)
    FINAL("Y", "l", 1)
    FINAL("Z", "l", 2)
    FINAL("vX", "l gamma", 3)
    FINAL("vY", "l gamma", 4)
    FINAL("vZ", "l gamma", 5)
    FINAL("nX", "1", 6)
    FINAL("nY", "1", 7)
    FINAL("nZ", "1", 8)
    FINAL("WX", "gamma", 9)
    FINAL("WY", "gamma", 10)
    FINAL("WZ", "gamma", 11)
    FLOATS("places", INT, NULL, places)
    SIDE("below", 0)
    SIDE("above", 1)
};
/* clang-format on */

const fst_bead_column *fst_bead_column_at(fst_row_kind kind, int index)
{
    for (size_t i = 0; i < sizeof columns / sizeof *columns; ++i)
        if (columns[i].rows == kind && index-- == 0)
            return &columns[i];
    return NULL;
}

int fst_bead_column_count(fst_row_kind kind)
{
    int count = 0;
    while (fst_bead_column_at(kind, count))
        ++count;
    return count;
}

const fst_bead_column *fst_bead_column_find(const char *name)
{
    for (size_t i = 0; i < sizeof columns / sizeof *columns; ++i)
        if (strcmp(columns[i].name, name) == 0)
            return &columns[i];
    return NULL;
}

/* ------------------------------------------------------------------ rows */

static fst_beads_row beads_row_of(const fst_beads_result *result)
{
    const fst_bead_group *largest = result->groups;
    for (int g = 1; g < result->group_count; ++g)
        if (result->groups[g].count > largest->count)
            largest = &result->groups[g];
    fst_beads_row row = {.outcome = (int)result->outcome,
                         .method = (int)result->method,
                         .group_count = result->group_count,
                         .mean_r = NAN,
                         .centre_rate = NAN,
                         .axis_rate = NAN,
                         .drive_power = result->drive_power,
                         .plate_power = result->plate_power,
                         .pair_power = result->pair_power,
                         .impact_power = result->impact_power,
                         .energy_residual = result->energy_residual,
                         .periods = result->periods,
                         .rhs_calls = (int64_t)result->rhs_calls,
                         .accepted = (int64_t)result->accepted,
                         .rejected = (int64_t)result->rejected};
    if (result->group_count) { /* else all beads are gone */
        row.largest_kind = (int)largest->kind;
        row.largest_count = largest->count;
        row.mean_r = largest->mean_r;
        row.centre_rate = largest->centre_rate;
        row.axis_rate = largest->axis_rate;
    }
    memcpy(row.counts, result->counts, sizeof row.counts);
    return row;
}

static fst_status beads_row(const fst_params *params, const fst_progress *progress, fst_sweep_record *record,
                            fst_error *error)
{
    fst_beads_result result;
    fst_beads_options options = fst_default_beads_options();
    options.progress = progress;
    const fst_status status = fst_beads_run_scene(params, &options, &result, error);
    if (status == FST_OK)
        record->beads = beads_row_of(&result);
    (void)snprintf(record->result.reason, sizeof record->result.reason, "%s", result.reason);
    fst_beads_free(&result);
    return status;
}

/* A point without a world is told by fst_run(), as `festoon run` tells it: its state has no height. */
static fst_status plate_row(const fst_params *params, const double *start, const fst_progress *progress,
                            fst_sweep_record *record, fst_error *error)
{
    double state[FST_STATE_SIZE];
    static const int places[FST_STATE_SIZE] = {0, 1, 3, 4, 6, 7, 8, 9, 10, 11};
    fst_run_options options = fst_default_run_options();
    fst_world_row *world = &record->world;
    options.progress = progress;
    *world = (fst_world_row){FST_FRAME_TURNING, NAN, NAN, NAN, NAN, {0}};
    for (int k = 0; k < FST_STATE_SIZE && start; ++k)
        state[k] = start[places[k]];
    options.start = start ? state : NULL;
    const fst_status status = fst_run(params, &options, &record->result, error);
    for (int k = 0; k < FST_STATE_SIZE; ++k)
        world->final_state[places[k]] = record->result.final_state[k];
    world->final_state[2] = world->final_state[5] = NAN;
    return status;
}

/* The length of a wave that is all there is over a flat plate: to go on by it changes nothing.  Else 0. */
static double wave_length_alone(const fst_params *p)
{
    const int alone = p->drive_waveform == FST_WAVEFORM_WAVE && p->plate_shape == FST_PLATE_FLAT &&
                      p->coil_count == 0 && p->magnet_part_count == 0;
    return alone ? p->wave_length / p->magnet_half_length : 0.0;
}

static fst_status world_row(const fst_params *params, const double *start, const fst_progress *progress,
                            fst_sweep_record *record, fst_error *error)
{
    double state[FST_BEAD_NUMBERS];
    fst_world_result result;
    fst_beads_options options = fst_default_beads_options();
    options.progress = progress;
    if (start) {
        const double length = wave_length_alone(params);
        options.state = memcpy(state, start, sizeof state);
        state[0] = length > 0 ? remainder(state[0], length) : state[0];
        if (isnan(state[2])) { /* of a point without a world */
            state[2] = params->start_position[2] / params->magnet_half_length;
            state[5] = 0.0;
        }
    }
    const fst_status status = fst_world_run(params, &options, &result, error);
    record->result = result.run;
    record->world = (fst_world_row){.frame = result.frame,
                                    .mean_height = result.mean_height,
                                    .mean_medium_power = result.mean_medium_power,
                                    .mean_velocity = result.mean_velocity,
                                    .mean_velocity_error = result.mean_velocity_error};
    memcpy(record->world.final_state, result.final_state, sizeof result.final_state);
    return status;
}

static fst_status levitation_row(const fst_params *params, const fst_progress *progress,
                                 fst_sweep_record *record, fst_error *error)
{
    fst_levitation_list list;
    const fst_status status = fst_levitation_find(params, progress, &list, error);
    record->levitation.places = (int)list.count;
    for (int side = 0; side < 2 && status == FST_OK; ++side) {
        const fst_levitation *best = fst_levitation_best(params, &list, side);
        record->levitation.side[side].word = (int)fst_levitation_word(best);
        record->levitation.side[side].height_mm = best ? best->height_mm : NAN;
        record->levitation.side[side].tilt_deg = best ? best->tilt_deg : NAN;
        record->levitation.side[side].gap_mm = best ? best->gap_mm : NAN;
        record->levitation.side[side].growth_per_s = best ? best->eigenvalue_re[0] : NAN;
    }
    fst_levitation_free(&list);
    return status;
}

int fst_can_go_on(const fst_sweep_record *record)
{
    const fst_regime regime = record->result.regime;
    return record->status == FST_OK && regime != FST_REGIME_EJECTED && regime != FST_REGIME_LIFTED &&
           regime != FST_REGIME_TOUCHED && regime != FST_REGIME_LOST;
}

static int is_whole(double turns)
{
    return fabs(turns - round(turns)) <= 1e-9 * fabs(turns);
}

static const char CARRY[] = "fst_sweep_options.carry";

/* Whether at the end of a run of this point all that changes with time is as at the start. */
static fst_status check_carried(const fst_params *p, int64_t point, fst_error *error)
{
    const double periods = fst_run_periods(p);
    const int steady = p->drive_waveform == FST_WAVEFORM_STEADY;
    if (!steady && p->drive_waveform != FST_WAVEFORM_OSCILLATING && p->drive_waveform != FST_WAVEFORM_WAVE)
        return fst_fail(error, FST_BAD_INPUT, CARRY,
                        "this drive begins anew with every run, so that no run goes on from another: choose "
                        "drive.waveform steady, oscillating or wave");
    if ((!steady || fst_frame_of_world(p) == FST_FRAME_LABORATORY) && !is_whole(periods))
        return fst_fail(
            error, FST_BAD_INPUT, CARRY,
            "after %.9g periods, at point %lld, the drive is not where a run begins: give run.periods, "
            "a whole number, in place of run.duration",
            periods, (long long)point);
    for (int i = 0; i < p->coil_count; ++i)
        if (p->coils[i].ac != 0 && !is_whole(p->coils[i].frequency * periods / fst_drive_frequency(p)))
            return fst_fail(
                error, FST_BAD_INPUT, CARRY,
                "after %.9g periods of the drive, at point %lld, the current of coils[%d] is not where a "
                "run begins: choose its frequency and run.periods so that it is",
                periods, (long long)point, i);
    return FST_OK;
}

fst_status fst_check_carried_worlds(const fst_grid *grid, const fst_progress *progress, fst_error *error)
{
    static const char *const refused[][2] = {
        {"bead.radius", "where the bead touches the plate"}, {"model.eps", "where the bead touches the plate"},
        {"plate.bowl_radius", "where the bead touches it"},  {"plate.shape", "where the bead touches it"},
        {"wave.length", "the phase at every place"},         {"drive.waveform", "what moves the bead"}};
    enum { ASK = 4096 }; /* points between two questions whether to go on */
    fst_params p;
    fst_status status = FST_OK;
    for (size_t i = 0; i < sizeof refused / sizeof *refused; ++i)
        if (strcmp(fst_grid_key(grid, 0), refused[i][0]) == 0)
            return fst_fail(error, FST_BAD_INPUT, CARRY, "%s changes %s, so a state cannot be carried along it",
                            refused[i][0], refused[i][1]);
    for (int64_t point = 0; point < fst_grid_points(grid) && status == FST_OK; ++point) {
        if (fst_grid_params(grid, point, &p, NULL) == FST_OK && fst_key_of_world(&p))
            status = check_carried(&p, point, error); /* of another point its row will say what is wrong */
        if (status == FST_OK && point % ASK == ASK - 1)
            status = fst_tell(progress, 0.0, NULL, error);
    }
    return status;
}

fst_status fst_own_row(fst_row_kind kind, const fst_params *params, const double *start,
                       const fst_progress *progress, fst_sweep_record *record, fst_error *error)
{
    fst_error why = {FST_OK, "", ""};
    record->status = kind == FST_ROWS_OF_BEADS        ? beads_row(params, progress, record, &why)
                     : kind == FST_ROWS_OF_LEVITATION ? levitation_row(params, progress, record, &why)
                     : fst_key_of_world(params)       ? world_row(params, start, progress, record, &why)
                                                      : plate_row(params, start, progress, record, &why);
    if (record->status != FST_OK)
        (void)snprintf(record->result.reason, sizeof record->result.reason, "%.255s", why.sentence);
    if (record->status != FST_INTERRUPTED)
        return FST_OK;
    *error = why;
    return FST_INTERRUPTED;
}
