/* critical.c - festoon critical: from which speed on does the bead circle against the magnet? */
#include <math.h>
#include <string.h>

#include "cli/command.h"
#include "cli/groups.h"
#include "cli/terminal.h"

static const option options[] = {
    SCENE_OPTIONS,
    {"over", '\0', "KEY=LO:HI:COUNT", "the speeds of the first runs (drive.frequency=2Hz:30Hz:113)"},
    {"tolerance", EXPERT, "T", "the width to which a border is enclosed, over the speed (1e-4)"},
    JSON_OPTION,
    UNITS_JSON_OPTION,
    {NULL, '\0', NULL, NULL},
};

/* What a special point of the branch is, in words. */
#define DOC(NAME, name, doc, ...) doc,
static const char *const special_docs[] = {FST_SPECIALS(DOC)};
#undef DOC

/* "8.8973163183 +- 8.9e-09 Hz": the value to two digits of its error. */
static void print_with_error(FILE *out, double value, double error, const char *unit)
{
    const int decimals = error > 0 ? (int)fmax(0, ceil(-log10(error)) + 1) : 0;
    (void)fprintf(out, "%.*f +- %.2g%s", decimals, value, error, unit);
}

/* "from it on counter-rotating", and up to where, if undecided runs or other outcomes follow. */
static void print_sides(FILE *out, const fst_critical *c, const char *unit)
{
    const fst_critical_stretch *next = c->stretches, *end = next + c->stretch_count;
    double from = NAN, to = NAN;
    int undecided = 0;
    while (next < end && !(next->from > c->until))
        ++next;
    (void)fprintf(out, "\n  below it the bead is %s, from it on", fst_regime_name(c->below));
    if (next < end)
        (void)fprintf(out, ", up to %.7g%s,", c->until, unit);
    for (; next < end && (next->regime == FST_REGIME_UNDECIDED || next->regime == c->above); ++next) {
        if (next->regime == c->above)
            continue;
        from = undecided ? from : next->from;
        to = next->to;
        undecided += next->runs;
    }
    (void)fprintf(out, " %s", fst_regime_name(c->above));
    if (undecided)
        (void)fprintf(out, "; undecided runs from %.7g to %.7g%s: %d", from, to, unit, undecided);
    if (next < end)
        (void)fprintf(out, "; other outcomes from %.7g%s", next->from, unit);
    (void)fputs("\n", out);
}

/* The unit in which speeds are shown; all of `c` are turned into it.  A frequency is one of SI already. */
static shown_parameter show_in(const page *p, fst_critical *c)
{
    const shown_parameter shown = show_parameter(p, c->key);
    double *const speeds[] = {&c->value, &c->error, &c->until, &c->parting, &c->parting_error};
    for (size_t i = 0; i < sizeof speeds / sizeof *speeds; ++i)
        *speeds[i] *= shown.factor;
    for (size_t i = 0; i < c->stretch_count; ++i) {
        c->stretches[i].from *= shown.factor;
        c->stretches[i].to *= shown.factor;
    }
    return shown;
}

static void print_critical(const page *p, fst_critical *c)
{
    FILE *out = p->out;
    const shown_parameter shown = show_in(p, c);
    const char *unit = shown.unit;
    if (c->found) {
        (void)fputs("critical speed: ", out);
        print_with_error(out, c->value, c->error, unit);
        if (strcmp(unit, " Hz") == 0)
            (void)fprintf(out, ", %.2f turns a minute", 60 * c->value);
        print_sides(out, c, unit);
        if (c->special >= 0)
            (void)fprintf(out, "  there %s: %s of festoon branch --kind counter\n", special_docs[c->special],
                          fst_special_name((fst_special_type)c->special));
    } else {
        (void)fprintf(out, "no critical speed in this range: %s\n", c->reason);
    }
    if (!isnan(c->parting) && c->parting != c->value) {
        (void)fputs("  it goes with the magnet up to ", out);
        print_with_error(out, c->parting, c->parting_error, unit);
        (void)fputs("\n", out);
    }
    (void)fprintf(out, "%d runs, each from the scene's start:\n", c->runs);
    for (size_t i = 0; i < c->stretch_count; ++i)
        (void)fprintf(out, "  %-10.7g to %10.7g%s  %-17s %d %s\n", c->stretches[i].from, c->stretches[i].to,
                      unit, fst_regime_name(c->stretches[i].regime), c->stretches[i].runs,
                      c->stretches[i].runs == 1 ? "run" : "runs");
}

static fst_status perform(const arguments *given, FILE *out, fst_error *error)
{
    fst_params params;
    fst_critical found = {.stretches = NULL};
    progress_line line;
    const fst_progress progress = {&line, progress_tell};
    fst_critical_options o = fst_default_critical_options();
    const char *over = option_value(given, "over"), *tolerance = option_value(given, "tolerance");
    page p = {.out = out};
    fst_status status = read_units(given, &p.units, error);
    if (status == FST_OK)
        status = read_scene(given, operand(given), &params, error);
    if (status == FST_OK && tolerance)
        status = read_numbers("--tolerance", tolerance, &o.tolerance, 1, error);
    if (status != FST_OK)
        return status;
    warn_of_material(&params);
    p.scales = fst_scales_of(&params);
    if (over)
        o.over = over;
    o.progress = &progress;
    progress_begin(&line);
    status = fst_critical_find(&params, &o, &found, error);
    progress_end(&line);
    const int told = status == FST_OK || (status == FST_INTERRUPTED && found.runs > 0);
    if (told && status != FST_OK)
        output_keep();
    if (told && option_value(given, "json")) {
        const fst_status printed = print_and_free(fst_critical_json(&params, &found, p.units), out, error);
        status = status == FST_OK ? printed : status;
    } else if (told) {
        print_critical(&p, &found);
    }
    fst_critical_free(&found);
    return status;
}

const command critical_command = {
    .name = "critical",
    .synopsis = "[SCENE.yaml] [--over KEY=LO:HI:COUNT] [--json] [--units U]",
    .summary = "From which speed on the bead circles against the magnet",
    .details = "Runs over the range, each from the scene's start, show where the outcome changes; more runs "
               "enclose the lowest\n"
               "speed from which on all that are decided circle against the magnet for at least a tenth more.  "
               "With smooth\n"
               "friction a special point of the branch of these orbits gives its digits; with dry friction "
               "outcomes alternate\n"
               "near the border, and the list of all runs shows where.\n",
    .options = options,
    .most_operands = 1,
    .perform = perform,
};
