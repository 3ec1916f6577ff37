/* figure_trajectory.h - the kinds of figure of a trajectory (fst_figure_kind), a function each. */
#ifndef FST_DRAW_FIGURE_TRAJECTORY_H
#define FST_DRAW_FIGURE_TRAJECTORY_H

#include <festoon/festoon_tools.h>

fst_status fst_figure_path(const fst_table *table, const char *out, const fst_figure_options *options,
                           fst_error *error);
fst_status fst_figure_local_n(const fst_table *table, const char *out, const fst_figure_options *options,
                              fst_error *error);
fst_status fst_figure_radius_field(const fst_table *table, const char *out, const fst_figure_options *options,
                                   fst_error *error);
fst_status fst_figure_time(const fst_table *table, const char *out, const fst_figure_options *options,
                           fst_error *error);
fst_status fst_figure_section(const fst_table *table, const char *out, const fst_figure_options *options,
                              fst_error *error);
fst_status fst_figure_ramp(const fst_table *table, const char *out, const fst_figure_options *options,
                           fst_error *error);

#endif
