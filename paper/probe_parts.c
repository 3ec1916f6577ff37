/* probe_parts.c - the parts of the paper's work that make its probes: near the period halving, on the
 * corotating motion, and of beads that the field magnetises. */
#include "paper/runs.h"
#include "paper/work.h"

#include "base/constants.h"
#include "base/error.h"

#include <stdlib.h>

const double fst_ansatz_drives[FST_ANSATZ_DRIVES] = {0.5, 0.8, 1.2, 2.0};
const double fst_remanence_drives[FST_REMANENCE_DRIVES] = {0.3, 0.4};
const double fst_remanence_strengths[FST_REMANENCE_STRENGTHS] = {1e-3, 1.4e-3, 1.8e-3, 2.2e-3, 2.6e-3, 3e-3};

/* Distances of the drive from the threshold. */
static const double halving_offsets[FST_HALVING_POINTS] = {-0.010,  -0.008,  -0.006,  -0.0045, -0.0035, -0.0025,
                                                           -0.0018, -0.0012, -0.0006, -0.0003, 0.0015,  0.0022,
                                                           0.003,   0.0045,  0.0065,  0.010};
/* The relaxation time grows as the inverse distance: nearer than this the motion is followed for longer. */
static const double NEAR_THRESHOLD = 0.0012;

enum { SEARCH = 240, REDUCED_SEARCH = 24 };

const fst_kappa_scan fst_remanence_scan = {2e-3, 1.5, 90, 3, 2, 600.0, NULL};
static const fst_kappa_scan reduced_remanence_scan = {2e-3, 1.5, 8, 1, 1, 100.0, NULL};

static fst_params probe_params(fst_dynamics dynamics, double omega)
{
    fst_params params = fst_default_params();
    params.model_dynamics = (int)dynamics;
    params.drive_omega = omega;
    params.drive_frequency = NAN;
    return params;
}

/* ------------------------------------------------------------------ the period halving */

static fst_status halving_piece(fst_paper_state *paper, int index, fst_error *error)
{
    fst_dynamics dynamics = (fst_dynamics)(index % FST_PAPER_DYNAMICS);
    int point = index / FST_PAPER_DYNAMICS;
    fst_paper_halving *halving = &paper->halving[dynamics];
    fst_paper_bracket bracket = paper->changes[FST_CHANGE_HALVING][dynamics];
    double centre = 0.5 * (bracket.low + bracket.high);
    halving->points[point] = (fst_halving_point){NAN, NAN, NAN, NAN};
    if (!isfinite(centre))
        return FST_OK;
    /* A reduced paper knows the threshold less well and follows the motion for less long, so it stays further
     * away. */
    double wider = paper->options->reduced ? 4.0 : 1.0;
    double offset = wider * halving_offsets[point];
    fst_params params = probe_params(dynamics, centre + offset);
    double periods = paper->options->reduced ? 700.0 : 1000.0;
    periods *= fmax(1.0, NEAR_THRESHOLD / fabs(offset));
    int shown = point == FST_HALVING_INSET;
    return fst_probe_halving(&params, periods, &halving->points[point], shown ? halving->r : NULL,
                             shown ? FST_HALVING_SHOWN : 0, error);
}

double fst_paper_halving_drive(const fst_paper_state *paper, fst_dynamics dynamics)
{
    double pitchfork = paper->exact[dynamics].halving;
    return isfinite(pitchfork) ? pitchfork : fst_paper_halving_line(paper, dynamics);
}

double fst_paper_halving_line(const fst_paper_state *paper, fst_dynamics dynamics)
{
    /* Without the orbits the threshold is only bracketed, and the two nearest drives may lie beyond it. */
    enum { NEAREST = 5, LEFT_OUT = 2 };
    double omega[NEAREST], square[NEAREST];
    int count = 0;
    for (int i = 0; i < NEAREST; ++i) {
        const fst_halving_point *point =
            &paper->halving[dynamics].points[FST_HALVING_BELOW - LEFT_OUT - NEAREST + i];
        if (isnan(point->mean_nz)) /* this one has not settled */
            continue;
        omega[count] = point->omega;
        square[count++] = point->mean_nz * point->mean_nz;
    }
    return count < 3 ? NAN : fst_line_zero(omega, square, count);
}

/* ------------------------------------------------------------------ rapid corotation */

static fst_status disc_piece(fst_paper_state *paper, int place, fst_error *error)
{
    const fst_params params = probe_params(FST_DYNAMICS_RIGID, fst_ansatz_drives[0]);
    fst_model *model;
    const fst_status status = fst_model_new(&params, &model, error);
    if (status != FST_OK)
        return status;
    paper->disc[place] = fst_disc_least_drive(model, fst_disc_radii[place], 2.4, NULL);
    fst_model_free(model);
    return FST_OK;
}

/* The discs, then the beads. */
static fst_status ansatz_piece(fst_paper_state *paper, int index, fst_error *error)
{
    if (index < FST_DISC_PLACES)
        return disc_piece(paper, index, error);
    index -= FST_DISC_PLACES;
    int start = index % FST_ANSATZ_STARTS, drive = index / FST_ANSATZ_STARTS % FST_ANSATZ_DRIVES;
    fst_dynamics dynamics = (fst_dynamics)(index / (FST_ANSATZ_STARTS * FST_ANSATZ_DRIVES));
    fst_paper_ansatz *bead = &paper->ansatz[dynamics][drive][start];
    fst_params params = probe_params(dynamics, fst_ansatz_drives[drive]);
    double r = 0.75 + 0.15 * (start / 4), bead_angle = 0.1 + 0.5 * FST_PI * (start % 4);
    return fst_probe_ansatz(&params, r, bead_angle, paper->options->reduced ? 40.0 : 120.0, &bead->speed,
                            &bead->survived, error);
}

/* ------------------------------------------------------------------ beads that the field magnetises */

static fst_status search_piece(fst_paper_state *paper, int index, fst_error *error)
{
    int start = index / FST_PAPER_DYNAMICS, dynamics = index % FST_PAPER_DYNAMICS;
    return fst_search_one(start, (fst_dynamics)dynamics, &paper->search[dynamics][start], error);
}

/* The identities hold over any window, with the term from the change of the state.  A mean by itself describes
 * the motion only over a window in which that term is small. */
static fst_status balance_piece(fst_paper_state *paper, int index, fst_error *error)
{
    /* Strengths and drives at which the bead is locked, and at which it circles and its motion is far from
     * periodic. */
    static const double cases[FST_BALANCE_CASES][2] = {{5e-3, 0.1}, {1e-3, 0.3}, {5e-3, 0.6}};
    static const double discards[] = {50.0, 350.0, 750.0}, windows[] = {100.0, 400.0, 800.0};
    int motion = index / FST_PAPER_DYNAMICS, dynamics = index % FST_PAPER_DYNAMICS;
    fst_balances *balances = &paper->balances[dynamics][motion], *settled = &paper->settled[dynamics][motion];
    fst_params params = probe_params((fst_dynamics)dynamics, cases[motion][1]);
    params.bead_material = FST_MATERIAL_PARAMAGNETIC;
    params.bead_a = cases[motion][0];
    fst_status status = fst_paramagnet_balances(&params, discards[0], windows[0], balances, error);
    *settled = *balances;
    for (int i = 1; i < 3 && status == FST_OK && !fst_balances_settled(settled); ++i)
        status = fst_paramagnet_means(&params, discards[i], windows[i], settled, error);
    return status;
}

/* The figure shows all of `rigid`.  With the other dynamics only the statement needs a number. */
static fst_status remanence_piece(fst_paper_state *paper, int index, fst_error *error)
{
    int dynamics = index % FST_PAPER_DYNAMICS, place = index / FST_PAPER_DYNAMICS;
    int strength = place % FST_REMANENCE_STRENGTHS, drive = place / FST_REMANENCE_STRENGTHS;
    fst_least_found *least = &paper->remanence[dynamics][drive][strength];
    *least = (fst_least_found){NAN, NAN};
    if (dynamics != FST_DYNAMICS_RIGID && place > 0)
        return FST_OK;
    fst_params params = probe_params((fst_dynamics)dynamics, fst_remanence_drives[drive]);
    params.bead_material = FST_MATERIAL_MIXED;
    params.bead_a = fst_remanence_strengths[strength];
    params.run_rtol = 1e-8;
    fst_kappa_scan scan = paper->options->reduced ? reduced_remanence_scan : fst_remanence_scan;
    scan.progress = &paper->until_refused;
    return fst_least_kappa(&params, &scan, least, error);
}

fst_status fst_paper_make_probes(fst_paper_state *paper, const fst_paper_step *only, fst_error *error)
{
    paper->search_count = paper->options->starts > 0 ? paper->options->starts
                          : paper->options->reduced  ? REDUCED_SEARCH
                                                     : SEARCH;
    for (int dynamics = 0; dynamics < FST_PAPER_DYNAMICS; ++dynamics) {
        paper->search[dynamics] = calloc((size_t)paper->search_count, sizeof *paper->search[dynamics]);
        if (!paper->search[dynamics])
            return fst_fail(error, FST_NO_MEMORY, "paper", "no memory for %d starts", paper->search_count);
    }
    const fst_paper_pieces parts[] = {
        {"period halving", 0.65, 0.72, FST_HALVING_POINTS * FST_PAPER_DYNAMICS, FST_PAPER_STEP_HALVING,
         halving_piece},
        {"rapid corotation", 0.72, 0.75,
         FST_DISC_PLACES + FST_PAPER_DYNAMICS * FST_ANSATZ_DRIVES * FST_ANSATZ_STARTS, FST_PAPER_STEP_ANSATZ,
         ansatz_piece},
        {"paramagnetic beads", 0.75, 0.87, FST_PAPER_DYNAMICS * paper->search_count, FST_PAPER_STEP_SEARCH,
         search_piece},
        {"identities", 0.87, 0.88, FST_PAPER_DYNAMICS * FST_BALANCE_CASES, FST_PAPER_STEP_BALANCES,
         balance_piece},
        /* The statement rests on the first drive and strength only. */
        {"remanence", 0.88, 0.97,
         FST_PAPER_DYNAMICS * (only ? 1 : FST_REMANENCE_DRIVES * FST_REMANENCE_STRENGTHS),
         FST_PAPER_STEP_REMANENCE, remanence_piece},
    };
    fst_status status = FST_OK;
    for (size_t i = 0; i < sizeof parts / sizeof parts[0] && status == FST_OK; ++i)
        if (!only || *only == parts[i].step)
            status = fst_paper_do(paper, &parts[i], error);
    return status;
}
