/* dipole.inl - the field of a point dipole, which is also that of a uniformly magnetised sphere, over REAL.
 *
 * With d from the dipole, r = |d|, and s = m.d:
 *
 *     B_i   = 3 d_i s/r^5 - m_i/r^3,
 *     G_ij  = 3 (m_i d_j + m_j d_i + delta_ij s)/r^5 - 15 d_i d_j s/r^7,
 *     T_ijk = 3 (m_i delta_jk + ...)/r^5 - 15 (m_i d_j d_k + ... + s (delta_ij d_k + ...))/r^7 + 105 d_i d_j
 * d_k s/r^9,
 *
 * where ... are the other two choices of the index that stands alone.
 */
static inline __attribute__((always_inline)) void FN(dipole_field)(const FN(part) * part, const REAL d[3],
                                                                   FN(local_field) * at)
{
    const REAL *m = part->j;
    const REAL r2 = REAL_MULADD(d[2], d[2], REAL_MULADD(d[1], d[1], d[0] * d[0]));
    const REAL s = REAL_MULADD(m[2], d[2], REAL_MULADD(m[1], d[1], m[0] * d[0]));
    const REAL inverse2 = R(1.0) / r2, inverse3 = inverse2 * inverse2 * REAL_SQRT(r2);
    const REAL three5 = R(3.0) * (inverse3 * inverse2), s_over = s * inverse2; /* 3/r^5 and s/r^2 */
    const REAL five = R(5.0) * s_over, thirty5 = R(35.0) * s_over * inverse2;
    const REAL x = d[0], y = d[1], z = d[2];
    for (int i = 0; i < 3; ++i)
        at->b[i] = REAL_MULSUB(three5 * s, d[i], m[i] * inverse3);
    at->gradient.xx = three5 * (R(2.0) * m[0] * x + s - five * x * x);
    at->gradient.yy = three5 * (R(2.0) * m[1] * y + s - five * y * y);
    at->gradient.xy = three5 * (m[0] * y + m[1] * x - five * x * y);
    at->gradient.xz = three5 * (m[0] * z + m[2] * x - five * x * z);
    at->gradient.yz = three5 * (m[1] * z + m[2] * y - five * y * z);
    const REAL q = R(5.0) * inverse2;
    FN(bend) *t = &at->bend;
    t->scale = t->vertical = R(1.0);
    t->xxx = three5 * (R(3.0) * m[0] - R(3.0) * q * x * (m[0] * x + s) + thirty5 * x * x * x);
    t->yyy = three5 * (R(3.0) * m[1] - R(3.0) * q * y * (m[1] * y + s) + thirty5 * y * y * y);
    t->xxy = three5 * (m[1] - q * (R(2.0) * m[0] * x * y + m[1] * x * x + s * y) + thirty5 * x * x * y);
    t->xyy = three5 * (m[0] - q * (R(2.0) * m[1] * x * y + m[0] * y * y + s * x) + thirty5 * x * y * y);
    t->xxz = three5 * (m[2] - q * (R(2.0) * m[0] * x * z + m[2] * x * x + s * z) + thirty5 * x * x * z);
    t->yyz = three5 * (m[2] - q * (R(2.0) * m[1] * y * z + m[2] * y * y + s * z) + thirty5 * y * y * z);
    t->xyz = three5 * (thirty5 * x * y * z - q * (m[0] * y * z + m[1] * x * z + m[2] * x * y));
}
