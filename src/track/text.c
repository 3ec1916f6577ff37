/* text.c - reading text.h's tables: encodings, line ends, cells, numbers. */
#include "track/text.h"

#include <ctype.h>
#include <math.h>
#include <stdarg.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/error.h"
#include "base/number.h"
#include "base/text.h"
#include "host/regular_file.h"

#define MOST_BYTES                                                                                             \
    ((size_t)256 << 20) /* of a file: a day of film at 200 frames a second takes about as much                 \
                         */

fst_status track_fail_line(const char *path, size_t line, fst_error *error, const char *format, ...)
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

/* Copy to UTF-8; `to` has room for 3 bytes for each of the source.  Returns the length. */
static size_t to_utf8(char *to, const unsigned char *bytes, size_t size)
{
    size_t length = 0;
    const int little = size >= 2 && bytes[0] == 0xff && bytes[1] == 0xfe;
    const int big = size >= 2 && bytes[0] == 0xfe && bytes[1] == 0xff;
    if (little || big) { /* UTF-16; what lies beyond 16 bits is in no number and no known name */
        for (size_t i = 2; i + 1 < size; i += 2) {
            const unsigned code = (unsigned)bytes[i + (size_t)big] | (unsigned)bytes[i + (size_t)little] << 8;
            length += put_utf8(to + length, code >= 0xd800 && code < 0xe000 ? '?' : code);
        }
        return length;
    }
    if (is_utf8(bytes, size)) {
        memcpy(to, bytes, size);
        return size;
    }
    for (size_t i = 0; i < size; ++i) /* Latin-1: a byte is its own number */
        length += put_utf8(to + length, bytes[i]);
    return length;
}

/* ---------------------------------------------------------------- lines */

/* Cut the bytes into lines, at "\n", "\r\n" or a lone "\r". */
static fst_status cut_lines(track_text *text, size_t size, fst_error *error)
{
    size_t count = 1;
    for (size_t i = 0; i < size; ++i)
        count += text->bytes[i] == '\n' || text->bytes[i] == '\r';
    text->lines = malloc(count * sizeof *text->lines);
    if (!text->lines)
        return fst_fail(error, FST_NO_MEMORY, text->path, "no memory for %zu lines", count);
    char *start = text->bytes;
    for (size_t i = 0; i < size; ++i) {
        char *c = &text->bytes[i];
        if (*c == '\0') /* would end the line for the C library */
            *c = '?';
        if (*c != '\n' && *c != '\r')
            continue;
        if (*c == '\r' && i + 1 < size && c[1] == '\n')
            *c++ = '\0', ++i;
        *c = '\0';
        text->lines[text->count++] = start;
        start = c + 1;
    }
    if (*start)
        text->lines[text->count++] = start;
    return FST_OK;
}

fst_status track_text_take(track_text *text, const char *path, const char *bytes, size_t size, fst_error *error)
{
    *text = (track_text){.path = path};
    text->bytes = malloc(3 * size + 1);
    if (!text->bytes)
        return fst_fail(error, FST_NO_MEMORY, path, "no memory for this file");
    const size_t length = to_utf8(text->bytes, (const unsigned char *)bytes, size);
    text->bytes[length] = '\0';
    text->size = length;
    if (length >= 3 && memcmp(text->bytes, "\xef\xbb\xbf", 3) == 0)
        memset(text->bytes, ' ', 3); /* the byte order mark */
    return cut_lines(text, length, error);
}

fst_status track_text_read(track_text *text, const char *path, fst_error *error)
{
    char *bytes = NULL;
    size_t size;
    *text = (track_text){.path = path};
    fst_status status = fst_read_regular(path, MOST_BYTES, &bytes, &size, error);
    if (status == FST_OK)
        status = track_text_take(text, path, bytes, size, error);
    free(bytes);
    return status;
}

void track_text_free(track_text *text)
{
    free(text->lines);
    free(text->bytes);
    *text = (track_text){0};
}

/* ---------------------------------------------------------------- cells */

void track_cells_free(track_cells *cells)
{
    free(cells->memory);
    *cells = (track_cells){0};
}

static int is_blank(char c)
{
    return c == ' ' || c == '\t';
}

/* Where the cell that begins at `at` ends. */
static char *end_of_cell(char *at, char separator)
{
    int quoted = 0;
    for (; *at; ++at) {
        quoted ^= *at == '"';
        if (!quoted && (separator == ' ' ? is_blank(*at) : *at == separator))
            break;
    }
    return at;
}

/* Strip blanks and one pair of quotes. */
static char *stripped(char *from, char *to)
{
    for (int again = 0; again < 2; ++again) {
        while (from < to && is_blank(*from))
            ++from;
        while (to > from && is_blank(to[-1]))
            --to;
        if (again || to - from < 2 || *from != '"' || to[-1] != '"')
            break;
        ++from;
        --to;
    }
    *to = '\0';
    return from;
}

fst_status track_split(track_cells *cells, const char *line, char separator, fst_error *error)
{
    const size_t size = strlen(line) + 1;
    cells->count = 0;
    if (size > cells->room) {
        char *longer = realloc(cells->memory, 2 * size);
        if (!longer)
            return fst_fail(error, FST_NO_MEMORY, "", "no memory for a line");
        cells->memory = longer;
        cells->room = 2 * size;
    }
    memcpy(cells->memory, line, size);
    char *at = cells->memory;
    if (separator == ' ') {
        at += strspn(at, " \t");
        if (!*at)
            return FST_OK;
    }
    for (;;) {
        char *end = end_of_cell(at, separator);
        const int last = !*end;
        char *next = end + 1;
        if (!last && separator == ' ')
            next += strspn(next, " \t");
        if (cells->count < TRACK_MOST_CELLS)
            cells->cell[cells->count++] = stripped(at, end);
        if (last || (separator == ' ' && !*next))
            return FST_OK;
        at = next;
    }
}

char track_separator_of(const char *line)
{
    static const char candidates[] = "\t;,";
    int best = 0, count[3] = {0}, quoted = 0, depth = 0;
    for (; *line; ++line) {
        quoted ^= *line == '"';
        depth += (*line == '[' || *line == '(') - ((*line == ']' || *line == ')') && depth > 0);
        const char *found = quoted || depth ? NULL : strchr(candidates, *line);
        if (found)
            ++count[found - candidates];
    }
    for (int i = 1; i < 3; ++i)
        best = count[i] > count[best] ? i : best;
    return count[best] ? candidates[best] : ' ';
}

/* ---------------------------------------------------------------- numbers and names */

/* Copy a cell with plain signs: '-' for U+2212, '.' for a decimal comma, no non-breaking blanks at all. */
static int plain_number(const char *cell, char plain[64])
{
    size_t length = 0;
    for (const char *c = cell; *c;) {
        if (length + 2 > 64)
            return 0;
        if (strncmp(c, "\xe2\x88\x92", 3) == 0) {
            plain[length++] = '-';
            c += 3;
        } else if (strncmp(c, "\xc2\xa0", 2) == 0) {
            c += 2;
        } else if (strncmp(c, "\xe2\x80\xaf", 3) == 0) { /* the narrow form */
            c += 3;
        } else {
            plain[length++] = *c == ',' ? '.' : *c;
            ++c;
        }
    }
    plain[length] = '\0';
    return 1;
}

track_value_kind track_number(const char *cell, double *value)
{
    static const char *const nothing[] = {"", "nan", "+nan", "-nan", "na", "n/a", "null", "none", "-"};
    char plain[64], small[64];
    *value = NAN;
    if (!plain_number(cell, plain))
        return TRACK_WORD;
    for (size_t i = 0; i == 0 || plain[i - 1]; ++i)
        small[i] = (char)tolower((unsigned char)plain[i]);
    for (size_t i = 0; i < sizeof nothing / sizeof *nothing; ++i)
        if (strcmp(small, nothing[i]) == 0)
            return TRACK_NOTHING;
    const char *from = plain + (plain[0] == '+');
    const size_t length = fst_number_length(from);
    if (length == 0 || from[length])
        return TRACK_WORD;
    const double number = fst_number_read(from, length, 0);
    if (!isfinite(number))
        return TRACK_WORD;
    *value = number;
    return TRACK_NUMBER;
}

void track_column_of(const char *cell, track_column *column)
{
    *column = (track_column){"", ""};
    const char *open = strpbrk(cell, "[(");
    size_t length = open ? (size_t)(open - cell) : strlen(cell);
    while (length > 0 && is_blank(cell[length - 1]))
        --length;
    if (length >= sizeof column->name)
        length = sizeof column->name - 1;
    for (size_t i = 0; i < length; ++i)
        column->name[i] = (char)tolower((unsigned char)cell[i]);
    column->name[length] = '\0';
    static const char *const units[] = {"_px", "_um", "_mm", "_cm", "_m", "_s", "_ms"};
    for (size_t i = 0; !open && i < sizeof units / sizeof *units; ++i) {
        const size_t ending = strlen(units[i]);
        if (length > ending && strcmp(column->name + length - ending, units[i]) == 0) {
            column->name[length - ending] = '\0';
            (void)snprintf(column->unit, sizeof column->unit, "%s", units[i] + 1);
            break;
        }
    }
    if (open) {
        const size_t unit = strcspn(open + 1, "])");
        (void)snprintf(column->unit, sizeof column->unit, "%.*s", (int)(unit < 31 ? unit : 31), open + 1);
    }
}
