/* figure_measure.c - a measured track as a picture, with the path of a scene laid over it.
 *
 *    path on the plate | path in the frame that turns with the magnet
 *    ------------------+---------------------------------------------
 *                       r against alpha
 *    ----------------------------------------------------------------
 *                what the fit leaves of r, over time
 *
 * A bead's path in the laboratory does not close, and two paths of nearly the same rates part after a few
 * turns.  In the magnet's frame both are closed curves.  The scene's curve is known by the part u of its
 * period, from 0 to 1; the phase of the festoons says which u belongs to which frame, and one angle, where the
 * magnet was at the film's begin, is found by laying the curves over each other.
 */
#include <festoon/festoon_tools.h>

#include <stdlib.h>
#include <string.h>

#include "base/constants.h"
#include "base/error.h"
#include "draw/figure_file.h"
#include "draw/legend.h"

enum {
    CURVE = 512,
    LEFT =
        64, /* pixels: margins of the panels, the side of a square one, the height of a wide one, room below */
    RIGHT = 14,
    SQUARE = 184,
    TALL = 120,
    AXIS = 54
};

/* The scene's closed curve in the magnet's frame: places at u = i/CURVE. */
typedef struct closed_curve {
    double x[CURVE], y[CURVE];
    double mean_r, std_r, festoons; /* of the run, in the unit of the places */
    double phase;                   /* by which u is ahead of wave_hz (t - wave_origin) */
    double angle;                   /* of the magnet at t = wave_origin */
} closed_curve;

/* ---------------------------------------------------------------- the track on the plate */

/* The angle by which the magnet turned since wave_origin, counter-clockwise in a film that is not mirrored. */
static double magnet_angle(const fst_measurement *m, double t)
{
    return FST_TWO_PI * m->drive_from_track_hz * (t - m->wave_origin);
}

/* 1, or -1 where the film shows the magnet turning clockwise: then the paths are mirrored. */
static double handedness(const fst_measurement *m)
{
    return (m->bead_frequency_hz > 0) == (m->filmed_sense > 0) ? 1.0 : -1.0;
}

double fst_fitted_radius(const fst_measurement *m, double t)
{
    double r = m->wave_mean;
    for (int k = 0; k < FST_WAVE_LIMIT; ++k) {
        const double angle = FST_TWO_PI * (k + 1) * m->wave_hz * (t - m->wave_origin);
        r += m->wave_cos[k] * cos(angle) + m->wave_sin[k] * sin(angle);
    }
    return r;
}

/* Put one frame. */
static void put_place(fst_placed_track *p, const fst_track *track, const fst_measurement *m, size_t row)
{
    const double dx = track->x[row] - m->centre[0], dy = track->y[row] - m->centre[1];
    const size_t i = p->count++;
    p->row[i] = row;
    p->t[i] = isfinite(track->fps) ? track->t[row] : (double)(track->frame[row] - track->frame[0]);
    const double x = m->stretch[0] * dx + m->stretch[1] * dy, y = m->stretch[1] * dx + m->stretch[2] * dy;
    p->x[i] = x;
    p->y[i] = y;
    p->r[i] = sqrt(x * x + y * y);
    p->fitted[i] = fst_fitted_radius(m, p->t[i]);
    p->seen_x[i] = p->seen_y[i] = NAN;
    if (!isfinite(m->drive_from_track_hz))
        return;
    const double angle = magnet_angle(m, p->t[i]), c = cos(angle), s = sin(angle), up = handedness(m) * y;
    p->seen_x[i] = c * x + s * up;
    p->seen_y[i] = c * up - s * x;
}

fst_status fst_place_track(const fst_track *track, const fst_measurement *m, fst_placed_track *p,
                           fst_error *error)
{
    const size_t room = track->rows + 1;
    *p = (fst_placed_track){.clock = isfinite(track->fps) ? "s" : "frames"};
    double **const columns[] = {&p->t, &p->x, &p->y, &p->seen_x, &p->seen_y, &p->r, &p->fitted};
    const size_t count = sizeof columns / sizeof *columns;
    double *memory = malloc(room * (count * sizeof *memory + sizeof *p->row));
    if (!memory)
        return fst_fail(error, FST_NO_MEMORY, "", "no memory for a figure of %zu frames", track->rows);
    p->memory = memory;
    for (size_t i = 0; i < count; ++i)
        *columns[i] = memory + i * room;
    p->row = (size_t *)(void *)(memory + count * room);
    for (size_t row = 0; row < track->rows; ++row)
        if (track->flag[row] != FST_FRAME_LOST)
            put_place(p, track, m, row);
    return FST_OK;
}

void fst_placed_track_free(fst_placed_track *p)
{
    free(p->memory);
    *p = (fst_placed_track){.count = 0};
}

/* ---------------------------------------------------------------- the scene */

typedef struct samples {
    double *t, *x, *y;
    size_t count, room;
} samples;

static fst_status keep_sample(void *user, const fst_sample *sample, fst_error *error)
{
    samples *s = user;
    if (s->count == s->room) {
        const size_t room = s->room ? 2 * s->room : 4096;
        double **const arrays[] = {&s->t, &s->x, &s->y};
        for (size_t i = 0; i < sizeof arrays / sizeof *arrays; ++i) {
            double *longer = realloc(*arrays[i], room * sizeof *longer);
            if (!longer)
                return fst_fail(error, FST_NO_MEMORY, "", "no memory for %zu samples", room);
            *arrays[i] = longer;
        }
        s->room = room;
    }
    s->t[s->count] = sample->t;
    s->x[s->count] = sample->state[FST_X];
    s->y[s->count++] = sample->state[FST_Y];
    return FST_OK;
}

/* The last period of the samples, at even steps of u. */
static int take_period(const samples *s, double period, double length, closed_curve *curve)
{
    const double from = s->count > 1 ? s->t[s->count - 1] - period : 0.0;
    size_t i = 0;
    if (s->count < 2 || from < s->t[0])
        return 0;
    for (int k = 0; k < CURVE; ++k) {
        const double t = from + period * k / CURVE;
        while (i + 2 < s->count && s->t[i + 1] <= t)
            ++i;
        const double part = (t - s->t[i]) / (s->t[i + 1] - s->t[i]);
        curve->x[k] = length * (s->x[i] + part * (s->x[i + 1] - s->x[i]));
        curve->y[k] = length * (s->y[i] + part * (s->y[i + 1] - s->y[i]));
    }
    return 1;
}

/* Where a curve is at the part u of its period. */
static void curve_at(const closed_curve *curve, double u, double place[2])
{
    const double at = (u - floor(u)) * CURVE;
    const int i = (int)at % CURVE, j = (i + 1) % CURVE;
    const double part = at - floor(at);
    place[0] = curve->x[i] + part * (curve->x[j] - curve->x[i]);
    place[1] = curve->y[i] + part * (curve->y[j] - curve->y[i]);
}

/* Find the phase of the festoons and the magnet's angle by which the curve lies on the track. */
static void lay_over(closed_curve *curve, const fst_placed_track *p, const fst_measurement *m)
{
    const int k = m->symmetry == 2 ? 2 : 1;
    double c = 0, s = 0, re = 0, im = 0;
    for (int i = 0; i < CURVE; ++i) {
        const double r = sqrt(curve->x[i] * curve->x[i] + curve->y[i] * curve->y[i]);
        c += r * cos(FST_TWO_PI * k * i / CURVE);
        s += r * sin(FST_TWO_PI * k * i / CURVE);
    }
    curve->phase = (atan2(s, c) - atan2(m->wave_sin[k - 1], m->wave_cos[k - 1])) / (FST_TWO_PI * k);
    for (size_t i = 0; i < p->count; ++i) {
        const double seen[2] = {p->seen_x[i], p->seen_y[i]};
        double there[2];
        curve_at(curve, m->wave_hz * (p->t[i] - m->wave_origin) + curve->phase, there);
        re += seen[0] * there[0] + seen[1] * there[1];
        im += seen[1] * there[0] - seen[0] * there[1];
    }
    curve->angle = atan2(im, re);
}

static fst_status follow_scene(const fst_params *compare, const fst_measurement *m,
                               const fst_progress *progress, closed_curve *curve, fst_error *error)
{
    fst_params params = *compare;
    fst_run_options options = fst_default_run_options();
    fst_run_result run;
    samples s = {NULL, NULL, NULL, 0, 0};
    char text[32];
    double length = 1.0;
    (void)snprintf(text, sizeof text, "%.17g Hz", m->drive_from_track_hz);
    fst_status status = fst_params_set(&params, "drive.frequency", text, error);
    params.run_samples = params.run_samples < 128 ? 128 : params.run_samples;
    options.sink = (fst_run_sink){&s, keep_sample, NULL};
    options.progress = progress;
    if (params.run_until != FST_UNTIL_SETTLED) /* which may end before its discard */
        options.sample_from = fst_run_discard(&params);
    if (status == FST_OK)
        status = fst_run(&params, &options, &run, error);
    if (status == FST_OK && run.regime != FST_REGIME_COUNTER_ROTATING && run.regime != FST_REGIME_COROTATING)
        status = fst_fail(error, FST_NO_CONVERGENCE, "fst_figure_measurement.compare",
                          "the scene's bead is %s at %.6g Hz: it has no path that could be laid over the track",
                          fst_regime_name(run.regime), m->drive_from_track_hz);
    if (status == FST_OK) {
        (void)snprintf(text, sizeof text, "1 %s", m->length_unit);
        length = fst_parse_value(text, FST_UNIT_LENGTH, &length, NULL) == FST_OK
                     ? params.magnet_half_length / length
                     : m->mean_r / run.mean_r;
        *curve = (closed_curve){
            .mean_r = length * run.mean_r, .std_r = length * run.std_r, .festoons = run.festoons};
        if (!take_period(&s, run.period, length, curve))
            status = fst_fail(error, FST_NO_CONVERGENCE, "fst_figure_measurement.compare",
                              "the scene's run is shorter than a turn against the magnet: raise run.periods");
    }
    free(s.t);
    free(s.x);
    free(s.y);
    return status;
}

/* ---------------------------------------------------------------- data */

static void write_track(fst_figure_file *figure, const fst_track *track, const fst_placed_track *p)
{
    for (int rejected = 0; rejected < 2; ++rejected) {
        fst_figure_block(figure, rejected ? "rejected" : "seen", "t x y X Y alpha/degrees r r-fit");
        size_t written = 0;
        for (size_t i = 0; i < p->count; ++i) {
            if ((track->flag[p->row[i]] == FST_FRAME_REJECTED) != rejected)
                continue;
            const double alpha = atan2(p->y[i], p->x[i]) * 180.0 / FST_PI;
            (void)fprintf(figure->data, "%.9g %.9g %.9g %.9g %.9g %.9g %.9g %.9g\n", p->t[i], p->x[i], p->y[i],
                          p->seen_x[i], p->seen_y[i], alpha < 0 ? alpha + 360.0 : alpha, p->r[i],
                          p->r[i] - p->fitted[i]);
            ++written;
        }
        if (written == 0)
            (void)fputs("nan nan nan nan nan nan nan nan\n", figure->data);
    }
}

/* The scene's path in the laboratory for two turns of the bead, and once round in the magnet's frame. */
static void write_curve(fst_figure_file *figure, const fst_measurement *m, const fst_placed_track *p,
                        const closed_curve *curve)
{
    enum { STEPS = 1200 };
    fst_figure_block(figure, "model-lab", "x y");
    const double from = p->t[0], last = p->t[p->count - 1];
    const double to = fmin(last, from + 2.0 / fabs(m->bead_frequency_hz));
    for (int i = 0; i <= STEPS; ++i) {
        double place[2];
        const double t = from + (to - from) * i / STEPS;
        curve_at(curve, m->wave_hz * (t - m->wave_origin) + curve->phase, place);
        const double angle = magnet_angle(m, t) + curve->angle, c = cos(angle), s = sin(angle);
        (void)fprintf(figure->data, "%.9g %.9g\n", c * place[0] - s * place[1],
                      handedness(m) * (s * place[0] + c * place[1]));
    }
    fst_figure_block(figure, "model-magnet", "X Y");
    const double c = cos(curve->angle), s = sin(curve->angle);
    for (int i = 0; i <= CURVE; ++i) {
        const double x = curve->x[i % CURVE], y = curve->y[i % CURVE];
        (void)fprintf(figure->data, "%.9g %.9g\n", c * x - s * y, s * x + c * y);
    }
}

/* ---------------------------------------------------------------- script */

/* The frame of a panel of a figure that is `height` pixels high, with its labels. */
static void begin_panel(fst_figure_file *figure, int height, const double frame[4], const char *x_label,
                        const char *y_label)
{
    (void)fputs("unset label\n", figure->script); /* a label that is drawn again looks bold */
    fst_figure_place(figure, height, frame);
    fst_figure_axis_label(figure, height, FST_SIDE_BELOW, x_label, FST_COLOUR_BLACK, frame);
    if (y_label)
        fst_figure_axis_label(figure, height, FST_SIDE_LEFT, y_label, FST_COLOUR_BLACK, frame);
    (void)fputs("set autoscale\nset xtics auto\nset ytics auto\n", figure->script);
}

/* Draw columns of the track, rejected places as crosses. */
static void plot_places(FILE *script, const char *columns)
{
    (void)fprintf(script,
                  "plot data index 'seen' using %s with points pt 7 ps 0.28 lc rgb '%s', \\\n"
                  "     data index 'rejected' using %s with points pt 2 ps 0.8 lw 1.5 lc rgb '%s'",
                  columns, fst_colour_code(FST_COLOUR_BLUE), columns, fst_colour_code(FST_COLOUR_BLACK));
}

static void plot_curve(FILE *script, const char *name)
{
    (void)fprintf(script, ", \\\n     data index '%s' using 1:2 with lines lw 1.6 lc rgb '%s'", name,
                  fst_colour_code(FST_COLOUR_VERMILION));
}

/* The range of r, or of what the fit leaves of it, from the places that were not rejected. */
static void write_range_of_r(FILE *script, const fst_placed_track *p, const fst_track *track, int residual)
{
    double low = INFINITY, high = -INFINITY;
    for (size_t i = 0; i < p->count; ++i) {
        const double r = p->r[i] - (residual ? p->fitted[i] : 0.0);
        if (track->flag[p->row[i]] != FST_FRAME_SEEN)
            continue;
        low = fmin(low, r);
        high = fmax(high, r);
    }
    const double margin = 0.05 * (high - low);
    (void)fprintf(script, "set yrange [%.9g:%.9g]\n", low - margin, high + margin);
}

static void write_ranges(FILE *script, const fst_placed_track *p, const fst_track *track)
{
    double most = 0.0;
    for (size_t i = 0; i < p->count; ++i)
        if (track->flag[p->row[i]] == FST_FRAME_SEEN)
            most = fmax(most, p->r[i]);
    (void)fprintf(script, "set xrange [%.9g:%.9g]\nset yrange [%.9g:%.9g]\nset xtics %.9g\nset ytics %.9g\n",
                  -1.1 * most, 1.1 * most, -1.1 * most, 1.1 * most, fst_round_step(0.5 * most),
                  fst_round_step(0.5 * most));
}

static void write_script(fst_figure_file *figure, int height, int top, const fst_track *track,
                         const fst_measurement *m, const fst_placed_track *p, const closed_curve *curve)
{
    char x[64], y[48], t[48];
    FILE *script = figure->script;
    const double left = LEFT, right = FST_FIGURE_WIDTH - RIGHT, square = top + SQUARE;
    const double around = square + AXIS, after = around + TALL + AXIS;
    fst_figure_panels(figure);
    (void)fputs("set grid ls 101\nset tics font ',12'\nunset key\n", script);
    (void)snprintf(x, sizeof x, "x (%s)", m->length_unit);
    (void)snprintf(y, sizeof y, "y (%s)", m->length_unit);
    begin_panel(figure, height, (const double[4]){left, left + SQUARE, top, square}, x, y);
    write_ranges(script, p, track);
    plot_places(script, "2:3");
    if (curve)
        plot_curve(script, "model-lab");
    (void)fputc('\n', script);
    if (isfinite(m->drive_from_track_hz)) {
        (void)snprintf(x, sizeof x, "X (%s), magnet's frame", m->length_unit);
        begin_panel(figure, height, (const double[4]){right - SQUARE, right, top, square}, x, NULL);
        write_ranges(script, p, track);
        plot_places(script, "4:5");
        if (curve)
            plot_curve(script, "model-magnet");
        (void)fputc('\n', script);
    }
    (void)snprintf(y, sizeof y, "r (%s)", m->length_unit);
    begin_panel(figure, height, (const double[4]){left, right, around, around + TALL}, "α (degrees)", y);
    (void)fputs("set xrange [0:360]\nset xtics 45\n", script);
    write_range_of_r(script, p, track, 0);
    plot_places(script, "6:7");
    (void)fputs("\n", script);
    (void)snprintf(t, sizeof t, "time (%s)", p->clock);
    (void)snprintf(y, sizeof y, "r − fit (%s)", m->length_unit);
    begin_panel(figure, height, (const double[4]){left, right, after, after + TALL}, t, y);
    write_range_of_r(script, p, track, 1);
    plot_places(script, "1:8");
    (void)fputs("\n", script);
}

/* The words around the figure: what was measured, and what the scene has. */
static fst_legend make_legend(const fst_track *track, const fst_measurement *m, const closed_curve *curve,
                              int same_scale)
{
    char style[96], words[128];
    size_t rejected = 0;
    fst_legend legend = {.title = "The track of the bead", .count = 0};
    int length = snprintf(legend.about, sizeof legend.about, "⟨r⟩ = %.5g ± %.2g %s, δr = %.4g ± %.2g %s",
                          m->mean_r, m->mean_r_error, m->length_unit, m->std_r, m->std_r_error, m->length_unit);
    if (isfinite(m->bead_frequency_hz))
        length += snprintf(legend.about + length, sizeof legend.about - (size_t)length, ", bead %.5g Hz",
                           m->bead_frequency_hz);
    if (isfinite(m->festoons))
        (void)snprintf(legend.about + length, sizeof legend.about - (size_t)length, ", N = %.5g", m->festoons);
    (void)snprintf(style, sizeof style, "pt 7 ps 0.5 lc rgb '%s'", fst_colour_code(FST_COLOUR_BLUE));
    fst_legend_add(&legend, FST_SAMPLE_POINT, style, "track");
    for (size_t i = 0; i < track->rows; ++i)
        rejected += track->flag[i] == FST_FRAME_REJECTED;
    (void)snprintf(style, sizeof style, "pt 2 ps 0.8 lw 1.5 lc rgb '%s'", fst_colour_code(FST_COLOUR_BLACK));
    if (rejected)
        fst_legend_add(&legend, FST_SAMPLE_POINT, style, "rejected");
    if (!curve)
        return legend;
    (void)snprintf(style, sizeof style, "lw 1.6 lc rgb '%s'", fst_colour_code(FST_COLOUR_VERMILION));
    (void)snprintf(words, sizeof words, "scene%s: ⟨r⟩ = %.5g %s, δr = %.4g %s, N = %.5g",
                   same_scale ? ", to the same scale" : "", curve->mean_r, m->length_unit, curve->std_r,
                   m->length_unit, curve->festoons);
    fst_legend_add(&legend, FST_SAMPLE_LINE, style, words);
    return legend;
}

fst_status fst_figure_measurement(const fst_track *track, const fst_measurement *m, const fst_params *compare,
                                  const char *out, const fst_progress *progress, fst_error *error)
{
    fst_placed_track p = {.count = 0};
    fst_figure_file figure;
    closed_curve *curve = NULL;
    fst_legend legend = {.count = 0};
    if (compare && (m->motion != FST_MOTION_TURNING || !isfinite(m->drive_from_track_hz)))
        return fst_fail(
            error, FST_BAD_INPUT, "fst_figure_measurement.compare",
            "the track tells no festoons: a scene can only be laid over a bead that turns against the magnet");
    fst_status status = fst_place_track(track, m, &p, error);
    if (status != FST_OK)
        return status;
    if (compare) {
        curve = malloc(sizeof *curve);
        status = curve ? follow_scene(compare, m, progress, curve, error)
                       : fst_fail(error, FST_NO_MEMORY, "", "no memory for a figure");
        if (status == FST_OK)
            lay_over(curve, &p, m);
    }
    if (status == FST_OK)
        legend = make_legend(track, m, curve, strcmp(m->length_unit, "px") == 0);
    const int top = fst_legend_head(&legend) + 6,
              height = top + SQUARE + 2 * TALL + 3 * AXIS + fst_legend_foot(&legend);
    const fst_canvas canvas = fst_canvas_for(NULL, height, 0);
    if (status == FST_OK)
        status = fst_figure_begin(&figure, out, &canvas, error);
    if (status == FST_OK) {
        write_track(&figure, track, &p);
        if (curve)
            write_curve(&figure, m, &p, curve);
        write_script(&figure, height, top, track, m, &p, curve);
        fst_legend_write(&figure, &legend, height);
        status = fst_figure_finish(&figure, error);
    }
    free(curve);
    fst_placed_track_free(&p);
    return status;
}
