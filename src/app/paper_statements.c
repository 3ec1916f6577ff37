/* paper_statements.c - what the paper says in words, held against the runs; paper_verdicts.c judges it. */
#include "app/measures.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>

#define HALVING_COMMAND                                                                                        \
    "festoon branch --kind counter --set model.dynamics=farago2020 --over drive.omega=0.19:4"
#define PROBE_COMMAND "festoon paper -o DIR"
#define REMANENCE_COMMAND                                                                                      \
    "festoon run --set bead.material=mixed --set bead.a=0.001 --set model.kappa=KAPPA --set drive.omega=0.3 "  \
    "--set run.periods=600"

static const fst_statement statements[] = {
#define STATEMENT(id, section, text, said, published, scale, unit, digits, rule, measure, scan, step, command) \
    {id,                                                                                                       \
     section,                                                                                                  \
     text,                                                                                                     \
     said,                                                                                                     \
     published,                                                                                                \
     scale,                                                                                                    \
     unit,                                                                                                     \
     digits,                                                                                                   \
     FST_RULE_##rule,                                                                                          \
     fst_measure_##measure,                                                                                    \
     FST_SCAN_##scan,                                                                                          \
     FST_STEP_##step,                                                                                          \
     command},
#include "app/paper_statements.def"
#undef STATEMENT
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

/* ------------------------------------------------------------------ the list */

static void write_rules(FILE *out)
{
    (void)fputs("| rule | what the paper prints | reproduced | close |\n| --- | --- | --- | --- |\n", out);
    for (int rule = 0; rule < FST_RULE_COUNT; rule++)
        (void)fprintf(out, "| %s | %s | %s | %s |\n", fst_rules[rule].name, fst_rules[rule].kind,
                      fst_rules[rule].reproduced, fst_rules[rule].close);
}

char *fst_paper_statements_text(void)
{
    char *text = NULL;
    size_t size = 0;
    FILE *out = open_memstream(&text, &size);
    if (!out)
        return NULL;
    write_rules(out);
    (void)fputs("\n| section | statement | published | rule |\n| --- | --- | --- | --- |\n", out);
    for (int i = 0; i < fst_statement_count(); i++) {
        const fst_statement *statement = &statements[i];
        char published[64];
        fst_statement_value(statement, statement->published, published, sizeof published);
        (void)fprintf(out, "| %s | %s | %s | %s |\n", statement->section, statement->text,
                      statement->said ? statement->said : published, fst_rules[statement->rule].name);
    }
    if (fclose(out) != 0) {
        free(text);
        return NULL;
    }
    return text;
}
