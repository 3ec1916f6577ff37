/* charges.h - equivalent charges below a measured map: a field without curl and divergence that fits its samples.
 *
 * The unknowns are the strengths of point charges on square lattices below the map, symmetric about its middle:
 *
 *     z   o o o o o o o    samples
 *         . . . . . . . . .              layer 0, `depth` below the lowest samples, 2.5 sites to a depth
 *       .    .    .    .    .    .       layer 1, twice as deep and as coarse, and so on to half of the map's width
 *
 * Each charge has three mirror images, in x, in y and in both.  With their four signs the unknowns fall into four
 * classes that do not know each other, so that sums over all samples are done in a quarter of them.
 */
#ifndef FST_MODEL_CHARGES_H
#define FST_MODEL_CHARGES_H

#include "model/field_map.h"

enum {
    CHARGE_CLASSES = 4, /* bit 0: the potential is odd in x; bit 1: in y */
    CHARGE_VALUES = 9   /* Bx By Bz, then dBx/dx dBx/dy dBx/dz dBy/dy dBy/dz dBz/dz */
};

/* The charges with x, y > 0 of the middle, each with a weight that makes all layers equally strong there. */
typedef struct charge_sites {
    int count, offset; /* offset: whether a column for the probe's offset follows on those of the charges */
    double middle[2], depth, *x, *y, *z, *weight;
    double lies; /* m: where a plane lies whose height is not told */
    double unit; /* the field of an offset of strength 1, far above that of a charge */
} charge_sites;

fst_status charge_sites_make(const fst_field_map *map, const fst_smoothing *how, double depth,
                             charge_sites *sites);
int charge_sites_count(const fst_field_map *map, const fst_smoothing *how,
                       double depth); /* without an offset */
void charge_sites_free(charge_sites *sites);
int charge_columns(const charge_sites *sites);

/* The first `values` of CHARGE_VALUES at a place for each column and class:
 * rows[(class * CHARGE_VALUES + value) * columns + column]. */
void charge_rows(const charge_sites *sites, const double place[3], int values, double *rows);

/* Least squares: of each class the normal matrix (upper half), and its products with the samples: of the field's
 * component a with the samples' component b at right[((class * 3 + a) * 3 + b) * columns]. */
typedef struct charge_sums {
    double *normal[CHARGE_CLASSES], *right;
    double square; /* of all samples, T^2 */
    double count;  /* of numbers */
} charge_sums;

fst_status charge_sums_make(const fst_field_map *map, const charge_sites *sites, const fst_progress *progress,
                            charge_sums *sums, fst_error *error);
void charge_sums_free(charge_sums *sums);

/* The fitted charges.  factor: of each class Cholesky's R, R'R = normal matrix + ridge. */
typedef struct fst_charges {
    charge_sites sites;
    double *factor[CHARGE_CLASSES], *strength;
    double
        *turning; /* how the strengths go with three errors of the probe's angles, over the noise; NULL: none */
    fst_map_fit fit;
} fst_charges;

fst_status fst_charges_fit(const fst_field_map *map, const fst_smoothing *how, const fst_progress *progress,
                           fst_charges **charges, fst_error *error);
void fst_charges_free(fst_charges *charges);

/* The first `values` of CHARGE_VALUES at a place in m, in T and T/m, and the covariance of their errors (values x
 * values) where it is not NULL.  `room` is for charge_rows(). */
void fst_charges_look(const fst_charges *charges, const double place[3], int values, double *room, double *out,
                      double *covariance);
/* Strengths drawn from all that the fit allows, `strength` having room for them. */
void fst_charges_draw(const fst_charges *charges, uint64_t seed, double *strength);
double *fst_charges_room(const fst_charges *charges);

#endif
