/* read_trackmate.c - TrackMate (Fiji): its simple XML of tracks, and its whole model as XML.  (Its table of
 * spots: read_columns.c.)
 *
 *   simple   <Tracks spaceUnits frameInterval timeUnits> <particle nSpots> <detection t x y z/>, t being a
 * frame model    <Model spatialunits timeunits>, <Spot ID FRAME POSITION_X POSITION_Y>, and for each <Track
 * name> <Edge SPOT_SOURCE_ID SPOT_TARGET_ID>; <ImageData timeinterval>
 *
 * y points down in both.
 */
#include "tracks/read_formats.h"

#include <stdlib.h>
#include <string.h>

#include "base/error.h"
#include "io/xml.h"

/* A spot of the whole model, and the track to which an edge joins it (-1: none). */
typedef struct model_spot {
    double id;
    track_spot spot;
} model_spot;

typedef struct model {
    const char *path;
    track_raw *raw;
    char time_unit[32];
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

static fst_status keep_spot(model *m, const fst_xml_event *element, fst_error *error)
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
                             fst_xml_number(element, "FRAME"),
                             NAN,
                             fst_xml_number(element, "POSITION_X"),
                             fst_xml_number(element, "POSITION_Y"),
                             element->line,
                             0,
                             0};
    const double id = fst_xml_number(element, "ID");
    if (isnan(id) || isnan(spot.frame) || isnan(spot.x) || isnan(spot.y))
        return fst_text_fail(m->path, spot.line, error,
                             "a spot lacks one of ID, FRAME, POSITION_X, POSITION_Y, or it is not a number");
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

static fst_status take_detection(model *m, const fst_xml_event *element, fst_error *error)
{
    const track_spot spot = {m->track,
                             fst_xml_number(element, "t"),
                             NAN,
                             fst_xml_number(element, "x"),
                             fst_xml_number(element, "y"),
                             element->line,
                             0,
                             0};
    if (isnan(spot.frame) || isnan(spot.x) || isnan(spot.y) || m->particles == 0)
        return fst_text_fail(
            m->path, spot.line, error,
            "a detection lacks one of t, x, y, or it is not a number, or it is of no particle");
    return track_raw_add(m->raw, spot, error);
}

static fst_status take_element(void *user, const fst_xml_event *element, fst_error *error)
{
    model *m = user;
    char name[TRACK_NAME_SIZE];
    const char *text;
    if (element->what != FST_XML_OPEN)
        return FST_OK;
    if (strcmp(element->text, "Tracks") == 0) {
        text = fst_xml_attribute(element, "spaceUnits");
        (void)snprintf(m->raw->length_unit, sizeof m->raw->length_unit, "%.31s", text ? text : "");
        take_interval(m->raw, fst_xml_number(element, "frameInterval"),
                      fst_xml_attribute(element, "timeUnits"));
    } else if (strcmp(element->text, "particle") == 0) {
        (void)snprintf(name, sizeof name, "%d", m->particles++);
        return track_raw_name(m->raw, name, &m->track, error);
    } else if (strcmp(element->text, "detection") == 0) {
        return take_detection(m, element, error);
    } else if (strcmp(element->text, "Model") == 0) {
        text = fst_xml_attribute(element, "spatialunits");
        (void)snprintf(m->raw->length_unit, sizeof m->raw->length_unit, "%.31s", text ? text : "");
        text = fst_xml_attribute(element, "timeunits");
        (void)snprintf(m->time_unit, sizeof m->time_unit, "%.31s", text ? text : "");
    } else if (strcmp(element->text, "Spot") == 0) {
        return keep_spot(m, element, error);
    } else if (strcmp(element->text, "Track") == 0) {
        text = fst_xml_attribute(element, "name");
        if (!text)
            text = fst_xml_attribute(element, "TRACK_ID");
        return track_raw_name(m->raw, text ? text : "", &m->track, error);
    } else if (strcmp(element->text, "Edge") == 0) {
        join(m, fst_xml_number(element, "SPOT_SOURCE_ID"));
        join(m, fst_xml_number(element, "SPOT_TARGET_ID"));
    } else if (strcmp(element->text, "ImageData") == 0) {
        take_interval(m->raw, fst_xml_number(element, "timeinterval"), m->time_unit);
    }
    return FST_OK;
}

fst_status track_read_trackmate_xml(const fst_text *text, size_t header, int variant, track_raw *raw,
                                    fst_error *error)
{
    (void)header, (void)variant;
    model m = {.path = text->path, .raw = raw};
    raw->y_down = 1;
    fst_status status = fst_xml_read(text, take_element, &m, error);
    for (size_t i = 0; i < m.count && status == FST_OK; ++i)
        if (m.spots[i].spot.track >= 0)
            status = track_raw_add(raw, m.spots[i].spot, error);
    free(m.spots);
    return status;
}
