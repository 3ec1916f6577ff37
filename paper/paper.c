/* paper.c - fst_paper(): everything that the paper shows, computed again.
 *
 *  1. runs         runs.c         all scans, both dynamics                      --+
 *  2. orbits       exact.c        what branches tell without runs                 |
 *  3. thresholds   runs.c         by bisection, where the orbits do not tell      +--> fst_paper_state
 *  4. probes       probe_parts.c  period halving, ansatz, paramagnetic beads    --+        (state.h)
 *     dry friction dry.c          the scans once more, and a small map                |
 *     magnets      magnets.c      the experiment on real magnets                      |
 *     beads        beads.c        several beads                                     --'
 *  5. statements   verdicts.c     each number against the paper's                          |
 *  6. figures      figures.c      drawn as soon as their step is done                      v
 *  7. report       json.c, report.c                                        paper.json, report.html
 *
 * After an interruption or a failure, what was done so far is written all the same, marked as incomplete.
 */
#include "paper/beads.h"
#include "paper/waves.h"
#include "paper/dry.h"
#include "paper/figures.h"
#include "paper/magnets.h"
#include "paper/report.h"
#include "paper/runs.h"
#include "paper/statements.h"
#include "paper/work.h"

#include "base/clock.h"
#include "base/error.h"
#include "base/number.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/resource.h>

/* ------------------------------------------------------------------ the whole */

/* The answer to every run and search at work, in whatever thread. */
static fst_status obey(void *user, double fraction, const char *what, fst_error *error)
{
    fst_paper_state *paper = user;
    (void)fraction, (void)what;
    return atomic_load(&paper->refused) ? fst_fail(error, FST_INTERRUPTED, "", "interrupted") : FST_OK;
}

/* The processor time of all threads, and of the programs that drew. */
static double processor_seconds(void)
{
    static const int who[2] = {RUSAGE_SELF, RUSAGE_CHILDREN};
    double seconds = 0.0;
    for (int i = 0; i < 2; ++i) {
        struct rusage used;
        if (getrusage(who[i], &used) == 0)
            seconds += (double)(used.ru_utime.tv_sec + used.ru_stime.tv_sec) +
                       1e-6 * (double)(used.ru_utime.tv_usec + used.ru_stime.tv_usec);
    }
    return seconds;
}

/* Compute and draw everything in its order.  Figures are drawn as soon as they can be, so that an interrupted
 * call leaves some. */
static fst_status make_everything(fst_paper_state *paper, fst_error *error)
{
    fst_status status = fst_paper_make_runs(paper, error);
    if (status == FST_OK)
        status = fst_paper_draw_figures(paper, 0.45, 0.5, error);
    if (status == FST_OK)
        status = fst_paper_find_orbits(paper, error);
    if (status == FST_OK)
        status = fst_paper_find_thresholds(paper, error);
    if (status == FST_OK)
        status = fst_paper_make_probes(paper, NULL, error);
    if (status == FST_OK)
        status = fst_paper_make_dry(paper, 0, error);
    if (status == FST_OK)
        status = fst_paper_make_magnets(paper, error);
    if (status == FST_OK)
        status = fst_paper_make_beads(paper, error);
    if (status == FST_OK)
        status = fst_paper_make_waves(paper, error);
    if (status == FST_OK)
        status = fst_paper_draw_figures(paper, 0.997, 1.0, error);
    paper->complete = status == FST_OK;
    return status;
}

static fst_status write_everything(const fst_paper_state *paper, fst_error *error)
{
    fst_status status = fst_paper_write_json(paper, error);
    return status == FST_OK ? fst_paper_write_report(paper, error) : status;
}

/* ------------------------------------------------------------------ one statement */

static fst_status no_such_statement(const char *id, fst_error *error)
{
    char names[4096] = "", suggestion[FST_SUGGESTION_SIZE];
    size_t used = 0;
    for (int i = 0; i < fst_statement_count() && used < sizeof names; ++i)
        used +=
            (size_t)snprintf(names + used, sizeof names - used, "%s%s", i ? "|" : "", fst_statement_at(i)->id);
    return fst_fail(error, FST_BAD_INPUT, "--only", "there is no statement \"%.60s\"; %s (paper.json has all)",
                    id, fst_suggest_name(id, names, suggestion));
}

/* Compute what the statement needs, and nothing else. */
static fst_status make_one(fst_paper_state *paper, const fst_statement *statement, fst_error *error)
{
    fst_paper_step step = statement->step;
    paper->first_scan = (int)statement->scan;
    fst_status status = statement->scan == FST_SCAN_NONE ? FST_OK : fst_paper_make_runs(paper, error);
    if (status == FST_OK && step >= FST_PAPER_STEP_EXACT && step <= FST_PAPER_STEP_HALVING)
        status = fst_paper_find_orbits(paper, error);
    if (status == FST_OK && step >= FST_PAPER_STEP_THRESHOLDS && step <= FST_PAPER_STEP_HALVING)
        status = fst_paper_find_thresholds(paper, error);
    if (status == FST_OK)
        status = fst_paper_make_probes(paper, &step, error);
    return status == FST_OK && statement->rubs ? fst_paper_make_dry(paper, 1, error) : status;
}

static fst_status answer_one(fst_paper_state *paper, fst_error *error)
{
    const char *id = paper->options->only;
    for (int i = 0; i < fst_statement_count(); ++i) {
        const fst_statement *statement = fst_statement_at(i);
        if (strcmp(statement->id, id) != 0)
            continue;
        fst_status status = make_one(paper, statement, error);
        if (status != FST_OK)
            return status;
        *paper->options->summary = fst_paper_statement_json(paper, statement);
        return *paper->options->summary ? FST_OK
                                        : fst_fail(error, FST_NO_MEMORY, "paper", "no memory for \"%s\"", id);
    }
    return no_such_statement(id, error);
}

/* ------------------------------------------------------------------ all of it */

static fst_status answer_all(fst_paper_state *paper, double began, fst_error *error)
{
    double processors_began = processor_seconds();
    const fst_paper_options *options = paper->options;
    fst_status status = make_everything(paper, error);
    paper->seconds = fst_clock_seconds() - began;
    paper->processor_seconds = processor_seconds() - processors_began;
    if (status == FST_OK && options->films)
        status = fst_paper_make_films(paper, error);
    /* Write what there is, whatever happened; the first failure is the one to report. */
    fst_status written = write_everything(paper, status == FST_OK ? error : NULL);
    status = status == FST_OK ? written : status;
    if (status == FST_OK)
        *options->summary = fst_paper_summary(paper);
    return status;
}

fst_status fst_paper(const char *directory, const fst_paper_options *options, fst_error *error)
{
    fst_paper_state paper = {.options = options, .directory = directory};
    paper.until_refused = (fst_progress){&paper, obey};
    fst_status status = options->only ? FST_OK : fst_paper_make_directory(&paper, error);
    if (status != FST_OK)
        return status;
    double began = fst_clock_seconds();
    fst_c_locale locale = fst_c_locale_enter();
    status = fst_paper_begin(&paper, error);
    if (status == FST_OK)
        status = fst_paper_dry_begin(&paper, error);
    if (status == FST_OK)
        status = fst_paper_magnets_begin(&paper, error);
    if (status == FST_OK)
        status = options->only ? answer_one(&paper, error) : answer_all(&paper, began, error);
    free(paper.beads);
    free(paper.waves);
    fst_paper_magnets_free(&paper);
    fst_paper_dry_free(&paper);
    fst_paper_free_runs(&paper);
    fst_c_locale_leave(locale);
    return status;
}
