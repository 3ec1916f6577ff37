/* figure_sweep.h - figures of sweeps: curves over one axis, maps over two. */
#ifndef FST_DRAW_FIGURE_SWEEP_H
#define FST_DRAW_FIGURE_SWEEP_H

#include "draw/figure_sweep_axes.h"

fst_status fst_figure_sweep_curves(const fst_sweep_table *table, const fst_sweep_quantity *quantities,
                                   int count, const fst_sweep_axis *axis, const char *out, fst_error *error);
fst_status fst_figure_sweep_map(const fst_sweep_table *table, const fst_sweep_quantity *quantity,
                                const fst_sweep_axis axes[2], const char *out, fst_error *error);

#endif
