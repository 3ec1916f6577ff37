/* pairs.c - several beads of one film: each measured by itself, and the angle between every two of them over time.
 *
 * The angle is that from one bead to the other about their common centre, on the plate, without the tilt of the camera.
 * Its mean in each of eight parts of the film gives its drift; how much these means scatter about a straight line gives the
 * errors, so that what the beads do within a turn is allowed for.  The middle of a part counts most: of an oscillation that a
 * part cuts off somewhere the mean is then next to nothing.
 */
#include "measure/work.h"

#include <string.h>

#include "base/constants.h"
#include "base/error.h"
#include "base/listed.h"
#include "io/json_writer.h"

enum { PARTS = 8 };

#define DEGREES (180.0 / FST_PI)
#define LEAST_TURNS 8.0 /* what an error of the centre does is not gone from parts of less than a turn */
#define STUDENT 1.09    /* errors of eight means about a straight line, to those of many */
#define RIGID 0.65      /* of the mean distance is the least one of beads that stay together */
#define SURE 3.7        /* errors of eight means: beyond so many lies one in a hundred */

const char *fst_pairing_name(fst_pairing pairing)
{
    FST_NAME_IN(FST_PAIRINGS, pairing, "unknown");
}

/* What is seen of a pair, over its frames. */
typedef struct pair_work {
    const fst_track *tracks[2];
    const fst_measurement *known[2]; /* NULL: not measured */
    double centre[2], stretch[3];
    int64_t from;          /* the first frame that counts */
    double sums[PARTS][3]; /* weight, time and angle of each part */
    double begin, end;     /* s, or frames */
} pair_work;

/* Centre and tilt: the means of what both beads tell. */
static int find_centre(pair_work *w)
{
    int count = 0;
    w->from = INT64_MIN;
    w->stretch[0] = w->stretch[2] = 1.0;
    for (int k = 0; k < 2; ++k) {
        const fst_measurement *m = w->known[k];
        if (!m)
            continue;
        ++count;
        for (int i = 0; i < 2; ++i)
            w->centre[i] += (m->centre[i] - w->centre[i]) / count;
        for (int i = 0; i < 3; ++i)
            w->stretch[i] += (m->stretch[i] - w->stretch[i]) / count;
        const int64_t from = w->tracks[k]->frame[0] + m->left_out;
        w->from = from > w->from ? from : w->from;
    }
    return count;
}

static void place_of(const pair_work *w, int which, size_t row, double place[2])
{
    const double x = w->tracks[which]->x[row] - w->centre[0], y = w->tracks[which]->y[row] - w->centre[1];
    place[0] = w->stretch[0] * x + w->stretch[1] * y;
    place[1] = w->stretch[1] * x + w->stretch[2] * y;
}

/* Go to the next row of both tracks that shows both beads; 0: there is none. */
static int next_row(const pair_work *w, size_t row[2])
{
    const fst_track *a = w->tracks[0], *b = w->tracks[1];
    while (row[0] < a->rows && row[1] < b->rows) {
        const int64_t off = a->frame[row[0]] - b->frame[row[1]];
        if (off == 0 && a->flag[row[0]] == FST_FRAME_SEEN && b->flag[row[1]] == FST_FRAME_SEEN &&
            a->frame[row[0]] >= w->from)
            return 1;
        row[0] += off <= 0;
        row[1] += off >= 0;
    }
    return 0;
}

static double moment_of(const pair_work *w, size_t row)
{
    const fst_track *a = w->tracks[0];
    return isfinite(a->t[row]) ? a->t[row] : (double)a->frame[row];
}

static void look_at_distance(pair_work *w, fst_pair *pair)
{
    double sum = 0.0;
    for (size_t row[2] = {0, 0}; next_row(w, row); ++row[0], ++row[1]) {
        double a[2], b[2];
        place_of(w, 0, row[0], a);
        place_of(w, 1, row[1], b);
        const double apart = hypot(b[0] - a[0], b[1] - a[1]);
        w->begin = pair->frames++ > 0 ? w->begin : moment_of(w, row[0]);
        w->end = moment_of(w, row[0]);
        pair->least_distance = pair->frames > 1 ? fmin(pair->least_distance, apart) : apart;
        sum += apart;
    }
    if (pair->frames > 0)
        pair->mean_distance = sum / (double)pair->frames;
}

/* The angle over time: its sums in the parts of the film, and its deviation. */
static void look_at_angle(pair_work *w, fst_pair *pair)
{
    double before = 0.0, sum = 0.0, squares = 0.0, n = 0.0;
    for (size_t row[2] = {0, 0}; next_row(w, row); ++row[0], ++row[1]) {
        double a[2], b[2];
        place_of(w, 0, row[0], a);
        place_of(w, 1, row[1], b);
        const double t = moment_of(w, row[0]);
        double angle = atan2(a[0] * b[1] - a[1] * b[0], a[0] * b[0] + a[1] * b[1]);
        angle += FST_TWO_PI * floor((before - angle) / FST_TWO_PI + 0.5) * (n > 0.0);
        before = angle;
        const double place = PARTS * (t - w->begin) / (w->end - w->begin), sine = sin(FST_PI * place);
        const int part = (int)fmin(PARTS - 1, floor(place));
        const double sums[3] = {sine * sine, sine * sine * t, sine * sine * angle};
        for (int k = 0; k < 3; ++k)
            w->sums[part][k] += sums[k];
        n += 1.0;
        squares += (n - 1.0) / n * (angle - sum) * (angle - sum);
        sum += (angle - sum) / n;
    }
    pair->angle_spread_deg = DEGREES * sqrt(squares / n);
}

/* The straight line through the means of the parts. */
static void find_drift(const pair_work *w, double turns, fst_pair *pair)
{
    double t = 0.0, angle = 0.0, tt = 0.0, ta = 0.0, off = 0.0, scatter = 0.0, means[PARTS][2];
    for (int i = 0; i < PARTS; ++i) {
        if (!(w->sums[i][0] > 2.0)) {
            (void)snprintf(pair->reason, sizeof pair->reason,
                           "in an eighth of the film, or more, there are not both beads");
            return;
        }
        for (int k = 0; k < 2; ++k)
            means[i][k] = w->sums[i][k + 1] / w->sums[i][0];
        t += means[i][0] / PARTS;
        angle += means[i][1] / PARTS;
    }
    for (int i = 0; i < PARTS; ++i) {
        tt += (means[i][0] - t) * (means[i][0] - t);
        ta += (means[i][0] - t) * (means[i][1] - angle);
    }
    const double slope = ta / tt, whole = slope * (w->end - w->begin);
    for (int i = 0; i < PARTS; ++i) {
        const double rest = means[i][1] - angle - slope * (means[i][0] - t);
        off += rest * rest;
        scatter += (means[i][1] - angle) * (means[i][1] - angle);
    }
    const double error = STUDENT * sqrt(off / (PARTS - 2) / tt);
    pair->pairing = fabs(slope) <= SURE * error && fabs(whole) < FST_PI ? FST_PAIRING_STEADY
                    : fabs(whole) < FST_TWO_PI                          ? FST_PAIRING_DRIFTING
                                                                        : FST_PAIRING_PASSING;
    pair->drift_deg_s = DEGREES * slope;
    pair->drift_deg_s_error = DEGREES * error;
    if (turns < LEAST_TURNS) {
        if (pair->pairing != FST_PAIRING_PASSING)
            pair->pairing = FST_PAIRING_UNKNOWN;
        pair->drift_deg_s_error = NAN;
        (void)snprintf(pair->reason, sizeof pair->reason, "the beads make less than eight turns");
    }
    if (pair->pairing !=
        FST_PAIRING_PASSING) { /* of a bead that goes past the other one an angle has no mean */
        pair->angle_deg = DEGREES * remainder(angle, FST_TWO_PI);
        pair->angle_deg_error =
            turns < LEAST_TURNS ? NAN : STUDENT * DEGREES * sqrt(scatter / (PARTS - 1) / PARTS);
    }
}

/* Beads that touch turn about each other, and that is what r oscillates with: of a bead alone nothing is told by it. */
static void forget_what_turning_shows(const fst_pair *pair, fst_measurement *m)
{
    if (m->motion == FST_MOTION_LOCKED || !(pair->least_distance > RIGID * pair->mean_distance) ||
        !(pair->mean_distance < m->mean_r))
        return;
    measure_warn(m,
                 "beads %d and %d stay together and turn about each other: the oscillation of r tells neither "
                 "festoons nor the drive",
                 pair->beads[0] + 1, pair->beads[1] + 1);
    m->festoons = m->festoons_error = m->drive_from_track_hz = m->drive_from_track_hz_error = NAN;
    m->motion = FST_MOTION_UNKNOWN;
    m->symmetry = 0;
}

static void measure_pair(const fst_track *tracks, fst_beads_measurement *m, fst_pair *pair)
{
    pair_work w = {.centre = {0.0, 0.0}};
    double turns = INFINITY;
    for (int k = 0; k < 2; ++k) {
        w.tracks[k] = &tracks[pair->beads[k]];
        w.known[k] = m->reasons[pair->beads[k]][0] ? NULL : &m->beads[pair->beads[k]];
        if (w.known[k])
            turns = fmin(turns, fabs(w.known[k]->turns));
    }
    const int centred = find_centre(&w);
    look_at_distance(&w, pair);
    if (!centred) {
        (void)snprintf(pair->reason, sizeof pair->reason, "the centre about which they go is not known");
    } else if (pair->frames < 3 * PARTS) {
        (void)snprintf(pair->reason, sizeof pair->reason, "both are seen in %lld frames only",
                       (long long)pair->frames);
    } else {
        look_at_angle(&w, pair);
        find_drift(&w, turns, pair);
    }
    for (int k = 0; k < 2; ++k)
        if (w.known[k])
            forget_what_turning_shows(pair, &m->beads[pair->beads[k]]);
    if (!isfinite(w.tracks[0]->fps))
        pair->drift_deg_s = pair->drift_deg_s_error = NAN;
}

/* Beads between which the angle is steady make a group. */
static void find_groups(fst_beads_measurement *m)
{
    m->grouped = 1;
    for (int i = 0; i < m->count; ++i)
        m->groups[i] = i;
    for (int again = 0; again < m->count; ++again)
        for (int i = 0; i < m->pair_count; ++i) {
            int *a = &m->groups[m->pairs[i].beads[0]], *b = &m->groups[m->pairs[i].beads[1]];
            if (m->pairs[i].pairing == FST_PAIRING_STEADY)
                *a = *b = *a < *b ? *a : *b;
            m->grouped = m->grouped && m->pairs[i].pairing != FST_PAIRING_UNKNOWN;
        }
}

fst_status fst_measure_tracks(fst_track *tracks, int count, const fst_measure_options *options,
                              fst_beads_measurement *m, fst_error *error)
{
    fst_error first = {FST_OK, "", ""}, said = {FST_OK, "", ""};
    int measured = 0;
    memset(m, 0, sizeof *m);
    if (count < 1 || count > FST_TRACKED_BEADS)
        return fst_fail(error, FST_BAD_INPUT, "fst_measure_tracks", "%d tracks: 1 to %d", count,
                        FST_TRACKED_BEADS);
    for (m->count = 0; m->count < count; ++m->count) {
        const fst_status status = fst_measure_track(&tracks[m->count], options, &m->beads[m->count], &said);
        if (status != FST_OK && (status != FST_NO_CONVERGENCE || count == 1)) {
            if (error)
                *error = said;
            return status;
        }
        m->uncertain_from[m->count] = measure_first_doubt(&tracks[m->count]);
        measured += status == FST_OK;
        first = status != FST_OK && !first.sentence[0] ? said : first;
        if (status != FST_OK)
            (void)snprintf(m->reasons[m->count], sizeof m->reasons[0], "%.300s", said.sentence);
    }
    if (measured == 0) {
        if (error)
            *error = first;
        return FST_NO_CONVERGENCE;
    }
    for (int i = 0; i < count; ++i)
        for (int k = i + 1; k < count; ++k) {
            m->pairs[m->pair_count] = (fst_pair){.beads = {i, k},
                                                 .angle_deg = NAN,
                                                 .angle_deg_error = NAN,
                                                 .angle_spread_deg = NAN,
                                                 .drift_deg_s = NAN,
                                                 .drift_deg_s_error = NAN,
                                                 .mean_distance = NAN,
                                                 .least_distance = NAN,
                                                 .pairing = FST_PAIRING_UNKNOWN};
            measure_pair(tracks, m, &m->pairs[m->pair_count++]);
        }
    find_groups(m);
    return FST_OK;
}

/* ---------------------------------------------------------------- JSON */

static void write_pair(fst_json *json, const fst_pair *p)
{
    fst_json_open(json, NULL, '{');
    fst_json_open(json, "beads", '[');
    for (int k = 0; k < 2; ++k)
        fst_json_integer(json, NULL, p->beads[k] + 1);
    fst_json_close(json);
    fst_json_text(json, "pairing", p->pairing == FST_PAIRING_UNKNOWN ? NULL : fst_pairing_name(p->pairing));
    fst_json_real(json, "angle_deg", p->angle_deg);
    fst_json_real(json, "angle_deg_error", p->angle_deg_error);
    fst_json_real(json, "angle_spread_deg", p->angle_spread_deg);
    fst_json_real(json, "drift_deg_s", p->drift_deg_s);
    fst_json_real(json, "drift_deg_s_error", p->drift_deg_s_error);
    fst_json_real(json, "mean_distance", p->mean_distance);
    fst_json_real(json, "least_distance", p->least_distance);
    fst_json_integer(json, "frames", p->frames);
    fst_json_text(json, "reason", p->reason[0] ? p->reason : NULL);
    fst_json_close(json);
}

char *fst_beads_measurement_json(const fst_beads_measurement *m)
{
    fst_json json = fst_json_begin('{');
    fst_json_open(&json, "beads", '[');
    for (int i = 0; i < m->count; ++i) {
        fst_json_open(&json, NULL, '{');
        measure_write(&json, &m->beads[i]);
        fst_json_text(&json, "reason", m->reasons[i][0] ? m->reasons[i] : NULL);
        fst_json_real(&json, "uncertain_from_frame",
                      m->uncertain_from[i] < 0 ? NAN : (double)m->uncertain_from[i]);
        fst_json_close(&json);
    }
    fst_json_close(&json);
    fst_json_open(&json, "pairs", '[');
    for (int i = 0; i < m->pair_count; ++i)
        write_pair(&json, &m->pairs[i]);
    fst_json_close(&json);
    fst_json_open(&json, "groups", '[');
    for (int group = 0; group < m->count && m->grouped; ++group) {
        int size = 0;
        for (int i = 0; i < m->count; ++i) {
            if (m->groups[i] != group)
                continue;
            if (size++ == 0)
                fst_json_open(&json, NULL, '[');
            fst_json_integer(&json, NULL, i + 1);
        }
        if (size > 0)
            fst_json_close(&json);
    }
    fst_json_close(&json);
    return fst_json_end(&json, JSON_INDENT(2));
}
