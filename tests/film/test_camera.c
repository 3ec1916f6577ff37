/* Films as a camera takes them: where a place is seen, what exposure, rolling shutter and noise do to the
 * picture, and whether the truth that is written beside the film is what the picture shows.
 * tests: film/camera.c film/camera_paint.c film/camera_view.c */
#include "numeric.h"

#include <stdlib.h>
#include <string.h>

#include "base/constants.h"
#include "film/camera_paint.h"

enum { WIDTH = 160, HEIGHT = 120, ROWS = 201 };

static double column_t[ROWS], column_x[ROWS], column_y[ROWS], column_vx[ROWS], column_vy[ROWS];

/* A bead on a circle of 20 mm, `turns` a second, told at 200 moments of a second. */
static fst_camera_motion circle(double turns)
{
    const double w = 2.0 * FST_PI * turns;
    for (int i = 0; i < ROWS; ++i) {
        const double t = column_t[i] = i / (ROWS - 1.0);
        column_x[i] = 2.0 * cos(w * t);
        column_y[i] = 2.0 * sin(w * t);
        column_vx[i] = -2.0 * w * sin(w * t);
        column_vy[i] = 2.0 * w * cos(w * t);
    }
    return (fst_camera_motion){.t = column_t,
                               .x = column_x,
                               .y = column_y,
                               .vx = column_vx,
                               .vy = column_vy,
                               .rows = ROWS,
                               .bead = 2.5,
                               .second = 1.0,
                               .millimetre = 10.0};
}

static fst_camera_paint camera(double tilt, double exposure, double readout)
{
    fst_camera_paint paint = {.view = fst_camera_view_make(WIDTH, HEIGHT, 200.0, tilt, -1.2, 40.0),
                              .width = WIDTH,
                              .height = HEIGHT,
                              .plate = 35.0,
                              .marks = 21.0,
                              .exposure = exposure,
                              .readout = readout,
                              .seed = 3};
    fst_error error;
    assert_int_equal(fst_camera_paint_begin(&paint, &error), FST_OK);
    return paint;
}

/* What a pixel sees is where a place is seen, and the middle of the plate is in the middle of the picture. */
static void rays_and_places_agree(void **state)
{
    (void)state;
    for (int k = 0; k < 24; ++k) {
        const fst_camera_view view = fst_camera_view_make(WIDTH, HEIGHT, 150.0, 0.05 * k, 0.7 * k, 30.0);
        const double place[3] = {10.0 * cos(k), 8.0 * sin(2.0 * k), 2.0}, middle[3] = {0.0, 0.0, 0.0};
        double seen[2], ray[3], off[3];
        fst_camera_view_project(&view, place, seen);
        fst_camera_view_ray(&view, seen[0], seen[1], ray);
        for (int i = 0; i < 3; ++i)
            off[i] = place[i] - view.place[i];
        const double way = off[0] * ray[0] + off[1] * ray[1] + off[2] * ray[2];
        for (int i = 0; i < 3; ++i)
            CHECK_CLOSE(view.place[i] + way * ray[i], place[i], 1e-11);
        fst_camera_view_project(&view, middle, seen);
        CHECK_CLOSE(seen[0], 0.5 * (WIDTH - 1), 1e-11);
        CHECK_CLOSE(seen[1], 0.5 * (HEIGHT - 1), 1e-11);
        CHECK_CLOSE(view.place[2], 150.0 * cos(0.05 * k), 1e-11);
        CHECK_CLOSE(view.place[0], 150.0 * sin(0.05 * k) * cos(0.7 * k), 1e-11);
    }
}

/* Without tilt, x is to the right, y up, and all lengths on the plate are seen at one scale. */
static void upright_without_tilt(void **state)
{
    (void)state;
    const fst_camera_view view = fst_camera_view_make(WIDTH, HEIGHT, 150.0, 0.0, 0.4, 30.0);
    double seen[2];
    fst_camera_view_project(&view, (const double[3]){30.0, 15.0, 0.0}, seen);
    CHECK_CLOSE(seen[0], 0.5 * (WIDTH - 1) + 0.5 * HEIGHT, 1e-11);
    CHECK_CLOSE(seen[1], 0.5 * (HEIGHT - 1) - 0.25 * HEIGHT, 1e-11);
}

/* Between samples the cubic is right to the fourth order in their distance. */
static void motion_between_samples(void **state)
{
    (void)state;
    fst_camera_motion motion = circle(4.0);
    const double w = 8.0 * FST_PI, h = 1.0 / (ROWS - 1);
    for (int i = 0; i < 500; ++i) {
        double place[3];
        const double t = fmod(0.7548776662466927 * i, 1.0);
        fst_camera_motion_at(&motion, t, place);
        CHECK_CLOSE(place[0], 20.0 * cos(w * t), 20.0 * pow(w * h, 4.0) / 384.0 + 1e-12);
        CHECK_CLOSE(place[1], 20.0 * sin(w * t), 20.0 * pow(w * h, 4.0) / 384.0 + 1e-12);
    }
}

/* The centroid of what is darker than in the picture without a bead. */
static void centroid(const fst_camera_paint *paint, const unsigned char *pixels, double seen[2])
{
    double sum = 0.0;
    seen[0] = seen[1] = 0.0;
    for (int row = 0; row < HEIGHT; ++row)
        for (int column = 0; column < WIDTH; ++column) {
            const double off =
                paint->still[row * WIDTH + column] > 150.0f && pixels[row * WIDTH + column] < 140;
            sum += off;
            seen[0] += off * column;
            seen[1] += off * row;
        }
    assert_true(sum > 20.0);
    seen[0] /= sum;
    seen[1] /= sum;
}

/* The truth is what the picture shows: with tilt, an exposure of a tenth of a turn, and a rolling shutter. */
static void truth_is_in_the_picture(void **state)
{
    (void)state;
    static unsigned char pixels[WIDTH * HEIGHT];
    for (int kind = 0; kind < 3; ++kind) {
        fst_camera_motion motion = circle(4.0);
        fst_camera_paint paint = camera(kind ? 0.4 : 0.0, kind > 1 ? 0.004 : 0.0, kind > 1 ? 0.03 : 0.0);
        for (int k = 0; k < 20; ++k) {
            double place[3], told[2], shown[2];
            fst_camera_paint_frame(&paint, &motion, 1, 0.04 * k, (uint64_t)k, pixels);
            fst_camera_paint_truth(&paint, &motion, 0.04 * k, place, told);
            centroid(&paint, pixels, shown);
            CHECK_CLOSE(shown[0], told[0], 0.5);
            CHECK_CLOSE(shown[1], told[1], 0.5);
        }
        fst_camera_paint_end(&paint);
    }
}

/* The truth of a long exposure is the mean place, nearer to the middle than the path by sinc(half the angle),
 * and a rolling shutter delays it by its row. */
static void exposure_and_readout(void **state)
{
    (void)state;
    const double turns = 4.0, exposure = 0.02, readout = 0.03, half = FST_PI * turns * exposure;
    fst_camera_motion motion = circle(turns);
    fst_camera_paint paint = camera(0.0, exposure, readout);
    for (int k = 0; k < 10; ++k) {
        double place[3], seen[2];
        fst_camera_paint_truth(&paint, &motion, 0.05 * k, place, seen);
        CHECK_CLOSE(hypot(place[0], place[1]), 20.0 * sin(half) / half, 0.002);
        const double delay = 0.5 * exposure + readout * seen[1] / HEIGHT;
        const double angle = 2.0 * FST_PI * turns * (0.05 * k + delay);
        CHECK_CLOSE(cos(atan2(place[1], place[0]) - angle), 1.0, 1e-5);
    }
    fst_camera_paint_end(&paint);
}

/* Noise has the deviation that was asked for and another value in every frame; the same seed gives the same
 * film. */
static void noise_is_as_asked(void **state)
{
    (void)state;
    static unsigned char one[WIDTH * HEIGHT], other[WIDTH * HEIGHT], again[WIDTH * HEIGHT];
    fst_camera_motion motion = circle(4.0);
    fst_camera_paint paint = camera(0.0, 0.001, 0.0);
    paint.noise = 5.0;
    fst_camera_paint_frame(&paint, &motion, 1, 0.1, 1, one);
    fst_camera_paint_frame(&paint, &motion, 1, 0.1, 2, other);
    fst_camera_paint_frame(&paint, &motion, 1, 0.1, 1, again);
    assert_memory_equal(one, again, sizeof one);
    double squares = 0.0, product = 0.0;
    int count = 0;
    for (int i = 0; i < WIDTH * 20; ++i) { /* the first rows, where no bead comes */
        const double a = one[i] - (double)paint.still[i], b = other[i] - (double)paint.still[i];
        squares += a * a + b * b;
        product += a * b;
        ++count;
    }
    CHECK_CLOSE(sqrt(0.5 * squares / count), sqrt(25.0 + 1.0 / 12.0), 0.2); /* rounding adds 1/12 */
    CHECK_CLOSE(product / count, 0.0, 1.5);                                 /* four deviations of its mean */
    fst_camera_paint_end(&paint);
}

/* Lamps at 100 Hz: a row is brighter by their sine at its own time, and an exposure of a hundredth of a second
 * sees no flicker. */
static void lamps_flicker_by_rows(void **state)
{
    (void)state;
    static unsigned char pixels[WIDTH * HEIGHT];
    fst_camera_motion motion = circle(4.0);
    for (int kind = 0; kind < 2; ++kind) {
        fst_camera_paint paint = camera(0.0, kind ? 0.01 : 0.0, 0.01);
        paint.flicker = 0.2;
        fst_camera_paint_frame(&paint, &motion, 1, 0.1, 0, pixels);
        for (int row = 0; row < HEIGHT; ++row) {
            const double still = paint.still[row * WIDTH];
            const double bright = kind ? 1.0 : 1.0 + 0.2 * sin(2.0 * FST_PI * row / HEIGHT);
            CHECK_CLOSE(pixels[row * WIDTH], bright * still, 0.51);
        }
        fst_camera_paint_end(&paint);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(rays_and_places_agree),  cmocka_unit_test(upright_without_tilt),
        cmocka_unit_test(motion_between_samples), cmocka_unit_test(truth_is_in_the_picture),
        cmocka_unit_test(exposure_and_readout),   cmocka_unit_test(noise_is_as_asked),
        cmocka_unit_test(lamps_flicker_by_rows),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
