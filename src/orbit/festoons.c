/* festoons.c - the patterns that close in the laboratory after a given number of festoons.
 *
 * A counter-rotating orbit of whole period T turns Phi once backwards, so <alpha'> = omega - 2 pi/T.  While the
 * bead goes once round in the laboratory, |1 - omega/<alpha'>| periods pass; each makes a festoons, a = 2 for a
 * symmetric orbit (S2) and 1 for another (S1), so N = a |1 - omega/<alpha'>|.  It is known at every point of
 * the counter-rotating branch over omega, and a wanted N is looked for between neighbouring points:
 *
 *       N |                 x  x        x: points of the branch
 *         |              x
 *  wanted |. . . . . . o                o: found by bracketing; each orbit tried is interpolated between the
 *         |          x                     neighbours and corrected by Newton's method
 *         |    x  x
 *         +---------------------- along the branch
 *
 * Runs would not do: their N is a mean with an error, and they show only the orbit that their start leads to.
 *
 * At a pitchfork a falls from 2 to 1, and N to its half, so numbers in the gap between the S2 and the S1 orbits
 * may not exist; the error then says from which N to which each part reaches.  The S1 branch begins at the
 * pitchfork, before its first point, and that piece is looked through too.  Newton's matrix is singular at the
 * pitchfork, so the located state is used there as it is.
 */
#include "orbit/node.h"
#include "orbit/search.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/bracket.h"
#include "base/constants.h"
#include "base/error.h"
#include "base/festoons.h"
#include "base/grow.h"

/* N of a counter-rotating orbit from its whole period alone. */
static double festoons_at(double omega, double period, int symmetric)
{
    const double alpha_dot = omega - FST_TWO_PI / period;
    return fst_festoons_a_lap(symmetric ? 2 : 1, omega, alpha_dot);
}

static double festoons_of(const fst_solution *s)
{
    return festoons_at(s->value, fst_whole_period(s), s->symmetric);
}

static int is_symmetric(const fst_branch_point *p)
{
    return p->symmetry == FST_SYMMETRY_S2;
}

static double festoons_at_point(const fst_branch_point *p)
{
    return festoons_at(p->value, p->period, is_symmetric(p));
}

/* A branch point as a guess at a solution of the family over omega. */
static fst_status chain_at(const fst_family *family, const fst_branch_point *p, fst_solution *s,
                           fst_error *error)
{
    memset(s, 0, sizeof *s);
    s->symmetric = is_symmetric(p);
    s->value = p->value;
    s->period = s->symmetric ? 0.5 * p->period : p->period;
    memcpy(s->y[0], p->state, sizeof s->y[0]);
    return fst_solution_chain(family, s, s->symmetric ? 1 : 2, error);
}

static void turn_tangent(const fst_family *family, fst_solution *s, const fst_direction *way)
{
    if (fst_direction_product(family, s, &s->tangent, way) < 0)
        fst_direction_scale(&s->tangent, -1.0);
}

/* The ends of a piece of the branch, with their tangents and the way between.  A point at which branches meet
 * cannot be corrected: its state is exact, and the way stands for its tangent. */
static fst_status piece_of(const fst_family *family, const fst_branch_point *from, const fst_branch_point *to,
                           int to_meeting, fst_node *a, fst_node *b, fst_error *error)
{
    fst_direction way;
    fst_status status = chain_at(family, from, &a->s, error);
    if (status == FST_OK)
        status = fst_solution_correct(family, &a->s, NULL, error);
    if (status == FST_OK)
        status = chain_at(family, to, &b->s, error);
    if (status == FST_OK && !to_meeting)
        status = fst_solution_correct(family, &b->s, NULL, error);
    if (status != FST_OK)
        return status;
    fst_direction_between(&a->s, &b->s, &way);
    b->length = sqrt(fst_direction_product(family, &a->s, &way, &way));
    if (!(b->length > 0))
        return fst_fail(error, FST_NO_CONVERGENCE, "festoons", "two points of the branch are one");
    if (to_meeting) {
        b->s.tangent = way;
        fst_direction_scale(&b->s.tangent, 1.0 / b->length);
    }
    turn_tangent(family, &a->s, &way);
    turn_tangent(family, &b->s, &way);
    return FST_OK;
}

/* The orbit between the ends of a piece that has `target` festoons. */
static fst_status locate(const fst_family *family, const fst_node *a, const fst_node *b, double target,
                         fst_solution *s, fst_error *error)
{
    fst_bracket z = {0.0, 1.0, festoons_of(&a->s) - target, festoons_of(&b->s) - target, 0};
    fst_direction way;
    fst_direction_between(&a->s, &b->s, &way);
    double f = INFINITY;
    for (int i = 0; i < 60 && fabs(f) > 1e-13 * target; ++i) {
        const double x = i % 6 == 5 ? 0.5 * (z.lo + z.hi) : fst_bracket_next(&z), before = s->value;
        fst_solution_between(a, b, x, s);
        const fst_status status = fst_solution_correct(family, s, &way, error);
        if (status != FST_OK)
            return status;
        f = festoons_of(s) - target;
        if (i > 0 && fabs(s->value - before) < 1e-14 * s->value)
            break;
        fst_bracket_take(&z, x, f);
    }
    return fabs(f) < 1e-9 * target
               ? FST_OK
               : fst_fail(error, FST_NO_CONVERGENCE, "festoons",
                          "%.10g festoons were not reached near omega = %.10g", target, s->value);
}

static fst_status add(fst_festoon_list *list, const fst_orbit *orbit, fst_error *error)
{
    if (!fst_grow(&list->orbits, list->count, sizeof *list->orbits) ||
        !fst_grow(&list->omegas, list->count, sizeof *list->omegas))
        return fst_fail(error, FST_NO_MEMORY, "festoons", "out of memory");
    for (size_t i = 0; i < list->count; ++i) /* met from both sides of a branch point */
        if (fabs(list->omegas[i] - orbit->means.omega) < 1e-11 &&
            list->orbits[i].means.symmetry == orbit->means.symmetry)
            return FST_OK;
    size_t place = list->count;
    while (place > 0 && list->omegas[place - 1] > orbit->means.omega)
        --place;
    memmove(list->orbits + place + 1, list->orbits + place, (list->count - place) * sizeof *list->orbits);
    memmove(list->omegas + place + 1, list->omegas + place, (list->count - place) * sizeof *list->omegas);
    list->orbits[place] = *orbit;
    list->omegas[place] = orbit->means.omega;
    list->count += 1;
    return FST_OK;
}

static int counter_rotates(const fst_branch_point *p)
{
    return p->stable && p->turns < 0;
}

static void note_reach(fst_festoon_list *list, const fst_branch_point *p)
{
    const int part = is_symmetric(p);
    list->least[part] = fmin(list->least[part], festoons_at_point(p));
    list->greatest[part] = fmax(list->greatest[part], festoons_at_point(p));
    list->from = fmin(list->from, p->value);
    list->to = fmax(list->to, p->value);
}

/* Find N between the neighbouring points a and b of a branch, at the second of which branches may meet. */
static fst_status look_between(const fst_family *family, const fst_branch_point *a, const fst_branch_point *b,
                               int meeting, double target, fst_festoon_list *list, fst_error *error)
{
    if (a->branch != b->branch || is_symmetric(a) != is_symmetric(b) ||
        !(counter_rotates(a) || counter_rotates(b)) ||
        (festoons_at_point(a) < target) == (festoons_at_point(b) < target))
        return FST_OK;
    fst_node from, to;
    fst_solution s;
    fst_orbit orbit;
    fst_status status = piece_of(family, a, b, meeting, &from, &to, error);
    if (status == FST_OK)
        status = locate(family, &from, &to, target, &s, error);
    if (status == FST_OK)
        status = fst_orbit_from_solution(family, &s, &orbit, error);
    return status == FST_OK && orbit.stable && orbit.means.regime == FST_REGIME_COUNTER_ROTATING
               ? add(list, &orbit, error)
               : status;
}

/* The counter-rotating orbit on a branch that is nearest to a special point. */
static const fst_branch_point *nearest_to(const fst_branch *branch, int number, const fst_branch_point *at)
{
    const fst_branch_point *best = NULL;
    double least = 0.1; /* a special point of unstable orbits has none beside it */
    for (size_t i = 0; i < branch->point_count; ++i) {
        const fst_branch_point *p = &branch->points[i];
        const double distance = fabs(p->value - at->value) + fabs(p->mean_r - at->mean_r);
        if (p->branch == number && counter_rotates(p) && distance < least)
            best = p, least = distance;
    }
    return best;
}

/* The stable orbits end at special points, beyond the last one that was followed: through a fold and through
 * r = 0 the branch goes on, where a symmetric orbit splits, the S1 branch begins. */
static fst_status look_beside(const fst_family *family, const fst_branch *branch, const fst_special *special,
                              double target, fst_festoon_list *list, fst_error *error)
{
    const int splits =
        special->type == FST_SPECIAL_PITCHFORK && special->born >= 0 && special->at.symmetry == FST_SYMMETRY_S2;
    if (!splits && special->type != FST_SPECIAL_FOLD && special->type != FST_SPECIAL_ORIGIN_CROSSING)
        return FST_OK;
    fst_branch_point end = special->at;
    if (nearest_to(branch, special->branch, &end))
        note_reach(list, &end);
    const fst_branch_point *born = splits ? nearest_to(branch, special->born, &end) : NULL;
    if (!born)
        return FST_OK;
    end.branch = special->born;
    end.symmetry = born->symmetry;
    note_reach(list, &end);
    return look_between(family, born, &end, 1, target, list, error);
}

/* The branch has a gap in N: where the period halves, N doubles. */
static fst_status none_closes(const fst_festoon_list *list, double festoons, fst_error *error)
{
    static const fst_symmetry symmetries[2] = {FST_SYMMETRY_S1, FST_SYMMETRY_S2};
    char reach[2][80] = {"", ""};
    for (int part = 0; part < 2; ++part)
        if (list->least[part] <= list->greatest[part])
            (void)snprintf(reach[part], sizeof reach[part], "; N is from %.6g to %.6g on its %s orbits",
                           list->least[part], list->greatest[part], fst_symmetry_name(symmetries[part]));
    return fst_fail(error, FST_NO_CONVERGENCE, "festoons",
                    "no stable pattern closes after %.10g festoons: the stable counter-rotating branch reaches "
                    "from omega = %.8g to %.8g%s%s",
                    festoons, list->from, list->to, reach[0], reach[1]);
}

static fst_status check_number(double festoons, fst_error *error)
{
    return festoons > 1 && festoons < 1e6
               ? FST_OK
               : fst_fail(error, FST_BAD_INPUT, "fst_festoons_find.festoons",
                          "%g: the number of festoons must be greater than 1 and less than 1e6", festoons);
}

static fst_status festoons_on(const fst_params *params, const fst_branch *branch, double festoons,
                              fst_watch *watch, fst_festoon_list *list, fst_error *error)
{
    memset(list, 0, sizeof *list);
    fst_status status = check_number(festoons, error);
    if (status != FST_OK)
        return status;
    if (branch->kind != FST_BRANCH_COUNTER || strcmp(branch->key, "drive.omega") != 0 || branch->second_key[0])
        return fst_fail(error, FST_BAD_INPUT, "festoons",
                        "the branch is not one of counter-rotation over drive.omega");
    fst_family family;
    status = fst_family_begin(&family, params, "drive.omega", error);
    family.watch = watch;
    list->least[0] = list->least[1] = list->from = INFINITY;
    list->greatest[0] = list->greatest[1] = list->to = -INFINITY;
    for (size_t i = 0; i < branch->point_count; ++i)
        if (counter_rotates(&branch->points[i]))
            note_reach(list, &branch->points[i]);
    for (size_t i = 0; i + 1 < branch->point_count && status == FST_OK; ++i) {
        fst_watch_reach(watch, (double)i / (double)branch->point_count);
        status = look_between(&family, &branch->points[i], &branch->points[i + 1], 0, festoons, list, error);
    }
    for (size_t i = 0; i < branch->special_count && status == FST_OK; ++i)
        status = look_beside(&family, branch, &branch->specials[i], festoons, list, error);
    if (status == FST_OK && list->count == 0)
        status = none_closes(list, festoons, error);
    if (status != FST_OK)
        fst_festoons_free(list);
    return status;
}

fst_status fst_festoons_on(const fst_params *params, const fst_branch *branch, double festoons,
                           const fst_progress *progress, fst_festoon_list *list, fst_error *error)
{
    fst_watch watch;
    fst_watch_begin(&watch, progress);
    return festoons_on(params, branch, festoons, &watch, list, error);
}

fst_status fst_festoons_find(const fst_params *params, double festoons, const fst_progress *progress,
                             fst_festoon_list *list, fst_error *error)
{
    memset(list, 0, sizeof *list);
    fst_status status = check_number(festoons, error); /* before any work is done */
    if (status != FST_OK)
        return status;
    fst_branch branch;
    fst_branch_options o = fst_default_branch_options();
    o.from = 0.02;
    o.to = 10.0;
    fst_part following = {progress, 0.0, 0.9, NULL}; /* the branch takes nearly all of the time */
    const fst_progress to_caller = {&following, fst_part_tell};
    o.progress = progress ? &to_caller : NULL;
    fst_watch watch;
    fst_watch_begin(&watch, progress);
    fst_watch_part(&watch, following.to, 1.0);
    status = fst_branch_follow(params, &o, &branch, error);
    if (status == FST_OK)
        status = festoons_on(params, &branch, festoons, &watch, list, error);
    fst_branch_free(&branch);
    return status;
}

void fst_festoons_free(fst_festoon_list *list)
{
    free(list->omegas);
    free(list->orbits);
    memset(list, 0, sizeof *list);
}
