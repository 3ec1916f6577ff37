/* observe.inl - what can be read off a state and the magnet's pull at it, over REAL.
 *
 * Local components (r, alpha, z) of a horizontal vector u: u_r = (X uX + Y uY)/r, u_alpha = (X uY - Y uX)/r.
 * On the axis r = 0 the local directions do not exist; the local components are then 0, never NaN.
 */
typedef struct FN(seen) {
    REAL r, cos_bead_angle, sin_bead_angle;
    REAL n[3], b[3]; /* local components */
    REAL b2, b_norm;
    REAL gap2;                      /* |n - B/|B||^2 = 2 (1 - cos angle), accurate for small angles */
    REAL v_r, v_alpha, centrifugal; /* v_alpha^2/r */
    REAL slip_r, slip_alpha, slip2;
    REAL friction_power;       /* taken by the contact law: f.V */
    REAL rolling_power;        /* taken by rolling resistance */
    REAL pivoting_power;       /* taken by pivoting on a disc */
    REAL sticking;             /* 1 where the contact rolls without slipping, by its law; else 0 */
    REAL flying;               /* 1 where the bead is in the air */
    REAL spin;                 /* W.n */
    REAL force_r, force_alpha; /* magnetic */
    REAL load;
    REAL drive_power;
} FN(seen);

static inline void FN(see)(const FN(world) * c, const FN(modes) * m, REAL omega, const REAL *y,
                           const FN(pull) * p, FN(seen) * o)
{
    const REAL *v = y + FST_VX, *n = y + FST_NX, *w = y + FST_WX;
    const REAL r2 = SUM_2(y[FST_X], y[FST_X], y[FST_Y], y[FST_Y]);
    const REAL inverse_r = REAL_RECIPROCAL_SQRT(r2 + R(1e-290));
    const REAL ex = y[FST_X] * inverse_r, ey = y[FST_Y] * inverse_r;
    o->r = r2 * inverse_r;
    o->cos_bead_angle = ex;
    o->sin_bead_angle = ey;
    o->n[0] = SUM_2(n[0], ex, n[1], ey);
    o->n[1] = REAL_MULSUB(n[1], ex, n[0] * ey);
    o->n[2] = n[2];
    o->b[0] = SUM_2(p->b[0], ex, p->b[1], ey);
    o->b[1] = REAL_MULSUB(p->b[1], ex, p->b[0] * ey);
    o->b[2] = p->b[2];
    o->b2 = SUM_3(p->b[0], p->b[0], p->b[1], p->b[1], p->b[2], p->b[2]);
    const REAL inverse_b = REAL_RECIPROCAL_SQRT(o->b2 + R(1e-290));
    o->b_norm = o->b2 * inverse_b;
    const REAL gap[3] = {REAL_NEGMULADD(p->b[0], inverse_b, n[0]), REAL_NEGMULADD(p->b[1], inverse_b, n[1]),
                         REAL_NEGMULADD(p->b[2], inverse_b, n[2])};
    o->gap2 = SUM_3(gap[0], gap[0], gap[1], gap[1], gap[2], gap[2]);
    o->v_r = SUM_2(v[0], ex, v[1], ey);
    o->v_alpha = REAL_MULSUB(v[1], ex, v[0] * ey);
#ifdef REAL_FAST_RECIPROCAL_SQRT
    o->centrifugal = (o->v_alpha * o->v_alpha) * inverse_r;
#else
    o->centrifugal = o->v_alpha * o->v_alpha / (o->r + R(1e-290));
#endif
    const FN(contact) contact = FN(contact_of)(c, m, y, p);
    const REAL *slip = contact.slip;
    o->slip_r = SUM_2(slip[0], ex, slip[1], ey);
    o->slip_alpha = REAL_MULSUB(slip[1], ex, slip[0] * ey);
    o->slip2 = SUM_2(slip[0], slip[0], slip[1], slip[1]);
    o->friction_power = FN(friction_loss)(&c->law, &c->kinds, &contact);
    o->rolling_power = HAS(c->kinds, dry) ? FN(resistance_loss)(&c->resistance, w, contact.load) : R(0.0);
    o->pivoting_power = HAS(c->kinds, patch) ? FN(coulomb_pivoting_loss)(&c->law.coulomb, &contact) : R(0.0);
    o->flying = HAS(c->kinds, flies) ? REAL_SELECT(FN(in_flight)(m), R(1.0), R(0.0)) : R(0.0);
    o->sticking = FN(sticks)(c, m);
    o->load = contact.load;
    o->spin = SUM_3(w[0], n[0], w[1], n[1], w[2], n[2]);
    o->force_r = SUM_2(p->force[0], ex, p->force[1], ey);
    o->force_alpha = REAL_MULSUB(p->force[1], ex, p->force[0] * ey);
    const REAL twist = REAL_MULSUB(n[0], p->b[1], n[1] * p->b[0]);
    o->drive_power = FN(drive_power)(omega, o->r, o->force_alpha, p->strength, twist);
}

/* Kinetic and magnetic energy per mass, and that of a bead's height and climb in the air. */
static inline REAL FN(energy)(const FN(world) * c, const FN(modes) * m, const REAL *y, const FN(pull) * p)
{
    const REAL *v = y + FST_VX, *n = y + FST_NX, *w = y + FST_WX;
    const REAL n_dot_b = n[0] * p->b[0] + n[1] * p->b[1] + n[2] * p->b[2];
    const REAL b2 = p->b[0] * p->b[0] + p->b[1] * p->b[1] + p->b[2] * p->b[2];
    const REAL kinetic = R(0.5) * (v[0] * v[0] + v[1] * v[1]) +
                         c->half_inertia * (c->eps * c->eps) * (w[0] * w[0] + w[1] * w[1] + w[2] * w[2]);
    REAL magnetic = c->hard * n_dot_b;
    if (c->kinds.magnetisable)
        magnetic = magnetic + R(0.5) * (c->twice_a * b2 + c->twice_b * (n_dot_b * n_dot_b));
    if (!HAS(c->kinds, flies) || !REAL_ANY(FN(in_flight)(m)))
        return kinetic - magnetic;
    return R(0.5) * (y[FST_CLIMB] * y[FST_CLIMB]) + c->gravity * y[FST_HEIGHT] + (kinetic - magnetic);
}

/* `r0`, `b0`: reference values near the means, so that small deviations of r and |B| lose no digits. */
static inline void FN(integrands)(const FN(world) * c, const FN(modes) * m, const REAL *y, const FN(pull) * p,
                                  const FN(seen) * o, REAL r0, REAL b0, REAL q[FST_Q_COUNT])
{
    q[FST_Q_R] = o->r;
    q[FST_Q_R2] = (o->r - r0) * (o->r - r0);
    q[FST_Q_B] = o->b_norm;
    q[FST_Q_B2] = (o->b_norm - b0) * (o->b_norm - b0);
    q[FST_Q_FRICTION_POWER] = o->friction_power;
    q[FST_Q_DRIVE_POWER] = o->drive_power;
    q[FST_Q_SLIP2] = o->slip2;
    q[FST_Q_LOAD] = o->load;
    q[FST_Q_SLIP_R] = o->slip_r;
    q[FST_Q_SLIP_ALPHA] = o->slip_alpha;
    q[FST_Q_R_SLIP_ALPHA] = o->r * o->slip_alpha;
    q[FST_Q_SPIN_TERM] = c->eps * o->spin * o->n[1]; /* n_alpha = sin(theta) sin(phi) */
    q[FST_Q_CENTRIFUGAL] = o->centrifugal;
    q[FST_Q_FORCE_R] = o->force_r;
    q[FST_Q_TORQUE_ALPHA] = o->r * o->force_alpha;
    /* Printed Eq. (12), (14): n = sin(phi) e_alpha - cos(phi) e_z with the actual phi, n_r dropped. */
    const REAL inverse_sine = REAL_RECIPROCAL_SQRT(SUM_2(o->n[1], o->n[1], o->n[2], o->n[2]) + R(1e-290));
    const REAL n_alpha = o->n[1] * inverse_sine, n_z = o->n[2] * inverse_sine;
    const REAL ex = o->cos_bead_angle, ey = o->sin_bead_angle;
    const REAL printed[3] = {-(n_alpha * ey), n_alpha * ex, n_z};
    REAL g[3];
    FN(gradient_along)(c, y[FST_X], y[FST_Y], FN(height_of)(c, m, y), p, printed, g);
    q[FST_Q_FORCE_R_PRINTED] = c->hard * SUM_2(g[0], ex, g[1], ey);
    q[FST_Q_EQ23] = c->hard_over_eps * REAL_MULSUB(o->b[2], n_alpha, o->b[1] * n_z);
    for (int i = 0; i < 3; ++i)
        q[FST_Q_N_R + i] = o->n[i];
    q[FST_Q_N_RR] = o->n[0] * o->n[0];
    q[FST_Q_N_RALPHA] = o->n[0] * o->n[1];
    q[FST_Q_N_RZ] = o->n[0] * o->n[2];
    q[FST_Q_N_ALPHAALPHA] = o->n[1] * o->n[1];
    q[FST_Q_N_ALPHAZ] = o->n[1] * o->n[2];
    q[FST_Q_N_ZZ] = o->n[2] * o->n[2];
#if KNOWS_DRY
    q[FST_Q_STICKING] = o->sticking;
    q[FST_Q_ROLLING_POWER] = o->rolling_power;
    q[FST_Q_PIVOTING_POWER] = o->pivoting_power;
    q[FST_Q_FLYING] = o->flying;
#endif
}
