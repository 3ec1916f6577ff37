/* The bead's diameter and place beside a shadow of known darkness, offset and softness, and without one.
 * tests: follow/shadow.c follow/learn.c follow/bead.c
 * labels: slow numbers */
#include "numeric.h"

#include <stdlib.h>
#include <string.h>

#include "base/chance.h"
#include "base/constants.h"
#include "follow/bead.h"
#include "follow/learn.h"

enum { WIDTH = 240, HEIGHT = 200, SIZE = WIDTH * HEIGHT };

/* What a film shows: a bead, lit or plain, and its shadow. */
typedef struct scene {
    double radius, contrast;  /* pixels; of the background's level, negative: a bright bead */
    double lit;               /* by how much lighter its lit side is, in parts of the contrast */
    double dark, away, fuzzy; /* of the shadow: parts of the contrast; bead's diameters; bead's radii */
    double blur;              /* pixels that it moves in an exposure */
    double dot; /* radius, in the bead's, of a black dot on it, which one half of the frames show */
} scene;

static const double side = 0.7; /* rad, where the shadow is */

static double noise(uint64_t *chance)
{
    const uint64_t word = fst_draw(chance);
    return ((double)(word & 0xffff) + (double)(word >> 16 & 0xffff) + (double)(word >> 32 & 0xffff) +
            (double)(word >> 48) - 131070.0) *
           (2.0 * sqrt(3.0) / 131070.0); /* of two gray levels */
}

/* How much of a disc is at a distance from its centre, whose outline goes over so many pixels. */
static double disc(double distance, double radius, double soft)
{
    const double off = (distance - radius) / soft;
    return off < -5.0 ? 1.0 : off > 5.0 ? 0.0 : 0.5 * erfc(off / sqrt(2.0));
}

/* By which part of the background's level it is darker at a place from the bead's centre: the bead covers its
 * shadow. */
static double darkness(const scene *s, double x, double y)
{
    const double way = 2.0 * s->away * s->radius;
    const double lit = s->lit * fmax(0.0, -(x * cos(side) + y * sin(side)) / s->radius);
    const double dx = x - way * cos(side), dy = y - way * sin(side);
    const double bead = disc(sqrt(x * x + y * y), s->radius, 0.8);
    const double shade = s->dark * disc(sqrt(dx * dx + dy * dy), s->radius, s->fuzzy * s->radius);
    return s->contrast * bead * (1.0 - lit) + fabs(s->contrast) * (1.0 - bead) * shade;
}

static void paint(const scene *s, int dot, const double place[2], double turn, uint64_t *chance,
                  const float *level, unsigned char *out)
{
    const int moments = 1 + (int)s->blur;
    const double reach = 4.0 * s->radius + s->blur + 4.0, along[2] = {cos(turn), sin(turn)};
    for (int row = 0; row < HEIGHT; ++row)
        for (int column = 0; column < WIDTH; ++column) {
            const int at = row * WIDTH + column;
            const double x = column - place[0], y = row - place[1];
            double dark = 0.0;
            for (int k = 0; k < moments && x * x + y * y < reach * reach; ++k) {
                const double way = s->blur * ((k + 0.5) / moments - 0.5);
                dark += darkness(s, x - way * along[0], y - way * along[1]) / moments;
            }
            if (dot)
                dark += (0.9 - dark) * disc(hypot(x - 0.2 * s->radius, y), s->dot * s->radius, 0.8);
            const double shown = (double)level[at] * (1.0 - dark) + noise(chance);
            out[at] = (unsigned char)(fmax(0.0, fmin(255.0, shown)) + 0.5);
        }
}

/* What learning and following made of 41 frames. */
typedef struct outcome {
    follow_look look;
    int seen;
    double offset, rms; /* of the places, pixels */
} outcome;

static void follow_samples(const follow_still *still, follow_blobs *blobs, double (*places)[2], outcome *out)
{
    double sum[2] = {0.0, 0.0}, squares = 0.0;
    follow_bead follower;
    fst_error error;
    assert_int_equal(follow_bead_begin(&follower, blobs, &out->look, &error), FST_OK);
    for (int k = 0; k < FOLLOW_SAMPLES; ++k) {
        follow_place place;
        follower.seen = 0; /* frames at random times: each for itself */
        assert_int_equal(follow_bead_next(&follower, still->samples + (size_t)k * SIZE, k, &place, &error),
                         FST_OK);
        if (isnan(place.column))
            continue;
        const double off[2] = {place.column - places[k][0], place.row - places[k][1]};
        ++out->seen;
        for (int i = 0; i < 2; ++i) {
            sum[i] += off[i];
            squares += off[i] * off[i];
        }
    }
    out->offset = hypot(sum[0], sum[1]) / out->seen;
    out->rms = sqrt(fmax(0.0, 0.5 * (squares / out->seen - out->offset * out->offset)));
    follow_bead_end(&follower);
}

static outcome look_at(const scene *s)
{
    follow_still still = {.width = WIDTH, .height = HEIGHT, .count = FOLLOW_SAMPLES, .noise = 2.0};
    static double places[FOLLOW_SAMPLES][2];
    uint64_t chance = 1;
    outcome out = {.seen = 0};
    follow_blobs blobs;
    fst_error error;
    still.level = malloc(SIZE * sizeof *still.level);
    still.samples = malloc((size_t)SIZE * FOLLOW_SAMPLES);
    still.gains = malloc((size_t)HEIGHT * FOLLOW_SAMPLES * sizeof *still.gains);
    assert_true(still.level && still.samples && still.gains);
    for (int i = 0; i < SIZE; ++i)
        still.level[i] = (s->contrast > 0.0 ? 150.0f : 60.0f) + 0.2f * (float)(i % WIDTH);
    for (int i = 0; i < HEIGHT * FOLLOW_SAMPLES; ++i)
        still.gains[i] = 1.0f;
    for (int k = 0; k < FOLLOW_SAMPLES; ++k) {
        const double turn = FST_TWO_PI * (double)(fst_draw(&chance) >> 11) * 0x1p-53;
        places[k][0] = 120.0 + 45.0 * cos(turn);
        places[k][1] = 100.0 + 45.0 * sin(turn);
        paint(s, s->dot > 0.0 && k % 9 < 5, places[k], turn + 0.5 * FST_PI, &chance, still.level,
              still.samples + (size_t)k * SIZE);
    }
    assert_int_equal(follow_blobs_begin(&blobs, &still, &error), FST_OK);
    assert_int_equal(follow_learn(&blobs, "film", 1, NULL, &out.look, &error), FST_OK);
    follow_samples(&still, &blobs, places, &out);
    follow_blobs_end(&blobs);
    follow_still_free(&still);
    return out;
}

/* The diameter is the bead's alone, within 2 %, and so is the place; a shadow that begins a fifth of the diameter away
 * and is almost as dark as a small bead cannot be told from it so well, and the error says so. */
static void beside_a_shadow(void **state)
{
    (void)state;
    static const double radii[] = {6.5, 18.5}, darks[] = {0.2, 0.45, 0.7}, aways[] = {0.2, 0.5, 1.0};
    for (int i = 0; i < 18; ++i) {
        const scene s = {.radius = radii[i % 2],
                         .contrast = 0.7,
                         .lit = i / 2 % 2 ? 0.25 : 0.0,
                         .dark = darks[i / 2 % 3],
                         .away = aways[i / 6 % 3],
                         .fuzzy = i % 3 == 0 ? 0.15 : 0.5};
        const outcome o = look_at(&s);
        const double off = fabs(o.look.diameter - 2.0 * s.radius);
        const int hard = s.radius < 10.0 && s.away < 0.3 && s.dark > 0.4;
        assert_int_equal(o.seen, FOLLOW_SAMPLES);
        assert_true(o.look.shade > 0.5 * s.dark * s.contrast);
        assert_true(off < (hard ? 2.0 * o.look.diameter_error : 0.02 * 2.0 * s.radius));
        assert_true(o.look.diameter_error < 0.08 * 2.0 * s.radius);
        assert_true(o.offset < 0.3);
        assert_true(o.rms < 0.04);
    }
}

/* Without a shadow there is none, also where the bead is lit, bright or blurred; the error covers the truth. */
static void without_a_shadow(void **state)
{
    (void)state;
    static const double blurs[] = {0.0, 4.0, 15.0}, contrasts[] = {0.7, 0.2, -0.8};
    for (int i = 0; i < 9; ++i) {
        const scene s = {.radius = i % 2 ? 6.5 : 12.5,
                         .contrast = contrasts[i / 3],
                         .lit = i % 4 < 2 ? 0.0 : 0.4,
                         .fuzzy = 1.0,
                         .blur = blurs[i % 3]};
        const outcome o = look_at(&s);
        assert_int_equal(o.seen, FOLLOW_SAMPLES);
        assert_true(o.look.shade == 0.0 && o.look.shift[0] == 0.0 && o.look.shift[1] == 0.0);
        assert_true(fabs(o.look.diameter - 2.0 * s.radius) < 2.0 * o.look.diameter_error);
        assert_true(o.look.diameter_error < (s.blur > 10.0 ? 1.5 : 0.6));
    }
}

/* A dot on a light bead has a steeper outline than the bead, and is not taken for it. */
static void with_a_dot(void **state)
{
    (void)state;
    const scene s = {.radius = 12.5, .contrast = 0.3, .fuzzy = 1.0, .dot = 0.4};
    const outcome o = look_at(&s);
    assert_true(fabs(o.look.diameter - 25.0) < 0.3);
    assert_true(o.look.diameter_error < 0.3);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(beside_a_shadow),
        cmocka_unit_test(without_a_shadow),
        cmocka_unit_test(with_a_dot),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
