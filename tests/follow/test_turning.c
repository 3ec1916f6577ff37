/* How a bead turns, on rotations, cameras and faces that are known exactly: rotation vectors there and back, a camera from
 * the plane that it sees, the axis of painted marks, W and slip with their errors, and faces with a highlight, a lamp
 * from the side and noise, of which the rotations come back.  A bead without marks: test_turning_long.py.
 * labels: slow numbers
 * tests: follow/patch.c follow/view.c follow/sphere.c follow/pose.c follow/light.c follow/turning.c follow/spin.c
 * follow/rhythm.c base/turn.h */
#include "numeric.h"

#include <stdlib.h>
#include <string.h>

#include "base/chance.h"
#include "base/constants.h"
#include "base/dot.h"
#include "base/turn.h"
#include "follow/pose.h"
#include "follow/rhythm.h"

#define STILL                                                                                                  \
    {                                                                                                          \
        {1.0, 0.0, 0.0}, {0.0, 1.0, 0.0},                                                                      \
        {                                                                                                      \
            0.0, 0.0, 1.0                                                                                      \
        }                                                                                                      \
    }

/* A number between -1 and 1. */
static double chance(uint64_t *state)
{
    return (double)(fst_draw(state) >> 11) / 4503599627370496.0 - 1.0;
}

/* Almost normal, with deviation 1. */
static double normal(uint64_t *state)
{
    double sum = 0.0;
    for (int i = 0; i < 12; ++i)
        sum += 0.5 * chance(state);
    return sum;
}

static void rotation_vectors(void **state)
{
    (void)state;
    uint64_t seed = 5;
    const double sizes[] = {0.0, 1e-9, 1e-4, 0.5, 2.0, 3.1, 3.14159, FST_PI};
    for (size_t k = 0; k < sizeof sizes / sizeof *sizes; ++k) {
        double from[3][3] = STILL, to[3][3], angle[3], found[3], length;
        for (int i = 0; i < 3; ++i)
            angle[i] = chance(&seed);
        fst_turn_by(from, angle);
        length = sqrt(fst_dot(angle, angle, 3));
        for (int i = 0; i < 3; ++i)
            angle[i] *= sizes[k] / length;
        memcpy(to, from, sizeof to);
        fst_turn_by(to, angle);
        fst_turn_between((const double(*)[3])from, (const double(*)[3])to, found);
        CHECK_CLOSE(sqrt(fst_dot(found, found, 3)), sizes[k], 1e-7);
        fst_turn_by(from, found);
        for (int i = 0; i < 9; ++i)
            CHECK_CLOSE(from[i / 3][i % 3], to[i / 3][i % 3], 1e-7);
    }
    /* A quarter turn about z takes x to y. */
    double turn[3][3] = STILL;
    fst_turn_by(turn, (const double[3]){0.0, 0.0, 0.5 * FST_PI});
    CHECK_CLOSE(turn[1][0], 1.0, 1e-12);
}

/* A camera at a place that looks at the origin: x to the right in its picture, as a person holds it. */
static void cameras(void **state)
{
    (void)state;
    const double place[3] = {40.0, -90.0, 280.0}, focal = 900.0, distance = sqrt(fst_dot(place, place, 3));
    double ahead[3], right[3] = {1.0, 0.0, 0.0}, down[3];
    for (int i = 0; i < 3; ++i)
        ahead[i] = -place[i] / distance;
    const double along = ahead[0];
    for (int i = 0; i < 3; ++i)
        right[i] -= along * ahead[i];
    const double length = sqrt(fst_dot(right, right, 3));
    for (int i = 0; i < 3; ++i)
        right[i] /= length;
    for (int i = 0; i < 3; ++i)
        down[i] = ahead[(i + 1) % 3] * right[(i + 2) % 3] - ahead[(i + 2) % 3] * right[(i + 1) % 3];
    /* Four corners of a square, as it sees them. */
    follow_scale scale = {.kind = FOLLOW_SCALE_FOUR, .length = {40.0, 40.0}};
    for (int k = 0; k < 4; ++k) {
        const double corner[3] = {k == 1 || k == 2 ? 20.0 : -20.0, k < 2 ? -20.0 : 20.0, 0.0};
        double off[3];
        for (int i = 0; i < 3; ++i)
            off[i] = corner[i] - place[i];
        const double depth = fst_dot(off, ahead, 3);
        scale.points[k][0] = 319.5 + focal * fst_dot(off, right, 3) / depth;
        scale.points[k][1] = 239.5 + focal * fst_dot(off, down, 3) / depth;
    }
    follow_plane plane;
    follow_camera camera;
    fst_error error;
    assert_int_equal(follow_plane_of_rectangle(&scale, &plane, &error), FST_OK);
    assert_true(follow_camera_find(&plane, 640, 480, distance, &camera));
    CHECK_CLOSE(camera.focal, focal, 1e-6 * focal);
    double view[3][3];
    const double column = 500.0, row = 120.0;
    const double radius = follow_camera_view(&camera, column, row, 2.5, view);
    double x, y;
    follow_plane_map(&plane, column, row, &x, &y);
    /* The plane's x points to the right in the picture, which here is not quite the axis of `place`: compare lengths. */
    const double to[3] = {camera.place[0] - x, camera.place[1] - y, camera.place[2]},
                 far = sqrt(fst_dot(to, to, 3));
    for (int i = 0; i < 3; ++i)
        CHECK_CLOSE(view[i][2], to[i] / far, 1e-9);
    CHECK_CLOSE(camera.place[2], place[2], 1e-6);
    CHECK_CLOSE(hypot(camera.place[0], camera.place[1]), hypot(place[0], place[1]), 1e-6);
    const double depth = fst_dot(to, to, 3) / far * fst_dot(camera.axes[2], to, 3) / far;
    CHECK_CLOSE(radius, focal * 2.5 / fabs(depth), 1e-9 * radius);
    /* Right-handed: to the right, up, and to the camera. */
    for (int i = 0; i < 3; ++i)
        CHECK_CLOSE(view[(i + 1) % 3][0] * view[(i + 2) % 3][1] - view[(i + 2) % 3][0] * view[(i + 1) % 3][1],
                    view[i][2], 1e-9);
}

/* ------------------------------------------------------------------ marks */

/* A dark half around an axis with a dot on each half, or two dots: 0 where it is dark. */
static double paint(const double point[3], int half)
{
    static const double north[3] = {0.36, 0.48, 0.8}, side[3] = {0.8, -0.6, 0.0},
                        spot[3] = {-0.9, -0.3, -0.316227766};
    const double n = fst_dot(point, north, 3);
    if (!half)
        return n > 0.87 || fst_dot(point, side, 3) > 0.95 ? 0.0 : 1.0;
    const double out[3] = {0.5, 0.7, 0.1}, reach = sqrt(fst_dot(out, out, 3));
    if (fst_dot(point, out, 3) / reach > 0.96 && n > 0.4)
        return 1.0;
    return n > 0.0 || fst_dot(point, spot, 3) > 0.93 ? 0.0 : 1.0;
}

/* Show the whole surface with its marks: a painted half, or dots. */
static void paint_sphere(follow_sphere *sphere, int half)
{
    uint64_t seed = 8;
    for (int k = 0; k < 60000; ++k) {
        double point[3];
        for (int i = 0; i < 3; ++i)
            point[i] = normal(&seed);
        const double length = sqrt(fst_dot(point, point, 3));
        for (int i = 0; i < 3; ++i)
            point[i] /= length;
        follow_sphere_add(sphere, point, paint(point, half), 1.0);
    }
}

static void axes_of_marks(void **state)
{
    (void)state;
    follow_sphere sphere;
    assert_true(follow_sphere_begin(&sphere));
    for (int half = 0; half < 2; ++half) {
        double axis[3] = {0.0, 0.0, 0.0};
        follow_sphere_clear(&sphere);
        assert_false(follow_sphere_axis(&sphere, axis));
        paint_sphere(&sphere, half);
        assert_true(follow_sphere_axis(&sphere, axis));
        assert_int_equal(follow_sphere_is_half(&sphere), half);
        CHECK_CLOSE(fst_dot(axis, (const double[3]){0.36, 0.48, 0.8}, 3), 1.0, half ? 1e-3 : 5e-4);
        /* The gradient is that of the value. */
        double value[2], slope[3], at[3] = {0.48, 0.6, 0.64}, beside[3] = {0.4801, 0.6, 0.64};
        assert_true(follow_sphere_at(&sphere, at, &value[0], slope));
        assert_true(follow_sphere_at(&sphere, beside, &value[1], NULL));
        CHECK_CLOSE((value[1] - value[0]) / 1e-4, slope[0], 0.02 + 0.02 * fabs(slope[0]));
    }
    free(sphere.nodes);
}

/* ------------------------------------------------------------------ a bead that moves */

enum { FRAMES = 140, FINE = 40 };
#define RADIUS 2.5
#define DISTANCE 150.0 /* mm, of the camera over the origin */

static double apart = 1.0 / 240.0; /* s, from one frame to the next */

/* ONCE: it does not repeat itself.  REPEATS: seen from what turns at 45 rad/s it does, 120 rad/s being the rate.  ALMOST: but
 * for its slip.  KINKS: the slope of its slip leaps, as dry friction makes it. */
typedef enum kind { ONCE, REPEATS, ALMOST, KINKS } kind;

/* Its velocity (mm/s): it goes round, faster and slower. */
static void velocity(kind k, double t, double v[2])
{
    const int once = k == ONCE;
    v[0] = once ? 300.0 * cos(20.0 * t) + 80.0 * cos(70.0 * t) : 400.0 * cos(45.0 * t) + 80.0 * cos(165.0 * t);
    v[1] = once ? 300.0 * sin(20.0 * t) + 60.0 * sin(60.0 * t) : 400.0 * sin(45.0 * t) + 80.0 * sin(165.0 * t);
}

static void slip_of(kind k, double t, double slip[2])
{
    const double more = k == ALMOST ? 80.0 * cos(30.0 * t + 60.0 * t * t) : 0.0;
    if (k == KINKS) {
        const double size = 200.0 * fmin(1.0, fmax(0.0, 2.5 * cos(120.0 * t + 0.4)));
        slip[0] = size * cos(45.0 * t);
        slip[1] = size * sin(45.0 * t);
        return;
    }
    slip[0] = k == ONCE ? 30.0 : 60.0 * cos(285.0 * t + 0.3) + 30.0 * cos(-195.0 * t) + more;
    slip[1] = k == ONCE ? -20.0 : 60.0 * sin(285.0 * t + 0.3) + 30.0 * sin(-195.0 * t) + more;
}

/* It rolls but for its slip, and spins about the vertical. */
static void rate(kind k, double t, double w[3])
{
    double v[2], slip[2];
    velocity(k, t, v);
    slip_of(k, t, slip);
    w[0] = -(v[1] - slip[1]) / RADIUS;
    w[1] = (v[0] - slip[0]) / RADIUS;
    w[2] = 30.0 * sin((k == ONCE ? 45.0 : 240.0) * t);
}

/* Fill in places and true rotations. */
static void move(follow_turning *t, kind what)
{
    double turn[3][3] = STILL, place[2] = {0.0, 0.0};
    t->turns = calloc(FRAMES, sizeof *t->turns);
    t->count = t->capacity = FRAMES;
    t->millimetres = RADIUS;
    fst_turn_by(turn, (const double[3]){0.4, -0.8, 0.3});
    for (int i = 0; i < FRAMES; ++i) {
        follow_turn *f = &t->turns[i];
        *f = (follow_turn){
            .frame = i, .good = 1, .time = apart * i, .bright = 200.0, .shrink = 1.0, .view = STILL};
        /* What points up turns towards the camera. */
        fst_turn_by(f->view, (const double[3]){place[1] / DISTANCE, -place[0] / DISTANCE, 0.0});
        f->close = RADIUS / DISTANCE;
        memcpy(f->place, place, sizeof place);
        memcpy(f->pose.turn, turn, sizeof turn);
        f->pose.gain = 1.0;
        for (int k = 0; k < FINE; ++k) {
            double w[3], v[2];
            rate(what, apart * (i + (k + 0.5) / FINE), w);
            velocity(what, apart * (i + (k + 0.5) / FINE), v);
            for (int j = 0; j < 3; ++j)
                w[j] *= apart / FINE;
            fst_turn_by(turn, w);
            for (int j = 0; j < 2; ++j)
                place[j] += v[j] * apart / FINE;
        }
    }
}

static void begin(follow_turning *t, kind what)
{
    fst_error error;
    assert_int_equal(follow_turning_begin(t, 30.0, &error), FST_OK);
    move(t, what);
}

static void make_track(fst_track *track)
{
    fst_error error;
    *track = (fst_track){.rows = 0};
    for (int i = 0; i < FRAMES; ++i)
        assert_int_equal(fst_track_append(track, i, apart * i, 0.0, 0.0, &error), FST_OK);
}

/* A shutter that rolls, in a film that was turned: frames show the bead later than they say, which its places tell.  What does
 * not repeat itself tells no more than the time of half a frame. */
static void shutters(void **state)
{
    (void)state;
    uint64_t seed = 11;
    for (kind what = ONCE; what <= REPEATS; ++what) {
        const double later[2] = {8e-6, -20e-6}; /* s/mm */
        double most = 0.0, first = NAN;
        follow_turning t;
        begin(&t, what);
        for (int i = 0; i < FRAMES; ++i) {
            t.turns[i].time -= fst_dot(later, t.turns[i].place, 2);
            for (int j = 0; j < 2; ++j)
                t.turns[i].place[j] += 0.01 * normal(&seed);
        }
        follow_rhythm_shutter(&t, apart);
        for (int i = 0; i < FRAMES; ++i) { /* all may be late alike */
            const double late = t.turns[i].time - apart * i;
            first = i == 0 ? late : first;
            most = fmax(most, fabs(late - first));
        }
        print_message("times are off by up to %.1f us\n", 1e6 * most);
        assert_true(most < (what == REPEATS ? 2e-5 : apart));
        follow_turning_end(&t);
    }
}

/* Frames that show no mark. */
static int hidden(kind what, int i)
{
    return what == REPEATS && i % 60 > 50;
}

/* Rotations with known errors, and places with others: W and slip are right, as often as their errors say.  What repeats
 * itself is known better than windows would have it, whose polynomials a slip of 45 Hz is too fast for. */
static void spins_of(kind what, uint64_t seed, double most)
{
    const double noise =
        what == KINKS ? 0.2 : 1.0; /* lest it hide what the kinks have beyond the last harmonic */
    follow_turning t;
    fst_track track;
    fst_error error;
    begin(&t, what);
    paint_sphere(&t.sphere, 1);
    double true_turns[FRAMES][3][3], squares = 0.0;
    const double north[3] = {0.36, 0.48, 0.8};
    for (int i = 0; i < FRAMES; ++i) {
        double by[3];
        memcpy(true_turns[i], t.turns[i].pose.turn, sizeof true_turns[i]);
        for (int j = 0; j < 3; ++j) { /* one axis is less sure than the others */
            const double sigma = noise * (j == 0 ? 0.02 : 0.005);
            by[j] = (hidden(what, i) ? 0.05 : sigma) * normal(&seed);
            t.turns[i].known[j][j] = hidden(what, i) ? 0.0 : 1.0 / (sigma * sigma);
        }
        fst_turn_by(t.turns[i].pose.turn, by);
        for (int j = 0; j < 2; ++j)
            t.turns[i].place[j] += 0.01 * noise * normal(&seed);
    }
    make_track(&track);
    assert_int_equal(follow_spin(&t, &track, &error), FST_OK);
    int within[2] = {0, 0}, twice = 0, all[2] = {0, 0}, told = 0;
    for (int i = 0; i < FRAMES; ++i) {
        const fst_turning *f = &track.turning[i];
        double w[3], slip[2];
        rate(what, apart * i, w);
        slip_of(what, apart * i, slip);
        if (hidden(what, i))
            assert_true(f->n_error > 0.02 && f->n_error < 0.15);
        for (int j = 0; j < 3 && isfinite(f->n_error); ++j)
            assert_true(fabs(f->n[j] - fst_dot(true_turns[i][j], north, 3)) < 6.0 * f->n_error);
        if (!isfinite(f->slip[0]))
            continue;
        ++told;
        for (int j = 0; j < 3; ++j, ++all[0])
            within[0] += fabs(f->w[j] - w[j]) < f->w_error;
        for (int j = 0; j < 2; ++j, ++all[1]) {
            within[1] += fabs(f->slip[j] - slip[j]) < f->slip_error;
            twice += fabs(f->slip[j] - slip[j]) < 2.0 * f->slip_error;
            squares += pow(f->slip[j] - slip[j], 2.0);
        }
        assert_true(fabs(f->slip[0] - slip[0]) < 6.0 * f->slip_error);
    }
    assert_true(told >= (track.rhythm > 0 ? FRAMES : FRAMES - 8));
    print_message(
        "rhythm %d; W %d of %d, slip %d of %d within an error, %d within two; slip off by %.1f mm/s\n",
        track.rhythm, within[0], all[0], within[1], all[1], twice, sqrt(squares / all[1]));
    assert_int_equal(track.rhythm > 0, what == REPEATS || what == KINKS);
    assert_true(twice > 0.9 * all[1]);
    assert_true(sqrt(squares / all[1]) < most);
    for (int k = 0; k < 2; ++k) /* the other errors are upper bounds: W changes fast */
        assert_true(within[k] > 0.55 * all[k] && (what != ONCE || within[k] < 0.9 * all[k]));
    for (int i = 0; i < 3; ++i)
        CHECK_CLOSE(track.turning[70].n[i], fst_dot(true_turns[70][i], north, 3), 0.06);
    fst_track_free(&track);
    follow_turning_end(&t);
}

static void spins(void **state)
{
    (void)state;
    for (uint64_t seed = 3; seed < 5; ++seed) {
        spins_of(ONCE, seed, 9.0);
        spins_of(REPEATS, seed, 2.0);
        spins_of(ALMOST, seed, 30.0);
        spins_of(KINKS, seed, 4.0);
    }
}

/* In how many frames the turning of a bead is told, which shows few marks or not. */
static int told_of(kind what, int few, int all_sides, double wider)
{
    uint64_t seed = 4;
    int told = 0;
    follow_turning t;
    fst_track track;
    fst_error error;
    begin(&t, what);
    t.few = few;
    if (all_sides)
        paint_sphere(&t.sphere, 0);
    for (int i = 0; i < FRAMES; ++i) {
        double by[3];
        for (int j = 0; j < 3; ++j) {
            by[j] = wider * 0.01 * normal(&seed);
            t.turns[i].known[j][j] = 1e4;
        }
        fst_turn_by(t.turns[i].pose.turn, by);
    }
    make_track(&track);
    assert_int_equal(follow_spin(&t, &track, &error), FST_OK);
    for (int i = 0; i < FRAMES; ++i)
        told += isfinite(track.turning[i].w_error) || isfinite(track.turning[i].slip_error);
    assert_true(!few || (track.rhythm > 0) == (told > 0));
    fst_track_free(&track);
    follow_turning_end(&t);
    return told;
}

/* Few marks tell what repeats itself, if each swing has 15 frames, all sides of the bead are seen, and rotations are as sure
 * as they say: nothing else.  Other marks must be as sure where not all sides are seen. */
static void few_marks(void **state)
{
    (void)state;
    assert_int_equal(told_of(REPEATS, 1, 1, 1.0), 0); /* 12.6 frames */
    apart = 1.0 / 300.0;                              /* 15.7 */
    assert_int_equal(told_of(REPEATS, 1, 1, 1.0), FRAMES);
    assert_int_equal(told_of(REPEATS, 1, 1, 5.0), 0);
    assert_int_equal(told_of(REPEATS, 1, 0, 1.0), 0);
    assert_int_equal(told_of(ONCE, 1, 1, 1.0), 0);
    assert_true(told_of(ONCE, 0, 0, 1.0) > 0);
    assert_int_equal(told_of(ONCE, 0, 0, 8.0), 0);
    apart = 1.0 / 240.0;
}

/* ------------------------------------------------------------------ faces */

/* Where on the bead's front a line of sight ends that starts at the camera, and crosses the plane through the bead's middle
 * at (right, up). */
static void see(const follow_turn *f, double right, double up, double facing[3])
{
    const double way[3] = {right * f->close, up * f->close, -1.0}, square = fst_dot(way, way, 3),
                 half = 1.0 / f->close, /* of the equation of second degree whose lesser root is the front */
        more = (1.0 / (f->close * f->close) - 1.0) * square,
                 at = (half - sqrt(fmax(0.0, half * half - more))) / square;
    const double seen[3] = {at * way[0], at * way[1], 1.0 / f->close + at * way[2]};
    for (int i = 0; i < 3; ++i)
        facing[i] = fst_dot(f->view[i], seen, 3);
}

/* Paint the faces: a lamp from the side, a highlight that stays where it is, noise, and the plate around. */
static void paint_faces(follow_turning *t, double contrast, int half)
{
    uint64_t seed = 6;
    t->levels = malloc((size_t)t->points * FRAMES);
    for (int i = 0; i < FRAMES; ++i)
        for (int k = 0; k < t->points; ++k) {
            const double right = t->grid[k][0], up = t->grid[k][1], far = hypot(right, up);
            const double cover = fmax(0.0, fmin(1.0, 15.0 * (1.0 - far) + 0.5));
            double level = 0.0;
            for (int s = 0; s < 9; ++s) { /* a pixel sees a small area */
                const double u = right + (s % 3 - 1) / 45.0, v = up + (double)(s / 3 - 1) / 45.0;
                const double size = fmax(1.0, hypot(u, v) / 0.999);
                double facing[3], point[3];
                see(&t->turns[i], u / size, v / size, facing);
                follow_on_bead((const double(*)[3])t->turns[i].pose.turn, facing, point);
                const double light = 70.0 + 60.0 * (0.5 * facing[1] - 0.4 * facing[0] + 0.7 * facing[2]);
                level += light * (1.0 - contrast * (1.0 - paint(point, half))) / 9.0;
            }
            if (hypot(right + 0.25, up - 0.3) < 0.15)
                level = 240.0;
            level = cover * level + (1.0 - cover) * 200.0 + 2.0 * normal(&seed);
            t->levels[i * t->points + k] = (unsigned char)fmax(0.0, fmin(255.0, level + 0.5));
        }
}

/* The points of a face lie where its lines of sight end, but for the square of the radius over the distance. */
static void lines_of_sight(void **state)
{
    (void)state;
    follow_turning t;
    begin(&t, ONCE);
    follow_face(&t, &t.turns[FRAMES - 1]);
    for (int k = 0; k < t.points; ++k) {
        double facing[3];
        if (hypot(t.grid[k][0], t.grid[k][1]) > 0.9)
            continue;
        see(&t.turns[FRAMES - 1], t.grid[k][0], t.grid[k][1], facing);
        for (int i = 0; i < 3; ++i)
            CHECK_CLOSE(t.facing[k][i], facing[i], 2.0 * (RADIUS / DISTANCE) * (RADIUS / DISTANCE));
    }
    follow_turning_end(&t);
}

/* How far the half that n points away from is turned about n against the other one. */
static double twist_of(const follow_turning *t, double (*const turns)[3][3], const double axis[3])
{
    double sums[2] = {0.0, 0.0}, counts[2] = {0.0, 0.0};
    for (int i = 0; i < FRAMES; ++i) {
        double off[3], n[3];
        for (int k = 0; k < 3; ++k)
            n[k] = fst_dot(turns[i][k], axis, 3);
        fst_turn_between((const double(*)[3])turns[i], (const double(*)[3])t->turns[i].pose.turn, off);
        if (fabs(n[2]) > 0.4) {
            sums[n[2] > 0.0] += fst_dot(off, n, 3);
            counts[n[2] > 0.0] += 1.0;
        }
    }
    return sums[1] / counts[1] - sums[0] / counts[0];
}

/* Halves of the surface that are twisted against each other come back. */
static void twisted(follow_turning *t)
{
    double axis[3], turns[FRAMES][3][3];
    assert_true(follow_sphere_axis(&t->sphere, axis));
    for (int i = 0; i < FRAMES; ++i) {
        double n[3];
        memcpy(turns[i], t->turns[i].pose.turn, sizeof turns[i]);
        for (int k = 0; k < 3; ++k)
            n[k] = fst_dot(turns[i][k], axis, 3);
        const double way = 0.05 * fmax(-1.0, fmin(1.0, 2.5 * n[2]));
        fst_turn_by(t->turns[i].pose.turn, (const double[3]){way * n[0], way * n[1], way * n[2]});
    }
    follow_surface_learn(t);
    const double before = twist_of(t, turns, axis);
    CHECK_CLOSE(before, 0.1, 1e-6);
    for (int repeat = 0; repeat < 2; ++repeat)
        (void)follow_untwist(t);
    print_message("twisted by %.3f, then by %.3f rad\n", before, twist_of(t, turns, axis));
    assert_true(fabs(twist_of(t, turns, axis)) < 0.01);
    assert_false(follow_untwist(t));
}

/* With the surface and the light learnt of all faces, rotations that were put wrong come back. */
static void faces(void **state)
{
    (void)state;
    uint64_t seed = 12;
    follow_turning t;
    double squares = 0.0, before = 0.0, claimed = 0.0;
    begin(&t, ONCE);
    paint_faces(&t, 0.8, 1);
    (void)follow_light_begin(&t);
    for (int repeat = 0; repeat < 3; ++repeat) {
        follow_surface_learn(&t);
        follow_light_learn(&t);
        assert_true(follow_explain(&t) > 0.9);
    }
    for (int i = 0; i < FRAMES; ++i) {
        follow_turn *f = &t.turns[i];
        follow_pose pose = f->pose;
        double by[3], off[3];
        for (int k = 0; k < 3; ++k)
            by[k] = 0.1 * chance(&seed);
        fst_turn_by(pose.turn, by);
        follow_face(&t, f);
        follow_refine(&t, f, 12, &pose);
        fst_turn_between((const double(*)[3])f->pose.turn, (const double(*)[3])pose.turn, off);
        follow_known(&t, f);
        squares += fst_dot(off, off, 3) / (3 * FRAMES);
        before += fst_dot(by, by, 3) / (3 * FRAMES);
        claimed += 1.0 / f->known[2][2] / FRAMES;
    }
    print_message("rms %.3f degrees of %.3f, claimed %.3f\n", sqrt(squares) * 180.0 / FST_PI,
                  sqrt(before) * 180.0 / FST_PI, sqrt(claimed) * 180.0 / FST_PI);
    assert_true(sqrt(squares) < 1.1 * FST_PI / 180.0); /* a film is to reach 3 */
    assert_true(claimed > 0.0 && sqrt(claimed) < 0.02);
    twisted(&t);
    follow_turning_end(&t);
}

/* Two dots, of which many frames show none: from frame to frame all faces together tell W, also where it is far from rolling. */
static void faces_in_rhythm(void **state)
{
    (void)state;
    follow_turning t;
    follow_rhythm rhythm;
    double off = 0.0, rolling = 0.0;
    begin(&t, REPEATS);
    paint_faces(&t, 0.8, 0);
    (void)follow_light_begin(&t);
    assert_true(follow_rhythm_begin(&t, apart, &rhythm));
    for (int i = 0; i < FRAMES; ++i) {
        double w[3], found[3], v[2];
        rate(REPEATS, apart * i, w);
        velocity(REPEATS, apart * i, v);
        follow_rhythm_rate(&rhythm, apart * i, found);
        for (int k = 0; k < 3; ++k)
            off += pow(found[k] - w[k], 2.0) / (3 * FRAMES);
        rolling +=
            (pow(w[0] + v[1] / RADIUS, 2.0) + pow(w[1] - v[0] / RADIUS, 2.0) + w[2] * w[2]) / (3 * FRAMES);
    }
    print_message("W off by %.1f rad/s, rolling by %.1f\n", sqrt(off), sqrt(rolling));
    assert_true(sqrt(off) < 8.0 && sqrt(rolling) > 18.0);
    follow_turning_end(&t);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(rotation_vectors), cmocka_unit_test(cameras),
        cmocka_unit_test(axes_of_marks),    cmocka_unit_test(spins),
        cmocka_unit_test(few_marks),        cmocka_unit_test(shutters),
        cmocka_unit_test(lines_of_sight),   cmocka_unit_test(faces),
        cmocka_unit_test(faces_in_rhythm),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
