/* poles.c - the magnet's bodies as pictures show them, from above. */
#include "draw/poles.h"

#include <math.h>
#include <string.h>

#include "draw/bar.h"

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

/* ------------------------------------------------------------------ in figures */

static const char *const pole_names[2] = {"north", "south"};
static const char *const pole_styles[2] = {"lc rgb '#d55e00' lw 1.8", "lc rgb '#0072b2' lw 1.8"};

static int has_pole(const fst_magnet_body *bodies, int count, int pole)
{
    int has = 0;
    for (int i = 0; i < count; ++i)
        has = has || bodies[i].pole_count[pole] > 0;
    return has;
}

int fst_figure_write_poles(fst_figure_file *figure, const fst_magnet_body *bodies, int count, double angle)
{
    const double c = cos(angle), s = sin(angle);
    int which = 0;
    for (int pole = 0; pole < 2; ++pole) {
        if (!has_pole(bodies, count, pole))
            continue;
        which |= 1 << pole;
        fst_figure_block(figure, pole_names[pole], "X Y: outlines of the magnet's poles");
        for (int i = 0; i < count; ++i) {
            const int corners = bodies[i].pole_count[pole];
            for (int k = 0; k <= corners && corners > 0; ++k) {
                const double *at = bodies[i].poles[pole][k % corners];
                (void)fprintf(figure->data, "%.6g %.6g\n", at[0] * c - at[1] * s, at[0] * s + at[1] * c);
            }
            (void)fputs(corners > 0 ? "\n" : "", figure->data);
        }
    }
    return which;
}

void fst_figure_plot_poles(FILE *script, int which)
{
    for (int pole = 0; pole < 2; ++pole)
        if (which & 1 << pole)
            (void)fprintf(script, "     data index '%s' using 1:2 with lines %s notitle, \\\n",
                          pole_names[pole], pole_styles[pole]);
}

void fst_legend_add_poles(fst_legend *legend, const fst_magnet_body *bodies, int count, const char *where)
{
    char words[64];
    for (int pole = 0; pole < 2; ++pole)
        if (has_pole(bodies, count, pole)) {
            (void)snprintf(words, sizeof words, "the magnet's %s poles, %s", pole_names[pole], where);
            fst_legend_add(legend, FST_SAMPLE_LINE, pole_styles[pole], words);
        }
}
