/* params.h - checks of a whole fst_params. */
#ifndef FST_MODEL_PARAMS_H
#define FST_MODEL_PARAMS_H

#include <festoon/festoon.h>

/* The cookies of the definition structs: set by the fst_default_*() functions. */
#define FST_PARAMS_COOKIE 0xfe570001u
#define FST_FLOW_OPTIONS_COOKIE 0xfe570006u
#define FST_RUN_OPTIONS_COOKIE 0xfe570003u
#define FST_BRANCH_OPTIONS_COOKIE 0xfe570004u

/* A row of the tables of parameters; `field` is where fst_params holds it. */
#define FST_PARAM_ROW(key, kind, unit, names, initial, least, greatest, doc, field)                            \
    {                                                                                                          \
        key, FST_KIND_##kind, FST_UNIT_##unit, names, initial, least, greatest, doc,                           \
            offsetof(fst_params, field)                                                                        \
    }

/* Settle them, and check the cookie, every value's range, and the ranges between values (run.discard
 * < run.periods, ...). */
fst_status fst_params_validate(fst_params *params, fst_error *error);

/* No key is called so: a sentence with the nearest one. */
fst_status fst_param_unknown_key(const char *key, fst_error *error);

/* What to do about a key, or about its choice ("": the key itself), that earlier versions had; NULL: none had
 * it. */
const char *fst_param_removed(const char *key, const char *choice);

/* The number in a row's field, an integer or the place of a choice too, and giving it one. */
double fst_param_value(const fst_params *params, const fst_param_info *row);
void fst_param_put(fst_params *params, const fst_param_info *row, double value);

/* Whether a row may have a value.  The sentence shows it as `shown` (NULL: in the customary unit) and ends in
 * `remark`. */
fst_status fst_param_check_range(const fst_param_info *row, double value, const char *shown, const char *remark,
                                 fst_error *error);

/* Whether a field that a program filled in by hand is what fst_params_set() would have let pass. */
fst_status fst_param_validate(const fst_params *params, const fst_param_info *row, fst_error *error);

/* The unit in which a bare number would be nearer to the row's default, and within its range; NULL: there is none. */
const char *fst_param_unit_meant(const fst_param_info *row, double value);

/* Whether a text is a number without a unit; and note that the row `index` was set by this text, see
 * fst_params_bare_number(). */
int fst_param_is_bare(const char *text);
void fst_param_note_bare(fst_params *params, int index, const char *text);

/* The moment of the scene in A m^2, if it does not follow from kappa; NAN: not given. */
double fst_given_moment(const fst_params *params);

/* m R^2 gamma^2: kappa is moment times B0 over this. */
double fst_moment_unit(const fst_params *params);

/* B0 in T, if magnet.b0 or the kind of magnet gives it; else NAN. */
double fst_field_unit(const fst_params *params);

/* kappa of a hard bead, and B0 in T (NAN: not known).  kappa is model.kappa, unless moment and B0 are both given: of
 * moment, B0 and kappa two give the third; beside a real magnet B0 is there already, and of moment and kappa one gives
 * the other. */
double fst_kappa_and_field(const fst_params *params, double *field);

/* What must be chosen so that `key` plays a part ("paramagnetic or mixed"), and of which key, *of
 * (bead.material); NULL: it does. */
const char *fst_param_missing_choice(const fst_params *params, const char *key, const char **of);

#endif
