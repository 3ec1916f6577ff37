/* figure_sweep_axes.h - what figures of sweeps share: axes and keys in the wanted units, and the colours of
 * regimes. */
#ifndef FST_DRAW_FIGURE_SWEEP_AXES_H
#define FST_DRAW_FIGURE_SWEEP_AXES_H

#include "draw/style.h"

#include <festoon/festoon_tools.h>

/* The units of a figure for which nobody asked for any: those of the laboratory where a varied parameter has
 * one, else scaled ones; as given where a varied parameter is a unit itself.  `at`: see fst_sweep_figure; what it fixes
 * is not varied. */
fst_shown_units fst_sweep_units(const fst_grid *grid, const char *const *at);

/* Whether a text "KEY=VALUE" names a key, also by its short name. */
int fst_sweep_is_at(const char *text, const char *key);

/* A label without its unit, "drive frequency". */
void fst_sweep_words(const char *label, char words[128]);

/* The part of a sweep that a figure shows: its varied axes, where all others have one value. */
typedef struct fst_sweep_slice {
    int varied;
    fst_sweep_axis axes[FST_AXIS_LIMIT];
    int64_t start;   /* its first point; the axes' strides lead to the others */
    char words[192]; /* the values of others that have several, "friction.mu 0.2"; "": there are none */
    const struct fst_sweep_slice *whole; /* the family whose curve it is; NULL: it is alone */
} fst_sweep_slice;

/* Why a figure of a sweep has nothing to show: its points are not done yet, or they have no such value. */
const char *fst_sweep_blank(const fst_sweep_table *table);

/* Add to `about` what is the same at all points, and how many of the slice were computed. */
void fst_sweep_about(const fst_sweep_table *table, const fst_sweep_slice *slice, char *about, size_t size);

/* The value of an axis at a point, in the figure's unit. */
double fst_sweep_axis_value(const fst_grid *grid, const fst_sweep_axis *axis, int64_t point);

/* gnuplot's tics for an axis that is a choice, "('rigid' 0, 'farago2020' 1)": the values that occur. */
void fst_sweep_choice_tics(const fst_sweep_axis *axis, char *tics, size_t size);

/* gnuplot's tics for values that are names: those of regimes, symmetries or floating; returns how many names there are, 0
 * where the values of `key` are numbers. */
int fst_sweep_result_tics(const char *key, char *tics, size_t size);

/* Take away the words at the ordinates of which no point has the value. */
void fst_sweep_trim_words(fst_chart *chart);

/* The names that are the values of a key, with colours of their own; NULL: they are others, or numbers. */
typedef struct fst_sweep_names {
    int count;
    const char *words;
    const fst_colour *colours;
} fst_sweep_names;
const fst_sweep_names *fst_sweep_names_of(const char *key);

/* The key of rows that says what became of a point; it has no value where the run failed. */
const char *fst_sweep_state_key(const fst_grid *grid);

/* The colour of a regime in all figures. */
fst_colour fst_regime_colour(int regime);

/* A key of a run as the figure shows it: from its scaled unit in `units`, with the label "mean radius ⟨r⟩ (mm)". */
typedef struct fst_sweep_quantity {
    const char *key, *unit;
    fst_shown_units units; /* FST_SHOWN_SCALED where the unit has no counterpart in others */
    char label[128];
    int asked; /* by the caller, rather than shown as usual */
} fst_sweep_quantity;
fst_sweep_quantity fst_sweep_quantity_of(const fst_grid *grid, const char *key, fst_shown_units units);

/* Bring the first `count` columns of a table, at the points of a slice, to the units of these quantities.  The scaled units
 * are those of each point, as in an export, for a sweep may vary them; a point that lacks one has no value. */
fst_status fst_sweep_convert(const fst_sweep_table *table, const fst_sweep_slice *slice,
                             const fst_sweep_quantity *quantities, int count, fst_error *error);

#endif
