/* dry.c - runs of a bead that rubs dry on the plate, and what they say to the paper's words about its
 * experiment.
 *
 * Two things are computed: the paper's own scans once more with one coefficient of friction, from which the
 * third column of the statements is measured; and a small map over the coefficient and the drive, from two
 * starts, for the table of facts.  The large maps are in dry_maps.c. */
#include "paper/dry.h"
#include "paper/runs.h"
#include "paper/work.h"

#include "base/constants.h"
#include "base/error.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

const double fst_dry_mus[FST_DRY_MUS] = {0.1, 0.15, 0.2, 0.3};
const double fst_dry_drives[FST_DRY_DRIVES] = {5.0,  6.0,  6.5,  7.0,  7.5,  8.0,  8.5,  9.0,  9.5,  10.0,
                                               10.7, 12.0, 13.0, 14.0, 15.0, 16.0, 17.0, 18.0, 19.0, 19.9};
const char *const fst_outcome_names[FST_OUTCOME_COUNT] = {"against the magnet", "with the magnet", "ejected",
                                                          "lifted", "other"};

/* A bead goes with the magnet if its mean angular velocity is the magnet's within this share, and against it if
 * it is negative by more than the other. */
static const double WITH = 0.02, AGAINST = 0.005;

fst_dry_outcome fst_outcome(const fst_run_result *result)
{
    const double share = result->mean_alpha_dot / result->omega;
    if (result->regime == FST_REGIME_EJECTED)
        return FST_OUTCOME_EJECTED;
    if (result->regime == FST_REGIME_LIFTED)
        return FST_OUTCOME_LIFTED;
    if (fabs(share - 1.0) < WITH)
        return FST_OUTCOME_WITH;
    return share < -AGAINST ? FST_OUTCOME_AGAINST : FST_OUTCOME_OTHER;
}

/* ------------------------------------------------------------------ the map */

/* The runs are short, because the outcome is clear long before the last digit of a mean is. */
static fst_status map_params(const fst_paper_state *paper, double mu, double hertz, int start,
                             fst_params *params, fst_error *error)
{
    *params = fst_default_params();
    return fst_paper_set(
        params, error, "friction.law=coulomb friction.mu=%.10g drive.frequency=%.10gHz run.rtol=1e-7 %s %s", mu,
        hertz, paper->options->reduced ? "run.discard=60 run.periods=100" : "run.discard=80 run.periods=120",
        start ? "start.spin=rest start.r=0.89" : "");
}

static int is_on_map(const fst_paper_state *paper, int mu, int drive, int start)
{
    if (start > 0 && drive >= FST_DRY_SLOW)
        return 0;
    return !paper->options->reduced || (fst_dry_mus[mu] == FST_DRY_MU && drive % 3 == 1);
}

static fst_status map_piece(fst_paper_state *paper, int index, fst_error *error)
{
    const int start = index % FST_DRY_STARTS, drive = index / FST_DRY_STARTS % FST_DRY_DRIVES;
    const int mu = index / (FST_DRY_STARTS * FST_DRY_DRIVES);
    if (!is_on_map(paper, mu, drive, start))
        return FST_OK;
    fst_paper_run *run = &paper->dry->map[mu][drive][start];
    const fst_status status =
        map_params(paper, fst_dry_mus[mu], fst_dry_drives[drive], start, &run->params, error);
    return status == FST_OK ? fst_paper_run_dry(run, 1, &paper->until_refused, NULL, error) : status;
}

/* ------------------------------------------------------------------ all of it */

fst_status fst_paper_dry_begin(fst_paper_state *paper, fst_error *error)
{
    paper->dry = calloc(1, sizeof *paper->dry);
    if (!paper->dry)
        return fst_fail(error, FST_NO_MEMORY, "paper", "no memory for the runs with dry friction");
    fst_paper_state *column = &paper->dry->column;
    column->mu = FST_DRY_MU;
    column->options = paper->options;
    column->directory = paper->directory;
    column->until_refused = paper->until_refused; /* which asks `paper` */
    for (int change = 0; change < FST_CHANGE_COUNT; ++change)
        for (int d = 0; d < FST_PAPER_DYNAMICS; ++d)
            column->changes[change][d] = (fst_paper_bracket){NAN, NAN};
    return fst_paper_begin(column, error);
}

void fst_paper_dry_free(fst_paper_state *paper)
{
    if (paper->dry)
        fst_paper_free_runs(&paper->dry->column);
    free(paper->dry);
    paper->dry = NULL;
}

/* Runs of the column first, then those of the map. */
static fst_status dry_piece(fst_paper_state *paper, int index, fst_error *error)
{
    const int column = fst_paper_run_count(&paper->dry->column);
    return index < column ? fst_paper_scan_run(&paper->dry->column, index, error)
                          : map_piece(paper, index - column, error);
}

fst_status fst_paper_make_dry(fst_paper_state *paper, int only_scans, fst_error *error)
{
    fst_paper_state *column = &paper->dry->column;
    column->first_scan = paper->first_scan;
    const int map = only_scans ? 0 : FST_DRY_MUS * FST_DRY_DRIVES * FST_DRY_STARTS;
    const fst_paper_pieces part = {"dry friction",     0.97,     0.98, fst_paper_run_count(column) + map,
                                   FST_PAPER_STEP_DRY, dry_piece};
    fst_status status = fst_paper_do(paper, &part, error);
    column->done[FST_PAPER_STEP_RUNS] = status == FST_OK;
    return status;
}

/* ------------------------------------------------------------------ facts */

void fst_dry_law_name(int law, char *text, size_t size)
{
    if (law < FST_PAPER_DYNAMICS)
        (void)snprintf(text, size, "viscous, %s",
                       fst_dynamics_name(law == 0 ? FST_DYNAMICS_FARAGO2020 : FST_DYNAMICS_RIGID));
    else
        (void)snprintf(text, size, "dry, μ = %g", fst_dry_mus[law - FST_PAPER_DYNAMICS]);
}

/* The runs of a law, the slowest drives first. */
enum { MOST_RUNS = 256 };
typedef struct law_runs {
    const fst_paper_run *of[MOST_RUNS];
    int count;
} law_runs;

static void add_run(law_runs *runs, const fst_paper_run *run)
{
    if (run->done && runs->count < MOST_RUNS)
        runs->of[runs->count++] = run;
}

static int by_drive(const void *one, const void *other)
{
    const fst_paper_run *const *a = one, *const *b = other;
    const double x = (*a)->result.omega, y = (*b)->result.omega;
    return (x > y) - (x < y);
}

static void sort_by_drive(law_runs *runs)
{
    qsort(runs->of, (size_t)runs->count, sizeof runs->of[0], by_drive);
}

static law_runs runs_of(const fst_paper_state *paper, int law)
{
    static const fst_scan viscous[] = {FST_SCAN_SLOW, FST_SCAN_COMPARISON};
    law_runs runs = {.count = 0};
    const fst_dynamics dynamics = law == 0 ? FST_DYNAMICS_FARAGO2020 : FST_DYNAMICS_RIGID;
    for (int s = 0; law < FST_PAPER_DYNAMICS && s < 2; ++s)
        for (int i = 0; i < paper->counts[viscous[s]]; ++i)
            add_run(&runs, &paper->scans[viscous[s]][dynamics][i]);
    for (int drive = 0; law >= FST_PAPER_DYNAMICS && drive < FST_DRY_DRIVES; ++drive)
        for (int start = 0; start < FST_DRY_STARTS; ++start)
            add_run(&runs, &paper->dry->map[law - FST_PAPER_DYNAMICS][drive][start]);
    sort_by_drive(&runs);
    return runs;
}

/* Halfway between the last run from rest that goes with the magnet and the next one that does not. */
static double corotation_end(const law_runs *runs)
{
    double last = NAN;
    for (int i = 0; i < runs->count; ++i) {
        const fst_paper_run *run = runs->of[i];
        if (run->params.start_spin != FST_SPIN_REST)
            continue;
        if (fst_outcome(&run->result) != FST_OUTCOME_WITH)
            return 0.5 * (last + run->result.frequency_hz);
        last = run->result.frequency_hz;
    }
    return NAN;
}

static double ejected_share(const law_runs *runs)
{
    int all = 0, gone = 0;
    for (int i = 0; i < runs->count; ++i) {
        const fst_run_result *result = &runs->of[i]->result;
        const fst_dry_outcome outcome = fst_outcome(result);
        if (result->frequency_hz < 7.0 || result->frequency_hz > 10.0)
            continue;
        ++all;
        gone += outcome == FST_OUTCOME_EJECTED || outcome == FST_OUTCOME_LIFTED;
    }
    return all > 0 ? 100.0 * gone / all : NAN;
}

/* The lowest drive from which on all runs circle against the magnet, from either start. */
static double onset_of(const law_runs *runs)
{
    double from = NAN, above = NAN; /* the drive last met, and the one before it */
    for (int i = runs->count - 1; i >= 0; --i) {
        const fst_run_result *result = &runs->of[i]->result;
        /* A viscous motion that has not settled has no means: it does not tell. */
        if (result->frequency_hz > 20.0 ||
            (result->regime == FST_REGIME_UNDECIDED && isnan(result->mean_alpha_dot)))
            continue;
        const int same = result->frequency_hz == from;
        if (fst_outcome(result) != FST_OUTCOME_AGAINST)
            return same ? above : from;
        if (!same)
            above = from;
        from = result->frequency_hz;
    }
    return from;
}

/* The festoons of the settled run from the rolling start that is next to this drive. */
static double festoons_near(const law_runs *runs, double hertz)
{
    const fst_run_result *nearest = NULL;
    for (int i = 0; i < runs->count; ++i) {
        const fst_run_result *result = &runs->of[i]->result;
        if (runs->of[i]->params.start_spin == FST_SPIN_ROLLING &&
            (!nearest || fabs(result->frequency_hz - hertz) < fabs(nearest->frequency_hz - hertz)))
            nearest = result;
    }
    return nearest && fabs(nearest->frequency_hz - hertz) < 0.2 && fst_paper_is_settled(nearest)
               ? nearest->festoons
               : NAN;
}

static double four_festoons(const law_runs *runs)
{
    return festoons_near(runs, 10.7);
}

static double many_festoons(const law_runs *runs)
{
    return festoons_near(runs, 19.9);
}

static double slowest(const law_runs *runs)
{
    double least = INFINITY, where = NAN;
    for (int i = 0; i < runs->count; ++i) {
        const fst_run_result *result = &runs->of[i]->result;
        if (!fst_paper_counter_rotates(runs->of[i]) || result->frequency_hz < 10.0 ||
            !(fabs(result->mean_alpha_dot) < least))
            continue;
        least = fabs(result->mean_alpha_dot);
        where = result->frequency_hz;
    }
    return where;
}

static int by_value(const void *one, const void *other)
{
    const double a = *(const double *)one, b = *(const double *)other;
    return (a > b) - (a < b);
}

static double friction_rate(const law_runs *runs)
{
    double rates[MOST_RUNS];
    int count = 0;
    for (int i = 0; i < runs->count; ++i) {
        const fst_paper_run *run = runs->of[i];
        if (run->params.friction_law == FST_FRICTION_VISCOUS)
            return run->params.friction_gamma;
        if (fst_paper_counter_rotates(run) && run->result.frequency_hz >= 10.0 &&
            run->result.frequency_hz <= 20.0 && isfinite(run->result.effective_rate))
            rates[count++] = run->result.effective_rate * run->params.friction_gamma;
    }
    qsort(rates, (size_t)count, sizeof rates[0], by_value);
    return count > 0 ? 0.5 * (rates[(count - 1) / 2] + rates[count / 2]) : NAN;
}

/* The facts, and how each is read off the runs. */
#define FACT(name, words, value, unit_, digits_, scale_, rule_)                                                \
    {                                                                                                          \
        .id = name, .section = "III (experiments)", .text = words, .said = NULL, .published = value,           \
        .scale = scale_, .unit = unit_, .digits = digits_, .rule = FST_RULE_##rule_                            \
    }
const fst_statement fst_dry_facts[FST_FACT_COUNT] = {
    FACT("corotation", "A bead released at rest above a pole goes round with the magnet up to about", 7.0, "Hz",
         2, 1.0, NUMBER),
    FACT("ejection", "Between 7 and 10 Hz most beads leave the plate (share of the runs)", NAN, "%", 0, 100.0,
         MOSTLY),
    FACT("onset", "Regular counter-rotation from about (lowest drive from which on all runs circle so)", 10.0,
         "Hz", 1, 1.0, NUMBER),
    FACT("four", "Festoons at 10.7 Hz", 4.0, "", 2, 1.0, NUMBER),
    FACT("many", "Festoons at 19.9 Hz (the paper's simulation has 15)", 15.0, "", 2, 1.0, NUMBER),
    FACT("bell", "The bead circles most slowly at about", 16.0, "Hz", 1, 1.0, NUMBER),
    FACT("rate", "Rate of friction (dry: ⟨f·V⟩/⟨V²⟩, median from 10 to 20 Hz)", 312.5, "1/s", 1, 1.0,
         MAGNITUDE),
};
static double (*const read_off[FST_FACT_COUNT])(const law_runs *runs) = {
    corotation_end, ejected_share, onset_of, four_festoons, many_festoons, slowest, friction_rate};

double fst_dry_fact(const fst_paper_state *paper, int fact, int law)
{
    const law_runs runs = runs_of(paper, law);
    return read_off[fact](&runs);
}

double fst_dry_fact_of(const fst_paper_run *runs, int count, int fact)
{
    law_runs sorted = {.count = 0};
    for (int i = 0; i < count; ++i)
        add_run(&sorted, &runs[i]);
    sort_by_drive(&sorted);
    return read_off[fact](&sorted);
}
