/* view.c - finding the part of a trajectory that a figure shows, and its columns. */
#include "draw/view.h"

#include "base/constants.h"
#include "base/error.h"
#include "draw/caption.h"

#include <stdarg.h>
#include <stdlib.h>
#include <string.h>

static fst_status no_such_column(const char *option, const char *name, fst_error *error)
{
    size_t room = 1;
    for (int i = 0; i < fst_column_count(); ++i)
        room += strlen(fst_column_at(i)->name) + 1;
    char *names = malloc(room);
    if (!names)
        return fst_fail(error, FST_NO_MEMORY, name, "no memory for a list of names");
    size_t used = 0;
    for (int i = 0; i < fst_column_count(); ++i)
        used += (size_t)snprintf(names + used, room - used, "%s%s", i ? "|" : "", fst_column_at(i)->name);
    char suggestion[FST_SUGGESTION_SIZE];
    (void)fst_suggest_name(name, names, suggestion);
    free(names);
    return fst_fail(error, FST_BAD_INPUT, option, "a trajectory has no column \"%.60s\"; %s", name, suggestion);
}

fst_status fst_view_column_for(const fst_view *view, const char *option, const char *name,
                               const double **column, const fst_column_info **info, fst_error *error)
{
    for (int i = 0; i < fst_column_count(); ++i) {
        if (strcmp(fst_column_at(i)->name, name) != 0)
            continue;
        *column = view->table->columns[i];
        if (info)
            *info = fst_column_at(i);
        return FST_OK;
    }
    return no_such_column(option, name, error);
}

fst_status fst_view_column(const fst_view *view, const char *name, const double **column,
                           const fst_column_info **info, fst_error *error)
{
    return fst_view_column_for(view, "fst_figure_options.colour", name, column, info, error);
}

fst_status fst_view_columns(const fst_view *view, fst_error *error, ...)
{
    va_list pairs;
    va_start(pairs, error);
    fst_status status = FST_OK;
    for (const char *name; status == FST_OK && (name = va_arg(pairs, const char *)) != NULL;)
        status = fst_view_column(view, name, va_arg(pairs, const double **), NULL, error);
    va_end(pairs);
    return status;
}

void fst_view_range(const fst_view *view, const double *column, double *least, double *greatest)
{
    *least = INFINITY;
    *greatest = -INFINITY;
    for (size_t row = view->first; row < view->last; ++row) {
        if (!isfinite(column[row]))
            continue;
        *least = fmin(*least, column[row]);
        *greatest = fmax(*greatest, column[row]);
    }
    if (*least > *greatest)
        *least = *greatest = 0.0;
}

double fst_view_between(double x0, double v0, double x1, double v1, double h, double part)
{
    double rest = 1.0 - part;
    return rest * rest * ((1.0 + 2.0 * part) * x0 + part * h * v0) +
           part * part * ((1.0 + 2.0 * rest) * x1 - rest * h * v1);
}

static int changes(double first, double last)
{
    return fabs(last - first) > 1e-9 * fabs(last);
}

/* Whether the drive is a ramp. */
static int is_ramp(const fst_table *table)
{
    const double *omega = fst_collected(table, "omega");
    return table->params.drive_waveform == FST_WAVEFORM_STEADY && omega && table->rows > 1 &&
           changes(omega[0], omega[table->rows - 1]);
}

fst_figure_kind fst_figure_kind_of(const fst_table *table)
{
    return is_ramp(table) ? FST_FIGURE_RAMP : FST_FIGURE_PATH;
}

/* The drive period from which on a trajectory is shown unless the options say: the end of the discard.  A run
 * that ended once it had settled is shown from a whole period on that lies at least 5.5 before its end, when
 * the motion was known; one that ended before its discard, from its beginning. */
static double usual_from(const fst_table *table, double end)
{
    const fst_params *p = &table->params;
    if (p->drive_waveform != FST_WAVEFORM_STEADY)
        return 0.0;
    if (p->run_until == FST_UNTIL_SETTLED && table->complete && end + 1.0 < p->run_periods)
        return fmax(floor(end - 5.5), 0.0);
    return end > p->run_discard ? p->run_discard : 0.0;
}

/* How much a figure shows where the options leave the end open: turns of the bead, or periods of the drive,
 * whichever ends first. */
static const struct {
    double turns, periods;
} lengths[FST_FIGURE_COUNT] = {[FST_FIGURE_PATH] = {2.0, 30.0},
                               [FST_FIGURE_LOCAL_N] = {2.0, 16.0},
                               [FST_FIGURE_RADIUS_FIELD] = {INFINITY, 6.0},
                               [FST_FIGURE_TIME] = {INFINITY, 8.0},
                               [FST_FIGURE_SECTION] = {INFINITY, INFINITY},
                               [FST_FIGURE_RAMP] = {INFINITY, INFINITY},
                               [FST_FIGURE_GROUPS] = {INFINITY, INFINITY},
                               [FST_FIGURE_LAG] = {INFINITY, INFINITY}};

/* Find the rows that are shown: all of a ramp, and of a drive that is not a steady turn, unless the options say. */
static fst_status choose_rows(fst_view *view, const fst_figure_options *options, fst_error *error)
{
    const fst_params *p = &view->table->params;
    const int whole = is_ramp(view->table) || p->drive_waveform != FST_WAVEFORM_STEADY;
    const double turns = whole ? INFINITY : lengths[options->kind].turns;
    const double periods = whole ? INFINITY : lengths[options->kind].periods;
    const double *t, *drive, *alpha;
    fst_status status = fst_view_columns(view, error, "t", &t, "drive_turns", &drive, "alpha", &alpha, NULL);
    if (status != FST_OK)
        return status;
    size_t rows = view->table->rows, first = 0;
    const double end = rows > 0 ? fst_drive_periods(p, t[rows - 1], drive[rows - 1]) : 0.0;
    const double from = isnan(options->from) ? usual_from(view->table, end) : options->from;
    while (first < rows && fst_drive_periods(p, t[first], drive[first]) < from - 1e-9)
        ++first;
    size_t last = first;
    for (double begin = NAN; last < rows; ++last) {
        const double period = fst_drive_periods(p, t[last], drive[last]);
        begin = last == first ? period : begin;
        if (!isnan(options->to)
                ? period > options->to + 1e-9
                : period - begin > periods || fabs(alpha[last] - alpha[first]) > 2.0 * FST_PI * turns)
            break;
    }
    if (last - first < 2)
        return fst_fail(
            error, FST_BAD_INPUT, "fst_figure_options.from",
            "fewer than two samples from drive period %g on: the trajectory has %zu samples and ends at "
            "period %g",
            from, rows, end);
    view->first = first;
    view->last = last;
    return FST_OK;
}

static void describe(fst_view *view)
{
    static const char *const shown[] = {"friction.law", "friction.mu", "model.dynamics", "drive.frequency",
                                        "drive.omega"};
    const int steady = view->table->params.drive_waveform == FST_WAVEFORM_STEADY;
    const int dry = view->table->params.friction_law == FST_FRICTION_COULOMB;
    const fst_params *p = &view->table->params;
    const double hertz = view->gamma / (2.0 * FST_PI);
    const char *dynamics = fst_dynamics_name((fst_dynamics)p->model_dynamics);
    int used;
    if (!steady)
        used = snprintf(view->about, sizeof view->about, "dynamics %s", dynamics);
    else if (changes(view->first_omega, view->omega))
        used =
            snprintf(view->about, sizeof view->about, "ω = %.4g to %.4g (%.4g to %.4g Hz), dynamics %s",
                     view->first_omega, view->omega, view->first_omega * hertz, view->omega * hertz, dynamics);
    else
        used = snprintf(view->about, sizeof view->about, "ω = %.4g (%.4g Hz), dynamics %s", view->omega,
                        view->omega * hertz, dynamics);
    if (dry && used > 0 && (size_t)used < sizeof view->about)
        (void)snprintf(view->about + used, sizeof view->about - (size_t)used, ", dry friction μ = %.3g",
                       p->friction_mu);
    fst_caption(p, dry ? shown : shown + 2, (steady ? 5 : 3) - (dry ? 0 : 2), view->about, sizeof view->about);
}

fst_legend fst_view_legend(const fst_view *view, const char *what)
{
    fst_legend legend = {.count = 0};
    (void)snprintf(legend.title, sizeof legend.title, "%s", view->title ? view->title : what);
    (void)snprintf(legend.about, sizeof legend.about, "%s", view->about);
    return legend;
}

fst_quantity fst_view_quantity(const fst_view *view, const fst_column_info *column)
{
    return fst_quantity_of_column(column, view->units, &view->table->params);
}

static void choose_units(fst_view *view, fst_shown_units units)
{
    fst_params settled = view->table->params;
    (void)fst_params_settle(&settled, NULL); /* the caller may have changed them */
    const fst_params *p = &settled;
    const fst_scales scales = {p->magnet_half_length, 1.0 / p->friction_gamma, fst_bead_mass(p), NAN};
    if (units == FST_SHOWN_AS_GIVEN)
        units = isfinite(p->drive_omega) ? FST_SHOWN_SCALED : FST_SHOWN_LAB;
    view->units = units;
    view->length = fst_unit_shown("l", units, &scales, &view->length_unit);
}

fst_status fst_view_of(fst_view *view, const fst_table *table, const fst_figure_options *options,
                       fst_error *error)
{
    *view = (fst_view){.table = table, .gamma = table->params.friction_gamma, .title = options->title};
    const int in_millimetres = options->kind == FST_FIGURE_PATH && options->units == FST_SHOWN_AS_GIVEN;
    choose_units(view, in_millimetres ? FST_SHOWN_LAB : options->units);
    fst_status status = choose_rows(view, options, error);
    const double *omega;
    if (status == FST_OK)
        status = fst_view_columns(view, error, "omega", &omega, NULL);
    if (status != FST_OK)
        return status;
    view->first_omega = omega[view->first];
    view->omega = omega[view->last - 1];
    describe(view);
    return FST_OK;
}

fst_status fst_figure_part_of(const fst_table *table, const fst_figure_options *options, fst_figure_part *part,
                              fst_error *error)
{
    fst_view view;
    const fst_status status = fst_view_of(&view, table, options, error);
    if (status == FST_OK) {
        *part = (fst_figure_part){.first = view.first, .last = view.last, .units = view.units};
        memcpy(part->about, view.about, sizeof part->about);
    }
    return status;
}
