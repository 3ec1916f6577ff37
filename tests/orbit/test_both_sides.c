/* Direct simulation on both sides of every special point of the complete branches: a small disturbance of the
 * state grows or decays along the critical direction as its eigenvalue or multiplier says, stable on one side
 * and not on the other; and where something attracts, a run ends where it must.
 * tests: orbit/special.c orbit/spectrum.c
 * labels: long */
#include "branches.h"

#include "orbit/solution.h"

/* ------------------------------------------------------------------ growth */

static fst_family family_over_omega(void)
{
    const fst_params params = scene_of(0.15, "rigid");
    fst_family family;
    fst_error error;
    if (fst_family_begin(&family, &params, "drive.omega", &error) != FST_OK)
        fail_msg("%s", error.sentence);
    return family;
}

/* The solution at a point of a branch, found again from its state, with its eigenvalues or multipliers. */
static fst_solution solution_of(const fst_family *family, const fst_branch_point *p)
{
    fst_solution s;
    fst_error error;
    memset(&s, 0, sizeof s);
    s.value = p->value;
    memcpy(s.y[0], p->state, sizeof s.y[0]);
    if (p->multipliers == FST_MULTIPLIER_COUNT) {
        s.symmetric = p->symmetry == FST_SYMMETRY_S2;
        s.period = p->period * (s.symmetric ? 0.5 : 1.0);
        assert_int_equal(fst_solution_chain(family, &s, 4, &error), FST_OK);
    }
    if (fst_solution_correct(family, &s, NULL, &error) != FST_OK)
        fail_msg("%s", error.sentence);
    assert_int_equal(fst_solution_spectrum(family, &s, NULL), FST_OK);
    return s;
}

/* Distance of an eigenvalue from the border that this type of special point crosses; of a pair only the upper
 * one counts. */
static double from_border(const fst_solution *s, int i, fst_special_type type)
{
    const double re = s->re[i], im = s->im[i];
    const int orbit = s->segments > 0;
    switch (type) {
    case FST_SPECIAL_HOPF: /* two pairs lie on the axis here, and one of them never leaves it */
        return im > 1e-6 && fabs(re) > 1e-12 ? fabs(re) : INFINITY;
    case FST_SPECIAL_NEIMARK_SACKER:
        return im > 1e-6 ? fabs(hypot(re, im) - 1.0) : INFINITY;
    case FST_SPECIAL_PITCHFORK:
        return hypot(re - (orbit ? -1.0 : 0.0), im);
    default:
        return hypot(re - (orbit ? 1.0 : 0.0), im);
    }
}

static int critical(const fst_solution *s, fst_special_type type)
{
    int best = 0;
    for (int i = 1; i < s->multipliers; ++i)
        if (from_border(s, i, type) < from_border(s, best, type))
            best = i;
    return best;
}

/* The logarithm of an eigenvalue's growth: its real part, or that of a multiplier's logarithm. */
static double growth_of(const fst_solution *s, int i)
{
    return s->segments > 0 ? log(hypot(s->re[i], s->im[i])) : s->re[i];
}

/* The left eigenvector that belongs to it, as a functional of states. */
static void left_eigenvector(const fst_family *family, const fst_solution *s, int which,
                             double part[2][FST_STATE_SIZE])
{
    enum { MOST = FST_TANGENT_SIZE };
    const int n = s->multipliers, first = MOST - n;
    double matrix[MOST * MOST], turned[MOST * MOST], basis[FST_STATE_SIZE][MOST], re[MOST], im[MOST],
        left[MOST * MOST];
    int best = 0;
    assert_int_equal(fst_solution_section(family, s, matrix, basis, NULL), FST_OK);
    for (int i = 0; i < n; ++i)
        for (int j = 0; j < n; ++j)
            turned[i * n + j] = matrix[j * n + i];
    assert_int_equal(family->lapack->eigen(n, turned, re, im, left), 0);
    for (int i = 1; i < n; ++i)
        if (hypot(re[i] - s->re[which], im[i] - s->im[which]) <
            hypot(re[best] - s->re[which], im[best] - s->im[which]))
            best = i;
    for (int k = 0; k < FST_STATE_SIZE; ++k) {
        part[0][k] = part[1][k] = 0.0;
        for (int i = 0; i < n; ++i) {
            part[0][k] += basis[k][i + first] * left[i * n + best];
            if (im[best] != 0.0)
                part[1][k] += basis[k][i + first] * left[i * n + best + 1];
        }
    }
}

static void simulated(double omega, const double *from, double time, int image, double *to)
{
    const fst_params params = scene_of(omega, "rigid");
    fst_flow_options options = fst_default_flow_options();
    fst_model *model;
    fst_flow *flow;
    fst_stop stop;
    options.rtol = 1e-13;
    for (int i = 0; i < FST_STATE_SIZE; ++i)
        options.atol[i] = 1e-14;
    assert_int_equal(fst_model_new(&params, &model, NULL), FST_OK);
    assert_int_equal(fst_flow_new(model, &options, from, &flow, NULL), FST_OK);
    assert_int_equal(fst_flow_next(flow, time, 0, &stop, NULL), FST_OK);
    memcpy(to, fst_flow_get(flow).state, FST_STATE_SIZE * sizeof *to);
    if (image)
        fst_apply_s2(to, to);
    fst_flow_free(flow);
    fst_model_free(model);
}

/* Two states are displaced along the critical direction, to either side, and followed. Half of their difference
 * is measured with the left eigenvector before and after: the result is the logarithm of its growth. */
static double simulated_growth(const fst_family *family, const fst_solution *s, int which, double time)
{
    const double small = 3e-6;
    double direction[FST_STATE_SIZE], imaginary[FST_STATE_SIZE], left[2][FST_STATE_SIZE],
        end[2][FST_STATE_SIZE];
    double before[2] = {0, 0}, after[2] = {0, 0};
    assert_int_equal(
        fst_solution_eigenvector(family, s, s->re[which], s->im[which], direction, imaginary, NULL), FST_OK);
    left_eigenvector(family, s, which, left);
    for (int side = 0; side < 2; ++side) {
        double start[FST_STATE_SIZE];
        for (int k = 0; k < FST_STATE_SIZE; ++k)
            start[k] = s->y[0][k] + (side ? -small : small) * direction[k];
        simulated(s->value, start, time, s->symmetric, end[side]);
    }
    for (int k = 0; k < FST_STATE_SIZE; ++k)
        for (int part = 0; part < 2; ++part) {
            before[part] += left[part][k] * small * direction[k];
            after[part] += left[part][k] * 0.5 * (end[0][k] - end[1][k]);
        }
    return log(hypot(after[0], after[1]) / hypot(before[0], before[1]));
}

/* The two points of a branch between which a special point lies; at a fold, its neighbours on either side of
 * the turning point. A Hopf point may have been found on the branch of the orbits: then the branch of the
 * equilibria is taken. */
static int neighbours(const fst_branch *b, const fst_special *at, const fst_branch_point *found[2])
{
    double least = INFINITY;
    for (size_t i = 1; i + 1 < b->point_count; ++i) {
        const fst_branch_point *p = &b->points[i - 1], *q = p + 1, *r = q + 1;
        if (p->branch != q->branch ||
            (at->type == FST_SPECIAL_HOPF ? p->multipliers != FST_EIGENVALUE_COUNT : p->branch != at->branch))
            continue;
        const int turns = r->branch == q->branch && (q->value > p->value) != (r->value > q->value);
        const int between = (p->value < at->value) != (q->value < at->value);
        const double off = fabs(q->mean_r - at->at.mean_r) + fabs(q->value - at->value);
        if (at->type == FST_SPECIAL_FOLD ? !turns : !between)
            continue;
        if (off < least) {
            least = off;
            found[0] = p;
            found[1] = at->type == FST_SPECIAL_FOLD ? r : q;
        }
    }
    return least < 0.05;
}

static void disturbances_grow_on_one_side(void **state)
{
    (void)state;
    const fst_params params = scene_of(0.3, "rigid");
    const fst_family family = family_over_omega();
    fst_branch_options o = over_omega(FST_BRANCH_ALL, 0.02, 5.0);
    o.longest_step = 0.1;
    fst_branch b = followed(&params, &o);
    int seen = 0;
    for (size_t i = 0; i < b.special_count; ++i) {
        const fst_special *at = &b.specials[i];
        const fst_branch_point *beside[2];
        double growth[2];
        if (at->type == FST_SPECIAL_ORIGIN_CROSSING)
            continue;
        if (!neighbours(&b, at, beside))
            fail_msg("no points beside the %s at %.10g", fst_special_name(at->type), at->value);
        for (int side = 0; side < 2; ++side) {
            const fst_solution s = solution_of(&family, beside[side]);
            const int which = critical(&s, at->type);
            double greatest = 0.3;
            for (int k = 0; k < s.multipliers && s.segments == 0; ++k)
                greatest = fmax(greatest, s.re[k]);
            const double time = s.segments > 0 ? s.period : 8.0 / greatest;
            const double wanted = growth_of(&s, which) * (s.segments > 0 ? 1.0 : time);
            growth[side] = simulated_growth(&family, &s, which, time);
            CHECK_CLOSE(growth[side] / wanted, 1.0, 1e-3);
        }
        if ((growth[0] > 0) == (growth[1] > 0))
            fail_msg("the %s at %.10g changes nothing: %g and %g", fst_special_name(at->type), at->value,
                     growth[0], growth[1]);
        seen += 1;
    }
    assert_int_equal(seen, 17); /* all but the origin crossing, which the runs below cover */
    fst_branch_free(&b);
}

/* ------------------------------------------------------------------ attractors */

/* A run from the default start, or from another r. */
static fst_run_result run_at(double omega, double r)
{
    fst_params params = scene_of(omega, "rigid");
    const fst_run_options options = fst_default_run_options();
    fst_run_result result;
    if (r > 0)
        params.start_r = r;
    params.run_periods = 900;
    params.run_discard = 800;
    assert_int_equal(fst_run(&params, &options, &result, NULL), FST_OK);
    return result;
}

/* Where runs from the default start end beside the special points that the attractors meet. */
static void runs_end_where_they_must(void **state)
{
    (void)state;
    static const struct {
        double omega;
        fst_regime below, above;
        double distance;
    } cases[] = {
        {0.0921063452, FST_REGIME_LOCKED, FST_REGIME_LIBRATING, 0.0015}, /* Hopf: the main locked state */
        {0.1526366306, FST_REGIME_LOCKED, FST_REGIME_LIBRATING, 0.0015}, /* Hopf: the second one */
        {0.1788911589, FST_REGIME_LIBRATING, FST_REGIME_COUNTER_ROTATING, 0.0005}, /* origin crossing */
    };
    for (size_t k = 0; k < sizeof cases / sizeof *cases; ++k) {
        assert_int_equal(run_at(cases[k].omega - cases[k].distance, 0).regime, cases[k].below);
        assert_int_equal(run_at(cases[k].omega + cases[k].distance, 0).regime, cases[k].above);
    }
}

/* The period halving: mean n_z vanishes above, and grows with the root of the distance below. */
static void the_period_halving_is_seen_in_runs(void **state)
{
    (void)state;
    const double halving = 0.26885303399, near = fabs(run_at(halving - 0.004, 0).mean_nz),
                 far = fabs(run_at(halving - 0.016, 0).mean_nz);
    assert_true(near > 0.03);
    CHECK_CLOSE(far / near, 2.0, 0.1);
    assert_true(fabs(run_at(halving + 0.006, 0).mean_nz) < 1e-6);
}

static const fst_branch_point *nearest_stable(const fst_branch *b, double value, double r, int multipliers)
{
    const fst_branch_point *best = NULL;
    for (size_t i = 0; i < b->point_count; ++i) {
        const fst_branch_point *p = &b->points[i];
        if (p->stable && p->multipliers == multipliers && fabs(p->mean_r - r) < 0.2 &&
            (!best || fabs(p->value - value) < fabs(best->value - value)))
            best = p;
    }
    assert_non_null(best);
    return best;
}

/* |d(state)/dt|: zero where the bead follows the magnet. */
static double speed_at(double omega, const double *state)
{
    const fst_params params = scene_of(omega, "rigid");
    fst_model *model;
    double rate[FST_STATE_SIZE], sum = 0.0;
    assert_int_equal(fst_model_new(&params, &model, NULL), FST_OK);
    fst_rhs(model, state, rate);
    fst_model_free(model);
    for (int i = 0; i < FST_STATE_SIZE; ++i)
        sum += rate[i] * rate[i];
    return sqrt(sum);
}

/* The second locked state exists only above its fold: a bead set on it stays there above the fold, and leaves
 * below. */
static void the_second_locked_state_appears_at_its_fold(void **state)
{
    (void)state;
    const fst_params params = scene_of(0.128, "rigid");
    const fst_branch_options o = over_omega(FST_BRANCH_LOCKED, 0.1277, 0.1279);
    fst_branch b = followed(&params, &o);
    const fst_branch_point *p = nearest_stable(&b, 0.12776, 0.8, FST_EIGENVALUE_COUNT);
    double above[FST_STATE_SIZE], below[FST_STATE_SIZE];
    simulated(0.127746588 + 2e-4, p->state, 8000.0, 0, above);
    simulated(0.127746588 - 2e-4, p->state, 8000.0, 0, below);
    CHECK_CLOSE(hypot(above[FST_X], above[FST_Y]), 0.79, 0.02);
    CHECK_CLOSE(speed_at(0.127746588 + 2e-4, above), 0.0, 1e-6);
    assert_true(speed_at(0.127746588 - 2e-4, below) > 1e-3);
    fst_branch_free(&b);
}

/* The libration keeps a bead that is set on it below its Neimark-Sacker point, at any time; above, the bead
 * leaves it and ends in the second locked state. */
static void the_libration_ends_at_its_neimark_sacker_point(void **state)
{
    (void)state;
    const fst_params params = scene_of(0.129, "rigid");
    fst_branch_options o = over_omega(FST_BRANCH_ALL, 0.1285, 0.1305);
    fst_branch b = followed(&params, &o);
    const double at = special_near(&b, FST_SPECIAL_NEIMARK_SACKER, 0.129014691545)->value;
    const fst_branch_point *p = nearest_stable(&b, at, 0.9, FST_MULTIPLIER_COUNT);
    double below[FST_STATE_SIZE], above[FST_STATE_SIZE];
    simulated(at - 5e-4, p->state, 60000.0, 0, below);
    simulated(at + 5e-4, p->state, 60000.0, 0, above);
    assert_true(speed_at(at - 5e-4, below) > 1e-3);
    CHECK_CLOSE(speed_at(at + 5e-4, above), 0.0, 1e-6);
    CHECK_CLOSE(hypot(above[FST_X], above[FST_Y]), 0.77, 0.03);
    fst_branch_free(&b);
}

/* The upper end: a bead set on the orbit stays below the fold, and is lost beyond. */
static void counter_rotation_ends_at_the_upper_fold(void **state)
{
    (void)state;
    const fst_params params = scene_of(3.3, "rigid");
    const fst_branch_options o = over_omega(FST_BRANCH_COUNTER, 3.2, 3.6);
    fst_branch b = followed(&params, &o);
    const double fold = special_near(&b, FST_SPECIAL_FOLD, 3.38951025245)->value;
    const fst_branch_point *p = nearest_stable(&b, fold - 0.02, 2.54, FST_MULTIPLIER_COUNT);
    double below[FST_STATE_SIZE], beyond[FST_STATE_SIZE];
    simulated(fold - 0.02, p->state, 3000.0, 0, below);
    simulated(fold + 0.03, p->state, 20000.0, 0, beyond);
    CHECK_CLOSE(hypot(below[FST_X], below[FST_Y]), p->mean_r, 0.1);
    assert_true(hypot(beyond[FST_X], beyond[FST_Y]) > 4.0);
    fst_branch_free(&b);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(disturbances_grow_on_one_side),
        cmocka_unit_test(runs_end_where_they_must),
        cmocka_unit_test(the_period_halving_is_seen_in_runs),
        cmocka_unit_test(the_second_locked_state_appears_at_its_fold),
        cmocka_unit_test(the_libration_ends_at_its_neimark_sacker_point),
        cmocka_unit_test(counter_rotation_ends_at_the_upper_fold),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
