/* track.c - the memory of a track, and writing it as festoon's own CSV. */
#include <festoon/festoon_tools.h>

#include <stdlib.h>
#include <string.h>

#include "base/error.h"
#include "base/number.h"
#include "host/whole_file.h"

void fst_track_free(fst_track *track)
{
    free(track->frame);
    free(track->t);
    free(track->x);
    free(track->y);
    free(track->flag);
    *track = (fst_track){0};
}

/* Give an array room for `capacity` elements of `size` bytes.  Returns 0 where there is no memory. */
static int widen(void *array, size_t capacity, size_t size)
{
    void *old, *wider;
    memcpy(&old, array, sizeof old);
    wider = realloc(old, capacity * size);
    if (wider)
        memcpy(array, &wider, sizeof wider);
    return wider != NULL;
}

fst_status fst_track_append(fst_track *track, int64_t frame, double t, double x, double y, fst_error *error)
{
    if (track->rows == track->capacity) {
        const size_t capacity = track->capacity ? 2 * track->capacity : 256;
        if (!widen(&track->frame, capacity, sizeof *track->frame) ||
            !widen(&track->t, capacity, sizeof *track->t) || !widen(&track->x, capacity, sizeof *track->x) ||
            !widen(&track->y, capacity, sizeof *track->y) || !widen(&track->flag, capacity, 1))
            return fst_fail(error, FST_NO_MEMORY, "", "no memory for a track of %zu frames", capacity);
        track->capacity = capacity;
    }
    const int seen = isfinite(x) && isfinite(y);
    const size_t i = track->rows++;
    track->frame[i] = frame;
    track->t[i] = t;
    track->x[i] = seen ? x : NAN;
    track->y[i] = seen ? y : NAN;
    track->flag[i] = seen ? FST_FRAME_SEEN : FST_FRAME_LOST;
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

fst_status fst_track_write(const char *path, const fst_track *track, fst_error *error)
{
    fst_whole_file file;
    const fst_status status = fst_whole_file_open(&file, path, error);
    if (status != FST_OK)
        return status;
    const fst_c_locale locale = fst_c_locale_enter();
    const int timed = track->rows == 0 || isfinite(track->t[0]);
    const char *unit = track->length_unit[0] ? track->length_unit : "px";
    (void)fprintf(file.stream, "frame,%sx [%s],y [%s]\n", timed ? "t [s]," : "", unit, unit);
    for (size_t i = 0; i < track->rows; ++i) {
        (void)fprintf(file.stream, "%lld,", (long long)track->frame[i]);
        if (timed)
            put(file.stream, track->t[i], ',');
        put(file.stream, track->x[i], ',');
        put(file.stream, track->y[i], '\n');
    }
    fst_c_locale_leave(locale);
    return fst_whole_file_commit(&file, error);
}
