/* chart.h - figures of curves: panels one below the other over a common abscissa, each with one or two
 * ordinates.  The titles of curves make one key below them all. */
#ifndef FST_DRAW_CHART_H
#define FST_DRAW_CHART_H

#include "draw/style.h"

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
    int right;            /* belongs to the right-hand ordinate */
    int sign;             /* gnuplot's number of the shape of points; 0: discs */
    const double *spread; /* of the styles with errors and of the band; else NULL */
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
} fst_chart;

fst_status fst_figure_chart(const char *out, const fst_chart *chart, fst_error *error);

#endif
