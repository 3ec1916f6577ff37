/* cuboid.inl - the field of a uniformly magnetised block, over REAL.
 *
 * What is wanted are the derivatives of Phi, the integral of 1/|x - x'| over the block (derivatives.inl).  With
 * u = x + a, x - a from the lower and the upper face (v and w alike) and r = |(u, v, w)|, they are sums over
 * the eight corners, each upper coordinate changing the sign:
 *
 *     Phi_xx = -sum of atan(v w/(u r)),   Phi_xy = sum of log(r + w),   Phi_xyz = sum of 1/r,
 *     Phi_xxy = sum of u/(r (r + w)),     Phi_xxyz = -sum of u/r^3,     and so on.
 *
 * Written down like this they are wrong beside the block, where r + w cancels, and lose digits with the
 * distance, at which the corners' terms cancel each other.  So corners are taken together first, by hand:
 *
 *     an edge                two corners: l its length, q = r r' + (r.r') = ((r + r')^2 - l^2)/2
 *         log(r + w) - log(r' + w') = log(s^2/(2 q)), s = r + r' + l:     the integral of 1/r along the edge
 *         1/(r (r + w)) - ...       = -l (r + r')/(q r r') = K,           which u multiplies in Phi_xxy,
 *                                                                         v in Phi_xyy
 *     four parallel edges    one logarithm of a ratio, whose distance from 1 follows from differences of s
 *     a face                 its solid angle W, tan(W/2) = N/D of both triangles into which a diagonal parts it
 *                            (van Oosterom and Strackee, IEEE Trans. Biomed. Eng. 30 (1983) 125): the angle of
 *                            (D + i N)(D' + i N), where N is u times the area for both
 *     two opposite faces     Phi_xx is the difference of their solid angles: one angle of a product
 *
 * q vanishes on the edge itself alone.  Where the foot of the place lies between the edge's ends (w w' < 0) it
 * is computed as c^2 (r r' - w w' + r^2 + w'^2)/(r r' - w w'), c being the distance from the edge's line.
 *
 * Beyond cuboid_far half diagonals Phi is the block's multipole series (far_form()): of three cancellations,
 * that of opposite corners, edges and faces, the first has been taken off above, and what the others leave is
 * still seen in the gradient.  Units: lengths in l, fields in B0.
 */
enum {
    FN(cuboid_far) = 10, /* half diagonals */
#ifdef REAL_BITS
    FN(cuboid_order) = 14 /* of the last multipole: the next is below 1e-15 of the field */
#else
    FN(cuboid_order) = 18
#endif
};

/* ------------------------------------------------------------------ near: corners, edges, faces */

/* Corner 4 i + 2 j + k has the coordinates u[0][i], u[1][j], u[2][k]; index 0 is the lower face.  The edges
 * along the axis c are numbered by 2 i + j, i belonging to the axis after c (cyclic) and j to the one after
 * that. */
typedef struct FN(cuboid_view) {
    REAL place[3], half[3];
    REAL u[3][2], u2[3][2];
    REAL r[8], inverse_r[8];
    REAL q[3][4], inverse_q[3][4], inverse_rr[3][4], k[3][4]; /* of edges; inverse_rr: 1/(r r') */
} FN(cuboid_view);

#define CORNER_STEP(axis) (4 >> (axis))
#define AXIS_AFTER(axis) (((axis) + 1) % 3)
#define EDGE_CORNER(axis, edge)                                                                                \
    (((edge) >> 1) * CORNER_STEP(AXIS_AFTER(axis)) + ((edge)&1) * CORNER_STEP(AXIS_AFTER((axis) + 1)))
#define EDGE_END(axis, edge) (EDGE_CORNER(axis, edge) + CORNER_STEP(axis))

static inline __attribute__((always_inline)) void FN(see_edges)(FN(cuboid_view) * at, int axis)
{
    const REAL *u2 = at->u2[axis], *a2 = at->u2[AXIS_AFTER(axis)], *b2 = at->u2[AXIS_AFTER(axis + 1)];
    const REAL product = at->u[axis][0] * at->u[axis][1], along2 = u2[0] + u2[1];
    const REAL_MASK between = REAL_LESS(product, R(0.0));
    const REAL apart = REAL_ABS(product);
    const REAL minus_l = R(-2.0) * at->half[axis];
    for (int edge = 0; edge < 4; ++edge) {
        const int from = EDGE_CORNER(axis, edge), to = EDGE_END(axis, edge);
        const REAL across2 = a2[edge >> 1] + b2[edge & 1];
        const REAL sum = REAL_MULADD(at->r[from], at->r[to], apart);
        const REAL over = REAL_SELECT(between, across2 * (sum + (across2 + along2)), across2 + sum);
        const REAL under = REAL_SELECT(between, sum, R(1.0));
        const REAL inverse = REAL_RECIPROCAL(over * under);
        at->q[axis][edge] = (over * over) * inverse;
        at->inverse_q[axis][edge] = (under * under) * inverse;
        at->inverse_rr[axis][edge] = at->inverse_r[from] * at->inverse_r[to];
        at->k[axis][edge] =
            (minus_l * (at->r[from] + at->r[to])) * (at->inverse_q[axis][edge] * at->inverse_rr[axis][edge]);
    }
}

static inline __attribute__((always_inline)) FN(cuboid_view)
    FN(see_cuboid)(const FN(part) * part, const REAL d[3])
{
    FN(cuboid_view) at;
    for (int i = 0; i < 3; ++i) {
        at.place[i] = d[i];
        at.half[i] = part->half[i];
        at.u[i][0] = d[i] + part->half[i];
        at.u[i][1] = d[i] - part->half[i];
        for (int side = 0; side < 2; ++side)
            at.u2[i][side] = at.u[i][side] * at.u[i][side];
    }
    for (int corner = 0; corner < 8; ++corner) {
        const REAL r2 = (at.u2[0][corner >> 2] + at.u2[1][corner >> 1 & 1]) + at.u2[2][corner & 1];
        at.inverse_r[corner] = REAL_RECIPROCAL_SQRT(r2);
        at.r[corner] = REAL_ROOT(r2, at.inverse_r[corner]);
    }
    /* In lanes a loop is not taken apart by itself, and the corners then wait in memory: a third of the time. */
#ifndef REAL_IS_SCALAR
#pragma GCC unroll 3
#endif
    for (int axis = 0; axis < 3; ++axis)
        FN(see_edges)(&at, axis);
    return at;
}

/* The derivative of Phi along both axes other than `axis`: log of (e_0/e_1)/(e_2/e_3) with e = s^2/q of the
 * four edges.  p - p' of the ratio p/p' follows from s_1 - s_0 = (r_1^2 - r_0^2)/(r_1 + r_0) + ..., because
 * s_0^2 q_1 - s_1^2 q_0 = l s_0 s_1 (s_1 - s_0). */
static inline __attribute__((always_inline)) REAL FN(mixed_second)(const FN(cuboid_view) * at, int axis)
{
    const int other = AXIS_AFTER(axis + 1); /* along which edges 0 and 1, and 2 and 3, differ */
    REAL s[4], sum[4];                      /* r + r' + l; r + r' of the edges along `other` */
    for (int edge = 0; edge < 4; ++edge) {
        s[edge] = (at->r[EDGE_CORNER(axis, edge)] + at->r[EDGE_END(axis, edge)]) + R(2.0) * at->half[axis];
        sum[edge] = at->r[EDGE_CORNER(other, edge)] + at->r[EDGE_END(other, edge)];
    }
    const REAL *q = at->q[axis];
    const REAL s01 = s[0] * s[1], s23 = s[2] * s[3];
    const REAL e0 = (s[0] * s[0]) * q[1], e1 = (s[1] * s[1]) * q[0];
    const REAL e2 = (s[2] * s[2]) * q[3], e3 = (s[3] * s[3]) * q[2];
    /* Of the edges along `other` 0 and 2 have the place of i = 0. */
    const REAL both0 = sum[0] * sum[2], both1 = sum[1] * sum[3];
    const REAL first = ((s01 * e3) * (sum[0] + sum[2])) * both1;
    const REAL second = ((s23 * e1) * (sum[1] + sum[3])) * both0;
    const REAL common = both0 * both1;
    const REAL factor = (R(-8.0) * at->half[axis]) * (at->place[other] * at->half[other]);
    return FN(log_of_ratio)((e0 * e3) * common, (e1 * e2) * common, factor * (first - second));
}

/* cosine and sine, times the same, of half the solid angle of a face; index `side` of `axis`. */
static inline __attribute__((always_inline)) void FN(see_face)(const FN(cuboid_view) * at, int axis, int side,
                                                               REAL *real, REAL *imaginary)
{
    const int b = AXIS_AFTER(axis), c = AXIS_AFTER(axis + 1);
    const int corner = side * CORNER_STEP(axis), across = corner + CORNER_STEP(b) + CORNER_STEP(c);
    const REAL ra = at->r[corner + CORNER_STEP(b)], rc = at->r[corner + CORNER_STEP(c)];
    const REAL product = REAL_MULADD(
        at->u[c][0], at->u[c][1], REAL_MULADD(at->u[b][0], at->u[b][1], at->u2[axis][side])); /* of both r's */
    const REAL diagonal = REAL_NEGMULADD(ra, rc, product);
    /* Edges along c at either end of b, and along b at either end of c. */
    const REAL *qc = at->q[c] + 2 * side, *qb = at->q[b] + side;
    const REAL d = REAL_MULADD(ra, qc[0], REAL_MULADD(rc, qb[0], at->r[corner] * diagonal));
    const REAL d_across = REAL_MULADD(ra, qb[2], REAL_MULADD(rc, qc[1], at->r[across] * diagonal));
    const REAL n = R(4.0) * (at->u[axis][side] * (at->half[b] * at->half[c]));
    *real = REAL_MULSUB(d, d_across, n * n);
    *imaginary = n * (d + d_across);
}

/* The second derivative of Phi along an axis. */
static inline __attribute__((always_inline)) REAL FN(straight_second)(const FN(cuboid_view) * at, int axis)
{
    REAL real[2], imaginary[2];
    for (int side = 0; side < 2; ++side)
        FN(see_face)(at, axis, side, &real[side], &imaginary[side]);
    return R(2.0) * FN(angle)(REAL_MULSUB(imaginary[1], real[0], imaginary[0] * real[1]),
                              REAL_MULADD(real[0], real[1], imaginary[0] * imaginary[1]));
}

/* a_0 (k_0 - k_1) - a_1 (k_2 - k_3) */
static inline __attribute__((always_inline)) REAL FN(weigh_first)(const REAL a[2], const REAL k[4])
{
    return REAL_MULSUB(a[0], k[0] - k[1], a[1] * (k[2] - k[3]));
}

static inline __attribute__((always_inline)) REAL FN(weigh_second)(const REAL b[2], const REAL k[4])
{
    return REAL_MULSUB(b[0], k[0] - k[2], b[1] * (k[1] - k[3]));
}

/* What the edges along one axis give.  a: the axis after it, b: the one after that. */
typedef struct FN(edge_sums) {
    REAL aab, abb;         /* third derivatives */
    REAL aaab, aabb, abbb; /* fourth */
} FN(edge_sums);

static inline __attribute__((always_inline)) FN(edge_sums)
    FN(add_edges)(const FN(cuboid_view) * at, int axis, int with_fourth)
{
    const REAL *a = at->u[AXIS_AFTER(axis)], *b = at->u[AXIS_AFTER(axis + 1)];
    const REAL *a2 = at->u2[AXIS_AFTER(axis)], *b2 = at->u2[AXIS_AFTER(axis + 1)];
    const REAL l2 = R(4.0) * (at->half[axis] * at->half[axis]);
    const REAL *k = at->k[axis];
    REAL change[4]; /* 2 dK/d(c^2) */
    for (int edge = 0; with_fourth && edge < 4; ++edge) {
        const REAL from = at->r[EDGE_CORNER(axis, edge)], to = at->r[EDGE_END(axis, edge)];
        const REAL inverse = at->inverse_rr[axis][edge], squares = REAL_MULADD(from, from, to * to);
        const REAL slope = REAL_MULADD(squares, inverse, REAL_MULADD(l2, at->inverse_q[axis][edge], R(1.0)));
        change[edge] = -(k[edge] * inverse) * slope;
    }
    FN(edge_sums) sums;
    sums.aab = FN(weigh_first)(a, k);
    sums.abb = FN(weigh_second)(b, k);
    if (with_fourth) {
        const REAL all = (k[0] - k[1]) - (k[2] - k[3]);
        sums.aaab = all + FN(weigh_first)(a2, change);
        sums.abbb = all + FN(weigh_second)(b2, change);
        const REAL a01 = REAL_MULSUB(b[0], change[0], b[1] * change[1]);
        const REAL a23 = REAL_MULSUB(b[0], change[2], b[1] * change[3]);
        sums.aabb = REAL_MULSUB(a[0], a01, a[1] * a23);
    }
    return sums;
}

/* sum of sign times value over the corners */
static inline __attribute__((always_inline)) REAL FN(add_corners)(const REAL v[8])
{
    return ((v[0] - v[1]) - (v[2] - v[3])) - ((v[4] - v[5]) - (v[6] - v[7]));
}

static inline __attribute__((always_inline)) void FN(near_form)(const FN(part) * part, const REAL d[3],
                                                                int with_fourth, FN(form) * f)
{
    const FN(cuboid_view) at = FN(see_cuboid)(part, d);
    f->xx = FN(straight_second)(&at, 0);
    f->yy = FN(straight_second)(&at, 1);
    f->yz = FN(mixed_second)(&at, 0);
    f->xz = FN(mixed_second)(&at, 1);
    f->xy = FN(mixed_second)(&at, 2);
    const FN(edge_sums) x = FN(add_edges)(&at, 0, with_fourth), y = FN(add_edges)(&at, 1, with_fourth),
                        z = FN(add_edges)(&at, 2, with_fourth);
    f->xxy = z.aab;
    f->xyy = z.abb;
    f->yyz = x.aab;
    f->xxz = y.abb;
    f->xxx = -(f->xyy + y.aab);
    f->yyy = -(f->xxy + x.abb);
    f->xyz = FN(add_corners)(at.inverse_r);
    if (with_fourth) {
        REAL cube[8], of_x[8], of_y[8];
        for (int corner = 0; corner < 8; ++corner) {
            cube[corner] = (at.inverse_r[corner] * at.inverse_r[corner]) * at.inverse_r[corner];
            of_x[corner] = at.u[0][corner >> 2] * cube[corner];
            of_y[corner] = at.u[1][corner >> 1 & 1] * cube[corner];
        }
        f->xxyz = -FN(add_corners)(of_x);
        f->xyyz = -FN(add_corners)(of_y);
        f->xxxy = z.aaab;
        f->xxyy = z.aabb;
        f->xyyy = z.abbb;
        f->yyyz = x.aaab;
        f->xxxz = y.abbb;
        f->xxxx = -(f->xxyy + y.aabb);
        f->yyyy = -(f->xxyy + x.aabb);
    }
}

/* ------------------------------------------------------------------ far: multipoles */

enum { FN(far_pairs) = FN(cuboid_order) / 2, FN(far_derivatives) = FN(cuboid_order) + 4 };

/* Phi/V = sum of m[i][j] (d/dx)^(2 i) (d/dy)^(2 j) of 1/r.  The mean over the block of 1/|x - x'| is the
 * product of sinh(a d/dx)/(a d/dx) and its like along y and z, and of z only (d/dz)^2 = -(d/dx)^2 - (d/dy)^2 is
 * asked. */
static inline __attribute__((always_inline)) void
FN(cuboid_moments)(const REAL half[3], REAL m[FN(far_pairs) + 1][FN(far_pairs) + 1])
{
    enum { pairs = FN(far_pairs) };
    REAL power[3][pairs + 1]; /* a^(2 i)/(2 i + 1)! */
    REAL plane[pairs + 1][pairs + 1];
    for (int axis = 0; axis < 3; ++axis) {
        const REAL a2 = axis == 2 ? -(half[2] * half[2]) : half[axis] * half[axis];
        power[axis][0] = R(1.0);
        for (int i = 1; i <= pairs; ++i)
            power[axis][i] = power[axis][i - 1] * (a2 * (R(1.0) / REAL_OF(2 * i * (2 * i + 1))));
    }
    for (int i = 0; i <= pairs; ++i)
        for (int j = 0; i + j <= pairs; ++j) {
            plane[i][j] = power[0][i] * power[1][j];
            m[i][j] = power[2][pairs] * plane[i][j];
        }
    /* Horner's rule in (d/dx)^2 + (d/dy)^2, which raises one index or the other. */
    for (int k = pairs - 1; k >= 0; --k)
        for (int i = pairs; i >= 0; --i)
            for (int j = pairs - i; j >= 0; --j) {
                REAL raised = power[2][k] * plane[i][j];
                if (i > 0)
                    raised = raised + m[i - 1][j];
                if (j > 0)
                    raised = raised + m[i][j - 1];
                m[i][j] = raised;
            }
}

/* Derivatives of 1/r by x and y: of[0][i][j], and by z as well: of[1][i][j].  Those of order n follow from
 * those of the two orders below:  n r^2 D_k + (2 n - 1) sum of k_i x_i D_(k - e_i) + (n - 1) sum of k_i (k_i -
 * 1) D_(k - 2 e_i) = 0  (r^2 grad 1/r = -x/r, differentiated). */
typedef REAL FN(inverse_distance)[2][FN(far_derivatives) + 1][FN(far_derivatives) + 1];

static inline __attribute__((always_inline)) void FN(derive_inverse_distance)(const REAL d[3], int last,
                                                                              FN(inverse_distance) of)
{
    const REAL r2 = REAL_MULADD(d[2], d[2], REAL_MULADD(d[1], d[1], d[0] * d[0]));
    const REAL inverse2 = R(1.0) / r2;
    of[0][0][0] = inverse2 * REAL_SQRT(r2);
    for (int n = 1; n <= last; ++n) {
        const REAL share = R(1.0) / REAL_OF(n), once = -inverse2 * (R(2.0) - share),
                   twice = -inverse2 * (R(1.0) - share);
        const REAL by_x = once * d[0], by_y = once * d[1], by_z = once * d[2];
        for (int vertical = 0; vertical < 2; ++vertical)
            for (int i = n - vertical; i >= 0; --i) {
                const int j = n - vertical - i;
                REAL sum = R(0.0);
                if (vertical)
                    sum = by_z * of[0][i][j];
                if (i > 0)
                    sum = REAL_MULADD(by_x * REAL_OF(i), of[vertical][i - 1][j], sum);
                if (j > 0)
                    sum = REAL_MULADD(by_y * REAL_OF(j), of[vertical][i][j - 1], sum);
                if (i > 1)
                    sum = REAL_MULADD(twice * REAL_OF(i * (i - 1)), of[vertical][i - 2][j], sum);
                if (j > 1)
                    sum = REAL_MULADD(twice * REAL_OF(j * (j - 1)), of[vertical][i][j - 2], sum);
                of[vertical][i][j] = sum;
            }
    }
}

static inline void FN(far_form)(const FN(part) * part, const REAL d[3], int with_fourth, FN(form) * f)
{
    /* The members of the form in their order, as derivatives along x, y and z. */
    static const unsigned char of_member[FN(form_all)][3] = {
        {2, 0, 0}, {1, 1, 0}, {0, 2, 0}, {1, 0, 1}, {0, 1, 1}, {3, 0, 0}, {2, 1, 0},
        {1, 2, 0}, {0, 3, 0}, {2, 0, 1}, {1, 1, 1}, {0, 2, 1}, {4, 0, 0}, {3, 1, 0},
        {2, 2, 0}, {1, 3, 0}, {0, 4, 0}, {3, 0, 1}, {2, 1, 1}, {1, 2, 1}, {0, 3, 1}};
    REAL m[FN(far_pairs) + 1][FN(far_pairs) + 1];
    FN(inverse_distance) of;
    FN(cuboid_moments)(part->half, m);
    FN(derive_inverse_distance)(d, FN(cuboid_order) + (with_fourth ? 4 : 3), of);
    const REAL volume = R(8.0) * (part->half[0] * (part->half[1] * part->half[2]));
    for (int n = 0; n < (with_fourth ? FN(form_all) : FN(form_of_field)); ++n) {
        const unsigned char *by = of_member[n];
        REAL sum = R(0.0);
        for (int order = FN(far_pairs); order >= 0; --order) /* the least first */
            for (int i = 0; i <= order; ++i)
                sum = REAL_MULADD(m[i][order - i], of[by[2]][2 * i + by[0]][2 * (order - i) + by[1]], sum);
        f->all[n] = volume * sum;
    }
}

/* ------------------------------------------------------------------ both */

static inline __attribute__((always_inline)) void FN(cuboid_form)(const FN(part) * part, const REAL d[3],
                                                                  int with_fourth, FN(form) * f)
{
    const REAL *a = part->half, limit = REAL_OF(FN(cuboid_far) * FN(cuboid_far));
    const REAL r2 = SUM_3(d[0], d[0], d[1], d[1], d[2], d[2]);
    const REAL_MASK far = REAL_LESS(limit * SUM_3(a[0], a[0], a[1], a[1], a[2], a[2]), r2);
    FN(near_form)(part, d, with_fourth, f);
    if (!REAL_ANY(far))
        return;
    FN(form) series;
    FN(far_form)(part, d, with_fourth, &series);
    for (int n = 0; n < (with_fourth ? FN(form_all) : FN(form_of_field)); ++n)
        f->all[n] = REAL_SELECT(far, series.all[n], f->all[n]);
}

/* B and G of a block at the place d from its centre. */
PART_KIND void FN(cuboid_field)(const FN(part) * part, const REAL d[3], REAL b[3], FN(gradient) * g)
{
    FN(form) f;
    FN(cuboid_form)(part, d, 0, &f);
    FN(field_of_form)(&f, part->j, b, g);
}

/* And T. */
PART_KIND void FN(cuboid_look)(const FN(part) * part, const REAL d[3], FN(local_field) * at)
{
    FN(form) f;
    FN(cuboid_form)(part, d, 1, &f);
    FN(field_of_form)(&f, part->j, at->b, &at->gradient);
    FN(bend_of_form)(&f, part->j, &at->bend);
}
