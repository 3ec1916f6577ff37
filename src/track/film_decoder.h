/* film_decoder.h - the frames of a film as gray pictures, one after another, by ffmpeg. */
#ifndef FST_TRACK_FILM_DECODER_H
#define FST_TRACK_FILM_DECODER_H

#include "track/child.h"
#include "track/film_source.h"

typedef struct track_decoder {
    const track_source *source;
    track_child child;
    int width, height; /* of the pictures as they are meant to be shown; 0 before the first */
    unsigned char *pixels;
    int frame;             /* how many were read */
    unsigned char *buffer; /* what was read of the pipe and not yet used */
    size_t begin, end;
    int image; /* images handed over so far */
    char *image_bytes;
} track_decoder;

/* Begin with the frames whose numbers `chosen` lists in rising order (NULL: all).  End with
 * track_decoder_end(), after a failure too. */
fst_status track_decoder_start(track_decoder *decoder, const track_source *source, const int *chosen, int count,
                               const fst_progress *progress, fst_error *error);

/* The next frame into decoder->pixels; *there is 0 at the end.  FST_BAD_INPUT: it has another size than the
 * frames before. */
fst_status track_decoder_next(track_decoder *decoder, int *there, fst_error *error);

/* Stop; `abandon` ends ffmpeg at once.  Returns whether ffmpeg ended well; child.said has its words. */
int track_decoder_end(track_decoder *decoder, int abandon);

#endif
