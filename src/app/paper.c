/* paper.c - fst_paper(): everything the paper shows, computed again. */
#include "app/paper.h"

#include "app/parallel.h"
#include "base/error.h"
#include "base/number.h"

#include <errno.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <time.h>

enum { OPTIONS_COOKIE = 0x50415052 };

fst_paper_options fst_default_paper_options(void)
{
    return (fst_paper_options){.cookie = OPTIONS_COOKIE};
}

char *fst_paper_path(const fst_paper_state *paper, const char *name, const char *ending)
{
    size_t room = strlen(paper->directory) + strlen(name) + strlen(ending) + 3;
    char *path = malloc(room);
    if (path)
        (void)snprintf(path, room, "%s/%s.%s", paper->directory, name, ending);
    return path;
}

/* ------------------------------------------------------------------ stages */

typedef struct stage_in_work {
    fst_paper_state *paper;
    const fst_paper_stage *stage;
} stage_in_work;

static fst_status piece_of_stage(void *user, int index, fst_error *error)
{
    const stage_in_work *work = user;
    return work->stage->piece(work->paper, index, error);
}

static fst_status progress_of_stage(void *user, int done, fst_error *error)
{
    const stage_in_work *work = user;
    const fst_paper_options *options = work->paper->options;
    const fst_paper_stage *stage = work->stage;
    if (!options->progress)
        return FST_OK;
    double fraction = stage->from + (stage->to - stage->from) * done / stage->count;
    return options->progress(options->user, fraction, stage->what, error);
}

fst_status fst_paper_do(fst_paper_state *paper, const fst_paper_stage *stage, fst_error *error)
{
    stage_in_work in_work = {paper, stage};
    fst_work work = {
        .user = &in_work, .count = stage->count, .piece = piece_of_stage, .progress = progress_of_stage};
    fst_status status = fst_parallel(&work, error);
    if (status == FST_OK && stage->step < FST_STEP_COUNT)
        paper->done[stage->step] = 1;
    return status;
}

/* ------------------------------------------------------------------ the whole */

/* Make the directory, unless it is there. */
static fst_status make_directory(const char *directory, fst_error *error)
{
    struct stat there;
    if (mkdir(directory, 0777) == 0)
        return FST_OK;
    int reason = errno;
    if (reason == EEXIST && stat(directory, &there) == 0) {
        if (S_ISDIR(there.st_mode))
            return FST_OK;
        return fst_fail(error, FST_BAD_INPUT, directory, "this is a file: give the name of a directory");
    }
    return fst_fail(error, FST_IO, directory, "cannot make this directory: %s", strerror(reason));
}

static double seconds_now(void)
{
    struct timespec now;
    (void)clock_gettime(CLOCK_MONOTONIC, &now);
    return (double)now.tv_sec + 1e-9 * (double)now.tv_nsec;
}

/* All that is computed and drawn, in its order; figures come as soon as they can, so that an interruption
 * leaves them. */
static fst_status make_everything(fst_paper_state *paper, fst_error *error)
{
    fst_status status = fst_paper_make_runs(paper, error);
    if (status == FST_OK)
        status = fst_paper_draw_figures(paper, 0.45, 0.5, error);
    if (status == FST_OK)
        status = fst_paper_find_thresholds(paper, error);
    if (status == FST_OK)
        status = fst_paper_make_probes(paper, error);
    if (status == FST_OK)
        status = fst_paper_draw_figures(paper, 0.97, 1.0, error);
    paper->complete = status == FST_OK;
    return status;
}

static fst_status write_everything(const fst_paper_state *paper, fst_error *error)
{
    fst_status status = fst_paper_write_json(paper, error);
    return status == FST_OK ? fst_paper_write_report(paper, error) : status;
}

fst_status fst_paper(const char *directory, const fst_paper_options *options, fst_error *error)
{
    fst_paper_options defaults = fst_default_paper_options();
    if (!options)
        options = &defaults;
    if (options->cookie != OPTIONS_COOKIE)
        return fst_fail(error, FST_BAD_INPUT, "fst_paper",
                        "the options were not made by fst_default_paper_options()");
    fst_status status = make_directory(directory, error);
    if (status != FST_OK)
        return status;
    double began = seconds_now();
    fst_c_locale locale = fst_c_locale_enter();
    fst_paper_state paper = {.options = options, .directory = directory};
    status = fst_paper_begin(&paper, error);
    if (status == FST_OK) {
        status = make_everything(&paper, error);
        paper.seconds = seconds_now() - began;
        if (status == FST_OK && options->films)
            status = fst_paper_make_films(&paper, error);
        /* What is there is written whatever happened; the first trouble is the one to tell of. */
        fst_status written = write_everything(&paper, status == FST_OK ? error : NULL);
        status = status == FST_OK ? written : status;
    }
    if (status == FST_OK && options->summary)
        *options->summary = fst_paper_summary(&paper);
    fst_paper_free_runs(&paper);
    fst_c_locale_leave(locale);
    return status;
}
