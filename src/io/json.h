/* json.h - pieces of JSON documents that several files write, and the one way to read one. */
#ifndef FST_IO_JSON_H
#define FST_IO_JSON_H

#include <festoon/beads.h>

#include "io/json_writer.h"

#define FST_LONGEST_JSON ((size_t)1 << 31) /* the most bytes of a file that is read */

/* The document in a text, or NULL.  *status is then FST_NO_MEMORY, or FST_BAD_INPUT with the reason in `why`. */
json_t *fst_json_read(const char *text, size_t size, json_error_t *why, fst_status *status);

/* The member "scene": the parameters by key, in SI.  Null: it was not given, or another form of the same
 * quantity was. */
void fst_json_scene(fst_json *json, const fst_params *params);

/* A number in SI, whose scaled unit is given, under its name with the SI unit behind it: mean_r_m.  A unit without
 * counterpart: nothing. */
void fst_json_in_si(fst_json *json, const char *name, double value, const char *unit, const fst_scales *scales);

/* A number; and in SI where `si` is not NULL. */
void fst_json_scaled(fst_json *json, const char *key, double value, const char *unit, const fst_scales *si);

/* Eigenvalues of a motion, in gamma; and in 1/s where `si` is not NULL. */
void fst_json_rates(fst_json *json, const double *re, const double *im, int count, const fst_scales *si);

/* The scaled units of a scene in which up to two parameters (NULL, "": none) have these values. */
fst_scales fst_json_scales_at(const fst_params *params, const char *const keys[2], const double values[2]);

/* Whether numbers in SI stand beside the scaled ones. */
int fst_json_with_si(fst_shown_units units);

/* A state of two or three axes in m, m/s and rad/s. */
void fst_json_state_si(fst_json *json, const char *key, const double *state, int axes,
                       const fst_scales *scales);

/* The numbers of a run in SI; a load in weights, mean_load_weights, becomes mean_load_newtons. */
void fst_json_run_si(fst_json *json, const fst_params *params, const fst_run_result *result);

/* The members of a run's result. */
void fst_json_run(fst_json *json, const fst_params *params, const fst_run_result *result);

/* The result of a run as JSON on one line, without the scene: a trajectory file holds it. free() it; NULL: no
 * memory. */
char *fst_result_line(const fst_params *params, const fst_run_result *result);
char *fst_world_line(const fst_params *params, const fst_world_result *result);

#endif
