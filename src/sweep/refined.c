/* refined.c - how a sweep is refined: the options, their line in its database, and the values of the points
 * that were not computed, as figures show them.
 *
 * The line, `refine` in the table `festoon`, belongs to no row: a row has the same bits in every sweep of its
 * scene.  It says which points the last command wanted, so it may change, and has a checksum of its own.
 */
#include "sweep/refined.h"

#include <inttypes.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/checksum.h"
#include "base/error.h"
#include "base/number.h"
#include "sweep/columns.h"

/* ------------------------------------------------------------------ the options */

static int has_names(const char *key)
{
    return strcmp(key, "regime") == 0 || strcmp(key, "symmetry") == 0;
}

fst_status fst_refining_of(const fst_sweep_options *o, fst_refining *refining, fst_error *error)
{
    const char *key = o->refine_by ? o->refine_by : "regime";
    *refining = (fst_refining){.levels = o->refine, .step = o->refine_step};
    if (o->refine == 0)
        return FST_OK;
    if (o->carry != FST_CARRY_NO)
        return fst_fail(error, FST_BAD_INPUT, "fst_sweep_options.refine",
                        "a carried sweep cannot be refined: each of its runs starts from the one before it");
    const fst_status status = fst_sweep_check_key(key, "fst_sweep_options.refine_by", error);
    if (status != FST_OK)
        return status;
    (void)snprintf(refining->key, sizeof refining->key, "%s", key);
    if (has_names(key) && o->refine_step != 0)
        return fst_fail(error, FST_BAD_INPUT, "fst_sweep_options.refine_by",
                        "%s has names as values, so no step belongs to it", key);
    if (!has_names(key) && !(o->refine_step > 0 && isfinite(o->refine_step)))
        return fst_fail(
            error, FST_BAD_INPUT, "fst_sweep_options.refine_by",
            "%s is a number: say by how much it may change between neighbours, a positive number in "
            "its unit, as in mean_r:0.05",
            key);
    return FST_OK;
}

/* ------------------------------------------------------------------ its line */

static uint64_t sum_of(const fst_identity_lines *lines, const char *text, size_t length)
{
    return fst_checksum_bytes(fst_identity_checksum(lines), text, length);
}

static void write_text(const fst_identity_lines *lines, const fst_refining *refining, char text[128])
{
    char step[40];
    (void)fst_number_write(step, sizeof step, refining->step);
    const int length = snprintf(text, 96, "%d %s %s ", refining->levels, refining->key, step);
    (void)snprintf(text + length, 24, "%016" PRIx64, sum_of(lines, text, (size_t)length));
}

fst_status fst_refining_write(sqlite3 *database, const char *path, const fst_identity_lines *lines,
                              const fst_refining *refining, fst_error *error)
{
    char text[128];
    write_text(lines, refining, text);
    char *statement = refining->levels == 0
                          ? sqlite3_mprintf("DELETE FROM festoon WHERE key = 'refine'")
                          : sqlite3_mprintf("INSERT OR REPLACE INTO festoon VALUES('refine', %Q)", text);
    const fst_status status = statement ? fst_database_do(database, path, statement, error)
                                        : fst_fail(error, FST_NO_MEMORY, path, "out of memory");
    sqlite3_free(statement);
    return status;
}

fst_status fst_refining_read(const fst_identity_lines *lines, const char *path, fst_refining *refining,
                             fst_error *error)
{
    char key[48], step[40], written[128];
    const char *text = fst_identity_text(lines, "refine");
    *refining = (fst_refining){.levels = 0};
    if (!text)
        return FST_OK;
    if (sscanf(text, "%d %47s %39s", &refining->levels, key, step) == 3 && refining->levels >= 1 &&
        fst_sweep_check_key(key, "", NULL) == FST_OK) {
        (void)snprintf(refining->key, sizeof refining->key, "%s", key);
        refining->step = fst_number_read(step, strlen(step), 0);
        write_text(lines, refining, written);
        if (strcmp(written, text) == 0)
            return FST_OK;
    }
    return fst_fail(error, FST_BAD_INPUT, path,
                    "this sweep database is damaged: what it says of its refinement does not agree with its "
                    "checksum; nothing was changed: restore a copy, or choose another file");
}

/* ------------------------------------------------------------------ the points between */

/* Find the cells that the rows make. */
static fst_status replay(fst_refinement *r, const fst_sweep_table *table, const double *values,
                         fst_error *error)
{
    fst_status status = FST_OK;
    int64_t point;
    while (status == FST_OK && fst_refinement_next(r, &point))
        if (table->computed[point])
            status = fst_refinement_note(r, point, values[point], error);
    return status;
}

typedef struct filling {
    const fst_sweep_table *table;
    double *values; /* of the key that is filled in */
    int names;      /* its values are names: they are never between two others */
} filling;

/* The value at a place of a cell, from those of its corners; NAN where it does not follow from them. */
static double value_between(const filling *f, const fst_refined_cell *c, const int64_t at[FST_REFINED_AXES])
{
    double sum = 0.0;
    const double first = f->values[c->corners[0]];
    for (int i = 0; i < 1 << c->axes; ++i) {
        const double value = f->values[c->corners[i]];
        double weight = 1.0;
        for (int a = 0; a < c->axes; ++a) {
            const double part = (double)at[a] / (double)c->lengths[a];
            weight *= i >> a & 1 ? part : 1.0 - part;
        }
        if (isnan(value) || (f->names && value != first))
            return NAN;
        sum += weight * value;
    }
    return f->names ? first : sum;
}

static void fill_cell(void *user, const fst_refined_cell *c)
{
    const filling *f = user;
    int64_t at[FST_REFINED_AXES] = {0}, point = c->corners[0];
    for (int a = 0; a < c->axes;) {
        if (!f->table->computed[point])
            f->values[point] = value_between(f, c, at);
        for (a = 0; a < c->axes && at[a] == c->lengths[a]; ++a) { /* the next place, as a counter counts */
            point -= at[a] * c->strides[a];
            at[a] = 0;
        }
        if (a < c->axes) {
            at[a] += 1;
            point += c->strides[a];
        }
    }
}

/* Fill in one key, where the table has `by`, the key by which the sweep was refined. */
static fst_status fill_key(const fst_refining *refining, const double *by, int names, double *values,
                           const fst_sweep_table *table, fst_error *error)
{
    fst_refinement *r;
    fst_status status = fst_refinement_new(table->grid, refining->levels, refining->step, &r, error);
    if (status != FST_OK)
        return status;
    status = replay(r, table, by, error);
    filling f = {table, values, names};
    if (status == FST_OK)
        fst_refinement_tell_cells(r, fill_cell, &f);
    fst_refinement_free(r);
    return status;
}

fst_status fst_sweep_read_filled(const char *path, const char *const *keys, int count, fst_sweep_table *table,
                                 fst_error *error)
{
    const char *all[FST_SWEEP_FILLED_KEYS + 1];
    memset(table, 0, sizeof *table);
    if (count > FST_SWEEP_FILLED_KEYS)
        return fst_fail(error, FST_BAD_INPUT, "fst_sweep_read.keys", "at most %d keys are filled in",
                        FST_SWEEP_FILLED_KEYS);
    fst_refining refining;
    fst_sweep_file file;
    fst_status status = fst_sweep_file_open(path, 0, &file, error);
    if (status == FST_OK)
        status = fst_refining_read(&file.lines, path, &refining, error);
    fst_sweep_file_close(&file);
    if (status != FST_OK || refining.levels == 0)
        return status == FST_OK ? fst_sweep_read(path, keys, count, table, error) : status;
    memcpy(all, keys, (size_t)count * sizeof *all);
    all[count] = refining.key;
    status = fst_sweep_read(path, all, count + 1, table, error);
    const int64_t points = status == FST_OK ? fst_grid_points(table->grid) : 0;
    const double *by = table->values + count * points;
    for (int i = 0; i < count && status == FST_OK; ++i)
        status = fill_key(&refining, by, has_names(keys[i]), table->values + i * points, table, error);
    if (status != FST_OK)
        fst_sweep_table_free(table);
    return status;
}
