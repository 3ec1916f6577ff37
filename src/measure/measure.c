/* measure.c - fst_measure_track(): from a track to numbers with errors. */
#include "measure/work.h"

#include <string.h>

#include "base/dot.h"
#include "base/error.h"
#include "base/listed.h"

enum { OPTIONS_COOKIE = 0x4d454153 };

/* Two readings of an oscillation may differ in its size by this part, or there is none. */
#define MOST_APART 0.3

static const fst_measured_info rows[] = {
#define FST_MEASURED(name, unit, doc) {#name, unit, doc, offsetof(fst_measurement, name)},
#include <festoon/measure.def>
#undef FST_MEASURED
};

const char *fst_motion_name(fst_motion motion)
{
    FST_NAME_IN(FST_MOTIONS, motion, "unknown");
}

int fst_measured_count(void)
{
    return (int)(sizeof rows / sizeof *rows);
}

const fst_measured_info *fst_measured_at(int index)
{
    return index >= 0 && index < fst_measured_count() ? &rows[index] : NULL;
}

fst_measure_options fst_default_measure_options(void)
{
    return (fst_measure_options){.cookie = OPTIONS_COOKIE, .drive = NAN, .exposure = NAN};
}

static fst_status check(const fst_measure_options *options, const fst_track *track, fst_error *error)
{
    if (options->cookie != OPTIONS_COOKIE)
        return fst_fail(error, FST_BAD_INPUT, "fst_measure_track",
                        "the options were not made by fst_default_measure_options()");
    if (isfinite(options->drive) && options->drive == 0.0)
        return fst_fail(error, FST_BAD_INPUT, "fst_measure_options.drive",
                        "a drive of 0 Hz: the magnet must turn");
    if (isfinite(options->exposure) && !(options->exposure >= 0 && options->exposure < 10))
        return fst_fail(error, FST_BAD_INPUT, "fst_measure_options.exposure",
                        "an exposure of %g s: from 0 to the time from frame to frame", options->exposure);
    if (isfinite(options->exposure) && isfinite(track->fps) && options->exposure * track->fps > 1.0 + 1e-6 &&
        !isfinite(options->drive))
        return fst_fail(error, FST_BAD_INPUT, "fst_measure_options.exposure",
                        "an exposure of %g s is longer than a frame at %g frames a second lasts",
                        options->exposure, track->fps);
    return FST_OK;
}

/* ---------------------------------------------------------------- frames */

static void count_frames(const fst_track *track, fst_measurement *measured)
{
    int64_t seen = 0;
    measured->frames = track->frame[track->rows - 1] - track->frame[0] + 1;
    for (size_t i = 0; i < track->rows; ++i) {
        seen += track->flag[i] == FST_FRAME_SEEN;
        measured->rejected += track->flag[i] == FST_FRAME_REJECTED;
        measured->repeated += i > 0 && track->flag[i] == FST_FRAME_SEEN && track->x[i] == track->x[i - 1] &&
                              track->y[i] == track->y[i - 1];
    }
    measured->lost = measured->frames - seen;
}

int64_t measure_first_doubt(const fst_track *track)
{
    for (size_t i = 0; i < track->rows && track->doubts; ++i)
        if (track->doubts[i] > track->doubts[0])
            return track->frame[i];
    return -1;
}

static void warn_of_frames(const fst_track *track, fst_measurement *measured)
{
    const double frames = (double)measured->frames;
    if (measured->rejected > 0)
        measure_warn(measured, "%lld places were rejected, because no bead can have been there",
                     (long long)measured->rejected);
    if ((double)measured->lost > 0.2 * frames)
        measure_warn(measured,
                     "%lld of %lld frames are lost: look at the film whether some part of the path is missing",
                     (long long)measured->lost, (long long)measured->frames);
    const int64_t doubt = measure_first_doubt(track);
    if (doubt >= 0)
        measure_warn(
            measured,
            "from frame %lld on this may be another bead: their names may have been exchanged when they met",
            (long long)doubt);
    if ((double)measured->repeated > 0.02 * frames)
        measure_warn(measured,
                     "%lld frames repeat the one before exactly: the film was converted to another frame rate, "
                     "and its clock may be wrong",
                     (long long)measured->repeated);
}

/* ---------------------------------------------------------------- exposure */

static void warn_of_exposure(const measure_work *work, const measure_drive *drive,
                             const fst_measure_options *options, fst_measurement *measured)
{
    if (!(work->peak > 0) || drive->motion == FST_MOTION_LOCKED || !isfinite(measured->fps))
        return;
    const double whole = 1.0 / work->fps, loss = 1.0 - fmax(0.01, measure_kept(drive->fastest, whole));
    if (isnan(options->exposure) && loss > 0.02)
        measure_warn(measured,
                     "the exposure is unknown: with one of a whole frame (%.3g ms) std_r would be %.2g %% too "
                     "small; give it, and film with 1/500 s or less",
                     1e3 * whole, 100.0 * loss);
}

/* What the exposure did to an oscillation whose frequency is not known, or whose blur cannot be undone. */
static void widen_for_exposure(const measure_work *work, const measure_drive *drive, int lost,
                               fst_measurement *measured)
{
    const double bead = fabs(work->bead), kept = measure_kept(drive->fastest, work->exposure);
    /* Where the line is a known one each of its waves is restored by its own frequency; otherwise that of a wave may
     * be anything up to the fastest one. */
    const int known = (drive->motion == FST_MOTION_TURNING && !drive->folded) || drive->fastest == work->peak;
    const double apart = known ? 0.0 : 1.0 / measure_kept(drive->fastest + bead, work->exposure) - 1.0;
    if (lost || kept < MEASURE_LEAST_KEPT || !(apart >= 0.0 && apart < MOST_APART) ||
        (drive->bead_folded && measure_kept(work->fps - bead, work->exposure) < 0.98)) {
        measure_warn(
            measured,
            known ? "the exposure lasts as long as an oscillation of r: what it blurred cannot be restored"
                  : "how fast r oscillates is not known, nor what the exposure has blurred of it: there is "
                    "no delta r; film with 1/500 s or less, at 120 or 240 frames a second");
        /* What blurred the oscillation away blurred the mean radius too, by an unknown part. */
        measured->std_r = measured->std_r_error = measured->mean_r_error = NAN;
        measured->drive_from_track_hz_error = measured->festoons_error = measured->radial_frequency_hz_error =
            NAN;
        return;
    }
    const double *c = work->angular.coefficient + 1; /* the path's bends, whose blur shortens the mean radius */
    const double bends = work->rolls ? 0.0 : 0.5 * fst_dot(c, c, work->angular.columns - 2);
    measured->std_r_error = hypot(measured->std_r_error, apart * measured->std_r);
    measured->mean_r_error = hypot(measured->mean_r_error, apart * bends * measured->mean_r);
}

/* Without a clock nobody knows how many frames an exposure lasts, so that its blur stays in the numbers. */
static void forget_blurred(fst_measurement *measured)
{
    measure_warn(measured, "the exposure cannot be undone without a clock: give the frame rate");
    measured->std_r = measured->std_r_error = measured->mean_r_error = NAN;
}

/* ---------------------------------------------------------------- the whole */

/* Whether every second festoon is alike cannot be told. */
static void forget_festoons(const measure_work *work, fst_measurement *measured, int fades)
{
    const int folded = work->skipped[0] || measure_line_is_blended(work);
    measure_warn(measured, "%s: there are %.4g festoons, or %.4g if they are all alike (S2); %s",
                 fades    ? "every second festoon differs ever less in this film"
                 : folded ? "the frame rate hides whether every second festoon differs"
                          : "the noise of the places hides whether every second festoon differs",
                 0.5 * measured->festoons, measured->festoons,
                 fades    ? "film the motion when it has settled, and for longer"
                 : folded ? "film it at 120 or 240 frames a second"
                          : "film it for longer, or closer");
    measured->festoons = measured->festoons_error = NAN;
    measured->radial_frequency_hz = measured->radial_frequency_hz_error = NAN;
}

/* Clean and fit until no more places are rejected. */
static fst_status find_motion(measure_work *work, fst_error *error)
{
    /* Beside a wild place another one looks less wild: look again once the first ones are gone. */
    for (int again = 0; again < 6 && measure_reject_jumps(work->track, work) > 0; ++again)
        measure_work_take(work);
    fst_status status = measure_find_motion(work, error);
    /* A wild place makes good ones beside it look wild; the model tells them apart. */
    if (status == FST_OK && measure_take_back(work->track, work) > 0) {
        measure_work_take(work);
        status = measure_find_motion(work, error);
    }
    if (status == FST_OK)
        status = measure_settle(work, error);
    for (int again = 0; again < 4 && status == FST_OK && measure_reject_far(work->track, work) > 0; ++again) {
        measure_work_take(work);
        status = measure_find_motion(work, error);
    }
    return status;
}

/* The size of the oscillation of r. */
static double oscillation(const measure_work *work)
{
    const double *waves = work->radial.coefficient + 1;
    return sqrt(fst_dot(waves, waves, work->radial.columns - MEASURE_GEOMETRY - 1));
}

static fst_status measure(measure_work *work, const fst_measure_options *options, fst_measurement *measured,
                          fst_error *error)
{
    measure_drive drive = {.motion = FST_MOTION_UNKNOWN, .relative = 1, .radial = NAN};
    fst_status status = find_motion(work, error);
    if (status == FST_OK)
        status = measure_find_drive(work, options, &drive, measured, error);
    int lost = 0;
    if (status == FST_OK && options->exposure > 0 && isfinite(work->track->fps)) {
        const double before = oscillation(work);
        work->exposure = options->exposure;
        lost = measure_sharpen(work);
        status = measure_refine_motion(work, error);
        work->gain = before > 0 ? fmax(1.0, oscillation(work) / before) : 1.0;
    }
    measured->fps = isfinite(work->track->fps) ? work->fps : NAN;
    measured->motion = drive.motion;
    measured->symmetry =
        drive.motion == FST_MOTION_TURNING && !drive.unsure && !drive.folded ? drive.symmetry : 0;
    if (status == FST_OK)
        status = measure_find_errors(work, &drive, measured, error);
    if (status == FST_OK && drive.unsure)
        forget_festoons(work, measured, drive.fades);
    if (status == FST_OK && work->exposure > 0)
        widen_for_exposure(work, &drive, lost, measured);
    if (status == FST_OK && options->exposure > 0 && isnan(measured->fps))
        forget_blurred(measured);
    if (status == FST_OK && drive.standing)
        measured->std_r = NAN;
    if (status == FST_OK && measured->wave_mean < 3.0 * measured->noise)
        status = fst_fail(error, FST_NO_CONVERGENCE, "",
                          "the bead rests, or trembles: its path has a radius of %.3g %s, no more than the "
                          "noise of its places (%.2g %s)",
                          measured->mean_r, measured->length_unit, measured->noise, measured->length_unit);
    if (status == FST_OK)
        warn_of_exposure(work, &drive, options, measured);
    return status;
}

/* Rates of a track without a clock are turns a frame, which is not Hz. */
static void forget_rates(fst_measurement *measured)
{
    measured->bead_frequency_hz = measured->bead_frequency_hz_error = NAN;
    measured->drive_from_track_hz = measured->drive_from_track_hz_error = NAN;
    measured->radial_frequency_hz = measured->radial_frequency_hz_error = NAN;
    measure_warn(measured, "the file has no clock: give the frame rate (or the drive, from which it follows)");
}

fst_status fst_measure_track(fst_track *track, const fst_measure_options *options, fst_measurement *measured,
                             fst_error *error)
{
    measure_work work;
    memset(measured, 0, sizeof *measured);
    for (int i = 0; i < fst_measured_count(); ++i) {
        const double unknown = NAN;
        memcpy((char *)measured + rows[i].offset, &unknown, sizeof unknown);
    }
    (void)snprintf(measured->length_unit, sizeof measured->length_unit, "%s", track->length_unit);
    if (track->scale_error > 0.0)
        measured->scale_error = track->scale_error;
    fst_status status = check(options, track, error);
    if (status == FST_OK && track->rows < 2)
        status = fst_fail(error, FST_BAD_INPUT, "", "a track of %zu frames: nothing can be measured of it",
                          track->rows);
    if (status == FST_OK)
        status = measure_forget_slowed_clock(track, measured, error);
    if (status == FST_OK)
        status = measure_work_begin(&work, track, error);
    if (status != FST_OK)
        return status;
    work.progress = options->progress;
    status = measure(&work, options, measured, error);
    if (status == FST_OK) {
        count_frames(track, measured);
        measure_tell_settled(&work, measured);
        warn_of_frames(track, measured);
        if (isnan(measured->fps))
            forget_rates(measured);
    }
    measure_work_free(&work);
    return status;
}
