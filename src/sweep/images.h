/* images.h - images of unfinished runs (fst_row_images) on their way between threads, ranks and the journal. */
#ifndef FST_SWEEP_IMAGES_H
#define FST_SWEEP_IMAGES_H

#include <stddef.h>

#include <festoon/festoon.h>

/* What follows `next` is sent between ranks as it is. */
typedef struct fst_image {
    struct fst_image *next;
    int64_t point;
    size_t size;
    unsigned char bytes[];
} fst_image;

/* A copy of an image, or room for one where `bytes` is NULL.  NULL: no memory. */
fst_image *fst_image_new(int64_t point, const void *bytes, size_t size);

/* Put an image into a list, in place of an older one of the same point. */
void fst_image_put(fst_image **list, fst_image *image);

/* Take the image of a point out of a list; NULL where there is none. */
fst_image *fst_image_take(fst_image **list, int64_t point);

void fst_images_free(fst_image *list);

#endif
