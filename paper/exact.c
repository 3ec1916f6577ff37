/* exact.c - what the branches of periodic orbits and of locked states tell without any run: the drives at which
 * patterns close, where the period halves, and where counter-rotation ends. */
#include "paper/runs.h"
#include "paper/statements.h"

#include "base/error.h"

#include <stdio.h>
#include <string.h>

/* The branch is followed between these drives: through the experiment's range and beyond, to the fold at which
 * the orbit ends. */
static const double BRANCH_FROM = 0.17, BRANCH_TO = 4.0;
static const double BRANCH_START = 0.3; /* a drive at which the bead counter-rotates */
/* The last locked state loses its stability between these drives. */
static const double LOCKED_FROM = 0.14, LOCKED_TO = 0.17;
/* With more friction it does so between these, if it is lost where it was, or as the paper's balance has it,
 * where friction is as great as before. */
static const double RUBBED_FROM = 0.143, RUBBED_TO = 0.157;
static const double LOCKED_AT = 0.02; /* the slowest drive of the runs */
/* A small kappa, and a drive at which a bead that is held so weakly stays locked. */
static const double WEAK = 0.015, WEAK_DRIVE = 0.001;

static fst_params params_at(fst_dynamics dynamics, double omega)
{
    fst_params params = fst_default_params();
    params.model_dynamics = (int)dynamics;
    params.drive_omega = omega;
    params.drive_frequency = NAN;
    return params;
}

/* Find for each row of Table 1 the drive at which its pattern closes on the stable branch. */
static fst_status close_patterns(const fst_params *params, const fst_branch *branch,
                                 const fst_progress *progress, fst_paper_exact *exact, fst_error *error)
{
    fst_status status = FST_OK;
    for (int row = 0; row < FST_TABLE1_ROWS && status == FST_OK; ++row) {
        fst_festoon_list list;
        status = fst_festoons_on(params, branch, fst_table1[row].count, progress, &list, error);
        if (status == FST_OK)
            exact->closed[row] = (fst_paper_pattern){list.omegas[0], list.orbits[0].means.symmetry};
        fst_festoons_free(&list);
        status = status == FST_NO_CONVERGENCE ? FST_OK : status; /* this pattern closes nowhere */
    }
    return status;
}

static void read_branch(const fst_branch *branch, fst_paper_exact *exact)
{
    for (size_t i = 0; i < branch->special_count; ++i) {
        const fst_special *special = &branch->specials[i];
        if (special->type == FST_SPECIAL_PITCHFORK) {
            exact->halving = special->omega;
            exact->criticality = special->criticality;
        } else if (special->type == FST_SPECIAL_FOLD) {
            exact->fold = special->omega;
        } else if (special->type == FST_SPECIAL_ORIGIN_CROSSING) {
            exact->origin = special->omega;
        }
    }
    for (size_t i = 0; i < branch->point_count; ++i) {
        const fst_branch_point *point = &branch->points[i];
        if (point->stable && point->turns < 0 && point->symmetry == FST_SYMMETRY_S1)
            exact->most_s1 = fmax(exact->most_s1, point->festoons);
    }
}

/* Find where the stable locked states end that reach the highest drive; NAN: nowhere between these drives. */
static fst_status find_locked_end(const fst_params *params, double from, double to,
                                  const fst_progress *progress, double *end, fst_error *error)
{
    fst_branch_options options = fst_default_branch_options();
    options.kind = FST_BRANCH_LOCKED;
    options.from = from;
    options.to = to;
    options.progress = progress;
    fst_branch branch;
    const fst_status status = fst_branch_follow(params, &options, &branch, error);
    double highest = -INFINITY;
    for (size_t i = 0; status == FST_OK && i < branch.point_count; ++i)
        if (branch.points[i].stable)
            highest = fmax(highest, branch.points[i].omega);
    for (size_t i = 0; status == FST_OK && i < branch.special_count; ++i) {
        const fst_special *special = &branch.specials[i];
        if (special->type == FST_SPECIAL_HOPF && special->omega >= highest)
            *end = fmin(special->omega, isnan(*end) ? INFINITY : *end);
    }
    fst_branch_free(&branch);
    return status;
}

/* The same with more friction and everything else, in its own units, as it was: kappa gamma^2 is the magnet's.
 */
static fst_status find_rubbed_end(const fst_params *params, const fst_progress *progress, double *end,
                                  fst_error *error)
{
    fst_params rubbed = *params;
    rubbed.friction_gamma *= FST_MORE_FRICTION;
    rubbed.model_kappa /= FST_MORE_FRICTION * FST_MORE_FRICTION;
    const fst_status status = find_locked_end(&rubbed, RUBBED_FROM / FST_MORE_FRICTION,
                                              RUBBED_TO / FST_MORE_FRICTION, progress, end, error);
    *end *= FST_MORE_FRICTION; /* in the units of the usual friction */
    return status;
}

static fst_status count_minima(fst_dynamics dynamics, const fst_progress *progress, fst_paper_exact *exact,
                               fst_error *error)
{
    fst_params params = params_at(dynamics, LOCKED_AT);
    fst_locked_list list;
    fst_status status = fst_locked_find(&params, progress, &list, error);
    if (status != FST_OK)
        return status;
    exact->locked_minima = 0.0;
    for (size_t i = 0; i < list.count; ++i)
        exact->locked_minima += list.states[i].stable;
    fst_locked_free(&list);
    return FST_OK;
}

/* Find the damping ratio -Re/|lambda| of the least damped swing about a stable locked state at a
 * small kappa. */
static fst_status find_damping(fst_dynamics dynamics, const fst_progress *progress, fst_paper_exact *exact,
                               fst_error *error)
{
    fst_params params = params_at(dynamics, WEAK_DRIVE);
    params.model_kappa = WEAK;
    fst_locked_list list;
    fst_status status = fst_locked_find(&params, progress, &list, error);
    if (status != FST_OK)
        return status;
    for (size_t i = 0; i < list.count; ++i) {
        const fst_locked *state = &list.states[i];
        for (int j = 0; j < FST_EIGENVALUE_COUNT && state->stable; ++j) {
            double re = state->eigenvalue_re[j], im = state->eigenvalue_im[j];
            if (im > 0.0)
                exact->damping = fmin(exact->damping, -re / hypot(re, im));
        }
    }
    fst_locked_free(&list);
    return FST_OK;
}

fst_status fst_paper_find_exact(fst_paper_state *paper, int index, fst_error *error)
{
    fst_dynamics dynamics = (fst_dynamics)index;
    fst_paper_exact *exact = &paper->exact[dynamics];
    const fst_progress *progress = &paper->until_refused;
    fst_params params = params_at(dynamics, BRANCH_START);
    fst_branch_options options = fst_default_branch_options();
    options.from = BRANCH_FROM;
    options.to = BRANCH_TO;
    options.progress = progress;
    fst_branch branch;
    fst_error why = {.code = FST_OK};
    fst_status status = fst_branch_follow(&params, &options, &branch, &why);
    if (status == FST_OK) {
        read_branch(&branch, exact);
        status = close_patterns(&params, &branch, progress, exact, &why);
    }
    fst_branch_free(&branch);
    if (status == FST_OK)
        status = find_locked_end(&params, LOCKED_FROM, LOCKED_TO, progress, &exact->locked_end, &why);
    if (status == FST_OK)
        status = find_rubbed_end(&params, progress, &exact->locked_end_rubbed, &why);
    if (status == FST_OK)
        status = count_minima(dynamics, progress, exact, &why);
    if (status == FST_OK)
        status = find_damping(dynamics, progress, exact, &why);
    /* Without LAPACK, or where the method fails, this sentence stands for these numbers; the rest of the paper
     * stays. */
    if (status == FST_UNAVAILABLE || status == FST_NO_CONVERGENCE) {
        (void)snprintf(exact->missing, sizeof exact->missing, "%s", why.sentence);
        return FST_OK;
    }
    if (status != FST_OK && error)
        *error = why;
    return status;
}

void fst_paper_exact_begin(fst_paper_exact *exact)
{
    *exact = (fst_paper_exact){.halving = NAN,
                               .fold = NAN,
                               .origin = NAN,
                               .locked_end = NAN,
                               .locked_end_rubbed = NAN,
                               .locked_minima = NAN,
                               .damping = NAN};
    for (int row = 0; row < FST_TABLE1_ROWS; ++row)
        exact->closed[row].omega = NAN;
}
