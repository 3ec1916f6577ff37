/* runs.c - the runs on which the comparison with the paper rests, and the thresholds between kinds
 * of motion. */
#include "paper/runs.h"
#include "paper/statements.h"
#include "paper/work.h"

#include "base/error.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

const fst_dynamics fst_paper_order[FST_PAPER_DYNAMICS] = {FST_DYNAMICS_FARAGO2020, FST_DYNAMICS_RIGID};

/* The scans.  `low` and `high` are drives omega, `count` is the number of points with both ends
 * (`reduced_count` in a reduced paper, `dry_count` of a bead that rubs dry).  Without a range the drives are
 * those of Table 1. */
static const struct {
    double low, high;
    int count, reduced_count, dry_count;
    const char *settings; /* what differs from the usual bead, for fst_paper_set() and for commands */
    int samples;          /* run.samples, for a scan that keeps its trajectories; else 0 */
} scans[FST_SCAN_COUNT] = {
    [FST_SCAN_COMPARISON] = {0.15, 0.50, 71, 8, 29, "", 0},
    [FST_SCAN_FAST] = {0.5, 2.0, 31, 4, 6, "", 0},
    [FST_SCAN_SLOW] = {0.02, 0.24, 12, 5, 12, "start.spin=rest", 0},
    [FST_SCAN_TABLE] = {0.0, 0.0, FST_TABLE1_ROWS, FST_TABLE1_ROWS, FST_TABLE1_ROWS, "", 0},
    [FST_SCAN_FOLD4] = {0.215, 0.215, 1, 1, 1, "", 128},
    [FST_SCAN_FOLD15] = {0.4, 0.4, 1, 1, 1, "", 128},
    [FST_SCAN_CONJUGATE] = {0.215, 0.215, 1, 1, 1, "start.phi=183",
                            0}, /* the image of the usual start, 3 deg, under S2 */
    [FST_SCAN_ASYMPTOTIC] = {2.2, 3.0, 3, 3, 3, "", 0},
    /* Equally magnetisable along its axis and across, without remanence. */
    [FST_SCAN_ANISOTROPIC] = {0.3, 0.4, 2, 2, 0, "bead.material=mixed model.kappa=0 bead.a=0.001 bead.b=0.001",
                              0},
};

/* Where a change of the motion is looked for: in which scan, and how many halvings refine it. */
static const struct {
    fst_scan scan;
    int halvings, reduced_halvings;
    const char *length; /* of the runs; "": the usual one */
} changes[FST_CHANGE_COUNT] = {
    /* Close to the threshold the motion settles ever more slowly, so these runs are long. */
    [FST_CHANGE_HALVING] = {FST_SCAN_COMPARISON, 7, 6, "run.periods=1200 run.discard=1100"},
    [FST_CHANGE_LOCKED] = {FST_SCAN_SLOW, 6, 5, ""},
    [FST_CHANGE_COROTATION] = {FST_SCAN_SLOW, 5, 5, ""},
};

/* A motion with a |<n_z>| above this lacks the symmetry S2; the rest of a transient is far smaller. */
#define ASYMMETRIC 1e-3

/* A reduced paper's runs are shorter; the motions have the same character. */
#define REDUCED "run.discard=100 run.periods=160"

static double scan_omega(const fst_paper_state *paper, fst_scan scan, int index)
{
    if (scan == FST_SCAN_TABLE)
        return fst_table1[index].omega;
    int count = paper->counts[scan];
    return count < 2 ? scans[scan].low
                     : scans[scan].low + (scans[scan].high - scans[scan].low) * index / (count - 1);
}

/* ------------------------------------------------------------------ one run */

/* The drive is passed on as short text, so that the command in the report repeats exactly this run.  Of dry
 * friction the tolerance is one at which the means are known to 1e-6 and a run takes a tenth of a second. */
static fst_status scan_params(const fst_paper_state *paper, fst_scan scan, fst_dynamics dynamics, double omega,
                              fst_params *params, fst_error *error)
{
    *params = fst_default_params();
    params->model_dynamics = (int)dynamics;
    fst_status status = fst_paper_set(params, error, "drive.omega=%.10g %s", omega, scans[scan].settings);
    if (status == FST_OK && scans[scan].samples)
        status = fst_paper_set(params, error, "run.samples=%d", scans[scan].samples);
    if (status == FST_OK && paper->mu > 0.0)
        status = fst_paper_set(
            params, error,
            "friction.law=coulomb friction.mu=%.10g run.rtol=1e-8 run.discard=140 run.periods=240", paper->mu);
    return status == FST_OK && paper->options->reduced ? fst_paper_set(params, error, REDUCED) : status;
}

static fst_status make_run(fst_paper_state *paper, fst_scan scan, fst_paper_run *run, fst_error *error)
{
    fst_table *trajectory = scans[scan].samples ? &run->trajectory : NULL;
    if (paper->mu > 0.0)
        return fst_paper_run_dry(run, paper->counts[scan] == 1 ? 2 : 1, &paper->until_refused, trajectory,
                                 error);
    const fst_status status =
        fst_paper_run_settled(&run->params, &paper->until_refused, &run->result, trajectory, error);
    run->done = status == FST_OK;
    return status;
}

/* Write the command for one run of a scan, with its drive given as text and its length from `params`. */
static void write_command(const fst_params *params, fst_scan scan, fst_dynamics dynamics, const char *omega,
                          char *text, size_t size)
{
    const fst_params usual = fst_default_params();
    size_t used = (size_t)snprintf(text, size, "festoon run --set drive.omega=%s --set model.dynamics=%s",
                                   omega, fst_dynamics_name(dynamics));
    for (const char *word = scans[scan].settings; *word && used < size; word += strspn(word, " ")) {
        const int length = (int)strcspn(word, " ");
        used += (size_t)snprintf(text + used, size - used, " --set %.*s", length, word);
        word += length;
    }
    if (params->friction_law != usual.friction_law && used < size)
        used += (size_t)snprintf(text + used, size - used,
                                 " --set friction.law=coulomb --set friction.mu=%g --set run.rtol=%g",
                                 params->friction_mu, params->run_rtol);
    if (params->run_periods != usual.run_periods && used < size)
        (void)snprintf(text + used, size - used, " --set run.discard=%g --set run.periods=%g",
                       params->run_discard, params->run_periods);
}

void fst_paper_scan_command(const fst_paper_state *paper, fst_scan scan, fst_dynamics dynamics, char *text,
                            size_t size)
{
    char omega[32] = "OMEGA";
    if (paper->counts[scan] == 1)
        (void)snprintf(omega, sizeof omega, "%g", scans[scan].low);
    /* Where a scan has many runs, some may have been longer, until they settled; the command has the length of
     * the first. */
    write_command(&paper->scans[scan][dynamics][0].params, scan, dynamics, omega, text, size);
    size_t used = strlen(text);
    if (paper->counts[scan] > 1 && scan != FST_SCAN_TABLE)
        (void)snprintf(text + used, size - used, "   # OMEGA: %d values from %g to %g", paper->counts[scan],
                       scans[scan].low, scans[scan].high);
}

void fst_paper_table1_command(const fst_paper_state *paper, int row, fst_dynamics dynamics, char *text,
                              size_t size)
{
    char omega[32];
    (void)snprintf(omega, sizeof omega, "%g", fst_table1[row].omega);
    write_command(&paper->scans[FST_SCAN_TABLE][dynamics][row].params, FST_SCAN_TABLE, dynamics, omega, text,
                  size);
    size_t used = strlen(text);
    (void)snprintf(text + used, size - used, " --json");
}

/* ------------------------------------------------------------------ all scans */

/* With how many dynamics the scans are made: a bead that rubs dry moves by the exact equations alone. */
static int dynamics_of(const fst_paper_state *paper)
{
    return paper->mu > 0.0 ? 1 : FST_PAPER_DYNAMICS;
}

int fst_paper_run_count(const fst_paper_state *paper)
{
    int count = 0;
    for (int scan = paper->first_scan; scan < FST_SCAN_COUNT; ++scan)
        count += dynamics_of(paper) * paper->counts[scan];
    return count;
}

fst_status fst_paper_scan_run(fst_paper_state *paper, int index, fst_error *error)
{
    /* The scans from rest take longest, because a libration near its threshold dies out slowly: begin with
     * them. */
    for (int scan = FST_SCAN_COUNT - 1; scan >= 0; --scan) {
        int both = dynamics_of(paper), here = both * paper->counts[scan];
        if (index < here) {
            int point = index / both;
            fst_dynamics dynamics = index % both ? FST_DYNAMICS_FARAGO2020 : FST_DYNAMICS_RIGID;
            return make_run(paper, (fst_scan)scan, &paper->scans[scan][dynamics][point], error);
        }
        index -= here;
    }
    return FST_OK;
}

/* ------------------------------------------------------------------ changes */

/* Whether the motion is still the one below the change. */
static int is_below(fst_change change, const fst_run_result *result)
{
    if (change == FST_CHANGE_HALVING)
        return fabs(result->mean_nz) > ASYMMETRIC;
    return result->regime == FST_REGIME_LOCKED ||
           (change == FST_CHANGE_COROTATION && result->regime == FST_REGIME_LIBRATING);
}

/* Whether a run at `omega` is below the change; -1: it has not settled, so it does not tell. */
static fst_status probe(const fst_paper_state *paper, fst_change change, fst_dynamics dynamics, double omega,
                        int *below, fst_error *error)
{
    fst_params params;
    fst_run_result result;
    fst_status status = scan_params(paper, changes[change].scan, dynamics, omega, &params, error);
    if (status == FST_OK && !paper->options->reduced)
        status = fst_paper_set(&params, error, "%s", changes[change].length);
    if (status == FST_OK)
        status = fst_paper_run_settled(&params, &paper->until_refused, &result, NULL, error);
    if (status == FST_OK)
        *below = isnan(result.mean_r) && fst_paper_may_settle(&result) ? -1 : is_below(change, &result);
    return status;
}

/* What the branches tell of a change; NAN: nothing. */
static double exact_change(const fst_paper_exact *exact, fst_change change)
{
    return change == FST_CHANGE_HALVING  ? exact->halving
           : change == FST_CHANGE_LOCKED ? exact->locked_end
                                         : exact->origin;
}

/* Find the last change of a scan and refine it by bisection; NAN where the scan has none.  It must be the last
 * one: a bead at rest under the magnet begins to swing near 4.9 Hz and is at rest again, beside it, from 6.4 to
 * 7.6 Hz. */
static fst_status find_change(fst_paper_state *paper, int index, fst_error *error)
{
    fst_change change = (fst_change)(index / FST_PAPER_DYNAMICS);
    fst_dynamics dynamics = index % FST_PAPER_DYNAMICS ? FST_DYNAMICS_FARAGO2020 : FST_DYNAMICS_RIGID;
    fst_scan scan = changes[change].scan;
    const fst_paper_run *runs = paper->scans[scan][dynamics];
    fst_paper_bracket *bracket = &paper->changes[change][dynamics];
    *bracket = (fst_paper_bracket){NAN, NAN};
    const double exact = exact_change(&paper->exact[dynamics], change);
    if (isfinite(exact)) {
        bracket->low = bracket->high = exact;
        return FST_OK;
    }
    int last = paper->counts[scan] - 2;
    while (last > 0 && !is_below(change, &runs[last].result))
        --last;
    if (last < 1 || is_below(change, &runs[last + 1].result))
        return FST_OK;
    /* The scan's runs are shorter than these, and next to the change one may not have settled: begin one point
     * further out. */
    bracket->low = scan_omega(paper, scan, last - 1);
    bracket->high = scan_omega(paper, scan, last + 1);
    int halvings = paper->options->reduced ? changes[change].reduced_halvings : changes[change].halvings;
    fst_status status = FST_OK;
    for (int i = 0, below = 0; i < halvings && status == FST_OK && below >= 0; ++i) {
        double middle = 0.5 * (bracket->low + bracket->high);
        status = probe(paper, change, dynamics, middle, &below, error);
        if (below >= 0) /* otherwise the bracket stays as wide as it is */
            *(below ? &bracket->low : &bracket->high) = middle;
    }
    return status;
}

/* ------------------------------------------------------------------ together */

static int count_of(const fst_paper_state *paper, fst_scan scan)
{
    const int count = paper->options->reduced ? scans[scan].reduced_count : scans[scan].count;
    return paper->mu > 0.0 && scans[scan].dry_count < count ? scans[scan].dry_count : count;
}

static fst_status begin_scan(fst_paper_state *paper, fst_scan scan, fst_dynamics dynamics, fst_error *error)
{
    fst_paper_run *runs = calloc((size_t)paper->counts[scan] + 1, sizeof *runs);
    paper->scans[scan][dynamics] = runs;
    if (!runs)
        return fst_fail(error, FST_NO_MEMORY, "paper", "no memory for %d runs", paper->counts[scan]);
    fst_status status = FST_OK;
    for (int i = 0; i < paper->counts[scan] && status == FST_OK; ++i)
        status = scan_params(paper, scan, dynamics, scan_omega(paper, scan, i), &runs[i].params, error);
    return status;
}

fst_status fst_paper_begin(fst_paper_state *paper, fst_error *error)
{
    fst_status status = FST_OK;
    for (int scan = 0; scan < FST_SCAN_COUNT; ++scan)
        paper->counts[scan] = count_of(paper, (fst_scan)scan);
    for (int d = 0; d < FST_PAPER_DYNAMICS && status == FST_OK; ++d) {
        fst_paper_exact_begin(&paper->exact[d]);
        for (int scan = 0; scan < FST_SCAN_COUNT && status == FST_OK; ++scan)
            status = begin_scan(paper, (fst_scan)scan, (fst_dynamics)d, error);
    }
    return status;
}

fst_status fst_paper_make_runs(fst_paper_state *paper, fst_error *error)
{
    fst_paper_pieces runs = {
        "runs", 0.0, 0.45, fst_paper_run_count(paper), FST_PAPER_STEP_RUNS, fst_paper_scan_run};
    return fst_paper_do(paper, &runs, error);
}

fst_status fst_paper_find_orbits(fst_paper_state *paper, fst_error *error)
{
    fst_paper_pieces exact = {"periodic orbits",   0.5, 0.6, FST_PAPER_DYNAMICS, FST_PAPER_STEP_EXACT,
                              fst_paper_find_exact};
    return fst_paper_do(paper, &exact, error);
}

fst_status fst_paper_find_thresholds(fst_paper_state *paper, fst_error *error)
{
    fst_paper_pieces changes_part = {
        "thresholds", 0.6, 0.65, FST_CHANGE_COUNT * FST_PAPER_DYNAMICS, FST_PAPER_STEP_THRESHOLDS, find_change};
    return fst_paper_do(paper, &changes_part, error);
}

int fst_paper_has(const fst_paper_state *paper, fst_paper_step step, fst_scan scan)
{
    if (step != FST_PAPER_STEP_RUNS && !paper->done[step])
        return 0;
    for (int s = (int)scan; s < FST_SCAN_COUNT; ++s)
        for (int d = 0; d < dynamics_of(paper); ++d)
            for (int i = 0; i < paper->counts[s]; ++i)
                if (!paper->scans[s][d] || !paper->scans[s][d][i].done)
                    return 0;
    return 1;
}

void fst_paper_free_runs(fst_paper_state *paper)
{
    for (int dynamics = 0; dynamics < FST_PAPER_DYNAMICS; ++dynamics) {
        free(paper->search[dynamics]);
        paper->search[dynamics] = NULL;
    }
    for (int scan = 0; scan < FST_SCAN_COUNT; ++scan) {
        for (int dynamics = 0; dynamics < FST_PAPER_DYNAMICS; ++dynamics) {
            for (int i = 0; paper->scans[scan][dynamics] && i < paper->counts[scan]; ++i)
                fst_table_free(&paper->scans[scan][dynamics][i].trajectory);
            free(paper->scans[scan][dynamics]);
            paper->scans[scan][dynamics] = NULL;
        }
    }
}

const fst_paper_run *fst_paper_single(const fst_paper_state *paper, fst_scan scan, fst_dynamics dynamics)
{
    return &paper->scans[scan][dynamics][0];
}

int fst_paper_counter_rotates(const fst_paper_run *run)
{
    return run->result.regime == FST_REGIME_COUNTER_ROTATING && fst_paper_is_settled(&run->result);
}
