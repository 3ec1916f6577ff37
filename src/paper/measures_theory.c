/* measures_theory.c - the paper's estimates, its Appendix on corotation, and beads that the
 * field magnetises. */
#include "base/constants.h"
#include "paper/measures_parts.h"

static const fst_params *scene(const fst_paper_state *paper, fst_dynamics dynamics)
{
    return &fst_paper_single(paper, FST_SCAN_FOLD4, dynamics)->params;
}

/* ------------------------------------------------------------------ geometry */

MEASURE(line_length)
{
    NO_NOTE;
    return scene(paper, dynamics)->magnet_half_length / 28e-3; /* half the length of the real magnet */
}

MEASURE(line_spacing)
{
    NO_NOTE;
    const fst_params *p = scene(paper, dynamics);
    return p->magnet_width / (4.0 * p->magnet_half_length);
}

MEASURE(bead_radius)
{
    NO_NOTE;
    const fst_params *p = scene(paper, dynamics);
    return p->bead_radius / p->magnet_half_length;
}

MEASURE(orthoradial)
{
    fst_model *model = model_of(paper, FST_SCAN_FOLD4, dynamics);
    double along = 0.0, all = 0.0;
    if (!model)
        return NAN;
    for (int i = 0; i < 360; ++i) {
        double bead_angle = FST_PI * i / 180.0, c = cos(bead_angle), s = sin(bead_angle), b[3], gradient[3][3];
        fst_field(model, 0.9 * c, 0.9 * s, b, gradient);
        double radial = b[0] * c + b[1] * s;
        along += radial * radial;
        all += b[0] * b[0] + b[1] * b[1] + b[2] * b[2];
    }
    fst_model_free(model);
    (void)snprintf(note, size,
                   "share of the radial part in the field (root mean squares) on the circle r = 0.9");
    return 100.0 * sqrt(along / all);
}

/* ------------------------------------------------------------------ estimates */

/* mu B0 in J: kappa m R^2 gamma^2. */
static double energy_scale(const fst_params *p)
{
    return p->model_kappa * p->bead_mass * p->bead_radius * p->bead_radius * p->friction_gamma *
           p->friction_gamma;
}

MEASURE(estimate_energy)
{
    NO_NOTE;
    return 1e4 * energy_scale(scene(paper, dynamics));
}

MEASURE(estimate_corotation)
{
    const fst_params *p = scene(paper, dynamics);
    double force = energy_scale(p) / p->magnet_half_length;
    double hertz = force / (p->bead_mass * p->friction_gamma * p->bead_radius) / (2.0 * FST_PI);
    (void)snprintf(
        note, size,
        "with μB₀ = %.2g J; the paper's rounded 4e-4 J gives %.1f Hz; the field at the bead is not B₀ but "
        "3.6 B₀, which would give %.0f Hz",
        energy_scale(p), hertz * 4e-4 / energy_scale(p), 3.6 * hertz);
    return hertz;
}

MEASURE(estimate_moment)
{
    const fst_params *p = scene(paper, dynamics);
    double cube = p->bead_radius * p->bead_radius * p->bead_radius;
    (void)snprintf(
        note, size,
        "R³ BH_max/B_rem = %.1e A m² with the values given; a sphere of remanence 1 T has %.1e A m². The "
        "paper's unit, A m⁻¹, is a misprint for A m²",
        cube * 1e5, 4.0 * FST_PI / 3.0 * cube / (4e-7 * FST_PI));
    return cube * 1e5;
}

MEASURE(estimate_field)
{
    const fst_params *p = scene(paper, dynamics);
    double cube = p->bead_radius * p->bead_radius * p->bead_radius,
           sphere = 4.0 * FST_PI / 3.0 * cube / (4e-7 * FST_PI), paper_moment = 1e-2;
    (void)snprintf(
        note, size,
        "with the paper's own μ, 1e-2 A m²; with that of a sphere of remanence 1 T, %.1e A m², B₀ is "
        "%.1f mT",
        sphere, 1e3 * energy_scale(p) / sphere);
    return energy_scale(p) / paper_moment;
}

MEASURE(dry_friction_weight)
{
    const fst_params *p = scene(paper, dynamics);
    double rate = p->friction_mu * p->plate_gravity / (p->bead_radius * 2.0 * FST_PI * 10.0);
    (void)snprintf(note, size, "μ_d g/(Rω₀) at 10 Hz with μ_d = %g is %.1f 1/s", p->friction_mu, rate);
    return rate;
}

MEASURE(dry_friction_pull)
{
    const fst_run_result *result = &fst_paper_single(paper, FST_SCAN_FOLD4, dynamics)->result;
    (void)snprintf(note, size,
                   "the magnet presses the bead down with %.0f weights on average: %.0f 1/s at 10.7 Hz",
                   result->mean_load_weights, result->dry_friction_rate);
    return result->dry_friction_rate;
}

/* ------------------------------------------------------------------ rapid corotation */

MEASURE(corotation_beads)
{
    int staying = 0;
    double longest = 0.0;
    for (int drive = 0; drive < FST_ANSATZ_DRIVES; ++drive)
        for (int start = 0; start < FST_ANSATZ_STARTS; ++start) {
            const fst_paper_ansatz *bead = &paper->ansatz[dynamics][drive][start];
            staying += bead->speed > 0.5;
            longest = fmax(longest, bead->survived);
        }
    (void)snprintf(
        note, size,
        "of %d beads set on the corotating motion, drives 0.5 to 2; the longest followed it for %.0f turns "
        "of the magnet",
        FST_ANSATZ_DRIVES * FST_ANSATZ_STARTS, longest);
    return 100.0 * staying / (FST_ANSATZ_DRIVES * FST_ANSATZ_STARTS);
}

MEASURE(counter_force)
{
    fst_model *model = model_of(paper, FST_SCAN_FOLD4, dynamics);
    if (!model)
        return NAN;
    int outwards = 0, radii = 0;
    double turns = NAN; /* beyond this radius the force points inwards */
    for (double r = 0.9; r < 1.505; r += 0.01, radii++) {
        int inwards = fst_ansatz_force(model, r, -1) < 0.0;
        outwards += !inwards;
        turns = inwards && isnan(turns) ? r : turns;
    }
    fst_model_free(model);
    (void)snprintf(
        note, size,
        "of %d radii from 0.9 to 1.5; the field is greatest at 0.88, but this force points inwards from "
        "%.2f on, and at the drive 0.4 the bead circles at 0.91: what holds it there is n_r",
        radii, turns);
    return outwards;
}

MEASURE(corotation_force)
{
    fst_model *model = model_of(paper, FST_SCAN_FOLD4, dynamics);
    if (!model)
        return NAN;
    double with = fst_ansatz_force(model, 1.05, 1), against = fst_ansatz_force(model, 1.05, -1);
    fst_model_free(model);
    (void)snprintf(
        note, size,
        "at r = 1.05: corotating %+.4f, counter-rotating %+.4f; with the whole field the corotating force is "
        "not small but points outwards, so it precludes that motion all the more",
        with, against);
    return fabs(with / against);
}

/* ------------------------------------------------------------------ beads that the field magnetises */

MEASURE(paramagnet_counter)
{
    int fates[FST_FATE_COUNT] = {0}, at_first = 0;
    double longest = 0.0;
    for (int i = 0; i < paper->search_count; ++i) {
        ++fates[paper->search[dynamics][i].last];
        at_first += paper->search[dynamics][i].first == FST_FATE_COUNTER;
        longest = fmax(longest, paper->search[dynamics][i].periods);
    }
    (void)snprintf(
        note, size,
        "%d starts, drives 0.02 to 2, strengths a from 1e-5 to 3e-2: %d end circling with the magnet, %d "
        "standing, %d off the plate; %d still went against it after 150 turns of the magnet and changed "
        "later, the last one within %.0f",
        paper->search_count, fates[FST_FATE_WITH], fates[FST_FATE_STANDING], fates[FST_FATE_AWAY],
        at_first - fates[FST_FATE_COUNTER], longest);
    return fates[FST_FATE_COUNTER];
}

static double worst_residual(const fst_paper_state *paper, fst_dynamics dynamics, fst_balance_kind kind,
                             char *note, size_t size)
{
    double residual = 0.0, boundary = 0.0;
    for (int i = 0; i < FST_BALANCE_CASES; ++i) {
        residual = fmax(residual, fst_balance_residual(&paper->balances[dynamics][i].of[kind]));
        boundary = fmax(boundary, fst_balance_boundary(&paper->balances[dynamics][i].of[kind]));
    }
    if (kind == FST_BALANCE_ENERGY)
        (void)snprintf(
            note, size,
            "greatest of three motions over 100 turns of the magnet; what the state's change between the ends "
            "adds is up to %.0f %% and taken into account",
            100.0 * boundary);
    else
        (void)snprintf(note, size, "the same motions; the state's change adds up to %.0f %%", 100.0 * boundary);
    return residual;
}

MEASURE(tondu)
{
    return worst_residual(paper, dynamics, FST_BALANCE_ENERGY, note, size);
}

MEASURE(friction_moment)
{
    return worst_residual(paper, dynamics, FST_BALANCE_MOMENT, note, size);
}

MEASURE(friction_on_centre)
{
    return worst_residual(paper, dynamics, FST_BALANCE_KINETIC, note, size);
}

/* The number of motions in which a mean is not positive; NAN where a motion has not settled and none of the
 * others is an exception. */
static double not_positive(const fst_paper_state *paper, fst_dynamics dynamics, fst_balance_kind kind,
                           char *note, size_t size)
{
    int wrong = 0, unsettled = 0;
    double least = INFINITY;
    for (int i = 0; i < FST_BALANCE_CASES; ++i) {
        const fst_balances *motion = &paper->settled[dynamics][i];
        const int settled = fst_balances_settled(motion);
        unsettled += !settled;
        wrong += settled && !(motion->of[kind].friction > 0.0);
        least = fmin(least, motion->of[kind].friction);
    }
    (void)snprintf(note, size, "%s; least %.1e ℓ²γ²%s",
                   kind == FST_BALANCE_MOMENT ? "of three motions, drives 0.1, 0.3 and 0.6" : "of these three",
                   least, unsettled ? "; undecided: one or more had not settled" : "");
    return wrong == 0 && unsettled > 0 ? NAN : (double)wrong;
}

MEASURE(friction_moment_sign)
{
    return not_positive(paper, dynamics, FST_BALANCE_MOMENT, note, size);
}

MEASURE(friction_on_centre_sign)
{
    return not_positive(paper, dynamics, FST_BALANCE_KINETIC, note, size);
}

MEASURE(splitting)
{
    const fst_balances *fastest = &paper->settled[dynamics][FST_BALANCE_CASES - 1];
    double product = fastest->mean_alpha_dot * fastest->of[FST_BALANCE_MOMENT].friction;
    double boundary = fst_balance_boundary(&fastest->of[FST_BALANCE_MOMENT]);
    if (!fst_balances_settled(fastest)) {
        (void)snprintf(
            note, size,
            "undecided: at the drive 0.6 the motion had not settled over %g turns of the magnet (the "
            "state's change adds %.1f %%)",
            fastest->periods, 100.0 * boundary);
        return NAN;
    }
    (void)snprintf(note, size,
                   "at the drive 0.6 over %g turns of the magnet, where ⟨α′⟩ = %+.4f (the state's change adds "
                   "%.1f %%): in a "
                   "stationary motion the exact identities make it ω/⟨α′⟩, so that the step holds for a locked "
                   "bead only; what "
                   "excludes counter-rotation is the identity carried on",
                   fastest->periods, fastest->mean_alpha_dot, 100.0 * boundary);
    return fastest->of[FST_BALANCE_KINETIC].friction / product;
}

/* What the field adds to dW/dt, at places, speeds and rotations of all kinds. */
MEASURE(paramagnet_torque)
{
    NO_NOTE;
    fst_params params = *scene(paper, dynamics);
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

MEASURE(rolling_identity)
{
    return worst_residual(paper, dynamics, FST_BALANCE_ROLLING, note, size);
}

MEASURE(remanence)
{
    const fst_least_found *least = &paper->remanence[dynamics][0][0];
    const fst_kappa_scan *scan = &fst_remanence_scan;
    char edge[96];
    if (isnan(least->below))
        (void)snprintf(edge, sizeof edge, "it does with the scan's least value: less may be enough");
    else
        (void)snprintf(edge, sizeof edge, "an edge between %.4g and %.4g; smaller ranges can be missed",
                       least->below, least->kappa);
    (void)snprintf(
        note, size,
        "least κ found of a magnetisable bead, a = %g, at the drive %g, from one of %d starts, in a scan "
        "from %g by factors of %.2f: %s. A neodymium bead has 1.5",
        fst_remanence_strengths[0], fst_remanence_drives[0], scan->starts, scan->low,
        pow(scan->high / scan->low, 1.0 / (scan->points - 1)), edge);
    return 100.0 * least->kappa / 1.5;
}

MEASURE(anisotropy)
{
    int others = 0, undecided = 0;
    double speeds[2] = {NAN, NAN};
    for (int i = 0; i < paper->counts[FST_SCAN_ANISOTROPIC]; ++i) {
        const fst_paper_run *run = &paper->scans[FST_SCAN_ANISOTROPIC][dynamics][i];
        undecided += fst_paper_may_settle(&run->result);
        others += !fst_paper_counter_rotates(run) && !fst_paper_may_settle(&run->result);
        speeds[i] = run->result.mean_alpha_dot;
    }
    (void)snprintf(
        note, size, "κ = 0, a = b = 1e-3, %g turns of the magnet, drives 0.3 and 0.4: ⟨α′⟩ = %.4f and %.4f",
        fst_paper_single(paper, FST_SCAN_ANISOTROPIC, dynamics)->params.run_periods, speeds[0], speeds[1]);
    return others == 0 && undecided > 0 ? NAN : (double)others;
}
