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

/* A place of the magnet as a part sees it. */
static inline void FN(place_in_part)(const FN(part) * part, int turned, const REAL place[3], REAL own[3])
{
    const REAL from[3] = {place[0] - part->centre[0], place[1] - part->centre[1], place[2] - part->centre[2]};
    if (turned)
        FN(into_part)(part, from, own);
    else
        memcpy(own, from, sizeof from);
}

#ifdef REAL_PAIR
/* B and G, or B, G and T, of two parts of one kind at the places d, for little more than those of one
 * (two_parts.c). */
void fst_two_parts_field(const FN(part) parts[2], int kind, REAL d[2][3], FN(local_field) found[2]);
void fst_two_parts_look(const FN(part) parts[2], int kind, REAL d[2][3], FN(local_field) found[2]);
#endif

/* B and G, and T where it is wanted, of part i along the magnet's axes; where a register holds two numbers and the
 * next part is of the same kind, whose field is long to compute, of both; returns of how many. */
static inline __attribute__((always_inline)) int FN(look_at_next)(const FN(parts) * parts,
                                                                  const fst_kinds *kinds, int i,
                                                                  const REAL place[3], int with_bend,
                                                                  FN(local_field) found[2])
{
    const FN(part) *part = &parts->part[i];
    const int kind = kinds->part[i];
    int count = 1;
    REAL own[2][3];
    FN(place_in_part)(part, kinds->part_turned[i], place, own[0]);
#ifdef REAL_PAIR
    const int is_long = kind == FST_PART_CUBOID || kind == FST_PART_CYLINDER;
    if (is_long && i + 1 < kinds->pieces && kinds->part[i + 1] == kind) {
        count = 2;
        FN(place_in_part)(part + 1, kinds->part_turned[i + 1], place, own[1]);
        (with_bend ? fst_two_parts_look : fst_two_parts_field)(part, kind, own, found);
    }
#endif
    if (count == 1 && with_bend)
        FN(part_look)(part, kind, own[0], &found[0]);
    else if (count == 1)
        FN(part_field)(part, kind, own[0], found[0].b, &found[0].gradient);
    for (int k = 0; k < count; ++k) {
        if (!kinds->part_turned[i + k])
            continue;
        FN(turn_field)(&part[k], found[k].b, &found[k].gradient);
        if (with_bend)
            FN(turn_bend)(&part[k], &found[k].bend);
    }
    return count;
}

static inline __attribute__((always_inline)) void FN(parts_field)(const FN(parts) * parts,
                                                                  const fst_kinds *kinds, REAL x, REAL y,
                                                                  REAL z, REAL b[3], FN(gradient) * sum)
{
    const REAL zero = R(0.0), place[3] = {x, y, z};
    const FN(gradient) flat = {zero, zero, zero, zero, zero, zero};
    FN(local_field) found[2];
    b[0] = b[1] = b[2] = zero;
    *sum = flat;
    for (int i = 0, end = 0; i < kinds->pieces; i = end) {
        end = i + FN(look_at_next)(parts, kinds, i, place, 0, found);
        for (const FN(local_field) *at = found; i < end; ++i, ++at) {
            for (int k = 0; k < 3; ++k)
                b[k] = b[k] + at->b[k];
            FN(add_gradient)(sum, &at->gradient);
        }
    }
}

static inline __attribute__((always_inline)) void
FN(parts_look)(const FN(parts) * parts, const fst_kinds *kinds, REAL x, REAL y, REAL z, FN(local_field) * sum)
{
    const REAL zero = R(0.0), one = R(1.0), place[3] = {x, y, z};
    const FN(gradient) flat = {zero, zero, zero, zero, zero, zero};
    const FN(bend) straight = {one, one, zero, zero, zero, zero, zero, zero, zero, zero, zero};
    FN(local_field) found[2];
    sum->b[0] = sum->b[1] = sum->b[2] = zero;
    sum->gradient = flat;
    sum->bend = straight;
    for (int i = 0, end = 0; i < kinds->pieces; i = end) {
        end = i + FN(look_at_next)(parts, kinds, i, place, 1, found);
        for (const FN(local_field) *at = found; i < end; ++i, ++at) {
            for (int k = 0; k < 3; ++k)
                sum->b[k] = sum->b[k] + at->b[k];
            FN(add_gradient)(&sum->gradient, &at->gradient);
            FN(add_bend)(&sum->bend, &at->bend);
        }
    }
}

SOURCE_ALONG_BY_FIELD(parts)
