/* field_map.c - what a map of the magnet's field shows: |B|, a component, or the force and load of a bead. */
#include "base/error.h"
#include "draw/caption.h"
#include "draw/chart.h"
#include "draw/poles.h"

#include <math.h>
#include <string.h>

enum {
    COLUMNS = 181,
    ROWS = 145,
    ARROW_STEP = 12, /* places from one arrow to the next */
    ARROWS = (COLUMNS / ARROW_STEP + 1) * (ROWS / ARROW_STEP + 1),
    LEVELS = 8, /* about as many lines of equal value */
    OPTIONS_COOKIE = 0x4649454c
};

/* Of the map's width: between two values of lines, and from a value to the next arrow. */
static const double LABEL_GAP = 0.035, LABEL_CLEAR = 0.026;

/* What each quantity is called: on the scale of colours, and in the title. */
#define WORDS(NAME, name, title, label) {label, title},
static const struct {
    const char *label, *title;
} words[] = {FST_FIELDS(WORDS)};
#undef WORDS

/* What is asked of the model. */
typedef struct survey {
    fst_model *model;
    const fst_params *params;
    fst_groups groups;
    fst_field_quantity quantity;
    double half_width, half_height; /* of the map, in l */
    double length, value;           /* how many of the picture's units make l, and the quantity's scaled unit */
    char length_unit[16], unit[32]; /* their names */
    double least, greatest;         /* of the quantity, in the picture's unit */
    double strongest;               /* of what the arrows show, scaled */
} survey;

static double x_of(const survey *s, int column)
{
    return s->half_width * (2.0 * column / (COLUMNS - 1) - 1.0);
}

static double y_of(const survey *s, int row)
{
    return s->half_height * (2.0 * row / (ROWS - 1) - 1.0);
}

static double strength(const fst_model *model, double x, double y)
{
    double b[3], gradient[3][3];
    fst_field(model, x, y, b, gradient);
    return sqrt(b[0] * b[0] + b[1] * b[1] + b[2] * b[2]);
}

static int is_of_bead(const survey *s)
{
    return s->quantity == FST_FIELD_FORCE || s->quantity == FST_FIELD_LOAD;
}

/* The quantity at a place, in the picture's unit; NAN in a part of the magnet. */
static double value_at(const survey *s, double x, double y)
{
    double b[3], gradient[3][3], force[3], load;
    switch (s->quantity) {
    case FST_FIELD_STRENGTH:
        return s->value * strength(s->model, x, y);
    case FST_FIELD_FORCE:
        fst_field_pull(s->model, x, y, force, &load);
        return s->value * hypot(force[0], force[1]);
    case FST_FIELD_LOAD:
        fst_field_pull(s->model, x, y, force, &load);
        return s->value * load;
    default:
        fst_field(s->model, x, y, b, gradient);
        return s->value * b[s->quantity - FST_FIELD_X];
    }
}

/* What the arrows show: the part of the field in the plane (B0), or of the force (l gamma^2). */
static void arrow_at(const survey *s, double x, double y, double arrow[2])
{
    double v[3], gradient[3][3], load;
    if (is_of_bead(s))
        fst_field_pull(s->model, x, y, v, &load);
    else
        fst_field(s->model, x, y, v, gradient);
    const int nothing = !isfinite(v[0]);
    arrow[0] = nothing ? 0.0 : v[0];
    arrow[1] = nothing ? 0.0 : v[1];
}

/* Whether the quantity is the same everywhere, as that of a uniform field or of none; nothing can be drawn on it. */
static int is_even(const survey *s)
{
    return !(s->greatest - s->least > 1e-9 * fmax(fabs(s->least), fabs(s->greatest)));
}

/* ------------------------------------------------------------------ values and maxima */

static int put_values(fst_field_picture *picture, survey *s)
{
    picture->columns = COLUMNS;
    picture->rows = ROWS;
    picture->values = fst_keep(&picture->memory, sizeof(double) * COLUMNS * ROWS);
    s->least = INFINITY;
    s->greatest = -INFINITY;
    for (int i = 0; picture->values && i < COLUMNS * ROWS; ++i) {
        const double value = value_at(s, x_of(s, i % COLUMNS), y_of(s, i / COLUMNS));
        picture->values[i] = value;
        s->least = fmin(s->least, value); /* of NAN the other */
        s->greatest = fmax(s->greatest, value);
    }
    return picture->values != NULL;
}

/* Climb from a place to the maximum: step along both axes, and halve the step where none leads up. */
static void climb(const fst_model *model, double step, double place[2])
{
    double here = strength(model, place[0], place[1]);
    while (step > 1e-9) {
        static const double ways[4][2] = {{1, 0}, {-1, 0}, {0, 1}, {0, -1}};
        int moved = 0;
        for (int i = 0; i < 4 && !moved; ++i) {
            double x = place[0] + step * ways[i][0], y = place[1] + step * ways[i][1];
            double there = strength(model, x, y);
            if (there > here) {
                here = there;
                place[0] = x;
                place[1] = y;
                moved = 1;
            }
        }
        if (!moved)
            step *= 0.5;
    }
}

/* Maxima are found in l. */
static void note_maximum(fst_field_picture *picture, const survey *s, int column, int row)
{
    double place[2] = {x_of(s, column), y_of(s, row)};
    climb(s->model, x_of(s, 1) - x_of(s, 0), place);
    for (int m = 0; m < picture->maximum_count; ++m)
        if (hypot(place[0] - picture->maxima[m][0], place[1] - picture->maxima[m][1]) < 1e-4)
            return;
    memcpy(picture->maxima[picture->maximum_count++], place, sizeof place);
}

/* Every place that is not lower than its eight neighbours leads to a maximum. */
static void find_maxima(fst_field_picture *picture, const survey *s)
{
    for (int row = 1; row < ROWS - 1; ++row)
        for (int column = 1; column < COLUMNS - 1 && picture->maximum_count < FST_PICTURE_MAXIMA; ++column) {
            const double *here = picture->values + row * COLUMNS + column;
            int highest = 1;
            for (int i = 0; i < 9 && highest; ++i)
                highest = *here >= here[(i / 3 - 1) * COLUMNS + i % 3 - 1];
            if (highest)
                note_maximum(picture, s, column, row);
        }
}

static void put_maxima(fst_field_picture *picture, const survey *s)
{
    double(*m)[2] = picture->maxima;
    if (s->quantity == FST_FIELD_STRENGTH && !is_even(s))
        find_maxima(picture, s);
    for (int i = 0; i < picture->maximum_count; ++i)
        for (int k = 0; k < 2; ++k)
            m[i][k] *= s->length;
    if (picture->maximum_count == 2)
        (void)snprintf(picture->distance, sizeof picture->distance, "%.3g %s",
                       hypot(m[0][0] - m[1][0], m[0][1] - m[1][1]), s->length_unit);
}

/* ------------------------------------------------------------------ lines of equal value, arrows */

static void put_levels(fst_field_picture *picture, const survey *s, double step, double from)
{
    for (double level = step * (floor(from / step) + 1.0);
         level < s->greatest && picture->level_count < FST_PICTURE_LEVELS; level += step)
        picture->levels[picture->level_count++] = fabs(level) < 1e-9 * step ? 0.0 : level;
}

/* Values of lines stand where these pass the column beside a maximum, on which the field falls: between two columns
 * of arrows, and no closer to the value before than letters are high. */
static void put_labels(fst_field_picture *picture, const survey *s)
{
    enum { STEPS = 2000 };
    const double peak = picture->maximum_count ? fabs(picture->maxima[0][0]) / s->length : 0.0;
    const double place = (peak / s->half_width + 1.0) / 2.0 * (COLUMNS - 1) / ARROW_STEP;
    const double x = x_of(s, ARROW_STEP * (int)(place + 0.5));
    const double from = s->quantity == FST_FIELD_STRENGTH ? 0.0 : s->least;
    const double step = fst_round_step((s->greatest - from) / LEVELS);
    double before = value_at(s, x, 0.0), labelled = -INFINITY;
    if (is_even(s))
        return;
    put_levels(picture, s, step, from);
    for (int i = 1; i <= STEPS && picture->label_count < FST_PICTURE_LEVELS; ++i) {
        const double y = 0.95 * s->half_height * i / STEPS;
        const double here = value_at(s, x, y);
        const double level = step * fmax(floor(before / step), floor(here / step));
        const int passes = floor(before / step) != floor(here / step) && isfinite(before) && isfinite(here);
        if (passes && (level > 0.0 || from < 0.0) && y - labelled > LABEL_GAP * 2.0 * s->half_width) {
            double *to = picture->labels[picture->label_count++];
            to[0] = s->length * x;
            to[1] = s->length * y;
            to[2] = level;
            labelled = y;
        }
        before = here;
    }
}

/* Whether an arrow passes a place closer than words may be passed. */
static int passes(const fst_field_picture *picture, const double arrow[4], double x, double y)
{
    const double square = arrow[2] * arrow[2] + arrow[3] * arrow[3], dx = x - arrow[0], dy = y - arrow[1];
    const double along = square > 0.0 ? fmax(0.0, fmin(1.0, (dx * arrow[2] + dy * arrow[3]) / square)) : 0.0;
    return hypot(dx - along * arrow[2], dy - along * arrow[3]) <
           LABEL_CLEAR * (picture->box[1] - picture->box[0]);
}

/* Whether an arrow would run into the value of a line, or into the distance of the maxima, which stands over the
 * middle between them and is as wide as three values. */
static int meets_words(const fst_field_picture *picture, const double arrow[4])
{
    const double(*m)[2] = picture->maxima, step = LABEL_GAP * (picture->box[1] - picture->box[0]);
    int meets = 0;
    for (int i = 0; i < picture->label_count; ++i)
        meets = meets || passes(picture, arrow, picture->labels[i][0], picture->labels[i][1]);
    for (int k = -1; k <= 1 && picture->distance[0]; ++k)
        meets = meets ||
                passes(picture, arrow, 0.5 * (m[0][0] + m[1][0]) + k * step, 0.5 * (m[0][1] + m[1][1]) + step);
    return meets;
}

/* Arrows of the field, or of the force, in the plane.  Their length goes with the square root of the strength, so
 * that weak fields show too. */
static int put_arrows(fst_field_picture *picture, survey *s)
{
    const double longest = 1.1 * ARROW_STEP * 2.0 * s->half_width / (COLUMNS - 1);
    double(*parts)[4] = fst_keep(&picture->memory, ARROWS * sizeof *parts);
    size_t count = 0;
    if (!parts)
        return 0;
    s->strongest = 0.0;
    for (int row = ARROW_STEP / 2; row < ROWS; row += ARROW_STEP)
        for (int column = ARROW_STEP / 2; column < COLUMNS; column += ARROW_STEP) {
            double *to = parts[count++];
            to[0] = x_of(s, column);
            to[1] = y_of(s, row);
            arrow_at(s, to[0], to[1], to + 2);
            s->strongest = fmax(s->strongest, hypot(to[2], to[3]));
        }
    for (size_t i = 0; i < count; ++i) {
        const double plane = hypot(parts[i][2], parts[i][3]);
        const double scale = plane > 0.0 ? longest * sqrt(plane / s->strongest) / plane : 0.0;
        double *to = parts[picture->arrow_count];
        const double dx = s->length * scale * parts[i][2], dy = s->length * scale * parts[i][3];
        to[0] = s->length * parts[i][0] - 0.5 * dx;
        to[1] = s->length * parts[i][1] - 0.5 * dy;
        to[2] = dx;
        to[3] = dy;
        picture->arrow_count += plane > 0.0 && !meets_words(picture, to);
    }
    picture->arrows = &parts[0][0];
    picture->longest = longest / (2.0 * s->half_width);
    return 1;
}

/* ------------------------------------------------------------------ words, colours, the magnet */

static void choose_units(survey *s, fst_shown_units units)
{
    const fst_scales scales = fst_scales_of(s->params);
    const char *name;
    s->length = fst_unit_shown("l", units, &scales, &name);
    fst_unit_symbols(name, s->length_unit, sizeof s->length_unit);
    s->value = fst_unit_shown(is_of_bead(s) ? "l gamma^2" : "B0", units, &scales, &name);
    fst_unit_symbols(name, s->unit, sizeof s->unit);
}

/* Lines of dipoles; a wave is there in place of a magnet. */
static int is_bar(const fst_params *p)
{
    return p->magnet_shape == FST_MAGNET_LINES && p->drive_waveform != FST_WAVEFORM_WAVE;
}

/* Whose field it is, where more than a turning magnet makes it. */
static void name_sources(const fst_params *p, char *text, size_t size)
{
    const int wave = p->drive_waveform == FST_WAVEFORM_WAVE, parts = p->magnet_shape == FST_MAGNET_PARTS;
    const double *b = p->field_uniform;
    int count = 0;
    char coils[32];
    (void)snprintf(coils, sizeof coils, "%d coil%s", p->coil_count, p->coil_count == 1 ? "" : "s");
    const char *const names[] = {wave ? "a wave" : NULL,
                                 (parts ? p->magnet_part_count > 0 : !wave) ? "the magnet" : NULL,
                                 p->coil_count ? coils : NULL,
                                 fabs(b[0]) > 0 || fabs(b[1]) > 0 || fabs(b[2]) > 0 ? "a uniform field" : NULL};
    (void)snprintf(text, size, "; of ");
    for (size_t i = 0; i < sizeof names / sizeof *names; ++i)
        if (names[i])
            (void)snprintf(text + strlen(text), size - strlen(text), "%s%s", count++ ? " and " : "", names[i]);
    (void)snprintf(text + strlen(text), size - strlen(text), " at the time 0, on the laboratory's axes");
}

static void put_words(fst_field_picture *picture, const survey *s, int other_height)
{
    const int bar = is_bar(s->params);
    const double longest = s->value * s->strongest;
    const int all = fst_key_of_surroundings(s->params) != NULL;
    char sources[160] = "";
    if (all)
        name_sources(s->params, sources, sizeof sources);
    const char *title = !all                                ? words[s->quantity].title
                        : s->quantity == FST_FIELD_STRENGTH ? "The field"
                        : s->quantity == FST_FIELD_FORCE    ? "The horizontal pull on a bead"
                                                            : words[s->quantity].title;
    if (other_height)
        (void)snprintf(picture->title, sizeof picture->title, "%s at the height %.4g mm", title,
                       1e3 * s->groups.h * s->groups.length_unit);
    else
        (void)snprintf(picture->title, sizeof picture->title, "%s%s", title,
                       is_of_bead(s) ? "" : " at the height of the bead's centre");
    (void)snprintf(picture->about, sizeof picture->about, "%s: ℓ = %.4g mm%s%s",
                   bar ? "half length of the magnet's lines" : "unit of length", 1e3 * s->groups.length_unit,
                   is_of_bead(s) ? "; the bead's moment along the field" : "", sources);
    fst_caption(s->params, NULL, 0, picture->about, sizeof picture->about);
    (void)snprintf(picture->x_label, sizeof picture->x_label, "X (%s)%s", s->length_unit,
                   bar ? ", along the magnet's lines" : "");
    (void)snprintf(picture->y_label, sizeof picture->y_label, "Y (%s)", s->length_unit);
    (void)snprintf(picture->colour_label, sizeof picture->colour_label, "%s (%s)", words[s->quantity].label,
                   s->unit);
    (void)snprintf(picture->level_words, sizeof picture->level_words, "lines of equal %s",
                   words[s->quantity].label);
    (void)snprintf(picture->arrow_words, sizeof picture->arrow_words,
                   "%s: this length is %.*g %s, others as its square root",
                   is_of_bead(s) ? "horizontal force" : "in-plane part of B", longest < 100.0 ? 2 : 3, longest,
                   s->unit);
}

/* A component has both signs, and grey is its zero; the load may be of any sign. */
static void put_colours(fst_field_picture *picture, const survey *s)
{
    const int component = s->quantity >= FST_FIELD_X && s->quantity <= FST_FIELD_Z, even = is_even(s);
    const double strongest = fmax(fabs(s->least), fabs(s->greatest)), most = strongest > 0.0 ? strongest : 1.0;
    const double low = even ? fmin(s->least, 0.0) : s->least;
    const double high = !even ? s->greatest : low < 0.0 ? 0.0 : most;
    picture->colours = component ? (fst_colour_range){FST_PALETTE_DIVERGING, -most, most}
                                 : (fst_colour_range){FST_PALETTE_MAP, low, high};
}

/* The map shows the poles and the corners of the magnet, with room about them that grows with the height. */
static int choose_extent(survey *s, const fst_field_options *options, void **memory)
{
    const double h = s->groups.h, half_lines = 0.5 * (s->groups.lines - 1) * s->groups.lambda;
    const double l = s->groups.length_unit;
    const int bar = is_bar(s->params);
    s->half_width = fmin(1.0 + 0.9 * h + 0.3, s->groups.map_radius); /* a measured field ends there */
    s->half_height = bar ? half_lines + 0.9 * h : s->half_width;
    fst_magnet_body *bodies = fst_keep(memory, FST_PARTS_MAX * sizeof *bodies);
    const int count = bodies && !bar ? fst_magnet_bodies(s->params, 1.0 / l, 1.0, bodies) : 0;
    double reach[2] = {0.0, 0.0}, middle = 0.0;
    for (int i = 0; i < count; ++i) {
        middle += 0.5 * (bodies[i].seen.low + bodies[i].seen.high) / count;
        for (int k = 0; k < bodies[i].seen.count; ++k)
            for (int axis = 0; axis < 2; ++axis)
                reach[axis] = fmax(reach[axis], fabs(bodies[i].seen.corners[k][axis]));
    }
    if (count > 0) {
        const double room = fmax(0.9 * fabs(h - middle), 0.15 * fmax(reach[0], reach[1]));
        s->half_width = fmax(reach[0] + room, (reach[1] + room) / 1.25);
        s->half_height = fmax(reach[1] + room, 0.5 * s->half_width);
    }
    s->half_width = isnan(options->half_width) ? s->half_width : options->half_width;
    s->half_height = isnan(options->half_height) ? s->half_height : options->half_height;
    return bodies != NULL;
}

static int put_magnet(fst_field_picture *picture, const survey *s)
{
    if (!is_bar(s->params) && s->params->magnet_shape == FST_MAGNET_LINES)
        return 1;
    if (!is_bar(s->params))
        return fst_magnet_lines(s->params, s->length, 0.0, "below the plate", picture->lines,
                                &picture->line_count, &picture->memory);
    picture->line_count = 1;
    return fst_magnet_rows(&s->groups, s->length, "the magnet's lines, below the plate", &picture->lines[0],
                           &picture->memory);
}

/* ------------------------------------------------------------------ all of it */

fst_field_options fst_default_field_options(void)
{
    return (fst_field_options){.cookie = OPTIONS_COOKIE, .height = NAN, .half_width = NAN, .half_height = NAN};
}

static int fill(fst_field_picture *picture, survey *s, const fst_field_options *options)
{
    choose_units(s, options->units);
    if (!choose_extent(s, options, &picture->memory) || !put_values(picture, s))
        return 0;
    for (int i = 0; i < 4; ++i)
        picture->box[i] = (i % 2 ? 1.0 : -1.0) * s->length * (i < 2 ? s->half_width : s->half_height);
    put_maxima(picture, s);
    put_labels(picture, s);
    put_colours(picture, s);
    if (!put_arrows(picture, s) || !put_magnet(picture, s))
        return 0;
    put_words(picture, s, !isnan(options->height) || s->params->plate_shape == FST_PLATE_NONE);
    return 1;
}

fst_status fst_field_picture_of(const fst_params *params, const fst_field_options *options,
                                fst_field_picture *picture, fst_error *error)
{
    const fst_field_options defaults = fst_default_field_options();
    *picture = (fst_field_picture){.columns = 0};
    if (!options)
        options = &defaults;
    if (options->cookie != OPTIONS_COOKIE)
        return fst_fail(error, FST_BAD_INPUT, "fst_field_picture_of",
                        "the options were not made by fst_default_field_options()");
    if (options->half_width <= 0.0 || options->half_height <= 0.0)
        return fst_fail(error, FST_BAD_INPUT, "fst_field_options.half_width",
                        "a map reaches more than 0 to each side");
    survey s = {.params = params, .quantity = options->quantity};
    fst_status status = fst_field_model_new(params, options->height, &s.model, error);
    if (status != FST_OK)
        return status;
    s.groups = fst_model_groups(s.model);
    if (!fill(picture, &s, options))
        status = fst_fail(error, FST_NO_MEMORY, "fst_field_picture_of", "out of memory");
    fst_model_free(s.model);
    return status;
}

void fst_field_picture_free(fst_field_picture *picture)
{
    fst_keep_free(picture->memory);
    *picture = (fst_field_picture){.columns = 0};
}
