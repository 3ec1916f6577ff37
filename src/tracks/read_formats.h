/* read_formats.h - the readers of formats of other programs, a function each: they take a text that was
 * recognised, and put all its places into `raw`. */
#ifndef FST_TRACKS_READ_FORMATS_H
#define FST_TRACKS_READ_FORMATS_H

#include "tracks/raw.h"

/* `header` is the index of the first line that is not a comment and not blank; `variant`: which of the formats
 * that the reader knows. */
typedef fst_status track_reader(const fst_text *text, size_t header, int variant, track_raw *raw,
                                fst_error *error);
enum { TRACK_ANY_COLUMNS, TRACK_TRACKPY, TRACK_TRACKMATE, TRACK_IMAGEJ }; /* of track_read_columns() */
track_reader track_read_columns, track_read_tracker, track_read_mtrackj, track_read_trk,
    track_read_trackmate_xml;
track_reader track_read_dltdv; /* variant: its version, 5 or 8 */

#endif
