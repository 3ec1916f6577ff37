/* magnets.c - the runs on real magnets: which magnets, how strong they are, and what beads do on them.
 *
 * Each magnet has the remanence that gives the greatest field of the five lines at the bead's centre, so that
 * the bead's energy over a pole is what kappa = 1.5 says; what differs is the field's shape. */
#include "paper/magnets.h"
#include "paper/runs.h"
#include "paper/work.h"

#include "base/constants.h"
#include "base/error.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#define BLOCK(x, length, j_x, j_z)                                                                             \
    {                                                                                                          \
        .kind = FST_PART_CUBOID, .centre = {x, 0.0, 0.0}, .size = {length, 40e-3, 9e-3},                       \
        .remanence = {j_x, 0.0, j_z}, .rotation = {                                                            \
            0.0,                                                                                               \
            0.0,                                                                                               \
            0.0,                                                                                               \
            1.0                                                                                                \
        }                                                                                                      \
    }

const fst_shown_magnet fst_shown_magnets[FST_MAGNETS] = {
    {.id = "lines", .name = "five lines", .about = "the paper's model: lines of dipoles, 46 mm long"},
    {.id = "bar",
     .name = "the whole bar",
     .about = "a block of 56 × 40 × 9 mm, magnetised along its length",
     .part_count = 1,
     .parts = {BLOCK(0.0, 56e-3, 1.0, 0.0)}},
    {.id = "short",
     .name = "45 mm of the bar",
     .about = "the same, with 5.5 mm at each end that are not magnetised",
     .part_count = 1,
     .parts = {BLOCK(0.0, 45e-3, 1.0, 0.0)}},
    {.id = "upright",
     .name = "two upright blocks",
     .about = "two blocks of 13 × 40 × 9 mm, 30 mm apart, one magnetised up and the other down",
     .part_count = 2,
     .parts = {BLOCK(21.5e-3, 13e-3, 0.0, 1.0), BLOCK(-21.5e-3, 13e-3, 0.0, -1.0)}},
};

/* Drives in Hz. */
static const double rolling_drives[FST_MAGNET_ROLLING] = {7.5,  8.5,  9.5,  10.0, 10.7, 12.0, 13.0, 14.0,
                                                          15.0, 16.0, 17.0, 18.0, 19.0, 19.9, 22.0};
static const double resting_drives[FST_MAGNET_RESTING] = {5.0, 6.0, 6.5, 7.0, 7.5, 8.0, 9.0, 10.0, 12.0};

/* ------------------------------------------------------------------ fields */

/* |B| in T at the place X on the magnet's axis. */
static double strength_at(const fst_model *model, double x)
{
    double b[3], gradient[3][3];
    fst_field(model, x, 0.0, b, gradient);
    return sqrt(b[0] * b[0] + b[1] * b[1] + b[2] * b[2]) * fst_model_groups(model).field_unit;
}

/* Where |B| is greatest on the axis of a model, in l: the best of a grid, and golden sections about it. */
static double place_of_greatest(const fst_model *model)
{
    enum { PLACES = 200 };
    const double step = 2.0 / PLACES, golden = 0.6180339887498949;
    int best = 0;
    for (int i = 1; i <= PLACES; ++i)
        if (strength_at(model, i * step) > strength_at(model, best * step))
            best = i;
    double low = fmax(best - 1, 0) * step, high = (best + 1) * step;
    while (high - low > 1e-9) {
        const double left = high - golden * (high - low), right = low + golden * (high - low);
        *(strength_at(model, left) < strength_at(model, right) ? &low : &high) =
            strength_at(model, left) < strength_at(model, right) ? left : right;
    }
    return 0.5 * (low + high);
}

/* The greatest |B| in T at the height `up` over the plate, and the distance of the maxima in mm. */
static fst_status greatest_field(const fst_params *of, double up, double *tesla, double *apart,
                                 fst_error *error)
{
    fst_params params = *of;
    fst_model *model = NULL;
    params.model_h = (params.magnet_depth + up) / params.magnet_half_length;
    const fst_status status = fst_model_new(&params, &model, error);
    if (status != FST_OK)
        return status;
    const double place = place_of_greatest(model);
    *tesla = strength_at(model, place);
    *apart = 2e3 * params.magnet_half_length * place;
    fst_model_free(model);
    return FST_OK;
}

/* A remanence of so many digits that a command can repeat it. */
static double rounded(double remanence)
{
    char text[32];
    (void)snprintf(text, sizeof text, "%.4g", remanence);
    return atof(text);
}

static fst_status measure_fields(fst_paper_state *paper, fst_error *error)
{
    fst_paper_magnets *magnets = paper->magnets;
    fst_status status = FST_OK;
    for (int m = 0; m < FST_MAGNETS && status == FST_OK; ++m) {
        fst_magnet_column *column = &magnets->of[m];
        fst_params params;
        double tesla, unused;
        column->remanence = m == 0 ? NAN : 1.0;
        status = fst_magnet_params(paper, m, 0, 10.7, 0, &params, error);
        if (status == FST_OK)
            status = greatest_field(&params, 0.0, &unused, &column->apart_plate, error);
        if (status == FST_OK)
            status = greatest_field(&params, params.bead_radius, &tesla, &column->apart, error);
        if (m == 0)
            magnets->greatest = tesla;
        else if (status == FST_OK)
            column->remanence = rounded(magnets->greatest / tesla);
    }
    return status;
}

/* ------------------------------------------------------------------ runs */

/* The moment of the bead, A m^2. */
static double bead_moment(double radius)
{
    return 2.0 * FST_TWO_PI / 3.0 * (radius * radius * radius) * FST_MAGNET_BEAD / FST_MU_0;
}

fst_status fst_magnet_params(const fst_paper_state *paper, int magnet, int law, double hertz, int start,
                             fst_params *params, fst_error *error)
{
    const fst_shown_magnet *shown = &fst_shown_magnets[magnet];
    *params = fst_default_params();
    fst_status status = fst_paper_set(
        params, error, "drive.frequency=%.10gHz run.rtol=1e-8 %s friction.law=%s friction.mu=%.10g %s", hertz,
        paper->options->reduced ? "run.discard=60 run.periods=100" : "run.discard=120 run.periods=160",
        law ? "coulomb" : "viscous", FST_DRY_MU,
        start ? "start.spin=rest start.r=0.89" : "start.spin=rolling start.r=0.95");
    if (shown->part_count == 0) { /* kappa is given, and the bead's moment tells what it is in tesla */
        params->bead_moment = bead_moment(params->bead_radius);
        return status == FST_OK ? fst_paper_set(params, error, "model.kappa=%.10g", FST_MAGNET_KAPPA) : status;
    }
    if (status == FST_OK)
        status = fst_paper_set(params, error, "magnet.shape=parts bead.remanence=%.10gT", FST_MAGNET_BEAD);
    params->magnet_part_count = shown->part_count;
    memcpy(params->magnet_parts, shown->parts, sizeof shown->parts);
    for (int part = 0; part < shown->part_count; ++part)
        for (int i = 0; i < 3; ++i)
            params->magnet_parts[part].remanence[i] *= paper->magnets->of[magnet].remanence;
    return status;
}

double fst_magnet_drive(int run)
{
    return run < FST_MAGNET_ROLLING ? rolling_drives[run] : resting_drives[run - FST_MAGNET_ROLLING];
}

/* Reduced papers make a few runs on the whole bar. */
static int is_made(const fst_paper_state *paper, int magnet, int law, int run)
{
    return !paper->options->reduced || (magnet == 1 && law == 1 && run % 4 == 0);
}

/* The runs with one magnet under one law, which are done side by side. */
typedef struct runs_side_by_side {
    const fst_paper_state *paper;
    int magnet, law, next;
    fst_paper_run *runs;
    fst_status status;
    fst_error *error;
} runs_side_by_side;

static int next_run(void *user, fst_row_job *job)
{
    runs_side_by_side *all = user;
    while (all->next < FST_MAGNET_RUNS && !is_made(all->paper, all->magnet, all->law, all->next))
        ++all->next;
    if (all->next == FST_MAGNET_RUNS || all->status != FST_OK)
        return 0;
    fst_paper_run *run = &all->runs[all->next];
    all->status = fst_magnet_params(all->paper, all->magnet, all->law, fst_magnet_drive(all->next),
                                    all->next >= FST_MAGNET_ROLLING, &run->params, all->error);
    *job = (fst_row_job){.point = all->next, .params = run->params};
    ++all->next;
    return all->status == FST_OK;
}

static int run_done(void *user, fst_row_job *job, fst_status status, const fst_run_result *result,
                    const fst_error *error)
{
    runs_side_by_side *all = user;
    fst_paper_run *run = &all->runs[job->point];
    /* As in fst_paper_run_dry(): a run whose exponent cannot be computed tells all the rest. */
    run->done = status == FST_OK || status == FST_STEP_UNDERFLOW;
    run->result = *result;
    if (!run->done && all->status == FST_OK) {
        all->status = status;
        if (all->error)
            *all->error = *error;
    }
    return 0;
}

static fst_status column_piece(fst_paper_state *paper, int index, fst_error *error)
{
    const int magnet = FST_MAGNETS - 1 - index / FST_MAGNET_LAWS; /* the slow ones first */
    const int law = FST_MAGNET_LAWS - 1 - index % FST_MAGNET_LAWS;
    runs_side_by_side all = {.paper = paper,
                             .magnet = magnet,
                             .law = law,
                             .runs = paper->magnets->of[magnet].runs[law],
                             .error = error};
    const fst_row_work work = {.user = &all,
                               .arithmetic = FST_ARITHMETIC_PORTABLE,
                               .next = next_run,
                               .done = run_done,
                               .progress = &paper->until_refused};
    const fst_status status = fst_rows(&work, error);
    return status == FST_OK ? all.status : status;
}

/* ------------------------------------------------------------------ all of it */

fst_status fst_paper_magnets_begin(fst_paper_state *paper, fst_error *error)
{
    paper->magnets = calloc(1, sizeof *paper->magnets);
    return paper->magnets ? FST_OK : fst_fail(error, FST_NO_MEMORY, "paper", "no memory for the real magnets");
}

void fst_paper_magnets_free(fst_paper_state *paper)
{
    free(paper->magnets);
    paper->magnets = NULL;
}

int fst_paper_has_magnets(const fst_paper_state *paper)
{
    return paper->magnets && paper->done[FST_PAPER_STEP_MAGNETS];
}

fst_status fst_paper_make_magnets(fst_paper_state *paper, fst_error *error)
{
    const fst_paper_pieces part = {"real magnets",         0.98,        0.99, FST_MAGNETS * FST_MAGNET_LAWS,
                                   FST_PAPER_STEP_MAGNETS, column_piece};
    const fst_status status = measure_fields(paper, error);
    return status == FST_OK ? fst_paper_do(paper, &part, error) : status;
}
