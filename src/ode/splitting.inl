/* splitting.inl - steps of a bead under dry friction without events or modes, over REAL.
 *
 *     drift for h/2      x moves with v, n turns about W, both exactly, and the axes turn with the magnet
 *     kick for h         x and n stay: force, torque and load are constant, and friction changes the slip by
 * the closed flow of contact_flow.inl, through capture and release drift for h/2
 *
 * The step is exact for either half of the motion and symmetric in time, so its error is C h^2.  A capture or a
 * release within a kick costs nothing extra, but C then depends on where in the step it falls; means over many
 * such steps are smooth in h again, and can be extrapolated to h = 0.  The second of two drifts and the first
 * of the next step are made as one, so a step needs one pull of the magnet.
 *
 * For dynamics `rigid` with constant mu (mu_s = mu_d) and without resistances: the kick is closed for these
 * only (study/splitting_run.c refuses others).
 */
#include "ode/contact_flow.inl"

/* A time, and by how much the axes turn in it. */
typedef struct FN(stride) {
    REAL h, cosine, sine; /* of omega h */
} FN(stride);

/* What a kick did. */
typedef struct FN(kick) {
    FN(slide_result) slide;
    REAL load; /* N; friction acts while it is positive */
} FN(kick);

static inline void FN(turn_axes)(const FN(stride) * by, REAL u[2])
{
    const REAL x = REAL_MULADD(by->cosine, u[0], by->sine * u[1]);
    u[1] = REAL_MULSUB(by->cosine, u[1], by->sine * u[0]);
    u[0] = x;
}

/* Turn n about W for the time h: the unit quaternion (cos, sin W/|W|) of half the angle.  The series are those
 * of cosine and sine/angle, to double precision for |W| h <= 1; beyond, n stays a unit vector and turns a
 * little wrong. */
static inline void FN(turn_about)(const REAL w[3], REAL h, REAL n[3])
{
    static const double cosine[] = {1.0,           -1.0 / 2.0,       1.0 / 24.0,        -1.0 / 720.0,
                                    1.0 / 40320.0, -1.0 / 3628800.0, 1.0 / 479001600.0, -1.0 / 87178291200.0};
    static const double sine[] = {1.0,
                                  -1.0 / 6.0,
                                  1.0 / 120.0,
                                  -1.0 / 5040.0,
                                  1.0 / 362880.0,
                                  -1.0 / 39916800.0,
                                  1.0 / 6227020800.0,
                                  -1.0 / 1307674368000.0};
    const REAL half = R(0.5) * h;
    const REAL q[3] = {half * w[0], half * w[1], half * w[2]};
    const REAL x = SUM_3(q[0], q[0], q[1], q[1], q[2], q[2]);
    REAL c = REAL_OF(cosine[7]), s = REAL_OF(sine[7]);
    for (int i = 6; i >= 0; --i) {
        c = REAL_MULADD(c, x, REAL_OF(cosine[i]));
        s = REAL_MULADD(s, x, REAL_OF(sine[i]));
    }
    /* n + 2 s (c q x n + s q x (q x n))/(c^2 + s^2 q^2) */
    const REAL factor = R(2.0) * s / REAL_MULADD(c, c, s * s * x);
    REAL qn[3], qqn[3];
    FN(cross)(q, n, qn);
    FN(cross)(q, qn, qqn);
    for (int i = 0; i < 3; ++i)
        n[i] = REAL_MULADD(factor, REAL_MULADD(c, qn[i], s * qqn[i]), n[i]);
    const REAL size2 = SUM_3(n[0], n[0], n[1], n[1], n[2], n[2]);
    const REAL shrink = REAL_NEGMULADD(R(0.5), size2, R(1.5)); /* 1/|n|, near 1 */
    for (int i = 0; i < 3; ++i)
        n[i] = n[i] * shrink;
}

static inline void FN(drift)(const FN(stride) * by, REAL *y)
{
    y[FST_X] = REAL_MULADD(by->h, y[FST_VX], y[FST_X]);
    y[FST_Y] = REAL_MULADD(by->h, y[FST_VY], y[FST_Y]);
    FN(turn_about)(y + FST_WX, by->h, y + FST_NX);
    FN(turn_axes)(by, y + FST_X);
    FN(turn_axes)(by, y + FST_VX);
    FN(turn_axes)(by, y + FST_NX);
    FN(turn_axes)(by, y + FST_WX);
}

/* The kick by the magnet's pull `p` at the state. */
static inline void FN(kick_by)(const FN(coefficients) * c, const FN(pull) * p, REAL h, REAL *y, FN(kick) * did)
{
    REAL twist[3], turning[3], push[2], slip[2], impulse[2];
    FN(cross)(y + FST_NX, p->b, twist);
    for (int i = 0; i < 3; ++i)
        turning[i] = p->strength * twist[i];
    FN(push)(c, p->force, turning, NULL, push);
    FN(slip)(c, y, slip);
    did->load = FN(load)(c, p->force);
    const REAL hold = R(3.5) * c->law.coulomb.sliding * REAL_MAX(did->load, R(0.0));
    FN(contact_flow)(push, hold, h, slip, &did->slide);
    for (int i = 0; i < 2; ++i) {
        /* V changed by the push and by 7/2 of the impulse of friction */
        impulse[i] = R((2.0 / 7.0)) * (REAL_MULADD(h, push[i], slip[i]) - did->slide.end[i]);
        y[FST_VX + i] = y[FST_VX + i] + REAL_MULSUB(h, p->force[i], impulse[i]);
    }
    const REAL torque = h * c->torque;
    y[FST_WX] = y[FST_WX] + REAL_MULSUB(torque, turning[0], c->traction * impulse[1]);
    y[FST_WY] = y[FST_WY] + REAL_MULADD(torque, turning[1], c->traction * impulse[0]);
    y[FST_WZ] = REAL_MULADD(torque, turning[2], y[FST_WZ]);
}
