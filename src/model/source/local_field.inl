/* local_field.inl - the field of a source at one place, over REAL.
 *
 * Where the bead is, the field has neither curl nor divergence.  So the gradient G_ij = dB_i/dx_j is symmetric
 * and traceless, and G's own derivatives T_ijk = dG_ij/dx_k are so in every pair of indices: 3 + 5 + 7 numbers.
 * G has all that a height changes of B, and the derivatives of G along x and y are all of T.
 *
 * A measured field has some curl, because it is not exact.  Its force keeps the energy all the same if it is
 * the derivative of the energy -u.B by the place, that is G^T u with dB_x/dy and dB_y/dx told apart.  So these
 * two have a number each (xy and yx), and their derivatives too; a source without curl leaves the second ones
 * to no_curl().  Derivatives along z are those of a field without curl and divergence: they enter the load
 * alone.
 */
typedef struct FN(gradient) {
    REAL xx, yy, xy, xz, yz; /* zz = -(xx + yy) */
    REAL yx;                 /* dB_y/dx; xy is dB_x/dy */
} FN(gradient);

/* How G changes from place to place: T_xxx = scale * xxx, ..., T_xxz = scale * vertical * xxz, ...  Factors
 * that are common to all of a source multiply the direction, once a tangent, instead of each number; 1 where a
 * source has none. */
typedef struct FN(bend) {
    REAL scale, vertical;
    REAL xxx, xxy, xyy, yyy, xxz, xyz, yyz;
    REAL yxx, yxy; /* derivatives of B_y where xxy and xyy are those of B_x */
} FN(bend);

typedef struct FN(local_field) {
    REAL b[3];
    FN(gradient) gradient;
    FN(bend) bend;
} FN(local_field);

/* Fill in what a field without curl has twice. */
static inline __attribute__((always_inline)) void FN(no_curl)(FN(gradient) * g)
{
    g->yx = g->xy;
}

static inline __attribute__((always_inline)) void FN(no_curl_anywhere)(FN(local_field) * at)
{
    FN(no_curl)(&at->gradient);
    at->bend.yxx = at->bend.xxy;
    at->bend.yxy = at->bend.xyy;
}

/* G^T u, which is G u in a field without curl. */
static inline void FN(times_gradient)(const FN(gradient) * g, const REAL u[3], REAL gu[3])
{
    gu[0] = REAL_MULADD(g->xz, u[2], REAL_MULADD(g->yx, u[1], g->xx * u[0]));
    gu[1] = REAL_MULADD(g->yz, u[2], REAL_MULADD(g->yy, u[1], g->xy * u[0]));
    gu[2] = REAL_NEGMULADD(g->xx + g->yy, u[2], REAL_MULADD(g->yz, u[1], g->xz * u[0]));
}

/* dB as the place moves by (ex, ey). */
static inline void FN(field_change)(const FN(gradient) * g, REAL ex, REAL ey, REAL db[3])
{
    db[0] = REAL_MULADD(g->xx, ex, g->xy * ey);
    db[1] = REAL_MULADD(g->yx, ex, g->yy * ey);
    db[2] = REAL_MULADD(g->xz, ex, g->yz * ey);
}

/* dG as the place moves by (ex, ey). */
static inline void FN(gradient_change)(const FN(bend) * t, REAL ex, REAL ey, FN(gradient) * dg)
{
    const REAL x = t->scale * ex, y = t->scale * ey, zx = t->vertical * x, zy = t->vertical * y;
    dg->xx = REAL_MULADD(x, t->xxx, y * t->xxy);
    dg->xy = REAL_MULADD(x, t->xxy, y * t->xyy);
    dg->yx = REAL_MULADD(x, t->yxx, y * t->yxy);
    dg->yy = REAL_MULADD(x, t->yxy, y * t->yyy);
    dg->xz = REAL_MULADD(zx, t->xxz, zy * t->xyz);
    dg->yz = REAL_MULADD(zx, t->xyz, zy * t->yyz);
}

/* What dB and dG have besides as the place rises by ez, in a field without curl (no bead flies beside a measured
 * one). */
static inline void FN(add_rise)(const FN(local_field) * at, REAL ez, REAL db[3], FN(gradient) * dg)
{
    const FN(gradient) *g = &at->gradient;
    const FN(bend) *t = &at->bend;
    const REAL z = t->scale * ez, zz = t->vertical * z;
    db[0] = REAL_MULADD(g->xz, ez, db[0]);
    db[1] = REAL_MULADD(g->yz, ez, db[1]);
    db[2] = REAL_NEGMULADD(g->xx + g->yy, ez, db[2]);
    dg->xx = REAL_MULADD(zz, t->xxz, dg->xx);
    dg->xy = REAL_MULADD(zz, t->xyz, dg->xy);
    dg->yx = REAL_MULADD(zz, t->xyz, dg->yx);
    dg->yy = REAL_MULADD(zz, t->yyz, dg->yy);
    dg->xz = REAL_NEGMULADD(z, t->xxx + t->xyy, dg->xz);
    dg->yz = REAL_NEGMULADD(z, t->xxy + t->yyy, dg->yz);
}

/* For a source that has no quicker way to B and G than its whole local field: defines NAME_field of its
 * NAME_look (sources.inl). */
#define SOURCE_FIELD_BY_LOOK(name)                                                                             \
    static inline __attribute__((always_inline)) void FN(name##_field)(                                        \
        const FN(name) * source, const fst_kinds *kinds, REAL x, REAL y, REAL z, REAL b[3], FN(gradient) * g)  \
    {                                                                                                          \
        FN(local_field) at;                                                                                    \
        FN(name##_look)(source, kinds, x, y, z, &at);                                                          \
        for (int i = 0; i < 3; ++i)                                                                            \
            b[i] = at.b[i];                                                                                    \
        *g = at.gradient;                                                                                      \
    }

/* For one that has no quicker way to B and G u than B and G: defines NAME_along of its NAME_field. */
#define SOURCE_ALONG_BY_FIELD(name)                                                                            \
    static inline void FN(name##_along)(const FN(name) * source, const fst_kinds *kinds, REAL x, REAL y,       \
                                        REAL z, const REAL u[3], REAL b[3], REAL gu[3])                        \
    {                                                                                                          \
        FN(gradient) g;                                                                                        \
        FN(name##_field)(source, kinds, x, y, z, b, &g);                                                       \
        FN(no_curl)(&g);                                                                                       \
        FN(times_gradient)(&g, u, gu);                                                                         \
    }

/* For one that has no quicker way to either. */
#define SOURCE_ALONG_BY_LOOK(name)                                                                             \
    SOURCE_FIELD_BY_LOOK(name)                                                                                 \
    SOURCE_ALONG_BY_FIELD(name)
