/* tangent.inl - the derivative of the equations of motion (rhs.inl) along a tangent vector, over REAL.
 *
 * It is the Jacobian (jacobian.inl) times the vector without the Jacobian, most of which is zeros; a test holds
 * one against the other.  With the bead's dipole u = s n + 2 a B, the magnet's force is G u and its torque u x
 * B, so that along the tangent vector, whose changes are written d:
 *
 *     dB = G dx,     ds = 2 b (dn.B + n.dB),     du = ds n + s dn + 2 a dB,     d(G u) = dG u + G du,
 *     d(u x B) = d(s n x B) = s dn x B + n x (ds B + s dB).
 */

/* The field at the bead's place, and how it changes as the place does. */
typedef struct FN(local_field) {
    REAL b[3], db[3];
    FN(gradient) g, dg;
} FN(local_field);

/* dG as the place moves by (ex, ey), from the third derivatives of the potential,
 *
 *     dG_ij/dx_k = sum of s [-3 (delta_ij d_k + delta_ik d_j + delta_jk d_i)/|d|^5 + 15 d_i d_j d_k/|d|^7],
 *
 * by the moments q_m of 1/|d|^7, where q_2 = s_0 - a q_0 and q_3 = s_1 - a q_1. */
static inline void FN(gradient_change)(REAL h, REAL f, const REAL dx[2], const REAL across2[2],
                                       const FN(moments) sum[2], REAL ex, REAL ey, FN(gradient) * dg)
{
    REAL xxx[2], xxy[2], xyy[2], yyy[2], xxz[2], xyz[2], yyz[2]; /* of either end; over h: the last three */
    for (int end = 0; end < 2; ++end) {
        const FN(moments) m = sum[end];
        const REAL x = dx[end], x2 = x * x, q0 = R(15.0) * m.q0, q1 = R(15.0) * m.q1;
        xxz[end] = REAL_NEGMULADD(R(3.0), m.s0, x2 * q0);
        yyz[end] = REAL_NEGMULADD(across2[end], q0, R(12.0) * m.s0);
        xyz[end] = x * q1;
        xxx[end] = x * REAL_NEGMULADD(R(6.0), m.s0, xxz[end]);
        xxy[end] = REAL_NEGMULADD(R(3.0), m.s1, x2 * q1);
        xyy[end] = x * yyz[end];
        yyy[end] = REAL_NEGMULADD(across2[end], q1, R(6.0) * m.s1);
    }
    const REAL fx = f * ex, fy = f * ey, hx = h * fx, hy = h * fy;
    const REAL mixed_xxy = xxy[0] - xxy[1], mixed_xyy = xyy[0] - xyy[1], mixed_xyz = xyz[0] - xyz[1];
    dg->xx = REAL_MULADD(fx, xxx[0] - xxx[1], fy * mixed_xxy);
    dg->xy = REAL_MULADD(fx, mixed_xxy, fy * mixed_xyy);
    dg->yy = REAL_MULADD(fx, mixed_xyy, fy * (yyy[0] - yyy[1]));
    dg->xz = REAL_MULADD(hx, xxz[0] - xxz[1], hy * mixed_xyz);
    dg->yz = REAL_MULADD(hx, mixed_xyz, hy * (yyz[0] - yyz[1]));
}

#ifndef FIELD_KEEPS_GRADIENT
/* The moments of an end, or of both at once, by sums over the lines. */
typedef struct FN(moment_sums) {
    ENDS s0, s1, s2, s3, q0, q1;
} FN(moment_sums);

static inline void FN(add_moments)(FN(moment_sums) * sum, ENDS across2, REAL dy)
{
    const REAL dy2 = dy * dy;
    const ENDS distance2 = dy2 + across2;
    const ENDS inverse2 = R(1.0) / distance2; /* the division need not wait for the root */
    const ENDS inverse5 = (inverse2 * inverse2) * (inverse2 * ENDS_SQRT(distance2));
    const ENDS inverse7 = inverse5 * inverse2;
    sum->s0 = sum->s0 + inverse5;
    sum->s1 = REAL_MULADD(dy, inverse5, sum->s1);
    sum->s2 = REAL_MULADD(dy2, inverse5, sum->s2);
    sum->s3 = REAL_MULADD(dy2 * dy, inverse5, sum->s3);
    sum->q0 = sum->q0 + inverse7;
    sum->q1 = REAL_MULADD(dy, inverse7, sum->q1);
}

static inline REAL FN(moments_of_lines)(const FN(coefficients) * c, REAL y, const REAL across2[2],
                                        FN(moments) moments[2])
{
    const ENDS across[ENDS_GROUPS] = ENDS_OF(across2[0], across2[1]);
    FN(moment_sums) sum[ENDS_GROUPS];
    for (int group = 0; group < ENDS_GROUPS; ++group) {
        const ENDS zero = across[group] - across[group];
        const FN(moment_sums) nothing = {zero, zero, zero, zero, zero, zero};
        sum[group] = nothing;
    }
    REAL line = c->first_line;
    for (int count = c->lines; count > 0; --count, line = line + R(1.0))
        for (int group = 0; group < ENDS_GROUPS; ++group)
            FN(add_moments)(&sum[group], across[group], REAL_NEGMULADD(line, c->spacing, y));
    for (int end = 0; end < 2; ++end) {
        const FN(moments) m = {END(sum, s0, end), END(sum, s1, end), END(sum, s2, end),
                               END(sum, s3, end), END(sum, q0, end), END(sum, q1, end)};
        moments[end] = m;
    }
    return c->line_strength;
}
#endif

static inline __attribute__((always_inline)) void
FN(field_and_change)(const FN(coefficients) * c, const REAL *place, const REAL *e, FN(local_field) * out)
{
    const REAL h = c->height, dx[2] = {place[0] - R(1.0), place[0] + R(1.0)};
    const REAL across2[2] = {REAL_MULADD(dx[0], dx[0], h * h), REAL_MULADD(dx[1], dx[1], h * h)};
    FN(moments) sum[2];
    const REAL f = FN(moments_of_lines)(c, place[1], across2, sum);
    FN(field_of_moments)(h, f, dx, across2, sum, out->b, &out->g);
    FN(gradient_change)(h, f, dx, across2, sum, e[0], e[1], &out->dg);
    out->db[0] = REAL_MULADD(out->g.xx, e[0], out->g.xy * e[1]);
    out->db[1] = REAL_MULADD(out->g.xy, e[0], out->g.yy * e[1]);
    out->db[2] = REAL_MULADD(out->g.xz, e[0], out->g.yz * e[1]);
}

/* a x b */
static inline void FN(cross)(const REAL a[3], const REAL b[3], REAL out[3])
{
    out[0] = REAL_MULSUB(a[1], b[2], a[2] * b[1]);
    out[1] = REAL_MULSUB(a[2], b[0], a[0] * b[2]);
    out[2] = REAL_MULSUB(a[0], b[1], a[1] * b[0]);
}

/* The pull on a bead and what the change of its direction, by dn, and of its place add to it: `change`, with
 * the torque s dn x B, and in `turning` ds B + s dB. */
static inline void FN(pull_and_change)(const FN(coefficients) * c, const FN(local_field) * at, const REAL *n,
                                       const REAL *dn, FN(pull) * p, FN(pull) * change, REAL turning[3])
{
    const REAL *b = at->b, *db = at->db;
    REAL s = c->hard, u[3], du[3], gdu[3];
    if (c->magnetisable) {
        s = s + c->twice_b * SUM_3(n[0], b[0], n[1], b[1], n[2], b[2]);
        const REAL ds =
            c->twice_b * SUM_6(dn[0], b[0], dn[1], b[1], dn[2], b[2], n[0], db[0], n[1], db[1], n[2], db[2]);
        for (int i = 0; i < 3; ++i) {
            u[i] = REAL_MULADD(s, n[i], c->twice_a * b[i]);
            du[i] = REAL_MULADD(ds, n[i], REAL_MULADD(s, dn[i], c->twice_a * db[i]));
            turning[i] = REAL_MULADD(ds, b[i], s * db[i]);
        }
    } else {
        for (int i = 0; i < 3; ++i) {
            u[i] = s * n[i];
            du[i] = s * dn[i];
            turning[i] = s * db[i];
        }
    }
    FN(times_gradient)(&at->g, u, p->force);
    FN(times_gradient)(&at->g, du, gdu);
    FN(times_gradient)(&at->dg, u, change->force);
    for (int i = 0; i < 3; ++i) {
        change->force[i] = change->force[i] + gdu[i];
        p->b[i] = change->b[i] = b[i];
    }
    p->strength = change->strength = s;
}

/* farago2020: the change of (W.n) W x n. */
static inline void FN(add_lost_change)(const REAL *n, const REAL *w, const REAL *dn, const REAL *dw, REAL *out)
{
    const REAL spin = SUM_3(w[0], n[0], w[1], n[1], w[2], n[2]);
    const REAL dspin = SUM_6(dw[0], n[0], dw[1], n[1], dw[2], n[2], w[0], dn[0], w[1], dn[1], w[2], dn[2]);
    REAL wxn[3], dwxn[3], wxdn[3];
    FN(cross)(w, n, wxn);
    FN(cross)(dw, n, dwxn);
    FN(cross)(w, dn, wxdn);
    for (int i = 0; i < 3; ++i)
        out[i] = REAL_MULADD(dspin, wxn[i], REAL_MULADD(spin, dwxn[i] + wxdn[i], out[i]));
}

/* d(state)/dt at the drive `omega`, and its change along `tangent`. */
static inline void FN(rhs_and_tangent)(const FN(coefficients) * c, REAL omega, const REAL *y,
                                       const REAL *tangent, REAL *dy, REAL *change)
{
    const REAL *n = y + FST_NX, *w = y + FST_WX, *dn = tangent + FST_NX, *dw = tangent + FST_WX;
    FN(local_field) at;
    FN(pull) pull, pull_change;
    REAL turning[3], torque[3], dwxn[3];
    FN(field_and_change)(c, y + FST_X, tangent + FST_X, &at);
    FN(pull_and_change)(c, &at, n, dn, &pull, &pull_change, turning);
    FN(kinematics)(omega, y, dy);
    FN(dynamics)(c, omega, y, &pull, dy);
    /* All but two products is linear: of W x n, and of n with the change of the field. */
    FN(kinematics)(omega, tangent, change);
    FN(rigid_dynamics)(c, omega, tangent, &pull_change, change);
    const REAL turn[3] = {w[0], w[1], w[2] - omega};
    FN(cross)(turn, dn, change + FST_NX);
    FN(cross)(dw, n, dwxn);
    FN(cross)(n, turning, torque);
    for (int i = 0; i < 3; ++i) {
        change[FST_NX + i] = change[FST_NX + i] + dwxn[i];
        change[FST_WX + i] = REAL_MULADD(c->torque, torque[i], change[FST_WX + i]);
    }
    if (c->gyroscopic_term_lost)
        FN(add_lost_change)(n, w, dn, dw, change + FST_WX);
}
