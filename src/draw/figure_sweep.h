/* figure_sweep.h - figures of sweeps: curves over one axis, maps over two. */
#ifndef FST_DRAW_FIGURE_SWEEP_H
#define FST_DRAW_FIGURE_SWEEP_H

#include "draw/style.h"

#include <festoon/festoon_tools.h>

/* An axis of a sweep as figures show it: its values in the unit that people use for it. */
typedef struct fst_sweep_axis {
    int index; /* in the grid */
    int64_t count;
    double factor;  /* from SI to that unit */
    char label[96]; /* "drive frequency (Hz)" */
} fst_sweep_axis;
fst_sweep_axis fst_sweep_axis_of(const fst_grid *grid, int index);

/* Value of an axis at a point, in the figure's unit. */
double fst_sweep_axis_value(const fst_grid *grid, const fst_sweep_axis *axis, int64_t point);

/* The colour of a regime in all figures. */
fst_colour fst_regime_colour(int regime);

/* "mean r (l)": a key with its unit. */
void fst_sweep_key_label(const char *key, char *label, size_t size);

fst_status fst_figure_sweep_curves(const fst_sweep_table *table, const char *const *keys, int count,
                                   const fst_sweep_axis *axis, const char *out, fst_error *error);
fst_status fst_figure_sweep_map(const fst_sweep_table *table, const char *key, const fst_sweep_axis axes[2],
                                const char *out, fst_error *error);

#endif
