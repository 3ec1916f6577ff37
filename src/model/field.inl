/* field.inl - the magnet's field and its gradient along a direction in one pass, over REAL.
 *
 * Each line of dipoles is two point charges, +1 at X = 1 and -1 at X = -1 (paper, section Modelling, the
 * equation before Fig. portrait).  With d from a charge of sign s to the bead,
 *
 *     B    = sum of s d/|d|^3,
 *     G_ij = dB_i/dx_j = sum of s (delta_ij/|d|^3 - 3 d_i d_j/|d|^5),
 *     G u  = sum of s (u/|d|^3 - 3 d (d.u)/|d|^5),
 *
 * and the last is all that a force needs: u is known before the roots and quotients are, so G u comes almost
 * with B. G is symmetric and traceless: curl B = 0 and div B = 0.
 */

/* The whole gradient. */
typedef struct FN(gradient) {
    REAL xx, yy, xy, xz, yz; /* zz = -(xx + yy) */
} FN(gradient);

static inline void FN(times_gradient)(const FN(gradient) * g, const REAL u[3], REAL gu[3])
{
    gu[0] = REAL_MULADD(g->xz, u[2], REAL_MULADD(g->xy, u[1], g->xx * u[0]));
    gu[1] = REAL_MULADD(g->yz, u[2], REAL_MULADD(g->yy, u[1], g->xy * u[0]));
    gu[2] = REAL_NEGMULADD(g->xx + g->yy, u[2], REAL_MULADD(g->yz, u[1], g->xz * u[0]));
}

/* All that B and G need of a line's end are the moments s_m = sum of Y^m/|d|^5 with m = 0 to 3 over the lines,
 * Y being the distance along y: |d|^2 = a + Y^2 with one a = X^2 + h^2 for an end, so
 *
 *     sum of 1/|d|^3 = a s_0 + s_2,        sum of Y/|d|^3 = a s_1 + s_3.
 */
typedef struct FN(moments) {
    REAL s0, s1, s2, s3;
    REAL q0, q1; /* of 1/|d|^7, for the gradient's own derivatives (tangent.inl) */
} FN(moments);

/* B and G by the moments of the plus end and the minus end, that lie dx away along x, with a = across2 and the
 * strength f of a line. */
static inline __attribute__((always_inline)) void FN(field_of_moments)(REAL h, REAL f, const REAL dx[2],
                                                                       const REAL across2[2],
                                                                       const FN(moments) sum[2], REAL b[3],
                                                                       FN(gradient) * g)
{
    const FN(moments) p = sum[0], m = sum[1];
    const REAL h3 = R(3.0) * h * f, f3 = R(3.0) * f;
    const REAL q_plus = REAL_MULADD(across2[0], p.s0, p.s2), q_minus = REAL_MULADD(across2[1], m.s0, m.s2);
    const REAL yq_plus = REAL_MULADD(across2[0], p.s1, p.s3), yq_minus = REAL_MULADD(across2[1], m.s1, m.s3);
    const REAL x_plus = dx[0] * p.s0, x_minus = dx[1] * m.s0;
    const REAL q = f * (q_plus - q_minus);
    b[0] = f * REAL_MULSUB(dx[0], q_plus, dx[1] * q_minus);
    b[1] = f * (yq_plus - yq_minus);
    b[2] = h * q;
    g->xx = REAL_NEGMULADD(f3, REAL_MULSUB(dx[0], x_plus, dx[1] * x_minus), q);
    g->yy = REAL_NEGMULADD(f3, p.s2 - m.s2, q);
    g->xy = f3 * REAL_MULSUB(dx[1], m.s1, dx[0] * p.s1);
    g->xz = h3 * (x_minus - x_plus);
    g->yz = h3 * (m.s1 - p.s1);
}

#ifdef REAL_INVERSE_FIFTH
/* Lanes with fused operations make B and G of moments, so the whole gradient comes with B, and is kept for
 * whoever needs it along another direction.  The other forms sum as below, in the order that their bits are
 * known by.
 */
#define FIELD_KEEPS_GRADIENT

/* A line: its distance along y, and for each of its ends |d|^2 and an estimate of 1/|d|. */
typedef struct FN(line) {
    REAL dy, dy2, distance2[2], estimate[2];
} FN(line);

static inline FN(line) FN(see_line)(REAL dy, const REAL across2[2])
{
    FN(line) line;
    line.dy = dy;
    line.dy2 = dy * dy;
    for (int end = 0; end < 2; ++end) {
        line.distance2[end] = line.dy2 + across2[end];
        line.estimate[end] = REAL_ESTIMATE_RECIPROCAL_SQRT(line.distance2[end]);
    }
    return line;
}

static inline __attribute__((always_inline)) void FN(add_line)(FN(moments) m[2], const FN(line) * line)
{
    const REAL dy = line->dy, dy2 = line->dy2, dy3 = dy2 * dy;
    for (int end = 0; end < 2; ++end) {
        const REAL inverse5 = REAL_INVERSE_FIFTH(line->distance2[end], line->estimate[end]);
        m[end].s0 = m[end].s0 + inverse5;
        m[end].s1 = REAL_MULADD(dy, inverse5, m[end].s1);
        m[end].s2 = REAL_MULADD(dy2, inverse5, m[end].s2);
        m[end].s3 = REAL_MULADD(dy3, inverse5, m[end].s3);
        const REAL inverse7 = inverse5 * REAL_INVERSE(line->distance2[end], line->estimate[end]);
        m[end].q0 = m[end].q0 + inverse7;
        m[end].q1 = REAL_MULADD(dy, inverse7, m[end].q1);
    }
}

/* The moments of five lines, the first the farthest along y: with Y = y + k lambda for k = 2, 1, 0, -1, -2, by
 * the moments lambda^m t_m in k and by y, which takes a fifth fewer operations than to add up each. */
static inline __attribute__((always_inline)) FN(moments)
    FN(moments_of_five)(const FN(line) lines[5], int end, REAL spacing)
{
    REAL inverse5[5], inverse7[5];
    for (int i = 0; i < 5; ++i) {
        inverse5[i] = REAL_INVERSE_FIFTH(lines[i].distance2[end], lines[i].estimate[end]);
        inverse7[i] = inverse5[i] * REAL_INVERSE(lines[i].distance2[end], lines[i].estimate[end]);
    }
    const REAL y = lines[2].dy, spacing2 = spacing * spacing;
    const REAL outer = inverse5[0] + inverse5[4], outer_odd = inverse5[0] - inverse5[4];
    const REAL inner = inverse5[1] + inverse5[3], inner_odd = inverse5[1] - inverse5[3];
    const REAL t0 = (outer + inner) + inverse5[2], t1 = spacing * REAL_MULADD(R(2.0), outer_odd, inner_odd);
    const REAL t2 = spacing2 * REAL_MULADD(R(4.0), outer, inner);
    const REAL t3 = (spacing2 * spacing) * REAL_MULADD(R(8.0), outer_odd, inner_odd);
    const REAL y1 = REAL_MULADD(y, t1, t2), y2 = REAL_MULADD(y, t2, t3);
    FN(moments) sum;
    sum.s0 = t0;
    sum.s1 = REAL_MULADD(y, t0, t1);
    sum.s2 = REAL_MULADD(y, sum.s1, y1);
    sum.s3 = REAL_MULADD(y, sum.s2, REAL_MULADD(y, y1, y2));
    sum.q0 = ((inverse7[0] + inverse7[4]) + (inverse7[1] + inverse7[3])) + inverse7[2];
    const REAL odd = REAL_MULADD(R(2.0), inverse7[0] - inverse7[4], inverse7[1] - inverse7[3]);
    sum.q1 = REAL_MULADD(y, sum.q0, spacing * odd);
    return sum;
}

/* The moments of all lines for both ends; returns the strength of a line.  By no call, as what follows, since
 * most of a step's time is here: what the caller does not use is not computed. */
static inline __attribute__((always_inline)) REAL
FN(moments_of_lines)(const FN(coefficients) * c, REAL y, const REAL across2[2], FN(moments) sum[2])
{
    if (c->lines == 5) { /* the paper's: straight on, and of strength 1 each */
        /* Estimates take long: all are under way before the first is used. */
        const FN(line) lines[5] = {FN(see_line)(REAL_MULADD(R(2.0), c->spacing, y), across2),
                                   FN(see_line)(y + c->spacing, across2), FN(see_line)(y, across2),
                                   FN(see_line)(y - c->spacing, across2),
                                   FN(see_line)(REAL_NEGMULADD(R(2.0), c->spacing, y), across2)};
        for (int end = 0; end < 2; ++end)
            sum[end] = FN(moments_of_five)(lines, end, c->spacing);
        return R(1.0);
    }
    const REAL zero = R(0.0);
    const FN(moments) nothing = {zero, zero, zero, zero, zero, zero};
    sum[0] = sum[1] = nothing;
    REAL place = c->first_line;
    for (int count = c->lines; count > 0; --count, place = place + R(1.0)) {
        const FN(line) line = FN(see_line)(REAL_NEGMULADD(place, c->spacing, y), across2);
        FN(add_line)(sum, &line);
    }
    return c->line_strength;
}

/* B and the gradient at (x, y), at the height of the bead's centre. */
static inline __attribute__((always_inline)) void FN(field_and_gradient)(const FN(coefficients) * c, REAL x,
                                                                         REAL y, REAL b[3], FN(gradient) * g)
{
    const REAL h = c->height, dx[2] = {x - R(1.0), x + R(1.0)};
    const REAL across2[2] = {REAL_MULADD(dx[0], dx[0], h * h), REAL_MULADD(dx[1], dx[1], h * h)};
    FN(moments) sum[2];
    const REAL f = FN(moments_of_lines)(c, y, across2, sum);
    FN(field_of_moments)(h, f, dx, across2, sum, b, g);
}

/* B and G u at (x, y), at the height of the bead's centre. */
static inline void FN(field_along)(const FN(coefficients) * c, REAL x, REAL y, const REAL u[3], REAL b[3],
                                   REAL gu[3])
{
    FN(gradient) g;
    FN(field_and_gradient)(c, x, y, b, &g);
    FN(times_gradient)(&g, u, gu);
}
#else
/* Sums over the lines, for the charges at the plus end and at the minus end: q = 1/|d|^3, Y q, t = 3
 * (d.u)/|d|^5 and Y t.  ENDS is a pair of REALs where a pair costs no more than one, else a REAL; END() picks
 * an end. */
typedef struct FN(line_sums) {
    ENDS q, yq, t, yt;
} FN(line_sums);

static inline void FN(add_line)(FN(line_sums) * sum, ENDS across2, ENDS along, REAL dy, REAL dy2, REAL uy)
{
    const ENDS distance2 = dy2 + across2;
    const ENDS inverse2 = R(1.0) / distance2; /* the division need not wait for the root */
    const ENDS q = (inverse2 * inverse2) * ENDS_SQRT(distance2);
    const ENDS t = (q * inverse2) * REAL_MULADD(uy, dy, along);
    sum->q = sum->q + q;
    sum->yq = REAL_MULADD(dy, q, sum->yq);
    sum->t = sum->t + t;
    sum->yt = REAL_MULADD(dy, t, sum->yt);
}

/* B and G u at (x, y), at the height of the bead's centre. */
static inline void FN(field_along)(const FN(coefficients) * c, REAL x, REAL y, const REAL u[3], REAL b[3],
                                   REAL gu[3])
{
    const REAL h = c->height, f = c->line_strength;
    const REAL dx[2] = {x - R(1.0), x + R(1.0)};
    const REAL ux3 = R(3.0) * u[0], uy3 = R(3.0) * u[1], uzh3 = R(3.0) * u[2] * h;
    const ENDS across2[ENDS_GROUPS] = ENDS_OF(dx[0] * dx[0] + h * h, dx[1] * dx[1] + h * h);
    const ENDS along[ENDS_GROUPS] = ENDS_OF(ux3 * dx[0] + uzh3, ux3 * dx[1] + uzh3);
    FN(line_sums) sum[ENDS_GROUPS];
    for (int group = 0; group < ENDS_GROUPS; ++group) {
        const ENDS zero = along[group] - along[group];
        const FN(line_sums) nothing = {zero, zero, zero, zero};
        sum[group] = nothing;
    }
    REAL line = c->first_line;
    for (int count = c->lines; count > 0; --count, line = line + R(1.0)) {
        const REAL dy = REAL_NEGMULADD(line, c->spacing, y);
        for (int group = 0; group < ENDS_GROUPS; ++group)
            FN(add_line)(&sum[group], across2[group], along[group], dy, dy * dy, uy3);
    }
    const REAL q = END(sum, q, 0) - END(sum, q, 1);
    b[0] = f * REAL_MULSUB(dx[0], END(sum, q, 0), dx[1] * END(sum, q, 1));
    b[1] = f * (END(sum, yq, 0) - END(sum, yq, 1));
    b[2] = f * (h * q);
    gu[0] = f * (u[0] * q - (dx[0] * END(sum, t, 0) - dx[1] * END(sum, t, 1)));
    gu[1] = f * (u[1] * q - (END(sum, yt, 0) - END(sum, yt, 1)));
    gu[2] = f * (u[2] * q - h * (END(sum, t, 0) - END(sum, t, 1)));
}
#endif

/* B and the whole gradient, for reading. */
typedef struct FN(field_values) {
    REAL b[3];
    REAL gxx, gyy, gxy, gxz, gyz; /* gzz = -(gxx + gyy) */
} FN(field_values);

static inline void FN(field)(const FN(coefficients) * c, REAL x, REAL y, FN(field_values) * out)
{
    const REAL ex[3] = {R(1.0), R(0.0), R(0.0)}, ey[3] = {R(0.0), R(1.0), R(0.0)};
    REAL gx[3], gy[3];
    FN(field_along)(c, x, y, ex, out->b, gx);
    FN(field_along)(c, x, y, ey, out->b, gy);
    out->gxx = gx[0];
    out->gyy = gy[1];
    out->gxy = gx[1];
    out->gxz = gx[2];
    out->gyz = gy[2];
}
