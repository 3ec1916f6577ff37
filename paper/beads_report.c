/* beads_report.c - the chapter "Several beads" of the report. */
#include "paper/beads.h"
#include "paper/report_parts.h"

#include <math.h>

static const char *const heads[FST_ASK_COUNT] = {
    "drive, Hz</th><th>start, degrees apart</th><th>they end",
    "drive, Hz</th><th>multiplier</th><th>opposition is",
    "drive, Hz</th><th>restitution of impacts</th><th>the pair is</th><th>its centre’s rate, ω</th><th>on r, ℓ",
    "followed from, Hz</th><th>beads in the bar</th><th>it breaks at, Hz"};

static const char *const before[FST_ASK_COUNT] = {
    ("<h3>Together or apart</h3><p>Two beads that roll against the magnet an angle D apart attract each "
     "other with the averaged potential −(χ/16 r³) cos D cos²(D/2)/sin³(D/2), which is greatest at cos D ="
     " (5 − √33)/2, D = 111.86 degrees: nearer beads should come together. The measured border lies lower "
     "and moves with the drive, since the beads settle nearer to each other than they start, and each is "
     "held on its orbit: what drifts is the phase between two orbits, not a free angle.</p>"),
    ("<h3>Opposition</h3><p>Beads that stay apart end opposite each other. A disturbance of the angle then"
     " dies away within hundreds of turns, or grows; it changes from one to the other at the drives of the"
     " figure.</p>"),
    ("<h3>Walkers</h3><p>Beads that come together touch for good, and their axis turns with the magnet. "
     "Impacts decide whether their centre circles against the magnet, a walker, or rests on the axis, a "
     "bar.</p>"),
    ("<h3>Bars</h3><p>Bars are arches, from three beads on: the ends alone touch the plate. A bar breaks "
     "where the force between two of its beads falls to zero.</p>")};

static void write_row(FILE *out, const fst_beads_case *of, const fst_beads_answer *answer)
{
    const char *outcome = fst_beads_outcome_name(answer->outcome);
    fprintf(out, "<tr><td class=\"n\">%g</td>", of->hertz);
    switch (of->question) {
    case FST_ASK_BORDER:
        fprintf(out, "<td class=\"n\">%g</td><td>%s</td></tr>\n", of->given, outcome);
        return;
    case FST_ASK_OPPOSITE:
        fprintf(out, "<td class=\"n\">%.7f</td><td>%s</td></tr>\n", answer->value,
                answer->value > 1.0 ? "unstable" : "stable");
        return;
    case FST_ASK_WALKER:
        fprintf(out, "<td class=\"n\">%g</td><td>%s</td>", of->given, outcome);
        fprintf(out,
                isfinite(answer->value) ? "<td class=\"n\">%.4f</td><td class=\"n\">%.3f</td></tr>\n"
                                        : "<td>on the axis</td><td></td></tr>\n",
                answer->value, answer->r);
        return;
    default:
        fprintf(out, "<td class=\"n\">%g</td><td class=\"n\">%.2f</td></tr>\n", of->given, answer->value);
    }
}

/* The command of a case, from its settings. */
static void write_command(FILE *out, const fst_beads_case *of)
{
    static const char *const verbs[FST_ASK_COUNT] = {"run", "orbit", "run",
                                                     "branch --kind locked --over drive.frequency=30:300"};
    char text[512], command[1024];
    fst_beads_settings(of, text, sizeof text);
    int used = snprintf(command, sizeof command, "festoon %s --set '", verbs[of->question]);
    for (const char *c = text; *c && used < (int)sizeof command - 16; ++c)
        used += snprintf(command + used, sizeof command - (size_t)used, *c == ' ' ? "' --set '" : "%c", *c);
    (void)snprintf(command + used, sizeof command - (size_t)used, "'");
    fst_report_code(out, command);
}

static void write_question(FILE *out, const fst_paper_beads *beads, fst_beads_question question)
{
    const fst_beads_case *last = NULL;
    for (int i = 0; i < FST_BEADS_CASES; ++i) {
        if (fst_beads_cases[i].question != question || !beads->answers[i].done)
            continue;
        if (!last) {
            fputs(before[question], out);
            fprintf(out, "<table class=\"narrow\"><thead><tr><th>%s</th></tr></thead><tbody>\n",
                    heads[question]);
        }
        last = &fst_beads_cases[i];
        write_row(out, last, &beads->answers[i]);
    }
    if (!last)
        return;
    fputs("</tbody></table>\n", out);
    write_command(out, last);
}

void fst_report_beads(FILE *out, const fst_paper_state *paper)
{
    if (!paper->beads || !paper->done[FST_PAPER_STEP_BEADS])
        return;
    fputs("<h2 id=\"beads\">Several beads</h2>\n<p>The paper's last paragraph asks what several beads do. They "
          "attract "
          "each other as dipoles, touch, rub and collide; here two and three of them, with impacts without "
          "restitution "
          "where nothing else is said.</p>\n",
          out);
    for (int question = 0; question < FST_ASK_COUNT; ++question)
        write_question(out, paper->beads, (fst_beads_question)question);
    fputs("<p class=\"fine\">Longer computations, among them the border at four drives, and what would decide "
          "it in a "
          "laboratory: docs/beads.md.</p>\n",
          out);
}
