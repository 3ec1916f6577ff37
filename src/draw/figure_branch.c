/* figure_branch.c - bifurcation diagrams, and multipliers in the complex plane. */
#include <festoon/festoon_tools.h>

#include <stdio.h>
#include <string.h>

#include "base/constants.h"
#include "base/error.h"
#include "draw/caption.h"
#include "draw/chart.h"
#include "draw/figure_branch.h"

enum {
    CIRCLE = 181,
    SIDES = 2, /* above the magnet and below it */
    CURVES = FST_SPECIAL_COUNT + 2 * SIDES + 1
};

static const fst_observable_info OBSERVABLES[] = {
    {"second", "", offsetof(fst_branch_point, second)},
    {"mean_r", "l", offsetof(fst_branch_point, mean_r)},
    {"mean_alpha_dot", "gamma", offsetof(fst_branch_point, mean_alpha_dot)},
    {"mean_nz", "1", offsetof(fst_branch_point, mean_nz)},
    {"festoons", "1", offsetof(fst_branch_point, festoons)},
    {"min_r", "l", offsetof(fst_branch_point, min_r)},
    {"period", "1/gamma", offsetof(fst_branch_point, period)},
    {"phi_deg", "deg", offsetof(fst_branch_point, bead_angle_deg)},
    {"slip", "l gamma", offsetof(fst_branch_point, slip)},
    {"relaxation_time", "1/gamma", offsetof(fst_branch_point, relaxation_time)},
    {"swing_ratio", "1", offsetof(fst_branch_point, swing_ratio)},
    {"height_mm", "1", offsetof(fst_branch_point, levitation.height_mm)},
    {"tilt_deg", "deg", offsetof(fst_branch_point, levitation.tilt_deg)},
    {"circle_mm", "1", offsetof(fst_branch_point, levitation.circle_mm)},
    {"gap_mm", "1", offsetof(fst_branch_point, levitation.gap_mm)},
};

const char *fst_branch_observable(const fst_branch *branch)
{
    return branch->second_key[0] ? "second" : branch->kind == FST_BRANCH_LEVITATING ? "height_mm" : "mean_r";
}

const fst_observable_info *fst_branch_observable_at(int index)
{
    const int count = (int)(sizeof OBSERVABLES / sizeof *OBSERVABLES);
    return index >= 0 && index < count ? &OBSERVABLES[index] : NULL;
}

/* What a figure shows of a branch, and in which units. */
typedef struct shown {
    const fst_observable_info *what; /* NULL: multipliers */
    fst_quantity x, y;
} shown;

static const fst_observable_info *find_observable(const char *name)
{
    for (size_t i = 0; i < sizeof OBSERVABLES / sizeof *OBSERVABLES; ++i)
        if (strcmp(OBSERVABLES[i].name, name) == 0)
            return &OBSERVABLES[i];
    return NULL;
}

static int is_angle(const fst_observable_info *what)
{
    return strcmp(what->unit, "deg") == 0;
}

static double value_of(const fst_branch_point *p, const fst_observable_info *what)
{
    double value;
    memcpy(&value, (const char *)p + what->offset, sizeof value);
    /* Angles lie about 0 and 180 degrees, so the gap of their range is best at -90. */
    return is_angle(what) && value < -90.0 ? value + 360.0 : value;
}

/* Where an orbit passes the axis it no longer turns round it: <alpha'> jumps, and N with it. */
static int jumps_with_turns(const fst_observable_info *what)
{
    return strcmp(what->name, "mean_alpha_dot") == 0 || strcmp(what->name, "festoons") == 0;
}

/* Whether the curve goes on from one point to the next; an angle may jump, through its gap or at r = 0. */
static int goes_on_to(const fst_observable_info *what, const fst_branch_point *from, const fst_branch_point *to)
{
    if (jumps_with_turns(what) && from->turns != to->turns)
        return 0;
    return !is_angle(what) || !(fabs(value_of(to, what) - value_of(from, what)) > 90.0);
}

typedef fst_columns columns;

/* By which a special point is known for that between two points. */
static double place_of(const fst_branch *b, const fst_branch_point *p)
{
    return b->kind == FST_BRANCH_LEVITATING ? p->levitation.state[2] : p->mean_r;
}

/* Where the stability changes between two neighbouring points: at the special point there, if one is known;
 * otherwise half way.  A fold lies a little beyond both points, so the search extends to both sides by their
 * distance. */
static void put_border(columns *c, const fst_branch *b, const fst_branch_point *p, const fst_branch_point *q,
                       const fst_observable_info *what)
{
    const double x = 0.5 * (p->value + q->value), reach = 1.5 * fabs(p->value - q->value) + 1e-9;
    const double here = place_of(b, p), there = place_of(b, q);
    const double r = 0.5 * (here + there), reach_r = 1.5 * fabs(here - there) + 1e-6;
    const fst_special *best = NULL;
    for (size_t i = 0; i < b->special_count; ++i) {
        const fst_special *s = &b->specials[i];
        if (s->type != FST_SPECIAL_ORIGIN_CROSSING && fabs(s->value - x) < reach &&
            fabs(place_of(b, &s->at) - r) < reach_r && (!best || fabs(s->value - x) < fabs(best->value - x)))
            best = s;
    }
    if (best && goes_on_to(what, p, &best->at) && goes_on_to(what, q, &best->at))
        fst_columns_put(c, best->value, value_of(&best->at, what));
    else if (goes_on_to(what, p, q))
        fst_columns_put(c, x, 0.5 * (value_of(p, what) + value_of(q, what)));
}

/* Whether a branch would be drawn exactly over its image under S2; only <n_z> and Phi tell the two apart. */
static int is_hidden(const fst_branch *b, const fst_observable_info *what, int branch)
{
    if (strcmp(what->name, "mean_nz") == 0 || strcmp(what->name, "phi_deg") == 0)
        return 0;
    for (size_t i = 0; i < b->end_count; ++i)
        if (b->ends[i].branch == branch && b->ends[i].image >= 0 && b->ends[i].image < branch)
            return 1;
    return 0;
}

/* A gap between two neighbouring points of one stability.  Both pieces of <alpha'> reach to where the orbit passes the
 * axis: it is omega there, and less by the turns of Phi in a period. */
static void put_gap(columns *c, const fst_branch *b, const fst_branch_point *p, const fst_branch_point *q,
                    const fst_observable_info *what)
{
    const fst_branch_point *at = NULL;
    for (size_t i = 0; i < b->special_count; ++i) {
        const fst_special *s = &b->specials[i];
        if (s->type == FST_SPECIAL_ORIGIN_CROSSING && s->branch == p->branch &&
            (s->value - p->value) * (s->value - q->value) <= 0.0)
            at = &s->at;
    }
    const int reach = at && strcmp(what->name, "mean_alpha_dot") == 0 && p->turns != q->turns;
    if (reach)
        fst_columns_put(c, at->value, at->omega + p->turns * FST_TWO_PI / at->period);
    fst_columns_put(c, NAN, NAN);
    if (reach)
        fst_columns_put(c, at->value, at->omega + q->turns * FST_TWO_PI / at->period);
}

/* Where the branch is born on another one, if it is known; only means go over to those of the orbits there: a
 * period may double. */
static void put_birth(columns *c, const fst_branch *b, const fst_branch_point *first,
                      const fst_observable_info *what)
{
    for (size_t i = 0; i < b->special_count && strncmp(what->name, "mean_", 5) == 0; ++i)
        if (b->specials[i].born == first->branch && goes_on_to(what, &b->specials[i].at, first))
            fst_columns_put(c, b->specials[i].value, value_of(&b->specials[i].at, what));
}

/* Whether a bead floats above the magnet; the weight pulls it down. */
static int is_above(const fst_branch *b, const fst_branch_point *p)
{
    return (b->scene->plate_gravity < 0 ? -p->levitation.state[2] : p->levitation.state[2]) > 0;
}

/* Write the pieces of one stability, with a gap between them; `above`: of one side of the magnet, -1: of both. */
static void put_pieces(columns *c, const fst_branch *b, const fst_observable_info *what, int stable, int above)
{
    for (size_t i = 0; i < b->point_count; ++i) {
        const fst_branch_point *p = &b->points[i];
        const int joined = i > 0 && p[-1].branch == p->branch;
        const int goes_on = i + 1 < b->point_count && p[1].branch == p->branch;
        if (p->stable != stable || is_hidden(b, what, p->branch) || (above >= 0 && is_above(b, p) != above))
            continue;
        if (!joined)
            put_birth(c, b, p, what);
        if (joined && p[-1].stable != stable)
            put_border(c, b, p - 1, p, what);
        if (joined && p[-1].stable == stable && !goes_on_to(what, p - 1, p))
            put_gap(c, b, p - 1, p, what);
        fst_columns_put(c, p->value, value_of(p, what));
        if (goes_on && p[1].stable != stable)
            put_border(c, b, p, p + 1, what);
        if (!goes_on || p[1].stable != stable)
            fst_columns_put(c, NAN, NAN);
    }
}

/* Whether its points have eigenvalues, in gamma or, of levitation, in 1/s. */
static int has_eigenvalues(const fst_branch *b)
{
    return b->kind == FST_BRANCH_LOCKED || b->kind == FST_BRANCH_LEVITATING;
}

static void put_multipliers(columns *c, const fst_branch *b, int stable)
{
    for (size_t i = 0; i < b->point_count; ++i) {
        const fst_branch_point *p = &b->points[i];
        const fst_levitation *l = &p->levitation;
        for (int k = 0; k < FST_LEVITATION_DIRECTIONS && p->stable == stable; ++k)
            if (b->kind == FST_BRANCH_LEVITATING)
                fst_columns_put(c, l->eigenvalue_re[k], l->eigenvalue_im[k]);
            else if (k < p->multipliers &&
                     (b->kind != FST_BRANCH_ALL || p->multipliers == FST_MULTIPLIER_COUNT))
                fst_columns_put(c, p->multiplier_re[k], p->multiplier_im[k]);
    }
}

/* The most numbers that a curve of a branch is made of, before it is smooth. */
static size_t room_for(const fst_branch *b)
{
    return 7 * b->point_count + b->special_count;
}

int fst_branch_curve(fst_chart *chart, const fst_branch *b, const char *observable, int stable,
                     fst_columns *curve)
{
    const fst_observable_info *what = find_observable(observable);
    if (!fst_columns_make(chart, curve, room_for(b)))
        return 0;
    put_pieces(curve, b, what, stable, -1);
    return fst_columns_smoothen(chart, curve);
}

static void show_in_units(columns *c, const shown *s)
{
    for (size_t i = 0; i < c->count; ++i) {
        c->x[i] *= s->x.factor;
        c->y[i] *= s->y.factor;
    }
}

static void style_curve(fst_chart_curve *curve, const columns *c, const char *title, fst_colour colour,
                        fst_curve_style style)
{
    *curve = (fst_chart_curve){
        .title = title, .x = c->x, .y = c->y, .count = c->count, .colour = colour, .style = style};
}

/* How special points are called and drawn. */
#define SIGN(NAME, name, doc, words, colour, sign) {words, FST_COLOUR_##colour, sign},
static const struct {
    const char *words;
    fst_colour colour;
    int sign; /* gnuplot's number of the shape */
} signs[] = {FST_SPECIALS(SIGN)};
#undef SIGN

fst_look fst_special_look(fst_special_type type)
{
    if ((unsigned)type >= FST_SPECIAL_COUNT)
        return (fst_look){NULL, NULL};
    return (fst_look){signs[type].words, fst_colour_code(signs[type].colour)};
}

fst_chart_curve fst_special_curve(fst_special_type type)
{
    return (fst_chart_curve){.title = signs[type].words,
                             .colour = signs[type].colour,
                             .sign = signs[type].sign,
                             .style = FST_CURVE_SIGNS};
}

/* Add the special points to so many lines, and stable ones again over them: a short piece is seen on the signs of its ends.
 * Returns how many curves there are. */
static int add_specials(const fst_branch *b, const shown *s, columns *c, fst_chart_curve *curves, int lines)
{
    int count = lines;
    for (int type = 0; type < FST_SPECIAL_COUNT; ++type) {
        columns *special = &c[2 * SIDES + type];
        for (size_t i = 0; i < b->special_count; ++i)
            if ((int)b->specials[i].type == type)
                fst_columns_put(special, b->specials[i].value, value_of(&b->specials[i].at, s->what));
        if (special->count == 0)
            continue;
        show_in_units(special, s);
        curves[count] = fst_special_curve((fst_special_type)type);
        curves[count].x = special->x;
        curves[count].y = special->y;
        curves[count++].count = special->count;
    }
    for (int k = 0; k < lines && count > lines; ++k)
        if (curves[k].style == FST_CURVE_LINE) {
            curves[count] = curves[k];
            curves[count++].title = NULL;
        }
    return count;
}

/* Returns how many curves there are; -1: no memory. */
static int add_diagram(fst_chart *chart, const fst_branch *b, const shown *s, columns *c,
                       fst_chart_curve *curves)
{
    static const char *const words[][2] = {{"stable, below the magnet", "unstable, below"},
                                           {"stable, above the magnet", "unstable, above"},
                                           {"stable", "unstable"},
                                           {"of a stable state", "of an unstable state"}};
    const int over_two = b->second_key[0] != 0,
              sided = b->kind == FST_BRANCH_LEVITATING && b->scene && !over_two;
    int count = 0;
    for (int k = 0; k < (sided ? 2 * SIDES : 2); ++k) {
        const int unstable = k % 2, above = k / 2;
        put_pieces(&c[k], b, s->what, !unstable, sided ? above : -1);
        if (sided && c[k].count == 0)
            continue;
        if (!fst_columns_smoothen(chart, &c[k]))
            return -1;
        show_in_units(&c[k], s);
        style_curve(&curves[count++], &c[k], words[sided ? above : 2 + over_two][unstable],
                    above                ? FST_COLOUR_VERMILION
                    : unstable && !sided ? FST_COLOUR_GREY
                                         : FST_COLOUR_BLUE,
                    unstable ? FST_CURVE_DASHED : FST_CURVE_LINE);
    }
    return add_specials(b, s, c, curves, count);
}

/* The multipliers of orbits with the unit circle, or the eigenvalues of locked states, whose real part decides.
 */
static int add_multipliers(const fst_branch *b, const shown *s, columns *c, fst_chart_curve *curves)
{
    int count = 0;
    for (int i = 0; i < CIRCLE && !has_eigenvalues(b); ++i)
        fst_columns_put(&c[2], cos(FST_TWO_PI * i / (CIRCLE - 1)), sin(FST_TWO_PI * i / (CIRCLE - 1)));
    put_multipliers(&c[0], b, 1);
    put_multipliers(&c[1], b, 0);
    show_in_units(&c[0], s);
    show_in_units(&c[1], s);
    if (c[2].count > 0)
        style_curve(&curves[count++], &c[2], "unit circle: within it disturbances die away", FST_COLOUR_BLACK,
                    FST_CURVE_LINE);
    const int many = has_eigenvalues(b); /* so many a point that they lie on curves */
    style_curve(&curves[count++], &c[1], "of unstable points of the branch", FST_COLOUR_VERMILION,
                many ? FST_CURVE_DOTS : FST_CURVE_OPEN_POINTS);
    style_curve(&curves[count++], &c[0], "of stable points", FST_COLOUR_BLUE,
                many ? FST_CURVE_DOTS : FST_CURVE_POINTS);
    return count;
}

static fst_status unknown_observable(const char *name, fst_error *error)
{
    char names[256] = "multipliers", suggestion[FST_SUGGESTION_SIZE];
    for (size_t i = 0; i < sizeof OBSERVABLES / sizeof *OBSERVABLES; ++i) {
        const size_t used = strlen(names);
        (void)snprintf(names + used, sizeof names - used, "|%s", OBSERVABLES[i].name);
    }
    return fst_fail(error, FST_BAD_INPUT, "fst_figure_branch.observable", "unknown observable \"%.60s\"; %s",
                    name, fst_suggest_name(name, names, suggestion));
}

static int has_values(const fst_branch *b, const fst_observable_info *what)
{
    for (size_t i = 0; i < b->point_count; ++i)
        if (isfinite(value_of(&b->points[i], what)))
            return 1;
    return 0;
}

/* An observable that belongs to the other kinds of branch would leave the frame empty. */
static fst_status check_values(const fst_branch *b, const fst_observable_info *what, fst_error *error)
{
    char names[256] = "";
    if (has_values(b, what))
        return FST_OK;
    for (size_t i = 0; i < sizeof OBSERVABLES / sizeof *OBSERVABLES; ++i)
        if (has_values(b, &OBSERVABLES[i])) {
            const size_t used = strlen(names);
            (void)snprintf(names + used, sizeof names - used, "%s%s", used ? ", " : "", OBSERVABLES[i].name);
        }
    return fst_fail(error, FST_BAD_INPUT, "fst_figure_branch.observable",
                    "no point of this branch (kind: %s) has a value of %s; it has values of %s",
                    fst_branch_kind_name(b->kind), what->name, names);
}

static int is_scale(const char *key)
{
    return strcmp(key, "friction.gamma") == 0 || strcmp(key, "magnet.half_length") == 0;
}

/* The axes in their units. */
static fst_status choose_axes(const fst_branch *b, fst_shown_units units, shown *s, fst_error *error)
{
    const fst_scales scales = {b->half_length, 1.0 / b->gamma, NAN, NAN};
    const char *scale = is_scale(b->key) ? b->key : is_scale(b->second_key) ? b->second_key : NULL;
    const int known = !scale && isfinite(scales.length) && isfinite(scales.time);
    if (units != FST_SHOWN_AS_GIVEN && !known)
        return fst_fail(
            error, FST_BAD_INPUT, "fst_figure_branch.units",
            scale ? "the branch varies %s, a unit itself, so it is shown in the units it was made with"
                  : "%sthis file has no scene, so that its scaled units are not known in others",
            scale ? scale : "");
    const fst_shown_units used = units != FST_SHOWN_AS_GIVEN ? units
                                 : known                     ? fst_units_over((const char *[]){b->key}, 1)
                                                             : FST_SHOWN_AS_GIVEN;
    if (s->what)
        s->x = fst_quantity_of_parameter(b->key, units, &scales);
    if (!s->what) {
        const char *unit = b->kind == FST_BRANCH_LOCKED ? "gamma" : "1";
        const int per_second = b->kind == FST_BRANCH_LEVITATING;
        s->x = fst_quantity_of_result(per_second ? "real part (1/s)" : "real part", unit, used, &scales);
        s->y =
            fst_quantity_of_result(per_second ? "imaginary part (1/s)" : "imaginary part", unit, used, &scales);
    } else if (strcmp(s->what->name, "second") == 0 && b->second_key[0]) {
        s->y = fst_quantity_of_parameter(b->second_key, units, &scales);
    } else {
        s->y = fst_quantity_of_result(s->what->name, s->what->unit, used, &scales);
    }
    return FST_OK;
}

static void make_title(const fst_branch *b, const shown *s, char *title, size_t size)
{
#define KIND_WORDS(NAME, name, doc, words) words,
    static const char *const kinds[] = {FST_BRANCH_KINDS(KIND_WORDS)};
#undef KIND_WORDS
    char over[128], second[128];
    const fst_scales none = {NAN, NAN, NAN, NAN};
    (void)snprintf(over, sizeof over, "%s", fst_quantity_of_parameter(b->key, FST_SHOWN_AS_GIVEN, &none).label);
    over[strcspn(over, "(") - (strchr(over, '(') != NULL)] = '\0';
    if (!s->what && has_eigenvalues(b))
        (void)snprintf(title, size, "Eigenvalues along the %s",
                       b->kind == FST_BRANCH_LOCKED ? "locked states" : "places where the bead floats");
    else if (!s->what)
        (void)snprintf(title, size, "Multipliers along the branch, those up to 1.2");
    else if (b->second_key[0]) {
        (void)snprintf(second, sizeof second, "%s",
                       fst_quantity_of_parameter(b->second_key, FST_SHOWN_AS_GIVEN, &none).label);
        second[strcspn(second, "(") - (strchr(second, '(') != NULL)] = '\0';
        (void)snprintf(title, size, "%s: special points (%s) over %.60s and %.60s", kinds[b->kind],
                       signs[b->followed].words, over, second);
    } else
        (void)snprintf(title, size, "%s over the %.90s", kinds[b->kind], over);
}

/* Axes, ranges and words of the chart. */
static fst_status arrange(fst_chart *chart, const fst_branch *b, const shown *s, const fst_chart_curve *curves,
                          int count)
{
    static const fst_chart_mark axis = {0.0, "left of it disturbances die away"};
    const int circle = !s->what && !has_eigenvalues(b), rates = !s->what && !circle;
    char title[256], about[256] = "";
    make_title(b, s, title, sizeof title);
    if (b->scene)
        fst_caption(b->scene, (const char *[]){b->key, b->second_key}, 2, about, sizeof about);
    if (!b->complete)
        (void)snprintf(about + strlen(about), sizeof about - strlen(about), "%s(incomplete: interrupted)",
                       about[0] ? " " : "");
    fst_chart_panel *panel = fst_chart_keep(chart, sizeof *panel);
    chart->title = fst_chart_text(chart, title);
    chart->about = about[0] ? fst_chart_text(chart, about) : NULL;
    chart->scene = b->scene ? fst_chart_scene(chart, b->scene) : NULL;
    chart->x_label = fst_chart_text(chart, s->x.label);
    const char *y_label = fst_chart_text(chart, s->y.label);
    if (!panel || !chart->title || !chart->x_label || !y_label)
        return FST_NO_MEMORY;
    chart->x_low = circle ? -1.2 : rates ? 0.0 : s->x.factor * fmin(b->from, b->to);
    chart->x_high = circle ? 1.2 : rates ? 0.0 : s->x.factor * fmax(b->from, b->to);
    for (int c = 0; rates && c < count; ++c)
        for (size_t i = 0; i < curves[c].count; ++i) {
            chart->x_low = fmin(chart->x_low, 1.05 * curves[c].x[i]);
            chart->x_high = fmax(chart->x_high, 1.05 * curves[c].x[i]);
        }
    if (rates)
        chart->x_high = fmax(chart->x_high, 0.05 * (chart->x_high - chart->x_low));
    *panel = (fst_chart_panel){.left_label = y_label,
                               .low = circle ? -1.2 : NAN,
                               .high = circle ? 1.2 : NAN,
                               .curves = curves,
                               .curve_count = count};
    chart->square = circle;
    chart->panels = panel;
    chart->panel_count = 1;
    chart->marks = &axis;
    chart->mark_count = rates;
    return FST_OK;
}

/* Fill in an empty chart; FST_NO_MEMORY needs no sentence yet. */
static fst_status fill(fst_chart *chart, const fst_branch *b, const shown *s, const double *dots,
                       size_t dot_count)
{
    columns c[CURVES];
    fst_chart_curve *curves = fst_chart_keep(chart, (CURVES + SIDES) * sizeof *curves);
    const size_t most = room_for(b) + FST_LEVITATION_DIRECTIONS * b->point_count + CIRCLE;
    for (int i = 0; i < CURVES; ++i)
        if (!curves || !fst_columns_make(chart, &c[i], most + dot_count))
            return FST_NO_MEMORY;
    int count = s->what ? add_diagram(chart, b, s, c, curves) : add_multipliers(b, s, c, curves);
    columns *simulated = &c[CURVES - 1];
    for (size_t i = 0; i < dot_count && s->what; ++i)
        fst_columns_put(simulated, dots[2 * i], dots[2 * i + 1]);
    if (count >= 0 && simulated->count > 0) {
        show_in_units(simulated, s);
        style_curve(&curves[count++], simulated, "simulated", FST_COLOUR_BLACK, FST_CURVE_OPEN_POINTS);
    }
    return count < 0 ? FST_NO_MEMORY : arrange(chart, b, s, curves, count);
}

fst_status fst_chart_of_branch(const fst_branch *branch, const char *observable, fst_shown_units units,
                               const double *dots, size_t dot_count, fst_chart **chart, fst_error *error)
{
    shown s = {.what = find_observable(observable)};
    *chart = NULL;
    if (!s.what && strcmp(observable, "multipliers") != 0)
        return unknown_observable(observable, error);
    if (branch->point_count == 0)
        return fst_fail(error, FST_BAD_INPUT, branch->key,
                        "this branch has no points, so that there is nothing to draw%s",
                        branch->complete ? "" : ": it was interrupted before the first one; compute it again");
    fst_status status = s.what ? check_values(branch, s.what, error) : FST_OK;
    if (status == FST_OK)
        status = choose_axes(branch, units, &s, error);
    if (status != FST_OK)
        return status;
    *chart = fst_chart_new();
    if (*chart && fill(*chart, branch, &s, dots, dot_count) == FST_OK)
        return FST_OK;
    fst_chart_free(*chart);
    *chart = NULL;
    return fst_fail(error, FST_NO_MEMORY, branch->key, "out of memory");
}

fst_status fst_figure_branch(const fst_branch *branch, const char *observable, fst_shown_units units,
                             const double *dots, size_t dot_count, const char *out, fst_error *error)
{
    fst_chart *chart;
    fst_status status = fst_chart_of_branch(branch, observable, units, dots, dot_count, &chart, error);
    if (status == FST_OK)
        status = fst_figure_chart(out, chart, error);
    fst_chart_free(chart);
    return status;
}
