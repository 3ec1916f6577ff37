/* cylinder.inl - the field of a uniformly magnetised cylinder, outside of it, over REAL.
 *
 * V, called Phi in derivatives.inl, is the integral of 1/distance over the cylinder of radius R and half height
 * h, and its second, third and fourth derivatives are what is wanted.  Take them along z and along x + i y, d+
 * = d/dx + i d/dy and d- = d/dx - i d/dy.  As V has axial symmetry, m derivatives along d+ leave a number times
 * exp(i m phi), and d+ d- = -d/dz d/dz.  With `zz+` for d/dz d/dz d+ and so on there are
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
 *     z+   = -R X_1,1/2
 *     zz+  = R zeta X_1,3/2
 *     z++  = R (rho X_1 - R X_2),3/2
 *     zzz  = R (R X_0 - rho X_1),3/2
 *     zzz+ = R (X_1,3/2 - 3 zeta^2 X_1,5/2)
 *     zz++ = -3 R zeta (rho X_1 - R X_2),5/2
 *     zzzz = -3 R zeta (R X_0 - rho X_1),5/2.
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
enum { FN(axial_of_field) = 6, FN(axial_all) = 9 }; /* without and with the fourth derivatives */
typedef union FN(axial) {
    struct {
        REAL zz, zp_1, pp_2;     /* zz, z+, ++ */
        REAL zzz, zzp_1, zpp;    /* zzz, zz+, z++ */
        REAL zzzz, zzzp_1, zzpp; /* zzzz, zzz+, zz++ */
    };
    REAL all[FN(axial_all)];
} FN(axial);

typedef struct FN(cylinder_place) {
    REAL rho, rho2, per_rho2;
    REAL radius, radius2, per_radius, area; /* area: rho R */
    REAL past, width, per_width;            /* rho - R, rho + R */
    REAL z, half;
    REAL_MASK within; /* rho < R */
} FN(cylinder_place);

static inline FN(cylinder_place) FN(see_cylinder)(const FN(part) * part, const REAL d[3])
{
    FN(cylinder_place) at;
    at.rho2 = REAL_MULADD(d[0], d[0], d[1] * d[1]);
    at.per_rho2 = REAL_RECIPROCAL(REAL_MAX(at.rho2, REAL_OF(1e-300)));
    at.rho = REAL_SQRT(at.rho2);
    at.radius = part->half[0];
    at.radius2 = at.radius * at.radius;
    at.per_radius = REAL_RECIPROCAL(at.radius);
    at.area = at.rho * at.radius;
    at.past = at.rho - at.radius;
    at.width = at.rho + at.radius;
    at.per_width = REAL_RECIPROCAL(at.width);
    at.z = d[2];
    at.half = part->half[2];
    at.within = REAL_LESS(at.past, R(0.0));
    return at;
}

/* ------------------------------------------------------------------ a rim */

typedef struct FN(rim) {
    REAL zeta, size, sign;        /* the height over the rim; size, sign: of zeta */
    REAL greatest, per_greatest2; /* a_0, 1/a_0^2 */
    REAL per_product2;            /* 1/(a_0 b_0)^2 */
    REAL a, a2, per_a, per_a2, c, c2;
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
    const REAL zeta2 = zeta * zeta, greatest2 = REAL_MULADD(at->width, at->width, zeta2);
    const REAL least2 = REAL_MULADD(at->past, at->past, zeta2);
    rim.zeta = zeta;
    rim.size = REAL_ABS(zeta);
    rim.sign = REAL_SELECT(REAL_LESS(zeta, R(0.0)), R(-1.0), R(1.0));
    rim.greatest = ELLIPTIC_ROOT(greatest2);
    const REAL least = ELLIPTIC_ROOT(least2), product = rim.greatest * least;
    const REAL a = R(0.5) * (rim.greatest + least), per_a = REAL_RECIPROCAL(a), a2 = a * a;
    const REAL c = at->area * per_a, c2 = c * c;
    rim.a = a;
    rim.a2 = a2;
    rim.c = c;
    rim.c2 = c2;
    rim.per_a2 = per_a * per_a;
    rim.per_greatest2 = REAL_RECIPROCAL(greatest2);
    rim.per_product2 = REAL_RECIPROCAL(product * product);
    rim.means = FN(elliptic_mean)(a, product, c);
    rim.circle = R(2.0) * REAL_OF(CYLINDER_PI) * REAL_RECIPROCAL(rim.means.mean);
    rim.sigma = c2 * rim.means.squares;
    const REAL share = R(0.5) * rim.circle * per_a, turn = share * at->radius * per_a; /* times rho: c/(2 a) */
    rim.per_a = per_a;
    rim.first = turn * (R(1.0) + rim.sigma);
    rim.cube = turn * (R(3.0) * a2 - c2 - (a2 + c2) * rim.sigma) * rim.per_product2;
    rim.cube_zero = share * (R(2.0) * a + c * (R(1.0) + rim.sigma)) * rim.per_greatest2;
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
    const REAL past = REAL_ABS(at->past), gap = past * at->width, p = rim->greatest * (past * at->per_width);
    const REAL_MASK over = REAL_LESS(p, rim->size);
    const REAL sum = FN(elliptic_third)(&rim->means, REAL_MAX(p, rim->size));
    const REAL inverse = REAL_RECIPROCAL(REAL_SELECT(over, rim->zeta, gap));
    const REAL least2 = REAL_SELECT(at->within, at->rho2, at->radius2);
    const REAL aside = rim->zeta * (rim->circle * REAL_MULADD(at->area, sum, least2) * inverse - nu_first);
    const REAL above = REAL_OF(CYLINDER_PI) * rim->sign - rim->zeta * (R(0.5) * rim->circle + nu_first) -
                       R(0.25) * rim->circle * gap * (R(1.0) + sum) * inverse;
    return REAL_SELECT(over, above, aside);
}

/* zz and ++ of a rim; returns sgn zeta where 2 pi (R/rho)^2 sgn zeta is left out of ++, else 0. */
static inline REAL FN(rim_axial)(const FN(cylinder_place) * at, const FN(rim) * rim, FN(axial) * v)
{
    const REAL limit = REAL_OF(CYLINDER_SERIES), none = R(0.0);
    const REAL x = at->radius2 * rim->per_a2, y = at->rho2 * rim->per_a2;
    const REAL_MASK within = at->within, near = REAL_LESS(y, limit);
    const REAL lesser = REAL_SELECT(within, y, x); /* H_2 has a series where it is small */
    const REAL_MASK known = REAL_LESS(lesser, limit), unknown = REAL_LESS_EQUAL(limit, lesser);
    const REAL nu_first = rim->first * REAL_SELECT(within, at->rho2 * at->per_radius, at->radius);
    REAL rest = none, inner = none; /* zeta H_2; ++ by a series */
    if (REAL_ANY(known) || REAL_ANY(near)) {
        const REAL factor = R(2.0) * REAL_OF(CYLINDER_PI) * rim->zeta * rim->per_a;
        REAL of_x, of_y;
        FN(rim_series)(x, y, &of_y, &of_x);
        rest = factor * REAL_SELECT(within, y * y * of_y, x * x * of_x);
        inner = -(factor * of_y * (x * rim->per_a2));
    }
    if (REAL_ANY(unknown))
        rest = REAL_SELECT(known, rest, FN(rim_third)(at, rim, nu_first));
    const REAL first = REAL_MULADD(rim->zeta, nu_first, rest); /* zeta H_1 */
    /* zeta X_0 - 2 pi sgn zeta = X_0 sgn zeta (|zeta| - M) */
    const REAL short_of =
        (rim->c2 - at->rho2 - at->radius2) * REAL_RECIPROCAL(rim->size + rim->a) + rim->means.below;
    v->zz = REAL_SELECT(within, REAL_MULADD(rim->sign * rim->circle, short_of, first), -first);
    const REAL ratio = at->radius2 * at->per_rho2;
    const REAL inside = -(rest * ratio);
    const REAL outside = REAL_MULADD(rim->zeta, nu_first, ratio * REAL_MULADD(rim->zeta, rim->circle, first));
    v->pp_2 = REAL_SELECT(near, inner, REAL_SELECT(within, inside, outside) * at->per_rho2);
    return REAL_SELECT(near, REAL_SELECT(within, none, rim->sign), none);
}

/* What a rim adds; returns what rim_axial() does. */
static inline __attribute__((always_inline)) REAL FN(rim_derivatives)(const FN(cylinder_place) * at, REAL zeta,
                                                                      int with_fourth, FN(axial) * v)
{
    const FN(rim) rim = FN(see_rim)(at, zeta);
    const REAL radius = at->radius, past = at->past;
    const REAL a = rim.a, a2 = rim.a2, c = rim.c, c2 = rim.c2, sigma = rim.sigma;
    const REAL left_out = FN(rim_axial)(at, &rim, v);
    v->zp_1 = -(radius * rim.first);
    /* X_1 and X_0 - X_1, X_1 - X_2 of the power 3/2 */
    const REAL cube = at->rho * rim.cube, past_cube = past * cube;
    const REAL cube_two =
        R(0.5) * rim.circle * (rim.per_a2 * rim.per_greatest2) *
        (c * (R(3.0) * a + R(2.0) * c) + sigma * (R(2.0) * a2 + R(3.0) * a * c + R(2.0) * c2));
    v->zzz = radius * REAL_MULSUB(radius, rim.cube_zero, past_cube);
    v->zzp_1 = radius * zeta * rim.cube;
    v->zpp = radius * REAL_MULADD(radius, cube_two, past_cube);
    if (!with_fourth)
        return left_out;
    /* The same of the power 5/2: with A = a^2 + c^2, B = 2 rho R, Y_1 = (B X_0 + A X_1/3)/(a_0 b_0)^2, Y_0 -
     * Y_1 = (X_0 - X_1/3)/a_0^2, Y_1 - Y_2 = 4 X_1/(3 B) - (Y_0 - Y_1). */
    const REAL third = R(1.0) / R(3.0), zero = rim.circle * REAL_NEGMULADD(c2, sigma, a2) * rim.per_product2;
    const REAL fifth = REAL_MULADD(R(2.0) * radius, zero, third * (a2 + c2) * rim.cube) * rim.per_product2;
    const REAL fifth_zero = REAL_NEGMULADD(third, cube, zero) * rim.per_greatest2;
    const REAL fifth_two = R(2.0) * third * rim.cube * at->per_radius - fifth_zero;
    const REAL past_fifth = past * at->rho * fifth, factor = R(-3.0) * radius * zeta;
    v->zzzz = factor * REAL_MULSUB(radius, fifth_zero, past_fifth);
    v->zzzp_1 = radius * REAL_NEGMULADD(R(3.0) * zeta * zeta, fifth, rim.cube);
    v->zzpp = factor * REAL_MULADD(radius, fifth_two, past_fifth);
    return left_out;
}

static inline __attribute__((always_inline)) void FN(by_rims)(const FN(cylinder_place) * at, int with_fourth,
                                                              FN(axial) * v)
{
    FN(axial) upper;
    const REAL below = FN(rim_derivatives)(at, at->z + at->half, with_fourth, v);
    const REAL above = FN(rim_derivatives)(at, at->z - at->half, with_fourth, &upper);
    for (int n = 0; n < (with_fourth ? FN(axial_all) : FN(axial_of_field)); ++n)
        v->all[n] = v->all[n] - upper.all[n];
    const REAL left_out = below - above;
    const REAL whole = R(2.0) * REAL_OF(CYLINDER_PI) * left_out * (at->radius2 * at->per_rho2) * at->per_rho2;
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
static inline __attribute__((always_inline)) void FN(add_multipole)(FN(multipoles) * f, int n, int with_fourth)
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
    if (with_fourth) {
        v->zzzz = REAL_MULADD(moment, f->d[0][0], v->zzzz);
        v->zzzp_1 = REAL_MULADD(moment, f->d[1][0], v->zzzp_1);
        v->zzpp = REAL_MULADD(moment, f->d[2][0], v->zzpp);
    }
    FN(next_moment)(f, n + 3);
    FN(next_moment)(f, n + 4);
}

static inline __attribute__((always_inline)) void FN(by_multipoles)(const FN(cylinder_place) * at,
                                                                    int with_fourth, FN(axial) * v)
{
    const REAL zero = R(0.0), r2 = REAL_MULADD(at->z, at->z, at->rho2);
    FN(multipoles) f = {.z = at->z, .per_r2 = R(1.0) / r2, .half = at->half};
    for (int n = 0; n < FN(axial_all); ++n)
        f.sum.all[n] = zero;
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
    FN(add_multipole)(&f, 0, with_fourth);
    FN(add_multipole)(&f, 2, with_fourth);
    FN(add_multipole)(&f, 4, with_fourth);
    FN(add_multipole)(&f, 6, with_fourth);
    FN(add_multipole)(&f, 8, with_fourth);
    FN(add_multipole)(&f, 10, with_fourth);
    FN(add_multipole)(&f, 12, with_fourth);
    FN(add_multipole)(&f, 14, with_fourth);
    FN(add_multipole)(&f, 16, with_fourth);
    FN(add_multipole)(&f, 18, with_fourth);
    FN(add_multipole)(&f, 20, with_fourth);
    FN(add_multipole)(&f, 22, with_fourth);
    FN(add_multipole)(&f, 24, with_fourth);
    FN(add_multipole)(&f, 26, with_fourth);
    FN(add_multipole)(&f, 28, with_fourth);
    FN(add_multipole)(&f, 30, with_fourth);
    *v = f.sum;
    v->zpp = v->zpp * at->rho2;
    v->zzpp = v->zzpp * at->rho2;
}

/* ------------------------------------------------------------------ both */

static inline __attribute__((always_inline)) void FN(axial_derivatives)(const FN(cylinder_place) * at,
                                                                        int with_fourth, FN(axial) * v)
{
    const REAL r2 = REAL_MULADD(at->z, at->z, at->rho2);
    const REAL edge2 = REAL_OF(CYLINDER_FAR) * REAL_MULADD(at->half, at->half, at->radius2);
    const REAL_MASK far = REAL_LESS(edge2, r2), near = REAL_LESS_EQUAL(r2, edge2);
    FN(axial) afar;
    if (REAL_ANY(far))
        FN(by_multipoles)(at, with_fourth, &afar);
    if (REAL_ANY(near))
        FN(by_rims)(at, with_fourth, v);
    else
        *v = afar;
    for (int n = 0; REAL_ANY(far) && n < (with_fourth ? FN(axial_all) : FN(axial_of_field)); ++n)
        v->all[n] = REAL_SELECT(far, afar.all[n], v->all[n]);
}

/* A number times exp(i m phi): real and imaginary part. */
typedef struct FN(turned) {
    REAL x, y;
} FN(turned);

static inline FN(turned) FN(turn_on)(FN(turned) a, FN(turned) b)
{
    const FN(turned) product = {REAL_MULSUB(a.x, b.x, a.y * b.y), REAL_MULADD(a.x, b.y, a.y * b.x)};
    return product;
}

static inline FN(turned) FN(scaled)(REAL size, FN(turned) a)
{
    const FN(turned) product = {size * a.x, size * a.y};
    return product;
}

/* (J.grad)/(4 pi) of a derivative of V, for j = J/(4 pi): `along` is what d/dz makes of it, `up` what d+ makes
 * of it, `down` what d- does.  B_z, B_x + i B_y and their like are such; taken so, and not from derivatives
 * along x and y, they keep their digits where J lies along the axis and other derivatives are far greater. */
static inline FN(turned) FN(along_remanence)(const REAL j[3], FN(turned) along, FN(turned) up, FN(turned) down)
{
    const REAL half = R(0.5);
    FN(turned) sum;
    sum.x = REAL_MULADD(j[2], along.x, half * REAL_MULADD(j[0], up.x + down.x, j[1] * (up.y - down.y)));
    sum.y = REAL_MULADD(j[2], along.y, half * REAL_MULSUB(j[0], up.y + down.y, j[1] * (up.x - down.x)));
    return sum;
}

/* The same of a derivative with z alone, which is real; of its two neighbours one is given. */
static inline REAL FN(upright)(const REAL j[3], REAL along, FN(turned) up)
{
    return REAL_MULADD(j[2], along, REAL_MULADD(j[0], up.x, j[1] * up.y));
}

/* Of zz, z+, ++ and so on with their directions. */
typedef struct FN(directed) {
    REAL j[3];
    FN(turned) zz, zp, pp, zzz, zzp, zpp, ppp, zzzz, zzzp, zzpp, zppp, pppp;
} FN(directed);

static inline FN(turned) FN(upward)(REAL value)
{
    const FN(turned) real = {value, R(0.0)};
    return real;
}

static inline __attribute__((always_inline)) FN(directed)
    FN(see_derivatives)(const FN(part) * part, const REAL d[3], int with_fourth)
{
    const FN(cylinder_place) at = FN(see_cylinder)(part, d);
    FN(axial) v;
    FN(axial_derivatives)(&at, with_fourth, &v);
    const REAL per_rho = REAL_RECIPROCAL(REAL_MAX(at.rho, REAL_OF(1e-150)));
    const FN(turned) place = {d[0], d[1]}, e = {d[0] * per_rho, d[1] * per_rho};
    const FN(turned) e2 = FN(turn_on)(e, e), place3 = FN(turn_on)(place, e2);
    const REAL ppp_1 = -REAL_MULADD(R(4.0), v.pp_2, v.zzp_1);
    FN(directed) to;
    for (int i = 0; i < 3; ++i)
        to.j[i] = R(0.25) / REAL_OF(CYLINDER_PI) * part->j[i];
    to.zz = FN(upward)(v.zz);
    to.zp = FN(scaled)(v.zp_1, place);
    to.pp = FN(scaled)(v.pp_2, FN(turn_on)(place, place));
    to.zzz = FN(upward)(v.zzz);
    to.zzp = FN(scaled)(v.zzp_1, place);
    to.zpp = FN(scaled)(v.zpp, e2);
    to.ppp = FN(scaled)(ppp_1, place3);
    if (with_fourth) {
        to.zzzz = FN(upward)(v.zzzz);
        to.zzzp = FN(scaled)(v.zzzp_1, place);
        to.zzpp = FN(scaled)(v.zzpp, e2);
        to.zppp = FN(scaled)(-REAL_MULADD(R(4.0) * v.zpp, at.per_rho2, v.zzzp_1), place3);
        to.pppp = FN(scaled)(-REAL_MULADD(R(6.0), ppp_1, v.zzpp), FN(turn_on)(e2, e2));
    }
    return to;
}

static inline __attribute__((always_inline)) void FN(field_of_derivatives)(const FN(directed) * v, REAL b[3],
                                                                           FN(gradient) * g)
{
    const REAL minus = R(-1.0), half = R(0.5);
    const FN(turned) across = FN(along_remanence)(v->j, v->zp, v->pp, FN(scaled)(minus, v->zz));
    b[0] = across.x;
    b[1] = across.y;
    b[2] = FN(upright)(v->j, v->zz.x, v->zp);
    const REAL zz = FN(upright)(v->j, v->zzz.x, v->zzp);
    const FN(turned) zp = FN(along_remanence)(v->j, v->zzp, v->zpp, FN(scaled)(minus, v->zzz));
    const FN(turned) pp = FN(along_remanence)(v->j, v->zpp, v->ppp, FN(scaled)(minus, v->zzp));
    g->xx = half * (pp.x - zz);
    g->yy = -(half * (pp.x + zz));
    g->xy = half * pp.y;
    g->xz = zp.x;
    g->yz = zp.y;
}

/* With p = d+: ppp = xxx - 3 xyy + i (3 xxy - yyy), and xx + yy = -zz. */
static inline __attribute__((always_inline)) void FN(bend_of_derivatives)(const FN(directed) * v, FN(bend) * t)
{
    const REAL minus = R(-1.0), half = R(0.5), quarter = R(0.25), three = R(3.0);
    const REAL zzz = FN(upright)(v->j, v->zzzz.x, v->zzzp);
    const FN(turned) zzp = FN(along_remanence)(v->j, v->zzzp, v->zzpp, FN(scaled)(minus, v->zzzz));
    const FN(turned) zpp = FN(along_remanence)(v->j, v->zzpp, v->zppp, FN(scaled)(minus, v->zzzp));
    const FN(turned) ppp = FN(along_remanence)(v->j, v->zppp, v->pppp, FN(scaled)(minus, v->zzpp));
    t->scale = t->vertical = R(1.0);
    t->xxx = quarter * REAL_NEGMULADD(three, zzp.x, ppp.x);
    t->xxy = quarter * (ppp.y - zzp.y);
    t->xyy = -(quarter * (ppp.x + zzp.x));
    t->yyy = -(quarter * REAL_MULADD(three, zzp.y, ppp.y));
    t->xxz = half * (zpp.x - zzz);
    t->yyz = -(half * (zpp.x + zzz));
    t->xyz = half * zpp.y;
}

/* B and G of a cylinder at the place d from its centre. */
PART_KIND void FN(cylinder_field)(const FN(part) * part, const REAL d[3], REAL b[3], FN(gradient) * g)
{
    const FN(directed) v = FN(see_derivatives)(part, d, 0);
    FN(field_of_derivatives)(&v, b, g);
}

/* And T. */
PART_KIND void FN(cylinder_look)(const FN(part) * part, const REAL d[3], FN(local_field) * at)
{
    const FN(directed) v = FN(see_derivatives)(part, d, 1);
    FN(field_of_derivatives)(&v, at->b, &at->gradient);
    FN(bend_of_derivatives)(&v, &at->bend);
}
