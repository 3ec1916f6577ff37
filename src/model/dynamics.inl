/* dynamics.inl - the bead's equations of motion, over REAL.
 *
 * In components along the axes that turn with the magnet at omega (e: the vertical), with the contact point's
 * velocity V = v - eps W x e, the magnetic force F, torque tau and friction -f per mass:
 *
 *     x' = v                                           - omega e x x
 *     v' = F - f                                       - omega e x v
 *     n' = W x n                                       - omega e x n
 *     W' = (tau + m)/(beta eps^2) + e x f/(beta eps)   - omega e x W   [+ (W.n) W x n : farago2020]
 *
 * where beta = I/(m R^2) is the bead's inertia, 2/5 of a solid sphere, and m the torque of the contact's
 * resistances, if it has any.  Hence the slip obeys, with k = 1 + 1/beta,
 *
 *     V' = A - k f  - omega e x V,     A = F_h - (tau + m) x e/(beta eps)   [- eps (W.n) (W x n) x e]
 *
 * with the push A, which dry friction sees: f = A/k keeps a contact at rest.  The terms in omega are the
 * drive's transport (drive.inl).
 *
 * The source gives B and its gradient (source/sources.inl), the contact law f (contact/contacts.inl).
 *
 * A hard magnet has F = kappa eps^2 (n.grad)B and tau = kappa eps^2 n x B (paper, Eqs. (9), (10) and, with
 * the gyroscopic term that it lacks, (7)).  Magnetisable beads of energy -kappa eps^2 n.B - a B^2 - b
 * (n.B)^2: F = s G n + 2 a G B and tau = s n x B with s = kappa eps^2 + 2 b (n.B). The last line is what
 * Lagrange's equations give if psi' = W.n is taken for the derivative of a coordinate, as the paper does; it
 * turns no energy over.
 */

/* What the magnet does to a bead of direction n: field, force per mass (its third component is what lifts the
 * bead), and the strength s. */
typedef struct FN(pull) {
    REAL b[3], force[3], strength;
#ifdef FIELD_KEEPS_GRADIENT
    FN(gradient) gradient;
#endif
} FN(pull);

/* a x b */
static inline void FN(cross)(const REAL a[3], const REAL b[3], REAL out[3])
{
    out[0] = REAL_MULSUB(a[1], b[2], a[2] * b[1]);
    out[1] = REAL_MULSUB(a[2], b[0], a[0] * b[2]);
    out[2] = REAL_MULSUB(a[0], b[1], a[1] * b[0]);
}

/* ------------------------------------------------------------------ the magnet */

/* B and G u at (x, y), at the height z over the magnet's reference plane. */
static inline void FN(field_along)(const FN(world) * c, REAL x, REAL y, REAL z, const REAL u[3], REAL b[3],
                                   REAL gu[3])
{
    FN(source_along)(&c->source, &c->kinds, x, y, z, u, b, gu);
}

/* B and the whole gradient there, for reading. */
static inline void FN(field)(const FN(world) * c, REAL x, REAL y, REAL z, REAL b[3], FN(gradient) * g)
{
    const REAL ex[3] = {R(1.0), R(0.0), R(0.0)}, ey[3] = {R(0.0), R(1.0), R(0.0)};
    REAL gx[3], gy[3];
    FN(field_along)(c, x, y, z, ex, b, gx);
    FN(field_along)(c, x, y, z, ey, b, gy);
    g->xx = gx[0];
    g->yy = gy[1];
    g->xy = gx[1];
    g->xz = gx[2];
    g->yz = gy[2];
    g->yx = c->kinds.source == FST_MAGNET_GRID ? gy[0] : g->xy;
}

/* The mask of a bead in the air. */
static inline REAL_MASK FN(in_flight)(const FN(modes) * m)
{
    return REAL_LESS(REAL_OF(FST_MODE_FLIGHT) - R(0.5), m->contact);
}

/* G u at the place (x, y) of a pull: of its gradient where that was kept, else by another pass. */
static inline void FN(gradient_along)(const FN(world) * c, REAL x, REAL y, REAL z, const FN(pull) * p,
                                      const REAL u[3], REAL gu[3])
{
#ifdef FIELD_KEEPS_GRADIENT
    (void)c, (void)x, (void)y, (void)z;
    FN(times_gradient)(&p->gradient, u, gu);
#else
    (void)p;
    REAL b[3];
    FN(field_along)(c, x, y, z, u, b, gu);
#endif
}

/* s of the bead's dipole u = s n + 2 a B. */
static inline REAL FN(strength)(const FN(world) * c, const REAL n[3], const REAL b[3])
{
    if (!c->kinds.magnetisable)
        return c->hard;
    return c->hard + c->twice_b * SUM_3(n[0], b[0], n[1], b[1], n[2], b[2]);
}

/* The pull on a bead at the height z.  The force is G u = s G n + 2 a G B, taken in the second form, because a
 * source can give G along a known direction in one pass, and s is not known before B.  (tangent.inl has the
 * whole gradient, and takes the first.) */
static inline void FN(pull_at)(const FN(world) * c, const REAL *state, REAL z, FN(pull) * p)
{
#ifdef FST_COUNT_EVALUATION
    FST_COUNT_EVALUATION(); /* in a library that a test has made for itself */
#endif
    const REAL x = state[FST_X], y = state[FST_Y], *n = state + FST_NX;
    REAL gn[3];
#ifdef FIELD_KEEPS_GRADIENT
    FN(source_field)(&c->source, &c->kinds, x, y, z, p->b, &p->gradient);
    FN(times_gradient)(&p->gradient, n, gn);
#else
    FN(field_along)(c, x, y, z, n, p->b, gn);
#endif
    p->strength = FN(strength)(c, n, p->b);
    if (!c->kinds.magnetisable) {
        for (int i = 0; i < 3; ++i)
            p->force[i] = p->strength * gn[i];
        return;
    }
    REAL gb[3];
    FN(gradient_along)(c, x, y, z, p, p->b, gb);
    for (int i = 0; i < 3; ++i)
        p->force[i] = p->strength * gn[i] + c->twice_a * gb[i];
}

/* The height of a bead over the magnet's reference plane: of one in the air it is a number of the motion. */
static inline REAL FN(height_of)(const FN(world) * c, const FN(modes) * m, const REAL *y)
{
    if (!HAS(c->kinds, flies) || !REAL_ANY(FN(in_flight)(m)))
        return c->height;
    return c->height + y[FST_HEIGHT];
}

static inline void FN(magnetic_pull)(const FN(world) * c, const FN(modes) * m, const REAL *y, FN(pull) * p)
{
    FN(pull_at)(c, y, FN(height_of)(c, m, y), p);
}

/* ------------------------------------------------------------------ the contact */

/* Normal load per mass: the weight less the magnet's vertical force, N = g + dU/dz = g - F_z. */
static inline REAL FN(load)(const FN(world) * c, const REAL force[3])
{
    return c->gravity - force[2];
}

/* V = v - eps W x e: linear, so that it is also how V changes with v and W. */
static inline void FN(slip)(const FN(world) * c, const REAL *y, REAL slip[2])
{
    const REAL *v = y + FST_VX, *w = y + FST_WX;
    slip[0] = REAL_NEGMULADD(c->eps, w[1], v[0]);
    slip[1] = REAL_MULADD(c->eps, w[0], v[1]);
}

/* A, from the force F, the torque `turning` per mass, and `lost`, which dynamics farago2020 adds to W' (NULL:
 * nothing); linear in all of them, so that it is also how A changes with them. */
static inline void FN(push)(const FN(world) * c, const REAL force[3], const REAL turning[3], const REAL *lost,
                            REAL push[2])
{
    push[0] = force[0] - c->traction * turning[1];
    push[1] = force[1] + c->traction * turning[0];
    if (lost) {
        push[0] = push[0] - c->eps * lost[1];
        push[1] = push[1] + c->eps * lost[0];
    }
}

/* (W.n) W x n, which dynamics farago2020 adds to W'. */
static inline void FN(lost_term)(const REAL *n, const REAL *w, REAL out[3])
{
    const REAL spin = w[0] * n[0] + w[1] * n[1] + w[2] * n[2];
    out[0] = spin * (w[1] * n[2] - w[2] * n[1]);
    out[1] = spin * (w[2] * n[0] - w[0] * n[2]);
    out[2] = spin * (w[0] * n[1] - w[1] * n[0]);
}

/* The torque of a plate that resists rolling, from the magnet's `turning`.  A bead that does not roll has v =
 * V, so the push that its slip feels is k F_h, in the sense that f = A/k keeps it in its place. */
static inline void FN(resist_rolling)(const FN(world) * c, const REAL w[3], const REAL force[3],
                                      const REAL turning[3], const REAL lost[3], FN(contact) * at)
{
    REAL f[2];
    if (FN(resist_asks_balance)(at->modes)) {
        for (int i = 0; i < 2; ++i)
            at->push[i] = c->yielding * force[i];
        FN(friction)(&c->law, &c->kinds, at, f);
        at->balance[0] = turning[0] + lost[0] / c->torque - c->eps * f[1];
        at->balance[1] = turning[1] + lost[1] / c->torque + c->eps * f[0];
    }
    FN(resist)(&c->resistance, at->modes, at->time, w, at->load, at->balance, at->torque);
}

/* The contact as the law sees it; `dry` is kinds.dry.  Where that is known to be 0 nothing of it need lie in
 * memory. */
static inline __attribute__((always_inline)) FN(contact)
    FN(contact_by)(const FN(world) * c, const FN(modes) * m, const REAL *y, const FN(pull) * p, int dry)
{
    const REAL *n = y + FST_NX, *w = y + FST_WX;
    FN(contact) at;
    FN(slip)(c, y, at.slip);
    at.load = FN(load)(c, p->force);
    if (dry && HAS(c->kinds, flies))
        at.load = REAL_SELECT(FN(in_flight)(m), R(0.0), at.load);
    at.modes = m;
    at.time = dry && HAS(c->kinds, modes) && FN(something_begins)(m) ? y[FST_STEP_TIME] : R(0.0);
    at.share = c->share;
    at.push[0] = at.push[1] = at.torque[0] = at.torque[1] = at.torque[2] = R(0.0);
    at.balance[0] = at.balance[1] = R(0.0);
    at.patch = dry ? HAS(c->kinds, patch) : FST_PATCH_POINT;
    at.pivot = w[2];
    if (dry) {
        REAL turning[3], lost[3] = {R(0.0), R(0.0), R(0.0)};
        FN(cross)(n, p->b, turning);
        for (int i = 0; i < 3; ++i)
            turning[i] = p->strength * turning[i];
        if (c->kinds.gyroscopic_term_lost)
            FN(lost_term)(n, w, lost);
        if (HAS(c->kinds, resists))
            FN(resist_rolling)(c, w, p->force, turning, lost, &at);
        const REAL kept[2] = {at.push[0], at.push[1]};
        for (int i = 0; i < 3; ++i)
            turning[i] = turning[i] + at.torque[i];
        FN(push)(c, p->force, turning, c->kinds.gyroscopic_term_lost ? lost : NULL, at.push);
        for (int i = 0; HAS(c->kinds, resists) && i < 2; ++i)
            at.push[i] = REAL_SELECT(FN(rests)(m), kept[i], at.push[i]);
        if (HAS(c->kinds, patch))
            at.torque[2] = FN(coulomb_pivoting)(&c->law.coulomb, &at, turning[2] + lost[2] / c->torque);
    }
    return at;
}

static inline __attribute__((always_inline)) FN(contact)
    FN(contact_of)(const FN(world) * c, const FN(modes) * m, const REAL *y, const FN(pull) * p)
{
    return FN(contact_by)(c, m, y, p, HAS(c->kinds, dry));
}

/* ------------------------------------------------------------------ the motion */

/* The derivatives that follow from the state alone, without the magnet: those of the place and of n. */
static inline void FN(kinematics)(REAL omega, const REAL *y, REAL *dy)
{
    REAL turn[3];
    FN(transport)(omega, y + FST_X, y + FST_VX, dy + FST_X);
    FN(turning_seen)(omega, y + FST_WX, turn);
    FN(cross)(turn, y + FST_NX, dy + FST_NX);
}

/* Newton's and Euler's laws: the derivatives of v and W, from the force F, the friction f and the torque
 * strength * twist.  They are linear in v, W, F, f and the torque together, whatever the source and the contact
 * law are: given the changes of all these, they are the changes of the derivatives. */
static inline void FN(accelerations)(const FN(world) * c, REAL omega, const REAL *y, const REAL force[3],
                                     const REAL friction[2], REAL strength, const REAL twist[3], REAL *dy)
{
    const REAL torque = c->torque * strength;
    const REAL of_v[2] = {force[0] - friction[0], force[1] - friction[1]};
    const REAL of_w[2] = {REAL_MULSUB(torque, twist[0], c->traction * friction[1]),
                          REAL_MULADD(torque, twist[1], c->traction * friction[0])};
    FN(transport)(omega, y + FST_VX, of_v, dy + FST_VX);
    FN(transport)(omega, y + FST_WX, of_w, dy + FST_WX);
    dy[FST_WZ] = torque * twist[2];
}

/* 1 where the contact rolls without slipping, by its law, else 0. */
static inline REAL FN(sticks)(const FN(world) * c, const FN(modes) * m)
{
    if (HAS(c->kinds, dry) && c->kinds.contact == FST_FRICTION_ROLLING)
        return R(1.0);
    if (!HAS(c->kinds, modes))
        return R(0.0);
    return REAL_SELECT(FN(is_mode)(m->contact, FST_MODE_STICK), R(1.0), R(0.0));
}

/* Take from the change of v and W what rounding leaves where the bead does not roll, and where it is at rest.
 */
static inline void FN(keep_at_rest)(const FN(world) * c, const FN(modes) * m, REAL *dy)
{
    const REAL_MASK rests = FN(rests)(m);
    const REAL stays = FN(sticks)(c, m);
    for (int i = 0; i < 2; ++i) {
        dy[FST_WX + i] = REAL_SELECT(rests, R(0.0), dy[FST_WX + i]);
        dy[FST_VX + i] = REAL_SELECT(rests, (R(1.0) - stays) * dy[FST_VX + i], dy[FST_VX + i]);
    }
}

/* The derivatives of the velocities v and W, by the magnet's pull at the state; `dry` is kinds.dry. */
static inline __attribute__((always_inline)) void FN(dynamics_by)(const FN(world) * c, const FN(modes) * m,
                                                                  REAL omega, const REAL *y, const FN(pull) * p,
                                                                  REAL *dy, int dry)
{
    const REAL *n = y + FST_NX, *w = y + FST_WX;
    const FN(contact) contact = FN(contact_by)(c, m, y, p, dry);
    REAL friction[2], twist[3];
    FN(friction)(&c->law, &c->kinds, &contact, friction);
    FN(cross)(n, p->b, twist);
    FN(accelerations)(c, omega, y, p->force, friction, p->strength, twist, dy);
    for (int i = 0; dry && i < 3; ++i)
        dy[FST_WX + i] = REAL_MULADD(c->torque, contact.torque[i], dy[FST_WX + i]);
    if (c->kinds.gyroscopic_term_lost) {
        REAL lost[3];
        FN(lost_term)(n, w, lost);
        for (int i = 0; i < 3; ++i)
            dy[FST_WX + i] = dy[FST_WX + i] + lost[i];
    }
    if (dry && HAS(c->kinds, resists))
        FN(keep_at_rest)(c, m, dy);
}

static inline __attribute__((always_inline)) void
FN(dynamics)(const FN(world) * c, const FN(modes) * m, REAL omega, const REAL *y, const FN(pull) * p, REAL *dy)
{
#ifdef REAL_IS_SCALAR
    if (!c->kinds.dry) { /* by code of its own, which is shorter */
        if (c->kinds.contact == FST_FRICTION_COULOMB || c->kinds.contact == FST_FRICTION_ROLLING)
            __builtin_unreachable();
        FN(dynamics_by)(c, m, omega, y, p, dy, 0);
        return;
    }
#endif
    FN(dynamics_by)(c, m, omega, y, p, dy, HAS(c->kinds, dry));
}

/* What static friction could still take of the push on a contact at a point, some slack for rounding included.
 */
static inline REAL FN(static_grip)(const FN(world) * c, const FN(contact) * at)
{
    return FN(grip)(at, c->yielding, c->law.coulomb.holding, REAL_OF(FST_RELEASE_SLACK));
}

/* How much a contact moves, squared: of a point |V|^2, of a disc what patch.inl has. */
static inline REAL FN(contact_motion_2)(const FN(world) * c, const FN(modes) * m, const REAL slip[2],
                                        REAL pivot)
{
    const REAL s2 = SUM_2(slip[0], slip[0], slip[1], slip[1]);
    return HAS(c->kinds, patch) ? FN(patch_motion_2)(&c->law.coulomb.patch, m->slow_2, s2, pivot) : s2;
}

/* dt/dtheta of the time in which a step is measured at the state; 1 for laws without modes. */
static inline REAL FN(pace)(const FN(world) * c, const FN(modes) * m, const REAL *y)
{
    REAL slip[2];
    if (!HAS(c->kinds, modes))
        return R(1.0);
    FN(slip)(c, y, slip);
    const REAL motion_2 = FN(contact_motion_2)(c, m, slip, y[FST_WZ]);
    const REAL pace = FN(coulomb_pace)(&c->law.coulomb, m->contact, motion_2);
    if (!HAS(c->kinds, resists))
        return pace;
    const REAL of_roll = FN(resistance_pace)(&c->resistance, m->rolling, y + FST_WX);
    return REAL_SELECT(FN(in_flight)(m), pace, pace * of_roll);
}

/* Its change along a tangent vector. */
static inline REAL FN(pace_change)(const FN(world) * c, const FN(modes) * m, const REAL *y, const REAL *tangent)
{
    REAL slip[2], change[2];
    if (!HAS(c->kinds, modes))
        return R(0.0);
    FN(slip)(c, y, slip);
    FN(slip)(c, tangent, change);
    REAL by = R(2.0) * SUM_2(slip[0], change[0], slip[1], change[1]);
    if (HAS(c->kinds, patch))
        by = by + R(2.0) * (c->law.coulomb.patch.radius * c->law.coulomb.patch.radius) *
                      (y[FST_WZ] * tangent[FST_WZ]);
    const REAL motion_2 = FN(contact_motion_2)(c, m, slip, y[FST_WZ]);
    by = FN(coulomb_pace_change)(&c->law.coulomb, m->contact, motion_2, by);
    if (!HAS(c->kinds, resists))
        return by;
    const REAL of_roll = FN(resistance_pace_change)(&c->resistance, m->rolling, y + FST_WX, tangent + FST_WX);
    const REAL both = REAL_MULADD(by, FN(resistance_pace)(&c->resistance, m->rolling, y + FST_WX),
                                  FN(coulomb_pace)(&c->law.coulomb, m->contact, motion_2) * of_roll);
    return REAL_SELECT(FN(in_flight)(m), by, both);
}

/* d(state)/dt at the drive `omega`; the magnet's pull is left in `p` for a caller that observes the state. */
RHS_KIND void FN(rhs)(const FN(world) * c, const FN(modes) * m, REAL omega, const REAL *y, REAL *dy,
                      FN(pull) * p)
{
#ifdef REAL_PAIR
    /* What is stored one by one cannot be read in pairs, as the sums over stages do, before it has reached the
     * cache: the processor would wait for that in every evaluation. */
    REAL slope[FST_STATE_SIZE];
    _Static_assert(FST_STATE_SIZE % 2 == 0, "a state is stored in pairs");
#else
    REAL *slope = dy;
#endif
    FN(kinematics)(omega, y, slope);
    FN(magnetic_pull)(c, m, y, p);
    FN(dynamics)(c, m, omega, y, p, slope);
#ifdef REAL_PAIR
    _Pragma("GCC unroll 8") for (int i = 0; i < FST_STATE_SIZE; i += 2)
    {
        const REAL_PAIR pair = {slope[i], slope[i + 1]};
        memcpy(dy + i, &pair, sizeof pair);
    }
#endif
}

#ifdef REAL_FORCES_AHEAD
/* The pull at the state `next`, of which only the place and n need to be known, and the dynamics at another
 * one: neither waits for the other. */
RHS_KIND void FN(pull_and_dynamics)(const FN(world) * c, const FN(modes) * m, const REAL *next,
                                    FN(pull) * next_pull, REAL omega, const REAL *y, const FN(pull) * p,
                                    REAL *dy)
{
    FN(dynamics)(c, m, omega, y, p, dy);
    FN(magnetic_pull)(c, m, next, next_pull);
}
#endif
