/* raw.h - what a file of tracks holds, before it is known which of its tracks is wanted.
 *
 *   file --> read.c ------> read_columns.c --> track_raw --> choose.c --> fst_track
 *            which format  or another reader  spots of      one track, in order, in the wanted unit,
 *                                           all tracks    with a clock, y up
 *
 * A reader of a format copies numbers as they stand and notes what they mean; choose.c alone converts.
 */
#ifndef FST_TRACKS_RAW_H
#define FST_TRACKS_RAW_H

#include <festoon/festoon_tools.h>

#include "io/text_table.h"

/* A place of a bead, as the file has it. */
typedef struct track_spot {
    int track;    /* index of its name */
    double frame; /* NAN: the file has no frame numbers */
    double t;     /* in the file's unit of time, NAN: none */
    double x, y;  /* NAN: lost */
    size_t line;  /* of the file; 0: unknown */
    int doubts;   /* of fst_track */
    int turning;  /* which of the turnings is its, from 1; 0: none */
} track_spot;

/* How the comment of festoon's own tracks begins that has the relative error of the scale. */
#define TRACK_SCALE_ERROR "# scale_error: "
/* ... and the one of its turning, in harmonics. */
#define TRACK_RHYTHM "# rhythm: "

enum { TRACK_NAME_SIZE = 64, TRACK_MOST_TRACKS = 65536 };

typedef struct track_raw {
    track_spot *spots;
    size_t count;
    fst_turning *turnings; /* in the file's unit of length */
    int turned, rhythm;
    char (*names)[TRACK_NAME_SIZE];
    int name_count;
    int last_name;        /* the name found last: spots of a track often stand together */
    char length_unit[32]; /* as the file writes it; "": it does not say */
    double time_unit;     /* s that a unit of `t` lasts */
    double interval;      /* s from frame to frame, as the file says; NAN: it does not */
    double scale_error;   /* relative, of the unit of length, as the file says; 0: it does not */
    int y_down;
    int is_whole;     /* all beads of a film, whose tracks belong together */
    char format[64];  /* for a person: "TrackMate, CSV" */
    char remark[256]; /* what else a person should know of how the file was understood; "" */
} track_raw;

void track_raw_begin(track_raw *raw, const char *format);
void track_raw_free(track_raw *raw);
fst_status track_raw_add(track_raw *raw, track_spot spot, fst_error *error);
/* The index of a track's name, which is new or was there before. */
fst_status track_raw_name(track_raw *raw, const char *name, int *index, fst_error *error);

/* Recognise the format of a text, or take the one that is named, and read all its tracks.  Begins `raw`, which
 * the caller frees, also after a failure. */
fst_status track_read_text(const fst_text *text, const fst_track_options *options, track_raw *raw,
                           fst_error *error);

/* Make a track of what was read: that of the name `which`, or where this is -1 the one that the options tell. */
fst_status track_choose(const track_raw *raw, const char *path, const fst_track_options *options, int which,
                        fst_track *track, char **understood, fst_error *error);

/* The factor of a unit of time ("s", "ms", "sec"...) in seconds; 0: no unit of time. */
double track_time_unit(const char *unit);

/* Whether a unit of length is that of pixels; if not, its factor in metres; 0: not a known unit. */
int track_is_pixel(const char *unit);
double track_length_unit(const char *unit);

#endif
