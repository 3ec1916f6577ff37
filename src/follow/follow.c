/* follow.c - fst_film_track(): from a film to a track.
 *
 *   film --> source.c  --> times of its frames
 *        --> still.c   --> what stays still, of 41 frames at random times
 *                          --> learn.c   what the bead looks like
 *        --> decoder.c --> bead.c        where it is, frame by frame --> overlay.c
 *                          beads.c       the same of several
 *                          --> plane.c, rim.c, plate.c   millimetres --> fst_track
 *
 * The film is decoded three times, because memory must not grow with it: once for the times, once for the
 * samples, once to follow the bead.
 */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/error.h"
#include "base/number.h"
#include "base/order.h"
#include "base/watch.h"
#include "follow/beads.h"
#include "follow/decoder.h"
#include "follow/learn.h"
#include "follow/overlay.h"
#include "follow/plate.h"
#include "follow/rim.h"

#include <festoon/festoon_tools.h>

enum { OPTIONS_COOKIE = 0x54524b46 };

#define LEAST_DIAMETER 3.0 /* pixels */

fst_film_track_options fst_default_film_track_options(void)
{
    return (fst_film_track_options){.cookie = OPTIONS_COOKIE, .fps = NAN, .distance = NAN, .beads = 1};
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
    follow_scale scale;
    follow_plane plane;
    follow_ellipse rim;
    int has_rim;
    follow_sizes sizes;
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
        status = follow_beads_next(follower, decoder->pixels, t->source.times[index], places, &doubt, error);
        if (status == FST_OK)
            status =
                follow_overlay_frame(&t->overlay, &t->still, decoder->pixels, index, &t->look, places, error);
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
    const int announced = t->source.announced > t->source.frames ? t->source.announced : t->source.frames;
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

static fst_status plane_of_plate(tracking *t, const double middle[2], double reach, fst_error *error)
{
    double horizon[2];
    follow_rim found;
    fst_status status =
        follow_rim_find(&t->still, t->path, middle, reach + 0.5 * t->look.diameter, &found, error);
    if (status != FST_OK)
        return status;
    t->has_rim = 1;
    t->rim = found.ellipses[found.taken];
    const fst_plate_edge *edge = &found.edges[found.taken];
    t->report->plate[0] = edge->diameter[0];
    t->report->plate[1] = edge->diameter[1];
    t->report->rim_error = edge->error;
    memcpy(t->report->edges, found.edges, sizeof found.edges);
    t->report->edge_count = found.count;
    t->report->edge_taken = found.taken;
    follow_plate_horizon(&t->sizes, &t->rim, t->still.width, t->still.height, horizon);
    return follow_plane_of_circle(&t->rim, horizon, 0.5 * t->scale.length[0], &t->plane, error);
}

/* A bead whose centre is above the plate is seen larger, and farther from the camera's axis, than the plate
 * under it. */
static fst_status lower_bead(tracking *t, const double middle[2], fst_error *error)
{
    const double distance = 1e3 * t->options->distance;
    const double height = 0.5 * t->look.diameter * follow_plane_step(&t->plane, middle[0], middle[1]);
    if (isnan(distance) || t->scale.kind == FOLLOW_SCALE_BEAD)
        return FST_OK;
    if (!(distance > 4.0 * height && distance < 1e6))
        return fst_fail(error, FST_BAD_INPUT, "fst_film_track_options.distance",
                        "%g mm from the camera to the plate, where the bead's centre is %.2g mm above it",
                        distance, height);
    double x, y;
    follow_plane_map(&t->plane, middle[0], middle[1], &x, &y);
    const double factor = 1.0 - height / distance;
    for (int j = 0; j < 3; ++j) { /* shrink about the middle of the path */
        t->plane.m[0][j] = factor * t->plane.m[0][j] + (1.0 - factor) * x * t->plane.m[2][j];
        t->plane.m[1][j] = factor * t->plane.m[1][j] + (1.0 - factor) * y * t->plane.m[2][j];
    }
    return FST_OK;
}

static fst_status check_points(const tracking *t, fst_error *error)
{
    const int count = t->scale.kind == FOLLOW_SCALE_TWO ? 2 : t->scale.kind == FOLLOW_SCALE_FOUR ? 4 : 0;
    for (int i = 0; i < count; ++i) {
        const double *p = t->scale.points[i];
        if (!(p[0] >= -1.0 && p[1] >= -1.0 && p[0] <= t->still.width && p[1] <= t->still.height))
            return fst_fail(error, FST_BAD_INPUT, "fst_film_track_options.scale",
                            "the point %g,%g is outside of the picture, which has %d x %d pixels", p[0], p[1],
                            t->still.width, t->still.height);
    }
    return FST_OK;
}

static fst_status make_plane(tracking *t, fst_error *error)
{
    const double bottom = t->still.height - 1.0;
    double middle[2], reach;
    fst_status status = FST_OK;
    middle_of_path(t, middle, &reach);
    switch (t->scale.kind) {
    case FOLLOW_SCALE_NONE:
        t->plane = follow_plane_even(1.0, bottom);
        return FST_OK;
    case FOLLOW_SCALE_BEAD:
        t->plane = follow_plane_even(t->scale.length[0] / t->look.diameter, bottom);
        break;
    case FOLLOW_SCALE_TWO:
        t->plane = follow_plane_even(t->scale.length[0] / hypot(t->scale.points[1][0] - t->scale.points[0][0],
                                                                t->scale.points[1][1] - t->scale.points[0][1]),
                                     bottom);
        break;
    case FOLLOW_SCALE_FOUR:
        status = follow_plane_of_rectangle(&t->scale, &t->plane, error);
        break;
    case FOLLOW_SCALE_PLATE:
        status = plane_of_plate(t, middle, reach, error);
        break;
    }
    if (status == FST_OK)
        status = lower_bead(t, middle, error);
    if (status == FST_OK)
        t->report->scale = follow_plane_step(&t->plane, middle[0], middle[1]);
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
    if (status == FST_OK)
        status = check_points(t, error);
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
    r->noise = t->still.noise;
    r->contrast = t->look.threshold; /* until the background behind it is known */
    return status;
}

static fst_status make_track(const tracking *t, int bead, fst_track *track, fst_error *error)
{
    (void)snprintf(track->length_unit, sizeof track->length_unit, "%s",
                   t->scale.kind == FOLLOW_SCALE_NONE ? "px" : "mm");
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
                                 t->has_rim ? &t->rim : NULL, error);
}

/* Where no scale was found, the picture and the overlay show why: they are written all the same. */
static void show_what_was_found(tracking *t)
{
    if (finish_overlay(t, NULL) == FST_OK)
        (void)follow_overlay_commit(&t->overlay, NULL);
}

static fst_status perform(tracking *t, fst_track *track, fst_error *error)
{
    const fst_film_track_options *o = t->options;
    fst_part part = {o->progress, 0.4, 1.0, "frames"};
    const fst_progress told = {&part, fst_part_tell};
    fst_status status = begin(t, error);
    if (status != FST_OK)
        return status;
    const double fps = (t->source.frames - 1) / (t->source.times[t->source.frames - 1] - t->source.times[0]);
    status = follow_overlay_begin(&t->overlay, &t->still, &t->look, fps, t->source.frames, t->beads, o->overlay,
                                  o->picture, error);
    if (status == FST_OK)
        status = follow(t, &told, error);
    t->report->frames = t->frames;
    if (status == FST_OK && t->report->lost == t->frames)
        status = fst_fail(error, FST_BAD_INPUT, t->path, "%s in none of its %d frames",
                          t->beads == 1 ? "the bead was found" : "all beads were found apart from each other",
                          t->frames);
    if (status != FST_OK)
        return status;
    status = make_plane(t, error);
    if (status != FST_OK) {
        show_what_was_found(t);
        return status;
    }
    status = tell_times(t, error);
    for (int bead = 0; bead < t->beads && status == FST_OK; ++bead)
        status = make_track(t, bead, &track[bead], error);
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

fst_status fst_film_track(const char *film, const fst_film_track_options *options, fst_track *track,
                          fst_film_track_report *report, fst_error *error)
{
    const fst_film_track_options defaults = fst_default_film_track_options();
    fst_film_track_report unwanted;
    tracking t = {.path = film,
                  .options = options ? options : &defaults,
                  .report = report ? report : &unwanted,
                  .source = {.descriptor = -1}};
    t.beads = t.options->beads;
    *t.report = (fst_film_track_report){.first_lost = -1,
                                        .beads = t.beads,
                                        .fps = NAN,
                                        .jitter = NAN,
                                        .scale = NAN,
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
    const fst_c_locale locale = fst_c_locale_enter();
    fst_status status = t.options->scale ? follow_scale_read(t.options->scale, &t.scale, error) : FST_OK;
    if (status == FST_OK && t.options->csv)
        status = check_place(t.options->csv, error);
    if (status == FST_OK)
        status = perform(&t, track, error);
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
    fst_c_locale_leave(locale);
    return status;
}
