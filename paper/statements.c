/* statements.c - the list of the paper's statements, each with the command that gives its number again;
 * verdicts.c judges them. */
#include "paper/dry.h"
#include "paper/measures.h"
#include "paper/runs.h"
#include "paper/statements.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* The flags of statements.def: whether it is a check, whether it stands still, and whether it rubs. */
#define MOVES 0, 0, 0
#define RUBS 0, 0, 1
#define STILL 0, 1, 0
#define CHECK 1, 0, 0
#define CHECK_RUBS 1, 0, 1
#define PARTS(group, rule, measure, scan, step)                                                                \
    FST_GROUP_##group, FST_RULE_##rule, fst_measure_##measure, FST_SCAN_##scan, FST_PAPER_STEP_##step

static const fst_statement statements[] = {
#define CLAIM(id, group, rule, measure, scan, step, ...)                                                       \
    {id, PARTS(group, rule, measure, scan, step), __VA_ARGS__},
#define READING(...)
#include "paper/statements.def"
#undef CLAIM
#undef READING
};

static const fst_reading readings[] = {
#define CLAIM(...)
#define READING(id, rule, measure, published, scale, unit, digits, said, ...)                                  \
    {{NULL, PARTS(READING, rule, measure, NONE, RUNS), published, scale, unit, digits, MOVES, NULL, said,      \
      NULL, NULL},                                                                                             \
     id,                                                                                                       \
     __VA_ARGS__},
#include "paper/statements.def"
#undef CLAIM
#undef READING
};

const fst_group_words fst_groups_of_statements[FST_GROUP_COUNT] = {
    [FST_GROUP_ERROR] = {"errors in the paper", "Errors in the paper",
                         "Equations and arguments that the model contradicts, whichever way they are read."},
    [FST_GROUP_EXPERIMENT] =
        {"model against experiment", "The model against the experiment",
         "What the paper reports of its experiment. Its measured points are not in its text, so that "
         "words and single numbers are compared."},
    [FST_GROUP_READING] =
        {"depends on the reading", "What depends on the reading",
         "Sentences with two readings. The badges are the first's, and only they are counted."},
    [FST_GROUP_ARITHMETIC] = {"arithmetic", "Arithmetic",
                              "Numbers that follow from others that the paper gives. No motion enters."},
    [FST_GROUP_MODEL] = {"model and theory", "The computed motion and the theory",
                         "What the paper computes and concludes, and checks of this computation."},
};

int fst_statement_count(void)
{
    return (int)(sizeof statements / sizeof statements[0]);
}

const fst_statement *fst_statement_at(int index)
{
    return &statements[index];
}

int fst_statement_known(const fst_statement *statement, const fst_paper_state *paper)
{
    return fst_paper_has(paper, statement->step, statement->scan);
}

const fst_statement *fst_statement_named(const char *id)
{
    for (int i = 0; i < fst_statement_count(); ++i)
        if (strcmp(statements[i].id, id) == 0)
            return &statements[i];
    return NULL;
}

const fst_reading *fst_statement_reading(const fst_statement *statement)
{
    for (size_t i = 0; i < sizeof readings / sizeof readings[0]; ++i)
        if (strcmp(readings[i].id, statement->id) == 0)
            return &readings[i];
    return NULL;
}

fst_tally fst_paper_tally(const fst_paper_state *paper, fst_group group)
{
    fst_tally tally = {0};
    for (int i = 0; i < fst_statement_count(); ++i) {
        const fst_statement *statement = &statements[i];
        if (statement->check || (group != FST_GROUP_COUNT && statement->group != group) ||
            !fst_statement_known(statement, paper))
            continue;
        const fst_finding finding = fst_statement_check(statement, paper);
        if (statement->still)
            ++tally.once[finding.verdict[FST_DYNAMICS_RIGID]];
        for (int d = 0; d < FST_PAPER_DYNAMICS && !statement->still; ++d) {
            ++tally.of[d][finding.verdict[d]];
            tally.undecided += finding.undecided[d];
        }
        ++*(statement->still ? &tally.still : &tally.moving);
    }
    return tally;
}

void fst_tally_add(fst_tally *all, const fst_tally *more)
{
    all->moving += more->moving;
    all->still += more->still;
    all->undecided += more->undecided;
    for (int v = 0; v < 3; ++v) {
        all->once[v] += more->once[v];
        for (int d = 0; d < FST_PAPER_DYNAMICS; ++d)
            all->of[d][v] += more->of[d][v];
    }
}

int fst_paper_dry_tally(const fst_paper_state *paper, int tally[3])
{
    int count = 0;
    for (int i = 0; i < fst_statement_count(); ++i) {
        if (statements[i].check || !fst_statement_known(&statements[i], paper))
            continue;
        fst_finding finding = fst_statement_check(&statements[i], paper);
        if (!finding.dry)
            continue;
        tally[finding.dry_verdict]++;
        ++count;
    }
    return count;
}

/* ------------------------------------------------------------------ how to have the number again */

void fst_statement_command(const fst_statement *statement, const fst_paper_state *paper, fst_dynamics dynamics,
                           char *command, size_t size)
{
    char run[320];
    if (!statement->reads) {
        (void)snprintf(command, size, "festoon paper --only %s%s", statement->id,
                       paper->options->reduced ? " --reduced" : "");
        return;
    }
    fst_paper_scan_command(paper, statement->scan, dynamics, run, sizeof run);
    (void)snprintf(command, size, "%s --json", run);
}

void fst_statement_dry_command(const fst_statement *statement, const fst_paper_state *paper, char *command,
                               size_t size)
{
    fst_statement_command(statement, &paper->dry->column, FST_DYNAMICS_RIGID, command, size);
}

const char *fst_statement_dry_reads(const fst_statement *statement)
{
    return statement->reads ? statement->reads : "coulomb";
}

const char *fst_statement_reads(const fst_statement *statement, fst_dynamics dynamics)
{
    return statement->reads ? statement->reads : fst_dynamics_name(dynamics);
}

/* ------------------------------------------------------------------ the list */

static void write_rules(FILE *out)
{
    (void)fputs("| rule | what the paper prints | reproduced | close |\n| --- | --- | --- | --- |\n", out);
    for (int rule = 0; rule < FST_RULE_COUNT; ++rule)
        (void)fprintf(out, "| %s | %s | %s | %s |\n", fst_rules[rule].name, fst_rules[rule].kind,
                      fst_rules[rule].reproduced, fst_rules[rule].close);
}

static void write_readings(FILE *out)
{
    (void)fputs(
        "\n| claim | counted | read otherwise | rule then | chosen |\n| --- | --- | --- | --- | --- |\n", out);
    for (int i = 0; i < fst_statement_count(); ++i) {
        const fst_reading *reading = fst_statement_reading(&statements[i]);
        if (reading)
            (void)fprintf(out, "| %s | %s | %s | %s | %s |\n", statements[i].id, reading->first, reading->words,
                          fst_rules[reading->second.rule].name, reading->chosen);
    }
}

char *fst_paper_statements_text(void)
{
    fst_printed printed;
    FILE *out = fst_print_begin(&printed);
    if (!out)
        return NULL;
    write_rules(out);
    (void)fputs("\n| section | statement | published | rule |\n| --- | --- | --- | --- |\n", out);
    for (int i = 0; i < fst_statement_count(); ++i) {
        const fst_statement *statement = &statements[i];
        char published[64];
        fst_statement_published(statement, published, sizeof published);
        (void)fprintf(out, "| %s | %s | %s | %s |\n", statement->section, statement->text, published,
                      fst_rules[statement->rule].name);
    }
    write_readings(out);
    return fst_print_end(&printed);
}
