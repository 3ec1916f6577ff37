/* Places where a bead floats without a plate beside a tilted turning magnet: against numbers of an independent program,
 * the formula of docs/levitation.md, and the branch's ends.
 *
 * tests: orbit/levitation.c orbit/world_branch.c orbit/beads_curve.c model/medium.c */
#include <stdio.h>

#include <festoon/beads.h>

#include "levitators.h"

/* The stable place on one side. */
static fst_levitation place(const fst_params *p, int above)
{
    fst_levitation_list list;
    fst_error error = {FST_OK, "", ""};
    if (fst_levitation_find(p, NULL, &list, &error) != FST_OK)
        fail_msg("%s", error.sentence);
    fst_levitation found = {.height_mm = NAN};
    for (size_t i = 0; i < list.count && isnan(found.height_mm); ++i)
        if ((list.states[i].state[2] > 0) == above && list.states[i].stable)
            found = list.states[i];
    fst_levitation_free(&list);
    return found;
}

static void test_heights(void **unused)
{
    (void)unused;
    fst_params p = levitator("5", "9.81");
    const fst_levitation below = place(&p, 0), above = place(&p, 1);
    CHECK_CLOSE(below.height_mm, 25.056, 5.1e-4);
    CHECK_CLOSE(below.tilt_deg, 6.35, 5.1e-3);
    CHECK_CLOSE(below.circle_mm, 0.210, 5.1e-4);
    CHECK_CLOSE(below.gap_mm, 9.2, 0.051);
    CHECK_CLOSE(below.eigenvalue_re[0], -0.5, 0.01);
    CHECK_CLOSE(above.height_mm, 23.021, 5.1e-4);
    set(&p, "plate.gravity", "-9.81"); /* the same upside down */
    CHECK_CLOSE(place(&p, 1).height_mm, below.height_mm, 1e-8);
    set(&p, "plate.gravity", "0");
    CHECK_CLOSE(place(&p, 1).height_mm, 23.772, 5.1e-4);
}

/* The rates of the laboratory: sideways and nodding, twice each, and up and down.  A motion of the turning frame at the
 * rate w +- f is seen there at the rate f.  The numbers are those of an independent program in the laboratory's frame, with
 * two point dipoles: multipliers of the map over a turn, by SciPy's solve_ivp at a tolerance of 1e-11. */
static void test_swings(void **unused)
{
    (void)unused;
    static const double swings[] = {5.0711, 5.2543, 11.5246, 20.3581, 23.4476};
    const fst_params p = levitator("5", "9.81");
    const fst_levitation below = place(&p, 0);
    for (size_t s = 0; s < sizeof swings / sizeof *swings; ++s) {
        int count = 0;
        for (int i = 0; i < FST_LEVITATION_DIRECTIONS; ++i) {
            const double turning = below.eigenvalue_im[i] / TWO_PI;
            const double hertz = turning > 100 ? fabs(turning - 200) : turning;
            count += turning > 1 && fabs(hertz - swings[s]) < 1e-3;
        }
        assert_int_equal(count, 1);
    }
}

/* z^3 = K s^2 (1 + 12 I/(m z^2))/(2 I w^2 c), and the same without the motion of the centre. */
static void test_formula(void **unused)
{
    (void)unused;
    fst_params p = levitator("5", "0");
    const double r[2] = {9.5e-3, 6.35e-3}, mu_0 = 4e-7 * 3.14159265358979323846, turn = 6.283185307179586;
    const double m = 7500 * turn / 1.5 * r[1] * r[1] * r[1], inertia = 0.4 * m * r[1] * r[1], w = turn * 200;
    double moment[2];
    for (int i = 0; i < 2; ++i)
        moment[i] = turn / 1.5 * r[i] * r[i] * r[i] * 1.2 / mu_0;
    const double k = mu_0 / (2 * turn) * moment[0] * moment[1], s = cos(5 * turn / 360),
                 c = sin(5 * turn / 360);
    double z = cbrt(k * s * s / (2 * inertia * w * w * c));
    CHECK_CLOSE(1e3 * z, 21.371, 5.1e-4);
    for (int i = 0; i < 60; ++i)
        z = cbrt(k * s * s * (1 + 12 * inertia / (m * z * z)) / (2 * inertia * w * w * c));
    CHECK_CLOSE(1e3 * z, 23.604, 5.1e-4);
    CHECK_CLOSE(place(&p, 1).height_mm, 1e3 * z, 0.01 * 1e3 * z);
    set(&p, "drive.frequency", "2000 Hz"); /* and small tilts of the floater follow it closely */
    set(&p, "magnet.parts[0].rotation[0]", "0.05");
    const double far = 1e3 * cbrt(k * (1 + 12 * inertia / (m * 23.6e-3 * 23.6e-3)) / (2 * inertia * w * w * c));
    CHECK_CLOSE(place(&p, 1).height_mm, far, 0.01 * far);
}

/* Drag of the turning alone makes it unstable; without any drag it is stable, one of a family. */
static void test_drags(void **unused)
{
    (void)unused;
    fst_params p = levitator("5", "-9.81");
    fst_levitation_list list;
    fst_error error;
    set(&p, "medium.drag_rate", "0");
    assert_int_equal(fst_levitation_find(&p, NULL, &list, &error), FST_OK);
    int found = 0;
    for (size_t i = 0; i < list.count; ++i)
        if (fabs(list.states[i].height_mm - 25.056) < 0.01) {
            CHECK_CLOSE(list.states[i].eigenvalue_re[0], 0.0046, 5.1e-5);
            found = 1;
        }
    assert_true(found);
    fst_levitation_free(&list);
    set(&p, "medium.drag_rate", "0.0085");
    assert_true(isnan(place(&p, 1).height_mm));
    set(&p, "medium.drag_rate", "0.0095");
    CHECK_CLOSE(place(&p, 1).height_mm, 25.056, 1e-3);
    set(&p, "medium.drag_rate", "0");
    set(&p, "medium.spin_drag_rate", "0");
    const fst_levitation free = place(&p, 1);
    assert_true(free.family && free.stable);
    CHECK_CLOSE(free.eigenvalue_re[0], 0, 1e-5);
}

static fst_branch follow(const fst_params *p, const char *key, double from, double to)
{
    fst_branch branch;
    fst_error error = {FST_OK, "", ""};
    fst_branch_options options = fst_default_branch_options();
    options.kind = FST_BRANCH_LEVITATING;
    options.key = key;
    options.from = from;
    options.to = to;
    if (fst_branch_follow(p, &options, &branch, &error) != FST_OK)
        fail_msg("%s", error.sentence);
    return branch;
}

/* Where the first special point of a type lies, over the magnet's plane; NAN: nowhere. */
static double special_above(const fst_branch *branch, fst_special_type type)
{
    for (size_t k = 0; k < branch->special_count; ++k)
        if (branch->specials[k].type == type && branch->specials[k].at.levitation.state[2] > 0)
            return branch->specials[k].value;
    return NAN;
}

/* The least frequencies: below a fold, above a Hopf point. */
static void test_least_frequencies(void **unused)
{
    (void)unused;
    static const struct {
        const char *tilt, *gravity;
        fst_special_type type;
        double hertz;
    } cases[] = {{"5", "-9.81", FST_SPECIAL_FOLD, 162.1},
                 {"3", "-9.81", FST_SPECIAL_FOLD, 258.0},
                 {"8", "-9.81", FST_SPECIAL_FOLD, 106.9},
                 {"12", "-9.81", FST_SPECIAL_FOLD, 75.9},
                 {"5", "9.81", FST_SPECIAL_HOPF, 158.8}};
    for (int i = 0; i < 5; ++i) {
        const fst_params p = levitator(cases[i].tilt, cases[i].gravity);
        fst_branch branch = follow(&p, "drive.frequency", 60, 300);
        CHECK_CLOSE(special_above(&branch, cases[i].type), cases[i].hertz, 0.051);
        fst_branch_free(&branch);
    }
}

/* Curves over other keys pass the same fold; over the drag the Hopf point above which the drag of the motion stops what
 * that of the turning feeds; and end where the bead touches the magnet or the range ends. */
static void test_keys(void **unused)
{
    (void)unused;
    fst_params p = levitator("5", "-9.81");
    fst_branch branch = follow(&p, "drive.frequency", 150, 500);
    const double hertz = special_above(&branch, FST_SPECIAL_FOLD);
    double touched = NAN;
    for (size_t i = 0; i < branch.end_count; ++i)
        if (branch.ends[i].type == FST_END_CONTACT)
            touched = branch.ends[i].value;
    fst_branch_free(&branch);
    char text[32];
    (void)snprintf(text, sizeof text, "%.17g", touched);
    set(&p, "drive.frequency", text);
    const fst_levitation at_end = place(&p, touched > 420);
    CHECK_CLOSE(at_end.gap_mm, 0, 1e-7);
    (void)snprintf(text, sizeof text, "%.17g", hertz);
    set(&p, "drive.frequency", text);
    branch = follow(&p, "magnet.parts[0].rotation[0]", 4, 6);
    CHECK_CLOSE(special_above(&branch, FST_SPECIAL_FOLD), 5, 1e-9);
    fst_branch_free(&branch);
    branch = follow(&p, "bead.radius", 6e-3, 7e-3);
    CHECK_CLOSE(1e3 * special_above(&branch, FST_SPECIAL_FOLD), 6.35, 1e-9);
    fst_branch_free(&branch);
    set(&p, "drive.frequency", "200");
    branch = follow(&p, "magnet.parts[0].rotation[0]", 12,
                    17); /* the upper end, a tilt of the rotor above 15 degrees */
    CHECK_CLOSE(special_above(&branch, FST_SPECIAL_HOPF), 15.4, 0.051);
    fst_branch_free(&branch);
    branch = follow(&p, "medium.drag_rate", 0, 0.02);
    CHECK_CLOSE(special_above(&branch, FST_SPECIAL_HOPF), 0.009, 5.1e-4);
    fst_branch_free(&branch);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_heights),           cmocka_unit_test(test_swings),
        cmocka_unit_test(test_formula),           cmocka_unit_test(test_drags),
        cmocka_unit_test(test_least_frequencies), cmocka_unit_test(test_keys),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
