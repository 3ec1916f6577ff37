/* charts_over.c - fst_charts_over(): several charts as one, a colour for each. */
#include "draw/charts_over.h"

#include <math.h>
#include <string.h>

#include "base/error.h"
#include "draw/legend.h"

/* How far apart points at names stand at most, of which there is one at each integer. */
static const double BESIDE = 0.7;

fst_colour fst_chart_colour(int place)
{
    static const fst_colour colours[FST_CHARTS_OVER] = {
        FST_COLOUR_BLUE, FST_COLOUR_VERMILION, FST_COLOUR_GREEN, FST_COLOUR_PURPLE,
        FST_COLOUR_SKY,  FST_COLOUR_ORANGE,    FST_COLOUR_BLACK, FST_COLOUR_OLIVE};
    return colours[place % FST_CHARTS_OVER];
}

static int same_text(const char *one, const char *other)
{
    return one == other || (one && other && strcmp(one, other) == 0);
}

/* The abscissa of all charts: from the least end to the greatest. */
static fst_status lay_abscissa(fst_chart *all, const fst_chart *first, const fst_chart *one, fst_error *error)
{
    if (!same_text(first->x_label, one->x_label) || !same_text(first->x_tics, one->x_tics) ||
        first->square != one->square)
        return fst_fail(error, FST_BAD_INPUT, "fst_figure_over",
                        "one of these is over the %s and another over the %s: they have no axis in common",
                        first->x_label, one->x_label);
    all->x_low = fmin(all->x_low, one->x_low);
    all->x_high = fmax(all->x_high, one->x_high);
    all->x_logarithmic &= one->x_logarithmic;
    if (!same_text(first->x2_label, one->x2_label) || first->x2_factor != one->x2_factor)
        all->x2_label = NULL;
    return FST_OK;
}

/* The panel with the ordinate of this one; a new one where there is none yet. */
static fst_chart_panel *panel_for(fst_chart_panel *panels, int *count, const fst_chart_panel *one)
{
    for (int p = 0; p < *count; ++p)
        if (same_text(panels[p].left_label, one->left_label)) {
            panels[p].low = fmin(panels[p].low, one->low); /* NAN, from the data, stays where both are */
            panels[p].high = fmax(panels[p].high, one->high);
            panels[p].right_high = fmax(panels[p].right_high, one->right_high); /* of the signs at the edge */
            panels[p].tics = one->tics ? panels[p].tics : NULL;
            return &panels[p];
        }
    panels[*count] = *one;
    panels[*count].curve_count = 0;
    panels[*count].inset = NULL;
    return &panels[(*count)++];
}

static int has_point(const fst_chart_curve *curve)
{
    for (size_t i = 0; i < curve->count; ++i)
        if (isfinite(curve->x[i]) && isfinite(curve->y[i]))
            return 1;
    return 0;
}

/* Whether a curve with this title is in the key already. */
static int is_named(const fst_chart_panel *panels, int count, const char *title)
{
    for (int p = 0; p < count; ++p)
        for (int c = 0; c < panels[p].curve_count; ++c)
            if (same_text(panels[p].curves[c].title, title) && has_point(&panels[p].curves[c]))
                return 1;
    return 0;
}

/* Whether a curve is of signs at the edge of its panel (fst_sweep_curves()). */
static int is_at_edge(const fst_chart_curve *curve)
{
    return curve->style == FST_CURVE_OPEN_POINTS && curve->right;
}

/* Whether a curve may bear the name of its chart: not what is unstable, special points, and lines beside others. */
static int is_main(const fst_chart_curve *curve)
{
    return !is_at_edge(curve) && curve->style != FST_CURVE_DASHED && curve->style != FST_CURVE_SIGNS &&
           curve->style != FST_CURVE_THIN && has_point(curve);
}

/* How the curves of a chart are taken over. */
typedef struct taking {
    fst_colour colour;
    int at_edge; /* the signs at the edge, or all others */
    double
        higher; /* signs, and points at names, stand by so much higher: other charts may have some at the same place */
    const char **name; /* of the chart, until a curve has it */
    int lacks_main;    /* no curve of the chart is_main() */
} taking;

static int lift(fst_chart *all, fst_chart_curve *curve, double higher)
{
    double *y = fst_chart_keep(all, (curve->count + 1) * sizeof *y);
    for (size_t i = 0; y && i < curve->count; ++i)
        y[i] = curve->y[i] + higher;
    curve->y = y;
    return y != NULL;
}

/* Signs at the edge, and what is unstable, have the name of their chart where no other curve has it. */
static int name_others(fst_chart *all, fst_chart_curve *curve, const char *name)
{
    char words[384];
    (void)snprintf(words, sizeof words, "%s%s%s", name ? name : "", name ? ": " : "", curve->title);
    curve->title = fst_chart_text(all, words);
    return curve->title != NULL;
}

static int take_curves(fst_chart *all, fst_chart_panel *panels, int count, fst_chart_panel *panel,
                       const fst_chart_panel *one, const taking *how)
{
    const size_t sum = (size_t)(panel->curve_count + one->curve_count);
    fst_chart_curve *curves = fst_chart_keep(all, (sum + 1) * sizeof *curves);
    if (!curves)
        return 0;
    memcpy(curves, panel->curves, (size_t)panel->curve_count * sizeof *curves);
    panel->curves = curves;
    for (int c = 0; c < one->curve_count; ++c) {
        fst_chart_curve curve = one->curves[c];
        curve.colour = how->colour;
        if (is_at_edge(&curve) != how->at_edge)
            continue;
        if ((how->at_edge || one->tics) && !lift(all, &curve, how->higher))
            return 0;
        if (how->at_edge && !name_others(all, &curve, *how->name))
            return 0;
        if (is_main(&curve)) {
            curve.title = *how->name;
            *how->name = NULL;
        } else if (how->lacks_main && *how->name && curve.style == FST_CURVE_DASHED && has_point(&curve)) {
            if (!name_others(all, &curve, *how->name))
                return 0;
            *how->name = NULL;
        } else if (curve.title && is_named(panels, count, curve.title)) {
            curve.title = NULL;
        }
        curves[panel->curve_count++] = curve;
    }
    return 1;
}

static int take_chart(fst_chart *all, fst_chart_panel *panels, int *count, const fst_chart *one,
                      const taking *how)
{
    int good = 1;
    taking own = *how;
    own.lacks_main = 1;
    for (int p = 0; p < one->panel_count; ++p)
        for (int c = 0; c < one->panels[p].curve_count; ++c)
            own.lacks_main &= !is_main(&one->panels[p].curves[c]);
    for (int p = 0; p < one->panel_count && good; ++p) {
        fst_chart_panel *panel = panel_for(panels, count, &one->panels[p]);
        good = take_curves(all, panels, *count, panel, &one->panels[p], &own);
    }
    return good;
}

/* The signs at the edges, behind all else. */
static int take_signs(fst_chart *all, fst_chart_panel *panels, int *panel_count, fst_chart *const *charts,
                      const char **names, int count)
{
    int level = 0, good = 1;
    for (int i = 0; i < count && good; ++i) {
        int has_some = 0;
        for (int p = 0; p < charts[i]->panel_count; ++p)
            for (int c = 0; c < charts[i]->panels[p].curve_count; ++c)
                has_some |= is_at_edge(&charts[i]->panels[p].curves[c]);
        const taking how = {fst_chart_colour(i), 1, 0.04 * level, &names[i], 0};
        good = take_chart(all, panels, panel_count, charts[i], &how);
        level += has_some;
    }
    return good;
}

/* The name of a chart in the key. */
static const char *own_name(fst_chart *all, const char *name)
{
    char words[384];
    fst_plain_words(name, words, sizeof words);
    return fst_chart_text(all, words);
}

/* What is of the whole chart is that of the first one. */
static void begin(fst_chart *all, const fst_chart *first, const char *about)
{
    void *memory = all->memory;
    *all = *first;
    all->memory = memory;
    if (about[0])
        all->about = fst_chart_text(all, about);
}

fst_status fst_charts_over(fst_chart *const *charts, const char *const *names, int count, const char *about,
                           fst_chart **all, fst_error *error)
{
    const char *own[FST_CHARTS_OVER]; /* the names that no curve has yet */
    size_t most = 1;
    for (int i = 0; i < count; ++i)
        most += (size_t)charts[i]->panel_count;
    fst_chart *made = *all = fst_chart_new();
    fst_chart_panel *panels = made ? fst_chart_keep(made, most * sizeof *panels) : NULL;
    int good = panels != NULL, panel_count = 0;
    fst_status status = FST_OK;
    for (int i = 0; i < count && good && status == FST_OK; ++i) {
        fst_chart_adopt(made, charts[i]);
        if (i == 0)
            begin(made, charts[0], about);
        if (made->scene && !(charts[i]->scene && strcmp(made->scene, charts[i]->scene) == 0))
            made->scene = NULL; /* each file has its own */
        status = lay_abscissa(made, charts[0], charts[i], error);
        const taking how = {fst_chart_colour(i), 0, BESIDE * ((i + 0.5) / count - 0.5), &own[i], 0};
        if (status == FST_OK)
            good =
                (own[i] = own_name(made, names[i])) && take_chart(made, panels, &panel_count, charts[i], &how);
    }
    if (good && status == FST_OK)
        good = take_signs(made, panels, &panel_count, charts, own, count);
    if (good && status == FST_OK) {
        made->panels = panels;
        made->panel_count = panel_count;
        return FST_OK;
    }
    fst_chart_free(made);
    *all = NULL;
    return status != FST_OK ? status
                            : fst_fail(error, FST_NO_MEMORY, "fst_figure_over", "no memory for a figure");
}
