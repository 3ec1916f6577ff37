/* chart_parts.h - curves, panels, insets and charts (festoon/charts.h), a line each. */
#ifndef FST_PAPER_CHART_PARTS_H
#define FST_PAPER_CHART_PARTS_H

#include <festoon/festoon_tools.h>

/* An array and how many elements it has, as two arguments. */
#define LISTED(array) (array), (int)(sizeof(array) / sizeof((array)[0]))

static inline fst_chart_curve curve_of(const char *title, const double *x, const double *y, size_t count,
                                       fst_colour colour, fst_curve_style style)
{
    return (fst_chart_curve){.title = title, .x = x, .y = y, .count = count, .colour = colour, .style = style};
}

/* The range of its ordinate is [low, high]. */
static inline fst_chart_panel panel_of(const char *label, double low, double high,
                                       const fst_chart_curve *curves, int count)
{
    return (fst_chart_panel){
        .left_label = label, .low = low, .high = high, .curves = curves, .curve_count = count};
}

/* The frame is (left, right, bottom, top); the ranges of the axes are (x_low, x_high, low, high). */
static inline fst_chart_inset inset_of(const double frame[4], const double range[4], const char *label,
                                       const fst_chart_curve *curves, int count)
{
    return (fst_chart_inset){frame[0], frame[1], frame[2], frame[3], range[0], range[1], range[2],
                             range[3], NULL,     label,    curves,   count,    NULL,     0};
}

static inline fst_chart chart_of(const char *title, const char *x_label, double x_low, double x_high,
                                 int height, const fst_chart_panel *panels, int count)
{
    return (fst_chart){.title = title,
                       .x_label = x_label,
                       .x_low = x_low,
                       .x_high = x_high,
                       .height = height,
                       .panels = panels,
                       .panel_count = count};
}

static inline void chart_marks(fst_chart *chart, const fst_chart_mark *marks, int count)
{
    chart->marks = marks;
    chart->mark_count = count;
}

/* A second abscissa on top: x2 = factor x. */
static inline void chart_second(fst_chart *chart, const char *label, double factor)
{
    chart->x2_label = label;
    chart->x2_factor = factor;
}

#endif
