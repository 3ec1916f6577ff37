/* poles.c - the magnet's bodies as pictures show them, from above. */
#include "draw/poles.h"

#include <festoon/festoon_tools.h>

#include <math.h>
#include <stdio.h>
#include <string.h>

#include "draw/bar.h"
#include "draw/chart.h"

static const double DIPOLE = 1e-3; /* half the side of the mark of a dipole, which has no size; m */

/* The piece of a convex polygon on the side of a line through `middle` to which `way` points. */
static int cut(const fst_part_shape *shape, const double middle[2], const double way[2],
               double piece[FST_OUTLINE_MOST + 2][2])
{
    int count = 0;
    for (int i = 0; i < shape->count; ++i) {
        const double *a = shape->corners[i], *b = shape->corners[(i + 1) % shape->count];
        const double from = (a[0] - middle[0]) * way[0] + (a[1] - middle[1]) * way[1];
        const double to = (b[0] - middle[0]) * way[0] + (b[1] - middle[1]) * way[1];
        if (from >= 0.0) {
            piece[count][0] = a[0];
            piece[count++][1] = a[1];
        }
        if (from * to < 0.0) {
            piece[count][0] = a[0] + (b[0] - a[0]) * from / (from - to);
            piece[count++][1] = a[1] + (b[1] - a[1]) * from / (from - to);
        }
    }
    return count;
}

/* North is where the magnetisation points: one half of a body, or its upper side. */
static void find_poles(fst_magnet_body *body, const double middle[2])
{
    const double *j = body->seen.magnetisation;
    const int sideways = hypot(j[0], j[1]) >= fabs(j[2]) && hypot(j[0], j[1]) > 0.0;
    for (int pole = 0; pole < 2; ++pole) {
        const double sign = pole == 0 ? 1.0 : -1.0, way[2] = {sign * j[0], sign * j[1]};
        if (sideways) {
            body->pole_count[pole] = cut(&body->seen, middle, way, body->poles[pole]);
        } else if (sign * j[2] > 0.0) {
            body->pole_count[pole] = body->seen.count;
            memcpy(body->poles[pole], body->seen.corners, sizeof body->seen.corners);
        }
    }
}

static void set_box(fst_part_shape *shape, const double middle[2], double half, double across)
{
    const double corners[4][2] = {{-half, -across}, {half, -across}, {half, across}, {-half, across}};
    shape->count = 4;
    for (int i = 0; i < 4; ++i) {
        shape->corners[i][0] = middle[0] + corners[i][0];
        shape->corners[i][1] = middle[1] + corners[i][1];
    }
}

static void scale_shape(fst_part_shape *shape, double unit)
{
    for (int i = 0; i < shape->count; ++i) {
        shape->corners[i][0] *= unit;
        shape->corners[i][1] *= unit;
    }
    shape->low *= unit;
    shape->high *= unit;
}

int fst_magnet_bodies(const fst_params *params, double unit, double over_lines,
                      fst_magnet_body bodies[FST_PARTS_MAX])
{
    static const double axis[2] = {0.0, 0.0};
    const int bar = params->magnet_shape == FST_MAGNET_LINES;
    const int count = bar ? 1 : params->magnet_shape == FST_MAGNET_PARTS ? params->magnet_part_count : 0;
    memset(bodies, 0, FST_PARTS_MAX * sizeof *bodies);
    for (int i = 0; i < count; ++i) {
        const double *centre = bar ? axis : params->magnet_parts[i].centre;
        fst_part_shape *seen = &bodies[i].seen;
        if (bar) {
            set_box(seen, axis, params->magnet_half_length * over_lines, 0.5 * params->magnet_width);
            seen->high = 0.5e-3 * FST_BAR_THICKNESS;
            seen->low = -seen->high;
            seen->magnetisation[0] = 1.0;
        } else {
            *seen = fst_part_seen(&params->magnet_parts[i]);
            if (seen->count == 0) {
                set_box(seen, centre, DIPOLE, DIPOLE);
                seen->low -= DIPOLE;
                seen->high += DIPOLE;
            }
        }
        scale_shape(seen, unit);
        const double middle[2] = {unit * centre[0], unit * centre[1]};
        find_poles(&bodies[i], middle);
    }
    return count;
}

/* ------------------------------------------------------------------ in pictures */

static const char *const pole_names[2] = {"north", "south"};
static const fst_colour pole_colours[2] = {FST_COLOUR_VERMILION, FST_COLOUR_BLUE};

/* A growing line. */
typedef struct pen {
    double *x, *y;
    size_t count;
    double c, s; /* by which it is turned */
} pen;

static void put(pen *to, double x, double y)
{
    to->x[to->count] = x * to->c - y * to->s;
    to->y[to->count++] = x * to->s + y * to->c;
}

/* Begin the next line of a picture, with room for so many points; 0: no memory. */
static int begin_line(fst_picture_line *line, pen *to, size_t room, double angle, void **memory)
{
    double *x = fst_keep(memory, 2 * room * sizeof *x);
    *to = (pen){.x = x, .y = x + room, .c = cos(angle), .s = sin(angle)};
    line->x = to->x;
    line->y = to->y;
    return x != NULL;
}

static int end_pole(fst_picture_line *line, const pen *from, int pole, const char *words, void **memory)
{
    char *kept = fst_keep(memory, strlen(words) + 1);
    if (!kept)
        return 0;
    memcpy(kept, words, strlen(words));
    line->name = pole_names[pole];
    line->count = from->count;
    line->words = kept;
    line->colour = fst_colour_code(pole_colours[pole]);
    line->width = 1.8;
    return 1;
}

/* ------------------------------------------------------------------ poles of a measured field */

enum { GRID = 96 }; /* cells from edge to edge of a measured field */

/* B_z on a square about the disc that is known; NAN outside. */
static void measure_poles(const fst_model *model, double radius, double values[GRID + 1][GRID + 1],
                          double most[2])
{
    most[0] = most[1] = 0.0;
    for (int row = 0; row <= GRID; ++row)
        for (int column = 0; column <= GRID; ++column) {
            const double x = radius * (2.0 * column / GRID - 1.0), y = radius * (2.0 * row / GRID - 1.0);
            double b[3] = {NAN, NAN, NAN}, gradient[3][3];
            if (hypot(x, y) < 0.999 * radius)
                fst_field(model, x, y, b, gradient);
            values[row][column] = b[2];
            most[0] = fmax(most[0], b[2]);
            most[1] = fmax(most[1], -b[2]);
        }
}

/* The piece of the line values = level in a cell: a straight one between two sides that it crosses. */
static void cross_cell(pen *to, double values[GRID + 1][GRID + 1], int row, int column, double level,
                       double length)
{
    static const int corner[5][2] = {{0, 0}, {0, 1}, {1, 1}, {1, 0}, {0, 0}};
    int crossed = 0;
    for (int side = 0; side < 4; ++side) {
        const int *a = corner[side], *b = corner[side + 1];
        const double from = values[row + a[0]][column + a[1]] - level;
        const double end = values[row + b[0]][column + b[1]] - level;
        if (!(from * end < 0.0)) /* also where one is not known */
            continue;
        const double part = from / (from - end);
        put(to, length * (2.0 * (column + a[1] + part * (b[1] - a[1])) / GRID - 1.0),
            length * (2.0 * (row + a[0] + part * (b[0] - a[0])) / GRID - 1.0));
        if (++crossed % 2 == 0)
            put(to, NAN, NAN);
    }
    if (crossed % 2 == 1) /* the line leaves what is known */
        put(to, NAN, NAN);
}

/* Nothing is known of the magnet of a measured field but where it is strong: the lines where B_z is half of its
 * greatest, upwards and downwards. */
static int put_measured_poles(const fst_params *params, double length, double angle, const char *where,
                              fst_picture_line *lines, int *count, void **memory)
{
    fst_model *model = NULL;
    fst_params magnet = *params; /* alone */
    double(*values)[GRID + 1] = fst_keep(memory, sizeof(double[GRID + 1][GRID + 1])), most[2];
    magnet.coil_count = 0;
    for (int i = 0; i < 3; ++i)
        magnet.field_uniform[i] = 0.0;
    if (!values || fst_field_model_new(&magnet, NAN, &model, NULL) != FST_OK)
        return values != NULL;
    const double radius = fst_model_groups(model).map_radius;
    int good = 1;
    measure_poles(model, radius, values, most);
    for (int pole = 0; pole < 2 && good; ++pole) {
        pen to;
        char words[128];
        if (most[pole] <= 0.1 * most[1 - pole])
            continue;
        good = begin_line(&lines[*count], &to, (size_t)6 * GRID * GRID, angle, memory);
        for (int cell = 0; good && cell < GRID * GRID; ++cell)
            cross_cell(&to, values, cell / GRID, cell % GRID, (pole ? -0.5 : 0.5) * most[pole],
                       radius * length);
        (void)snprintf(words, sizeof words, "%s of the measured field: half the greatest B_z, %s",
                       pole_names[pole], where);
        good = good && end_pole(&lines[(*count)++], &to, pole, words, memory);
    }
    fst_model_free(model);
    return good;
}

/* ------------------------------------------------------------------ all magnets */

static int put_poles(const fst_magnet_body *bodies, int body_count, double angle, const char *where,
                     fst_picture_line *lines, int *count, void **memory)
{
    for (int pole = 0; pole < 2; ++pole) {
        size_t corners = 0;
        pen to;
        char words[96];
        for (int i = 0; i < body_count; ++i)
            corners += bodies[i].pole_count[pole] > 0 ? (size_t)bodies[i].pole_count[pole] + 2 : 0;
        if (corners == 0)
            continue;
        if (!begin_line(&lines[*count], &to, corners, angle, memory))
            return 0;
        for (int i = 0; i < body_count; ++i) {
            const int own = bodies[i].pole_count[pole];
            for (int k = 0; k <= own && own > 0; ++k)
                put(&to, bodies[i].poles[pole][k % own][0], bodies[i].poles[pole][k % own][1]);
            if (own > 0)
                put(&to, NAN, NAN);
        }
        (void)snprintf(words, sizeof words, "the magnet's %s poles, %s", pole_names[pole], where);
        if (!end_pole(&lines[(*count)++], &to, pole, words, memory))
            return 0;
    }
    return 1;
}

int fst_magnet_lines(const fst_params *params, double length, double angle, const char *where,
                     fst_picture_line lines[FST_PICTURE_LINES], int *count, void **memory)
{
    *count = 0;
    if (params->magnet_shape == FST_MAGNET_GRID)
        return put_measured_poles(params, length, angle, where, lines, count, memory);
    fst_magnet_body *bodies = fst_keep(memory, FST_PARTS_MAX * sizeof *bodies);
    if (!bodies)
        return 0;
    const int body_count = fst_magnet_bodies(params, length / params->magnet_half_length, 1.0, bodies);
    return put_poles(bodies, body_count, angle, where, lines, count, memory);
}

int fst_magnet_outline(const fst_params *params, double length, double angle, const char *words,
                       fst_picture_line *line, void **memory)
{
    const double half = length, across = 0.5 * length * params->magnet_width / params->magnet_half_length;
    static const double corners[5][2] = {{-1, -1}, {1, -1}, {1, 1}, {-1, 1}, {-1, -1}};
    pen to;
    *line =
        (fst_picture_line){.name = "magnet", .words = words, .colour = "#b4b4b4", .width = 1.0, .is_ground = 1};
    if (!begin_line(line, &to, 5, angle, memory))
        return 0;
    for (int i = 0; i < 5; ++i)
        put(&to, half * corners[i][0], across * corners[i][1]);
    line->count = to.count;
    return 1;
}

int fst_magnet_rows(const fst_groups *groups, double length, const char *words, fst_picture_line *line,
                    void **memory)
{
    pen to;
    *line = (fst_picture_line){.name = "lines", .words = words, .colour = "#e07b39", .width = 3.0};
    if (!begin_line(line, &to, 3 * (size_t)groups->lines, 0.0, memory))
        return 0;
    for (int k = 0; k < groups->lines; ++k) {
        const double y = length * (k - 0.5 * (groups->lines - 1)) * groups->lambda;
        put(&to, -length, y);
        put(&to, length, y);
        put(&to, NAN, NAN);
    }
    line->count = to.count;
    return 1;
}

/* ------------------------------------------------------------------ in figures */

void fst_figure_write_lines(fst_figure_file *figure, const fst_picture_line *lines, int count)
{
    for (const fst_picture_line *line = lines; line < lines + count; ++line) {
        fst_figure_block(figure, line->name, "x y: lines of the magnet");
        for (size_t i = 0; i < line->count; ++i)
            if (isfinite(line->x[i]))
                (void)fprintf(figure->data, "%.6g %.6g\n", line->x[i], line->y[i]);
            else
                (void)fputc('\n', figure->data);
    }
}

static void style_of(const fst_picture_line *line, char style[48])
{
    (void)snprintf(style, 48, "lc rgb '%s' lw %g", line->colour, line->width);
}

void fst_figure_plot_lines(FILE *script, const fst_picture_line *lines, int count)
{
    for (const fst_picture_line *line = lines; line < lines + count; ++line) {
        char style[48];
        style_of(line, style);
        if (line->is_ground)
            (void)fprintf(
                script,
                "     data index '%s' using 1:2 with filledcurves closed fc rgb '#f4f4f4' notitle, \\\n",
                line->name);
        (void)fprintf(script, "     data index '%s' using 1:2 with lines %s notitle, \\\n", line->name, style);
    }
}

void fst_legend_add_lines(fst_legend *legend, const fst_picture_line *lines, int count)
{
    for (const fst_picture_line *line = lines; line < lines + count; ++line) {
        char style[48];
        style_of(line, style);
        fst_legend_add(legend, FST_SAMPLE_LINE, style, line->words);
    }
}
