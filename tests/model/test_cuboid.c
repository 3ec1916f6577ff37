/* The field of a block: against quadrature, against its own differences, against itself in other pieces and
 * places, and double against long double wherever a formula could lose its digits.
 * tests: model/source/cuboid.inl model/source/part_local.inl model/source/parts.inl model/two_parts.c
 * labels: long-double */
#include "blocks_ld.h"
#include "golden_parts.h"

static const block BLOCKS[] = {{{28, 20, 4.5}, {1.2, 0.3, -0.7}},
                               {{1, 1, 1}, {0.4, -1.0, 0.8}},
                               {{0.25, 0.375, 6}, {1.0, 0.5, 0.25}},
                               {{4, 3, 0.125}, {-0.3, 0.2, 1.1}}};
enum { BLOCK_COUNT = sizeof BLOCKS / sizeof *BLOCKS };

static double half_diagonal(const block *of)
{
    return sqrt(of->half[0] * of->half[0] + of->half[1] * of->half[1] + of->half[2] * of->half[2]);
}

/* A place outside at `far` half diagonals or, for less than 1, that far from a face. */
static void place_at(uint64_t *seed, const block *of, double far, double d[3])
{
    double length = 0;
    for (int i = 0; i < 3; ++i) {
        d[i] = uniform(seed, -1, 1) * (far < 1 ? of->half[i] : 1);
        length += d[i] * d[i];
    }
    if (far < 1) {
        const int axis = (int)uniform(seed, 0, 2.999);
        d[axis] = (uniform(seed, -1, 1) < 0 ? -1 : 1) * (of->half[axis] + far * half_diagonal(of));
        return;
    }
    for (int i = 0; i < 3; ++i)
        d[i] *= far * half_diagonal(of) / sqrt(length);
}

/* ------------------------------------------------------------------ against others */

static void test_quadrature(void **unused)
{
    (void)unused;
    int blocks = 0;
    for (size_t n = 0; n < sizeof GOLDEN_PARTS / sizeof *GOLDEN_PARTS; ++n) {
        const golden_part *p = &GOLDEN_PARTS[n];
        if (p->kind != FST_PART_CUBOID)
            continue;
        block of;
        for (int i = 0; i < 3; ++i) {
            of.half[i] = p->size[i] / 2;
            of.j[i] = p->j[i];
        }
        const fst_local_field_double at = block_field(&of, p->place);
        double v[NUMBERS], error[3];
        long double golden[NUMBERS] = {0};
        numbers_of(&at, v);
        memcpy(golden, p->b, sizeof p->b);
        memcpy(golden + 3, p->g, sizeof p->g);
        differ(v, golden, error);
        CHECK_WITHIN(error[0], 0, 2e-15);
        CHECK_WITHIN(error[1], 0, 6e-15);
        ++blocks;
    }
    assert_int_equal(blocks, 27);
}

/* Far away a block is a dipole of its volume times J/(4 pi), up to (size/distance)^2: of cubes to the fourth
 * power, because a cube has no quadrupole of its magnetisation. */
static void test_far_dipole(void **unused)
{
    (void)unused;
    for (int n = 0; n < BLOCK_COUNT; ++n) {
        const block *of = &BLOCKS[n];
        fst_part_long_double part = part_ld_of(of);
        for (int i = 0; i < 3; ++i)
            part.j[i] *= 8 * part.half[0] * part.half[1] * part.half[2] / (4 * 3.14159265358979323846L);
        double off[2][3];
        for (int twice = 0; twice < 2; ++twice) {
            long double d[3] = {0.6L, -0.48L, 0.64L}, a[NUMBERS];
            for (int i = 0; i < 3; ++i)
                d[i] *= (twice ? 200 : 100) * (long double)half_diagonal(of);
            field_ld dipole;
            const field_ld at = block_field_ld(of, d);
            fst_dipole_look_long_double(&part, d, &dipole);
            double v[NUMBERS];
            numbers_of_ld(&dipole, a);
            long double w[NUMBERS];
            numbers_of_ld(&at, w);
            for (int i = 0; i < NUMBERS; ++i)
                v[i] = (double)((w[i] - a[i]) / fabsl(a[FIRST_OF[i < 3 ? 0 : i < 8 ? 1 : 2]]));
            for (int what = 0; what < 3; ++what) {
                off[twice][what] = 0;
                for (int i = FIRST_OF[what]; i < FIRST_OF[what + 1]; ++i)
                    off[twice][what] = fmax(off[twice][what], fabs(v[i]));
                CHECK_WITHIN(off[twice][what], 0, 1e-2);
            }
        }
        for (int what = 0; what < 3; ++what)
            CHECK_CLOSE(log2(off[0][what] / off[1][what]), n == 1 ? 4 : 2, 0.01);
    }
}

/* ------------------------------------------------------------------ against itself */

/* The numbers of G are differences of B along x, y and z, and so of T and G along x and y; B's own differences
 * have neither curl nor divergence, because G holds five numbers and all nine differences agree with them.  The
 * error of the differences falls with the eighth power of the step. */
static void test_differences(void **unused)
{
    (void)unused;
    static const long double weights[4] = {4.0L / 5, -1.0L / 5, 4.0L / 105, -1.0L / 280};
    static const int of_b[3][3] = {{3, 4, 6}, {4, 5, 7}, {6, 7, -1}};              /* dB_i/dx_j */
    static const int of_g[5][2] = {{8, 9}, {9, 10}, {10, 11}, {12, 13}, {13, 14}}; /* xx xy yy xz yz by x, y */
    uint64_t seed = 31;
    for (int n = 0; n < BLOCK_COUNT; ++n)
        for (int trial = 0; trial < 12; ++trial) {
            const block *of = &BLOCKS[n];
            double place[3], off[2][2] = {{0}};
            place_at(&seed, of, trial < 4 ? 0.6 : trial < 8 ? 1.7 : 12.0, place);
            const long double unit = (trial < 8 ? 0.02L : 0.2L) * (long double)half_diagonal(of);
            for (int half = 0; half < 2; ++half) {
                const long double step = unit / (half ? 2 : 1);
                const long double at[3] = {place[0], place[1], place[2]};
                long double here[NUMBERS], change[3][NUMBERS] = {{0}};
                const field_ld f = block_field_ld(of, at);
                numbers_of_ld(&f, here);
                for (int axis = 0; axis < 3; ++axis)
                    for (int k = -4; k <= 4; ++k) {
                        long double moved[3] = {at[0], at[1], at[2]}, v[NUMBERS];
                        moved[axis] += k * step;
                        const field_ld there = block_field_ld(of, moved);
                        numbers_of_ld(&there, v);
                        for (int i = 0; k != 0 && i < NUMBERS; ++i)
                            change[axis][i] += (k < 0 ? -1 : 1) * weights[abs(k) - 1] * v[i] / step;
                    }
                long double greatest[2] = {0, 0};
                for (int i = 3; i < NUMBERS; ++i)
                    greatest[i >= 8] = fmaxl(greatest[i >= 8], fabsl(here[i]));
                for (int i = 0; i < 3; ++i)
                    for (int j = 0; j < 3; ++j) {
                        const long double g = i == 2 && j == 2 ? -(here[3] + here[5]) : here[of_b[i][j]];
                        off[half][0] = fmax(off[half][0], (double)(fabsl(change[j][i] - g) / greatest[0]));
                    }
                for (int i = 0; i < 5; ++i)
                    for (int j = 0; j < 2; ++j)
                        off[half][1] = fmax(off[half][1],
                                            (double)(fabsl(change[j][3 + i] - here[of_g[i][j]]) / greatest[1]));
            }
            for (int what = 0; what < 2; ++what) {
                CHECK_WITHIN(off[1][what], 0, 1e-10);
                if (off[0][what] > 1e-12) /* well above rounding */
                    CHECK_CLOSE(log2(off[0][what] / off[1][what]), 8.0, 0.5);
            }
        }
}

static void test_cut_in_two(void **unused)
{
    (void)unused;
    uint64_t seed = 32;
    for (int n = 0; n < BLOCK_COUNT; ++n)
        for (int trial = 0; trial < 60; ++trial) {
            const block *of = &BLOCKS[n];
            const int axis = trial % 3;
            double d[3];
            /* From 5 to 10 half diagonals the pieces are seen from afar and the whole from near. */
            place_at(&seed, of, trial < 20 ? 0.3 : trial < 40 ? 1.5 + 0.1 * trial : 0.25 * trial - 1, d);
            const double share = 0.25;
            long double sum[NUMBERS] = {0}, whole[NUMBERS];
            for (int piece = 0; piece < 2; ++piece) {
                block part = *of;
                part.half[axis] *= piece ? 1 - share : share;
                long double own[3] = {d[0], d[1], d[2]}, w[NUMBERS];
                own[axis] += (piece ? -1 : 1) * ((long double)of->half[axis] - part.half[axis]);
                const field_ld f = block_field_ld(&part, own);
                numbers_of_ld(&f, w);
                for (int i = 0; i < NUMBERS; ++i)
                    sum[i] += w[i];
            }
            const long double at[3] = {d[0], d[1], d[2]};
            const field_ld f = block_field_ld(of, at);
            numbers_of_ld(&f, whole);
            for (int what = 0; what < 3; ++what) {
                long double greatest = 0, off = 0;
                for (int i = FIRST_OF[what]; i < FIRST_OF[what + 1]; ++i) {
                    greatest = fmaxl(greatest, fabsl(whole[i]));
                    off = fmaxl(off, fabsl(sum[i] - whole[i]));
                }
                CHECK_WITHIN((double)(off / greatest), 0, 1e-14);
            }
        }
}

/* A quarter turn about z takes (x, y) to (y, -x); a mirror image has the mirrored field. */
static void test_symmetry(void **unused)
{
    (void)unused;
    uint64_t seed = 33;
    for (int trial = 0; trial < 200; ++trial) {
        const block *of = &BLOCKS[trial % BLOCK_COUNT];
        double d[3];
        place_at(&seed, of, trial < 100 ? 0.4 : 1.2 + 0.1 * trial, d);
        const block turned = {{of->half[1], of->half[0], of->half[2]}, {of->j[1], -of->j[0], of->j[2]}};
        const double there[3] = {d[1], -d[0], d[2]};
        const fst_local_field_double a = block_field(of, d), b = block_field(&turned, there);
        const double b_norm = fabs(a.b[0]) + fabs(a.b[1]) + fabs(a.b[2]);
        const double g_norm = fabs(a.gradient.xx) + fabs(a.gradient.yy) + fabs(a.gradient.xy) +
                              fabs(a.gradient.xz) + fabs(a.gradient.yz);
        const double off[3] = {a.b[1] - b.b[0], a.b[0] + b.b[1], a.b[2] - b.b[2]};
        for (int i = 0; i < 3; ++i)
            CHECK_CLOSE(off[i], 0, 1e-12 * b_norm);
        CHECK_CLOSE(a.gradient.xx, b.gradient.yy, 1e-11 * g_norm);
        CHECK_CLOSE(a.gradient.xy, -b.gradient.xy, 1e-11 * g_norm);
        CHECK_CLOSE(a.gradient.xz, -b.gradient.yz, 1e-11 * g_norm);
        const block mirrored = {{of->half[0], of->half[1], of->half[2]}, {-of->j[0], of->j[1], of->j[2]}};
        const double image[3] = {-d[0], d[1], d[2]};
        const fst_local_field_double m = block_field(&mirrored, image);
        CHECK_CLOSE(m.b[0], -a.b[0], 1e-12 * b_norm);
        CHECK_CLOSE(m.b[1], a.b[1], 1e-12 * b_norm);
        CHECK_CLOSE(m.b[2], a.b[2], 1e-12 * b_norm);
    }
}

/* ------------------------------------------------------------------ digits */

static void errors_at(const block *of, const double d[3], double error[3])
{
    const long double at[3] = {d[0], d[1], d[2]};
    long double exact[NUMBERS];
    double v[NUMBERS];
    const field_ld f = block_field_ld(of, at);
    const fst_local_field_double g = block_field(of, d);
    numbers_of_ld(&f, exact);
    numbers_of(&g, v);
    differ(v, exact, error);
}

static void keep_greatest(double worst[3], const double error[3])
{
    for (int what = 0; what < 3; ++what)
        worst[what] = fmax(worst[what], error[what]);
}

/* Two parts of one kind are seen at once, each with the bits that it would have alone: near and far, beside an edge's
 * extension, turned, and an odd one. */
static void test_two_at_once(void **unused)
{
    (void)unused;
    static const unsigned char kinds_of[][3] = {{FST_PART_CUBOID, FST_PART_CUBOID, FST_PART_DIPOLE},
                                                {FST_PART_CYLINDER, FST_PART_CYLINDER, FST_PART_CYLINDER},
                                                {FST_PART_CUBOID, FST_PART_DIPOLE, FST_PART_DIPOLE}};
    uint64_t seed = 36;
    for (int trial = 0; trial < 3000; ++trial) {
        fst_kinds kinds = {.source = FST_MAGNET_PARTS, .pieces = 3};
        fst_parts_double all;
        memset(&all, 0, sizeof all);
        memcpy(kinds.part, kinds_of[trial % 3], 3);
        for (int i = 0; i < 3; ++i) {
            fst_part_double *part = &all.part[i];
            kinds.part_turned[i] = (trial + i) % 4 == 0;
            for (int k = 0; k < 3; ++k) {
                part->centre[k] = uniform(&seed, -1, 1);
                part->half[k] = BLOCKS[(trial + i) % BLOCK_COUNT].half[k] / 16;
                part->j[k] = uniform(&seed, -1, 1);
            }
            part->half[1] = kinds.part[i] == FST_PART_CYLINDER ? part->half[0] : part->half[1];
            fst_set_axes_double((const double[4]){30.0 * i, 0.3, -0.2, 0.9}, part->axes);
        }
        const double far = trial % 5 == 0 ? 40 : 2;
        const double x =
            trial % 7 == 0 ? all.part[0].centre[0] + all.part[0].half[0] : uniform(&seed, -far, far);
        const double y = uniform(&seed, -far, far), z = 3.1;
        double v[NUMBERS], sum[NUMBERS] = {0}, b[3];
        fst_local_field_double at;
        fst_gradient_double g;
        for (int i = 0; i < 3; ++i) {
            fst_kinds one = {.source = FST_MAGNET_PARTS, .pieces = 1};
            const fst_parts_double alone = {.part = {all.part[i]}};
            one.part[0] = kinds.part[i];
            one.part_turned[0] = kinds.part_turned[i];
            fst_parts_look_double(&alone, &one, x, y, z, &at);
            numbers_of(&at, v);
            for (int k = 0; k < NUMBERS; ++k)
                sum[k] += v[k];
        }
        fst_parts_look_double(&all, &kinds, x, y, z, &at);
        fst_parts_field_double(&all, &kinds, x, y, z, b, &g);
        numbers_of(&at, v);
        assert_memory_equal(v, sum, sizeof v);
        assert_memory_equal(b, at.b, sizeof b);
        assert_memory_equal(&g, &at.gradient, 5 * sizeof g.xx);
    }
}

/* Errors of B over |B|, of G and T alike, against long double: of four blocks, among them a rod 24 times as
 * long as it is thick and a plate of 32 times its thickness.  Before 10 half diagonals the cancellation of the
 * opposite faces of these two is seen, most in the gradient; beyond them there is none. */
static void test_digits(void **unused)
{
    (void)unused;
    static const struct {
        double far, most[3];
    } zones[] = {{0.1, {6e-14, 1e-14, 2e-14}}, {0.5, {5e-14, 3e-14, 3e-14}},  {2, {4e-14, 2e-13, 2e-13}},
                 {5, {1.2e-13, 4e-12, 3e-12}}, {9.9, {3e-13, 3e-11, 2e-11}},  {10.1, {4e-15, 1e-14, 5e-14}},
                 {200, {3e-15, 6e-15, 8e-15}}, {2000, {3e-15, 6e-15, 8e-15}}, {1e8, {3e-15, 6e-15, 8e-15}}};
    uint64_t seed = 34;
    for (size_t zone = 0; zone < sizeof zones / sizeof *zones; ++zone) {
        double worst[3] = {0, 0, 0};
        for (int trial = 0; trial < 400; ++trial) {
            const block *of = &BLOCKS[trial % BLOCK_COUNT];
            double d[3], error[3];
            place_at(&seed, of, zones[zone].far, d);
            errors_at(of, d, error);
            keep_greatest(worst, error);
        }
        for (int what = 0; what < 3; ++what)
            if (!(worst[what] <= zones[zone].most[what]))
                fail_msg("at %g half diagonals the error of %c is %.2g", zones[zone].far, "BGT"[what],
                         worst[what]);
    }
}

/* Where a thin plate is seen from the side, the cancellation of its faces costs most: two digits of the field
 * of one that is 32 times as long as it is thick.
 *
 * On the extensions of edges and faces and beside them, where r + w of the textbook's formula vanishes. */
static void test_extensions(void **unused)
{
    (void)unused;
    static const double beside[] = {0, 1e-300, -1e-300, 1e-30, 1e-9, -1e-9, 1e-4};
    double worst[3] = {0, 0, 0};
    for (int n = 0; n < BLOCK_COUNT; ++n)
        for (int where = 0; where < 3 * 4 * 7 * 7 * 4; ++where) {
            const block *of = &BLOCKS[n];
            const int axis = where % 3, b = (axis + 1) % 3, c = (axis + 2) % 3, signs = where / 3 % 4;
            const double first = beside[where / 12 % 7], second = beside[where / 84 % 7];
            const double shift[4] = {0.3, -0.3, 2, -2};
            const double out = shift[where / 588];
            double d[3], error[3];
            d[axis] = out < 0 ? out - of->half[axis] : out + of->half[axis];
            d[b] = (signs & 1 ? -of->half[b] : of->half[b]) + first;
            d[c] = signs & 2 ? -of->half[c] + second : second; /* an edge's extension, or a face's */
            errors_at(of, d, error);
            keep_greatest(worst, error);
        }
    CHECK_WITHIN(worst[0], 1e-17, 1.5e-13);
    CHECK_WITHIN(worst[1], 1e-17, 2e-14);
    CHECK_WITHIN(worst[2], 1e-17, 4e-14);
}

/* At the switch from corners to multipoles no digit jumps: both are computed at the same place in long double,
 * where their own errors are below 1e-16. */
static void test_switch(void **unused)
{
    (void)unused;
    uint64_t seed = 35;
    for (int trial = 0; trial < 100; ++trial) {
        const block *of = &BLOCKS[trial % BLOCK_COUNT];
        const fst_part_long_double part = part_ld_of(of);
        double place[3];
        place_at(&seed, of, 10.0, place);
        const long double d[3] = {place[0], place[1], place[2]};
        fst_form_long_double near, far;
        fst_near_form_long_double(&part, d, 1, &near);
        fst_far_form_long_double(&part, d, 1, &far);
        for (int i = 0; i < fst_form_all_long_double; ++i) {
            long double scale = 0;
            const int from = i < 5 ? 0 : i < 12 ? 5 : 12, to = i < 5 ? 5 : i < 12 ? 12 : 21;
            for (int k = from; k < to; ++k)
                scale = fmaxl(scale, fabsl(far.all[k]));
            CHECK_WITHIN((double)(fabsl(near.all[i] - far.all[i]) / scale), 0, 1e-14);
        }
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_quadrature),  cmocka_unit_test(test_far_dipole),
        cmocka_unit_test(test_differences), cmocka_unit_test(test_cut_in_two),
        cmocka_unit_test(test_symmetry),    cmocka_unit_test(test_digits),
        cmocka_unit_test(test_extensions),  cmocka_unit_test(test_switch),
        cmocka_unit_test(test_two_at_once),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
