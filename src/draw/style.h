/* style.h - the colours that all figures share; colour-blind readers can tell them apart. */
#ifndef FST_DRAW_STYLE_H
#define FST_DRAW_STYLE_H

#include "draw/figure_file.h"

/* Colours of curves (Okabe and Ito's palette). */
typedef enum {
    FST_COLOUR_BLACK,
    FST_COLOUR_BLUE,
    FST_COLOUR_VERMILION,
    FST_COLOUR_GREEN,
    FST_COLOUR_PURPLE,
    FST_COLOUR_GREY,
    FST_COLOUR_SKY,
    FST_COLOUR_ORANGE
} fst_colour;

/* "#0072b2" */
const char *fst_colour_code(fst_colour colour);

/* A unit as figures print it: "ℓ²γ²" for "l^2 gamma^2". */
void fst_unit_symbols(const char *unit, char *text, size_t size);

/* Define the palette: for a quantity of both signs from blue over grey to vermilion; for one sign by its use.
 * `line`, from light green to dark violet, is for lines on white; `map`, from nearly white to blue, is for
 * areas with dark lines on them. */
typedef enum { FST_PALETTE_DIVERGING, FST_PALETTE_LINE, FST_PALETTE_MAP } fst_palette;
void fst_figure_palette(fst_figure_file *figure, fst_palette palette);

/* A round number, 1, 2 or 5 times a power of ten, near `rough`. */
double fst_round_step(double rough);

/* Make an axis ("x", "x2", "y") logarithmic, with tics at 1, 2 and 5 times powers of ten. */
void fst_figure_logarithmic(fst_figure_file *figure, const char *axis, double low, double high);

#endif
