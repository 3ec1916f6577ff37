/* figure_beads.h - the charts of a trajectory of several beads. */
#ifndef FST_DRAW_FIGURE_BEADS_H
#define FST_DRAW_FIGURE_BEADS_H

#include <festoon/bead_files.h>
#include <festoon/festoon_tools.h>

fst_status fst_chart_of_paths(const fst_beads_table *table, const fst_figure_options *options, fst_chart *chart,
                              fst_error *error);
fst_status fst_chart_of_groups(const fst_beads_table *table, const fst_figure_options *options,
                               fst_chart *chart, fst_error *error);

/* Whether two beads, the lesser first, touch in a row. */
int fst_beads_touch_in(const fst_beads_table *table, size_t row, const int beads[2]);

#endif
