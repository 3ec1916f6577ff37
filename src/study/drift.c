/* drift.c - is a motion settled?  A straight line is laid through the means of the window's blocks.
 *
 * The line's change over the window is a drift if it stands out of the scatter about the line, and is large
 * enough to matter.  A motion that goes back and forth scatters about a level line; one that relaxes, or creeps
 * away, does not:
 *
 *     <r> |                       x  x
 *         |              x  x  x
 *         |        x  x
 *         |  x  x
 *         +--------------------------- t
 *
 * Where the blocks follow a slow swing of few cycles, a drift can hide in it: a swing of k cycles tilts the
 * line by up to 6 sqrt(2)/(pi k) standard deviations.  The changes of sign of the
 * deviations from the line count the cycles.
 *
 * At most FST_MARKS blocks are kept of a run, however long it is: nothing has to be done for this while it
 * runs.
 */
#include "study/drift.h"

#include <math.h>
#include <stddef.h>

#include "base/constants.h"
#include "base/elementary.h"
#include "observe/means.h"

/* docs/regimes.md says why these, and how often they err. */
static const double STANDS_OUT = 5.0; /* change over its standard error: below, the scatter explains it */
/* Change over the scale of the quantity: below, the means hold to 4 digits. */
static const double MATTERS = 1e-4;
static const double ALIASED = 0.1;       /* part of the swing that a block shows when it ends within one */
static const double SWING_MATTERS = 0.1; /* relative change of the swing of a bead that librates */
static const double SWING_SEEN = 1e-7;   /* a swing below this part of <r> is rounding */
static const double HIDES = 0.02;        /* a drift of this part of a mean must be seen, where there is one */
static const double LEAVES = 0.3; /* growth of the logarithm of a bead's speed that leaves a state of rest */
enum { LEAST_BLOCKS = 4 };        /* for a line and its scatter */

/* Means between one kept mark and the next, and their straight line of least squares. */
typedef struct blocks {
    int count;
    double r[FST_MARKS], alpha_dot[FST_MARKS], nz[FST_MARKS],
        swing[FST_MARKS]; /* swing: delta r within a block */
} blocks;

typedef struct line {
    double mean, change, noise; /* over all blocks; the standard error of the change */
    double hidden;              /* change that a slow swing could hide */
} line;

static int takes_section(const fst_watched_run *run)
{
    return fst_window_series(&run->window, run->flow->t) == &run->window.returns.marks;
}

/* The blocks of a run, and the window's length; 0: they are too few for a line. */
static int fill_blocks(const fst_watched_run *run, blocks *b, double *turns)
{
    /* Librations are judged by whole drive periods: there are marks of them whatever the motion does. */
    const fst_mark_series *series = takes_section(run) ? &run->window.returns.marks : &run->window.periods;
    if (series->count - 1 < LEAST_BLOCKS)
        series = &run->window.periods;
    b->count = series->count - 1;
    for (int i = 0; i < b->count; ++i) {
        fst_ramp_point means;
        fst_means_between(&run->window, &series->kept[i], &series->kept[i + 1], &means);
        b->r[i] = means.mean_r;
        b->alpha_dot[i] = means.mean_alpha_dot;
        b->nz[i] = means.mean_nz;
        b->swing[i] = means.std_r;
    }
    *turns =
        b->count > 0 ? fst_time_between(&series->kept[0], &series->kept[b->count]) / run->window.period : 0;
    return b->count >= LEAST_BLOCKS;
}

static line line_through(const double *values, int count)
{
    line found = {.mean = 0.0};
    const double middle = 0.5 * (count - 1);
    double moment = 0.0, spread = 0.0, scatter = 0.0, before = 0.0;
    int turns = 0;
    for (int i = 0; i < count; ++i)
        found.mean += values[i] / count;
    for (int i = 0; i < count; ++i) {
        moment += (i - middle) * (values[i] - found.mean);
        spread += (i - middle) * (i - middle);
    }
    const double slope = moment / spread;
    for (int i = 0; i < count; ++i) {
        const double rest = values[i] - found.mean - slope * (i - middle);
        scatter += rest * rest;
        turns += i > 0 && (rest > 0) != (before > 0);
        before = rest;
    }
    found.change = slope * count;
    found.noise = count * sqrt(scatter / (count - 2) / spread);
    found.hidden = 12.0 * sqrt(2.0) / FST_PI * sqrt(scatter / count) / (turns + 1);
    return found;
}

static line line_through_logarithms(const double *values, int count)
{
    double logarithms[FST_MARKS];
    for (int i = 0; i < count; ++i)
        logarithms[i] = fst_log(fmax(values[i], 1e-300));
    return line_through(logarithms, count);
}

/* Keep the worst: `least` is the least change that matters. */
static void compare(fst_drift *worst, double *greatest, const char *what, const line *l, double least)
{
    const double size = fabs(l->change);
    if (!(size > STANDS_OUT * l->noise) || !(size > *greatest * least))
        return;
    *greatest = size / least;
    *worst = (fst_drift){what, l->change, l->noise, l->mean, worst->turns};
}

fst_drift fst_drift_of(const fst_watched_run *run)
{
    fst_drift worst = {.what = NULL};
    blocks b;
    if (!fill_blocks(run, &b, &worst.turns))
        return worst;
    double greatest = 1.0;
    const line r = line_through(b.r, b.count), swing = line_through(b.swing, b.count);
    const double least = MATTERS * r.mean;
    if (takes_section(run)) {
        const line alpha_dot = line_through(b.alpha_dot, b.count), nz = line_through(b.nz, b.count);
        const double omega = fst_drive_rate_double(&run->flow->drive, run->flow->t);
        compare(&worst, &greatest, "<r>", &r, least);
        compare(&worst, &greatest, "<alpha'>", &alpha_dot, MATTERS * omega);
        compare(&worst, &greatest, "<n_z>", &nz, MATTERS);
        compare(&worst, &greatest, "delta r", &swing, least);
        return worst;
    }
    /* Whole drive periods are not whole swings: what a block cuts off goes round slowly, and looks like a drift.
     */
    const double cut_off = ALIASED * swing.mean / (worst.turns / b.count);
    compare(&worst, &greatest, "<r>", &r, fmax(least, cut_off));
    compare(&worst, &greatest, "delta r", &swing, fmax(least, cut_off));
    /* What dies out or grows does so exponentially: its logarithm follows the line. */
    const line growth = line_through_logarithms(b.swing, b.count);
    if (swing.mean > SWING_SEEN * r.mean)
        compare(&worst, &greatest, "the logarithm of delta r", &growth, SWING_MATTERS);
    return worst;
}

fst_drift fst_hidden_drift_of(const fst_watched_run *run)
{
    fst_drift found = {.what = NULL};
    blocks b;
    if (!fill_blocks(run, &b, &found.turns))
        return found;
    /* What the line shows may be the swing's or a drift's, and a drift as large again may hide under the swing.
     */
    const line r = line_through(b.r, b.count), alpha_dot = line_through(b.alpha_dot, b.count);
    const double of_r = fabs(r.change) + r.hidden, of_alpha_dot = fabs(alpha_dot.change) + alpha_dot.hidden;
    const int in_alpha_dot = of_alpha_dot * r.mean > of_r * fabs(alpha_dot.mean);
    const line *worst = in_alpha_dot ? &alpha_dot : &r;
    const double possible = in_alpha_dot ? of_alpha_dot : of_r;
    if (!(possible > HIDES * fabs(worst->mean)))
        return found;
    return (fst_drift){in_alpha_dot ? "<alpha'>" : "<r>", worst->change, possible, worst->mean, found.turns};
}

/* The second half alone: where a bead comes to rest the steps lengthen first, and what their errors leave of
 * motion grows with them. */
int fst_speed_grows(const fst_watched_run *run)
{
    const fst_mark_series *marks = &run->window.periods;
    const int from = 1 + (marks->count - 1) / 2, count = marks->count - from;
    if (count < 2 * LEAST_BLOCKS)
        return 0;
    double activity[FST_MARKS];
    for (int i = 0; i < count; ++i)
        activity[i] = marks->kept[from + i].activity;
    const line growth = line_through_logarithms(activity, count);
    return growth.change > LEAVES && growth.change > STANDS_OUT * growth.noise;
}
