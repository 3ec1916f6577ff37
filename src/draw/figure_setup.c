/* figure_setup.c - the sketch of the experiment, and the path as the paper's camera would see it. */
#include "draw/figure_setup.h"

#include "base/constants.h"
#include "base/error.h"

#include "draw/style.h"

#include <math.h>

#define FRAMES_A_SECOND 200.0 /* the paper's camera (section III) */
#define PIXELS_A_MM 10.0      /* the paper gives no scale */
#define MAGNET_THICKNESS 9.0  /* mm, the paper's magnet (section II) */

enum { CAMERA_SECONDS = 2, CAMERA_WIDTH = 690, CAMERA_HEIGHT = 640, SKETCH_WIDTH = 760, SKETCH_HEIGHT = 430 };

static const double degree = 0.017453292519943295;
static const double MOMENT_ANGLE = 110.0; /* the angle of the sketched moment against e_r */

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
static void write_turning(fst_figure_file *figure)
{
    fst_figure_block(figure, "turning", "x/mm y/mm dx dy: the sense of the magnet's turning");
    for (int side = 0; side < 2; ++side) {
        double at = (205.0 + 180.0 * side) * degree, reach = 33.0, step = 9.0;
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

static void write_sketch_data(fst_figure_file *figure, const fst_params *p)
{
    double l = 1e3 * p->magnet_half_length, width = 1e3 * p->magnet_width, depth = 1e3 * p->magnet_depth;
    double radius = 1e3 * p->bead_radius, r = 0.9 * l;
    const double above[4] = {0.0, 0.0, l, 0.5 * width}, beside[4] = {0.0, -depth, l, 0.5 * MAGNET_THICKNESS};
    write_box(figure, "magnet-above", above, 25.0);
    write_circle(figure, "bead-above", r * cos(60 * degree), r * sin(60 * degree), radius);
    write_arc(figure, "angle", 0.0, 0.0, 12.0, 25.0, 60.0);
    write_turning(figure);
    write_box(figure, "magnet-beside", beside, 0.0);
    write_circle(figure, "bead-beside", r, radius, radius);
    write_arc(figure, "theta", r, radius, 6.0, 0.0, MOMENT_ANGLE);
    fst_figure_block(figure, "lines", "x/mm y/mm dx dy: the model's lines of dipoles");
    for (int k = 0; k < p->magnet_lines; ++k) {
        double across = p->magnet_lines > 1 ? width * (k / (p->magnet_lines - 1.0) - 0.5) : 0.0;
        double c = cos(25 * degree), s = sin(25 * degree);
        (void)fprintf(figure->data, "%.6g %.6g %.6g %.6g\n", -l * c - across * s, -l * s + across * c,
                      2 * l * c, 2 * l * s);
    }
    double turned = 60 * degree, c = cos(turned), s = sin(turned);
    (void)fprintf(figure->script,
                  "set multiplot title 'The setup to scale'\n"
                  "set size ratio -1\nset grid ls 101\n"
                  "set tmargin at screen 0.86\nset bmargin at screen 0.15\n"
                  "set lmargin at screen 0.08\nset rmargin at screen 0.50\n"
                  "set xrange [-36:36]\nset yrange [-36:36]\n"
                  "set xlabel 'x (mm)'\nset ylabel 'y (mm)' offset 1,0\nset title 'from above' font ',12'\n"
                  "set arrow 1 from 0,0 to %.5g,%.5g front nohead lc rgb '#222222' lw 1.4\n"
                  "set label 1 'r' at %.5g,%.5g front\n"
                  "set arrow 2 from 0,0 to %.5g,%.5g front nohead dt 2 lc rgb '#222222'\n"
                  "set label 2 'Φ' at 13.5,10.5 center front\n"
                  "set label 3 'ω' at -29,-22 center front\n"
                  "set arrow 4 from %.5g,%.5g to %.5g,%.5g front lc rgb '#009e73' lw 2\n"
                  "set label 4 'e_r' at %.5g,%.5g center front textcolor rgb '#009e73'\n"
                  "set arrow 5 from %.5g,%.5g to %.5g,%.5g front lc rgb '#009e73' lw 2\n"
                  "set label 5 'e_α' at %.5g,%.5g center front textcolor rgb '#009e73'\n",
                  r * c, r * s, 0.5 * r * c - 3.0, 0.5 * r * s + 1.0, 30 * cos(25 * degree),
                  30 * sin(25 * degree), r * c, r * s, (r + 8) * c, (r + 8) * s, (r + 11) * c, (r + 11) * s,
                  r * c, r * s, r * c - 8 * s, r * s + 8 * c, r * c - 11.5 * s, r * s + 11.5 * c);
}

static const char sketch_plots[] =
    "plot data index 'magnet-above' using 1:2 with filledcurves closed fc rgb '#eeeeee' notitle, \\\n"
    "     data index 'magnet-above' using 1:2 with lines lc rgb '#888888' notitle, \\\n"
    "     data index 'lines' using 1:2:3:4 with vectors nohead lc rgb '#0072b2' lw 1.5 notitle, \\\n"
    "     data index 'bead-above' using 1:2 with filledcurves closed fc rgb '#d55e00' notitle, \\\n"
    "     data index 'angle' using 1:2 with lines lc rgb '#222222' lw 1.2 notitle, \\\n"
    "     data index 'turning' using 1:2:3:4 with vectors head filled lc rgb '#222222' lw 1.2 notitle\n"
    "unset arrow\nunset label\nunset object\n"
    "set lmargin at screen 0.57\nset rmargin at screen 0.98\n"
    "set xrange [-36:36]\nset yrange [-40:32]\n"
    "set xlabel 'along the magnet (mm)'\nset ylabel 'z (mm)'\nset title 'from the side' font ',12'\n"
    "set arrow 1 from -36,0 to 36,0 nohead lc rgb '#222222' lw 2\n"
    "set label 1 'plate' at -35,3\n";

fst_status fst_figure_sketch(const fst_params *params, const char *out, fst_error *error)
{
    fst_figure_file figure;
    if (params->magnet_shape != FST_MAGNET_LINES)
        return fst_fail(error, FST_BAD_INPUT, "magnet.shape",
                        "the sketch shows the bar of lines, and this magnet is another: expected lines");
    fst_status status = fst_figure_begin(&figure, out, SKETCH_WIDTH, SKETCH_HEIGHT, error);
    if (status != FST_OK)
        return status;
    write_sketch_data(&figure, params);
    (void)fputs(sketch_plots, figure.script);
    double depth = 1e3 * params->magnet_depth, radius = 1e3 * params->bead_radius;
    double r = 0.9e3 * params->magnet_half_length;
    double along = 10.0 * cos(MOMENT_ANGLE * degree), up = 10.0 * sin(MOMENT_ANGLE * degree);
    (void)fprintf(figure.script,
                  "set arrow 2 from -28,0 to -28,%.5g heads size screen 0.006,20 lc rgb '#666666'\n"
                  "set label 2 '%.4g mm' at -27,%.5g font ',11'\n"
                  "set arrow 3 from %.5g,%.5g to %.5g,%.5g front lc rgb '#222222' lw 2\n"
                  "set label 3 'n' at %.5g,%.5g center front\n"
                  "set arrow 4 from 0,-36 to 0,28 nohead dt 4 lc rgb '#888888'\n"
                  "set label 4 'e_z' at 2,27 textcolor rgb '#666666'\n"
                  "set arrow 5 from %.5g,%.5g rto 11,0 front lc rgb '#009e73' lw 2\n"
                  "set label 5 'e_r' at %.5g,%.5g center front textcolor rgb '#009e73'\n"
                  "set label 6 'θ' at %.5g,%.5g center front\n"
                  "set label 7 'magnet' at 0,%.5g center front font ',11'\n",
                  -depth, depth, -0.45 * depth, r, radius, r + along, radius + up, r + 1.35 * along,
                  radius + 1.3 * up, r, radius, r + 12.5, radius + 3.5, r + 5.5, radius + 7.5, -depth);
    (void)fputs(
        "plot data index 'magnet-beside' using 1:2 with filledcurves closed fc rgb '#eeeeee' notitle, \\\n"
        "     data index 'magnet-beside' using 1:2 with lines lc rgb '#888888' notitle, \\\n"
        "     data index 'theta' using 1:2 with lines lc rgb '#222222' lw 1.2 notitle, \\\n"
        "     data index 'bead-beside' using 1:2 with filledcurves closed fc rgb '#d55e00' notitle\n"
        "unset multiplot\n",
        figure.script);
    return fst_figure_finish(&figure, error);
}

/* ------------------------------------------------------------------ the camera */

fst_status fst_figure_camera(const double *t, const double *x, const double *y, size_t rows,
                             const fst_params *params, const char *out, fst_error *error)
{
    fst_figure_file figure;
    fst_status status = fst_figure_begin(&figure, out, CAMERA_WIDTH, CAMERA_HEIGHT, error);
    if (status != FST_OK)
        return status;
    double pixels = 1e3 * params->magnet_half_length * PIXELS_A_MM, gamma = params->friction_gamma;
    fst_figure_block(&figure, "frames", "x/pixels y/pixels: one line a frame of the camera");
    size_t row = 0;
    for (int frame = 0; frame < CAMERA_SECONDS * (int)FRAMES_A_SECOND && rows > 1; ++frame) {
        double moment = t[0] + frame / FRAMES_A_SECOND * gamma;
        while (row + 2 < rows && t[row + 1] < moment)
            ++row;
        if (t[row + 1] < moment)
            break;
        double part = (moment - t[row]) / (t[row + 1] - t[row]);
        (void)fprintf(figure.data, "%.2f %.2f\n", pixels * (x[row] + part * (x[row + 1] - x[row])),
                      pixels * (y[row] + part * (y[row + 1] - y[row])));
    }
    (void)fprintf(
        figure.script,
        "set title 'The path at %.3g Hz as a camera sees it: %g frames a second, %d s' noenhanced\n"
        "set size ratio -1\nset grid ls 101\n"
        "set xrange [-300:300]\nset yrange [-300:300]\n"
        "set xlabel 'x (pixels, %g a millimetre)'\nset ylabel 'y (pixels)'\n"
        "plot data index 'frames' using 1:2 with linespoints pt 7 ps 0.35 lw 0.8 lc rgb '%s' notitle\n",
        (isfinite(params->drive_omega) ? params->drive_omega * gamma / FST_TWO_PI : params->drive_frequency),
        FRAMES_A_SECOND, CAMERA_SECONDS, PIXELS_A_MM, fst_colour_code(FST_COLOUR_BLUE));
    return fst_figure_finish(&figure, error);
}
