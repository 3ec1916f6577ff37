/* branch.c - festoon branch: families of orbits or of equilibria over a parameter. */
#include <errno.h>
#include <string.h>
#include <unistd.h>

#include "cli/beads_orbits.h"
#include "cli/command.h"
#include "cli/terminal.h"

static const option options[] = {
    SCENE_OPTIONS,
    JSON_OPTION,
    UNITS_JSON_OPTION,
    {"kind", '\0', FST_WORDS(FST_BRANCH_KINDS), FST_DOCS(FST_BRANCH_KINDS)},
    {"over", '\0', "KEY=LO:HI", "the parameter and its range, as in drive.omega=0.2:3"},
    {"with", '\0', "KEY=LO:HI",
     "a second parameter and its range: special points are followed as curves over both"},
    {"follow", '\0', FST_WORDS(FST_FOLLOWED_SPECIALS), "type of these special points"},
    {"output", 'o', "FILE.json", "write the branch to a file, for festoon plot"},
    {"tolerance", EXPERT, "T",
     "tolerance of the integration; that of Newton's method and of special points follows it (1e-12)"},
    {"step", EXPERT, "S", "greatest step along the branch, scaled (0.5)"},
    {NULL, '\0', NULL, NULL},
};

/* Read KEY=LO:HI of an option; the values may carry the key's unit. */
static fst_status read_range(const char *name, const char *text, char key[64], double *from, double *to,
                             fst_error *error)
{
    char low[64], high[64];
    const char *equals = strchr(text, '='), *colon = equals ? strchr(equals, ':') : NULL;
    if (!colon || equals == text || equals - text > 63 || colon - equals > 63 || strlen(colon) > 63)
        return fail(error, FST_BAD_INPUT, name, "\"%.80s\" must be KEY=LO:HI, as in drive.omega=0.2:3", text);
    if (strchr(colon + 1, ':'))
        return fail(error, FST_BAD_INPUT, name, "\"%.80s\" must be KEY=LO:HI: a branch takes no count", text);
    (void)snprintf(key, 64, "%.*s", (int)(equals - text), text);
    (void)snprintf(low, sizeof low, "%.*s", (int)(colon - equals - 1), equals + 1);
    (void)snprintf(high, sizeof high, "%s", colon + 1);
    const int row = fst_param_find(key);
    if (row < 0 && strncmp(key, "magnet.parts", strlen("magnet.parts")) == 0) {
        fst_params scratch = fst_default_params(); /* its sentence knows the keys of parts */
        return fst_params_set(&scratch, key, low, error);
    }
    if (row < 0 || fst_param_at(row)->kind != FST_KIND_REAL) {
        char names[2048] = "", suggestion[FST_SUGGESTION_SIZE];
        for (int i = 0; i < fst_param_count(); ++i) {
            const size_t used = strlen(names);
            if (fst_param_at(i)->kind == FST_KIND_REAL)
                (void)snprintf(names + used, sizeof names - used, "%s%s", used ? "|" : "",
                               fst_param_at(i)->key);
        }
        return fail(error, FST_BAD_INPUT, name, "\"%s\" is not a parameter with real values; %s", key,
                    fst_suggest_name(key, names, suggestion));
    }
    fst_error why;
    fst_status status = fst_parse_value(low, fst_param_at(row)->unit, from, &why);
    if (status == FST_OK)
        status = fst_parse_value(high, fst_param_at(row)->unit, to, &why);
    if (status != FST_OK)
        return fail(error, FST_BAD_INPUT, name, "%s", why.sentence);
    if (!(*from < *to))
        return fail(error, FST_BAD_INPUT, name, "the range %s:%s must rise", low, high);
    return FST_OK;
}

/* Read the second parameter, and the type of special points that are followed over both. */
static fst_status read_second(const arguments *given, char key[64], fst_branch_options *o, fst_error *error)
{
    const char *with = option_value(given, "with"), *follow = option_value(given, "follow");
    if (!with && !follow)
        return FST_OK;
    if (!with || !follow)
        return fail(error, FST_BAD_INPUT, with ? "--follow" : "--with",
                    "curves over two parameters need both, as in --follow pitchfork --with model.kappa=1:3");
    int place = 0;
    const fst_status status =
        read_choice("--follow", follow, "type", FST_WORDS(FST_FOLLOWED_SPECIALS), &place, error);
    if (status != FST_OK)
        return status;
    o->special = (fst_special_type)place;
    o->second_key = key;
    return read_range("--with", with, key, &o->second_from, &o->second_to, error);
}

static fst_status read_options(const arguments *given, char keys[2][64], fst_branch_options *o,
                               fst_error *error)
{
    *o = fst_default_branch_options();
    const char *kind = option_value(given, "kind"), *over = option_value(given, "over");
    const char *tolerance = option_value(given, "tolerance"), *step = option_value(given, "step");
    int place = 0;
    if (!kind)
        return fail(error, FST_BAD_INPUT, "--kind", "say which: --kind %s", FST_WORDS(FST_BRANCH_KINDS));
    fst_status status = read_choice("--kind", kind, "kind", FST_WORDS(FST_BRANCH_KINDS), &place, error);
    if (status != FST_OK)
        return status;
    o->kind = (fst_branch_kind)place;
    if (!over)
        return fail(error, FST_BAD_INPUT, "--over", "say over which parameter: --over drive.omega=0.2:3");
    status = read_range("--over", over, keys[0], &o->from, &o->to, error);
    o->key = keys[0];
    if (status == FST_OK)
        status = read_second(given, keys[1], o, error);
    if (status == FST_OK && tolerance)
        status = read_numbers("--tolerance", tolerance, &o->tolerance, 1, error);
    if (status == FST_OK && !(o->tolerance >= 1e-14 && o->tolerance <= 1e-6))
        status = fail(error, FST_BAD_INPUT, "--tolerance", "\"%.40s\" must be a number from 1e-14 to 1e-6",
                      tolerance);
    if (status == FST_OK && step)
        status = read_numbers("--step", step, &o->longest_step, 1, error);
    if (status == FST_OK && !(o->longest_step > 1e-5))
        status = fail(error, FST_BAD_INPUT, "--step", "\"%.40s\" must be a number greater than 1e-5", step);
    return status;
}

/* Whether a file can be made at this place.  It is asked before any work is done for it. */
static fst_status check_place(const char *path, fst_error *error)
{
    char directory[1024];
    const char *slash = strrchr(path, '/');
    const int length = slash == path ? 1 : slash ? (int)(slash - path) : 0;
    if ((size_t)length >= sizeof directory)
        return FST_OK; /* the writing will tell */
    (void)snprintf(directory, sizeof directory, "%.*s", length, path);
    return access(length ? directory : ".", W_OK) == 0
               ? FST_OK
               : fail(error, FST_IO, path, "cannot write here: %s", strerror(errno));
}

/* Print a curve over two parameters: some of its points. */
static void print_curve(const page *p, const fst_branch *b, int curve)
{
    const shown_parameter over = show_parameter(p, b->key), with = show_parameter(p, b->second_key);
    size_t first = 0, count = 0;
    for (size_t i = 0; i < b->point_count; ++i)
        if (b->points[i].branch == curve && count++ == 0)
            first = i;
    (void)fprintf(p->out, "\n%s, curve %d: %zu points\n  %16s %16s\n  %16s %16s\n",
                  fst_special_name(b->followed), curve, count, b->key, b->second_key, over.unit, with.unit);
    const size_t rows = count < 16 ? count : 16;
    for (size_t k = 0; k < rows; ++k) {
        const fst_branch_point *at = &b->points[first + (rows > 1 ? k * (count - 1) / (rows - 1) : 0)];
        (void)fprintf(p->out, "  %16.10f %16.10f  %s\n", unsigned_zero(over.factor * at->value, 10),
                      unsigned_zero(with.factor * at->second, 10), at->stable ? "of a stable state" : "");
    }
}

/* omega of a special point, where it is not the parameter. */
static void print_omega_there(const page *p, const fst_params *params, const fst_branch *b,
                              const fst_special *s)
{
    const char *unit;
    char text[32];
    fst_params there = *params;
    (void)snprintf(text, sizeof text, "%.17g", s->value);
    (void)fst_params_set(&there, b->key, text, NULL);
    const fst_scales scales = fst_scales_of(&there);
    const double factor = fst_number_shown("omega", "gamma", p->units, &scales, &unit);
    (void)fprintf(p->out, "  omega = %.12g %s", factor * s->omega, unit);
}

static void print_branch(const page *p, const fst_params *params, const fst_branch *b)
{
    FILE *out = p->out;
    const shown_parameter shown = show_parameter(p, b->key);
    const char *unit = shown.unit;
    if (b->second_key[0]) {
        (void)fprintf(out, "%d curve%s of %s points over %s and %s\n", b->branches, b->branches == 1 ? "" : "s",
                      fst_special_name(b->followed), b->key, b->second_key);
        for (int curve = 0; curve < b->branches; ++curve)
            print_curve(p, b, curve);
        (void)fprintf(out, "\nends\n");
        for (size_t i = 0; i < b->end_count; ++i)
            (void)fprintf(out, "  curve %d at %s = %.10g%s: %s\n", b->ends[i].branch, b->key,
                          shown.factor * unsigned_zero(b->ends[i].value, ALL_DIGITS), unit, b->ends[i].reason);
        return;
    }
    (void)fprintf(out, "%d %s, %zu points over %s = %.10g to %.10g%s\n\nspecial points\n", b->branches,
                  b->branches == 1 ? "branch" : "branches", b->point_count, b->key,
                  shown.factor * unsigned_zero(b->from, ALL_DIGITS),
                  shown.factor * unsigned_zero(b->to, ALL_DIGITS), unit);
    for (size_t i = 0; i < b->special_count; ++i) {
        const fst_special *s = &b->specials[i];
        (void)fprintf(out, "  %-16s %s = %.12g%s", fst_special_name(s->type), b->key,
                      shown.factor * unsigned_zero(s->value, ALL_DIGITS), unit);
        if (strcmp(b->key, "drive.omega") != 0)
            print_omega_there(p, params, b, s);
        (void)fprintf(out, "  branch %d%s\n", s->branch,
                      s->criticality > 0   ? "  supercritical"
                      : s->criticality < 0 ? "  subcritical"
                                           : "");
    }
    (void)fprintf(out, "\nends\n");
    for (size_t i = 0; i < b->end_count; ++i)
        (void)fprintf(out, "  branch %d at %.10g%s: %s\n", b->ends[i].branch,
                      shown.factor * unsigned_zero(b->ends[i].value, ALL_DIGITS), unit, b->ends[i].reason);
}

/* Warn if the bead of either end contradicts any material; one warning is enough. */
static void warn_of_ends(const fst_params *params, const fst_branch_options *o)
{
    const double ends[2] = {o->from, o->to};
    char sentence[512], text[32];
    for (int i = 0; i < 2; ++i) {
        fst_params at = *params;
        fst_error ignored;
        (void)snprintf(text, sizeof text, "%.17g", ends[i]);
        if (fst_params_set(&at, o->key, text, &ignored) == FST_OK &&
            fst_bead_contradiction(&at, sentence, sizeof sentence)) {
            warn_of_material(&at);
            return;
        }
    }
}

static fst_status perform(const arguments *given, FILE *out, fst_error *error)
{
    fst_params params;
    fst_branch_options o;
    fst_branch branch;
    char keys[2][64];
    page p = {.out = out};
    fst_status status = read_units(given, &p.units, error);
    if (status == FST_OK)
        status = read_scene(given, operand(given), &params, error);
    if (status == FST_OK)
        p.scales = fst_scales_of(&params);
    if (status == FST_OK)
        status = read_options(given, keys, &o, error);
    const int of_one = o.kind == FST_BRANCH_LEVITATING || o.kind == FST_BRANCH_DRIVEN;
    if (status == FST_OK && (params.bead_count || (fst_key_of_world(&params) && !of_one)))
        return branch_of_beads(given, &params, &o, &p, error);
    const char *path = option_value(given, "output");
    if (status == FST_OK && path)
        status = check_place(path, error);
    if (status != FST_OK)
        return status;
    if (o.kind == FST_BRANCH_LEVITATING && option_value(given, "tolerance"))
        return fail(error, FST_BAD_INPUT, "--tolerance",
                    "a place where a bead floats is solved for, not integrated: leave it out");
    warn_of_ends(&params, &o);
    progress_line line;
    const fst_progress progress = {&line, progress_tell};
    progress_begin(&line);
    o.progress = &progress;
    status = fst_branch_follow(&params, &o, &branch, error);
    progress_end(&line);
    if (status != FST_OK && status != FST_INTERRUPTED)
        return status;
    const int stopped = status == FST_INTERRUPTED;
    if (path)
        status = fst_branch_write(path, &params, &branch, error);
    if (path && status == FST_OK)
        tell_written(path, stopped ? " (incomplete)" : "; festoon plot draws it");
    if (stopped && (!path || status == FST_OK))
        status = fail(error, FST_INTERRUPTED, path ? path : "branch",
                      path ? "interrupted: it holds the %zu points found until then, and is marked incomplete"
                           : "interrupted after %zu points, which -o FILE.json would have kept",
                      branch.point_count);
    if (status == FST_OK && option_value(given, "json"))
        status = print_and_free(fst_branch_json(&params, &branch, p.units), out, error);
    else if (status == FST_OK)
        print_branch(&p, &params, &branch);
    fst_branch_free(&branch);
    return status;
}

const command branch_command = {
    .name = "branch",
    .synopsis = "[SCENE.yaml] --kind KIND --over KEY=LO:HI [-o FILE.json] [options]",
    .summary = "Follow families of orbits or locked states over a parameter, with their bifurcations",
    .details = "With --with and --follow, special points of one type are sought over the first parameter at "
               "the scene's value of\n"
               "the second, and each is followed as a curve over both.  festoon plot draws the file.\n",
    .options = options,
    .most_operands = 1,
    .perform = perform,
};
