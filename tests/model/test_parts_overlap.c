/* Which parts of a magnet stand in one place: overlaps, parts that only touch, holes and what fills them.
 * tests: model/part_geometry.c */
#include "numeric.h"

#include <stdio.h>
#include <stdlib.h>

#include <festoon/festoon.h>

#include "model/model.h"

/* A part of a kind, turned as the seed says, whose sizes are 4 to 12 mm. */
static fst_magnet_part any_part(int kind, unsigned *seed)
{
    fst_magnet_part part = {.kind = kind, .rotation = {0, 0, 0, 1}};
    double numbers[10];
    for (int i = 0; i < 10; ++i) {
        *seed = *seed * 1664525u + 1013904223u;
        numbers[i] = (double)(*seed >> 8) / (1 << 24);
    }
    for (int i = 0; i < 3; ++i) {
        part.centre[i] = 0.01 * numbers[i];
        part.size[i] = 0.004 + 0.008 * numbers[3 + i];
        part.rotation[1 + i] = numbers[6 + i] - 0.5;
    }
    part.rotation[0] = 360.0 * numbers[9];
    return part;
}

/* The second part beside the first, surface to surface but for `gap`: along the z of its own axes, which both share, and of a
 * sphere along the same. */
static void put_beside(const fst_magnet_part *one, fst_magnet_part *other, double gap)
{
    const double half[2] = {0.5 * one->size[one->kind == FST_PART_CUBOID     ? 2
                                            : one->kind == FST_PART_CYLINDER ? 1
                                                                             : 0],
                            0.5 * other->size[other->kind == FST_PART_CUBOID     ? 2
                                              : other->kind == FST_PART_CYLINDER ? 1
                                                                                 : 0]};
    double axes[3][3];
    memcpy(other->rotation, one->rotation, sizeof other->rotation);
    fst_set_axes_double(one->rotation, axes);
    for (int i = 0; i < 3; ++i)
        other->centre[i] = one->centre[i] + (half[0] + half[1] + gap) * axes[2][i];
}

static void parts_that_touch_do_not_overlap(void **state)
{
    (void)state;
    unsigned seed = 1;
    for (int trial = 0; trial < 90; ++trial) {
        const fst_magnet_part one = any_part(trial % 3, &seed);
        fst_magnet_part other = any_part(trial / 3 % 3, &seed);
        put_beside(&one, &other, 0.0);
        assert_false(fst_parts_overlap(&one, &other));
        assert_false(fst_parts_overlap(&other, &one));
        put_beside(&one, &other, -1e-4); /* 2 % of the thinnest at least */
        assert_true(fst_parts_overlap(&one, &other));
        assert_true(fst_parts_overlap(&other, &one));
    }
    fst_magnet_part dipole = any_part(FST_PART_DIPOLE, &seed), block = any_part(FST_PART_CUBOID, &seed);
    memcpy(dipole.centre, block.centre, sizeof dipole.centre);
    assert_false(fst_parts_overlap(&dipole, &block));
}

/* However two parts stand, they overlap where a place lies in both, and where they do there is one. */
static void parts_overlap_where_a_place_is_in_both(void **state)
{
    enum { GRID = 24 };
    (void)state;
    unsigned seed = 5;
    int counts[2] = {0, 0};
    for (int trial = 0; trial < 90; ++trial) {
        const fst_magnet_part one = any_part(trial % 3, &seed), other = any_part(trial / 3 % 3, &seed);
        fst_magnet_part core = other;
        for (int i = 0; i < 3; ++i)
            core.size[i] -= 2e-4;
        const double step = 0.024 / GRID; /* over a box about the first, however it is turned */
        double nearest = INFINITY;
        int deep = 0;
        for (int k = 0; k < GRID * GRID * GRID; ++k) {
            double place[3];
            for (int i = 0, at = k; i < 3; ++i, at /= GRID)
                place[i] = one.centre[i] - 0.012 + step * (at % GRID + 0.5);
            if (fst_part_distance(&one, place) > 0.0)
                continue;
            nearest = fmin(nearest, fst_part_distance(&other, place));
            deep |= fst_part_distance(&core, place) == 0.0;
        }
        const int found = fst_parts_overlap(&one, &other);
        assert_true(!deep || found);
        assert_true(!found || nearest < 2.0 * step);
        ++counts[found];
    }
    assert_true(counts[0] > 10 && counts[1] > 10);
}

/* What a magnet of blocks and rods about one place is told. */
static void holes_and_what_fills_them(void **state)
{
    (void)state;
    static const struct {
        struct {
            fst_part_kind kind;
            double size[4], remanence; /* size[3]: its place along x */
        } parts[3];
        int count;
        const char *told;
    } cases[] = {
        {{{FST_PART_CUBOID, {0.02, 0.02, 0.01}, 1.0}, {FST_PART_CYLINDER, {0.008, 0.01}, -1.0}}, 2, NULL},
        {{{FST_PART_CUBOID, {0.02, 0.02, 0.01}, 1.0}, {FST_PART_CYLINDER, {0.008, 0.012}, -1.0}},
         2,
         "[0] and magnet.parts[1] make a hole that reaches beyond"},
        {{{FST_PART_CUBOID, {0.02, 0.02, 0.01}, 1.0}, {FST_PART_SPHERE, {0.01}, -1.0}}, 2, NULL},
        {{{FST_PART_CUBOID, {0.02, 0.02, 0.01}, 1.0}, {FST_PART_SPHERE, {0.011}, -1.0}},
         2,
         "[0] and magnet.parts[1] make a hole"},
        {{{FST_PART_CUBOID, {0.02, 0.02, 0.01}, 1.0}, {FST_PART_CYLINDER, {0.008, 0.01}, -0.5}},
         2,
         "[0] and magnet.parts[1] overlap"},
        {{{FST_PART_CUBOID, {0.02, 0.02, 0.01}, 1.0},
          {FST_PART_CYLINDER, {0.008, 0.01}, -1.0},
          {FST_PART_SPHERE, {0.006}, 0.7}},
         3,
         NULL},
        {{{FST_PART_SPHERE, {0.006}, 0.7},
          {FST_PART_CYLINDER, {0.008, 0.01}, -1.0},
          {FST_PART_CUBOID, {0.02, 0.02, 0.01}, 1.0}},
         3,
         NULL},
        {{{FST_PART_CUBOID, {0.02, 0.02, 0.01}, 1.0},
          {FST_PART_CYLINDER, {0.008, 0.01}, -1.0},
          {FST_PART_SPHERE, {0.009}, 0.7}},
         3,
         "[0] and magnet.parts[2] overlap"},
        {{{FST_PART_CUBOID, {0.02, 0.02, 0.01, -0.01}, 1.0},
          {FST_PART_CUBOID, {0.02, 0.02, 0.01, 0.01}, 1.0},
          {FST_PART_CYLINDER, {0.008, 0.01}, -1.0}},
         3,
         NULL},
        {{{FST_PART_CUBOID, {0.02, 0.02, 0.01, -0.01}, 1.0},
          {FST_PART_CUBOID, {0.02, 0.02, 0.01, 0.01}, 1.0},
          {FST_PART_SPHERE, {0.011}, -1.0}},
         3,
         "make a hole that reaches beyond"},
        {{{FST_PART_CUBOID, {0.02, 0.02, 0.01, -0.01}, 1.0},
          {FST_PART_CUBOID, {0.02, 0.02, 0.01, 0.01}, 0.9},
          {FST_PART_CYLINDER, {0.008, 0.01}, -1.0}},
         3,
         "[0] and magnet.parts[2] make a hole that reaches beyond"},
    };
    for (size_t k = 0; k < sizeof cases / sizeof *cases; ++k) {
        fst_params params = fst_default_params();
        char sentence[256];
        params.magnet_shape = FST_MAGNET_PARTS;
        params.magnet_part_count = cases[k].count;
        for (int i = 0; i < cases[k].count; ++i) {
            fst_magnet_part *part = &params.magnet_parts[i];
            memset(part, 0, sizeof *part);
            part->kind = (int)cases[k].parts[i].kind;
            part->rotation[3] = 1.0;
            memcpy(part->size, cases[k].parts[i].size, sizeof part->size);
            part->remanence[2] = cases[k].parts[i].remanence;
            part->centre[0] = cases[k].parts[i].size[3];
        }
        const int found = fst_parts_contradiction(&params, sentence, sizeof sentence);
        assert_int_equal(found != 0, cases[k].told != NULL);
        if (cases[k].told)
            CHECK_CONTAINS(sentence, cases[k].told);
    }
}

/* A bar that turns in the plane of a pin beside it meets it where its end comes by, and not where that is higher, farther
 * out or does not come. */
static void what_turns_meets_what_stands_still(void **unused)
{
    (void)unused;
    static const struct {
        double pin[3], amplitude; /* 0: it turns on */
        int told;
        const char *table; /* NULL: none */
    } cases[] = {{{0, 22e-3, 0}, 0, 1, NULL},         {{0, 22e-3, 8e-3}, 0, 0, NULL},
                 {{0, 24e-3, 0}, 0, 0, NULL},         {{0, 22e-3, 0}, 60, 0, NULL},
                 {{0, 22e-3, 0}, 90, 1, NULL},        {{0, -15e-3, 4e-3}, 0, 1, NULL},
                 {{0, 22e-3, 0}, 77, 0, NULL},        {{0, 22e-3, 0}, 80, 1, NULL},
                 {{0, 22e-3, 0}, 0, 1, "0:0 1:360"},  {{0, 22e-3, 0}, 0, 0, "0:0 1:60"},
                 {{0, 22e-3, 0}, 0, 1, "0:0 1:-80"},  {{0, 22e-3, 0}, 0, 1, "0:410 1:450"},
                 {{0, 22e-3, 0}, 0, 0, "0:110 1:250"}};
    for (size_t k = 0; k < sizeof cases / sizeof *cases; ++k) {
        fst_params params = fst_default_params();
        char sentence[256] = "";
        params.magnet_shape = FST_MAGNET_PARTS;
        params.magnet_part_count = 2;
        params.drive_waveform = cases[k].table           ? FST_WAVEFORM_TABLE
                                : cases[k].amplitude > 0 ? FST_WAVEFORM_OSCILLATING
                                                         : FST_WAVEFORM_STEADY;
        if (cases[k].table)
            (void)snprintf(params.drive_table, sizeof params.drive_table, "%s", cases[k].table);
        params.drive_amplitude = cases[k].amplitude;
        fst_magnet_part *bar = &params.magnet_parts[0], *pin = &params.magnet_parts[1];
        *bar = (fst_magnet_part){.kind = FST_PART_CUBOID, .size = {5e-3, 40e-3, 5e-3}, .remanence = {1, 0, 0}};
        bar->rotation[0] = 90; /* its edge of 40 mm along x, by a turn of its own */
        bar->rotation[3] = 2;
        *pin = (fst_magnet_part){
            .kind = FST_PART_CYLINDER, .size = {5e-3, 5e-3}, .remanence = {0, 0, 1}, .motion = FST_PART_FIXED};
        pin->rotation[3] = 1;
        memcpy(pin->centre, cases[k].pin, sizeof pin->centre);
        assert_int_equal(fst_parts_contradiction(&params, sentence, sizeof sentence), cases[k].told);
        if (cases[k].told)
            CHECK_CONTAINS(sentence, "meet where the magnet has turned by");
        pin->motion = FST_PART_TURNING;
        assert_int_equal(fst_parts_contradiction(&params, sentence, sizeof sentence), 0);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(holes_and_what_fills_them),
        cmocka_unit_test(what_turns_meets_what_stands_still),
        cmocka_unit_test(parts_that_touch_do_not_overlap),
        cmocka_unit_test(parts_overlap_where_a_place_is_in_both),
    };
    return cmocka_run_group_tests_name("parts_overlap", tests, NULL, NULL);
}
