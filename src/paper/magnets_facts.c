/* magnets_facts.c - what the paper tells of the field and of its experiment, read off the runs on real magnets.
 */
#include "paper/magnets.h"
#include "paper/runs.h"

#include <math.h>
#include <stdlib.h>

enum { APART, REMANENCE, SPREAD, HALVING, BELL = FST_MAGNET_FACTS - 1 };

/* What the field decides, and the halving of the period; then what is read off as in the chapter on dry
 * friction. */
static const fst_statement facts[FST_MAGNET_FACTS] = {
    [APART] = {.id = "magnet-maxima",
               .section = "IV (modelling)",
               .text = "Distance of the two maxima of the field, at the height of the bead's centre",
               .published = 41.0,
               .scale = 1.0,
               .unit = "mm",
               .digits = 1,
               .rule = FST_RULE_NUMBER},
    [REMANENCE] = {.id = "magnet-remanence",
                   .section = "IV B (numerical simulations)",
                   .text = "Remanence with which κ = 1.5 and a bead of 1.2 T give this greatest field",
                   .published = NAN,
                   .scale = 1.0,
                   .unit = "T",
                   .digits = 3,
                   .rule = FST_RULE_NUMBER},
    [SPREAD] = {.id = "magnet-spread",
                .section = "V A (4-fold counter-rotation)",
                .text = "Spread of the field's strength along the path, 10.7 Hz (the paper's simulation)",
                .published = 13.0,
                .scale = 1.0,
                .unit = "%",
                .digits = 1,
                .rule = FST_RULE_AT_MOST},
    [HALVING] = {.id = "magnet-halving",
                 .section = "V C (order of the patterns)",
                 .text = "The period halves at about (halfway between two runs)",
                 .published = 14.4,
                 .scale = 1.0,
                 .unit = "Hz",
                 .digits = 1,
                 .rule = FST_RULE_NUMBER},
    [FST_MAGNET_FIELD_FACTS + 0] = {.id = "corotation",
                                    .section = "III (experiments)",
                                    .text = "From rest, goes round with the magnet up to about",
                                    .published = 7.0,
                                    .scale = 1.0,
                                    .unit = "Hz",
                                    .digits = 2,
                                    .rule = FST_RULE_NUMBER},
    [FST_MAGNET_FIELD_FACTS + 1] = {.id = "ejection",
                                    .section = "III (experiments)",
                                    .text = "Leaves the plate, 7 to 10 Hz (share of the runs)",
                                    .published = NAN,
                                    .scale = 100.0,
                                    .unit = "%",
                                    .digits = 0,
                                    .rule = FST_RULE_MOSTLY},
    [FST_MAGNET_FIELD_FACTS + 2] = {.id = "onset",
                                    .section = "III (experiments)",
                                    .text = "Circles against the magnet in all runs from about",
                                    .published = 10.0,
                                    .scale = 1.0,
                                    .unit = "Hz",
                                    .digits = 1,
                                    .rule = FST_RULE_NUMBER},
    [FST_MAGNET_FIELD_FACTS + 3] = {.id = "four",
                                    .section = "III (experiments)",
                                    .text = "Festoons, 10.7 Hz",
                                    .published = 4.0,
                                    .scale = 1.0,
                                    .unit = "",
                                    .digits = 2,
                                    .rule = FST_RULE_NUMBER},
    [FST_MAGNET_FIELD_FACTS + 4] = {.id = "many",
                                    .section = "III (experiments)",
                                    .text = "Festoons, 19.9 Hz (15: the paper's simulation)",
                                    .published = 15.0,
                                    .scale = 1.0,
                                    .unit = "",
                                    .digits = 2,
                                    .rule = FST_RULE_NUMBER},
    [BELL] = {.id = "bell",
              .section = "III (experiments)",
              .text = "Circles most slowly at",
              .published = 16.0,
              .scale = 1.0,
              .unit = "Hz",
              .digits = 1,
              .rule = FST_RULE_NUMBER},
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
