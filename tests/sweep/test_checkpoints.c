/* Images of unfinished runs: each byte of one, of its size, its checksum and its point is turned over, and two images
 * change places; none of them is taken for sound.
 * tests: sweep/checkpoints.c */
#include "physics.h"

#include <sqlite3.h>
#include <stdio.h>
#include <stdlib.h>
#include <unistd.h>

#include "sweep/checkpoints.h"

enum { SIZE = 203 };

typedef struct stored {
    int64_t point, size, checksum;
    unsigned char image[SIZE];
} stored;

static fst_checkpoints *images;
static sqlite3 *database;
static fst_journal *journal;
static uint64_t identity_hash;

static stored read_stored(int64_t point)
{
    stored s = {.point = point};
    sqlite3_stmt *row = NULL;
    assert_int_equal(sqlite3_prepare_v2(database,
                                        "SELECT size, checksum, image FROM checkpoints WHERE point = ?", -1,
                                        &row, NULL),
                     SQLITE_OK);
    (void)sqlite3_bind_int64(row, 1, point);
    assert_int_equal(sqlite3_step(row), SQLITE_ROW);
    s.size = sqlite3_column_int64(row, 0);
    s.checksum = sqlite3_column_int64(row, 1);
    memcpy(s.image, sqlite3_column_blob(row, 2), SIZE);
    (void)sqlite3_finalize(row);
    return s;
}

static void put_stored(const stored *s)
{
    sqlite3_stmt *row = NULL;
    assert_int_equal(
        sqlite3_prepare_v2(database, "INSERT OR REPLACE INTO checkpoints VALUES(?, ?, ?, ?)", -1, &row, NULL),
        SQLITE_OK);
    (void)sqlite3_bind_int64(row, 1, s->point);
    (void)sqlite3_bind_int64(row, 2, s->size);
    (void)sqlite3_bind_int64(row, 3, s->checksum);
    (void)sqlite3_bind_blob(row, 4, s->image, SIZE, SQLITE_STATIC);
    assert_int_equal(sqlite3_step(row), SQLITE_DONE);
    (void)sqlite3_finalize(row);
}

static int is_sound(int64_t point)
{
    size_t size = 0;
    void *image = fst_checkpoints_get(images, point, &size);
    const int sound = image && size == SIZE;
    free(image);
    return sound;
}

static void test_each_byte(void **unused)
{
    (void)unused;
    const stored good = read_stored(1);
    assert_true(is_sound(1));
    assert_int_equal(fst_checkpoints_damaged(images), 0);
    for (size_t i = offsetof(stored, size); i < offsetof(stored, image) + SIZE; ++i) {
        stored bad = good;
        ((unsigned char *)&bad)[i] ^= (unsigned char)(1 << i % 8);
        put_stored(&bad);
        assert_false(is_sound(1));
        assert_int_equal(fst_checkpoints_damaged(images), 1);
    }
    put_stored(&good);
    for (int bit = 2; bit < 63; ++bit) { /* the image of another point */
        stored moved = good;
        moved.point ^= (int64_t)1 << bit;
        put_stored(&moved);
        assert_false(is_sound(moved.point));
        assert_int_equal(fst_checkpoints_damaged(images), 1);
        assert_int_equal(fst_checkpoints_drop(images, moved.point, NULL), FST_OK);
    }
    assert_true(is_sound(1));
}

/* The same bytes beside the same point of another sweep. */
static void test_another_sweep(void **unused)
{
    (void)unused;
    fst_checkpoints *own = images;
    assert_int_equal(fst_checkpoints_open(journal, identity_hash ^ 1U, &images, NULL), FST_OK);
    assert_false(is_sound(1));
    assert_int_equal(fst_checkpoints_damaged(images), 2);
    fst_checkpoints_close(images);
    images = own;
    assert_true(is_sound(1));
}

static void test_exchange(void **unused)
{
    (void)unused;
    stored first = read_stored(1), second = read_stored(2);
    first.point = 2;
    second.point = 1;
    put_stored(&first);
    put_stored(&second);
    assert_false(is_sound(1) || is_sound(2));
    assert_int_equal(fst_checkpoints_damaged(images), 2);
}

int main(void)
{
    char path[] = "/tmp/festoon-checkpoints-XXXXXX", beside[64];
    const int file = mkstemp(path);
    (void)close(file);
    (void)unlink(path);
    const char *axes[] = {"model.kappa=1:2:8"};
    const fst_params params = fst_default_params();
    fst_grid *grid = NULL;
    fst_error error = {FST_OK, "", ""};
    fst_status status = fst_grid_new(&params, axes, 1, 1, &grid, &error);
    const fst_sweep_identity identity = {.grid = grid, .seed = 1};
    identity_hash = status == FST_OK ? fst_journal_identity_hash(&identity) : 0;
    if (status != FST_OK || fst_journal_open(path, &identity, &journal, &error) != FST_OK ||
        fst_checkpoints_open(journal, identity_hash, &images, &error) != FST_OK) {
        (void)fprintf(stderr, "%s: %s\n", error.where, error.sentence);
        return 1;
    }
    database = fst_journal_database(journal);
    for (int point = 1; point <= 2; ++point) {
        unsigned char bytes[SIZE];
        for (int i = 0; i < SIZE; ++i)
            bytes[i] = (unsigned char)(37 * i + point);
        if (fst_checkpoints_put(images, point, bytes, SIZE, &error) != FST_OK)
            return 1;
    }
    const struct CMUnitTest tests[] = {cmocka_unit_test(test_each_byte), cmocka_unit_test(test_another_sweep),
                                       cmocka_unit_test(test_exchange)};
    const int failed = cmocka_run_group_tests(tests, NULL, NULL);
    fst_checkpoints_close(images);
    (void)fst_journal_close(journal, NULL);
    fst_grid_free(grid);
    (void)unlink(path);
    (void)snprintf(beside, sizeof beside, "%s-wal", path);
    (void)unlink(beside);
    return failed;
}
