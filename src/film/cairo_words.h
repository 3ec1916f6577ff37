/* cairo_words.h - colours and words of a frame. */
#ifndef FST_FILM_CAIRO_WORDS_H
#define FST_FILM_CAIRO_WORDS_H

#include <cairo.h>

#include "film/frame.h"

extern const double fst_pen_north[3], fst_pen_south[3]; /* of poles: red, green, blue */

/* Set the colour of a trail at a shade from 0 to 1. */
void fst_pen_shade(cairo_t *pen, int both_signs, double shade);
void fst_pen_write(cairo_t *pen, double x, double y, double size, const char *text);

/* The greatest 1, 2 or 5 times a power of ten that is not above `most`. */
double fst_round_length(double most);

void fst_pen_scale_bar(cairo_t *pen, const fst_film_layout *layout, double scale);
void fst_pen_key(cairo_t *pen, const fst_film_layout *layout);
void fst_pen_bead_key(cairo_t *pen, const fst_film_layout *layout, const fst_film_frame *frame);
void fst_pen_colour_bar(cairo_t *pen, const fst_film_layout *layout);

#endif
