/* Tangents carried along motions with dry friction: against central differences of the flow, over slips, rests
 * and what lies between.
 * tests: orbit/dry_carry.c ode/neighbours.c ode/two_neighbours.c ode/carried.inl */
#include "branches.h"

#include <stdlib.h>
#include <string.h>

#include "ode/creep.h"
#include "ode/neighbours.h"
#include "orbit/family.h"

#define TOLERANCE 1e-13

static fst_params dry_scene(const char *law, const char *dynamics, double mu, double mu_static, double stribeck)
{
    fst_params params = scene_of(0.2151, dynamics);
    fst_error error;
    assert_int_equal(fst_params_set(&params, "friction.law", law, &error), FST_OK);
    params.friction_mu = mu;
    params.friction_mu_static = mu_static;
    params.friction_stribeck_speed = stribeck;
    return params;
}

/* What a motion did on its way. */
typedef struct way {
    int captures, releases, onsets, sunk, mode;
    int rests, starts, roll;
} way;

static void end_of(const fst_params *params, const double *start, double duration, double *end, way *did)
{
    fst_model *model;
    fst_flow *flow = NULL;
    fst_error error;
    fst_flow_options o = fst_default_flow_options();
    o.rtol = TOLERANCE;
    for (int i = 0; i < FST_STATE_SIZE; ++i)
        o.atol[i] = TOLERANCE;
    memset(did, 0, sizeof *did);
    if (fst_model_new(params, &model, &error) != FST_OK ||
        fst_flow_new(model, &o, start, &flow, &error) != FST_OK)
        fail_msg("%s", error.sentence);
    fst_creep_is_followed(flow); /* by the steps that neighbours know */
    while (flow->t.high < duration) {
        if (fst_flow_step(flow, duration, &error) != FST_OK)
            fail_msg("%s", error.sentence);
        const int before = fst_contact_mode(flow), after = flow->contact.slip.next;
        did->captures += before == FST_MODE_SLIP && after == FST_MODE_STICK;
        did->releases += before == FST_MODE_STICK && after >= 0;
        did->onsets += after == FST_MODE_ONSET;
        did->sunk += before == FST_MODE_ONSET && after == FST_MODE_STICK;
        did->mode = before;
        const int roll = fst_contact_roll(flow), roll_after = flow->contact.roll.next;
        did->rests += roll == FST_ROLL_ROLLS && roll_after == FST_ROLL_RESTS;
        did->starts += roll == FST_ROLL_RESTS && roll_after == FST_ROLL_STARTS;
        did->roll = roll;
    }
    memcpy(end, flow->step.end, FST_STATE_SIZE * sizeof *end);
    fst_flow_free(flow);
    fst_model_free(model);
}

/* The derivative of the end along a direction of the start (or by the parameter, NULL) by central differences
 * of fourth order; `did` of the motion itself must be that of all neighbours. */
static void by_differences(const fst_family *family, double value, const double *start, const double *along,
                           double h, double duration, const way *did, double *derivative)
{
    static const double weight[4] = {1.0 / 12.0, -8.0 / 12.0, 8.0 / 12.0, -1.0 / 12.0}, at[4] = {-2, -1, 1, 2};
    memset(derivative, 0, FST_STATE_SIZE * sizeof *derivative);
    for (int k = 0; k < 4; ++k) {
        double y[FST_STATE_SIZE], end[FST_STATE_SIZE];
        way other;
        const fst_params params = fst_family_params(family, along ? value : value + at[k] * h);
        for (int i = 0; i < FST_STATE_SIZE; ++i)
            y[i] = start[i] + (along ? at[k] * h * along[i] : 0.0);
        end_of(&params, y, duration, end, &other);
        if (memcmp(&other, did, sizeof other) != 0)
            fail_msg("a neighbour changes its mode otherwise: %d %d %d %d %d against %d %d %d %d %d",
                     other.captures, other.releases, other.onsets, other.sunk, other.mode, did->captures,
                     did->releases, did->onsets, did->sunk, did->mode);
        for (int i = 0; i < FST_STATE_SIZE; ++i)
            derivative[i] += weight[k] * end[i] / h;
    }
}

typedef struct carry_case {
    const char *name, *key, *law, *dynamics;
    double mu, mu_static, stribeck, duration;
    int captures, releases; /* at least */
    double within;
    const char *radius; /* of a contact that is a disc */
    double resistance;  /* c_rr, */
    int rests;          /* and how often the bead stops rolling at least */
} carry_case;

static double column_error(const carry_case *k, double h, int print)
{
    const double start[FST_STATE_SIZE] = {0.01, 0.72, 0.035, 0.062, -0.9999, -0.002, -0.014, -0.51, 0.25, 0.15};
    double y[FST_STATE_SIZE], basis[FST_STATE_SIZE][FST_TANGENT_SIZE], tangent[FST_STATE_SIZE][FST_COLUMNS];
    double end[FST_STATE_SIZE], greatest = 0.0;
    fst_params params = dry_scene(k->law, k->dynamics, k->mu, k->mu_static, k->stribeck);
    fst_family family;
    fst_setup setup;
    fst_error error;
    way did;
    if (k->radius && (fst_params_set(&params, "contact.patch", "hertz", &error) != FST_OK ||
                      fst_params_set(&params, "contact.radius", k->radius, &error) != FST_OK))
        fail_msg("%s", error.sentence);
    params.friction_rolling_resistance = k->resistance;
    if (fst_family_begin(&family, &params, k->key, &error) != FST_OK)
        fail_msg("%s", error.sentence);
    const double value = fst_family_value(&family), scale = fabs(value);
    if (fst_family_setup(&family, value, &setup, &error) != FST_OK)
        fail_msg("%s", error.sentence);
    memcpy(y, start, sizeof y);
    const double length = sqrt(y[4] * y[4] + y[5] * y[5] + y[6] * y[6]);
    for (int i = FST_NX; i <= FST_NZ; ++i)
        y[i] /= length;
    if (strcmp(k->law, "rolling") == 0) { /* it begins rolling */
        y[FST_VX] = setup.model.groups.eps * y[FST_WY];
        y[FST_VY] = -setup.model.groups.eps * y[FST_WX];
    }
    double begin[FST_STATE_SIZE];
    memcpy(begin, y, sizeof y);
    fst_tangent_basis(y, basis);
    memset(tangent, 0, sizeof tangent);
    for (int i = 0; i < FST_STATE_SIZE; ++i)
        memcpy(tangent[i], basis[i], sizeof basis[i]);
    if (fst_carry(&setup, TOLERANCE, k->duration, y, tangent, &error) != FST_OK)
        fail_msg("%s", error.sentence);
    end_of(&family.params, begin, k->duration, end, &did);
    for (int i = 0; i < FST_STATE_SIZE; ++i)
        CHECK_CLOSE(y[i], end[i], 1e-11);
    if (print)
        printf("%s: %d captures, %d releases, %d sunk, %d rests, %d starts, ends in modes %d, %d\n", k->name,
               did.captures, did.releases, did.sunk, did.rests, did.starts, did.mode, did.roll);
    for (int c = 0; c < FST_COLUMNS; ++c) {
        double along[FST_STATE_SIZE], numeric[FST_STATE_SIZE], size = 1.0, off = 0.0;
        for (int i = 0; i < FST_STATE_SIZE; ++i)
            along[i] = c < FST_TANGENT_SIZE ? basis[i][c] : 0.0;
        const int state = c < FST_TANGENT_SIZE;
        by_differences(&family, value, begin, state ? along : NULL, state ? h : h * scale, k->duration, &did,
                       numeric);
        for (int i = 0; i < FST_STATE_SIZE; ++i) {
            size = fmax(size, fabs(numeric[i]));
            off = fmax(off, fabs(numeric[i] - tangent[i][c]));
        }
        if (print)
            printf("  column %d: size %.3g, off %.3g\n", c, size, off / size);
        greatest = fmax(greatest, off / size);
    }
    assert_true(did.captures >= k->captures && did.releases >= k->releases && did.rests >= k->rests);
    return greatest;
}

static void columns_against_differences(void **unused)
{
    (void)unused;
    static const carry_case cases[] = {
        {"one capture", "drive.omega", "coulomb", "rigid", 0.2, NAN, NAN, 0.5, 1, 0, 1e-9, NULL, 0, 0},
        {"captures and releases", "friction.mu", "coulomb", "rigid", 0.2, NAN, NAN, 14.0, 3, 3, 1e-7, NULL, 0,
         0},
        {"more of them", "friction.mu", "coulomb", "rigid", 0.2, NAN, NAN, 24.0, 5, 5, 2e-7, NULL, 0, 0},
        {"farago2020", "model.kappa", "coulomb", "farago2020", 0.2, NAN, NAN, 24.0, 4, 4, 4e-7, NULL, 0, 0},
        {"by eps", "model.eps", "coulomb", "rigid", 0.2, NAN, NAN, 24.0, 5, 5, 2e-7, NULL, 0, 0},
        {"by omega", "drive.omega", "coulomb", "rigid", 0.2, NAN, NAN, 24.0, 5, 5, 2e-7, NULL, 0, 0},
        {"by frequency", "drive.frequency", "coulomb", "rigid", 0.2, NAN, NAN, 24.0, 5, 5, 2e-7, NULL, 0, 0},
        {"static > sliding", "friction.mu", "coulomb", "rigid", 0.2, 0.25, NAN, 24.0, 4, 4, 1e-8, NULL, 0, 0},
        {"by static friction", "friction.mu_static", "coulomb", "rigid", 0.2, 0.25, NAN, 24.0, 4, 4, 1e-8, NULL,
         0, 0},
        {"static > sliding, farago2020", "drive.omega", "coulomb", "farago2020", 0.2, 0.25, NAN, 24.0, 4, 4,
         1e-8, NULL, 0, 0},
        {"Stribeck", "friction.mu", "coulomb", "rigid", 0.2, 0.25, 0.05, 24.0, 5, 4, 3e-7, NULL, 0, 0},
        {"static hardly > sliding", "friction.mu", "coulomb", "rigid", 0.2, 0.201, NAN, 14.0, 2, 2, 1e-6, NULL,
         0, 0},
        {"rolling", "model.eps", "rolling", "rigid", 0.2, NAN, NAN, 5.0, 0, 0, 1e-9, NULL, 0, 0},
        {"a disc", "friction.mu", "coulomb", "rigid", 0.2, NAN, NAN, 6.0, 0, 0, 1e-7, "0.5mm", 0, 0},
        {"held discs", "friction.mu_static", "coulomb", "rigid", 0.5, 0.6, NAN, 24.0, 3, 3, 1e-6, "3mm", 0, 0},
        {"held discs, by mu", "friction.mu", "coulomb", "farago2020", 0.5, 0.6, NAN, 24.0, 3, 3, 1e-6, "3mm", 0,
         0},
        {"held discs, by eps", "model.eps", "coulomb", "rigid", 0.5, 0.6, NAN, 24.0, 3, 3, 1e-6, "3mm", 0, 0},
        {"rests", "friction.mu", "coulomb", "rigid", 0.2, NAN, NAN, 40.0, 4, 3, 1e-7, NULL, 0.2, 2},
        {"rests, by omega", "drive.omega", "coulomb", "rigid", 0.2, NAN, NAN, 40.0, 4, 3, 1e-7, NULL, 0.2, 2},
        {"rests, by resistance", "friction.rolling_resistance", "coulomb", "farago2020", 0.2, NAN, NAN, 40.0, 4,
         3, 1e-7, NULL, 0.2, 2},
        {"rests and rolls", "model.kappa", "rolling", "rigid", 0.2, NAN, NAN, 40.0, 0, 0, 1e-7, NULL, 0.2, 2},
        {"slips without rolling", "friction.mu", "coulomb", "rigid", 0.2, NAN, NAN, 20.0, 1, 1, 1e-7, NULL, 0.5,
         5},
        {"by eps, with rests", "model.eps", "coulomb", "rigid", 0.2, NAN, NAN, 40.0, 4, 3, 1e-7, NULL, 0.2, 2},
    };
    for (size_t i = 0; i < sizeof cases / sizeof *cases; ++i) {
        const double off = column_error(&cases[i], 1e-5, 1);
        if (!(off <= cases[i].within))
            fail_msg("%s: the columns differ by %.3g", cases[i].name, off);
    }
}

/* The error of the differences falls with the fourth power of their step until rounding takes over. */
static void differences_converge(void **unused)
{
    (void)unused;
    const carry_case k = {
        "static > sliding", "friction.mu", "coulomb", "rigid", 0.2, 0.25, NAN, 14.0, 1, 1, 0, NULL, 0, 0};
    const double coarse = column_error(&k, 8e-4, 0), fine = column_error(&k, 2e-4, 0);
    printf("8e-4: %.3g, 2e-4: %.3g\n", coarse, fine);
    assert_true(fine < coarse / 64.0 && coarse > 1e-9);
}

/* Where neighbours are in the end, of a bead that might fly or that cannot. */
static void carry_neighbours(const fst_params *params, int flies, fst_neighbours *b)
{
    const double start[FST_STATE_SIZE] = {0.01, 0.72, 0.035, 0.062, -1, 0, 0, -0.51, 0.25, 0.15};
    fst_params with = *params;
    fst_model *model;
    fst_flow *flow;
    fst_error error;
    int captures = 0;
    with.impact_restitution = flies ? 0.5 : NAN;
    const fst_flow_options o = fst_default_flow_options();
    if (fst_model_new(&with, &model, &error) != FST_OK ||
        fst_flow_new(model, &o, start, &flow, &error) != FST_OK)
        fail_msg("%s", error.sentence);
    for (int column = 0; column < b->count; ++column)
        for (int i = 0; i < FST_STATE_SIZE; ++i)
            b->d[column][i] = cos(3.0 * i + 5.0 * column);
    for (fst_neighbours_start(b, flow); flow->t.high < 14.0; fst_neighbours_follow(b, flow)) {
        if (fst_flow_step(flow, 14.0, &error) != FST_OK)
            fail_msg("%s", error.sentence);
        captures += flow->contact.slip.next == FST_MODE_STICK;
    }
    assert_true(captures >= 2);
    fst_flow_free(flow);
    fst_model_free(model);
}

/* Neighbours are carried two at a time, those of a bead that might fly one by one: of a motion on the plate both give
 * the same bits, through slips, rests and onsets. */
static void two_are_carried_like_one(void **unused)
{
    (void)unused;
    const fst_params scenes[] = {dry_scene("coulomb", "farago2020", 0.2, 0.25, NAN),
                                 dry_scene("coulomb", "rigid", 0.2, NAN, NAN),
                                 dry_scene("coulomb", "rigid", 0.2, 0.25, 0.05)};
    for (int k = 0; k < 3; ++k) {
        static fst_neighbours two, one;
        two = one = (fst_neighbours){.count = 9 - k, .parameter = -1};
        carry_neighbours(&scenes[k], 0, &two);
        carry_neighbours(&scenes[k], 1, &one);
        assert_memory_equal(two.d, one.d, sizeof one.d);
    }
}

/* Where a family of rolling locks ends on the cone, friction can just hold the contact: a slip there dies ever more
 * slowly, and creeps (ode/creep.c). */
static void slips_at_the_cone_creep(void **unused)
{
    (void)unused;
    fst_params params = dry_scene("coulomb", "rigid", 0.05, NAN, NAN);
    fst_locked_list locks;
    fst_family family;
    fst_setup setup;
    fst_error error;
    assert_int_equal(fst_locked_find(&params, NULL, &locks, &error), FST_OK);
    assert_true(locks.family_count > 0 && locks.families[0].from.end == FST_ROLLING_CONE);
    assert_int_equal(fst_family_begin(&family, &params, "drive.omega", &error), FST_OK);
    assert_int_equal(fst_family_setup(&family, fst_family_value(&family), &setup, &error), FST_OK);
    for (int i = 0; i < 8; ++i) {
        const double angle = 6.283185307179586 / 8 * i;
        double y[FST_STATE_SIZE], tangent[FST_STATE_SIZE][FST_COLUMNS] = {{0.0}};
        memcpy(y, locks.families[0].from.state, sizeof y);
        y[FST_VX] += 1e-9 * cos(angle);
        y[FST_VY] += 1e-9 * sin(angle);
        if (fst_carry(&setup, TOLERANCE, 1.0, y, tangent, &error) != FST_OK)
            fail_msg("%s", error.sentence);
    }
    fst_locked_free(&locks);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(slips_at_the_cone_creep), cmocka_unit_test(two_are_carried_like_one),
        cmocka_unit_test(columns_against_differences), cmocka_unit_test(differences_converge)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
