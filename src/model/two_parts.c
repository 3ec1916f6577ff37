/* two_parts.c - the fields of two parts of a magnet, side by side in registers of two doubles.
 *
 * A field function waits for roots and quotients most of its time, and a register's two cost what one does.  Each part
 * has the bits that it would have alone.
 */
#include "model/model.h"

#include "base/real_two.h"

#include "base/elementary.inl"
#include "model/source/local_field.inl"
#include "model/source/parts.inl"

static FN(part) side_by_side(const fst_part_double parts[2], double d[2][3], REAL place[3])
{
    FN(part) both;
    for (int i = 0; i < 3; ++i) {
        place[i] = (REAL){d[0][i], d[1][i]};
        both.half[i] = (REAL){parts[0].half[i], parts[1].half[i]};
        both.j[i] = (REAL){parts[0].j[i], parts[1].j[i]};
    }
    return both;
}

static void tell_fields(const REAL b[3], const FN(gradient) * g, fst_local_field_double found[2])
{
    for (int k = 0; k < 2; ++k) {
        fst_gradient_double *of = &found[k].gradient;
        for (int i = 0; i < 3; ++i)
            found[k].b[i] = b[i][k];
        of->xx = g->xx[k];
        of->yy = g->yy[k];
        of->xy = g->xy[k];
        of->xz = g->xz[k];
        of->yz = g->yz[k];
    }
}

void fst_two_parts_field(const fst_part_double parts[2], int kind, double d[2][3],
                         fst_local_field_double found[2])
{
    REAL place[3], b[3];
    FN(gradient) g;
    const FN(part) both = side_by_side(parts, d, place);
    FN(part_field)(&both, kind, place, b, &g);
    tell_fields(b, &g, found);
}

void fst_two_parts_look(const fst_part_double parts[2], int kind, double d[2][3],
                        fst_local_field_double found[2])
{
    REAL place[3];
    FN(local_field) at;
    const FN(part) both = side_by_side(parts, d, place);
    FN(part_look)(&both, kind, place, &at);
    tell_fields(at.b, &at.gradient, found);
    for (int k = 0; k < 2; ++k) {
        fst_bend_double *t = &found[k].bend;
        t->xxx = at.bend.xxx[k];
        t->xxy = at.bend.xxy[k];
        t->xyy = at.bend.xyy[k];
        t->yyy = at.bend.yyy[k];
        t->xxz = at.bend.xxz[k];
        t->xyz = at.bend.xyz[k];
        t->yyz = at.bend.yyz[k];
    }
}
