/* figure_radius_field.c - r and |B| while the magnet passes under the bead (the paper's Fig. 13). */
#include "draw/figure_trajectory.h"

#include "draw/chart.h"
#include "base/constants.h"
#include "base/error.h"
#include <festoon/festoon_tools.h>
#include "draw/view.h"

#include <stdlib.h>

/* Fold Phi into half a revolution of the magnet.  Each fold gets a row of NAN, so that the line
 * breaks there. */
typedef struct folded {
    double *bead_angle, *r, *b;
    size_t count;
} folded;

static void fold(const fst_view *view, const double *bead_angle, const double *r, const double *b,
                 folded *curve)
{
    double previous = NAN;
    for (size_t row = view->first; row < view->last; ++row) {
        double half_turn = floor(bead_angle[row] / FST_PI);
        size_t i = curve->count;
        if (!isnan(previous) && half_turn != previous) {
            curve->bead_angle[i] = curve->r[i] = curve->b[i] = NAN;
            ++i;
        }
        previous = half_turn;
        curve->bead_angle[i] = bead_angle[row] - half_turn * FST_PI;
        curve->r[i] = r[row];
        curve->b[i] = b[row];
        curve->count = i + 1;
    }
}

/* The label of an axis with the colour of its curve in words. */
static void with_colour(const fst_quantity *quantity, const char *colour, char label[160])
{
    (void)snprintf(label, 160, "%s, %s", quantity->label, colour);
}

static void scale(double *values, size_t count, double factor)
{
    for (size_t i = 0; i < count; ++i)
        values[i] *= factor;
}

static fst_status draw(const fst_view *view, const char *out, const fst_figure_options *options,
                       const folded *curve, fst_error *error)
{
    const fst_column_info *columns[2];
    const double *unused;
    char labels[2][160];
    fst_status status = fst_view_column(view, "r", &unused, &columns[0], error);
    if (status == FST_OK)
        status = fst_view_column(view, "B", &unused, &columns[1], error);
    if (status != FST_OK)
        return status;
    for (int i = 0; i < 2; ++i) {
        const fst_quantity quantity = fst_view_quantity(view, columns[i]);
        scale(i ? curve->b : curve->r, curve->count, quantity.factor);
        with_colour(&quantity, i ? "orange" : "blue", labels[i]);
    }
    fst_chart_curve curves[] = {
        {.x = curve->bead_angle, .y = curve->r, .count = curve->count, .colour = FST_COLOUR_BLUE},
        {.x = curve->bead_angle,
         .y = curve->b,
         .count = curve->count,
         .colour = FST_COLOUR_VERMILION,
         .right = 1},
    };
    fst_chart_panel panel = {.left_label = labels[0],
                             .right_label = labels[1],
                             .low = NAN,
                             .high = NAN,
                             .left_colour = FST_COLOUR_BLUE,
                             .right_colour = FST_COLOUR_VERMILION,
                             .curves = curves,
                             .curve_count = 2};
    fst_chart chart = {.title = view->title ? view->title : "Radius and field while the magnet passes the bead",
                       .about = view->about,
                       .x_label =
                           view->table->params.magnet_shape == FST_MAGNET_LINES
                               ? "Φ = α − ωt, the bead's angle against the magnet (0: over the ends of its "
                                 "lines)"
                               : "Φ = α − ωt, the bead's angle against the magnet",
                       .x_low = 0.0,
                       .x_high = FST_PI,
                       .x_tics = "('0' 0, 'π/4' 0.785398163, 'π/2' 1.570796327, '3π/4' 2.35619449, 'π' "
                                 "3.141592654)",
                       .panels = &panel,
                       .panel_count = 1};
    char *scene = fst_scene_text(&view->table->params, 0);
    chart.scene = scene;
    status = fst_figure_chart_as(out, &chart, NULL, options->size, error);
    free(scene);
    return status;
}

fst_status fst_figure_radius_field(const fst_table *table, const char *out, const fst_figure_options *options,
                                   fst_error *error)
{
    if (options->colour)
        return fst_fail(error, FST_BAD_INPUT, "fst_figure_options.colour",
                        "the figure of r and |B| has two curves and no colour scale");
    fst_view view;
    const double *bead_angle, *r, *b;
    fst_status status = fst_view_of(&view, table, options, error);
    if (status == FST_OK)
        status = fst_view_columns(&view, error, "Phi", &bead_angle, "r", &r, "B", &b, NULL);
    if (status != FST_OK)
        return status;
    size_t room = 2 * (view.last - view.first);
    double *memory = malloc(3 * room * sizeof *memory);
    if (!memory)
        return fst_fail(error, FST_NO_MEMORY, out, "no memory for %zu samples", room);
    folded curve = {.bead_angle = memory, .r = memory + room, .b = memory + 2 * room};
    fold(&view, bead_angle, r, b, &curve);
    status = draw(&view, out, options, &curve, error);
    free(memory);
    return status;
}
