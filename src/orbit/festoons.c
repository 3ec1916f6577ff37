/* festoons.c - the patterns that close in the laboratory after a whole number of festoons. */
#include "orbit/describe.h"
#include "orbit/search.h"

#include <stdlib.h>
#include <string.h>

#include "base/bracket.h"
#include "base/error.h"

#define TWO_PI 6.283185307179586476925287

/* N of a counter-rotating orbit from its period alone: N = a (1 + omega/|<alpha'>|), alpha' = omega - 2 pi/T.
 */
static double festoons_of(const fst_solution *s)
{
    const double alpha_dot = s->value - TWO_PI / fst_whole_period(s);
    return (s->symmetric ? 2.0 : 1.0) * (1.0 + s->value / fabs(alpha_dot));
}

/* A branch point as a solution of the family over omega. */
static fst_status solution_at(const fst_family *family, const fst_branch_point *p, fst_solution *s,
                              fst_error *error)
{
    memset(s, 0, sizeof *s);
    s->symmetric = p->symmetry == FST_SYMMETRY_S2;
    s->value = p->value;
    s->period = s->symmetric ? 0.5 * p->period : p->period;
    memcpy(s->y[0], p->state, sizeof s->y[0]);
    const fst_status status = fst_solution_chain(family, s, s->symmetric ? 1 : 2, error);
    return status == FST_OK ? fst_solution_correct(family, s, NULL, error) : status;
}

/* The omega between two neighbours on a branch at which N is reached, by the Illinois rule. */
static fst_status locate(const fst_family *family, const fst_branch_point *a, const fst_branch_point *b,
                         double target, fst_solution *s, fst_error *error)
{
    fst_bracket z = {a->value, b->value, a->festoons - target, b->festoons - target, 0};
    fst_status status = solution_at(family, a, s, error);
    for (int i = 0; i < 60 && status == FST_OK; ++i) {
        const double x = i % 6 == 5 ? 0.5 * (z.lo + z.hi) : fst_bracket_next(&z);
        if (fabs(x - s->value) < 1e-13)
            break;
        /* Move from the last one in steps small enough for Newton's method. */
        const int pieces = 1 + (int)(fabs(x - s->value) / 0.01);
        const double from = s->value;
        for (int k = 1; k <= pieces && status == FST_OK; ++k) {
            fst_direction step = s->tangent;
            const double length = (from + (x - from) * k / pieces - s->value) / step.value;
            fst_solution_move(s, &step, length);
            s->value = from + (x - from) * k / pieces;
            status = fst_solution_correct(family, s, NULL, error);
        }
        const double f = festoons_of(s) - target;
        if (status != FST_OK || fabs(f) < 1e-13 * target)
            break;
        fst_bracket_take(&z, x, f);
    }
    return status;
}

static fst_status add(fst_festoon_list *list, const fst_orbit *orbit, fst_error *error)
{
    fst_orbit *orbits = realloc(list->orbits, (list->count + 1) * sizeof *orbits);
    if (orbits)
        list->orbits = orbits;
    double *omegas = realloc(list->omegas, (list->count + 1) * sizeof *omegas);
    if (omegas)
        list->omegas = omegas;
    if (!orbits || !omegas)
        return fst_fail(error, FST_NO_MEMORY, "festoons", "out of memory");
    size_t place = list->count;
    while (place > 0 && list->omegas[place - 1] > orbit->means.omega)
        --place;
    memmove(list->orbits + place + 1, list->orbits + place, (list->count - place) * sizeof *orbits);
    memmove(list->omegas + place + 1, list->omegas + place, (list->count - place) * sizeof *omegas);
    list->orbits[place] = *orbit;
    list->omegas[place] = orbit->means.omega;
    list->count += 1;
    return FST_OK;
}

/* Note the reach of the stable branch, and find N between its neighbouring points a and b. */
static fst_status look_between(const fst_family *family, const fst_branch_point *a, const fst_branch_point *b,
                               double target, fst_festoon_list *list, fst_error *error)
{
    if (a->stable && a->turns < 0) {
        list->least = fmin(list->least, a->festoons);
        list->greatest = fmax(list->greatest, a->festoons);
        list->from = fmin(list->from, a->value);
        list->to = fmax(list->to, a->value);
    }
    if (a->branch != b->branch || !(a->stable || b->stable) || a->turns >= 0 || b->turns >= 0 ||
        (a->festoons < target) == (b->festoons < target))
        return FST_OK;
    fst_solution s;
    fst_orbit orbit;
    fst_error ignored;
    if (locate(family, a, b, target, &s, &ignored) != FST_OK ||
        fst_orbit_from_solution(family, &s, &orbit, &ignored) != FST_OK || !orbit.stable)
        return FST_OK;
    return add(list, &orbit, error);
}

fst_status fst_festoons_find(const fst_params *params, double festoons, fst_festoon_list *list,
                             fst_error *error)
{
    memset(list, 0, sizeof *list);
    if (!(festoons > 1) || !(festoons < 1e6))
        return fst_fail(error, FST_BAD_INPUT, "festoons", "%g festoons: give a number above 1", festoons);
    fst_family family;
    fst_branch branch;
    fst_branch_options o = fst_default_branch_options();
    o.from = 0.02;
    o.to = 10.0;
    fst_status status = fst_branch_follow(params, &o, &branch, error);
    if (status != FST_OK)
        return status;
    status = fst_family_begin(&family, params, "drive.omega", error);
    list->least = list->from = INFINITY;
    list->greatest = list->to = -INFINITY;
    for (size_t i = 0; i + 1 < branch.point_count && status == FST_OK; ++i)
        status = look_between(&family, &branch.points[i], &branch.points[i + 1], festoons, list, error);
    for (size_t i = 0; i < branch.special_count; ++i) { /* where the turning begins, and where it ends */
        if (branch.specials[i].type == FST_SPECIAL_ORIGIN_CROSSING && branch.specials[i].at.stable)
            list->from = fmin(list->from, branch.specials[i].value);
        if (branch.specials[i].type == FST_SPECIAL_FOLD && branch.specials[i].at.mean_r > 1.0)
            list->to = fmax(list->to, branch.specials[i].value);
    }
    fst_branch_free(&branch);
    if (status == FST_OK && list->count == 0)
        status = fst_fail(
            error, FST_NO_CONVERGENCE, "festoons",
            "no stable pattern closes after %.10g festoons: the stable counter-rotating branch reaches "
            "from omega = %.8g to %.8g, and N from %.6g to %.6g on it",
            festoons, list->from, list->to, list->least, list->greatest);
    if (status != FST_OK)
        fst_festoons_free(list);
    return status;
}

void fst_festoons_free(fst_festoon_list *list)
{
    free(list->omegas);
    free(list->orbits);
    memset(list, 0, sizeof *list);
}
