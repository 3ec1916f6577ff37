/* report_findings.c - the first chapter of the report: what was found (findings.def).  Every number in it is
 * one that this run computed; what it has not computed is left out. */
#include "base/constants.h"
#include "paper/beads.h"
#include "paper/waves.h"
#include "paper/dry.h"
#include "paper/runs.h"
#include "paper/report_parts.h"

#include <string.h>

static const struct {
    const char *known, *text, *links;
} findings[] = {
#define FINDING(known, text, links) {known, text, links},
#include "paper/findings.def"
#undef FINDING
};

static int is_known(const fst_paper_state *paper, const char *id)
{
    if (strcmp(id, "dry") == 0)
        return paper->dry && paper->done[FST_PAPER_STEP_DRY];
    if (strcmp(id, "beads") == 0) { /* a reduced paper has not looked for the three drives */
        double drives[FST_BEADS_CASES];
        return paper->beads && paper->done[FST_PAPER_STEP_BEADS] &&
               fst_beads_changes(paper->beads, drives) == 3;
    }
    if (strcmp(id, "waves") == 0) /* a reduced one has few drives and no beads let go at rest */
        return paper->waves && paper->done[FST_PAPER_STEP_WAVES] && !paper->options->reduced;
    return fst_statement_known(fst_statement_named(id), paper);
}

/* A number as findings.def names it; NAN: it is not computed. */
static double value_of(const fst_paper_state *paper, const char *column, const char *id)
{
    const fst_dynamics dynamics = strcmp(column, "printed") == 0 ? FST_DYNAMICS_FARAGO2020 : FST_DYNAMICS_RIGID;
    if (strncmp(id, "change", 6) == 0) {
        double drives[FST_BEADS_CASES] = {NAN, NAN, NAN};
        (void)fst_beads_changes(paper->beads, drives);
        return drives[id[6] - '1'];
    }
    for (int i = 0; i < FST_WAVE_NUMBERS && strncmp(id, "wave-", 5) == 0; ++i)
        if (strcmp(id + 5, fst_wave_names[i]) == 0)
            return fst_wave_found(paper->waves, (fst_wave_number)i);
    if (strcmp(id, "mu") == 0)
        return FST_DRY_MU;
    if (strcmp(id, "fold") == 0)
        return fst_paper_single(paper, FST_SCAN_FOLD15, dynamics)->params.friction_gamma / (2.0 * FST_PI) *
               paper->exact[dynamics].fold;
    if (!is_known(paper, id))
        return NAN;
    const fst_finding found = fst_statement_check(fst_statement_named(id), paper);
    return strcmp(column, "coulomb") == 0 ? found.dry_value : found.value[dynamics];
}

static void write_text(FILE *out, const fst_paper_state *paper, const char *text)
{
    for (const char *c = text; *c; ++c) {
        char column[16] = "", id[32] = "";
        int decimals = 0;
        double factor = 1.0;
        if (*c != '{') {
            fputc(*c, out);
            continue;
        }
        (void)sscanf(c, "{%d %15s %31[^ }] %lf", &decimals, column, id, &factor);
        const double value = factor * value_of(paper, column, id);
        fprintf(out, isfinite(value) ? "%.*f" : "—", decimals, value);
        c = strchr(c, '}');
    }
}

/* Links to the statements, at the end of a finding. */
static void write_links(FILE *out, const char *ids)
{
    fputs(" <span class=\"from\">", out);
    for (const char *id = ids; *id; id += strspn(id, " ")) {
        const int length = (int)strcspn(id, " ");
        const char *chapter = strcmp(id, "dry") == 0     ? "what dry friction says"
                              : strcmp(id, "beads") == 0 ? "several beads"
                              : strcmp(id, "waves") == 0 ? "a travelling field"
                                                         : NULL;
        fprintf(out, "%s<a href=\"#%.*s\">%.*s</a>", id > ids ? ", " : "", length, id, chapter ? 64 : length,
                chapter ? chapter : id);
        id += length;
    }
    fputs("</span></li>\n", out);
}

void fst_report_findings(FILE *out, const fst_paper_state *paper)
{
    fputs("<h2 id=\"found\">What we found</h2>\n<ol class=\"found\">\n", out);
    for (size_t i = 0, begun = 0; i < sizeof findings / sizeof findings[0]; ++i) {
        const int known = is_known(paper, findings[i].known), goes_on = i > 0 && !findings[i - 1].links[0];
        begun = goes_on ? begun : (size_t)known;
        if (begun && known && !goes_on)
            fputs("<li>", out);
        if (begun && known)
            write_text(out, paper, findings[i].text);
        if (begun && findings[i].links[0])
            write_links(out, findings[i].links);
    }
    fputs("</ol>\n", out);
}
