/* xml.h - a small reader of XML: elements with their attributes, and the text between them, one after the
 * other.
 *
 * What it knows is what trackers write: no document types, no entities but the five that XML has itself, no
 * name spaces. Comments, processing instructions and CDATA marks are passed over.
 */
#ifndef FST_TRACK_XML_H
#define FST_TRACK_XML_H

#include "track/text.h"

typedef enum {
    TRACK_XML_OPEN,  /* <name attribute="value"> ; <name/> gives OPEN and then CLOSE */
    TRACK_XML_CLOSE, /* </name> */
    TRACK_XML_TEXT,  /* what stands between tags, without white space at its ends; never empty */
    TRACK_XML_END    /* of the file */
} track_xml_event;

enum { TRACK_XML_NAME = 80, TRACK_XML_VALUE = 256, TRACK_XML_ATTRIBUTES = 64, TRACK_XML_DEPTH = 64 };

typedef struct track_xml {
    const track_text *file;
    const char *at, *end;
    char name[TRACK_XML_NAME];  /* of the element that opens or closes */
    char text[TRACK_XML_VALUE]; /* of TRACK_XML_TEXT; a longer one is cut */
    struct {
        char name[TRACK_XML_NAME], value[TRACK_XML_VALUE];
    } attributes[TRACK_XML_ATTRIBUTES];
    int attribute_count;
    int closes;                                 /* the element that was opened is closed at once */
    char open[TRACK_XML_DEPTH][TRACK_XML_NAME]; /* elements that are open, from the root */
    int depth;
} track_xml;

/* Begin to read; the file may hold zero bytes where its lines ended. */
void track_xml_begin(track_xml *xml, const track_text *file);
/* Go on to the next event.  FST_BAD_INPUT: this is no XML; error->where has the line. */
fst_status track_xml_next(track_xml *xml, track_xml_event *event, fst_error *error);
/* The value of an attribute of the element that opens, or NULL. */
const char *track_xml_attribute(const track_xml *xml, const char *name);
/* The same as a number; NAN where there is none. */
double track_xml_number(const track_xml *xml, const char *name);
/* The line at which the reader is. */
size_t track_xml_line(const track_xml *xml);

#endif
