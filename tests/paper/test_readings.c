/* Measures behind claims of the text and second readings, on trajectories whose answers are known, and the
 * margins of verdicts.
 * tests: */
#include "physics.h"

#include "base/constants.h"

#include "paper/measures.h"
#include "paper/state.h"
#include "paper/statements.h"

enum { ROWS = 60000 };
static const double OMEGA = 0.2, CIRCLING = -0.05, STEP = 0.01;

/* What a column holds at the time t. */
typedef double (*column_of)(const char *name, double t);

typedef struct stage {
    fst_paper_state paper;
    fst_paper_run run;
} stage;

static stage *set_up(column_of column)
{
    stage *s = test_calloc(1, sizeof *s);
    s->run.params = fst_default_params();
    s->run.result.omega = OMEGA;
    s->run.result.mean_alpha_dot = CIRCLING;
    s->run.result.mean_r = 0.8;
    s->run.result.max_r = 1.0;
    s->run.done = 1;
    s->run.trajectory = (fst_table){.rows = ROWS, .params = s->run.params, .complete = 1};
    s->run.trajectory.columns = test_calloc((size_t)fst_column_count(), sizeof(double *));
    for (int c = 0; c < fst_column_count(); ++c) {
        double *values = test_calloc(ROWS, sizeof *values);
        for (int row = 0; row < ROWS; ++row)
            values[row] = column(fst_column_at(c)->name, STEP * row);
        s->run.trajectory.columns[c] = values;
    }
    for (int scan = 0; scan < 2; ++scan) {
        s->paper.scans[scan ? FST_SCAN_FOLD15 : FST_SCAN_FOLD4][0] = &s->run;
        s->paper.counts[scan ? FST_SCAN_FOLD15 : FST_SCAN_FOLD4] = 1;
    }
    return s;
}

static void take_down(stage *s)
{
    for (int c = 0; c < fst_column_count(); ++c)
        test_free(s->run.trajectory.columns[c]);
    test_free(s->run.trajectory.columns);
    test_free(s);
}

static double measured(stage *s, fst_measure measure)
{
    char note[512] = "";
    return measure(&(fst_measuring){&s->paper, FST_DYNAMICS_RIGID, note, sizeof note});
}

/* ------------------------------------------------------------------ hypocycloids */

/* x + iy = 0.8 e^(i CIRCLING t) + `second` e^(i OMEGA t); at second = 0.2 the speeds of both are equal. */
static double second;
static double trochoid(const char *name, double t)
{
    return !strcmp(name, "t")       ? t
           : !strcmp(name, "x")     ? 0.8 * cos(CIRCLING * t) + second * cos(OMEGA * t)
           : !strcmp(name, "y")     ? 0.8 * sin(CIRCLING * t) + second * sin(OMEGA * t)
           : !strcmp(name, "alpha") ? CIRCLING * t
                                    : 0.0;
}

/* A hypocycloid has cusps: the ratio of speeds is 1.  A curve with rounded corners, and one with loops, is a
 * trochoid all the same. */
static void cusps_are_told_from_loops_and_rounded_corners(void **state)
{
    (void)state;
    static const double seconds[][2] = {{0.2, 1.0}, {0.1, 0.5}, {0.4, 0.5}};
    for (size_t i = 0; i < sizeof seconds / sizeof seconds[0]; ++i) {
        second = seconds[i][0];
        stage *s = set_up(trochoid);
        CHECK_CLOSE(measured(s, fst_measure_cusps), seconds[i][1], 1e-2);
        CHECK_CLOSE(measured(s, fst_measure_trochoid), 1.0, 1e-2);
        take_down(s);
    }
}

/* Two equal speeds that turn against each other make 2 |sin| of one of them, which is 4/pi of it on average. */
static void the_length_of_a_revolution(void **state)
{
    (void)state;
    second = 0.2;
    stage *s = set_up(trochoid);
    const double speed = 4.0 / FST_PI * second * OMEGA, length = speed * TWO_PI / fabs(CIRCLING);
    CHECK_CLOSE(measured(s, fst_measure_shortcuts), 100.0 * (1.0 - length / (TWO_PI * 0.8)), 0.1);
    CHECK_CLOSE(measured(s, fst_measure_shortcuts_within), 100.0 * (1.0 - length / TWO_PI), 0.1);
    second = 0.0; /* a circle is not a shortcut */
    stage *circle = set_up(trochoid);
    CHECK_CLOSE(measured(circle, fst_measure_shortcuts), 0.0, 1e-3);
    take_down(circle);
    take_down(s);
}

/* ------------------------------------------------------------------ where friction acts */

/* r has a turning point each 10 time units.  Friction acts for a tenth of that time, `lag` after each of them,
 * or always (lag < 0). */
static double lag;
static double rubbing(const char *name, double t)
{
    const double since = fmod(t, 10.0), off = fabs(since - lag);
    if (!strcmp(name, "friction_power"))
        return lag < 0.0 || off < 0.5 ? 1.0 : 0.0;
    return !strcmp(name, "t")       ? t
           : !strcmp(name, "r")     ? cos(TWO_PI * t / 10.0)
           : !strcmp(name, "x")     ? t
           : !strcmp(name, "angle") ? (since < 2.5 ? 3.0 : 1.0)
                                    : 0.0;
}

/* Beside the turning points it counts in the first reading, on them in both, between them in none.  A steady
 * loss has the shares of the time, which is why neither is met by it. */
static void friction_near_turning_points(void **state)
{
    (void)state;
    static const double lags[][3] = {{2.0, 100.0, 0.0}, {1.0, 100.0, 75.0}, {5.0, 0.0, 0.0}};
    for (size_t i = 0; i < sizeof lags / sizeof lags[0]; ++i) {
        lag = lags[i][0];
        stage *s = set_up(rubbing);
        CHECK_CLOSE(measured(s, fst_measure_turning_points), lags[i][1], 1.0);
        CHECK_CLOSE(measured(s, fst_measure_turning_times), lags[i][2], 1.0);
        take_down(s);
    }
    lag = -1.0;
    stage *steady = set_up(rubbing);
    CHECK_CLOSE(measured(steady, fst_measure_turning_times), 25.0, 0.5);
    assert_true(measured(steady, fst_measure_turning_points) < 25.5);
    take_down(steady);
}

/* Angles of 3 for a quarter of the time and of 1 for the rest: half of the mean square, 3, is in 1/6 of the
 * time. */
static void half_of_the_angle(void **state)
{
    (void)state;
    stage *s = set_up(rubbing);
    CHECK_CLOSE(measured(s, fst_measure_half_of_the_angle), 100.0 / 6.0, 0.1);
    take_down(s);
}

/* ------------------------------------------------------------------ S2 */

/* A motion with the symmetry S2 (`broken` 0), in the magnet's frame: r at the angle Phi, which falls unevenly,
 * and n whose local components change their signs after half a turn. */
static double broken;
static double symmetric(const char *name, double t)
{
    const double turn = -0.25 * t, angle = turn + 0.1 * sin(2.0 * turn), r = 0.9 + 0.05 * cos(2.0 * turn);
    const double n_r = 0.4 * cos(turn) + 0.1 * cos(3.0 * turn) + broken, n_a = -sin(turn),
                 n_z = 0.8 * cos(turn);
    return !strcmp(name, "Phi")       ? angle
           : !strcmp(name, "X")       ? r * cos(angle)
           : !strcmp(name, "Y")       ? r * sin(angle)
           : !strcmp(name, "n_r")     ? n_r
           : !strcmp(name, "n_alpha") ? n_a
           : !strcmp(name, "n_z")     ? n_z
           : !strcmp(name, "nX")      ? n_r * cos(angle) - n_a * sin(angle)
           : !strcmp(name, "nY")      ? n_r * sin(angle) + n_a * cos(angle)
           : !strcmp(name, "nZ")      ? n_z
                                      : 0.0;
}

/* The components are reversed; the vector is not, for its axes turned as well: its part in the plane is the
 * same again, and so off by twice its size. */
static void s2_holds_for_components_and_not_for_vectors(void **state)
{
    (void)state;
    broken = 0.0;
    stage *s = set_up(symmetric);
    double plane = 0.0, all = 0.0;
    for (int i = 0; i < 1000; ++i) {
        const double t = TWO_PI / 0.25 * i / 1000.0, x = symmetric("nX", t), y = symmetric("nY", t);
        plane += x * x + y * y;
        all += x * x + y * y + symmetric("nZ", t) * symmetric("nZ", t);
    }
    assert_true(measured(s, fst_measure_s2_in_components) < 1e-8);
    CHECK_CLOSE(measured(s, fst_measure_s2_in_the_frame), 2.0 * sqrt(plane / all), 5e-3); /* no whole turns */
    take_down(s);
    broken = 0.05;
    stage *other = set_up(symmetric);
    assert_true(measured(other, fst_measure_s2_in_components) > 0.05);
    take_down(other);
}

/* ------------------------------------------------------------------ margins */

static double margin(fst_rule rule, double published, double scale, double value, double *border)
{
    const fst_statement statement = {.rule = rule, .published = published, .scale = scale};
    return fst_statement_margin(&statement, value, border);
}

static void margins_are_distances_from_the_nearest_border(void **state)
{
    (void)state;
    double border;
    CHECK_CLOSE(margin(FST_RULE_SMALL, 0.0, 100.0, 30.4, &border), 0.4 / 30.0, 1e-9);
    CHECK_CLOSE(border, 30.0, 1e-12);
    CHECK_CLOSE(margin(FST_RULE_SMALL, 0.0, 100.0, 10.5, &border), 0.05, 1e-9);
    CHECK_CLOSE(border, 10.0, 1e-12);
    CHECK_CLOSE(margin(FST_RULE_NUMBER, 41.0, 1.0, 40.54, &border), 0.08, 1e-9);
    CHECK_CLOSE(border, 40.5, 1e-12);
    CHECK_CLOSE(margin(FST_RULE_AT_MOST, 4.0, 1.0, 4.42, &border), 0.16, 1e-9);
    CHECK_CLOSE(margin(FST_RULE_NOTABLE, NAN, 100.0, 2.9, &border), 0.1 / 3.0, 1e-9);
    CHECK_CLOSE(margin(FST_RULE_MOSTLY, NAN, 100.0, 49.0, &border), 0.02, 1e-9);
    CHECK_CLOSE(margin(FST_RULE_MAGNITUDE, 100.0, 1.0, 12.49, &border), log10(1.249), 1e-9);
    assert_true(isnan(margin(FST_RULE_NEVER, 0.0, 1.0, 0.0, &border)) && isnan(border));
    assert_true(isnan(margin(FST_RULE_SMALL, 0.0, 1.0, NAN, &border)));
}

/* ------------------------------------------------------------------ the tables */

/* A claim stands among the readings exactly if it has a second one; what is printed shows no digit that the
 * number does not have; still claims measure the same under both dynamics by being of the field or of given
 * numbers alone. */
static void the_tables_agree(void **state)
{
    (void)state;
    int readings = 0;
    for (int i = 0; i < fst_statement_count(); ++i) {
        const fst_statement *statement = fst_statement_at(i);
        const fst_reading *reading = fst_statement_reading(statement);
        char text[64], number[64];
        assert_int_equal(reading != NULL, statement->group == FST_GROUP_READING);
        readings += reading != NULL;
        fst_statement_published(statement, text, sizeof text);
        (void)snprintf(number, sizeof number, "%.10g", statement->published);
        if (!statement->said && statement->rule != FST_RULE_SYMMETRY)
            assert_memory_equal(text, number, strlen(number));
        if (!statement->said)
            assert_null(strstr(text, ".0"));
        assert_ptr_equal(fst_statement_named(statement->id), statement);
        assert_false(statement->still && (statement->scan != FST_SCAN_NONE || statement->check));
    }
    assert_true(readings >= 12);
    assert_null(fst_statement_named("maximum"));
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(cusps_are_told_from_loops_and_rounded_corners),
        cmocka_unit_test(the_length_of_a_revolution),
        cmocka_unit_test(friction_near_turning_points),
        cmocka_unit_test(half_of_the_angle),
        cmocka_unit_test(s2_holds_for_components_and_not_for_vectors),
        cmocka_unit_test(margins_are_distances_from_the_nearest_border),
        cmocka_unit_test(the_tables_agree),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
