/* ffmpeg.h - an ffmpeg process that makes a film of frames. */
#ifndef FST_IO_FFMPEG_H
#define FST_IO_FFMPEG_H

#include <festoon/festoon.h>

#include "host/process.h"

/* What kind of film is made of which frames. */
typedef struct fst_ffmpeg_kind {
    int width, height;
    double fps;
    const char *format; /* "mp4", "mov", "gif", or "png", a picture of one frame */
    const char *pixels; /* "bgr0" (four bytes: blue, green, red, unused) or "gray" (one byte) */
    int quality;        /* of mp4 and mov: from 0, lossless, to 51 */
    int drop; /* every drop-th frame was lost before it came here, so the times jump there; 0: none was */
} fst_ffmpeg_kind;

/* Start ffmpeg on raw frames, which fst_process_write() hands over.  It writes to `out`, over any file there;
 * `name`, which is kept, stands for `out` in messages.  FST_UNAVAILABLE: there is no ffmpeg (the sentence names
 * the package). */
fst_status fst_ffmpeg_start(fst_process *film, const fst_ffmpeg_kind *kind, const char *out, const char *name,
                            fst_error *error);

/* End the frames, and wait until the film is whole.  Call it once after each start that went well, also after a
 * failure; with `abandon` the process is ended at once.  FST_IO: ffmpeg failed, and the sentence quotes it. */
fst_status fst_ffmpeg_end(fst_process *film, int abandon, fst_error *error);

#endif
