/* fuzz_track.c - tracks of any format: a refusal has a sentence, an accepted track has rising times and unit,
 * and what is measured of it is finite or unknown. */
#include <stdlib.h>
#include <string.h>

#include "tracks/raw.h"

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size);

static void check_track(fst_track *track)
{
    fst_measure_options options = fst_default_measure_options();
    fst_measurement measured;
    fst_error error = {FST_OK, "", ""};
    for (size_t i = 0; i < track->rows; ++i)
        if ((i > 0 && track->frame[i] <= track->frame[i - 1]) ||
            (track->flag[i] == FST_FRAME_SEEN) != isfinite(track->x[i]))
            abort();
    if (!track->length_unit[0])
        abort();
    options.drive = 12.8;
    if (fst_measure_track(track, &options, &measured, &error) != FST_OK && !error.sentence[0])
        abort();
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    fst_text text;
    track_raw raw;
    fst_track track = {0};
    fst_track_options options = fst_default_track_options();
    fst_error error = {FST_OK, "", ""};
    options.fps = size % 2 ? 240.0 : NAN;
    options.scale = size % 3 ? NAN : 1.0;
    options.scale_unit = "px";
    track_raw_begin(&raw, "");
    fst_status status = fst_text_take(&text, "fuzz", (const char *)data, size, &error);
    if (status == FST_OK)
        status = track_read_text(&text, &options, &raw, &error);
    if (status == FST_OK)
        status = track_choose(&raw, "fuzz", &options, -1, &track, NULL, &error);
    if (status == FST_OK)
        check_track(&track);
    else if (error.code == FST_OK || !error.sentence[0])
        abort();
    fst_track_free(&track);
    track_raw_free(&raw);
    fst_text_free(&text);
    return 0;
}
