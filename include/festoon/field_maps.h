/* field_maps.h - measured fields (magnet.shape: grid) as the library has them; festoon.h includes it.
 * festoon_tools.h reads them from files.
 */
#ifndef FESTOON_FIELD_MAPS_H
#define FESTOON_FIELD_MAPS_H

#include <festoon/festoon.h>

#ifdef __cplusplus
extern "C" {
#endif

/* A map of the field of a magnet (magnet.shape: grid): samples on a rectangular grid in the magnet's frame, and
 * the splines between them.  It never changes, and threads may share it.  It is counted: fst_field_map_share()
 * adds an owner, fst_field_map_free() takes one away, and the last one frees it.  Models that are made with a
 * map own it too. */
typedef struct fst_field_samples {
    int count[3];      /* samples along x, y, z: at least 8, 8, 1 */
    double first[3];   /* m: where the first sample is; z over the magnet's reference plane, NAN: not told */
    double spacing[3]; /* m, positive (of z: where there are several) */
    const double *b;   /* T: Bx, By, Bz of each sample; x runs fastest, then y, then z.  It is copied. */
} fst_field_samples;

/* Make a map of samples.  FST_BAD_INPUT: too few samples, a spacing or place that is none, a field that is not
 * finite, or samples that do not surround the axis x = y = 0. */
FST_API fst_status fst_field_map_new(const fst_field_samples *samples, const fst_progress *progress,
                                     fst_field_map **map, fst_error *error);
FST_API fst_field_map *fst_field_map_share(const fst_field_map *map);
FST_API void fst_field_map_free(fst_field_map *map);

/* What can be told of a map. */
typedef struct fst_field_map_facts {
    int count[3];
    double first[3], spacing[3]; /* as in fst_field_samples */
    double radius;               /* m: of the greatest disc about the axis that the samples cover */
    double greatest;             /* T: the greatest |B| of the samples */
    /* How far the samples are from a field of magnets, of which the curl of B vanishes: the rms of dBx/dy -
     * dBy/dx over the rms of all derivatives by x and y.  Noise and wrong axes make it large. */
    double curl;
} fst_field_map_facts;
FST_API fst_field_map_facts fst_field_map_describe(const fst_field_map *map);

#ifdef __cplusplus
}
#endif

#endif
