/* levitation.c - where a bead floats without a plate, beside a turning magnet.
 *
 * The field on the axis has a part that turns, B_h, and one that stands, B_z.  A bead on the axis with n = +-e_z is
 * driven by the torque n x B_h and by the force F_h, both at the drive's rate w, which is faster than it can follow; it
 * answers in antiphase, as the pendulum of Kapitza does:
 *
 *     n_h = -mu B_h/(I w^2),      x_h = -F_h/(m w^2)
 *
 * With the tilt and the place of this answer the force along the axis has a mean beside that of B_z: away from the
 * magnet, because like poles face each other.  The list of equilibria begins at the heights where it vanishes with the
 * weight.  For two dipoles that is the formula of docs/levitation.md; here the field and the force are the engine's own.
 *
 *     way from        . . . . . .|. . . + . . x . . . - . . . .     x: bisected; then Newton's method in all twelve
 *     the magnet                 touching                          numbers (beads_lock.c)
 */
#include "orbit/levitation.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/constants.h"
#include "base/error.h"
#include "base/watch.h"
#include "beads/setup.h"
#include "model/worlds.h"

enum { HEIGHTS = 160, BISECTIONS = 24 };
static const double SAME = 1e-6, STEEPEST = 0.7; /* greatest n_h of an answer, the sine of a tilt */

/* The answer at the height z on the axis, with n about `up` times e_z. */
static void answer(const beads_world *world, double z, double up, double *state)
{
    const beads_body *body = &world->body[0];
    const double w = world->omega, w2 = w * w;
    const beads_modes modes = {.gone = {0}};
    beads_look look;
    fst_gradient_double unused;
    double b[3];
    memset(state, 0, BEADS_NUMBERS * sizeof *state);
    state[2] = z;
    state[BEADS_N + 2] = up;
    world->field(world->source, 0.0, 0.0, z, b, &unused);
    beads_look_at(world, &modes, state, &look);
    double *n = state + BEADS_N, tilt = 0.0;
    for (int k = 0; k < 2; ++k) {
        state[k] = -look.force[0][k] / (beads_moved_mass(body) * w2);
        n[k] = -body->strength * b[k] / (body->inertia * w2);
        tilt += n[k] * n[k];
    }
    const double cut = tilt > STEEPEST * STEEPEST ? STEEPEST / sqrt(tilt) : 1.0;
    n[0] *= cut;
    n[1] *= cut;
    n[2] = up * sqrt(1.0 - cut * cut * tilt);
    state[BEADS_V] = -w * state[1];
    state[BEADS_V + 1] = w * state[0];
    for (int k = 0; k < 3; ++k) /* no spin about n */
        state[BEADS_W + k] = w * ((k == 2) - n[2] * n[k]);
}

/* The mean force along the axis with the answer at z. */
static double lift(const beads_world *world, double z, double up, double *state)
{
    const beads_modes modes = {.gone = {0}};
    beads_look look;
    answer(world, z, up, state);
    beads_look_at(world, &modes, state, &look);
    return look.force[0][2];
}

/* ------------------------------------------------------------------ what is told */

void levitation_describe(const beads_world *world, const fst_groups *g, const beads_lock *lock,
                         fst_levitation *out)
{
    const double mm = 1e3 * g->length_unit, *x = lock->state, *n = x + BEADS_N;
    memset(out, 0, sizeof *out);
    memcpy(out->state, x, sizeof out->state);
    for (int k = 0; k < 3; ++k) {
        out->position_m[k] = x[k] * g->length_unit;
        out->w_per_s[k] = x[BEADS_W + k] / g->time_unit;
    }
    out->height_mm = fabs(x[2]) * mm;
    out->circle_mm = hypot(x[0], x[1]) * mm;
    out->tilt_deg = atan2(hypot(n[0], n[1]), fabs(n[2])) * 360.0 / FST_TWO_PI;
    out->gap_mm = (world->clearance(world->source, x[0], x[1], x[2]) - world->body[0].radius) * mm;
    out->family = !(world->body[0].spin_drag > 0);
    out->residual = lock->residual;
    out->unstable = lock->unstable;
    out->stable = lock->unstable == 0;
    for (int i = 0; i < FST_LEVITATION_DIRECTIONS; ++i) {
        out->eigenvalue_re[i] = lock->re[i] / g->time_unit;
        out->eigenvalue_im[i] = lock->im[i] / g->time_unit;
    }
}

fst_status levitation_world(const fst_params *params, fst_model **model, beads_world *world, fst_error *error)
{
    const fst_beads_options options = fst_default_beads_options();
    double state[FST_BEAD_NUMBERS];
    *model = NULL;
    if (params->plate_shape != FST_PLATE_NONE)
        return fst_fail(error, FST_BAD_INPUT, "plate.shape",
                        "a bead levitates without a plate: choose plate.shape none");
    const char *still = fst_key_of_surroundings(params);
    if (still)
        return fst_fail(
            error, FST_BAD_INPUT, still,
            "a place where a bead turns with the magnet needs a magnet that turns steadily and alone, not %s",
            still);
    fst_params placed = *params; /* the start plays no part */
    const double far = 0.5 * params->plate_radius, place[3] = {far, 0.0, far}, up[3] = {0.0, 0.0, 1.0};
    memcpy(placed.start_position, place, sizeof place);
    memcpy(placed.start_n, up, sizeof up);
    return beads_set_up(&placed, 1, &options, model, world, state, error);
}

/* ------------------------------------------------------------------ the search */

typedef struct search {
    const fst_lapack *lapack;
    beads_world world;
    fst_groups groups;
    beads_lock lock;
    fst_levitation_list *list;
} search;

static int is_known(const search *s, const fst_levitation *found)
{
    for (size_t i = 0; i < s->list->count; ++i) {
        double greatest = 0.0;
        for (int k = 0; k < FST_BEAD_NUMBERS; ++k)
            if (k < BEADS_V || (k >= BEADS_N && k < BEADS_W))
                greatest = fmax(greatest, fabs(s->list->states[i].state[k] - found->state[k]));
        if (greatest < SAME)
            return 1;
    }
    return 0;
}

/* Newton's method from the answer at z; what it finds beside the magnet is kept. */
static fst_status try_from(search *s, double z, double up, fst_error *error)
{
    fst_levitation found;
    fst_error why;
    memset(&s->lock, 0, sizeof s->lock);
    (void)lift(&s->world, z, up, s->lock.state);
    const fst_status status = beads_lock_correct(s->lapack, NULL, &s->world, &s->lock, &why);
    if (status == FST_NO_MEMORY)
        return fst_fail(error, status, "locked", "out of memory");
    int what;
    if (status != FST_OK || !(beads_way_out(&s->world, 0, s->lock.state, &what) > 0))
        return FST_OK;
    levitation_describe(&s->world, &s->groups, &s->lock, &found);
    if (is_known(s, &found))
        return FST_OK;
    fst_levitation *longer = realloc(s->list->states, (s->list->count + 1) * sizeof *longer);
    if (!longer)
        return fst_fail(error, FST_NO_MEMORY, "locked", "out of memory");
    s->list->states = longer;
    longer[s->list->count++] = found;
    return FST_OK;
}

/* The heights on one side of the magnet, from touching it to plate.radius, in steps that grow. */
static fst_status search_side(search *s, double side, double up, fst_error *error)
{
    double near = 0.0, state[BEADS_NUMBERS], before = NAN, low = NAN;
    const double radius = s->world.body[0].radius, far = s->world.plate_radius;
    for (int i = 0; i <= 400; ++i) /* the last height at which it touches */
        if (s->world.clearance(s->world.source, 0.0, 0.0, side * far * i / 400) <= radius)
            near = far * i / 400;
    near = fmax(near, 1e-3 * far);
    fst_status status = FST_OK;
    for (int i = 0; i <= HEIGHTS && status == FST_OK; ++i) {
        const double z = side * near * pow(far / near, (double)i / HEIGHTS);
        const double here = lift(&s->world, z, up, state);
        if (here * before < 0) {
            double a = low, b = z;
            for (int k = 0; k < BISECTIONS; ++k) {
                const double middle = 0.5 * (a + b);
                *(lift(&s->world, middle, up, state) * before > 0 ? &a : &b) = middle;
            }
            status = try_from(s, 0.5 * (a + b), up, error);
        }
        before = here;
        low = z;
    }
    return status;
}

static int by_stability(const void *a, const void *b)
{
    const fst_levitation *x = a, *y = b;
    if (x->unstable != y->unstable)
        return x->unstable - y->unstable;
    return (x->height_mm > y->height_mm) - (x->height_mm < y->height_mm);
}

fst_status fst_levitation_find(const fst_params *params, const fst_progress *progress,
                               fst_levitation_list *list, fst_error *error)
{
    fst_model *model = NULL;
    memset(list, 0, sizeof *list);
    search *s = calloc(1, sizeof *s);
    if (!s)
        return fst_fail(error, FST_NO_MEMORY, "locked", "out of memory");
    s->list = list;
    fst_status status = fst_lapack_load(&s->lapack, error);
    if (status == FST_OK)
        status = levitation_world(params, &model, &s->world, error);
    if (status == FST_OK)
        s->groups = fst_model_groups(model);
    for (int i = 0; i < 4 && status == FST_OK; ++i) {
        status = search_side(s, i % 2 ? -1.0 : 1.0, i / 2 ? -1.0 : 1.0, error);
        if (status == FST_OK)
            status = fst_tell(progress, 0.25 * (i + 1), NULL, error);
    }
    if (status == FST_OK && list->count)
        qsort(list->states, list->count, sizeof *list->states, by_stability);
    if (status != FST_OK)
        fst_levitation_free(list);
    fst_model_free(model);
    free(s);
    return status;
}

void fst_levitation_free(fst_levitation_list *list)
{
    free(list->states);
    memset(list, 0, sizeof *list);
}

const fst_levitation *fst_levitation_best(const fst_params *params, const fst_levitation_list *list, int above)
{
    const double up = params->plate_gravity < 0 ? -1.0 : 1.0;
    const fst_levitation *best = NULL;
    for (size_t i = 0; i < list->count; ++i) {
        const fst_levitation *l = &list->states[i];
        if ((up * l->state[2] > 0) != (above != 0))
            continue;
        if (!best || (!best->stable && l->eigenvalue_re[0] < best->eigenvalue_re[0]))
            best = l;
    }
    return best;
}

fst_floating fst_levitation_word(const fst_levitation *place)
{
    if (!place || place->stable)
        return place ? FST_FLOATS_STABLY : FST_FLOATS_NOWHERE;
    for (int i = 0; i < place->unstable; ++i)
        if (place->eigenvalue_im[i] == 0.0)
            return FST_FLOATS_AWAY;
    return FST_FLOATS_OSCILLATING;
}
