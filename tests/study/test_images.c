/* A run that is interrupted and goes on from its image ends with the bits of an undisturbed run, in every form
 * of arithmetic, however often and wherever it is interrupted. Bytes that are not an image of the run are ignored.
 * tests: study/run_image.c study/lane_images.c study/lone_run.c
 * labels: slow */
#include <stdio.h>
#include <stdlib.h>

#include "lanes/lanes.h"
#include "physics.h"
#include "same_results.h"
#include "study/run_image.h"

enum { JOBS = 24, TASKS_WITHOUT_DISCARD = 3, SETTLING = 12, LIBRATING = 16, REPEATING = 20 };

/* Low and high drives, both dynamics, orbits that librate, do not close or are chaotic (which need an
 * exponent), beads that leave the plate, and a scene that is refused. */
static fst_params job_params(int i)
{
    fst_params p = bead_at(0.3 + 0.07 * i, FST_DYNAMICS_RIGID);
    p.run_periods = 12 + 5 * (i % 4);
    p.run_rtol = 1e-7;
    p.model_kappa = 1.0 + 0.25 * (i % 4);
    if (i % 9 < TASKS_WITHOUT_DISCARD)
        p.run_discard = 0;
    if (i % 6 == 3)
        p.model_dynamics = FST_DYNAMICS_FARAGO2020;
    if (i == 7)
        p.magnet_lines = 3; /* shares no batch with the others */
    if (i == 13)
        p.start_r = p.model_eps = 0.2; /* a start in free rolling does not exist here */
    if (i == SETTLING) {
        p = fst_default_params(); /* a libration that is known by the maxima of r */
        p.drive_frequency = 7.29;
        p.model_kappa = 1.035;
        p.run_periods = 120;
        p.run_rtol = 1e-8;
        p.run_until = FST_UNTIL_SETTLED;
    }
    if (i >= REPEATING) {
        p = fst_default_params(); /* these repeat themselves, and are not observed for a part of their windows
                                   */
        p.drive_frequency = 10.7 + 2.0 * (i - REPEATING);
        p.run_periods = 50;
        p.run_discard = 15;
        p.run_rtol = 1e-7;
        p.run_until = i % 2 ? FST_UNTIL_SETTLED : FST_UNTIL_PERIODS;
    } else if (i >= LIBRATING) {
        p = fst_default_params(); /* these librate, and need an exponent */
        p.drive_frequency = 6.57 + 0.02 * (i - LIBRATING);
        p.model_kappa = 0.93;
        p.run_periods = i % 2 ? 24 : 26;
        p.run_discard = 12;
    }
    return p;
}

typedef struct image {
    void *bytes;
    size_t size;
} image;

typedef struct store {
    int next;
    int patience; /* the engine is told to stop after it has asked so many times; 0: never */
    int looks, broken_off, found, spoilt;
    fst_run_result results[JOBS];
    fst_status statuses[JOBS];
    int done[JOBS];
    int stations[FST_STATION_COUNT]; /* how many images of each station were found */
    int parked;                      /* images saved of runs that wait for their exponents */
    image images[JOBS];
    void (*spoil)(struct store *s, image *i); /* changes an image before it is found again; NULL: leaves it */
} store;

static int next_job(void *user, fst_row_job *job)
{
    store *s = user;
    while (s->next < JOBS && s->done[s->next])
        ++s->next;
    if (s->next == JOBS)
        return 0;
    memset(job, 0, sizeof *job);
    job->point = s->next++;
    job->params = job_params((int)job->point);
    return 1;
}

static int job_done(void *user, fst_row_job *job, fst_status status, const fst_run_result *result,
                    const fst_error *error)
{
    (void)error;
    store *s = user;
    assert_false(s->done[job->point]);
    s->done[job->point] = 1;
    s->results[job->point] = *result;
    s->statuses[job->point] = status;
    return 0;
}

static fst_status answer(void *user, double fraction, const char *what, fst_error *error)
{
    store *s = user;
    (void)fraction, (void)what;
    if (s->patience == 0 || ++s->looks <= s->patience)
        return FST_OK;
    (void)snprintf(error->sentence, sizeof error->sentence, "no more patience");
    return error->code = FST_INTERRUPTED;
}

static void save(void *user, const fst_row_job *job, const void *bytes, size_t size)
{
    store *s = user;
    image *i = &s->images[job->point];
    assert_false(s->done[job->point]);
    free(i->bytes);
    i->bytes = malloc(size);
    assert_non_null(i->bytes);
    memcpy(i->bytes, bytes, size);
    i->size = size;
    fst_run_place place;
    memcpy(&place, (const unsigned char *)bytes + sizeof(uint64_t), sizeof place);
    s->parked += place.station == FST_STATION_PARKED;
}

static void *find(void *user, const fst_row_job *job, size_t *size)
{
    store *s = user;
    image *i = &s->images[job->point];
    void *bytes = i->bytes;
    if (!bytes)
        return NULL;
    s->found += 1;
    fst_run_place place; /* it stands behind the number of the layout */
    memcpy(&place, (const unsigned char *)bytes + sizeof(uint64_t), sizeof place);
    s->stations[place.station] += 1;
    if (s->spoil)
        s->spoil(s, i);
    *size = i->size;
    i->bytes = NULL;
    return bytes;
}

static void clear(store *s)
{
    for (int i = 0; i < JOBS; ++i)
        free(s->images[i].bytes);
    memset(s, 0, sizeof *s);
}

/* Does all jobs, interrupted again and again, each time after some more questions than before, so that it ends:
 * the sooner where every image is spoilt, and each time begins anew. */
static void do_all(store *s, fst_arithmetic arithmetic, int lanes, int other_lanes, int patience)
{
    const fst_row_images images = {.user = s, .seconds = 0.0, .save = save, .find = find};
    fst_status status = FST_INTERRUPTED;
    s->patience = patience;
    for (int turn = 0; status == FST_INTERRUPTED; ++turn) {
        const fst_progress progress = {s, answer};
        const fst_row_work work = {.user = s,
                                   .arithmetic = arithmetic,
                                   .lanes = turn % 2 == 0 ? lanes : other_lanes,
                                   .next = next_job,
                                   .done = job_done,
                                   .progress = &progress};
        fst_error error = {FST_OK, "", ""};
        s->next = s->looks = 0;
        status = fst_rows_with_images(&work, &images, &error);
        if (status != FST_OK && status != FST_INTERRUPTED)
            fail_msg("fst_rows_with_images: %s", error.sentence);
        if (status == FST_INTERRUPTED) {
            assert_int_equal(s->looks, s->patience + 1); /* it stopped when it was first told to */
            assert_string_equal(error.sentence, "no more patience");
            s->broken_off += 1;
        }
        s->patience += s->spoil ? s->patience / 4 : patience > 0;
    }
    for (int i = 0; i < JOBS; ++i)
        assert_true(s->done[i]);
}

static fst_status refuse(void *user, double fraction, const char *what, fst_error *error)
{
    (void)user, (void)what;
    assert_true(fraction == 0.0);
    (void)snprintf(error->sentence, sizeof error->sentence, "the disk is full");
    return error->code = FST_IO;
}

/* Whatever the caller answers is handed back, and is not a failure of the runs that were at work. */
static void test_any_answer_ends_the_rows(void **state)
{
    (void)state;
    static store s;
    const fst_progress progress = {NULL, refuse};
    for (int lanes = 1; lanes <= 4; lanes += 3) {
        const fst_row_work work = {&s, FST_ARITHMETIC_PORTABLE, lanes, next_job, job_done, &progress};
        fst_error error = {FST_OK, "", ""};
        if (lanes > 1 && !fst_lane_engine_of(FST_ARITHMETIC_PORTABLE, lanes))
            continue;
        assert_int_equal(fst_rows(&work, &error), FST_IO);
        assert_string_equal(error.sentence, "the disk is full");
        for (int i = 0; i < JOBS; ++i)
            assert_false(s.done[i]);
        s.next = 0;
    }
}

static void check_same(const store *a, const store *b)
{
    for (int i = 0; i < JOBS; ++i) {
        assert_int_equal(a->statuses[i], b->statuses[i]);
        check_same_result(i, &a->results[i], &b->results[i]);
    }
}

static void test_bits(void **state)
{
    (void)state;
    static store whole, parts;
    int stations[FST_STATION_COUNT] = {0}, fused = 0;
    static const struct {
        fst_arithmetic arithmetic;
        int lanes, other_lanes;
    } kinds[] = {{FST_ARITHMETIC_PORTABLE, 1, 1},
                 {FST_ARITHMETIC_PORTABLE, 4, 8},
                 {FST_ARITHMETIC_PORTABLE, 8, 1},
                 {FST_ARITHMETIC_AVX2, 0, 0},
                 {FST_ARITHMETIC_AVX512, 0, 0}};
    for (size_t k = 0; k < sizeof kinds / sizeof *kinds; ++k) {
        const int lanes = kinds[k].lanes, others = kinds[k].other_lanes;
        if (lanes != 1 && !fst_lane_engine_of(kinds[k].arithmetic, lanes))
            continue;
        if (others != 1 && !fst_lane_engine_of(kinds[k].arithmetic, others))
            continue;
        do_all(&whole, kinds[k].arithmetic, lanes, lanes, 0);
        int exponents = 0;
        for (int i = 0; i < JOBS; ++i)
            exponents += whole.statuses[i] == FST_OK && !isnan(whole.results[i].largest_exponent);
        assert_true(exponents > 2);
        assert_int_equal(whole.results[SETTLING].regime, FST_REGIME_LIBRATING);
        assert_true(whole.results[SETTLING].settled_at > 20.0);
        for (int patience = 3; patience < 30; patience += 17) {
            do_all(&parts, kinds[k].arithmetic, lanes, others, patience);
            assert_true(parts.broken_off > 3);
            assert_true(parts.found > 8);
            check_same(&whole, &parts);
            for (int station = 0; station < FST_STATION_COUNT; ++station)
                stations[station] += parts.stations[station];
            clear(&parts);
        }
        fused = fused || kinds[k].arithmetic != FST_ARITHMETIC_PORTABLE;
        clear(&whole);
    }
    assert_true(stations[FST_STATION_ALONE] > 0 && stations[FST_STATION_PARKED] > 0 &&
                stations[FST_STATION_OBSERVED] > 0);
    assert_true(!fused || stations[FST_STATION_RUN_UP] > 0);
}

static void cut(store *s, image *i)
{
    i->size -= 1 + (size_t)(s->spoilt++ % 7) * 640;
}

static void of_another_build(store *s, image *i)
{
    unsigned char *bytes = i->bytes;
    bytes[s->spoilt++ % 8] ^= 1;
    for (size_t k = i->size / 2; k < i->size; k += 8) /* the numbers in it are wrong */
        bytes[k] ^= 1;
}

static void with_wild_numbers(store *s, image *i)
{
    /* Spoils every byte behind the layout in turn: a wrong count, stride or station must be noticed. */
    (void)s;
    memset((unsigned char *)i->bytes + 8, 0xff, i->size - 8);
    s->spoilt += 1;
}

static void empty(store *s, image *i)
{
    i->size = 0;
    s->spoilt += 1;
}

static void test_what_is_no_image(void **state)
{
    (void)state;
    static store whole, parts;
    static void (*const ways[])(store *, image *) = {cut, of_another_build, with_wild_numbers, empty};
    const fst_arithmetic best = fst_best_arithmetic();
    do_all(&whole, best, 0, 0, 0);
    for (size_t w = 0; w < sizeof ways / sizeof *ways; ++w) {
        parts.spoil = ways[w];
        do_all(&parts, best, 0, 0, 12);
        assert_true(parts.spoilt > 8);
        check_same(&whole, &parts);
        clear(&parts);
    }
    clear(&whole);
}

/* Lanes that compute exponents ask as often as others whether to stop. Each time they save the images of all
 * runs that wait for an exponent, and no other run is in work. */
static void test_exponents_hear(void **state)
{
    (void)state;
    static store s;
    for (int lanes = 4; lanes <= 8; lanes += 4) {
        if (!fst_lane_engine_of(FST_ARITHMETIC_PORTABLE, lanes))
            continue;
        for (int i = 0; i < JOBS; ++i)
            s.done[i] = i < LIBRATING || i >= REPEATING; /* only the librating ones remain */
        do_all(&s, FST_ARITHMETIC_PORTABLE, lanes, lanes, 1000000);
        for (int i = LIBRATING; i < REPEATING; ++i)
            assert_true(!isnan(s.results[i].largest_exponent));
        print_message("%d images of %d runs that are parked\n", s.parked, REPEATING - LIBRATING);
        assert_true(s.parked >= 10 * (REPEATING - LIBRATING));
        clear(&s);
    }
}

/* A run takes the motion from its image but keeps its own parameters, model and flow, also if the image was
 * made with other parameters. An image that is refused changes nothing in the run. */
static void test_what_a_run_takes_up(void **state)
{
    (void)state;
    static fst_watched_run from, to;
    const fst_params p = job_params(1), other = job_params(2);
    fst_exponent exponent;
    for (int cut_off = 0; cut_off < 2; ++cut_off) {
        const fst_run_place place = {.station = FST_STATION_ALONE};
        fst_run_place found = {.station = FST_STATION_PARKED};
        double *lane;
        const double *read;
        size_t size;
        int over = 0;
        assert_int_equal(fst_watched_run_begin(&from, &p, NULL, NULL), FST_OK);
        assert_int_equal(fst_watched_run_begin(&to, &other, NULL, NULL), FST_OK);
        assert_int_equal(fst_watched_run_go_on(&from, 50, &over, NULL), FST_OK);
        const fst_watched_run begun = to;
        const uint64_t steps = cut_off ? 0 : from.flow->accepted;
        void *bytes = fst_run_image_make(&from, NULL, &place, 0, &lane, &size);
        assert_non_null(bytes);
        const int taken = fst_run_image_take(bytes, size - (size_t)cut_off, 0, &to, &exponent, &found, &read);
        assert_int_equal(taken, !cut_off);
        assert_int_equal(found.station, cut_off ? FST_STATION_PARKED : FST_STATION_ALONE);
        assert_int_equal(to.flow->accepted, steps);
        assert_ptr_equal(to.params, &other);
        assert_ptr_equal(to.model, begun.model);
        assert_ptr_equal(to.flow, begun.flow);
        assert_memory_equal(&to.window.groups, &begun.window.groups, sizeof to.window.groups);
        assert_memory_equal(cut_off ? &begun.window.quadrature : &from.window.quadrature, &to.window.quadrature,
                            sizeof to.window.quadrature);
        free(bytes);
        fst_watched_run_free(&from);
        fst_watched_run_free(&to);
    }
}

/* A bead under a law with modes whose plate may resist rolling, and on which it may fly. */
static fst_params dry_params(double resistance, double restitution)
{
    fst_params p = bead_at(0.3, FST_DYNAMICS_RIGID);
    p.friction_law = FST_FRICTION_COULOMB;
    p.friction_rolling_resistance = resistance;
    p.impact_restitution = restitution;
    return p;
}

/* Whether a run with the parameters p takes up the image of a run in these modes. */
static int takes_up(const fst_params *p, int contact, int rolling)
{
    static fst_watched_run from, to;
    const fst_params any = dry_params(0.1, 0.5);
    const fst_run_place place = {.station = FST_STATION_ALONE};
    fst_run_place found;
    fst_exponent exponent;
    double *lane;
    const double *read;
    size_t size;
    assert_int_equal(fst_watched_run_begin(&from, &any, NULL, NULL), FST_OK);
    assert_int_equal(fst_watched_run_begin(&to, p, NULL, NULL), FST_OK);
    from.flow->step.context.modes.contact = contact;
    from.flow->step.context.modes.rolling = rolling;
    void *bytes = fst_run_image_make(&from, NULL, &place, 0, &lane, &size);
    assert_non_null(bytes);
    const int taken = fst_run_image_take(bytes, size, 0, &to, &exponent, &found, &read);
    free(bytes);
    fst_watched_run_free(&from);
    fst_watched_run_free(&to);
    return taken;
}

/* A run takes up no modes that its law does not know, and all others. */
static void test_modes_that_a_run_may_have(void **state)
{
    (void)state;
    const fst_params laws[] = {bead_at(0.3, FST_DYNAMICS_RIGID), dry_params(0, NAN), dry_params(0, 0.5),
                               dry_params(0.1, NAN), dry_params(0.1, 0.5)};
    for (int law = 0; law < 5; ++law)
        for (int contact = 0; contact <= FST_MODES; ++contact)
            for (int rolling = 0; rolling <= FST_ROLL_MODES; ++rolling) {
                const int flies = law == 2 || law == 4, rests = law >= 3;
                const int of_contact = contact == FST_MODE_SLIP || (law > 0 && contact < FST_MODE_FLIGHT) ||
                                       (flies && contact == FST_MODE_FLIGHT);
                const int of_rolling = rolling == FST_ROLL_ROLLS || (rests && rolling < FST_ROLL_MODES);
                if (takes_up(&laws[law], contact, rolling) != (of_contact && of_rolling))
                    fail_msg("law %d, modes %d and %d", law, contact, rolling);
            }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_bits),
        cmocka_unit_test(test_any_answer_ends_the_rows),
        cmocka_unit_test(test_what_is_no_image),
        cmocka_unit_test(test_exponents_hear),
        cmocka_unit_test(test_what_a_run_takes_up),
        cmocka_unit_test(test_modes_that_a_run_may_have),
    };
    return fst_run_images_possible() ? cmocka_run_group_tests(tests, NULL, NULL) : 77;
}
