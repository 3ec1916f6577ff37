/* branch.c - festoon branch: families of orbits or of equilibria over a parameter. */
#include <string.h>

#include "cli/command.h"
#include "cli/terminal.h"

static const option options[] = {
    SCENE_OPTIONS,
    JSON_OPTION,
    {"kind", '\0', "KIND", "counter: the counter-rotating family; locked: every family of equilibria"},
    {"over", '\0', "KEY=LO:HI", "the parameter and its range, as in drive.omega=0.2:3"},
    {"output", 'o', "FILE.json", "write the branch to a file, for festoon plot"},
    {"tolerance", '\0', "T", "of the integration, 1e-12"},
    {"step", '\0', "S", "greatest step along the branch, scaled, 0.5"},
    {NULL, '\0', NULL, NULL},
};

/* KEY=LO:HI into key and ends; values may carry the key's unit. */
static fst_status read_over(const char *text, char key[64], double *from, double *to, fst_error *error)
{
    char low[64], high[64];
    const char *equals = strchr(text, '='), *colon = equals ? strchr(equals, ':') : NULL;
    if (!colon || equals == text || equals - text > 63 || colon - equals > 63 || strlen(colon) > 63)
        return fail(error, FST_BAD_INPUT, "--over", "\"%.80s\" must be KEY=LO:HI, as in drive.omega=0.2:3",
                    text);
    (void)snprintf(key, 64, "%.*s", (int)(equals - text), text);
    (void)snprintf(low, sizeof low, "%.*s", (int)(colon - equals - 1), equals + 1);
    (void)snprintf(high, sizeof high, "%s", colon + 1);
    const int row = fst_param_find(key);
    if (row < 0 || fst_param_at(row)->kind != FST_KIND_REAL) {
        char names[2048] = "", nearest[64];
        for (int i = 0; i < fst_param_count(); i++) {
            const size_t used = strlen(names);
            if (fst_param_at(i)->kind == FST_KIND_REAL)
                (void)snprintf(names + used, sizeof names - used, "%s%s", used ? "|" : "",
                               fst_param_at(i)->key);
        }
        (void)fst_nearest_name(key, names, nearest, sizeof nearest);
        return fail(error, FST_BAD_INPUT, "--over",
                    "\"%s\" is no parameter with real values; the nearest is %s", key, nearest);
    }
    fst_status status = fst_parse_value(low, fst_param_at(row)->unit, from, error);
    if (status == FST_OK)
        status = fst_parse_value(high, fst_param_at(row)->unit, to, error);
    if (status == FST_OK && !(*from < *to))
        status = fail(error, FST_BAD_INPUT, "--over", "the range %s:%s must rise", low, high);
    return status;
}

static fst_status read_options(const arguments *given, char key[64], fst_branch_options *o, fst_error *error)
{
    *o = fst_default_branch_options();
    const char *kind = option_value(given, "kind"), *over = option_value(given, "over");
    const char *tolerance = option_value(given, "tolerance"), *step = option_value(given, "step");
    if (!kind || (strcmp(kind, "counter") != 0 && strcmp(kind, "locked") != 0))
        return fail(error, FST_BAD_INPUT, "--kind", "tell which: --kind counter or --kind locked");
    if (!over)
        return fail(error, FST_BAD_INPUT, "--over", "tell over what: --over drive.omega=0.2:3");
    o->kind = strcmp(kind, "locked") == 0 ? FST_BRANCH_LOCKED : FST_BRANCH_COUNTER;
    fst_status status = read_over(over, key, &o->from, &o->to, error);
    o->key = key;
    if (status == FST_OK && tolerance)
        status = read_numbers("--tolerance", tolerance, &o->tolerance, 1, error);
    if (status == FST_OK && step)
        status = read_numbers("--step", step, &o->longest_step, 1, error);
    return status;
}

static void print_branch(FILE *out, const fst_branch *b)
{
    (void)fprintf(out, "%d branches, %zu points over %s = %.10g to %.10g\n\nspecial points\n", b->branches,
                  b->point_count, b->key, b->from, b->to);
    for (size_t i = 0; i < b->special_count; i++) {
        const fst_special *s = &b->specials[i];
        (void)fprintf(out, "  %-16s %s = %.12g  omega = %.12g  branch %d%s\n", fst_special_name(s->type),
                      b->key, s->value, s->omega, s->branch,
                      s->criticality > 0   ? "  supercritical"
                      : s->criticality < 0 ? "  subcritical"
                                           : "");
    }
    (void)fprintf(out, "\nends\n");
    for (size_t i = 0; i < b->end_count; i++)
        (void)fprintf(out, "  branch %d at %.10g: %s\n", b->ends[i].branch, b->ends[i].value,
                      b->ends[i].reason);
}

static fst_status show(void *user, double fraction, fst_error *error)
{
    return progress_show(user, fraction, NULL, error);
}

static fst_status perform(const arguments *given, FILE *out, fst_error *error)
{
    fst_params params;
    fst_branch_options o;
    fst_branch branch;
    char key[64];
    fst_status status = read_scene(given, operand(given), &params, error);
    if (status == FST_OK)
        status = read_options(given, key, &o, error);
    if (status != FST_OK)
        return status;
    progress_line line;
    progress_begin(&line);
    o.user = &line;
    o.progress = show;
    status = fst_branch_follow(&params, &o, &branch, error);
    progress_end(&line);
    if (status != FST_OK)
        return status;
    const char *path = option_value(given, "output");
    if (path)
        status = fst_branch_write(path, &params, &branch, error);
    if (status == FST_OK && option_value(given, "json"))
        status = print_and_free(fst_branch_json(&params, &branch), out, error);
    else if (status == FST_OK)
        print_branch(out, &branch);
    fst_branch_free(&branch);
    return status;
}

const command branch_command = {
    .name = "branch",
    .synopsis =
        "[SCENE.yaml] [--set KEY=VALUE]... --kind counter|locked --over KEY=LO:HI [-o FILE.json] [--json]",
    .summary = "Follow families of orbits or locked states over a parameter, with their bifurcations",
    .details =
        "counter: the symmetric counter-rotating branch both ways through the range, and the branches that\n"
        "leave it, through r = 0 and beyond.  locked: every family of equilibria.  festoon plot draws the "
        "file.\n",
    .options = options,
    .most_operands = 1,
    .perform = perform,
};
