/* reseal.c - for tests: give what a test has put into a sweep's database the checksums that it then should
 * have, and its rows their axes.
 *
 *     reseal FILE.db
 *
 * Where the scene is one that this program cannot read, only the scene's checksum is made: status 3.
 */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "sweep/columns.h"
#include "sweep/identity.h"

static void stop(const char *what)
{
    (void)fprintf(stderr, "reseal: %s\n", what);
    exit(1);
}

static void execute(sqlite3 *database, const char *sql)
{
    if (sqlite3_exec(database, sql, NULL, NULL, NULL) != SQLITE_OK)
        stop(sqlite3_errmsg(database));
}

static sqlite3_stmt *query(sqlite3 *database, const char *sql)
{
    sqlite3_stmt *made = NULL;
    if (sqlite3_prepare_v2(database, sql, -1, &made, NULL) != SQLITE_OK)
        stop(sqlite3_errmsg(database));
    return made;
}

static void read_lines(sqlite3 *database, fst_identity_lines *lines)
{
    sqlite3_stmt *row = query(database, "SELECT key, value FROM festoon ORDER BY key");
    while (sqlite3_step(row) == SQLITE_ROW) {
        (void)snprintf(lines->keys[lines->count], sizeof lines->keys[0], "%s",
                       (const char *)sqlite3_column_text(row, 0));
        lines->values[lines->count++] = strdup((const char *)sqlite3_column_text(row, 1));
    }
    (void)sqlite3_finalize(row);
}

/* Sets the axes whose values are numbers; choices are left as they are. */
static void set_axes(sqlite3 *database, const fst_grid *grid)
{
    for (int i = 0; i < fst_grid_axis_count(grid); ++i) {
        const char *key = fst_grid_key(grid, i);
        if (fst_param_at(fst_param_find(key))->kind == FST_KIND_CHOICE)
            continue;
        char *sql = sqlite3_mprintf("UPDATE rows SET \"%s\" = ? WHERE point = ?", key);
        sqlite3_stmt *points = query(database, "SELECT point FROM rows"), *set = query(database, sql);
        sqlite3_free(sql);
        while (sqlite3_step(points) == SQLITE_ROW) {
            const int64_t point = sqlite3_column_int64(points, 0);
            if (point < 0 || point >= fst_grid_points(grid))
                continue;
            (void)sqlite3_bind_double(set, 1, fst_grid_value(grid, i, point));
            (void)sqlite3_bind_int64(set, 2, point);
            if (sqlite3_step(set) != SQLITE_DONE)
                stop(sqlite3_errmsg(database));
            (void)sqlite3_reset(set);
        }
        (void)sqlite3_finalize(points);
        (void)sqlite3_finalize(set);
    }
}

static void set_checksums(sqlite3 *database, const fst_grid *grid, uint64_t seed)
{
    sqlite3_stmt *rows = query(database, "SELECT * FROM rows");
    sqlite3_stmt *set = query(database, "UPDATE rows SET checksum = ? WHERE point = ?");
    const int count = fst_sweep_column_count(grid);
    while (sqlite3_step(rows) == SQLITE_ROW) {
        (void)sqlite3_bind_int64(set, 1, (sqlite3_int64)fst_sweep_row_checksum(rows, count, seed));
        (void)sqlite3_bind_int64(set, 2, sqlite3_column_int64(rows, 0));
        if (sqlite3_step(set) != SQLITE_DONE)
            stop(sqlite3_errmsg(database));
        (void)sqlite3_reset(set);
    }
    (void)sqlite3_finalize(rows);
    (void)sqlite3_finalize(set);
}

int main(int argc, char **argv)
{
    sqlite3 *database = NULL;
    fst_identity_lines lines = {.count = 0};
    fst_grid *grid = NULL;
    fst_error error = {FST_OK, "", ""};
    if (argc != 2 || sqlite3_open_v2(argv[1], &database, SQLITE_OPEN_READWRITE, NULL) != SQLITE_OK)
        stop("reseal FILE.db");
    read_lines(database, &lines);
    const uint64_t seed = fst_identity_checksum(&lines);
    execute(database, "BEGIN");
    char *sql = sqlite3_mprintf("UPDATE festoon SET value = '%016llx' WHERE key = 'checksum'",
                                (unsigned long long)seed);
    execute(database, sql);
    const int known = fst_identity_grid(&lines, argv[1], &grid, &error) == FST_OK;
    if (known) {
        set_axes(database, grid);
        set_checksums(database, grid, seed);
    }
    execute(database, "COMMIT");
    sqlite3_free(sql);
    fst_grid_free(grid);
    fst_identity_free(&lines);
    (void)sqlite3_close(database);
    return known ? 0 : 3;
}
