/* films.c - the two films of the paper's supplement. */
#include "paper/figures.h"
#include "paper/work.h"

#include "base/clock.h"
#include "base/error.h"
#include "base/watch.h"

#include <stdlib.h>

const char *const fst_film_names[FST_FILM_COUNT] = {"film_0215", "film_04"};

static const struct {
    fst_scan scan;
    double periods;
} films[FST_FILM_COUNT] = {{FST_SCAN_FOLD4, 24.0}, {FST_SCAN_FOLD15, 16.0}};

/* The paper's films show motions by its printed equations, and so do these. */
fst_status fst_paper_make_films(fst_paper_state *paper, fst_error *error)
{
    double began = fst_clock_seconds();
    const double share = fst_paper_share(paper);
    fst_status status = FST_OK;
    for (int i = 0; i < FST_FILM_COUNT && status == FST_OK; ++i) {
        const fst_paper_run *run = fst_paper_single(paper, films[i].scan, FST_DYNAMICS_FARAGO2020);
        fst_part shown = {paper->options->progress, share + (1.0 - share) * i / FST_FILM_COUNT,
                          share + (1.0 - share) * (i + 1) / FST_FILM_COUNT, "films"};
        const fst_progress progress = {&shown, fst_part_tell};
        fst_film_options options = fst_default_film_options();
        options.from = run->params.run_discard;
        options.to = options.from + (paper->options->reduced ? 1.0 : films[i].periods);
        options.colour = "slip";
        options.progress = &progress;
        char *path = fst_paper_path(paper, fst_film_names[i], "mp4");
        status = path ? fst_film(&run->trajectory, path, &options, error)
                      : fst_fail(error, FST_NO_MEMORY, fst_film_names[i], "no memory for a file name");
        free(path);
        paper->films += status == FST_OK;
    }
    fst_paper_note_time(paper, "films", began);
    return status;
}
