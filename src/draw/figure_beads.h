/* figure_beads.h - the charts of a trajectory of several beads. */
#ifndef FST_DRAW_FIGURE_BEADS_H
#define FST_DRAW_FIGURE_BEADS_H

#include <festoon/bead_files.h>
#include <festoon/festoon_tools.h>

fst_status fst_chart_of_paths(const fst_beads_table *table, const fst_figure_options *options, fst_chart *chart,
                              fst_error *error);
fst_status fst_chart_of_groups(const fst_beads_table *table, const fst_figure_options *options,
                               fst_chart *chart, fst_error *error);
fst_status fst_chart_of_lag(const fst_beads_table *table, const fst_figure_options *options, fst_chart *chart,
                            fst_error *error);

/* Whether two beads, the lesser first, touch in a row. */
static inline int fst_beads_touch_in(const fst_beads_table *table, size_t row, const int beads[2])
{
    for (size_t k = table->first[row]; k < table->first[row + 1]; ++k)
        if (table->touches[k].beads[0] == beads[0] && table->touches[k].beads[1] == beads[1])
            return 1;
    return 0;
}

#endif
