/* point_set.h - points of a grid with what is known of each: a hash table, so that its size follows the points
 * that are in it and not those of the grid. */
#ifndef FST_SWEEP_POINT_SET_H
#define FST_SWEEP_POINT_SET_H

#include <stddef.h>
#include <stdint.h>

typedef struct fst_point_entry {
    int64_t point; /* -1: a free place */
    double value;
    /* Bit k: the cell of level k whose least corner this is was divided, or is active (refine.h). */
    uint32_t divided, active;
} fst_point_entry;

typedef struct fst_point_set {
    fst_point_entry *places;
    size_t size, count; /* size: a power of two, or 0 */
} fst_point_set;

/* The entry of a point; NULL: it is not there.  The next addition moves entries. */
fst_point_entry *fst_point_find(const fst_point_set *set, int64_t point);

/* Add a point that is not there; 0: no memory. */
int fst_point_add(fst_point_set *set, int64_t point);

void fst_point_set_free(fst_point_set *set);

#endif
