/* drive.c - what the oscillation of r tells of the drive, of the symmetry, and of the clock.
 *
 * In the frame of the magnet the bead goes round with f0 = f_drive - f_bead, f_bead being negative against the
 * magnet. r repeats with f0 (a = 1), or with 2 f0 where the path has the symmetry S2 (a = 2): the film shows
 * f_r = a f0 and f_bead, and so the drive.  Where the drive is known there is one condition more than unknowns,
 * and it checks the clock: if times ran slower by a factor s, both rates are too small by s, the drive is not.
 *
 *   f_r = a (f_drive - f_bead)   true rates        s f_r = a (f_drive - s f_bead)   a clock that is slow by s
 *
 * A film shows rates beyond half its frame rate at another place (folded): they are sought there.
 */
#include "measure/work.h"

#include <stdarg.h>

#include "base/constants.h"

/* How far the given drive may be from that of the track: people type three digits. */
#define OF_DRIVE 0.007
/* Patterns with less festoons than this have a = 1, with more a = 2: the model's end at 6 and begin at 12, the
 * paper's Table 1 has the same gap. */
#define MANY_FESTOONS 9.0
#define LEAST_FESTOONS 2.6 /* below this the line is a folded one, or there are no festoons */
/* Lines that a film may have folded are sought up to here: stirrers turn no faster, patterns have no more. */
#define GREATEST_DRIVE 30.0
#define MOST_FESTOONS 40.0
/* No bead goes round faster than this with a magnet that is not known. */
#define FASTEST_BEAD 12.0

enum { ALIASES_SIZE = FST_WARNING_SIZE / 3 };

void measure_warn(fst_measurement *measured, const char *format, ...)
{
    if (measured->warning_count == FST_WARNING_LIMIT)
        return;
    va_list values;
    va_start(values, format);
    (void)vsnprintf(measured->warnings[measured->warning_count++], FST_WARNING_SIZE, format, values);
    va_end(values);
}

/* ---------------------------------------------------------------- does the clock agree? */

typedef struct match {
    int lines;     /* the strongest line of r is at so many times f0 */
    int relative;  /* sense of the bead against the magnet */
    double miss;   /* how far that is, over how far it may be */
    double radial; /* the frequency of that line, unfolded */
} match;

/* The line that is strongest by the number of festoons alone. */
static int likely_lines(const measure_work *work)
{
    return work->half || work->peak > MANY_FESTOONS * fabs(work->bead) ? 2 : 1;
}

/* The line of r nearest to where the drive puts it.  With four festoons 2 (f_drive - f_bead) is f_drive +
 * f_bead: with the line that is unlikely for the number of festoons a mirrored film would look like a bead that
 * goes round with the magnet, so that line, and then a sense other than the filmed one, must be nearer by a
 * part of what it may miss.  A folded line gives no number of festoons. */
static match best_match(const measure_work *work, double drive, int filmed)
{
    match best = {0, filmed, INFINITY, 0.0};
    double least = INFINITY;
    const int likely = likely_lines(work);
    for (int turn = 0; turn < 2; ++turn)
        for (int lines = 1; lines <= 2; ++lines) {
            const int relative = turn == 0 ? filmed : -filmed;
            const double expected = lines * fabs(drive - relative * fabs(work->bead));
            const int folded = expected > 0.5 * work->fps;
            /* A sense that contradicts the film needs better evidence than a folded line. */
            if (turn > 0 && folded)
                continue;
            const double miss = fabs(measure_folded(expected, work->fps) - work->peak) /
                                (OF_DRIVE * lines * drive + 0.3 / measure_duration(work));
            const double doubt = miss + 0.4 * turn + (lines != likely && !folded ? 0.6 : 0.0);
            if (miss < 1.0 && doubt < least) {
                const double turns = work->fps * round(expected / work->fps);
                const double one = turns + work->peak, other = turns - work->peak;
                least = doubt;
                best = (match){lines, relative, miss,
                               fabs(one - expected) < fabs(other - expected) ? one : fabs(other)};
            }
        }
    return best;
}

/* ---------------------------------------------------------------- what else may a line be? */

/* The frequency that the film would show as that of the strongest line, by the n-th folding. */
static double unfolded(const measure_work *work, int n)
{
    return n % 2 ? (n + 1) / 2 * work->fps - work->peak : n / 2 * work->fps + work->peak;
}

/* The most that festoons oscillate with: without a clock their number alone is bounded. */
static double most_of_lines(const measure_work *work, double greatest_drive)
{
    const double bead = fabs(work->bead), most = MOST_FESTOONS * bead;
    return isfinite(work->track->fps) ? fmin(most, 2.0 * (greatest_drive + bead)) : most;
}

/* The greatest frequency up to `most` that the film may show as the strongest line; of none, `most`. */
static double fastest_line(const measure_work *work, double most)
{
    double fastest = work->peak > 0 ? work->peak : most;
    for (int n = 1; work->peak > 0 && unfolded(work, n) <= most; ++n)
        fastest = unfolded(work, n);
    return fastest;
}

/* What else the line may be, if the film folded it: the drive would be another one, and so would the number of
 * festoons.  Nothing in the film tells the readings apart, so none of them is a result. */
static int list_aliases(const measure_work *work, char others[ALIASES_SIZE])
{
    const double bead = fabs(work->bead), most = most_of_lines(work, GREATEST_DRIVE);
    const int timed = isfinite(work->track->fps);
    size_t length = 0;
    others[0] = '\0';
    for (int n = 1; unfolded(work, n) <= most; ++n)
        for (int of = 1; of <= 2; ++of) {
            const double line = unfolded(work, n), festoons = line / bead, drive = line / of - bead;
            /* Twice the line of S1 may be its strongest. */
            if (festoons < of * LEAST_FESTOONS || festoons > (of == 1 ? MANY_FESTOONS : MOST_FESTOONS) ||
                (timed && drive > GREATEST_DRIVE))
                continue;
            if (length + 16 < ALIASES_SIZE)
                length += (size_t)snprintf(others + length, ALIASES_SIZE - length, "%s%.4g%s",
                                           length ? ", " : "", timed ? drive : festoons, timed ? " Hz" : "");
        }
    return length > 0;
}

static void tell_aliases(const measure_work *work, measure_drive *found, fst_measurement *measured)
{
    char others[ALIASES_SIZE];
    const double bead = fabs(work->bead);
    const int timed = isfinite(work->track->fps);
    found->folded = list_aliases(work, others);
    if (found->folded && timed)
        measure_warn(measured,
                     "%.4g frames a second may show a quicker oscillation of r as one at %.4g Hz (alias): the "
                     "drive may be %s as well as %.4g Hz; give it, or film at 120 or 240 frames a second",
                     work->fps, work->peak, others, work->peak / likely_lines(work) - bead);
    else if (found->folded)
        measure_warn(
            measured,
            "so few frames in a turn of the bead (%.3g) may show a quicker oscillation of r as a slow "
            "one (alias): there may be %s festoons as well as %.4g; film at 120 or 240 frames a second",
            1.0 / bead, others, work->peak / bead);
}

/* ---------------------------------------------------------------- which clock would agree? */

/* The frame rate of cameras nearest to `fps`, or 0 where none is near. */
static double usual_rate(double fps)
{
    static const double rates[] = {15,  23.976, 24,  25,     29.97, 30,   48,   50,   59.94,
                                   60,  90,     100, 119.88, 120,   150,  180,  200,  239.76,
                                   240, 250,    300, 400,    420,   480,  500,  600,  720,
                                   800, 900,    960, 1000,   1200,  1500, 1920, 2000, 2400};
    double nearest = 0.0;
    for (size_t i = 0; i < sizeof rates / sizeof *rates; ++i)
        if (fabs(fps / rates[i] - 1.0) < fmin(0.012, fabs(fps / nearest - 1.0)))
            nearest = rates[i];
    return nearest;
}

/* The factor by which the clock is slow, if the strongest line is at `lines` f0 and the bead has this sense. */
static double slowness(const measure_work *work, double drive, int lines, int relative)
{
    return lines * drive / (work->peak + lines * relative * fabs(work->bead));
}

/* Make time run by this factor faster. */
static void correct_clock(measure_work *work, double factor)
{
    fst_track *track = work->track;
    const double fps = work->fps * factor;
    for (size_t i = 0; i < track->rows; ++i)
        track->t[i] =
            isfinite(track->fps) ? track->t[i] / factor : (double)(track->frame[i] - track->frame[0]) / fps;
    for (size_t i = 0; i < work->count; ++i)
        work->t[i] /= factor;
    work->fps = fps;
    work->bead *= factor;
    work->peak *= factor;
    work->f0 *= factor;
    track->fps = fps;
}

/* Look for a clock under which drive and track agree.  Returns 1 where one was found and set, -1 where the clock is said to be
 * wrong, but stays. */
static int find_clock(measure_work *work, double drive, int filmed, measure_drive *found,
                      fst_measurement *measured)
{
    const int timed = isfinite(work->track->fps), likely = likely_lines(work);
    double stayed = NAN;
    char others[ALIASES_SIZE];
    /* Each reading would give another clock. */
    if (!timed && work->peak > 0 && list_aliases(work, others))
        return 0;
    for (int try = 0; try < 3; ++try) {
        const int lines = try == 1 ? 3 - likely : likely, locked = try == 2;
        if (locked ? filmed < 0 : !(work->peak > 0))
            continue;
        /* S2 never has so few festoons, and of two clocks the wrong one may be usual too. */
        if (try == 1 && lines == 2)
            continue;
        const double factor = locked ? drive / fabs(work->bead) : slowness(work, drive, lines, filmed);
        if (!(factor > 0))
            continue;
        if (try == 0)
            stayed = work->fps * factor;
        const double usual = timed ? usual_rate(work->fps * factor) : work->fps * factor;
        if (usual == 0.0 || (timed && fabs(usual / work->fps - 1.0) < 0.01))
            continue;
        const double before = work->fps;
        correct_clock(work, usual / work->fps);
        found->clock_follows = !timed;
        found->clock_set = timed;
        found->motion = locked ? FST_MOTION_LOCKED : FST_MOTION_TURNING;
        found->radial = locked ? NAN : work->peak;
        found->relative = locked ? 1 : filmed;
        found->symmetry = lines == 2 && !work->half ? 2 : 1;
        work->f0 = locked ? work->f0 : work->peak / lines;
        /* The corrected clock may say that the line is a folded one after all, just beyond half the frame rate.
         */
        const match m = locked ? (match){0, filmed, INFINITY, 0.0} : best_match(work, drive, filmed);
        if (m.miss < 1.0) {
            found->radial = m.radial;
            work->f0 = m.radial / m.lines;
            found->symmetry = m.lines;
        }
        if (timed)
            measure_warn(measured,
                         "the clock is wrong: with a drive of %.6g Hz the festoons ask for %.6g frames a "
                         "second, not for the file's %.6g (%.4g frames a second stored as %.4g?); all rates "
                         "are those of the corrected clock",
                         drive, usual, before, usual, before);
        return 1;
    }
    if (isfinite(stayed) && timed)
        measure_warn(measured,
                     "the frame rate or the drive is wrong: r oscillates at %.5g Hz while the bead turns at "
                     "%.5g Hz, which a drive of %.5g Hz does not make; %.5g frames a second would agree, but "
                     "cameras have no such rate, so the file's %.5g were kept",
                     work->peak, fabs(work->bead), drive, stayed, work->fps);
    return isfinite(stayed) && timed ? -1 : 0;
}

/* ---------------------------------------------------------------- cases */

/* Without a drive, or with one that agrees with nothing: what a bead that circles clockwise against a magnet
 * that turns counter-clockwise shows by itself. */
static void by_itself(measure_work *work, int filmed, measure_drive *found, fst_measurement *measured)
{
    const double bead = fabs(work->bead);
    *found = (measure_drive){
        .motion = FST_MOTION_UNKNOWN, .relative = filmed, .radial = work->peak > 0 ? work->peak : NAN};
    if (work->peak == 0.0) {
        measure_warn(measured, "r does not oscillate beyond the noise: how the magnet turns cannot be told");
    } else if (filmed > 0) {
        measure_warn(
            measured,
            "the bead goes round counter-clockwise, as the magnet is taken to do: it may be locked or "
            "librating, or go with a magnet of about %.4g Hz, or the film is mirrored, or the magnet turns "
            "clockwise (then the drive is about %.4g Hz: give it as %.4g Hz); the drive must be given to "
            "tell",
            work->peak / likely_lines(work) + bead, work->peak / likely_lines(work) - bead,
            bead - work->peak / likely_lines(work));
    } else if (work->peak < LEAST_FESTOONS * bead && unfolded(work, 1) > most_of_lines(work, GREATEST_DRIVE)) {
        measure_warn(
            measured,
            "r oscillates at %.4g Hz, too slowly for festoons at %.4g turns a second: the film is mirrored, "
            "and the bead goes with the magnet, or the drive must be given to tell",
            work->peak, bead);
    } else if (work->peak < LEAST_FESTOONS * bead) {
        measure_warn(
            measured,
            "r oscillates at %.4g Hz in this film, too slowly for festoons at %.4g turns a second: the frame "
            "rate is too low to show them (alias); film at 120 or 240 frames a second, or give the drive",
            work->peak, bead);
    } else {
        const int lines = likely_lines(work);
        found->motion = FST_MOTION_TURNING;
        found->symmetry = lines == 2 && !work->half ? 2 : 1;
        work->f0 = work->peak / lines;
        if (work->half)
            found->radial = work->f0;
        tell_aliases(work, found, measured);
    }
}

/* Whether the bead has the magnet's rate. */
static int goes_with(const measure_work *work, double drive)
{
    return fabs(fabs(work->bead) - drive) < 0.01 * drive;
}

/* The drive is given, and so is a clock: compare. */
static int by_drive(measure_work *work, double drive, int filmed, measure_drive *found,
                    fst_measurement *measured)
{
    const match m = work->peak > 0 ? best_match(work, drive, filmed) : (match){0, filmed, INFINITY, 0.0};
    const char *const sense = work->bead > 0 ? "counter-clockwise" : "clockwise";
    if (goes_with(work, drive) && (filmed > 0 || !(m.miss < 1.0))) {
        *found = (measure_drive){.motion = FST_MOTION_LOCKED, .relative = 1, .radial = NAN};
        if (filmed < 0)
            measure_warn(
                measured,
                "the bead goes round at the magnet's rate, but %s: the film is mirrored, or the magnet "
                "turns %s (then give the drive %s a minus)",
                sense, sense, work->bead > 0 ? "without" : "with");
        return 1;
    }
    if (!(m.miss < 1.0))
        return 0;
    *found = (measure_drive){
        .motion = FST_MOTION_TURNING, .symmetry = m.lines, .relative = m.relative, .radial = m.radial};
    work->f0 = m.radial / m.lines;
    if (m.relative != filmed)
        measure_warn(measured,
                     "the festoons say that the bead goes round %s the magnet, which contradicts the sense in "
                     "the film: it is mirrored, or the drive has the other sign; the bead's frequency has the "
                     "sign that the festoons tell",
                     m.relative < 0 ? "against" : "with");
    if (m.radial > 0.5 * work->fps)
        measure_warn(measured,
                     "r oscillates at %.5g Hz, beyond half of %.5g frames a second: the film shows it as %.5g "
                     "Hz (alias), which the given drive explains",
                     m.radial, work->fps, work->peak);
    return 1;
}

/* Whether the line that is seen may be but twice that of the festoons, which is hidden. */
static int may_be_second(const measure_work *work)
{
    const double most = most_of_lines(work, GREATEST_DRIVE);
    for (int n = 1; unfolded(work, n) <= 2.0 * most; ++n)
        if (unfolded(work, n) > 2.0 * LEAST_FESTOONS * fabs(work->bead) &&
            measure_stands(work, 0.5 * unfolded(work, n)))
            return 1;
    return 0;
}

/* Festoons may be there that are not seen: where they stand still in the film, or look like a tilt, means depend on
 * where they stand. */
static void look_for_standing(const measure_work *work, double drive, measure_drive *found,
                              fst_measurement *measured)
{
    const double unseen = measure_least_line(work);
    for (int lines = 1; lines <= 2 && isfinite(drive); ++lines) {
        const double expected = lines * (drive + fabs(work->bead));
        if (2.0 * expected + 1.5 / measure_duration(work) < work->fps ||
            (measure_folded(expected, work->fps) > unseen && !measure_stands(work, expected)))
            continue;
        found->standing = found->folded = 1;
        measure_warn(
            measured,
            "%.5g frames a second are in step with festoons at %.5g Hz, which stand still in the film, or "
            "look like a tilt: means of r may be wrong by all of its oscillation; film at another frame rate",
            work->fps, expected);
    }
    if (isfinite(drive) ||
        (work->peak > 0 ? !may_be_second(work) : work->fps - unseen > most_of_lines(work, GREATEST_DRIVE)))
        return;
    found->standing = 1;
    measure_warn(
        measured,
        "festoons may stand still in a film of so few frames (%.3g in a turn of the bead), or look like a "
        "tilt: "
        "means of r may be wrong by all of its oscillation; give the drive, or film at 120 or 240 frames a "
        "second",
        work->fps / fabs(work->bead));
}

/* Whether the bead may go round with another rate, which the film shows as this one.  Against a known drive it
 * has festoons, with it the drive's rate. */
static int bead_is_folded(const measure_work *work, double drive, int filmed, const measure_drive *found)
{
    const int known = isfinite(drive);
    for (int n = -1; n <= 1 && found->motion != FST_MOTION_LOCKED; n += 2) {
        const double other = filmed * fabs(work->bead) + n * work->fps;
        if (known ? (other < 0 && -other <= drive / (LEAST_FESTOONS - 1.0)) ||
                        (fabs(other - drive) < 0.01 * drive && found->motion != FST_MOTION_TURNING)
                  : fabs(other) < FASTEST_BEAD)
            return 1;
    }
    return 0;
}

/* What the frame rate hides. */
static void look_for_aliases(const measure_work *work, double drive, int filmed, measure_drive *found,
                             fst_measurement *measured)
{
    const double greatest =
        found->motion == FST_MOTION_LOCKED ? GREATEST_DRIVE : most_of_lines(work, fmax(GREATEST_DRIVE, drive));
    found->fastest =
        found->motion == FST_MOTION_TURNING && !found->folded ? found->radial : fastest_line(work, greatest);
    const int timed = isfinite(work->track->fps);
    if (found->motion != FST_MOTION_LOCKED)
        look_for_standing(work, timed ? drive : NAN, found, measured);
    if (timed && bead_is_folded(work, drive, filmed, found)) {
        found->bead_folded = found->folded = 1;
        found->motion = FST_MOTION_UNKNOWN;
        measure_warn(
            measured,
            "%.4g frames a second may show a bead that turns at %.4g Hz as one at %.4g Hz the other way "
            "round (alias): %s film at 120 or 240 frames a second",
            work->fps, work->fps - fabs(work->bead), fabs(work->bead),
            isfinite(drive) ? "" : "give the drive, or");
    }
}

/* A clock that the drive gives is as good as the rates: take it from the refined ones. */
static fst_status finish_clock(measure_work *work, double drive, const measure_drive *found,
                               fst_measurement *measured, fst_error *error)
{
    fst_status status = FST_OK;
    if (found->motion == FST_MOTION_TURNING) {
        correct_clock(work, drive / (work->f0 + found->relative * fabs(work->bead)));
        status = measure_refine_motion(work, error);
    }
    measure_warn(measured,
                 "the file has no clock: the frame rate, %.6g frames a second, follows from the drive",
                 work->fps);
    return status;
}

/* Of a bead that could not be followed, and whose strongest line is not its rate, neither rate is known, nor what of r is
 * its mean, its oscillation or a tilt. */
static fst_status not_followed(const measure_work *work, int filmed, measure_drive *found,
                               fst_measurement *measured)
{
    *found = (measure_drive){.motion = FST_MOTION_UNKNOWN,
                             .relative = filmed,
                             .radial = NAN,
                             .fastest = fastest_line(work, most_of_lines(work, GREATEST_DRIVE)),
                             .standing = 1,
                             .folded = 1,
                             .bead_folded = 1};
    measure_warn(
        measured,
        "from frame to frame the bead goes too far round the axis to be followed at %.4g frames a second: "
        "its frequency is not known; film at a higher frame rate",
        work->fps);
    return FST_OK;
}

/* Of a motion that does not repeat itself the bead's rate alone is known. */
static fst_status irregular(const measure_work *work, double drive, int filmed, measure_drive *found,
                            fst_measurement *measured)
{
    *found = (measure_drive){.motion = FST_MOTION_UNKNOWN,
                             .relative = filmed,
                             .radial = NAN,
                             .fastest = fastest_line(work, most_of_lines(work, GREATEST_DRIVE))};
    measure_warn(measured,
                 "the motion does not repeat itself (it may be chaotic): r has no frequency that would tell of "
                 "the drive or of festoons");
    look_for_standing(work, drive, found, measured);
    return FST_OK;
}

fst_status measure_find_drive(measure_work *work, const fst_measure_options *options, measure_drive *found,
                              fst_measurement *measured, fst_error *error)
{
    const double drive = fabs(options->drive);
    const int known = isfinite(drive) && drive > 0, timed = isfinite(work->track->fps);
    const int filmed = (work->bead > 0 ? 1 : -1) * (options->drive < 0 ? -1 : 1);
    int agreed = 0;
    const measure_rate rate = measure_look_at_rate(work);
    if (rate == MEASURE_RATE_UNKNOWN)
        return not_followed(work, filmed, found, measured);
    if (rate == MEASURE_RATE_IRREGULAR && !(known && goes_with(work, drive)))
        return irregular(work, known && timed ? drive : NAN, filmed, found, measured);
    if (known && timed)
        agreed = by_drive(work, drive, filmed, found, measured);
    if (known && !agreed)
        agreed = find_clock(work, drive, filmed, found, measured);
    if (agreed != 1)
        by_itself(work, filmed, found, measured);
    found->clock_wrong = agreed < 0;
    look_for_aliases(work, known ? drive : NAN, filmed, found, measured);
    fst_status status = found->motion == FST_MOTION_TURNING ? measure_refine_motion(work, error) : FST_OK;
    if (status == FST_OK && found->clock_follows)
        status = finish_clock(work, drive, found, measured, error);
    if (found->motion != FST_MOTION_TURNING)
        return status;
    if (status == FST_OK && found->symmetry == 2 && measure_has_line(work, 1)) {
        found->symmetry = 1;
        found->radial = work->f0;
    }
    if (work->skipped[1] == 2) {
        found->folded = 1;
        measure_warn(
            measured,
            "%.5g frames a second show an oscillation of r at %.5g Hz in the place of one at %.5g Hz: there is "
            "no number of festoons; film at another frame rate",
            work->fps, 2.0 * work->f0, work->f0);
    }
    const int blended = found->symmetry == 1 && measure_line_is_blended(work);
    found->symmetry = blended ? 2 : found->symmetry;
    found->unsure = !found->folded && found->symmetry == 2 && (blended || measure_may_hide_line(work, 1, 2));
    /* What every second festoon differs by may be but the rest of the motion's beginning. */
    if (status == FST_OK && found->symmetry == 1 && work->half &&
        (work->drifts || measure_line_dies(work, 1))) {
        found->symmetry = 2;
        found->unsure = found->fades = 1;
    }
    return status;
}
