/* figure_trajectory.h - the kinds of figure of a trajectory (fst_figure_kind), a function each. */
#ifndef FST_DRAW_FIGURE_TRAJECTORY_H
#define FST_DRAW_FIGURE_TRAJECTORY_H

#include "draw/chart.h"

fst_status fst_figure_path(const fst_table *table, const char *out, const fst_figure_options *options,
                           fst_error *error);
fst_status fst_figure_local_n(const fst_table *table, const char *out, const fst_figure_options *options,
                              fst_error *error);
fst_status fst_figure_radius_field(const fst_table *table, const char *out, const fst_figure_options *options,
                                   fst_error *error);

/* The same as charts: they fill in an empty one.  From zero: the time begins with what is shown. */
fst_status fst_chart_time(const fst_table *table, const fst_figure_options *options, int from_zero,
                          fst_chart *chart, fst_error *error);
fst_status fst_chart_section(const fst_table *table, const fst_figure_options *options, fst_chart *chart,
                             fst_error *error);
fst_status fst_chart_ramp(const fst_table *table, const fst_figure_options *options, fst_chart *chart,
                          fst_error *error);

/* A chart of a trajectory, which fst_chart_free() frees: of the kinds above, or of the path as a bare curve. */
fst_status fst_chart_of_trajectory(const fst_table *table, const fst_figure_options *options, int from_zero,
                                   fst_chart **chart, fst_error *error);

#endif
