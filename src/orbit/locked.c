/* locked.c - every equilibrium: the bead goes round with the magnet.
 *
 * In the turning frame a locked bead is a zero of nine equations.  Nothing says how many there are; they are
 * looked for by Newton's method from many starts, which a Halton sequence spreads evenly.  A start already
 * obeys what follows from rest:
 *
 *      place (X, Y)      in a disc, more densely near the axis
 *      v, W              follow: v = omega e x x, and W = omega e + c n, so that n stands still
 *      n                 a third anywhere, a third in the plane of e_r and e_z, where the contact can roll
 *                        without slip, and a third there at the angle that belongs to a spin from 1 to 1000
 *      c                 so that the contact slips least
 *
 * Each state that is found gives a further start, its image under S2.  States whose numbers agree to 1e-6 are
 * one, and how many starts led to it is reported.
 *
 * A sign of completeness is the index, the sum of the signs of det(-J): states appear and vanish in pairs of
 * opposite sign, so the sum stays the same unless a state comes from far away (docs/inside/orbits.md).
 *
 * To follow them over a parameter they are searched at several values, more closely spaced at the low end, and
 * a state is skipped if a branch already passes through it.
 */
#include "orbit/tracer.h"

#include <stdlib.h>
#include <string.h>

#include "base/constants.h"
#include "base/error.h"
#include "orbit/branch_list.h"
#include "orbit/rolling_lock.h"

enum { STARTS = 3000, MOST = 256 };

/* Element `index` of the van der Corput sequence in base `base`. */
static double radical_inverse(int index, int base)
{
    double value = 0.0, digit = 1.0 / base;
    for (; index > 0; index /= base, digit /= base)
        value += digit * (index % base);
    return value;
}

/* A start of Newton's method.  The contact can hardly slip where the field is weak, and rolls without slip only
 * if n lies in the plane of e_r and e_z, with c n_r = -omega r/eps; families end with their spin growing
 * without bound. */
static void start_at(const fst_setup *setup, int index, double y[FST_STATE_SIZE])
{
    const double omega = setup->model.groups.omega;
    const double eps = setup->model.groups.eps, choice = radical_inverse(index, 7);
    const double u = radical_inverse(index, 2), angle = FST_TWO_PI * radical_inverse(index, 3);
    const double r = (index % 3 == 2 ? 0.4 : 1.0) * FST_LARGEST_RADIUS * (u * u);
    double nz = 2.0 * radical_inverse(index, 5) - 1.0, across = sqrt(1.0 - nz * nz), turn = FST_TWO_PI * choice;
    if (index % 3 != 0)
        turn = angle + (choice < 0.5 ? 0.0 : 0.5 * FST_TWO_PI);
    if (index % 3 == 2) {
        const double spin = exp(6.9 * fabs(nz));
        across = fmin(0.99, omega * r / (eps * spin));
        nz = copysign(sqrt(1.0 - across * across), nz);
    }
    y[FST_X] = r * cos(angle);
    y[FST_Y] = r * sin(angle);
    y[FST_VX] = -omega * y[FST_Y];
    y[FST_VY] = omega * y[FST_X];
    y[FST_NX] = across * cos(turn);
    y[FST_NY] = across * sin(turn);
    y[FST_NZ] = nz;
    /* V = v - eps W x e = v - eps c (nY, -nX): least for this c, bounded where n stands upright. */
    const double spread = eps * (across * across + (index % 3 == 2 ? 1e-12 : 0.05));
    const double c = (y[FST_VX] * y[FST_NY] - y[FST_VY] * y[FST_NX]) / spread;
    y[FST_WX] = c * y[FST_NX];
    y[FST_WY] = c * y[FST_NY];
    y[FST_WZ] = omega + c * y[FST_NZ];
}

typedef struct found_state {
    fst_solution s;
    int count;
} found_state;

typedef struct finder {
    fst_family family; /* which has the setup at `value` once, for every start asks for it */
    double value;
    double searching; /* the share of the progress that the search takes */
    found_state *found;
    int count;
} finder;

static int same(const double *a, const double *b)
{
    for (int k = 0; k < FST_STATE_SIZE; ++k)
        if (!(fabs(a[k] - b[k]) < 1e-6 * (1.0 + fabs(a[k]))))
            return 0;
    return 1;
}

static void note(finder *f, const fst_solution *s, int count)
{
    for (int i = 0; i < f->count; ++i)
        if (same(f->found[i].s.y[0], s->y[0])) {
            f->found[i].count += count;
            return;
        }
    if (f->count < MOST)
        f->found[f->count++] = (found_state){*s, count};
}

/* Whether the field is known there, and whether the bead touches the plate, as dry friction must know: without
 * a load it would act no more, and such states form continua. */
static int is_possible(const finder *f, const fst_solution *s)
{
    fst_setup setup;
    fst_error ignored;
    fst_pull_double pull;
    if (fst_family_setup(&f->family, s->value, &setup, &ignored) != FST_OK)
        return 0;
    const fst_world_double *c = &setup.model.world;
    if (hypot(s->y[0][FST_X], s->y[0][FST_Y]) > setup.model.groups.map_radius)
        return 0;
    fst_pull_at_double(c, s->y[0], c->height, &pull);
    return !c->kinds.dry || fst_load_double(c, pull.force) > 0.0;
}

/* Damped Newton iterations on the equations of rest; 1 if they end at an equilibrium. */
static int settle(finder *f, fst_solution *s)
{
    fst_error ignored;
    return fst_solution_correct(&f->family, s, NULL, &ignored) == FST_OK &&
           hypot(s->y[0][FST_X], s->y[0][FST_Y]) < 4.0 * FST_LARGEST_RADIUS && is_possible(f, s);
}

/* Every start, every state's image under S2 as well. */
static fst_status try_starts(finder *f, int starts, fst_error *error)
{
    fst_setup setup;
    fst_status status = fst_family_setup(&f->family, f->value, &setup, error);
    f->family.made = &setup;
    f->family.made_at = f->value;
    for (int i = 1; i <= starts && status == FST_OK; ++i) {
        fst_solution s;
        fst_watch_reach(f->family.watch, f->searching * i / starts);
        status = fst_watch_count(f->family.watch, 0, error);
        memset(&s, 0, sizeof s);
        s.value = f->value;
        start_at(&setup, i, s.y[0]);
        if (!settle(f, &s))
            continue;
        fst_solution image = s;
        fst_apply_s2(s.y[0], image.y[0]);
        note(f, &s, 1);
        if (settle(f, &image))
            note(f, &image, 0);
    }
    f->family.made = NULL;
    return status == FST_OK ? fst_watch_count(f->family.watch, 0, error) : status;
}

static fst_status find_all(const fst_family *family, double value, int starts, double searching, finder *f,
                           fst_error *error)
{
    memset(f, 0, sizeof *f);
    f->searching = searching;
    f->family = *family;
    f->value = value;
    f->found = calloc(MOST, sizeof *f->found);
    if (!f->found)
        return fst_fail(error, FST_NO_MEMORY, "locked", "out of memory");
    return try_starts(f, starts, error);
}

/* Stable ones first, then from the axis outwards. */
static int before(const void *left, const void *right)
{
    const fst_locked *a = left, *b = right;
    if (a->stable != b->stable)
        return b->stable - a->stable;
    if (fabs(a->r - b->r) > 1e-9)
        return a->r < b->r ? -1 : 1;
    return (a->state[FST_X] < b->state[FST_X]) - (a->state[FST_X] > b->state[FST_X]);
}

static fst_status fill(const fst_family *family, found_state *found, fst_locked *out, int *sign,
                       fst_error *error)
{
    fst_setup setup;
    fst_status status = fst_solution_spectrum(family, &found->s, error);
    if (status == FST_OK)
        status = fst_family_setup(family, found->s.value, &setup, error);
    if (status != FST_OK)
        return status;
    const fst_observation o = fst_observe(&setup.model, found->s.y[0]);
    memcpy(out->state, found->s.y[0], sizeof out->state);
    out->r = o.r;
    out->bead_angle_deg = o.r > 1e-9 ? atan2(o.sin_bead_angle, o.cos_bead_angle) * FST_DEGREES : NAN;
    out->slip = o.slip_norm;
    out->friction_power = o.friction_power;
    memcpy(out->eigenvalue_re, found->s.re, sizeof out->eigenvalue_re);
    memcpy(out->eigenvalue_im, found->s.im, sizeof out->eigenvalue_im);
    out->stable = fst_solution_is_stable(&found->s);
    out->residual = found->s.residual;
    out->found = found->count;
    *sign = 1;
    for (int i = 0; i < FST_EIGENVALUE_COUNT; ++i)
        if (found->s.im[i] == 0.0 && found->s.re[i] > 0)
            *sign = -*sign;
    return FST_OK;
}

fst_status fst_locked_find(const fst_params *params, const fst_progress *progress, fst_locked_list *list,
                           fst_error *error)
{
    memset(list, 0, sizeof *list);
    fst_family family;
    finder f = {.found = NULL};
    fst_watch watch;
    fst_watch_begin(&watch, progress);
    fst_status status = fst_family_begin(&family, params, NULL, error);
    family.watch = &watch;
    if (status == FST_OK)
        status = find_all(&family, 0.0, STARTS, 0.95, &f, error);
    if (status == FST_OK && !(list->states = calloc((size_t)f.count + 1, sizeof *list->states)))
        status = fst_fail(error, FST_NO_MEMORY, "locked", "out of memory");
    for (int i = 0; i < f.count && status == FST_OK; ++i) {
        int sign = 0;
        status = fill(&family, &f.found[i], &list->states[i], &sign, error);
        list->index_sum += sign;
    }
    free(f.found);
    fst_setup setup;
    if (status == FST_OK)
        status = fst_family_setup(&family, 0.0, &setup, error);
    if (status == FST_OK)
        status = fst_rolling_locks_find(&setup, list, error);
    if (status != FST_OK) {
        fst_locked_free(list);
        return status;
    }
    list->count = (size_t)f.count;
    list->starts = STARTS;
    list->truncated = f.count == MOST;
    if (list->count > 0)
        qsort(list->states, list->count, sizeof *list->states, before);
    return FST_OK;
}

void fst_locked_free(fst_locked_list *list)
{
    free(list->states);
    free(list->families);
    memset(list, 0, sizeof *list);
}

fst_status fst_follow_locked(fst_tracer *t, fst_error *error)
{
    enum { SLICES = 12, FEWER_STARTS = 900 };
    const double lo = fmin(t->options->from, t->options->to), hi = fmax(t->options->from, t->options->to);
    const double whole = t->watch.share[1], first = 0.75; /* most branches are met in the first slice */
    fst_status status = FST_OK;
    for (int slice = 0; slice < SLICES && status == FST_OK; ++slice) {
        finder f;
        const double part = (slice + 0.5) / SLICES; /* most states live at the low end of omega */
        const double begin = slice ? whole * (first + (1.0 - first) * (slice - 1) / (SLICES - 1)) : 0.0;
        fst_watch_part(&t->watch, begin, whole * (first + (1.0 - first) * slice / (SLICES - 1)));
        status = fst_watch_ask(&t->watch, error);
        if (status != FST_OK)
            break;
        status = find_all(&t->family, lo + (hi - lo) * (part * part), FEWER_STARTS, 0.0, &f, error);
        for (int i = 0; i < f.count && status == FST_OK; ++i) {
            fst_node node;
            fst_solution s = f.found[i].s;
            fst_error ignored;
            if (fst_solution_correct(&t->family, &s, NULL, &ignored) != FST_OK ||
                fst_node_make(&t->family, &s, &node, &ignored) != FST_OK ||
                fst_branch_of_state(t->out, node.seen.value, node.seen.state) >= 0) {
                status = fst_watch_ask(&t->watch, error);
                continue;
            }
            status = fst_tracer_add(t, &node, error);
            if (status == FST_OK)
                status = fst_tracer_run(t, error);
        }
        free(f.found);
    }
    return status;
}
