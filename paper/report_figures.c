/* report_figures.c - the figures of the report: beside the claim that says what they show, those of both dynamics
 * side by side. */
#include "paper/figures.h"
#include "paper/report_parts.h"
#include "paper/runs.h"
#include "paper/work.h"

#include "base/error.h"

#include <stdlib.h>
#include <string.h>

/* The verdict on what the figure itself shows. */
static void write_figure_badge(FILE *out, const fst_paper_state *paper, const fst_paper_figure *figure,
                               fst_dynamics dynamics)
{
    fst_verdict verdict;
    if (!fst_paper_figure_verdict(paper, figure, dynamics, &verdict))
        return;
    fprintf(out, " <small>%s</small> ", fst_dynamics_name(dynamics));
    fst_report_badge(out, verdict);
}

/* The picture of one dynamics, or of both. */
static fst_status write_picture(FILE *out, const fst_paper_state *paper, const fst_paper_figure *figure,
                                fst_error *error)
{
    char *path = fst_paper_path(paper, figure->file, "svg"), command[512], alternative[160];
    if (!path)
        return fst_fail(error, FST_NO_MEMORY, figure->file, "no memory for a file name");
    fprintf(out, "<div id=\"figure-%s\">", figure->file);
    if (figure->each) {
        fprintf(out, "<p class=\"which\">%s</p>", fst_dynamics_name(figure->dynamics));
        (void)snprintf(alternative, sizeof alternative, "%s, %s", figure->title,
                       fst_dynamics_name(figure->dynamics));
    } else {
        (void)snprintf(alternative, sizeof alternative, "%s", figure->title);
    }
    const fst_status status = fst_report_image(out, path, alternative, error);
    free(path);
    fst_paper_figure_command(paper, figure, command, sizeof command);
    fputs("<details><summary>draw it again</summary>", out);
    fst_report_code(out, command);
    fputs("</details></div>\n", out);
    return status;
}

/* The figures of one row: both dynamics share title and caption. */
static fst_status write_figure(FILE *out, const fst_paper_state *paper, int *index, fst_error *error)
{
    fst_paper_figure figure = fst_paper_figure_at(*index);
    const fst_paper_figure first = figure;
    fst_status status = FST_OK;
    fputs(figure.each ? "<figure><h3>" : "<figure class=\"single\"><h3>", out);
    fst_report_text(out, figure.title);
    fputs("</h3>\n<div class=\"pair\">", out);
    for (; status == FST_OK && *index < fst_paper_figure_count(); ++*index) {
        figure = fst_paper_figure_at(*index);
        if (strcmp(figure.name, first.name) != 0)
            break;
        if (paper->drawn[*index])
            status = write_picture(out, paper, &figure, error);
    }
    fputs("</div><figcaption>", out);
    fst_report_prose(out, first.caption);
    fputs(" <span class=\"from\">The paper's ", out);
    fst_report_text(out, first.source);
    fputs(".</span>", out);
    if (first.own)
        fprintf(out, " <span class=\"from\">Judged by <a href=\"#%s\">%s</a>:</span>", first.own, first.own);
    for (int i = 0; i < FST_PAPER_DYNAMICS; ++i)
        write_figure_badge(out, paper, &first, fst_paper_order[i]);
    fputs("</figcaption></figure>\n", out);
    return status;
}

/* Whether a figure stands beside the claim `own`, or with the others (NULL), whose claim is not on the page. */
static int belongs(const fst_paper_state *paper, const fst_paper_figure *figure, const char *own)
{
    fst_verdict verdict;
    const int beside = fst_paper_figure_verdict(paper, figure, figure->dynamics, &verdict);
    return own ? beside && strcmp(figure->own, own) == 0 : !beside;
}

fst_status fst_report_figures(FILE *out, const fst_paper_state *paper, const char *own, fst_error *error)
{
    fst_status status = FST_OK;
    for (int i = 0; i < fst_paper_figure_count() && status == FST_OK;) {
        const fst_paper_figure figure = fst_paper_figure_at(i);
        if (paper->drawn[i] && belongs(paper, &figure, own))
            status = write_figure(out, paper, &i, error);
        else
            ++i;
    }
    return status;
}

/* All figures by their names, as links. */
static void write_list(FILE *out, const fst_paper_state *paper)
{
    char before[64] = "";
    fputs("<ul class=\"list\">\n", out);
    for (int i = 0; i < fst_paper_figure_count(); ++i) {
        const fst_paper_figure figure = fst_paper_figure_at(i);
        if (!paper->drawn[i] || strcmp(before, figure.name) == 0)
            continue;
        fprintf(out, "<li><a href=\"#figure-%s\">%.*s</a></li>\n", figure.file,
                (int)strcspn(figure.source, ","), figure.source);
        (void)snprintf(before, sizeof before, "%s", figure.name);
    }
    fputs("</ul>\n", out);
}

fst_status fst_report_other_figures(FILE *out, const fst_paper_state *paper, fst_error *error)
{
    fputs(
        "<h2 id=\"figures\">The figures</h2>\n<p>Each figure stands beside the claim that says what it shows, "
        "and has its badge; here are the others. Full size, with scripts and data: the files beside this "
        "page.</p>\n",
        out);
    write_list(out, paper);
    const fst_status status = fst_report_figures(out, paper, NULL, error);
    for (int i = 0; i < paper->films; ++i)
        fprintf(out, "%s%s.mp4",
                i ? ", " : "<p class=\"fine\">The supplement's films, beside this page (--films): ",
                fst_film_names[i]);
    if (paper->films > 0)
        fputs("</p>\n", out);
    return status;
}
