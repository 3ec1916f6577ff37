/* charts_over.h - charts of one abscissa laid over each other. */
#ifndef FST_DRAW_CHARTS_OVER_H
#define FST_DRAW_CHARTS_OVER_H

#include "draw/chart.h"

/* The colour of a chart among others, from 0. */
fst_colour fst_chart_colour(int place);

/* One chart with the panels of all, in which the curves of each have a colour of their own and its name in the key;
 * fst_chart_free() frees it.  What the others own passes to it, so that they may only be freed.  `about` is the line below the title ("": that
 * of the first).  FST_BAD_INPUT: their abscissas differ. */
fst_status fst_charts_over(fst_chart *const *charts, const char *const *names, int count, const char *about,
                           fst_chart **all, fst_error *error);

#endif
