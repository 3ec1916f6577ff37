/* The field of a uniformly magnetised cylinder (model/source/cylinder.inl): against quadrature, Maxwell's
 * equations, closed forms, limits, and itself cut in two. (test_cylinder_double.c: double against long
 * double.)
 * tests: model/source/cylinder.inl model/source/derivatives.inl
 * labels: long-double */
#include "cylinder_fields.h"
#include "cylinder_golden.h"

static const double REMANENCES[][3] = {{0, 0, 1}, {1, 0, 0}, {0.2, -0.6, 0.9}};

/* ------------------------------------------------------------------ against quadrature */

static void test_golden(void **unused)
{
    (void)unused;
    for (size_t n = 0; n < COUNT(CYLINDER_GOLDEN); ++n) {
        const cylinder_golden *golden = &CYLINDER_GOLDEN[n];
        cylinder c = {10, 4, {0}};
        memcpy(c.j, golden->remanence, sizeof c.j);
        const long double place[3] = {golden->place[0], golden->place[1], golden->place[2]};
        long double found[FIELD_NUMBERS], rounded[FIELD_NUMBERS], exact[FIELD_NUMBERS] = {0};
        memcpy(exact, golden->b, sizeof golden->b);
        memcpy(exact + FIELD_G, golden->gradient, sizeof golden->gradient);
        field_ld(&c, place, found);
        field_double(&c, golden->place, rounded);
        memset(found + FIELD_T, 0, (FIELD_NUMBERS - FIELD_T) * sizeof *found);
        memset(rounded + FIELD_T, 0, (FIELD_NUMBERS - FIELD_T) * sizeof *rounded);
        check_errors(errors_of(found, exact, place), 3e-17, 3e-17, 0);
        check_errors(errors_of(rounded, exact, place), 5e-15, 5e-15, 0);
    }
}

/* T as well, for a thick and a flat cylinder: above it, over the rim, beside it, below it, on the axis, and on
 * both sides of where series and multipoles begin. */
static void test_charges(void **unused)
{
    (void)unused;
    static const double halves[] = {0.8, 0.2};
    for (size_t h = 0; h < COUNT(halves); ++h)
        for (size_t k = 0; k < COUNT(REMANENCES); ++k) {
            const double half = halves[h];
            const long double places[][3] = {
                {0, 0, half + 1.4L},
                {0.3L, 0.1L, half + 1},
                {1, 0, half + 0.6L},
                {0.6L, 0.8L, half + 1},
                {1e-9L, 0, half + 0.7L},
                {0.5L, 0.2L, half + 0.6L},
                {2, 1, 0.3L * half},
                {1.8L, 0, half},
                {1.5L, 0, -half - 1},
                {1.2L, 0, half + 3.9L},
                {-0.2L, 1.05L, half + 1},
                {0.3L, -0.2L, -half - 0.9L},
                {4, 2, 0.1L},
                {4, 2, 3},
                {0.2L, 0.1L, 4.9L},
                {0.2L, 0.1L, 5.5L},
                {3, 1, 10},
                {40, 13, 30},
            };
            cylinder c = {1, half, {0}};
            memcpy(c.j, REMANENCES[k], sizeof c.j);
            for (size_t n = 0; n < COUNT(places); ++n) {
                long double found[FIELD_NUMBERS], exact[FIELD_NUMBERS];
                field_ld(&c, places[n], found);
                charged_cylinder(1, half, c.j, places[n], exact);
                check_errors(errors_of(found, exact, places[n]), 1e-15, 1e-15, 1e-15);
            }
        }
}

/* ------------------------------------------------------------------ Maxwell's equations, by differences */

/* dB_i/dx_j of B alone, by differences of eighth order. */
static void differences_of_b(const cylinder *c, const long double place[3], long double g[3][3])
{
    const long double d = 4e-3L;
    memset(g, 0, 9 * sizeof g[0][0]);
    for (int j = 0; j < 3; ++j)
        for (int k = 1; k <= 4; ++k)
            for (int sign = -1; sign <= 1; sign += 2) {
                long double at[3] = {place[0], place[1], place[2]}, field[FIELD_NUMBERS];
                at[j] += sign * k * d;
                field_ld(c, at, field);
                for (int i = 0; i < 3; ++i)
                    g[i][j] += sign * DIFFERENCE_WEIGHTS[k - 1] * field[i] / d;
            }
}

static void test_divergence_and_curl(void **unused)
{
    (void)unused;
    uint64_t seed = 3;
    for (int trial = 0; trial < 200; ++trial) {
        const cylinder c = {1, uniform(&seed, 0.1, 2), {uniform(&seed, -1, 1), uniform(&seed, -1, 1), 0.5}};
        const long double place[3] = {uniform(&seed, -2, 2), uniform(&seed, -2, 2), c.half + 0.6};
        long double g[3][3];
        differences_of_b(&c, place, g);
        CHECK_CLOSE_LD(g[0][0] + g[1][1] + g[2][2], 0, 1e-13);
        CHECK_CLOSE_LD(g[2][1] - g[1][2], 0, 1e-13);
        CHECK_CLOSE_LD(g[0][2] - g[2][0], 0, 1e-13);
        CHECK_CLOSE_LD(g[1][0] - g[0][1], 0, 1e-13);
    }
}

/* What G and T say of the change along x (axis 0) or y (1): of B, and of xx yy xy xz yz. */
static void changes(const long double *f, int axis, long double *db, long double *dg)
{
    const long double *g = f + FIELD_G, *t = f + FIELD_T;
    const long double b_along[2][3] = {{g[0], g[2], g[3]}, {g[2], g[1], g[4]}};
    const long double g_along[2][5] = {{t[0], t[2], t[1], t[4], t[5]}, {t[1], t[3], t[2], t[5], t[6]}};
    memcpy(db, b_along[axis], sizeof b_along[axis]);
    memcpy(dg, g_along[axis], sizeof g_along[axis]);
}

/* Differences of second order come to G and T as the square of their step: the slope of the logarithms. */
static void test_difference_slopes(void **unused)
{
    (void)unused;
    const cylinder c = {1, 0.7, {0.3, -0.5, 0.8}};
    static const long double places[][3] = {{0.4L, 0.2L, 1.3L}, {0.9L, -0.5L, 1.2L}, {2, 1, 0.4L}, {3, -4, 6}};
    for (size_t n = 0; n < COUNT(places); ++n)
        for (int axis = 0; axis < 2; ++axis) {
            long double here[FIELD_NUMBERS], db[3], dg[5], off_b[2] = {0, 0}, off_g[2] = {0, 0};
            field_ld(&c, places[n], here);
            changes(here, axis, db, dg);
            for (int level = 0; level < 2; ++level) {
                const long double step = level ? 2e-3L : 1e-2L;
                long double after[FIELD_NUMBERS], before[FIELD_NUMBERS];
                long double at[3] = {places[n][0], places[n][1], places[n][2]};
                at[axis] += step;
                field_ld(&c, at, after);
                at[axis] -= 2 * step;
                field_ld(&c, at, before);
                for (int i = 0; i < 3; ++i)
                    off_b[level] += fabsl((after[i] - before[i]) / (2 * step) - db[i]);
                for (int i = 0; i < 5; ++i)
                    off_g[level] += fabsl((after[FIELD_G + i] - before[FIELD_G + i]) / (2 * step) - dg[i]);
            }
            CHECK_CLOSE_LD(logl(off_b[0] / off_b[1]) / logl(5), 2, 5e-3);
            CHECK_CLOSE_LD(logl(off_g[0] / off_g[1]) / logl(5), 2, 5e-3);
        }
}

/* ------------------------------------------------------------------ closed forms, limits, symmetries */

/* On the axis B_z = (J_z/2) [z+/sqrt(z+^2 + R^2) - z-/sqrt(z-^2 + R^2)], z+- = z +- h, and half of it, with the
 * sign turned, is B_x of J_x.  With the fractions as 1 - R^2/(s (s + z)) nothing cancels far away. */
static void test_axis(void **unused)
{
    (void)unused;
    for (long double z = 1.01L; z < 2000; z *= 1.3L) {
        const cylinder c = {0.5, 1, {0.4, 0, 1}};
        const long double place[3] = {0, 0, z}, s[2] = {hypotl(z + 1, 0.5L), hypotl(z - 1, 0.5L)};
        const long double share = 0.125L * (1 / (s[1] * (s[1] + z - 1)) - 1 / (s[0] * (s[0] + z + 1)));
        long double found[FIELD_NUMBERS], rounded[FIELD_NUMBERS];
        field_ld(&c, place, found);
        CHECK_CLOSE_LD(found[2] / share, 1, 1e-15);
        CHECK_CLOSE_LD(found[0] / (-0.5L * (long double)0.4 * share), 1, 1e-15);
        field_double(&c, (const double[3]){0, 0, (double)z}, rounded);
        const long double there[3] = {0, 0, (double)z};
        field_ld(&c, there, found);
        CHECK_CLOSE_LD(rounded[2] / found[2], 1, 4e-15);
        CHECK_CLOSE_LD(rounded[0] / found[0], 1, 4e-15);
    }
}

/* Far away the cylinder is the dipole of its volume: what is left falls as the square of the distance. */
static void test_dipole(void **unused)
{
    (void)unused;
    const cylinder c = {1, 0.5, {0.3, -0.5, 0.8}};
    fst_part_long_double dipole = part_ld(&c);
    for (int i = 0; i < 3; ++i)
        dipole.j[i] = c.j[i] * (long double)(c.radius * c.radius * c.half / 2); /* volume/(4 pi) */
    errors off[2];
    for (int level = 0; level < 2; ++level) {
        const long double r = level ? 1000 : 100, place[3] = {0.36L * r, 0.48L * r, 0.8L * r};
        long double found[FIELD_NUMBERS];
        fst_local_field_long_double f;
        fst_dipole_look_long_double(&dipole, place, &f);
        const long double exact[FIELD_NUMBERS] = FLAT(f);
        field_ld(&c, place, found);
        off[level] = errors_of(found, exact, place);
    }
    CHECK_CLOSE(log10(off[0].b / off[1].b), 2, 1e-3);
    CHECK_CLOSE(log10(off[0].g / off[1].g), 2, 1e-3);
    CHECK_CLOSE(log10(off[0].t / off[1].t), 2, 1e-3);
    CHECK_WITHIN(off[0].b, 1e-6, 1e-3);
}

/* Rims and multipoles agree where one gives way to the other, for all shapes, and at 100 and 1000 lengths, as
 * far as the rims, which lose digits there, can tell. */
static void test_switch_to_multipoles(void **unused)
{
    (void)unused;
    uint64_t seed = 8;
    static const double halves[] = {0.05, 0.3, 1, 4, 30}, distances[] = {4, 5, 100, 1000};
    for (size_t h = 0; h < COUNT(halves); ++h)
        for (size_t d = 0; d < COUNT(distances); ++d)
            for (int trial = 0; trial < 50; ++trial) {
                const long double r = distances[d] * hypotl(1, halves[h]), along = uniform(&seed, -1, 1);
                const cylinder c = {1, halves[h], {0}};
                const fst_part_long_double part = part_ld(&c);
                const long double place[3] = {r * sqrtl(1 - along * along), 0, r * along};
                const fst_cylinder_place_long_double at = fst_see_cylinder_long_double(&part, place);
                fst_axial_long_double near, far;
                fst_by_rims_long_double(&at, 1, &near);
                fst_by_multipoles_long_double(&at, 1, &far);
                const long double b = fabsl(far.zz) + at.rho * fabsl(far.zp_1);
                const long double g = fabsl(far.zzz) + at.rho * fabsl(far.zzp_1);
                const long double t = fabsl(far.zzzz) + at.rho * fabsl(far.zzzp_1);
                const double lost = 5e-18 * distances[d] * distances[d] * fmax(1, 1 / halves[h]);
                CHECK_CLOSE_LD((near.zz - far.zz) / b, 0, lost);
                CHECK_CLOSE_LD(at.rho * (near.zp_1 - far.zp_1) / b, 0, lost);
                CHECK_CLOSE_LD(at.rho2 * (near.pp_2 - far.pp_2) / b, 0, lost);
                CHECK_CLOSE_LD((near.zzz - far.zzz) / g, 0, lost);
                CHECK_CLOSE_LD(at.rho * (near.zzp_1 - far.zzp_1) / g, 0, lost);
                CHECK_CLOSE_LD((near.zpp - far.zpp) / g, 0, lost);
                CHECK_CLOSE_LD((near.zzzz - far.zzzz) / t, 0, lost);
                CHECK_CLOSE_LD(at.rho * (near.zzzp_1 - far.zzzp_1) / t, 0, lost);
                CHECK_CLOSE_LD((near.zzpp - far.zzpp) / t, 0, lost);
            }
}

/* Two cylinders on top of each other are one. */
static void test_stack(void **unused)
{
    (void)unused;
    uint64_t seed = 4;
    const cylinder whole = {1, 1, {0.3, -0.5, 0.8}}, low = {1, 0.75, {0.3, -0.5, 0.8}},
                   high = {1, 0.25, {0.3, -0.5, 0.8}};
    for (int trial = 0; trial < 500; ++trial) {
        const long double rho = powl(10, uniform(&seed, -8, 1.3)), angle = uniform(&seed, 0, TWO_PI);
        const long double z = rho > 1.2L ? uniform(&seed, -3, 3) : uniform(&seed, 1.2, 9);
        const long double place[3] = {rho * cosl(angle), rho * sinl(angle), z};
        const long double of_low[3] = {place[0], place[1], z + 0.25L},
                          of_high[3] = {place[0], place[1], z - 0.75L};
        long double one[FIELD_NUMBERS], two[FIELD_NUMBERS], other[FIELD_NUMBERS];
        field_ld(&whole, place, one);
        field_ld(&low, of_low, two);
        field_ld(&high, of_high, other);
        for (int i = 0; i < FIELD_NUMBERS; ++i)
            two[i] += other[i];
        check_errors(errors_of(two, one, place), 1e-16, 1e-16, 1e-16);
    }
}

/* B_i of unit J_k is second derivatives of one potential: a symmetric tensor without trace. */
static void test_tensor(void **unused)
{
    (void)unused;
    uint64_t seed = 6;
    for (int trial = 0; trial < 500; ++trial) {
        const double place[3] = {uniform(&seed, -4, 4), uniform(&seed, -4, 4), uniform(&seed, 1.1, 3)};
        long double b[3][FIELD_NUMBERS];
        for (int k = 0; k < 3; ++k) {
            const cylinder c = {1, 1, {k == 0, k == 1, k == 2}};
            field_double(&c, place, b[k]);
        }
        CHECK_CLOSE_LD(b[0][0] + b[1][1] + b[2][2], 0, 1e-16);
        CHECK_CLOSE_LD(b[0][1] - b[1][0], 0, 1e-16);
        CHECK_CLOSE_LD(b[0][2] - b[2][0], 0, 1e-16);
        CHECK_CLOSE_LD(b[1][2] - b[2][1], 0, 1e-16);
    }
}

/* The radius is a unit of length: B keeps, G and T fall as its first and second power. */
static void test_scale(void **unused)
{
    (void)unused;
    const cylinder small = {1, 0.6, {0.3, -0.5, 0.8}}, large = {8, 4.8, {0.3, -0.5, 0.8}};
    uint64_t seed = 9;
    for (int trial = 0; trial < 200; ++trial) {
        const double place[3] = {uniform(&seed, -4, 4), uniform(&seed, -4, 4), uniform(&seed, 0.7, 3)};
        const double far[3] = {8 * place[0], 8 * place[1], 8 * place[2]};
        long double one[FIELD_NUMBERS], eight[FIELD_NUMBERS];
        field_double(&small, place, one);
        field_double(&large, far, eight);
        for (int i = 0; i < FIELD_NUMBERS; ++i)
            CHECK_CLOSE_LD(eight[i] * (i < FIELD_G   ? 1
                                       : i < FIELD_T ? 8
                                                     : 64),
                           one[i], 4e-15 * (double)greatest(one, i < FIELD_G ? 0 : FIELD_G, FIELD_NUMBERS));
    }
}

/* The disc cut into strips of equal angle, each a block of as much area: what is left falls as the square of
 * their number. */
static void strips(const cylinder *c, int count, const long double place[3], long double *sum)
{
    memset(sum, 0, FIELD_NUMBERS * sizeof *sum);
    for (int n = 0; n < count; ++n) {
        const long double from = SURFACE_PI * n / count, to = SURFACE_PI * (n + 1) / count;
        const long double low = c->radius * cosl(to), high = c->radius * cosl(from);
        const long double area = c->radius * c->radius * ((to - from) - (sinl(2 * to) - sinl(2 * from)) / 2);
        fst_part_long_double block = part_ld(c);
        block.half[0] = (high - low) / 2;
        block.half[1] = area / (2 * (high - low));
        const long double d[3] = {place[0] - (low + high) / 2, place[1], place[2]};
        fst_local_field_long_double f;
        fst_cuboid_look_long_double(&block, d, &f);
        const long double flat[FIELD_NUMBERS] = FLAT(f);
        for (int i = 0; i < FIELD_NUMBERS; ++i)
            sum[i] += flat[i];
    }
}

static void test_blocks(void **unused)
{
    (void)unused;
    static const long double places[][3] = {{0.3L, 0.2L, 1.1L}, {1, 0.1L, 1.2L}, {1.6L, -1, 0.2L}, {0, 0, -1}};
    for (size_t n = 0; n < COUNT(places); ++n)
        for (size_t k = 0; k < COUNT(REMANENCES); ++k) {
            cylinder c = {1, 0.5, {0}};
            memcpy(c.j, REMANENCES[k], sizeof c.j);
            long double exact[FIELD_NUMBERS], coarse[FIELD_NUMBERS], fine[FIELD_NUMBERS];
            field_ld(&c, places[n], exact);
            strips(&c, 60, places[n], coarse);
            strips(&c, 240, places[n], fine);
            const errors at_60 = errors_of(coarse, exact, places[n]),
                         at_240 = errors_of(fine, exact, places[n]);
            check_errors(at_240, 1e-4, 1e-3, 1e-2);
            CHECK_CLOSE(log2(at_60.b / at_240.b) / 2, 2, 0.1);
            CHECK_CLOSE(log2(at_60.g / at_240.g) / 2, 2, 0.1);
            CHECK_CLOSE(log2(at_60.t / at_240.t) / 2, 2, 0.1);
        }
}

/* ------------------------------------------------------------------ turned and displaced */

typedef struct rotation {
    long double q[3][3];
} rotation;

/* By 73 degrees about (1, 2, -2), by Rodrigues' formula. */
static rotation turn_of_test(void)
{
    const long double angle = 73 * SURFACE_PI / 180, cosine = cosl(angle), sine = sinl(angle);
    const long double n[3] = {1 / 3.0L, 2 / 3.0L, -2 / 3.0L};
    rotation turn;
    for (int i = 0; i < 3; ++i)
        for (int k = 0; k < 3; ++k) {
            const long double across = (k + 1) % 3 == i ? sine : -sine;
            turn.q[i][k] = n[i] * n[k] * (1 - cosine) + (i == k ? cosine : n[3 - i - k] * across);
        }
    return turn;
}

static void turn_tensor(const rotation *turn, const long double *from, int order, long double *to)
{
    static const int sizes[] = {1, 3, 9, 27};
    for (int n = 0; n < sizes[order]; ++n) {
        to[n] = 0;
        for (int m = 0; m < sizes[order]; ++m) {
            long double weight = 1;
            for (int k = 0, i = n, a = m; k < order; ++k, i /= 3, a /= 3)
                weight *= turn->q[i % 3][a % 3];
            to[n] += weight * from[m];
        }
    }
}

/* All components of B, G and T written out, turned, and put together again. */
static void turn_field(const rotation *turn, const fst_local_field_long_double *f, long double *to)
{
    const fst_gradient_long_double s = f->gradient;
    const fst_bend_long_double e = f->bend;
    const long double g[9] = {s.xx, s.xy, s.xz, s.xy, s.yy, s.yz, s.xz, s.yz, -s.xx - s.yy};
    const long double xzz = -e.xxx - e.xyy, yzz = -e.xxy - e.yyy, zzz = -e.xxz - e.yyz;
    const long double t[27] = {e.xxx, e.xxy, e.xxz, e.xxy, e.xyy, e.xyz, e.xxz, e.xyz, xzz,
                               e.xxy, e.xyy, e.xyz, e.xyy, e.yyy, e.yyz, e.xyz, e.yyz, yzz,
                               e.xxz, e.xyz, xzz,   e.xyz, e.yyz, yzz,   xzz,   yzz,   zzz};
    long double b[3], gradient[9], bend[27];
    turn_tensor(turn, f->b, 1, b);
    turn_tensor(turn, g, 2, gradient);
    turn_tensor(turn, t, 3, bend);
    static const int of_g[5] = {0, 4, 1, 2, 5}, of_t[7] = {0, 1, 4, 13, 2, 5, 14};
    memcpy(to, b, sizeof b);
    for (int i = 0; i < 5; ++i)
        to[FIELD_G + i] = gradient[of_g[i]];
    for (int i = 0; i < 7; ++i)
        to[FIELD_T + i] = bend[of_t[i]];
}

/* A part in a magnet, turned about an axis that is none of its own: B, G and T turn with it. */
static void test_turned(void **unused)
{
    (void)unused;
    const fst_magnet_part given = {FST_PART_CYLINDER, {0.25, -0.5, 0.125}, {2, 1, 0}, {0.3, -0.5, 0.8}, {0},
                                   {73, 1, 2, -2},    FST_PART_TURNING};
    const fst_groups groups = {.length_unit = 1, .field_unit = 1};
    static fst_parts_long_double parts;
    parts.part[0] = fst_make_part_long_double(&given, &groups);
    const fst_kinds kinds = {.pieces = 1, .part = {FST_PART_CYLINDER}, .part_turned = {1}};
    const cylinder c = {1, 0.5, {0.3, -0.5, 0.8}};
    const fst_part_long_double part = part_ld(&c);
    const rotation turn = turn_of_test();
    uint64_t seed = 10;
    for (int trial = 0; trial < 100; ++trial) {
        const long double place[3] = {uniform(&seed, -3, 3), uniform(&seed, -3, 3), uniform(&seed, 1.6, 3)};
        const long double d[3] = {place[0] - 0.25L, place[1] + 0.5L, place[2] - 0.125L};
        long double own[3] = {0, 0, 0}, exact[FIELD_NUMBERS];
        for (int a = 0; a < 3; ++a)
            for (int i = 0; i < 3; ++i)
                own[a] += turn.q[i][a] * d[i];
        fst_local_field_long_double f, found;
        fst_cylinder_look_long_double(&part, own, &f);
        turn_field(&turn, &f, exact);
        fst_parts_look_long_double(&parts, &kinds, place[0], place[1], place[2], &found);
        const long double flat[FIELD_NUMBERS] = FLAT(found);
        /* 1e-15: the part's axes come of a sine and cosine in double */
        check_errors(errors_of(flat, exact, place), 1e-15, 1e-15, 1e-15);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_golden),
        cmocka_unit_test(test_charges),
        cmocka_unit_test(test_divergence_and_curl),
        cmocka_unit_test(test_difference_slopes),
        cmocka_unit_test(test_axis),
        cmocka_unit_test(test_dipole),
        cmocka_unit_test(test_switch_to_multipoles),
        cmocka_unit_test(test_stack),
        cmocka_unit_test(test_tensor),
        cmocka_unit_test(test_scale),
        cmocka_unit_test(test_blocks),
        cmocka_unit_test(test_turned),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
