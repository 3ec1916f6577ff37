/* dipole.inl - the field of a point dipole, which is also that of a uniformly magnetised sphere, over REAL.
 *
 * With d from the dipole, r = |d|, and s = m.d:
 *
 *     B_i   = 3 d_i s/r^5 - m_i/r^3,
 *     G_ij  = 3 (m_i d_j + m_j d_i + delta_ij s)/r^5 - 15 d_i d_j s/r^7,
 *     T_ijk = 3 (m_i delta_jk + ...)/r^5 - 15 (m_i d_j d_k + ... + s (delta_ij d_k + ...))/r^7
 *             + 105 d_i d_j d_k s/r^9,
 *
 * where ... are the other two choices of the index that stands alone.
 */
typedef struct FN(dipole_view) {
    REAL s, inverse2, inverse3, three5; /* 1/r^2, 1/r^3, 3/r^5 */
} FN(dipole_view);

static inline __attribute__((always_inline)) FN(dipole_view)
    FN(see_dipole)(const FN(part) * part, const REAL d[3])
{
    const REAL *m = part->j;
    const REAL r2 = REAL_MULADD(d[2], d[2], REAL_MULADD(d[1], d[1], d[0] * d[0]));
    FN(dipole_view) at;
    at.s = REAL_MULADD(m[2], d[2], REAL_MULADD(m[1], d[1], m[0] * d[0]));
    at.inverse2 = R(1.0) / r2;
    at.inverse3 = at.inverse2 * at.inverse2 * REAL_SQRT(r2);
    at.three5 = R(3.0) * (at.inverse3 * at.inverse2);
    return at;
}

/* B and G of a dipole at the place d from it. */
PART_KIND void FN(dipole_field)(const FN(part) * part, const REAL d[3], REAL b[3], FN(gradient) * g)
{
    const FN(dipole_view) at = FN(see_dipole)(part, d);
    const REAL *m = part->j, x = d[0], y = d[1], z = d[2];
    const REAL s = at.s, three5 = at.three5, five = R(5.0) * (s * at.inverse2);
    for (int i = 0; i < 3; ++i)
        b[i] = REAL_MULSUB(three5 * s, d[i], m[i] * at.inverse3);
    g->xx = three5 * (R(2.0) * m[0] * x + s - five * x * x);
    g->yy = three5 * (R(2.0) * m[1] * y + s - five * y * y);
    g->xy = three5 * (m[0] * y + m[1] * x - five * x * y);
    g->xz = three5 * (m[0] * z + m[2] * x - five * x * z);
    g->yz = three5 * (m[1] * z + m[2] * y - five * y * z);
}

/* And T. */
PART_KIND void FN(dipole_look)(const FN(part) * part, const REAL d[3], FN(local_field) * look)
{
    const FN(dipole_view) at = FN(see_dipole)(part, d);
    const REAL *m = part->j, x = d[0], y = d[1], z = d[2];
    const REAL s = at.s, three5 = at.three5, q = R(5.0) * at.inverse2;
    const REAL thirty5 = R(35.0) * (s * at.inverse2) * at.inverse2;
    FN(dipole_field)(part, d, look->b, &look->gradient);
    FN(bend) *t = &look->bend;
    t->scale = t->vertical = R(1.0);
    t->xxx = three5 * (R(3.0) * m[0] - R(3.0) * q * x * (m[0] * x + s) + thirty5 * x * x * x);
    t->yyy = three5 * (R(3.0) * m[1] - R(3.0) * q * y * (m[1] * y + s) + thirty5 * y * y * y);
    t->xxy = three5 * (m[1] - q * (R(2.0) * m[0] * x * y + m[1] * x * x + s * y) + thirty5 * x * x * y);
    t->xyy = three5 * (m[0] - q * (R(2.0) * m[1] * x * y + m[0] * y * y + s * x) + thirty5 * x * y * y);
    t->xxz = three5 * (m[2] - q * (R(2.0) * m[0] * x * z + m[2] * x * x + s * z) + thirty5 * x * x * z);
    t->yyz = three5 * (m[2] - q * (R(2.0) * m[1] * y * z + m[2] * y * y + s * z) + thirty5 * y * y * z);
    t->xyz = three5 * (thirty5 * x * y * z - q * (m[0] * y * z + m[1] * x * z + m[2] * x * y));
}
