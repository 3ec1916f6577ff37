/* verdicts.c - one set of rules for all statements.  A rule depends on how the paper prints a number, and never
 * on what was computed. */
#include "paper/dry.h"
#include "paper/runs.h"
#include "paper/statements.h"

#include <stdio.h>

/* Within these shares of its natural scale a claim in words is met, or nearly met. */
static const double SMALL[2] = {0.1, 0.3}, NOTABLE[2] = {0.1, 0.03}, MOST[2] = {0.5, 0.25},
                    EXACT[2] = {1e-6, 1e-3};
/* A printed number: half a unit of its last digit; close is ten units, but never more than a fifth of the
 * number. */
static const double UNITS[2] = {0.5, 10.0}, FARTHEST = 0.2;
/* An order of magnitude: distances in decimal logarithms. */
static const double ORDERS[2] = {0.5, 1.0};

const fst_rule_words fst_rules[FST_RULE_COUNT] = {
    [FST_RULE_NUMBER] = {"number", "a printed number", "the value rounds to it",
                         "within ten units of its last digit, and within 20 %"},
    [FST_RULE_AT_MOST] = {"limit", "a printed limit", "the value, rounded likewise, does not exceed it",
                          "by no more than ten units of its last digit, and 20 %"},
    [FST_RULE_MAGNITUDE] = {"magnitude", "an order of magnitude", "within half an order (a factor of 3.2)",
                            "within one order"},
    [FST_RULE_SMALL] =
        {"small",
         "“almost”, “negligible”, “small”, “rare”, “convincing”, “locks to”, “sudden”, “about” without a "
         "number",
         "off by at most 10 % of the natural scale", "by at most 30 %"},
    [FST_RULE_NOTABLE] =
        {"notable",
         "“not negligible”, “not zero”, “not correct”, “a part”, “quite a lot”, “substantial”, “high”, "
         "“shrinks”, “weakens”, “shortcuts”, “an approximation”",
         "at least 10 % of the natural scale", "at least 3 %"},
    [FST_RULE_MOSTLY] = {"mostly", "“mainly”, “localized”, “tightly correlated”, “similar”, “in general”",
                         "at least 50 %", "at least 25 %"},
    [FST_RULE_EXACT] = {"law", "a law, an equation, a proportionality, a symmetry",
                        "met within 1e-6 of the natural scale", "within 1e-3"},
    [FST_RULE_NEVER] = {"never", "what one exception breaks: “never”, “positive”, a sense, a shape",
                        "no exception was met", ""},
    [FST_RULE_SEVERAL] = {"several", "“one or another”", "there are two or more", ""},
    [FST_RULE_SYMMETRY] = {"symmetry", "the symmetry of a closed path", "closed, with this symmetry", ""},
};

const char *fst_verdict_name(fst_verdict verdict)
{
    static const char *const names[] = {[FST_VERDICT_REPRODUCED] = "reproduced",
                                        [FST_VERDICT_CLOSE] = "close",
                                        [FST_VERDICT_NOT] = "not reproduced"};
    return names[verdict];
}

/* The distance allowed for `verdict`: half a unit of the last digit for reproduced, ten units for close. */
static double room(const fst_statement *statement, fst_verdict verdict)
{
    double half = UNITS[FST_VERDICT_REPRODUCED] * statement->scale, ten = UNITS[verdict] * statement->scale;
    return verdict == FST_VERDICT_REPRODUCED ? half
                                             : fmax(half, fmin(ten, FARTHEST * fabs(statement->published)));
}

/* Whether the value earns `verdict` (reproduced or close).  NAN never does. */
static int passes(const fst_statement *statement, double value, fst_verdict verdict)
{
    double scale = statement->scale, distance = fabs(value - statement->published);
    switch (statement->rule) {
    case FST_RULE_NUMBER:
        return distance <= room(statement, verdict);
    case FST_RULE_AT_MOST:
        return value <= statement->published + room(statement, verdict);
    case FST_RULE_MAGNITUDE:
        return fabs(log10(value / statement->published)) <= ORDERS[verdict];
    case FST_RULE_SMALL:
        return distance <= SMALL[verdict] * scale;
    case FST_RULE_NOTABLE:
        return value >= NOTABLE[verdict] * scale;
    case FST_RULE_MOSTLY:
        return value >= MOST[verdict] * scale;
    case FST_RULE_EXACT:
        return distance <= EXACT[verdict] * scale;
    case FST_RULE_SEVERAL:
        return value >= 2.0;
    case FST_RULE_NEVER:
    case FST_RULE_SYMMETRY:
        return value == statement->published;
    case FST_RULE_COUNT:
        break;
    }
    return 0;
}

/* The borders of `verdict` in the value, or the only one twice, and the distance that they allow; 0: the rule
 * has no distances. */
static int borders_of(const fst_statement *statement, fst_verdict verdict, double border[2], double *allowed)
{
    const double p = statement->published, scale = statement->scale;
    switch (statement->rule) {
    case FST_RULE_NUMBER:
    case FST_RULE_SMALL:
        *allowed = statement->rule == FST_RULE_NUMBER ? room(statement, verdict) : SMALL[verdict] * scale;
        border[0] = p - *allowed;
        border[1] = p + *allowed;
        return 1;
    case FST_RULE_AT_MOST:
        *allowed = room(statement, verdict);
        border[0] = border[1] = p + *allowed;
        return 1;
    case FST_RULE_MAGNITUDE:
        border[0] = p * pow(10.0, -ORDERS[verdict]);
        border[1] = p / pow(10.0, -ORDERS[verdict]);
        *allowed = ORDERS[verdict];
        return 1;
    case FST_RULE_NOTABLE:
    case FST_RULE_MOSTLY:
        *allowed = border[0] = border[1] =
            (statement->rule == FST_RULE_NOTABLE ? NOTABLE[verdict] : MOST[verdict]) * scale;
        return 1;
    case FST_RULE_EXACT:
    case FST_RULE_NEVER:
    case FST_RULE_SEVERAL:
    case FST_RULE_SYMMETRY:
    case FST_RULE_COUNT:
        break;
    }
    return 0;
}

double fst_statement_margin(const fst_statement *statement, double value, double *border)
{
    double least = NAN, allowed, at[2];
    *border = NAN;
    for (fst_verdict verdict = FST_VERDICT_REPRODUCED; verdict <= FST_VERDICT_CLOSE; ++verdict) {
        if (!borders_of(statement, verdict, at, &allowed))
            return NAN;
        for (int side = 0; side < 2; ++side) {
            const double off =
                statement->rule == FST_RULE_MAGNITUDE ? log10(value / at[side]) : value - at[side];
            const double margin = fabs(off) / allowed;
            if (isfinite(margin) && !(margin >= least)) {
                least = margin;
                *border = at[side];
            }
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

/* A statement about one motion that has not settled has no value.  Where a value is missing and runs have not
 * settled, the note says that it is undecided. */
static double unless_unsettled(const fst_statement *statement, const fst_paper_state *paper,
                               fst_dynamics dynamics, double value, char *note, size_t size, int *undecided)
{
    const int unsettled = fst_paper_unsettled(paper, statement->scan, dynamics);
    if (unsettled == 0)
        return value;
    const int all = paper->counts[statement->scan];
    if (all > 1 && !isnan(value))
        return value;
    *undecided = 1;
    const fst_run_result *last = &last_unsettled(paper, statement->scan, dynamics)->result;
    (void)snprintf(
        note, size,
        "undecided: %d of %d runs had not settled when they ended; the last of them, at %.2f Hz: %.120s",
        unsettled, all, last->frequency_hz, last->reason);
    return NAN;
}

static fst_finding check(const fst_statement *statement, fst_measure dry_measure, const fst_paper_state *paper)
{
    fst_finding finding = {.note = {"", ""}, .dry_value = NAN, .dry_verdict = FST_VERDICT_NOT};
    for (int d = 0; d < FST_PAPER_DYNAMICS; ++d) {
        double value = statement->measure(paper, (fst_dynamics)d, finding.note[d], sizeof finding.note[d]);
        value = unless_unsettled(statement, paper, (fst_dynamics)d, value, finding.note[d],
                                 sizeof finding.note[d], &finding.undecided[d]);
        finding.value[d] = value;
        finding.verdict[d] = fst_statement_verdict(statement, value);
    }
    finding.dry = dry_measure && paper->dry && paper->done[FST_PAPER_STEP_DRY];
    if (finding.dry) {
        const fst_paper_state *column = &paper->dry->column;
        double value = dry_measure(column, FST_DYNAMICS_RIGID, finding.dry_note, sizeof finding.dry_note);
        finding.dry_value = unless_unsettled(statement, column, FST_DYNAMICS_RIGID, value, finding.dry_note,
                                             sizeof finding.dry_note, &finding.dry_undecided);
        finding.dry_verdict = fst_statement_verdict(statement, finding.dry_value);
    }
    return finding;
}

fst_finding fst_statement_check(const fst_statement *statement, const fst_paper_state *paper)
{
    return check(statement, fst_statement_dry(statement), paper);
}

fst_finding fst_reading_check(const fst_reading *reading, const fst_statement *statement,
                              const fst_paper_state *paper)
{
    fst_statement second = reading->second;
    second.scan = statement->scan;
    return check(&second, fst_statement_dry(&second), paper);
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
