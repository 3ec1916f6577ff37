/* json_parts.h - pieces of JSON documents, for the files that make or read them. */
#ifndef FST_IO_JSON_PARTS_H
#define FST_IO_JSON_PARTS_H

#include <festoon/festoon.h>
#include <jansson.h>

#define FST_LONGEST_JSON ((size_t)1 << 31) /* the most bytes of a file that is read */

/* A number; null where it is not finite, because JSON has no NaN and no infinity. */
json_t *fst_json_number(double value);
json_t *fst_json_numbers(const double *values, int count);

/* The parameters by key, in SI.  Null: it was not given, or another form of the same quantity was. */
json_t *fst_json_scene(const fst_params *params);

/* The numbers of a point of a branch under their keys, for writing and for reading. */
typedef struct fst_point_number {
    const char *key;
    size_t offset; /* in fst_branch_point */
} fst_point_number;
enum { FST_POINT_NUMBER_COUNT = 13 };
extern const fst_point_number fst_point_numbers[FST_POINT_NUMBER_COUNT];

/* The numbers of a run. */
json_t *fst_json_run(const fst_params *params, const fst_run_result *result);

/* The text of a document with a newline at its end; takes the reference. */
char *fst_json_dump(json_t *document, size_t flags);

#endif
