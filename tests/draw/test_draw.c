/* test_draw.c - figures: whole or not at all, redrawn by their scripts, and failures that say what to do.
 *
 * Pictures are looked at by people; here is tested what a machine can tell of them.
 * tests: draw/figure_file.c draw/figure_trajectory.c draw/figure_branch.c draw/figure_field.c
 *   draw/figure_setup.c draw/chart.c draw/gnuplot.c draw/legend.c draw/style.c draw/view.c
 *   draw/figure_local.c draw/figure_radius_field.c */
#include "numeric.h"

#include <dirent.h>
#include <stdio.h>
#include <stdlib.h>
#include <sys/stat.h>
#include <unistd.h>

#include <festoon/charts.h>
#include "draw/gnuplot.h"
#include "draw/legend.h"
#include "draw/view.h"
#include <festoon/festoon_tools.h>

static char directory[64];
static char *path_before;

/* ------------------------------------------------------------------ a trajectory made by hand */

enum { ROWS = 400 };

/* Four festoons, and something smooth in every column. */
static fst_table make_table(void)
{
    fst_table table = {.rows = ROWS, .params = fst_default_params(), .complete = 1};
    table.columns = calloc((size_t)fst_column_count(), sizeof *table.columns);
    assert_non_null(table.columns);
    table.params.run_discard = 0.0;
    for (int i = 0; i < fst_column_count(); i++) {
        const char *name = fst_column_at(i)->name;
        table.columns[i] = malloc(ROWS * sizeof *table.columns[i]);
        assert_non_null(table.columns[i]);
        for (int row = 0; row < ROWS; row++) {
            double turn = 6.3 * row / ROWS, alpha = -turn, r = 0.9 + 0.1 * cos(4.0 * turn);
            double value = !strcmp(name, "drive_turns") ? 3.0 * row / ROWS
                           : !strcmp(name, "alpha")     ? alpha
                           : !strcmp(name, "Phi")       ? alpha - 3.0 * turn
                           : !strcmp(name, "omega")     ? 0.215
                           : !strcmp(name, "x")         ? r * cos(alpha)
                           : !strcmp(name, "y")         ? r * sin(alpha)
                           : !strcmp(name, "r")         ? r
                                                        : sin(2.0 * turn + i);
            table.columns[i][row] = value;
        }
    }
    return table;
}

static void free_table(fst_table *table)
{
    for (int i = 0; i < fst_column_count(); i++)
        free(table->columns[i]);
    free(table->columns);
}

/* ------------------------------------------------------------------ files */

static const char *inside(const char *name)
{
    static char path[512];
    (void)snprintf(path, sizeof path, "%s/%s", directory, name);
    return path;
}

static int exists(const char *name)
{
    return access(inside(name), F_OK) == 0;
}

static char *contents(const char *name, size_t *size)
{
    FILE *file = fopen(inside(name), "rb");
    assert_non_null(file);
    char *bytes = malloc(1 << 22);
    assert_non_null(bytes);
    *size = fread(bytes, 1, (1 << 22) - 1, file);
    bytes[*size] = '\0';
    (void)fclose(file);
    return bytes;
}

/* Removes everything in the directory; a leftover of a half-made file is an error. */
static int clear_directory(void **state)
{
    (void)state;
    (void)setenv("PATH", path_before, 1);
    DIR *entries = opendir(directory);
    assert_non_null(entries);
    int leftovers = 0;
    for (struct dirent *entry; (entry = readdir(entries)) != NULL;) {
        leftovers += strstr(entry->d_name, ".part") != NULL;
        if (entry->d_name[0] != '.' || strstr(entry->d_name, ".part"))
            (void)remove(inside(entry->d_name));
    }
    (void)closedir(entries);
    assert_int_equal(leftovers, 0);
    return 0;
}

/* Puts a program called gnuplot first on PATH that does something else. */
static void pretend_gnuplot(const char *body)
{
    FILE *file = fopen(inside("gnuplot"), "w");
    assert_non_null(file);
    (void)fprintf(file, "#!/bin/sh\n%s\n", body);
    (void)fclose(file);
    assert_int_equal(chmod(inside("gnuplot"), 0700), 0);
    char path[512];
    (void)snprintf(path, sizeof path, "%s:%s", directory, path_before);
    (void)setenv("PATH", path, 1);
}

/* ------------------------------------------------------------------ tests */

static void every_kind_in_every_format(void **state)
{
    (void)state;
    static const fst_figure_kind kinds[] = {FST_FIGURE_PATH, FST_FIGURE_LOCAL_N, FST_FIGURE_RADIUS_FIELD,
                                            FST_FIGURE_TIME, FST_FIGURE_SECTION};
    enum { KINDS = sizeof kinds / sizeof kinds[0] };
    static const char *const endings[] = {"svg", "pdf", "png"}, *const marks[] = {"<?xml", "%PDF", "\x89PNG"};
    fst_table table = make_table();
    fst_error error = {.code = FST_OK};
    for (int k = 0; k < KINDS; k++) {
        for (int e = 0; e < 3; e++) {
            fst_figure_options options = fst_default_figure_options();
            options.kind = kinds[k];
            char name[64];
            (void)snprintf(name, sizeof name, "kind%d.%s", k, endings[e]);
            fst_status status = fst_figure_trajectory(&table, inside(name), &options, &error);
            if (status != FST_OK)
                fail_msg("%s: %s", error.where, error.sentence);
            size_t size;
            char *bytes = contents(name, &size);
            assert_memory_equal(bytes, marks[e], strlen(marks[e]));
            free(bytes);
        }
    }
    assert_true(exists("kind0.gp") && exists("kind0.dat"));
    free_table(&table);
}

/* The outline in a figure is that of the bar of lines: the data hang on its width.  Of another source it is not
 * known, and not drawn. */
static void only_the_bar_of_lines_is_drawn(void **state)
{
    (void)state;
    for (int bar = 0; bar < 2; bar++) {
        char *data[2];
        size_t size[2];
        for (int wide = 0; wide < 2; wide++) {
            fst_table table = make_table();
            fst_figure_options options = fst_default_figure_options();
            table.params.magnet_width = wide ? 0.06 : 0.03;
            table.params.magnet_shape = bar ? (int)FST_MAGNET_LINES : (int)FST_MAGNET_SHAPES;
            assert_int_equal(fst_figure_trajectory(&table, inside("bar.svg"), &options, NULL), FST_OK);
            data[wide] = contents("bar.dat", &size[wide]);
            free_table(&table);
        }
        assert_int_equal(strcmp(data[0], data[1]) != 0, bar);
        assert_int_equal(strstr(data[0], "magnet") != NULL, bar);
        free(data[0]);
        free(data[1]);
    }
}

/* Lines of words end at blanks, but not between a number and its unit or its error. */
static void no_line_ends_inside_a_number(void **state)
{
    (void)state;
    static const double x[] = {0.0, 1.0};
    const fst_chart_curve curve = {.x = x, .y = x, .count = 2};
    const fst_chart_panel panel = {
        .left_label = "r (mm)", .low = NAN, .high = NAN, .curves = &curve, .curve_count = 1};
    const fst_chart chart = {
        .title = "The track of the bead",
        .about = "⟨r⟩ = 17.621 ± 0.0055 mm, δr = 3.851 ± 0.0031 mm, bead -3.3586 Hz, N = 4.1858",
        .x_label = "time (s)",
        .x_high = 1.0,
        .panels = &panel,
        .panel_count = 1};
    size_t size;
    assert_int_equal(fst_figure_chart(inside("lines.svg"), &chart, NULL), FST_OK);
    char *script = contents("lines.gp", &size);
    assert_non_null(strstr(script, "'-3.3586 Hz, N = 4.1858'"));
    free(script);
}

static void the_script_draws_the_figure_again(void **state)
{
    (void)state;
    fst_table table = make_table();
    fst_figure_options options = fst_default_figure_options();
    options.title = "100 % 'quoted' {text}_^@ \\n";
    options.colour = "slip";
    /* A file name with every character that a shell or gnuplot might interpret. */
    assert_int_equal(fst_figure_trajectory(&table, inside("-it's a $(figure).svg"), &options, NULL), FST_OK);
    FILE *other = fopen(inside("it's again.svg"), "w");
    assert_non_null(other);
    assert_int_equal(fst_gnuplot_run(directory, "-it's a $(figure).gp", "-it's a $(figure).dat", other, NULL),
                     FST_OK);
    assert_int_equal(fclose(other), 0);
    size_t size, size_again;
    char *first = contents("-it's a $(figure).svg", &size);
    char *again = contents("it's again.svg", &size_again);
    assert_int_equal(size, size_again);
    assert_memory_equal(first, again, size);
    assert_non_null(strstr(first, "quoted"));
    free(first);
    free(again);
    free_table(&table);
}

static void bad_requests_say_what_is_wrong(void **state)
{
    (void)state;
    fst_table table = make_table();
    fst_error error;
    fst_figure_options options = fst_default_figure_options();
    static const char *const names[] = {"figure.jpg", "figure", ".svg", "svg"};
    for (size_t i = 0; i < sizeof names / sizeof names[0]; i++) {
        assert_int_equal(fst_figure_trajectory(&table, inside(names[i]), &options, &error), FST_BAD_INPUT);
        assert_non_null(strstr(error.sentence, ".svg, .pdf or .png"));
        assert_false(exists(names[i]));
    }
    options.colour = "slop";
    assert_int_equal(fst_figure_trajectory(&table, inside("a.svg"), &options, &error), FST_BAD_INPUT);
    assert_non_null(strstr(error.sentence, "the nearest is slip"));

    options = fst_default_figure_options();
    options.zoom[0] = options.zoom[1] = options.zoom[2] = options.zoom[3] = 1.0;
    assert_int_equal(fst_figure_trajectory(&table, inside("a.svg"), &options, &error), FST_BAD_INPUT);

    options = fst_default_figure_options();
    options.from = 1e6;
    assert_int_equal(fst_figure_trajectory(&table, inside("a.svg"), &options, &error), FST_BAD_INPUT);

    options.cookie = 0;
    assert_int_equal(fst_figure_trajectory(&table, inside("a.svg"), &options, &error), FST_BAD_INPUT);
    assert_int_equal(fst_figure_trajectory(&table, "/nowhere/at/all/a.svg", NULL, &error), FST_IO);
    assert_false(exists("a.svg"));
    free_table(&table);
}

static void without_gnuplot_the_package_is_named(void **state)
{
    (void)state;
    fst_table table = make_table();
    fst_error error;
    (void)setenv("PATH", "/nowhere", 1);
    assert_int_equal(fst_figure_trajectory(&table, inside("a.svg"), NULL, &error), FST_UNAVAILABLE);
    assert_non_null(strstr(error.sentence, "gnuplot-nox"));
    assert_false(exists("a.svg"));
    free_table(&table);
}

static void a_failing_gnuplot_leaves_the_old_figure(void **state)
{
    (void)state;
    fst_table table = make_table();
    fst_error error;
    assert_int_equal(fst_figure_trajectory(&table, inside("a.svg"), NULL, NULL), FST_OK);
    size_t size, size_after;
    char *before = contents("a.svg", &size);

    pretend_gnuplot("echo 'line 3: no such thing' >&2; exit 1");
    assert_int_equal(fst_figure_trajectory(&table, inside("a.svg"), NULL, &error), FST_IO);
    assert_non_null(strstr(error.sentence, "no such thing"));
    pretend_gnuplot("kill -9 $$");
    assert_int_equal(fst_figure_trajectory(&table, inside("a.svg"), NULL, &error), FST_IO);
    /* This gnuplot reports success and has written nothing, which is what a full disk looks like. */
    pretend_gnuplot("exit 0");
    assert_int_equal(fst_figure_trajectory(&table, inside("a.svg"), NULL, &error), FST_IO);

    char *after = contents("a.svg", &size_after);
    assert_int_equal(size, size_after);
    assert_memory_equal(before, after, size);
    free(before);
    free(after);
    free_table(&table);
}

/* A background process keeps gnuplot's outputs open: festoon must not wait for it. */
static void much_output_does_not_block(void **state)
{
    (void)state;
    fst_error error;
    pretend_gnuplot(
        "i=0; while [ $i -lt 3000 ]; do echo 'a line of some length, again and again' >&2; i=$((i+1)); done; "
        "cat; exit 1");
    FILE *other = fopen(inside("none.svg"), "w");
    assert_non_null(other);
    assert_int_equal(fst_gnuplot_run(directory, "none.gp", "none.dat", other, &error), FST_IO);
    assert_int_equal(fclose(other), 0);
    assert_non_null(strstr(error.sentence, "again and again"));
}

static void the_field_shows_its_maxima(void **state)
{
    (void)state;
    fst_params params = fst_default_params();
    fst_error error;
    fst_field_options options = {.quantity = FST_FIELD_STRENGTH, .height = NAN, .units = FST_SHOWN_SCALED};
    assert_int_equal(fst_figure_field_map(&params, &options, inside("field.svg"), &error), FST_BAD_INPUT);
    assert_non_null(strstr(error.sentence, "fst_default_field_options()"));
    assert_int_equal(fst_figure_field(&params, FST_SHOWN_SCALED, inside("field.svg"), NULL), FST_OK);
    size_t size;
    char *data = contents("field.dat", &size), *at = strstr(data, "# maxima");
    assert_non_null(at);
    double x[2], y[2];
    at = strchr(strchr(at, '\n') + 1, '\n');
    assert_int_equal(sscanf(at, "%lf %lf %lf %lf", &x[0], &y[0], &x[1], &y[1]), 4);
    /* The paper fits the model so that they are 41 mm apart. */
    assert_true(fabs(23.0 * hypot(x[0] - x[1], y[0] - y[1]) - 41.0) < 0.6);
    free(data);
}

static void a_curve_breaks_where_it_is_not_a_number(void **state)
{
    (void)state;
    const double x[] = {0, 1, 2, 3, 4, 5}, y[] = {0, 1, NAN, NAN, 4, 5};
    fst_chart_curve curve = {.title = "curve", .x = x, .y = y, .count = 6, .colour = FST_COLOUR_BLUE};
    fst_chart_panel panel = {.left_label = "y", .low = NAN, .high = NAN, .curves = &curve, .curve_count = 1};
    fst_chart chart = {.title = "a chart", .x_label = "x", .x_high = 5.0, .panels = &panel, .panel_count = 1};
    assert_int_equal(fst_figure_chart(inside("chart.svg"), &chart, NULL), FST_OK);
    size_t size;
    char *data = contents("chart.dat", &size);
    assert_non_null(strstr(data, "0 0\n1 1\n\n4 4\n5 5\n"));
    free(data);
}

static void an_axis_of_equal_values_has_numbers_that_differ(void **state)
{
    (void)state;
    const double x[] = {0, 1, 2}, y[] = {0.607179, 0.607179 + 1e-11, 0.607179 - 1e-11};
    fst_chart_curve curve = {.title = "curve", .x = x, .y = y, .count = 3, .colour = FST_COLOUR_BLUE};
    fst_chart_panel panel = {.left_label = "y", .low = NAN, .high = NAN, .curves = &curve, .curve_count = 1};
    fst_chart chart = {.title = "a chart", .x_label = "x", .x_high = 2.0, .panels = &panel, .panel_count = 1};
    assert_int_equal(fst_figure_chart(inside("chart.svg"), &chart, NULL), FST_OK);
    size_t size;
    char *script = contents("chart.gp", &size), *range = strstr(script, "set yrange [");
    double low, high;
    assert_non_null(range);
    assert_int_equal(sscanf(range, "set yrange [%lf:%lf]", &low, &high), 2);
    assert_true(low < 0.6 && high > 0.61);
    free(script);
}

/* Hermite's interpolation is exact for cubics, and its error on a sine falls as h^4. */
static void between_samples_the_path_is_smooth(void **unused)
{
    (void)unused;
    for (int i = 0; i <= 10; i++) {
        double t = 0.7 * i / 10.0, cubic = ((2.0 * t - 3.0) * t + 0.5) * t + 1.0;
        double there = fst_view_between(1.0, 0.5, ((1.4 - 3.0) * 0.7 + 0.5) * 0.7 + 1.0,
                                        (4.2 - 6.0) * 0.7 + 0.5, 0.7, i / 10.0);
        assert_true(fabs(there - cubic) < 1e-14);
    }
    double error[2];
    for (int i = 0; i < 2; i++) {
        double h = i ? 0.1 : 0.2;
        error[i] =
            fabs(fst_view_between(sin(1.0), cos(1.0), sin(1.0 + h), cos(1.0 + h), h, 0.5) - sin(1.0 + 0.5 * h));
    }
    assert_true(error[0] / error[1] > 14.0 && error[0] / error[1] < 18.0);
}

static void units_have_their_symbols(void **unused)
{
    (void)unused;
    static const char *const pairs[][2] = {
        {"l^2 gamma^3", "ℓ²γ³"}, {"1/gamma", "1/γ"}, {"B0", "B₀"}, {"deg", "°"}, {"rad", "rad"}, {"", ""}};
    char text[32];
    for (size_t i = 0; i < sizeof pairs / sizeof pairs[0]; i++) {
        fst_unit_symbols(pairs[i][0], text, sizeof text);
        assert_string_equal(text, pairs[i][1]);
    }
    char tight[4]; /* the text must not overrun it */
    fst_unit_symbols("1/gamma", tight, sizeof tight);
    assert_true(strlen(tight) < sizeof tight);
}

/* A long title takes lines, none of which is longer than the figure is wide, and no word of it is lost; the
 * panels begin below it. */
static void long_titles_take_lines(void **state)
{
    (void)state;
    const double x[] = {0, 1}, y[] = {0, 1};
    fst_chart_curve curve = {.title = "curve", .x = x, .y = y, .count = 2, .colour = FST_COLOUR_BLUE};
    fst_chart_curve empty = {.title = "nothing", .x = x, .y = y, .count = 0, .colour = FST_COLOUR_GREEN};
    fst_chart_curve curves[] = {curve, empty, curve};
    fst_chart_panel panel = {
        .left_label = "an ordinate", .low = NAN, .high = NAN, .curves = curves, .curve_count = 3};
    fst_chart chart = {
        .title = "This is a title that says a great deal about what the figure shows and of which bead",
        .x_label = "x",
        .x_high = 1.0,
        .panels = &panel,
        .panel_count = 1};
    assert_int_equal(fst_figure_chart(inside("title.svg"), &chart, NULL), FST_OK);
    size_t size;
    char *script = contents("title.gp", &size), joined[512] = "";
    int lines = 0, keyed = 0;
    for (char *at = script; (at = strstr(at, "set label '")) != NULL;) {
        at += strlen("set label '");
        const size_t length = strcspn(at, "'");
        assert_true(8.0 * (double)length < FST_FIGURE_WIDTH);
        if (strstr(at, "font ',15'") && strstr(at, "font ',15'") < strchr(at, '\n')) {
            (void)snprintf(joined + strlen(joined), sizeof joined - strlen(joined), "%s%.*s",
                           lines++ ? " " : "", (int)length, at);
        }
        keyed += strncmp(at, "curve'", 6) == 0;
        assert_true(strncmp(at, "nothing'", 8) != 0); /* a curve without a point is not in the key */
    }
    assert_string_equal(joined, chart.title);
    assert_int_equal(lines, 2);
    assert_int_equal(keyed, 1); /* two curves of one name and style are one entry */
    free(script);
}

/* The sketch names every angle that the model speaks of, and has the bar's true size. */
static void the_sketch_names_its_angles(void **state)
{
    (void)state;
    static const char *const words[] = {"φ", "θ", "Φ", "ω", "56 × 40 × 9 mm", "16.2 mm", "plate", "its model"};
    const fst_params params = fst_default_params();
    assert_int_equal(fst_figure_sketch(&params, inside("sketch.svg"), NULL), FST_OK);
    size_t size;
    char *picture = contents("sketch.svg", &size);
    for (size_t i = 0; i < sizeof words / sizeof words[0]; i++)
        if (!strstr(picture, words[i]))
            fail_msg("the sketch lacks %s", words[i]);
    free(picture);
    char *data = contents("sketch.dat", &size), *at = strstr(data, "# magnet-above");
    double corner[4];
    assert_non_null(at);
    at = strchr(strchr(at, '\n') + 1, '\n');
    assert_int_equal(sscanf(at, "%lf %lf %lf %lf", &corner[0], &corner[1], &corner[2], &corner[3]), 4);
    assert_true(fabs(hypot(corner[2] - corner[0], corner[3] - corner[1]) - 56.0) < 1e-3);
    free(data);
}

/* A cubic through points on a circle is ever closer to it, at least as the third power of their distance. */
static void smooth_curves_converge(void **state)
{
    (void)state;
    double worst[2] = {0.0, 0.0};
    for (int fine = 0; fine < 2; fine++) {
        enum { MOST = 33, PARTS = 8 };
        const size_t count = fine ? 33 : 17;
        double x[MOST], y[MOST], to_x[MOST * PARTS], to_y[MOST * PARTS];
        for (size_t i = 0; i < count; i++) {
            const double turned = 3.0 * pow((double)i / (double)(count - 1), 1.3); /* distances differ */
            x[i] = 5.0 * cos(turned);
            y[i] = 0.2 * sin(turned);
        }
        const size_t drawn = fst_smooth(x, y, count, PARTS, 5.0, 0.2, to_x, to_y);
        assert_int_equal(drawn, PARTS * (count - 1) + 1);
        for (size_t i = 0; i < drawn; i++)
            worst[fine] = fmax(worst[fine], fabs(hypot(to_x[i] / 5.0, to_y[i] / 0.2) - 1.0));
        for (size_t i = 0; i < count; i++)
            assert_true(to_x[PARTS * i] == x[i] && to_y[PARTS * i] == y[i]);
    }
    assert_true(worst[0] < 1e-3 && worst[0] > 7.0 * worst[1]);
}

/* A relaxation time that diverges at the end of a branch: the long last piece does not bulge beyond its ends.
 */
static void smooth_curves_do_not_bulge(void **state)
{
    (void)state;
    enum { PARTS = 8, COUNT = 5 };
    const double x[COUNT] = {9.0, 8.5, 8.0, 7.7, 7.6}, y[COUNT] = {1.0, 1.2, 2.0, 6.0, 5600.0};
    double to_x[COUNT * PARTS], to_y[COUNT * PARTS];
    const size_t drawn = fst_smooth(x, y, COUNT, PARTS, 25.0, 5600.0, to_x, to_y);
    assert_int_equal(drawn, PARTS * (COUNT - 1) + 1);
    for (size_t i = 0; i < drawn; i++)
        assert_true(to_x[i] >= 7.6 && to_x[i] <= 9.0 && to_y[i] >= 0.99 && to_y[i] <= 5600.0);
}

/* The units of a laboratory: the paper's numbers (l = 23 mm, gamma = 312.5 1/s, 0.5 g). */
/* Outside programs draw with the same words, units and colours. */
static void words_and_colours_for_others(void **state)
{
    (void)state;
    for (int r = 0; r < FST_REGIME_COUNT; ++r) {
        const fst_look look = fst_regime_look((fst_regime)r);
        assert_string_equal(look.words, fst_regime_name((fst_regime)r));
        assert_int_equal(strlen(look.colour), strlen("#009e73"));
        for (int other = 0; other < r; ++other)
            assert_string_not_equal(look.colour, fst_regime_look((fst_regime)other).colour);
    }
    for (int type = 0; type < FST_SPECIAL_COUNT; ++type)
        assert_non_null(fst_special_look((fst_special_type)type).words);
    assert_null(fst_regime_look((fst_regime)-1).words);
    assert_null(fst_special_look(FST_SPECIAL_COUNT).words);
    fst_branch_point point = {.mean_r = 0.75};
    int found = 0;
    for (int i = 0; fst_branch_observable_at(i); ++i) {
        const fst_observable_info *info = fst_branch_observable_at(i);
        found += strcmp(info->name, "mean_r") == 0 &&
                 *(const double *)(const void *)((const char *)&point + info->offset) == 0.75;
    }
    assert_int_equal(found, 1);
    const fst_params bead = fst_default_params();
    const fst_scales scales = fst_scales_of(&bead);
    const fst_quantity radius = fst_quantity_of_result("mean_r", "l", FST_SHOWN_LAB, &scales);
    assert_string_equal(radius.label, "mean radius ⟨r⟩ (mm)");
    assert_true(fabs(radius.factor - 23.0) < 1e-12);
}

static void units_of_the_laboratory(void **state)
{
    (void)state;
    const fst_params params = fst_default_params();
    const fst_scales scales = fst_scales_of(&params);
    static const struct {
        const char *unit, *lab, *si;
        double in_lab, in_si;
    } wanted[] = {{"l", "mm", "m", 23.0, 0.023},
                  {"1/gamma", "s", "s", 3.2e-3, 3.2e-3},
                  {"l gamma", "mm/s", "m/s", 7187.5, 7.1875},
                  {"l gamma^2", "mN", "N", 1123.046875, 1.123046875},
                  {"l^2 gamma^2", "uJ", "J", 25830.078125, 0.025830078125},
                  {"l^2 gamma^3", "mW", "W", 8071.8994140625, 8.0718994140625},
                  {"B0", "B0", "B0", 1.0, 1.0}, /* no moment is given, so B0 is not known in tesla */
                  {"deg", "deg", "deg", 1.0, 1.0}};
    assert_true(isnan(scales.field));
    for (size_t i = 0; i < sizeof wanted / sizeof wanted[0]; i++) {
        const char *name;
        assert_true(fabs(fst_unit_shown(wanted[i].unit, FST_SHOWN_LAB, &scales, &name) / wanted[i].in_lab -
                         1.0) < 1e-12);
        assert_string_equal(name, wanted[i].lab);
        assert_true(fabs(fst_unit_shown(wanted[i].unit, FST_SHOWN_SI, &scales, &name) / wanted[i].in_si - 1.0) <
                    1e-12);
        assert_string_equal(name, wanted[i].si);
        assert_true(fst_unit_shown(wanted[i].unit, FST_SHOWN_SCALED, &scales, &name) == 1.0);
        assert_string_equal(name, wanted[i].unit);
    }
}

int main(void)
{
    if (system("gnuplot --version >/dev/null 2>&1") != 0)
        return 77;
    path_before = strdup(getenv("PATH"));
    (void)snprintf(directory, sizeof directory, "/tmp/festoon-draw-XXXXXX");
    if (!path_before || !mkdtemp(directory))
        return 1;
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(between_samples_the_path_is_smooth),
        cmocka_unit_test(units_have_their_symbols),
        cmocka_unit_test(units_of_the_laboratory),
        cmocka_unit_test(words_and_colours_for_others),
        cmocka_unit_test(smooth_curves_converge),
        cmocka_unit_test(smooth_curves_do_not_bulge),
        cmocka_unit_test_teardown(long_titles_take_lines, clear_directory),
        cmocka_unit_test_teardown(the_sketch_names_its_angles, clear_directory),
        cmocka_unit_test_teardown(every_kind_in_every_format, clear_directory),
        cmocka_unit_test_teardown(only_the_bar_of_lines_is_drawn, clear_directory),
        cmocka_unit_test_teardown(the_script_draws_the_figure_again, clear_directory),
        cmocka_unit_test_teardown(bad_requests_say_what_is_wrong, clear_directory),
        cmocka_unit_test_teardown(without_gnuplot_the_package_is_named, clear_directory),
        cmocka_unit_test_teardown(a_failing_gnuplot_leaves_the_old_figure, clear_directory),
        cmocka_unit_test_teardown(much_output_does_not_block, clear_directory),
        cmocka_unit_test_teardown(no_line_ends_inside_a_number, clear_directory),
        cmocka_unit_test_teardown(the_field_shows_its_maxima, clear_directory),
        cmocka_unit_test_teardown(a_curve_breaks_where_it_is_not_a_number, clear_directory),
        cmocka_unit_test_teardown(an_axis_of_equal_values_has_numbers_that_differ, clear_directory),
    };
    int failed = cmocka_run_group_tests(tests, NULL, NULL);
    (void)rmdir(directory);
    free(path_before);
    return failed;
}
