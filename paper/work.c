/* work.c - doing a part of the paper on all processors and noting its time; names of files; the machine in
 * words. */
#include "paper/work.h"

#include "base/clock.h"
#include "base/error.h"
#include "base/watch.h"

#include <errno.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <sys/utsname.h>
#include <unistd.h>

char *fst_paper_path(const fst_paper_state *paper, const char *name, const char *ending)
{
    size_t room = strlen(paper->directory) + strlen(name) + strlen(ending) + 3;
    char *path = malloc(room);
    if (path)
        (void)snprintf(path, room, "%s/%s.%s", paper->directory, name, ending);
    return path;
}

typedef struct part_in_work {
    fst_paper_state *paper;
    const fst_paper_pieces *part;
} part_in_work;

static fst_status piece_of_part(void *user, int index, fst_error *error)
{
    const part_in_work *work = user;
    return work->part->piece(work->paper, index, error);
}

static fst_status tell_of_part(void *user, double fraction, const char *what, fst_error *error)
{
    const part_in_work *work = user;
    const fst_paper_pieces *part = work->part;
    const double share = fst_paper_share(work->paper);
    fst_part share_of_all = {work->paper->options->progress, share * part->from, share * part->to, part->what};
    const fst_status status = fst_part_tell(&share_of_all, fraction, what, error);
    if (status != FST_OK)
        atomic_store(&work->paper->refused, 1);
    return status;
}

void fst_paper_note_time(fst_paper_state *paper, const char *what, double began)
{
    int part = 0;
    while (part < paper->part_count && strcmp(paper->parts[part].what, what) != 0)
        ++part;
    if (part == FST_MOST_PARTS)
        return;
    if (part == paper->part_count)
        paper->parts[paper->part_count++] = (fst_paper_part){what, 0.0};
    paper->parts[part].seconds += fst_clock_seconds() - began;
}

fst_status fst_paper_set(fst_params *params, fst_error *error, const char *settings, ...)
{
    char text[512], *rest = NULL;
    va_list values;
    va_start(values, settings);
    (void)vsnprintf(text, sizeof text, settings, values);
    va_end(values);
    fst_status status = FST_OK;
    for (char *word = strtok_r(text, " ", &rest); word && status == FST_OK; word = strtok_r(NULL, " ", &rest)) {
        char *value = strchr(word, '=');
        *value = '\0';
        status = fst_params_set(params, word, value + 1, error);
    }
    return status;
}

void fst_paper_machine(char *text, size_t size)
{
#ifdef __clang__
    static const char *const compiler = __VERSION__;
#else
    static const char *const compiler = "gcc " __VERSION__;
#endif
    struct utsname machine;
    char components[FST_COMPONENTS_SIZE];
    (void)snprintf(
        text, size,
        "binary64 (double precision), one bead at a time without vector instructions of its own, no fused "
        "multiply-add; %s, %s, %ld processors; %s",
        compiler, uname(&machine) >= 0 ? machine.machine : "unknown machine", sysconf(_SC_NPROCESSORS_ONLN),
        fst_tools_components(components));
}

fst_status fst_paper_do(fst_paper_state *paper, const fst_paper_pieces *part, fst_error *error)
{
    double began = fst_clock_seconds();
    part_in_work in_work = {paper, part};
    const fst_progress progress = {&in_work, tell_of_part};
    fst_work work = {.user = &in_work, .count = part->count, .piece = piece_of_part, .progress = &progress};
    fst_status status = fst_parallel(&work, error);
    fst_paper_note_time(paper, part->what, began);
    if (status == FST_OK && part->step < FST_PAPER_STEP_COUNT)
        paper->done[part->step] = 1;
    return status;
}

/* ------------------------------------------------------------------ files and their directory */

fst_status fst_paper_file_begin(fst_paper_file *file, fst_error *error)
{
    file->stream = fst_print_begin(&file->printed);
    return file->stream ? FST_OK : fst_fail(error, FST_NO_MEMORY, "paper", "no memory for a file");
}

/* Without a text, only see whether the file could be written. */
static fst_status write_file(const fst_paper_state *paper, const char *name, const char *ending,
                             const char *text, size_t size, fst_error *error)
{
    char *path = fst_paper_path(paper, name, ending);
    const fst_status status = path ? fst_file_write(path, text, size, error)
                                   : fst_fail(error, FST_NO_MEMORY, name, "no memory for a file name");
    free(path);
    return status;
}

fst_status fst_paper_file_end(fst_paper_file *file, const fst_paper_state *paper, const char *name,
                              const char *ending, fst_status status, fst_error *error)
{
    char *text = fst_print_end(&file->printed);
    if (!text && status == FST_OK)
        status = fst_fail(error, FST_NO_MEMORY, name, "no memory for this file");
    if (status == FST_OK)
        status = write_file(paper, name, ending, text, file->printed.size, error);
    free(text);
    return status;
}

fst_status fst_paper_make_directory(const fst_paper_state *paper, fst_error *error)
{
    const char *directory = paper->directory;
    struct stat there;
    if (mkdir(directory, 0777) == 0)
        return FST_OK;
    int reason = errno;
    if (reason == EEXIST && stat(directory, &there) == 0) {
        if (S_ISDIR(there.st_mode))
            return write_file(paper, "paper", "json", NULL, 0, error); /* see that before all is computed */
        return fst_fail(error, FST_BAD_INPUT, directory, "this is a file: give the name of a directory");
    }
    return fst_fail(error, FST_IO, directory, "cannot make this directory: %s", strerror(reason));
}
