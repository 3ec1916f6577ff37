/* magnets_charts.c - the two figures of the chapter on real magnets. */
#include "base/error.h"
#include "paper/chart_parts.h"
#include "paper/figures.h"
#include "paper/magnets.h"
#include "paper/runs.h"

#include <math.h>

static const fst_colour colours[FST_MAGNETS] = {FST_COLOUR_BLACK, FST_COLOUR_VERMILION, FST_COLOUR_BLUE,
                                                FST_COLOUR_GREEN};

/* ------------------------------------------------------------------ the field on the magnet's axis */

enum { PLACES = 181 };
typedef struct field_curves {
    double x[PLACES], along[FST_MAGNETS][PLACES], across[FST_MAGNETS][PLACES];
} field_curves;

static fst_status read_field(const fst_paper_state *paper, int magnet, field_curves *curves, fst_error *error)
{
    fst_params params;
    fst_model *model = NULL;
    fst_status status = fst_magnet_params(paper, magnet, 0, 10.7, 0, &params, error);
    if (status == FST_OK)
        status = fst_model_new(&params, &model, error);
    if (status != FST_OK)
        return status;
    for (int i = 0; i < PLACES; ++i) {
        const double place = (i - PLACES / 2) * 0.5e-3 / params.magnet_half_length;
        double b[3], gradient[3][3];
        curves->x[i] = 0.5 * (i - PLACES / 2);
        fst_field(model, place, 0.0, b, gradient);
        curves->along[magnet][i] = hypot(hypot(b[0], b[1]), b[2]);
        fst_field(model, 0.0, place, b, gradient);
        curves->across[magnet][i] = hypot(hypot(b[0], b[1]), b[2]);
    }
    const double unit = 1e3 * fst_model_groups(model).field_unit;
    for (int i = 0; i < PLACES; ++i) {
        curves->along[magnet][i] *= unit;
        curves->across[magnet][i] *= unit;
    }
    fst_model_free(model);
    return FST_OK;
}

fst_status fst_paper_draw_magnet_fields(const fst_paper_state *paper, const fst_paper_figure *figure,
                                        const char *out, fst_error *error)
{
    field_curves read;
    fst_chart_curve along[FST_MAGNETS], across[FST_MAGNETS];
    for (int m = 0; m < FST_MAGNETS; ++m) {
        const fst_status status = read_field(paper, m, &read, error);
        if (status != FST_OK)
            return status;
        const fst_curve_style style = m == 0 ? FST_CURVE_DASHED : FST_CURVE_LINE;
        along[m] = curve_of(fst_shown_magnets[m].name, read.x, read.along[m], PLACES, colours[m], style);
        across[m] = curve_of(NULL, read.x, read.across[m], PLACES, colours[m], style);
    }
    const fst_chart_panel panels[] = {panel_of("|B| along the magnet (mT)", 0.0, 35.0, LISTED(along)),
                                      panel_of("|B| across it (mT)", 0.0, 35.0, LISTED(across))};
    const fst_chart_mark marks[] = {{-20.5, "measured: maxima 41 mm apart"}, {20.5, NULL}};
    fst_chart chart =
        chart_of(figure->title, "distance from the axis of rotation (mm)", -45.0, 45.0, 230, LISTED(panels));
    chart_marks(&chart, LISTED(marks));
    return fst_figure_chart(out, &chart, error);
}

/* ------------------------------------------------------------------ speeds */

typedef struct speed_curves {
    double hertz[FST_MAGNET_ROLLING], speed[FST_MAGNET_LAWS][FST_MAGNETS][FST_MAGNET_ROLLING];
} speed_curves;

/* Frequencies of the bead at the drives of the rolling start, where it circles against the magnet. */
static void read_speeds(const fst_paper_state *paper, speed_curves *curves)
{
    for (int m = 0; m < FST_MAGNETS; ++m)
        for (int law = 0; law < FST_MAGNET_LAWS; ++law)
            for (int i = 0; i < FST_MAGNET_ROLLING; ++i) {
                const fst_paper_run *run = &paper->magnets->of[m].runs[law][i];
                curves->speed[law][m][i] = NAN;
                if (!run->done || !fst_paper_counter_rotates(run))
                    continue;
                curves->speed[law][m][i] =
                    run->result.frequency_hz * run->result.mean_alpha_dot / run->result.omega;
            }
    for (int i = 0; i < FST_MAGNET_ROLLING; ++i)
        curves->hertz[i] = fst_magnet_drive(i);
}

fst_status fst_paper_draw_magnet_speeds(const fst_paper_state *paper, const fst_paper_figure *figure,
                                        const char *out, fst_error *error)
{
    static const char *const labels[FST_MAGNET_LAWS] = {"bead, viscous (Hz)", "bead, dry, μ = 0.2 (Hz)"};
    speed_curves read;
    fst_chart_curve curves[FST_MAGNET_LAWS][FST_MAGNETS];
    fst_chart_panel panels[FST_MAGNET_LAWS];
    read_speeds(paper, &read);
    for (int law = 0; law < FST_MAGNET_LAWS; ++law) {
        for (int m = 0; m < FST_MAGNETS; ++m)
            curves[law][m] = curve_of(law == 0 ? fst_shown_magnets[m].name : NULL, read.hertz,
                                      read.speed[law][m], FST_MAGNET_ROLLING, colours[m],
                                      m == 0 ? FST_CURVE_DASHED_POINTS : FST_CURVE_LINE_POINTS);
        panels[law] = panel_of(labels[law], -6.0, 0.0, LISTED(curves[law]));
    }
    const fst_chart_mark marks[] = {{10.7, "10.7 Hz: 4 festoons"}, {16.0, "16 Hz: slowest"}};
    fst_chart chart = chart_of(figure->title, "drive (Hz)", 7.0, 22.5, 230, LISTED(panels));
    chart_marks(&chart, LISTED(marks));
    chart.remark = "dotted: what the paper's text tells of the experiment; lines guide the eye";
    return fst_figure_chart(out, &chart, error);
}
