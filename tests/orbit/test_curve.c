/* Curves of solutions where Newton's method fails at a bad moment.
 * tests: orbit/curve.c orbit/node.c */
#include "branches.h"

#include <string.h>

#include "orbit/curve.h"
#include "orbit/search.h"

/* LAPACK with a fault: the given number of times, it calls a system singular that holds the parameter fixed, as
 * at the border of the range. Such systems are known by a last row of zeros but for its last element. */
static const fst_lapack *lapack;
static int faults, solves;

static int faulty_solve(int n, int columns, double *a, double *b)
{
    solves += 1;
    int fixed = n == FST_TANGENT_SIZE + 1;
    for (int i = 0; i + 1 < n; ++i)
        fixed = fixed && a[(n - 1) * n + i] == 0.0;
    if (fixed && faults > 0) {
        faults -= 1;
        return 1;
    }
    return lapack->solve(n, columns, a, b);
}

typedef struct path {
    double last;
    int nodes;
} path;

static fst_status take_node(void *user, const fst_node *node, fst_error *error)
{
    path *p = user;
    (void)error;
    p->last = node->s.value;
    p->nodes += 1;
    return FST_OK;
}

static fst_status take_special(void *user, fst_special_type type, const fst_node *at, int criticality,
                               const fst_node *born, fst_error *error)
{
    (void)user, (void)type, (void)at, (void)criticality, (void)born, (void)error;
    return FST_OK;
}

/* A curve that begins at the equilibrium on the axis with n along the magnet's lines, and rises in model.h. */
static void follow_axis(int faults_wanted, path *p, fst_curve *curve)
{
    const fst_params params = fst_default_params();
    fst_family family;
    fst_error error;
    fst_node start;
    fst_setup setup;
    fst_lapack faulty;
    memset(p, 0, sizeof *p);
    assert_int_equal(fst_family_begin(&family, &params, "model.h", &error), FST_OK);
    family.watch = NULL;
    fst_solution s;
    memset(&s, 0, sizeof s);
    s.value = 0.6;
    assert_int_equal(fst_family_setup(&family, s.value, &setup, &error), FST_OK);
    s.y[0][FST_NX] = -1.0;
    s.y[0][FST_WZ] = setup.model.groups.omega;
    assert_int_equal(fst_solution_correct(&family, &s, NULL, &error), FST_OK);
    assert_int_equal(fst_node_make(&family, &s, &start, &error), FST_OK);
    lapack = family.lapack;
    faulty = *lapack;
    faulty.solve = faulty_solve;
    family.lapack = &faulty;
    faults = faults_wanted;
    *curve = (fst_curve){.family = &family,
                         .from = 0.55,
                         .to = 0.65,
                         .longest_step = 0.5,
                         .sink = {p, 0, take_node, take_special}};
    assert_int_equal(fst_curve_follow(curve, &start, start.s.tangent.value > 0 ? 1 : -1, &error), FST_OK);
}

/* If the border cannot be reached from the last node in one step, smaller steps reach it. */
static void the_border_is_reached_in_smaller_steps(void **state)
{
    (void)state;
    fst_curve curve;
    path whole, p;
    follow_axis(0, &whole, &curve);
    assert_int_equal(curve.end.type, FST_END_RANGE);
    for (int wanted = 1; wanted <= 3; ++wanted) {
        follow_axis(wanted, &p, &curve);
        assert_int_equal(faults, 0);
        assert_int_equal(curve.end.type, FST_END_RANGE);
        assert_true(p.last == 0.65);
        assert_true(p.nodes > whole.nodes);
    }
}

/* If the border cannot be reached at all, the curve ends before it and says so; this is not a failure. */
static void a_border_out_of_reach(void **state)
{
    (void)state;
    fst_curve curve;
    path p;
    follow_axis(1000000, &p, &curve);
    assert_int_equal(curve.end.type, FST_END_LOST);
    CHECK_CONTAINS(curve.end.reason, "could not be followed beyond 0.6");
    assert_true(p.nodes > 3 && p.last > 0.64 && p.last < 0.65);
}

static void search_for(const fst_params *params, fst_solution *once)
{
    fst_family still;
    fst_orbit_outcome outcome;
    fst_error error;
    assert_int_equal(fst_family_begin(&still, params, NULL, &error), FST_OK);
    assert_int_equal(fst_search_orbit(&still, once, &outcome, &error), FST_OK);
}

/* An orbit of twice the period that is close to the one that is gone round twice, as beside its birth (made up: a
 * state of the chain is moved by `apart`), is followed over omega. */
static void follow_doubled(double apart, path *p, fst_curve *curve)
{
    const fst_params params = scene_of(0.25, "rigid");
    fst_family family;
    fst_solution once;
    fst_error error;
    fst_node start;
    memset(p, 0, sizeof *p);
    search_for(&params, &once);
    assert_int_equal(fst_family_begin(&family, &params, "drive.omega", &error), FST_OK);
    fst_solution twice = {.period = 2.0 * fst_whole_period(&once), .value = 0.25};
    memcpy(twice.y[0], once.y[0], sizeof twice.y[0]);
    assert_int_equal(fst_solution_chain(&family, &twice, 2, &error), FST_OK);
    assert_int_equal(fst_solution_correct(&family, &twice, NULL, &error), FST_OK);
    assert_int_equal(fst_node_make(&family, &twice, &start, &error), FST_OK);
    start.s.y[1][FST_WX] += apart;
    *curve = (fst_curve){.family = &family,
                         .from = 0.24,
                         .to = 0.26,
                         .longest_step = 0.5,
                         .sink = {p, 0, take_node, take_special}};
    assert_int_equal(fst_curve_follow(curve, &start, 1, &error), FST_OK);
}

/* Where nobody hears of special points, as on a trial, a curve has the same nodes and end, and none is located. */
static void special_points_that_nobody_hears_of(void **state)
{
    (void)state;
    const fst_params params = scene_of(0.3, "rigid");
    fst_family family;
    fst_solution once;
    fst_error error;
    fst_node start;
    path p[2] = {{0}};
    int needed[2];
    search_for(&params, &once);
    assert_int_equal(fst_family_begin(&family, &params, "drive.omega", &error), FST_OK);
    once.value = 0.3;
    once.on_section = 0;
    assert_int_equal(fst_solution_correct(&family, &once, NULL, &error), FST_OK);
    assert_int_equal(fst_node_make(&family, &once, &start, &error), FST_OK);
    lapack = family.lapack;
    fst_lapack counting = *lapack;
    counting.solve = faulty_solve;
    family.lapack = &counting;
    for (int heard = 0; heard < 2; ++heard) {
        fst_curve curve = {.family = &family,
                           .from = 0.25,
                           .to = 0.32,
                           .longest_step = 0.5,
                           .sink = {&p[heard], 0, take_node, heard ? take_special : NULL}};
        solves = 0;
        assert_int_equal(fst_curve_follow(&curve, &start, start.s.tangent.value > 0 ? -1 : 1, &error), FST_OK);
        needed[heard] = solves;
        printf("%d nodes to %g, %d solves, end %d\n", p[heard].nodes, p[heard].last, solves, curve.end.type);
    }
    assert_true(p[0].nodes == p[1].nodes && p[0].last == p[1].last && needed[0] < needed[1]);
}

/* A curve does not go on along an orbit of half its period, unless it has always done so. */
static void half_the_period_is_another_curve(void **state)
{
    (void)state;
    fst_curve curve;
    path p;
    follow_doubled(0.0, &p, &curve);
    assert_true(curve.end.type == FST_END_RANGE && p.nodes > 0);
    follow_doubled(1e-4, &p, &curve);
    assert_true(curve.end.type == FST_END_LOST && p.nodes == 0);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(the_border_is_reached_in_smaller_steps),
        cmocka_unit_test(a_border_out_of_reach),
        cmocka_unit_test(special_points_that_nobody_hears_of),
        cmocka_unit_test(half_the_period_is_another_curve),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
