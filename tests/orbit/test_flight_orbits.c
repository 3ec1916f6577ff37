/* Orbits on which the bead flies, or a disc of contact is held: multipliers against the eigenvalues of the return by central differences of the
 * flow; branches from orbits that stay on the plate to orbits that do not; exponents of two programs,
 * and of runs beside each other.
 * tests: orbit/dry_carry.c ode/neighbours.c orbit/spectrum.c orbit/curve.c study/exponent.c orbit/lyapunov.c */
#include "branches.h"
#include "physics.h"

#include <string.h>

#include "ode/flight.h"
#include "orbit/describe.h"
#include "orbit/search.h"
#include "study/exponent.h"

static fst_params flying(double mu, double restitution, double hertz)
{
    fst_params params = fst_default_params();
    params.friction_law = FST_FRICTION_COULOMB;
    params.friction_mu = mu;
    params.impact_restitution = restitution;
    params.drive_frequency = hertz;
    return params;
}

/* Guesses, from branches over the drive. */
typedef struct guess {
    double mu, restitution, hertz;
    int symmetric, flights;
    double period; /* of the whole orbit */
    double state[FST_STATE_SIZE];
} guess;

static const guess GUESSES[] = {
    {0.1,
     0.0,
     79.9859,
     0,
     1,
     4.170737,
     {0, 1.4133912, -0.1574617, -0.005229, -0.1821267, -0.9628414, 0.1994109, -2.6281585, 1.1399177,
      -2.9918984}},
    {0.1,
     0.0,
     90.7638,
     1,
     2,
     3.542633,
     {1.0214562, 0.2127376, 0.0064963, 0.0456239, 0.2476305, -0.8786286, 0.408278, 1.1179365, -1.1207532,
      -3.0585796}},
    {0.05,
     0.3,
     94.4214,
     0,
     1,
     6.201686,
     {0, 1.1453763, 0.161821, -0.0064303, -0.8303022, 0.5336579, 0.1606473, -0.7333838, -0.3212419, 2.5930643}},
    {0.1,
     0.5,
     89.8193,
     1,
     2,
     3.598032,
     {1.0316937, 0.2215947, 0.0042795, 0.0534906, 0.1902389, -0.8751759, 0.4448328, 0.8757015, -1.2536019,
      -2.8049367}},
    {0.2,
     0.7,
     87.44952,
     1,
     2,
     3.702623,
     {0.0976273, 1.0440339, -0.083679, 0.0067935, -0.5075068, -0.5177271, -0.6887637, -1.2425026, 4.0544262,
      -2.3039083}},
};

/* The state after one chain of the orbit, from `state`, in the basis at its first state. */
static void go_round(const fst_solution *s, const fst_family *family, const double *state,
                     double basis[FST_STATE_SIZE][FST_TANGENT_SIZE], double *part)
{
    fst_model *model;
    fst_flow *flow;
    fst_error error;
    double y[FST_STATE_SIZE];
    if (fst_solution_flow(family, s->value, state, 1e-13, &model, &flow, &error) != FST_OK ||
        fst_solution_advance(family, flow, s->period, &error) != FST_OK)
        fail_msg("%s", error.sentence);
    memcpy(y, flow->step.end, sizeof y);
    fst_flow_free(flow);
    fst_model_free(model);
    if (s->symmetric)
        fst_apply_s2(y, y);
    fst_tangent_part(basis, y, part);
}

/* The eigenvalues of the return by differences of fourth order; one of them is that of the flow direction. */
static void by_differences(const fst_solution *s, const fst_family *family, double *re, double *im)
{
    static const double weight[4] = {1.0 / 12.0, -8.0 / 12.0, 8.0 / 12.0, -1.0 / 12.0}, at[4] = {-2, -1, 1, 2};
    const double h = 3e-5;
    double basis[FST_STATE_SIZE][FST_TANGENT_SIZE], matrix[FST_TANGENT_SIZE * FST_TANGENT_SIZE] = {0.0};
    fst_tangent_basis(s->y[0], basis);
    for (int c = 0; c < FST_TANGENT_SIZE; ++c)
        for (int k = 0; k < 4; ++k) {
            double y[FST_STATE_SIZE], part[FST_TANGENT_SIZE];
            for (int i = 0; i < FST_STATE_SIZE; ++i)
                y[i] = s->y[0][i] + at[k] * h * basis[i][c];
            go_round(s, family, y, basis, part);
            for (int j = 0; j < FST_TANGENT_SIZE; ++j)
                matrix[j * FST_TANGENT_SIZE + c] += weight[k] * part[j] / h;
        }
    assert_int_equal(family->lapack->eigen(FST_TANGENT_SIZE, matrix, re, im, NULL), 0);
}

static void orbit_from(const guess *g, double restitution, fst_family *family, fst_solution *s)
{
    const fst_params params = flying(g->mu, restitution, g->hertz);
    fst_error error;
    if (fst_family_begin(family, &params, NULL, &error) != FST_OK)
        fail_msg("%s", error.sentence);
    memset(s, 0, sizeof *s);
    memcpy(s->y[0], g->state, sizeof s->y[0]);
    const double *n = s->y[0] + FST_NX, length = sqrt(n[0] * n[0] + n[1] * n[1] + n[2] * n[2]);
    for (int i = FST_NX; i <= FST_NZ; ++i)
        s->y[0][i] /= length;
    s->symmetric = g->symmetric;
    s->period = g->symmetric ? 0.5 * g->period : g->period;
    if (fst_solution_chain(family, s, 1, &error) != FST_OK ||
        fst_solution_correct(family, s, NULL, &error) != FST_OK ||
        fst_solution_spectrum(family, s, &error) != FST_OK)
        fail_msg("mu %g, e %g: %s", g->mu, restitution, error.sentence);
}

/* How far any multiplier is from the nearest eigenvalue. */
static double farthest(const fst_solution *s, const double *re, const double *im)
{
    double off = 0.0;
    for (int i = 0; i < s->multipliers; ++i) {
        double nearest = INFINITY;
        for (int j = 0; j < FST_TANGENT_SIZE; ++j)
            nearest = fmin(nearest, hypot(s->re[i] - re[j], s->im[i] - im[j]));
        off = fmax(off, nearest);
    }
    return off;
}

static void multipliers_against_differences(void **unused)
{
    (void)unused;
    for (size_t k = 0; k < sizeof GUESSES / sizeof *GUESSES; ++k)
        for (int more = 0; more < 2; ++more) {
            fst_family family;
            fst_solution s;
            fst_description d;
            fst_error error;
            double re[FST_TANGENT_SIZE], im[FST_TANGENT_SIZE];
            const double restitution = GUESSES[k].restitution + 0.01 * more;
            orbit_from(&GUESSES[k], restitution, &family, &s);
            if (fst_describe_orbit(&family, &s, 0, &d, &error) != FST_OK)
                fail_msg("%s", error.sentence);
            assert_int_equal(d.flights, GUESSES[k].flights);
            by_differences(&s, &family, re, im);
            const double off = farthest(&s, re, im);
            printf("mu %g, e %g, %g Hz: %d iterations, residual %.2g, trivial error %.2g, multipliers off by "
                   "%.2g\n",
                   GUESSES[k].mu, restitution, GUESSES[k].hertz, s.iterations, s.residual, s.trivial_error,
                   off);
            assert_true(off < 1e-7 && s.trivial_error < 1e-9);
        }
}

/* From an orbit that stays on the plate over the place where it begins to fly, and on to where the bead flies for
 * a third of the time, which the border of the range ends. */
static void branch_through_lift_off(void **unused)
{
    (void)unused;
    fst_params params = flying(0.1, 0.3, 80.0);
    fst_branch_options o = over_omega(FST_BRANCH_COUNTER, 75.0, 92.0);
    o.key = "drive.frequency";
    fst_branch branch = followed(&params, &o);
    const fst_special *grazing = special_near(&branch, FST_SPECIAL_GRAZING, 88.8279);
    int beyond = 0;
    for (size_t i = 0; i < branch.point_count; ++i) {
        const fst_branch_point *p = &branch.points[i];
        if (p->branch != 0 || p->value < 88.0)
            continue;
        fst_solution s = {.segments = 1, .symmetric = 1, .period = 0.5 * p->period, .value = p->value};
        fst_family family;
        fst_description d;
        fst_error error;
        memcpy(s.y[0], p->state, sizeof s.y[0]);
        if (fst_family_begin(&family, &params, "drive.frequency", &error) != FST_OK ||
            fst_describe_orbit(&family, &s, 0, &d, &error) != FST_OK)
            fail_msg("%s", error.sentence);
        assert_int_equal(d.flights, p->value > grazing->value ? 2 : 0);
        beyond += p->value == 92.0 && d.means.flying > 0.3;
    }
    assert_int_equal(beyond, 1);
    fst_branch_free(&branch);
}

/* The greatest exponent of a bead that hops chaotically: of one vector in the air and on the plate, and of nine
 * whose pieces end on the plate. */
static void exponents_of_hops(void **unused)
{
    (void)unused;
    fst_params params = flying(0.201652, 0.76637, 80.41717);
    fst_lyapunov l;
    fst_error error;
    params.plate_gravity = 44.58906;
    params.run_periods = 500;
    params.run_discard = 100;
    if (fst_lyapunov_find(&params, NULL, &l, &error) != FST_OK)
        fail_msg("%s", error.sentence);
    params.run_rtol = 1e-9;
    const fst_run_result run = run_of(&params);
    printf("exponents %.4g +- %.2g and %.4g +- %.2g, %.3g of the time in the air\n", l.exponents[0],
           l.errors[0], run.largest_exponent, run.largest_exponent_error, run.flying);
    assert_true(run.flying > 0.02 && run.largest_exponent > 0.02 && l.flow_direction >= 0);
    CHECK_CLOSE(l.exponents[0], run.largest_exponent, 3.0 * (l.errors[0] + run.largest_exponent_error));
    CHECK_CLOSE(l.exponents[l.flow_direction], 0.0, 4.0 * l.errors[l.flow_direction]);
}

/* ------------------------------------------------------------------ a bead that hardly ever stays on the plate */

enum { COLUMNS = FST_TANGENT_SIZE, ALOFT = FST_STATE_SIZE + 2 };

/* Make the differences orthonormal and add up the logarithms of what they had grown to. */
static void orthonormal(double d[COLUMNS][ALOFT], double *logarithms)
{
    for (int c = 0; c < COLUMNS; ++c) {
        for (int before = 0; before < c; ++before) {
            double along = 0.0;
            for (int i = 0; i < ALOFT; ++i)
                along += d[c][i] * d[before][i];
            for (int i = 0; i < ALOFT; ++i)
                d[c][i] -= along * d[before][i];
        }
        double square = 0.0;
        for (int i = 0; i < ALOFT; ++i)
            square += d[c][i] * d[c][i];
        for (int i = 0; i < ALOFT; ++i)
            d[c][i] /= sqrt(square);
        logarithms[c] += 0.5 * log(square);
    }
}

static void step_until(fst_flow *flow, double until)
{
    fst_error error;
    while (flow->t.high < until)
        if (fst_flow_step(flow, until, &error) != FST_OK)
            fail_msg("%s", error.sentence);
}

static int place_of(int i)
{
    return i < FST_STATE_SIZE ? i : i - FST_STATE_SIZE + FST_HEIGHT;
}

/* Nine runs beside the flow, put back near to it again and again.  No tangent knows of them. */
static void exponents_beside(fst_flow *flow, double aligned, double until, double *exponents)
{
    const double h = 1e-7, piece = 0.02;
    double d[COLUMNS][ALOFT];
    for (int c = 0; c < COLUMNS; ++c)
        for (int i = 0; i < ALOFT; ++i)
            d[c][i] = (i == c + (c > FST_NX) ? 1.0 : 0.0) + 0.3 * sin(1.0 + 7.0 * c + 3.0 * i);
    orthonormal(d, exponents);
    for (double start = flow->t.high, from = start; from < until; from += piece) {
        if (from < aligned)
            memset(exponents, 0, COLUMNS * sizeof *exponents);
        const fst_flow before = *flow;
        const int flies = fst_flight_is_on(flow);
        step_until(flow, from + piece);
        for (int c = 0; c < COLUMNS; ++c) {
            fst_flow other = before;
            for (int i = 0; i < (flies ? ALOFT : FST_STATE_SIZE); ++i)
                other.step.end[place_of(i)] += h * d[c][i];
            fst_bead_flow_restart(&other);
            step_until(&other, from + piece);
            for (int i = 0; i < ALOFT; ++i)
                d[c][i] = (other.step.end[place_of(i)] - flow->step.end[place_of(i)]) / h;
        }
        orthonormal(d, exponents);
    }
    for (int c = 0; c < COLUMNS; ++c)
        exponents[c] /= until - aligned;
}

/* In the air there are eleven directions, and a bead that comes down without staying loses none. */
static void exponents_of_one_that_hardly_lands(void **unused)
{
    (void)unused;
    fst_params params = flying(fst_default_params().friction_mu, 0.7, 350.0);
    fst_family family;
    fst_lyapunov l;
    fst_error error;
    fst_model *first = NULL, *model = NULL;
    fst_flow *flow = NULL;
    double start[FST_STATE_SIZE], exponents[COLUMNS] = {0.0};
    params.start_spin = FST_SPIN_REST;
    params.start_r = 0.6;
    params.model_kappa = 0.3;
    if (fst_lyapunov_find(&params, NULL, &l, &error) != FST_OK)
        fail_msg("%s", error.sentence);
    if (fst_family_begin(&family, &params, NULL, &error) != FST_OK ||
        fst_model_new(&params, &first, &error) != FST_OK ||
        fst_start_state(&params, first, start, &error) != FST_OK ||
        fst_solution_flow(&family, 0.0, start, 1e-12, &model, &flow, &error) != FST_OK)
        fail_msg("%s", error.sentence);
    const double period = FST_TWO_PI / model->groups.omega, from = fst_run_discard(&params) * period;
    step_until(flow, from);
    fst_exponent one = {.world = &model->world, .duration = 1.1 * l.time, .rtol = 1e-9}, *asked = &one;
    memcpy(one.state, start, sizeof start);
    if (fst_largest_exponents(NULL, &asked, 1, NULL, &error) != FST_OK)
        fail_msg("%s", error.sentence);
    exponents_beside(flow, from + 20.0 * period, from + 20.0 * period + l.time, exponents);
    printf("one vector: %.4g +- %.2g\n", one.value, one.standard_error);
    CHECK_CLOSE(l.exponents[0], one.value, 4.0 * (l.errors[0] + one.standard_error));
    for (int c = 0; c < COLUMNS; ++c) {
        printf("%d: %.4g +- %.2g, beside each other %.4g\n", c, l.exponents[c], l.errors[c], exponents[c]);
        CHECK_CLOSE(l.exponents[c], exponents[c], 4.0 * l.errors[c]);
    }
    fst_flow_free(flow);
    fst_model_free(model);
    fst_model_free(first);
}

/* A disc that is held loses slip and pivoting, three directions, and lets go when the push and torque on it ask for
 * it: multipliers over a return with both against differences. */
static void orbits_of_held_discs(void **unused)
{
    (void)unused;
    /* mu, mu_s, Hz, the disc's radius, or a modulus by which its radius follows the load */
    static const double cases[][5] = {{0.2, 0.24, 15.0, 3e-3, NAN},
                                      {0.5, 0.6, 15.0, 3e-3, NAN},
                                      {0.3, 0.4, 30.0, 4e-3, NAN},
                                      {0.5, 0.6, 15.0, NAN, 3e3},
                                      {0.2, 0.24, 15.0, NAN, 3e3}};
    for (size_t k = 0; k < sizeof cases / sizeof *cases; ++k) {
        fst_params params = flying(cases[k][0], NAN, cases[k][2]);
        fst_family family;
        fst_solution s;
        fst_description d;
        fst_orbit_outcome outcome;
        fst_error error;
        double re[FST_TANGENT_SIZE], im[FST_TANGENT_SIZE], greatest = 0.0;
        int lost = 0;
        params.friction_mu_static = cases[k][1];
        params.contact_patch = FST_PATCH_HERTZ;
        params.contact_radius = cases[k][3];
        params.contact_modulus = cases[k][4];
        if (fst_family_begin(&family, &params, NULL, &error) != FST_OK ||
            fst_search_orbit(&family, &s, &outcome, &error) != FST_OK ||
            fst_solution_spectrum(&family, &s, &error) != FST_OK ||
            fst_describe_orbit(&family, &s, 0, &d, &error) != FST_OK)
            fail_msg("%s", error.sentence);
        by_differences(&s, &family, re, im);
        const double off = farthest(&s, re, im);
        for (int i = 0; i < s.multipliers; ++i) {
            lost += s.re[i] == 0.0 && s.im[i] == 0.0;
            greatest = fmax(greatest, hypot(s.re[i], s.im[i]));
        }
        printf("disc, mu %g, %g Hz: sticks %.3g, residual %.2g, trivial error %.2g, greatest %.6g, %d lost, "
               "off by %.2g\n",
               cases[k][0], cases[k][2], d.means.sticking, s.residual, s.trivial_error, greatest, lost, off);
        assert_true(off < 1e-6 && s.trivial_error < 1e-6 && d.means.sticking > 0.0);
        assert_int_equal(lost, 3);
    }
}

/* A branch goes through holdings and lettings go, over the static friction at which the disc lets go: at its ends it
 * has the orbits that the bead comes to there, and along it three directions are lost. */
static void branch_of_held_discs(void **unused)
{
    (void)unused;
    static const double ends[] = {0.22, 0.3};
    fst_params params = flying(0.2, NAN, 15.0);
    params.friction_mu_static = 0.24;
    params.contact_patch = FST_PATCH_HERTZ;
    params.contact_radius = 3e-3;
    fst_branch_options options = fst_default_branch_options();
    options.kind = FST_BRANCH_COUNTER;
    options.key = "friction.mu_static";
    options.from = ends[0];
    options.to = ends[1];
    fst_branch branch = followed(&params, &options);
    assert_true(branch.branches == 1 && branch.end_count == 2 && branch.point_count < 9);
    for (size_t i = 0; i < branch.point_count; ++i) {
        int lost = 0;
        for (int k = 0; k < branch.points[i].multipliers; ++k)
            lost += branch.points[i].multiplier_re[k] == 0.0 && branch.points[i].multiplier_im[k] == 0.0;
        assert_int_equal(lost, 3);
    }
    for (int i = 0; i < 2; ++i) {
        const fst_branch_point *at = &branch.points[i ? branch.point_count - 1 : 0];
        fst_orbit orbit;
        fst_error error;
        params.friction_mu_static = ends[i];
        assert_int_equal(branch.ends[i].type, FST_END_RANGE);
        if (fst_orbit_find(&params, NULL, &orbit, &error) != FST_OK)
            fail_msg("%s", error.sentence);
        double greatest[2] = {0.0, 0.0};
        for (int k = 0; k < at->multipliers; ++k) {
            greatest[0] = fmax(greatest[0], hypot(at->multiplier_re[k], at->multiplier_im[k]));
            greatest[1] = fmax(greatest[1], hypot(orbit.multiplier_re[k], orbit.multiplier_im[k]));
        }
        printf("held at mu_s %g: <r> off by %.2g, period by %.2g, multiplier %.6f by %.2g, sticks %.3g\n",
               ends[i], at->mean_r - orbit.means.mean_r, at->period - orbit.means.period, greatest[0],
               greatest[0] - greatest[1], orbit.means.sticking);
        CHECK_CLOSE(at->value, ends[i], 1e-15);
        CHECK_CLOSE(at->mean_r, orbit.means.mean_r, 1e-9);
        CHECK_CLOSE(at->period, orbit.means.period, 1e-8);
        CHECK_CLOSE(greatest[0], greatest[1], 1e-6);
        assert_true(orbit.means.sticking > 0.01);
    }
    fst_branch_free(&branch);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(multipliers_against_differences),
                                       cmocka_unit_test(branch_through_lift_off),
                                       cmocka_unit_test(orbits_of_held_discs),
                                       cmocka_unit_test(branch_of_held_discs),
                                       cmocka_unit_test(exponents_of_hops),
                                       cmocka_unit_test(exponents_of_one_that_hardly_lands)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
