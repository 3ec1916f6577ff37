/* read_trackmate.c - TrackMate (Fiji): its table of spots, its simple XML of tracks, and its whole model as
 * XML.
 *
 *   table    a line of keys (LABEL,ID,TRACK_ID,...,POSITION_X,POSITION_Y,...,FRAME), up to three more lines of
 * names and units, then spots in any order; one without TRACK_ID belongs to no track simple   <Tracks
 * spaceUnits frameInterval timeUnits> <particle nSpots> <detection t x y z/>, t being a frame model    <Model
 * spatialunits timeunits>, <Spot ID FRAME POSITION_X POSITION_Y>, and for each <Track name> <Edge
 * SPOT_SOURCE_ID SPOT_TARGET_ID>; <ImageData timeinterval>
 *
 * y points down in all of them.
 */
#include "track/read_formats.h"

#include <ctype.h>
#include <stdlib.h>
#include <string.h>

#include "base/error.h"
#include "base/text.h"
#include "track/xml.h"

/* ---------------------------------------------------------------- the table */

enum { TRACK_ID, FRAME, POSITION_T, POSITION_X, POSITION_Y, KEYS };
static const char *const keys[KEYS] = {"TRACK_ID", "FRAME", "POSITION_T", "POSITION_X", "POSITION_Y"};

static void find_keys(const track_cells *cells, int at[KEYS])
{
    for (int k = 0; k < KEYS; ++k) {
        at[k] = -1;
        for (int i = 0; i < cells->count; ++i)
            if (strcmp(cells->cell[i], keys[k]) == 0)
                at[k] = i;
    }
}

/* Copy a unit out of its brackets: "(micron)". */
static void bare_unit(const char *cell, char *unit, size_t size)
{
    const char *from = cell + strspn(cell, "([ ");
    (void)snprintf(unit, size, "%.*s", (int)strcspn(from, ")] "), from);
}

/* The lines of names and units below the keys have no number as frame.  Keep the units of the last one. */
static void take_units(const track_cells *cells, const int at[KEYS], track_raw *raw, char time_unit[32])
{
    if (at[POSITION_X] < cells->count && cells->cell[at[POSITION_X]][0])
        bare_unit(cells->cell[at[POSITION_X]], raw->length_unit, sizeof raw->length_unit);
    if (at[POSITION_T] >= 0 && at[POSITION_T] < cells->count)
        bare_unit(cells->cell[at[POSITION_T]], time_unit, 32);
}

static fst_status take_spot(const track_text *text, size_t line, const track_cells *cells, const int at[KEYS],
                            track_raw *raw, fst_error *error)
{
    track_spot spot = {.t = NAN, .line = line};
    double *const values[KEYS] = {NULL, &spot.frame, &spot.t, &spot.x, &spot.y};
    char quoted[FST_QUOTE_SIZE];
    const char *track = at[TRACK_ID] < cells->count ? cells->cell[at[TRACK_ID]] : "";
    if (!track[0] || strcmp(track, "None") == 0)
        return FST_OK;
    for (int k = FRAME; k < KEYS; ++k) {
        if (at[k] < 0)
            continue;
        const char *cell = at[k] < cells->count ? cells->cell[at[k]] : "";
        if (track_number(cell, values[k]) != TRACK_NUMBER)
            return track_fail_line(text->path, line, error, "column %d (%s): %s is no number", at[k] + 1,
                                   keys[k], fst_quote(cell, quoted));
    }
    const fst_status status = track_raw_name(raw, track, &spot.track, error);
    return status == FST_OK ? track_raw_add(raw, spot, error) : status;
}

/* Whether the time of the table is one in seconds: TrackMate writes frames there where it knows no interval. */
static void take_clock(track_raw *raw, const char *time_unit)
{
    raw->time_unit = track_time_unit(time_unit);
    if (raw->time_unit > 0)
        return;
    raw->time_unit = 1.0;
    for (size_t i = 0; i < raw->count; ++i)
        raw->spots[i].t = NAN;
}

fst_status track_read_trackmate_csv(const track_text *text, size_t header, track_raw *raw, fst_error *error)
{
    track_cells cells = {.count = 0};
    const char separator = track_separator_of(text->lines[header]);
    char time_unit[32] = "sec";
    int at[KEYS], names = 1;
    raw->y_down = 1;
    fst_status status = track_split(&cells, text->lines[header], separator, error);
    if (status == FST_OK)
        find_keys(&cells, at);
    for (int k = 0; k < KEYS && status == FST_OK; ++k)
        if (at[k] < 0 && k != POSITION_T)
            status = track_fail_line(text->path, header + 1, error,
                                     "a table of TrackMate's spots has a column %s", keys[k]);
    for (size_t i = header + 1; i < text->count && status == FST_OK; ++i) {
        double number;
        if (!text->lines[i][strspn(text->lines[i], " \t")])
            continue;
        status = track_split(&cells, text->lines[i], separator, error);
        names =
            names && (at[FRAME] >= cells.count || track_number(cells.cell[at[FRAME]], &number) != TRACK_NUMBER);
        if (status == FST_OK && names)
            take_units(&cells, at, raw, time_unit);
        else if (status == FST_OK)
            status = take_spot(text, i + 1, &cells, at, raw, error);
    }
    if (status == FST_OK)
        take_clock(raw, time_unit);
    track_cells_free(&cells);
    return status;
}

/* ---------------------------------------------------------------- XML */

/* A spot of the whole model, and the track to which an edge joins it (-1: none). */
typedef struct model_spot {
    double id;
    track_spot spot;
} model_spot;

typedef struct model {
    track_raw *raw;
    model_spot *spots;
    size_t count, capacity;
    int track; /* that is being read */
    int particles;
    int sorted;
} model;

static int by_id(const void *a, const void *b)
{
    const double p = ((const model_spot *)a)->id, q = ((const model_spot *)b)->id;
    return (p > q) - (p < q);
}

static fst_status keep_spot(model *m, const track_xml *xml, fst_error *error)
{
    if (m->count == m->capacity) {
        const size_t capacity = m->capacity ? 2 * m->capacity : 1024;
        model_spot *spots = realloc(m->spots, capacity * sizeof *spots);
        if (!spots)
            return fst_fail(error, FST_NO_MEMORY, "", "no memory for %zu spots", capacity);
        m->spots = spots;
        m->capacity = capacity;
    }
    const track_spot spot = {-1,
                             track_xml_number(xml, "FRAME"),
                             NAN,
                             track_xml_number(xml, "POSITION_X"),
                             track_xml_number(xml, "POSITION_Y"),
                             track_xml_line(xml)};
    const double id = track_xml_number(xml, "ID");
    if (isnan(id) || isnan(spot.frame) || isnan(spot.x) || isnan(spot.y))
        return track_fail_line(xml->file->path, spot.line, error,
                               "a spot lacks one of ID, FRAME, POSITION_X, POSITION_Y, or it is no number");
    m->spots[m->count++] = (model_spot){id, spot};
    return FST_OK;
}

/* Put a spot that an edge names into the present track. */
static void join(model *m, double id)
{
    const model_spot wanted = {.id = id};
    if (!m->sorted && m->count > 0)
        qsort(m->spots, m->count, sizeof *m->spots, by_id);
    m->sorted = 1;
    model_spot *found = m->count > 0 ? bsearch(&wanted, m->spots, m->count, sizeof *m->spots, by_id) : NULL;
    if (found)
        found->spot.track = m->track;
}

static void take_interval(track_raw *raw, double interval, const char *unit)
{
    const double seconds = unit ? track_time_unit(unit) : 0.0;
    if (interval > 0 && seconds > 0)
        raw->interval = interval * seconds;
}

static fst_status take_detection(model *m, const track_xml *xml, fst_error *error)
{
    const track_spot spot = {m->track,
                             track_xml_number(xml, "t"),
                             NAN,
                             track_xml_number(xml, "x"),
                             track_xml_number(xml, "y"),
                             track_xml_line(xml)};
    if (isnan(spot.frame) || isnan(spot.x) || isnan(spot.y) || m->particles == 0)
        return track_fail_line(xml->file->path, spot.line, error,
                               "a detection lacks one of t, x, y, or it is no number, or it is of no particle");
    return track_raw_add(m->raw, spot, error);
}

static fst_status take_element(model *m, const track_xml *xml, char time_unit[32], fst_error *error)
{
    char name[TRACK_NAME_SIZE];
    const char *text;
    if (strcmp(xml->name, "Tracks") == 0) {
        text = track_xml_attribute(xml, "spaceUnits");
        (void)snprintf(m->raw->length_unit, sizeof m->raw->length_unit, "%.31s", text ? text : "");
        take_interval(m->raw, track_xml_number(xml, "frameInterval"), track_xml_attribute(xml, "timeUnits"));
    } else if (strcmp(xml->name, "particle") == 0) {
        (void)snprintf(name, sizeof name, "%d", m->particles++);
        return track_raw_name(m->raw, name, &m->track, error);
    } else if (strcmp(xml->name, "detection") == 0) {
        return take_detection(m, xml, error);
    } else if (strcmp(xml->name, "Model") == 0) {
        text = track_xml_attribute(xml, "spatialunits");
        (void)snprintf(m->raw->length_unit, sizeof m->raw->length_unit, "%.31s", text ? text : "");
        text = track_xml_attribute(xml, "timeunits");
        (void)snprintf(time_unit, 32, "%.31s", text ? text : "");
    } else if (strcmp(xml->name, "Spot") == 0) {
        return keep_spot(m, xml, error);
    } else if (strcmp(xml->name, "Track") == 0) {
        text = track_xml_attribute(xml, "name");
        if (!text)
            text = track_xml_attribute(xml, "TRACK_ID");
        return track_raw_name(m->raw, text ? text : "", &m->track, error);
    } else if (strcmp(xml->name, "Edge") == 0) {
        join(m, track_xml_number(xml, "SPOT_SOURCE_ID"));
        join(m, track_xml_number(xml, "SPOT_TARGET_ID"));
    } else if (strcmp(xml->name, "ImageData") == 0) {
        take_interval(m->raw, track_xml_number(xml, "timeinterval"), time_unit);
    }
    return FST_OK;
}

fst_status track_read_trackmate_xml(const track_text *text, track_raw *raw, fst_error *error)
{
    model m = {.raw = raw};
    char time_unit[32] = "";
    track_xml *xml = malloc(sizeof *xml);
    track_xml_event event = TRACK_XML_OPEN;
    fst_status status = xml ? FST_OK : fst_fail(error, FST_NO_MEMORY, text->path, "no memory for this file");
    raw->y_down = 1;
    if (xml)
        track_xml_begin(xml, text);
    while (status == FST_OK && event != TRACK_XML_END) {
        status = track_xml_next(xml, &event, error);
        if (status == FST_OK && event == TRACK_XML_OPEN)
            status = take_element(&m, xml, time_unit, error);
    }
    for (size_t i = 0; i < m.count && status == FST_OK; ++i)
        if (m.spots[i].spot.track >= 0)
            status = track_raw_add(raw, m.spots[i].spot, error);
    free(m.spots);
    free(xml);
    return status;
}
