/* paper_statements.c - what the paper says in words, held against the runs. */
#include "app/measures.h"

#include <stdio.h>
#include <string.h>

/* Fields: id, section, text, said, published, unit, digits, test, bound of "reproduced", bound of "close",
 * measure, scan, command. */
static const fst_statement statements[] = {
    {"maxima", "3 (Modelling)",
     "The two maxima of the field on the plate are 41 mm apart; this fixes the length of the model's lines.",
     NULL, 41.0, "mm", 1, FST_TEST_WITHIN, 0.6, 1.5, fst_measure_maxima_distance, FST_SCAN_FOLD15,
     "festoon field --at 0.8812,0"},
    {"fold4-festoons", "4-fold counter-rotation",
     "At the drive 0.215 (10.7 Hz) the bead draws a pattern of 4 festoons that drifts slowly.", "4, drifting",
     4.0, "", 2, FST_TEST_WITHIN, 0.25, 0.5, fst_measure_fold4_festoons, FST_SCAN_FOLD4, NULL},
    {"fold4-angle", "4-fold counter-rotation",
     "The moment stays parallel to the field: their angle does not exceed about 4 degrees.",
     "at most about 4 deg", 4.0, "deg", 2, FST_TEST_AT_MOST, 4.5, 6.0, fst_measure_fold4_angle, FST_SCAN_FOLD4,
     NULL},
    {"fold4-nz", "4-fold counter-rotation", "The mean of n_z is not zero, so a conjugate solution exists.",
     "not 0", NAN, "", 3, FST_TEST_AT_LEAST, 0.02, 0.005, fst_measure_fold4_nz, FST_SCAN_FOLD4, NULL},
    {"fold4-field", "4-fold counter-rotation",
     "The strength of the field at the bead varies by 13 % about its mean (read as the standard deviation).",
     NULL, 13.0, "%", 1, FST_TEST_WITHIN, 1.0, 3.0, fst_measure_fold4_field, FST_SCAN_FOLD4, NULL},
    {"fold15-festoons", "Many-fold counter-rotation", "At the drive 0.4 (19.9 Hz) there are 15 festoons.", NULL,
     15.0, "", 2, FST_TEST_WITHIN, 0.25, 0.5, fst_measure_fold15_festoons, FST_SCAN_FOLD15, NULL},
    {"fold15-angle", "Many-fold counter-rotation",
     "The angle between moment and field is never larger than about 3 degrees.", "at most about 3 deg", 3.0,
     "deg", 2, FST_TEST_AT_MOST, 3.5, 5.0, fst_measure_fold15_angle, FST_SCAN_FOLD15, NULL},
    {"fold15-closed", "Many-fold counter-rotation",
     "In the local frame the path of the moment is closed, with the symmetry S2.", NULL, 2.0, "", 0,
     FST_TEST_SYMMETRY, 0.0, 0.0, fst_measure_fold15_symmetry, FST_SCAN_FOLD15, NULL},
    {"fold15-round", "Many-fold counter-rotation", "That path is almost circular (ratio of its two widths).",
     "almost 1", 1.0, "", 3, FST_TEST_WITHIN, 0.15, 0.3, fst_measure_fold15_roundness, FST_SCAN_FOLD15, NULL},
    {"fold15-tilt", "Many-fold counter-rotation",
     "The plane of that path is tilted by about 25 degrees against the vertical.", "about 25 deg", 25.0, "deg",
     1, FST_TEST_WITHIN, 3.0, 8.0, fst_measure_fold15_tilt, FST_SCAN_FOLD15, NULL},
    {"magint-least", "Fig. magint", "The radius is least, about 0.89, where the field is strongest.",
     "about 0.89", 0.89, "l", 3, FST_TEST_WITHIN, 0.02, 0.05, fst_measure_least_radius, FST_SCAN_FOLD15, NULL},
    {"magint-aligned", "Fig. magint", "That happens when the magnet and the bead are aligned, Φ = 0.", NULL,
     0.0, "deg", 1, FST_TEST_WITHIN, 5.0, 15.0, fst_measure_least_radius_phi, FST_SCAN_FOLD15, NULL},
    {"magint-across", "Fig. magint", "The radius is greatest at precisely Φ = π/2.", NULL, 90.0, "deg", 1,
     FST_TEST_WITHIN, 5.0, 15.0, fst_measure_greatest_radius_phi, FST_SCAN_FOLD15, NULL},
    {"halving", "Fig. supercritical",
     "The period halves (S1 to S2) at the drive 0.2904, between 0.2845 and 0.352.", NULL, 0.2904, "", 4,
     FST_TEST_WITHIN, 0.002, 0.02, fst_measure_halving, FST_SCAN_COMPARISON,
     "festoon run --set drive.omega=OMEGA --set model.dynamics=farago2020 --set run.periods=1200 --set "
     "run.discard=1100"},
    {"corotation", "2 (experiment)", "Corotation is lost near 7 Hz.", "about 7 Hz", 7.0, "Hz", 1,
     FST_TEST_WITHIN, 1.0, 2.0, fst_measure_corotation, FST_SCAN_SLOW, NULL},
    {"chaos", "2 (experiment)",
     "Between corotation and counter-rotation, 7 to 10 Hz, the motion is mainly chaotic and beads leave the "
     "plate (share of irregular runs).",
     "mainly chaotic", NAN, "%", 0, FST_TEST_AT_LEAST, 50.0, 20.0, fst_measure_irregular, FST_SCAN_SLOW, NULL},
    {"bell", "2 (experiment)", "The bead circles most slowly, |⟨α′⟩| least, around 16 Hz.", "around 16 Hz",
     16.0, "Hz", 1, FST_TEST_WITHIN, 1.0, 2.0, fst_measure_bell, FST_SCAN_COMPARISON, NULL},
    {"slowness", "2 (experiment)", "The bead circles one order of magnitude slower than the magnet (ω/|⟨α′⟩|).",
     "about 10", NAN, "", 1, FST_TEST_AT_LEAST, 5.0, 3.2, fst_measure_slowness, FST_SCAN_COMPARISON, NULL},
    {"rolling-alpha", "Fig. test", "From the drive 0.5 on, ⟨α′⟩ = −εω/(r − ε), as in free rolling.",
     "convincing", NAN, "%", 1, FST_TEST_AT_MOST, 10.0, 20.0, fst_measure_rolling_alpha, FST_SCAN_FAST, NULL},
    {"rolling-phi", "Fig. test", "From the drive 0.5 on, ⟨φ′⟩ = ωr/(r − ε).", "convincing", NAN, "%", 1,
     FST_TEST_AT_MOST, 10.0, 20.0, fst_measure_rolling_phi, FST_SCAN_FAST, NULL},
    {"friction", "Fig. evolution",
     "Friction is not at all negligible in the radial balance under the drive 0.5 (its share of the magnetic "
     "term).",
     "not negligible", NAN, "%", 0, FST_TEST_AT_LEAST, 20.0, 10.0, fst_measure_friction_share, FST_SCAN_FOLD15,
     NULL},
    {"energy", "4 (energy)", "What the drive gives is what friction takes: a check on the computation.", "0",
     0.0, "", -1, FST_TEST_AT_MOST, 1e-8, 1e-6, fst_measure_energy, FST_SCAN_TABLE, NULL},
};

int fst_statement_count(void)
{
    return (int)(sizeof statements / sizeof statements[0]);
}

const fst_statement *fst_statement_at(int index)
{
    return &statements[index];
}

const char *fst_verdict_name(fst_verdict verdict)
{
    static const char *const names[] = {[FST_VERDICT_REPRODUCED] = "reproduced",
                                        [FST_VERDICT_CLOSE] = "close",
                                        [FST_VERDICT_NOT] = "not reproduced"};
    return names[verdict];
}

static int passes(const fst_statement *statement, double value, double bound)
{
    switch (statement->test) {
    case FST_TEST_WITHIN:
        return fabs(value - statement->published) <= bound;
    case FST_TEST_AT_MOST:
        return value <= bound;
    case FST_TEST_AT_LEAST:
        return value >= bound;
    case FST_TEST_SYMMETRY:
        return value == statement->published;
    }
    return 0;
}

fst_finding fst_statement_check(const fst_statement *statement, const fst_paper_state *paper)
{
    fst_finding finding = {.note = {"", ""}};
    for (int d = 0; d < FST_PAPER_DYNAMICS; d++) {
        double value = statement->measure(paper, (fst_dynamics)d, finding.note[d], sizeof finding.note[d]);
        finding.value[d] = value;
        /* A NAN passes nothing. */
        finding.verdict[d] = passes(statement, value, statement->reproduced) ? FST_VERDICT_REPRODUCED
                             : passes(statement, value, statement->close)    ? FST_VERDICT_CLOSE
                                                                             : FST_VERDICT_NOT;
    }
    return finding;
}

void fst_statement_criterion(const fst_statement *statement, char *text, size_t size)
{
    const char *words = statement->test == FST_TEST_WITHIN    ? "within"
                        : statement->test == FST_TEST_AT_MOST ? "at most"
                                                              : "at least";
    const char *blank = statement->unit[0] ? " " : "";
    if (statement->test == FST_TEST_SYMMETRY)
        (void)snprintf(text, size, "reproduced: closed, with this symmetry");
    else
        (void)snprintf(text, size, "reproduced: %s %g%s%s; close: %s %g%s%s", words, statement->reproduced,
                       blank, statement->unit, words, statement->close, blank, statement->unit);
}

void fst_statement_value(const fst_statement *statement, double value, char *text, size_t size)
{
    const char *blank = statement->unit[0] ? " " : "";
    if (!isfinite(value))
        (void)snprintf(text, size, "none");
    else if (statement->test == FST_TEST_SYMMETRY)
        (void)snprintf(text, size, "S%.0f", value);
    else if (statement->digits < 0)
        (void)snprintf(text, size, "%.1e", value);
    else
        (void)snprintf(text, size, "%.*f%s%s", statement->digits, value, blank, statement->unit);
}
