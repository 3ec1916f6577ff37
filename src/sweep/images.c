/* images.c - lists of images of unfinished runs. */
#include "sweep/images.h"

#include <stdlib.h>
#include <string.h>

fst_image *fst_image_new(int64_t point, const void *bytes, size_t size)
{
    fst_image *made = malloc(sizeof *made + size);
    if (!made)
        return NULL;
    made->next = NULL;
    made->point = point;
    made->size = size;
    if (bytes)
        memcpy(made->bytes, bytes, size);
    return made;
}

fst_image *fst_image_take(fst_image **list, int64_t point)
{
    while (*list && (*list)->point != point)
        list = &(*list)->next;
    fst_image *found = *list;
    if (found)
        *list = found->next;
    return found;
}

void fst_image_put(fst_image **list, fst_image *image)
{
    free(fst_image_take(list, image->point));
    image->next = *list;
    *list = image;
}

void fst_images_free(fst_image *list)
{
    while (list) {
        fst_image *next = list->next;
        free(list);
        list = next;
    }
}
