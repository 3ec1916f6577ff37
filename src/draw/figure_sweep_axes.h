/* figure_sweep_axes.h - what figures of sweeps share: axes and keys in the unit that is wanted, and the colours
 * of regimes. */
#ifndef FST_DRAW_FIGURE_SWEEP_AXES_H
#define FST_DRAW_FIGURE_SWEEP_AXES_H

#include "draw/style.h"

#include <festoon/festoon_tools.h>

/* An axis of a sweep as figures show it: its values in the unit that is wanted. */
typedef struct fst_sweep_axis {
    int index; /* in the grid */
    int64_t count;
    double factor;                /* from the grid's unit to that one */
    int logarithmic;              /* its values are spaced so */
    const fst_param_info *choice; /* a choice, whose values have names; NULL: numbers */
    char label[96];               /* "drive frequency (Hz)" */
} fst_sweep_axis;

/* FST_BAD_INPUT: a varied parameter changes the units that are asked for. */
fst_status fst_sweep_axis_of(const fst_grid *grid, int index, fst_shown_units units, fst_sweep_axis *axis,
                             fst_error *error);

/* Value of an axis at a point, in the figure's unit. */
double fst_sweep_axis_value(const fst_grid *grid, const fst_sweep_axis *axis, int64_t point);

/* gnuplot's tics for an axis that is a choice, "('rigid' 0, 'farago2020' 1)". */
void fst_sweep_choice_tics(const fst_param_info *choice, char *tics, size_t size);

/* The colour of a regime in all figures. */
fst_colour fst_regime_colour(int regime);

/* A key of a run as figures show it: its values times `factor`, and "mean r (l)". */
typedef struct fst_sweep_quantity {
    const char *key;
    double factor;
    char label[96];
} fst_sweep_quantity;
fst_status fst_sweep_quantity_of(const fst_grid *grid, const char *key, fst_shown_units units,
                                 fst_sweep_quantity *quantity, fst_error *error);

#endif
