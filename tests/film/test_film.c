/* The motion that a film shows, from samples of motions that are known exactly: a body that turns evenly about
 * a fixed axis, and a bead that goes straight on. And how a whole film is told from one that was cut short.
 * tests: film/film.c film/cast.c film/motion.c io/film_file.c io/collect.c */
#include "numeric.h"

#include <stdlib.h>
#include <unistd.h>

#include "io/film_file.h"
#include "film/cast.h"

#include <festoon/festoon_tools.h>

enum { ROWS = 81 };

static const double TURNS = 4.0;                  /* turns of the drive over all rows */
static const double AXIS[3] = {0.48, -0.6, 0.64}; /* the axis about which the body turns, a unit vector */
static const double RATE = 3.1, TIME = 2.0, N0[3] = {0.36, 0.8, -0.48};

/* v turned about AXIS by an angle. */
static void turned(const double v[3], double angle, double out[3])
{
    const double along = AXIS[0] * v[0] + AXIS[1] * v[1] + AXIS[2] * v[2];
    for (int i = 0; i < 3; ++i) {
        const int j = (i + 1) % 3, k = (i + 2) % 3;
        const double across = AXIS[j] * v[k] - AXIS[k] * v[j];
        out[i] = along * AXIS[i] + cos(angle) * (v[i] - along * AXIS[i]) + sin(angle) * across;
    }
}

static fst_table table_of_turning(double colour_from, double colour_to)
{
    fst_table table = {.rows = ROWS, .params = fst_default_params(), .complete = 1};
    table.columns = calloc((size_t)fst_column_count(), sizeof *table.columns);
    assert_non_null(table.columns);
    for (int c = 0; c < fst_column_count(); ++c) {
        const char *name = fst_column_at(c)->name;
        table.columns[c] = calloc(ROWS, sizeof *table.columns[c]);
        assert_non_null(table.columns[c]);
        for (int row = 0; row < ROWS; ++row) {
            const double part = (double)row / (ROWS - 1), t = TIME * part;
            double n[3];
            turned(N0, RATE * t, n);
            double *value = &table.columns[c][row];
            if (!strcmp(name, "t"))
                *value = t;
            else if (!strcmp(name, "drive_turns"))
                *value = TURNS * part;
            else if (!strcmp(name, "x"))
                *value = 0.5 + 0.25 * part;
            else if (!strcmp(name, "y"))
                *value = -1.0 + 2.0 * part;
            else if (!strcmp(name, "slip"))
                *value = colour_from + (colour_to - colour_from) * part;
            else if (!strncmp(name, "n_", 2) && strlen(name) == 3)
                *value = name[2] == 'x' ? n[0] : name[2] == 'y' ? n[1] : name[2] == 'z' ? n[2] : 0.0;
            else if (!strncmp(name, "w_", 2))
                *value = RATE * AXIS[name[2] - 'x'];
        }
    }
    return table;
}

static void begin(fst_film_motion *motion, const fst_table *table, const char *colour)
{
    fst_error error = {FST_OK, "", ""};
    if (fst_film_motion_begin(motion, table, NULL, NAN, NAN, colour, &error) != FST_OK)
        fail_msg("%s", error.sentence);
}

/* Each axis of the painted body has turned with the body, by the right angle and the right way round, at
 * samples and between them; the moment is the third axis, and the three are right-handed. */
static void test_the_body_turns_with_the_bead(void **state)
{
    (void)state;
    fst_table table = table_of_turning(0.0, 1.0);
    fst_film_motion motion;
    fst_film_bead bead = {.trail = 0};
    begin(&motion, &table, NULL);
    double start[3][3];
    fst_film_motion_to(&motion, 0.0);
    fst_film_motion_bead(&motion, &bead);
    memcpy(start, bead.turn, sizeof start);
    for (int i = 0; i < 3; ++i)
        CHECK_CLOSE(start[i][2], N0[i], 1e-14);
    for (int step = 0; step <= 160; ++step) {
        const double part = step / 160.0;
        const int between = step % 2;
        fst_film_motion_to(&motion, TURNS * part);
        fst_film_motion_bead(&motion, &bead);
        double(*turn)[3] = bead.turn;
        for (int k = 0; k < 3; ++k) {
            const double before[3] = {start[0][k], start[1][k], start[2][k]};
            double now[3];
            turned(before, RATE * TIME * part, now);
            for (int i = 0; i < 3; ++i)
                CHECK_CLOSE(turn[i][k], now[i], between ? 2e-3 : 1e-11);
        }
        for (int i = 0; i < 3; ++i) {
            const int j = (i + 1) % 3, k = (i + 2) % 3;
            CHECK_CLOSE(turn[j][0] * turn[k][1] - turn[k][0] * turn[j][1], turn[i][2], 1e-13);
        }
    }
    fst_table_free(&table);
}

/* Bead and magnet are shown where they are at that moment, not where the sample before had them. */
static void test_places_between_samples(void **state)
{
    (void)state;
    fst_table table = table_of_turning(0.0, 1.0);
    fst_film_cast cast;
    fst_error error = {FST_OK, "", ""};
    const fst_film_options options = fst_default_film_options();
    const double mm = 1e3 * table.params.magnet_half_length;
    assert_int_equal(fst_film_cast_one(&cast, &table, &options, &error), FST_OK);
    for (int step = 0; step <= 333; ++step) {
        fst_film_frame frame = {.clock = NULL};
        const double part = step / 333.0;
        fst_film_cast_to(&cast, TURNS * part, &frame);
        assert_int_equal(frame.count, 1);
        CHECK_CLOSE(frame.beads[0].place[0], mm * (0.5 + 0.25 * part), 1e-9);
        CHECK_CLOSE(frame.beads[0].place[1], mm * (-1.0 + 2.0 * part), 1e-9);
        CHECK_CLOSE(frame.beads[0].place[2], frame.beads[0].radius, 0.0);
        const double angle = 6.283185307179586476925287 * TURNS * part;
        CHECK_CLOSE(cos(frame.magnet_angle), cos(angle), 1e-9);
        CHECK_CLOSE(sin(frame.magnet_angle), sin(angle), 1e-9);
    }
    fst_film_cast_free(&cast);
    fst_table_free(&table);
}

/* Ranges of colours: symmetric about zero for both signs, from zero where the least value is close to it, from
 * -1 to 1 for n_z. */
static void test_ranges_of_colours(void **state)
{
    (void)state;
    static const struct {
        double from, to, low, high;
        int both_signs;
    } cases[] = {{-0.2, 0.7, -0.7, 0.7, 1},
                 {-0.9, 0.3, -0.9, 0.9, 1},
                 {0.1, 1.0, 0.0, 1.0, 0},
                 {0.5, 1.0, 0.5, 1.0, 0},
                 {-1.0, -0.5, -1.0, -0.5, 0}};
    for (size_t i = 0; i < sizeof cases / sizeof *cases; ++i) {
        fst_table table = table_of_turning(cases[i].from, cases[i].to);
        fst_film_motion motion;
        begin(&motion, &table, "slip");
        CHECK_CLOSE(motion.low, cases[i].low, 1e-14);
        CHECK_CLOSE(motion.high, cases[i].high, 1e-14);
        assert_int_equal(motion.both_signs, cases[i].both_signs);
        begin(&motion, &table, "n_z");
        CHECK_CLOSE(motion.low, -1.0, 0.0);
        CHECK_CLOSE(motion.high, 1.0, 0.0);
        fst_table_free(&table);
    }
}

/* ------------------------------------------------------------------ frames */

enum { PICTURE_ROOM = 1 << 20 };

/* The first frame of a film, as PNG. */
static size_t first_frame(const fst_table *table, unsigned char *picture)
{
    char folder[] = "/tmp/festoon-film-XXXXXX", frames[64], name[128];
    fst_film_options options = fst_default_film_options();
    fst_error error = {FST_OK, "", ""};
    assert_non_null(mkdtemp(folder));
    (void)snprintf(frames, sizeof frames, "%s/frames", folder);
    options.width = options.height = 200;
    options.fps = 1.0;
    const fst_status status = fst_film(table, frames, &options, &error);
    if (status == FST_UNAVAILABLE) {
        assert_int_equal(rmdir(folder), 0);
        skip();
    }
    if (status != FST_OK)
        fail_msg("%s", error.sentence);
    (void)snprintf(name, sizeof name, "%s/frame-00001.png", frames);
    FILE *file = fopen(name, "rb");
    assert_non_null(file);
    const size_t size = fread(picture, 1, PICTURE_ROOM, file);
    assert_int_equal(fclose(file), 0);
    (void)snprintf(name, sizeof name, "rm -r %s", folder);
    assert_int_equal(system(name), 0);
    return size;
}

/* The magnet that is painted is the bar of lines, as wide as it is.  Of another source the outline is not
 * known, and nothing is painted. */
static void test_only_the_bar_of_lines_is_painted(void **state)
{
    (void)state;
    unsigned char *pictures[2] = {test_malloc(PICTURE_ROOM), test_malloc(PICTURE_ROOM)};
    for (int bar = 0; bar < 2; ++bar) {
        size_t size[2];
        for (int wide = 0; wide < 2; ++wide) {
            fst_table table = table_of_turning(0.0, 1.0);
            table.params.magnet_width = wide ? 0.04 : 0.02;
            table.params.magnet_shape = bar ? (int)FST_MAGNET_LINES : (int)FST_MAGNET_SHAPES;
            size[wide] = first_frame(&table, pictures[wide]);
            fst_table_free(&table);
        }
        const int same = size[0] == size[1] && memcmp(pictures[0], pictures[1], size[0]) == 0;
        assert_int_equal(same, !bar);
    }
    test_free(pictures[0]);
    test_free(pictures[1]);
}

/* ------------------------------------------------------------------ files */

static void put_number(unsigned char *at, size_t value)
{
    for (int i = 0; i < 4; ++i)
        at[i] = (unsigned char)(value >> (24 - 8 * i));
}

/* Make everything from `start` on a box of the mp4 format: its first bytes were left free for the box's head.
 */
static void close_box(unsigned char *bytes, size_t start, size_t end, const char *type)
{
    put_number(bytes + start, end - start);
    memcpy(bytes + start + 4, type, 4);
}

/* An mp4 whose table lists `pictures` pictures of ten bytes each, with `contents` bytes of contents; returns
 * its size. */
static size_t make_mp4(unsigned char *bytes, size_t pictures, size_t contents)
{
    static const char *const holders[] = {"moov", "trak", "mdia", "minf", "stbl"};
    enum { HEAD = 8, FTYP = 16, TABLE = FTYP + 5 * HEAD };
    memset(bytes, 0, 1024);
    close_box(bytes, 0, FTYP, "ftyp");
    put_number(bytes + TABLE + 16, pictures);
    size_t end = TABLE + 20;
    for (size_t i = 0; i < pictures; ++i, end += 4)
        put_number(bytes + end, 10);
    close_box(bytes, TABLE, end, "stsz");
    for (size_t i = 0; i < 5; ++i)
        close_box(bytes, FTYP + i * HEAD, end, holders[i]);
    close_box(bytes, end, end + HEAD + contents, "mdat");
    return end + HEAD + contents;
}

static void check_film(const unsigned char *bytes, size_t size, const char *problem)
{
    char path[] = "/tmp/festoon-film-XXXXXX";
    fst_error error = {FST_OK, "", ""};
    const int descriptor = mkstemp(path);
    assert_true(descriptor >= 0);
    assert_int_equal(write(descriptor, bytes, size), (ssize_t)size);
    assert_int_equal(close(descriptor), 0);
    const fst_status status = fst_film_file_check(path, "mp4", 12, "film.mp4", &error);
    assert_int_equal(unlink(path), 0);
    assert_int_equal(status, problem ? FST_IO : FST_OK);
    if (problem)
        CHECK_CONTAINS(error.sentence, problem);
}

static void test_films_are_whole(void **state)
{
    (void)state;
    static unsigned char bytes[1024];
    const size_t size = make_mp4(bytes, 12, 120);
    check_film(bytes, size, NULL);
    for (size_t cut = 1; cut < 128; cut += 9)
        check_film(bytes, size - cut, "it is cut short");
    check_film(bytes, size - 128, "the pictures themselves are missing");
    check_film(bytes, make_mp4(bytes, 12, 119), "the pictures themselves are missing");
    check_film(bytes, make_mp4(bytes, 11, 120), "pictures are missing");
    check_film(bytes, make_mp4(bytes, 13, 130), "pictures are missing");
    check_film(bytes, 16, "it has no index");
    check_film(bytes, 0, "it is empty");
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_the_body_turns_with_the_bead),
        cmocka_unit_test(test_places_between_samples),
        cmocka_unit_test(test_ranges_of_colours),
        cmocka_unit_test(test_films_are_whole),
        cmocka_unit_test(test_only_the_bar_of_lines_is_painted),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
