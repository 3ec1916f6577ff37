/* smooth.h - a smooth curve through points that are few. */
#ifndef FST_DRAW_SMOOTH_H
#define FST_DRAW_SMOOTH_H

#include <stddef.h>

/* Put `parts` points for each piece between neighbours, and the last point, into `to_x` and `to_y`, which need
 * room for parts (count - 1) + 1; returns how many there are.  The curve passes every point, and is drawn for
 * axes on which lengths `wide` and `tall` look alike.  All numbers must be finite. */
size_t fst_smooth(const double *x, const double *y, size_t count, int parts, double wide, double tall,
                  double *to_x, double *to_y);

#endif
