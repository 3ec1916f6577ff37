/* read.c - fst_track_read(): which format a file has, and the reader of that format. */
#include "track/raw.h"

#include <string.h>

#include "base/error.h"
#include "base/text.h"

enum { OPTIONS_COOKIE = 0x5452414b };

fst_track_options fst_default_track_options(void)
{
    return (fst_track_options){.cookie = OPTIONS_COOKIE, .fps = NAN, .scale = NAN};
}

const char *fst_track_formats(void)
{
    return "festoon";
}

/* The first line that is neither blank nor a comment; text->count where there is none. */
static size_t first_line(const track_text *text)
{
    size_t i = 0;
    while (i < text->count && (!text->lines[i][strspn(text->lines[i], " \t")] || text->lines[i][0] == '#'))
        ++i;
    return i;
}

fst_status fst_track_read(const char *path, const fst_track_options *options, fst_track *track,
                          char **understood, fst_error *error)
{
    track_text text;
    track_raw raw;
    *track = (fst_track){0};
    if (options->cookie != OPTIONS_COOKIE)
        return fst_fail(error, FST_BAD_INPUT, "fst_track_read",
                        "the options were not made by fst_default_track_options()");
    track_raw_begin(&raw, "a table with named columns");
    fst_status status = track_text_read(&text, path, error);
    const size_t header = status == FST_OK ? first_line(&text) : 0;
    if (status == FST_OK && header == text.count)
        status = fst_fail(error, FST_BAD_INPUT, path, "the file is empty");
    if (status == FST_OK)
        status = track_read_columns(&text, header, &raw, error);
    if (status == FST_OK)
        status = track_choose(&raw, path, options, track, understood, error);
    track_raw_free(&raw);
    track_text_free(&text);
    return status;
}
