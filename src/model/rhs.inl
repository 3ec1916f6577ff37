/* rhs.inl - the bead's equations of motion, over REAL.
 *
 * In components along the axes that turn with the magnet at omega (e: the vertical), with the contact point's
 * velocity V = v - eps W x e, the magnetic force F, torque tau and friction -f per mass:
 *
 *     x' = v                                           - omega e x x
 *     v' = F - f                                       - omega e x v
 *     n' = W x n                                       - omega e x n
 *     W' = 5/(2 eps^2) tau + 5/(2 eps) e x f           - omega e x W   [+ (W.n) W x n : farago2020]
 *
 * with f = V for viscous friction, in units of the friction rate, and f = 0 on a frictionless plate.
 *
 * A hard magnet has F = kappa eps^2 (n.grad)B and tau = kappa eps^2 n x B (paper, Eqs. (r), (sigz) and, with
 * the gyroscopic term that it lacks, (nseconde)).  Magnetisable beads of energy -kappa eps^2 n.B - a B^2 - b
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

/* G u at the place (x, y) of a pull: of its gradient where that was kept, else by another pass. */
static inline void FN(gradient_along)(const FN(coefficients) * c, REAL x, REAL y, const FN(pull) * p,
                                      const REAL u[3], REAL gu[3])
{
#ifdef FIELD_KEEPS_GRADIENT
    (void)c, (void)x, (void)y;
    FN(times_gradient)(&p->gradient, u, gu);
#else
    (void)p;
    REAL b[3];
    FN(field_along)(c, x, y, u, b, gu);
#endif
}

static inline void FN(magnetic_pull)(const FN(coefficients) * c, const REAL *state, FN(pull) * p)
{
#ifdef FST_COUNT_EVALUATION
    FST_COUNT_EVALUATION(); /* in a library that a test has made for itself */
#endif
    const REAL x = state[FST_X], y = state[FST_Y], *n = state + FST_NX;
    REAL gn[3];
#ifdef FIELD_KEEPS_GRADIENT
    FN(field_and_gradient)(c, x, y, p->b, &p->gradient);
    FN(times_gradient)(&p->gradient, n, gn);
#else
    FN(field_along)(c, x, y, n, p->b, gn);
#endif
    p->strength = c->hard;
    if (!c->magnetisable) {
        for (int i = 0; i < 3; ++i)
            p->force[i] = p->strength * gn[i];
        return;
    }
    p->strength = p->strength + c->twice_b * SUM_3(n[0], p->b[0], n[1], p->b[1], n[2], p->b[2]);
    REAL gb[3];
    FN(gradient_along)(c, x, y, p, p->b, gb);
    for (int i = 0; i < 3; ++i)
        p->force[i] = p->strength * gn[i] + c->twice_a * gb[i];
}

/* The derivatives that follow from the state alone, without the magnet: those of the place and of n. */
static inline void FN(kinematics)(REAL omega, const REAL *y, REAL *dy)
{
    const REAL *v = y + FST_VX, *n = y + FST_NX, *w = y + FST_WX;
    dy[FST_X] = REAL_MULADD(omega, y[FST_Y], v[0]);
    dy[FST_Y] = REAL_NEGMULADD(omega, y[FST_X], v[1]);
    const REAL wz = w[2] - omega; /* W x n - omega e x n = (W - omega e) x n */
    dy[FST_NX] = REAL_MULSUB(w[1], n[2], wz * n[1]);
    dy[FST_NY] = REAL_MULSUB(wz, n[0], w[0] * n[2]);
    dy[FST_NZ] = REAL_MULSUB(w[0], n[1], w[1] * n[0]);
}

/* The others, of the velocities v and W, by the magnet's pull at the state; linear in v, W and the force, and
 * in n where the pull is given. */
static inline void FN(rigid_dynamics)(const FN(coefficients) * c, REAL omega, const REAL *y, const FN(pull) * p,
                                      REAL *dy)
{
    const REAL *v = y + FST_VX, *n = y + FST_NX, *w = y + FST_WX, *b = p->b;
    const REAL torque = c->torque * p->strength;
    const REAL friction_x = c->friction * REAL_NEGMULADD(c->eps, w[1], v[0]);
    const REAL friction_y = c->friction * REAL_MULADD(c->eps, w[0], v[1]);
    dy[FST_VX] = REAL_MULADD(omega, v[1], p->force[0] - friction_x);
    dy[FST_VY] = REAL_NEGMULADD(omega, v[0], p->force[1] - friction_y);
    dy[FST_WX] = REAL_MULADD(
        omega, w[1], REAL_MULSUB(torque, REAL_MULSUB(n[1], b[2], n[2] * b[1]), c->traction * friction_y));
    dy[FST_WY] = REAL_NEGMULADD(
        omega, w[0], REAL_MULADD(torque, REAL_MULSUB(n[2], b[0], n[0] * b[2]), c->traction * friction_x));
    dy[FST_WZ] = torque * REAL_MULSUB(n[0], b[1], n[1] * b[0]);
}

static inline void FN(dynamics)(const FN(coefficients) * c, REAL omega, const REAL *y, const FN(pull) * p,
                                REAL *dy)
{
    FN(rigid_dynamics)(c, omega, y, p, dy);
    if (c->gyroscopic_term_lost) {
        const REAL *n = y + FST_NX, *w = y + FST_WX;
        const REAL spin = w[0] * n[0] + w[1] * n[1] + w[2] * n[2];
        dy[FST_WX] = dy[FST_WX] + spin * (w[1] * n[2] - w[2] * n[1]);
        dy[FST_WY] = dy[FST_WY] + spin * (w[2] * n[0] - w[0] * n[2]);
        dy[FST_WZ] = dy[FST_WZ] + spin * (w[0] * n[1] - w[1] * n[0]);
    }
}

/* d(state)/dt at the drive `omega`; the magnet's pull is left in `p` for whoever observes the state. */
RHS_KIND void FN(rhs)(const FN(coefficients) * c, REAL omega, const REAL *y, REAL *dy, FN(pull) * p)
{
    FN(kinematics)(omega, y, dy);
    FN(magnetic_pull)(c, y, p);
    FN(dynamics)(c, omega, y, p, dy);
}

#ifdef REAL_FORCES_AHEAD
/* The pull at the state `next`, of which only the place and n need to be known, and the dynamics at another
 * one: neither waits for the other. */
RHS_KIND void FN(pull_and_dynamics)(const FN(coefficients) * c, const REAL *next, FN(pull) * next_pull,
                                    REAL omega, const REAL *y, const FN(pull) * p, REAL *dy)
{
    FN(dynamics)(c, omega, y, p, dy);
    FN(magnetic_pull)(c, next, next_pull);
}
#endif
