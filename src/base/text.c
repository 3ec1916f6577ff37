#include "base/text.h"

#include <string.h>

const char *fst_quote(const char *text, char quoted[FST_QUOTE_SIZE])
{
    const size_t longest = FST_QUOTE_SIZE - 6; /* two quotes, three dots, the final zero */
    size_t length = strlen(text);
    size_t shown = length < longest ? length : longest;
    /* A cut must not leave half of a UTF-8 character. */
    while (shown < length && shown > 0 && ((unsigned char)text[shown] & 0xC0U) == 0x80U)
        shown--;
    char *out = quoted;
    *out++ = '"';
    for (size_t i = 0; i < shown; i++) {
        unsigned char byte = (unsigned char)text[i];
        *out++ = byte < 0x20 || byte == 0x7F ? '?' : text[i];
    }
    if (shown < length) {
        memcpy(out, "...", 3);
        out += 3;
    }
    *out++ = '"';
    *out = '\0';
    return quoted;
}

const char *fst_trim(const char *text, size_t *length)
{
    const char *spaces = " \t\r\n";
    text += strspn(text, spaces);
    size_t end = strlen(text);
    while (end > 0 && strchr(spaces, text[end - 1]))
        end--;
    *length = end;
    return text;
}
