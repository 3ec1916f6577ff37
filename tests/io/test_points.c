/* The table of measured points: what is written is read back to the same bits, in any order, unit and spelling;
 * and whatever is wrong in a table is refused with its line and column.
 * tests: measure/points.c
 * labels: memcheck */
#include "numeric.h"

#include <stdio.h>
#include <stdlib.h>
#include <unistd.h>

#include <festoon/festoon_tools.h>

static char path[] = "/tmp/festoon-points-XXXXXX";

static void write_text(const char *text)
{
    FILE *file = fopen(path, "w");
    assert_non_null(file);
    (void)fputs(text, file);
    (void)fclose(file);
}

static void assert_same(double a, double b)
{
    if (isnan(a) || isnan(b))
        assert_true(isnan(a) && isnan(b));
    else
        assert_true(a == b);
}

static void test_written_table_is_read_back(void **state)
{
    (void)state;
    /* Values whose decimal form in millimetres would round twice are among them. */
    fst_point rows[300];
    uint64_t seed = 12345;
    for (int i = 0; i < 300; ++i) {
        double part[8];
        for (int k = 0; k < 8; ++k) {
            seed = seed * 6364136223846793005u + 1442695040888963407u;
            part[k] = (double)(seed >> 11) / 9007199254740992.0 + 1e-3;
        }
        rows[i] = (fst_point){8.0 + 12.0 * part[0],
                              i % 3 ? part[1] * 0.01 : NAN,
                              {0.02 * part[2], i % 5 ? 1e-4 * part[3] : NAN, -3.0 * part[4]},
                              {1e-5 * part[5], i % 5 ? 1e-7 * part[6] : NAN, 1e-3 * part[7]},
                              i % 4 ? part[2] * 0.05 : NAN,
                              0};
    }
    fst_points written = {.rows = rows, .count = 300}, points;
    fst_error error;
    assert_int_equal(fst_points_write(path, &written, &error), FST_OK);
    assert_int_equal(fst_points_read(path, &points, &error), FST_OK);
    assert_int_equal(points.count, 300);
    for (size_t i = 0; i < points.count; ++i) {
        assert_same(points.rows[i].frequency, rows[i].frequency);
        assert_same(points.rows[i].frequency_error, rows[i].frequency_error);
        assert_same(points.rows[i].scale_error, rows[i].scale_error);
        for (int q = 0; q < FST_MEASURED_COUNT; ++q) {
            assert_same(points.rows[i].value[q], rows[i].value[q]);
            assert_same(points.rows[i].error[q], rows[i].error[q]);
        }
        assert_int_equal(points.rows[i].line, (int)i + 2);
    }
    fst_points_free(&points);
}

static void test_any_order_unit_and_spelling(void **state)
{
    (void)state;
    static const char *const tables[] = {
        "frequency [Hz],mean_r [mm],mean_r_error [mm]\n10,20,0.1\n",
        "\xEF\xBB\xBFmean_r_error [um], mean_r [cm] ,frequency [rpm]\r\n# a remark\r\n\r\n100,2,600\r\n",
        "mean_r [m];frequency [Hz];mean_r_error [mm]\n0,02;10,0;0,1\n",
        "mean_r [m]\tmean_r_error [\xC2\xB5m]\tfrequency [kHz]\n2e-2\t1e2\t0.01\n",
        "\"frequency [Hz]\",\"mean_r [mm]\",\"mean_r_error [mm]\"\n\"10\",\"20\",\"0.1\"",
    };
    for (size_t i = 0; i < sizeof tables / sizeof *tables; ++i) {
        fst_points points;
        fst_error error = {0};
        write_text(tables[i]);
        if (fst_points_read(path, &points, &error) != FST_OK)
            fail_msg("table %zu: %s: %s", i, error.where, error.sentence);
        assert_int_equal(points.count, 1);
        assert_true(fabs(points.rows[0].frequency - 10.0) < 1e-12);
        assert_true(fabs(points.rows[0].value[FST_MEASURED_MEAN_R] - 0.02) < 1e-15);
        assert_true(fabs(points.rows[0].error[FST_MEASURED_MEAN_R] - 1e-4) < 1e-17);
        assert_true(isnan(points.rows[0].value[FST_MEASURED_STD_R]));
        assert_int_equal(points.column[FST_MEASURED_STD_R], 0);
        fst_points_free(&points);
    }
}

/* A cell as a dialect writes it: with a decimal comma, which between commas stands in quotes. */
static void put_cell(char *text, size_t size, const char *cell, char separator, int comma)
{
    const size_t used = strlen(text);
    const char *quote = comma && separator == ',' ? "\"" : "";
    (void)snprintf(text + used, size - used, "%s%s%s", quote, cell, quote);
    for (char *point = strchr(text + used, '.'); point && comma; point = NULL)
        *point = ',';
}

/* tests/tracks/test_dialects.py does the same with maps, tracks and trajectories. */
static void test_every_dialect_is_read(void **state)
{
    (void)state;
    static const char separators[] = ",;\t ";
    static const char *const heads[] = {"%s [%s]", "%s (%s)", "%s/%s"}, *const marks[] = {"", "\xEF\xBB\xBF"},
                             *const ends[] = {"\n", "\r\n"},
                             *const names[] = {"frequency", "mean_r", "mean_r_error"},
                             *const units[] = {"Hz", "mm", "mm"}, *const cells[] = {"10.25", "20.125", "0.5"};
    for (int way = 0; way < 4 * 2 * 2 * 2 * 3; ++way) {
        const char separator = separators[way % 4], *end = ends[way / 8 % 2], *head = heads[way / 32];
        char text[400], one[80];
        fst_points points;
        fst_error error = {0};
        (void)snprintf(text, sizeof text, "%s# measured%s", marks[way / 16 % 2], end);
        for (int row = 0; row < 2; ++row)
            for (int c = 0; c < 3; ++c) {
                (void)snprintf(one, sizeof one, head, names[c], units[c]);
                put_cell(text, sizeof text, row ? cells[c] : one, separator, row && way / 4 % 2);
                (void)snprintf(one, sizeof one, "%s", c < 2 ? (char[]){separator, '\0'} : end);
                (void)strcat(text, one);
            }
        write_text(text);
        if (fst_points_read(path, &points, &error) != FST_OK)
            fail_msg("%s%s: %s", text, error.where, error.sentence);
        assert_int_equal(points.count, 1);
        assert_true(points.rows[0].frequency == 10.25);
        assert_true(points.rows[0].value[FST_MEASURED_MEAN_R] == 0.020125);
        assert_true(points.rows[0].error[FST_MEASURED_MEAN_R] == 0.0005);
        fst_points_free(&points);
    }
}

static void test_wrong_tables_are_refused(void **state)
{
    (void)state;
#define HEAD "frequency [Hz],mean_r [mm],mean_r_error [mm]\n"
    static const struct {
        const char *text;
        int line;
        const char *says;
    } wrong[] = {
        {"", 0, "empty"},
        {"mean_r [mm],mean_r_error [mm]\n1,2\n", 1, "frequency"},
        {"frequency [Hz],mean_r [mm]\n10,20\n", 1, "column 2 (mean_r)"},
        {"frequency [Hz],mean_r_error [mm]\n10,20\n", 1, "column 2 (mean_r_error)"},
        {"frequency [Hz]\n10\n", 1, "no column of a measured quantity"},
        {"frequency [Hz],mean_r [miles],mean_r_error [mm]\n10,20,1\n", 1, "column 2 (mean_r): \"miles\""},
        {"frequency [Hz],mean_r,mean_r_error [mm]\n10,20,1\n", 1, "column 2 (mean_r): has no unit"},
        {"frequency [Hz],mean_r [],mean_r_error [mm]\n10,20,1\n", 1, "column 2 (mean_r): has no unit"},
        {"frequency [mm],mean_r [mm],mean_r_error [mm]\n10,20,1\n", 1, "column 1 (frequency): \"mm\""},
        {"frequency [Hz],maen_r [mm],mean_r_error [mm]\n10,20,1\n", 1, "the nearest is mean_r"},
        {"frequency [Hz],mean_r [mm],mean_r [mm]\n10,20,1\n", 1,
         "column 3 (mean_r): this column is there twice"},
        {HEAD, 1, "no row"},
        {HEAD "10,20\n", 2, "column 3 (mean_r_error)"},
        {HEAD "10,20,1\n10,20,1,4\n", 3, "after column 3"},
        {HEAD "10,twenty,1\n", 2, "column 2 (mean_r): \"twenty\""},
        {HEAD "10,0x14,1\n", 2, "column 2 (mean_r)"},
        {HEAD "10,nan,1\n", 2, "column 2 (mean_r)"},
        {HEAD "10,1e400,1\n", 2, "too large"},
        {HEAD "10,20,0\n", 2, "column 3 (mean_r_error): \"0\" is not an error"},
        {HEAD "10,20,-1\n", 2, "column 3 (mean_r_error)"},
        {HEAD "10,20,\n", 2, "column 2 (mean_r): the error of this number is empty"},
        {HEAD "10,,1\n", 2, "column 2 (mean_r): the number is empty"},
        {HEAD ",20,1\n", 2, "frequency is empty"},
        {HEAD "0,20,1\n", 2, "column 1 (frequency)"},
        {HEAD "10,-20,1\n", 2, "column 2 (mean_r)"},
    };
    for (size_t i = 0; i < sizeof wrong / sizeof *wrong; ++i) {
        fst_points points;
        fst_error error = {0};
        char where[300];
        write_text(wrong[i].text);
        if (fst_points_read(path, &points, &error) != FST_BAD_INPUT)
            fail_msg("table %zu was read", i);
        if (!strstr(error.sentence, wrong[i].says))
            fail_msg("table %zu: \"%s\" does not say \"%s\"", i, error.sentence, wrong[i].says);
        (void)snprintf(where, sizeof where, wrong[i].line ? "%s:%d" : "%s", path, wrong[i].line);
        assert_string_equal(error.where, where);
        assert_null(points.rows);
    }
    fst_points points;
    fst_error error;
    assert_int_equal(fst_points_read("/there/is/no/such/file", &points, &error), FST_BAD_INPUT);
}

int main(void)
{
    const int descriptor = mkstemp(path);
    if (descriptor < 0)
        return 1;
    (void)close(descriptor);
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_written_table_is_read_back),
        cmocka_unit_test(test_any_order_unit_and_spelling),
        cmocka_unit_test(test_every_dialect_is_read),
        cmocka_unit_test(test_wrong_tables_are_refused),
    };
    const int failed = cmocka_run_group_tests(tests, NULL, NULL);
    (void)unlink(path);
    return failed;
}
