/* xml.h - reading XML by libexpat: elements with their attributes, and the text between them, one after the
 * other. */
#ifndef FST_IO_XML_H
#define FST_IO_XML_H

#include "io/text_table.h"

/* The deepest elements, which have the root at depth 0; the longest name and text that are kept. */
enum { FST_XML_DEPTH = 64, FST_XML_VALUE = 256 };

/* An element that begins or ends, or the text behind a tag. */
typedef struct fst_xml_event {
    enum { FST_XML_OPEN, FST_XML_CLOSE, FST_XML_TEXT } what;
    const char *text; /* the element's name, or text without white space at its ends, never empty */
    const char *const *attributes; /* of an element that begins: name, value, ..., NULL */
    int depth;                     /* of the element, or of the one around the text */
    size_t line;                   /* of the file */
} fst_xml_event;

/* Called for each event; what is not FST_OK ends the reading. */
typedef fst_status fst_xml_taker(void *user, const fst_xml_event *event, fst_error *error);

/* Read all.  FST_BAD_INPUT: this is not XML, or it has a document type, whose entities could grow without end;
 * FST_UNAVAILABLE: festoon was built without libexpat. */
fst_status fst_xml_read(const fst_text *text, fst_xml_taker *taker, void *user, fst_error *error);

/* The value of an attribute, or NULL; the same as a number, NAN where there is none. */
const char *fst_xml_attribute(const fst_xml_event *event, const char *name);
double fst_xml_number(const fst_xml_event *event, const char *name);

#endif
