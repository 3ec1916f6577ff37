/* raw.c - the memory of track_raw, and the units that files of tracks use. */
#include "tracks/raw.h"

#include <stdlib.h>
#include <string.h>

#include "base/error.h"
#include "base/grow.h"

void track_raw_begin(track_raw *raw, const char *format)
{
    *raw = (track_raw){.time_unit = 1.0, .interval = NAN};
    (void)snprintf(raw->format, sizeof raw->format, "%s", format);
}

void track_raw_free(track_raw *raw)
{
    free(raw->spots);
    free(raw->turnings);
    free(raw->names);
    *raw = (track_raw){0};
}

fst_status track_raw_add(track_raw *raw, track_spot spot, fst_error *error)
{
    if (!fst_grow(&raw->spots, raw->count, sizeof *raw->spots))
        return fst_fail(error, FST_NO_MEMORY, "", "no memory for more than %zu places of a track", raw->count);
    raw->spots[raw->count++] = spot;
    return FST_OK;
}

fst_status track_raw_name(track_raw *raw, const char *name, int *index, fst_error *error)
{
    char cut[TRACK_NAME_SIZE];
    (void)snprintf(cut, sizeof cut, "%s", name);
    *index = raw->last_name;
    if (raw->name_count > 0 && strcmp(raw->names[*index], cut) == 0)
        return FST_OK;
    for (*index = 0; *index < raw->name_count; ++*index)
        if (strcmp(raw->names[*index], cut) == 0) {
            raw->last_name = *index;
            return FST_OK;
        }
    if (raw->name_count == TRACK_MOST_TRACKS)
        return fst_fail(error, FST_BAD_INPUT, "", "there are more than %d tracks", TRACK_MOST_TRACKS);
    if (!fst_grow(&raw->names, (size_t)raw->name_count, sizeof *raw->names))
        return fst_fail(error, FST_NO_MEMORY, "", "no memory for more than %d tracks", raw->name_count);
    memcpy(raw->names[raw->name_count], cut, sizeof cut);
    raw->last_name = *index = raw->name_count++;
    return FST_OK;
}

/* ---------------------------------------------------------------- units */

double track_time_unit(const char *unit)
{
    static const struct {
        const char *name;
        double seconds;
    } units[] = {{"s", 1},       {"sec", 1},   {"second", 1},       {"seconds", 1}, {"ms", 1e-3},
                 {"msec", 1e-3}, {"us", 1e-6}, {"\xC2\xB5s", 1e-6}, {"min", 60},    {"h", 3600}};
    for (size_t i = 0; i < sizeof units / sizeof *units; ++i)
        if (strcmp(units[i].name, unit) == 0)
            return units[i].seconds;
    return 0.0;
}

int track_is_pixel(const char *unit)
{
    return strcmp(unit, "px") == 0 || strcmp(unit, "pixel") == 0 || strcmp(unit, "pixels") == 0;
}

double track_length_unit(const char *unit)
{
    char text[48];
    double metres;
    const int micron = strcmp(unit, "micron") == 0 || strcmp(unit, "microns") == 0;
    (void)snprintf(text, sizeof text, "1 %.30s", micron ? "um" : unit);
    return unit[0] && fst_parse_value(text, FST_UNIT_LENGTH, &metres, NULL) == FST_OK ? metres : 0.0;
}
