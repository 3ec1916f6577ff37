/* magnets_facts.c - what the paper tells of the field and of its experiment, read off the runs on real magnets.
 */
#include "paper/magnets.h"
#include "paper/runs.h"

#include <math.h>
#include <stdlib.h>

enum { APART, REMANENCE, SPREAD, HALVING, BELL = FST_MAGNET_FACTS - 1 };

/* What the field decides, and the halving of the period; then what is read off as in the chapter on dry
 * friction. */
#define FACT(name, section_, words, value, scale_, unit_, digits_, rule_)                                      \
    {                                                                                                          \
        .id = name, .section = section_, .text = words, .published = value, .scale = scale_, .unit = unit_,    \
        .digits = digits_, .rule = FST_RULE_##rule_                                                            \
    }
#define SEEN "III (experiments)"
static const fst_statement facts[FST_MAGNET_FACTS] = {
    FACT("magnet-maxima", "IV (modelling)",
         "Distance of the two maxima of the field, at the height of the bead's centre", 41.0, 1.0, "mm", 1,
         NUMBER),
    FACT("magnet-remanence", "IV B (numerical simulations)",
         "Remanence with which κ = 1.5 and a bead of 1.2 T give this greatest field", NAN, 1.0, "T", 3, NUMBER),
    FACT("magnet-spread", "V A (4-fold counter-rotation)",
         "Spread of the field's strength along the path, 10.7 Hz (the paper's simulation)", 13.0, 1.0, "%", 1,
         AT_MOST),
    FACT("magnet-halving", "V C (order of the patterns)",
         "The period halves at about (halfway between two runs)", 14.4, 1.0, "Hz", 1, NUMBER),
    FACT("corotation", SEEN, "From rest, goes round with the magnet up to about", 7.0, 1.0, "Hz", 2, NUMBER),
    FACT("ejection", SEEN, "Leaves the plate, 7 to 10 Hz (share of the runs)", NAN, 100.0, "%", 0, MOSTLY),
    FACT("onset", SEEN, "Circles against the magnet in all runs from about", 10.0, 1.0, "Hz", 1, NUMBER),
    FACT("four", SEEN, "Festoons, 10.7 Hz", 4.0, 1.0, "", 2, NUMBER),
    FACT("many", SEEN, "Festoons, 19.9 Hz (15: the paper's simulation)", 15.0, 1.0, "", 2, NUMBER),
    FACT("bell", SEEN, "Circles most slowly at", 16.0, 1.0, "Hz", 1, NUMBER),
};

/* Of these, which fact of that chapter each is. */
static const fst_dry_fact_id of_motion[FST_MAGNET_FACTS - FST_MAGNET_FIELD_FACTS] = {
    FST_FACT_COROTATION, FST_FACT_EJECTION, FST_FACT_ONSET, FST_FACT_FOUR, FST_FACT_MANY, FST_FACT_BELL};

const fst_statement *fst_magnet_fact_about(int fact)
{
    return &facts[fact];
}

const char *fst_magnet_law_name(int law)
{
    return law ? "dry" : "viscous";
}

/* The rolling run at this drive; NULL: it was not made, or has not settled. */
static const fst_run_result *settled_at(const fst_paper_run *runs, double hertz)
{
    for (int i = 0; i < FST_MAGNET_ROLLING; ++i)
        if (runs[i].done && runs[i].params.drive_frequency == hertz && fst_paper_counter_rotates(&runs[i]))
            return &runs[i].result;
    return NULL;
}

/* Halfway between the fastest drive with S1 and the next one, whose pattern has S2 or is still on its way
 * there. */
static double halving_of(const fst_paper_run *runs)
{
    double above = NAN;
    for (int i = FST_MAGNET_ROLLING - 1; i >= 0; --i) { /* the drives rise */
        if (!runs[i].done || !fst_paper_counter_rotates(&runs[i]))
            continue;
        if (runs[i].result.symmetry == FST_SYMMETRY_S1)
            return 0.5 * (above + runs[i].params.drive_frequency); /* NAN where even the fastest is S1 */
        above = runs[i].params.drive_frequency;
    }
    return NAN;
}

static double spread_of(const fst_run_result *result)
{
    return result ? 100.0 * result->std_b / result->mean_b : NAN;
}

/* The slowest drive; NAN where it is the first or the last one, beyond which a slower one may lie. */
static double bell_of(const fst_paper_run *runs)
{
    const double slowest = fst_dry_fact_of(runs, FST_MAGNET_RUNS, FST_FACT_BELL);
    return slowest > 10.0 && slowest < fst_magnet_drive(FST_MAGNET_ROLLING - 1) ? slowest : NAN;
}

double fst_magnet_fact(const fst_paper_state *paper, int fact, int magnet, int law)
{
    const fst_magnet_column *column = &paper->magnets->of[magnet];
    const fst_paper_run *runs = column->runs[law];
    switch (fact) {
    case APART:
        return column->apart;
    case REMANENCE:
        return column->remanence;
    case SPREAD:
        return spread_of(settled_at(runs, 10.7));
    case HALVING:
        return halving_of(runs);
    case BELL:
        return bell_of(runs);
    default:
        return fst_dry_fact_of(runs, FST_MAGNET_RUNS, (int)of_motion[fact - FST_MAGNET_FIELD_FACTS]);
    }
}
