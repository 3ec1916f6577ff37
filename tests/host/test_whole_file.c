/* Output files that appear whole or not at all: what is on the disk, in which order, and what remains if the
 * disk refuses. The test's own fsync() takes the place of the system's and notes each call.
 * tests: host/whole_file.c */
#include "numeric.h"

#include <dirent.h>
#include <errno.h>
#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <unistd.h>

#include <festoon/festoon_tools.h>

#include "host/whole_file.h"

static char folder[] = "/tmp/festoon-whole-file-XXXXXX", path[64];

/* ------------------------------------------------------------------ what fsync() was asked for */

enum { CONTENT = 11 };
static int content_before_name, folder_after_name, refuse;

static int there(void)
{
    struct stat found;
    return stat(path, &found) == 0 && found.st_size == CONTENT;
}

int fsync(int descriptor)
{
    struct stat found;
    if (refuse) {
        errno = EIO;
        return -1;
    }
    assert_int_equal(fstat(descriptor, &found), 0);
    content_before_name += S_ISREG(found.st_mode) && found.st_size == CONTENT && !there();
    folder_after_name += S_ISDIR(found.st_mode) && there();
    return 0;
}

/* ------------------------------------------------------------------ */

static int make_folder(void **state)
{
    (void)state;
    assert_non_null(mkdtemp(folder));
    (void)snprintf(path, sizeof path, "%s/file", folder);
    return 0;
}

static int files_in_folder(void)
{
    int count = 0;
    DIR *listing = opendir(folder);
    assert_non_null(listing);
    for (const struct dirent *entry; (entry = readdir(listing)) != NULL;)
        count += strcmp(entry->d_name, ".") != 0 && strcmp(entry->d_name, "..") != 0;
    (void)closedir(listing);
    return count;
}

static int remove_folder(void **state)
{
    (void)state;
    (void)unlink(path);
    return rmdir(folder);
}

static fst_status write_file(const char *content, fst_error *error)
{
    fst_whole_file file;
    const fst_status status = fst_whole_file_open(&file, path, error);
    if (status != FST_OK)
        return status;
    (void)fputs(content, file.stream);
    return fst_whole_file_commit(&file, error);
}

static void check_content(const char *expected)
{
    char content[64] = "";
    FILE *in = fopen(path, "r");
    assert_non_null(in);
    const size_t size = fread(content, 1, sizeof content - 1, in);
    (void)fclose(in);
    content[size] = '\0';
    assert_string_equal(content, expected);
}

/* The contents are synced before the file gets its name, and the name after that. */
static void test_content_then_name(void **state)
{
    (void)state;
    fst_error error = {FST_OK, "", ""};
    (void)unlink(path);
    content_before_name = folder_after_name = 0;
    assert_int_equal(write_file("eleven char", &error), FST_OK);
    assert_true(content_before_name > 0);
    assert_true(folder_after_name > 0);
    check_content("eleven char");
    assert_int_equal(files_in_folder(), 1);
}

/* If the disk cannot sync, the old file stays, nothing else remains, and the caller is told. */
static void test_a_disk_that_refuses(void **state)
{
    (void)state;
    fst_error error = {FST_OK, "", ""};
    assert_int_equal(write_file("old", &error), FST_OK);
    refuse = 1;
    const fst_status status = write_file("new", &error);
    refuse = 0;
    assert_int_equal(status, FST_IO);
    assert_true(strlen(error.sentence) > 5);
    check_content("old");
    assert_int_equal(files_in_folder(), 1);
}

/* The same if the last bytes find no room, which only closing the file shows. */
static void test_no_room_for_the_last_bytes(void **state)
{
    (void)state;
    fst_error error = {FST_OK, "", ""};
    struct rlimit before, small;
    assert_int_equal(write_file("old", &error), FST_OK);
    assert_int_equal(getrlimit(RLIMIT_FSIZE, &before), 0);
    small = before;
    small.rlim_cur = 4;
    (void)signal(SIGXFSZ, SIG_IGN);
    assert_int_equal(setrlimit(RLIMIT_FSIZE, &small), 0);
    const fst_status status = write_file("something longer than that", &error);
    assert_int_equal(setrlimit(RLIMIT_FSIZE, &before), 0);
    assert_int_equal(status, FST_IO);
    check_content("old");
    assert_int_equal(files_in_folder(), 1);
}

/* The same if a folder has taken the name when the file is ready. */
static void test_a_name_that_was_taken(void **state)
{
    (void)state;
    fst_error error = {FST_OK, "", ""};
    fst_whole_file file;
    (void)unlink(path);
    assert_int_equal(fst_whole_file_open(&file, path, &error), FST_OK);
    (void)fputs("text", file.stream);
    assert_int_equal(mkdir(path, 0777), 0);
    assert_int_equal(fst_whole_file_commit(&file, &error), FST_IO);
    assert_int_equal(files_in_folder(), 1);
    assert_int_equal(rmdir(path), 0);
}

/* A file that is given up leaves nothing. */
static void test_what_is_given_up(void **state)
{
    (void)state;
    fst_error error = {FST_OK, "", ""};
    fst_whole_file file;
    assert_int_equal(write_file("old", &error), FST_OK);
    assert_int_equal(fst_whole_file_open(&file, path, &error), FST_OK);
    assert_int_equal(files_in_folder(), 2);
    fst_whole_file_discard(&file);
    check_content("old");
    assert_int_equal(files_in_folder(), 1);
}

/* A text is written at once; without one nothing is, but what would hinder it is told. */
static void test_a_text(void **state)
{
    (void)state;
    fst_error error = {FST_OK, "", ""};
    assert_int_equal(fst_file_write(path, "whole", 5, &error), FST_OK);
    assert_int_equal(fst_file_write(path, NULL, 0, &error), FST_OK);
    check_content("whole");
    assert_int_equal(files_in_folder(), 1);
    assert_int_equal(fst_file_write(folder, NULL, 0, &error), FST_BAD_INPUT);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_content_then_name),          cmocka_unit_test(test_a_disk_that_refuses),
        cmocka_unit_test(test_no_room_for_the_last_bytes), cmocka_unit_test(test_a_name_that_was_taken),
        cmocka_unit_test(test_what_is_given_up),           cmocka_unit_test(test_a_text),
    };
    return cmocka_run_group_tests(tests, make_folder, remove_folder);
}
