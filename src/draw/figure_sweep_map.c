/* figure_sweep_map.c - a key of a sweep over the plane of its two axes: a regime map or a heat map. */
#include "draw/figure_sweep.h"

#include "base/error.h"

#include <string.h>

enum { WIDTH = 780, HEIGHT = 620, REGIMES = FST_REGIME_LIFTED + 1 };

typedef struct map {
    const fst_sweep_table *table;
    const fst_sweep_axis *axes; /* the first one upward, the second one to the right */
    const char *key;
    int regimes; /* colours stand for regimes */
} map;

static int64_t point_at(const map *m, int64_t row, int64_t column)
{
    const fst_grid *grid = m->table->grid;
    return row * fst_grid_axis_stride(grid, m->axes[0].index) +
           column * fst_grid_axis_stride(grid, m->axes[1].index);
}

/* The borders of a value's cell: halfway to its neighbours. */
static void cell(const map *m, int which, int64_t i, double *low, double *high)
{
    const fst_sweep_axis *axis = &m->axes[which];
    const int64_t last = axis->count - 1, before = i > 0 ? i - 1 : 0, after = i < last ? i + 1 : last;
#define VALUE(place)                                                                                           \
    fst_sweep_axis_value(m->table->grid, axis, which ? point_at(m, 0, place) : point_at(m, place, 0))
    const double here = VALUE(i), down = here - VALUE(before), up = VALUE(after) - here;
#undef VALUE
    *low = here - 0.5 * (i > 0 ? down : up);
    *high = here + 0.5 * (i < last ? up : down);
}

/* Boxes overlap a little, so that no seams show between them. */
static void write_box(fst_figure_file *figure, double x_low, double x_high, double y_low, double y_high,
                      double value)
{
    const double wider = 0.03 * (x_high - x_low), higher = 0.03 * (y_high - y_low);
    (void)fprintf(figure->data, "%.7g %.7g %.7g %.7g %.7g %.7g %.7g\n", 0.5 * (x_low + x_high),
                  0.5 * (y_low + y_high), x_low, x_high + wider, y_low, y_high + higher, value);
}

/* The cells of one regime, or all of them (regime < 0).  Cells of one row that follow each other with the same
 * regime become one box: maps stay small as files. */
static void write_cells(fst_figure_file *figure, const map *m, int regime)
{
    const double *values = m->table->values;
    char name[24];
    (void)snprintf(name, sizeof name, regime < 0 ? "cells" : "cells-%d", regime);
    fst_figure_block(figure, name, "x y x_low x_high y_low y_high value");
    for (int64_t row = 0; row < m->axes[0].count; ++row)
        for (int64_t column = 0; column < m->axes[1].count;) {
            const double value = values[point_at(m, row, column)];
            double x_low, x_high, y_low, y_high, end;
            cell(m, 0, row, &y_low, &y_high);
            cell(m, 1, column, &x_low, &x_high);
            int64_t next = column + 1;
            for (; m->regimes && next < m->axes[1].count && values[point_at(m, row, next)] == value; ++next)
                cell(m, 1, next, &end, &x_high);
            column = next;
            if (regime < 0 ? isfinite(value) : value == regime)
                write_box(figure, x_low, x_high, y_low, y_high, value);
        }
}

static void write_axis(fst_figure_file *figure, const map *m, int which, const char *letter)
{
    double low, high, unused;
    cell(m, which, 0, &low, &unused);
    cell(m, which, m->axes[which].count - 1, &unused, &high);
    (void)fprintf(figure->script, "set %srange [%.7g:%.7g]\nset %slabel '%s'\n", letter, fmin(low, high),
                  fmax(low, high), letter, m->axes[which].label);
}

static void write_regimes(fst_figure_file *figure, const map *m)
{
    int occurs[REGIMES] = {0};
    for (int64_t i = 0; i < fst_grid_points(m->table->grid); ++i)
        if (isfinite(m->table->values[i]))
            occurs[(int)m->table->values[i]] = 1;
    (void)fputs("set key outside below horizontal height 1\nplot ", figure->script);
    for (int r = 0; r < REGIMES; ++r)
        if (occurs[r]) {
            write_cells(figure, m, r);
            (void)fprintf(
                figure->script,
                "data index 'cells-%d' using 1:2:3:4:5:6 with boxxyerror fillstyle solid 1.0 noborder lc rgb "
                "'%s' title '%s', \\\n     ",
                r, fst_colour_code(fst_regime_colour(r)), fst_regime_name((fst_regime)r));
        }
    (void)fputs("NaN notitle\n", figure->script);
}

fst_status fst_figure_sweep_map(const fst_sweep_table *table, const char *key, const fst_sweep_axis axes[2],
                                const char *out, fst_error *error)
{
    const map m = {.table = table, .axes = axes, .key = key, .regimes = strcmp(key, "regime") == 0};
    if (fst_grid_axis_stride(table->grid, axes[0].index) == fst_grid_axis_stride(table->grid, axes[1].index))
        return fst_fail(error, FST_BAD_INPUT, out, "random points make no map: festoon export them");
    fst_figure_file figure;
    const fst_status status = fst_figure_begin(&figure, out, WIDTH, HEIGHT, error);
    if (status != FST_OK)
        return status;
    char label[96];
    fst_sweep_key_label(key, label, sizeof label);
    (void)fputs("set title ", figure.script);
    fst_figure_quote(&figure, m.regimes ? "Regimes of motion" : label);
    (void)fputs(" noenhanced\nset tics out nomirror\n", figure.script);
    write_axis(&figure, &m, 1, "x");
    write_axis(&figure, &m, 0, "y");
    if (m.regimes) {
        write_regimes(&figure, &m);
    } else {
        write_cells(&figure, &m, -1);
        fst_figure_palette(&figure, FST_PALETTE_LINE);
        (void)fputs("set cblabel ", figure.script);
        fst_figure_quote(&figure, label);
        (void)fputs(" noenhanced\nplot data index 'cells' using 1:2:3:4:5:6:7 with boxxyerror fillstyle solid "
                    "1.0 noborder "
                    "lc palette notitle\n",
                    figure.script);
    }
    return fst_figure_finish(&figure, error);
}
