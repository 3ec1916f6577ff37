/* identity.c - writing, reading and comparing the record of what a database is a sweep of. */
#include "sweep/identity.h"

#include <limits.h>
#include <stdlib.h>
#include <string.h>

#include "base/error.h"
#include "base/checksum.h"
#include "sweep/log.h"

static char *format_text(const char *format, ...) __attribute__((format(printf, 1, 2)));
static char *format_text(const char *format, ...)
{
    va_list values;
    va_start(values, format);
    char *text = sqlite3_vmprintf(format, values), *copy = text ? strdup(text) : NULL;
    va_end(values);
    sqlite3_free(text);
    return copy;
}

static void add_line(fst_identity_lines *lines, const char *key, char *value)
{
    (void)snprintf(lines->keys[lines->count], sizeof lines->keys[0], "%s", key);
    lines->values[lines->count++] = value;
}

/* The version of the bits of these rows: dry friction, if a row has it, has one of its own. */
static int results_version(const fst_grid *grid)
{
    const fst_params *base = fst_grid_base(grid);
    int dry = base->friction_law == FST_FRICTION_COULOMB || base->friction_law == FST_FRICTION_ROLLING;
    for (int i = 0; i < fst_grid_axis_count(grid); ++i)
        dry |= strncmp(fst_grid_axis_text(grid, i), "friction.law=", strlen("friction.law=")) == 0;
    if (fst_grid_row_kind(grid) != FST_ROWS_OF_RUNS)
        return FST_BEADS_RESULTS_VERSION;
    return dry ? FST_DRY_RESULTS_VERSION : FST_RESULTS_VERSION;
}

/* All lines that must be the same for a sweep to go on.  Of the scene the parameters must be, not the text. */
static void wanted_lines(const fst_sweep_identity *identity, fst_identity_lines *lines)
{
    static const char *const carry[] = {"no", "up", "down"};
    lines->count = 0;
    add_line(lines, "scene", fst_scene_text(fst_grid_base(identity->grid), 0));
    add_line(lines, "axes", format_text("%d", fst_grid_axis_count(identity->grid)));
    for (int i = 0; i < fst_grid_axis_count(identity->grid); ++i) {
        char name[24];
        (void)snprintf(name, sizeof name, "axis_%d", i + 1);
        add_line(lines, name, strdup(fst_grid_axis_text(identity->grid, i)));
    }
    add_line(lines, "seed", format_text("%llu", (unsigned long long)identity->seed));
    add_line(lines, "carry", strdup(carry[identity->carry]));
    add_line(lines, "arithmetic", strdup(fst_arithmetic_name(identity->arithmetic)));
    add_line(lines, "fingerprint", format_text("%016llx", (unsigned long long)identity->fingerprint));
    add_line(lines, "results_version", format_text("%d", results_version(identity->grid)));
    if (fst_grid_row_kind(identity->grid) == FST_ROWS_OF_LEVITATION) /* other rows follow from the scene */
        add_line(lines, "rows", strdup("levitation"));
    if (identity->shards > 1)
        add_line(lines, "shard",
                 format_text("%lld/%lld", (long long)identity->shard + 1, (long long)identity->shards));
}

void fst_identity_free(fst_identity_lines *lines)
{
    for (int i = 0; i < lines->count; ++i)
        free(lines->values[i]);
    lines->count = 0;
}

const char *fst_identity_text(const fst_identity_lines *lines, const char *key)
{
    for (int i = 0; i < lines->count; ++i)
        if (strcmp(lines->keys[i], key) == 0)
            return lines->values[i];
    return NULL;
}

/* ------------------------------------------------------------------ comparing */

/* The parameters from which the sweep was made.  A key that its scene lacks has its default: an older program,
 * which did not know the key, did what the default says. */
static fst_status read_scene(const fst_identity_lines *lines, const char *path, fst_params *params,
                             fst_error *error)
{
    const char *scene = fst_identity_text(lines, "scene"), *version = fst_identity_text(lines, "version");
    fst_error why = {FST_OK, "", ""};
    *params = fst_default_params();
    const fst_status status = fst_scene_parse(scene, strlen(scene), path, params, &why);
    if (status == FST_OK)
        return FST_OK;
    if (status != FST_BAD_INPUT)
        return fst_fail(error, status, path, "%s", why.sentence);
    return fst_fail(
        error, FST_BAD_INPUT, path,
        "the scene of this sweep, which festoon %.40s made, means nothing to festoon %s (%s); it was "
        "left untouched: use the festoon that made it",
        version ? version : "(not told)", fst_version(), why.sentence);
}

/* Say what differs: `what` of the command, or of the other file. */
static fst_status fail_differs(const char *path, const char *other, const char *what, const char *key,
                               const char *there, const char *wanted, fst_error *error)
{
    if (other)
        return fst_fail(error, FST_BAD_INPUT, path,
                        "this sweep was made with %s %.120s, and %s with %.120s: they are not parts of one "
                        "sweep; nothing was written",
                        key, there, other, wanted);
    return fst_fail(error, FST_BAD_INPUT, path,
                    "this sweep was made with %s %.120s, not %.120s; it was left untouched: choose another "
                    "file, or the same %s to go on with it",
                    key, there, wanted, what);
}

/* Compare the parameters, whatever text they were written in, and say which one differs. */
static fst_status compare_scene(const fst_identity_lines *lines, const char *path, const fst_params *wanted,
                                const char *other, fst_error *error)
{
    fst_params made;
    const fst_status status = read_scene(lines, path, &made, error);
    if (status != FST_OK)
        return status;
    const int there = fst_params_row_count(&made), here = fst_params_row_count(wanted);
    for (int i = 0; i < (there > here ? there : here); ++i) {
        char before[FST_PARAM_TEXT_SIZE], now[FST_PARAM_TEXT_SIZE];
        (void)fst_params_get(&made, i, before, sizeof before);
        (void)fst_params_get(wanted, i, now, sizeof now);
        /* The same content under another name is the same map. */
        if (strcmp(fst_param_at(i)->key, "magnet.file") == 0 && made.magnet_checksum[0])
            continue;
        char key[64];
        (void)snprintf(key, sizeof key, "%s =", fst_param_at(i)->key);
        if (strcmp(before, now) != 0)
            return fail_differs(path, other, "parameters", key, before[0] ? before : "(not given)",
                                now[0] ? now : "(not given)", error);
    }
    return FST_OK;
}

/* Whether the file is of the shard that is wanted. */
static fst_status compare_shard(const fst_identity_lines *lines, const char *path,
                                const fst_identity_lines *wanted, fst_error *error)
{
    const char *there = fst_identity_text(lines, "shard"), *here = fst_identity_text(wanted, "shard");
    if (strcmp(there ? there : "", here ? here : "") == 0)
        return FST_OK;
    return fst_fail(error, FST_BAD_INPUT, path,
                    "this is %s%.40s, not %s%.40s; it was left untouched: choose another file, or the same "
                    "options to go on with it",
                    there ? "shard " : "a whole sweep", there ? there : "", here ? "shard " : "the whole sweep",
                    here ? here : "");
}

fst_status fst_identity_compare(const fst_identity_lines *lines, const char *path,
                                const fst_sweep_identity *identity, const char *other, fst_error *error)
{
    fst_identity_lines wanted;
    wanted_lines(identity, &wanted);
    fst_status status = other ? FST_OK : compare_shard(lines, path, &wanted, error);
    if (fst_identity_text(lines, "rows") && !fst_identity_text(&wanted, "rows"))
        status =
            fst_fail(error, FST_BAD_INPUT, path,
                     "this sweep tells of levitation, not of runs; it was left untouched: choose another file");
    for (int i = 0; i < wanted.count && status == FST_OK; ++i) {
        const char *there = fst_identity_text(lines, wanted.keys[i]);
        if (!wanted.values[i])
            status = fst_fail(error, FST_NO_MEMORY, path, "out of memory");
        else if (!there)
            status = fst_fail(error, FST_BAD_INPUT, path,
                              "this sweep does not say its %s; it was left untouched: choose another file",
                              wanted.keys[i]);
        else if (strcmp(wanted.keys[i], "scene") == 0)
            status = compare_scene(lines, path, fst_grid_base(identity->grid), other, error);
        else if (strcmp(there, wanted.values[i]) != 0)
            status = fail_differs(path, other, "options", wanted.keys[i], there, wanted.values[i], error);
    }
    fst_identity_free(&wanted);
    return status;
}

/* ------------------------------------------------------------------ writing and reading */

static int compare_keys(const void *a, const void *b)
{
    return strcmp(a, b);
}

/* Sort the lines by their keys, as the table has them.  The values move with the keys. */
static void sort_lines(fst_identity_lines *lines)
{
    fst_identity_lines sorted = *lines;
    qsort(sorted.keys, (size_t)sorted.count, sizeof sorted.keys[0], compare_keys);
    for (int i = 0; i < sorted.count; ++i)
        for (int k = 0; k < lines->count; ++k)
            if (strcmp(sorted.keys[i], lines->keys[k]) == 0)
                sorted.values[i] = lines->values[k];
    *lines = sorted;
}

uint64_t fst_identity_checksum(const fst_identity_lines *lines)
{
    uint64_t sum = 0;
    for (int i = 0; i < lines->count; ++i) {
        if (!lines->values[i] || strcmp(lines->keys[i], "checksum") == 0 ||
            strcmp(lines->keys[i], "refine") == 0)
            continue;
        sum = fst_checksum_bytes(sum, lines->keys[i], strlen(lines->keys[i]));
        sum = fst_checksum_bytes(sum, lines->values[i], strlen(lines->values[i]));
    }
    return sum;
}

uint64_t fst_journal_identity_hash(const fst_sweep_identity *identity)
{
    fst_identity_lines lines;
    wanted_lines(identity, &lines);
    const uint64_t sum = fst_identity_checksum(&lines);
    fst_identity_free(&lines);
    return sum;
}

fst_status fst_identity_write(sqlite3 *database, const char *path, const fst_sweep_identity *identity,
                              const char *mark, fst_error *error)
{
    fst_identity_lines lines;
    wanted_lines(identity, &lines);
    add_line(&lines, "version", strdup(fst_version()));
    add_line(&lines, "points", format_text("%lld", (long long)fst_grid_points(identity->grid)));
    add_line(&lines, "mark", strdup(mark));
    fst_status status = FST_OK;
    for (int i = 0; i < lines.count; ++i)
        if (!lines.values[i])
            status = fst_fail(error, FST_NO_MEMORY, path, "out of memory");
    if (status == FST_OK) {
        sort_lines(&lines);
        add_line(&lines, "checksum", format_text("%016llx", (unsigned long long)fst_identity_checksum(&lines)));
    }
    for (int i = 0; i < lines.count && status == FST_OK; ++i) {
        char *statement = sqlite3_mprintf("INSERT INTO festoon VALUES(%Q, %Q)", lines.keys[i], lines.values[i]);
        status = statement && lines.values[i] ? fst_database_do(database, path, statement, error)
                                              : fst_fail(error, FST_NO_MEMORY, path, "out of memory");
        sqlite3_free(statement);
    }
    fst_identity_free(&lines);
    return status;
}

static fst_status fail_damaged(const char *path, fst_error *error)
{
    return fst_fail(
        error, FST_BAD_INPUT, path,
        "this sweep database is damaged: its record of what it is a sweep of does not agree with its "
        "checksum; nothing was changed: restore a copy, or choose another file");
}

/* Read one line of the table; 0 where it cannot be one of ours. */
static int read_line(sqlite3_stmt *query, fst_identity_lines *lines)
{
    if (lines->count == FST_IDENTITY_LIMIT || sqlite3_column_type(query, 0) != SQLITE_TEXT ||
        sqlite3_column_type(query, 1) != SQLITE_TEXT)
        return 0;
    const char *key = (const char *)sqlite3_column_text(query, 0);
    const char *value = (const char *)sqlite3_column_text(query, 1);
    if (!key || !value || strlen(key) >= sizeof lines->keys[0] ||
        strlen(value) != (size_t)sqlite3_column_bytes(query, 1))
        return 0;
    char *copy = strdup(value);
    if (!copy)
        return 0;
    add_line(lines, key, copy);
    return 1;
}

fst_status fst_identity_read(sqlite3 *database, const char *path, fst_identity_lines *lines, fst_error *error)
{
    sqlite3_stmt *query = NULL;
    lines->count = 0;
    int code = sqlite3_prepare_v2(database, "SELECT key, value FROM festoon ORDER BY key", -1, &query, NULL);
    int good = code == SQLITE_OK;
    while (good && (code = sqlite3_step(query)) == SQLITE_ROW)
        good = read_line(query, lines);
    fst_status status = FST_OK;
    if (code != SQLITE_DONE && code != SQLITE_ROW)
        status = fst_database_fail(database, path, error);
    (void)sqlite3_finalize(query);
    char sum[24];
    (void)snprintf(sum, sizeof sum, "%016llx", (unsigned long long)fst_identity_checksum(lines));
    const char *there = fst_identity_text(lines, "checksum");
    if (status == FST_OK && (!good || !there || strcmp(there, sum) != 0))
        status = fail_damaged(path, error);
    if (status != FST_OK)
        fst_identity_free(lines);
    return status;
}

fst_status fst_identity_grid(const fst_identity_lines *lines, const char *path, fst_grid **grid,
                             fst_error *error)
{
    const char *texts[FST_AXIS_LIMIT] = {NULL};
    const char *scene = fst_identity_text(lines, "scene"), *axes = fst_identity_text(lines, "axes");
    const char *seed = fst_identity_text(lines, "seed");
    const int count = axes ? atoi(axes) : 0;
    int good = scene && seed && count >= 1 && count <= FST_AXIS_LIMIT;
    for (int i = 0; good && i < count; ++i) {
        char key[24];
        (void)snprintf(key, sizeof key, "axis_%d", i + 1);
        texts[i] = fst_identity_text(lines, key);
        good = texts[i] != NULL;
    }
    fst_params params;
    if (!good)
        return fail_damaged(path, error);
    const fst_status status = read_scene(lines, path, &params, error);
    if (status != FST_OK)
        return status;
    const fst_status made = fst_grid_new(&params, texts, count, strtoull(seed, NULL, 10), grid, error);
    return made == FST_OK && fst_identity_text(lines, "rows") ? fst_grid_ask_levitation(*grid, error) : made;
}

fst_status fst_identity_of(const fst_identity_lines *lines, const char *path, const fst_grid *grid,
                           fst_sweep_identity *identity, fst_error *error)
{
    const char *seed = fst_identity_text(lines, "seed"), *carry = fst_identity_text(lines, "carry");
    const char *arithmetic = fst_identity_text(lines, "arithmetic"), *shard = fst_identity_text(lines, "shard");
    const char *fingerprint = fst_identity_text(lines, "fingerprint");
    if (!seed || !carry || !arithmetic || !fingerprint)
        return fail_damaged(path, error);
    *identity = (fst_sweep_identity){grid,
                                     strtoull(seed, NULL, 10),
                                     (fst_carry)fst_name_place(carry, FST_WORDS(FST_CARRIES)),
                                     (fst_arithmetic)fst_name_place(arithmetic, FST_WORDS(FST_ARITHMETICS)),
                                     strtoull(fingerprint, NULL, 16),
                                     0,
                                     1};
    if (!shard)
        return FST_OK;
    char *behind;
    const int64_t number = strtoll(shard, &behind, 10);
    identity->shards = *behind == '/' ? strtoll(behind + 1, NULL, 10) : 0;
    if (number < 1 || number > identity->shards || identity->shards > INT_MAX) /* as of fst_sweep_options */
        return fail_damaged(path, error);
    identity->shard = number - 1;
    return FST_OK;
}
