/* xml.c - reading XML by libexpat. */
#include "io/xml.h"

#include <math.h>
#include <string.h>

#include "base/error.h"
#include "base/text.h"

const char *fst_xml_attribute(const fst_xml_event *event, const char *name)
{
    for (const char *const *at = event->attributes; at && at[0]; at += 2)
        if (strcmp(at[0], name) == 0)
            return at[1];
    return NULL;
}

double fst_xml_number(const fst_xml_event *event, const char *name)
{
    double number = NAN;
    const char *value = fst_xml_attribute(event, name);
    return value && fst_text_number(value, &number) == FST_TEXT_NUMBER ? number : NAN;
}

#ifdef FESTOON_HAVE_EXPAT
#include <expat.h>

typedef struct reader {
    XML_Parser parser;
    const fst_text *text;
    size_t before; /* lines of the file before the first one of the XML */
    fst_xml_taker *taker;
    void *user;
    fst_error *error;
    fst_status status;
    int depth;                 /* elements that are open */
    char value[FST_XML_VALUE]; /* the text behind the last tag; a longer one is cut */
    size_t length;
} reader;

static size_t line_of(const reader *r)
{
    return r->before + (size_t)XML_GetCurrentLineNumber(r->parser);
}

static void fail(reader *r, const char *what)
{
    if (r->status == FST_OK)
        r->status =
            fst_text_fail(r->text->path, line_of(r), r->error, "this is not XML that can be read: %s", what);
    (void)XML_StopParser(r->parser, XML_FALSE);
}

static void hand_on(reader *r, fst_xml_event event)
{
    if (r->status != FST_OK)
        return;
    event.line = line_of(r);
    r->status = r->taker(r->user, &event, r->error);
    if (r->status != FST_OK)
        (void)XML_StopParser(r->parser, XML_FALSE);
}

/* Hand on the text before a tag. */
static void end_text(reader *r)
{
    size_t length;
    r->value[r->length] = '\0';
    r->length = 0;
    char *trimmed = r->value + (fst_trim(r->value, &length) - r->value);
    trimmed[length] = '\0';
    if (length > 0)
        hand_on(r, (fst_xml_event){FST_XML_TEXT, trimmed, NULL, r->depth - 1, 0});
}

static void XMLCALL on_open(void *user, const char *name, const char **attributes)
{
    reader *r = user;
    end_text(r);
    if (r->depth == FST_XML_DEPTH)
        fail(r, "its elements are nested too deeply");
    else
        hand_on(r, (fst_xml_event){FST_XML_OPEN, name, (const char *const *)attributes, r->depth++, 0});
}

static void XMLCALL on_close(void *user, const char *name)
{
    reader *r = user;
    end_text(r);
    hand_on(r, (fst_xml_event){FST_XML_CLOSE, name, NULL, --r->depth, 0});
}

static void XMLCALL on_text(void *user, const char *text, int length)
{
    reader *r = user;
    for (int i = 0; i < length && r->length + 1 < sizeof r->value; ++i)
        if (r->length > 0 || !strchr(" \t\r\n", text[i]))
            r->value[r->length++] = text[i];
}

static void XMLCALL on_document_type(void *user, const char *name, const char *system, const char *public,
                                     int inner)
{
    (void)name, (void)system, (void)public, (void)inner;
    fail(user, "it has a document type, which no tracker writes");
}

fst_status fst_xml_read(const fst_text *text, fst_xml_taker *taker, void *user, fst_error *error)
{
    /* The lines are UTF-8, whatever the file says of itself. */
    reader r = {XML_ParserCreate("UTF-8"), .text = text, .taker = taker, .user = user, .error = error};
    if (!r.parser)
        return fst_fail(error, FST_NO_MEMORY, text->path, "no memory for this file");
    XML_SetUserData(r.parser, &r);
    XML_SetElementHandler(r.parser, on_open, on_close);
    XML_SetCharacterDataHandler(r.parser, on_text);
    XML_SetStartDoctypeDeclHandler(r.parser, on_document_type);
    while (r.before < text->count && fst_text_says_nothing(text->lines[r.before]))
        ++r.before;
    enum XML_Status parsed = XML_STATUS_OK;
    for (size_t i = r.before; i <= text->count && parsed == XML_STATUS_OK; ++i) {
        const char *line = i < text->count ? text->lines[i] : "";
        line += i == r.before ? strspn(line, " \t") : 0; /* nothing may stand before the first tag */
        parsed = XML_Parse(r.parser, line, (int)strlen(line), i == text->count);
        if (parsed == XML_STATUS_OK && i < text->count)
            parsed = XML_Parse(r.parser, "\n", 1, 0);
    }
    if (parsed != XML_STATUS_OK)
        fail(&r, XML_ErrorString(XML_GetErrorCode(r.parser)));
    XML_ParserFree(r.parser);
    return r.status;
}

#else

fst_status fst_xml_read(const fst_text *text, fst_xml_taker *taker, void *user, fst_error *error)
{
    (void)taker, (void)user;
    return fst_fail(error, FST_UNAVAILABLE, text->path,
                    "this is XML, and this festoon was built without libexpat, which reads it: install "
                    "libexpat1-dev and build festoon again");
}

#endif
