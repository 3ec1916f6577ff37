/* beads_text.h - the result of a run of several beads as its trajectory holds it. */
#ifndef FST_IO_BEADS_TEXT_H
#define FST_IO_BEADS_TEXT_H

#include <festoon/beads.h>

/* JSON on one line, without the scene and the events, for which an attribute of HDF5 has no room.  free() it; NULL: no
 * memory. */
char *fst_beads_line(const fst_params *scene, const fst_beads_result *result);

#endif
