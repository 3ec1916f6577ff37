/* dry_maps.c - fst_paper_dry_maps(): what becomes of a bead that rubs dry, over the coefficient of friction and
 * the drive, from several starts.  Each map is a sweep with a database of its own, so that it can be
 * interrupted. */
#include "paper/dry.h"
#include "paper/work.h"

#include "base/error.h"
#include "base/number.h"
#include "base/watch.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>

static const char *const axes[] = {"friction.mu=0.05:0.6:12", "drive.frequency=4Hz:150Hz:90:log"};

static const struct {
    const char *name;
    const char *spin, *r, *phi;
} starts[] = {
    {"rolling-far", "rolling", "0.95", "3"},
    {"rolling-across", "rolling", "0.6", "93"},
    {"rolling-near", "rolling", "0.3", "48"},
    {"pole", "rest", "0.89", "3"},
};
enum { STARTS = sizeof starts / sizeof starts[0] };

/* What a figure shows of each map. */
static const char *const shown[] = {"regime", "mean_alpha_dot", "sticking"};

static fst_status start_params(int start, fst_params *params, fst_error *error)
{
    *params = fst_default_params();
    return fst_paper_set(
        params, error,
        "friction.law=coulomb run.rtol=1e-8 run.periods=240 run.discard=140 start.spin=%s start.r=%s "
        "start.phi=%s",
        starts[start].spin, starts[start].r, starts[start].phi);
}

static char *map_path(const fst_paper_state *paper, int start, const char *key, const char *ending)
{
    char name[80];
    (void)snprintf(name, sizeof name, "dry-map-%s%s%s", starts[start].name, key ? "-" : "", key ? key : "");
    return fst_paper_path(paper, name, ending);
}

static fst_status make_map(const fst_paper_state *paper, int start, const fst_progress *progress,
                           fst_error *error)
{
    fst_params params;
    fst_status status = start_params(start, &params, error);
    char *path = map_path(paper, start, NULL, "db");
    if (!path)
        return fst_fail(error, FST_NO_MEMORY, "paper", "no memory for a file name");
    fst_sweep_options options = fst_default_sweep_options();
    fst_sweep_counts counts;
    options.axes = axes;
    options.axis_count = 2;
    options.progress = progress;
    if (status == FST_OK)
        status = fst_sweep(&params, path, &options, &counts, error);
    free(path);
    return status;
}

/* The rows as CSV, and the figures. */
static fst_status show_map(const fst_paper_state *paper, int start, fst_error *error)
{
    char *database = map_path(paper, start, NULL, "db"), *table = map_path(paper, start, NULL, "csv");
    fst_status status = database && table
                            ? fst_sweep_export(database, FST_EXPORT_CSV, table, NULL, NULL, error)
                            : fst_fail(error, FST_NO_MEMORY, "paper", "no memory for a file name");
    for (size_t i = 0; i < sizeof shown / sizeof shown[0] && status == FST_OK; ++i) {
        const fst_sweep_figure as_map = {.kind = FST_FIGURE_MAP, .keys = {shown[i]}};
        char *figure = map_path(paper, start, shown[i], "svg");
        status = figure ? fst_figure_sweep(database, &as_map, figure, error)
                        : fst_fail(error, FST_NO_MEMORY, "paper", "no memory for a file name");
        free(figure);
    }
    free(database);
    free(table);
    return status;
}

/* ------------------------------------------------------------------ the table of outcomes */

/* A letter for each outcome; small where the motion had not settled. */
static char letter(const fst_sweep_table *table, int64_t point)
{
    const int64_t points = fst_grid_points(table->grid);
    fst_run_result result = {.omega = table->values[1 * points + point],
                             .mean_alpha_dot = table->values[2 * points + point],
                             .regime = FST_REGIME_UNDECIDED};
    const double regime = table->values[point];
    if (isfinite(regime))
        result.regime = (fst_regime)regime;
    static const char letters[FST_OUTCOME_COUNT] = {'A', 'W', 'E', 'L', 'O'};
    const char found = letters[fst_outcome(&result)];
    return result.regime == FST_REGIME_UNDECIDED ? (char)(found - 'A' + 'a') : found;
}

/* A row for each start and drive; the first start brings the line of names. */
static void put_table(FILE *out, int start, const fst_sweep_table *table)
{
    const int64_t mus = fst_grid_axis_points(table->grid, 0), drives = fst_grid_axis_points(table->grid, 1);
    const int64_t mu_stride = fst_grid_axis_stride(table->grid, 0),
                  stride = fst_grid_axis_stride(table->grid, 1);
    if (start == 0) {
        (void)fputs("start.spin,start.r,start.phi [deg],drive.frequency [Hz]", out);
        for (int64_t mu = 0; mu < mus; ++mu)
            (void)fprintf(out, ",mu %4.2f", fst_grid_value(table->grid, 0, mu * mu_stride));
        (void)fputc('\n', out);
    }
    for (int64_t drive = 0; drive < drives; ++drive) {
        (void)fprintf(out, "%s,%s,%s,%.2f", starts[start].spin, starts[start].r, starts[start].phi,
                      fst_grid_value(table->grid, 1, drive * stride));
        for (int64_t mu = 0; mu < mus; ++mu)
            (void)fprintf(out, ",%c", letter(table, mu * mu_stride + drive * stride));
        (void)fputc('\n', out);
    }
}

static fst_status put_map(const fst_paper_state *paper, int start, FILE *out, fst_error *error)
{
    static const char *const keys[] = {"regime", "omega", "mean_alpha_dot"};
    char *path = map_path(paper, start, NULL, "db");
    fst_sweep_table table;
    if (!path)
        return fst_fail(error, FST_NO_MEMORY, "paper", "no memory for a file name");
    const fst_status status = fst_sweep_read(path, keys, 3, &table, error);
    free(path);
    if (status != FST_OK)
        return status;
    put_table(out, start, &table);
    fst_sweep_table_free(&table);
    return FST_OK;
}

static fst_status write_tables(const fst_paper_state *paper, fst_error *error)
{
    fst_paper_file file;
    fst_status status = fst_paper_file_begin(&file, error);
    if (status != FST_OK)
        return status;
    (void)fputs(
        "# What becomes of a bead that rubs dry. A: circles against the magnet. W: goes round with it. E: "
        "ejected.\n"
        "# L: lifted off the plate. O: other. Small letters: the motion had not settled after 240 turns.\n",
        file.stream);
    for (int start = 0; start < STARTS && status == FST_OK; ++start)
        status = put_map(paper, start, file.stream, error);
    return fst_paper_file_end(&file, paper, "dry-maps", "csv", status, error);
}

fst_status fst_paper_dry_maps(const char *directory, const fst_progress *progress, fst_error *error)
{
    const fst_paper_state paper = {.directory = directory};
    fst_c_locale locale = fst_c_locale_enter();
    fst_status status = fst_paper_make_directory(&paper, error);
    for (int start = 0; start < STARTS && status == FST_OK; ++start) {
        fst_part part = {progress, (double)start / STARTS, (start + 1.0) / STARTS, starts[start].name};
        const fst_progress of_part = {&part, fst_part_tell};
        status = make_map(&paper, start, &of_part, error);
        if (status == FST_OK)
            status = show_map(&paper, start, error);
    }
    if (status == FST_OK)
        status = write_tables(&paper, error);
    fst_c_locale_leave(locale);
    return status;
}
