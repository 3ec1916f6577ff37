/* paper_exact.c - what needs no run: the drives at which patterns close, where the period halves and where
 * counter-rotation ends, on the branch of periodic orbits. */
#include "app/paper.h"

#include "base/bracket.h"
#include "base/error.h"

#include <stdio.h>
#include <string.h>

/* Drives between which the branch is followed: the experiment's range and beyond, to the fold at which the
 * orbit ends. */
static const double BRANCH_FROM = 0.19, BRANCH_TO = 4.0;
static const double LOCKED_AT = 0.02; /* the slowest drive of the runs */

static fst_params params_at(fst_dynamics dynamics, double omega)
{
    fst_params params = fst_default_params();
    params.model_dynamics = (int)dynamics;
    params.drive_omega = omega;
    params.drive_frequency = NAN;
    return params;
}

/* The drive between two stable neighbours on the branch at which N is `target`: the Illinois rule on orbits
 * that Newton's method makes exact. */
static fst_status close_pattern(fst_dynamics dynamics, const fst_branch_point *a, const fst_branch_point *b,
                                double target, fst_paper_pattern *pattern, fst_error *error)
{
    fst_bracket z = {a->value, b->value, a->festoons - target, b->festoons - target, 0};
    fst_orbit orbit;
    for (int i = 0; i < 60; i++) {
        double omega = fst_bracket_next(&z);
        fst_params params = params_at(dynamics, omega);
        fst_status status = fst_orbit_find(&params, &orbit, error);
        if (status != FST_OK)
            return status;
        double f = orbit.means.festoons - target;
        *pattern = (fst_paper_pattern){omega, orbit.symmetry};
        if (fabs(f) < 1e-11 * target || fabs(z.hi - z.lo) < 1e-12)
            break;
        fst_bracket_take(&z, omega, f);
    }
    return FST_OK;
}

static int brackets(const fst_branch_point *a, const fst_branch_point *b, double target)
{
    return a->branch == b->branch && a->stable && b->stable && a->turns < 0 && b->turns < 0 &&
           (a->festoons < target) != (b->festoons < target);
}

/* Each row of Table 1 whose pattern closes somewhere on the stable branch. */
static fst_status close_patterns(fst_dynamics dynamics, const fst_branch *branch, fst_paper_exact *exact,
                                 fst_error *error)
{
    fst_status status = FST_OK;
    for (int row = 0; row < FST_TABLE1_ROWS; row++)
        for (size_t i = 0; i + 1 < branch->point_count && status == FST_OK; i++)
            if (brackets(&branch->points[i], &branch->points[i + 1], fst_table1[row].count))
                status = close_pattern(dynamics, &branch->points[i], &branch->points[i + 1],
                                       fst_table1[row].count, &exact->closed[row], error);
    return status;
}

static void read_branch(const fst_branch *branch, fst_paper_exact *exact)
{
    for (size_t i = 0; i < branch->special_count; i++) {
        const fst_special *special = &branch->specials[i];
        if (special->type == FST_SPECIAL_PITCHFORK) {
            exact->halving = special->omega;
            exact->criticality = special->criticality;
        } else if (special->type == FST_SPECIAL_FOLD) {
            exact->fold = special->omega;
        }
    }
    for (size_t i = 0; i < branch->point_count; i++) {
        const fst_branch_point *point = &branch->points[i];
        if (point->stable && point->turns < 0 && point->symmetry == FST_SYMMETRY_S1)
            exact->most_s1 = fmax(exact->most_s1, point->festoons);
    }
}

static fst_status count_minima(fst_dynamics dynamics, fst_paper_exact *exact, fst_error *error)
{
    fst_params params = params_at(dynamics, LOCKED_AT);
    fst_locked_list list;
    fst_status status = fst_locked_find(&params, &list, error);
    if (status != FST_OK)
        return status;
    exact->locked_minima = 0.0;
    for (size_t i = 0; i < list.count; i++)
        exact->locked_minima += list.states[i].stable;
    fst_locked_free(&list);
    return FST_OK;
}

fst_status fst_paper_find_exact(fst_paper_state *paper, int index, fst_error *error)
{
    fst_dynamics dynamics = (fst_dynamics)index;
    fst_paper_exact *exact = &paper->exact[dynamics];
    fst_params params = params_at(dynamics, BRANCH_FROM);
    fst_branch_options options = fst_default_branch_options();
    options.from = BRANCH_FROM;
    options.to = BRANCH_TO;
    fst_branch branch;
    fst_error why = {.code = FST_OK};
    fst_status status = fst_branch_follow(&params, &options, &branch, &why);
    if (status == FST_OK) {
        read_branch(&branch, exact);
        status = close_patterns(dynamics, &branch, exact, &why);
    }
    fst_branch_free(&branch);
    if (status == FST_OK)
        status = count_minima(dynamics, exact, &why);
    /* Without LAPACK, or where the method fails, the rest of the paper stands, and this sentence instead. */
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
    *exact = (fst_paper_exact){.halving = NAN, .fold = NAN, .locked_minima = NAN};
    for (int row = 0; row < FST_TABLE1_ROWS; row++)
        exact->closed[row].omega = NAN;
}
