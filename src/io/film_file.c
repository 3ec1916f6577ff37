/* film_file.c - checking the structure of a film, because ffmpeg may report success on a full disk.
 *
 * An mp4 is a row of boxes, [size][type][contents], that fill the file exactly.  The box `moov` says where in
 * `mdat` each picture lies and how long it is.  It is written last, so a film that was cut short has none, or
 * one that counts more than there is.
 *
 *      ftyp | moov { trak { mdia { minf { stbl { stsz: sizes of pictures } } } } } | free | mdat: pictures
 *
 * A GIF is a row of blocks that ends with the byte 0x3B.
 */
#include "io/film_file.h"

#include <errno.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/error.h"

enum { MOST_MOOV = 1 << 28 };

/* ------------------------------------------------------------------ mp4 */

typedef struct mp4 {
    uint64_t size; /* the size of the file */
    int has_ftyp;
    uint64_t mdat; /* bytes of pictures; 0: there are none */
    unsigned char *moov;
    uint64_t moov_size;
    int64_t pictures; /* -1: there is no table of them */
    uint64_t picture_bytes;
} mp4;

static uint32_t number32(const unsigned char *at)
{
    return (uint32_t)at[0] << 24 | (uint32_t)at[1] << 16 | (uint32_t)at[2] << 8 | at[3];
}

/* Read the head of the box at `at`: its type, its whole size, and the size of the head; 0: there is no box. */
static int read_head(FILE *in, uint64_t at, uint64_t end, char type[5], uint64_t *size, uint64_t *head)
{
    unsigned char bytes[16];
    if (end - at < 8 || fseek(in, (long)at, SEEK_SET) != 0 || fread(bytes, 1, 8, in) != 8)
        return 0;
    memcpy(type, bytes + 4, 4);
    type[4] = '\0';
    *size = number32(bytes);
    *head = 8;
    if (*size == 1) {
        if (fread(bytes + 8, 1, 8, in) != 8)
            return 0;
        *size = (uint64_t)number32(bytes + 8) << 32 | number32(bytes + 12);
        *head = 16;
    }
    return *size >= *head && *size <= end - at;
}

/* Walk through the boxes of the file.  Returns what is wrong, or NULL. */
static const char *read_boxes(FILE *in, mp4 *film)
{
    char type[5];
    uint64_t size, head;
    for (uint64_t at = 0; at < film->size; at += size) {
        if (!read_head(in, at, film->size, type, &size, &head))
            return "it is cut short";
        if (strcmp(type, "ftyp") == 0) {
            film->has_ftyp = 1;
        } else if (strcmp(type, "mdat") == 0) {
            film->mdat += size - head;
        } else if (strcmp(type, "moov") == 0 && !film->moov && size - head <= MOST_MOOV) {
            film->moov_size = size - head;
            film->moov = malloc((size_t)film->moov_size + 1);
            if (!film->moov || fread(film->moov, 1, (size_t)film->moov_size, in) != film->moov_size)
                return "its index cannot be read";
        }
    }
    return !film->has_ftyp ? "it has no head" : !film->moov ? "it has no index" : NULL;
}

/* Find the table of the sizes of pictures, within the boxes that contain it. */
static void find_table(mp4 *film, const unsigned char *bytes, uint64_t size)
{
    static const char *const holders[] = {"trak", "mdia", "minf", "stbl"};
    for (uint64_t at = 0; at + 8 <= size;) {
        const uint64_t box = number32(bytes + at);
        const unsigned char *inside = bytes + at + 8;
        if (box < 8 || box > size - at)
            return;
        for (size_t i = 0; i < sizeof holders / sizeof *holders; ++i)
            if (memcmp(bytes + at + 4, holders[i], 4) == 0)
                find_table(film, inside, box - 8);
        if (memcmp(bytes + at + 4, "stsz", 4) == 0 && box >= 20) {
            const uint32_t each = number32(inside + 4), count = number32(inside + 8);
            film->pictures = count;
            film->picture_bytes = (uint64_t)each * count;
            for (uint64_t i = 0; each == 0 && i < count && 20 + 4 * (i + 1) <= box; ++i)
                film->picture_bytes += number32(inside + 12 + 4 * i);
        }
        at += box;
    }
}

static const char *check_mp4(FILE *in, uint64_t size, int frames)
{
    mp4 film = {.size = size, .pictures = -1};
    const char *problem = read_boxes(in, &film);
    if (!problem) {
        find_table(&film, film.moov, film.moov_size);
        if (film.pictures != frames)
            problem = "pictures are missing";
        else if (film.picture_bytes == 0 || film.picture_bytes > film.mdat)
            problem = "the pictures themselves are missing";
    }
    free(film.moov);
    return problem;
}

/* ------------------------------------------------------------------ gif */

static int skip(FILE *in, long bytes)
{
    return fseek(in, bytes, SEEK_CUR) == 0;
}

/* The bytes of the colour table that a packed field announces. */
static long table_size(int packed)
{
    return packed & 0x80 ? 3L << ((packed & 7) + 1) : 0;
}

/* Skip sub-blocks up to the empty one; 0 where the file ends before. */
static int skip_blocks(FILE *in)
{
    for (int size = fgetc(in); size != 0; size = fgetc(in))
        if (size == EOF || !skip(in, size))
            return 0;
    return 1;
}

static const char *check_gif(FILE *in)
{
    unsigned char head[13], image[9];
    static const char *const cut = "it is cut short";
    int images = 0;
    if (fread(head, 1, sizeof head, in) != sizeof head || memcmp(head, "GIF89a", 6) != 0 ||
        !skip(in, table_size(head[10])))
        return "it has no head";
    for (int kind = fgetc(in); kind != 0x3B; kind = fgetc(in)) {
        if (kind == 0x21) {
            if (fgetc(in) == EOF || !skip_blocks(in))
                return cut;
        } else if (kind == 0x2C) {
            if (fread(image, 1, sizeof image, in) != sizeof image || !skip(in, table_size(image[8]) + 1) ||
                !skip_blocks(in))
                return cut;
            ++images;
        } else {
            return cut;
        }
    }
    return images == 0 ? "it has no picture" : fgetc(in) != EOF ? "there is something after its end" : NULL;
}

/* ------------------------------------------------------------------ */

fst_status fst_film_file_check(const char *path, const char *format, int frames, const char *name,
                               fst_error *error)
{
    FILE *in = fopen(path, "rb");
    const char *problem = NULL;
    if (!in)
        return fst_fail(error, FST_IO, name, "ffmpeg left no film: %s", strerror(errno));
    const long size = fseek(in, 0, SEEK_END) == 0 ? ftell(in) : -1;
    rewind(in);
    if (size <= 0)
        problem = "it is empty";
    else
        problem = strcmp(format, "gif") == 0 ? check_gif(in) : check_mp4(in, (uint64_t)size, frames);
    (void)fclose(in);
    return problem ? fst_fail(error, FST_IO, name, "ffmpeg left an incomplete film (%s): is the disk full?",
                              problem)
                   : FST_OK;
}
