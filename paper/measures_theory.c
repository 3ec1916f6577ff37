/* measures_theory.c - the Appendix on corotation, and beads that the field magnetises. */
#include "base/constants.h"
#include "paper/measures_parts.h"

/* ------------------------------------------------------------------ rapid corotation */

MEASURE(corotation_beads)
{
    int staying = 0;
    double longest = 0.0;
    for (int drive = 0; drive < FST_ANSATZ_DRIVES; ++drive)
        for (int start = 0; start < FST_ANSATZ_STARTS; ++start) {
            const fst_paper_ansatz *bead = &m->paper->ansatz[m->dynamics][drive][start];
            staying += bead->speed > 0.5;
            longest = fmax(longest, bead->survived);
        }
    NOTE("of %d beads set on the corotating motion, drives 0.5 to 2; the longest followed it for %.0f turns of "
         "the magnet",
         FST_ANSATZ_DRIVES * FST_ANSATZ_STARTS, longest);
    return 100.0 * staying / (FST_ANSATZ_DRIVES * FST_ANSATZ_STARTS);
}

MEASURE(disc_drive)
{
    NOTE("at r = %g, at r = %g from %.4g on; for weak friction. Below, the disc is shaken off by a period "
         "doubling",
         fst_disc_radii[1], fst_disc_radii[0], m->paper->disc[0]);
    return m->paper->disc[1];
}

MEASURE(disc_hertz)
{
    const double hertz = run_of(m, FST_SCAN_FOLD4)->params.friction_gamma / (2.0 * FST_PI);
    NOTE("at r = %g from %.4g Hz on", fst_disc_radii[0], hertz * m->paper->disc[0]);
    return hertz * m->paper->disc[1];
}

/* ------------------------------------------------------------------ beads that the field magnetises */

MEASURE(paramagnet_counter)
{
    int fates[FST_FATE_COUNT] = {0}, at_first = 0;
    double longest = 0.0;
    for (int i = 0; i < m->paper->search_count; ++i) {
        ++fates[m->paper->search[m->dynamics][i].last];
        at_first += m->paper->search[m->dynamics][i].first == FST_FATE_COUNTER;
        longest = fmax(longest, m->paper->search[m->dynamics][i].periods);
    }
    NOTE("%d starts, drives 0.02 to 2, strengths a from 1e-5 to 3e-2: %d end circling with the magnet, %d "
         "standing, %d off the plate; %d still went against it after 150 turns of the magnet and changed "
         "later, the last one within %.0f",
         m->paper->search_count, fates[FST_FATE_WITH], fates[FST_FATE_STANDING], fates[FST_FATE_AWAY],
         at_first - fates[FST_FATE_COUNTER], longest);
    return fates[FST_FATE_COUNTER];
}

static double worst_residual(const fst_measuring *m, fst_balance_kind kind)
{
    double residual = 0.0, boundary = 0.0;
    for (int i = 0; i < FST_BALANCE_CASES; ++i) {
        const fst_balance *balance = &m->paper->balances[m->dynamics][i].of[kind];
        residual = fmax(residual, fst_balance_residual(balance));
        boundary = fmax(boundary, fst_balance_boundary(balance));
    }
    if (kind == FST_BALANCE_ENERGY)
        NOTE("greatest of three motions over 100 turns of the magnet; what the state's change between the ends "
             "adds is up to %.0f %% and taken into account",
             100.0 * boundary);
    else
        NOTE("the same motions; the state's change adds up to %.0f %%", 100.0 * boundary);
    return residual;
}

FORMULA(tondu, FOLD4, worst_residual(m, FST_BALANCE_ENERGY));
FORMULA(friction_moment, FOLD4, worst_residual(m, FST_BALANCE_MOMENT));
FORMULA(friction_on_centre, FOLD4, worst_residual(m, FST_BALANCE_KINETIC));
FORMULA(rolling_identity, FOLD4, worst_residual(m, FST_BALANCE_ROLLING));

/* The number of motions in which a mean is not positive; NAN where a motion has not settled and none of the
 * others is an exception. */
static double not_positive(const fst_measuring *m, fst_balance_kind kind)
{
    int wrong = 0, unsettled = 0;
    double least = INFINITY;
    for (int i = 0; i < FST_BALANCE_CASES; ++i) {
        const fst_balances *motion = &m->paper->settled[m->dynamics][i];
        const int settled = fst_balances_settled(motion);
        unsettled += !settled;
        wrong += settled && !(motion->of[kind].friction > 0.0);
        least = fmin(least, motion->of[kind].friction);
    }
    NOTE("%s; least %.1e ℓ²γ²%s",
         kind == FST_BALANCE_MOMENT ? "of three motions, drives 0.1, 0.3 and 0.6" : "of these three", least,
         unsettled ? "; undecided: one or more had not settled" : "");
    return wrong == 0 && unsettled > 0 ? NAN : (double)wrong;
}

FORMULA(friction_moment_sign, FOLD4, not_positive(m, FST_BALANCE_MOMENT));
FORMULA(friction_on_centre_sign, FOLD4, not_positive(m, FST_BALANCE_KINETIC));

MEASURE(splitting)
{
    const fst_balances *fastest = &m->paper->settled[m->dynamics][FST_BALANCE_CASES - 1];
    double product = fastest->mean_alpha_dot * fastest->of[FST_BALANCE_MOMENT].friction;
    double boundary = fst_balance_boundary(&fastest->of[FST_BALANCE_MOMENT]);
    if (!fst_balances_settled(fastest)) {
        NOTE("undecided: at the drive 0.6 the motion had not settled over %g turns of the magnet (the state's "
             "change adds %.1f %%)",
             fastest->periods, 100.0 * boundary);
        return NAN;
    }
    NOTE("at the drive 0.6 over %g turns of the magnet, where ⟨α′⟩ = %+.4f (the state's change adds %.1f %%): "
         "in a stationary motion the exact identities make it ω/⟨α′⟩, so that the step holds for a locked bead "
         "only; what excludes counter-rotation is the identity carried on",
         fastest->periods, fastest->mean_alpha_dot, 100.0 * boundary);
    return fastest->of[FST_BALANCE_KINETIC].friction / product;
}

/* What the field adds to dW/dt, at places, speeds and rotations of all kinds. */
MEASURE(paramagnet_torque)
{
    fst_params params = run_of(m, FST_SCAN_FOLD4)->params;
    fst_model *in_field = NULL, *alone = NULL;
    double worst = 0.0;
    params.bead_material = FST_MATERIAL_PARAMAGNETIC;
    params.bead_a = 5e-3;
    fst_status status = fst_model_new(&params, &in_field, NULL);
    params.bead_a = 0.0;
    if (status == FST_OK)
        status = fst_model_new(&params, &alone, NULL);
    for (int i = 0; i < 60 && status == FST_OK; ++i) {
        double r = 0.3 + 0.02 * i, turn = 0.7 * i, with[FST_STATE_SIZE], without[FST_STATE_SIZE];
        const double y[FST_STATE_SIZE] = {
            r * cos(turn), r * sin(turn), 0.1 * sin(3.0 * i), 0.1 * cos(5.0 * i), 0.6,
            0.0,           0.8,           sin(2.0 * i),       cos(7.0 * i),       0.3 * sin(i)};
        fst_rhs(in_field, y, with);
        fst_rhs(alone, y, without);
        for (int k = FST_WX; k <= FST_WZ; ++k)
            worst = fmax(worst, fabs(with[k] - without[k]));
    }
    fst_model_free(in_field);
    fst_model_free(alone);
    return status == FST_OK ? worst : NAN;
}

MEASURE(remanence)
{
    const fst_least_found *least = &m->paper->remanence[m->dynamics][0][0];
    const fst_kappa_scan *scan = &fst_remanence_scan;
    char edge[96];
    if (isnan(least->below))
        (void)snprintf(edge, sizeof edge, "it does with the scan's least value: less may be enough");
    else
        (void)snprintf(edge, sizeof edge, "an edge between %.4g and %.4g; smaller ranges can be missed",
                       least->below, least->kappa);
    NOTE("least κ found of a magnetisable bead, a = %g, at the drive %g, from one of %d starts, in a scan from "
         "%g by factors of %.2f: %s. A neodymium bead has 1.5",
         fst_remanence_strengths[0], fst_remanence_drives[0], scan->starts, scan->low,
         pow(scan->high / scan->low, 1.0 / (scan->points - 1)), edge);
    return 100.0 * least->kappa / 1.5;
}

MEASURE(anisotropy)
{
    int others = 0, undecided = 0;
    double speeds[2] = {NAN, NAN};
    for (int i = 0; i < m->paper->counts[FST_SCAN_ANISOTROPIC]; ++i) {
        const fst_paper_run *run = &run_of(m, FST_SCAN_ANISOTROPIC)[i];
        undecided += fst_paper_may_settle(&run->result);
        others += !fst_paper_counter_rotates(run) && !fst_paper_may_settle(&run->result);
        speeds[i] = run->result.mean_alpha_dot;
    }
    NOTE("κ = 0, a = b = 1e-3, %g turns of the magnet, drives 0.3 and 0.4: ⟨α′⟩ = %.4f and %.4f",
         run_of(m, FST_SCAN_ANISOTROPIC)->params.run_periods, speeds[0], speeds[1]);
    return others == 0 && undecided > 0 ? NAN : (double)others;
}
