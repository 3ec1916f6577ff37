/* probe_charts.c - figures of the probes (Fig. 10, remanence), the sketch of the experiment (Fig. 1) and the
 * camera's view (Fig. 2). */
#include "base/error.h"
#include "paper/chart_parts.h"
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

static fst_status draw_halving(const fst_paper_halving *halving, const halving_curves *c, const char *title,
                               const char *about, const char *out, fst_error *error)
{
    const fst_chart_curve curves[4] = {
        curve_of("p = Δ+/Δ− − 1, of two swings of r in a row", c->omega, c->p, FST_HALVING_POINTS,
                 FST_COLOUR_BLUE, FST_CURVE_POINTS),
        curve_of("|⟨n_z⟩|", c->omega, c->nz, FST_HALVING_POINTS, FST_COLOUR_VERMILION, FST_CURVE_POINTS),
        curve_of("square root of the distance", c->line_x, c->line_y, LINE, FST_COLOUR_GREY, FST_CURVE_LINE),
        curve_of("relaxation time", c->omega, c->tau, FST_HALVING_POINTS, FST_COLOUR_GREEN, FST_CURVE_POINTS)};
    const fst_chart_curve swings[3] = {
        curve_of(NULL, c->time, halving->r, FST_HALVING_SHOWN, FST_COLOUR_PURPLE, FST_CURVE_LINE),
        curve_of(NULL, c->swing_x[0], c->swing_y[0], 2, FST_COLOUR_BLACK, FST_CURVE_LINE),
        curve_of(NULL, c->swing_x[1], c->swing_y[1], 2, FST_COLOUR_BLACK, FST_CURVE_LINE)};
    fst_chart_inset inset = inset_of((double[]){0.66, 0.98, 0.26, 0.80}, (double[]){0.0, 3.0, c->low, c->high},
                                     "r (ℓ)", LISTED(swings));
    inset.x_label = "turns of the magnet";
    inset.labels = c->labels;
    inset.label_count = 2;
    fst_chart_panel panels[] = {panel_of("inequality p of swings", 0.0, 6.5, curves, 1),
                                panel_of("|⟨n_z⟩|", 0.0, NAN, curves + 1, 2),
                                panel_of("relaxation time (1000/γ)", NAN, NAN, curves + 3, 1)};
    panels[0].inset = &inset;
    const fst_chart_mark marks[] = {{c->threshold, "threshold"}};
    fst_chart chart = chart_of(title, "drive ω (γ)", c->omega[0] - 0.0005,
                               c->omega[FST_HALVING_POINTS - 1] + 0.0005, 220, LISTED(panels));
    chart.about = about;
    chart_marks(&chart, LISTED(marks));
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
    const fst_chart_panel nothing = panel_of("p", 0.0, 1.0, NULL, 0);
    fst_chart chart = chart_of("No period halving was found", "drive ω (γ)", 0.25, 0.3, 0, &nothing, 1);
    chart.about = about;
    return fst_figure_chart(out, &chart, error);
}

/* ------------------------------------------------------------------ how much remanence */

static const double BESIDE = 0.012; /* of the abscissa, so that points of both drives can be seen */

fst_status fst_paper_draw_remanence(const fst_paper_state *paper, const fst_paper_figure *figure,
                                    const char *out, fst_error *error)
{
    static const char *const names[FST_REMANENCE_DRIVES] = {"drive 0.3 (14.9 Hz)", "drive 0.4 (19.9 Hz)"};
    double share[FST_REMANENCE_DRIVES][FST_REMANENCE_STRENGTHS],
        strength[FST_REMANENCE_DRIVES][FST_REMANENCE_STRENGTHS];
    double doubt[FST_REMANENCE_DRIVES][FST_REMANENCE_STRENGTHS], widest = 0.0; /* %, in parts of the value */
    char remark[96];
    fst_chart_curve curves[FST_REMANENCE_DRIVES];
    for (int d = 0; d < FST_REMANENCE_DRIVES; ++d) {
        for (int i = 0; i < FST_REMANENCE_STRENGTHS; ++i) {
            strength[d][i] = 1e3 * fst_remanence_strengths[i] + (d ? BESIDE : -BESIDE);
            /* Between a value that failed and the next one, which did not, nothing is known. */
            const fst_least_found *least = &paper->remanence[FST_DYNAMICS_RIGID][d][i];
            const double below = isfinite(least->below) ? least->below : least->kappa;
            share[d][i] = 100.0 * 0.5 * (least->kappa + below) / 1.5;
            doubt[d][i] = 100.0 * 0.5 * (least->kappa - below) / 1.5;
            widest = fmax(widest, 100.0 * doubt[d][i] / share[d][i]);
        }
        curves[d] =
            curve_of(names[d], strength[d], share[d], FST_REMANENCE_STRENGTHS,
                     d ? FST_COLOUR_VERMILION : FST_COLOUR_BLUE, d ? FST_CURVE_OPEN_ERRORS : FST_CURVE_ERRORS);
        curves[d].spread = doubt[d];
    }
    const fst_chart_panel panel = panel_of("least κ (% of a neodymium bead's)", 0.0, NAN, LISTED(curves));
    fst_chart chart =
        chart_of(figure->title, "magnetisability a (1000 a/(m ℓ²γ²/B_0²))", 0.9, 3.1, 0, &panel, 1);
    (void)snprintf(remark, sizeof remark,
                   "each within %.1g %%: from a κ that is too small to the next one tried", widest);
    chart.remark = remark;
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
