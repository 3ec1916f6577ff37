/* verdicts.c - one set of rules for all statements.  A rule depends on how the paper prints a number, and never
 * on what was computed. */
#include "paper/dry.h"
#include "paper/runs.h"
#include "paper/statements.h"

#include <stdio.h>

/* A printed number (NUMBER, AT_MOST) has a unit of its last digit for its scale; it is never close when it is
 * off by more than this share of it. */
static const double FARTHEST = 0.2;

const fst_rule_words fst_rules[FST_RULE_COUNT] = {
#define RULE(name, held, near, far, has_borders, ...) {__VA_ARGS__, FST_HELD_##held, {near, far}, has_borders},
#include "paper/rules.def"
#undef RULE
};

const char *fst_verdict_name(fst_verdict verdict)
{
    static const char *const names[] = {[FST_VERDICT_REPRODUCED] = "reproduced",
                                        [FST_VERDICT_CLOSE] = "close",
                                        [FST_VERDICT_NOT] = "not reproduced"};
    return names[verdict];
}

/* The room for `verdict`, reproduced or close. */
static double room(const fst_statement *statement, fst_verdict verdict)
{
    const fst_rule_words *rule = &fst_rules[statement->rule];
    const double near = rule->room[FST_VERDICT_REPRODUCED] * statement->scale;
    if (rule->held == FST_HELD_ORDERS)
        return rule->room[verdict];
    if (statement->rule != FST_RULE_NUMBER && statement->rule != FST_RULE_AT_MOST)
        return rule->room[verdict] * statement->scale;
    return verdict == FST_VERDICT_REPRODUCED ? near
                                             : fmax(near, fmin(rule->room[verdict] * statement->scale,
                                                               FARTHEST * fabs(statement->published)));
}

/* Whether the value earns `verdict` (reproduced or close).  NAN never does. */
static int passes(const fst_statement *statement, double value, fst_verdict verdict)
{
    const double p = statement->published, allowed = room(statement, verdict);
    switch (fst_rules[statement->rule].held) {
    case FST_HELD_WITHIN:
        return fabs(value - p) <= allowed;
    case FST_HELD_UP_TO:
        return value <= p + allowed;
    case FST_HELD_AT_LEAST:
        return value >= allowed;
    case FST_HELD_ORDERS:
        return fabs(log10(value / p)) <= allowed;
    case FST_HELD_EQUAL:
        break;
    }
    return value == p;
}

double fst_statement_margin(const fst_statement *statement, double value, double *border)
{
    const fst_held by = fst_rules[statement->rule].held;
    const double p = statement->published;
    double least = NAN;
    *border = NAN;
    for (int i = 0; i < 4 && fst_rules[statement->rule].has_borders; ++i) { /* two verdicts, both sides */
        const double allowed = room(statement, i / 2 ? FST_VERDICT_CLOSE : FST_VERDICT_REPRODUCED);
        const int above = by == FST_HELD_UP_TO || i % 2;
        const double at = by == FST_HELD_AT_LEAST ? allowed
                          : by == FST_HELD_ORDERS ? (above ? p / pow(10.0, -allowed) : p * pow(10.0, -allowed))
                                                  : (above ? p + allowed : p - allowed);
        const double margin = fabs(by == FST_HELD_ORDERS ? log10(value / at) : value - at) / allowed;
        if (isfinite(margin) && !(margin >= least)) {
            least = margin;
            *border = at;
        }
    }
    return least;
}

fst_verdict fst_statement_verdict(const fst_statement *statement, double value)
{
    return passes(statement, value, FST_VERDICT_REPRODUCED) ? FST_VERDICT_REPRODUCED
           : passes(statement, value, FST_VERDICT_CLOSE)    ? FST_VERDICT_CLOSE
                                                            : FST_VERDICT_NOT;
}

/* The last run of the scan whose motion had not settled. */
static const fst_paper_run *last_unsettled(const fst_paper_state *paper, fst_scan scan, fst_dynamics dynamics)
{
    int i = paper->counts[scan] - 1;
    while (i > 0 && !(paper->scans[scan][dynamics][i].done &&
                      fst_paper_may_settle(&paper->scans[scan][dynamics][i].result)))
        --i;
    return &paper->scans[scan][dynamics][i];
}

/* Measure the statement.  One about a single motion that has not settled has no value; where a value is missing
 * and runs have not settled, the note says that it is undecided. */
static double measured(const fst_statement *statement, const fst_measuring *m, int *undecided,
                       fst_verdict *verdict)
{
    double value = statement->measure(m);
    const int unsettled = fst_paper_unsettled(m->paper, statement->scan, m->dynamics);
    const int all = statement->scan == FST_SCAN_NONE ? 0 : m->paper->counts[statement->scan];
    if (unsettled > 0 && (all <= 1 || isnan(value))) {
        *undecided = 1;
        value = NAN;
        const fst_run_result *last = &last_unsettled(m->paper, statement->scan, m->dynamics)->result;
        (void)snprintf(
            m->note, m->size,
            "undecided: %d of %d runs had not settled when they ended; the last of them, at %.2f Hz: %.120s",
            unsettled, all, last->frequency_hz, last->reason);
    }
    *verdict = fst_statement_verdict(statement, value);
    return value;
}

static fst_finding check(const fst_statement *statement, int rubs, const fst_paper_state *paper)
{
    fst_finding finding = {.note = {"", ""}, .dry_value = NAN, .dry_verdict = FST_VERDICT_NOT};
    for (int d = 0; d < FST_PAPER_DYNAMICS; ++d) {
        const fst_measuring m = {paper, (fst_dynamics)d, finding.note[d], sizeof finding.note[d]};
        finding.value[d] = measured(statement, &m, &finding.undecided[d], &finding.verdict[d]);
    }
    finding.dry = rubs && paper->dry && paper->done[FST_PAPER_STEP_DRY];
    if (finding.dry) {
        const fst_measuring m = {&paper->dry->column, FST_DYNAMICS_RIGID, finding.dry_note,
                                 sizeof finding.dry_note};
        finding.dry_value = measured(statement, &m, &finding.dry_undecided, &finding.dry_verdict);
    }
    return finding;
}

fst_finding fst_statement_check(const fst_statement *statement, const fst_paper_state *paper)
{
    return check(statement, statement->rubs, paper);
}

fst_finding fst_reading_check(const fst_reading *reading, const fst_statement *statement,
                              const fst_paper_state *paper)
{
    fst_statement second = reading->second;
    second.scan = statement->scan;
    return check(&second, statement->rubs, paper);
}

/* The interval "40.5 to 41.5 mm" for a number, otherwise the words of the rule. */
void fst_statement_criterion(const fst_statement *statement, char *text, size_t size)
{
    const fst_rule_words *words = &fst_rules[statement->rule];
    double p = statement->published, half = room(statement, FST_VERDICT_REPRODUCED);
    double ten = room(statement, FST_VERDICT_CLOSE);
    const char *blank = statement->unit[0] ? " " : "";
    if (statement->rule == FST_RULE_NUMBER)
        (void)snprintf(text, size, "number; reproduced: %g to %g%s%s; close: %g to %g%s%s", p - half, p + half,
                       blank, statement->unit, p - ten, p + ten, blank, statement->unit);
    else if (statement->rule == FST_RULE_AT_MOST)
        (void)snprintf(text, size, "limit; reproduced: at most %g%s%s; close: at most %g%s%s", p + half, blank,
                       statement->unit, p + ten, blank, statement->unit);
    else
        (void)snprintf(text, size, "%s; reproduced: %s%s%s", words->name, words->reproduced,
                       words->close[0] ? "; close: " : "", words->close);
}

/* Only what is printed: the words, or the number with as many digits as it needs. */
void fst_statement_published(const fst_statement *statement, char *text, size_t size)
{
    if (statement->said)
        (void)snprintf(text, size, "%s", statement->said);
    else if (statement->rule == FST_RULE_SYMMETRY || !isfinite(statement->published))
        fst_statement_value(statement, statement->published, text, size);
    else
        (void)snprintf(text, size, "%.10g%s%s", statement->published, statement->unit[0] ? " " : "",
                       statement->unit);
}

void fst_statement_value(const fst_statement *statement, double value, char *text, size_t size)
{
    const char *blank = statement->unit[0] ? " " : "";
    if (!isfinite(value))
        (void)snprintf(text, size, "none");
    else if (statement->rule == FST_RULE_SYMMETRY)
        (void)snprintf(text, size, "S%.0f", value);
    else if (statement->digits < 0)
        (void)snprintf(text, size, fabs(value) >= 1e-2 && fabs(value) < 1e3 ? "%.2g%s%s" : "%.1e%s%s", value,
                       blank, statement->unit);
    else
        (void)snprintf(text, size, "%.*f%s%s", statement->digits, value, blank, statement->unit);
}
