/* rows.c - reading the rows of a sweep's database in order, past any damage.
 *
 * Each row is checked against its checksum, the types of its columns and the grid.  Where a page cannot be
 * read, the reading starts again at the next point, and the points between are noted as lost.
 */
#include <inttypes.h>
#include <stdlib.h>
#include <string.h>

#include "base/error.h"
#include "base/watch.h"
#include "sweep/columns.h"
#include "sweep/file.h"

/* A damaged inner page of the tree hides thousands of points.  After so many failures in a row the search for
 * the next readable row takes longer and longer steps. */
enum { PATIENCE = 4096 };

void fst_lost_points_add(fst_lost_points *lost, int64_t first, int64_t last)
{
    lost->count += last - first + 1;
    const int i = lost->range_count - 1;
    if (i >= 0 && lost->ranges[i].last + 1 == first) {
        lost->ranges[i].last = last;
    } else if (i + 1 < FST_LOST_RANGES) {
        lost->ranges[i + 1].first = first;
        lost->ranges[i + 1].last = last;
        ++lost->range_count;
    }
}

fst_status fst_sweep_rows_begin(fst_sweep_rows *rows, const fst_sweep_file *file, fst_error *error)
{
    memset(rows, 0, sizeof *rows);
    rows->file = file;
    char *select = fst_sweep_select_sql();
    fst_status status = FST_OK;
    if (!select)
        status = fst_fail(error, FST_NO_MEMORY, file->name, "out of memory");
    else if (sqlite3_prepare_v2(file->database, select, -1, &rows->row, NULL) != SQLITE_OK)
        status = fst_database_fail(file->database, file->name, error);
    else if (sqlite3_bind_int64(rows->row, 1, INT64_MIN) != SQLITE_OK)
        status = fst_database_fail(file->database, file->name, error);
    free(select);
    return status;
}

void fst_sweep_rows_end(fst_sweep_rows *rows)
{
    (void)sqlite3_finalize(rows->row);
    rows->row = NULL;
}

/* Look for the first readable row at or behind a point. */
static int seek(fst_sweep_rows *rows, int64_t point)
{
    (void)sqlite3_reset(rows->row);
    (void)sqlite3_bind_int64(rows->row, 1, point);
    return sqlite3_step(rows->row);
}

/* Pass over the points from rows->next on that cannot be read. */
static int pass_damage(fst_sweep_rows *rows)
{
    const int64_t end = fst_grid_points(rows->file->grid);
    int64_t step = 1;
    int code = SQLITE_CORRUPT;
    for (int failures = 1; fst_database_is_damage(code) && rows->next < end; ++failures) {
        const int64_t last = rows->next + step <= end ? rows->next + step - 1 : end - 1;
        fst_lost_points_add(&rows->lost, rows->next, last);
        rows->next = last + 1;
        code = rows->next < end ? seek(rows, rows->next) : SQLITE_DONE;
        step = failures < PATIENCE ? 1 : 2 * step;
    }
    return rows->next < end || !fst_database_is_damage(code) ? code : SQLITE_DONE;
}

fst_status fst_sweep_rows_tell(const fst_sweep_rows *rows, int64_t point, fst_error *error)
{
    enum { BETWEEN = 1024 };
    if (!rows->progress || point % BETWEEN != 0)
        return FST_OK;
    return fst_tell(rows->progress, (double)point / (double)fst_grid_points(rows->file->grid), "rows", error);
}

fst_status fst_sweep_rows_next(fst_sweep_rows *rows, int *more, fst_error *error)
{
    const fst_sweep_file *file = rows->file;
    const int64_t end = fst_grid_points(file->grid);
    *more = 0;
    for (;;) {
        int code = sqlite3_step(rows->row);
        if (fst_database_is_damage(code))
            code = pass_damage(rows);
        if (code == SQLITE_DONE)
            return FST_OK;
        if (code != SQLITE_ROW)
            return fst_database_fail(file->database, file->name, error);
        const int64_t point = sqlite3_column_int64(rows->row, 0);
        if (point < rows->next || point >= end) { /* it belongs to no point, or is out of order */
            ++rows->lost.outside;
            continue;
        }
        rows->next = point + 1;
        if (fst_sweep_row_is_sound(rows->row, file->grid, file->seed)) {
            ++rows->sound;
            *more = 1;
            return fst_sweep_rows_tell(rows, rows->sound, error);
        }
        fst_lost_points_add(&rows->lost, point, point);
    }
}

int fst_sweep_rows_are_whole(const fst_sweep_rows *rows)
{
    return rows->lost.count == 0 && rows->lost.outside == 0 && rows->file->log != FST_LOG_DAMAGED &&
           !rows->file->finding[0];
}

void fst_lost_points_name(const fst_lost_points *lost, char *text, size_t size)
{
    size_t used = 0;
    text[0] = '\0';
    int64_t named = 0;
    for (int i = 0; i < lost->range_count && used < size; ++i) {
        const int64_t first = lost->ranges[i].first, last = lost->ranges[i].last;
        used += (size_t)snprintf(text + used, size - used, "%s%" PRId64, i ? ", " : "", first);
        if (last > first && used < size)
            used += (size_t)snprintf(text + used, size - used, "-%" PRId64, last);
        named += last - first + 1;
    }
    if (named < lost->count && used < size)
        (void)snprintf(text + used, size - used, " and %" PRId64 " more", lost->count - named);
}

fst_status fst_sweep_rows_fail(const fst_sweep_rows *rows, const char *others, fst_error *error)
{
    char points[240], what[300] = "";
    const fst_sweep_file *file = rows->file;
    fst_lost_points_name(&rows->lost, points, sizeof points);
    if (rows->lost.count > 0)
        (void)snprintf(what, sizeof what,
                       rows->lost.count == 1 ? "the row of point %s is lost"
                                             : "the rows of the points %s are lost",
                       points);
    else if (rows->lost.outside > 0)
        (void)snprintf(what, sizeof what, "%" PRId64 " of its rows belong to no point of this sweep",
                       rows->lost.outside);
    else if (file->log == FST_LOG_DAMAGED)
        (void)snprintf(what, sizeof what, "part of its log cannot be read, and the last rows may be lost");
    else
        (void)snprintf(what, sizeof what, "no lost row was found, but some may be missing");
    return fst_fail(
        error, FST_BAD_INPUT, file->name,
        "this sweep database is damaged%s%s%s: %s. %sThe same sweep command computes lost rows again",
        file->finding[0] ? " (" : "", file->finding, file->finding[0] ? ")" : "", what, others);
}
