/* merge.c - the shards of a sweep, each in a database of its own, joined in a new database of the whole sweep.
 *
 * The files are read one after another while the new database has no name yet (make.c), so there is either a whole
 * one or none.  What they are sweeps of must agree; a point that several of them have must have the same row.
 */
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "base/error.h"
#include "base/watch.h"
#include "sweep/make.h"

typedef struct merging {
    const char *const *paths;
    int count;
    const char *out;
    const fst_progress *progress;
    fst_sweep_identity identity; /* of the first file, without its shard */
    fst_sweep_merged *merged;
    fst_error damage; /* of the first damaged file */
} merging;

/* Open a file that is a part of a sweep. */
static fst_status open_part(const char *path, fst_sweep_file *file, fst_error *error)
{
    const fst_status status = fst_sweep_file_open(path, 0, file, error);
    file->is_left = 1;
    if (status == FST_OK && fst_identity_text(&file->lines, "refine"))
        return fst_fail(
            error, FST_BAD_INPUT, path,
            "this sweep is refined, and such a one cannot be merged: which points it computes follows "
            "from all its rows");
    return status;
}

/* Copy the rows of an open file. */
static fst_status take_rows(merging *m, const fst_sweep_file *file, sqlite3 *database, uint64_t seed,
                            fst_error *error)
{
    fst_sweep_rows rows;
    int64_t differs = -1;
    fst_status status = fst_sweep_rows_begin(&rows, file, error);
    if (status == FST_OK)
        status = fst_sweep_copy_rows(&rows, database, m->out, seed, &differs, error);
    if (status == FST_OK && differs >= 0)
        status =
            fst_fail(error, FST_BAD_INPUT, file->name,
                     "point %lld has another row here than in a file before this one: they are not parts of "
                     "one sweep, whatever they say; nothing was written",
                     (long long)differs);
    if (status == FST_OK && !fst_sweep_rows_are_whole(&rows) && m->merged->damaged++ == 0)
        (void)fst_sweep_rows_fail(&rows, "The other rows were merged. ", &m->damage);
    fst_sweep_rows_end(&rows);
    return status;
}

static fst_status take_file(merging *m, const char *path, sqlite3 *database, uint64_t seed, fst_error *error)
{
    fst_sweep_file file;
    fst_status status = open_part(path, &file, error);
    if (status == FST_OK)
        status = fst_identity_compare(&file.lines, path, &m->identity, m->paths[0], error);
    if (status == FST_OK)
        status = take_rows(m, &file, database, seed, error);
    fst_sweep_file_close(&file);
    return status;
}

/* Count the rows of the new database, and note which points have none. */
static fst_status find_missing(merging *m, sqlite3 *database, fst_error *error)
{
    const int64_t end = fst_grid_points(m->identity.grid);
    fst_lost_points missing = {.count = 0};
    int64_t next = 0, point = -1;
    sqlite3_stmt *query = NULL;
    int code = sqlite3_prepare_v2(database, "SELECT point FROM rows ORDER BY point", -1, &query, NULL);
    while (point < end && (code == SQLITE_OK || code == SQLITE_ROW)) {
        code = sqlite3_step(query);
        point = code == SQLITE_ROW ? sqlite3_column_int64(query, 0) : end;
        if (point > next)
            fst_lost_points_add(&missing, next, point - 1);
        next = point + 1;
    }
    const fst_status status = code == SQLITE_DONE ? FST_OK : fst_database_fail(database, m->out, error);
    (void)sqlite3_finalize(query);
    fst_lost_points_name(&missing, m->merged->missing, sizeof m->merged->missing);
    m->merged->points = end;
    m->merged->rows = end - missing.count;
    return status;
}

static fst_status take_all(void *user, sqlite3 *database, uint64_t seed, fst_error *error)
{
    merging *m = user;
    fst_status status = FST_OK;
    for (int i = 0; i < m->count && status == FST_OK; ++i) {
        status = take_file(m, m->paths[i], database, seed, error);
        if (status == FST_OK)
            status = fst_tell(m->progress, (i + 1.0) / m->count, NULL, error);
    }
    return status == FST_OK ? find_missing(m, database, error) : status;
}

static fst_status make_whole(merging *m, fst_error *error)
{
    const fst_sweep_filling filling = {take_all, m};
    int descriptor = -1;
    char *path;
    fst_status status = fst_database_path(m->out, &path, error);
    if (status != FST_OK)
        return status;
    if (!fst_sweep_is_made(path))
        status = fst_sweep_make(m->out, path, &m->identity, &filling, 1, &descriptor, error);
    if (status == FST_OK && descriptor < 0)
        status = fst_fail(error, FST_BAD_INPUT, m->out,
                          "this file is there already, and was left untouched: choose the name of a new one");
    if (descriptor >= 0)
        (void)close(descriptor);
    free(path);
    return status;
}

fst_status fst_sweep_merge(const char *const *paths, int count, const char *out, const fst_progress *progress,
                           fst_sweep_merged *merged, fst_error *error)
{
    fst_sweep_file first;
    memset(merged, 0, sizeof *merged);
    if (count < 1)
        return fst_fail(error, FST_BAD_INPUT, "fst_sweep_merge", "there are no databases to be merged");
    fst_status status = open_part(paths[0], &first, error);
    merging m = {paths, count, out, progress, first.identity, merged, {FST_OK, "", ""}};
    m.identity.shard = 0;
    m.identity.shards = 1;
    if (status == FST_OK)
        status = make_whole(&m, error);
    fst_sweep_file_close(&first);
    if (status == FST_OK && merged->damaged > 0) {
        status = m.damage.code;
        if (error)
            *error = m.damage;
    }
    return status;
}
