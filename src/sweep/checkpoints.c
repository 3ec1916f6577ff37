/* checkpoints.c - images of unfinished runs, kept in the database so that a killed sweep goes on from them. */
#include "sweep/checkpoints.h"

#include <stdlib.h>
#include <string.h>

#include "base/error.h"
#include "base/checksum.h"
#include "sweep/database.h"

struct fst_checkpoints {
    fst_journal *journal;
    sqlite3 *database;
    const char *path;
    uint64_t identity;
    sqlite3_stmt *put, *get, *drop; /* NULL until the table exists */
};

/* The checksum covers the image and everything that must fit it: sweep, point and size. */
static sqlite3_int64 checksum(uint64_t identity, int64_t point, const void *image, size_t size)
{
    return (sqlite3_int64)fst_checksum_bytes(fst_checksum_word(identity, (uint64_t)point), image, size);
}

/* The image in a row of point, size, checksum and image; NULL: it is damaged, or another point's. */
static const void *sound_image(const fst_checkpoints *c, sqlite3_stmt *row, size_t *size)
{
    const void *image = sqlite3_column_blob(row, 3);
    const int bytes = sqlite3_column_bytes(row, 3);
    *size = image ? (size_t)bytes : 0;
    return image && sqlite3_column_int64(row, 1) == bytes &&
                   sqlite3_column_int64(row, 2) ==
                       checksum(c->identity, sqlite3_column_int64(row, 0), image, *size)
               ? image
               : NULL;
}

static fst_status prepare(fst_checkpoints *c, fst_error *error)
{
    if (sqlite3_prepare_v2(c->database,
                           "INSERT OR REPLACE INTO checkpoints SELECT ?1, ?2, ?3, ?4 "
                           "WHERE NOT EXISTS (SELECT 1 FROM rows WHERE point = ?1)",
                           -1, &c->put, NULL) == SQLITE_OK &&
        sqlite3_prepare_v2(c->database, "SELECT point, size, checksum, image FROM checkpoints WHERE point = ?",
                           -1, &c->get, NULL) == SQLITE_OK &&
        sqlite3_prepare_v2(c->database, "DELETE FROM checkpoints WHERE point = ?", -1, &c->drop, NULL) ==
            SQLITE_OK)
        return FST_OK;
    return fst_database_fail(c->database, c->path, error);
}

static void forget_statements(fst_checkpoints *c)
{
    (void)sqlite3_finalize(c->put);
    (void)sqlite3_finalize(c->get);
    (void)sqlite3_finalize(c->drop);
    c->put = c->get = c->drop = NULL;
}

fst_status fst_checkpoints_open(fst_journal *journal, uint64_t identity, fst_checkpoints **checkpoints,
                                fst_error *error)
{
    fst_checkpoints *c = calloc(1, sizeof *c);
    *checkpoints = c;
    if (!c)
        return fst_fail(error, FST_NO_MEMORY, "fst_sweep", "out of memory");
    c->journal = journal;
    c->database = fst_journal_database(journal);
    c->path = fst_journal_path(journal);
    c->identity = identity;
    sqlite3_stmt *look = NULL;
    const int there = sqlite3_prepare_v2(c->database,
                                         "SELECT 1 FROM sqlite_master WHERE type = 'table' AND name = "
                                         "'checkpoints'",
                                         -1, &look, NULL) == SQLITE_OK &&
                      sqlite3_step(look) == SQLITE_ROW;
    (void)sqlite3_finalize(look);
    return there ? prepare(c, error) : FST_OK;
}

fst_status fst_checkpoints_put(fst_checkpoints *c, int64_t point, const void *image, size_t size,
                               fst_error *error)
{
    fst_status status = fst_journal_begin(c->journal, error);
    if (status == FST_OK && !c->put) {
        status = fst_database_do(c->database, c->path, FST_CHECKPOINTS_TABLE, error);
        if (status == FST_OK)
            status = prepare(c, error);
    }
    if (status != FST_OK)
        return status;
    (void)sqlite3_bind_int64(c->put, 1, point);
    (void)sqlite3_bind_int64(c->put, 2, (sqlite3_int64)size);
    (void)sqlite3_bind_int64(c->put, 3, checksum(c->identity, point, image, size));
    (void)sqlite3_bind_blob64(c->put, 4, image, size, SQLITE_STATIC);
    if (sqlite3_step(c->put) != SQLITE_DONE)
        status = fst_database_fail(c->database, c->path, error);
    (void)sqlite3_reset(c->put);
    (void)sqlite3_clear_bindings(c->put);
    return status;
}

void *fst_checkpoints_get(fst_checkpoints *c, int64_t point, size_t *size)
{
    void *image = NULL;
    if (!c->get)
        return NULL;
    (void)sqlite3_bind_int64(c->get, 1, point);
    const void *there = sqlite3_step(c->get) == SQLITE_ROW ? sound_image(c, c->get, size) : NULL;
    if (there && (image = malloc(*size)))
        memcpy(image, there, *size);
    (void)sqlite3_reset(c->get);
    return image;
}

int64_t fst_checkpoints_damaged(fst_checkpoints *c)
{
    sqlite3_stmt *all = NULL;
    size_t size;
    int64_t damaged = 0;
    int code = SQLITE_DONE;
    if (c->get)
        code = sqlite3_prepare_v2(c->database, "SELECT point, size, checksum, image FROM checkpoints", -1, &all,
                                  NULL);
    while (c->get && (code = sqlite3_step(all)) == SQLITE_ROW)
        damaged += !sound_image(c, all, &size);
    (void)sqlite3_finalize(all);
    return damaged + fst_database_is_damage(code); /* further ones cannot be read */
}

fst_status fst_checkpoints_drop(fst_checkpoints *c, int64_t point, fst_error *error)
{
    if (!c->drop)
        return FST_OK;
    (void)sqlite3_bind_int64(c->drop, 1, point);
    const fst_status status =
        sqlite3_step(c->drop) == SQLITE_DONE ? FST_OK : fst_database_fail(c->database, c->path, error);
    (void)sqlite3_reset(c->drop);
    return status;
}

fst_status fst_checkpoints_drop_all(fst_checkpoints *c, fst_error *error)
{
    if (!c->drop)
        return FST_OK;
    forget_statements(c); /* SQLite does not drop a table that a statement uses */
    fst_status status = fst_journal_begin(c->journal, error);
    if (status == FST_OK)
        status = fst_database_do(c->database, c->path, "DROP TABLE checkpoints", error);
    return status == FST_OK ? fst_journal_commit(c->journal, error) : status;
}

void fst_checkpoints_close(fst_checkpoints *c)
{
    if (!c)
        return;
    forget_statements(c);
    free(c);
}
