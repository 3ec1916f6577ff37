/* branch_points.h - the numbers of a point of a branch under their keys, for writing and for reading. */
#ifndef FST_IO_BRANCH_POINTS_H
#define FST_IO_BRANCH_POINTS_H

#include <stddef.h>

typedef struct fst_point_number {
    const char *key, *unit; /* "": the parameter's */
    size_t offset;          /* in fst_branch_point */
} fst_point_number;
enum { FST_POINT_NUMBER_COUNT = 13 };
extern const fst_point_number fst_point_numbers[FST_POINT_NUMBER_COUNT];

#endif
