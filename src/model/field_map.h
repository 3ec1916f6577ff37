/* field_map.h - a measured field: samples on a rectangular grid, and the splines through them.
 *
 * Each plane of samples is a spline of degree 7 in x and in y, of each component on its own: the sum over the
 * nodes (k, l) of coefficients times M(x/dx - k) M(y/dy - l), M being the B-spline on eight cells.
 */
#ifndef FST_MODEL_FIELD_MAP_H
#define FST_MODEL_FIELD_MAP_H

#include <festoon/festoon.h>

enum {
    FST_SPLINE_DEGREE = 7,
    FST_SPLINE_NODES = FST_SPLINE_DEGREE + 1, /* whose splines reach into one cell */
    FST_SPLINE_BEYOND = 3,                    /* nodes with a coefficient beyond either end of the samples */
    FST_MAP_COMPONENTS = 4                    /* room for each node: Bx, By, Bz, and nothing */
};

/* One plane.  Node (k, l) of cell (i, j), k and l from 0 to 7, is at
 * coefficients[((j + l) * stride + i + k) * FST_MAP_COMPONENTS]. */
typedef struct fst_map_plane {
    const double *coefficients; /* T */
    int stride;                 /* nodes in a row */
    int cells[2];               /* along x and y */
    double first[2];            /* m: where the first sample is */
    double spacing[2];          /* m */
    double height;              /* m over the magnet's reference plane; NAN: not known */
} fst_map_plane;

/* The plane at a height, or NULL where there is none.  A map whose height is not known serves every height. */
const fst_map_plane *fst_map_plane_at(const fst_field_map *map, double height);

/* The nearest plane's height, for messages; NAN: not known. */
double fst_map_nearest_height(const fst_field_map *map, double height);

/* The plane `number`, from 0, and its sample (i, j), which the splines pass through. */
const fst_map_plane *fst_map_plane_number(const fst_field_map *map, int number);
void fst_map_sample(const fst_map_plane *plane, int i, int j, double b[3]);

/* The charges of a smoothed map, or NULL; and to give them to it, which frees them with itself. */
struct fst_charges;
const struct fst_charges *fst_map_charges(const fst_field_map *map);
void fst_map_own_charges(fst_field_map *map, struct fst_charges *charges,
                         void (*free_charges)(struct fst_charges *charges), const fst_map_fit *fit);

#endif
