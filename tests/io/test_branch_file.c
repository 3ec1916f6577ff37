/* A branch that is written to a file and read back is the same in every member. A file in which a member has a
 * value that is not allowed is refused, and the sentence names the member.
 * tests: io/branch_read.c io/orbit_json.c */
#include "branches.h"

#include <stdlib.h>

#include <festoon/festoon_tools.h>

static const char PATH[] = "test_branch_file.json";

/* If a struct grows, this fails: write, read and fill in the new member below. (Padding counts as integers.) */
_Static_assert(sizeof(fst_levitation) == (12 + 6 + 4 + 2 * 11 + 1) * sizeof(double) + 4 * sizeof(int),
               "a new member");
_Static_assert(sizeof(fst_branch_point) ==
                   (13 + 2 * 9 + 10) * sizeof(double) + 6 * sizeof(int) + sizeof(fst_levitation),
               "a new member");
_Static_assert(sizeof(fst_special) == 2 * sizeof(double) + 6 * sizeof(int) + sizeof(fst_branch_point),
               "a new member");
_Static_assert(sizeof(fst_branch_end) == 4 * sizeof(int) + sizeof(double) + 192, "a new member");
_Static_assert(sizeof(fst_branch) == 2 * 64 + 6 * sizeof(double) + 6 * sizeof(int) + 7 * sizeof(void *),
               "a new member");

/* All numbers differ from each other and none is zero, so that no member can stand for another. */
static fst_levitation place_of(int i)
{
    fst_levitation l;
    memset(&l, 0, sizeof l);
    double *const numbers[] = {&l.height_mm, &l.tilt_deg, &l.circle_mm, &l.gap_mm, &l.residual};
    for (int k = 0; k < 5; ++k)
        *numbers[k] = 1.0 / (5.0 + 19.0 * i + k);
    for (int k = 0; k < 3; ++k) {
        l.position_m[k] = 1e-3 / (i + k + 1);
        l.w_per_s[k] = 1e3 / (i + k + 1);
    }
    for (int k = 0; k < FST_BEAD_NUMBERS; ++k)
        l.state[k] = 0.2 * (i + 1) + 1e-17 * k + k;
    l.stable = i % 2;
    l.family = i % 3 == 0;
    l.unstable = l.stable ? 0 : 2;
    for (int k = 0; k < FST_LEVITATION_DIRECTIONS; ++k) {
        l.eigenvalue_re[k] = (k < l.unstable ? 1.0 : -1.0) / (7.0 + i + k);
        l.eigenvalue_im[k] = 1e-300 * (i + k + 1);
    }
    return l;
}

static fst_branch_point point_of(int i, int eigenvalues, fst_branch_kind kind)
{
    fst_branch_point p;
    memset(&p, 0, sizeof p);
    double *const numbers[] = {&p.value,   &p.second,          &p.omega,      &p.mean_r, &p.mean_alpha_dot,
                               &p.mean_nz, &p.festoons,        &p.period,     &p.min_r,  &p.bead_angle_deg,
                               &p.slip,    &p.relaxation_time, &p.swing_ratio};
    for (int k = 0; k < 13; ++k)
        *numbers[k] = 1.0 / (3.0 + 17.0 * i + k);
    if (i % 3 == 1)
        p.festoons = p.second = p.relaxation_time = NAN;
    p.symmetry = i % 3 == 0 ? FST_SYMMETRY_NONE : i % 3 == 1 ? FST_SYMMETRY_S1 : FST_SYMMETRY_S2;
    p.stable = i % 2;
    p.turns = i % 3 - 1;
    p.branch = i % 4;
    if (kind == FST_BRANCH_LEVITATING) {
        p.levitation = place_of(i);
        return p;
    }
    p.levitation.height_mm = p.levitation.tilt_deg = p.levitation.circle_mm = p.levitation.gap_mm = NAN;
    p.multipliers = eigenvalues ? FST_EIGENVALUE_COUNT : FST_MULTIPLIER_COUNT;
    for (int k = 0; k < p.multipliers; ++k) {
        p.multiplier_re[k] = -1.0 / (7.0 + i + k);
        p.multiplier_im[k] = 1e-300 * (i + k + 1);
    }
    for (int k = 0; k < FST_STATE_SIZE && kind != FST_BRANCH_DRIVEN; ++k)
        p.state[k] = 0.1 * (i + 1) + 1e-17 * k + k;
    for (int k = 0; k < FST_BEAD_NUMBERS && kind == FST_BRANCH_DRIVEN; ++k)
        p.levitation.state[k] = 0.1 * (i + 1) + 1e-17 * k + k;
    return p;
}

/* Every type, kind and symmetry occurs, and every value that is not a number. */
static fst_branch made_up(fst_branch_kind kind)
{
    const int over_two = kind == FST_BRANCH_LOCKED;
    enum { POINTS = 7, TYPES = FST_SPECIAL_COUNT, ENDS = FST_END_COUNT };
    fst_branch b;
    memset(&b, 0, sizeof b);
    b.kind = kind;
    (void)snprintf(b.key, sizeof b.key, "drive.omega");
    b.from = -0.1;
    b.to = 2.0 / 3.0;
    b.branches = 5;
    b.complete = over_two;
    b.half_length = fst_default_params().magnet_half_length; /* they stand in the scene */
    b.gamma = fst_default_params().friction_gamma;
    if (over_two) {
        (void)snprintf(b.second_key, sizeof b.second_key, "model.kappa");
        b.second_from = 1.1;
        b.second_to = 7.0 / 3.0;
        b.followed = FST_SPECIAL_NEIMARK_SACKER;
    }
    b.points = calloc(POINTS, sizeof *b.points);
    b.specials = calloc(TYPES, sizeof *b.specials);
    b.ends = calloc(ENDS, sizeof *b.ends);
    assert_true(b.points && b.specials && b.ends);
    for (int i = 0; i < POINTS; ++i)
        b.points[b.point_count++] = point_of(i, i % 2, kind);
    for (int i = 0; i < TYPES; ++i) {
        fst_special *s = &b.specials[b.special_count++];
        s->type = (fst_special_type)i;
        s->value = 1.0 / (91.0 + i);
        s->omega = 1.0 / (191.0 + i);
        s->branch = 4 - i % 5;
        s->criticality = i % 3 - 1;
        s->born = i % 4 - 1;
        s->at = point_of(20 + i, i % 2, kind);
    }
    for (int i = 0; i < ENDS; ++i) {
        fst_branch_end *end = &b.ends[b.end_count++];
        end->branch = i % 5;
        end->type = (fst_end_type)i;
        end->family = i % 5 - 1;
        end->image = over_two || i == 1 ? -1 : i < 2 ? end->branch : 1;
        end->value = 1.0 / (291.0 + i);
        (void)snprintf(end->reason, sizeof end->reason, "the reason \"%d\", <r> = 8 \xc3\xa9", i);
    }
    return b;
}

/* Crossings stand in a list of their own and are read after the others. */
static void put_crossings_last(fst_branch *b)
{
    fst_special *sorted = calloc(b->special_count + 1, sizeof *sorted);
    size_t count = 0;
    assert_non_null(sorted);
    for (int crossing = 0; crossing < 2; ++crossing)
        for (size_t i = 0; i < b->special_count; ++i)
            if ((b->specials[i].type == FST_SPECIAL_TRANSCRITICAL) == crossing)
                sorted[count++] = b->specials[i];
    free(b->specials);
    b->specials = sorted;
}

/* Compares the lists byte by byte, and the members beside them. */
static void check_same(const fst_branch *a, const fst_branch *b)
{
    fst_branch head[2] = {*a, *b};
    for (int i = 0; i < 2; ++i) {
        head[i].points = NULL;
        head[i].specials = NULL;
        head[i].ends = NULL;
        head[i].scene = NULL; /* only of a branch that was read */
    }
    assert_memory_equal(&head[0], &head[1], sizeof head[0]);
    if (a->point_count > 0)
        assert_memory_equal(a->points, b->points, a->point_count * sizeof *a->points);
    if (a->special_count > 0)
        assert_memory_equal(a->specials, b->specials, a->special_count * sizeof *a->specials);
    if (a->end_count > 0)
        assert_memory_equal(a->ends, b->ends, a->end_count * sizeof *a->ends);
}

/* Each key of the scene, as a person would set it. */
static void check_same_scene(const fst_params *a, const fst_params *b)
{
    char values[2][256];
    assert_non_null(b);
    for (int i = 0; i < fst_params_row_count(a); ++i) {
        (void)fst_params_get(a, i, values[0], sizeof values[0]);
        (void)fst_params_get(b, i, values[1], sizeof values[1]);
        assert_string_equal(values[0], values[1]);
    }
}

static void check_round_trip(fst_branch *b)
{
    static const char *const given[][2] = {{"friction.law", "coulomb"},
                                           {"drive.omega", "0.3"},
                                           {"bead.radius", "2 mm"},
                                           {"magnet.width", "30 mm"},
                                           {"model.dynamics", "farago2020"}};
    fst_params params = fst_default_params();
    for (size_t i = 0; i < sizeof given / sizeof *given; ++i)
        assert_int_equal(fst_params_set(&params, given[i][0], given[i][1], NULL), FST_OK);
    fst_branch read;
    fst_error error;
    put_crossings_last(b);
    assert_int_equal(fst_branch_write(PATH, &params, b, &error), FST_OK);
    if (fst_branch_read(PATH, &read, &error) != FST_OK)
        fail_msg("%s: %s", error.where, error.sentence);
    check_same(b, &read);
    check_same_scene(&params, read.scene);
    char *first = fst_branch_json(&params, b, FST_SHOWN_SCALED),
         *second = fst_branch_json(&params, &read, FST_SHOWN_SCALED);
    assert_string_equal(first, second);
    free(first);
    free(second);
    fst_branch_free(&read);
}

static void every_member_comes_back(void **state)
{
    (void)state;
    for (int kind = FST_BRANCH_LOCKED; kind < FST_BRANCH_COUNT; ++kind) {
        fst_branch b = made_up((fst_branch_kind)kind);
        check_round_trip(&b);
        fst_branch_free(&b);
    }
}

static fst_status refuse(void *user, double fraction, const char *what, fst_error *error)
{
    (void)what;
    (void)fraction;
    if (--*(int *)user > 0)
        return FST_OK;
    error->code = FST_INTERRUPTED;
    return FST_INTERRUPTED;
}

/* Parts of a magnet stand in a list of objects. */
static void parts_of_the_scene_come_back(void **state)
{
    (void)state;
    static const char *const given[][2] = {{"magnet.shape", "parts"},
                                           {"magnet.parts[0].kind", "cylinder"},
                                           {"magnet.parts[0].size[0]", "10 mm"},
                                           {"magnet.parts[1].kind", "cuboid"},
                                           {"magnet.parts[1].remanence[0]", "1.1 T"}};
    fst_params params = fst_default_params();
    fst_branch b = made_up(FST_BRANCH_LOCKED), read;
    fst_error error;
    for (size_t i = 0; i < sizeof given / sizeof *given; ++i)
        if (fst_params_set(&params, given[i][0], given[i][1], &error) != FST_OK)
            fail_msg("%s: %s", error.where, error.sentence);
    put_crossings_last(&b);
    assert_int_equal(params.magnet_part_count, 2);
    assert_int_equal(fst_branch_write(PATH, &params, &b, &error), FST_OK);
    assert_int_equal(fst_branch_read(PATH, &read, &error), FST_OK);
    check_same_scene(&params, read.scene);
    fst_branch_free(&read);
    fst_branch_free(&b);
}

/* Branches that the program makes: a finished one, one stopped on the way, one over two parameters. */
static void real_branches_come_back(void **state)
{
    (void)state;
    const fst_params params = scene_of(0.27, "rigid");
    fst_branch_options o = over_omega(FST_BRANCH_ALL, 0.085, 0.095);
    fst_branch b = followed(&params, &o);
    assert_true(b.special_count > 1 && b.end_count > 1 && b.complete);
    check_round_trip(&b);
    fst_branch_free(&b);
    int calls = 300;
    const fst_progress progress = {&calls, refuse};
    o.progress = &progress;
    assert_int_equal(fst_branch_follow(&params, &o, &b, NULL), FST_INTERRUPTED);
    assert_true(b.point_count > 0 && !b.complete);
    check_round_trip(&b);
    fst_branch_free(&b);
    o = over_omega(FST_BRANCH_COUNTER, 0.262, 0.276);
    o.second_key = "model.kappa";
    o.second_from = 1.49;
    o.second_to = 1.51;
    o.special = FST_SPECIAL_PITCHFORK;
    b = followed(&params, &o);
    assert_true(b.point_count > 2);
    check_round_trip(&b);
    fst_branch_free(&b);
}

/* `text` with the first `old` after `after` replaced. */
static char *changed(const char *text, const char *after, const char *old, const char *new_text)
{
    const char *from = strstr(text, after);
    const char *at = from ? strstr(from, old) : NULL;
    if (!at)
        fail_msg("no \"%s\" after \"%s\" in the file", old, after);
    char *out = malloc(strlen(text) + strlen(new_text) + 1);
    assert_non_null(out);
    (void)sprintf(out, "%.*s%s%s", (int)(at - text), text, new_text, at + strlen(old));
    return out;
}

static void put_file(const char *text)
{
    FILE *out = fopen(PATH, "w");
    assert_non_null(out);
    assert_true(fputs(text, out) >= 0);
    assert_int_equal(fclose(out), 0);
}

static void other_members_are_refused(void **state)
{
    static const struct {
        const char *after, *old, *new_text, *named;
    } faults[] = {
        {"\"specials\"", "\"fold\"", "\"cusp\"", "specials[0].type must be one of fold|pitchfork|"},
        {"\"specials\"", "\"type\": \"fold\"", "\"type\": 0", "specials[0].type"},
        {"\"specials\"", "\"type\": \"fold\",", "", "specials[0].type is missing: it must be one of"},
        {"\"crossings\"", "\"transcritical\"", "\"Fold\"", "crossings[0].type"},
        {"{", "\"all\"", "\"al\"", "kind must be one of counter|locked|all|levitating|driven, not \"al\""},
        {"{", "\"drive.omega\"", "\"drive.omega\\n`id`\"", "parameter must be a key of the scene"},
        {"{", "\"drive.omega\"", "\"drive.omega\\u0000x\"", "this is not JSON"},
        {"{", "\"drive.omega\"", "\"model.dynamics\"", "parameter"},
        {"\"specials\"", "\"drive.omega\"", "\"model.h\"", "specials[0].parameter"},
        {"{", "\"complete\": false", "\"complete\": 0", "complete must be true or false"},
        {"{", "\"branches\": 5", "\"branches\": -5", "branches must be an integer from 0"},
        {"{", "\"branches\": 5", "\"branches\": -7", ", not -7"},
        {"{", "\"branches\": 5", "\"branches\": 3", "branch must be an integer from 0 to 2"},
        {"{", "\"from\": ", "\"from\": \"x\", \"old\": ", "from must be a number, not"},
        {"\"specials\"", "\"criticality\": \"subcritical\"", "\"criticality\": \"super\"",
         "specials[0].criticality"},
        {"\"specials\"", "\"born\": null", "\"born\": 1.5", "specials[0].born"},
        {"\"specials\"", "\"born\": null", "\"born\": 99999999999", "specials[0].born"},
        {"\"specials\"", "\"born\": null,", "",
         "specials[0].born is missing: it must be an integer from 0 to 4"},
        {"\"ends\"", "\"image_under_s2\": \"itself\"", "\"image_under_s2\": \"me\"", "ends[0].image_under_s2"},
        {"\"ends\"", "\"born_on\": null", "\"born_on\": \"null\"", "ends[0].born_on"},
        {"\"ends\"", "\"type\": \"closed\"", "\"type\": \"close\"",
         "ends[2].type must be one of none|range|closed|"},
        {"\"ends\"", "the reason", "the\\u001b[31m reason", "ends[0].reason must be a short text"},
        {"\"points\"", "\"symmetry\": \"S1\"", "\"symmetry\": \"S3\"", "points[1].symmetry"},
        {"\"points\"", "\"stable\": false", "\"stable\": null", "points[0].stable"},
        {"\"points\"", "\"turns\": -1", "\"turns\": \"-1\"", "points[0].turns"},
        {"\"points\"", "\"mean_r\": ", "\"mean_r\": \"0\", \"mean\": ", "points[0].mean_r must be a number"},
        {"\"points\"", "\"multipliers\"", "\"multiplier\"", "points[0].multipliers is missing: it must be"},
        {"\"points\"", "\"state\": [", "\"state\": [1, ", "points[0].state must be 10 numbers"},
        {"\"points\"", "\"value\"", "\"value\": 1, \"value\"", "duplicate"},
        {"{", "\"kind\"", "kind", "line 2"},
    };
    (void)state;
    const fst_params params = fst_default_params();
    fst_branch b = made_up(FST_BRANCH_ALL), read;
    fst_error error;
    char *text = fst_branch_json(&params, &b, FST_SHOWN_SCALED);
    put_file(text);
    assert_int_equal(fst_branch_read(PATH, &read, &error), FST_OK);
    fst_branch_free(&read);
    for (size_t i = 0; i < sizeof faults / sizeof *faults; ++i) {
        char *wrong = changed(text, faults[i].after, faults[i].old, faults[i].new_text);
        put_file(wrong);
        free(wrong);
        if (fst_branch_read(PATH, &read, &error) != FST_BAD_INPUT)
            fail_msg("taken for a branch: %s instead of %s", faults[i].new_text, faults[i].old);
        CHECK_CONTAINS(error.where, PATH);
        CHECK_CONTAINS(error.sentence, faults[i].named);
        assert_null(read.points);
    }
    free(text);
    fst_branch_free(&b);
    assert_int_equal(fst_branch_read("no/such/file.json", &read, &error), FST_BAD_INPUT);
    (void)remove(PATH);
}

/* `text` with the first `"key": ...` after `after` made this integer. */
static char *with_integer(const char *text, const char *after, const char *key, int value)
{
    char old[256], name[64], made[96];
    const char *from = strstr(text, after);
    (void)snprintf(name, sizeof name, "\"%s\": ", key);
    const char *at = from ? strstr(from, name) : NULL;
    if (!at)
        fail_msg("no %s after %s in the file", name, after);
    (void)snprintf(old, sizeof old, "%.*s", (int)strcspn(at, ",}\n"), at);
    (void)snprintf(made, sizeof made, "%s%d", name, value);
    return changed(text, after, old, made);
}

/* A locked state has nine eigenvalues: one more or less is refused. */
static void eigenvalues_are_nine(void **state)
{
    (void)state;
    const fst_params params = fst_default_params();
    fst_branch b = made_up(1), read;
    fst_error error;
    char *text = fst_branch_json(&params, &b, FST_SHOWN_SCALED);
    char *list = strstr(text, "\"eigenvalues\": [");
    assert_non_null(list);
    char *from = strchr(list, '[') + 1, *next = strstr(from, "],") + 2;
    memmove(from, next, strlen(next) + 1);
    put_file(text);
    assert_int_equal(fst_branch_read(PATH, &read, &error), FST_BAD_INPUT);
    assert_non_null(strstr(error.sentence, "9 eigenvalues"));
    free(text);
    fst_branch_free(&b);
    (void)remove(PATH);
}

/* Every integer takes the borders of its range, and nothing beyond: the branches are numbered from 0 to 4. */
static void integers_end_at_their_borders(void **state)
{
    static const struct {
        const char *after, *key;
        int least, most;
    } integers[] = {
        {"\"points\"", "branch", 0, 4},       {"\"points\"", "turns", -1000000, 1000000},
        {"\"specials\"", "branch", 0, 4},     {"\"specials\"", "born", 0, 4},
        {"\"at\"", "branch", 0, 4},           {"\"at\"", "turns", -1000000, 1000000},
        {"\"crossings\"", "branch", 0, 4},    {"\"crossings\"", "born", 0, 4},
        {"\"ends\"", "branch", 0, 4},         {"\"ends\"", "born_on", 0, 4},
        {"\"ends\"", "image_under_s2", 0, 4}, {"{", "branches", 5, 1000000},
    };
    (void)state;
    const fst_params params = fst_default_params();
    fst_branch b = made_up(FST_BRANCH_ALL), read;
    fst_error error;
    char *text = fst_branch_json(&params, &b, FST_SHOWN_SCALED);
    for (size_t i = 0; i < sizeof integers / sizeof *integers; ++i)
        for (int beyond = 0; beyond < 4; ++beyond) {
            const int value = beyond % 2 ? integers[i].most + beyond / 2 : integers[i].least - beyond / 2;
            char *made = with_integer(text, integers[i].after, integers[i].key, value);
            put_file(made);
            free(made);
            const fst_status status = fst_branch_read(PATH, &read, &error);
            if (status != (beyond < 2 ? FST_OK : FST_BAD_INPUT))
                fail_msg("%s of %s may %sbe %d", integers[i].key, integers[i].after, beyond < 2 ? "not " : "",
                         value);
            if (status == FST_OK)
                fst_branch_free(&read);
        }
    free(text);
    fst_branch_free(&b);
    (void)remove(PATH);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(every_member_comes_back),       cmocka_unit_test(parts_of_the_scene_come_back),
        cmocka_unit_test(real_branches_come_back),       cmocka_unit_test(other_members_are_refused),
        cmocka_unit_test(integers_end_at_their_borders), cmocka_unit_test(eigenvalues_are_nine),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
