/* refined.c - how a sweep is refined: the options, and their line in its database.
 *
 * The line, `refine` in the table `festoon`, belongs to no row: a row has the same bits in every sweep of its
 * scene.  It says which points the last command wanted, so it may change, and has a checksum of its own.
 */
#include "sweep/refined.h"

#include <inttypes.h>
#include <math.h>
#include <string.h>

#include "base/checksum.h"
#include "base/error.h"
#include "base/number.h"
#include "sweep/columns.h"

/* ------------------------------------------------------------------ the options */

int fst_sweep_has_names(const char *key)
{
    const fst_bead_column *own = fst_bead_column_find(key);
    return strcmp(key, "symmetry") == 0 || (own && own->names);
}

fst_status fst_refining_of(const fst_sweep_options *o, fst_refining *refining, fst_error *error)
{
    const char *key = o->refine_by ? o->refine_by : "regime";
    *refining = (fst_refining){.levels = o->refine, .step = o->refine_step};
    if (o->refine == 0 && (o->refine_by || o->refine_step != 0))
        return fst_fail(
            error, FST_BAD_INPUT, "fst_sweep_options.refine_by",
            "a key or a step belongs to a refined sweep, but `refine` is 0: give it a number of levels");
    if (o->refine == 0)
        return FST_OK;
    if (o->carry != FST_CARRY_NO)
        return fst_fail(error, FST_BAD_INPUT, "fst_sweep_options.refine",
                        "a carried sweep cannot be refined: each of its runs starts from the one before it");
    const fst_status status = fst_sweep_check_key(NULL, key, "fst_sweep_options.refine_by", error);
    if (status != FST_OK)
        return status;
    (void)snprintf(refining->key, sizeof refining->key, "%s", key);
    if (fst_sweep_has_names(key) && o->refine_step != 0)
        return fst_fail(error, FST_BAD_INPUT, "fst_sweep_options.refine_by",
                        "%s has names as values, so no step belongs to it", key);
    if (!fst_sweep_has_names(key) && !(o->refine_step > 0 && isfinite(o->refine_step)))
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
        fst_sweep_check_key(NULL, key, "", NULL) == FST_OK) {
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
