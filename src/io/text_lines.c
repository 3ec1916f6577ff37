/* text_lines.c - text files of any encoding as lines of UTF-8: what text_table.c cuts into cells, and XML is
 * read from. */
#include "io/text_table.h"

#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/error.h"
#include "host/regular_file.h"

fst_status fst_text_fail(const char *path, size_t line, fst_error *error, const char *format, ...)
{
    char where[256], sentence[600];
    va_list values;
    va_start(values, format);
    (void)vsnprintf(sentence, sizeof sentence, format, values);
    va_end(values);
    (void)snprintf(where, sizeof where, "%.220s:%zu", path, line);
    return fst_fail(error, FST_BAD_INPUT, where, "%s", sentence);
}

/* ---------------------------------------------------------------- encodings */

static size_t put_utf8(char *to, unsigned code)
{
    if (code < 0x80) {
        to[0] = (char)code;
        return 1;
    }
    if (code < 0x800) {
        to[0] = (char)(0xc0 | code >> 6);
        to[1] = (char)(0x80 | (code & 0x3f));
        return 2;
    }
    to[0] = (char)(0xe0 | code >> 12);
    to[1] = (char)(0x80 | (code >> 6 & 0x3f));
    to[2] = (char)(0x80 | (code & 0x3f));
    return 3;
}

/* Whether bytes are UTF-8: each leading byte is followed by as many further bytes as it says. */
static int is_utf8(const unsigned char *bytes, size_t size)
{
    for (size_t i = 0; i < size;) {
        const unsigned char c = bytes[i++];
        const int more = c < 0x80                ? 0
                         : c >= 0xc2 && c < 0xe0 ? 1
                         : (c & 0xf0) == 0xe0    ? 2
                         : (c & 0xf8) == 0xf0    ? 3
                                                 : -1;
        if (more < 0 || i + (size_t)more > size)
            return 0;
        for (int k = 0; k < more; ++k)
            if ((bytes[i++] & 0xc0) != 0x80)
                return 0;
    }
    return 1;
}

/* Copy to UTF-8 what is UTF-16 (by its byte order mark) or Latin-1; `to` has room for 3 bytes for each of the
 * source.  Returns the length. */
static size_t to_utf8(char *to, const unsigned char *bytes, size_t size)
{
    size_t length = 0;
    const int little = size >= 2 && bytes[0] == 0xff && bytes[1] == 0xfe;
    const int big = size >= 2 && bytes[0] == 0xfe && bytes[1] == 0xff;
    if (little || big) /* what lies beyond 16 bits is in no number and no known name */
        for (size_t i = 2; i + 1 < size; i += 2) {
            const unsigned code = (unsigned)bytes[i + (size_t)big] | (unsigned)bytes[i + (size_t)little] << 8;
            length += put_utf8(to + length, code >= 0xd800 && code < 0xe000 ? '?' : code);
        }
    else /* Latin-1: a byte is its own number */
        for (size_t i = 0; i < size; ++i)
            length += put_utf8(to + length, bytes[i]);
    return length;
}

/* ---------------------------------------------------------------- lines */

/* Cut the bytes into lines, at "\n", "\r\n" or a lone "\r". */
static fst_status cut_lines(fst_text *text, fst_error *error)
{
    size_t count = 1;
    for (size_t i = 0; i < text->size; ++i)
        count += text->bytes[i] == '\n' || text->bytes[i] == '\r';
    text->lines = malloc(count * sizeof *text->lines);
    if (!text->lines)
        return fst_fail(error, FST_NO_MEMORY, text->path, "no memory for %zu lines", count);
    char *start = text->bytes;
    if (text->size >= 3 && memcmp(start, "\xef\xbb\xbf", 3) == 0)
        start += 3; /* the byte order mark */
    for (size_t i = 0; i < text->size; ++i) {
        char *c = &text->bytes[i];
        if (*c == '\0') /* would end the line for the C library */
            *c = '?';
        if (*c != '\n' && *c != '\r')
            continue;
        if (*c == '\r' && i + 1 < text->size && c[1] == '\n')
            *c++ = '\0', ++i;
        *c = '\0';
        text->lines[text->count++] = start;
        start = c + 1;
    }
    if (*start)
        text->lines[text->count++] = start;
    return FST_OK;
}

/* Make lines of bytes that are ours, with a zero behind them. */
static fst_status take_over(fst_text *text, const char *path, char *bytes, size_t size, fst_error *error)
{
    *text = (fst_text){.path = path, .bytes = bytes, .size = size};
    if (!bytes)
        return fst_fail(error, FST_NO_MEMORY, path, "no memory for this file");
    if (!is_utf8((const unsigned char *)bytes, size)) {
        char *longer = malloc(3 * size + 1);
        if (!longer)
            return fst_fail(error, FST_NO_MEMORY, path, "no memory for this file");
        text->size = to_utf8(longer, (const unsigned char *)bytes, size);
        longer[text->size] = '\0';
        free(bytes);
        text->bytes = longer;
    }
    return cut_lines(text, error);
}

fst_status fst_text_take(fst_text *text, const char *path, const char *bytes, size_t size, fst_error *error)
{
    char *copy = malloc(size + 1);
    if (copy) {
        memcpy(copy, bytes, size);
        copy[size] = '\0';
    }
    return take_over(text, path, copy, size, error);
}

fst_status fst_text_read(fst_text *text, const char *path, size_t most, fst_error *error)
{
    char *bytes = NULL;
    size_t size;
    *text = (fst_text){.path = path};
    const fst_status status = fst_read_regular(path, most, &bytes, &size, error);
    return status == FST_OK ? take_over(text, path, bytes, size, error) : status;
}

void fst_text_free(fst_text *text)
{
    free(text->lines);
    free(text->bytes);
    *text = (fst_text){0};
}
