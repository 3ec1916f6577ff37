/* source.h - a film, or a folder of images, before it is looked at: how many frames, and when.
 *
 * Names of files never reach ffmpeg: a film is its standard input (file:/dev/fd/0), and images are handed to it
 * one after another through a pipe.  So no name can be taken for an option, a pattern or a protocol.
 */
#ifndef FST_FOLLOW_SOURCE_H
#define FST_FOLLOW_SOURCE_H

#include <festoon/festoon_tools.h>

typedef struct follow_source {
    const char *path;         /* the caller's */
    int descriptor;           /* of the film; -1: a folder of images */
    char **images;            /* the names of the images, in the order of the film */
    int image_count, skipped; /* images, and other files in the folder */
    const char *demuxer;      /* of the images: "png_pipe" */
    double *times;            /* s, of each frame; NULL where the film has no clock */
    int frames, announced;    /* counted by decoding them; as the film's head says, 0: it does not */
    double tick;              /* of the film's clock, s; 0: unknown */
    /* Frames a second at which the film says that it was taken, and at which it is stored, where its clock was
     * corrected for that; 0: it was not. */
    double taken_fps, stored_fps;
    char format[64], codec[64]; /* as ffprobe calls them, for a person */
} follow_source;

/* Look at a film: count its frames and read their times, by decoding it once.  `fps` (NAN: the film's own
 * clock) makes the times instead.  FST_BAD_INPUT: it is not a film, or has no clock; FST_UNAVAILABLE: there is no
 * ffprobe. Free with follow_source_close() after a failure too. */
fst_status follow_source_open(follow_source *source, const char *path, double fps, const fst_progress *progress,
                              fst_error *error);
void follow_source_close(follow_source *source);

/* Options that every use of ffmpeg and ffprobe here begins with: which protocols and formats may be read. */
#define FOLLOW_PROTOCOLS "file,pipe"
#define FOLLOW_FORMATS                                                                                         \
    "mov,mp4,m4a,3gp,3g2,mj2,matroska,webm,avi,gif,apng,mpegts,mpeg,flv,asf,ogg,nut,mjpeg,h264,hevc,ivf,mxf,"  \
    "dv"
#define FOLLOW_FILM_URL "file:/dev/fd/0"

#endif
