/* track.c - the memory of a track, and writing it as festoon's own CSV. */
#include <festoon/festoon_tools.h>

#include <stdlib.h>

#include "base/error.h"
#include "base/grow.h"
#include "base/number.h"
#include "host/whole_file.h"
#include "tracks/raw.h"

void fst_track_free(fst_track *track)
{
    free(track->frame);
    free(track->t);
    free(track->x);
    free(track->y);
    free(track->flag);
    free(track->doubts);
    free(track->turning);
    *track = (fst_track){0};
}

/* Forget the turning in the rows from one on. */
static void forget_turning(fst_track *track, size_t from)
{
    for (size_t i = from; i < track->capacity; ++i)
        track->turning[i] = (fst_turning){{NAN, NAN, NAN}, NAN, {NAN, NAN, NAN}, NAN, {NAN, NAN}, NAN};
}

fst_status fst_track_add_turning(fst_track *track, fst_error *error)
{
    if (!track->turning)
        track->turning = malloc((track->capacity + 1) * sizeof *track->turning);
    if (!track->turning)
        return fst_fail(error, FST_NO_MEMORY, "", "no memory for the turning in %zu frames", track->rows);
    forget_turning(track, 0);
    return FST_OK;
}

fst_status fst_track_append(fst_track *track, int64_t frame, double t, double x, double y, fst_error *error)
{
    if (track->rows == track->capacity) {
        const size_t capacity = track->capacity ? 2 * track->capacity : 256;
        if (!fst_resize(&track->frame, capacity, sizeof *track->frame) ||
            !fst_resize(&track->t, capacity, sizeof *track->t) ||
            !fst_resize(&track->x, capacity, sizeof *track->x) ||
            !fst_resize(&track->y, capacity, sizeof *track->y) || !fst_resize(&track->flag, capacity, 1) ||
            !fst_resize(&track->doubts, capacity, sizeof *track->doubts) ||
            (track->turning && !fst_resize(&track->turning, capacity, sizeof *track->turning)))
            return fst_fail(error, FST_NO_MEMORY, "", "no memory for a track of %zu frames", capacity);
        track->capacity = capacity;
        if (track->turning)
            forget_turning(track, track->rows);
    }
    const int seen = isfinite(x) && isfinite(y);
    const size_t i = track->rows++;
    track->frame[i] = frame;
    track->t[i] = t;
    track->x[i] = seen ? x : NAN;
    track->y[i] = seen ? y : NAN;
    track->flag[i] = seen ? FST_FRAME_SEEN : FST_FRAME_LOST;
    track->doubts[i] = 0;
    return FST_OK;
}

/* Write a number and what follows it; nothing where it is NAN. */
static void put(FILE *out, double value, char end)
{
    char text[64];
    if (isfinite(value)) {
        (void)fst_number_write(text, sizeof text, value);
        (void)fputs(text, out);
    }
    (void)fputc(end, out);
}

static void put_turning(FILE *out, const fst_turning *t)
{
    const double values[] = {t->n[0], t->n[1],    t->n[2],    t->n_error, t->w[0],      t->w[1],
                             t->w[2], t->w_error, t->slip[0], t->slip[1], t->slip_error};
    const int count = (int)(sizeof values / sizeof *values);
    for (int i = 0; i < count; ++i)
        put(out, values[i], i + 1 < count ? ',' : '\n');
}

fst_status fst_track_write(const char *path, const fst_track *track, fst_error *error)
{
    return fst_tracks_write(path, track, 1, error);
}

fst_status fst_tracks_write(const char *path, const fst_track *track, int count, fst_error *error)
{
    fst_whole_file file;
    const fst_status status = fst_whole_file_open(&file, path, error);
    if (status != FST_OK)
        return status;
    const fst_c_locale locale = fst_c_locale_enter();
    const int timed = track->rows == 0 || isfinite(track->t[0]);
    const char *unit = track->length_unit[0] ? track->length_unit : "px";
    if (track->scale_error > 0.0) {
        (void)fputs(TRACK_SCALE_ERROR, file.stream);
        put(file.stream, track->scale_error, '\n');
    }
    if (track->rhythm)
        (void)fprintf(file.stream, TRACK_RHYTHM "%d\n", track->rhythm);
    (void)fprintf(file.stream, "frame,%sx [%s],y [%s]%s", timed ? "t [s]," : "", unit, unit,
                  count > 1 ? ",track,doubts" : "");
    if (count == 1 && track->turning)
        (void)fprintf(file.stream,
                      ",nx,ny,nz,n_error [rad],wx [rad/s],wy [rad/s],wz [rad/s],w_error [rad/s],slip_x [%s/s],"
                      "slip_y [%s/s],slip_error [%s/s]",
                      unit, unit, unit);
    (void)fputc('\n', file.stream);
    for (size_t i = 0; i < track->rows; ++i)
        for (const fst_track *one = track; one < track + count; ++one) {
            (void)fprintf(file.stream, "%lld,", (long long)one->frame[i]);
            if (timed)
                put(file.stream, one->t[i], ',');
            put(file.stream, one->x[i], ',');
            put(file.stream, one->y[i], count > 1 || one->turning ? ',' : '\n');
            if (count > 1)
                (void)fprintf(file.stream, "%d,%d\n", (int)(one - track) + 1, one->doubts[i]);
            else if (one->turning)
                put_turning(file.stream, &one->turning[i]);
        }
    fst_c_locale_leave(locale);
    return fst_whole_file_commit(&file, error);
}
