/* xml.c - reading XML: see xml.h for what of it. */
#include "track/xml.h"

#include <math.h>
#include <string.h>

#include "base/text.h"

void track_xml_begin(track_xml *xml, const track_text *file)
{
    memset(xml, 0, sizeof *xml);
    xml->file = file;
    xml->at = file->bytes;
    xml->end = file->bytes + file->size;
}

size_t track_xml_line(const track_xml *xml)
{
    size_t low = 0, high = xml->file->count; /* the last line that begins at or before the place */
    while (low + 1 < high) {
        const size_t middle = (low + high) / 2;
        if (xml->file->lines[middle] <= xml->at)
            low = middle;
        else
            high = middle;
    }
    return low + 1;
}

static fst_status broken(const track_xml *xml, const char *what, fst_error *error)
{
    return track_fail_line(xml->file->path, track_xml_line(xml), error, "this is no XML that can be read: %s",
                           what);
}

static int is_space(char c)
{
    return c == ' ' || c == '\t' || c == '\0'; /* ends of lines are zeros in track_text */
}

static void skip_space(track_xml *xml)
{
    while (xml->at < xml->end && is_space(*xml->at))
        ++xml->at;
}

static int begins(const track_xml *xml, const char *word)
{
    const size_t length = strlen(word);
    return (size_t)(xml->end - xml->at) >= length && memcmp(xml->at, word, length) == 0;
}

/* Go beyond the next `word`; 0 where there is none. */
static int skip_to(track_xml *xml, const char *word)
{
    for (; xml->at < xml->end; ++xml->at)
        if (begins(xml, word)) {
            xml->at += strlen(word);
            return 1;
        }
    return 0;
}

/* Copy one character of text to `to`, where there is room, with the entities of XML resolved. */
static void take_character(track_xml *xml, char *to, size_t size, size_t *length)
{
    static const struct {
        const char *name;
        char meant;
    } entities[] = {{"&lt;", '<'}, {"&gt;", '>'}, {"&amp;", '&'}, {"&quot;", '"'}, {"&apos;", '\''}};
    char c = *xml->at;
    size_t taken = 1;
    for (size_t i = 0; c == '&' && i < sizeof entities / sizeof *entities; ++i)
        if (begins(xml, entities[i].name)) {
            c = entities[i].meant;
            taken = strlen(entities[i].name);
            break;
        }
    xml->at += taken;
    if (*length + 1 < size)
        to[(*length)++] = c ? c : ' ';
    to[*length] = '\0';
}

static int take_name(track_xml *xml, char *name, size_t size)
{
    size_t length = 0;
    while (xml->at < xml->end && !is_space(*xml->at) && !strchr("<>/=\"'", *xml->at)) {
        if (length + 1 < size)
            name[length++] = *xml->at;
        ++xml->at;
    }
    name[length] = '\0';
    return length > 0;
}

static fst_status take_attribute(track_xml *xml, fst_error *error)
{
    char name[TRACK_XML_NAME], value[TRACK_XML_VALUE] = "";
    size_t length = 0;
    if (!take_name(xml, name, sizeof name))
        return broken(xml, "the name of an attribute was expected", error);
    skip_space(xml);
    if (!begins(xml, "="))
        return broken(xml, "an attribute has no value", error);
    ++xml->at;
    skip_space(xml);
    const char quote = xml->at < xml->end ? *xml->at : '\0';
    if (quote != '"' && quote != '\'')
        return broken(xml, "the value of an attribute stands in no quotes", error);
    for (++xml->at; xml->at < xml->end && *xml->at != quote;)
        take_character(xml, value, sizeof value, &length);
    if (xml->at == xml->end)
        return broken(xml, "the file ends in the value of an attribute", error);
    ++xml->at;
    if (xml->attribute_count < TRACK_XML_ATTRIBUTES) {
        memcpy(xml->attributes[xml->attribute_count].name, name, sizeof name);
        memcpy(xml->attributes[xml->attribute_count++].value, value, sizeof value);
    }
    return FST_OK;
}

static fst_status take_opening(track_xml *xml, fst_error *error)
{
    xml->attribute_count = 0;
    if (!take_name(xml, xml->name, sizeof xml->name))
        return broken(xml, "the name of an element was expected", error);
    if (xml->depth == TRACK_XML_DEPTH)
        return broken(xml, "its elements are nested too deeply", error);
    memcpy(xml->open[xml->depth++], xml->name, sizeof xml->name);
    for (;;) {
        skip_space(xml);
        if (begins(xml, "/>")) {
            xml->at += 2;
            xml->closes = 1;
            return FST_OK;
        }
        if (begins(xml, ">")) {
            ++xml->at;
            return FST_OK;
        }
        if (xml->at == xml->end)
            return broken(xml, "the file ends within an element", error);
        const fst_status status = take_attribute(xml, error);
        if (status != FST_OK)
            return status;
    }
}

static fst_status take_closing(track_xml *xml, fst_error *error)
{
    (void)take_name(xml, xml->name, sizeof xml->name);
    skip_space(xml);
    if (!begins(xml, ">"))
        return broken(xml, "the end of an element was expected", error);
    ++xml->at;
    if (xml->depth == 0 || strcmp(xml->open[xml->depth - 1], xml->name) != 0)
        return broken(xml, "an element ends that is not open", error);
    --xml->depth;
    return FST_OK;
}

/* Pass over what is neither element nor text.  Returns 1 where something was, -1 where it has no end. */
static int skip_other(track_xml *xml)
{
    static const char *const others[][2] = {{"<!--", "-->"}, {"<?", "?>"}, {"<![CDATA[", ""}, {"]]>", ""}};
    for (size_t i = 0; i < sizeof others / sizeof *others; ++i)
        if (begins(xml, others[i][0])) {
            xml->at += strlen(others[i][0]);
            return !others[i][1][0] || skip_to(xml, others[i][1]) ? 1 : -1;
        }
    return 0;
}

static void take_text(track_xml *xml)
{
    size_t length = 0;
    while (xml->at < xml->end && *xml->at != '<' && !begins(xml, "]]>"))
        take_character(xml, xml->text, sizeof xml->text, &length);
    while (length > 0 && is_space(xml->text[length - 1]))
        xml->text[--length] = '\0';
}

fst_status track_xml_next(track_xml *xml, track_xml_event *event, fst_error *error)
{
    if (xml->closes) {
        xml->closes = 0;
        --xml->depth;
        *event = TRACK_XML_CLOSE;
        return FST_OK;
    }
    for (;;) {
        skip_space(xml);
        if (xml->at == xml->end) {
            *event = TRACK_XML_END;
            return xml->depth > 0 ? broken(xml, "the file ends within an element", error) : FST_OK;
        }
        const int other = skip_other(xml);
        if (other < 0)
            return broken(xml, "a comment or an instruction has no end", error);
        if (other > 0)
            continue;
        if (begins(xml, "<!"))
            return broken(xml, "it has a document type, which no tracker writes", error);
        if (begins(xml, "</")) {
            xml->at += 2;
            *event = TRACK_XML_CLOSE;
            return take_closing(xml, error);
        }
        if (*xml->at == '<') {
            ++xml->at;
            *event = TRACK_XML_OPEN;
            return take_opening(xml, error);
        }
        *event = TRACK_XML_TEXT;
        take_text(xml);
        if (xml->text[0])
            return FST_OK;
    }
}

const char *track_xml_attribute(const track_xml *xml, const char *name)
{
    for (int i = 0; i < xml->attribute_count; ++i)
        if (strcmp(xml->attributes[i].name, name) == 0)
            return xml->attributes[i].value;
    return NULL;
}

double track_xml_number(const track_xml *xml, const char *name)
{
    double number = NAN;
    const char *value = track_xml_attribute(xml, name);
    return value && track_number(value, &number) == TRACK_NUMBER ? number : NAN;
}
