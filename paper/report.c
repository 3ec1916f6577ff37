/* report.c - report.html: the comparison for people, in one file that needs no other. */
#include "paper/beads.h"
#include "paper/waves.h"
#include "paper/dry.h"
#include "paper/magnets.h"
#include "paper/report.h"
#include "paper/runs.h"
#include "paper/work.h"
#include "paper/report_parts.h"

#include "base/error.h"

#include <stdlib.h>
#include <string.h>

/* ------------------------------------------------------------------ the first page */

static void write_counts(FILE *out, const char *title, const char *id, const fst_tally *tally)
{
    fputs("<tr><td>", out);
    if (id)
        fprintf(out, "<a href=\"#%s\">%s</a>", id, title);
    else
        fprintf(out, "<b>%s</b>", title);
    fputs("</td>", out);
    for (int i = 0; i < FST_PAPER_DYNAMICS; ++i) {
        const int *of = tally->of[fst_paper_order[i]];
        fprintf(out, tally->moving > 0 ? "<td class=\"n\">%d · %d · %d</td>" : "<td></td>", of[0], of[1],
                of[2]);
    }
    fprintf(out, tally->still > 0 ? "<td class=\"n\">%d · %d · %d</td></tr>\n" : "<td></td></tr>\n",
            tally->once[0], tally->once[1], tally->once[2]);
}

static void write_summary(FILE *out, const fst_paper_state *paper)
{
    fputs("<h2 id=\"tally\">The claims, counted</h2>\n<p>Reproduced · close · not reproduced. Where no "
          "motion enters, both dynamics have the same number, and it counts once.</p>\n"
          "<table class=\"tally\"><thead><tr><th></th><th>farago2020<br><small>as "
          "printed</small></th><th>rigid<br><small>exact</small></th><th>no motion</th></tr></thead><tbody>\n",
          out);
    fst_tally all = {0};
    for (int group = 0; group < FST_GROUP_COUNT; ++group) {
        const fst_tally tally = fst_paper_tally(paper, (fst_group)group);
        char id[16];
        (void)snprintf(id, sizeof id, "group-%d", group + 1);
        write_counts(out, fst_groups_of_statements[group].title, id, &tally);
        fst_tally_add(&all, &tally);
    }
    write_counts(out, "All", NULL, &all);
    fputs("</tbody></table>\n", out);
    if (all.undecided > 0)
        fprintf(out,
                "<p class=\"fine\">Undecided, since runs had not settled: %d of the verdicts “not "
                "reproduced”.</p>\n",
                all.undecided);
    int dry[3] = {0};
    const int about_motion = fst_paper_dry_tally(paper, dry);
    if (about_motion > 0)
        fprintf(out,
                "<p>Of the claims, %d can be asked of a bead that rubs dry. With <a href=\"#dry\">dry "
                "friction</a>, μ = %g, %d are reproduced, %d close, %d not.</p>\n",
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
        const fst_paper_exact *exact = &paper->exact[fst_paper_order[i]];
        const char *name = fst_dynamics_name(fst_paper_order[i]);
        if (exact->missing[0]) {
            fprintf(out, "<p class=\"fine\">No exact drives for %s: ", name);
            fst_report_text(out, exact->missing);
            fputs("</p>\n", out);
        } else if (exact->most_s1 > 0.0) {
            fprintf(out,
                    "<p class=\"fine\">With %s the patterns of symmetry S1 have up to %.3f festoons: the "
                    "period halves at ω = %.9f, and above it they have the symmetry S2.</p>\n",
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
          "these five drives the paper finds patterns that almost close. Where only the symmetry differs, N "
          "is about twice or half as large. The last line of each cell is the drive at which the pattern "
          "closes exactly: a periodic orbit found by Newton's method.</p>\n"
          "<table class=\"narrow\"><thead><tr><th>drive "
          "ω</th><th>published</th><th>farago2020</th><th>rigid</th></tr></thead><tbody>\n",
          out);
    for (int row = 0; row < FST_TABLE1_ROWS; ++row) {
        fprintf(out, "<tr><td class=\"n\">%g</td><td class=\"n\">%.2f <small>S%d</small></td>",
                fst_table1[row].omega, fst_table1[row].published, fst_table1[row].published_a);
        for (int i = 0; i < FST_PAPER_DYNAMICS; ++i)
            write_festoons(out, paper, row, fst_paper_order[i]);
        fputs("</tr>\n", out);
    }
    fputs("</tbody></table>\n", out);
    write_orbits_missing(out, paper);
    fputs("<p class=\"fine\">Criterion: " FST_TABLE1_CRITERION ". Each number again:</p>", out);
    fst_report_code(out, command);
    fst_report_code(out, "festoon orbit --festoons 4 --set model.dynamics=farago2020   # and 5, 6, 14, 15");
}

/* ------------------------------------------------------------------ the end */

static void write_regimes(FILE *out, const fst_paper_state *paper)
{
    fputs("<h2 id=\"regimes\">How the runs ended</h2>\n"
          "<p>The drives of Fig. 6, from the rolling start:</p>"
          "<table><thead><tr><th>motion</th><th>farago2020</th><th>rigid</th></tr></thead><tbody>\n",
          out);
    for (int regime = FST_REGIME_UNDECIDED; regime <= FST_REGIME_LIFTED; ++regime) {
        int counts[FST_PAPER_DYNAMICS] = {0};
        for (int d = 0; d < FST_PAPER_DYNAMICS; ++d)
            for (int i = 0; i < paper->counts[FST_SCAN_COMPARISON]; ++i)
                counts[d] += paper->scans[FST_SCAN_COMPARISON][d][i].result.regime == (fst_regime)regime;
        if (counts[0] + counts[1] > 0)
            fprintf(out, "<tr><td>%s</td><td class=\"n\">%d</td><td class=\"n\">%d</td></tr>\n",
                    fst_regime_name((fst_regime)regime), counts[fst_paper_order[0]],
                    counts[fst_paper_order[1]]);
    }
    fputs("</tbody></table>\n", out);
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
    fputs(". The same commands give the same numbers again. Beside this page: paper.json, and for each "
          "figure its SVG, the gnuplot script and the data.</p>\n",
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
    fputs(fst_report_introduction, out);
    if (!paper->complete)
        fputs("<p class=\"incomplete\">Incomplete: this was interrupted. What was done until then is here; "
              "the same command makes the whole.</p>\n",
              out);
    fst_report_findings(out, paper);
    fputs(fst_report_reading, out);
    write_summary(out, paper);
    write_table1(out, paper);
    fst_status status = fst_report_statements(out, paper, error);
    if (status == FST_OK)
        status = fst_report_other_figures(out, paper, error);
    fst_report_dry(out, paper);
    fst_report_magnets(out, paper);
    fst_report_beads(out, paper);
    fst_report_waves(out, paper);
    write_regimes(out, paper);
    write_provenance(out, paper);
    fputs("</main></body></html>\n", out);
    return status;
}

fst_status fst_paper_write_report(const fst_paper_state *paper, fst_error *error)
{
    fst_paper_file file;
    fst_status status = fst_paper_file_begin(&file, error);
    if (status != FST_OK)
        return status;
    status = write_all(file.stream, paper, error);
    return fst_paper_file_end(&file, paper, "report", "html", status, error);
}
