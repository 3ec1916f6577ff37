/* cylinder.inl - the field of a uniformly magnetised cylinder, outside of it, over REAL.
 *
 * Let V be the potential of the solid cylinder of density 1, radius R and half height h, i.e. the integral of
 * 1/distance over it.  Outside
 *
 *     4 pi B = grad (J.grad V),
 *
 * so that B, G and T are second, third and fourth derivatives of V.  Take these along z and along x + i y,
 * d+ = d/dx + i d/dy and d- = d/dx - i d/dy.  As V has axial symmetry, m derivatives along d+ leave a number
 * times exp(i m phi), and d+ d- = -d/dz d/dz.  With `zz+` for d/dz d/dz d+ and so on there are
 *
 *     of order 2:  zz, z+, ++     3:  zzz, zz+, z++, +++     4:  zzzz, zzz+, zz++, z+++, ++++,
 *
 * and, because d-(f exp(i m phi)) = (f' + m f/rho) exp(i (m-1) phi), d+(...) = (f' - m f/rho) exp(...),
 *
 *     +++ = -zz+ - 4 (++)/rho,     z+++ = -zzz+ - 4 (z++)/rho,     ++++ = -zz++ - 6 (+++)/rho.
 *
 * The rest comes from the two rims, as what it is at z + h less what it is at z - h, or, far away, from the
 * multipoles of the cylinder.
 *
 * A rim.  Let D be the distance to the point of the rim at the angle theta, X_n,s the integral of cos(n theta)
 * D^(-2 s) over the circle.  By Gauss's theorem in the plane
 *
 *     z+ = -R X_1,1/2      zz+ = R zeta X_1,3/2     z++ = R (rho X_1 - R X_2),3/2     zzz = R (R X_0 - rho
 * X_1),3/2 zzz+ = R (X_1,3/2 - 3 zeta^2 X_1,5/2)   zz++ = -3 R zeta (rho X_1 - R X_2),5/2 zzzz = -3 R zeta (R
 * X_0 - rho X_1),5/2.
 *
 * With the greatest and least distance a_0 and b_0, a = (a_0 + b_0)/2 and c = rho R/a, D = |a - c exp(i
 * theta)|: this is a step of the arithmetic-geometric mean, after which the expressions below have no
 * differences of like terms, neither near the axis (c = 0) nor near the rim (a = c).
 *
 * zz and ++ need the third kind as well: with nu = min(rho, R)/max(rho, R) and H = sum of nu^k X_k,1/2, k >= 0,
 *
 *     rho < R:  zz = zeta H - 2 pi sgn zeta        ++ = -zeta (H - X_0 - nu X_1)/nu^2
 *     rho > R:  zz = -zeta (H - X_0)               ++ = zeta nu (X_1 + nu H).
 *
 * So what is wanted is H less its first two terms, H_2.  Where x = R^2/a^2 or y = rho^2/a^2 is small it is a
 * series of positive terms, with beta_k = (2k - 1)!!/(2k)!!:
 *
 *     H_2 = (2 pi/a) sum of beta_k y^k (sum of beta_j x^j, 0 <= j <= k-2), k >= 2, for rho < R,
 *
 * x and y exchanged for rho > R.  (That series times -zeta R^2/rho^2, of x and y as they are, is ++ less 2 pi
 * (R/rho)^2 sgn zeta for rho > R: what it is less cancels between the rims above and below the cylinder.)
 * Where both are large H comes from the third kind, of alpha^2 = 1 - p^2/a_0^2 with p = a_0 |R - rho|/(R +
 * rho), or, if that is smaller, with p = |zeta| (DLMF 19.7.8): the greater serves, over the rim too.
 */
#include "base/elliptic.inl"

#define CYLINDER_PI 3.14159265358979323846264338327950288L
#define CYLINDER_SERIES 0.25 /* the series serve where x or y is below this */
#define CYLINDER_SERIES_TERMS 26
#define CYLINDER_FAR 16.0 /* the multipoles serve beyond 4 half diagonals */

/* Derivatives of V, or what a rim adds to them; _1: over rho, _2: over rho^2. */
typedef struct FN(axial) {
    REAL zz, zp_1, pp_2;     /* zz, z+, ++ */
    REAL zzz, zzp_1, zpp;    /* zzz, zz+, z++ */
    REAL zzzz, zzzp_1, zzpp; /* zzzz, zzz+, zz++ */
} FN(axial);

typedef struct FN(cylinder_place) {
    REAL rho, rho2, radius, radius2, past; /* past: rho - R */
    REAL z, half;
    REAL_MASK within; /* rho < R */
} FN(cylinder_place);

/* ------------------------------------------------------------------ a rim */

typedef struct FN(rim) {
    REAL zeta, size, sign;    /* the height over the rim; size, sign: of zeta */
    REAL greatest, greatest2; /* a_0 */
    REAL product2;            /* (a_0 b_0)^2 */
    REAL a, a2, c, c2;
    REAL circle;    /* X_0,1/2 */
    REAL sigma;     /* (sum of 2^(n-1) c_n^2, n >= 2)/c^2 */
    REAL first;     /* X_1,1/2 over rho */
    REAL cube;      /* X_1,3/2 over rho */
    REAL cube_zero; /* (X_0 - X_1),3/2 */
    FN(elliptic) means;
} FN(rim);

static inline FN(rim) FN(see_rim)(const FN(cylinder_place) * at, REAL zeta)
{
    FN(rim) rim;
    const REAL zeta2 = zeta * zeta, width = at->rho + at->radius;
    rim.zeta = zeta;
    rim.size = REAL_ABS(zeta);
    rim.sign = REAL_SELECT(REAL_LESS(zeta, R(0.0)), R(-1.0), R(1.0));
    rim.greatest2 = REAL_MULADD(width, width, zeta2);
    rim.greatest = REAL_SQRT(rim.greatest2);
    const REAL least = REAL_SQRT(REAL_MULADD(at->past, at->past, zeta2)), product = rim.greatest * least;
    const REAL a = R(0.5) * (rim.greatest + least), c = at->rho * at->radius / a, a2 = a * a, c2 = c * c;
    rim.a = a;
    rim.a2 = a2;
    rim.c = c;
    rim.c2 = c2;
    rim.product2 = product * product;
    rim.means = FN(elliptic_mean)(a, product, c);
    rim.circle = R(2.0) * REAL_OF(CYLINDER_PI) / rim.means.mean;
    rim.sigma = c2 * rim.means.squares;
    const REAL share = R(0.5) * rim.circle / a, turn = share * at->radius / a; /* c/(2 a) = rho R/(2 a^2) */
    rim.first = turn * (R(1.0) + rim.sigma);
    rim.cube = turn * (R(3.0) * a2 - c2 - (a2 + c2) * rim.sigma) / rim.product2;
    rim.cube_zero = share * (R(2.0) * a + c * (R(1.0) + rim.sigma)) / rim.greatest2;
    return rim;
}

/* The two series of H_2, without their factors (2 pi/a) y^2 and (2 pi/a) x^2. */
static inline void FN(rim_series)(REAL x, REAL y, REAL *of_y, REAL *of_x)
{
    /* beta_k = binomial(2 k, k)/4^k; doubles hold these exactly */
    /* clang-format off */
    static const double BETA[CYLINDER_SERIES_TERMS + 2] = {
        0x1p-0, 0x2p-2, 0x6p-4, 0x14p-6, 0x46p-8, 0xfcp-10, 0x39cp-12, 0xd68p-14, 0x3246p-16,
        0xbdecp-18, 0x2d1b4p-20, 0xac398p-22, 0x29431cp-24, 0x9eb358p-26, 0x2642178p-28,
        0x93ee7d0p-30, 0x23d3c246p-32, 0x8b18014cp-34, 0x21ceb9344p-36, 0x83abdecb8p-38,
        0x20184b1b34p-40, 0x7d52ab5e08p-42, 0x1e9e6124108p-44, 0x77cfeb6bbb0p-46,
        0x1d543af65f1cp-48, 0x72f8434ae578p-50, 0x1c30907fe7088p-52, 0x6eabb28dd6df0p-54};
    /* clang-format on */
    REAL power_x = R(1.0), power_y = R(1.0), inner_x = R(1.0), inner_y = R(1.0);
    *of_x = *of_y = REAL_OF(BETA[2]);
    for (int j = 1; j < CYLINDER_SERIES_TERMS; ++j) {
        const REAL beta = REAL_OF(BETA[j]), outer = REAL_OF(BETA[j + 2]);
        power_x = power_x * x;
        power_y = power_y * y;
        inner_x = REAL_MULADD(beta, power_x, inner_x);
        inner_y = REAL_MULADD(beta, power_y, inner_y);
        *of_y = REAL_MULADD(outer * power_y, inner_x, *of_y);
        *of_x = REAL_MULADD(outer * power_x, inner_y, *of_x);
    }
}

/* zeta H_2 by the third kind.  nu_first: nu X_1,1/2. */
static inline REAL FN(rim_third)(const FN(cylinder_place) * at, const FN(rim) * rim, REAL nu_first)
{
    const REAL width = at->rho + at->radius, gap = REAL_ABS(at->past) * width;
    const REAL p = rim->greatest * REAL_ABS(at->past) / width;
    const REAL sum = FN(elliptic_third)(&rim->means, REAL_MAX(p, rim->size));
    const REAL least2 = REAL_SELECT(at->within, at->rho2, at->radius2);
    const REAL aside =
        rim->zeta * (rim->circle * REAL_MULADD(at->rho * at->radius, sum, least2) / gap - nu_first);
    const REAL above = REAL_OF(CYLINDER_PI) * rim->sign - rim->zeta * (R(0.5) * rim->circle + nu_first) -
                       R(0.25) * rim->circle * gap * (R(1.0) + sum) / rim->zeta;
    return REAL_SELECT(REAL_LESS(p, rim->size), above, aside);
}

/* zz and ++ of a rim; returns sgn zeta where 2 pi (R/rho)^2 sgn zeta is left out of ++, else 0. */
static inline REAL FN(rim_axial)(const FN(cylinder_place) * at, const FN(rim) * rim, REAL *zz, REAL *pp_2)
{
    const REAL x = at->radius2 / rim->a2, y = at->rho2 / rim->a2, limit = REAL_OF(CYLINDER_SERIES);
    const REAL_MASK within = at->within, near = REAL_LESS(y, limit);
    const REAL lesser = REAL_SELECT(within, y, x);
    const REAL_MASK known = REAL_LESS(lesser, limit),
                    unknown = REAL_LESS_EQUAL(limit, lesser); /* series of H_2 */
    const REAL nu_first = rim->first * REAL_SELECT(within, at->rho2 / at->radius, at->radius);
    REAL rest = R(0.0), inner = R(0.0); /* zeta H_2; ++ by a series */
    if (REAL_ANY(known) || REAL_ANY(near)) {
        const REAL factor = R(2.0) * REAL_OF(CYLINDER_PI) * rim->zeta / rim->a;
        REAL of_x, of_y;
        FN(rim_series)(x, y, &of_y, &of_x);
        rest = factor * REAL_SELECT(within, y * y * of_y, x * x * of_x);
        inner = -(factor * of_y * (at->radius2 / (rim->a2 * rim->a2)));
    }
    if (REAL_ANY(unknown))
        rest = REAL_SELECT(known, rest, FN(rim_third)(at, rim, nu_first));
    const REAL first = REAL_MULADD(rim->zeta, nu_first, rest); /* zeta H_1 */
    /* zeta X_0 - 2 pi sgn zeta = X_0 sgn zeta (|zeta| - M) */
    const REAL short_of = (rim->c2 - at->rho2 - at->radius2) / (rim->size + rim->a) + rim->means.below;
    *zz = REAL_SELECT(within, REAL_MULADD(rim->sign * rim->circle, short_of, first), -first);
    const REAL ratio = at->radius2 / at->rho2, none = R(0.0);
    const REAL inside = -(rest * ratio / at->rho2);
    const REAL outside = (rim->zeta * nu_first + ratio * REAL_MULADD(rim->zeta, rim->circle, first)) / at->rho2;
    *pp_2 = REAL_SELECT(near, inner, REAL_SELECT(within, inside, outside));
    return REAL_SELECT(near, REAL_SELECT(within, none, rim->sign), none);
}

static inline void FN(subtract_rims)(FN(axial) * lower, const FN(axial) * upper)
{
    lower->zz = lower->zz - upper->zz;
    lower->zp_1 = lower->zp_1 - upper->zp_1;
    lower->pp_2 = lower->pp_2 - upper->pp_2;
    lower->zzz = lower->zzz - upper->zzz;
    lower->zzp_1 = lower->zzp_1 - upper->zzp_1;
    lower->zpp = lower->zpp - upper->zpp;
    lower->zzzz = lower->zzzz - upper->zzzz;
    lower->zzzp_1 = lower->zzzp_1 - upper->zzzp_1;
    lower->zzpp = lower->zzpp - upper->zzpp;
}

/* What a rim adds; returns what rim_axial() does. */
static inline __attribute__((always_inline)) REAL FN(rim_derivatives)(const FN(cylinder_place) * at, REAL zeta,
                                                                      FN(axial) * v)
{
    const FN(rim) rim = FN(see_rim)(at, zeta);
    const REAL radius = at->radius, past = at->past;
    const REAL a = rim.a, a2 = rim.a2, c = rim.c, c2 = rim.c2, sigma = rim.sigma;
    const REAL left_out = FN(rim_axial)(at, &rim, &v->zz, &v->pp_2);
    v->zp_1 = -(radius * rim.first);
    /* X_1 and X_0 - X_1, X_1 - X_2 of the power 3/2 */
    const REAL cube = at->rho * rim.cube, past_cube = past * cube;
    const REAL cube_two =
        R(0.5) * rim.circle / (a2 * rim.greatest2) *
        (c * (R(3.0) * a + R(2.0) * c) + sigma * (R(2.0) * a2 + R(3.0) * a * c + R(2.0) * c2));
    v->zzz = radius * (radius * rim.cube_zero - past_cube);
    v->zzp_1 = radius * zeta * rim.cube;
    v->zpp = radius * REAL_MULADD(radius, cube_two, past_cube);
    /* The same of the power 5/2: with A = a^2 + c^2, B = 2 rho R, Y_1 = (B X_0 + A X_1/3)/(a_0 b_0)^2, Y_0 -
     * Y_1 = (X_0 - X_1/3)/a_0^2, Y_1 - Y_2 = 4 X_1/(3 B) - (Y_0 - Y_1). */
    const REAL third = R(1.0) / R(3.0), zero = rim.circle * REAL_NEGMULADD(c2, sigma, a2) / rim.product2;
    const REAL fifth = REAL_MULADD(R(2.0) * radius, zero, third * (a2 + c2) * rim.cube) / rim.product2;
    const REAL fifth_zero = REAL_NEGMULADD(third, cube, zero) / rim.greatest2;
    const REAL fifth_two = R(2.0) * third * rim.cube / radius - fifth_zero;
    const REAL past_fifth = past * at->rho * fifth, factor = R(-3.0) * radius * zeta;
    v->zzzz = factor * (radius * fifth_zero - past_fifth);
    v->zzzp_1 = radius * REAL_NEGMULADD(R(3.0) * zeta * zeta, fifth, rim.cube);
    v->zzpp = factor * REAL_MULADD(radius, fifth_two, past_fifth);
    return left_out;
}

static inline __attribute__((always_inline)) void FN(by_rims)(const FN(cylinder_place) * at, FN(axial) * v)
{
    FN(axial) upper;
    const REAL below = FN(rim_derivatives)(at, at->z + at->half, v);
    const REAL above = FN(rim_derivatives)(at, at->z - at->half, &upper);
    FN(subtract_rims)(v, &upper);
    const REAL left_out = below - above;
    const REAL whole = R(2.0) * REAL_OF(CYLINDER_PI) * left_out * at->radius2 / (at->rho2 * at->rho2);
    v->pp_2 = REAL_SELECT(REAL_LESS(R(0.5), left_out), v->pp_2 + whole, v->pp_2);
}

/* ------------------------------------------------------------------ far away
 *
 * V = sum of M_n P_n(cos)/r^(n+1), n = 0, 2, 4, ..., and each of its terms is M_n/n! times the n-th derivative
 * of 1/r along z.  With d(l, m) for the derivative of 1/r of order l, m of it along d+, over rho^m exp(i m
 * phi),
 *
 *     d(l+1, m) r^2 = -(2 l + 1) z d(l, m) - (l^2 - m^2) d(l-1, m),   d(m, m) = (-1)^m (2m - 1)!!/r^(2m+1).
 *
 * M_n/n! = 4 pi R s(n + 2), where s(l) is the solid harmonic r^l P_l^1/(l + 1)! at the rim:
 *
 *     l (l + 2) s(l+1) = (2 l + 1) h s(l) - (R^2 + h^2) s(l-1),   s(0) = 0, s(1) = R/2.
 */
typedef struct FN(multipoles) {
    REAL z, per_r2;
    REAL half, corner2; /* h, R^2 + h^2 */
    REAL s[2];          /* s(l), s(l + 1) */
    REAL d[3][2];       /* d(l, m), d(l - 1, m) */
    FN(axial) sum;
} FN(multipoles);

static inline __attribute__((always_inline)) void FN(next_order)(FN(multipoles) * f, int l)
{
    for (int m = 0; m < 3; ++m) {
        const REAL next = -(f->per_r2 * REAL_MULADD(REAL_OF(2 * l + 1) * f->z, f->d[m][0],
                                                    REAL_OF(l * l - m * m) * f->d[m][1]));
        f->d[m][1] = f->d[m][0];
        f->d[m][0] = next;
    }
}

static inline __attribute__((always_inline)) void FN(next_moment)(FN(multipoles) * f, int l)
{
    const REAL next = REAL_MULSUB(REAL_OF(2 * l + 1) * f->half, f->s[1], f->corner2 * f->s[0]);
    f->s[0] = f->s[1];
    f->s[1] = next * (R(1.0) / REAL_OF(l * (l + 2)));
}

/* The term of n; d and s are those of l = n + 2 before, of n + 4 after. */
static inline __attribute__((always_inline)) void FN(add_multipole)(FN(multipoles) * f, int n)
{
    const REAL moment = f->s[0];
    FN(axial) *v = &f->sum;
    v->zz = REAL_MULADD(moment, f->d[0][0], v->zz);
    v->zp_1 = REAL_MULADD(moment, f->d[1][0], v->zp_1);
    v->pp_2 = REAL_MULADD(moment, f->d[2][0], v->pp_2);
    FN(next_order)(f, n + 2);
    v->zzz = REAL_MULADD(moment, f->d[0][0], v->zzz);
    v->zzp_1 = REAL_MULADD(moment, f->d[1][0], v->zzp_1);
    v->zpp = REAL_MULADD(moment, f->d[2][0], v->zpp);
    FN(next_order)(f, n + 3);
    v->zzzz = REAL_MULADD(moment, f->d[0][0], v->zzzz);
    v->zzzp_1 = REAL_MULADD(moment, f->d[1][0], v->zzzp_1);
    v->zzpp = REAL_MULADD(moment, f->d[2][0], v->zzpp);
    FN(next_moment)(f, n + 3);
    FN(next_moment)(f, n + 4);
}

static inline void FN(by_multipoles)(const FN(cylinder_place) * at, FN(axial) * v)
{
    const REAL zero = R(0.0), r2 = REAL_MULADD(at->z, at->z, at->rho2);
    const FN(axial) nothing = {zero, zero, zero, zero, zero, zero, zero, zero, zero};
    FN(multipoles) f = {.z = at->z, .per_r2 = R(1.0) / r2, .half = at->half, .sum = nothing};
    f.corner2 = REAL_MULADD(at->half, at->half, at->radius2);
    const REAL per_r = R(1.0) / REAL_SQRT(r2), per_r3 = per_r * f.per_r2;
    const REAL along = -(at->z * f.per_r2);
    f.d[0][1] = along * per_r;                                  /* l = 1 */
    f.d[0][0] = REAL_MULSUB(R(3.0) * along, f.d[0][1], per_r3); /* l = 2 */
    f.d[1][1] = -per_r3;
    f.d[1][0] = R(3.0) * along * f.d[1][1];
    f.d[2][1] = zero;
    f.d[2][0] = R(3.0) * per_r3 * f.per_r2;
    const REAL factor = R(2.0) * REAL_OF(CYLINDER_PI) * at->radius2; /* 4 pi R s(1) */
    f.s[0] = factor * at->half;                                      /* s(2) = h R/2, and so on */
    f.s[1] = factor * REAL_MULSUB(R(5.0) * at->half, at->half, f.corner2) / R(8.0);
    FN(add_multipole)(&f, 0);
    FN(add_multipole)(&f, 2);
    FN(add_multipole)(&f, 4);
    FN(add_multipole)(&f, 6);
    FN(add_multipole)(&f, 8);
    FN(add_multipole)(&f, 10);
    FN(add_multipole)(&f, 12);
    FN(add_multipole)(&f, 14);
    FN(add_multipole)(&f, 16);
    FN(add_multipole)(&f, 18);
    FN(add_multipole)(&f, 20);
    FN(add_multipole)(&f, 22);
    FN(add_multipole)(&f, 24);
    FN(add_multipole)(&f, 26);
    FN(add_multipole)(&f, 28);
    FN(add_multipole)(&f, 30);
    *v = f.sum;
    v->zpp = v->zpp * at->rho2;
    v->zzpp = v->zzpp * at->rho2;
}

/* ------------------------------------------------------------------ B, G and T */

static inline void FN(select_axial)(REAL_MASK mask, const FN(axial) * yes, FN(axial) * no)
{
    no->zz = REAL_SELECT(mask, yes->zz, no->zz);
    no->zp_1 = REAL_SELECT(mask, yes->zp_1, no->zp_1);
    no->pp_2 = REAL_SELECT(mask, yes->pp_2, no->pp_2);
    no->zzz = REAL_SELECT(mask, yes->zzz, no->zzz);
    no->zzp_1 = REAL_SELECT(mask, yes->zzp_1, no->zzp_1);
    no->zpp = REAL_SELECT(mask, yes->zpp, no->zpp);
    no->zzzz = REAL_SELECT(mask, yes->zzzz, no->zzzz);
    no->zzzp_1 = REAL_SELECT(mask, yes->zzzp_1, no->zzzp_1);
    no->zzpp = REAL_SELECT(mask, yes->zzpp, no->zzpp);
}

static inline __attribute__((always_inline)) void FN(axial_derivatives)(const FN(cylinder_place) * at,
                                                                        FN(axial) * v)
{
    const REAL r2 = REAL_MULADD(at->z, at->z, at->rho2);
    const REAL edge2 = REAL_OF(CYLINDER_FAR) * REAL_MULADD(at->half, at->half, at->radius2);
    const REAL_MASK far = REAL_LESS(edge2, r2), near = REAL_LESS_EQUAL(r2, edge2);
    FN(axial) afar;
    if (!REAL_ANY(far)) {
        FN(by_rims)(at, v);
        return;
    }
    FN(by_multipoles)(at, &afar);
    *v = afar;
    if (REAL_ANY(near)) {
        FN(by_rims)(at, v);
        FN(select_axial)(far, &afar, v);
    }
}

/* A derivative of V times exp(i m phi): its real and its imaginary part. */
typedef struct FN(turned) {
    REAL x, y;
} FN(turned);

static inline FN(turned) FN(turn_on)(FN(turned) a, FN(turned) b)
{
    const FN(turned) product = {REAL_MULSUB(a.x, b.x, a.y * b.y), REAL_MULADD(a.x, b.y, a.y * b.x)};
    return product;
}

/* (J.grad)/(4 pi) of a derivative, for j = J/(4 pi): `along` is what d/dz makes of it, `up` what d+ makes of
 * it, `down` what d- does. */
static inline FN(turned) FN(along_remanence)(const REAL j[3], FN(turned) along, FN(turned) up, FN(turned) down)
{
    const REAL half = R(0.5);
    FN(turned) sum;
    sum.x = REAL_MULADD(j[2], along.x, half * (j[0] * (up.x + down.x) + j[1] * (up.y - down.y)));
    sum.y = REAL_MULADD(j[2], along.y, half * (j[0] * (up.y + down.y) - j[1] * (up.x - down.x)));
    return sum;
}

static inline FN(turned) FN(scaled)(REAL size, FN(turned) a)
{
    const FN(turned) product = {size * a.x, size * a.y};
    return product;
}

static inline FN(turned) FN(mirrored)(FN(turned) a)
{
    const FN(turned) conjugate = {a.x, -a.y};
    return conjugate;
}

static inline __attribute__((always_inline)) void FN(cylinder_field)(const FN(part) * part, const REAL d[3],
                                                                     FN(local_field) * to)
{
    const REAL zero = R(0.0), tiny = REAL_OF(1e-150);
    FN(cylinder_place) at;
    at.z = d[2];
    at.rho2 = REAL_MULADD(d[0], d[0], d[1] * d[1]);
    at.rho = REAL_SQRT(at.rho2);
    at.radius = part->half[0];
    at.half = part->half[2];
    at.radius2 = at.radius * at.radius;
    at.past = at.rho - at.radius;
    at.within = REAL_LESS(at.past, zero);
    FN(axial) v;
    FN(axial_derivatives)(&at, &v);

    const REAL per_rho = R(1.0) / REAL_MAX(at.rho, tiny);
    const FN(turned) place = {d[0], d[1]}, e = {d[0] * per_rho, d[1] * per_rho};
    const FN(turned) e2 = FN(turn_on)(e, e), place2 = FN(turn_on)(place, place);
    const REAL ppp_1 = -REAL_MULADD(R(4.0), v.pp_2, v.zzp_1);
    const REAL zppp = -REAL_MULADD(R(4.0), v.zpp * per_rho, at.rho * v.zzzp_1);
    const REAL pppp = -REAL_MULADD(R(6.0), ppp_1, v.zzpp);
    const FN(turned) zz = {v.zz, zero}, zp = FN(scaled)(v.zp_1, place), pp = FN(scaled)(v.pp_2, place2);
    const FN(turned) zzz = {v.zzz, zero}, zzp = FN(scaled)(v.zzp_1, place), zpp = FN(scaled)(v.zpp, e2);
    const FN(turned) ppp = FN(scaled)(ppp_1, FN(turn_on)(place, e2));
    const FN(turned) zzzz = {v.zzzz, zero}, zzzp = FN(scaled)(v.zzzp_1, place), zzpp = FN(scaled)(v.zzpp, e2);
    const FN(turned) e3 = FN(turn_on)(e, e2);
    const FN(turned) zppp_turned = FN(scaled)(zppp, e3), pppp_turned = FN(scaled)(pppp, FN(turn_on)(e2, e2));

    const REAL quarter = R(0.25) / REAL_OF(CYLINDER_PI);
    const REAL j[3] = {quarter * part->j[0], quarter * part->j[1], quarter * part->j[2]};
    const FN(turned) bz = FN(along_remanence)(j, zz, zp, FN(mirrored)(zp));
    const FN(turned) bp = FN(along_remanence)(j, zp, pp, FN(scaled)(R(-1.0), zz));
    to->b[0] = bp.x;
    to->b[1] = bp.y;
    to->b[2] = bz.x;
    const FN(turned) gzz = FN(along_remanence)(j, zzz, zzp, FN(mirrored)(zzp));
    const FN(turned) gzp = FN(along_remanence)(j, zzp, zpp, FN(scaled)(R(-1.0), zzz));
    const FN(turned) gpp = FN(along_remanence)(j, zpp, ppp, FN(scaled)(R(-1.0), zzp));
    to->gradient.xx = R(0.5) * (gpp.x - gzz.x);
    to->gradient.yy = R(-0.5) * (gpp.x + gzz.x);
    to->gradient.xy = R(0.5) * gpp.y;
    to->gradient.xz = gzp.x;
    to->gradient.yz = gzp.y;
    const FN(turned) tzzz = FN(along_remanence)(j, zzzz, zzzp, FN(mirrored)(zzzp));
    const FN(turned) tzzp = FN(along_remanence)(j, zzzp, zzpp, FN(scaled)(R(-1.0), zzzz));
    const FN(turned) tzpp = FN(along_remanence)(j, zzpp, zppp_turned, FN(scaled)(R(-1.0), zzzp));
    const FN(turned) tppp = FN(along_remanence)(j, zppp_turned, pppp_turned, FN(scaled)(R(-1.0), zzpp));
    FN(bend) *t = &to->bend;
    t->scale = t->vertical = R(1.0);
    t->xxx = R(0.25) * (tppp.x - R(3.0) * tzzp.x);
    t->xyy = R(-0.25) * (tppp.x + tzzp.x);
    t->xxy = R(0.25) * (tppp.y - tzzp.y);
    t->yyy = R(-0.25) * (tppp.y + R(3.0) * tzzp.y);
    t->xxz = R(0.5) * (tzpp.x - tzzz.x);
    t->yyz = R(-0.5) * (tzpp.x + tzzz.x);
    t->xyz = R(0.5) * tzpp.y;
}
