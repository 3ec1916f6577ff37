/* critical.c - the critical speed: from which drive on does the bead circle against the magnet?
 *
 * Runs over the range, each from the scene's start, say where the outcome changes.  The critical speed is the lowest
 * from which on all runs that are decided circle against the magnet for at least another LASTING of the speed: what
 * windows there are below it do not last.  An undecided run says nothing for it or against it: `until` ends below the
 * first.  The border is enclosed by more runs, at each level between the highest speed that fails and the lowest that
 * does not, because outcomes may alternate there.  Where the friction is smooth, a special point of the
 * counter-rotating branch within the border is the border, to many more digits. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include <festoon/festoon_tools.h>

#include "base/error.h"
#include "base/grow.h"
#include "base/watch.h"

enum { PIECES = 16, LEVELS = 8, GROUP = 8, LONGER = 4 /* times run.periods, where a run is undecided */ };
static const double LASTING = 0.1, BRANCH_BELOW = 0.02, BRANCH_ABOVE = 0.1;
static const double BRANCH_ERROR = 1e-9; /* relative; docs/inside/orbits.md, special points */

typedef struct speed {
    double value;
    fst_regime regime;
    int done;
} speed;

/* All runs, sorted by speed, because borders lie between neighbours; and the runs that the threads fill in now. */
typedef struct search {
    const fst_params *params;
    const char *key;
    fst_part part; /* of the whole that is being done */
    fst_progress told, within;
    speed *all, *asked;
    size_t count;
    int wanted; /* of `asked` */
} search;

static int follows(fst_regime regime)
{
    return regime == FST_REGIME_LOCKED || regime == FST_REGIME_LIBRATING || regime == FST_REGIME_COROTATING;
}

static int counter_rotates(fst_regime regime)
{
    return regime == FST_REGIME_COUNTER_ROTATING;
}

/* ------------------------------------------------------------------ runs */

/* The runs that one thread does side by side. */
typedef struct group {
    search *s;
    int next, end;
    fst_status status;
    fst_error *error;
} group;

static int next_job(void *user, fst_row_job *job)
{
    group *g = user;
    char text[32];
    if (g->status != FST_OK || g->next == g->end)
        return 0;
    job->point = g->next++;
    job->params = *g->s->params;
    job->has_start = 0;
    (void)snprintf(text, sizeof text, "%.17g", g->s->asked[job->point].value);
    g->status = fst_params_set(&job->params, g->s->key, text, g->error);
    return g->status == FST_OK;
}

/* A run that is undecided is done once more for longer. */
static int take_result(void *user, fst_row_job *job, fst_status status, const fst_run_result *result,
                       const fst_error *error)
{
    group *g = user;
    if (status != FST_OK) {
        g->status = status;
        *g->error = *error;
        return 0;
    }
    g->s->asked[job->point].regime = result->regime;
    g->s->asked[job->point].done = 1;
    if (result->regime != FST_REGIME_UNDECIDED || !isnan(job->params.run_duration) ||
        job->params.run_periods > g->s->params->run_periods)
        return 0;
    job->params.run_periods *= LONGER;
    return 1;
}

static fst_status run_group(void *user, int index, fst_error *error)
{
    search *s = user;
    const int begin = index * GROUP, end = begin + GROUP;
    group g = {s, begin, end < s->wanted ? end : s->wanted, FST_OK, error};
    const fst_row_work work = {.user = &g,
                               .arithmetic = fst_best_arithmetic(),
                               .next = next_job,
                               .done = take_result,
                               .progress = &s->within};
    const fst_status status = fst_rows(&work, error);
    return status == FST_OK ? g.status : status;
}

static int by_value(const void *a, const void *b)
{
    const double x = ((const speed *)a)->value, y = ((const speed *)b)->value;
    return (x > y) - (x < y);
}

/* What is done next goes on to this fraction of the whole. */
static void begin_part(search *s, double to, const char *what)
{
    s->part = (fst_part){s->part.whole, s->part.to, to, what};
    s->told = (fst_progress){&s->part, fst_part_tell};
}

/* Do the first `count` of the runs that are asked for, and put them among the others, also where some are missing
 * because it was interrupted. */
static fst_status run_asked(search *s, int count, fst_error *error)
{
    const fst_work work = {s, (count + GROUP - 1) / GROUP, run_group, &s->told, &s->within};
    s->wanted = count;
    for (int i = 0; i < count; ++i)
        s->asked[i].done = 0;
    const fst_status status = fst_parallel(&work, error);
    for (int i = 0; i < count; ++i) {
        if (!s->asked[i].done)
            continue;
        if (!fst_grow(&s->all, s->count, sizeof *s->all))
            return fst_fail(error, FST_NO_MEMORY, "critical", "out of memory");
        s->all[s->count++] = s->asked[i];
    }
    if (s->count)
        qsort(s->all, s->count, sizeof *s->all, by_value);
    return status;
}

/* ------------------------------------------------------------------ borders among the runs */

/* A border between two neighbouring outcomes: the places of the runs on either side; undecided ones may lie between. */
typedef struct border {
    size_t low, high;
    int found;
} border;

/* From the run `at` on: does no run do anything else than circle against the magnet for long enough? */
static int lasts(const search *s, size_t at)
{
    const double enough = (1 + LASTING) * s->all[at].value;
    for (size_t i = at; i < s->count && s->all[i].value <= enough; ++i)
        if (!counter_rotates(s->all[i].regime) && s->all[i].regime != FST_REGIME_UNDECIDED)
            return 0;
    return s->all[s->count - 1].value >= enough;
}

/* The lowest run from which on the bead circles against the magnet, and the one that fails below it. */
static border find_critical(const search *s)
{
    border b = {0, 0, 0};
    while (b.high < s->count && !(counter_rotates(s->all[b.high].regime) && lasts(s, b.high)))
        ++b.high;
    b.found = b.high < s->count;
    b.low = b.high;
    while (b.found && b.low > 0 && (b.low == b.high || s->all[b.low].regime == FST_REGIME_UNDECIDED))
        --b.low;
    return b; /* low = high: it is the lowest run; an undecided one at `low`: all below are */
}

/* The first run in which the bead does not go with the magnet, and the last below in which it does. */
static border find_parting(const search *s)
{
    border b = {0, 0, 0};
    while (b.high < s->count &&
           (follows(s->all[b.high].regime) || s->all[b.high].regime == FST_REGIME_UNDECIDED))
        ++b.high;
    for (b.low = b.high; b.low > 0 && !b.found; --b.low)
        b.found = b.high < s->count && follows(s->all[b.low - 1].regime);
    return b;
}

/* Enclose a border by more runs until it is as narrow as asked, or undecided runs let it be no narrower. */
static fst_status enclose(search *s, border (*find)(const search *), double tolerance, fst_error *error)
{
    double width = INFINITY;
    border found = find(s), *b = &found;
    for (int level = 0; level < LEVELS && b->found && b->low < b->high; ++level) {
        const double low = s->all[b->low].value, high = s->all[b->high].value;
        if (high - low <= tolerance * high || high - low > 0.9 * width)
            break;
        width = high - low;
        for (int i = 1; i < PIECES; ++i)
            s->asked[i - 1].value = low + width * i / PIECES;
        begin_part(s, s->part.to + (1 - s->part.to) / 4, "border");
        const fst_status status = run_asked(s, PIECES - 1, error);
        if (status != FST_OK)
            return status;
        *b = find(s);
    }
    return FST_OK;
}

/* The last run that circles against the magnet before one that does otherwise or is undecided. */
static double find_end(const search *s, size_t from)
{
    while (from + 1 < s->count && counter_rotates(s->all[from + 1].regime))
        ++from;
    return s->all[from].value;
}

/* Where outcomes alternate one by one in the first runs, from the run `at` on: the last that differs from its neighbour. */
static double find_far(const search *s, size_t at, int upwards, int (*alike)(fst_regime))
{
    const size_t step = upwards ? 1 : (size_t)-1; /* below the lowest run it is beyond all of them */
    while (at + step < s->count && s->all[at + step].regime != FST_REGIME_UNDECIDED &&
           alike(s->all[at].regime) != alike(s->all[at + step].regime))
        at += step;
    return s->all[at].value;
}

/* The middle of a border and half its width.  Where outcomes alternate, runs of the one side that were met between this border
 * and `far`, where the other side began in the first runs, belong to the error. */
static void put_border(const search *s, const border *b, int (*alike)(fst_regime), double far, double *value,
                       double *error)
{
    const double low = s->all[b->low].value, high = s->all[b->high].value;
    *value = 0.5 * (low + high);
    *error = 0.5 * (high - low);
    for (size_t i = 0; i < s->count; ++i) {
        const double at = s->all[i].value;
        if (alike(s->all[i].regime) && (at - *value) * (at - far) < 0)
            *error = fmax(*error, fabs(at - *value));
    }
}

/* The special point of the counter-rotating branch within the border, where there is one. */
static fst_status sharpen(search *s, fst_critical *c, fst_error *error)
{
    fst_branch branch;
    fst_branch_options options = fst_default_branch_options();
    fst_error unheard;
    options.key = s->key;
    options.from = (1 - BRANCH_BELOW) * c->value;
    options.to = fmin((1 + BRANCH_ABOVE) * c->value, fst_param_at(fst_param_find(s->key))->greatest);
    begin_part(s, 1.0, "branch");
    options.progress = &s->told;
    const fst_status status = fst_branch_follow(s->params, &options, &branch, &unheard);
    double nearest = 2 * c->error, sharp = c->value;
    for (size_t i = 0; status == FST_OK && i < branch.special_count; ++i) {
        const double distance = fabs(branch.specials[i].value - c->value);
        if (distance > nearest)
            continue;
        nearest = distance;
        c->special = (int)branch.specials[i].type;
        sharp = branch.specials[i].value;
    }
    fst_branch_free(&branch);
    if (c->special >= 0) {
        c->value = sharp;
        c->error = BRANCH_ERROR * c->value;
    }
    /* Where no orbit was found, or the law has none of its own, the border stays as the runs enclose it. */
    return status == FST_OK || status == FST_NO_CONVERGENCE || status == FST_BAD_INPUT
               ? FST_OK
               : fst_fail(error, status, unheard.where, "%s", unheard.sentence);
}

/* ------------------------------------------------------------------ the whole */

/* Neighbouring runs with one outcome make a stretch. */
static fst_status put_stretches(const search *s, fst_critical *c, fst_error *error)
{
    for (size_t i = 0; i < s->count; ++i) {
        if (i > 0 && s->all[i].regime == s->all[i - 1].regime) {
            c->stretches[c->stretch_count - 1].to = s->all[i].value;
            c->stretches[c->stretch_count - 1].runs += 1;
            continue;
        }
        if (!fst_grow(&c->stretches, c->stretch_count, sizeof *c->stretches))
            return fst_fail(error, FST_NO_MEMORY, "critical", "out of memory");
        c->stretches[c->stretch_count++] =
            (fst_critical_stretch){s->all[i].value, s->all[i].value, s->all[i].regime, 1};
    }
    c->runs = (int)s->count;
    return FST_OK;
}

/* Why there is no critical speed. */
static void tell_why(const search *s, const border *critical, fst_critical *c)
{
    int any = 0;
    for (size_t i = 0; i < s->count; ++i)
        any |= counter_rotates(s->all[i].regime);
    (void)snprintf(c->reason, sizeof c->reason, "%s",
                   !any               ? "no bead circles against the magnet"
                   : !critical->found ? "the bead circles against the magnet, but not for another tenth of the "
                                        "speed: look at the runs, or go on to higher speeds"
                   : critical->low == critical->high
                       ? "the bead circles against the magnet at the lowest speed already: begin "
                         "lower"
                       : "all runs below those that circle against the magnet are undecided: give "
                         "a longer run.periods");
}

static fst_status find_borders(search *s, double tolerance, fst_critical *c, fst_error *error)
{
    border parting = find_parting(s), critical = find_critical(s);
    const double fails = critical.found ? s->all[critical.low].value : NAN;
    const double parts = parting.found ? s->all[parting.high].value : NAN;
    const double low_end = critical.found ? find_far(s, critical.low, 0, counter_rotates) : NAN;
    const double high_end = parting.found ? find_far(s, parting.high, 1, follows) : NAN;
    fst_status status = enclose(s, find_critical, tolerance, error);
    if (status == FST_OK)
        status = enclose(s, find_parting, tolerance, error);
    if (status != FST_OK)
        return status;
    parting = find_parting(s);
    critical = find_critical(s);
    c->found =
        critical.found && critical.low < critical.high && s->all[critical.low].regime != FST_REGIME_UNDECIDED;
    if (!c->found)
        tell_why(s, &critical, c);
    if (parting.found)
        put_border(s, &parting, follows, parts, &c->parting, &c->parting_error);
    if (c->found) {
        c->above = s->all[critical.high].regime;
        c->below = s->all[critical.low].regime;
        c->until = find_end(s, critical.high);
        put_border(s, &critical, counter_rotates, fails, &c->value, &c->error);
    }
    if (c->found && s->params->friction_law != FST_FRICTION_COULOMB)
        status = sharpen(s, c, error);
    if (c->found && c->special < 0 && low_end != fails)
        c->error = fmax(c->error, c->value - low_end);
    if (parting.found && high_end != parts)
        c->parting_error = fmax(c->parting_error, high_end - c->parting);
    if (c->found && parting.found && parting.high == critical.high) { /* one border */
        c->parting = c->value;
        c->parting_error = c->error;
    }
    return status;
}

static fst_status check_axis(const fst_grid *grid, fst_error *error)
{
    const char *key = fst_grid_key(grid, 0);
    const fst_spacing spacing = fst_grid_axis_spacing(grid, 0);
    if (strcmp(key, "drive.frequency") != 0 && strcmp(key, "drive.omega") != 0)
        return fst_fail(error, FST_BAD_INPUT, "fst_critical_options.over",
                        "%s: a critical speed is one of drive.frequency or drive.omega", key);
    if (spacing != FST_SPACING_LINEAR && spacing != FST_SPACING_LOG)
        return fst_fail(error, FST_BAD_INPUT, "fst_critical_options.over",
                        "%s: give a range LO:HI:COUNT, as in drive.frequency=2Hz:30Hz:113",
                        fst_grid_axis_text(grid, 0));
    if (fst_grid_row_kind(grid) != FST_ROWS_OF_RUNS)
        return fst_fail(
            error, FST_BAD_INPUT, "fst_critical_find",
            "a critical speed is that of one bead on a flat plate over a magnet that turns steadily");
    return FST_OK;
}

fst_critical_options fst_default_critical_options(void)
{
    return (fst_critical_options){"drive.frequency=2Hz:30Hz:113", 1e-4, NULL};
}

fst_status fst_critical_find(const fst_params *params, const fst_critical_options *options,
                             fst_critical *critical, fst_error *error)
{
    fst_grid *grid = NULL;
    search s = {.params = params, .part = {options->progress, 0, 0, NULL}};
    *critical = (fst_critical){
        .special = -1, .value = NAN, .error = NAN, .until = NAN, .parting = NAN, .parting_error = NAN};
    if (!(options->tolerance >= 1e-9 && options->tolerance <= 0.1))
        return fst_fail(error, FST_BAD_INPUT, "fst_critical_options.tolerance",
                        "tolerance = %g is out of range: it must be 1e-9 to 0.1", options->tolerance);
    fst_status status = fst_grid_new(params, &options->over, 1, 0, &grid, error);
    if (status == FST_OK)
        status = check_axis(grid, error);
    const int count = status == FST_OK ? (int)fst_grid_points(grid) : 0;
    s.asked = malloc(((size_t)count + PIECES) * sizeof *s.asked);
    if (status == FST_OK && !s.asked)
        status = fst_fail(error, FST_NO_MEMORY, "critical", "out of memory");
    if (status == FST_OK) {
        s.key = fst_grid_key(grid, 0);
        (void)snprintf(critical->key, sizeof critical->key, "%s", s.key);
        for (int i = 0; i < count; ++i)
            s.asked[i].value = fst_grid_value(grid, 0, i);
        begin_part(&s, 0.6, "scan");
        status = run_asked(&s, count, error);
    }
    if (status == FST_OK)
        status = find_borders(&s, options->tolerance, critical, error);
    if (status == FST_INTERRUPTED) {
        critical->found = 0;
        critical->value = critical->error = NAN;
        (void)snprintf(critical->reason, sizeof critical->reason,
                       "the search was interrupted, and these are all runs that were done");
        (void)put_stretches(&s, critical, NULL);
    } else if (status == FST_OK) {
        status = put_stretches(&s, critical, error);
    }
    free(s.asked);
    free(s.all);
    fst_grid_free(grid);
    return status;
}

void fst_critical_free(fst_critical *critical)
{
    free(critical->stretches);
    *critical = (fst_critical){.stretches = NULL};
}
