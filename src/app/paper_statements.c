/* paper_statements.c - what the paper says in words, held against the runs. */
#include "app/measures.h"

#include <stdio.h>
#include <string.h>

#define HALVING_COMMAND                                                                                        \
    "festoon run --set drive.omega=OMEGA --set model.dynamics=farago2020 --set run.periods=1200 --set "        \
    "run.discard=1100"
#define PROBE_COMMAND "festoon paper -o DIR"
#define REMANENCE_COMMAND                                                                                      \
    "festoon run --set bead.material=mixed --set bead.a=0.001 --set model.kappa=KAPPA --set drive.omega=0.3 "  \
    "--set run.periods=600"

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
     FST_TEST_WITHIN, 0.002, 0.02, fst_measure_halving, FST_SCAN_COMPARISON, HALVING_COMMAND},
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
    {"turning-points", "4-fold counter-rotation",
     "Friction acts at localized moments of the path, close to the turning points (share of the loss in the "
     "nearest "
     "quarter of the path).",
     "localized", NAN, "%", 0, FST_TEST_AT_LEAST, 60.0, 40.0, fst_measure_turning_points, FST_SCAN_FOLD4, NULL},
    {"friction-angle", "4-fold counter-rotation",
     "Friction is high when the moment cannot follow the field (correlation of |V| with their angle).",
     "tightly correlated", NAN, "", 2, FST_TEST_AT_LEAST, 0.8, 0.6, fst_measure_friction_follows_angle,
     FST_SCAN_FOLD4, NULL},
    {"fold4-corners", "4-fold counter-rotation",
     "At the corners of the square-like path the moment is almost upright, |n_z| close to 1 (the conjugate: "
     "-1).",
     "about 1", 1.0, "", 3, FST_TEST_WITHIN, 0.1, 0.25, fst_measure_corner_nz, FST_SCAN_FOLD4, NULL},
    {"fold4-conjugate", "4-fold counter-rotation",
     "A conjugate solution exists with the poles of bead and magnet exchanged (ratio of the two ⟨n_z⟩).", NULL,
     -1.0, "", 6, FST_TEST_WITHIN, 1e-4, 1e-2, fst_measure_conjugate, FST_SCAN_CONJUGATE, NULL},
    {"shrinking", "2 (experiment)",
     "The festoons shrink with the drive (δr at 10.7 Hz over that at 19.9 Hz) and the path nears a circle.",
     "shrinks", NAN, "", 1, FST_TEST_AT_LEAST, 3.0, 1.5, fst_measure_fluctuation, FST_SCAN_FOLD15, NULL},
    {"slow-corotation", "2 (experiment)", "At low drives the bead goes round with the magnet, ⟨α′⟩ = ω.", NULL,
     1.0, "", 6, FST_TEST_WITHIN, 1e-6, 1e-3, fst_measure_strict_corotation, FST_SCAN_SLOW, NULL},
    {"circling", "2 (experiment)", "Above 16 Hz |⟨α′⟩| is about ωR/⟨r⟩ (their ratio).", "about 1", 1.0, "", 2,
     FST_TEST_WITHIN, 0.2, 0.4, fst_measure_circling_estimate, FST_SCAN_FOLD15, NULL},
    {"frequency-lock", "5 (averages)",
     "The moment turns with the magnet as the bead sees it: ⟨φ′⟩ = ω − ⟨α′⟩ (ratio).", NULL, 1.0, "", 6,
     FST_TEST_WITHIN, 1e-6, 1e-3, fst_measure_frequency_lock, FST_SCAN_FOLD15, NULL},
    {"phase-lock", "5 (averages)", "The phase of φ = −Φ + χ locks to χ = π.", NULL, 180.0, "deg", 1,
     FST_TEST_WITHIN, 3.0, 10.0, fst_measure_phase_lock, FST_SCAN_FOLD15, NULL},
    {"rolling-mean", "5 (averages)",
     "The averaged equations leave ⟨V_α⟩ = 0 (here over ⟨r⟩|⟨α′⟩|; the paper neglects fluctuations).", NULL,
     0.0, "%", 1, FST_TEST_AT_MOST, 5.0, 15.0, fst_measure_rolling_on_average, FST_SCAN_FOLD15, NULL},
    {"spin-term", "Fig. evolution",
     "The spin about the magnetic axis contributes to friction's radial part (its share).", "a part", NAN, "%",
     0, FST_TEST_AT_LEAST, 10.0, 3.0, fst_measure_spin_share, FST_SCAN_FOLD15, NULL},
    {"magnetic-term", "5 (averages), Eq. (eq21)",
     "With θ = π/2 the magnetic term of the radial balance is ⟨B_α sin φ − B_z cos φ⟩ differentiated (its "
     "error at the "
     "drive 0.4).",
     "neglects n_r", 0.0, "%", 0, FST_TEST_AT_MOST, 20.0, 50.0, fst_measure_dropped_part, FST_SCAN_FOLD15,
     NULL},
    {"asymptotic", "Conclusion", "For ω to infinity the motion is free rolling.", "asymptotically", 0.0, "%", 2,
     FST_TEST_AT_MOST, 1.0, 5.0, fst_measure_asymptotic_rolling, FST_SCAN_ASYMPTOTIC, NULL},
    {"asymptotic-hz", "Conclusion",
     "The asymptotic regime begins at about 100 Hz (decimal logarithm of the frequency).", "about 100 Hz", 2.0,
     "", 2, FST_TEST_WITHIN, 0.3, 0.6, fst_measure_asymptotic_frequency, FST_SCAN_FAST, NULL},
    {"halving-root", "Fig. supercritical",
     "The period halving is supercritical: ⟨n_z⟩ grows as the square root of the distance (exponent).",
     "supercritical", 0.5, "", 2, FST_TEST_WITHIN, 0.05, 0.1, fst_measure_halving_nz, FST_SCAN_COMPARISON,
     HALVING_COMMAND},
    {"halving-p", "Fig. supercritical",
     "So does the ratio p of successive amplitudes (exponent, nearest points).", "supercritical", 0.5, "", 2,
     FST_TEST_WITHIN, 0.1, 0.5, fst_measure_halving_p, FST_SCAN_COMPARISON, HALVING_COMMAND},
    {"halving-time", "Fig. supercritical", "The relaxation time diverges at the transition (exponent).",
     "diverges", -1.0, "", 2, FST_TEST_WITHIN, 0.1, 0.3, fst_measure_halving_relaxation, FST_SCAN_COMPARISON,
     HALVING_COMMAND},
    {"length", "3 (Modelling)", "The model's lines are shorter than the magnet: l = 0.82 l_m.", NULL, 0.82, "",
     3, FST_TEST_WITHIN, 0.005, 0.02, fst_measure_line_length, FST_SCAN_FOLD4, "festoon check"},
    {"spacing", "Fig. portrait", "The lines are λ = w_m/(4l) = 0.435 apart.", NULL, 0.435, "", 4,
     FST_TEST_WITHIN, 0.0005, 0.005, fst_measure_line_spacing, FST_SCAN_FOLD4, "festoon check"},
    {"eps", "3 (Simulations)", "ε = R/l = 0.11.", NULL, 0.11, "", 4, FST_TEST_WITHIN, 0.005, 0.01,
     fst_measure_bead_radius, FST_SCAN_FOLD4, "festoon check"},
    {"orthoradial", "5 (averages)",
     "Close to its maximum the field is essentially orthoradial, slightly tilted.", "essentially", NAN, "%", 0,
     FST_TEST_AT_MOST, 40.0, 60.0, fst_measure_orthoradial, FST_SCAN_FOLD4, "festoon field --at 0.9,0"},
    {"estimate-energy", "3 (Simulations)", "The fit gives μB₀ of about 4e-4 J (in 1e-4 J).", "about 4", 4.0, "",
     2, FST_TEST_WITHIN, 0.5, 1.5, fst_measure_estimate_energy, FST_SCAN_FOLD4, "festoon check"},
    {"estimate-corotation", "2 (experiment)", "Corotation ends where μB/(mγRl) = ω_c, about 7 Hz.",
     "about 7 Hz", 7.0, "Hz", 1, FST_TEST_WITHIN, 0.5, 2.0, fst_measure_estimate_corotation, FST_SCAN_FOLD4,
     "festoon check"},
    {"estimate-moment", "3 (Simulations)", "μ is about R³ BH_max/B_rem, 1e-2 A m² (decimal logarithm).",
     "about 1e-2", -2.0, "", 2, FST_TEST_WITHIN, 0.5, 1.0, fst_measure_estimate_moment, FST_SCAN_FOLD4,
     "festoon check"},
    {"estimate-field", "3 (Simulations)", "B₀ is about 1e-2 T (decimal logarithm).", "about 1e-2 T", -2.0, "",
     2, FST_TEST_WITHIN, 0.5, 1.0, fst_measure_estimate_field, FST_SCAN_FOLD4, "festoon check"},
    {"dry-weight", "4-fold counter-rotation",
     "Dry friction under the bead's weight amounts to γ = μ_d g/(Rω₀), about 1e2 1/s at 10 Hz (decimal "
     "logarithm).",
     "about 1e2", 2.0, "", 2, FST_TEST_WITHIN, 0.5, 0.7, fst_measure_dry_friction_weight, FST_SCAN_FOLD4, NULL},
    {"dry-pull", "4-fold counter-rotation",
     "That is the order of the fitted 312.5 1/s (here with the magnet's pull; decimal logarithm).", "312.5 1/s",
     2.495, "", 2, FST_TEST_WITHIN, 0.3, 0.5, fst_measure_dry_friction_pull, FST_SCAN_FOLD4, NULL},
    {"corotation-beads", "Appendix: rapid corotation",
     "Rapid corotation, α′ = εω/(r + ε), is never stable (beads set on it that stay).", "never", 0.0, "%", 0,
     FST_TEST_AT_MOST, 0.0, 5.0, fst_measure_corotation_beads, FST_SCAN_FAST, PROBE_COMMAND},
    {"corotation-force", "Appendix: rapid corotation",
     "Its mean radial magnetic force is small (over the counter-rotating motion's).", "small", 0.0, "", 2,
     FST_TEST_AT_MOST, 0.3, 0.6, fst_measure_corotation_force, FST_SCAN_FAST, PROBE_COMMAND},
    {"paramagnet", "Paramagnetic bead", "A purely paramagnetic bead never counter-rotates (cases found).",
     "never", 0.0, "", 0, FST_TEST_AT_MOST, 0.0, 0.0, fst_measure_paramagnet_counter, FST_SCAN_FAST,
     PROBE_COMMAND},
    {"tondu", "Paramagnetic bead, Eq. (tondu)", "⟨V_r² + V_α²⟩ = aω⟨∂B²/∂α⟩ (relative residual).", NULL, 0.0,
     "", -1, FST_TEST_AT_MOST, 1e-6, 1e-4, fst_measure_tondu, FST_SCAN_FAST, PROBE_COMMAND},
    {"moment", "Paramagnetic bead, Eq. (17)", "⟨rV_α⟩ = a⟨∂B²/∂α⟩ (relative residual).", NULL, 0.0, "", -1,
     FST_TEST_AT_MOST, 1e-6, 1e-4, fst_measure_friction_moment, FST_SCAN_FAST, PROBE_COMMAND},
    {"moment-sign", "Paramagnetic bead, Eq. (17)", "ω⟨rV_α⟩ > 0: friction takes angular momentum.", "positive",
     NAN, "", 2, FST_TEST_AT_LEAST, 1e-9, 0.0, fst_measure_friction_moment_sign, FST_SCAN_FAST, PROBE_COMMAND},
    {"kinetic", "Paramagnetic bead", "ωa⟨∂B²/∂α⟩ = ⟨r′V_r + rα′V_α⟩ (relative residual).", NULL, 0.0, "", -1,
     FST_TEST_AT_MOST, 1e-6, 1e-4, fst_measure_friction_on_centre, FST_SCAN_FAST, PROBE_COMMAND},
    {"remanence", "Conclusion",
     "A slight remanence is enough for steel beads to counter-rotate (least, in % of the neodymium bead's).",
     "slight", NAN, "%", 2, FST_TEST_AT_MOST, 5.0, 20.0, fst_measure_remanence, FST_SCAN_FAST,
     REMANENCE_COMMAND},
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
