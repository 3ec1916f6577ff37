/* report_findings.c - the first chapter of the report: what was found.  Every number in it is one that this run
 * computed; what it has not computed is left out. */
#include "base/constants.h"
#include "paper/dry.h"
#include "paper/runs.h"
#include "paper/report_parts.h"

/* A number as text; "—" where there is none. */
typedef struct shown {
    char text[32];
} shown;

static shown show(const char *format, double value)
{
    shown s = {"—"};
    if (isfinite(value))
        (void)snprintf(s.text, sizeof s.text, format, value);
    return s;
}

/* The value of a statement; NAN: it is not computed. */
static double value_of(const fst_paper_state *paper, const char *id, fst_dynamics dynamics)
{
    const fst_statement *statement = fst_statement_named(id);
    if (!fst_statement_known(statement, paper))
        return NAN;
    return fst_statement_check(statement, paper).value[dynamics];
}

static int is_known(const fst_paper_state *paper, const char *id)
{
    return fst_statement_known(fst_statement_named(id), paper);
}

static double printed(const fst_paper_state *paper, const char *id)
{
    return value_of(paper, id, FST_DYNAMICS_FARAGO2020);
}

static double exact(const fst_paper_state *paper, const char *id)
{
    return value_of(paper, id, FST_DYNAMICS_RIGID);
}

/* The third column's value. */
static double rubbing(const fst_paper_state *paper, const char *id)
{
    return fst_statement_check(fst_statement_named(id), paper).dry_value;
}

/* Links to the statements, at the end of a finding. */
static void end_finding(FILE *out, const char *const ids[])
{
    fputs(" <span class=\"from\">", out);
    for (int i = 0; ids[i]; ++i)
        fprintf(out, "%s<a href=\"#%s\">%s</a>", i ? ", " : "", ids[i], ids[i]);
    fputs("</span></li>\n", out);
}
#define END(...) end_finding(out, (const char *const[]){__VA_ARGS__, NULL})

static void write_gyroscope(FILE *out, const fst_paper_state *paper)
{
    if (!is_known(paper, "turning-equations"))
        return;
    fprintf(out,
            "<li><b>The printed equation of the moment lacks its gyroscopic term, ψ′ n × n′.</b> The "
            "simulation behind the "
            "paper lacks it as well: its equations as printed give Table 1 and the period halving (ω = %s; the "
            "paper: "
            "0.2904), a rigid sphere halves its period at %s already. A bead's motion misses the printed "
            "equation by %s %% of "
            "its size.",
            show("%.4f", printed(paper, "halving")).text, show("%.4f", exact(paper, "halving")).text,
            show("%.0f", 100.0 * exact(paper, "turning-equations")).text);
    END("turning-equations", "euler-equation", "halving");
}

static void write_misprints(FILE *out, const fst_paper_state *paper)
{
    if (!is_known(paper, "appendix-theta"))
        return;
    fputs("<li><b>Two equations of the Appendix are misprinted.</b> In Eq. (21), + α′² sin θ cos θ sin² φ "
          "should read "
          "− α′² sin θ cos θ cos² φ; in Eq. (22), the factor 5κ/(2ε) of the friction should read 5/(2ε). The "
          "gyroscopic term "
          "is missing from both. Eq. (12) drops the radial part of n from its magnetic term, which reverses "
          "the term's sign "
          "in the experiment's range.",
          out);
    END("appendix-theta", "appendix-phi", "magnetic-term");
}

static void write_chaos(FILE *out, const fst_paper_state *paper)
{
    if (!is_known(paper, "chaos"))
        return;
    fprintf(out,
            "<li><b>With viscous friction there is no chaos between corotation and counter-rotation.</b> Of "
            "the runs from 7 to "
            "10 Hz, %s %% are irregular or leave the plate: the bead is locked, swings about the magnet, or "
            "counter-rotates.",
            show("%.0f", exact(paper, "chaos")).text);
    if (is_known(paper, "unlocking"))
        fprintf(out,
                " Nor is it friction that ends corotation: the drive at which the last locked state loses its "
                "stability goes as "
                "γ to the power −%s, not as 1/γ.",
                show("%.3f", exact(paper, "unlocking")).text);
    END("chaos", "unlocking", "corotation");
}

static void write_fold(FILE *out, const fst_paper_state *paper)
{
    const double hertz =
        fst_paper_single(paper, FST_SCAN_FOLD15, FST_DYNAMICS_RIGID)->params.friction_gamma / (2.0 * FST_PI);
    if (!is_known(paper, "asymptotic"))
        return;
    fprintf(out,
            "<li><b>Counter-rotation ends at high drives, in a fold.</b> At %s Hz (equations as printed: %s "
            "Hz) the orbit meets "
            "its unstable twin, and beyond the magnet no longer holds the bead. The limit of free rolling at "
            "infinite drive "
            "does not exist.",
            show("%.0f", hertz * paper->exact[FST_DYNAMICS_RIGID].fold).text,
            show("%.0f", hertz * paper->exact[FST_DYNAMICS_FARAGO2020].fold).text);
    END("asymptotic", "asymptotic-hz");
}

static void write_festoons(FILE *out, const fst_paper_state *paper)
{
    if (!is_known(paper, "force-ends"))
        return;
    fprintf(
        out,
        "<li><b>The festoons come about the other way round.</b> Over the ends of the magnet, where the radius "
        "is least, "
        "the magnet's force on the bead is %s %% weaker than over its middle, and does not pull inwards. The "
        "bead is "
        "driven faster than it could swing by itself, so that its radius is greatest where the pull inwards is "
        "greatest.",
        show("%.0f", -exact(paper, "force-ends")).text);
    END("force-ends", "pull-weakens", "modulation");
}

static void write_paramagnets(FILE *out, const fst_paper_state *paper)
{
    if (!is_known(paper, "splitting"))
        return;
    fprintf(out,
            "<li><b>Paramagnetic beads do not counter-rotate, but the last step of the argument fails.</b> The "
            "ratio that it takes "
            "for 1 is %s in a settled motion: by the paper's own identities it is ω/⟨α′⟩. Another identity, "
            "a⟨∂B²/∂α⟩ = "
            "(2/5)⟨(v × V)<sub>z</sub>⟩, excludes a rolling bead that circles against the magnet.",
            show("%.1f", exact(paper, "splitting")).text);
    END("splitting", "rolling-identity", "paramagnet");
}

static void write_dry(FILE *out, const fst_paper_state *paper)
{
    if (!paper->dry || !paper->done[FST_PAPER_STEP_DRY])
        return;
    fprintf(out,
            "<li><b>Dry friction needs no fitted rate, and loses the bead where the experiment does.</b> With "
            "μ = %g, of four coefficients "
            "the one that agrees best, a bead "
            "goes with the "
            "magnet up to about %s Hz, %s %% of the runs from 7 to 10 Hz end off the plate, and "
            "counter-rotation sets in at "
            "%s Hz with %s festoons at 10.7 Hz. It misses the bell: the bead circles most slowly at %s Hz, not "
            "16.",
            FST_DRY_MU, show("%.1f", rubbing(paper, "corotation")).text,
            show("%.0f", rubbing(paper, "chaos")).text, show("%.1f", rubbing(paper, "onset")).text,
            show("%.1f", rubbing(paper, "fold4-festoons")).text, show("%.1f", rubbing(paper, "bell")).text);
    fputs(" <span class=\"from\"><a href=\"#dry\">what dry friction says</a></span></li>\n", out);
}

void fst_report_findings(FILE *out, const fst_paper_state *paper)
{
    fputs("<h2 id=\"found\">What we found</h2>\n<ol class=\"found\">\n", out);
    write_gyroscope(out, paper);
    write_misprints(out, paper);
    write_chaos(out, paper);
    write_fold(out, paper);
    write_festoons(out, paper);
    write_paramagnets(out, paper);
    write_dry(out, paper);
    fputs("</ol>\n", out);
}
