/* read_trk.c - projects of Tracker (Open Source Physics), .trk: XML made of nested objects and properties.
 *
 *   TrackerPanel > property "coords" > ImageCoordSystem > "framedata" > "[n]" > FrameData > xorigin, yorigin,
 * angle, ... > property "tracks" > PointMass > "name", "framedata" > "[n]" > FrameData > x, y > property
 * "length_unit"; "clipcontrol" > "delta_t"
 *
 * Places are in pixels, y down; n is the number of the frame.  The axes have an origin, an angle (degrees,
 * counter-clockwise) and a scale (pixels in a unit of length), which may change at any frame and hold from
 * there on.
 */
#include "track/read_formats.h"

#include <stdlib.h>
#include <string.h>

#include "base/constants.h"
#include "base/error.h"
#include "track/xml.h"

enum { MOST_AXES = 4096 };

/* The axes from a frame on. */
typedef struct axes {
    double frame, x, y, angle, x_scale, y_scale;
} axes;

typedef struct project {
    track_raw *raw;
    axes *axes;
    int axes_count;
    char unit[32];
    char name[TRACK_NAME_SIZE];                     /* of the track that is being read */
    char property[TRACK_XML_DEPTH][TRACK_XML_NAME]; /* names of the properties that are open; "" for objects */
    char object[TRACK_XML_DEPTH][TRACK_XML_NAME];   /* last word of the classes of objects that are open */
    track_spot spot;
    axes now;
} project;

/* The last part of a class's name, after the last point: "PointMass$FrameData". */
static const char *last_part(const char *class)
{
    const char *point = class ? strrchr(class, '.') : NULL;
    return point ? point + 1 : class ? class : "";
}

/* "[12]" is 12; otherwise -1. */
static double number_in_brackets(const char *name)
{
    double number;
    char digits[32];
    if (name[0] != '[' || sscanf(name, "[%30[0-9]]", digits) != 1 ||
        track_number(digits, &number) != TRACK_NUMBER)
        return -1.0;
    return number;
}

/* The name of the property around the object that is open at `depth`. */
static const char *property_of(const project *p, int depth)
{
    return depth > 0 ? p->property[depth - 1] : "";
}

static void open_element(project *p, const track_xml *xml)
{
    const int depth = xml->depth - 1;
    const char *name = track_xml_attribute(xml, "name");
    p->property[depth][0] = p->object[depth][0] = '\0';
    if (strcmp(xml->name, "property") == 0) {
        (void)snprintf(p->property[depth], TRACK_XML_NAME, "%s", name ? name : "");
        return;
    }
    (void)snprintf(p->object[depth], TRACK_XML_NAME, "%s", last_part(track_xml_attribute(xml, "class")));
    const double frame = number_in_brackets(property_of(p, depth));
    if (strcmp(p->object[depth], "PointMass") == 0)
        p->name[0] = '\0';
    p->spot = (track_spot){.frame = frame, .t = NAN, .x = NAN, .y = NAN, .line = track_xml_line(xml)};
    p->now = (axes){.frame = frame, .x_scale = 1.0, .y_scale = 1.0};
}

/* The value of a property: keep it if it is one that says something. */
static void take_value(project *p, const track_xml *xml)
{
    const int depth = xml->depth - 1;
    const char *property = depth >= 0 ? p->property[depth] : "",
               *object = depth >= 1 ? p->object[depth - 1] : "";
    const struct {
        const char *object, *property;
        double *value;
    } numbers[] = {
        {"PointMass$FrameData", "x", &p->spot.x},
        {"PointMass$FrameData", "y", &p->spot.y},
        {"ImageCoordSystem$FrameData", "xorigin", &p->now.x},
        {"ImageCoordSystem$FrameData", "yorigin", &p->now.y},
        {"ImageCoordSystem$FrameData", "angle", &p->now.angle},
        {"ImageCoordSystem$FrameData", "xscale", &p->now.x_scale},
        {"ImageCoordSystem$FrameData", "yscale", &p->now.y_scale},
    };
    for (size_t i = 0; i < sizeof numbers / sizeof *numbers; ++i)
        if (strcmp(object, numbers[i].object) == 0 && strcmp(property, numbers[i].property) == 0)
            (void)track_number(xml->text, numbers[i].value);
    /* The control's class is StepperClipControl or VideoClipControl.  Videos of images have a delta_t too,
     * which is not the one in use. */
    if (strcmp(property, "delta_t") == 0 && strcmp(property_of(p, depth - 1), "clipcontrol") == 0)
        (void)track_number(xml->text, &p->raw->interval);
    if (strcmp(property, "length_unit") == 0)
        (void)snprintf(p->unit, sizeof p->unit, "%.31s", xml->text);
    if (strcmp(object, "PointMass") == 0 && strcmp(property, "name") == 0)
        (void)snprintf(p->name, sizeof p->name, "%.63s", xml->text);
}

static fst_status close_element(project *p, const track_xml *xml, fst_error *error)
{
    const char *object = p->object[xml->depth];
    if (strcmp(object, "ImageCoordSystem$FrameData") == 0 && p->axes_count < MOST_AXES && p->now.frame >= 0)
        p->axes[p->axes_count++] = p->now;
    else if (strcmp(object, "PointMass$FrameData") == 0 && p->spot.frame >= 0) {
        const fst_status status = track_raw_name(p->raw, p->name, &p->spot.track, error);
        return status == FST_OK ? track_raw_add(p->raw, p->spot, error) : status;
    }
    p->object[xml->depth][0] = '\0';
    return FST_OK;
}

/* From pixels to the axes of the project, which have y up. */
static void place_spot(const project *p, track_spot *spot)
{
    axes here = {0, 0, 0, 0, 1, 1};
    for (int i = 0; i < p->axes_count; ++i)
        if (p->axes[i].frame <= spot->frame || i == 0)
            here = p->axes[i];
    const double dx = spot->x - here.x, dy = here.y - spot->y;
    const double c = cos(here.angle * FST_PI / 180.0), s = sin(here.angle * FST_PI / 180.0);
    spot->x = (c * dx + s * dy) / here.x_scale;
    spot->y = (c * dy - s * dx) / here.y_scale;
}

static fst_status take_project(project *p, const track_text *text, fst_error *error)
{
    track_xml *xml = malloc(sizeof *xml);
    track_xml_event event = TRACK_XML_OPEN;
    fst_status status = FST_OK;
    if (!xml)
        return fst_fail(error, FST_NO_MEMORY, text->path, "no memory for this file");
    track_xml_begin(xml, text);
    while (status == FST_OK && event != TRACK_XML_END) {
        status = track_xml_next(xml, &event, error);
        if (status != FST_OK)
            break;
        if (event == TRACK_XML_OPEN)
            open_element(p, xml);
        else if (event == TRACK_XML_TEXT)
            take_value(p, xml);
        else if (event == TRACK_XML_CLOSE)
            status = close_element(p, xml, error);
    }
    free(xml);
    return status;
}

fst_status track_read_trk(const track_text *text, track_raw *raw, fst_error *error)
{
    project *p = calloc(1, sizeof *p);
    axes *all = calloc(MOST_AXES, sizeof *all);
    if (!p || !all) {
        free(p);
        free(all);
        return fst_fail(error, FST_NO_MEMORY, text->path, "no memory for this file");
    }
    p->raw = raw;
    p->axes = all;
    const fst_status status = take_project(p, text, error);
    raw->interval /= 1000.0; /* ms */
    int scaled = 0;
    for (int i = 0; i < p->axes_count; ++i) {
        scaled |= p->axes[i].x_scale != 1.0 || p->axes[i].y_scale != 1.0;
        if (!(p->axes[i].x_scale > 0) || !(p->axes[i].y_scale > 0))
            p->axes[i].x_scale = p->axes[i].y_scale = 1.0;
    }
    for (size_t i = 0; i < raw->count; ++i)
        place_spot(p, &raw->spots[i]);
    /* A project whose scale was never set has one of 1, and its unit of length means nothing. */
    (void)snprintf(raw->length_unit, sizeof raw->length_unit, "%s", scaled ? p->unit : "px");
    if (!scaled)
        (void)snprintf(raw->remark, sizeof raw->remark, "the project has no scale");
    free(all);
    free(p);
    return status;
}
