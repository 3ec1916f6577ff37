/* choose.c - from the places of a file to one track: which of several, in which order, in which unit, by which
 * clock.
 */
#include "tracks/raw.h"

#include <stdlib.h>
#include <string.h>

#include "base/error.h"
#include "base/order.h"
#include "base/text.h"

typedef struct choice {
    const track_raw *raw;
    const char *path;
    const fst_track_options *options;
    int track; /* index of the chosen name */
    size_t seen;
    double scale;       /* from the file's unit of length to the track's */
    int scale_replaces; /* the caller's scale contradicts a unit that the file states */
    double step;  /* frames of the film from row to row: some people follow a bead in every second frame */
    int by_frame; /* rows are told apart by their frames, not by their times */
} choice;

/* ---------------------------------------------------------------- which track */

/* The numbers of places seen, track by track; NULL: no memory. */
static size_t *seen_by_track(const track_raw *raw)
{
    size_t *seen = calloc((size_t)raw->name_count + 1, sizeof *seen);
    for (size_t i = 0; seen && i < raw->count; ++i)
        seen[raw->spots[i].track] += isfinite(raw->spots[i].x) && isfinite(raw->spots[i].y);
    return seen;
}

static fst_status no_such_track(const choice *c, fst_error *error)
{
    char names[2048] = "", suggestion[FST_SUGGESTION_SIZE], quoted[FST_QUOTE_SIZE];
    for (int i = 0; i < c->raw->name_count && strlen(names) + TRACK_NAME_SIZE + 1 < sizeof names; ++i) {
        const size_t used = strlen(names);
        (void)snprintf(names + used, sizeof names - used, "%s%s", used ? "|" : "", c->raw->names[i]);
    }
    return fst_fail(error, FST_BAD_INPUT, c->path, "there is no track called %s among %d; %s",
                    fst_quote(c->options->name, quoted), c->raw->name_count,
                    fst_suggest_name(c->options->name, names, suggestion));
}

static fst_status choose_track(choice *c, fst_error *error)
{
    size_t *seen = seen_by_track(c->raw);
    if (!seen)
        return fst_fail(error, FST_NO_MEMORY, c->path, "no memory for %d tracks", c->raw->name_count);
    const int which = c->track;
    for (int i = 0; i < c->raw->name_count; ++i) {
        const int wanted =
            which >= 0 ? i == which : !c->options->name || strcmp(c->options->name, c->raw->names[i]) == 0;
        if (wanted && (c->track < 0 || which >= 0 || seen[i] > seen[c->track]))
            c->track = i;
    }
    c->seen = c->track < 0 ? 0 : seen[c->track];
    free(seen);
    if (c->track < 0 && c->options->name && c->raw->name_count > 0)
        return no_such_track(c, error);
    if (c->track < 0 || c->seen == 0)
        return fst_fail(error, FST_BAD_INPUT, c->path, "there is no place of a bead in this file (read as %s)",
                        c->raw->format);
    return FST_OK;
}

/* ---------------------------------------------------------------- in which unit */

static fst_status choose_unit(choice *c, fst_track *track, fst_error *error)
{
    const char *says = c->raw->length_unit;
    const double metres = track_length_unit(says);
    c->scale = 1.0;
    track->rhythm = c->raw->rhythm;
    track->scale_error = isfinite(c->options->scale) ? c->options->scale_error : c->raw->scale_error;
    if (isfinite(c->options->scale)) {
        const char *unit = c->options->scale_unit ? c->options->scale_unit : "mm";
        const double of_unit = track_is_pixel(unit) ? 1.0 : track_length_unit(unit);
        if (!(c->options->scale > 0.0) || of_unit == 0.0)
            return fst_fail(error, FST_BAD_INPUT, "fst_track_options.scale",
                            "the length of one unit of the file must be positive, in px %s",
                            fst_unit_accepted(FST_UNIT_LENGTH));
        c->scale = c->options->scale / of_unit;
        c->scale_replaces = metres > 0.0 && fabs(c->options->scale / metres - 1.0) > 1e-9;
        (void)snprintf(track->length_unit, sizeof track->length_unit, "%.7s", unit);
        return FST_OK;
    }
    if (track_is_pixel(says)) {
        (void)snprintf(track->length_unit, sizeof track->length_unit, "px");
        return FST_OK;
    }
    if (metres == 0.0)
        return fst_fail(
            error, FST_BAD_INPUT, c->path,
            "read as %s; it does not say in which unit x and y are%s%s%s. Say what one unit of the file is by "
            "fst_track_options.scale, as in 1cm, or 1px for pixels",
            c->raw->format, says[0] ? " (\"" : "", says, says[0] ? "\" is not a known unit)" : "");
    /* The customary spelling; a unit that is not a customary one becomes the metre's. */
    for (const char *unit = fst_unit_accepted(FST_UNIT_LENGTH); *unit; unit += strspn(unit, " ")) {
        const size_t length = strcspn(unit, " ");
        char name[FST_LENGTH_UNIT_SIZE];
        (void)snprintf(name, sizeof name, "%.*s", (int)length, unit);
        if (track_length_unit(name) == metres)
            memcpy(track->length_unit, name, sizeof name);
        unit += length;
    }
    return FST_OK;
}

/* ---------------------------------------------------------------- in which order */

/* Spots in the order of their frames, or of their times where the file has no frames. */
static int by_frame(const void *a, const void *b)
{
    const track_spot *one = a, *other = b;
    const double p = isnan(one->frame) ? one->t : one->frame, q = isnan(other->frame) ? other->t : other->frame;
    if (p != q)
        return p < q ? -1 : 1;
    return one->line < other->line ? -1 : one->line > other->line;
}

/* The greatest number of which all steps from frame to frame are multiples. */
static double common_step(const track_spot *spots, size_t count)
{
    double step = 0.0;
    for (size_t i = 1; i < count && step != 1.0; ++i)
        for (double other = spots[i].frame - spots[i - 1].frame; other > 0;) {
            const double rest = fmod(step, other);
            step = other;
            other = rest;
        }
    return step > 0 ? step : 1.0;
}

/* The spots of the chosen track in their order; a frame may hold one place only.  The same place twice is one.
 */
static fst_status sorted_spots(choice *c, track_spot **spots, size_t *count, fst_error *error)
{
    *count = 0;
    *spots = malloc((c->raw->count + 1) * sizeof **spots);
    if (!*spots)
        return fst_fail(error, FST_NO_MEMORY, c->path, "no memory for %zu places", c->raw->count);
    c->by_frame = 1;
    for (size_t i = 0; i < c->raw->count; ++i)
        if (c->raw->spots[i].track == c->track) {
            (*spots)[(*count)++] = c->raw->spots[i];
            c->by_frame = c->by_frame && isfinite(c->raw->spots[i].frame);
        }
    for (size_t i = 0; i < *count && c->by_frame; ++i)
        if (!(fabs((*spots)[i].frame) < 1e15) || (*spots)[i].frame != floor((*spots)[i].frame))
            return fst_fail(error, FST_BAD_INPUT, c->path,
                            "track \"%s\" has a frame %g: a whole number was expected", c->raw->names[c->track],
                            (*spots)[i].frame);
    qsort(*spots, *count, sizeof **spots, by_frame);
    size_t kept = 0;
    for (size_t i = 0; i < *count; ++i) {
        track_spot *here = &(*spots)[i], *last = kept > 0 ? &(*spots)[kept - 1] : NULL;
        const int same = last && (c->by_frame ? here->frame == last->frame : here->t == last->t);
        if (!same) {
            (*spots)[kept++] = *here;
        } else if (isnan(last->x)) {
            *last = *here;
        } else if (isfinite(here->x) && (here->x != last->x || here->y != last->y)) {
            const double at = c->by_frame ? here->frame : here->t;
            return here->line
                       ? fst_text_fail(c->path, here->line, error,
                                       "track \"%s\" has a second place at %s %g: were two beads followed "
                                       "as one?",
                                       c->raw->names[c->track], c->by_frame ? "frame" : "time", at)
                       : fst_fail(error, FST_BAD_INPUT, c->path,
                                  "track \"%s\" has two places at %s %g: were two beads followed as one?",
                                  c->raw->names[c->track], c->by_frame ? "frame" : "time", at);
        }
    }
    *count = kept;
    c->step = c->by_frame && kept > 8 ? common_step(*spots, kept) : 1.0;
    for (size_t i = kept; i-- > 0 && c->step > 1.0;)
        (*spots)[i].frame = (*spots)[0].frame + ((*spots)[i].frame - (*spots)[0].frame) / c->step;
    return FST_OK;
}

/* ---------------------------------------------------------------- by which clock */

/* Number the frames by their times: whole multiples of the median of the steps, at least one. */
static fst_status number_frames(track_spot *spots, size_t count, const char *path, fst_error *error)
{
    double *steps = malloc((count + 1) * sizeof *steps);
    size_t found = 0;
    if (!steps)
        return fst_fail(error, FST_NO_MEMORY, path, "no memory for the times of %zu frames", count);
    for (size_t i = 1; i < count; ++i) {
        const double step = spots[i].t - spots[i - 1].t;
        if (isfinite(step) && step > 0)
            steps[found++] = step;
    }
    const double interval = found > 0 ? fst_median(steps, found) : NAN; /* NAN: no two rows have a time */
    free(steps);
    spots[0].frame = 0.0;
    for (size_t i = 1; i < count; ++i) {
        const double step = (spots[i].t - spots[i - 1].t) / interval;
        spots[i].frame = spots[i - 1].frame + fmax(1.0, step < 1e9 ? round(step) : 1e9);
    }
    return FST_OK;
}

/* The straight line t = t0 + frame/fps through the rows, and how far the farthest row is from it, in frames. */
static double clock_of(const track_spot *spots, size_t count, double *unevenness)
{
    double n = 0, sum_f = 0, sum_t = 0, ff = 0, ft = 0;
    *unevenness = 0.0;
    for (size_t i = 0; i < count; ++i)
        if (isfinite(spots[i].t)) {
            n += 1.0;
            sum_f += spots[i].frame;
            sum_t += spots[i].t;
        }
    const double mean_f = sum_f / n, mean_t = sum_t / n;
    for (size_t i = 0; i < count; ++i)
        if (isfinite(spots[i].t)) {
            ff += (spots[i].frame - mean_f) * (spots[i].frame - mean_f);
            ft += (spots[i].frame - mean_f) * (spots[i].t - mean_t);
        }
    if (!(ff > 0) || !(ft > 0))
        return NAN;
    const double interval = ft / ff;
    for (size_t i = 0; i < count; ++i)
        if (isfinite(spots[i].t))
            *unevenness = fmax(*unevenness, fabs((spots[i].t - mean_t) / interval - (spots[i].frame - mean_f)));
    return 1.0 / interval;
}

/* Give every spot a frame number and a time in seconds, and the track its frame rate. */
static fst_status set_clock(const choice *c, track_spot *spots, size_t count, fst_track *track,
                            fst_error *error)
{
    int timed = 1;
    for (size_t i = 0; i < count; ++i) {
        spots[i].t *= c->raw->time_unit;
        timed = timed && isfinite(spots[i].t);
    }
    for (size_t i = 1; i < count && timed; ++i)
        if (!(spots[i].t > spots[i - 1].t))
            return fst_text_fail(c->path, spots[i].line, error,
                                 "the time %.9g s does not come after %.9g s, that of the frame before",
                                 spots[i].t, spots[i - 1].t);
    if (!c->by_frame && number_frames(spots, count, c->path, error) != FST_OK)
        return FST_NO_MEMORY;
    double unevenness = 0.0;
    track->fps = timed && count > 1 ? clock_of(spots, count, &unevenness) : 1.0 / (c->raw->interval * c->step);
    track->steady = unevenness < 0.1;
    if (unevenness >= 0.1) /* the line is that of even frames */
        track->fps = (spots[count - 1].frame - spots[0].frame) / (spots[count - 1].t - spots[0].t);
    if (isfinite(c->options->fps)) {
        if (!(c->options->fps > 0))
            return fst_fail(error, FST_BAD_INPUT, "fst_track_options.fps",
                            "%g frames a second: a positive number is "
                            "needed",
                            c->options->fps);
        track->fps = c->options->fps / c->step;
        track->steady = 1;
    }
    if (isfinite(c->options->fps) || !timed)
        for (size_t i = 0; i < count; ++i)
            spots[i].t = (spots[i].frame - spots[0].frame) / track->fps;
    return FST_OK;
}

/* ---------------------------------------------------------------- the whole */

static char *tell(const choice *c, const fst_track *track, int of_all)
{
    fst_printed printed;
    FILE *out = fst_print_begin(&printed);
    if (!out)
        return NULL;
    char name[TRACK_NAME_SIZE];
    (void)snprintf(name, sizeof name, "%s", c->raw->names[c->track]);
    fst_text_tame(name);
    (void)fprintf(out, "%s: ", c->raw->format);
    if (of_all)
        (void)fprintf(out, "%d beads; track \"%s\": ", c->raw->name_count, name);
    else if (c->raw->name_count > 1)
        (void)fprintf(out, "track \"%s\", %s of %d; ", name, c->options->name ? "chosen" : "the longest",
                      c->raw->name_count);
    (void)fprintf(out, "%zu places in frames %lld to %lld, ", c->seen, (long long)track->frame[0],
                  (long long)track->frame[track->rows - 1]);
    if (c->step > 1.0)
        (void)fprintf(out, "every %g frames, ", c->step);
    if (isfinite(track->fps))
        (void)fprintf(out, "%.6g frames a second%s%s", track->fps, track->steady ? "" : " on average, unevenly",
                      isfinite(c->options->fps) ? " as given" : "");
    else
        (void)fputs("no clock", out);
    (void)fprintf(out, ", lengths in %s%s", track->length_unit,
                  c->scale_replaces ? " by the scale given, which replaces that of the file" : "");
    if (track->scale_error > 0.0)
        (void)fprintf(out, ", all wrong by the same %.2g %% or so", 100.0 * track->scale_error);
    (void)fprintf(out, ", y %s%s%s", c->raw->y_down ? "down in the file (turned round)" : "up",
                  c->raw->remark[0] ? "; " : "", c->raw->remark);
    return fst_print_end(&printed);
}

/* How the bead turns in the last row; lengths are in the track's unit.  Only tables whose y points up have it. */
static fst_status take_turning(const choice *c, const track_spot *spot, fst_track *track, fst_error *error)
{
    if (spot->turning == 0)
        return FST_OK;
    if (!track->turning && fst_track_add_turning(track, error) != FST_OK)
        return FST_NO_MEMORY;
    fst_turning *turning = &track->turning[track->rows - 1];
    *turning = c->raw->turnings[spot->turning - 1];
    turning->slip[0] *= c->scale;
    turning->slip[1] *= c->scale;
    turning->slip_error *= c->scale;
    return FST_OK;
}

/* The frames that are asked for, into the track. */
static fst_status take_frames(const choice *c, const track_spot *spots, size_t count, fst_track *track,
                              fst_error *error)
{
    const double from = c->options->from, to = c->options->to;
    fst_status status = FST_OK;
    for (size_t i = 0; i < count && status == FST_OK; ++i) {
        if (spots[i].frame < from || spots[i].frame > to)
            continue;
        status = fst_track_append(track, (int64_t)spots[i].frame, spots[i].t, spots[i].x * c->scale,
                                  spots[i].y * (c->raw->y_down ? -c->scale : c->scale), error);
        if (status != FST_OK)
            break;
        track->doubts[track->rows - 1] = spots[i].doubts;
        status = take_turning(c, &spots[i], track, error);
    }
    if (status == FST_OK && track->rows < 2)
        status = fst_fail(error, FST_BAD_INPUT, from >= 0 ? "fst_track_options.from" : "fst_track_options.to",
                          "%.200s has frames %.0f to %.0f: of those asked for it has %s", c->path,
                          spots[0].frame, spots[count - 1].frame, track->rows ? "one" : "none");
    return status;
}

fst_status track_choose(const track_raw *raw, const char *path, const fst_track_options *options, int which,
                        fst_track *track, char **understood, fst_error *error)
{
    choice c = {.raw = raw, .path = path, .options = options, .track = which};
    track_spot *spots = NULL;
    size_t count = 0;
    *track = (fst_track){0};
    fst_status status = choose_track(&c, error);
    if (status == FST_OK)
        status = choose_unit(&c, track, error);
    if (status == FST_OK)
        status = sorted_spots(&c, &spots, &count, error);
    if (status == FST_OK && count < 2)
        status = fst_fail(error, FST_BAD_INPUT, path, "a track of one frame: nothing can be measured of it");
    if (status == FST_OK)
        status = set_clock(&c, spots, count, track, error);
    if (status == FST_OK)
        status = take_frames(&c, spots, count, track, error);
    free(spots);
    if (status == FST_OK && understood && !(*understood = tell(&c, track, which >= 0)))
        status = fst_fail(error, FST_NO_MEMORY, path, "no memory for what was understood of this track");
    if (status != FST_OK)
        fst_track_free(track);
    return status;
}
