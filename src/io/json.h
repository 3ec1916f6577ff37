/* json.h - JSON for other files of this room. */
#ifndef FST_IO_JSON_H
#define FST_IO_JSON_H

#include <festoon/festoon.h>

/* The result of a run as JSON on one line, without the scene: a trajectory file holds it. free() it; NULL: no
 * memory. */
char *fst_result_line(const fst_params *params, const fst_run_result *result);

#endif
