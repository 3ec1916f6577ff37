/* magnets_report.c - the chapter "With real magnets" of the report. */
#include "paper/magnets.h"
#include "paper/report_parts.h"
#include "paper/runs.h"

/* Whether a magnet has runs under a law; a law of -1 stands for any. A reduced paper makes few. */
static int is_known(const fst_paper_state *paper, int magnet, int law)
{
    for (int l = 0; l < FST_MAGNET_LAWS; ++l)
        for (int i = 0; i < FST_MAGNET_RUNS; ++i)
            if ((law < 0 || law == l) && paper->magnets->of[magnet].runs[l][i].done)
                return 1;
    return 0;
}

static int law_is_known(const fst_paper_state *paper, int law)
{
    for (int magnet = 0; magnet < FST_MAGNETS; ++magnet)
        if (is_known(paper, magnet, law))
            return 1;
    return 0;
}

static void write_value(FILE *out, const fst_paper_state *paper, int fact, int magnet, int law)
{
    static const char *const classes[] = {"reproduced", "close", "not"}, *const marks[] = {"✓", "≈", "✗"};
    const fst_statement *about = fst_magnet_fact_about(fact);
    const double value = fst_magnet_fact(paper, fact, magnet, law);
    const fst_verdict verdict = fst_statement_verdict(about, value);
    const int judged = isfinite(value) && (isfinite(about->published) || about->rule != FST_RULE_NUMBER);
    char text[64];
    fst_statement_value(about, value, text, sizeof text);
    fprintf(out, "<td class=\"n %s\"><span class=\"label\">%s</span>%s&nbsp;%s</td>",
            judged ? classes[verdict] : "", fst_shown_magnets[magnet].name, isfinite(value) ? text : "–",
            judged ? marks[verdict] : "");
}

static void write_head(FILE *out, const fst_paper_state *paper)
{
    fputs("<table class=\"facts\"><thead><tr><th>the paper's words</th>", out);
    for (int magnet = 0; magnet < FST_MAGNETS; ++magnet)
        if (is_known(paper, magnet, -1))
            fprintf(out, "<th>%s</th>", fst_shown_magnets[magnet].name);
    fputs("</tr></thead><tbody>\n", out);
}

/* The fact and the paper's number in the first of its rows, and the law in each. */
static void write_words(FILE *out, int fact, int law, int first)
{
    const fst_statement *about = fst_magnet_fact_about(fact);
    char published[64];
    fputs("<tr><td>", out);
    if (first) {
        fst_report_text(out, about->text);
        fst_statement_published(about, published, sizeof published);
        fprintf(out, ": <strong>%s</strong>; ", isfinite(about->published) ? published : "most");
    }
    fprintf(out, "%s</td>", fst_magnet_law_name(law));
}

/* What no motion decides stands in the list of magnets. */
static void write_facts(FILE *out, const fst_paper_state *paper)
{
    write_head(out, paper);
    for (int fact = FST_MAGNET_STILL_FACTS; fact < FST_MAGNET_FACTS; ++fact)
        for (int law = 0, rows = 0; law < FST_MAGNET_LAWS; ++law) {
            if (!law_is_known(paper, law))
                continue;
            write_words(out, fact, law, rows++ == 0);
            for (int magnet = 0; magnet < FST_MAGNETS; ++magnet)
                if (is_known(paper, magnet, -1))
                    write_value(out, paper, fact, magnet, law);
            fputs("</tr>\n", out);
        }
    fputs("</tbody></table>\n", out);
}

static void write_magnets(FILE *out, const fst_paper_state *paper)
{
    fputs("<ul>\n", out);
    for (int magnet = 0; magnet < FST_MAGNETS; ++magnet) {
        const fst_shown_magnet *shown = &fst_shown_magnets[magnet];
        const fst_magnet_column *column = &paper->magnets->of[magnet];
        fprintf(out, "<li><strong>%s</strong>: ", shown->name);
        fst_report_text(out, shown->about);
        if (shown->part_count > 0)
            fprintf(out, ", %.3f T", column->remanence);
        fprintf(out, "; maxima %.1f mm apart at the bead's centre, %.1f mm on the plate</li>\n", column->apart,
                column->apart_plate);
    }
    fputs("</ul>\n", out);
}

/* The command of one run, with the magnet written out. */
static void write_command(FILE *out, const fst_paper_state *paper, int magnet, int law)
{
    const fst_shown_magnet *shown = &fst_shown_magnets[magnet];
    const double remanence = paper->magnets->of[magnet].remanence;
    char command[2048];
    int used = snprintf(command, sizeof command,
                        "festoon run --set magnet.shape=parts --set bead.remanence=%gT", FST_MAGNET_BEAD);
    for (int i = 0; i < shown->part_count; ++i) {
        const fst_magnet_part *part = &shown->parts[i];
        used += snprintf(command + used, sizeof command - (size_t)used,
                         " --set 'magnet.parts[%d].kind=cuboid' --set 'magnet.parts[%d].centre[0]=%gmm'"
                         " --set 'magnet.parts[%d].size[0]=%gmm' --set 'magnet.parts[%d].size[1]=%gmm'"
                         " --set 'magnet.parts[%d].size[2]=%gmm' --set 'magnet.parts[%d].remanence[%d]=%gT'",
                         i, i, 1e3 * part->centre[0], i, 1e3 * part->size[0], i, 1e3 * part->size[1], i,
                         1e3 * part->size[2], i, part->remanence[0] != 0.0 ? 0 : 2,
                         remanence * (part->remanence[0] + part->remanence[2]));
    }
    (void)snprintf(
        command + used, sizeof command - (size_t)used,
        "%s --set drive.frequency=10.7Hz --set run.rtol=1e-8 --set run.periods=%g --set run.discard=%g",
        law ? " --set friction.law=coulomb --set friction.mu=0.2" : "", paper->options->reduced ? 100.0 : 160.0,
        paper->options->reduced ? 60.0 : 120.0);
    fst_report_code(out, command);
}

void fst_report_magnets(FILE *out, const fst_paper_state *paper)
{
    if (!fst_paper_has_magnets(paper))
        return;
    fprintf(
        out,
        "<h2 id=\"magnets\">With real magnets</h2>\n"
        "<p>The paper measured of its magnet the outline, 56 × 40 × 9 mm, its depth, and the distance of the "
        "two maxima of its field, 41 mm. It made the lines of its model shorter than the magnet until their "
        "maxima had this distance. A block of this outline that is magnetised along its length throughout "
        "has them %.1f mm apart, so it cannot be the magnet. Below, the experiment with blocks in the place "
        "of the lines: each has the remanence that gives the greatest field of the lines at κ = %g and a "
        "bead of %g T, %.1f mT. Recoil permeability and iron are left out.</p>\n",
        paper->magnets->of[1].apart, FST_MAGNET_KAPPA, FST_MAGNET_BEAD, 1e3 * paper->magnets->greatest);
    write_magnets(out, paper);
    fputs("<p>Which magnet of this outline can it be? One whose ends give little field: a block with 45 mm of "
          "magnetised length, say, or two blocks that stand on their poles with a gap of 30 mm. With the "
          "paper's friction the first comes near to what the text tells, as the five lines do, to which "
          "friction and strength were fitted; the second does not, and neither does the whole bar. With dry "
          "friction, where no rate is fitted, the shape of the field decides much: on the whole bar a bead "
          "draws twenty small festoons at 10.7 Hz where the experiment has four large ones, and two upright "
          "blocks throw it off up to 13 Hz. 45 mm of the bar throw it off up to 11 Hz, and there it draws 15 "
          "festoons at 19.9 Hz.</p>\n",
          out);
    write_facts(out, paper);
    fputs(
        "<p class=\"fine\">Viscous: the paper's rate, 312.5 1/s. Dry: Coulomb's law, μ = 0.2, no rate. Both by "
        "the exact equations. ✓ reproduced, ≈ close, ✗ not reproduced, – not told by these runs. The bead "
        "starts rolling, and at rest above a pole. The spread of the field is the paper's simulation, not a "
        "measurement. One run again, of the whole bar that rubs dry:</p>\n",
        out);
    write_command(out, paper, 1, 1);
}
