/* report.c - report.html: the comparison for people, in one file that needs no other. */
#include "paper/dry.h"
#include "paper/figures.h"
#include "paper/report.h"
#include "paper/runs.h"
#include "paper/work.h"
#include "paper/report_parts.h"

#include "base/error.h"
#include "host/whole_file.h"

#include <stdlib.h>
#include <string.h>

/* The printed equations come first in every table: they are what was published. */
static const fst_dynamics order[FST_PAPER_DYNAMICS] = {FST_DYNAMICS_FARAGO2020, FST_DYNAMICS_RIGID};

/* ------------------------------------------------------------------ the first page */

static void write_summary(FILE *out, const fst_paper_state *paper)
{
    int tally[FST_PAPER_DYNAMICS][3] = {{0}};
    (void)fst_paper_tally(paper, tally);
    int rows[FST_PAPER_DYNAMICS] = {0};
    int known = fst_paper_has(paper, FST_PAPER_STEP_RUNS, FST_SCAN_TABLE);
    for (int row = 0; row < FST_TABLE1_ROWS && known; ++row)
        for (int d = 0; d < FST_PAPER_DYNAMICS; ++d)
            rows[d] += fst_table1_verdict(paper, row, (fst_dynamics)d) == FST_VERDICT_REPRODUCED;
    fputs(fst_report_introduction, out);
    if (!paper->complete)
        fputs("<p class=\"incomplete\">Incomplete: this was interrupted. What was done until then is here; the "
              "same "
              "command makes the whole.</p>\n",
              out);
    fputs("<div class=\"scroll\"><table><thead><tr><th></th><th>farago2020<br><small>as "
          "printed</small></th><th>rigid<br><small>exact</small></th></tr></thead><tbody>\n",
          out);
    static const char *const names[] = {"statements reproduced", "close", "not reproduced"};
    for (int v = 0; v < 3; ++v)
        fprintf(out, "<tr><td>%s</td><td class=\"n\">%d</td><td class=\"n\">%d</td></tr>\n", names[v],
                tally[order[0]][v], tally[order[1]][v]);
    fprintf(
        out,
        "<tr><td>rows of Table 1 reproduced, of %d</td><td class=\"n\">%d</td><td class=\"n\">%d</td></tr>\n",
        FST_TABLE1_ROWS, rows[order[0]], rows[order[1]]);
    fputs("</tbody></table></div>\n", out);
    int dry[3] = {0};
    const int about_motion = fst_paper_dry_tally(paper, dry);
    if (about_motion > 0)
        fprintf(out,
                "<p>Of these statements, %d are about the bead's motion. With <a href=\"#dry\">dry "
                "friction</a>, μ = %g, "
                "%d are reproduced, %d close, %d not.</p>\n",
                about_motion, FST_DRY_MU, dry[0], dry[1], dry[2]);
}

/* ------------------------------------------------------------------ Table 1 */

static void write_festoons(FILE *out, const fst_paper_state *paper, int row, fst_dynamics d)
{
    const fst_run_result *result = &paper->scans[FST_SCAN_TABLE][d][row].result;
    const fst_paper_pattern *closed = &paper->exact[d].closed[row];
    const char *symmetry = fst_symmetry_name(result->symmetry);
    if (isfinite(result->festoons))
        fprintf(out, "<td class=\"n\">%.3f <small>%s</small><br><small>%+.2f %%</small> ", result->festoons,
                symmetry ? symmetry : fst_regime_name(result->regime),
                100.0 * (result->festoons / fst_table1[row].published - 1.0));
    else
        fprintf(out, "<td class=\"n\">%s<br>", fst_regime_name(result->regime));
    fst_report_badge(out, fst_table1_verdict(paper, row, d));
    if (isfinite(closed->omega))
        fprintf(out, "<br><small>%d at ω = %.7f</small></td>", fst_table1[row].count, closed->omega);
    else
        fprintf(out, "<br><small>%d: %s</small></td>", fst_table1[row].count,
                paper->done[FST_PAPER_STEP_EXACT] && !paper->exact[d].missing[0] ? "nowhere stable"
                                                                                 : "not searched");
}

static void write_orbits_missing(FILE *out, const fst_paper_state *paper)
{
    for (int i = 0; i < FST_PAPER_DYNAMICS; ++i) {
        const fst_paper_exact *exact = &paper->exact[order[i]];
        const char *name = fst_dynamics_name(order[i]);
        if (exact->missing[0]) {
            fprintf(out, "<p class=\"fine\">No exact drives for %s: ", name);
            fst_report_text(out, exact->missing);
            fputs("</p>\n", out);
        } else if (exact->most_s1 > 0.0) {
            fprintf(out,
                    "<p class=\"fine\">With %s the patterns of symmetry S1 have up to %.3f festoons: the "
                    "period halves "
                    "at ω = %.9f, and above it they have the symmetry S2.</p>\n",
                    name, exact->most_s1, exact->halving);
        }
    }
}

static void write_table1(FILE *out, const fst_paper_state *paper)
{
    char command[256];
    if (!fst_paper_has(paper, FST_PAPER_STEP_RUNS, FST_SCAN_TABLE))
        return;
    fst_paper_scan_command(paper, FST_SCAN_TABLE, FST_DYNAMICS_FARAGO2020, command, sizeof command);
    fputs("<h2 id=\"table1\">Table 1: how many festoons?</h2>\n"
          "<p>In the laboratory the pattern closes when N = a(1 + ω/|⟨α′⟩|) is a whole number; a is 1 where "
          "the motion repeats after a full turn of the magnet (S1), 2 where half a turn is enough (S2). At "
          "these five drives the paper finds patterns that almost close. Where only the symmetry differs, N is "
          "about "
          "twice or half as large. The last line of each cell is the drive at which the pattern closes "
          "exactly: a "
          "periodic orbit found by Newton's method.</p>\n"
          "<div class=\"scroll\"><table><thead><tr><th>drive "
          "ω</th><th>published</th><th>farago2020</th><th>rigid</th></tr></thead><tbody>\n",
          out);
    for (int row = 0; row < FST_TABLE1_ROWS; ++row) {
        fprintf(out, "<tr><td class=\"n\">%g</td><td class=\"n\">%.2f <small>S%d</small></td>",
                fst_table1[row].omega, fst_table1[row].published, fst_table1[row].published_a);
        for (int i = 0; i < FST_PAPER_DYNAMICS; ++i)
            write_festoons(out, paper, row, order[i]);
        fputs("</tr>\n", out);
    }
    fputs("</tbody></table></div>\n", out);
    write_orbits_missing(out, paper);
    fputs("<p class=\"fine\">Criterion: " FST_TABLE1_CRITERION ". Each number again:</p>", out);
    fst_report_code(out, command);
    fst_report_code(out, "festoon orbit --festoons 4 --set model.dynamics=farago2020   # and 5, 6, 14, 15");
}

/* ------------------------------------------------------------------ statements */

static void write_values(FILE *out, const fst_statement *statement, const fst_finding *finding)
{
    for (int i = 0; i < FST_PAPER_DYNAMICS; ++i) {
        char value[64];
        fst_statement_value(statement, finding->value[order[i]], value, sizeof value);
        fprintf(out, "<tr><td>%s</td><td class=\"n\">", fst_dynamics_name(order[i]));
        fst_report_text(out, value);
        fputs("</td><td>", out);
        fst_report_badge(out, finding->verdict[order[i]]);
        fputs("</td></tr>\n", out);
    }
    if (!finding->dry)
        return;
    char value[64];
    fst_statement_value(statement, finding->dry_value, value, sizeof value);
    fprintf(out, "<tr><td>coulomb, μ = %g</td><td class=\"n\">", FST_DRY_MU);
    fst_report_text(out, value);
    fputs("</td><td>", out);
    fst_report_badge(out, finding->dry_verdict);
    fputs("</td></tr>\n", out);
}

static void write_notes(FILE *out, const fst_finding *finding)
{
    const char *first = finding->note[order[0]], *second = finding->note[order[1]];
    if (first[0] == '\0' && second[0] == '\0')
        return;
    fputs("<p class=\"fine\">", out);
    if (!strcmp(first, second)) {
        fst_report_text(out, first);
    } else {
        fputs("farago2020: ", out);
        fst_report_text(out, first);
        fputs("; rigid: ", out);
        fst_report_text(out, second);
    }
    fputs(".</p>", out);
}

static void write_dry_note(FILE *out, const fst_finding *finding)
{
    if (!finding->dry || finding->dry_note[0] == '\0')
        return;
    fputs("<p class=\"fine\">coulomb: ", out);
    fst_report_text(out, finding->dry_note);
    fputs(".</p>", out);
}

/* The rules come before the statements that they judge. */
static void write_rules(FILE *out)
{
    fputs("<p id=\"rules\">One set of rules holds for all of them. The rules depend on how the paper prints a "
          "number, not on what was computed here:</p>\n<dl class=\"rules\">\n",
          out);
    for (int rule = 0; rule < FST_RULE_COUNT; ++rule) {
        fprintf(out, "<dt>%s: ", fst_rules[rule].name);
        fst_report_text(out, fst_rules[rule].kind);
        fputs("</dt><dd><b>reproduced:</b> ", out);
        fst_report_text(out, fst_rules[rule].reproduced);
        if (fst_rules[rule].close[0]) {
            fputs("; <b>close:</b> ", out);
            fst_report_text(out, fst_rules[rule].close);
        }
        fputs("</dd>\n", out);
    }
    fputs("</dl>\n", out);
}

static void write_statements(FILE *out, const fst_paper_state *paper)
{
    fputs("<h2 id=\"statements\">The paper's statements, one by one</h2>\n", out);
    write_rules(out);
    for (int i = 0; i < fst_statement_count(); ++i) {
        const fst_statement *statement = fst_statement_at(i);
        if (!fst_statement_known(statement, paper))
            continue;
        fst_finding finding = fst_statement_check(statement, paper);
        char text[320];
        fprintf(out, "<section class=\"card\" id=\"%s\"><p class=\"from\">", statement->id);
        fst_report_text(out, statement->section);
        fputs("</p><p>", out);
        fst_report_text(out, statement->text);
        fputs("</p><table><tbody><tr><td>published</td><td colspan=\"2\">", out);
        if (statement->said)
            (void)snprintf(text, sizeof text, "%s", statement->said);
        else
            fst_statement_value(statement, statement->published, text, sizeof text);
        fst_report_text(out, text);
        fputs("</td></tr>\n", out);
        write_values(out, statement, &finding);
        fputs("</tbody></table>", out);
        write_notes(out, &finding);
        write_dry_note(out, &finding);
        fst_statement_criterion(statement, text, sizeof text);
        fputs("<p class=\"fine\">Criterion: ", out);
        fst_report_text(out, text);
        fputs(".</p>", out);
        char command[320], repeat[448];
        fst_statement_command(statement, paper, FST_DYNAMICS_FARAGO2020, command, sizeof command);
        (void)snprintf(repeat, sizeof repeat, "%s   # %s", command,
                       fst_statement_reads(statement, FST_DYNAMICS_FARAGO2020));
        fst_report_code(out, repeat);
        fputs("</section>\n", out);
    }
}

/* ------------------------------------------------------------------ figures */

static fst_status write_figure(FILE *out, const fst_paper_state *paper, int index, fst_error *error)
{
    fst_paper_figure figure = fst_paper_figure_at(index);
    fst_verdict verdict;
    fprintf(out, "<figure id=\"figure-%s\"><h3>", figure.file);
    fst_report_text(out, figure.title);
    if (figure.each)
        fprintf(out, " <small>%s</small>", fst_dynamics_name(figure.dynamics));
    fputs("</h3>\n", out);
    char *path = fst_paper_path(paper, figure.file, "svg");
    fst_status status = path ? fst_report_image(out, path, figure.title, error)
                             : fst_fail(error, FST_NO_MEMORY, figure.file, "no memory for a file name");
    free(path);
    fputs("<figcaption>", out);
    fst_report_text(out, figure.caption);
    fputs(" <span class=\"from\">The paper's ", out);
    fst_report_text(out, figure.source);
    fputs(".</span> ", out);
    for (int i = 0; i < FST_PAPER_DYNAMICS; ++i) {
        if ((figure.each && order[i] != figure.dynamics) ||
            !fst_paper_figure_verdict(paper, &figure, order[i], &verdict))
            continue;
        if (!figure.each)
            fprintf(out, " <small>%s</small> ", fst_dynamics_name((fst_dynamics)order[i]));
        fst_report_badge(out, verdict);
    }
    fputs("</figcaption>", out);
    char command[512];
    fst_paper_figure_command(paper, &figure, command, sizeof command);
    fst_report_code(out, command);
    fputs("</figure>\n", out);
    return status;
}

/* ------------------------------------------------------------------ the end */

static void write_regimes(FILE *out, const fst_paper_state *paper)
{
    fputs("<h2 id=\"regimes\">How the runs ended</h2>\n"
          "<p>How the runs of Fig. 6 ended:</p><div "
          "class=\"scroll\"><table><thead><tr><th>motion</th><th>farago2020</th><th>rigid</th></tr></"
          "thead><tbody>\n",
          out);
    for (int regime = FST_REGIME_UNDECIDED; regime <= FST_REGIME_LIFTED; ++regime) {
        int counts[FST_PAPER_DYNAMICS] = {0};
        for (int d = 0; d < FST_PAPER_DYNAMICS; ++d)
            for (int i = 0; i < paper->counts[FST_SCAN_COMPARISON]; ++i)
                counts[d] += paper->scans[FST_SCAN_COMPARISON][d][i].result.regime == (fst_regime)regime;
        if (counts[0] + counts[1] > 0)
            fprintf(out, "<tr><td>%s</td><td class=\"n\">%d</td><td class=\"n\">%d</td></tr>\n",
                    fst_regime_name((fst_regime)regime), counts[order[0]], counts[order[1]]);
    }
    fputs("</tbody></table></div>\n", out);
}

static void write_times(FILE *out, const fst_paper_state *paper)
{
    fputs("<table><thead><tr><th>part</th><th>seconds</th></tr></thead><tbody>\n", out);
    for (int i = 0; i < paper->part_count; ++i)
        fprintf(out, "<tr><td>%s</td><td class=\"n\">%.1f</td></tr>\n", paper->parts[i].what,
                paper->parts[i].seconds);
    fprintf(out,
            "<tr><td>all, without films</td><td class=\"n\">%.1f</td></tr>\n</tbody></table>\n"
            "<p class=\"fine\">Together %.0f s of processor time.</p>\n",
            paper->seconds, paper->processor_seconds);
}

static void write_provenance(FILE *out, const fst_paper_state *paper)
{
    const fst_params *params = &fst_paper_single(paper, FST_SCAN_FOLD15, FST_DYNAMICS_RIGID)->params;
    char *scene = fst_scene_text(params, 0), machine[512];
    fst_paper_machine(machine, sizeof machine);
    fprintf(out,
            "<h2 id=\"provenance\">Where the numbers come from</h2>\n"
            "<p>festoon %s%s. Method: Dormand and Prince, order 8(5,3), relative and absolute tolerance %g. "
            "Each run lasts %g turns of the magnet, the means are taken after the first %g. Arithmetic: ",
            fst_version(), paper->options->reduced ? ", reduced: fewer points and shorter runs" : "",
            params->run_rtol, params->run_periods, params->run_discard);
    fst_report_text(out, machine);
    fputs(". The same commands give the same numbers again. Beside this page: paper.json, and for each figure "
          "its "
          "SVG, the gnuplot script and the data.</p>\n",
          out);
    write_times(out, paper);
    fputs("<details><summary>The scene (here with the drive 0.4)</summary><pre>", out);
    fst_report_text(out, scene ? scene : "");
    fputs("</pre></details>\n", out);
    free(scene);
}

static fst_status write_all(FILE *out, const fst_paper_state *paper, fst_error *error)
{
    fputs(fst_report_head, out);
    write_summary(out, paper);
    write_table1(out, paper);
    fputs("<h2 id=\"figures\">The figures</h2>\n<div class=\"figures\">\n", out);
    fst_status status = FST_OK;
    for (int i = 0; i < fst_paper_figure_count() && status == FST_OK; ++i)
        if (paper->drawn[i])
            status = write_figure(out, paper, i, error);
    fputs("</div>\n", out);
    for (int i = 0; i < paper->films; ++i)
        fprintf(
            out,
            "<p class=\"fine\">Film of the supplement, beside this page: %s.mp4 (festoon paper --films).</p>\n",
            fst_film_names[i]);
    fst_report_dry(out, paper);
    write_statements(out, paper);
    write_regimes(out, paper);
    write_provenance(out, paper);
    fputs("</main></body></html>\n", out);
    return status;
}

fst_status fst_paper_write_report(const fst_paper_state *paper, fst_error *error)
{
    char *path = fst_paper_path(paper, "report", "html");
    if (!path)
        return fst_fail(error, FST_NO_MEMORY, "report.html", "no memory for a file name");
    fst_whole_file file;
    fst_status status = fst_whole_file_open(&file, path, error);
    free(path);
    if (status != FST_OK)
        return status;
    status = write_all(file.stream, paper, error);
    if (status == FST_OK)
        return fst_whole_file_commit(&file, error);
    fst_whole_file_discard(&file);
    return status;
}
