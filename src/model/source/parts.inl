/* parts.inl - the source `parts`: a magnet made of uniformly magnetised bodies, over REAL.
 *
 * The fields of the parts add up (remanent magnets of recoil permeability 1, no iron near them).  Each kind of
 * part has a file with its field along its own axes; here the place is taken into these axes, and what is found
 * back.
 */
#include "model/source/part_local.inl"

#include "model/source/derivatives.inl"

#include "model/source/cuboid.inl"
#include "model/source/cylinder.inl"
#include "model/source/dipole.inl"

typedef struct FN(parts) {
    FN(part) part[FST_PARTS_MAX];
} FN(parts);

static inline FN(parts) FN(make_parts)(const fst_params *params, const fst_groups *g)
{
    static const FN(parts) nothing;
    FN(parts) parts = nothing;
    for (int i = 0; i < params->magnet_part_count; ++i)
        parts.part[i] = FN(make_part)(&params->magnet_parts[i], g);
    return parts;
}

/* B and G of one part at the place d from its centre, along its own axes. */
static inline void FN(part_field)(const FN(part) * part, int kind, const REAL d[3], REAL b[3], FN(gradient) * g)
{
    switch (kind) {
    case FST_PART_CUBOID:
        FN(cuboid_field)(part, d, b, g);
        break;
    case FST_PART_CYLINDER:
        FN(cylinder_field)(part, d, b, g);
        break;
    default: /* FST_PART_SPHERE, FST_PART_DIPOLE */
        FN(dipole_field)(part, d, b, g);
    }
}

/* B, G and T of it. */
static inline void FN(part_look)(const FN(part) * part, int kind, const REAL d[3], FN(local_field) * at)
{
    switch (kind) {
    case FST_PART_CUBOID:
        FN(cuboid_look)(part, d, at);
        break;
    case FST_PART_CYLINDER:
        FN(cylinder_look)(part, d, at);
        break;
    default:
        FN(dipole_look)(part, d, at);
    }
}

static inline void FN(add_bend)(FN(bend) * sum, const FN(bend) * t)
{
    sum->xxx = sum->xxx + t->xxx;
    sum->xxy = sum->xxy + t->xxy;
    sum->xyy = sum->xyy + t->xyy;
    sum->yyy = sum->yyy + t->yyy;
    sum->xxz = sum->xxz + t->xxz;
    sum->xyz = sum->xyz + t->xyz;
    sum->yyz = sum->yyz + t->yyz;
}

static inline void FN(add_gradient)(FN(gradient) * sum, const FN(gradient) * g)
{
    sum->xx = sum->xx + g->xx;
    sum->yy = sum->yy + g->yy;
    sum->xy = sum->xy + g->xy;
    sum->xz = sum->xz + g->xz;
    sum->yz = sum->yz + g->yz;
}

/* The place as part i sees it. */
static inline void FN(place_in_part)(const FN(parts) * parts, const fst_kinds *kinds, int i, REAL x, REAL y,
                                     REAL z, REAL own[3])
{
    const FN(part) *part = &parts->part[i];
    const REAL from[3] = {x - part->centre[0], y - part->centre[1], z - part->centre[2]};
    if (kinds->part_turned[i])
        FN(into_part)(part, from, own);
    else
        memcpy(own, from, sizeof from);
}

static inline __attribute__((always_inline)) void FN(parts_field)(const FN(parts) * parts,
                                                                  const fst_kinds *kinds, REAL x, REAL y,
                                                                  REAL z, REAL b[3], FN(gradient) * sum)
{
    const REAL zero = R(0.0);
    const FN(gradient) flat = {zero, zero, zero, zero, zero, zero};
    b[0] = b[1] = b[2] = zero;
    *sum = flat;
    for (int i = 0; i < kinds->pieces; ++i) {
        REAL own[3], of[3];
        FN(gradient) g;
        FN(place_in_part)(parts, kinds, i, x, y, z, own);
        FN(part_field)(&parts->part[i], kinds->part[i], own, of, &g);
        if (kinds->part_turned[i])
            FN(turn_field)(&parts->part[i], of, &g);
        for (int k = 0; k < 3; ++k)
            b[k] = b[k] + of[k];
        FN(add_gradient)(sum, &g);
    }
}

static inline __attribute__((always_inline)) void
FN(parts_look)(const FN(parts) * parts, const fst_kinds *kinds, REAL x, REAL y, REAL z, FN(local_field) * sum)
{
    const REAL zero = R(0.0), one = R(1.0);
    const FN(gradient) flat = {zero, zero, zero, zero, zero, zero};
    const FN(bend) straight = {one, one, zero, zero, zero, zero, zero, zero, zero, zero, zero};
    sum->b[0] = sum->b[1] = sum->b[2] = zero;
    sum->gradient = flat;
    sum->bend = straight;
    for (int i = 0; i < kinds->pieces; ++i) {
        REAL own[3];
        FN(local_field) at;
        FN(place_in_part)(parts, kinds, i, x, y, z, own);
        FN(part_look)(&parts->part[i], kinds->part[i], own, &at);
        if (kinds->part_turned[i]) {
            FN(turn_field)(&parts->part[i], at.b, &at.gradient);
            FN(turn_bend)(&parts->part[i], &at.bend);
        }
        for (int k = 0; k < 3; ++k)
            sum->b[k] = sum->b[k] + at.b[k];
        FN(add_gradient)(&sum->gradient, &at.gradient);
        FN(add_bend)(&sum->bend, &at.bend);
    }
}

SOURCE_ALONG_BY_FIELD(parts)
