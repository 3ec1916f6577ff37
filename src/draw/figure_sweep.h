/* figure_sweep.h - figures of sweeps: curves over one axis, families of curves and maps over two. */
#ifndef FST_DRAW_FIGURE_SWEEP_H
#define FST_DRAW_FIGURE_SWEEP_H

#include "draw/figure_sweep_axes.h"

/* A chart of keys over the one axis of a slice, which fst_chart_free() frees.  Behind these the table has the key of
 * fst_sweep_state_key(): signs at the lower edge tell which points failed, or were ejected, or undecided.  Plain: without
 * the colours of regimes, to be laid over others. */
fst_status fst_sweep_curves(const fst_sweep_table *table, const fst_sweep_quantity *quantities, int count,
                            const fst_sweep_slice *slice, int plain, fst_chart **chart, fst_error *error);

/* Which sign stands for a run of this state, because it is no motion or an undecided one; -1: none, or there is no run. */
int fst_sweep_gap(const char *state_key, double state, int computed);

/* Whether a line joins a computed run of this state to the next one, of the state `next`. */
int fst_sweep_joins(const char *state_key, double state, double next);

enum { FST_SWEEP_GAPS = 6, FST_SWEEP_UNDECIDED = 0, FST_SWEEP_FAILED = FST_SWEEP_GAPS - 1 };

/* Such signs, without their places: for a panel whose right ordinate reaches from 0 to 1.  The title is a word. */
fst_chart_curve fst_sweep_sign(const char *state_key, int gap);
#define FST_SWEEP_EDGE 0.03 /* how high signs stand over the lower edge, in parts of the panel */

fst_status fst_figure_sweep_map(const fst_sweep_table *table, const fst_sweep_quantity *quantity,
                                const fst_sweep_slice *slice, const fst_sweep_figure *options, const char *out,
                                fst_error *error);

/* The slice that `figure` asks for of a sweep read from `path`, over one axis or two, in these units. */
fst_status fst_sweep_cut(const fst_grid *grid, const char *path, const fst_sweep_figure *figure,
                         fst_shown_units units, fst_sweep_slice *slice, fst_error *error);

/* What a figure of several files asks for of one of them: the values of those axes that its sweep has; used[i] becomes 1
 * for each place in figure->at that it has. */
fst_sweep_figure fst_sweep_figure_of(const fst_grid *grid, const fst_sweep_figure *figure,
                                     int used[FST_AXIS_LIMIT]);

/* Refuse a value that no sweep of these has. */
fst_status fst_sweep_check_used(const fst_sweep_figure *figure, const int used[FST_AXIS_LIMIT],
                                fst_error *error);

/* The chart of fst_figure_sweep() over one axis, to be laid over others, and which part it shows; fst_chart_free() frees
 * it. */
fst_status fst_chart_of_sweep(const char *path, const fst_sweep_figure *options, fst_chart **chart,
                              fst_sweep_slice *slice, fst_error *error);

#endif
