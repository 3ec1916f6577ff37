/* Branches over short ranges: special points, the branches born there, other parameters, and a caller that
 * stops the work. Whole branches are in test_branch_long.c.
 * tests: orbit/branch.c orbit/counter.c orbit/switching.c orbit/special.c orbit/special_test.c orbit/branch_list.c */
#include "branches.h"

/* The period halving and the branch born there. Neighbouring points are close together, so no curve jumps to
 * another. */
static void the_period_halving(void **state)
{
    (void)state;
    const fst_params params = scene_of(0.27, "rigid");
    const fst_branch_options o = over_omega(FST_BRANCH_COUNTER, 0.265, 0.272);
    fst_branch b = followed(&params, &o);
    assert_int_equal(b.branches, 2);
    assert_int_equal(b.special_count, 1);
    const fst_special *fork = special_near(&b, FST_SPECIAL_PITCHFORK, 0.26885303399);
    CHECK_CLOSE(fork->value, 0.26885303399, 1e-9);
    assert_int_equal(fork->criticality, 1);
    assert_int_equal(fork->born, 1);
    for (size_t i = 0; i < b.point_count; ++i) {
        const fst_branch_point *p = &b.points[i];
        assert_int_equal(p->symmetry, p->branch == 0 ? FST_SYMMETRY_S2 : FST_SYMMETRY_S1);
        assert_int_equal(p->stable, p->branch == 1 || p->value > fork->value);
        if (p->branch == 1)
            assert_true(p->value < fork->value);
        if (i > 0 && p[-1].branch == p->branch) {
            CHECK_CLOSE(p->mean_r, p[-1].mean_r, 0.02);
            CHECK_CLOSE(p->value, p[-1].value, 0.01);
        }
    }
    fst_branch_free(&b);
}

/* A branch may be followed over any parameter: here the pitchfork over kappa, at the omega where it lies at
 * kappa = 1.5. */
static void another_parameter(void **state)
{
    (void)state;
    const fst_params params = scene_of(0.26885303399, "rigid");
    fst_branch_options o = over_omega(FST_BRANCH_COUNTER, 1.45, 1.55);
    o.key = "model.kappa";
    o.follow = 0;
    fst_branch b = followed(&params, &o);
    assert_int_equal(b.branches, 1);
    CHECK_CLOSE(special_near(&b, FST_SPECIAL_PITCHFORK, 1.5)->value, 1.5, 1e-8);
    fst_branch_free(&b);
}

/* A branch begins with the scene's own orbit wherever the range lies, whether or not it holds symmetric orbits.
 */
static void a_range_without_symmetric_orbits(void **state)
{
    (void)state;
    const fst_params params = scene_of(0.2, "rigid");
    const fst_branch_options o = over_omega(FST_BRANCH_COUNTER, 0.195, 0.205);
    fst_branch b = followed(&params, &o);
    int of_scene = 0;
    for (size_t i = 0; i < b.point_count; ++i)
        of_scene += b.points[i].symmetry == FST_SYMMETRY_S1 && b.points[i].stable;
    assert_true(of_scene > 1);
    fst_branch_free(&b);
}

/* The greatest difference of two states in any component. */
static double gap(const double *a, const double *b)
{
    double greatest = 0.0;
    for (int k = 0; k < FST_STATE_SIZE; ++k)
        greatest = fmax(greatest, fabs(a[k] - b[k]));
    return greatest;
}

/* Which branch holds the images under S2. A symmetric branch is its own image. Of librations and S1 orbits only
 * one of the two branches is followed. Of equilibria both are followed, and each names the other; states on the
 * axis are their own images. */
static void images_under_s2(void **state)
{
    (void)state;
    const fst_params params = scene_of(0.27, "rigid");
    fst_branch_options o = over_omega(FST_BRANCH_COUNTER, 0.265, 0.272);
    fst_branch b = followed(&params, &o);
    for (size_t e = 0; e < b.end_count; ++e)
        assert_int_equal(b.ends[e].image, b.ends[e].branch == 0 ? 0 : -1);
    fst_branch_free(&b);
    o = over_omega(FST_BRANCH_LOCKED, 0.05, 0.06);
    b = followed(&params, &o);
    int own = 0, others = 0;
    for (size_t e = 0; e < b.end_count; ++e) {
        const fst_branch_end *end = &b.ends[e];
        assert_in_range(end->image, 0, b.branches - 1);
        own += end->image == end->branch;
        others += end->image != end->branch;
        for (size_t f = 0; f < b.end_count; ++f)
            if (b.ends[f].branch == end->image)
                assert_int_equal(b.ends[f].image, end->branch);
        /* all branches reach the border of the range exactly, so states there can be compared with each other's
         * images */
        const fst_branch_point *here = NULL;
        double image[FST_STATE_SIZE], nearest = INFINITY;
        for (size_t i = 0; i < b.point_count; ++i)
            if (b.points[i].branch == end->branch && fabs(b.points[i].value - o.from) < 1e-12)
                here = &b.points[i];
        if (!here)
            continue;
        assert_int_equal(end->image == end->branch, here->mean_r < 1e-9);
        fst_apply_s2(here->state, image);
        for (size_t i = 0; i < b.point_count; ++i)
            if (b.points[i].branch == end->image && fabs(b.points[i].value - o.from) < 1e-12)
                nearest = fmin(nearest, gap(image, b.points[i].state));
        CHECK_CLOSE(nearest, 0.0, 1e-7);
    }
    assert_int_equal(own, 4); /* two states on the axis */
    assert_int_equal(others, 16);
    fst_branch_free(&b);
}

/* A bead over two dipoles, of which one is by a part stronger than the other. */
static fst_params over_dipoles(double stronger)
{
    static const char *const sets[][2] = {
        {"bead.moment", "0.06 A*m^2"},
        {"magnet.shape", "parts"},
        {"magnet.depth", "15 mm"},
        {"drive.omega", "0.4"},
    };
    fst_params params = fst_default_params();
    fst_error error;
    for (size_t i = 0; i < sizeof sets / sizeof *sets; ++i)
        if (fst_params_set(&params, sets[i][0], sets[i][1], &error) != FST_OK)
            fail_msg("%s", error.sentence);
    params.magnet_part_count = 2;
    for (int i = 0; i < 2; ++i) {
        fst_magnet_part *part = &params.magnet_parts[i];
        memset(part, 0, sizeof *part);
        part->kind = FST_PART_DIPOLE;
        part->rotation[3] = 1.0;
        part->centre[0] = i ? -0.023 : 0.023;
        part->moment[2] = i ? -1.0 : 1.0 + stronger;
    }
    return params;
}

/* The branch on which an orbit at this value has nearly this mean height of its pole. */
static int branch_through(const fst_branch *b, double value, double mean_nz)
{
    double least = 5e-4;
    int nearest = -1;
    for (size_t i = 0; i + 1 < b->point_count; ++i) {
        const fst_branch_point *p = &b->points[i], *q = p + 1;
        const double x = (value - p->value) / (q->value - p->value),
                     off = fabs(p->mean_nz + x * (q->mean_nz - p->mean_nz) - mean_nz);
        if (p->branch == q->branch && x >= 0.0 && x <= 1.0 && off < least) {
            least = off;
            nearest = p->branch;
        }
    }
    return nearest;
}

/* Where the magnet is not its own image under S2 the pitchfork falls apart: one branch passes, a pair ends at a fold, and
 * both are found.  Runs from two sides lead to both.  The fold leaves the pitchfork's place as the two thirds power of
 * what breaks the symmetry. */
static void both_halves_of_a_broken_pitchfork(void **state)
{
    (void)state;
    const fst_params even = over_dipoles(0.0);
    const fst_branch_options o = over_omega(FST_BRANCH_COUNTER, 0.38, 0.45);
    fst_branch b = followed(&even, &o);
    assert_int_equal(b.special_count, 1);
    assert_int_equal(b.specials[0].type, FST_SPECIAL_PITCHFORK);
    const double fork = b.specials[0].value;
    double shift[2];
    fst_branch_free(&b);
    for (int i = 0; i < 2; ++i) {
        fst_params params = over_dipoles(i ? 0.008 : 0.001);
        b = followed(&params, &o);
        assert_int_equal(b.branches, 2);
        assert_int_equal(b.special_count, 1);
        assert_int_equal(b.specials[0].type, FST_SPECIAL_FOLD);
        shift[i] = fork - b.specials[0].value;
        int met[2] = {0, 0};
        for (int start = 0; start < 6 && i; ++start) {
            fst_orbit orbit;
            fst_error error;
            params.start_phi = 60.0 * start;
            assert_int_equal(fst_orbit_find(&params, NULL, &orbit, &error), FST_OK);
            const int through = branch_through(&b, 0.4, orbit.means.mean_nz);
            assert_in_range(through, 0, 1);
            met[through] = 1;
        }
        assert_true(i == 0 || (met[0] && met[1]));
        fst_branch_free(&b);
    }
    CHECK_CLOSE(shift[1] / shift[0], 4.0, 0.4);
}

/* Two blocks of which the second is magnetised the other way and a little less; drive.frequency in Hz. */
static fst_params over_blocks(double weaker)
{
    fst_params params = fst_default_params();
    fst_error error;
    assert_int_equal(fst_params_set(&params, "magnet.shape", "parts", &error), FST_OK);
    assert_int_equal(fst_params_set(&params, "magnet.depth", "16.2 mm", &error), FST_OK);
    assert_int_equal(fst_params_set(&params, "drive.frequency", "22 Hz", &error), FST_OK);
    params.magnet_part_count = 2;
    for (int i = 0; i < 2; ++i) {
        fst_magnet_part *part = &params.magnet_parts[i];
        memset(part, 0, sizeof *part);
        part->kind = FST_PART_CUBOID;
        part->rotation[3] = 1.0;
        part->centre[0] = i ? -0.015 : 0.015;
        part->size[0] = part->size[1] = 0.02;
        part->size[2] = 0.008;
        part->remanence[2] = i ? weaker - 1.0 : 1.0;
    }
    return params;
}

/* Long steps do not leap over the gap that a weaker block opens at the pitchfork: each Hopf point belongs to one branch,
 * and behind the fold the pair's other half repels all the way to the border. */
static void no_leap_over_the_gap(void **state)
{
    static const double weaker[] = {0.01, 0.001};
    (void)state;
    for (int i = 0; i < 2; ++i) {
        const fst_params params = over_blocks(weaker[i]);
        fst_branch_options o = over_omega(FST_BRANCH_COUNTER, 21.5, 32.0);
        o.key = "drive.frequency";
        o.tolerance = 1e-9;
        fst_branch b = followed(&params, &o);
        int hopf[2] = {0, 0}, fold = -1, repel[2] = {0, 0};
        double turn = NAN, low = INFINITY;
        assert_int_equal(b.branches, 2);
        assert_int_equal(b.end_count, 4);
        for (size_t k = 0; k < b.special_count; ++k) {
            const fst_special *s = &b.specials[k];
            hopf[s->branch] += s->type == FST_SPECIAL_HOPF;
            if (s->type == FST_SPECIAL_FOLD) {
                assert_int_equal(fold, -1);
                fold = s->branch;
                turn = s->value;
            }
        }
        assert_in_range(fold, 0, 1);
        assert_int_equal(hopf[0], 1);
        assert_int_equal(hopf[1], 1);
        for (size_t k = 0; k < b.point_count; ++k) {
            const fst_branch_point *p = &b.points[k];
            repel[p->branch] += !p->stable;
            if (p->branch == fold)
                assert_true(p->value < turn + 1e-6);
            if (!p->stable)
                low = fmin(low, p->value);
        }
        assert_int_equal(repel[1 - fold], 0);
        assert_true(repel[fold] > 3);
        CHECK_CLOSE(low, o.from, 1e-9);
        fst_branch_free(&b);
    }
}

static fst_status stop_at_once(void *user, double fraction, const char *what, fst_error *error)
{
    (void)what;
    (void)user;
    (void)fraction;
    if (error)
        (void)snprintf(error->sentence, sizeof error->sentence, "enough");
    return FST_INTERRUPTED;
}

static void refusals_and_interruption(void **state)
{
    (void)state;
    const fst_params params = scene_of(0.27, "rigid");
    fst_branch_options o = over_omega(FST_BRANCH_COUNTER, 0.268, 0.272);
    fst_branch b;
    fst_error error;
    const fst_progress progress = {NULL, stop_at_once};
    o.progress = &progress;
    assert_int_equal(fst_branch_follow(&params, &o, &b, &error), FST_INTERRUPTED);
    fst_branch_free(&b);
    o = over_omega(FST_BRANCH_COUNTER, 0.3, 0.3);
    assert_int_equal(fst_branch_follow(&params, &o, &b, &error), FST_BAD_INPUT);
    o = over_omega(FST_BRANCH_COUNTER, 0.2, 0.3);
    o.key = "drive.omga";
    assert_int_equal(fst_branch_follow(&params, &o, &b, &error), FST_BAD_INPUT);
    CHECK_CONTAINS(error.sentence, "drive.omga");
    o.key = "start.r"; /* errors name the field at fault */
    assert_int_equal(fst_branch_follow(&params, &o, &b, &error), FST_BAD_INPUT);
    assert_string_equal(error.where, "fst_branch_options.key");
    CHECK_CONTAINS(error.sentence, "no orbit and no locked state depends on start.r");
    o = over_omega(FST_BRANCH_COUNTER, 0.0, 0.3);
    assert_int_equal(fst_branch_follow(&params, &o, &b, &error), FST_BAD_INPUT);
    CHECK_CONTAINS(error.sentence, "drive.omega = 0 is out of range");
    o = over_omega(FST_BRANCH_COUNTER, 0.2, 0.3);
    o.longest_step = 0.0;
    assert_int_equal(fst_branch_follow(&params, &o, &b, &error), FST_BAD_INPUT);
    assert_string_equal(error.where, "fst_branch_options.longest_step");
    o = over_omega(FST_BRANCH_COUNTER, 0.04, 0.06);
    assert_int_equal(fst_branch_follow(&params, &o, &b, &error), FST_NO_CONVERGENCE);
    CHECK_CONTAINS(error.sentence, "locks to the magnet");
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(the_period_halving),
        cmocka_unit_test(another_parameter),
        cmocka_unit_test(a_range_without_symmetric_orbits),
        cmocka_unit_test(images_under_s2),
        cmocka_unit_test(both_halves_of_a_broken_pitchfork),
        cmocka_unit_test(no_leap_over_the_gap),
        cmocka_unit_test(refusals_and_interruption),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
