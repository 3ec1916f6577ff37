/* scene.c - the scene of a command: a file or standard input, and what --set changes in it. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "cli/command.h"
#include "cli/terminal.h"

typedef char key_text[96];

/* The key of KEY=VALUE, without the blanks about it. */
static void key_of(const char *text, key_text key)
{
    size_t length = strcspn(text, "=");
    const size_t start = strspn(text, " \t");
    while (length > start && (text[length - 1] == ' ' || text[length - 1] == '\t'))
        --length;
    (void)snprintf(key, sizeof(key_text), "%.*s", start < length ? (int)(length - start) : 0, text + start);
}

/* Apply KEY=VALUE. */
static fst_status apply_set(const char *text, fst_params *params, fst_error *error)
{
    key_text key;
    if (!strchr(text, '='))
        return fail(error, FST_BAD_INPUT, "--set", "\"%.60s\" must be KEY=VALUE, as in drive.frequency=10.7Hz",
                    text);
    key_of(text, key);
    fst_status status = fst_params_set(params, key, strchr(text, '=') + 1, error);
    if (status != FST_OK)
        (void)snprintf(error->where, sizeof error->where, "--set");
    return status;
}

/* Whether a --set gives `key`. */
static int is_set(const arguments *given, const char *key)
{
    key_text set;
    for (int i = 0; i < given->option_count; ++i) {
        if (strcmp(given->options[i].row->name, "set") != 0)
            continue;
        key_of(given->options[i].value, set);
        if (strcmp(set, key) == 0)
            return 1;
    }
    return 0;
}

/* Tell what of the scene does not count because of what is set: of kappa, B0 and the bead's moment two give the third. */
static void tell_dropped(const arguments *given, const fst_params *scene, const fst_params *now)
{
    static const struct {
        const char *key, *from;
    } rows[] = {{"model.kappa", "the magnet's field"}, {"magnet.b0", "model.kappa"}};
    for (int k = 0; k < 2; ++k)
        if (!is_set(given, rows[k].key) && fst_params_takes_back(scene, now, rows[k].key))
            (void)fprintf(
                stderr,
                "festoon: warning: --set: the scene's %s does not count: it follows from the bead's moment and "
                "%s\n",
                rows[k].key, rows[k].from);
}

/* Apply each --set.  Of two that give one quantity the last counts, as of two that give one key, so that a script can
 * add its own behind others; but it is told, because it may be a mistake. */
static fst_status apply_sets(const arguments *given, fst_params *params, fst_error *error)
{
    fst_status status = FST_OK;
    const fst_params scene = *params;
    for (int i = 0; i < given->option_count && status == FST_OK; ++i) {
        if (strcmp(given->options[i].row->name, "set") != 0)
            continue;
        const fst_params before = *params;
        status = apply_set(given->options[i].value, params, error);
        for (int k = 0; k < i && status == FST_OK; ++k) {
            key_text one, two;
            if (strcmp(given->options[k].row->name, "set") != 0)
                continue;
            key_of(given->options[k].value, one);
            key_of(given->options[i].value, two);
            const int of_kappa = strcmp(one, "model.kappa") == 0 || strcmp(two, "model.kappa") == 0;
            if (of_kappa ? fst_params_takes_back(&before, params, one) : fst_params_clash(params, one, two))
                (void)fprintf(
                    stderr,
                    "festoon: warning: --set: %s and %s give the same quantity%s: the last counts, %s\n", one,
                    two, of_kappa ? " (with the bead's moment magnet.b0 gives kappa)" : "", two);
        }
    }
    if (status == FST_OK)
        tell_dropped(given, &scene, params);
    return status;
}

/* Read the scene that another program writes: festoon init - | festoon run -. */
static fst_status read_scene_from_input(fst_params *params, fst_bead_params **beads, fst_error *error)
{
    static const char name[] = "standard input";
    char *text = malloc(FST_SCENE_SIZE_LIMIT + 1);
    size_t size;
    if (!text)
        return fail(error, FST_NO_MEMORY, name, "out of memory");
    fst_status status = FST_OK;
    const int reason = read_standard_input(text, FST_SCENE_SIZE_LIMIT + 1, &size);
    if (interrupted())
        status = fail(error, FST_INTERRUPTED, name, "interrupted while reading the scene");
    else if (reason)
        status = fail(error, FST_IO, name, "reading the scene failed: %s", strerror(reason));
    else if (size == 0) /* the program before the pipe failed, and said why */
        status = fail(error, FST_BAD_INPUT, name, "it is empty: expected a scene");
    else
        status = fst_scene_parse_beads(text, size, name, params, beads, error);
    free(text);
    return status;
}

/* A scene that says nothing is the default one; somebody who meant another file should know. */
static void warn_of_empty(const char *path)
{
    char line[512], name[SHOWN_SIZE];
    int says_something = 0;
    FILE *file = fopen(path, "r");
    while (file && !says_something && fgets(line, sizeof line, file)) {
        const char first = line[strspn(line, " \t\r\n")];
        says_something = first && first != '#';
    }
    if (!file || fclose(file) != 0 || says_something)
        return;
    (void)fprintf(
        stderr,
        "festoon: warning: %s is an empty scene: it has no key, so every parameter keeps its default, the "
        "bead of the paper at 10.7 Hz\n",
        shown(path, name));
}

static void warn_of_map(const arguments *given, const fst_field_map *map)
{
    char doubt[256];
    if (fst_field_map_doubt(map, doubt, sizeof doubt))
        (void)fprintf(stderr, "festoon: warning: %s%s\n", doubt,
                      option_value(given, "smooth") ? "" : " (festoon field --smooth)");
}

/* The map of the scene, which lives until the command is done. */
static fst_status read_map(const arguments *given, fst_params *params, fst_error *error)
{
    progress_line line;
    const fst_progress progress = {&line, progress_tell};
    fst_field_map_free(*given->map);
    progress_begin(&line);
    const fst_status status = fst_params_read_map(params, &progress, given->map, error);
    progress_end(&line);
    if (status == FST_OK && *given->map)
        warn_of_map(given, *given->map);
    return status;
}

/* Whether a sweep varies a key. */
static int varies(const arguments *given, const char *key)
{
    const size_t length = strlen(key);
    for (int i = 0; i < given->option_count; ++i)
        if (strcmp(given->options[i].row->name, "over") == 0 &&
            strncmp(given->options[i].value, key, length) == 0 && given->options[i].value[length] == '=')
            return 1;
    return 0;
}

/* Refuse what has no effect; static friction that a sweep varies counts as given. */
static fst_status check_effects(const arguments *given, const fst_params *params, fst_error *error)
{
    fst_params asked = *params;
    if (isnan(asked.friction_mu_static) && varies(given, "friction.mu_static"))
        asked.friction_mu_static = asked.friction_mu;
    return fst_params_check_effects(&asked, error);
}

fst_status read_scene(const arguments *given, const char *path, fst_params *params, fst_error *error)
{
    char doubt[512];
    *params = fst_default_params();
    if (path) {
        const fst_status status = strcmp(path, "-") == 0
                                      ? read_scene_from_input(params, given->beads, error)
                                      : fst_scene_read_beads(path, params, given->beads, error);
        if (status != FST_OK)
            return status;
        if (strcmp(path, "-") != 0)
            warn_of_empty(path);
    }
    fst_status status = apply_sets(given, params, error);
    if (status != FST_OK)
        return status;
    if (isnan(params->run_duration) && !varies(given, "run.periods") && !varies(given, "run.duration"))
        params->run_discard = fst_run_discard(params); /* what is printed is what is done */
    if (fst_parts_contradiction(params, doubt, sizeof doubt))
        (void)fprintf(stderr, "festoon: warning: %s\n", doubt);
    if (fst_params_bare_number(params, doubt, sizeof doubt))
        (void)fprintf(stderr, "festoon: warning: %s\n", doubt);
    status = check_effects(given, params, error);
    if (status != FST_OK) {
        (void)snprintf(error->where, sizeof error->where, "%s", path ? path : "");
        return status;
    }
    const fst_status apart = check_outputs_spare(given, params->magnet_file, error);
    return apart == FST_OK ? read_map(given, params, error) : apart;
}
