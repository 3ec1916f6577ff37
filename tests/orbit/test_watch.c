/* A caller can stop the search for orbits, branches and locked states anywhere. The callback is called often,
 * after a number of evaluations of the equations of motion and not after a time. Once it has refused it is not
 * called again, and hardly any work follows. The part of a branch that is kept is part of the whole branch,
 * without anything that only looks like a failure.
 * tests: base/watch.h orbit/search.c orbit/tracer.c orbit/locked.c
 * labels: counted numbers slow */
#include "branches.h"

#include "count/count_evaluations.h"

enum {
    LONGEST_GAP = 12000, /* evaluations between two calls; a processor does 10^6 in a second or in less time */
    REST = 3000,         /* evaluations after the refusal */
    MOMENTS = 5
};

typedef struct spy {
    long long last, longest; /* evaluations at the latest call; the longest gap */
    long calls, stop_at;     /* 0: never */
    int refused, called_again;
    double fraction;
    int fell; /* whether the fraction ever fell */
} spy;

static fst_status watch(void *user, double fraction, const char *what, fst_error *error)
{
    (void)what;
    spy *s = user;
    const long long gap = fst_test_evaluations - s->last;
    s->longest = gap > s->longest ? gap : s->longest;
    s->last = fst_test_evaluations;
    s->calls += 1;
    s->called_again += s->refused;
    s->fell += !(fraction >= s->fraction && fraction <= 1.0);
    s->fraction = fraction;
    if (s->stop_at == 0 || s->calls < s->stop_at)
        return FST_OK;
    s->refused = 1;
    error->code = FST_INTERRUPTED;
    (void)snprintf(error->sentence, sizeof error->sentence, "enough after %ld", s->calls);
    return FST_INTERRUPTED;
}

typedef struct job {
    const char *name;
    fst_status (*perform)(const struct job *job, const fst_progress *progress, fst_branch *branch,
                          fst_error *error);
    const char *set[3][2];
    fst_branch_kind kind;
    double from, to;
    int hard; /* the whole takes too long to wait for */
} job;

static fst_params scene_for(const job *j)
{
    fst_params params = fst_default_params();
    fst_error error;
    for (int i = 0; i < 3 && j->set[i][0]; ++i)
        if (fst_params_set(&params, j->set[i][0], j->set[i][1], &error) != FST_OK)
            fail_msg("%s", error.sentence);
    return params;
}

static fst_status an_orbit(const job *j, const fst_progress *progress, fst_branch *branch, fst_error *error)
{
    fst_orbit orbit;
    (void)branch;
    const fst_params params = scene_for(j);
    return fst_orbit_find(&params, progress, &orbit, error);
}

static fst_status locked_states(const job *j, const fst_progress *progress, fst_branch *branch,
                                fst_error *error)
{
    fst_locked_list list;
    (void)branch;
    const fst_params params = scene_for(j);
    const fst_status status = fst_locked_find(&params, progress, &list, error);
    fst_locked_free(&list);
    return status;
}

static fst_status festoons(const job *j, const fst_progress *progress, fst_branch *branch, fst_error *error)
{
    fst_festoon_list list;
    (void)branch;
    const fst_params params = scene_for(j);
    const fst_status status = fst_festoons_find(&params, 4.0, progress, &list, error);
    fst_festoons_free(&list);
    return status;
}

static fst_status a_branch(const job *j, const fst_progress *progress, fst_branch *branch, fst_error *error)
{
    const fst_params params = scene_for(j);
    fst_branch_options o = over_omega(j->kind, j->from, j->to);
    o.progress = progress;
    return fst_branch_follow(&params, &o, branch, error);
}

static fst_status over_two(const job *j, const fst_progress *progress, fst_branch *branch, fst_error *error)
{
    const fst_params params = scene_for(j);
    fst_branch_options o = over_omega(j->kind, j->from, j->to);
    o.progress = progress;
    o.second_key = "model.kappa";
    o.second_from = 1.45;
    o.second_to = 1.55;
    o.special = FST_SPECIAL_PITCHFORK;
    return fst_branch_follow(&params, &o, branch, error);
}

static int same_point(const fst_branch_point *a, const fst_branch_point *b)
{
    return a->value == b->value && a->mean_r == b->mean_r && a->stable == b->stable && a->branch == b->branch &&
           memcmp(a->state, b->state, sizeof a->state) == 0;
}

/* Every point, special point and end of a partial branch is also in the whole branch. */
static void check_part(const char *name, const fst_branch *part, const fst_branch *whole)
{
    assert_false(part->complete);
    for (size_t i = 0; i < part->point_count; ++i) {
        size_t k = 0;
        while (k < whole->point_count && !same_point(&part->points[i], &whole->points[k]))
            ++k;
        if (k == whole->point_count)
            fail_msg("%s: point %zu at %g is none of the whole branch", name, i, part->points[i].value);
    }
    for (size_t i = 0; i < part->special_count; ++i) {
        const fst_special *a = &part->specials[i];
        size_t k = 0;
        while (k < whole->special_count &&
               !(whole->specials[k].type == a->type && whole->specials[k].value == a->value &&
                 whole->specials[k].criticality == a->criticality))
            ++k;
        if (k == whole->special_count && !whole->second_key[0])
            fail_msg("%s: the special point at %g is none of the whole branch", name, a->value);
    }
    for (size_t i = 0; i < part->end_count; ++i) {
        const fst_branch_end *a = &part->ends[i];
        size_t k = 0;
        while (k < whole->end_count && !(whole->ends[k].branch == a->branch &&
                                         whole->ends[k].value == a->value && whole->ends[k].type == a->type))
            ++k;
        if (k == whole->end_count)
            fail_msg("%s: the end at %g is none of the whole branch: %s", name, a->value, a->reason);
    }
}

static fst_status perform(const job *j, spy *s, long stop_at, fst_branch *branch, fst_error *error)
{
    *s = (spy){.last = fst_test_evaluations, .stop_at = stop_at};
    const fst_progress progress = {s, watch};
    memset(branch, 0, sizeof *branch);
    const fst_status status = j->perform(j, &progress, branch, error);
    if (s->longest > LONGEST_GAP)
        fail_msg("%s: %lld evaluations between two calls", j->name, s->longest);
    assert_int_equal(s->fell, 0);
    return status;
}

static void stop_often(const job *j)
{
    fst_branch whole, part;
    fst_error error;
    spy s;
    long calls = 400;
    memset(&whole, 0, sizeof whole);
    if (!j->hard) {
        const fst_status status = perform(j, &s, 0, &whole, &error);
        if (status != FST_OK)
            fail_msg("%s: %s", j->name, error.sentence);
        calls = s.calls;
        print_message("%s: %ld calls, at most %lld evaluations between two\n", j->name, calls, s.longest);
    }
    for (int moment = 0; moment < MOMENTS; ++moment) {
        const double part_of = (double)moment / (MOMENTS - 1);
        const long stop_at = 1 + (long)((double)(calls - 1) * part_of * part_of);
        const fst_status status = perform(j, &s, stop_at, &part, &error);
        if (status != FST_INTERRUPTED)
            fail_msg("%s, refused at call %ld: status %d", j->name, stop_at, status);
        CHECK_CONTAINS(error.sentence, "enough after");
        assert_int_equal(s.called_again, 0);
        if (fst_test_evaluations - s.last > REST)
            fail_msg("%s, refused at call %ld: %lld evaluations more", j->name, stop_at,
                     fst_test_evaluations - s.last);
        if (!j->hard)
            check_part(j->name, &part, &whole);
        fst_branch_free(&part);
    }
    fst_branch_free(&whole);
}

#define H_SMALL                                                                                                \
    {                                                                                                          \
        {                                                                                                      \
            "model.h", "0.001"                                                                                 \
        }                                                                                                      \
    }
#define AT(omega)                                                                                              \
    {                                                                                                          \
        {                                                                                                      \
            "drive.omega", omega                                                                               \
        }                                                                                                      \
    }

static void ordinary_scenes(void **state)
{
    static const job jobs[] = {
        {"orbit", an_orbit, AT("0.3"), FST_BRANCH_COUNTER, 0, 0, 0},
        {"orbit beside the period halving", an_orbit, AT("0.2688"), FST_BRANCH_COUNTER, 0, 0, 0},
        {"libration", an_orbit, AT("0.0930"), FST_BRANCH_COUNTER, 0, 0, 0},
        {"locked", locked_states, AT("0.1"), FST_BRANCH_COUNTER, 0, 0, 0},
        {"counter", a_branch, AT("0.3"), FST_BRANCH_COUNTER, 0.2, 0.35, 0},
        {"locked families", a_branch, AT("0.3"), FST_BRANCH_LOCKED, 0.15, 0.2, 0},
        {"all", a_branch, AT("0.3"), FST_BRANCH_ALL, 0.148, 0.158, 0},
        {"over two", over_two, AT("0.27"), FST_BRANCH_COUNTER, 0.262, 0.276, 0},
    };
    (void)state;
    for (size_t i = 0; i < sizeof jobs / sizeof *jobs; ++i)
        stop_often(&jobs[i]);
}

/* A bead that nearly touches the lines of the magnet takes tiny steps, and its orbit is not found soon. */
static void hard_scenes(void **state)
{
    static const job jobs[] = {
        {"orbit, h small", an_orbit, H_SMALL, FST_BRANCH_COUNTER, 0, 0, 1},
        {"branch, h small", a_branch, H_SMALL, FST_BRANCH_COUNTER, 0.2, 3.0, 1},
        {"all, h small", a_branch, H_SMALL, FST_BRANCH_ALL, 0.02, 3.0, 1},
        {"festoons, h small", festoons, H_SMALL, FST_BRANCH_COUNTER, 0, 0, 1},
        {"a strong bead", a_branch, {{"model.kappa", "1e5"}}, FST_BRANCH_COUNTER, 0.2, 3.0, 1},
    };
    (void)state;
    for (size_t i = 0; i < sizeof jobs / sizeof *jobs; ++i)
        stop_often(&jobs[i]);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(ordinary_scenes), cmocka_unit_test(hard_scenes)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
