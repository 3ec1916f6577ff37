/* chart.h - making a chart (festoon/charts.h) that owns what it shows. */
#ifndef FST_DRAW_CHART_H
#define FST_DRAW_CHART_H

#include "draw/style.h"

#include <festoon/festoon_tools.h>

/* Memory of zeros that hangs on `memory`, NULL at first, until all of it is freed; NULL: there is none. */
void *fst_keep(void **memory, size_t size);
void fst_keep_free(void *memory);

/* An empty chart; NULL: no memory. */
fst_chart *fst_chart_new(void);

/* Memory of zeros that belongs to the chart, and a copy of a text; NULL: there is none. */
void *fst_chart_keep(fst_chart *chart, size_t size);
const char *fst_chart_text(fst_chart *chart, const char *text);

/* The text of a scene, which belongs to the chart; NULL: there is no memory. */
const char *fst_chart_scene(fst_chart *chart, const fst_params *params);

/* Draw a chart with another title (NULL: its own) and in another size. */
fst_status fst_figure_chart_as(const char *out, fst_chart *chart, const char *title, const double size[2],
                               fst_error *error);

/* Give a chart all that another one owns. */
void fst_chart_adopt(fst_chart *chart, fst_chart *other);

#endif
