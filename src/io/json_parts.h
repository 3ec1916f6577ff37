/* json_parts.h - pieces of JSON documents, for the files of this room that make them. */
#ifndef FST_IO_JSON_PARTS_H
#define FST_IO_JSON_PARTS_H

#include <festoon/festoon.h>
#include <jansson.h>

#define FST_LONGEST_JSON ((size_t)1 << 31) /* bytes of a file that is read */

/* null where the value is not finite: JSON has no NaN and no infinity. */
json_t *fst_json_number(double value);
json_t *fst_json_numbers(const double *values, int count);

/* The parameters by key, in SI; what was not given, or is overridden by its other form, is null. */
json_t *fst_json_scene(const fst_params *params);

/* The numbers of a point of a branch under their keys, for writing and reading. */
typedef struct fst_point_number {
    const char *key;
    size_t offset; /* in fst_branch_point */
} fst_point_number;
enum { FST_POINT_NUMBER_COUNT = 13 };
extern const fst_point_number fst_point_numbers[FST_POINT_NUMBER_COUNT];

/* The numbers of a run. */
json_t *fst_json_run(const fst_params *params, const fst_run_result *result);

/* The text of a document, with a newline at its end; takes the reference. */
char *fst_json_dump(json_t *document, size_t flags);

#endif
