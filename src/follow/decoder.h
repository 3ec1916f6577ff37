/* decoder.h - the frames of a film as gray pictures, one after another, by ffmpeg. */
#ifndef FST_FOLLOW_DECODER_H
#define FST_FOLLOW_DECODER_H

#include "follow/source.h"
#include "host/process.h"

typedef struct follow_decoder {
    const follow_source *source;
    fst_process child; /* ffmpeg */
    int width, height; /* of the pictures as they are meant to be shown; 0 before the first */
    unsigned char *pixels;
    int frame;             /* how many were read */
    unsigned char *buffer; /* what was read of the pipe and not yet used */
    size_t begin, end;
    int image; /* images handed over so far */
    char *image_bytes;
} follow_decoder;

/* Begin with the frames whose numbers `chosen` lists in rising order (NULL: all).  End with
 * follow_decoder_end(), after a failure too. */
fst_status follow_decoder_start(follow_decoder *decoder, const follow_source *source, const int *chosen,
                                int count, const fst_progress *progress, fst_error *error);

/* The next frame into decoder->pixels; *there is 0 at the end.  FST_BAD_INPUT: it has another size than the
 * frames before. */
fst_status follow_decoder_next(follow_decoder *decoder, int *there, fst_error *error);

/* Stop; `abandon` ends ffmpeg at once.  Returns whether ffmpeg ended well; child.said has its words. */
int follow_decoder_end(follow_decoder *decoder, int abandon);

#endif
