/* bar.h - the bar magnet that the lines of dipoles stand for, as pictures show it. */
#ifndef FST_DRAW_BAR_H
#define FST_DRAW_BAR_H

/* The paper's magnet is 56 mm long (section II), and the lines that stand for it are 46 mm long (section IV); a
 * bar for other lines is drawn in the same proportion. */
#define FST_BAR_OVER_LINES (56.0 / 46.0)
#define FST_BAR_THICKNESS 9.0 /* mm */

#endif
