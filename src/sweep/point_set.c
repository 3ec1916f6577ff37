/* point_set.c - a hash table of points: a point lies at the first free place at or behind that of its hash. */
#include "sweep/point_set.h"

#include <stdlib.h>
#include <string.h>

/* The place at which a search for the point ends: its own, or a free one. */
static size_t place_of(const fst_point_set *set, int64_t point)
{
    const uint64_t golden = UINT64_C(0x9e3779b97f4a7c15); /* 2^64 over the golden ratio spreads neighbours */
    size_t i = (size_t)(((uint64_t)point * golden) >> 20) & (set->size - 1);
    while (set->places[i].point >= 0 && set->places[i].point != point)
        i = (i + 1) & (set->size - 1);
    return i;
}

fst_point_entry *fst_point_find(const fst_point_set *set, int64_t point)
{
    if (set->size == 0)
        return NULL;
    fst_point_entry *found = &set->places[place_of(set, point)];
    return found->point < 0 ? NULL : found;
}

static int grow(fst_point_set *set)
{
    fst_point_set larger = {.size = set->size > 0 ? 2 * set->size : 1024, .count = set->count};
    larger.places = malloc(larger.size * sizeof *larger.places);
    if (!larger.places)
        return 0;
    for (size_t i = 0; i < larger.size; ++i)
        larger.places[i].point = -1;
    for (size_t i = 0; i < set->size; ++i)
        if (set->places[i].point >= 0)
            larger.places[place_of(&larger, set->places[i].point)] = set->places[i];
    free(set->places);
    *set = larger;
    return 1;
}

int fst_point_add(fst_point_set *set, int64_t point)
{
    if (4 * (set->count + 1) > 3 * set->size && !grow(set))
        return 0;
    set->places[place_of(set, point)] = (fst_point_entry){.point = point};
    set->count += 1;
    return 1;
}

void fst_point_set_free(fst_point_set *set)
{
    free(set->places);
    memset(set, 0, sizeof *set);
}
