/* text.c - text from outside, made harmless for terminals, figures and pages, and quoted for messages. */
#include "base/text.h"

#include <string.h>

/* The length of the UTF-8 character at `text`, and its number; 0 where there is none (stray or missing bytes,
 * forms longer than needed, surrogates). */
static size_t character_at(const unsigned char *text, unsigned long *number)
{
    static const struct {
        unsigned char mask, mark;
        unsigned long least;
    } forms[] = {{0x80, 0x00, 0}, {0xE0, 0xC0, 0x80}, {0xF0, 0xE0, 0x800}, {0xF8, 0xF0, 0x10000}};
    for (size_t more = 0; more < sizeof forms / sizeof *forms; ++more) {
        if ((text[0] & forms[more].mask) != forms[more].mark)
            continue;
        *number = text[0] & (unsigned char)~forms[more].mask;
        for (size_t i = 1; i <= more; ++i) {
            if ((text[i] & 0xC0U) != 0x80U)
                return 0;
            *number = *number << 6 | (text[i] & 0x3FU);
        }
        const int valid =
            *number >= forms[more].least && *number <= 0x10FFFF && !(*number >= 0xD800 && *number <= 0xDFFF);
        return valid ? more + 1 : 0;
    }
    return 0;
}

/* Characters that a terminal may obey, or that make a line look like another one. */
static int is_wild(unsigned long c)
{
    return c < 0x20 || (c >= 0x7F && c <= 0x9F) || (c >= 0x200E && c <= 0x200F) ||
           (c >= 0x2028 && c <= 0x202E) || (c >= 0x2066 && c <= 0x2069) || c == 0xFEFF;
}

void fst_text_tame(char *text)
{
    char *out = text;
    for (const char *in = text; *in;) {
        unsigned long number = 0;
        const size_t length = character_at((const unsigned char *)in, &number);
        if (length == 0 || is_wild(number)) {
            *out++ = '?';
            in += length ? length : 1;
            continue;
        }
        for (size_t i = 0; i < length; ++i)
            *out++ = *in++;
    }
    *out = '\0';
}

const char *fst_quote(const char *text, char quoted[FST_QUOTE_SIZE])
{
    const size_t longest = FST_QUOTE_SIZE - 6; /* room for two quotes, three dots and the final zero */
    size_t length = strlen(text);
    size_t shown = length < longest ? length : longest;
    /* A cut must not leave half of a UTF-8 character. */
    while (shown < length && shown > 0 && ((unsigned char)text[shown] & 0xC0U) == 0x80U)
        --shown;
    quoted[0] = '"';
    memcpy(quoted + 1, text, shown);
    quoted[1 + shown] = '\0';
    fst_text_tame(quoted);
    memcpy(quoted + strlen(quoted), shown < length ? "...\"" : "\"", shown < length ? 5 : 2);
    return quoted;
}

const char *fst_trim(const char *text, size_t *length)
{
    const char *spaces = " \t\r\n";
    text += strspn(text, spaces);
    size_t end = strlen(text);
    while (end > 0 && strchr(spaces, text[end - 1]))
        --end;
    *length = end;
    return text;
}

const char *fst_name_at(const char *names, int place, size_t *length)
{
    names = place < 0 ? "" : names;
    for (int at = 0; at < place; ++at) {
        names += strcspn(names, "|");
        names += *names == '|';
    }
    *length = strcspn(names, "|");
    return names;
}

int fst_ends_in(const char *name, const char *ending)
{
    const size_t length = strlen(name), wanted = strlen(ending);
    return length > wanted && strcmp(name + length - wanted, ending) == 0;
}
