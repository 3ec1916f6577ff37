/* The shift and the roll of a frame against a picture with a texture, however the light has changed and wherever the bead is; and a
 * plain picture, which tells nothing.
 * tests: follow/shake.c follow/still.c */
#include "numeric.h"

#include <stdlib.h>

#include "base/chance.h"
#include "follow/shake.h"
#include "follow/still.h"

enum { WIDTH = 320, HEIGHT = 240, WAVES = 60 };

static double even(uint64_t *chance)
{
    return (double)(fst_draw(chance) >> 11) * 0x1p-53;
}

/* A texture that is known between its pixels too. */
typedef struct texture {
    double waves[WAVES][4]; /* across, down, phase, size */
} texture;

static texture make_texture(uint64_t *chance, double size)
{
    texture t;
    for (int i = 0; i < WAVES; ++i) {
        const double turn = 6.28 * even(chance), wave = 0.02 * exp(3.2 * even(chance)); /* from large to fine */
        t.waves[i][0] = wave * cos(turn);
        t.waves[i][1] = wave * sin(turn);
        t.waves[i][2] = 6.28 * even(chance);
        t.waves[i][3] = size * even(chance);
    }
    return t;
}

/* The levels at a row of places, each `step` beyond the one before, so that each wave turns by the same angle. */
static void levels_along(const texture *t, double x, double y, const double step[2], double level[WIDTH])
{
    for (int k = 0; k < WIDTH; ++k)
        level[k] = 150.0;
    for (int i = 0; i < WAVES; ++i) {
        const double *wave = t->waves[i], begin = wave[0] * x + wave[1] * y + wave[2];
        const double turn = wave[0] * step[0] + wave[1] * step[1], c = cos(turn), s = sin(turn);
        double sine = wave[3] * sin(begin), cosine = wave[3] * cos(begin);
        for (int k = 0; k < WIDTH; ++k) {
            level[k] += sine;
            const double next = sine * c + cosine * s;
            cosine = cosine * c - sine * s;
            sine = next;
        }
    }
}

static float picture[WIDTH * HEIGHT], gains[HEIGHT];
static unsigned char frame[WIDTH * HEIGHT];

static void draw_picture(const texture *t)
{
    static const double step[2] = {1.0, 0.0};
    for (int row = 0; row < HEIGHT; ++row) {
        double level[WIDTH];
        levels_along(t, 0.0, row, step, level);
        for (int column = 0; column < WIDTH; ++column)
            picture[row * WIDTH + column] = (float)level[column];
    }
}

/* A frame that is shifted, turned clockwise about its middle, dimmed, noisy, and has a bead on it. */
static void film(const texture *t, const double shift[2], double roll, double dim, double noise,
                 uint64_t *chance)
{
    const double step[2] = {cos(roll), -sin(roll)}, middle[2] = {0.5 * (WIDTH - 1), 0.5 * (HEIGHT - 1)};
    for (int row = 0; row < HEIGHT; ++row) {
        const double x = -shift[0] - middle[0], y = row - shift[1] - middle[1];
        double level[WIDTH];
        levels_along(t, middle[0] + cos(roll) * x + sin(roll) * y, middle[1] - sin(roll) * x + cos(roll) * y,
                     step, level);
        for (int column = 0; column < WIDTH; ++column) {
            const int bead = hypot(column - 200.0, row - 90.0) < 15.0;
            const double shown = dim * (bead ? 40.0 : level[column]) + noise * (even(chance) - 0.5) + 0.5;
            frame[row * WIDTH + column] = (unsigned char)fmax(0.0, fmin(255.0, shown));
        }
    }
}

/* A texture of three gray levels tells shifts of up to 15 pixels to a twentieth of one, a faint one to a tenth; shifted back, the frame is the
 * picture again. */
static void shifts(void **state)
{
    (void)state;
    uint64_t chance = 7;
    for (int trial = 0; trial < 24; ++trial) {
        const texture t = make_texture(&chance, trial % 2 ? 1.0 : 4.0);
        const double size = trial < 12 ? 3.0 : 15.0,
                     shift[2] = {size * (2.0 * even(&chance) - 1.0), size * (2.0 * even(&chance) - 1.0)};
        const double dim = trial % 3 ? 1.0 : 0.7;
        double found[2] = {0.0, 0.0}, squares = 0.0;
        follow_shake shake;
        int count = 0;
        draw_picture(&t);
        for (int row = 0; row < HEIGHT; ++row)
            gains[row] = (float)dim;
        film(&t, shift, 0.0, dim, 6.0, &chance);
        assert_true(follow_shake_begin(&shake, picture, WIDTH, HEIGHT, 16));
        assert_true(follow_shake_find(&shake, frame, gains, found) > 0.6);
        CHECK_CLOSE(found[0], shift[0], trial % 2 ? 0.1 : 0.05);
        CHECK_CLOSE(found[1], shift[1], trial % 2 ? 0.1 : 0.05);
        follow_shake_undo(&shake, gains, found, frame);
        for (int row = 0; row < HEIGHT; ++row)
            for (int column = 0; column < WIDTH; ++column) {
                const double off = frame[row * WIDTH + column] / dim - (double)picture[row * WIDTH + column];
                const int margin = row < 16 || column < 16 || row >= HEIGHT - 16 || column >= WIDTH - 16;
                if (margin)
                    assert_true(fabs(off) < 1.0);
                if (!margin && hypot(column + shift[0] - 200.0, row + shift[1] - 90.0) > 17.0) {
                    squares += off * off;
                    ++count;
                }
            }
        assert_true(sqrt(squares / count) < 2.5);
        follow_shake_end(&shake);
    }
}

/* A camera that turns about its axis, by up to 3 degrees, and shakes: the angle is found, as clockwise, to 0.01 degrees or a
 * hundredth of it. */
static void rolls(void **state)
{
    (void)state;
    uint64_t chance = 11;
    for (int trial = 0; trial < 12; ++trial) {
        const texture t = make_texture(&chance, 4.0);
        const double roll = trial == 0 ? 0.0 : 0.05 * (2.0 * even(&chance) - 1.0) * (trial % 2 ? 1.0 : 0.1),
                     shift[2] = {6.0 * even(&chance) - 3.0, 6.0 * even(&chance) - 3.0};
        double found[2] = {0.0, 0.0};
        follow_shake shake;
        draw_picture(&t);
        for (int row = 0; row < HEIGHT; ++row)
            gains[row] = 1.0f;
        film(&t, shift, roll, 1.0, 6.0, &chance);
        assert_true(follow_shake_begin(&shake, picture, WIDTH, HEIGHT, 16));
        (void)follow_shake_find(&shake, frame, gains, found);
        const double angle = follow_shake_roll(&shake, found);
        print_message("roll %.5f found as %.5f\n", roll, angle);
        CHECK_CLOSE(angle, roll, 2e-4 + 0.01 * fabs(roll));
        follow_shake_end(&shake);
    }
}

/* Of a camera that stands still the products of both halves cancel over many noisy frames, where the squares of the
 * shifts add up; of one that moved and turned they are its squares. */
static void halves_of_a_chequerboard(void **state)
{
    (void)state;
    enum { FRAMES = 40 };
    uint64_t chance = 5;
    const texture t = make_texture(&chance, 1.5);
    const double still[2] = {0.0, 0.0}, moved[2] = {1.5, -2.0}, roll = 0.01;
    double squares = 0.0, products = 0.0, turns = 0.0, product, turned;
    follow_shake shake;
    draw_picture(&t);
    for (int row = 0; row < HEIGHT; ++row)
        gains[row] = 1.0f;
    assert_true(follow_shake_begin(&shake, picture, WIDTH, HEIGHT, 4));
    for (int k = 0; k < FRAMES; ++k) {
        double found[2] = {0.0, 0.0};
        film(&t, still, 0.0, 1.0, 12.0, &chance);
        (void)follow_shake_find(&shake, frame, gains, found);
        follow_shake_squares(&shake, found, &product, &turned);
        squares += 0.5 * (found[0] * found[0] + found[1] * found[1]) / FRAMES;
        products += product / FRAMES;
        turns += turned / FRAMES;
    }
    print_message("still: mean square %.2e, of products %.2e; of angles %.2e\n", squares, products, turns);
    assert_true(squares > 0.0 && fabs(products) < 0.5 * squares);
    double found[2] = {0.0, 0.0};
    film(&t, moved, roll, 1.0, 3.0, &chance);
    (void)follow_shake_find(&shake, frame, gains, found);
    follow_shake_squares(&shake, found, &product, &turned);
    print_message("moved: %.4f of 3.125, turned %.3e of %.3e\n", product, turned, roll * roll);
    CHECK_CLOSE(product, 3.125, 0.3);
    CHECK_CLOSE(turned, roll * roll, 0.1 * roll * roll);
    follow_shake_end(&shake);
}

static void plain_pictures(void **state)
{
    (void)state;
    uint64_t chance = 9;
    const texture none = make_texture(&chance, 0.0);
    const double shift[2] = {2.0, 1.0};
    double found[2] = {0.5, -0.5};
    follow_shake shake;
    for (int i = 0; i < WIDTH * HEIGHT; ++i)
        picture[i] = 150.0f;
    for (int row = 0; row < HEIGHT; ++row)
        gains[row] = 1.0f;
    film(&none, shift, 0.0, 1.0, 6.0, &chance);
    assert_true(follow_shake_begin(&shake, picture, WIDTH, HEIGHT, 16));
    assert_true(isnan(follow_shake_find(&shake, frame, gains, found)));
    assert_true(found[0] == 0.5 && found[1] == -0.5);
    assert_true(isnan(follow_shake_roll(&shake, shift)));
    follow_shake_end(&shake);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(shifts),
        cmocka_unit_test(rolls),
        cmocka_unit_test(halves_of_a_chequerboard),
        cmocka_unit_test(plain_pictures),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
