/* read_trk.c - projects of Tracker (Open Source Physics), .trk: XML made of nested objects and properties.
 *
 *   TrackerPanel > property "coords" > ImageCoordSystem > "framedata" > "[n]" > FrameData > xorigin, yorigin,
 *                                                                                         angle, ...
 *                > property "tracks" > PointMass > "name", "framedata" > "[n]" > FrameData > x, y
 *                > property "length_unit"; "clipcontrol" > "delta_t"
 *
 * Places are in pixels, y down; n is the number of the frame.  The axes have an origin, an angle (degrees,
 * counter-clockwise) and a scale (pixels in a unit of length), which may change at any frame and hold from
 * there on.
 */
#include "tracks/read_formats.h"

#include <stdlib.h>
#include <string.h>

#include "base/constants.h"
#include "base/error.h"
#include "io/xml.h"

enum { MOST_AXES = 4096, LONGEST_WORD = 80 };

/* The axes from a frame on. */
typedef struct axes {
    double frame, x, y, angle, x_scale, y_scale;
} axes;

typedef struct project {
    track_raw *raw;
    axes *axes;
    int axes_count;
    char unit[32];
    char name[TRACK_NAME_SIZE];                 /* of the track that is being read */
    char property[FST_XML_DEPTH][LONGEST_WORD]; /* names of the properties that are open; "" for objects */
    char object[FST_XML_DEPTH][LONGEST_WORD];   /* last word of the classes of objects that are open */
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
        fst_text_number(digits, &number) != FST_TEXT_NUMBER)
        return -1.0;
    return number;
}

/* The name of the property around the object that is open at `depth`. */
static const char *property_of(const project *p, int depth)
{
    return depth > 0 ? p->property[depth - 1] : "";
}

static void open_element(project *p, const fst_xml_event *element)
{
    const int depth = element->depth;
    const char *name = fst_xml_attribute(element, "name");
    p->property[depth][0] = p->object[depth][0] = '\0';
    if (strcmp(element->text, "property") == 0) {
        (void)snprintf(p->property[depth], LONGEST_WORD, "%s", name ? name : "");
        return;
    }
    (void)snprintf(p->object[depth], LONGEST_WORD, "%s", last_part(fst_xml_attribute(element, "class")));
    const double frame = number_in_brackets(property_of(p, depth));
    if (strcmp(p->object[depth], "PointMass") == 0)
        p->name[0] = '\0';
    p->spot = (track_spot){.frame = frame, .t = NAN, .x = NAN, .y = NAN, .line = element->line};
    p->now = (axes){.frame = frame, .x_scale = 1.0, .y_scale = 1.0};
}

/* The value of a property: keep it if it is one that says something. */
static void take_value(project *p, const fst_xml_event *value)
{
    const int depth = value->depth;
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
            (void)fst_text_number(value->text, numbers[i].value);
    /* The control's class is StepperClipControl or VideoClipControl.  Videos of images have a delta_t too,
     * which is not the one in use. */
    if (strcmp(property, "delta_t") == 0 && strcmp(property_of(p, depth - 1), "clipcontrol") == 0)
        (void)fst_text_number(value->text, &p->raw->interval);
    if (strcmp(property, "length_unit") == 0)
        (void)snprintf(p->unit, sizeof p->unit, "%.31s", value->text);
    if (strcmp(object, "PointMass") == 0 && strcmp(property, "name") == 0)
        (void)snprintf(p->name, sizeof p->name, "%.63s", value->text);
}

static fst_status close_element(project *p, int depth, fst_error *error)
{
    const char *object = p->object[depth];
    if (strcmp(object, "ImageCoordSystem$FrameData") == 0 && p->axes_count < MOST_AXES && p->now.frame >= 0)
        p->axes[p->axes_count++] = p->now;
    else if (strcmp(object, "PointMass$FrameData") == 0 && p->spot.frame >= 0) {
        const fst_status status = track_raw_name(p->raw, p->name, &p->spot.track, error);
        return status == FST_OK ? track_raw_add(p->raw, p->spot, error) : status;
    }
    p->object[depth][0] = '\0';
    return FST_OK;
}

static fst_status take_event(void *user, const fst_xml_event *event, fst_error *error)
{
    if (event->what == FST_XML_CLOSE)
        return close_element(user, event->depth, error);
    if (event->what == FST_XML_OPEN)
        open_element(user, event);
    else
        take_value(user, event);
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

fst_status track_read_trk(const fst_text *text, size_t header, int variant, track_raw *raw, fst_error *error)
{
    (void)header, (void)variant;
    project *p = calloc(1, sizeof *p);
    axes *all = calloc(MOST_AXES, sizeof *all);
    if (!p || !all) {
        free(p);
        free(all);
        return fst_fail(error, FST_NO_MEMORY, text->path, "no memory for this file");
    }
    p->raw = raw;
    p->axes = all;
    const fst_status status = fst_xml_read(text, take_event, p, error);
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
