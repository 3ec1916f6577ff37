/* Output files that appear whole or not at all: a temporary file is removed if its writer is dead, and kept if
 * its writer lives. And texts that are made harmless.
 * tests: host/whole_file.c host/file_lock.c base/text.c
 * labels: memcheck */
#include "numeric.h"

#include <fcntl.h>
#include <stdio.h>
#include <stdlib.h>
#include <sys/stat.h>
#include <unistd.h>

#include "base/text.h"
#include "host/file_lock.h"
#include "host/whole_file.h"

static char folder[64];

static int make_folder(void **state)
{
    (void)state;
    (void)strcpy(folder, "/tmp/festoon-whole-XXXXXX");
    return mkdtemp(folder) ? 0 : -1;
}

static int remove_folder(void **state)
{
    (void)state;
    char command[128];
    (void)snprintf(command, sizeof command, "rm -rf %s", folder);
    return system(command);
}

static const char *inside(const char *name)
{
    static char paths[4][512];
    static int turn;
    char *path = paths[turn = (turn + 1) % 4];
    (void)snprintf(path, sizeof paths[0], "%s/%s", folder, name);
    return path;
}

static int exists(const char *path)
{
    return access(path, F_OK) == 0;
}

/* Makes the file that a killed command leaves; returns its open descriptor. */
static int leave_file(const char *path)
{
    const int descriptor = open(path, O_RDWR | O_CREAT, 0600);
    assert_true(descriptor >= 0);
    return descriptor;
}

/* The temporary name of `name` for another process. */
static char *other_writers(const char *name)
{
    fst_whole_file file;
    assert_int_equal(fst_whole_file_open(&file, inside(name), NULL), FST_OK);
    char *path = strdup(file.temporary), *mark = path ? strrchr(path, '-') : NULL;
    assert_non_null(mark);
    mark[1] = '7'; /* the number of the try */
    fst_whole_file_discard(&file);
    assert_false(exists(path));
    return path;
}

static void write_whole(const char *path)
{
    fst_whole_file file;
    assert_int_equal(fst_whole_file_open(&file, path, NULL), FST_OK);
    assert_true(fputs("new\n", file.stream) >= 0);
    assert_int_equal(fst_whole_file_commit(&file, NULL), FST_OK);
    assert_true(exists(path));
}

static void leftovers_are_removed(void **state)
{
    (void)state;
    char *dead = other_writers("a.csv"), *cousin = other_writers("a.csv.old");
    (void)close(leave_file(dead));
    (void)close(leave_file(cousin));
    write_whole(inside("a.csv"));
    assert_false(exists(dead));
    assert_true(exists(cousin)); /* it belongs to another file */
    fst_whole_file_tidy(folder, ".a.csv");
    assert_false(exists(cousin));
    free(dead);
    free(cousin);
}

static void files_in_work_stay(void **state)
{
    (void)state;
    char *living = other_writers("b.csv");
    const int descriptor = leave_file(living);
    assert_int_equal(fst_lock_byte(descriptor, FST_LOCK_WRITING, 0), 0);
    write_whole(inside("b.csv"));
    assert_true(exists(living));
    fst_whole_file_tidy(folder, ".b");
    assert_true(exists(living));
    (void)close(descriptor);
    write_whole(inside("b.csv"));
    assert_false(exists(living));
    free(living);
}

/* Kept: files of other hosts, whose locks may be invisible here, and files of other programs; links are not
 * followed. */
static void foreign_files_stay(void **state)
{
    (void)state;
    static const char *const names[] = {".c.csv.part", ".c.csv.00000000-12-0.part", ".c.csv.12-0.part",
                                        ".c.csv.x-0.part", "c.csv.part"};
    for (size_t i = 0; i < sizeof names / sizeof *names; ++i)
        (void)close(leave_file(inside(names[i])));
    char *link = other_writers("c.csv");
    assert_int_equal(symlink("c.csv.part", link), 0);
    write_whole(inside("c.csv"));
    for (size_t i = 0; i < sizeof names / sizeof *names; ++i)
        assert_true(exists(inside(names[i])));
    assert_true(exists(link));
    free(link);
}

static void a_removed_file_is_no_success(void **state)
{
    (void)state;
    fst_error error;
    fst_whole_file file;
    assert_int_equal(fst_whole_file_open(&file, inside("d.csv"), NULL), FST_OK);
    assert_int_equal(unlink(file.temporary), 0);
    (void)close(leave_file(file.temporary)); /* another program's file of that name is kept */
    assert_int_equal(fst_whole_file_commit(&file, &error), FST_IO);
    assert_non_null(strstr(error.sentence, "removed"));
    assert_false(exists(inside("d.csv")));
}

static void a_link_is_followed(void **state)
{
    (void)state;
    struct stat there;
    assert_int_equal(mkdir(inside("deep"), 0700), 0);
    (void)close(leave_file(inside("deep/e.csv")));
    assert_int_equal(symlink("deep/e.csv", inside("e.csv")), 0);
    write_whole(inside("e.csv"));
    assert_int_equal(lstat(inside("e.csv"), &there), 0);
    assert_true(S_ISLNK(there.st_mode));
    assert_int_equal(stat(inside("deep/e.csv"), &there), 0);
    assert_int_equal(there.st_size, 4);
}

/* ------------------------------------------------------------------ texts */

static void texts_are_tamed(void **state)
{
    (void)state;
    static const char *const pairs[][2] = {
        {"plain < text' \"`$", "plain < text' \"`$"},
        {"line\nline\ttab\r", "line?line?tab?"},
        {"\x1b[2J\x7f", "?[2J?"},
        {"\xc2\x9b"
         "2J",
         "?2J"}, /* a terminal's CSI in one character */
        {"\xc2\xb5m \xce\xb3 \xe2\x82\xac \xf0\x9f\x98\x80",
         "\xc2\xb5m \xce\xb3 \xe2\x82\xac \xf0\x9f\x98\x80"},
        {"a\xe2\x80\xae"
         "b\xe2\x80\xa8",
         "a?b?"},                                    /* turns the direction of writing; a line separator */
        {"\xff\xc3", "??"},                          /* invalid UTF-8; half a character */
        {"\xc0\x8a\xe0\x80\x8a", "?????"},           /* a line feed in overlong forms */
        {"\xed\xa0\x80\xf5\x80\x80\x80", "???????"}, /* a surrogate; beyond the last character */
        {"", ""},
    };
    for (size_t i = 0; i < sizeof pairs / sizeof *pairs; ++i) {
        char text[64];
        (void)snprintf(text, sizeof text, "%s", pairs[i][0]);
        fst_text_tame(text);
        assert_string_equal(text, pairs[i][1]);
    }
    char quoted[FST_QUOTE_SIZE];
    assert_string_equal(fst_quote("a\nb", quoted), "\"a?b\"");
}

/* A sweep renames its file by itself. The next file of this process then has the same temporary name, and must
 * stay when the first one is given up. */
static int holds_lock(const char *path, off_t place)
{
    struct stat there;
    return stat(path, &there) == 0 && fst_holds_lock(&there, place);
}

static void a_name_that_came_free(void **state)
{
    (void)state;
    fst_whole_file first, second;
    fst_error error;
    const char *place = inside("same");
    assert_int_equal(fst_whole_file_open(&first, place, &error), FST_OK);
    assert_int_equal(rename(first.temporary, place), 0);
    assert_int_equal(fst_whole_file_open(&second, place, &error), FST_OK);
    assert_string_equal(second.temporary, first.temporary);
    assert_false(holds_lock(place, FST_LOCK_SWEEP));
    assert_true(holds_lock(place, FST_LOCK_WRITING)); /* the first one's lock, under its new name */
    fst_whole_file_discard(&first);
    assert_false(holds_lock(place, FST_LOCK_WRITING));
    assert_true(exists(second.temporary));
    assert_int_equal(fst_whole_file_commit(&second, &error), FST_OK);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(leftovers_are_removed), cmocka_unit_test(files_in_work_stay),
        cmocka_unit_test(foreign_files_stay),    cmocka_unit_test(a_removed_file_is_no_success),
        cmocka_unit_test(a_link_is_followed),    cmocka_unit_test(texts_are_tamed),
        cmocka_unit_test(a_name_that_came_free)};
    return cmocka_run_group_tests(tests, make_folder, remove_folder);
}
