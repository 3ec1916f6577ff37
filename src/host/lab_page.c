/* lab_page.c - the page festoon-lab.html: where it lies, its address for a scene, and opening it on a desktop.
 */
#ifndef _GNU_SOURCE
#define _GNU_SOURCE /* dladdr(), mkstemps() */
#endif
#include <festoon/festoon_tools.h>

#include <ctype.h>
#include <dlfcn.h>
#include <errno.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "base/error.h"
#include "host/process.h"

#define PAGE "festoon-lab.html"

/* Where the page lies relative to this library: in the build tree, and installed below lib or lib/ARCHITECTURE.
 */
static const char *const places[] = {"", "../share/festoon/", "../../share/festoon/"};

static int find_page(char path[FST_LAB_ADDRESS_SIZE])
{
    Dl_info here;
    char folder[FST_LAB_ADDRESS_SIZE];
    if (!dladdr((void *)&places, &here) || !here.dli_fname)
        return 0;
    const char *slash = strrchr(here.dli_fname, '/');
    (void)snprintf(folder, sizeof folder, "%.*s", slash ? (int)(slash - here.dli_fname) + 1 : 2,
                   slash ? here.dli_fname : "./");
    for (size_t i = 0; i < sizeof places / sizeof places[0]; ++i) {
        const int length = snprintf(path, FST_LAB_ADDRESS_SIZE, "%s%s" PAGE, folder, places[i]);
        if (length < 0 || length >= FST_LAB_ADDRESS_SIZE || access(path, R_OK) != 0)
            continue;
        char *whole = realpath(path, NULL);
        const int fits = whole && strlen(whole) < FST_LAB_ADDRESS_SIZE;
        if (fits)
            memcpy(path, whole, strlen(whole) + 1);
        free(whole);
        return fits;
    }
    return 0;
}

/* Append `text`; what is neither a letter, a digit nor one of `plain` becomes %XX.  Returns 0 where it is too
 * long. */
static int append(char address[FST_LAB_ADDRESS_SIZE], const char *text, const char *plain)
{
    size_t length = strlen(address);
    for (; *text; ++text) {
        const unsigned char c = (unsigned char)*text;
        if (length + 4 > FST_LAB_ADDRESS_SIZE)
            return 0;
        if ((c < 128 && isalnum(c)) || strchr(plain, c))
            address[length++] = *text;
        else
            length += (size_t)snprintf(address + length, 4, "%%%02X", (unsigned)c);
    }
    address[length] = '\0';
    return 1;
}

/* What differs from the default scene, as the page reads it behind "#". */
static int append_scene(char address[FST_LAB_ADDRESS_SIZE], const fst_params *params)
{
    const fst_params usual = fst_default_params();
    int fits = append(address, "#v=1", "#=");
    for (int i = 0; i < fst_params_row_count(params) && fits; ++i) {
        char value[FST_LAB_VALUE_SIZE], initial[FST_LAB_VALUE_SIZE];
        const int length = fst_params_get(params, i, value, sizeof value);
        const int in_both = i < fst_param_count(); /* the default scene has no parts of a magnet */
        if (length > 0 && in_both)
            (void)fst_params_get(&usual, i, initial, sizeof initial);
        if (length <= 0 || (in_both && strcmp(value, initial) == 0))
            continue;
        fits = length < FST_LAB_VALUE_SIZE && append(address, "&", "&") &&
               append(address, fst_param_at(i)->key, "._") && append(address, "=", "=") &&
               append(address, value, "._-");
    }
    return fits;
}

/* Whether the page says in its first bytes that it was built from this version.  An old one would show other
 * numbers than the program. */
static int is_of_this_version(const char *path)
{
    char stamp[128], head[8192];
    FILE *page = fopen(path, "rb");
    if (!page)
        return 0;
    const size_t size = fread(head, 1, sizeof head - 1, page);
    (void)fclose(page);
    head[size] = '\0';
    (void)snprintf(stamp, sizeof stamp, "\"festoon %s, results version %d\"", fst_version(),
                   FST_RESULTS_VERSION);
    return strstr(head, stamp) != NULL;
}

fst_status fst_lab_address(const fst_params *params, char address[FST_LAB_ADDRESS_SIZE], fst_error *error)
{
    char path[FST_LAB_ADDRESS_SIZE];
    if (!find_page(path))
        return fst_fail(
            error, FST_UNAVAILABLE, PAGE,
            "the page is not installed: in festoon's source make lab builds it, and make install or make deb "
            "after that installs it with the program");
    if (!is_of_this_version(path))
        return fst_fail(error, FST_UNAVAILABLE, path,
                        "the page is of another version than this program: make lab builds it anew");
    address[0] = '\0';
    if (!append(address, "file://", ":/") || !append(address, path, "/._-~") || !append_scene(address, params))
        return fst_fail(error, FST_BAD_INPUT, PAGE, "its address would be longer than %d characters",
                        FST_LAB_ADDRESS_SIZE);
    return FST_OK;
}

/* xdg-open drops what stands behind "#" of a file's address.  So it is given a page that leads there.  The
 * address has no character but letters, digits and "%:/#=&._-~", and only & has a meaning in HTML. */
static fst_status write_way(const char *address, char *path, size_t size, fst_error *error)
{
    const char *folder = getenv("XDG_RUNTIME_DIR");
    if (!folder || !*folder)
        folder = getenv("TMPDIR");
    if (!folder || !*folder)
        folder = "/tmp";
    const int length = snprintf(path, size, "%s/festoon-lab-XXXXXX.html", folder);
    const int file = length > 0 && (size_t)length < size ? mkstemps(path, 5) : -1;
    FILE *stream = file >= 0 ? fdopen(file, "w") : NULL;
    if (!stream) {
        const int reason = errno;
        if (file >= 0) {
            (void)close(file);
            (void)unlink(path);
        }
        return fst_fail(error, FST_IO, folder, "no page could be written there: %s", strerror(reason));
    }
    (void)fputs("<!doctype html>\n<meta charset=\"utf-8\">\n<title>A bead</title>\n"
                "<meta http-equiv=\"refresh\" content=\"0;url=",
                stream);
    for (const char *at = address; *at; ++at)
        (void)fputs(*at == '&' ? "&amp;" : (const char[]){*at, '\0'}, stream);
    (void)fputs("\">\n", stream);
    const int failed = ferror(stream);
    if (fclose(stream) != 0 || failed) {
        (void)unlink(path);
        return fst_fail(error, FST_IO, path, "writing failed: %s", strerror(errno));
    }
    return FST_OK;
}

static int is_set(const char *name)
{
    const char *value = getenv(name);
    return value && *value;
}

fst_status fst_lab_open(const char *address, int *opened, fst_error *error)
{
    static const char program[] = "xdg-open";
    char path[4096];
    *opened = 0;
    if (!is_set("DISPLAY") && !is_set("WAYLAND_DISPLAY"))
        return FST_OK;
    const fst_status status = write_way(address, path, sizeof path, error);
    if (status != FST_OK)
        return status;
    const char *const arguments[] = {program, path, NULL};
    /* Nobody waits for it: on some desktops it lives as long as the browser. */
    const int failed = fst_process_leave(arguments);
    if (failed)
        (void)unlink(path);
    if (failed == ENOENT)
        return FST_OK;
    if (failed)
        return fst_fail(error, FST_IO, program, "it could not be started: %s", strerror(failed));
    *opened = 1;
    return FST_OK;
}
