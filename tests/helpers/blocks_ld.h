/* blocks_ld.h - blocks of the same numbers over double and over long double, and what their fields differ by.
 */
#ifndef FST_TESTS_BLOCKS_LD_H
#define FST_TESTS_BLOCKS_LD_H

#include "both_precisions.h"

typedef fst_local_field_long_double field_ld;

typedef struct block {
    double half[3], j[3];
} block;

static inline fst_part_long_double part_ld_of(const block *of)
{
    fst_part_long_double part;
    memset(&part, 0, sizeof part);
    for (int i = 0; i < 3; ++i) {
        part.half[i] = of->half[i];
        part.j[i] = of->j[i];
        part.axes[i][i] = 1;
    }
    return part;
}

static inline field_ld block_field_ld(const block *of, const long double d[3])
{
    const fst_part_long_double part = part_ld_of(of);
    field_ld at;
    fst_cuboid_look_long_double(&part, d, &at);
    return at;
}

static inline fst_local_field_double block_field(const block *of, const double d[3])
{
    fst_part_double part;
    fst_local_field_double at;
    memset(&part, 0, sizeof part);
    memcpy(part.half, of->half, sizeof part.half);
    memcpy(part.j, of->j, sizeof part.j);
    fst_cuboid_look_double(&part, d, &at);
    return at;
}

/* All of a local field as numbers: B (3), G (xx xy yy xz yz), T (xxx xxy xyy yyy xxz xyz yyz). */
enum { NUMBERS = 15 };
static inline void numbers_of_ld(const field_ld *f, long double v[NUMBERS])
{
    const fst_gradient_long_double *g = &f->gradient;
    const fst_bend_long_double *t = &f->bend;
    const long double all[NUMBERS] = {f->b[0], f->b[1], f->b[2], g->xx,  g->xy,  g->yy,  g->xz, g->yz,
                                      t->xxx,  t->xxy,  t->xyy,  t->yyy, t->xxz, t->xyz, t->yyz};
    memcpy(v, all, sizeof all);
}

static inline void numbers_of(const fst_local_field_double *f, double v[NUMBERS])
{
    const fst_gradient_double *g = &f->gradient;
    const fst_bend_double *t = &f->bend;
    const double all[NUMBERS] = {f->b[0], f->b[1], f->b[2], g->xx,  g->xy,  g->yy,  g->xz, g->yz,
                                 t->xxx,  t->xxy,  t->xyy,  t->yyy, t->xxz, t->xyz, t->yyz};
    memcpy(v, all, sizeof all);
}

static const int FIRST_OF[4] = {0, 3, 8, 15}; /* where B, G and T begin */

/* The greatest differences of B, G and T, over the greatest component of each. */
static inline void differ(const double a[NUMBERS], const long double b[NUMBERS], double error[3])
{
    for (int what = 0; what < 3; ++what) {
        long double greatest = 0, off = 0;
        for (int i = FIRST_OF[what]; i < FIRST_OF[what + 1]; ++i) {
            greatest = fmaxl(greatest, fabsl(b[i]));
            off = isnan(a[i]) ? INFINITY : fmaxl(off, fabsl(a[i] - b[i]));
        }
        error[what] = (double)(off / greatest);
    }
}

#endif
