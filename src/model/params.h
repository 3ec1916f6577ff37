/* params.h - checks of a whole fst_params. */
#ifndef FST_MODEL_PARAMS_H
#define FST_MODEL_PARAMS_H

#include <festoon/festoon.h>

/* The cookies of the definition structs: set by the fst_default_*() functions. */
#define FST_PARAMS_COOKIE 0xfe570001u
#define FST_FLOW_OPTIONS_COOKIE 0xfe570003u
#define FST_RUN_OPTIONS_COOKIE 0xfe570003u
#define FST_BRANCH_OPTIONS_COOKIE 0xfe570004u

/* The cookie, every value's range, and the ranges between values (run.discard < run.periods, ...). */
fst_status fst_params_validate(const fst_params *params, fst_error *error);

/* Whether model.kappa was given, also with the value that is its default. */
int fst_kappa_given(const fst_params *params);

/* Whether kappa follows from the bead and the magnet, so that model.kappa plays no part. */
int fst_kappa_follows(const fst_params *params);

/* The moment that the scene tells, in A m^2, not by way of kappa; NAN: it tells none. */
double fst_given_moment(const fst_params *params);

/* m R^2 gamma^2: kappa is moment times B0 over this. */
double fst_moment_unit(const fst_params *params);

/* B0 in T, as far as magnet.b0 or the kind of magnet tell it; NAN: they do not. */
double fst_field_unit(const fst_params *params);

/* What must be chosen so that `key` plays a part ("paramagnetic or mixed"), and of which key, *of
 * (bead.material); NULL: it does. */
const char *fst_param_missing_choice(const fst_params *params, const char *key, const char **of);

#endif
