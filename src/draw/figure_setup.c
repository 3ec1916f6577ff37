/* figure_setup.c - the sketch of the experiment, and the path as the paper's camera would see it. */
#include <festoon/festoon_tools.h>

#include "base/constants.h"
#include "base/error.h"

#include "draw/bar.h"
#include "draw/legend.h"

#include <math.h>

#define FRAMES_A_SECOND 200.0 /* the paper's camera (section III) */
#define PIXELS_A_MM 10.0      /* the paper gives no scale */

enum {
    CAMERA_SECONDS = 2,
    LEFT = 56,
    RIGHT = 20,
    AXIS = 54,
    TITLE = 30,
    ABOVE = FST_FIGURE_WIDTH - LEFT - RIGHT, /* side of the view from above, in pixels */
    BELOW = 186,                             /* of the two views below it */
    LOCAL_LEFT = 284
};

static const double degree = 0.017453292519943295;
static const double MAGNET_ANGLE = 25.0, BEAD_ANGLE = 70.0; /* of the sketch */
static const double THETA = 60.0, PHI = 50.0;               /* of the sketched moment */

/* ------------------------------------------------------------------ the sketch */

static void write_circle(fst_figure_file *figure, const char *name, double x, double y, double radius)
{
    fst_figure_block(figure, name, "x/mm y/mm");
    for (int i = 0; i <= 360; i += 4)
        (void)fprintf(figure->data, "%.6g %.6g\n", x + radius * cos(i * degree), y + radius * sin(i * degree));
}

/* Draw an arc from the angle `from` to `to`, in degrees, about (x, y). */
static void write_arc(fst_figure_file *figure, const char *name, double x, double y, double radius, double from,
                      double to)
{
    fst_figure_block(figure, name, "x/mm y/mm");
    for (int i = 0; i <= 20; ++i) {
        double angle = (from + (to - from) * i / 20.0) * degree;
        (void)fprintf(figure->data, "%.6g %.6g\n", x + radius * cos(angle), y + radius * sin(angle));
    }
}

/* Draw an arc about the axis by short vectors; the head of the last one shows the sense of turning,
 * anticlockwise. */
static void write_turning(fst_figure_file *figure, double reach)
{
    fst_figure_block(figure, "turning", "x/mm y/mm dx dy: the sense of the magnet's turning");
    for (int side = 0; side < 2; ++side) {
        double at = (205.0 + 180.0 * side) * degree, step = 9.0;
        (void)fprintf(figure->data, "%.6g %.6g %.6g %.6g\n", reach * cos(at), reach * sin(at), -step * sin(at),
                      step * cos(at));
    }
}

/* Draw a rectangle of half sides a, b about (x, y), turned by `angle` degrees. */
static void write_box(fst_figure_file *figure, const char *name, const double box[4], double angle)
{
    static const double corners[5][2] = {{-1, -1}, {1, -1}, {1, 1}, {-1, 1}, {-1, -1}};
    double c = cos(angle * degree), s = sin(angle * degree);
    fst_figure_block(figure, name, "x/mm y/mm");
    for (int i = 0; i < 5; ++i) {
        double a = box[2] * corners[i][0], b = box[3] * corners[i][1];
        (void)fprintf(figure->data, "%.6g %.6g\n", box[0] + a * c - b * s, box[1] + a * s + b * c);
    }
}

static void write_above(fst_figure_file *figure, const fst_params *p, double bar)
{
    const double l = 1e3 * p->magnet_half_length, width = 1e3 * p->magnet_width, r = 0.9 * l;
    const double c = cos(MAGNET_ANGLE * degree), s = sin(MAGNET_ANGLE * degree);
    const double above[4] = {0.0, 0.0, bar, 0.5 * width};
    write_box(figure, "magnet-above", above, MAGNET_ANGLE);
    write_circle(figure, "bead-above", r * cos(BEAD_ANGLE * degree), r * sin(BEAD_ANGLE * degree),
                 1e3 * p->bead_radius);
    write_arc(figure, "angle", 0.0, 0.0, 0.55 * l, MAGNET_ANGLE, BEAD_ANGLE);
    write_turning(figure, bar + 8.0);
    fst_figure_block(figure, "lines", "x/mm y/mm dx dy: the model's lines of dipoles");
    for (int k = 0; k < p->magnet_lines; ++k) {
        const double across = p->magnet_lines > 1 ? width * (k / (p->magnet_lines - 1.0) - 0.5) : 0.0;
        (void)fprintf(figure->data, "%.6g %.6g %.6g %.6g\n", -l * c - across * s, -l * s + across * c,
                      2 * l * c, 2 * l * s);
    }
}

/* Place a square panel with its title and labels. */
static void place(fst_figure_file *figure, int height, double left, double top, double side, const char *title,
                  const char *below, const char *beside)
{
    const double frame[4] = {left, left + side, top, top + side};
    fst_figure_place(figure, height, frame);
    (void)fprintf(figure->script, "set label '%s' at graph 0.5,1 center offset character 0,0.8 font ',12'\n",
                  title);
    if (below)
        fst_figure_axis_label(figure, height, FST_SIDE_BELOW, below, FST_COLOUR_BLACK, frame);
    if (beside)
        fst_figure_axis_label(figure, height, FST_SIDE_LEFT, beside, FST_COLOUR_BLACK, frame);
}

static void draw_above(fst_figure_file *figure, const fst_params *p, double reach)
{
    const double l = 1e3 * p->magnet_half_length, r = 0.9 * l;
    const double c = cos(BEAD_ANGLE * degree), s = sin(BEAD_ANGLE * degree);
    const double middle = 0.5 * (MAGNET_ANGLE + BEAD_ANGLE) * degree;
    (void)fprintf(figure->script,
                  "set size ratio -1\nset xrange [%.4g:%.4g]\nset yrange [%.4g:%.4g]\n"
                  "set arrow 1 from 0,0 to %.5g,%.5g front nohead lc rgb '#222222' lw 1.4\n"
                  "set label 'r' at %.5g,%.5g center front\n"
                  "set arrow 2 from 0,0 to %.5g,%.5g front nohead dt 2 lc rgb '#222222'\n"
                  "set label 'Φ' at %.5g,%.5g center front\n"
                  "set label 'ω' at %.5g,%.5g center front\n"
                  "set arrow 4 from %.5g,%.5g to %.5g,%.5g front lc rgb '#009e73' lw 2\n"
                  "set label 'e_r' at %.5g,%.5g center front textcolor rgb '#009e73'\n"
                  "set arrow 5 from %.5g,%.5g to %.5g,%.5g front lc rgb '#009e73' lw 2\n"
                  "set label 'e_α' at %.5g,%.5g center front textcolor rgb '#009e73'\n",
                  -reach, reach, -reach, reach, r * c, r * s, 0.55 * r * c - 2.5, 0.55 * r * s + 1.5,
                  1.35 * l * cos(MAGNET_ANGLE * degree), 1.35 * l * sin(MAGNET_ANGLE * degree),
                  0.68 * l * cos(middle), 0.68 * l * sin(middle), -0.9 * reach, -0.62 * reach, r * c, r * s,
                  (r + 9) * c, (r + 9) * s, (r + 12) * c, (r + 12) * s, r * c, r * s, r * c - 9 * s,
                  r * s + 9 * c, r * c - 12.5 * s, r * s + 12.5 * c);
    (void)fputs(
        "plot data index 'magnet-above' using 1:2 with filledcurves closed fc rgb '#eeeeee' notitle, \\\n"
        "     data index 'magnet-above' using 1:2 with lines lc rgb '#888888' notitle, \\\n"
        "     data index 'lines' using 1:2:3:4 with vectors nohead lc rgb '#0072b2' lw 1.5 notitle, \\\n"
        "     data index 'bead-above' using 1:2 with filledcurves closed fc rgb '#d55e00' notitle, \\\n"
        "     data index 'angle' using 1:2 with lines lc rgb '#222222' lw 1.2 notitle, \\\n"
        "     data index 'turning' using 1:2:3:4 with vectors head filled lc rgb '#222222' lw 1.2 notitle\n"
        "unset arrow\nunset label\n",
        figure->script);
}

/* The view from the side: a cut through axis and bead. */
static void draw_side(fst_figure_file *figure, const fst_params *p, double bar, double reach)
{
    const double depth = 1e3 * p->magnet_depth, radius = 1e3 * p->bead_radius,
                 r = 0.9e3 * p->magnet_half_length;
    const double beside[4] = {0.0, -depth, bar, 0.5 * FST_BAR_THICKNESS};
    write_box(figure, "magnet-beside", beside, 0.0);
    write_circle(figure, "bead-beside", r, radius, radius);
    (void)fprintf(figure->script,
                  "set xrange [%.4g:%.4g]\nset yrange [%.4g:%.4g]\nset tics 20\n"
                  "set arrow 1 from %.4g,0 to %.4g,0 nohead lc rgb '#222222' lw 2\n"
                  "set label 'plate' at %.4g,4 font ',11'\n"
                  "set arrow 2 from %.4g,0 to %.4g,%.5g heads size screen 0.010,20 lc rgb '#666666'\n"
                  "set label '%.4g mm' at %.4g,%.4g right font ',11'\n"
                  "set arrow 3 from 0,%.4g to 0,%.4g nohead dt 4 lc rgb '#888888'\n"
                  "set label 'axis' at 2,%.4g font ',11' textcolor rgb '#666666'\n"
                  "set label 'magnet' at 0,%.5g center front font ',11'\n"
                  "set label 'bead' at %.5g,%.5g center front font ',11'\n",
                  -reach, reach, -reach, reach, -reach, reach, -0.95 * reach, bar + 5.0, bar + 5.0, -depth,
                  depth, 0.95 * reach, -0.62 * reach, -0.95 * reach, 0.9 * reach, 0.8 * reach, -depth, r,
                  2.0 * radius + 4.0);
    (void)fputs(
        "plot data index 'magnet-beside' using 1:2 with filledcurves closed fc rgb '#eeeeee' notitle, \\\n"
        "     data index 'magnet-beside' using 1:2 with lines lc rgb '#888888' notitle, \\\n"
        "     data index 'bead-beside' using 1:2 with filledcurves closed fc rgb '#d55e00' notitle\n"
        "unset arrow\nunset label\n",
        figure->script);
}

/* The bead's local frame in a slanted view: e_alpha to the right, e_z up, e_r towards the reader.  The part of
 * n across e_r has the angle phi against -e_z. */
static void draw_local(fst_figure_file *figure)
{
    static const double slant[3][2] = {{-0.55, -0.40}, {1.0, 0.0}, {0.0, 1.0}}; /* of e_r, e_alpha, e_z */
    static const char *const names[] = {"e_r", "e_α", "e_z"};
    const double ct = cos(THETA * degree), st = sin(THETA * degree);
    const double n[3] = {ct, st * sin(PHI * degree), -st * cos(PHI * degree)};
    double tip[2] = {0, 0}, across[2] = {n[1], n[2]};
    for (int i = 0; i < 3; ++i)
        for (int k = 0; k < 2; ++k)
            tip[k] += n[i] * slant[i][k];
    write_arc(figure, "phi", 0.0, 0.0, 0.68, -90.0, -90.0 + PHI);
    fst_figure_block(figure, "theta", "an arc from e_r to n");
    for (int i = 0; i <= 20; ++i) {
        const double a = THETA * degree * i / 20.0, u = 0.5 * cos(a), v = 0.5 * sin(a) / st;
        (void)fprintf(figure->data, "%.6g %.6g\n", u * slant[0][0] + v * across[0],
                      u * slant[0][1] + v * across[1]);
    }
    (void)fputs("set xrange [-1.2:1.2]\nset yrange [-1.2:1.2]\nunset tics\n", figure->script);
    for (int i = 0; i < 3; ++i) {
        const double reach = i == 0 ? 1.15 : 0.85;
        (void)fprintf(figure->script,
                      "set arrow %d from 0,0 to %.4g,%.4g front lc rgb '#009e73' lw 2\n"
                      "set label '%s' at %.4g,%.4g center front textcolor rgb '#009e73'\n",
                      i + 1, reach * slant[i][0], reach * slant[i][1], names[i], (reach + 0.17) * slant[i][0],
                      (reach + 0.17) * slant[i][1]);
    }
    (void)fprintf(figure->script,
                  "set arrow 4 from 0,0 to %.4g,%.4g front lc rgb '#d55e00' lw 2.5\n"
                  "set label 'n' at %.4g,%.4g center front textcolor rgb '#d55e00'\n"
                  "set arrow 5 from 0,0 to 0,-0.75 nohead dt 2 lc rgb '#666666'\n"
                  "set label '−e_z' at 0.02,-0.92 center front font ',11' textcolor rgb '#666666'\n"
                  "set arrow 6 from 0,0 to %.4g,%.4g nohead dt 2 lc rgb '#666666'\n"
                  "set arrow 7 from %.4g,%.4g to %.4g,%.4g nohead dt 3 lc rgb '#666666'\n"
                  "set label 'φ' at %.4g,%.4g center front\nset label 'θ' at %.4g,%.4g center front\n",
                  tip[0], tip[1], 1.2 * tip[0] - 0.06, 1.2 * tip[1], across[0], across[1], tip[0], tip[1],
                  across[0], across[1], 0.11, -0.55, -0.26, -0.42);
    (void)fputs("plot data index 'phi' using 1:2 with lines lc rgb '#222222' lw 1.2 notitle, \\\n"
                "     data index 'theta' using 1:2 with lines lc rgb '#222222' lw 1.2 notitle\n",
                figure->script);
}

static fst_legend sketch_legend(const fst_params *p, double bar)
{
    fst_legend legend = {.title = "The setup to scale"};
    (void)snprintf(legend.about, sizeof legend.about, "bar magnet %.4g × %.4g × %.4g mm, bead %.4g mm across",
                   2.0 * bar, 1e3 * p->magnet_width, FST_BAR_THICKNESS, 2e3 * p->bead_radius);
    fst_legend_add(&legend, FST_SAMPLE_BOX, "fs solid 1.0 noborder lc rgb '#dddddd'", "the bar");
    fst_legend_add(&legend, FST_SAMPLE_LINE, "lc rgb '#0072b2' lw 1.5", "its model, lines of dipoles");
    fst_legend_add(&legend, FST_SAMPLE_POINT, "pt 7 ps 1.1 lc rgb '#d55e00'", "bead");
    return legend;
}

fst_status fst_figure_sketch(const fst_params *params, const char *out, fst_error *error)
{
    fst_figure_file figure;
    if (params->magnet_shape != FST_MAGNET_LINES)
        return fst_fail(error, FST_BAD_INPUT, "magnet.shape",
                        "the sketch shows the bar of lines, and this magnet is another: expected lines");
    const double bar = 1e3 * params->magnet_half_length * FST_BAR_OVER_LINES;
    const double reach = 1.5 * bar;
    const fst_legend legend = sketch_legend(params, bar);
    const int top = fst_legend_head(&legend) + TITLE, below = top + ABOVE + AXIS + TITLE;
    const int height = below + BELOW + AXIS + fst_legend_foot(&legend);
    const fst_canvas canvas = fst_canvas_for(NULL, height, 0);
    fst_status status = fst_figure_begin(&figure, out, &canvas, error);
    if (status != FST_OK)
        return status;
    write_above(&figure, params, bar);
    fst_figure_panels(&figure);
    place(&figure, height, LEFT, top, ABOVE, "from above", "x (mm)", "y (mm)");
    draw_above(&figure, params, reach);
    place(&figure, height, LEFT, below, BELOW, "from the side", "along the magnet (mm)", "z (mm)");
    draw_side(&figure, params, bar, reach);
    place(&figure, height, LOCAL_LEFT, below, BELOW, "angles of the moment n", NULL, NULL);
    draw_local(&figure);
    fst_legend_write(&figure, &legend, height);
    return fst_figure_finish(&figure, error);
}

/* ------------------------------------------------------------------ the camera */

/* Write the points of the frames; returns how far the farthest of them is from the middle. */
static double write_frames(fst_figure_file *figure, const double *t, const double *x, const double *y,
                           size_t rows, const fst_params *params)
{
    const double pixels = 1e3 * params->magnet_half_length * PIXELS_A_MM, gamma = params->friction_gamma;
    double reach = 0.0;
    fst_figure_block(figure, "frames", "x/pixels y/pixels: one line a frame of the camera");
    size_t row = 0;
    for (int frame = 0; frame < CAMERA_SECONDS * (int)FRAMES_A_SECOND && rows > 1; ++frame) {
        const double moment = t[0] + frame / FRAMES_A_SECOND * gamma;
        while (row + 2 < rows && t[row + 1] < moment)
            ++row;
        if (t[row + 1] < moment)
            break;
        const double part = (moment - t[row]) / (t[row + 1] - t[row]);
        const double px = pixels * (x[row] + part * (x[row + 1] - x[row]));
        const double py = pixels * (y[row] + part * (y[row + 1] - y[row]));
        (void)fprintf(figure->data, "%.2f %.2f\n", px, py);
        reach = fmax(reach, fmax(fabs(px), fabs(py)));
    }
    return reach;
}

static fst_legend camera_legend(const fst_params *params)
{
    fst_legend legend = {.count = 0};
    const double hertz = fst_drive_frequency(params);
    (void)snprintf(legend.title, sizeof legend.title, "The path at %.3g Hz as a camera sees it", hertz);
    (void)snprintf(legend.about, sizeof legend.about, "%g frames a second for %d s, dynamics %s",
                   FRAMES_A_SECOND, CAMERA_SECONDS, fst_dynamics_name((fst_dynamics)params->model_dynamics));
    fst_legend_add(&legend, FST_SAMPLE_LINE_POINT, "pt 7 ps 0.35 lw 0.8 lc rgb '#0072b2'",
                   "the bead, a point a frame");
    return legend;
}

fst_status fst_figure_camera(const double *t, const double *x, const double *y, size_t rows,
                             const fst_params *params, const char *out, fst_error *error)
{
    fst_figure_file figure;
    const fst_legend legend = camera_legend(params);
    const int top = fst_legend_head(&legend) + 6, height = top + ABOVE + AXIS + fst_legend_foot(&legend);
    const fst_canvas canvas = fst_canvas_for(NULL, height, 0);
    fst_status status = fst_figure_begin(&figure, out, &canvas, error);
    if (status != FST_OK)
        return status;
    const double reach = 1.1 * fmax(write_frames(&figure, t, x, y, rows, params), 1.0);
    fst_figure_panels(&figure);
    char label[64];
    const double frame[4] = {LEFT, LEFT + ABOVE, top, top + ABOVE};
    fst_figure_place(&figure, height, frame);
    (void)snprintf(label, sizeof label, "x (pixels, %g a millimetre)", PIXELS_A_MM);
    fst_figure_axis_label(&figure, height, FST_SIDE_BELOW, label, FST_COLOUR_BLACK, frame);
    fst_figure_axis_label(&figure, height, FST_SIDE_LEFT, "y (pixels)", FST_COLOUR_BLACK, frame);
    (void)fprintf(
        figure.script,
        "set size ratio -1\nset xrange [%.4g:%.4g]\nset yrange [%.4g:%.4g]\n"
        "plot data index 'frames' using 1:2 with linespoints pt 7 ps 0.35 lw 0.8 lc rgb '%s' notitle\n",
        -reach, reach, -reach, reach, fst_colour_code(FST_COLOUR_BLUE));
    fst_legend_write(&figure, &legend, height);
    return fst_figure_finish(&figure, error);
}
