/* read_formats.h - the readers of formats of other programs, a function each: they take a text that was
 * recognised, and put all its places into `raw`. */
#ifndef FST_TRACK_READ_FORMATS_H
#define FST_TRACK_READ_FORMATS_H

#include "track/raw.h"

/* `header` is the index of the first line that is no comment and not blank. */
fst_status track_read_tracker(const track_text *text, size_t header, track_raw *raw, fst_error *error);
fst_status track_read_trk(const track_text *text, track_raw *raw, fst_error *error);
fst_status track_read_trackmate_csv(const track_text *text, size_t header, track_raw *raw, fst_error *error);
fst_status track_read_trackmate_xml(const track_text *text, track_raw *raw, fst_error *error);
fst_status track_read_imagej(const track_text *text, size_t header, track_raw *raw, fst_error *error);
fst_status track_read_mtrackj(const track_text *text, size_t header, track_raw *raw, fst_error *error);
fst_status track_read_dltdv(const track_text *text, size_t header, int y_down, track_raw *raw,
                            fst_error *error);

#endif
