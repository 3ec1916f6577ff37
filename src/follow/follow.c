/* follow.c - fst_film_track(): from a film to a track.
 *
 *   film --> source.c  --> times of its frames
 *        --> still.c   --> what stays still, of 41 frames at random times
 *                          --> learn.c   what the bead looks like
 *        --> decoder.c --> bead.c        where it is, frame by frame --> overlay.c
 *                          beads.c       the same of several
 *                          --> scale.c, plane.c, rim.c, plate.c   millimetres --> fst_track
 *
 * The film is decoded three times, because memory must not grow with it: once for the times, once for the
 * samples, once to follow the bead.
 */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/constants.h"
#include "base/error.h"
#include "base/number.h"
#include "base/order.h"
#include "base/watch.h"
#include "follow/beads.h"
#include "follow/decoder.h"
#include "follow/learn.h"
#include "follow/overlay.h"
#include "follow/scale.h"
#include "follow/turning.h"

#include <festoon/festoon_tools.h>

enum { OPTIONS_COOKIE = 0x54524b46 };
static const double WORST_SCALE = 0.99; /* relative error, of a scale that another one contradicts */

#define LEAST_DIAMETER 3.0 /* pixels */

fst_film_track_options fst_default_film_track_options(void)
{
    return (fst_film_track_options){
        .cookie = OPTIONS_COOKIE, .fps = NAN, .distance = NAN, .turning = NAN, .beads = 1};
}

/* A film being tracked. */
typedef struct tracking {
    const char *path;
    const fst_film_track_options *options;
    fst_film_track_report *report;
    follow_source source;
    follow_still still;
    follow_blobs blobs;
    follow_look look;
    follow_overlay overlay;
    follow_scale scales[FST_FILM_SCALES];
    int scale_count; /* 0: pixels */
    follow_plane plane;
    follow_rim rim;
    follow_turning turning;
    follow_sizes sizes;
    follow_shake shake; /* of a camera that shook; count 0: it stood still */
    double moved[2];    /* the latest frame of it, pixels */
    float *gains;       /* of the rows of such a frame */
    double *columns[FST_TRACKED_BEADS], *rows[FST_TRACKED_BEADS]; /* pixels, of each frame; NAN where lost */
    int *doubts[FST_TRACKED_BEADS]; /* how often until there the bead's name was in doubt */
    int beads, frames;
} tracking;

/* ------------------------------------------------------------------ following */

static void count_places(tracking *t, int index, const follow_place *places, unsigned doubt)
{
    fst_film_track_report *r = t->report;
    int seen = 0;
    for (int bead = 0; bead < t->beads; ++bead) {
        const follow_place *place = &places[bead];
        t->columns[bead][index] = place->column;
        t->rows[bead][index] = place->row;
        t->doubts[bead][index] = (index > 0 ? t->doubts[bead][index - 1] : 0) + (int)(doubt >> bead & 1U);
        seen += !isnan(place->column);
        if (!isnan(place->column) &&
            !isnan(place->diameter)) /* the width of a bead that touches another is not known */
            follow_sizes_add(&t->sizes, place->column, place->row, place->diameter);
    }
    r->twins += places[0].twin;
    if (doubt && r->doubt_count++ < FST_NAME_DOUBTS)
        r->doubts[r->doubt_count - 1] = (fst_name_doubt){index, t->source.times[index], doubt};
    if (seen == t->beads)
        return;
    if (r->first_lost < 0)
        r->first_lost = index;
    ++r->lost;
}

static fst_status follow_frames(tracking *t, follow_decoder *decoder, follow_beads *follower,
                                const fst_progress *progress, fst_error *error)
{
    for (int there = 1;;) {
        follow_place places[FST_TRACKED_BEADS];
        unsigned doubt;
        fst_status status = follow_decoder_next(decoder, &there, error);
        if (status != FST_OK || !there || t->frames == t->source.frames)
            return status;
        const int index = t->frames;
        if (t->shake.count > 0)
            follow_still_steady(&t->still, &t->shake, decoder->pixels, t->gains, t->moved);
        status = follow_beads_next(follower, decoder->pixels, t->source.times[index], places, &doubt, error);
        if (status == FST_OK)
            status =
                follow_overlay_frame(&t->overlay, &t->still, decoder->pixels, index, &t->look, places, error);
        if (status == FST_OK && t->turning.grid)
            status = follow_turning_take(&t->turning, &t->still, decoder->pixels, follower->film.gains,
                                         &places[0], index, t->source.times[index], error);
        if (status != FST_OK)
            return status;
        count_places(t, index, places, doubt);
        ++t->frames;
        decoder->child.fraction = (double)t->frames / t->source.frames;
        status = fst_tell(progress, decoder->child.fraction, NULL, error);
        if (status != FST_OK)
            return status;
    }
}

static fst_status follow(tracking *t, const fst_progress *progress, fst_error *error)
{
    follow_decoder decoder;
    follow_beads follower;
    const size_t count = (size_t)t->source.frames;
    for (int bead = 0; bead < t->beads; ++bead) {
        t->columns[bead] = malloc(count * sizeof **t->columns);
        t->rows[bead] = malloc(count * sizeof **t->rows);
        t->doubts[bead] = malloc(count * sizeof **t->doubts);
        if (!t->columns[bead] || !t->rows[bead] || !t->doubts[bead])
            return fst_fail(error, FST_NO_MEMORY, t->path, "no memory for %d places", t->source.frames);
    }
    t->gains = malloc((size_t)t->still.height * sizeof *t->gains);
    if (!t->gains || (t->still.shake > 0.0 && !follow_shake_begin(&t->shake, t->still.level, t->still.width,
                                                                  t->still.height, t->still.margin)))
        return fst_fail(error, FST_NO_MEMORY, t->path, "no memory for the shake of the camera");
    t->sizes.middle[0] = 0.5 * t->still.width;
    t->sizes.middle[1] = 0.5 * t->still.height;
    fst_status status = follow_beads_begin(&follower, &t->blobs, &t->look, t->beads, error);
    if (status != FST_OK)
        return status;
    status = follow_decoder_start(&decoder, &t->source, NULL, 0, progress, error);
    if (status == FST_OK)
        status = follow_frames(t, &decoder, &follower, progress, error);
    const int well = follow_decoder_end(&decoder, status != FST_OK);
    follow_beads_end(&follower);
    if (status != FST_OK)
        return status;
    if (t->source.descriptor < 0 && t->frames < t->source.frames)
        return fst_fail(error, FST_BAD_INPUT, t->path, "%d of its %d images can be decoded: %.200s", t->frames,
                        t->source.frames, decoder.child.said);
    /* An mp4 that was cut without coding it anew still counts what its edit list hides; of one that is incomplete
     * ffmpeg complains. */
    const int counts_hidden = strncmp(t->source.format, "mov,", 4) == 0 && !decoder.child.said[0];
    const int announced =
        t->source.announced > t->source.frames && !counts_hidden ? t->source.announced : t->source.frames;
    if (!well || decoder.child.said[0] || t->frames < announced)
        (void)snprintf(t->report->remark, sizeof t->report->remark,
                       "%d of %d frames could be decoded; ffmpeg says: %.150s", t->frames, announced,
                       decoder.child.said[0] ? decoder.child.said : "nothing");
    return FST_OK;
}

/* ------------------------------------------------------------------ what is told of it */

/* The scatter of places about a smooth path, by fourth differences, from which a cubic is gone: their deviation
 * is sqrt(70) times that of a place.  The median forgives places where the path is not smooth. */
static double jitter_of(const tracking *t, double *room)
{
    int count = 0;
    for (int i = 4; i < t->frames; ++i) {
        for (int k = 0; k < 2 * t->beads; ++k) {
            const double *p = (k % 2 ? t->rows : t->columns)[k / 2] + i,
                         off = p[0] - 4.0 * p[-1] + 6.0 * p[-2] - 4.0 * p[-3] + p[-4];
            if (!isnan(off))
                room[count++] = fabs(off);
        }
    }
    if (count < 16)
        return NAN;
    /* The median, by halving the range. */
    double low = 0.0, high = 1e6;
    for (int repeat = 0; repeat < 60; ++repeat) {
        const double middle = 0.5 * (low + high);
        int below = 0;
        for (int i = 0; i < count; ++i)
            below += room[i] < middle;
        *(2 * below < count ? &low : &high) = middle;
    }
    return 1.4826 * low / sqrt(70.0);
}

static fst_status tell_times(tracking *t, fst_error *error)
{
    fst_film_track_report *r = t->report;
    const int steps = t->frames - 1;
    double *room = malloc((size_t)(2 * t->beads * t->frames + 1) * sizeof *room);
    if (!room)
        return fst_fail(error, FST_NO_MEMORY, t->path, "no memory for its times");
    for (int i = 0; i < steps; ++i)
        room[i] = t->source.times[i + 1] - t->source.times[i];
    if (steps > 0) {
        qsort(room, (size_t)steps, sizeof *room, fst_ascending);
        const double usual = room[steps / 2];
        r->least_step = room[0];
        r->most_step = room[steps - 1];
        r->fps = steps / (t->source.times[steps] - t->source.times[0]);
        for (int i = 0; i < steps; ++i)
            r->missing += room[i] > 1.5 * usual ? (int)fmin(1e6, floor(room[i] / usual + 0.5) - 1.0) : 0;
    }
    r->tick = t->source.tick;
    r->taken_fps = t->source.taken_fps;
    r->stored_fps = t->source.stored_fps;
    r->jitter = jitter_of(t, room);
    free(room);
    return FST_OK;
}

/* ------------------------------------------------------------------ the scale */

static void middle_of_path(const tracking *t, double middle[2], double *reach)
{
    double low[2] = {INFINITY, INFINITY}, high[2] = {-INFINITY, -INFINITY};
    for (int bead = 0; bead < t->beads; ++bead)
        for (int i = 0; i < t->frames; ++i) { /* fmin() and fmax() pass over NAN */
            low[0] = fmin(low[0], t->columns[bead][i]);
            low[1] = fmin(low[1], t->rows[bead][i]);
            high[0] = fmax(high[0], t->columns[bead][i]);
            high[1] = fmax(high[1], t->rows[bead][i]);
        }
    middle[0] = 0.5 * (low[0] + high[0]);
    middle[1] = 0.5 * (low[1] + high[1]);
    *reach = 0.0;
    for (int bead = 0; bead < t->beads; ++bead)
        for (int i = 0; i < t->frames; ++i)
            *reach = fmax(*reach, hypot(t->columns[bead][i] - middle[0], t->rows[bead][i] - middle[1]));
}

/* Apply all scales; the first makes the track. */
static fst_status make_plane(tracking *t, fst_error *error)
{
    fst_film_track_report *r = t->report;
    follow_view view = {.path = t->path,
                        .still = &t->still,
                        .look = &t->look,
                        .sizes = &t->sizes,
                        .distance = t->options->distance};
    fst_status status = FST_OK;
    middle_of_path(t, view.middle, &view.reach);
    t->plane = follow_plane_even(1.0, t->still.height - 1.0);
    for (int i = 0; i < t->scale_count && status == FST_OK; ++i) {
        follow_plane other;
        fst_film_scale *found = &r->scales[i];
        status = follow_scale_apply(&t->scales[i], &view, &t->rim, i ? &other : &t->plane, &found->value,
                                    &found->error, error);
        r->scale_count += status == FST_OK;
    }
    if (t->rim.taken >= 0) {
        const fst_plate_edge *edge = &t->rim.edges[t->rim.taken];
        memcpy(r->plate, edge->diameter, sizeof r->plate);
        memcpy(r->edges, t->rim.edges, sizeof r->edges);
        r->rim_error = edge->error;
        r->edge_count = t->rim.count;
        r->edge_taken = t->rim.taken;
    }
    if (r->scale_count > 0) {
        r->scale = r->scales[0].value;
        r->scale_error = r->scales[0].error;
    }
    /* Of scales that contradict each other nobody knows which one is right. */
    for (int i = 1; i < r->scale_count; ++i)
        if (fst_film_scales_differ(&r->scales[0], &r->scales[i]))
            r->scale_error = fmax(r->scale_error, fmin(fabs(r->scales[i].value / r->scale - 1.0), WORST_SCALE));
    return status;
}

/* ------------------------------------------------------------------ all of it */

static fst_status begin(tracking *t, fst_error *error)
{
    const fst_film_track_options *o = t->options;
    fst_film_track_report *r = t->report;
    fst_part parts[3] = {{o->progress, 0.0, 0.15, "times"},
                         {o->progress, 0.15, 0.35, "background"},
                         {o->progress, 0.35, 0.4, "bead"}};
    const fst_progress told[3] = {
        {&parts[0], fst_part_tell}, {&parts[1], fst_part_tell}, {&parts[2], fst_part_tell}};
    fst_status status = follow_source_open(&t->source, t->path, o->fps, &told[0], error);
    if (status != FST_OK)
        return status;
    (void)snprintf(r->format, sizeof r->format, "%s", t->source.format);
    (void)snprintf(r->codec, sizeof r->codec, "%s", t->source.codec);
    if (t->source.frames < FOLLOW_LEAST_FRAMES)
        return fst_fail(
            error, FST_BAD_INPUT, t->path,
            "it has %d frame%s: a bead is told from the plate by its motion, which takes %d frames or more",
            t->source.frames, t->source.frames == 1 ? "" : "s", FOLLOW_LEAST_FRAMES);
    status = follow_still_make(&t->still, &t->source, &told[1], error);
    if (status == FST_OK)
        status = follow_blobs_begin(&t->blobs, &t->still, error);
    for (int i = 0; i < t->scale_count && status == FST_OK; ++i)
        status = follow_scale_check(&t->scales[i], &t->still, error);
    if (status == FST_OK)
        status = follow_learn(&t->blobs, t->path, t->beads, &told[2], &t->look, error);
    if (status == FST_OK && !(t->look.diameter >= LEAST_DIAMETER))
        status =
            fst_fail(error, FST_BAD_INPUT, t->path,
                     "what moves is only %.1f pixels wide: film closer, so that the bead has 8 pixels or more",
                     t->look.diameter);
    follow_still_drop_samples(&t->still);
    r->width = t->still.width;
    r->height = t->still.height;
    r->diameter = t->look.diameter;
    r->diameter_error = t->look.diameter_error;
    r->shadow = t->look.shade / (t->look.shade + (1.0 - t->look.shade) * t->look.contrast);
    r->noise = t->still.noise;
    r->shake = t->still.shake;
    r->roll = FST_DEGREES * t->still.roll;
    r->contrast = t->look.levels;
    return status;
}

static fst_status make_track(const tracking *t, int bead, fst_track *track, fst_error *error)
{
    (void)snprintf(track->length_unit, sizeof track->length_unit, "%s", t->scale_count ? "mm" : "px");
    track->scale_error = t->scale_count ? t->report->scale_error : 0.0;
    track->fps = t->report->fps;
    track->steady = t->report->most_step - t->report->least_step < 1e-3 * t->report->least_step;
    for (int i = 0; i < t->frames; ++i) {
        double x = NAN, y = NAN;
        if (!isnan(t->columns[bead][i]))
            follow_plane_map(&t->plane, t->columns[bead][i], t->rows[bead][i], &x, &y);
        const fst_status status = fst_track_append(track, i, t->source.times[i], x, y, error);
        if (status != FST_OK)
            return status;
        track->doubts[i] = t->doubts[bead][i];
    }
    return FST_OK;
}

static fst_status finish_overlay(tracking *t, fst_error *error)
{
    return follow_overlay_finish(&t->overlay, &t->still, &t->look, t->columns, t->rows, t->frames,
                                 t->rim.taken < 0 ? NULL : &t->rim.ellipses[t->rim.taken], error);
}

/* In how many frames n and the slip are known, and how large the slip is. */
static void count_turning(const fst_track *track, double radius, fst_film_track_report *report)
{
    double slip = 0.0, speed = 0.0, beyond = 0.0;
    for (size_t i = 0; i < track->rows; ++i) {
        const fst_turning *t = &track->turning[i];
        const double size = hypot(t->slip[0], t->slip[1]);
        report->turned += isfinite(t->n[0]);
        if (!isfinite(size))
            continue;
        ++report->slips;
        slip += size;
        speed += hypot(t->slip[0] + radius * t->w[1], t->slip[1] - radius * t->w[0]); /* v = V + R W x e */
        beyond += size > 2.0 * t->slip_error;
    }
    if (report->slips > 0) {
        report->slip = slip / speed;
        report->slipping = beyond / report->slips;
    }
}

/* Why the turning, or n, is not known. */
static void remark_turning(const follow_turning *turning, fst_film_track_report *r)
{
    double axis[3];
    const size_t used = strlen(r->remark);
    const char *why = NULL;
    if (turning->few && r->slips == 0)
        why = "too few marks are in view to tell how the bead turns, unless its motion repeats itself, shows "
              "all its sides and has 15 frames or more a swing: paint half of the bead";
    else if (r->slips > 0 && r->turned == 0)
        why = follow_sphere_axis(&turning->sphere, axis)
                  ? "no frame tells n surely"
                  : "n is not known: the film does not show all sides of the bead";
    if (why)
        (void)snprintf(r->remark + used, sizeof r->remark - used, "%s%s", used ? "; " : "", why);
}

/* How the bead turns, by its marks. */
static fst_status find_turning(tracking *t, const fst_progress *progress, fst_track *track, fst_error *error)
{
    fst_film_track_report *r = t->report;
    const double radius = 500.0 * t->options->turning;
    fst_status status = follow_turning_place(&t->turning, &t->still, &t->plane, radius,
                                             1e3 * t->options->distance - radius, error);
    if (status == FST_OK)
        status = follow_turning_find(&t->turning, progress, &r->turned_share, error);
    if (status == FST_OK) /* the turning has told the centres better */
        status = follow_turning_place(&t->turning, &t->still, &t->plane, radius,
                                      1e3 * t->options->distance - radius, error);
    if (status == FST_OK)
        status = fst_track_add_turning(track, error);
    if (status == FST_OK && r->turned_share > 0.0)
        status = follow_spin(&t->turning, track, error);
    if (status == FST_OK)
        count_turning(track, radius, r);
    if (status == FST_OK &&
        r->slips < 0.95 * (t->turning.count - 4)) { /* rotations that do not follow from each other */
        r->turned = r->slips = 0;
        r->turned_share = 0.0;
        r->slip = r->slipping = NAN;
        track->rhythm = 0;
        status = fst_track_add_turning(track, error);
    }
    if (status == FST_OK)
        remark_turning(&t->turning, r);
    return status;
}

/* Where no scale was found, or a bead in no frame, the picture and the overlay show why: they are written all the same. */
static void show_what_was_found(tracking *t)
{
    if (finish_overlay(t, NULL) == FST_OK)
        (void)follow_overlay_commit(&t->overlay, NULL);
}

/* Of a film that is refused before its frames are followed the picture shows what there was to be seen. */
static void show_what_stands_still(tracking *t)
{
    if (t->still.level && t->options->picture &&
        follow_overlay_begin(&t->overlay, &t->still, &t->look, 1.0, 1, t->beads, NULL, t->options->picture,
                             NULL) == FST_OK)
        show_what_was_found(t);
}

static fst_status perform(tracking *t, fst_track *track, fst_error *error)
{
    const fst_film_track_options *o = t->options;
    const int turns = !isnan(o->turning);
    fst_part parts[2] = {{o->progress, 0.4, turns ? 0.6 : 1.0, "frames"}, {o->progress, 0.6, 1.0, "turning"}};
    const fst_progress told = {&parts[0], fst_part_tell}, turning_told = {&parts[1], fst_part_tell};
    fst_status status = begin(t, error);
    if (status == FST_BAD_INPUT) {
        show_what_stands_still(t);
        return status;
    }
    if (status == FST_OK && turns)
        status = follow_turning_begin(&t->turning, t->look.diameter, error);
    if (status != FST_OK)
        return status;
    const double fps = (t->source.frames - 1) / (t->source.times[t->source.frames - 1] - t->source.times[0]);
    status = follow_overlay_begin(&t->overlay, &t->still, &t->look, fps, t->source.frames, t->beads, o->overlay,
                                  o->picture, error);
    if (status != FST_OK)
        return status;
    status = follow(t, &told, error);
    t->report->frames = t->frames;
    if (status == FST_OK && t->report->lost == t->frames)
        status = fst_fail(error, FST_BAD_INPUT, t->path, "%s in none of its %d frames",
                          t->beads == 1 ? "the bead was found" : "all beads were found apart from each other",
                          t->frames);
    else if (status == FST_OK)
        status = make_plane(t, error);
    if (status == FST_BAD_INPUT)
        show_what_was_found(t);
    if (status != FST_OK)
        return status;
    status = tell_times(t, error);
    for (int bead = 0; bead < t->beads && status == FST_OK; ++bead)
        status = make_track(t, bead, &track[bead], error);
    if (status == FST_OK)
        status = turns ? find_turning(t, &turning_told, track, error) : FST_OK;
    if (status == FST_OK)
        status = finish_overlay(t, error);
    if (status == FST_OK && o->csv)
        status = fst_tracks_write(o->csv, track, t->beads, error);
    return status == FST_OK ? follow_overlay_commit(&t->overlay, error) : status;
}

/* Whether a file can be written there: better told before the work than after it. */
static fst_status check_place(const char *path, fst_error *error)
{
    fst_whole_file file;
    const fst_status status = fst_whole_file_open(&file, path, error);
    if (status == FST_OK)
        fst_whole_file_discard(&file);
    return status;
}

/* How much of a turning the slip takes needs lengths, and from where the camera sees the bead. */
static fst_status check_turning(const fst_film_track_options *o, fst_error *error)
{
    static const char where[] = "fst_film_track_options.turning";
    if (isnan(o->turning))
        return FST_OK;
    if (!(o->turning > 0.0 && o->turning < 1.0))
        return fst_fail(error, FST_BAD_INPUT, where,
                        "a bead of %g m: its diameter, more than 0 and less than 1 m", o->turning);
    if (!o->scale || isnan(o->distance))
        return fst_fail(
            error, FST_BAD_INPUT, where,
            "the turning of a bead needs a scale and the distance of the camera: from where a mark is seen "
            "follows from them");
    if (o->beads > 1)
        return fst_fail(error, FST_BAD_INPUT, where, "the turning is that of one bead, and %d are followed",
                        o->beads);
    return FST_OK;
}

fst_status fst_film_track(const char *film, const fst_film_track_options *options, fst_track *track,
                          fst_film_track_report *report, fst_error *error)
{
    const fst_film_track_options defaults = fst_default_film_track_options();
    fst_film_track_report unwanted;
    tracking t = {.path = film,
                  .options = options ? options : &defaults,
                  .report = report ? report : &unwanted,
                  .source = {.descriptor = -1},
                  .rim = {.taken = -1}};
    t.beads = t.options->beads;
    *t.report = (fst_film_track_report){.first_lost = -1,
                                        .beads = t.beads,
                                        .fps = NAN,
                                        .jitter = NAN,
                                        .scale = NAN,
                                        .scale_error = NAN,
                                        .slip = NAN,
                                        .slipping = NAN,
                                        .turned_share = NAN,
                                        .plate = {NAN, NAN},
                                        .rim_error = NAN,
                                        .edge_taken = -1};
    *track = (fst_track){.rows = 0};
    if (t.options->cookie != OPTIONS_COOKIE)
        return fst_fail(error, FST_BAD_INPUT, "fst_film_track",
                        "the options were not made by fst_default_film_track_options()");
    if (t.beads < 1 || t.beads > FST_TRACKED_BEADS)
        return fst_fail(error, FST_BAD_INPUT, "fst_film_track_options.beads",
                        "%d beads to be followed: 1 to %d", t.beads, FST_TRACKED_BEADS);
    for (int bead = 0; bead < t.beads; ++bead)
        track[bead] = (fst_track){.rows = 0};
    if (!isnan(t.options->distance) && !(t.options->distance > 0.0 && t.options->distance <= 1e3))
        return fst_fail(error, FST_BAD_INPUT, "fst_film_track_options.distance",
                        "%g m from the camera to the plate: more than 0, at most 1 km", t.options->distance);
    const fst_status wanted = check_turning(t.options, error);
    if (wanted != FST_OK)
        return wanted;
    const fst_c_locale locale = fst_c_locale_enter();
    fst_status status = t.options->scale ? follow_scales_read(t.options->scale, t.scales, t.report->scales,
                                                              &t.scale_count, error)
                                         : FST_OK;
    if (status == FST_OK && t.options->csv)
        status = check_place(t.options->csv, error);
    if (status == FST_OK)
        status = perform(&t, track, error);
    follow_turning_end(&t.turning);
    for (int bead = 0; bead < t.beads; ++bead) {
        if (status != FST_OK)
            fst_track_free(&track[bead]);
        free(t.columns[bead]);
        free(t.rows[bead]);
        free(t.doubts[bead]);
    }
    follow_overlay_free(&t.overlay);
    follow_blobs_end(&t.blobs);
    follow_still_free(&t.still);
    follow_source_close(&t.source);
    follow_shake_end(&t.shake);
    free(t.gains);
    fst_c_locale_leave(locale);
    return status;
}
