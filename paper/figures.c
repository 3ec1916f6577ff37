/* figures.c - the table of the paper's figures: what each shows, how it is drawn, and which statement says
 * what it shows. */
#include "paper/figures.h"
#include "paper/runs.h"
#include "paper/work.h"

#include "base/clock.h"
#include "base/error.h"
#include "base/watch.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static fst_status draw_trajectory(const fst_paper_state *paper, const fst_paper_figure *figure, const char *out,
                                  fst_error *error)
{
    const fst_paper_run *run = fst_paper_single(paper, figure->scan, figure->dynamics);
    fst_figure_options options = fst_default_figure_options();
    options.kind = figure->kind;
    options.colour = figure->colour;
    options.arrows = !figure->plain;
    options.inset = figure->inset;
    if (figure->zoomed) {
        options.zoom[0] = options.zoom[2] = 0.0;
        options.zoom[1] = options.zoom[3] = 1e3 * run->params.magnet_half_length;
    }
    return fst_figure_trajectory(&run->trajectory, out, &options, error);
}

static fst_status draw_field(const fst_paper_state *paper, const fst_paper_figure *figure, const char *out,
                             fst_error *error)
{
    return fst_figure_field(&fst_paper_single(paper, figure->scan, FST_DYNAMICS_RIGID)->params,
                            FST_SHOWN_SCALED, out, error);
}

enum { EACH = 1, BOTH = 0 };
#define FIGURE(name_, source_, title_, caption_, each_, own_, scan_, step_, ...)                               \
    {.name = name_,                                                                                            \
     .source = source_,                                                                                        \
     .title = title_,                                                                                          \
     .caption = caption_,                                                                                      \
     .each = each_,                                                                                            \
     .own = own_,                                                                                              \
     .scan = FST_SCAN_##scan_,                                                                                 \
     .step = FST_PAPER_STEP_##step_,                                                                           \
     .draw = __VA_ARGS__},
static const fst_paper_figure figures[] = {
#include "paper/figures.def"
};
#undef FIGURE

enum { FIGURE_ROWS = sizeof figures / sizeof figures[0] };
_Static_assert(FST_PAPER_DYNAMICS *FIGURE_ROWS <= FST_MOST_FIGURES, "fst_paper_state.drawn is too short");

int fst_paper_figure_count(void)
{
    int count = 0;
    for (int row = 0; row < FIGURE_ROWS; ++row)
        count += figures[row].each ? FST_PAPER_DYNAMICS : 1;
    return count;
}

fst_paper_figure fst_paper_figure_at(int index)
{
    int row = 0;
    for (; row < FIGURE_ROWS - 1; ++row) {
        int here = figures[row].each ? FST_PAPER_DYNAMICS : 1;
        if (index < here)
            break;
        index -= here;
    }
    fst_paper_figure figure = figures[row];
    figure.dynamics = index == 0 ? FST_DYNAMICS_FARAGO2020 : FST_DYNAMICS_RIGID;
    (void)snprintf(figure.file, sizeof figure.file, "%s%s", figure.name,
                   !figure.each                            ? ""
                   : figure.dynamics == FST_DYNAMICS_RIGID ? "-rigid"
                                                           : "-farago2020");
    return figure;
}

int fst_paper_figure_verdict(const fst_paper_state *paper, const fst_paper_figure *figure,
                             fst_dynamics dynamics, fst_verdict *verdict)
{
    const fst_statement *statement = figure->own ? fst_statement_named(figure->own) : NULL;
    if (!statement || !fst_statement_known(statement, paper))
        return 0;
    *verdict = fst_statement_check(statement, paper).verdict[dynamics];
    return 1;
}

/* Write the options of `festoon plot` that draw this figure. */
static void plot_options(const fst_paper_state *paper, const fst_paper_figure *figure, char *text, size_t size)
{
    static const char *const kinds[] = {[FST_FIGURE_PATH] = "",
                                        [FST_FIGURE_LOCAL_N] = " --kind local-n",
                                        [FST_FIGURE_RADIUS_FIELD] = " --kind radius-field"};
    double corner = 1e3 * fst_paper_single(paper, figure->scan, figure->dynamics)->params.magnet_half_length;
    char zoom[64] = "";
    if (figure->zoomed)
        (void)snprintf(zoom, sizeof zoom, " --zoom 0,%g,0,%g", corner, corner);
    (void)snprintf(text, size, "%s%s%s%s%s%s", kinds[figure->kind], figure->colour ? " --quantity " : "",
                   figure->colour ? figure->colour : "", figure->plain ? " --no-arrows" : "",
                   figure->inset ? " --inset" : "", zoom);
}

void fst_paper_figure_command(const fst_paper_state *paper, const fst_paper_figure *figure, char *text,
                              size_t size)
{
    char run[256], options[128];
    fst_paper_scan_command(paper, figure->scan, figure->dynamics, run, sizeof run);
    plot_options(paper, figure, options, sizeof options);
    if (figure->draw == draw_field)
        (void)snprintf(text, size, "festoon field -o %s.svg", figure->file);
    else if (figure->draw == draw_trajectory)
        (void)snprintf(text, size, "%s --set run.samples=128 -o %s.h5\nfestoon plot %s.h5 -o %s.svg%s", run,
                       figure->file, figure->file, figure->file, options);
    else
        (void)snprintf(text, size, "festoon paper -o DIR%s\ngnuplot %s.gp   # in DIR",
                       paper->options->reduced ? " --reduced" : "", figure->file);
}

static fst_status draw_one(fst_paper_state *paper, int index, fst_error *error)
{
    fst_paper_figure figure = fst_paper_figure_at(index);
    char *out = fst_paper_path(paper, figure.file, "svg");
    if (!out)
        return fst_fail(error, FST_NO_MEMORY, figure.file, "no memory for a file name");
    fst_status status = figure.draw(paper, &figure, out, error);
    free(out);
    return status;
}

typedef struct gallery {
    fst_paper_state *paper;
    int list[FST_MOST_FIGURES], count;
} gallery;

/* Figures are drawn at the same time: each has its own place in `drawn`. */
static fst_status draw_piece(void *user, int place, fst_error *error)
{
    const gallery *all = user;
    int index = all->list[place];
    fst_status status = draw_one(all->paper, index, error);
    all->paper->drawn[index] = status == FST_OK;
    return status;
}

fst_status fst_paper_draw_figures(fst_paper_state *paper, double from, double to, fst_error *error)
{
    gallery all = {.paper = paper};
    for (int i = 0; i < fst_paper_figure_count(); ++i) {
        fst_paper_figure figure = fst_paper_figure_at(i);
        if (!paper->drawn[i] && fst_paper_has(paper, figure.step, figure.scan))
            all.list[all.count++] = i;
    }
    const double share = fst_paper_share(paper);
    fst_part part = {paper->options->progress, share * from, share * to, "figures"};
    const fst_progress progress = {&part, fst_part_tell};
    fst_work work = {.user = &all, .count = all.count, .piece = draw_piece, .progress = &progress};
    double began = fst_clock_seconds();
    fst_status status = fst_parallel(&work, error);
    fst_paper_note_time(paper, "figures", began);
    return status;
}
