/* params.h - checks of a whole fst_params. */
#ifndef FST_MODEL_PARAMS_H
#define FST_MODEL_PARAMS_H

#include <festoon/festoon.h>

/* The cookies of the definition structs: set by the fst_default_*() functions. */
#define FST_PARAMS_COOKIE 0xfe570001u
#define FST_FLOW_OPTIONS_COOKIE 0xfe570002u
#define FST_RUN_OPTIONS_COOKIE 0xfe570003u
#define FST_BRANCH_OPTIONS_COOKIE 0xfe570004u

/* The cookie, every value's range, and the ranges between values (run.discard < run.periods, ...). */
fst_status fst_params_validate(const fst_params *params, fst_error *error);

/* What must be chosen so that `key` plays a part ("paramagnetic or mixed"), and of which key, *of
 * (bead.material); NULL: it does. */
const char *fst_param_missing_choice(const fst_params *params, const char *key, const char **of);

#endif
