/* world_run.c - a run of one bead in three dimensions, told as a run of a bead on the plate is. */
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "base/constants.h"
#include "base/error.h"
#include "model/drive.h"
#include "model/params.h"
#include "model/surroundings.h"
#include "model/worlds.h"

#include <festoon/beads.h>

/* The tolerance over run.rtol: a bead near the axis has small numbers, of which the absolute tolerance would take more
 * than their share, and the balance of energy would show it. */
static const double CLOSER = 0.1;

/* The speed below which a bead rests, and over omega the rate at which it circles. */
static const double AT_REST = 1e-6;

/* Numbers of a run that nothing tells. */
static void begin_result(fst_run_result *run)
{
    memset(run, 0, sizeof *run);
    for (int i = 0; i < fst_result_count(); ++i) {
        const double unknown = NAN;
        memcpy((char *)run + fst_result_at(i)->offset, &unknown, sizeof unknown);
    }
    run->symmetry = FST_SYMMETRY_NONE;
    run->never_slips = -1;
}

/* The place and the vectors on the axes that the magnet had at the time 0. */
static void to_laboratory(const fst_groups *g, const fst_surroundings *around, double time, const double *state,
                          fst_world_result *result)
{
    const fst_drive_double drive = {.omega = g->omega};
    const fst_twofold t = {time, 0.0};
    const double l = g->length_unit, s = g->time_unit, units[4] = {l, l / s, 1.0, 1.0 / s};
    double whole, rest;
    if (around)
        rest = fst_frame_angle(around, time) / FST_TWO_PI;
    else
        fst_drive_turns(&drive, t, &whole, &rest);
    for (int v = 0; v < 4; ++v) {
        fst_drive_to_laboratory(rest, state + 3 * v, result->final_lab + 3 * v);
        for (int k = 0; k < 3; ++k)
            result->final_lab_si[3 * v + k] = units[v] * result->final_lab[3 * v + k];
    }
}

/* Whether anything turns or travels: a scene may have coils, parts that stand still or a uniform field alone. */
static int is_driven(const fst_params *params)
{
    int moving = params->magnet_shape != FST_MAGNET_PARTS;
    for (int i = 0; i < params->magnet_part_count && !moving; ++i)
        moving = params->magnet_parts[i].motion != FST_PART_FIXED;
    return moving || params->drive_waveform == FST_WAVEFORM_WAVE;
}

/* A bead over a plate of whose motion no other word tells: it rests, on the axis too, keeps its side of it, or circles. */
static void tell_undecided(const fst_bead_result *bead, const fst_params *params, const fst_groups *g,
                           fst_run_result *run)
{
    const double *v = bead->final_state + 3, mm = 1e3 * g->length_unit;
    const int stays = !(fabs(bead->mean_alpha_dot) >= AT_REST * g->omega);
    const double speed = fmax(fmax(fabs(v[0]), fabs(v[1])), fabs(v[2]));
    run->regime = bead->regime == FST_REGIME_LOCKED ? FST_REGIME_LOCKED : FST_REGIME_UNDECIDED;
    if (stays)
        (void)snprintf(run->reason, sizeof run->reason,
                       speed < AT_REST ? "the bead rests in the laboratory, %.4g mm from the axis"
                                       : "the bead circles neither way, on average %.4g mm from the axis",
                       bead->mean_r * mm);
    else
        (void)snprintf(
            run->reason, sizeof run->reason,
            !is_driven(params)
                ? "nothing turns with which or against which it could circle; the bead circles at %.4g Hz"
            : params->drive_waveform == FST_WAVEFORM_STEADY
                ? "with the magnet or against it cannot be told yet: run longer; the bead circles at %.4g Hz"
                : "under this drive a motion has no word of its own; the bead circles at %.4g Hz",
            bead->mean_alpha_dot / (FST_TWO_PI * g->time_unit));
}

/* What became of a bead that is gone. */
static const char *way_gone(fst_regime regime, const fst_params *params)
{
    if (regime == FST_REGIME_TOUCHED)
        return params->coil_count > 0 ? "touched the magnet, or the wire of a coil" : "touched the magnet";
    if (regime == FST_REGIME_EJECTED)
        return "passed the plate's edge";
    if (params->drive_waveform != FST_WAVEFORM_WAVE)
        return "was farther from the magnet than plate.radius";
    return params->plate_shape != FST_PLATE_NONE
               ? "had risen by a wave length, drawn up by the sources of the wave above the plate"
               : "had come a wave length nearer to sources of the wave, or farther away than plate.radius";
}

static void give_reason(const fst_beads_result *beads, const fst_params *params, const fst_groups *g,
                        fst_run_result *run)
{
    const fst_bead_result *bead = &beads->beads[0];
    const double mm = 1e3 * g->length_unit, seconds = g->time_unit;
    const double up = g->gravity < 0 ? -bead->mean_height : bead->mean_height;
    const size_t room = sizeof run->reason;
    run->regime = bead->regime;
    if (bead->regime == FST_REGIME_EJECTED || bead->regime == FST_REGIME_TOUCHED ||
        bead->regime == FST_REGIME_LOST)
        (void)snprintf(run->reason, room, "after %.4g s the bead %s", bead->ejected_at * seconds,
                       way_gone(bead->regime, params));
    else if (beads->outcome == FST_BEADS_UNDECIDED) {
        run->regime = FST_REGIME_UNDECIDED;
        (void)snprintf(run->reason, room, "%s", beads->reason);
    } else if (bead->regime == FST_REGIME_LEVITATING)
        (void)snprintf(run->reason, room,
                       up < 0 ? "it stays, on average %.5g mm below the magnet's reference plane"
                              : "it stays, on average %.5g mm over the magnet's reference plane",
                       fabs(up) * mm);
    else if (bead->regime == FST_REGIME_BACKWARD || bead->regime == FST_REGIME_FORWARD)
        (void)snprintf(
            run->reason, room, "it rolls %s the wave, locked to its field from %s, on average at %.5g mm/s",
            bead->regime == FST_REGIME_FORWARD ? "with" : "against",
            bead->regime == FST_REGIME_FORWARD ? "above" : "below", bead->mean_velocity * mm / seconds);
    else if (bead->regime == FST_REGIME_DRIFTING)
        (void)snprintf(run->reason, room,
                       "its velocity is that of no lock: on average %.5g mm/s along the wave",
                       bead->mean_velocity * mm / seconds);
    else if (bead->regime == FST_REGIME_UNDECIDED || isnan(bead->mean_alpha_dot) ||
             (!is_driven(params) &&
              (bead->regime == FST_REGIME_COUNTER_ROTATING || bead->regime == FST_REGIME_COROTATING)))
        tell_undecided(bead, params, g, run);
    else { /* the mean rate of a bead that swings with the magnet is off the magnet's by chance alone */
        const double apart = fabs(beads->omega - bead->mean_alpha_dot);
        const int with = bead->regime == FST_REGIME_LIBRATING && apart <= bead->mean_alpha_dot_error;
        (void)snprintf(run->reason, room, "the bead circles at %.4g of the drive's rate",
                       with ? 1.0 : bead->mean_alpha_dot / beads->omega);
    }
}

static void fill(const fst_params *params, const fst_groups *g, const fst_surroundings *around,
                 const fst_beads_result *beads, fst_world_result *result)
{
    const fst_bead_result *bead = &beads->beads[0];
    fst_run_result *run = &result->run;
    give_reason(beads, params, g, run);
    run->omega = g->omega;
    run->frequency_hz = g->omega / (FST_TWO_PI * g->time_unit);
    run->mean_r = bead->mean_r;
    run->mean_alpha_dot = bead->mean_alpha_dot;
    run->mean_r_error = bead->mean_r_error + params->run_rtol * bead->mean_r;
    run->mean_alpha_dot_error = bead->mean_alpha_dot_error + params->run_rtol * fabs(bead->mean_alpha_dot);
    run->mean_load_weights = bead->mean_load_weights;
    run->mean_friction_power = beads->plate_power;
    run->mean_drive_power = beads->drive_power;
    run->mean_impact_power = beads->impact_power;
    run->energy_residual = beads->energy_residual / beads->energy_scale;
    run->end_time = isnan(bead->ejected_at) ? beads->periods * FST_TWO_PI / g->omega : bead->ejected_at;
    run->periods = run->end_time * g->omega / FST_TWO_PI;
    run->window_periods = isnan(bead->ejected_at) ? beads->periods - fst_run_discard(params) : NAN;
    run->rhs_calls = beads->rhs_calls;
    run->accepted = beads->accepted;
    run->rejected = beads->rejected;
    result->mean_height = bead->mean_height;
    result->mean_medium_power = beads->medium_power;
    result->mean_velocity = bead->mean_velocity;
    result->mean_velocity_error = bead->mean_velocity_error;
    result->final_time = run->end_time;
    memcpy(result->final_state, bead->final_state, sizeof result->final_state);
    result->frame = fst_frame_of_world(params);
    to_laboratory(g, around, run->end_time, bead->final_state, result);
}

fst_status fst_world_run(const fst_params *params, const fst_beads_options *options, fst_world_result *result,
                         fst_error *error)
{
    fst_beads_result beads;
    fst_model *model;
    memset(result, 0, sizeof *result);
    begin_result(&result->run);
    fst_status status = fst_field_model_new(params, NAN, &model, error);
    if (status != FST_OK)
        return status;
    const fst_groups g = fst_model_groups(model);
    fst_surroundings made, *around = fst_key_of_surroundings(&model->params) ? &made : NULL;
    if (around)
        status = fst_make_surroundings(model, around, error);
    fst_model_free(model);
    if (status != FST_OK)
        return status;
    fst_params closer = *params;
    closer.run_rtol = fmax(CLOSER * params->run_rtol, 1e-15);
    status = fst_beads_run(&closer, 1, options, &beads, error);
    if (status != FST_OK)
        return status;
    fill(params, &g, around, &beads, result);
    fst_beads_free(&beads);
    return FST_OK;
}
