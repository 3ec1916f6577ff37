/* charts.h - what a figure shows, as numbers and words, so that the program (by gnuplot) and Python (by
 * matplotlib) draw the same; festoon_tools.h includes it.
 */
#ifndef FESTOON_CHARTS_H
#define FESTOON_CHARTS_H

#include <festoon/look.h>

#ifdef __cplusplus
extern "C" {
#endif

struct fst_table; /* a trajectory, festoon_tools.h */
struct fst_figure_options;

/* ------------------------------------------------------------------ curves */

/* Panels one below the other over a common abscissa, each with one or two ordinates.  The titles of curves make
 * one key below them all. */
typedef enum {
    FST_CURVE_LINE,
    FST_CURVE_DASHED,
    FST_CURVE_POINTS,
    FST_CURVE_OPEN_POINTS,
    FST_CURVE_LINE_POINTS, /* few points; the line only guides the eye between them */
    FST_CURVE_DASHED_POINTS,
    FST_CURVE_THIN,        /* a thin line */
    FST_CURVE_SIGNS,       /* points of different shapes */
    FST_CURVE_DOTS,        /* small points, where there are many */
    FST_CURVE_ERRORS,      /* points with error bars, y - spread to y + spread */
    FST_CURVE_OPEN_ERRORS, /* the same with open points */
    FST_CURVE_BAND         /* a pale area from y - spread to y + spread */
} fst_curve_style;

typedef struct fst_chart_curve {
    const char *title;   /* its name in the key; NULL: it is not in the key */
    const double *x, *y; /* a NAN breaks the line */
    size_t count;
    fst_colour colour;
    fst_curve_style style;
    int right;              /* belongs to the right-hand ordinate */
    int sign;               /* gnuplot's number of the shape of points; 0: discs */
    const double *spread;   /* of the styles with errors and of the band; else NULL */
    const double *x_spread; /* of points with errors; NULL: none */
} fst_chart_curve;

/* A word at a place of an inset. */
typedef struct fst_chart_label {
    double x, y;
    const char *text;
} fst_chart_label;

/* A small chart within a panel, on white ground. */
typedef struct fst_chart_inset {
    double left, right, bottom, top; /* its frame, in parts of the panel */
    double x_low, x_high, low, high; /* the ranges of its axes; NAN: from the data */
    const char *x_label, *label;     /* NULL: none */
    const fst_chart_curve *curves;
    int curve_count;
    const fst_chart_label *labels;
    int label_count;
} fst_chart_inset;

typedef struct fst_chart_panel {
    const char *left_label, *right_label; /* right: NULL where there is none */
    fst_colour left_colour,
        right_colour;             /* of the labels, where they say which curves belong to which ordinate */
    double low, high;             /* range of the left ordinate; NAN: from the data */
    double right_low, right_high; /* range of the right ordinate; both 0: from the data */
    const char *tics;             /* gnuplot's tics of the left ordinate, "('locked' 1)"; NULL: automatic */
    const fst_chart_curve *curves;
    int curve_count;
    const fst_chart_inset *inset; /* NULL: none */
} fst_chart_panel;

/* A vertical line through all panels, with its text in the key.  Several ones with texts are told apart by the
 * letters a, b, c. */
typedef struct fst_chart_mark {
    double x;
    const char *text;
} fst_chart_mark;

typedef struct fst_chart {
    const char *title, *about; /* what is shown, and of what (NULL: no more) */
    const char *scene;         /* its text is written into the script as comments; NULL: there is none */
    double size[2]; /* of the figure, width and height in m; 0: 0.127, and as high as it needs.  Letters
                                  grow with the width; a PNG has 192 pixels an inch */
    const char *x_label;
    double x_low, x_high;
    int x_logarithmic;
    const char *x_tics;   /* gnuplot's tics, "('0' 0, 'π' 3.14159)"; NULL: automatic */
    const char *x2_label; /* a second abscissa on top, x2 = x2_factor x; NULL: none */
    double x2_factor;
    int height;         /* of each panel in pixels; 0: as usual */
    int square;         /* one unit is equally long on both axes */
    const char *remark; /* one more line of the key, without a sample; NULL: none */
    const fst_chart_panel *panels;
    int panel_count;
    const fst_chart_mark *marks;
    int mark_count;
    void *memory; /* what fst_chart_free() frees; NULL: everything is the caller's own */
} fst_chart;

/* Draw a chart to OUT.(svg|pdf|png) with gnuplot, as fst_figure_trajectory() does. */
FST_API fst_status fst_figure_chart(const char *out, const fst_chart *chart, fst_error *error);

/* Plate, bead and magnet to scale, from above and from the side, and the angles of the moment (the paper's
 * Fig. 1). */
FST_API fst_status fst_figure_sketch(const fst_params *params, const char *out, fst_error *error);

/* The bead's path as a camera of 200 frames a second sees it: a point a frame, for two seconds (the paper's
 * Fig. 2).  `rows` samples of t (1/gamma), x and y (l). */
FST_API fst_status fst_figure_camera(const double *t, const double *x, const double *y, size_t rows,
                                     const fst_params *params, const char *out, fst_error *error);

/* The chart of fst_figure_branch(), with its arguments; fst_chart_free() frees it. */
FST_API fst_status fst_chart_of_branch(const fst_branch *branch, const char *observable, fst_shown_units units,
                                       const double *dots, size_t dot_count, fst_chart **chart,
                                       fst_error *error);
FST_API void fst_chart_free(fst_chart *chart);

/* ------------------------------------------------------------------ sweeps */

/* An axis of a sweep as the figure shows it, with its values in the wanted unit. */
typedef struct fst_sweep_axis {
    int index; /* its index in the grid */
    int64_t count;
    double factor;                /* from the grid's unit to the wanted one */
    int logarithmic;              /* its values are spaced by a factor */
    const fst_param_info *choice; /* set for a choice, whose values have names; NULL: its values are numbers */
    unsigned swept;  /* of a choice, bit i: its value i occurs; the value of the axis counts these */
    char label[128]; /* "drive frequency (Hz)" */
} fst_sweep_axis;

/* FST_BAD_INPUT: a varied parameter changes the wanted units. */
FST_API fst_status fst_sweep_axis_of(const fst_grid *grid, int index, fst_shown_units units,
                                     fst_sweep_axis *axis, fst_error *error);

/* ------------------------------------------------------------------ trajectories */

/* The part of a trajectory that a figure of options->kind shows: rows first <= row < last; its units, and what
 * is known of the bead, "ω = 0.215 (10.7 Hz), dynamics rigid". */
typedef struct fst_figure_part {
    size_t first, last;
    fst_shown_units units;
    char about[256];
} fst_figure_part;
FST_API fst_status fst_figure_part_of(const struct fst_table *table, const struct fst_figure_options *options,
                                      fst_figure_part *part, fst_error *error);

/* The palette of a quantity with values from `least` to `greatest`, and the range of its scale. */
typedef struct fst_colour_range {
    fst_palette palette;
    double low, high;
} fst_colour_range;
FST_API fst_colour_range fst_colours_between(const char *name, double least, double greatest);

/* ------------------------------------------------------------------ the magnet */

/* A line of the magnet, as pictures show it from above. */
typedef struct fst_picture_line {
    const char *name;    /* "magnet", "lines", "north", "south" */
    const double *x, *y; /* a NAN breaks the line */
    size_t count;
    const char *words, *colour; /* in the key; "#d55e00" */
    double width;               /* of the line, in pixels */
    int is_ground;              /* what it encloses is grey */
} fst_picture_line;
enum { FST_PICTURE_LINES = 2, FST_PICTURE_LEVELS = 24, FST_PICTURE_MAXIMA = 8 };

/* The arrow of a horizontal moment in a picture of the path, in sides of its square. */
#define FST_LONGEST_ARROW 0.07

/* The path of the bead over the plate, or as seen from the turning magnet. */
typedef struct fst_path_picture {
    char title[96], about[256], x_label[64], y_label[64], colour_label[128];
    double box[4]; /* x0 x1 y0 y1 of the square that is shown */
    size_t count;  /* of the points of the path, a smooth curve through the samples */
    double *x, *y, *colour;
    fst_colour_range colours;
    size_t arrow_count; /* of the moment's horizontal part; 0: none are wanted */
    double *arrows;     /* x y dx dy of each */
    int begins_inside;  /* the first point lies in the box */
    int line_count;     /* of the magnet's lines at the beginning */
    fst_picture_line lines[FST_PICTURE_LINES];
    void *memory; /* of fst_path_picture_free() */
} fst_path_picture;
FST_API fst_status fst_path_picture_of(const struct fst_table *table, const struct fst_figure_options *options,
                                       fst_path_picture *picture, fst_error *error);
FST_API void fst_path_picture_free(fst_path_picture *picture);

/* ------------------------------------------------------------------ the field */

struct fst_field_options;

/* A map of the magnet's field, or of what it does to a bead, on a plane over the magnet. */
typedef struct fst_field_picture {
    char title[160], about[340], x_label[64], y_label[64], colour_label[96];
    double box[4];        /* x0 x1 y0 y1 */
    size_t columns, rows; /* of places spread evenly from edge to edge of the box */
    double *values;       /* at row * columns + column; NAN in a part of the magnet */
    fst_colour_range colours;
    int level_count; /* of lines of equal value */
    double levels[FST_PICTURE_LEVELS];
    char level_words[64];
    int label_count; /* where their values stand: x y value */
    double labels[FST_PICTURE_LEVELS][3];
    size_t arrow_count;
    double *arrows; /* x y dx dy of each */
    double longest; /* of the arrows, in widths of the box */
    char arrow_words[160];
    int maximum_count; /* of |B| */
    double maxima[FST_PICTURE_MAXIMA][2];
    char distance[32]; /* of two maxima, "40.5 mm"; "": there are not two */
    int line_count;
    fst_picture_line lines[FST_PICTURE_LINES];
    void *memory; /* of fst_field_picture_free() */
} fst_field_picture;
/* Without options (NULL) the map of the defaults. */
FST_API fst_status fst_field_picture_of(const fst_params *params, const struct fst_field_options *options,
                                        fst_field_picture *picture, fst_error *error);
FST_API void fst_field_picture_free(fst_field_picture *picture);

#ifdef __cplusplus
}
#endif

#endif
