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

/* FST_NOISE_AGREES, ...: whether the noise told of a map agrees with what is left of its samples. */
typedef enum { FST_NOISE_VERDICTS(FST_ROW_ENUM) FST_NOISE_VERDICT_COUNT } fst_noise_verdict;
FST_API const char *fst_noise_verdict_name(fst_noise_verdict verdict);

/* How equivalent charges fit the samples of a map (fst_field_map_smooth()). */
typedef struct fst_map_fit {
    int charges;  /* how many; 0: the map's splines pass through its samples */
    double depth; /* m: of the uppermost charges below the samples */
    double rms;   /* T: of what is left of a component of a sample */
    double
        free; /* degrees of freedom that are left: the numbers of the samples less the trace of the hat matrix */
    double noise; /* T: of a component, as the fit estimates it, or as told; errors are those of this noise */
    double rough; /* T: the noise by sixth differences of neighbours alone, which see a smooth field hardly */
    double chi2;  /* chi^2 per degree of freedom against the noise told, or against `rough` where none was */
    double told;  /* T: the noise told; NAN: none was */
    double bound[2]; /* at least 95 % of chi2 are between these if the noise told is the map's; NAN: none was */
    fst_noise_verdict verdict; /* on the noise told */
    double seen[3];            /* T: the noise that what is left shows, and between which it is with 95 % */
    double turned[3], turned_error[3]; /* rad: rotation vector of the probe's axes; 0 where it was not free */
    double offset[3], offset_error[3]; /* T: what the probe's axes show in no field; 0 where it was not free */
} fst_map_fit;

/* What can be told of a map. */
typedef struct fst_field_map_facts {
    int count[3];
    double first[3], spacing[3]; /* as in fst_field_samples */
    double radius;               /* m: of the greatest disc about the axis that the samples cover */
    double greatest;             /* T: the greatest |B| of the samples */
    /* How far the samples are from a field of magnets, of which the curl of B vanishes: the rms of dBx/dy -
     * dBy/dx over the rms of all derivatives by x and y.  Noise and wrong axes make it large. */
    double curl;
    fst_map_fit fit;
} fst_field_map_facts;
FST_API fst_field_map_facts fst_field_map_describe(const fst_field_map *map);

/* Say what makes a map doubtful, a curl above 1e-3, in `sentence`.  Returns its length, 0 where nothing does. */
FST_API int fst_field_map_doubt(const fst_field_map *map, char *sentence, size_t size);

typedef struct fst_smoothing {
    double noise;  /* T: standard deviation of a component of a sample; NAN: the fit estimates it */
    int probe;     /* whether the probe may be turned about its place and have offsets, which are fitted too */
    double height; /* m: of the plane that is wanted */
    double lies;   /* m: where a map lies that does not tell its height */
} fst_smoothing;

/* Fit charges below the map to its samples by regularised least squares, and make a map of their field, which has
 * neither curl nor divergence, at a height.  FST_BAD_INPUT: an empty field, more than 100 000 samples, a height
 * that is too near to the charges, a noise that is none, a probe whose rotation the field does not tell. */
FST_API fst_status fst_field_map_smooth(const fst_field_map *measured, const fst_smoothing *how,
                                        const fst_progress *progress, fst_field_map **smooth, fst_error *error);

/* What is to be said of a fit, for people: the verdict on the noise with its numbers, or that more is left than noise.
 * It is empty where there is nothing to say, and 256 bytes are enough. */
FST_API void fst_map_fit_sentence(const fst_map_fit *fit, char *sentence, size_t size);

/* A map of a field drawn from all that the samples and the fit allow, each as often as it is likely: the standard
 * deviations of many are the errors of fst_field_error(), which a drawn map has none of.  Runs over several tell what
 * the map's noise does to a motion.  A seed gives the same map again.  FST_BAD_INPUT: `smooth` is none of
 * fst_field_map_smooth(). */
FST_API fst_status fst_field_map_draw(const fst_field_map *smooth, uint64_t seed, const fst_progress *progress,
                                      fst_field_map **drawn, fst_error *error);

/* The standard errors of what fst_field() and fst_field_pull() tell of a model over a smoothed map, in the same units;
 * the load has the error of force[2].  That of the force is linear in the field's: too large where |B| is not far above
 * its error.  0, and no number written: the model has no such map, the place is beyond it, or a time was set. */
FST_API int fst_field_error(const fst_model *model, double x, double y, double b[3], double grad[3][3],
                            double force[3]);

/* The map of a model, borrowed; NULL: it has none. */
FST_API const fst_field_map *fst_model_map(const fst_model *model);

#ifdef __cplusplus
}
#endif

#endif
