/* ffmpeg.h - an ffmpeg process that turns frames into a film. */
#ifndef FST_FILM_FFMPEG_H
#define FST_FILM_FFMPEG_H

#include <festoon/festoon.h>

#include <sys/types.h>

typedef struct fst_ffmpeg {
    pid_t child;
    int frames;       /* socket to its standard input */
    int words;        /* pipe from its standard error */
    const char *name; /* of the film in messages */
    char said[512];   /* the beginning of its words */
    size_t said_size;
} fst_ffmpeg;

/* Start ffmpeg on raw frames of width x height pixels (four bytes each: blue, green, red, unused), writing the
 * format "mp4" or "gif" to `out`, over what is there; `name`, which is kept, stands for it in messages.
 * FST_UNAVAILABLE: no ffmpeg (the sentence names the package). */
fst_status fst_ffmpeg_start(fst_ffmpeg *film, int width, int height, double fps, const char *format,
                            const char *out, const char *name, fst_error *error);

/* Hand over one frame's bytes.  FST_IO: ffmpeg is gone; fst_ffmpeg_end() tells why. */
fst_status fst_ffmpeg_frame(fst_ffmpeg *film, const unsigned char *bytes, size_t size, fst_error *error);

/* No more frames: wait until the film is whole.  Called once after a start that went well, whatever happened
 * then; with `abandon` the process is ended at once.  FST_IO: it failed, with its own words. */
fst_status fst_ffmpeg_end(fst_ffmpeg *film, int abandon, fst_error *error);

#endif
