/* measure_coverage.h - many films, measured: how often is the truth within the errors? */
#ifndef FST_TESTS_MEASURE_COVERAGE_H
#define FST_TESTS_MEASURE_COVERAGE_H

#include "numeric.h"

#include <stdio.h>

#include "base/constants.h"
#include "made_tracks.h"

enum {
    COVERED_MEAN,
    COVERED_STD,
    COVERED_BEAD,
    COVERED_FESTOONS,
    COVERED_DRIVE,
    COVERED_RADIAL,
    COVERED_TILT,
    COVERED
};
static const char *const covered_names[COVERED] = {
    "mean_r",  "std_r", "bead_frequency_hz", "festoons", "drive_from_track_hz", "radial_frequency_hz",
    "tilt_deg"};

/* Motions in both symmetries, at both ends of what the paper shows. */
enum { MOTIONS = 5 };
static const double usual_drives[MOTIONS] = {11.5, 19.9, 10.7, 12.4, 15.6};

/* The first `count` motions, followed for so many seconds. */
static inline void make_motions(made_motion *motions, const double *drives_hz, int count, double seconds)
{
    for (int i = 0; i < count; ++i) {
        fst_params params = fst_default_params();
        params.drive_frequency = drives_hz[i];
        params.run_periods = ceil((seconds + 1.0) * drives_hz[i]) + 150.0;
        params.run_discard = 150.0;
        params.run_rtol = 1e-9;
        made_motion_follow(&motions[i], &params);
        assert_int_equal(motions[i].regime, FST_REGIME_COUNTER_ROTATING);
    }
}

/* A film with faults drawn by chance: everything but a wrong clock comes in any mixture. */
static inline made_film random_film(uint64_t *chance, double longest, int *has_drive)
{
    static const double rates[] = {60, 100, 120, 200, 239.76, 240};
    static const double clocks[] = {1, 1, 1, 8, 4};
    made_film film = made_film_plain();
    film.fps = rates[(int)(6 * made_chance(chance))];
    film.seconds = 4.0 + (longest - 5.0) * made_chance(chance);
    film.start = 0.5 * made_chance(chance);
    film.scale = 2.0 + 6.0 * made_chance(chance);
    film.noise = 0.05 + 0.4 * made_chance(chance);
    film.tilt = made_chance(chance) < 0.4 ? 0.0 : 30.0 * made_chance(chance);
    film.along = 180.0 * made_chance(chance);
    film.lost = made_chance(chance) < 0.5 ? 0.0 : 0.3 * made_chance(chance);
    film.wild = made_chance(chance) < 0.5 ? 0.0 : 0.03 * made_chance(chance);
    film.exposure = made_chance(chance) < 0.5 ? 0.0 : made_chance(chance) * fmin(1.0 / film.fps, 1.0 / 120);
    film.mirrored = made_chance(chance) < 0.3;
    film.clock = film.fps == 240 ? clocks[(int)(5 * made_chance(chance))] : 1.0;
    *has_drive = film.fps < 110 || film.clock != 1.0 || film.mirrored || made_chance(chance) < 0.5;
    film.seed = (uint64_t)(1e15 * made_chance(chance));
    return film;
}

/* A film of so few frames a second that it shows most festoons as slower ones. */
static inline made_film coarse_film(uint64_t *chance, double longest, int *has_drive)
{
    made_film film = random_film(chance, longest, has_drive);
    film.fps = 12.0 + 48.0 * made_chance(chance);
    film.seconds = 5.0 + (longest - 6.0) * made_chance(chance);
    film.exposure = made_chance(chance) < 0.3 ? 0.0 : made_chance(chance) / film.fps;
    film.clock = 1.0;
    film.wild = 0.0;
    *has_drive = film.mirrored || made_chance(chance) < 0.6;
    return film;
}

typedef struct coverage {
    int within[COVERED][2], counted, known[COVERED]; /* known: it has an error */
    double farthest[COVERED];
} coverage;

/* Measure a film and count. */
static inline fst_measurement cover_film(coverage *c, int number, const made_motion *motion,
                                         const made_film *film, int has_drive)
{
    fst_track track;
    fst_measure_options options = fst_default_measure_options();
    fst_measurement m;
    fst_error error = {FST_OK, "", ""};
    options.exposure = film->exposure > 0 ? film->exposure : NAN;
    options.drive = has_drive ? (film->mirrored ? -motion->drive : motion->drive) : NAN;
    made_track(motion, film, &track);
    if (fst_measure_track(&track, &options, &m, &error) != FST_OK)
        fail_msg("film %d: %s", number, error.sentence);
    const double found[COVERED][3] = {
        {m.mean_r, m.mean_r_error, film->scale * motion->mean_r},
        {m.std_r, m.std_r_error, film->scale * motion->std_r},
        {m.bead_frequency_hz, m.bead_frequency_hz_error, motion->bead},
        {m.festoons, m.festoons_error, motion->festoons},
        {m.drive_from_track_hz, m.drive_from_track_hz_error, motion->drive},
        {m.radial_frequency_hz, m.radial_frequency_hz_error, motion->festoons * fabs(motion->bead)},
        {m.tilt_deg, m.tilt_deg_error, film->tilt},
    };
    ++c->counted;
    for (int q = 0; q < COVERED; ++q) {
        const double z = fabs(found[q][0] - found[q][2]) / found[q][1];
        c->within[q][0] += z < 1.0;
        c->within[q][1] += z < 2.0;
        c->known[q] += !isnan(z);
        c->farthest[q] = fmax(c->farthest[q], isnan(z) ? 0.0 : z);
        if (z >= 4.5)
            print_message(
                "film %d, %s: %.9g +- %.2g, truth %.9g: drive %g, %g frames a second for %g s, noise %.2f, "
                "tilt %.1f, exposure %.4f, lost %.2f, wild %.3f, clock %g\n",
                number, covered_names[q], found[q][0], found[q][1], found[q][2], motion->drive, film->fps,
                film->seconds, film->noise, film->tilt, film->exposure, film->lost, film->wild, film->clock);
    }
    fst_track_free(&track);
    return m;
}

/* Of each number at least `least` films have an error, and the truth lies within it as often as chance makes of 68 and 95
 * in 100, but for `below` standard deviations; six are let pass upwards, because an error may be a bit too large but not
 * too small. */
static inline void judge_coverage(const coverage *c, double below, double least)
{
    for (int q = 0; q < COVERED; ++q) {
        const double known = c->known[q], one = c->within[q][0] / known, two = c->within[q][1] / known;
        const double scatter = sqrt(0.683 * 0.317 / known);
        if (known < 0.0) /* not asked for */
            continue;
        print_message("%-22s of %3.0f films, within one error: %.3f, two: %.3f, farthest %.1f\n",
                      covered_names[q], known, one, two, c->farthest[q]);
        assert_true(known >= least && one > 0.683 - below * scatter && one < 0.683 + 6.0 * scatter);
        assert_true(two > 0.954 - below * sqrt(0.954 * 0.046 / known) && c->farthest[q] < 5.0);
    }
}

/* Measure so many films of the first `kinds` motions. */
static inline void check_coverage(int kinds, int films, double least_turns, double most_turns)
{
    static const double longest = 14.0;
    made_motion motions[MOTIONS];
    coverage c = {.counted = 0};
    uint64_t chance = 20260101;
    make_motions(motions, usual_drives, kinds, longest);
    for (int i = 0; i < films; ++i) {
        int has_drive;
        made_film film = random_film(&chance, longest, &has_drive);
        if (most_turns > 0) { /* of a film that tells its festoons */
            film.seconds = (least_turns + (most_turns - least_turns) * made_chance(&chance)) /
                           fabs(motions[i % kinds].bead);
            film.fps = fmax(film.fps, 100.0);
        }
        (void)cover_film(&c, i, &motions[i % kinds], &film, has_drive);
    }
    judge_coverage(&c, 3.0, (most_turns > 0 ? 0.9 : 1.0) * films);
    for (int i = 0; i < kinds; ++i)
        made_motion_free(&motions[i]);
}

/* Films that begin with the motion, long before it has settled: what is measured is the settled motion. */
static inline void check_settling_coverage(int kinds, int films)
{
    static const double longest = 12.0;
    made_motion settled[MOTIONS];
    coverage c = {.counted = 0};
    uint64_t chance = 20260103;
    make_motions(settled, usual_drives, kinds, 1.0);
    for (int kind = 0; kind < kinds; ++kind) {
        made_motion motion;
        fst_params params = fst_default_params();
        params.drive_frequency = usual_drives[kind];
        params.run_periods = ceil(longest * usual_drives[kind]);
        params.run_discard = 0.0;
        made_motion_follow(&motion, &params);
        motion.mean_r = settled[kind].mean_r;
        motion.std_r = settled[kind].std_r;
        motion.bead = settled[kind].bead;
        motion.festoons = settled[kind].festoons;
        for (int i = 0; i < films / kinds; ++i) {
            int has_drive;
            made_film film = random_film(&chance, longest, &has_drive);
            film.fps = fmax(film.fps, 100.0);
            film.seconds = fmax(film.seconds, 6.0);
            film.start = 0.0;
            (void)cover_film(&c, i, &motion, &film, has_drive);
        }
        made_motion_free(&motion);
        made_motion_free(&settled[kind]);
    }
    judge_coverage(&c, 3.5, floor(0.85 * films) + 1.0);
}

/* Films without a clock, each by a camera that is tilted, each exposed, every second one mirrored; two of three have the
 * drive, which gives the clock. */
static inline void check_clockless_coverage(int kinds, int films)
{
    static const double longest = 14.0;
    made_motion motions[MOTIONS];
    coverage c = {.counted = 0};
    uint64_t chance = 20260105;
    make_motions(motions, usual_drives, kinds, longest);
    for (int i = 0; i < films; ++i) {
        int has_drive;
        made_film film = random_film(&chance, longest, &has_drive);
        film.fps = fmax(film.fps, 100.0);
        film.clock = NAN;
        film.mirrored = i % 2;
        film.tilt = 5.0 + 25.0 * made_chance(&chance);
        has_drive = i % 3 != 0;
        film.exposure = made_chance(&chance) * fmin(1.0 / film.fps, 1.0 / 120);
        if (!has_drive) /* without a clock it has no length */
            film.exposure = 0.0;
        (void)cover_film(&c, i, &motions[i % kinds], &film, has_drive);
    }
    /* The drive that the track tells is the one that gave the clock, and no measurement. */
    c.known[COVERED_DRIVE] = -1;
    judge_coverage(&c, 3.0, 0.3 * films);
    for (int i = 0; i < kinds; ++i)
        made_motion_free(&motions[i]);
}

/* What has an error in films of few frames a second.  What the rate hides has none, and what it may hide a wide one. */
static inline void check_coarse_coverage(int kinds, int films)
{
    static const double longest = 12.0;
    made_motion motions[MOTIONS];
    coverage c = {.counted = 0};
    uint64_t chance = 20260102;
    make_motions(motions, usual_drives, kinds, longest);
    for (int i = 0; i < films; ++i) {
        int has_drive;
        const made_film film = coarse_film(&chance, longest, &has_drive);
        (void)cover_film(&c, i, &motions[i % kinds], &film, has_drive);
    }
    for (int q = 0; q < COVERED; ++q) {
        const double known = c.known[q], one = c.within[q][0] / known, two = c.within[q][1] / known;
        print_message("%-22s of %3.0f films, within one error: %.3f, two: %.3f, farthest %.1f\n",
                      covered_names[q], known, one, two, c.farthest[q]);
        assert_true(known > 0.2 * films && known < 0.9 * films);
        assert_true(one > 0.683 - 3.0 * sqrt(0.683 * 0.317 / known) && one < 0.95);
        assert_true(two > 0.954 - 3.0 * sqrt(0.954 * 0.046 / known) && c.farthest[q] < 5.0);
    }
    for (int i = 0; i < kinds; ++i)
        made_motion_free(&motions[i]);
}

#endif
