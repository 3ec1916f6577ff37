/* patch.inl - the contact of dry friction is not a point but a small disc, over REAL.
 *
 * Under the load N the bead and the plate touch in a disc of the radius a, pressed together most in the middle
 * (Hertz).  Where the bead pivots at the rate w = W.e while its middle slips at the speed |V|, the disc turns
 * about a point at the distance |V|/|w| from its middle, and every piece of it rubs against its own motion:
 *
 *       |V| << a |w|              |V| = a |w|                |V| >> a |w|
 *
 *          .---.                     .---.                      .---.
 *         / ^ v \                   / ^ ^ \                    / ^ ^ \
 *        |  ^o v |                 |  ^ ^  o                  |  ^ ^  |                     o
 *         \ ^ v /                   \ ^ ^ /                    \ ^ ^ /
 *          '---'                     '---'                      '---'
 *       little force              force and torque             the force mu N, little torque
 *
 * Summed up, with nu = |V|/(a |w|), the force against V and the torque against w are
 *
 *     T = mu N tau(nu),   M = mu N a m(nu):
 *
 *     nu <= 1:  tau = (3 pi/8) (nu - nu^3/4),          m = (3 pi/16) (1 - nu^2 + (3/8) nu^4)
 *     nu >= 1:  tau = (3/4) [(nu - nu^3/4) t + (nu^2 + 2) q/(4 nu)],
 *               m = (3/4) [(1 - nu^2 + (3/8) nu^4) t/2 + (3/16) (2 - nu^2) q],
 *                                                      t = asin(1/nu), q = sqrt(nu^2 - 1)
 *     nu > 2.5: their series in 1/nu^2, because the terms above then cancel.
 *
 * Both are derivatives of one potential (by |V| and |w|): the tangents need tau'(nu) alone.
 *
 * With w != 0 nothing sticks: f is smooth at V = 0, and a bead that a point would hold creeps at some fraction
 * of a |w|.  At w = 0 the direction of w is not defined: below a `slow`, which is far below any rotation and
 * follows the tolerance of a trajectory (model/disc.c), |w| bends smoothly to (5/16) slow instead of 0.  A bead
 * that neither slips nor pivots at all is held by a mode of its own (stick, coulomb.inl).
 *
 * The radius follows the load, a = (3 N R/(4 E*))^(1/3) with N in newtons, where the modulus E* is given.
 */
typedef struct FN(patch) {
    REAL radius; /* a; where it follows the load, that at the load `1/growth` */
    REAL growth; /* 0: a is given */
} FN(patch);

/* ------------------------------------------------------------------ functions */

/* x^(1/3) of x >= 0; of a smaller x than 1e-30 that of 1e-30.  Four times y -> (x y)^(1/4), each of which
 * leaves a quarter of the error of log y, then Halley's fractions, each of which leaves its cube. */
static inline REAL FN(cube_root)(REAL x)
{
    const REAL positive = REAL_MAX(x, R(1e-30));
    REAL y = R(1.0);
    for (int i = 0; i < 4; ++i)
        y = REAL_SQRT(REAL_SQRT(positive * y));
    for (int i = 0; i < 3; ++i) {
        const REAL cube = y * y * y;
        y = y + y * (positive - cube) / (R(2.0) * cube + positive);
    }
    return y;
}

/* The angle in [0, pi/2] of a sine and a cosine: halved three times, then its series. */
static inline REAL FN(angle_of)(REAL sine, REAL cosine)
{
    enum { TERMS = 13 };
    REAL x = sine / (R(1.0) + cosine), sum = R(0.0);
    for (int i = 0; i < 2; ++i)
        x = x / (R(1.0) + REAL_SQRT(REAL_MULADD(x, x, R(1.0))));
    const REAL x2 = x * x;
    for (int i = TERMS; i > 0; --i)
        sum = REAL_NEGMULADD(x2, sum, R(1.0) / REAL_OF(2 * i - 1));
    return R(8.0) * (x * sum);
}

/* ------------------------------------------------------------------ force and torque */

/* tau and m at the slip speed s and the pivoting speed p = a |w|, in the form in which they are needed: all are
 * finite at s = 0. */
typedef struct FN(shares) {
    REAL grip;    /* tau/s */
    REAL bend;    /* its derivative by s, over s */
    REAL across;  /* its derivative by p, which is also that of m by s, over s */
    REAL twist;   /* m */
    REAL twist_p; /* its derivative by p */
} FN(shares);

static inline FN(shares) FN(hertz_near)(REAL s, REAL p)
{
    const REAL c = R(3.0) * REAL_OF(FST_PI) / R(8.0), inverse = R(1.0) / p, nu = s * inverse, nu2 = nu * nu;
    FN(shares) at;
    at.grip = c * inverse * (R(1.0) - R(0.25) * nu2);
    at.bend = -(R(0.5) * c * inverse * inverse * inverse);
    at.across = -(c * inverse * inverse * (R(1.0) - R(0.75) * nu2));
    at.twist = R(0.5) * c * (R(1.0) - nu2 + R(0.375) * nu2 * nu2);
    at.twist_p = -(nu * s * at.across);
    return at;
}

static inline FN(shares) FN(hertz_middle)(REAL s, REAL p)
{
    const REAL y = p / s, cosine = REAL_SQRT(R(1.0) - y * y), t = FN(angle_of)(y, cosine);
    const REAL nu = s / p, nu2 = nu * nu, q = nu * cosine, inverse_s = R(1.0) / s;
    const REAL tau = R(0.75) * ((nu - R(0.25) * nu2 * nu) * t + R(0.25) * (nu2 + R(2.0)) * q * y);
    const REAL by_nu = R(0.75) * ((R(1.0) - R(0.75) * nu2) * t + q * (R(0.75) - R(0.5) * y * y));
    FN(shares) at;
    at.grip = tau * inverse_s;
    at.bend = (by_nu / p - at.grip) * inverse_s * inverse_s;
    at.across = -(by_nu / (p * p));
    at.twist = R(0.75) * (R(0.5) * (R(1.0) - nu2 + R(0.375) * nu2 * nu2) * t + R(0.1875) * (R(2.0) - nu2) * q);
    at.twist_p = nu2 * by_nu / p;
    return at;
}

/* The series: with p_0 = 1 and p_(k+1)/p_k = (k - 1/2)^2/((k + 1) (k + 5/2)), the coefficients (1 - 2k) p_k of
 * tau and 2k p_k of m. */
static inline FN(shares) FN(hertz_far)(REAL s, REAL p)
{
    enum { TERMS = 16 };
    static const double along[TERMS] = {
        1.0,
        -1.0 / 10,
        -0.010714285714285714,
        -0.002976190476190476,
        -0.0011837121212121212,
        -0.0005736451048951049,
        -0.0003155048076923077,
        -0.00018956801470588236,
        -0.00012159790416989164,
        -8.20303321781015e-05,
        -5.759955933375388e-05,
        -4.1785862134850544e-05,
        -3.1145943535698785e-05,
        -2.3751880017276925e-05,
        -1.8470644022651988e-05,
        -1.4608600272461117e-05,
    };
    const REAL inverse_s = R(1.0) / s, y = p * inverse_s, y2 = y * y;
    REAL tau = R(0.0), twist = R(0.0), slope = R(0.0);
    for (int k = TERMS - 1; k > 0; --k) {
        tau = REAL_MULADD(tau, y2, REAL_OF(along[k]));
        twist = REAL_MULADD(twist, y2, REAL_OF(along[k] * (-2.0 * k / (2.0 * k - 1.0))));
        slope = REAL_MULADD(slope, y2, REAL_OF(along[k] * (-2.0 * k)));
    }
    FN(shares) at;
    at.grip = REAL_MULADD(tau, y2, R(1.0)) * inverse_s;
    at.across = -(y * slope * inverse_s * inverse_s);
    at.bend = (y2 * slope * inverse_s - at.grip) * inverse_s * inverse_s;
    at.twist = y * twist;
    at.twist_p = slope * inverse_s;
    return at;
}

/* The nu at which tau is that share of mu N, at most 0.88 (nu = 0.99): Newton's steps from below, which never pass
 * it. */
static inline REAL FN(hertz_nu)(REAL share)
{
    enum { STEPS = 6 };
    const REAL x = REAL_SELECT(REAL_LESS(share, R(0.88)), share, R(0.88)) * R(8.0) / (R(3.0) * REAL_OF(FST_PI));
    REAL nu = x;
    for (int i = 0; i < STEPS; ++i) {
        const REAL nu2 = nu * nu;
        nu = nu + (x - nu * (R(1.0) - R(0.25) * nu2)) / (R(1.0) - R(0.75) * nu2);
    }
    return nu;
}

static inline FN(shares) FN(hertz_shares)(REAL s, REAL p)
{
    const REAL_MASK near = REAL_LESS_EQUAL(s, p), far = REAL_LESS(R(2.5) * p, s);
#ifdef REAL_IS_SCALAR
    return near ? FN(hertz_near)(s, p) : far ? FN(hertz_far)(s, p) : FN(hertz_middle)(s, p);
#else
    const FN(shares) a = FN(hertz_near)(s, p), b = FN(hertz_middle)(s, p), c = FN(hertz_far)(s, p);
    FN(shares) at;
    at.grip = REAL_SELECT(near, a.grip, REAL_SELECT(far, c.grip, b.grip));
    at.bend = REAL_SELECT(near, a.bend, REAL_SELECT(far, c.bend, b.bend));
    at.across = REAL_SELECT(near, a.across, REAL_SELECT(far, c.across, b.across));
    at.twist = REAL_SELECT(near, a.twist, REAL_SELECT(far, c.twist, b.twist));
    at.twist_p = REAL_SELECT(near, a.twist_p, REAL_SELECT(far, c.twist_p, b.twist_p));
    return at;
#endif
}

/* ------------------------------------------------------------------ the patch at a contact */

static inline FN(patch) FN(make_patch)(const fst_params *params, const fst_groups *g)
{
    const double l = g->length_unit, modulus = params->contact_modulus;
    /* A load of the usual order, on which nothing depends but rounding. */
    const double usual = g->gravity + 4.0 * g->kappa * (g->eps * g->eps) + 1e-12;
    const double newtons = usual * g->mass * l / (g->time_unit * g->time_unit);
    const REAL cube = REAL_OF(0.75 * newtons * g->eps / (modulus * l * l));
    const REAL given = REAL_OF(isnan(params->contact_radius) ? 0.0 : params->contact_radius / l);
    const FN(patch) patch = {
        .radius = isnan(modulus) ? given : FN(cube_root)(cube),
        .growth = REAL_OF(isnan(modulus) ? 0.0 : 1.0 / usual),
    };
    return patch;
}

/* The radius a at the load N, and its derivative. */
static inline REAL FN(patch_radius)(const FN(patch) * q, REAL load)
{
    const REAL_MASK follows = REAL_LESS(R(0.0), q->growth);
    return q->radius * REAL_SELECT(follows, FN(cube_root)(load * q->growth), R(1.0));
}

static inline REAL FN(patch_radius_by_load)(const FN(patch) * q, REAL load, REAL radius)
{
    const REAL_MASK follows = REAL_LESS(R(1e-30), load * q->growth);
    return REAL_SELECT(follows, radius / (R(3.0) * load), R(0.0));
}

/* |w|, its derivative `side`, and the derivative of that.  For x = |w|/slow < 1 it is
 * slow (5 + 15 x^2 - 5 x^4 + x^6)/16, which joins |w| there with three derivatives. */
static inline void FN(pivoting_rate)(REAL slow_2, REAL w, REAL *rate, REAL *side, REAL *bend)
{
    const REAL slow = REAL_SQRT(slow_2), size = REAL_ABS(w), x = w / slow, x2 = x * x, rest = R(1.0) - x2;
    const REAL_MASK inside = REAL_LESS(size, slow);
    const REAL even = R(5.0) + x2 * (R(15.0) + x2 * (x2 - R(5.0)));
    const REAL odd = x * (R(15.0) + x2 * (R(3.0) * x2 - R(10.0)));
    *rate = REAL_SELECT(inside, slow * even / R(16.0), size);
    *side = REAL_SELECT(inside, odd / R(8.0), REAL_SELECT(REAL_LESS(w, R(0.0)), -R(1.0), R(1.0)));
    *bend = REAL_SELECT(inside, R(1.875) * rest * rest / slow, R(0.0));
}

/* |V|^2 + (a |w|)^2, a that of the usual load: what the pace of a step is measured by. */
static inline REAL FN(patch_motion_2)(const FN(patch) * q, REAL slow_2, REAL s2, REAL w)
{
    return REAL_MULADD(q->radius * q->radius, REAL_MULADD(w, w, slow_2), s2);
}
