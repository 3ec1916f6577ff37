/* part_local.inl - one part of a magnet as its field functions see it: its numbers, and its axes, over REAL.
 *
 * A field function adds nothing up and turns nothing: it is given the place from the part's centre along the
 * part's own axes, and leaves B and G, or B, G and T, along these axes.  Lengths are in l, fields in B0.
 */
#define PART_KIND                                                                                              \
    static __attribute__((noinline, unused)) /* long: a copy for each caller would fill the cache */

typedef struct FN(part) {
    REAL centre[3];
    REAL half[3];    /* cuboid: half edges; cylinder: radius, radius, half height; sphere: radius each */
    REAL j[3];       /* remanence over B0; of a dipole and a sphere mu_0 m/(4 pi l^3 B0) */
    REAL axes[3][3]; /* axes[a] is the part's own axis a, along the magnet's */
} FN(part);

/* The part's own axes, by Rodrigues' formula. */
static inline void FN(set_axes)(const double rotation[4], REAL axes[3][3])
{
    double sine, cosine;
    fst_sin_cos_degrees(rotation[0], &sine, &cosine);
    const double *k = rotation + 1;
    const REAL size2 = REAL_OF(k[0] * k[0] + (k[1] * k[1] + k[2] * k[2]));
    for (int a = 0; a < 3; ++a)
        for (int i = 0; i < 3; ++i) {
            const int after = (a + 1) % 3 == i;
            const int other = 3 - a - i; /* of a != i: e_a x ... turns about the third axis */
            if (rotation[0] == 0) {
                axes[a][i] = REAL_OF(a == i);
                continue;
            }
            REAL value = REAL_OF(k[a]) * REAL_OF(k[i]) * (R(1.0) - REAL_OF(cosine)) / size2;
            if (a == i)
                value = value + REAL_OF(cosine);
            else
                value = value + REAL_OF(after ? k[other] : -k[other]) * REAL_OF(sine) / REAL_SQRT(size2);
            axes[a][i] = value;
        }
}

static inline FN(part) FN(make_part)(const fst_magnet_part *from, const fst_groups *g)
{
    FN(part) part;
    const REAL l = REAL_OF(g->length_unit), b0 = REAL_OF(g->field_unit);
    const int point = from->kind == FST_PART_DIPOLE, ball = from->kind == FST_PART_SPHERE;
    for (int i = 0; i < 3; ++i) {
        const double size = ball                              ? from->size[0]
                            : from->kind == FST_PART_CYLINDER ? from->size[i == 2]
                                                              : from->size[i];
        part.centre[i] = REAL_OF(from->centre[i]) / l;
        part.half[i] = R(0.5) * REAL_OF(point ? 0.0 : size) / l;
        part.j[i] = REAL_OF(point ? from->moment[i] : from->remanence[i]) / b0;
    }
    /* B of a uniform sphere is that of a dipole outside, m = J (4 pi/3) R^3/mu_0. */
    const REAL radius3 = part.half[0] * part.half[0] * part.half[0];
    const REAL strength =
        point ? REAL_OF(FST_MU_0) / (R(2.0) * REAL_OF(FST_TWO_PI) * (l * l * l)) : radius3 / R(3.0);
    for (int i = 0; i < 3 && (point || ball); ++i)
        part.j[i] = part.j[i] * strength;
    FN(set_axes)(from->rotation, part.axes);
    return part;
}

/* From the magnet's axes to the part's. */
static inline void FN(into_part)(const FN(part) * part, const REAL v[3], REAL own[3])
{
    for (int a = 0; a < 3; ++a)
        own[a] =
            REAL_MULADD(part->axes[a][2], v[2], REAL_MULADD(part->axes[a][1], v[1], part->axes[a][0] * v[0]));
}

/* T of local_field.inl as all its 27 numbers, and back; its scale and vertical are 1 here. */
static inline void FN(spread_bend)(const FN(bend) * t, REAL all[3][3][3])
{
    const REAL xzz = -(t->xxx + t->xyy), yzz = -(t->xxy + t->yyy), zzz = -(t->xxz + t->yyz);
    const REAL of_plane[3][3] = {{t->xxx, t->xxy, t->xyy}, {t->xxy, t->xyy, t->yyy}, {t->xxz, t->xyz, t->yyz}};
    for (int k = 0; k < 3; ++k) {
        all[0][0][k] = of_plane[k][0];
        all[0][1][k] = all[1][0][k] = of_plane[k][1];
        all[1][1][k] = of_plane[k][2];
    }
    const REAL xz[3] = {t->xxz, t->xyz, xzz}, yz[3] = {t->xyz, t->yyz, yzz}, zz[3] = {xzz, yzz, zzz};
    for (int k = 0; k < 3; ++k) {
        all[0][2][k] = all[2][0][k] = xz[k];
        all[1][2][k] = all[2][1][k] = yz[k];
        all[2][2][k] = zz[k];
    }
}

/* One index of T from the part's axes to the magnet's; the index that was first is then the last. */
static inline void FN(turn_index)(const FN(part) * part, REAL t[3][3][3])
{
    REAL turned[3][3][3];
    for (int i = 0; i < 3; ++i)
        for (int j = 0; j < 3; ++j)
            for (int k = 0; k < 3; ++k)
                turned[j][k][i] =
                    REAL_MULADD(part->axes[2][i], t[2][j][k],
                                REAL_MULADD(part->axes[1][i], t[1][j][k], part->axes[0][i] * t[0][j][k]));
    memcpy(t, turned, sizeof turned);
}

static inline void FN(turn_bend)(const FN(part) * part, FN(bend) * t)
{
    REAL all[3][3][3];
    FN(spread_bend)(t, all);
    for (int index = 0; index < 3; ++index)
        FN(turn_index)(part, all);
    t->xxx = all[0][0][0];
    t->xxy = all[0][0][1];
    t->xyy = all[0][1][1];
    t->yyy = all[1][1][1];
    t->xxz = all[0][0][2];
    t->xyz = all[0][1][2];
    t->yyz = all[1][1][2];
}

/* B and G from the part's axes to the magnet's. */
static inline void FN(turn_field)(const FN(part) * part, REAL b[3], FN(gradient) * g)
{
    const REAL zz = -(g->xx + g->yy);
    const REAL own[3][3] = {{g->xx, g->xy, g->xz}, {g->xy, g->yy, g->yz}, {g->xz, g->yz, zz}};
    REAL half[3][3], of[3] = {b[0], b[1], b[2]}; /* half: second index turned */
    for (int i = 0; i < 3; ++i) {
        b[i] = REAL_MULADD(part->axes[2][i], of[2],
                           REAL_MULADD(part->axes[1][i], of[1], part->axes[0][i] * of[0]));
        for (int a = 0; a < 3; ++a)
            half[a][i] = REAL_MULADD(part->axes[2][i], own[a][2],
                                     REAL_MULADD(part->axes[1][i], own[a][1], part->axes[0][i] * own[a][0]));
    }
#define TURNED(i, j)                                                                                           \
    REAL_MULADD(part->axes[2][i], half[2][j],                                                                  \
                REAL_MULADD(part->axes[1][i], half[1][j], part->axes[0][i] * half[0][j]))
    g->xx = TURNED(0, 0);
    g->xy = TURNED(0, 1);
    g->yy = TURNED(1, 1);
    g->xz = TURNED(0, 2);
    g->yz = TURNED(1, 2);
#undef TURNED
}
