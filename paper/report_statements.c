/* report_statements.c - the claims of the paper, in groups, each on a card of its own. */
#include "paper/dry.h"
#include "paper/report_parts.h"

#include <ctype.h>
#include <stdlib.h>
#include <string.h>

/* ------------------------------------------------------------------ notes */

enum { COLUMNS = 3 };
static const char *const column_names[COLUMNS] = {"farago2020", "rigid", "coulomb"};

/* The next word of a note, or of nothing. */
static size_t word(const char **at)
{
    *at += strspn(*at, " ");
    return strcspn(*at, " ");
}

static int is_number(const char *text, size_t size)
{
    for (size_t i = 0; i < size; ++i)
        if (isdigit((unsigned char)text[i]))
            return 1;
    return size >= 3 && (strncmp(text, "nan", 3) == 0 || strncmp(text, "inf", 3) == 0);
}

/* The size of a word without the marks that end it. */
static size_t bare(const char *text, size_t size)
{
    while (size > 0 && strchr(",;:.)", text[size - 1]))
        --size;
    return size;
}

/* Whether two notes differ in their numbers alone. */
static int differ_in_numbers(const char *one, const char *other)
{
    while (*one || *other) {
        const size_t size = word(&one), length = word(&other);
        const int same = size == length && strncmp(one, other, size) == 0;
        if (!same && !(is_number(one, size) && is_number(other, length)))
            return 0;
        one += size;
        other += length;
    }
    return 1;
}

/* One sentence for all columns: numbers in which they differ stand beside each other, "12 | 16 | 34". */
static void write_together(FILE *out, const char *const notes[COLUMNS])
{
    const char *at[COLUMNS] = {notes[0], notes[1], notes[2]};
    for (int first = 1; *at[0]; first = 0) {
        char piece[256] = "";
        size_t size[COLUMNS] = {0}, used = 0;
        int same = 1;
        for (int i = 0; i < COLUMNS && at[i]; ++i) {
            size[i] = word(&at[i]);
            same = same && size[i] == size[0] && strncmp(at[i], at[0], size[0]) == 0;
        }
        for (int i = 0; i < COLUMNS && at[i] && (i == 0 || !same) && used < sizeof piece; ++i)
            used += (size_t)snprintf(piece + used, sizeof piece - used, "%s%.*s", i > 0 ? " | " : "",
                                     (int)bare(at[i], size[i]), at[i]);
        const size_t end = bare(at[0], size[0]);
        if (used < sizeof piece)
            (void)snprintf(piece + used, sizeof piece - used, "%.*s", (int)(size[0] - end), at[0] + end);
        if (size[0] > 0)
            fputs(first ? "" : " ", out);
        fst_report_prose(out, piece);
        for (int i = 0; i < COLUMNS && at[i]; ++i)
            at[i] += size[i];
    }
}

/* What the columns have to say beside their numbers, nothing twice. */
static void write_notes(FILE *out, const fst_finding *finding)
{
    const char *notes[COLUMNS] = {finding->note[fst_paper_order[0]], finding->note[fst_paper_order[1]],
                                  finding->dry ? finding->dry_note : NULL};
    int together = 1;
    for (int i = 1; i < COLUMNS && notes[i]; ++i)
        together = together && differ_in_numbers(notes[0], notes[i]);
    if (together && notes[0][0] == '\0')
        return;
    if (together) {
        fputs("<p class=\"fine note\">", out);
        write_together(out, notes);
        fputs(".</p>", out);
        return;
    }
    for (int i = 0; i < COLUMNS && notes[i]; ++i) {
        int said = notes[i][0] == '\0';
        for (int j = 0; j < i; ++j)
            said = said || strcmp(notes[i], notes[j]) == 0;
        if (said)
            continue;
        fputs("<p class=\"fine note\">", out);
        for (int j = i; j < COLUMNS && notes[j]; ++j)
            if (j == i || strcmp(notes[i], notes[j]) == 0)
                fprintf(out, "%s%s", j > i ? ", " : "", column_names[j]);
        fputs(": ", out);
        fst_report_prose(out, notes[i]);
        fputs(".</p>", out);
    }
}

/* ------------------------------------------------------------------ numbers */

static void write_row(FILE *out, const char *name, const fst_statement *statement, double value,
                      fst_verdict verdict, int undecided)
{
    char text[64];
    double border;
    fst_statement_value(statement, value, text, sizeof text);
    fprintf(out, "<tr><td>%s</td><td class=\"n\">", name);
    fst_report_text(out, text);
    if (fst_statement_margin(statement, value, &border) < FST_HAIR)
        fprintf(out, " <small class=\"hair\">by a hair: %.4g, and %.4g decides</small>", value, border);
    fputs("</td><td>", out);
    if (undecided)
        fputs("<span class=\"badge\">undecided</span>", out);
    else
        fst_report_badge(out, verdict);
    fputs("</td></tr>\n", out);
}

static void write_values(FILE *out, const fst_statement *statement, const fst_finding *finding, int still)
{
    char name[48];
    for (int i = 0; i < (still ? 1 : FST_PAPER_DYNAMICS); ++i)
        write_row(out, still ? "computed" : fst_dynamics_name(fst_paper_order[i]), statement,
                  finding->value[fst_paper_order[i]], finding->verdict[fst_paper_order[i]],
                  finding->undecided[fst_paper_order[i]]);
    (void)snprintf(name, sizeof name, "coulomb, μ = %g", FST_DRY_MU);
    if (finding->dry)
        write_row(out, name, statement, finding->dry_value, finding->dry_verdict, finding->dry_undecided);
}

static void write_line(FILE *out, const char *title, const char *text)
{
    fprintf(out, "<tr><td>%s</td><td colspan=\"2\">", title);
    fst_report_prose(out, text);
    fputs("</td></tr>\n", out);
}

/* The rule; where it is made of the printed number, with its borders. */
static void write_criterion(FILE *out, const fst_statement *statement)
{
    char text[320];
    fst_statement_criterion(statement, text, sizeof text);
    fprintf(out, "<p class=\"fine rule\">Rule: <a href=\"#rules\">%s</a>", fst_rules[statement->rule].name);
    const char *borders = strstr(text, "; ");
    if (borders && (statement->rule == FST_RULE_NUMBER || statement->rule == FST_RULE_AT_MOST))
        fst_report_text(out, borders);
    fputs("</p>", out);
}

static void write_second(FILE *out, const fst_statement *statement, const fst_paper_state *paper)
{
    const fst_reading *reading = fst_statement_reading(statement);
    if (!reading)
        return;
    const fst_finding finding = fst_reading_check(reading, statement, paper);
    char text[64];
    fputs("<details class=\"second\"><summary>Read otherwise: ", out);
    fst_report_prose(out, reading->words);
    fputs("</summary><table><tbody>", out);
    fst_statement_published(&reading->second, text, sizeof text);
    if (reading->second.said == NULL)
        write_line(out, "published", text);
    write_values(out, &reading->second, &finding, statement->still);
    fputs("</tbody></table>", out);
    write_notes(out, &finding);
    write_criterion(out, &reading->second);
    fputs("<p class=\"fine\">Counted is the first: ", out);
    fst_report_prose(out, reading->first);
    fputs(". ", out);
    fst_report_prose(out, reading->chosen);
    fputs("</p></details>", out);
}

static void write_card(FILE *out, const fst_statement *statement, const fst_paper_state *paper)
{
    const fst_finding finding = fst_statement_check(statement, paper);
    char text[320], command[320], repeat[448];
    fprintf(out, "<section class=\"card\" id=\"%s\"><p class=\"from\">", statement->id);
    fst_report_text(out, statement->section);
    fputs(statement->check ? " · not counted</p><p>" : "</p><p>", out);
    fst_report_prose(out, statement->text);
    fputs("</p><table><tbody>", out);
    fst_statement_published(statement, text, sizeof text);
    write_line(out, "published", text);
    write_values(out, statement, &finding, statement->still);
    fputs("</tbody></table>", out);
    write_notes(out, &finding);
    write_second(out, statement, paper);
    fputs("<details><summary>rule and command</summary>", out);
    write_criterion(out, statement);
    fst_statement_command(statement, paper, FST_DYNAMICS_FARAGO2020, command, sizeof command);
    (void)snprintf(repeat, sizeof repeat, "%s   # %s", command,
                   fst_statement_reads(statement, FST_DYNAMICS_FARAGO2020));
    fst_report_code(out, repeat);
    fputs("</details></section>\n", out);
}

/* ------------------------------------------------------------------ the chapter */

/* The rules come before the statements that they judge. */
static void write_rules(FILE *out)
{
    fputs("<h2 id=\"rules\">The rules</h2>\n<p>One set of rules holds for all claims. Which rule holds for a "
          "claim depends on how the paper prints it. What is measured for it was chosen by us, for some "
          "claims after numbers were known: these say so.</p>\n<dl class=\"rules\">\n",
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
    fputs("</dl>\n<p>A verdict whose value lies within a tenth of the allowed distance from a border hangs "
          "by a hair; value and border stand beside it.</p>\n",
          out);
}

fst_status fst_report_statements(FILE *out, const fst_paper_state *paper, fst_error *error)
{
    fst_status status = FST_OK;
    write_rules(out);
    fputs("<h2 id=\"statements\">The paper's claims</h2>\n<p>In notes, numbers parted by strokes are those "
          "of the columns, in their order.</p>\n",
          out);
    for (int group = 0; group < FST_GROUP_COUNT; ++group) {
        fprintf(out, "<h3 class=\"group\" id=\"group-%d\">", group + 1);
        fst_report_text(out, fst_groups_of_statements[group].title);
        fputs("</h3>\n<p>", out);
        fst_report_text(out, fst_groups_of_statements[group].about);
        fputs("</p>\n<div class=\"cards\">\n", out);
        for (int i = 0; i < fst_statement_count() && status == FST_OK; ++i) {
            const fst_statement *statement = fst_statement_at(i);
            if (statement->group != (fst_group)group || !fst_statement_known(statement, paper))
                continue;
            write_card(out, statement, paper);
            status = fst_report_figures(out, paper, statement->id, error);
        }
        fputs("</div>\n", out);
    }
    return status;
}
