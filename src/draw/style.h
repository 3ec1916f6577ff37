/* style.h - units, palettes and logarithmic axes, as all figures have them. */
#ifndef FST_DRAW_STYLE_H
#define FST_DRAW_STYLE_H

#include "draw/figure_file.h"

#include <festoon/festoon_tools.h>

/* A unit as figures print it: "ℓ²γ²" for "l^2 gamma^2". */
void fst_unit_symbols(const char *unit, char *text, size_t size);

/* Define a palette in the script. */
void fst_figure_palette(fst_figure_file *figure, fst_palette palette);

/* A round number, 1, 2 or 5 times a power of ten, near `rough`. */
double fst_round_step(double rough);

/* Make an axis ("x", "x2", "y") logarithmic, with tics at 1, 2 and 5 times powers of ten. */
void fst_figure_logarithmic(fst_figure_file *figure, const char *axis, double low, double high);

#endif
