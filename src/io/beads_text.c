/* beads_text.c - what a run of several beads tells, as JSON. */
#include "io/beads_text.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

#include <festoon/bead_files.h>

#include "base/constants.h"
#include "io/json.h"

/* ------------------------------------------------------------------ JSON */

/* What JSON gives beside scaled numbers. */
typedef struct page {
    fst_json json;
    int in_si, with_events;
    fst_scales scales;
} page;

/* A number, and with its unit at the end of its key in SI. */
static void put(page *p, const char *key, double value, const char *unit)
{
    fst_json_real(&p->json, key, value);
    if (p->in_si)
        fst_json_in_si(&p->json, key, value, unit, &p->scales);
}

static void put_beads(page *p, const fst_beads_result *result)
{
    fst_json_open(&p->json, "beads", '[');
    for (int i = 0; i < result->count; ++i) {
        const fst_bead_result *bead = &result->beads[i];
        fst_json_open(&p->json, NULL, '{');
        fst_json_text(&p->json, "regime", fst_regime_name(bead->regime));
        put(p, "mean_r", bead->mean_r, "l");
        put(p, "mean_alpha_dot", bead->mean_alpha_dot, "gamma");
        fst_json_real(&p->json, "mean_load_weights", bead->mean_load_weights);
        put(p, "mean_height", bead->mean_height, "l");
        put(p, "ejected_at", bead->ejected_at, "1/gamma");
        fst_json_reals(&p->json, "final_state", bead->final_state, FST_BEAD_NUMBERS);
        if (p->in_si)
            fst_json_state_si(&p->json, "final_state_si", bead->final_state, 3, &p->scales);
        fst_json_close(&p->json);
    }
    fst_json_close(&p->json);
}

static void put_groups(page *p, const fst_beads_result *result)
{
    fst_json_open(&p->json, "groups", '[');
    for (int g = 0; g < result->group_count; ++g) {
        const fst_bead_group *group = &result->groups[g];
        fst_json_open(&p->json, NULL, '{');
        fst_json_text(&p->json, "kind", fst_bead_group_name(group->kind));
        fst_json_open(&p->json, "members", '[');
        for (int k = 0; k < group->count; ++k)
            fst_json_integer(&p->json, NULL, group->members[k]);
        fst_json_close(&p->json);
        put(p, "mean_r", group->mean_r, "l");
        put(p, "centre_rate", group->centre_rate, "gamma");
        put(p, "axis_rate", group->axis_rate, "gamma");
        fst_json_close(&p->json);
    }
    fst_json_close(&p->json);
}

/* Who takes part: the second is null for the plate. */
static void put_two(page *p, const int beads[2])
{
    fst_json_integer(&p->json, "a", beads[0]);
    fst_json_place(&p->json, "b", beads[1]);
}

static void put_contacts(page *p, const fst_beads_result *result)
{
    fst_json_open(&p->json, "contacts", '[');
    for (int k = 0; k < result->touch_count; ++k) {
        fst_json_open(&p->json, NULL, '{');
        put_two(p, result->touches[k].beads);
        put(p, "force", result->touches[k].force, "l gamma^2");
        fst_json_close(&p->json);
    }
    fst_json_close(&p->json);
    fst_json_flag(&p->json, "forces_unique", result->forces_unique);
}

static void put_powers(page *p, const fst_beads_result *result)
{
    fst_json_open(&p->json, "powers", '{');
    put(p, "drive", result->drive_power, "l^2 gamma^3");
    put(p, "plate", result->plate_power, "l^2 gamma^3");
    put(p, "pair", result->pair_power, "l^2 gamma^3");
    put(p, "impacts", result->impact_power, "l^2 gamma^3");
    fst_json_close(&p->json);
}

static void put_events(page *p, const fst_beads_result *result)
{
    if (p->with_events)
        fst_json_open(&p->json, "events", '[');
    for (int k = 0; k < result->event_count && p->with_events; ++k) {
        const fst_bead_event *event = &result->events[k];
        fst_json_open(&p->json, NULL, '{');
        put(p, "time", event->time, "1/gamma");
        fst_json_text(&p->json, "kind", fst_bead_event_name(event->kind));
        fst_json_open(&p->json, "beads", '[');
        fst_json_integer(&p->json, NULL, event->beads[0]);
        if (event->beads[1] >= 0)
            fst_json_integer(&p->json, NULL, event->beads[1]);
        fst_json_close(&p->json);
        put(p, "speed", event->speed, "l gamma");
        fst_json_close(&p->json);
    }
    if (p->with_events)
        fst_json_close(&p->json);
    fst_json_open(&p->json, "counts", '{');
    for (int kind = 0; kind < FST_BEAD_EVENTS; ++kind)
        fst_json_integer(&p->json, fst_bead_event_name((fst_bead_event_kind)kind), result->counts[kind]);
    fst_json_close(&p->json);
}

static void put_paradox(page *p, const fst_beads_paradox *paradox)
{
    if (isnan(paradox->time)) {
        fst_json_put(&p->json, "paradox", json_null());
        return;
    }
    fst_json_open(&p->json, "paradox", '{');
    put(p, "time", paradox->time, "1/gamma");
    fst_json_integer(&p->json, "motions", paradox->motions);
    fst_json_open(&p->json, "contacts", '[');
    for (int k = 0; k < paradox->touch_count; ++k) {
        fst_json_open(&p->json, NULL, '{');
        put_two(p, paradox->touches[k]);
        fst_json_close(&p->json);
    }
    fst_json_close(&p->json);
    fst_json_close(&p->json);
}

static void put_result(page *p, const fst_params *scene, const fst_beads_result *result)
{
    char sentence[FST_BEADS_SENTENCE_SIZE];
    fst_beads_sentence(result, sentence, sizeof sentence);
    fst_json_text(&p->json, "outcome", fst_beads_outcome_name(result->outcome));
    fst_json_text(&p->json, "sentence", sentence);
    fst_json_text(&p->json, "reason", result->reason);
    fst_json_real(&p->json, "omega", result->omega);
    fst_json_real(&p->json, "frequency_hz", result->omega * scene->friction_gamma / FST_TWO_PI);
    fst_json_text(&p->json, "dynamics", fst_dynamics_name((fst_dynamics)scene->model_dynamics));
    put_beads(p, result);
    put_groups(p, result);
    put_contacts(p, result);
    put_powers(p, result);
    put(p, "energy_residual", result->energy_residual, "l^2 gamma^2");
    if (p->with_events) /* files keep their keys */
        fst_json_real(&p->json, "relative_energy_residual",
                      result->energy_scale > 0 ? result->energy_residual / result->energy_scale : NAN);
    fst_json_real(&p->json, "restitution", result->restitution);
    put_events(p, result);
    put_paradox(p, &result->paradox);
    fst_json_real(&p->json, "periods", result->periods);
    fst_json_text(&p->json, "method", fst_beads_method_name(result->method));
    fst_json_integer(&p->json, "rhs_calls", (int64_t)result->rhs_calls);
    fst_json_integer(&p->json, "steps_accepted", (int64_t)result->accepted);
    fst_json_integer(&p->json, "steps_rejected", (int64_t)result->rejected);
    if (result->method == FST_BEADS_STEPPING) {
        fst_json_real(&p->json, "steps_per_turn", result->steps_per_turn);
        fst_json_real(&p->json, "solver_residual", result->solver_residual);
        fst_json_real(&p->json, "deepest", result->deepest);
        fst_json_integer(&p->json, "solver_sweeps", (int64_t)result->solver_sweeps);
    }
}

char *fst_beads_json(const fst_params *scene, const fst_beads_result *result, fst_shown_units units)
{
    page p = {fst_json_begin('{'), fst_json_with_si(units), 1, fst_scales_of(scene)};
    put_result(&p, scene, result);
    fst_json_scene(&p.json, scene);
    fst_json_text(&p.json, "version", fst_version());
    return fst_json_end(&p.json, JSON_INDENT(2));
}

char *fst_beads_line(const fst_params *scene, const fst_beads_result *result)
{
    page p = {fst_json_begin('{'), 0, 0,
              fst_scales_of(scene)}; /* an attribute of HDF5 has no room for events */
    put_result(&p, scene, result);
    char *text = fst_json_end(&p.json, JSON_COMPACT);
    if (text)
        text[strlen(text) - 1] = '\0';
    return text;
}
