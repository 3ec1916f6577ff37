/* figure_field.c - a map of the magnet's field (the paper's Fig. 5), drawn by gnuplot. */
#include "base/error.h"
#include "draw/legend.h"
#include "draw/poles.h"

#include <math.h>

enum {
    LEFT = 56, /* pixels about the map */
    RIGHT = 20,
    AXIS = 54,
    SCALE = 64 /* for the scale of colours */
};

/* Where the map begins, how high it is, and the figure; pixels. */
typedef struct field_layout {
    int top, frame, height;
} field_layout;

static void write_map(fst_figure_file *figure, const fst_field_picture *f)
{
    const double *box = f->box;
    fst_figure_block(figure, "map", "X Y and what is shown");
    for (size_t row = 0; row < f->rows; ++row) {
        for (size_t column = 0; column < f->columns; ++column) {
            const double value = f->values[row * f->columns + column];
            (void)fprintf(figure->data, "%.5g %.5g ",
                          box[0] + (box[1] - box[0]) * (double)column / (double)(f->columns - 1),
                          box[2] + (box[3] - box[2]) * (double)row / (double)(f->rows - 1));
            if (isnan(value)) /* in a part of the magnet */
                (void)fputs("NaN\n", figure->data);
            else
                (void)fprintf(figure->data, "%.5g\n", value);
        }
        (void)fputc('\n', figure->data);
    }
}

static void write_data(fst_figure_file *figure, const fst_field_picture *f)
{
    write_map(figure, f);
    if (f->arrow_count)
        fst_figure_block(figure, "arrows", "X Y dX dY: the part in the plane");
    for (const double *at = f->arrows; at < f->arrows + 4 * f->arrow_count; at += 4)
        (void)fprintf(figure->data, "%.5g %.5g %.4g %.4g\n", at[0], at[1], at[2], at[3]);
    fst_figure_block(figure, "labels", "X Y: values of the lines");
    for (int i = 0; i < f->label_count; ++i)
        (void)fprintf(figure->data, "%.6g %.6g %.4g\n", f->labels[i][0], f->labels[i][1], f->labels[i][2]);
    fst_figure_write_lines(figure, f->lines, f->line_count);
    if (f->maximum_count)
        fst_figure_block(figure, "maxima", "X Y: maxima of |B|");
    for (int m = 0; m < f->maximum_count; ++m)
        (void)fprintf(figure->data, "%.8g %.8g\n", f->maxima[m][0], f->maxima[m][1]);
}

/* ------------------------------------------------------------------ script */

static void write_distance(fst_figure_file *figure, const fst_field_picture *f)
{
    const double(*m)[2] = f->maxima;
    if (!f->distance[0])
        return;
    (void)fprintf(
        figure->script,
        "set label '%s' at %.6g,%.6g center offset character 0,0.9 front font ',11'\n"
        "set arrow from %.6g,%.6g to %.6g,%.6g heads size screen 0.010,20 front lc rgb 'black' lw 1.5\n",
        f->distance, (m[0][0] + m[1][0]) / 2.0, (m[0][1] + m[1][1]) / 2.0, m[0][0], m[0][1], m[1][0], m[1][1]);
}

static void write_axes(fst_figure_file *figure, const fst_field_picture *f, const field_layout *l)
{
    const int scale = l->top + l->frame + AXIS;
    const double frame[4] = {LEFT, FST_FIGURE_WIDTH - RIGHT, l->top, l->top + l->frame};
    fst_figure_place(figure, l->height, frame);
    fst_figure_axis_label(figure, l->height, FST_SIDE_BELOW, f->x_label, FST_COLOUR_BLACK, frame);
    fst_figure_axis_label(figure, l->height, FST_SIDE_LEFT, f->y_label, FST_COLOUR_BLACK, frame);
    fst_figure_colour_scale(figure, l->height, f->colour_label,
                            (const double[4]){frame[0], frame[1], scale, scale + 12});
    (void)fprintf(figure->script,
                  "set xrange [%.6g:%.6g]\nset yrange [%.6g:%.6g]\nset cbrange [%.9g:%.9g]\nunset key\n",
                  f->box[0], f->box[1], f->box[2], f->box[3], f->colours.low, f->colours.high);
    fst_figure_palette(figure, f->colours.palette);
}

/* A value of a line stands on a disc of the map's own colour, which interrupts the lines. */
static void write_script(fst_figure_file *figure, const fst_field_picture *f, const field_layout *l)
{
    FILE *script = figure->script;
    fst_figure_panels(figure);
    for (int i = 0; i < f->level_count; ++i)
        (void)fprintf(script, "%s%.9g", i ? "," : "set cntrparam levels discrete ", f->levels[i]);
    if (f->level_count)
        (void)fputs("\nset contour base\nunset surface\nset table $contours\n"
                    "splot data index 'map' using 1:2:3\n"
                    "unset table\nunset contour\nset surface\n",
                    script);
    write_axes(figure, f, l);
    write_distance(figure, f);
    (void)fputs("plot data index 'map' using 1:2:3 with image notitle, \\\n", script);
    if (f->level_count)
        (void)fputs("     $contours using 1:2 with lines lc rgb '#4f759b' lw 0.8 notitle, \\\n", script);
    fst_figure_plot_lines(script, f->lines, f->line_count);
    if (f->label_count)
        (void)fputs("     data index 'labels' using 1:2:3 with points pt 7 ps 1.9 lc palette notitle, \\\n"
                    "     data index 'labels' using 1:2:(sprintf('%.4g', $3)) with labels font ',11' "
                    "textcolor rgb '#0b2a4a' notitle, \\\n",
                    script);
    if (f->arrow_count)
        (void)fputs(
            "     data index 'arrows' using 1:2:3:4 with vectors head filled size screen 0.011,20 lc rgb "
            "'#333333' lw 1 notitle, \\\n",
            script);
    if (f->maximum_count)
        (void)fputs(
            "     data index 'maxima' using 1:2 with points pt 2 ps 1.2 lw 3 lc rgb '#000000' notitle, \\\n",
            script);
    (void)fputs("     NaN notitle\n", script);
}

static fst_legend make_legend(const fst_field_picture *f, const char *title)
{
    fst_legend legend = {.count = 0};
    (void)snprintf(legend.title, sizeof legend.title, "%s", title ? title : f->title);
    (void)snprintf(legend.about, sizeof legend.about, "%s%s%s", title ? f->title : "", title ? "; " : "",
                   f->about);
    if (f->level_count)
        fst_legend_add(&legend, FST_SAMPLE_LINE, "lc rgb '#4f759b' lw 0.8", f->level_words);
    if (f->maximum_count > 0)
        fst_legend_add(&legend, FST_SAMPLE_POINT, "pt 2 ps 1.2 lw 3 lc rgb '#000000'", "maxima of |B|");
    fst_legend_add_lines(&legend, f->lines, f->line_count);
    if (f->arrow_count == 0)
        return legend;
    fst_legend_add(&legend, FST_SAMPLE_ARROW, "lc rgb '#333333' lw 1", f->arrow_words);
    legend.entries[legend.count - 1].length = f->longest * (FST_FIGURE_WIDTH - LEFT - RIGHT);
    return legend;
}

fst_status fst_figure_field_map(const fst_params *params, const fst_field_options *options, const char *out,
                                fst_error *error)
{
    fst_field_picture picture;
    fst_figure_file figure;
    fst_status status = fst_field_picture_of(params, options, &picture, error);
    if (status == FST_OK) {
        const fst_legend legend = make_legend(&picture, options ? options->title : NULL);
        const double *box = picture.box;
        field_layout l = {.top = fst_legend_head(&legend) + 6};
        l.frame = (int)((FST_FIGURE_WIDTH - LEFT - RIGHT) * (box[3] - box[2]) / (box[1] - box[0]));
        const fst_canvas canvas = fst_canvas_for(options ? options->size : NULL,
                                                 l.top + l.frame + AXIS + SCALE + fst_legend_foot(&legend), 0);
        l.top += canvas.more / 2;
        l.height = canvas.height;
        status = fst_figure_begin(&figure, out, &canvas, error);
        if (status == FST_OK) {
            fst_figure_scene_of(&figure, params);
            write_data(&figure, &picture);
            write_script(&figure, &picture, &l);
            fst_legend_write(&figure, &legend, l.height);
            status = fst_figure_finish(&figure, error);
        }
    }
    fst_field_picture_free(&picture);
    return status;
}

fst_status fst_figure_field(const fst_params *params, fst_shown_units units, const char *out, fst_error *error)
{
    fst_field_options options = fst_default_field_options();
    options.units = units;
    return fst_figure_field_map(params, &options, out, error);
}
