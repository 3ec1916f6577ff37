/* The regime of a run: right if the evidence is there, and never a guess.
 * tests: study/regime.c study/conclude.c
 * labels: numbers slow */
#include <stdio.h>

#include "physics.h"

static void expect_regime(const fst_run_result *r, fst_regime expected)
{
    if (r->regime != expected)
        fail_msg("%s, expected %s (%s)", fst_regime_name(r->regime), fst_regime_name(expected), r->reason);
    assert_true(strlen(r->reason) > 20);
}

/* Equilibria in the turning frame.  r, <n_z> and the angle(n, B) by an independent implementation: 300 drive
 * periods left out, 100 averaged, DOP853 of its own at rtol 1e-11. */
static void test_locked(void **unused)
{
    (void)unused;
    static const struct {
        fst_dynamics dynamics;
        double omega, r, nz, angle_deg;
    } reference[] = {
        {FST_DYNAMICS_RIGID, 0.0825, 0.9347643783348, 0.9551742104, NAN},
        {FST_DYNAMICS_RIGID, 0.1325, 0.7209501489105, 0.8251002928, 3.490696677},
        {FST_DYNAMICS_RIGID, 0.145, 0.6234952762946, 0.7310739434, 4.084847149},
        {FST_DYNAMICS_FARAGO2020, 0.095, 0.9483484156190, 0.9598012562, NAN},
        {FST_DYNAMICS_FARAGO2020, 0.1325, 0.7304277170648, 0.8302669949, 2.915259936},
        {FST_DYNAMICS_FARAGO2020, 0.145, 0.6270334256116, 0.7307475346, 3.552646511},
    };
    for (size_t i = 0; i < sizeof reference / sizeof *reference; ++i) {
        fst_params p = bead_at(reference[i].omega, reference[i].dynamics);
        p.run_discard = 300;
        const fst_run_result r = run_of(&p);
        expect_regime(&r, FST_REGIME_LOCKED);
        assert_int_equal(r.symmetry, FST_SYMMETRY_NONE);
        CHECK_CLOSE(r.mean_r, reference[i].r, 1e-8);
        CHECK_CLOSE(r.mean_nz, reference[i].nz, 1e-8);
        if (!isnan(reference[i].angle_deg))
            CHECK_CLOSE(r.max_angle_deg, reference[i].angle_deg, 1e-6);
        CHECK_CLOSE(r.std_r, 0, 1e-7);
        CHECK_CLOSE(r.mean_alpha_dot, r.omega, 1e-9); /* corotation */
        CHECK_CLOSE(r.mean_phi_dot, 0, 1e-9);
        assert_true(isnan(r.festoons));
        /* an equilibrium indeed */
        fst_model *model = model_of(&p);
        double rate[FST_STATE_SIZE];
        fst_rhs(model, r.final_state, rate);
        const double nothing[FST_STATE_SIZE] = {0};
        CHECK_CLOSE(greatest_difference(rate, nothing, FST_STATE_SIZE), 0, 1e-8);
        fst_model_free(model);
    }
}

/* At low drive the field holds the bead, whether it starts at rest or rolling. */
static void test_locked_from_rest(void **unused)
{
    (void)unused;
    for (int dynamics = 0; dynamics < 2; ++dynamics) {
        fst_params p = bead_at(0.045, (fst_dynamics)dynamics);
        p.run_discard = 300;
        const fst_run_result rolling = run_of(&p);
        p.start_spin = FST_SPIN_REST;
        const fst_run_result rest = run_of(&p);
        expect_regime(&rolling, FST_REGIME_LOCKED);
        expect_regime(&rest, FST_REGIME_LOCKED);
        CHECK_CLOSE(rest.mean_r, rolling.mean_r, 1e-8);
        CHECK_CLOSE(rest.mean_r, dynamics == FST_DYNAMICS_RIGID ? 0.8968883071 : 0.8959083658, 1e-8);
    }
}

/* A bead over a strong magnet, given by the model's kappa, or by a moment and a field where kappa would be too
 * large. */
static fst_params strong_magnet(double kappa, fst_dynamics dynamics)
{
    fst_params p = bead_at(4.0, dynamics);
    if (kappa <= 1e6) {
        p.model_kappa = kappa;
    } else {
        p.magnet_b0 = 1e3;
        p.bead_moment = kappa * p.bead_mass * pow(p.bead_radius * p.friction_gamma, 2) / p.magnet_b0;
    }
    p.run_periods = kappa > 3e7 ? 28 : kappa > 3e6 ? 40 : kappa > 3e3 ? 120 : 16;
    p.run_discard = 0.5 * p.run_periods;
    return p;
}

static fst_run_result run_from(const fst_params *p, const double *start)
{
    fst_run_options options = fst_default_run_options();
    options.start = start;
    fst_run_result result;
    fst_error error = {FST_OK, "", ""};
    if (fst_run(p, &options, &result, &error) != FST_OK)
        fail_msg("fst_run: %s", error.sentence);
    return result;
}

/* A strong magnet amplifies the integrator's errors. They are not a motion, whatever its strength and the
 * tolerance: each run with kappa from 1e4 on starts where a magnet a tenth as strong holds the bead. */
static void test_locked_by_any_strong_magnet(void **unused)
{
    (void)unused;
    for (int dynamics = 0; dynamics < 2; ++dynamics)
        for (int loose = 0; loose < 2; ++loose) {
            double start[FST_STATE_SIZE];
            for (double kappa = 1e2; kappa < (loose ? 2e5 : 2e8); kappa *= 10) {
                fst_params p = strong_magnet(kappa, (fst_dynamics)dynamics);
                p.drive_omega = kappa < 3e3 ? 0.3 : 4.0;
                p.run_rtol = loose ? 1e-8 : 1e-10;
                const fst_run_result r = kappa <= 1e3 ? run_of(&p) : run_from(&p, start);
                if (r.regime != FST_REGIME_LOCKED)
                    fail_msg("kappa %g, rtol %g: %s (%s)", kappa, p.run_rtol, fst_regime_name(r.regime),
                             r.reason);
                memcpy(start, r.final_state, sizeof start);
            }
        }
}

/* A small true libration is called one. Nothing damps it here: the plate has no friction, and the bead is
 * turned slightly out of its place, or its moment out of the field. */
static void test_small_librations(void **unused)
{
    (void)unused;
    for (int dynamics = 0; dynamics < 2; ++dynamics)
        for (double kappa = 1e2; kappa < 2e5; kappa *= 10) {
            fst_params p = bead_at(kappa > 3e3 ? 1.0 : 0.3, (fst_dynamics)dynamics);
            p.model_kappa = kappa;
            p.run_periods = 16;
            p.run_discard = 8;
            const fst_run_result rest = run_of(&p);
            expect_regime(&rest, FST_REGIME_LOCKED);
            for (int large = 0; large < 2; ++large) { /* each kick by one of the dynamics */
                const double angle = large ? 1e-3 : 1e-6;
                const int from = large == dynamics ? FST_X : FST_NX;
                double start[FST_STATE_SIZE];
                memcpy(start, rest.final_state, sizeof start);
                start[from] = cos(angle) * rest.final_state[from] - sin(angle) * rest.final_state[from + 1];
                start[from + 1] = sin(angle) * rest.final_state[from] + cos(angle) * rest.final_state[from + 1];
                fst_params free_bead = p;
                free_bead.friction_law = FST_FRICTION_NONE;
                free_bead.run_periods = 12;
                free_bead.run_discard = 2;
                const fst_run_result r = run_from(&free_bead, start);
                if (r.regime != FST_REGIME_LIBRATING)
                    fail_msg("kappa %g, %g rad of component %d: %s (%s)", kappa, angle, from,
                             fst_regime_name(r.regime), r.reason);
            }
        }
}

/* Phi stays bounded, but the bead is not at rest. */
static void test_librating(void **unused)
{
    (void)unused;
    static const double drives[] = {0.12, 0.17};
    for (int dynamics = 0; dynamics < 2; ++dynamics)
        for (int i = 0; i < 2; ++i) {
            fst_params p = bead_at(drives[i], (fst_dynamics)dynamics);
            p.run_periods = 140;
            p.run_discard = 100;
            const fst_run_result r = run_of(&p);
            expect_regime(&r, FST_REGIME_LIBRATING);
            CHECK_CLOSE(r.mean_alpha_dot, r.omega, 1e-3);
            CHECK_WITHIN(r.std_r, 0.01, 0.5);
            CHECK_WITHIN(r.largest_exponent, -1, 1e-3);
            assert_true(isnan(r.festoons));
        }
}

/* Frictionless motion is conservative, and this start leads to chaos: neighbours part exponentially. */
static void test_chaotic(void **unused)
{
    (void)unused;
    fst_params p = bead_at(0.4, FST_DYNAMICS_RIGID);
    p.friction_law = FST_FRICTION_NONE;
    p.start_r = 1.1;
    p.run_periods = 500;
    p.run_discard = 100;
    const fst_run_result r = run_of(&p);
    expect_regime(&r, FST_REGIME_CHAOTIC);
    /* The growth rate differs between parts of the window, which widens the error, but is positive in all of
     * them. */
    assert_true(r.largest_exponent > 1.5 * r.largest_exponent_error);
    /* two trajectories that start a billionth apart */
    fst_model *model = model_of(&p);
    double start[FST_STATE_SIZE], a[FST_STATE_SIZE], b[FST_STATE_SIZE];
    start_of(&p, model, start);
    const double t = 300 * TWO_PI / 0.4;
    state_after(model, 1e-12, start, t, a);
    start[FST_X] += 1e-9;
    state_after(model, 1e-12, start, t, b);
    CHECK_WITHIN(greatest_difference(a, b, FST_STATE_SIZE), 1e-2, 100);
    fst_model_free(model);
}

/* A bead that goes over the edge: the result says when, and r is 10 at that moment. */
static void test_ejected(void **unused)
{
    (void)unused;
    fst_params p = bead_at(0.405, FST_DYNAMICS_RIGID);
    p.start_r = 9.9;
    fst_run_result r = run_of(&p);
    expect_regime(&r, FST_REGIME_EJECTED);
    CHECK_CLOSE(hypot(r.final_state[FST_X], r.final_state[FST_Y]), 10, 1e-14);
    CHECK_CLOSE(r.periods, r.end_time * 0.405 / TWO_PI, 1e-12);
    CHECK_WITHIN(r.periods, 1, 2);
    assert_non_null(strstr(r.reason, "edge"));
    fst_model *model = model_of(&p);
    double start[FST_STATE_SIZE], end[FST_STATE_SIZE];
    start_of(&p, model, start);
    state_after(model, 1e-12, start, r.end_time, end);
    CHECK_CLOSE(greatest_difference(end, r.final_state, FST_STATE_SIZE), 0, 1e-8);
    fst_model_free(model);
    /* in no field it rolls straight on with v = eps omega r/(r - eps), r^2 = 9.9^2 + v^2 t^2 */
    p.model_kappa = 0;
    r = run_of(&p);
    expect_regime(&r, FST_REGIME_EJECTED);
    const double eps = 2.5 / 23, v = eps * 0.405 * 9.9 / (9.9 - eps);
    CHECK_CLOSE(r.end_time, sqrt(100 - 9.9 * 9.9) / v, 1e-7);
}

/* Beads that are lifted off the plate: a diamagnetic one at once; a frictionless one at r = 1.177, after 9.3
 * turns of the magnet. */
static void test_lifted(void **unused)
{
    (void)unused;
    fst_params p = bead_at(0.405, FST_DYNAMICS_RIGID);
    p.bead_material = FST_MATERIAL_PARAMAGNETIC;
    p.bead_a = -1e-3;
    const fst_run_result at_once = run_of(&p);
    expect_regime(&at_once, FST_REGIME_LIFTED);
    assert_true(at_once.end_time == 0);
    p = bead_at(1.0, FST_DYNAMICS_RIGID);
    p.friction_law = FST_FRICTION_NONE;
    p.start_r = 0.5;
    const fst_run_result r = run_of(&p);
    expect_regime(&r, FST_REGIME_LIFTED);
    CHECK_CLOSE(r.periods, 9.3247, 1e-3);
    fst_model *model = model_of(&p);
    CHECK_CLOSE(fst_observe(model, r.final_state).load, 0, 1e-14);
    fst_model_free(model);
}

/* Without gravity no load in units of the weight exists, but the run does. */
static void test_no_gravity(void **unused)
{
    (void)unused;
    fst_params p = bead_at(0.405, FST_DYNAMICS_RIGID);
    p.plate_gravity = 0;
    p.run_periods = 60;
    p.run_discard = 40;
    const fst_run_result r = run_of(&p);
    assert_true(isnan(r.mean_load_weights) && isnan(r.min_load_weights));
    CHECK_WITHIN(r.mean_r, 0.85, 0.95);
}

/* ------------------------------------------------------------------ never guessed */

/* Two drive periods or fewer are too short to tell, whatever the motion. */
static void test_too_short(void **unused)
{
    (void)unused;
    static const double lengths[] = {0.1, 1, 1.5, 1.999};
    static const double drives[] = {0.0825, 0.12, 0.21, 0.405};
    for (int i = 0; i < 4; ++i)
        for (int k = 0; k < 4; ++k) {
            fst_params p = bead_at(drives[k], FST_DYNAMICS_RIGID);
            p.run_discard = 0;
            p.run_periods = lengths[i];
            const fst_run_result r = run_of(&p);
            expect_regime(&r, FST_REGIME_UNDECIDED);
            p.run_discard = 3;
            p.run_periods = 3 + lengths[i];
            const fst_run_result late = run_of(&p);
            expect_regime(&late, FST_REGIME_UNDECIDED);
        }
}

/* A bead that turns a few times and is then caught does not counter-rotate. */
static void test_transient_turns(void **unused)
{
    (void)unused;
    static const double drives[] = {0.10, 0.15};
    for (int i = 0; i < 2; ++i)
        for (int length = 0; length < 2; ++length) {
            fst_params p = bead_at(drives[i], FST_DYNAMICS_RIGID);
            p.start_r = 1.3;
            p.start_phi = 90;
            p.run_discard = 0;
            p.run_periods = length == 0 ? 15 : 60;
            const fst_run_result r = run_of(&p);
            if (r.regime == FST_REGIME_COUNTER_ROTATING || r.regime == FST_REGIME_COROTATING)
                fail_msg("omega %g, %g periods: %s (%s)", drives[i], p.run_periods, fst_regime_name(r.regime),
                         r.reason);
        }
}

/* The noise of a loose tolerance is not a libration. */
static void test_loose_tolerance(void **unused)
{
    (void)unused;
    for (double tolerance = 1e-4; tolerance > 1e-9; tolerance /= 10) {
        fst_params p = bead_at(0.0825, FST_DYNAMICS_RIGID);
        p.run_rtol = tolerance;
        p.run_periods = 150;
        p.run_discard = 100;
        const fst_run_result r = run_of(&p);
        if (r.regime != FST_REGIME_LOCKED && r.regime != FST_REGIME_UNDECIDED)
            fail_msg("rtol %g: %s (%s)", tolerance, fst_regime_name(r.regime), r.reason);
    }
}

/* A paramagnetic bead that the magnet holds still is locked, however its n turns with W: nothing acts on n. */
static void test_locked_paramagnet(void **unused)
{
    (void)unused;
    fst_params p = bead_at(0.2, FST_DYNAMICS_RIGID);
    p.bead_material = FST_MATERIAL_PARAMAGNETIC;
    p.bead_a = 2e-2;
    p.run_periods = 150;
    p.run_discard = 100;
    const fst_run_result r = run_of(&p);
    expect_regime(&r, FST_REGIME_LOCKED);
    CHECK_CLOSE(r.std_r, 0, 1e-7);
}

/* Without a field the bead stays at rest in the laboratory: it rotates neither way. */
static void test_no_field(void **unused)
{
    (void)unused;
    fst_params p = bead_at(0.3, FST_DYNAMICS_RIGID);
    p.model_kappa = 0;
    p.start_spin = FST_SPIN_REST;
    const fst_run_result r = run_of(&p);
    CHECK_CLOSE(r.mean_alpha_dot, 0, 1e-9);
    expect_regime(&r, FST_REGIME_UNDECIDED);
}

/* On the axis the bead balances for a while, in an unstable equilibrium. Falling off it is not chaos. */
static void test_balanced_on_the_axis(void **unused)
{
    (void)unused;
    fst_params p = bead_at(0.405, FST_DYNAMICS_RIGID);
    p.start_r = 0;
    p.start_spin = FST_SPIN_REST;
    p.run_periods = 100;
    p.run_discard = 20;
    assert_int_not_equal(run_of(&p).regime, FST_REGIME_CHAOTIC);
    /* over a block the moment swings as a pendulum for ever, and beads beside this one leave the axis */
    static const char *const block[][2] = {
        {"magnet.shape", "parts"},
        {"magnet.parts[0].kind", "cuboid"},
        {"bead.remanence", "1.15 T"},
        {"magnet.parts[0].size[0]", "44 mm"},
        {"bead.radius", "1.8 mm"},
        {"magnet.parts[0].size[1]", "24 mm"},
        {"bead.density", "7450 kg/m^3"},
        {"magnet.parts[0].size[2]", "7 mm"},
        {"magnet.depth", "13 mm"},
        {"magnet.parts[0].remanence[0]", "0.9 T"},
        {"drive.frequency", "14 Hz"},
        {"run.discard", "10"},
        {"run.periods", "40"},
        {"start.spin", "rest"},
        {"start.r", "0"},
    };
    p = fst_default_params();
    for (size_t i = 0; i < sizeof block / sizeof *block; ++i)
        assert_int_equal(fst_params_set(&p, block[i][0], block[i][1], NULL), FST_OK);
    const fst_run_result r = run_of(&p);
    expect_regime(&r, FST_REGIME_UNDECIDED);
    assert_non_null(strstr(r.reason, "the bead stays on the axis"));
    assert_true(r.mean_r == 0 && r.std_r == 0);
}

/* Close to the period halving <n_z> takes longer than the run to settle. No regime is claimed, and no error of
 * the means: their limit is known here alone, where <n_z> is 0 above the halving at 0.26885. */
static void test_near_the_period_halving(void **unused)
{
    (void)unused;
    static const double drives[] = {0.2690, 0.2720};
    for (int i = 0; i < 2; ++i) {
        fst_params p = bead_at(drives[i], FST_DYNAMICS_RIGID);
        const fst_run_result r = run_of(&p);
        expect_regime(&r, FST_REGIME_UNDECIDED);
        assert_int_equal(r.symmetry, FST_SYMMETRY_NONE);
        assert_true(isnan(r.festoons) && isnan(r.period));
        assert_non_null(strstr(r.reason, "still drifts: <n_z>"));
        assert_true(fabs(r.mean_nz) > 1e-4 && isnan(r.mean_nz_error) && isnan(r.mean_r_error));
    }
}

/* The number of festoons is told where the symmetry is; until then the reason has both readings. */
static void test_festoons_of_a_known_symmetry(void **unused)
{
    (void)unused;
    static const double discards[] = {100, 1000};
    double festoons = NAN;
    char first[256] = "", both[64];
    for (int i = 0; i < 2; ++i) {
        fst_params p = fst_default_params();
        p.drive_frequency = 14;
        p.run_discard = discards[i];
        p.run_periods = discards[i] + 60;
        const fst_run_result r = run_of(&p);
        expect_regime(&r, FST_REGIME_COUNTER_ROTATING);
        assert_int_equal(r.symmetry, i ? FST_SYMMETRY_S2 : FST_SYMMETRY_NONE);
        assert_true(isnan(r.festoons) == (r.symmetry == FST_SYMMETRY_NONE));
        assert_true(isfinite(r.period));
        if (i == 0)
            (void)snprintf(first, sizeof first, "%s", r.reason);
        festoons = r.festoons;
    }
    (void)snprintf(both, sizeof both, "; festoons: %.4g, or %.4g if S2", 0.5 * festoons, festoons);
    if (!strstr(first, both) || first[strlen(first) - 1] != '2')
        fail_msg("\"%s\" lacks \"%s\"", first, both);
}

/* Maxima of r beyond `above`, and the angles alpha at the first and the last of them. */
typedef struct counted {
    double above, r[2], alpha, first, last;
    int samples, maxima;
} counted;

static fst_status count_maxima(void *user, const fst_sample *sample, fst_error *error)
{
    counted *c = user;
    const double r = hypot(sample->x, sample->y);
    (void)error;
    if (c->samples > 1 && c->r[1] > c->above && c->r[1] > c->r[0] && c->r[1] >= r) {
        c->first = c->maxima++ ? c->first : c->alpha;
        c->last = c->alpha;
    }
    c->r[0] = c->r[1];
    c->r[1] = r;
    c->alpha = sample->alpha;
    ++c->samples;
    return FST_OK;
}

/* In either sense and either symmetry a bead draws as many festoons a lap as r has maxima. */
static void test_festoons_are_counted(void **unused)
{
    (void)unused;
    static const struct {
        double depth, hertz;
        int own;
        double above; /* l; of the two maxima of a swing one is higher */
        fst_regime regime;
        fst_symmetry symmetry;
    } runs[] = {{8.0, 9.0, 0, 0.0, FST_REGIME_COROTATING, FST_SYMMETRY_S2},
                {10.0, 11.0, 1, 1.15, FST_REGIME_COROTATING, FST_SYMMETRY_S1},
                {16.2, 19.9, 0, 0.0, FST_REGIME_COUNTER_ROTATING, FST_SYMMETRY_S2},
                {16.2, 10.7, 0, 0.0, FST_REGIME_COUNTER_ROTATING, FST_SYMMETRY_S1}};
    for (size_t i = 0; i < sizeof runs / sizeof *runs; ++i) {
        fst_params p = fst_default_params();
        fst_run_options options = fst_default_run_options();
        fst_run_result r;
        counted c = {.above = runs[i].above};
        if (runs[i].own) {
            p.bead_radius = 3.1e-3;
            p.bead_mass = 0.9e-3;
            p.model_kappa = 1.1;
        }
        p.magnet_depth = 1e-3 * runs[i].depth;
        p.drive_frequency = runs[i].hertz;
        options.sink.user = &c;
        options.sink.sample = count_maxima;
        options.sample_from = p.run_discard;
        assert_int_equal(fst_run(&p, &options, &r, NULL), FST_OK);
        expect_regime(&r, runs[i].regime);
        assert_int_equal(r.symmetry, runs[i].symmetry);
        assert_true(c.maxima > 50);
        CHECK_CLOSE(fabs(r.festoons * (c.last - c.first) / (8.0 * atan(1.0))), c.maxima - 1, 0.1);
    }
}

/* Beyond the end of its branch at 168.58 Hz counter-rotation lingers for thousands of turns, in ever wider
 * circles. */
static void test_slowly_lost(void **unused)
{
    (void)unused;
    fst_params p = fst_default_params();
    for (p.drive_frequency = 170; p.drive_frequency < 215; p.drive_frequency += 15)
        for (int dynamics = 0; dynamics < 2; ++dynamics) {
            p.model_dynamics = dynamics;
            const fst_run_result r = run_of(&p);
            if (r.regime == FST_REGIME_EJECTED)
                continue;
            expect_regime(&r, FST_REGIME_UNDECIDED);
            assert_true(isnan(r.festoons) && isnan(r.period));
            assert_non_null(strstr(r.reason, " drift"));
            assert_non_null(strstr(r.reason, "raise run.periods"));
        }
    p.model_dynamics = FST_DYNAMICS_RIGID;
    p.drive_frequency = 150;
    const fst_run_result before = run_of(&p);
    expect_regime(&before, FST_REGIME_COUNTER_ROTATING);
}

/* The regime does not depend on the tolerance: with a loose one an equilibrium jitters by the integrator's
 * noise, and is an equilibrium all the same. */
static void test_same_regimes_at_any_tolerance(void **unused)
{
    (void)unused;
    static const double tolerances[] = {1e-10, 1e-8, 1e-6};
    int locked = 0, librating = 0, turning = 0;
    for (int i = 0; i < 12; ++i) {
        fst_params p = bead_at(0.02 + 0.03 * i, FST_DYNAMICS_RIGID);
        fst_regime expected = FST_REGIME_UNDECIDED;
        for (size_t k = 0; k < sizeof tolerances / sizeof *tolerances; ++k) {
            p.run_rtol = tolerances[k];
            const fst_run_result r = run_of(&p);
            if (k == 0)
                expected = r.regime;
            expect_regime(&r, expected);
        }
        locked += expected == FST_REGIME_LOCKED;
        librating += expected == FST_REGIME_LIBRATING;
        turning += expected == FST_REGIME_COUNTER_ROTATING;
    }
    assert_int_equal(locked + librating + turning, 12);
    assert_true(locked >= 4 && librating >= 2 && turning >= 5);
}

/* Just above a Hopf point the locked state is unstable: the bead leaves it from a distance so small that its
 * speed cannot be told from rest. Just below it is stable. */
static void test_leaving_a_locked_state(void **unused)
{
    (void)unused;
    const double hopf[] = {0.092106345, 0.098864612}; /* docs/orbits.md */
    const double above[] = {1e-5, 2e-5, 3e-5};
    for (int dynamics = 0; dynamics < 2; ++dynamics) {
        for (size_t i = 0; i < sizeof above / sizeof *above; ++i) {
            fst_params p = bead_at(hopf[dynamics] + above[i], (fst_dynamics)dynamics);
            p.run_periods = i == 0 && dynamics ? 1200 : 400;
            p.run_discard = 0.5 * p.run_periods;
            const fst_run_result r = run_of(&p);
            expect_regime(&r, FST_REGIME_UNDECIDED);
            assert_true(strstr(r.reason, "grows") || strstr(r.reason, "drifts"));
        }
        fst_params p = bead_at(hopf[dynamics] - 3e-5, (fst_dynamics)dynamics);
        p.run_periods = 400;
        p.run_discard = 200;
        const fst_run_result r = run_of(&p);
        expect_regime(&r, FST_REGIME_LOCKED);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_same_regimes_at_any_tolerance),
        cmocka_unit_test(test_locked),
        cmocka_unit_test(test_locked_from_rest),
        cmocka_unit_test(test_locked_by_any_strong_magnet),
        cmocka_unit_test(test_small_librations),
        cmocka_unit_test(test_librating),
        cmocka_unit_test(test_chaotic),
        cmocka_unit_test(test_ejected),
        cmocka_unit_test(test_lifted),
        cmocka_unit_test(test_no_gravity),
        cmocka_unit_test(test_too_short),
        cmocka_unit_test(test_transient_turns),
        cmocka_unit_test(test_loose_tolerance),
        cmocka_unit_test(test_locked_paramagnet),
        cmocka_unit_test(test_no_field),
        cmocka_unit_test(test_balanced_on_the_axis),
        cmocka_unit_test(test_near_the_period_halving),
        cmocka_unit_test(test_festoons_of_a_known_symmetry),
        cmocka_unit_test(test_festoons_are_counted),
        cmocka_unit_test(test_slowly_lost),
        cmocka_unit_test(test_leaving_a_locked_state),
    };
    return cmocka_run_group_tests_name("regimes", tests, NULL, NULL);
}
