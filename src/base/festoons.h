/* festoons.h - how many garlands a bead draws in a lap. */
#ifndef FST_BASE_FESTOONS_H
#define FST_BASE_FESTOONS_H

#include <math.h>

/* N of a bead that circles at the rate `bead` over a magnet that turns at `drive`, both with their signs: r swings `lines`
 * times (2 for S2, 1 for S1) whenever the magnet meets the bead, which is |drive - bead| times in a unit of time. */
static inline double fst_festoons_a_lap(int lines, double drive, double bead)
{
    return lines * fabs(1.0 - drive / bead);
}

#endif
