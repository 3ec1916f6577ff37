/* dry_report.c - the chapter "What dry friction says" of the report. */
#include "paper/dry.h"
#include "paper/report_parts.h"
#include "paper/runs.h"

/* The number on the colour of its verdict, with the distance from the paper's. */
static void write_fact(FILE *out, const fst_statement *about, int law, double value)
{
    static const char *const classes[] = {"reproduced", "close", "not"}, *const marks[] = {"✓", "≈", "✗"};
    const fst_verdict verdict = fst_statement_verdict(about, value);
    char name[48], text[64];
    double border;
    fst_dry_law_name(law, name, sizeof name);
    fst_statement_value(about, value, text, sizeof text);
    const int known = isfinite(value); /* otherwise no run has shown it */
    fprintf(out, "<td class=\"n %s\" title=\"%s\"><span class=\"label\">", known ? classes[verdict] : "",
            known ? fst_verdict_name(verdict) : "not known");
    fst_report_text(out, name);
    fprintf(out, "</span>%s&nbsp;%s", text, known ? marks[verdict] : "");
    if (known && isfinite(about->published))
        fprintf(out, "<br><small>%+.0f %%</small>", 100.0 * (value / about->published - 1.0));
    if (fst_statement_margin(about, value, &border) < FST_HAIR)
        fprintf(out, "<br><small>%.4g decides</small>", border);
    fputs("</td>", out);
}

/* Whether any fact is known of a law: a reduced paper computes one coefficient. */
static int law_is_known(const fst_paper_state *paper, int law)
{
    for (int fact = 0; fact < FST_FACT_COUNT; ++fact)
        if (isfinite(fst_dry_fact(paper, fact, law)))
            return 1;
    return 0;
}

/* Whether any run was done with a coefficient, or at a drive; -1 stands for all. */
static int any_done(const fst_paper_dry *dry, int start, int mu, int drive)
{
    for (int m = 0; m < FST_DRY_MUS; ++m)
        for (int d = 0; d < (start ? FST_DRY_SLOW : FST_DRY_DRIVES); ++d)
            if ((mu < 0 || mu == m) && (drive < 0 || drive == d) && dry->map[m][d][start].done)
                return 1;
    return 0;
}

static void write_facts(FILE *out, const fst_paper_state *paper)
{
    fputs("<table class=\"facts\"><thead><tr><th>the paper's words</th>", out);
    for (int law = 0; law < FST_DRY_LAWS; ++law) {
        char name[48];
        if (!law_is_known(paper, law))
            continue;
        fst_dry_law_name(law, name, sizeof name);
        fputs("<th>", out);
        fst_report_text(out, name);
        fputs("</th>", out);
    }
    fputs("</tr></thead><tbody>\n", out);
    for (int fact = 0; fact < FST_FACT_COUNT; ++fact) {
        const fst_statement *about = &fst_dry_facts[fact];
        char text[64];
        fputs("<tr><td>", out);
        fst_report_text(out, about->text);
        fst_statement_published(about, text, sizeof text);
        fprintf(out, ": <strong>%s</strong></td>", isfinite(about->published) ? text : "most");
        for (int law = 0; law < FST_DRY_LAWS; ++law)
            if (law_is_known(paper, law))
                write_fact(out, about, law, fst_dry_fact(paper, fact, law));
        fputs("</tr>\n", out);
    }
    fputs("</tbody></table>\n", out);
}

static void write_cell(FILE *out, const fst_paper_run *run)
{
    static const char *const colours[FST_OUTCOME_COUNT] = {"#d8efe3", "#d9e6f7", "#f9d9cf", "#f3c9e4",
                                                           "#eeeeee"};
    static const char *const words[FST_OUTCOME_COUNT] = {"against", "with", "ejected", "lifted", "other"};
    if (!run->done) {
        fputs("<td></td>", out);
        return;
    }
    const fst_dry_outcome outcome = fst_outcome(&run->result);
    const int undecided = fst_paper_may_settle(&run->result);
    fprintf(out, "<td style=\"background:%s\">%s%s</td>", colours[outcome], words[outcome],
            undecided ? " ?" : "");
}

static void write_map(FILE *out, const fst_paper_dry *dry, int start)
{
    fprintf(out, "<h3>%s</h3><table class=\"map\"><thead><tr><th>Hz</th>",
            start ? "Released at rest above a pole" : "Rolling at the start");
    for (int mu = 0; mu < FST_DRY_MUS; ++mu)
        if (any_done(dry, start, mu, -1))
            fprintf(out, "<th>μ = %g</th>", fst_dry_mus[mu]);
    fputs("</tr></thead><tbody>\n", out);
    const int drives = start ? FST_DRY_SLOW : FST_DRY_DRIVES;
    for (int drive = 0; drive < drives; ++drive) {
        if (!any_done(dry, start, -1, drive))
            continue;
        fprintf(out, "<tr><td class=\"n\">%g</td>", fst_dry_drives[drive]);
        for (int mu = 0; mu < FST_DRY_MUS; ++mu)
            if (any_done(dry, start, mu, -1))
                write_cell(out, &dry->map[mu][drive][start]);
        fputs("</tr>\n", out);
    }
    fputs("</tbody></table>\n", out);
}

void fst_report_dry(FILE *out, const fst_paper_state *paper)
{
    if (!paper->dry || !paper->done[FST_PAPER_STEP_DRY])
        return;
    fprintf(
        out,
        "<h2 id=\"dry\">What dry friction says</h2>\n"
        "<p>The paper's bead rubs dry on its plate, the paper's model is viscous with a fitted rate. The load "
        "on the contact is the magnet's own pull, which the model knows at every instant; so Coulomb's law "
        "needs one number, the coefficient of friction μ, and no rate. Below, the same bead (the same κγ², the "
        "exact equations) with that law. While its contact sticks it rolls exactly; friction is then whatever "
        "keeps it so.</p>\n"
        "<p>Corotation ends where the locked, slipping state ends in a fold, near 7 to 8 Hz: the centrifugal "
        "force wins over the magnet's pull. Beyond, most beads are thrown off the plate, as in the "
        "experiment and unlike with viscous friction; from about 10 Hz on counter-rotation takes over. The "
        "third column of the claims above has μ = %g.</p>\n",
        FST_DRY_MU);
    write_facts(out, paper);
    fputs("<p class=\"fine\">✓ reproduced, ≈ close, ✗ not reproduced. The percentages are distances from the "
          "paper's number. Runs of 120 turns of the magnet, means after 80. What a bead does depends on its "
          "start too: two are shown. A question mark stands where the motion had not settled. Motions that "
          "end in pure rolling settle ever more slowly.</p>\n",
          out);
    for (int start = 0; start < FST_DRY_STARTS; ++start)
        write_map(out, paper->dry, start);
    fputs("<p class=\"fine\">Each cell again, and the whole maps:</p>", out);
    fst_report_code(out,
                    "festoon run --set friction.law=coulomb --set friction.mu=0.2 --set drive.frequency=8Hz "
                    "--set run.rtol=1e-7 --set run.periods=120 --set run.discard=80   # start.spin=rest, "
                    "start.r=0.89: at rest above a pole");
    fst_report_code(out, "festoon paper --dry-maps -o DIR");
}
