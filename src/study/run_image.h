/* run_image.h - an unfinished run as bytes, from which it goes on to the same bits as if never interrupted.
 *
 *     | build and sizes | place | lane's numbers | window, end | exponent | flow |  numbers of the lane ...
 *
 * An image is what a run carries, as it lies in memory, with the numbers of its lane: it means nothing to
 * another build.  So it begins with a number made of the build's identity and of the sizes of what follows, and
 * an image with another number is ignored.  Pointers are not part of it; a run takes up an image
 * after it was begun from its parameters, and keeps its own.  A new pointer in what an image holds is to be
 * added to fst_run_image_take(), and a new index to what is checked there: files may be damaged.
 */
#ifndef FST_STUDY_RUN_IMAGE_H
#define FST_STUDY_RUN_IMAGE_H

#include "study/exponent.h"
#include "study/watched_run.h"

/* Where a run is between its beginning and its end. */
typedef enum fst_run_station {
    FST_STATION_RUN_UP,   /* in a lane before its window */
    FST_STATION_READY,    /* waiting for a lane in which it is observed */
    FST_STATION_OBSERVED, /* in such a lane */
    FST_STATION_PARKED,   /* finished, waiting for a Lyapunov exponent */
    FST_STATION_ALONE,    /* without lanes, on its way */
    FST_STATION_COUNT
} fst_run_station;

typedef struct fst_run_place {
    fst_run_station station;
    int in_window, tracked, turning; /* of a lane that is observed */
} fst_run_place;

/* Whether this build can make images: only a build with an identity can (the linker's --build-id). */
int fst_run_images_possible(void);

/* The image of a run, to be freed, with room for `numbers` of its lane at *lane; `exponent`: what a parked run
 * waits for, else NULL.  NULL: no memory. */
void *fst_run_image_make(const fst_watched_run *run, const fst_exponent *exponent, const fst_run_place *place,
                         int numbers, double **lane, size_t *size);

/* Make a run that was just begun the one of an image, and where it is parked `exponent` what it waits for: 1,
 * or 0 (and the run is as it was) where the image is damaged or comes from another build.  *lane points into the
 * image. */
int fst_run_image_take(const void *image, size_t size, int numbers, fst_watched_run *run,
                       fst_exponent *exponent, fst_run_place *place, const double **lane);

#endif
