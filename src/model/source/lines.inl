/* lines.inl - the source `lines`: parallel lines of dipoles, over REAL.
 *
 * Each line of dipoles is two point charges, +1 at X = 1 and -1 at X = -1 (paper, section IV,
 * Eq. (11)).  With d from a charge of sign s to the bead,
 *
 *     B     = sum of s d/|d|^3,
 *     G_ij  = sum of s (delta_ij/|d|^3 - 3 d_i d_j/|d|^5),
 *     T_ijk = sum of s (-3 (delta_ij d_k + delta_ik d_j + delta_jk d_i)/|d|^5 + 15 d_i d_j d_k/|d|^7),
 *
 * The charges at one end of all lines have the same X and h.  So all that B and G need of an end are the
 * moments s_m = sum of Y^m/|d|^5 with m = 0 to 3, Y being the distance along y: |d|^2 = a + Y^2 with one a =
 * X^2 + h^2, and so
 *
 *     sum of 1/|d|^3 = a s_0 + s_2,        sum of Y/|d|^3 = a s_1 + s_3.
 *
 * T needs the moments q_m of 1/|d|^7 for m = 0 and 1 too; the next are q_2 = s_0 - a q_0 and q_3 = s_1 - a q_1.
 *
 * Numbers of one lane that need B and G u alone have a shorter way, lines_along(), below.
 */
typedef struct FN(lines) {
    REAL spacing;  /* lambda */
    REAL first;    /* -(lines - 1)/2: the lines lie at Y = lambda (first, first + 1, ...) */
    REAL strength; /* of each, 5/lines */
} FN(lines);

static inline FN(lines) FN(make_lines)(const fst_params *params, const fst_groups *g)
{
    (void)params;
    FN(lines) lines;
    lines.spacing = REAL_OF(g->lambda);
    lines.first = -(R(0.5) * REAL_OF(g->lines - 1));
    lines.strength = R(5.0) / REAL_OF(g->lines);
    return lines;
}

/* ------------------------------------------------------------------ moments: sums over the lines */

/* 1/|d|^5 and 1/|d|^7 of |d|^2: with fused operations by a series about an estimate of 1/|d|, else by a root
 * and a quotient, which need not wait for each other. */
#ifdef REAL_INVERSE_FIFTH
#define LINES_BEGIN(distance2) REAL_ESTIMATE_RECIPROCAL_SQRT(distance2)
#define LINES_INVERSE5(distance2, begun) REAL_INVERSE_FIFTH(distance2, begun)
#define LINES_INVERSE2(distance2, begun) REAL_INVERSE(distance2, begun)
#else
#define LINES_BEGIN(distance2) (R(1.0) / (distance2))
#define LINES_INVERSE5(distance2, begun) (((begun) * (begun)) * ((begun)*ENDS_SQRT(distance2)))
#define LINES_INVERSE2(distance2, begun) (begun)
#endif

/* A line as seen from the bead: its distance along y, and for both its ends |d|^2 and what is begun of the
 * inverse powers.  ENDS is a pair of REALs where a pair costs no more than one, else a REAL. */
typedef struct FN(line) {
    REAL dy, dy2;
    ENDS distance2[ENDS_GROUPS], begun[ENDS_GROUPS];
} FN(line);

/* The moments of one end.  While they are added up, FN(moment_sums) holds both ends where a pair of REALs costs
 * no more than one. */
typedef struct FN(moments) {
    REAL s0, s1, s2, s3, q0, q1;
} FN(moments);

#ifdef REAL_INVERSE_FIFTH
typedef FN(moments) FN(moment_sums); /* one type, so that gcc adds up in registers */
#else
typedef struct FN(moment_sums) {
    ENDS s0, s1, s2, s3, q0, q1;
} FN(moment_sums);
#endif

static inline FN(line) FN(see_line)(REAL dy, const ENDS across2[ENDS_GROUPS])
{
    FN(line) line;
    line.dy = dy;
    line.dy2 = dy * dy;
    for (int group = 0; group < ENDS_GROUPS; ++group) {
        line.distance2[group] = line.dy2 + across2[group];
        line.begun[group] = LINES_BEGIN(line.distance2[group]);
    }
    return line;
}

static inline __attribute__((always_inline)) void FN(add_moments)(FN(moment_sums) sum[ENDS_GROUPS],
                                                                  const FN(line) * line)
{
    const REAL dy = line->dy, dy2 = line->dy2, dy3 = dy2 * dy;
    for (int group = 0; group < ENDS_GROUPS; ++group) {
        FN(moment_sums) *m = &sum[group];
        const ENDS inverse5 = LINES_INVERSE5(line->distance2[group], line->begun[group]);
        const ENDS inverse7 = inverse5 * LINES_INVERSE2(line->distance2[group], line->begun[group]);
        m->s0 = m->s0 + inverse5;
        m->s1 = REAL_MULADD(dy, inverse5, m->s1);
        m->s2 = REAL_MULADD(dy2, inverse5, m->s2);
        m->s3 = REAL_MULADD(dy3, inverse5, m->s3);
        m->q0 = m->q0 + inverse7;
        m->q1 = REAL_MULADD(dy, inverse7, m->q1);
    }
}

#ifdef REAL_INVERSE_FIFTH
/* Inverse powers of |d|^2 at one end: by an estimate and a series, or, where a processor's divider has nothing
 * else to do, at one of the two ends by a root and a quotient, which then cost next to no time. */
static inline REAL FN(begin_inverse)(REAL distance2, int divides)
{
    if (divides)
        return distance2 * REAL_SQRT(distance2);
    return LINES_BEGIN(distance2);
}

static inline REAL FN(inverse_fifth)(REAL distance2, REAL begun, int divides)
{
    if (divides)
        return R(1.0) / (distance2 * begun);
    return LINES_INVERSE5(distance2, begun);
}

static inline REAL FN(inverse_seventh)(REAL distance2, REAL begun, REAL inverse5, int divides)
{
    if (divides)
        return (inverse5 * inverse5) * begun;
    return inverse5 * LINES_INVERSE2(distance2, begun);
}

/* One of five lines, for both ends. */
typedef struct FN(fifth) {
    REAL distance2[2], begun[2], inverse5[2], inverse7[2];
} FN(fifth);

static inline __attribute__((always_inline)) void FN(finish_fifth)(FN(fifth) * line, int end)
{
    const int divides = REAL_DIVIDER_IS_FREE && end == 1;
    const REAL distance2 = line->distance2[end], begun = line->begun[end];
    line->inverse5[end] = FN(inverse_fifth)(distance2, begun, divides);
    line->inverse7[end] = FN(inverse_seventh)(distance2, begun, line->inverse5[end], divides);
}

/* With few registers each line is finished at once; else what takes long is begun for all lines before the
 * first is finished. */
static inline __attribute__((always_inline)) void FN(see_fifth)(FN(fifth) * line, REAL dy,
                                                                const REAL across2[2])
{
    for (int end = 0; end < 2; ++end) {
        line->distance2[end] = dy * dy + across2[end];
        line->begun[end] = FN(begin_inverse)(line->distance2[end], REAL_DIVIDER_IS_FREE && end == 1);
    }
    for (int end = 0; REAL_FEW_REGISTERS && end < 2; ++end)
        FN(finish_fifth)(line, end);
}

/* The moments of five lines at Y = y + k lambda, k = 2, 1, 0, -1, -2: first the moments t_m = lambda^m sum of
 * k^m/|d|^5 about the middle line, then these shifted by y (binomial formula).  This takes a fifth fewer
 * operations than adding up each s_m. */
static inline __attribute__((always_inline)) FN(moments)
    FN(moments_of_five)(FN(fifth) lines[5], int end, REAL y, REAL spacing)
{
    REAL inverse5[5], inverse7[5];
    for (int i = 0; i < 5; ++i) {
        if (!REAL_FEW_REGISTERS)
            FN(finish_fifth)(&lines[i], end);
        inverse5[i] = lines[i].inverse5[end];
        inverse7[i] = lines[i].inverse7[end];
    }
    const REAL spacing2 = spacing * spacing;
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
#endif

/* The moments of all lines for both ends; returns the strength of a line.  Inlined, like what follows, because
 * most of a step's time is spent here; what the caller does not use is then not computed. */
static inline __attribute__((always_inline)) REAL
FN(moments_of_lines)(const FN(lines) * lines, int count, REAL y, const REAL across2[2], FN(moments) moments[2])
{
    const ENDS across[ENDS_GROUPS] = ENDS_OF(across2[0], across2[1]);
#ifdef REAL_INVERSE_FIFTH
    if (count == 5) { /* the paper's: straight on, and of strength 1 each */
        const REAL spacing = lines->spacing;
        FN(fifth) seen[5];
        FN(see_fifth)(&seen[0], REAL_MULADD(R(2.0), spacing, y), across2);
        FN(see_fifth)(&seen[4], REAL_NEGMULADD(R(2.0), spacing, y), across2);
        FN(see_fifth)(&seen[1], y + spacing, across2);
        FN(see_fifth)(&seen[3], y - spacing, across2);
        FN(see_fifth)(&seen[2], y, across2);
        for (int end = 0; end < 2; ++end)
            moments[end] = FN(moments_of_five)(seen, end, y, spacing);
        return R(1.0);
    }
    const REAL zero = R(0.0);
    const FN(moments) nothing = {zero, zero, zero, zero, zero, zero};
    moments[0] = moments[1] = nothing;
    REAL place = lines->first;
    for (int left = count; left > 0; --left, place = place + R(1.0)) {
        const FN(line) line = FN(see_line)(REAL_NEGMULADD(place, lines->spacing, y), across);
        FN(add_moments)(moments, &line);
    }
    return lines->strength;
#else
    FN(moment_sums) sum[ENDS_GROUPS];
    for (int group = 0; group < ENDS_GROUPS; ++group) {
        const ENDS zero = across[group] - across[group];
        FN(moment_sums) *m = &sum[group]; /* member by member: gcc keeps a copied struct in memory */
        m->s0 = m->s1 = m->s2 = m->s3 = m->q0 = m->q1 = zero;
    }
    REAL place = lines->first;
    for (int left = count; left > 0; --left, place = place + R(1.0)) {
        const FN(line) line = FN(see_line)(REAL_NEGMULADD(place, lines->spacing, y), across);
        FN(add_moments)(sum, &line);
    }
    for (int end = 0; end < 2; ++end) {
        FN(moments) *m = &moments[end];
        m->s0 = END(sum, s0, end);
        m->s1 = END(sum, s1, end);
        m->s2 = END(sum, s2, end);
        m->s3 = END(sum, s3, end);
        m->q0 = END(sum, q0, end);
        m->q1 = END(sum, q1, end);
    }
    return lines->strength;
#endif
}

/* ------------------------------------------------------------------ the field of the moments */

/* The two ends lie dx away along x, with a = across2; f: the strength of a line. */
typedef struct FN(line_ends) {
    REAL h, f, dx[2], across2[2];
    FN(moments) sum[2]; /* of the plus end, of the minus end */
} FN(line_ends);

static inline __attribute__((always_inline)) void FN(field_of_lines)(const FN(line_ends) * ends, REAL b[3],
                                                                     FN(gradient) * g)
{
    const FN(moments) p = ends->sum[0], m = ends->sum[1];
    const REAL h = ends->h, f = ends->f, *dx = ends->dx, *across2 = ends->across2;
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

static inline __attribute__((always_inline)) void FN(bend_of_lines)(const FN(line_ends) * ends, FN(bend) * t)
{
    REAL xxx[2], xxy[2], xyy[2], yyy[2], xxz[2], xyz[2], yyz[2]; /* of either end */
    for (int end = 0; end < 2; ++end) {
        const FN(moments) m = ends->sum[end];
        const REAL x = ends->dx[end], x2 = x * x, q0 = R(15.0) * m.q0, q1 = R(15.0) * m.q1;
        xxz[end] = REAL_NEGMULADD(R(3.0), m.s0, x2 * q0);
        yyz[end] = REAL_NEGMULADD(ends->across2[end], q0, R(12.0) * m.s0);
        xyz[end] = x * q1;
        xxx[end] = x * REAL_NEGMULADD(R(6.0), m.s0, xxz[end]);
        xxy[end] = REAL_NEGMULADD(R(3.0), m.s1, x2 * q1);
        xyy[end] = x * yyz[end];
        yyy[end] = REAL_NEGMULADD(ends->across2[end], q1, R(6.0) * m.s1);
    }
    t->scale = ends->f;
    t->vertical = ends->h;
    t->xxx = xxx[0] - xxx[1];
    t->xxy = xxy[0] - xxy[1];
    t->xyy = xyy[0] - xyy[1];
    t->yyy = yyy[0] - yyy[1];
    t->xxz = xxz[0] - xxz[1];
    t->xyz = xyz[0] - xyz[1];
    t->yyz = yyz[0] - yyz[1];
}

/* B, G and T at (x, y), at the height h over the lines. */
static inline __attribute__((always_inline)) void
FN(lines_look)(const FN(lines) * lines, const fst_kinds *kinds, REAL x, REAL y, REAL h, FN(local_field) * at)
{
    FN(line_ends) ends;
    ends.h = h;
    ends.dx[0] = x - R(1.0);
    ends.dx[1] = x + R(1.0);
    for (int end = 0; end < 2; ++end)
        ends.across2[end] = REAL_MULADD(ends.dx[end], ends.dx[end], h * h);
    ends.f = FN(moments_of_lines)(lines, kinds->pieces, y, ends.across2, ends.sum);
    FN(field_of_lines)(&ends, at->b, &at->gradient);
    FN(bend_of_lines)(&ends, &at->bend);
}

/* ------------------------------------------------------------------ B and G u alone */

SOURCE_FIELD_BY_LOOK(lines)
#ifdef FIELD_KEEPS_GRADIENT
SOURCE_ALONG_BY_FIELD(lines)
#else
/* G u = sum of s (u/|d|^3 - 3 d (d.u)/|d|^5) needs of the plus ends and the minus ends the sums of q = 1/|d|^3,
 * Y q, t = 3 (d.u)/|d|^5 and Y t, because u is known before the roots and quotients are: a third less work than
 * the moments.  Do not reorder: this order defines the published bits of the portable form.
 */
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

static inline void FN(lines_along)(const FN(lines) * lines, const fst_kinds *kinds, REAL x, REAL y, REAL h,
                                   const REAL u[3], REAL b[3], REAL gu[3])
{
    const REAL f = lines->strength;
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
    REAL place = lines->first;
    for (int left = kinds->pieces; left > 0; --left, place = place + R(1.0)) {
        const REAL dy = REAL_NEGMULADD(place, lines->spacing, y);
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

#undef LINES_BEGIN
#undef LINES_INVERSE5
#undef LINES_INVERSE2
