/* probe_charts.c - figures of the probes (Fig. 10, remanence), the sketch of the experiment (Fig. 1) and the
 * camera's view (Fig. 2). */
#include "base/error.h"
#include "draw/chart.h"
#include "draw/figure_setup.h"
#include "io/collect.h"
#include "paper/figures.h"
#include "paper/runs.h"

#include <stdlib.h>

/* ------------------------------------------------------------------ Fig. 10 */

enum { LINE = 64 };

typedef struct halving_curves {
    double omega[FST_HALVING_POINTS], p[FST_HALVING_POINTS], nz[FST_HALVING_POINTS], tau[FST_HALVING_POINTS];
    double line_x[LINE], line_y[LINE], time[FST_HALVING_SHOWN], threshold;
    double swing_x[2][2], swing_y[2][2]; /* from a maximum of r(t) to the next minimum, twice */
    fst_chart_label labels[2];
    double low, high; /* of the inset, with room for the labels */
} halving_curves;

/* Mark two successive swings of r(t), from a maximum to the next minimum, by vertical lines: Delta+
 * and Delta-. */
static void mark_swings(const double *r, halving_curves *c)
{
    int found = 0, top = -1;
    /* From a quarter of a turn on: nearer to the axis a name would lie over its numbers. */
    for (int i = FST_HALVING_PARTS / 4; i + 1 < FST_HALVING_SHOWN && found < 2; ++i) {
        if (r[i] > r[i - 1] && r[i] >= r[i + 1])
            top = i;
        if (!(r[i] < r[i - 1] && r[i] <= r[i + 1]) || top < 0)
            continue;
        c->swing_x[found][0] = c->swing_x[found][1] = c->time[i];
        c->swing_y[found][0] = r[top];
        c->swing_y[found][1] = r[i];
        ++found;
    }
    int larger = c->swing_y[1][0] - c->swing_y[1][1] > c->swing_y[0][0] - c->swing_y[0][1];
    double low = INFINITY, high = -INFINITY;
    for (int i = 0; i < FST_HALVING_SHOWN; ++i) {
        low = fmin(low, r[i]);
        high = fmax(high, r[i]);
    }
    /* The names stand off the curve: one below the large swing, one above the small one. */
    const double room = 0.34 * (high - low);
    c->low = low - room;
    c->high = high + room;
    for (int i = 0; i < 2; ++i)
        c->labels[i] = (fst_chart_label){c->swing_x[i][0], i == larger ? low - 0.5 * room : high + 0.5 * room,
                                         i == larger ? "Δ+" : "Δ−"};
}

static void read_halving(const fst_paper_state *paper, fst_dynamics dynamics, halving_curves *c)
{
    const fst_halving_point *points = paper->halving[dynamics].points;
    const fst_halving_point *near = &points[FST_HALVING_BELOW - 3]; /* the line goes through this point */
    *c = (halving_curves){.threshold = fst_paper_halving_drive(paper, dynamics)};
    for (int i = 0; i < FST_HALVING_POINTS; ++i) {
        c->omega[i] = points[i].omega;
        c->p[i] = points[i].order > 6.0 ? NAN : points[i].order;
        c->nz[i] = points[i].mean_nz;
        c->tau[i] = 1e-3 * points[i].relaxation;
    }
    double factor = near->mean_nz / sqrt(fabs(c->threshold - near->omega));
    for (int i = 0; i < LINE; ++i) { /* points close up to the threshold, where the line is steep */
        double part = 1.0 - i / (LINE - 1.0);
        c->line_x[i] = c->threshold - (c->threshold - c->omega[0]) * part * part;
        c->line_y[i] = factor * sqrt(fmax(c->threshold - c->line_x[i], 0.0));
    }
    for (int i = 0; i < FST_HALVING_SHOWN; ++i)
        c->time[i] = i / (double)FST_HALVING_PARTS;
    mark_swings(paper->halving[dynamics].r, c);
}

static fst_chart_curve halving_curve(const char *title, const double *x, const double *y, size_t count,
                                     fst_colour colour, fst_curve_style style)
{
    return (fst_chart_curve){.title = title, .x = x, .y = y, .count = count, .colour = colour, .style = style};
}

static fst_status draw_halving(const fst_paper_halving *halving, const halving_curves *c, const char *title,
                               const char *about, const char *out, fst_error *error)
{
    const fst_chart_curve curves[4] = {
        halving_curve("p", c->omega, c->p, FST_HALVING_POINTS, FST_COLOUR_BLUE, FST_CURVE_POINTS),
        halving_curve("|⟨n_z⟩|", c->omega, c->nz, FST_HALVING_POINTS, FST_COLOUR_VERMILION, FST_CURVE_POINTS),
        halving_curve("square root of the distance", c->line_x, c->line_y, LINE, FST_COLOUR_GREY,
                      FST_CURVE_LINE),
        halving_curve("relaxation time", c->omega, c->tau, FST_HALVING_POINTS, FST_COLOUR_GREEN,
                      FST_CURVE_POINTS)};
    const fst_chart_curve swings[3] = {
        halving_curve(NULL, c->time, halving->r, FST_HALVING_SHOWN, FST_COLOUR_PURPLE, FST_CURVE_LINE),
        halving_curve(NULL, c->swing_x[0], c->swing_y[0], 2, FST_COLOUR_BLACK, FST_CURVE_LINE),
        halving_curve(NULL, c->swing_x[1], c->swing_y[1], 2, FST_COLOUR_BLACK, FST_CURVE_LINE)};
    const fst_chart_inset inset = {.left = 0.66,
                                   .right = 0.98,
                                   .bottom = 0.26,
                                   .top = 0.80,
                                   .x_low = 0.0,
                                   .x_high = 3.0,
                                   .low = c->low,
                                   .high = c->high,
                                   .x_label = "turns of the magnet",
                                   .label = "r (ℓ)",
                                   .curves = swings,
                                   .curve_count = 3,
                                   .labels = c->labels,
                                   .label_count = 2};
    const fst_chart_panel panels[3] = {
        {.left_label = "p = Δ+/Δ− − 1",
         .low = 0.0,
         .high = 6.5,
         .curves = curves,
         .curve_count = 1,
         .inset = &inset},
        {.left_label = "|⟨n_z⟩|", .low = 0.0, .high = NAN, .curves = curves + 1, .curve_count = 2},
        {.left_label = "relaxation time (1000/γ)",
         .low = NAN,
         .high = NAN,
         .curves = curves + 3,
         .curve_count = 1}};
    const fst_chart_mark marks[] = {{c->threshold, "threshold"}};
    fst_chart chart = {.title = title,
                       .about = about,
                       .x_label = "drive ω (γ)",
                       .x_low = c->omega[0] - 0.0005,
                       .x_high = c->omega[FST_HALVING_POINTS - 1] + 0.0005,
                       .height = 220,
                       .panels = panels,
                       .panel_count = 3,
                       .marks = marks,
                       .mark_count = 1};
    return fst_figure_chart(out, &chart, error);
}

fst_status fst_paper_draw_supercritical(const fst_paper_state *paper, const fst_paper_figure *figure,
                                        const char *out, fst_error *error)
{
    halving_curves c;
    read_halving(paper, figure->dynamics, &c);
    char about[64];
    (void)snprintf(about, sizeof about, "dynamics %s", fst_dynamics_name(figure->dynamics));
    if (isfinite(c.threshold))
        return draw_halving(&paper->halving[figure->dynamics], &c, figure->title, about, out, error);
    const fst_chart_panel nothing = {.left_label = "p", .low = 0.0, .high = 1.0};
    const fst_chart chart = {.title = "No period halving was found",
                             .about = about,
                             .x_label = "drive ω (γ)",
                             .x_low = 0.25,
                             .x_high = 0.3,
                             .panels = &nothing,
                             .panel_count = 1};
    return fst_figure_chart(out, &chart, error);
}

/* ------------------------------------------------------------------ how much remanence */

fst_status fst_paper_draw_remanence(const fst_paper_state *paper, const fst_paper_figure *figure,
                                    const char *out, fst_error *error)
{
    static const char *const names[FST_REMANENCE_DRIVES] = {"drive 0.3 (14.9 Hz)", "drive 0.4 (19.9 Hz)"};
    double share[FST_REMANENCE_DRIVES][FST_REMANENCE_STRENGTHS], strength[FST_REMANENCE_STRENGTHS];
    fst_chart_curve curves[FST_REMANENCE_DRIVES];
    for (int d = 0; d < FST_REMANENCE_DRIVES; ++d) {
        for (int i = 0; i < FST_REMANENCE_STRENGTHS; ++i) {
            strength[i] = 1e3 * fst_remanence_strengths[i];
            share[d][i] = 100.0 * paper->remanence[FST_DYNAMICS_RIGID][d][i].kappa / 1.5;
        }
        curves[d] = (fst_chart_curve){.title = names[d],
                                      .x = strength,
                                      .y = share[d],
                                      .count = FST_REMANENCE_STRENGTHS,
                                      .colour = d ? FST_COLOUR_VERMILION : FST_COLOUR_BLUE,
                                      .style = d ? FST_CURVE_DASHED_POINTS : FST_CURVE_LINE_POINTS};
    }
    const fst_chart_panel panel = {.left_label = "least κ found, % of a neodymium bead's",
                                   .low = 0.0,
                                   .high = NAN,
                                   .curves = curves,
                                   .curve_count = FST_REMANENCE_DRIVES};
    fst_chart chart = {.title = figure->title,
                       .x_label = "magnetisability a (1000 a/(m ℓ²γ²/B_0²))",
                       .x_low = 0.9,
                       .x_high = 3.1,
                       .panels = &panel,
                       .panel_count = 1};
    return fst_figure_chart(out, &chart, error);
}

/* ------------------------------------------------------------------ the setup */

fst_status fst_paper_draw_sketch(const fst_paper_state *paper, const fst_paper_figure *figure, const char *out,
                                 fst_error *error)
{
    return fst_figure_sketch(&fst_paper_single(paper, figure->scan, FST_DYNAMICS_RIGID)->params, out, error);
}

fst_status fst_paper_draw_camera(const fst_paper_state *paper, const fst_paper_figure *figure, const char *out,
                                 fst_error *error)
{
    const fst_paper_run *run = fst_paper_single(paper, figure->scan, figure->dynamics);
    return fst_figure_camera(fst_collected(&run->trajectory, "t"), fst_collected(&run->trajectory, "x"),
                             fst_collected(&run->trajectory, "y"), run->trajectory.rows, &run->params, out,
                             error);
}
