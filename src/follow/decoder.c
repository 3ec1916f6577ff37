/* decoder.c - ffmpeg as a process that turns a film into gray pictures.
 *
 * The pictures come as PGM ("P5", width, height, 255, then a byte a pixel): so their size is that after ffmpeg
 * has turned them as the film's rotation says.
 */
#include "follow/decoder.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/error.h"
#include "host/regular_file.h"

enum { ROOM = 1 << 18, MOST_PIXELS = 1 << 26, MOST_IMAGE = 1 << 28, CHOICE_SIZE = 24 };

/* ------------------------------------------------------------------ images into the process */

static fst_status feed_image(void *user, const unsigned char **bytes, size_t *size, fst_error *error)
{
    follow_decoder *d = (follow_decoder *)user;
    char path[8192];
    free(d->image_bytes);
    d->image_bytes = NULL;
    *size = 0;
    if (d->image == d->source->image_count)
        return FST_OK;
    if (snprintf(path, sizeof path, "%s/%s", d->source->path, d->source->images[d->image]) >= (int)sizeof path)
        return fst_fail(error, FST_BAD_INPUT, d->source->path, "the name of an image is too long");
    const fst_status status = fst_read_regular(path, MOST_IMAGE, &d->image_bytes, size, error);
    *bytes = (const unsigned char *)d->image_bytes;
    ++d->image;
    return status;
}

/* ------------------------------------------------------------------ the process */

/* "select='eq(n,3)+eq(n,17)'": ffmpeg then passes on these frames alone.  NULL: no memory. */
static char *choice(const int *chosen, int count)
{
    char *text = malloc((size_t)(count + 2) * CHOICE_SIZE);
    size_t length = 0;
    if (!text)
        return NULL;
    length += (size_t)snprintf(text, CHOICE_SIZE, "select='");
    for (int i = 0; i < count; ++i)
        length += (size_t)snprintf(text + length, CHOICE_SIZE, "%seq(n,%d)", i ? "+" : "", chosen[i]);
    (void)snprintf(text + length, CHOICE_SIZE, "'");
    return text;
}

fst_status follow_decoder_start(follow_decoder *decoder, const follow_source *source, const int *chosen,
                                int count, const fst_progress *progress, fst_error *error)
{
    *decoder = (follow_decoder){.source = source, .child = {.progress = progress, .user = decoder}};
    decoder->buffer = malloc(ROOM);
    char *filter = chosen ? choice(chosen, count) : strdup("null");
    fst_status status =
        decoder->buffer && filter ? FST_OK : fst_fail(error, FST_NO_MEMORY, source->path, "no memory");
    const int images = source->descriptor < 0;
    decoder->child.feed = images ? feed_image : NULL;
    const char *const arguments[] = {"ffmpeg",
                                     "-nostdin",
                                     "-hide_banner",
                                     "-loglevel",
                                     "error",
                                     "-protocol_whitelist",
                                     FOLLOW_PROTOCOLS,
                                     images ? "-f" : "-format_whitelist",
                                     images ? source->demuxer : FOLLOW_FORMATS,
                                     "-i",
                                     images ? "pipe:0" : FOLLOW_FILM_URL,
                                     "-map",
                                     "0:v:0",
                                     "-fps_mode",
                                     "passthrough",
                                     "-vf",
                                     filter,
                                     "-pix_fmt",
                                     "gray",
                                     "-c:v",
                                     "pgm",
                                     "-f",
                                     "image2pipe",
                                     "pipe:1",
                                     NULL};
    const fst_program program = {.arguments = arguments,
                                 .input = images ? FST_INPUT_FED : source->descriptor,
                                 .is_read = 1,
                                 .purpose = "films are read by ffmpeg",
                                 .package = "ffmpeg"};
    if (status == FST_OK)
        status = fst_process_start(&decoder->child, &program, "track", error);
    free(filter);
    return status;
}

/* ------------------------------------------------------------------ pictures out of it */

/* More bytes into the buffer; 0 at the end. */
static fst_status refill(follow_decoder *d, fst_error *error)
{
    d->begin = 0;
    return fst_process_read(&d->child, d->buffer, ROOM, &d->end, error);
}

static fst_status next_byte(follow_decoder *d, int *byte, fst_error *error)
{
    if (d->begin == d->end) {
        const fst_status status = refill(d, error);
        if (status != FST_OK)
            return status;
    }
    *byte = d->begin < d->end ? d->buffer[d->begin++] : EOF;
    return FST_OK;
}

/* The head of a picture; *there is 0 where no other picture comes. */
static fst_status read_head(follow_decoder *d, int *width, int *height, int *there, fst_error *error)
{
    char head[64];
    size_t length = 0;
    int lines = 0, most;
    *there = 0;
    while (lines < 3 && length + 1 < sizeof head) {
        int byte;
        const fst_status status = next_byte(d, &byte, error);
        if (status != FST_OK || byte == EOF)
            return status;
        head[length++] = (char)byte;
        lines += byte == '\n';
    }
    head[length] = '\0';
    if (sscanf(head, "P5 %6d %6d %6d", width, height, &most) != 3 || most != 255 || *width < 1 || *height < 1)
        return fst_fail(error, FST_IO, d->source->path, "ffmpeg made no gray pictures of it");
    if ((int64_t)*width * *height > MOST_PIXELS)
        return fst_fail(error, FST_BAD_INPUT, d->source->path, "pictures of %d x %d pixels are too large",
                        *width, *height);
    *there = 1;
    return FST_OK;
}

fst_status follow_decoder_next(follow_decoder *decoder, int *there, fst_error *error)
{
    int width = 0, height = 0;
    fst_status status = read_head(decoder, &width, &height, there, error);
    if (status != FST_OK || !*there)
        return status;
    const size_t size = (size_t)width * (size_t)height;
    if (!decoder->pixels) {
        decoder->width = width;
        decoder->height = height;
        decoder->pixels = malloc(size);
        if (!decoder->pixels)
            return fst_fail(error, FST_NO_MEMORY, decoder->source->path, "no memory for a picture");
    }
    if (width != decoder->width || height != decoder->height)
        return fst_fail(error, FST_BAD_INPUT, decoder->source->path,
                        "frame %d has %d x %d pixels, and those before have %d x %d", decoder->frame, width,
                        height, decoder->width, decoder->height);
    for (size_t done = 0; done < size;) {
        if (decoder->begin == decoder->end) {
            status = refill(decoder, error);
            if (status != FST_OK)
                return status;
            if (decoder->end == 0) {
                *there = 0; /* ffmpeg ended within a picture: it does not count */
                return FST_OK;
            }
        }
        const size_t have = decoder->end - decoder->begin, take = have < size - done ? have : size - done;
        memcpy(decoder->pixels + done, decoder->buffer + decoder->begin, take);
        decoder->begin += take;
        done += take;
    }
    ++decoder->frame;
    return FST_OK;
}

int follow_decoder_end(follow_decoder *decoder, int abandon)
{
    const int well = decoder->child.pid > 0 && fst_process_end(&decoder->child, abandon, NULL) == FST_OK;
    free(decoder->pixels);
    free(decoder->buffer);
    free(decoder->image_bytes);
    decoder->pixels = decoder->buffer = NULL;
    decoder->image_bytes = NULL;
    return well;
}
