/* beads_report.c - the result of a run of several beads in words: a sentence, a table of groups, one of beads, and the
 * balance of powers. */
#include <string.h>

#include "cli/groups.h"
#include "cli/run_beads.h"

/* Where the numbers go, and their units. */
typedef struct beads_page {
    FILE *out;
    double length, rate, power, energy; /* factors of scaled numbers */
    const char *length_unit, *rate_unit, *power_unit, *energy_unit;
} beads_page;

static beads_page begin_page(FILE *out, const fst_params *scene, fst_shown_units units)
{
    const fst_scales scales = fst_scales_of(scene);
    beads_page p = {.out = out};
    p.length = fst_unit_shown("l", units, &scales, &p.length_unit);
    p.rate = fst_number_shown("mean_alpha_dot", "gamma", units, &scales, &p.rate_unit);
    p.power = fst_unit_shown("l^2 gamma^3", units, &scales, &p.power_unit);
    p.energy = fst_unit_shown("l^2 gamma^2", units, &scales, &p.energy_unit);
    return p;
}

/* A number in a cell of its width, or "-". */
static void print_cell(const beads_page *p, int width, double value)
{
    if (isfinite(value))
        (void)fprintf(p->out, " %*.5g", width, unsigned_zero(value, ALL_DIGITS));
    else
        (void)fprintf(p->out, " %*s", width, "-");
}

static void print_groups_table(const beads_page *p, const fst_beads_result *result)
{
    (void)fprintf(p->out, "\n  %-8s %-18s %10s %12s %12s\n", "group", "beads", "<r> ", "centre ", "axis ");
    (void)fprintf(p->out, "  %-8s %-18s %10s %12s %12s\n", "", "", p->length_unit, p->rate_unit, p->rate_unit);
    for (int g = 0; g < result->group_count; ++g) {
        const fst_bead_group *group = &result->groups[g];
        char members[64] = "";
        for (int k = 0; k < group->count; ++k) {
            const size_t used = strlen(members);
            const int fits = used + 12 < sizeof members;
            (void)snprintf(members + used, sizeof members - used, fits ? "%s%d" : "%s...", k ? " " : "",
                           group->members[k] + 1);
            if (!fits)
                break;
        }
        (void)fprintf(p->out, "  %-8s %-18s", fst_bead_group_name(group->kind), members);
        print_cell(p, 10, group->mean_r * p->length);
        print_cell(p, 12, group->centre_rate * p->rate);
        print_cell(p, 12, group->axis_rate * p->rate);
        (void)fprintf(p->out, "\n");
    }
}

static void print_beads_table(const beads_page *p, const fst_beads_result *result)
{
    (void)fprintf(p->out, "\n  %-5s %-17s %10s %12s %10s %12s\n", "bead", "regime", "<r> ", "<alpha'> ",
                  "load ", "<height> ");
    (void)fprintf(p->out, "  %-5s %-17s %10s %12s %10s %12s\n", "", "", p->length_unit, p->rate_unit, "weights",
                  p->length_unit);
    for (int i = 0; i < result->count; ++i) {
        const fst_bead_result *bead = &result->beads[i];
        (void)fprintf(p->out, "  %-5d %-17s", i + 1, fst_regime_name(bead->regime));
        print_cell(p, 10, bead->mean_r * p->length);
        print_cell(p, 12, bead->mean_alpha_dot * p->rate);
        print_cell(p, 10, bead->mean_load_weights);
        print_cell(p, 12, bead->mean_height * p->length);
        (void)fprintf(p->out, "\n");
    }
}

static void print_power(const beads_page *p, const char *name, double value)
{
    if (isfinite(value))
        (void)fprintf(p->out, "  %-32s %.8g %s\n", name, unsigned_zero(value * p->power, ALL_DIGITS),
                      p->power_unit);
}

static void print_balance(const beads_page *p, const fst_beads_result *result)
{
    (void)fprintf(p->out, "\n");
    print_power(p, "power of the drive", result->drive_power);
    print_power(p, "power lost at the plate", result->plate_power);
    print_power(p, "power lost between beads", result->pair_power);
    print_power(p, "power lost in impacts", result->impact_power);
    (void)fprintf(p->out, "  %-32s %g\n", "restitution of impacts", result->restitution);
    (void)fprintf(p->out, "  %-32s %.6g %s\n", "energy residual", result->energy_residual * p->energy,
                  p->energy_unit);
    (void)fprintf(p->out, "  %-32s", "events");
    for (int kind = 0; kind < FST_BEAD_EVENTS; ++kind)
        (void)fprintf(p->out, "%s %s %lld", kind ? "," : "", fst_bead_event_name((fst_bead_event_kind)kind),
                      (long long)result->counts[kind]);
    (void)fprintf(p->out, "\n");
    if (!result->forces_unique && result->method == FST_BEADS_EXACT)
        (void)fprintf(p->out, "  the contact forces are one choice of many: more contacts than directions\n");
}

void print_beads(FILE *out, const fst_params *scene, const fst_beads_result *result, fst_shown_units units)
{
    const beads_page p = begin_page(out, scene, units == FST_SHOWN_AS_GIVEN ? FST_SHOWN_LAB : units);
    char sentence[FST_BEADS_SENTENCE_SIZE];
    fst_beads_sentence(result, sentence, sizeof sentence);
    (void)fprintf(out, "%s\n  %s: %s\n", sentence, fst_beads_outcome_name(result->outcome), result->reason);
    (void)fprintf(out, "\n  method %s, %.6g turns of the magnet at %.6g Hz",
                  fst_beads_method_name(result->method), result->periods,
                  result->omega * scene->friction_gamma / TWO_PI);
    if (isfinite(result->drive_power)) /* else no bead is left */
        (void)fprintf(out, ", means behind the first %.6g", fst_run_discard(scene));
    (void)fprintf(out, "\n");
    print_groups_table(&p, result);
    print_beads_table(&p, result);
    print_balance(&p, result);
}
