/* figure_branch.c - bifurcation diagrams, and multipliers in the complex plane. */
#include <festoon/festoon_tools.h>

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/constants.h"
#include "base/error.h"
#include "draw/chart.h"

enum { CIRCLE = 181, CIRCLE_SIZE = 680, SPECIAL_TYPES = FST_SPECIAL_GRAZING + 1, CURVES = SPECIAL_TYPES + 4 };

static const struct observable {
    const char *name, *label;
    size_t offset;
} OBSERVABLES[] = {
    {"second", "second parameter", offsetof(fst_branch_point, second)},
    {"mean_r", "<r> / l", offsetof(fst_branch_point, mean_r)},
    {"mean_alpha_dot", "<α'> / γ", offsetof(fst_branch_point, mean_alpha_dot)},
    {"mean_nz", "<n_z>", offsetof(fst_branch_point, mean_nz)},
    {"festoons", "festoons N", offsetof(fst_branch_point, festoons)},
    {"min_r", "least r / l", offsetof(fst_branch_point, min_r)},
    {"period", "period γ", offsetof(fst_branch_point, period)},
    {"phi_deg", "Φ / degrees", offsetof(fst_branch_point, bead_angle_deg)},
    {"slip", "slip / (l γ)", offsetof(fst_branch_point, slip)},
    {"relaxation_time", "relaxation time γ", offsetof(fst_branch_point, relaxation_time)},
    {"swing_ratio", "p, ratio of swings - 1", offsetof(fst_branch_point, swing_ratio)},
};

static const struct observable *find_observable(const char *name)
{
    for (size_t i = 0; i < sizeof OBSERVABLES / sizeof *OBSERVABLES; ++i)
        if (strcmp(OBSERVABLES[i].name, name) == 0)
            return &OBSERVABLES[i];
    return NULL;
}

static double value_of(const fst_branch_point *p, const struct observable *what)
{
    double value;
    memcpy(&value, (const char *)p + what->offset, sizeof value);
    return value;
}

/* Write a curve as two columns of numbers. */
typedef struct columns {
    double *x, *y;
    size_t count;
} columns;

static int make_columns(columns *c, size_t capacity)
{
    c->x = malloc((capacity + 1) * sizeof *c->x);
    c->y = malloc((capacity + 1) * sizeof *c->y);
    c->count = 0;
    return c->x && c->y;
}

static void put(columns *c, double x, double y)
{
    c->x[c->count] = x;
    c->y[c->count++] = y;
}

/* Where the stability changes between two neighbouring points: at the special point there, if one is known;
 * otherwise half way.  A fold lies a little beyond both points, so the search extends to both sides by their
 * distance. */
static void put_border(columns *c, const fst_branch *b, const fst_branch_point *p, const fst_branch_point *q,
                       const struct observable *what)
{
    const double x = 0.5 * (p->value + q->value), reach = 1.5 * fabs(p->value - q->value) + 1e-9;
    const double r = 0.5 * (p->mean_r + q->mean_r), reach_r = 1.5 * fabs(p->mean_r - q->mean_r) + 1e-6;
    const fst_special *best = NULL;
    for (size_t i = 0; i < b->special_count; ++i) {
        const fst_special *s = &b->specials[i];
        if (s->type != FST_SPECIAL_ORIGIN_CROSSING && fabs(s->value - x) < reach &&
            fabs(s->at.mean_r - r) < reach_r && (!best || fabs(s->value - x) < fabs(best->value - x)))
            best = s;
    }
    if (best)
        put(c, best->value, value_of(&best->at, what));
    else
        put(c, x, 0.5 * (value_of(p, what) + value_of(q, what)));
}

/* Whether a branch would be drawn exactly over its image under S2; only <n_z> and Phi tell the two apart. */
static int is_hidden(const fst_branch *b, const struct observable *what, int branch)
{
    if (strcmp(what->name, "mean_nz") == 0 || strcmp(what->name, "phi_deg") == 0)
        return 0;
    for (size_t i = 0; i < b->end_count; ++i)
        if (b->ends[i].branch == branch && b->ends[i].image >= 0 && b->ends[i].image < branch)
            return 1;
    return 0;
}

/* Write the pieces of one stability, with a gap between them. */
static void put_pieces(columns *c, const fst_branch *b, const struct observable *what, int stable)
{
    for (size_t i = 0; i < b->point_count; ++i) {
        const fst_branch_point *p = &b->points[i];
        const int joined = i > 0 && p[-1].branch == p->branch;
        const int goes_on = i + 1 < b->point_count && p[1].branch == p->branch;
        if (p->stable != stable || is_hidden(b, what, p->branch))
            continue;
        if (joined && p[-1].stable != stable)
            put_border(c, b, p - 1, p, what);
        put(c, p->value, value_of(p, what));
        if (goes_on && p[1].stable != stable)
            put_border(c, b, p, p + 1, what);
        if (!goes_on || p[1].stable != stable)
            put(c, NAN, NAN);
    }
}

static void put_multipliers(columns *c, const fst_branch *b, int stable)
{
    for (size_t i = 0; i < b->point_count; ++i)
        for (int k = 0; k < b->points[i].multipliers; ++k)
            if (b->points[i].stable == stable &&
                (b->kind == FST_BRANCH_LOCKED || b->points[i].multipliers == FST_MULTIPLIER_COUNT))
                put(c, b->points[i].multiplier_re[k], b->points[i].multiplier_im[k]);
}

static void style_curve(fst_chart_curve *curve, const columns *c, const char *title, fst_colour colour,
                        fst_curve_style style)
{
    *curve = (fst_chart_curve){
        .title = title, .x = c->x, .y = c->y, .count = c->count, .colour = colour, .style = style};
}

static int add_diagram(const fst_branch *b, const struct observable *what, columns *c, fst_chart_curve *curves)
{
    const int over_two = b->second_key[0] != 0;
    static const fst_colour colours[SPECIAL_TYPES] = {FST_COLOUR_BLACK,  FST_COLOUR_VERMILION, FST_COLOUR_GREEN,
                                                      FST_COLOUR_PURPLE, FST_COLOUR_GREY,      FST_COLOUR_BLUE,
                                                      FST_COLOUR_ORANGE, FST_COLOUR_SKY};
    int count = 0;
    put_pieces(&c[0], b, what, 1);
    put_pieces(&c[1], b, what, 0);
    style_curve(&curves[count++], &c[0], over_two ? "of a stable state" : "stable", FST_COLOUR_BLUE,
                FST_CURVE_LINE);
    style_curve(&curves[count++], &c[1], over_two ? "of an unstable state" : "unstable", FST_COLOUR_GREY,
                FST_CURVE_DASHED);
    for (int type = 0; type < SPECIAL_TYPES; ++type) {
        columns *special = &c[2 + type];
        for (size_t i = 0; i < b->special_count; ++i)
            if ((int)b->specials[i].type == type)
                put(special, b->specials[i].value, value_of(&b->specials[i].at, what));
        if (special->count > 0)
            style_curve(&curves[count++], special, fst_special_name((fst_special_type)type), colours[type],
                        FST_CURVE_POINTS);
    }
    return count;
}

static int add_circle(const fst_branch *b, columns *c, fst_chart_curve *curves)
{
    for (int i = 0; i < CIRCLE && b->kind != FST_BRANCH_LOCKED; ++i)
        put(&c[2], cos(FST_TWO_PI * i / (CIRCLE - 1)), sin(FST_TWO_PI * i / (CIRCLE - 1)));
    put_multipliers(&c[0], b, 1);
    put_multipliers(&c[1], b, 0);
    style_curve(&curves[0], &c[2], NULL, FST_COLOUR_BLACK, FST_CURVE_LINE);
    style_curve(&curves[1], &c[0], "stable", FST_COLOUR_BLUE, FST_CURVE_POINTS);
    style_curve(&curves[2], &c[1], "unstable", FST_COLOUR_VERMILION, FST_CURVE_OPEN_POINTS);
    return 3;
}

static fst_status unknown_observable(const char *name, fst_error *error)
{
    char names[256] = "multipliers", nearest[32];
    for (size_t i = 0; i < sizeof OBSERVABLES / sizeof *OBSERVABLES; ++i) {
        const size_t used = strlen(names);
        (void)snprintf(names + used, sizeof names - used, "|%s", OBSERVABLES[i].name);
    }
    (void)fst_nearest_name(name, names, nearest, sizeof nearest);
    return fst_fail(error, FST_BAD_INPUT, "fst_figure_branch.observable",
                    "unknown observable \"%.60s\"; the nearest is %s (%s)", name, nearest, names);
}

fst_status fst_figure_branch(const fst_branch *branch, const char *observable, const double *dots,
                             size_t dot_count, const char *out, fst_error *error)
{
    const int circle = strcmp(observable, "multipliers") == 0;
    const struct observable *what = find_observable(observable);
    if (!what && !circle)
        return unknown_observable(observable, error);
    if (branch->point_count == 0)
        return fst_fail(error, FST_BAD_INPUT, branch->key,
                        "this branch has no points, so that there is nothing to draw%s",
                        branch->complete ? "" : ": it was interrupted before the first one; compute it again");
    columns c[CURVES] = {{NULL, NULL, 0}};
    fst_chart_curve curves[CURVES];
    const size_t most =
        branch->point_count * (circle ? FST_EIGENVALUE_COUNT : 3) + branch->special_count + CIRCLE;
    fst_status status = FST_OK;
    for (int i = 0; i < CURVES; ++i)
        if (!make_columns(&c[i], most + dot_count))
            status = fst_fail(error, FST_NO_MEMORY, out, "out of memory");
    if (status == FST_OK) {
        int count = circle ? add_circle(branch, c, curves) : add_diagram(branch, what, c, curves);
        for (size_t i = 0; i < dot_count && !circle; ++i)
            put(&c[CURVES - 1], dots[2 * i], dots[2 * i + 1]);
        if (c[CURVES - 1].count > 0)
            style_curve(&curves[count++], &c[CURVES - 1], "simulated", FST_COLOUR_BLACK, FST_CURVE_OPEN_POINTS);
        const int over_two = branch->second_key[0] != 0;
        char title[96] = "branches";
        if (over_two)
            (void)snprintf(title, sizeof title, "where the %s lies", fst_special_name(branch->followed));
        const char *label = circle                                          ? "imaginary part"
                            : over_two && strcmp(what->name, "second") == 0 ? branch->second_key
                                                                            : what->label;
        const fst_chart_panel panel = {.left_label = label,
                                       .left_colour = FST_COLOUR_BLACK,
                                       .low = circle ? -1.2 : NAN,
                                       .high = circle ? 1.2 : NAN,
                                       .key = branch->kind != FST_BRANCH_COUNTER ? "top right" : "bottom right",
                                       .curves = curves,
                                       .curve_count = count};
        const fst_chart chart = {.title = circle ? "multipliers along the branch, where they are less than 1.2"
                                                 : title,
                                 .x_label = circle ? "real part" : branch->key,
                                 .x_low = circle ? -1.2 : fmin(branch->from, branch->to),
                                 .x_high = circle ? 1.2 : fmax(branch->from, branch->to),
                                 .square = circle,
                                 .width = circle ? CIRCLE_SIZE : 0,
                                 .height = circle ? CIRCLE_SIZE : 0,
                                 .panels = &panel,
                                 .panel_count = 1};
        status = fst_figure_chart(out, &chart, error);
    }
    for (int i = 0; i < CURVES; ++i) {
        free(c[i].x);
        free(c[i].y);
    }
    return status;
}
