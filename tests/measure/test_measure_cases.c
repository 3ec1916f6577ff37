/* fst_measure_track() on films of beads that the library moves: each kind of motion, and each fault of a film,
 * with what must come out (test_measure_locked.c has beads that go with the magnet); and the coverage of errors over a
 * few films (test_measure_coverage.c has many).
 * tests: measure/measure.c measure/clean.c measure/geometry.c measure/spectrum.c measure/drive.c measure/settle.c
 *   measure/winding.c measure/errors.c measure/sharpen.c measure/regress.c tracks/track.c
 * labels: numbers */
#include "measure_cases.h"

#include <stdlib.h>

static int warned(const fst_measurement *m, const char *word)
{
    int found = 0;
    for (int i = 0; i < m->warning_count; ++i)
        found |= strstr(m->warnings[i], word) != NULL;
    return found;
}

static void assert_as(const fst_measurement *m, const made_motion *motion, double scale)
{
    assert_near(m->mean_r, m->mean_r_error, scale * motion->mean_r);
    assert_near(m->std_r, m->std_r_error, scale * motion->std_r);
    assert_near(m->bead_frequency_hz, m->bead_frequency_hz_error, motion->bead);
    assert_near(m->festoons, m->festoons_error, motion->festoons);
    assert_near(m->drive_from_track_hz, m->drive_from_track_hz_error, motion->drive);
}

static void test_festoons(void **state)
{
    (void)state;
    for (int i = 0; i < 2; ++i) {
        made_motion motion = motion_at(i ? 19.9 : 10.7, 6.0);
        made_film film = made_film_plain();
        fst_track track;
        fst_measurement m = measured(&motion, &film, NAN, NAN, &track);
        assert_as(&m, &motion, film.scale); /* without the drive: the track tells it */
        assert_int_equal(m.symmetry, i ? 2 : 1);
        assert_int_equal(m.motion, FST_MOTION_TURNING);
        assert_near(m.noise, 0.02, film.noise);
        assert_near(m.centre[0], 4 * m.centre_error[0], 640.0);
        assert_near(m.centre[1], 4 * m.centre_error[1], 360.0);
        fst_track_free(&track);

        film.mirrored = 1; /* or filmed from below: then the magnet turns clockwise */
        m = measured(&motion, &film, -motion.drive, NAN, &track);
        assert_as(&m, &motion, film.scale);
        assert_false(warned(&m, "mirrored"));
        fst_track_free(&track);
        m = measured(&motion, &film, motion.drive, NAN, &track);
        assert_as(&m, &motion, film.scale); /* the festoons know better */
        assert_true(warned(&m, "mirrored"));
        fst_track_free(&track);
        m = measured(&motion, &film, NAN, NAN, &track);
        assert_true(isnan(m.festoons) && isnan(m.drive_from_track_hz) && m.warning_count > 0);
        fst_track_free(&track);
        made_motion_free(&motion);
    }
}

/* With the magnet, against it, librating and chaotic: thinned as it may be, a film tells the run's rate, festoons and
 * drive, or none; and those of a regular motion where it has enough frames. */
static void test_senses(void **state)
{
    (void)state;
    static const struct {
        double depth, hertz, seconds, least; /* mm, Hz, s, frames a second that tell the rate */
        int own, turns;                      /* another bead; it circles at a rate of its own */
    } motions[] = {{10.0, 11.0, 5.0, 120.0, 1, 1},  {10.0, 13.0, 5.0, 240.0, 1, 1},
                   {7.0, 9.0, 5.0, 25.0, 0, 1},     {8.0, 9.0, 60.0, 25.0, 0, 1},
                   {16.2, 9.0, 5.0, 25.0, 0, 1},    {16.2, 8.0, 5.0, 60.0, 0, 0},
                   {10.0, 9.0, 5.0, INFINITY, 0, 1}};
    static const double rates[] = {240.0, 120.0, 60.0, 25.0};
    for (size_t i = 0; i < sizeof motions / sizeof *motions; ++i) {
        fst_params params = fst_default_params();
        made_motion motion;
        if (motions[i].own) {
            params.bead_radius = 3.1e-3;
            params.bead_mass = 0.9e-3;
            params.model_kappa = 1.1;
        }
        params.magnet_depth = 1e-3 * motions[i].depth;
        params.drive_frequency = motions[i].hertz;
        params.run_periods = ceil((motions[i].seconds + 1.0) * motions[i].hertz) + 200.0;
        made_motion_follow(&motion, &params);
        for (size_t k = 0; k < 2 * sizeof rates / sizeof *rates; ++k) {
            made_film film = made_film_plain();
            fst_track track;
            film.fps = rates[k / 2];
            film.seconds = motions[i].seconds;
            const int known = k % 2 == 0;
            const fst_measurement m = measured(&motion, &film, known ? motion.drive : NAN, NAN, &track);
            assert_true(isnan(m.bead_frequency_hz) == !(film.fps >= motions[i].least));
            if (isfinite(m.bead_frequency_hz_error))
                assert_near(m.bead_frequency_hz, 1e-4 + m.bead_frequency_hz_error, motion.bead);
            if (isfinite(m.festoons_error))
                assert_near(m.festoons, 1e-4 + m.festoons_error, motion.festoons);
            if (isfinite(m.drive_from_track_hz_error))
                assert_near(m.drive_from_track_hz, 1e-4 + m.drive_from_track_hz_error, motion.drive);
            assert_true(!known || film.fps < 100.0 || film.fps < motions[i].least || !motions[i].turns ||
                        isfinite(m.festoons));
            fst_track_free(&track);
        }
        made_motion_free(&motion);
    }
}

/* So much noise that every second festoon could differ: N or 2 N are not told apart, nor is the symmetry. */
static void test_unsure_festoons(void **state)
{
    (void)state;
    made_motion motion = motion_at(19.9, 6.0);
    made_film film = made_film_plain();
    int known = 0, unknown = 0;
    for (film.noise = 0.2; film.noise < 8.0; film.noise *= 1.5) {
        fst_track track;
        const fst_measurement m = measured(&motion, &film, motion.drive, NAN, &track);
        assert_true(isfinite(m.festoons) == (m.symmetry == 2) && m.symmetry != 1);
        known += m.symmetry == 2;
        if (m.motion == FST_MOTION_TURNING && m.symmetry == 0) {
            ++unknown;
            assert_true(isnan(m.festoons_error) && isfinite(m.drive_from_track_hz));
            assert_true(warned(&m, "there are 7.") && warned(&m, " festoons, or 14.") && warned(&m, "(S2)"));
        }
        fst_track_free(&track);
    }
    assert_true(known > 4 && unknown > 0);
    made_motion_free(&motion);
}

/* At 14 Hz the motion becomes S2, from a start that is not: while every second festoon differs less and less, which
 * is too little for a drift, neither 5.94 nor 11.89 is told; at 13 Hz they keep differing, and half the number is right. */
static void test_fading_festoons(void **state)
{
    (void)state;
    const struct {
        double hertz, discard, noise;
        int symmetry;
    } films[] = {{14.0, 30.0, 0.2, 2}, {14.0, 100.0, 1e-6, 0}, {14.0, 100.0, 0.2, 2}, {13.0, 150.0, 1e-6, 1}};
    for (size_t i = 0; i < sizeof films / sizeof *films; ++i) {
        made_motion motion;
        made_film film = made_film_plain();
        fst_params params = fst_default_params();
        fst_track track;
        params.drive_frequency = films[i].hertz;
        params.run_periods = 100.0 + films[i].discard;
        params.run_discard = films[i].discard;
        made_motion_follow(&motion, &params);
        film.noise = films[i].noise;
        const fst_measurement m = measured(&motion, &film, NAN, NAN, &track);
        assert_int_equal(m.symmetry, films[i].symmetry);
        assert_near(m.drive_from_track_hz, m.drive_from_track_hz_error + 1e-4, films[i].hertz);
        if (films[i].symmetry == 0) {
            assert_true(isnan(m.festoons) && isnan(m.festoons_error));
            assert_true(warned(&m, "ever less") && warned(&m, "there are 5.9") &&
                        warned(&m, " festoons, or 11.8"));
        } else
            assert_near(m.festoons, 1e-4 + m.festoons_error,
                        films[i].symmetry * (1.0 - films[i].hertz / motion.bead));
        fst_track_free(&track);
        made_motion_free(&motion);
    }
}

/* Of the same film without a clock as many frames are left out, of the angle between two beads too; when that was is not
 * known. */
static void without_a_clock(const fst_track *track, const fst_measurement *clocked)
{
    fst_track bare[2] = {*track, *track};
    fst_measure_options options = fst_default_measure_options();
    fst_beads_measurement m;
    fst_error error;
    double *none = malloc(track->rows * sizeof *none);
    for (size_t i = 0; i < track->rows; ++i)
        none[i] = NAN;
    for (int k = 0; k < 2; ++k) {
        bare[k].t = none;
        bare[k].fps = NAN;
    }
    assert_int_equal(fst_measure_tracks(bare, 2, &options, &m, &error), FST_OK);
    assert_int_equal(m.beads[0].left_out, clocked->left_out);
    assert_true(clocked->left_out == 0 ? m.beads[0].settled_after_s == 0.0 : isnan(m.beads[0].settled_after_s));
    assert_in_range(m.pairs[0].frames, 1, clocked->frames - clocked->left_out);
    free(none);
}

/* A film that begins with the motion: what comes before it has settled is left out, or nothing has an error; of a
 * settled one nothing is left out. */
static void test_transients(void **state)
{
    (void)state;
    static const struct {
        double hertz, seconds, from, to; /* s; NAN: it never settles */
        int symmetry;
        double tilt, clock;
        int mirrored;
    } films[] = {
        {14.0, 8.0, 3.0, 6.0, 2, 0.0, 1.0, 0},  {14.0, 8.0, 3.0, 6.0, 2, 25.0, 8.0, 1},
        {13.0, 8.0, 3.0, 6.0, 1, 20.0, 1.0, 0}, {14.0, 2.5, NAN, NAN, 0, 0.0, 1.0, 0},
        {10.7, 6.0, 0.0, 1.0, 1, 0.0, 1.0, 0},
    };
    for (size_t i = 0; i < sizeof films / sizeof *films; ++i) {
        made_motion settled = motion_at(films[i].hertz, 1.0), motion;
        made_film film = made_film_plain();
        fst_params params = fst_default_params();
        fst_track track;
        params.drive_frequency = films[i].hertz;
        params.run_periods = 9.0 * films[i].hertz;
        params.run_discard = 0.0;
        made_motion_follow(&motion, &params);
        film.seconds = films[i].seconds;
        film.tilt = films[i].tilt;
        film.clock = films[i].clock;
        film.mirrored = films[i].mirrored;
        const double drive = film.mirrored ? -motion.drive : motion.drive;
        const fst_measurement m = measured(&motion, &film, drive, NAN, &track);
        assert_int_equal(m.symmetry, films[i].symmetry);
        assert_true(warned(&m, isnan(films[i].from) ? "never settles" : "settles first"));
        if (isnan(films[i].from)) {
            assert_true(isnan(m.settled_after_s) && isnan(m.festoons) && isfinite(m.mean_r));
            assert_true(isnan(m.mean_r_error) && isnan(m.std_r_error) && isnan(m.bead_frequency_hz_error) &&
                        isnan(m.tilt_deg_error) && isnan(m.drive_from_track_hz_error));
        } else {
            assert_as(&m, &settled, film.scale);
            assert_true(m.settled_after_s > films[i].from && m.settled_after_s < films[i].to);
            assert_true(fabs((double)m.left_out - m.settled_after_s * m.fps) < 1.5);
        }
        without_a_clock(&track, &m);
        fst_track_free(&track);
        film = made_film_plain();
        film.seconds = 0.9;
        assert_true(measured(&settled, &film, settled.drive, NAN, &track).settled_after_s == 0.0);
        fst_track_free(&track);
        made_motion_free(&motion);
        made_motion_free(&settled);
    }
}

static void test_clocks(void **state)
{
    (void)state;
    made_motion motion = motion_at(10.7, 6.0);
    made_film film = made_film_plain();
    fst_track track;
    film.clock = 8.0; /* 240 frames a second, stored as 30 */
    fst_measurement m = measured(&motion, &film, motion.drive, NAN, &track);
    assert_as(&m, &motion, film.scale);
    assert_true(fabs(m.fps - 240.0) < 0.1 && fabs(track.fps - m.fps) < 1e-9);
    assert_true(fabs(track.t[track.rows - 1] - track.t[0] - (double)(track.rows - 1) / 240.0) < 1e-3);
    assert_true(warned(&m, "frame"));
    fst_track_free(&track);
    m = measured(&motion, &film, NAN, NAN, &track); /* without the drive nothing can be noticed */
    assert_near(8.0 * m.drive_from_track_hz, 8.0 * m.drive_from_track_hz_error, motion.drive);
    fst_track_free(&track);
    film.clock = 1.3;
    film.fps = 221.0; /* no camera has such a rate: the file's clock stays, and a warning says so */
    m = measured(&motion, &film, motion.drive, NAN, &track);
    assert_true(fabs(m.fps - 170.0) < 0.1 && warned(&m, "frame rate"));
    fst_track_free(&track);

    film.clock = 1.0; /* no clock at all */
    film.fps = 240.0;
    made_track(&motion, &film, &track);
    for (int with_drive = 0; with_drive < 2; ++with_drive) {
        fst_measure_options options = fst_default_measure_options();
        fst_error error;
        for (size_t i = 0; i < track.rows; ++i)
            track.t[i] = NAN;
        track.fps = NAN;
        options.drive = with_drive ? motion.drive : NAN;
        assert_int_equal(fst_measure_track(&track, &options, &m, &error), FST_OK);
        assert_near(m.festoons, m.festoons_error, motion.festoons);
        assert_near(m.mean_r, m.mean_r_error, film.scale * motion.mean_r);
        if (with_drive)
            assert_true(fabs(m.fps - 240.0) < 0.1);
        else
            for (int k = 0; k < fst_measured_count(); ++k) {
                const fst_measured_info *info = fst_measured_at(k);
                double value;
                memcpy(&value, (const char *)&m + info->offset, sizeof value);
                if (!isnan(value) && (strcmp(info->unit, "Hz") == 0 || strcmp(info->unit, "1/s") == 0))
                    fail_msg("%s is %g %s, though there is no clock", info->name, value, info->unit);
            }
    }
    fst_track_free(&track);
    made_motion_free(&motion);
}

static void test_few_frames_a_second(void **state)
{
    (void)state;
    made_motion motion = motion_at(19.9, 10.0);
    made_film film = made_film_plain();
    fst_track track;
    film.fps = 60.0; /* r oscillates at 46 Hz */
    film.seconds = 9.0;
    fst_measurement m = measured(&motion, &film, motion.drive, NAN, &track);
    assert_as(&m, &motion, film.scale);
    assert_true(warned(&m, "alias"));
    fst_track_free(&track);
    film.fps = 46.1339; /* the festoons stand still */
    m = measured(&motion, &film, motion.drive, NAN, &track);
    assert_true(isnan(m.festoons) && warned(&m, "stand still"));
    fst_track_free(&track);
    film.fps = 240.0;
    film.seconds = 1.5; /* five turns are enough, and three */
    m = measured(&motion, &film, motion.drive, NAN, &track);
    assert_as(&m, &motion, film.scale);
    fst_track_free(&track);
    film.seconds = 0.9; /* but not less */
    m = measured(&motion, &film, motion.drive, NAN, &track);
    assert_true(isfinite(m.mean_r) && isnan(m.mean_r_error) && isnan(m.bead_frequency_hz_error) &&
                warned(&m, "turns"));
    assert_true(isfinite(m.festoons) && isnan(m.festoons_error) && isnan(m.drive_from_track_hz_error) &&
                isnan(m.std_r_error) && isnan(m.tilt_deg_error));
    fst_track_free(&track);
    made_motion_free(&motion);
}

/* What a low frame rate cannot tell is not told, and a warning says why.  A letter a number: m mean_r, d delta r, b
 * bead, n festoons, f drive, t tilt; in capitals: with an error. */
static void test_hidden_festoons(void **state)
{
    (void)state;
    static const struct {
        double hertz, fps, exposure;
        int has_drive;
        const char *known, *word;
    } films[] = {
        {19.9, 60.0, NAN, 1, "MDBNFT", "explains"},
        {19.9, 60.0, NAN, 0, "MDBT", "19.9 Hz as well as 10.7 Hz"}, /* 46 Hz look like 14 Hz */
        {13.0, 15.0, 30e-3, 0, "mBT", "has blurred"},               /* twice 15.88 Hz look like 1.75 Hz */
        {13.0, 15.0, 30e-3, 1, "mbt", "stand still"},               /* the drive does not help */
        {10.7, 24.0, 30e-3, 1, "MDBNFT", "explains"},               /* but it does here */
        {10.7, 24.0, 30e-3, 0, "mBT", "has blurred"},               /* 14 Hz or 10 Hz: blurred by how much? */
        {15.6, 31.2045, 2e-3, 1, "mbt", "like a tilt"},             /* 37 Hz look like two waves a turn */
        {15.6, 27.757, NAN, 1, "MBT", "in the place of"}, /* 18.5 Hz and 37 Hz both look like 9.25 Hz */
        {5.0, 8.0, NAN, 0, "mt", "the other way round"},  /* a locked bead looks like one against it */
        {5.0, 8.0, NAN, 1, "mt", "the other way round"},
        {15.6, 24.0, 30e-3, 1, "mBfT", "cannot be restored"},
        {14.6, 43.616, 4.8e-3, 1, "MBFT", "hides whether"}, /* six times 17.46 Hz look like 17.46 Hz */
        {8.0, 23.231, 6e-3, 1, "MDBFT",
         "without a warning"}, /* locked; 12.6 Hz look like 10.6 Hz: what was blurred? */
    };
    for (size_t i = 0; i < sizeof films / sizeof *films; ++i) {
        made_motion motion = motion_at(films[i].hertz, 10.0);
        made_film film = made_film_plain();
        fst_track track;
        film.fps = films[i].fps;
        film.exposure = isnan(films[i].exposure) ? 0.0 : films[i].exposure;
        film.seconds = 9.0;
        const fst_measurement m =
            measured(&motion, &film, films[i].has_drive ? motion.drive : NAN, films[i].exposure, &track);
        const double found[6][2] = {{m.mean_r, m.mean_r_error},
                                    {m.std_r, m.std_r_error},
                                    {m.bead_frequency_hz, m.bead_frequency_hz_error},
                                    {m.festoons, m.festoons_error},
                                    {m.drive_from_track_hz, m.drive_from_track_hz_error},
                                    {m.tilt_deg, m.tilt_deg_error}};
        char known[7] = "", *end = known;
        for (int q = 0; q < 6; ++q)
            if (!isnan(found[q][0]))
                *end++ = "mdbnftMDBNFT"[q + (isnan(found[q][1]) ? 0 : 6)];
        *end = '\0';
        if (strcmp(known, films[i].known) != 0 || (m.warning_count > 0 && !warned(&m, films[i].word)))
            fail_msg("film %zu: %s is known, not %s; \"%s\" is said: %d", i, known, films[i].known,
                     films[i].word, warned(&m, films[i].word));
        assert_true(isfinite(m.radial_frequency_hz) == isfinite(m.festoons));
        if (isfinite(m.std_r))
            assert_near(m.std_r, m.std_r_error, film.scale * motion.std_r);
        fst_track_free(&track);
        made_motion_free(&motion);
    }
}

static void test_exposure(void **state)
{
    (void)state;
    made_motion motion = motion_at(19.9, 8.0);
    made_film film = made_film_plain();
    fst_track track;
    film.seconds = 7.0;
    film.fps = 120.0;
    film.exposure = 1.0 / 120;
    fst_measurement m = measured(&motion, &film, motion.drive, NAN, &track);
    const double angle = FST_PI * m.radial_frequency_hz / 120;
    /* The shrinkage that a long exposure makes, about a fifth, to first order. */
    assert_true(fabs(m.std_r / (film.scale * motion.std_r) - sin(angle) / angle) < 0.04);
    assert_true(warned(&m, "exposure"));
    fst_track_free(&track);
    m = measured(&motion, &film, motion.drive, film.exposure, &track);
    assert_as(&m, &motion, film.scale);
    fst_track_free(&track);
    /* Where an exposure leaves two fifths, the noise has the error of its rate grow by what the line is stretched. */
    double square = 0.0;
    film.fps = 60.0;
    film.exposure = 15.5e-3;
    film.noise = 0.4;
    for (film.seed = 1; film.seed <= 8; ++film.seed) {
        m = measured(&motion, &film, motion.drive, film.exposure, &track);
        square += pow((m.drive_from_track_hz - motion.drive) / m.drive_from_track_hz_error, 2) / 8.0;
        fst_track_free(&track);
    }
    assert_true(square > 0.2 && square < 3.0);
    film = made_film_plain();
    film.seconds = 7.0;
    film.fps = 120.0;
    film.exposure = 1.0 / 120;
    m = measured(&motion, &film, motion.drive, film.exposure, &track);
    fst_track_free(&track);
    /* An exposure that leaves less than a third of the oscillation leaves no number of it. */
    m = measured(&motion, &film, motion.drive, 0.8 / m.radial_frequency_hz, &track);
    assert_true(isnan(m.std_r) && isnan(m.std_r_error) && isnan(m.mean_r_error) && isfinite(m.mean_r));
    fst_track_free(&track);
    made_motion_free(&motion);
}

static void test_tilt(void **state)
{
    (void)state;
    made_motion motion = motion_at(19.9, 6.0);
    made_film film = made_film_plain();
    fst_track track;
    static const double tilts[] = {0.0, 20.1, 45.0, 60.0};
    for (int i = 0; i < 4; ++i) {
        film.tilt = tilts[i];
        film.along = 50.0 * i;
        film.seed = (uint64_t)(i + 1);
        const fst_measurement m = measured(&motion, &film, motion.drive, NAN, &track);
        assert_as(&m, &motion, film.scale);
        assert_near(m.tilt_deg, m.tilt_deg_error, film.tilt);
        assert_true(fabs(m.mean_r / (film.scale * motion.mean_r) - 1.0) < 0.002);
        fst_track_free(&track);
    }
    made_motion_free(&motion);
}

static void test_faults(void **state)
{
    (void)state;
    made_motion motion = motion_at(10.7, 9.0);
    made_film film = made_film_plain();
    fst_track track;
    film.seconds = 8.0;
    film.lost = 0.3;
    film.wild = 0.05;
    film.tilt = 15.0;
    const fst_measurement m = measured(&motion, &film, motion.drive, NAN, &track);
    assert_as(&m, &motion, film.scale);
    assert_true(fabs((double)m.lost / (double)m.frames - 0.335) < 0.03); /* missing ones and rejected ones */
    assert_true(fabs((double)m.rejected / (double)m.frames - 0.035) < 0.015);
    size_t flagged = 0;
    for (size_t i = 0; i < track.rows; ++i)
        flagged += track.flag[i] == FST_FRAME_REJECTED;
    assert_int_equal(flagged, m.rejected);
    fst_track_free(&track);
    made_motion_free(&motion);
}

static fst_status refuse(void *user, double fraction, const char *what, fst_error *error)
{
    double *last = user;
    (void)what;
    assert_true(fraction >= last[0] && fraction <= 1.0); /* it never falls */
    last[0] = fraction;
    if ((last[1] -= 1.0) > 0)
        return FST_OK;
    (void)snprintf(error->sentence, sizeof error->sentence, "enough");
    return FST_INTERRUPTED;
}

/* The caller may end the work whenever it is told of the progress. */
static void test_interruption(void **state)
{
    (void)state;
    made_motion motion = motion_at(10.7, 3.0);
    const made_film film = {.fps = 240, .seconds = 2.5, .scale = 4.0, .noise = 0.2, .clock = 1.0, .seed = 3};
    for (int calls = 1; calls < 12; calls += 5) {
        double user[2] = {0.0, calls};
        const fst_progress progress = {user, refuse};
        fst_measure_options options = fst_default_measure_options();
        fst_measurement m;
        fst_error error;
        fst_track track;
        options.progress = &progress;
        made_track(&motion, &film, &track);
        assert_int_equal(fst_measure_track(&track, &options, &m, &error), FST_INTERRUPTED);
        assert_string_equal(error.sentence, "enough");
        assert_true(user[1] == 0.0);
        fst_track_free(&track);
    }
    made_motion_free(&motion);
}

static void test_20_films(void **state)
{
    (void)state;
    check_coverage(2, 20, 0, 0);
    check_coverage(2, 40, 3.0, 8.0);
}

static void test_60_coarse_films(void **state)
{
    (void)state;
    check_coarse_coverage(2, 60);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_festoons),
        cmocka_unit_test(test_senses),
        cmocka_unit_test(test_unsure_festoons),
        cmocka_unit_test(test_fading_festoons),
        cmocka_unit_test(test_transients),
        cmocka_unit_test(test_clocks),
        cmocka_unit_test(test_few_frames_a_second),
        cmocka_unit_test(test_hidden_festoons),
        cmocka_unit_test(test_exposure),
        cmocka_unit_test(test_tilt),
        cmocka_unit_test(test_faults),
        cmocka_unit_test(test_interruption),
        cmocka_unit_test(test_20_films),
        cmocka_unit_test(test_60_coarse_films),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
