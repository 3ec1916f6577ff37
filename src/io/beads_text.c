/* beads_text.c - what a run of several beads tells: a sentence, and JSON. */
#include "io/beads_text.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

#include <festoon/bead_files.h>

#include "base/constants.h"
#include "io/json.h"

static const double SAME_RATE = 0.02; /* rates that differ by less, over omega, are the same */
static const double OPPOSITE = 10.0;  /* degrees by which two beads may depart from being opposite */

/* ------------------------------------------------------------------ the sentence */

/* "two", "17" */
static const char *number_word(int number, char text[16])
{
    static const char *const words[] = {"no", "one", "two", "three", "four", "five", "six", "seven", "eight"};
    if (number >= 0 && number < (int)(sizeof words / sizeof *words))
        return words[number];
    (void)snprintf(text, 16, "%d", number);
    return text;
}

static void add(char *text, size_t size, const char *more)
{
    const size_t used = strlen(text);
    (void)snprintf(text + used, size - used, "%s", more);
}

/* Which way the beads apart go: 1 all against the magnet, 2 all with it, 3 both ways. */
static int ways_of_singles(const fst_beads_result *result)
{
    int ways = 0;
    for (int g = 0; g < result->group_count; ++g)
        if (result->groups[g].kind == FST_BEAD_GROUP_SINGLE)
            ways |= result->beads[result->groups[g].members[0]].mean_alpha_dot < 0 ? 1 : 2;
    return ways;
}

static int are_opposite(const fst_beads_result *result)
{
    const double *one = result->beads[0].final_state, *two = result->beads[1].final_state;
    const double angle = atan2(one[0] * two[1] - one[1] * two[0], one[0] * two[0] + one[1] * two[1]);
    const double slow = fabs(result->beads[0].mean_alpha_dot - result->beads[1].mean_alpha_dot);
    return fabs(fabs(angle) * 180.0 / FST_PI - 180.0) < OPPOSITE && slow < SAME_RATE * result->omega;
}

/* No bead touches another. */
static void tell_apart(const fst_beads_result *result, char *text, size_t size)
{
    static const char *const ways[] = {"", ", against the magnet", ", with the magnet",
                                       ", some with the magnet and some against it"};
    char word[16];
    add(text, size, number_word(result->count, word));
    if (result->count == 1)
        add(text, size, " bead circles");
    else
        add(text, size,
            result->count == 2 && are_opposite(result) ? " beads circle opposite each other"
                                                       : " beads circle apart");
    add(text, size, ways[ways_of_singles(result)]);
}

/* "a chain of four" */
static void tell_name(const fst_bead_group *group, char *text, size_t size)
{
    char word[16], name[64];
    if (group->kind == FST_BEAD_GROUP_PAIR)
        (void)snprintf(name, sizeof name, "a pair");
    else
        (void)snprintf(name, sizeof name, "a %s of %s", fst_bead_group_name(group->kind),
                       number_word(group->count, word));
    add(text, size, name);
}

/* " turns with the magnet, and its centre circles against it" */
static void tell_motion(const fst_bead_group *group, double omega, char *text, size_t size)
{
    char phrase[128];
    if (isnan(group->axis_rate)) {
        add(text, size, " whose motion has not settled");
        return;
    }
    if (fabs(group->axis_rate - omega) < SAME_RATE * omega)
        add(text, size, " turns with the magnet");
    else {
        (void)snprintf(phrase, sizeof phrase, " turns at %.3g of the magnet's rate", group->axis_rate / omega);
        add(text, size, phrase);
    }
    if (isnan(group->centre_rate))
        add(text, size, " about the axis");
    else if (fabs(group->centre_rate - omega) > SAME_RATE * omega)
        add(text, size,
            group->centre_rate < 0 ? ", and its centre walks against it" : ", and its centre walks with it");
}

/* Groups of several beads, the largest first, then those apart and those that are gone. */
static void tell_groups(const fst_beads_result *result, char *text, size_t size)
{
    int apart = 0, gone = 0, told = 0;
    char word[16], phrase[64];
    for (int count = result->count; count > 1; --count)
        for (int g = 0; g < result->group_count; ++g) {
            const fst_bead_group *group = &result->groups[g];
            if (group->count != count)
                continue;
            add(text, size, told++ ? ", " : "");
            tell_name(group, text, size);
            tell_motion(group, result->omega, text, size);
        }
    for (int i = 0; i < result->count; ++i)
        gone += result->beads[i].regime == FST_REGIME_EJECTED;
    for (int g = 0; g < result->group_count; ++g)
        apart += result->groups[g].count == 1;
    if (apart) {
        (void)snprintf(phrase, sizeof phrase, "%s%s bead%s apart", told ? ", " : "", number_word(apart, word),
                       apart == 1 ? "" : "s");
        add(text, size, phrase);
    }
    if (gone) {
        (void)snprintf(phrase, sizeof phrase, "%s%s bead%s ejected", told || apart ? ", " : "",
                       number_word(gone, word), gone == 1 ? "" : "s");
        add(text, size, phrase);
    }
}

void fst_beads_sentence(const fst_beads_result *result, char *text, size_t size)
{
    int singles = 1;
    for (int i = 0; i < result->count; ++i)
        singles &= result->beads[i].regime != FST_REGIME_EJECTED;
    for (int g = 0; g < result->group_count; ++g)
        singles &= result->groups[g].count == 1;
    text[0] = '\0';
    if (singles)
        tell_apart(result, text, size);
    else
        tell_groups(result, text, size);
    if (result->outcome == FST_BEADS_UNDECIDED)
        add(text, size, ": undecided");
}

/* ------------------------------------------------------------------ JSON */

/* What JSON gives beside scaled numbers. */
typedef struct page {
    fst_json json;
    int in_si, with_events;
    fst_scales scales;
} page;

/* A number, and with its unit at the end of its key in SI. */
static void put(page *p, const char *key, double value, const char *unit, const char *ending)
{
    const char *unused;
    char in_si[64];
    fst_json_real(&p->json, key, value);
    if (!p->in_si)
        return;
    (void)snprintf(in_si, sizeof in_si, "%s%s", key, ending);
    fst_json_real(&p->json, in_si, value * fst_unit_shown(unit, FST_SHOWN_SI, &p->scales, &unused));
}

static void put_beads(page *p, const fst_beads_result *result)
{
    fst_json_open(&p->json, "beads", '[');
    for (int i = 0; i < result->count; ++i) {
        const fst_bead_result *bead = &result->beads[i];
        fst_json_open(&p->json, NULL, '{');
        fst_json_text(&p->json, "regime", fst_regime_name(bead->regime));
        put(p, "mean_r", bead->mean_r, "l", "_m");
        put(p, "mean_alpha_dot", bead->mean_alpha_dot, "gamma", "_per_s");
        fst_json_real(&p->json, "mean_load_weights", bead->mean_load_weights);
        put(p, "ejected_at", bead->ejected_at, "1/gamma", "_s");
        fst_json_reals(&p->json, "final_state", bead->final_state, FST_BEAD_NUMBERS);
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
        put(p, "mean_r", group->mean_r, "l", "_m");
        put(p, "centre_rate", group->centre_rate, "gamma", "_per_s");
        put(p, "axis_rate", group->axis_rate, "gamma", "_per_s");
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
        put(p, "force", result->touches[k].force, "l gamma^2", "_newtons");
        fst_json_close(&p->json);
    }
    fst_json_close(&p->json);
    fst_json_flag(&p->json, "forces_unique", result->forces_unique);
}

static void put_powers(page *p, const fst_beads_result *result)
{
    fst_json_open(&p->json, "powers", '{');
    put(p, "drive", result->drive_power, "l^2 gamma^3", "_watts");
    put(p, "plate", result->plate_power, "l^2 gamma^3", "_watts");
    put(p, "pair", result->pair_power, "l^2 gamma^3", "_watts");
    put(p, "impacts", result->impact_power, "l^2 gamma^3", "_watts");
    fst_json_close(&p->json);
}

static void put_events(page *p, const fst_beads_result *result)
{
    if (p->with_events)
        fst_json_open(&p->json, "events", '[');
    for (int k = 0; k < result->event_count && p->with_events; ++k) {
        const fst_bead_event *event = &result->events[k];
        fst_json_open(&p->json, NULL, '{');
        put(p, "time", event->time, "1/gamma", "_s");
        fst_json_text(&p->json, "kind", fst_bead_event_name(event->kind));
        fst_json_open(&p->json, "beads", '[');
        fst_json_integer(&p->json, NULL, event->beads[0]);
        if (event->beads[1] >= 0)
            fst_json_integer(&p->json, NULL, event->beads[1]);
        fst_json_close(&p->json);
        put(p, "speed", event->speed, "l gamma", "_m_per_s");
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
    put(p, "time", paradox->time, "1/gamma", "_s");
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
    fst_json_real(&p->json, "energy_residual", result->energy_residual);
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
    page p = {fst_json_begin('{'), units == FST_SHOWN_LAB || units == FST_SHOWN_SI, 1, fst_scales_of(scene)};
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
