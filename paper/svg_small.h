/* svg_small.h - a figure made small enough for a page that holds all of them. */
#ifndef FST_PAPER_SVG_SMALL_H
#define FST_PAPER_SVG_SMALL_H

/* The same picture as `svg` in fewer letters; free() it, NULL: no memory.  `svg` is written to while this
 * works, and is unchanged at the end. */
char *fst_svg_small(char *svg);

#endif
