/* grow.h - lists in memory that become longer. */
#ifndef FST_BASE_GROW_H
#define FST_BASE_GROW_H

#include <stdlib.h>
#include <string.h>

/* Give a list room for `room` elements of `size` bytes.  `list` points to the pointer to its first element,
 * which is NULL before the first call.  Returns 0 where there is no memory; the list then stays as it was. */
static inline int fst_resize(void *list, size_t room, size_t size)
{
    void *elements;
    memcpy(&elements, list, sizeof elements);
    elements = realloc(elements, room * size);
    if (elements)
        memcpy(list, &elements, sizeof elements);
    return elements != NULL;
}

/* The same for one more than the `count` elements that it has.  A list that grows in this way alone has room
 * for a power of two of them, so nobody needs to remember for how many. */
static inline int fst_grow(void *list, size_t count, size_t size)
{
    return (count & (count - 1)) != 0 || fst_resize(list, count ? 2 * count : 1, size);
}

#endif
