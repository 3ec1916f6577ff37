/* images.h - images of runs (fst_row_images) between threads, ranks and the journal: lists of them. */
#ifndef FST_SWEEP_IMAGES_H
#define FST_SWEEP_IMAGES_H

#include <stddef.h>

#include <festoon/festoon.h>

/* Between ranks, all that follows `next` is sent. */
typedef struct fst_image {
    struct fst_image *next;
    int64_t point;
    size_t size;
    unsigned char bytes[];
} fst_image;

/* A copy of an image, or room for one where `bytes` is NULL; NULL: no memory. */
fst_image *fst_image_new(int64_t point, const void *bytes, size_t size);

/* Put an image into a list, in place of that of the same point. */
void fst_image_put(fst_image **list, fst_image *image);

/* Take the image of a point out of a list, or NULL. */
fst_image *fst_image_take(fst_image **list, int64_t point);

void fst_images_free(fst_image *list);

#endif
