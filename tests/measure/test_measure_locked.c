/* fst_measure_track() on films of beads that go round with the magnet: locked, librating, on the way there, and pushed.
 * tests: measure/measure.c measure/drive.c measure/settle.c measure/clean.c measure/errors.c
 * labels: numbers */
#include "measure_cases.h"

/* A bead that goes round with the magnet has the drive's frequency and no festoons. */
static void test_locked(void **state)
{
    (void)state;
    static const double drives[] = {3.0, 5.0}; /* locked; librating */
    for (int i = 0; i < 2; ++i) {
        made_motion motion = motion_at(drives[i], 8.0);
        made_film film = made_film_plain();
        fst_track track;
        assert_int_equal(motion.regime, i ? FST_REGIME_LIBRATING : FST_REGIME_LOCKED);
        film.seconds = 7.0;
        for (int mirrored = 0; mirrored < 2; ++mirrored) {
            film.mirrored = mirrored;
            const fst_measurement m =
                measured(&motion, &film, mirrored ? -motion.drive : motion.drive, NAN, &track);
            assert_int_equal(m.motion, FST_MOTION_LOCKED);
            assert_true(isnan(m.festoons) && isnan(m.festoons_error));
            assert_near(m.bead_frequency_hz, fmax(m.bead_frequency_hz_error, 2e-4 * motion.drive),
                        motion.drive);
            assert_near(m.mean_r, fmax(m.mean_r_error, 1e-3 * m.mean_r), film.scale * motion.mean_r);
            assert_near(m.std_r, fmax(m.std_r_error, 0.02 * m.std_r), film.scale * motion.std_r);
            fst_track_free(&track);
        }
        film.mirrored = 0;
        const fst_measurement m = measured(&motion, &film, NAN, NAN, &track);
        assert_true(isnan(m.festoons) && m.warning_count > 0);
        assert_near(m.bead_frequency_hz, fmax(m.bead_frequency_hz_error, 2e-4 * motion.drive), motion.drive);
        fst_track_free(&track);
        made_motion_free(&motion);
    }
}

/* A motion from its start, almost without noise, at each usual rate: a bead that locks or librates has settled long
 * before a film of it ends, and what comes before is left out. */
static void test_locking(void **state)
{
    (void)state;
    static const double drives[] = {3.0, 8.5}, rates[] = {60.0, 120.0, 240.0};
    for (int i = 0; i < 6; ++i) {
        fst_params params = fst_default_params();
        made_motion settled = motion_at(drives[i % 2], 1.0), motion;
        made_film film = made_film_plain();
        fst_track track;
        params.drive_frequency = drives[i % 2];
        params.run_periods = 41.0 * drives[i % 2];
        params.run_discard = 0.0;
        made_motion_follow(&motion, &params);
        film.seconds = 40.0;
        film.noise = 0.001;
        film.fps = rates[i / 2];
        const fst_measurement m = measured(&motion, &film, motion.drive, NAN, &track);
        assert_near(m.mean_r, m.mean_r_error, film.scale * settled.mean_r);
        assert_near(m.std_r, m.std_r_error, film.scale * settled.std_r);
        assert_true(m.settled_after_s > 1.0 && m.settled_after_s < 10.0 && m.rejected == 0);
        fst_track_free(&track);
        made_motion_free(&motion);
        made_motion_free(&settled);
    }
}

/* A bead that is locked, and is pushed once: r changes without an oscillation, and one push says little of others. */
static void test_pushed(void **state)
{
    (void)state;
    made_motion motion = motion_at(3.0, 20.0);
    made_film film = made_film_plain();
    fst_track track;
    fst_measure_options options = fst_default_measure_options();
    fst_error error;
    film.seconds = 20.0;
    film.fps = 60.0;
    film.noise = 0.0;
    fst_measurement m = measured(&motion, &film, motion.drive, NAN, &track);
    assert_int_equal(m.rejected, 0); /* rounding errors are no wild places */
    fst_track_free(&track);
    film.noise = 0.1;
    m = measured(&motion, &film, motion.drive, NAN, &track);
    for (int k = -80; k <= 80; ++k) {
        const size_t at = track.rows / 2 + (size_t)(k + 80);
        const double push = 0.02 * exp(-k * k / 800.0);
        track.x[at] += push * (track.x[at] - m.centre[0]);
        track.y[at] += push * (track.y[at] - m.centre[1]);
    }
    options.drive = motion.drive;
    assert_int_equal(fst_measure_track(&track, &options, &m, &error), FST_OK);
    assert_true(m.std_r > 1e-3 * m.mean_r && m.std_r < 4.0 * m.std_r_error);
    fst_track_free(&track);
    made_motion_free(&motion);
}

/* Of films of locked beads, with every fault that a film may have, none has festoons. */
static void test_50_locked_films(void **state)
{
    (void)state;
    made_motion motion = motion_at(3.0, 15.0);
    uint64_t chance = 20260104;
    for (int i = 0; i < 50; ++i) {
        int has_drive;
        const made_film film = random_film(&chance, 14.0, &has_drive);
        fst_track track;
        const fst_measurement m =
            measured(&motion, &film, has_drive ? (film.mirrored ? -motion.drive : motion.drive) : NAN,
                     film.exposure > 0 ? film.exposure : NAN, &track);
        if (!isnan(m.festoons) || !isnan(m.festoons_error))
            fail_msg("film %d of a locked bead has %g festoons", i, m.festoons);
        fst_track_free(&track);
    }
    made_motion_free(&motion);
}

/* Errors of places that each turn repeats: those by pixels and light are ever smaller harmonics of the bead's angle; a shutter
 * that rolls makes one side of the circle late. */
static void repeat_errors(fst_track *track, uint64_t *chance)
{
    double x = 0.0, y = 0.0, size[13][2];
    for (int k = 1; k <= 12; ++k)
        for (int part = 0; part < 2; ++part)
            size[k][part] = 0.03 / k * made_normal(chance);
    for (size_t i = 0; i < track->rows; ++i) {
        x += track->x[i] / (double)track->rows;
        y += track->y[i] / (double)track->rows;
    }
    for (size_t i = 0; i < track->rows; ++i) {
        const double angle = atan2(track->y[i] - y, track->x[i] - x);
        double off = 0.0;
        for (int k = 2; k <= 12; ++k)
            off += size[k][0] * cos(k * angle) + size[k][1] * sin(k * angle);
        const double along = 0.009 * hypot(track->x[i] - x, track->y[i] - y) * cos(angle);
        track->x[i] += off * cos(angle) - along * sin(angle);
        track->y[i] += off * sin(angle) + along * cos(angle);
    }
}

/* Such errors are neither a tilt of a locked bead's film nor an oscillation, however clean it is, also where each turn has the
 * same frames; a bead that librates does so beside them. */
static void test_repeated_errors(void **state)
{
    (void)state;
    static const double rates[] = {60.0, 120.0, 240.0}, noises[] = {0.003, 0.02, 0.1};
    made_motion locked = motion_at(3.0, 6.0), librating = motion_at(8.5, 6.0);
    uint64_t chance = 20260107;
    double squares[4] = {0};
    for (int i = 0; i < 60; ++i) {
        made_film film = made_film_plain();
        fst_track track;
        fst_measure_options options = fst_default_measure_options();
        fst_measurement m;
        fst_error error;
        const made_motion *motion = i % 6 == 5 ? &librating : &locked;
        film.seconds = 4.6;
        film.fps = rates[i % 3];
        film.noise = noises[i / 3 % 3];
        film.tilt = i % 4 == 3 ? 15.0 : 0.0;
        film.seed = (uint64_t)i + 1;
        options.drive = motion->drive;
        made_track(motion, &film, &track);
        repeat_errors(&track, &chance);
        assert_int_equal(fst_measure_track(&track, &options, &m, &error), FST_OK);
        assert_int_equal(m.motion, FST_MOTION_LOCKED);
        const double off[4] = {(m.mean_r - film.scale * motion->mean_r) / m.mean_r_error,
                               (m.std_r - film.scale * motion->std_r) / m.std_r_error,
                               (m.tilt_deg - film.tilt) / m.tilt_deg_error,
                               (m.bead_frequency_hz - motion->drive) / m.bead_frequency_hz_error};
        for (int q = 0; q < 4; ++q) {
            squares[q] += off[q] * off[q] / 60.0;
            if (!(fabs(off[q]) < 4.0))
                fail_msg("film %d: number %d is %g errors off", i, q, off[q]);
        }
        assert_true(motion == &locked ? m.std_r < 2.0 * m.std_r_error && m.std_r < 0.05 : m.std_r > 10.0);
        assert_true(m.mean_r_error < 1e-3 * m.mean_r && m.tilt_deg_error < 4.0);
        assert_true(motion != &locked || m.bead_frequency_hz_error < 2e-4 * film.noise + 3e-6);
        fst_track_free(&track);
    }
    print_message("rms of errors: <r> %.2f, delta r %.2f, tilt %.2f, rate %.2f\n", sqrt(squares[0]),
                  sqrt(squares[1]), sqrt(squares[2]), sqrt(squares[3]));
    for (int q = 0; q < 4; ++q)
        assert_true(sqrt(squares[q]) < 1.4);
    made_motion_free(&locked);
    made_motion_free(&librating);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_locked),          cmocka_unit_test(test_locking),
        cmocka_unit_test(test_pushed),          cmocka_unit_test(test_50_locked_films),
        cmocka_unit_test(test_repeated_errors),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
