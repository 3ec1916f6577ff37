/* printed.c - a text that is collected by printing, whole or not at all. */
/* fopencookie() is an extension of the C library. */
#define _GNU_SOURCE
#include <festoon/festoon_tools.h>

#include <stdlib.h>
#include <string.h>

enum { ROOM = 4096 }; /* of the text at first, and of the stream's buffer before it */

static ssize_t collect(void *cookie, const char *bytes, size_t size)
{
    fst_printed *printed = cookie;
    while (!printed->failed && printed->room - printed->size <= size) {
        char *longer = realloc(printed->text, 2 * printed->room);
        printed->failed = !longer;
        printed->text = longer ? longer : printed->text;
        printed->room *= longer ? 2 : 1;
    }
    if (printed->failed)
        return 0;
    memcpy(printed->text + printed->size, bytes, size);
    printed->size += size;
    return (ssize_t)size;
}

FILE *fst_print_begin(fst_printed *printed)
{
    *printed = (fst_printed){.text = malloc(ROOM), .buffer = malloc(ROOM), .room = ROOM};
    if (printed->text && printed->buffer)
        printed->stream = fopencookie(printed, "w", (cookie_io_functions_t){.write = collect});
    if (printed->stream) {
        (void)setvbuf(printed->stream, printed->buffer, _IOFBF, ROOM);
    } else {
        free(printed->text);
        free(printed->buffer);
    }
    return printed->stream;
}

char *fst_print_end(fst_printed *printed)
{
    if (!printed->stream)
        return NULL;
    const int refused = ferror(printed->stream), closed = fclose(printed->stream) == 0;
    char *text = printed->text;
    free(printed->buffer);
    printed->stream = NULL;
    if (refused || !closed || printed->failed) {
        free(text);
        return NULL;
    }
    text[printed->size] = '\0';
    return text;
}
