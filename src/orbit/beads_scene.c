/* beads_scene.c - several beads as a caller gives them, and the locked state to which their start leads.
 *
 *     start --> simulate --> do the beads hardly move in the turning frame? --yes--> Newton --> does it attract, do its
 *                  ^                       | no                                        contacts hold, is it near?
 *                  '-----------------------+----------------------------------------------- | no          | yes
 *                                                                                             (slower next)  found
 *
 * A bead without a plate falls away from most starts, so Newton's method begins at the start itself.
 */
#include "orbit/beads_scene.h"

#include <stdlib.h>
#include <string.h>

#include "base/constants.h"
#include "base/error.h"
#include "base/watch.h"
#include "beads/setup.h"
#include "model/worlds.h"

static const double SLOW =
    0.03; /* greatest rate at which Newton's method is tried first, in the units of numbers */
static const double NEAR = 1.0; /* greatest way of a place from the motion to the locked state, in radii */
static const double SEARCH_TOLERANCE = 1e-9;

static fst_status check(const fst_params *p, int count, const fst_beads_options *options, fst_error *error)
{
    if (options->cookie != FST_BEADS_OPTIONS_COOKIE)
        return fst_fail(error, FST_BAD_INPUT, "beads",
                        "the options were never initialised: get them from fst_default_beads_options()");
    if (count < 1 || count > FST_BEADS_MOST)
        return fst_fail(error, FST_BAD_INPUT, "beads",
                        "%d beads: locked states, orbits and branches are sought for 1 to %d", count,
                        FST_BEADS_MOST);
    const char *still = fst_key_of_surroundings(p);
    if (still)
        return fst_fail(error, FST_BAD_INPUT, still,
                        "locked states, orbits and branches of beads need a magnet that turns steadily "
                        "and alone over a level plate, not %s",
                        still);
    if (p->friction_law != FST_FRICTION_VISCOUS && p->friction_law != FST_FRICTION_NONE)
        return fst_fail(
            error, FST_BAD_INPUT, "friction.law",
            "locked states, orbits and branches of several beads are sought with viscous friction or "
            "none: friction.law must be viscous or none");
    return FST_OK;
}

fst_status beads_scene_begin(const fst_params *beads, int count, const fst_beads_options *options,
                             beads_scene *scene, fst_error *error)
{
    memset(scene, 0, sizeof *scene);
    fst_status status = check(&beads[0], count, options, error);
    if (status == FST_OK)
        status = fst_lapack_load(&scene->lapack, error);
    if (status == FST_OK)
        status = beads_set_up(beads, count, options, &scene->model, &scene->world, scene->state, error);
    scene->longest = beads[0].run_periods * FST_TWO_PI / fabs(scene->world.omega);
    scene->progress = options->progress;
    return status;
}

/* The greatest of v, each number in its unit. */
static double greatest_of(const beads_world *world, const double *v)
{
    double unit[BEADS_NUMBERS], greatest = 0.0;
    beads_units(world, unit);
    for (int i = 0; i < FST_BEAD_NUMBERS * world->count; ++i)
        greatest = fmax(greatest, fabs(v[i]) / unit[i]);
    return greatest;
}

/* Whether a contact pulls, or beads overlap that no contact keeps apart. */
static int is_impossible(const beads_world *world, const beads_lock *lock)
{
    int which;
    return beads_lock_least_force(world, lock, &which) < 0 || beads_lock_least_gap(world, lock, &which) < 0;
}

/* Newton's method from where the motion is. */
static fst_status try_newton(const beads_scene *scene, const beads_flow *flow, beads_lock *lock,
                             fst_error *error)
{
    const int floats = isnan(scene->world.plate);
    double way[BEADS_NUMBERS] = {0.0};
    const int numbers = FST_BEAD_NUMBERS * scene->world.count;
    memset(lock, 0, sizeof *lock);
    memcpy(lock->state, flow->step.y, (size_t)numbers * sizeof *way);
    lock->modes = flow->modes;
    for (int k = 0; k < scene->world.contacts; ++k)
        if (lock->modes.contact[k] == BEADS_GRAZING)
            return fst_fail(error, FST_NO_CONVERGENCE, "locked", "a contact grazes");
    const fst_status status = beads_lock_correct(scene->lapack, NULL, &scene->world, lock, error);
    for (int i = 0; i < numbers; ++i)
        way[i] = i % FST_BEAD_NUMBERS < BEADS_V ? lock->state[i] - flow->step.y[i] : 0.0;
    if (status == FST_OK && !floats && greatest_of(&scene->world, way) > NEAR)
        return fst_fail(error, FST_NO_CONVERGENCE, "locked",
                        "the state that Newton's method finds is far from the motion");
    if (status == FST_OK && is_impossible(&scene->world, lock))
        return fst_fail(error, FST_NO_CONVERGENCE, "locked",
                        "the state that Newton's method finds is impossible: a contact would have to pull, or "
                        "beads overlap");
    return status;
}

fst_status beads_scene_lock(const beads_scene *scene, beads_lock *lock, fst_error *error)
{
    beads_flow *flow = malloc(sizeof *flow);
    if (!flow)
        return fst_fail(error, FST_NO_MEMORY, "locked", "out of memory");
    fst_status status = beads_begin(flow, &scene->world, scene->state, SEARCH_TOLERANCE, error);
    double slow = SLOW;
    while (status == FST_OK) {
        const double speed = greatest_of(&scene->world, flow->step.k[0]);
        const int last = flow->t.high >= scene->longest || isnan(scene->world.plate);
        if (last || speed < slow) {
            fst_error why;
            const fst_status found = try_newton(scene, flow, lock, &why);
            if (found == FST_OK && (lock->unstable == 0 || last))
                break;
            slow = 0.3 * speed;
            if (found == FST_NO_MEMORY)
                status = fst_fail(error, found, "locked", "out of memory");
            else if (last)
                status =
                    fst_fail(error, FST_NO_CONVERGENCE, "locked",
                             "from this start the beads come to no state in which they turn with the magnet "
                             "within run.periods: %s",
                             why.sentence);
        }
        if (status == FST_OK)
            status = beads_go(flow, scene->longest, error);
        if (status == FST_OK)
            status = fst_tell(scene->progress, fmin(flow->t.high / scene->longest, 1.0), NULL, error);
    }
    free(flow);
    return status;
}

/* ------------------------------------------------------------------ what is told */

void beads_tell_state(const beads_world *world, const double *state, double told[][FST_BEAD_NUMBERS])
{
    for (int i = 0; i < world->count; ++i) {
        memcpy(told[i], state + FST_BEAD_NUMBERS * i, sizeof told[i]);
        told[i][2] += isnan(world->plate) ? 0.0 : world->body[i].radius;
    }
}

void beads_tell_lock(const beads_world *world, const beads_lock *lock, fst_beads_locked *locked)
{
    beads_look look;
    beads_look_at(world, &lock->modes, lock->state, &look);
    memset(locked, 0, sizeof *locked);
    locked->count = world->count;
    beads_tell_state(world, lock->state, locked->state);
    for (int i = 0; i < world->count; ++i) {
        const double *x = locked->state[i], r = hypot(x[0], x[1]),
                     weight = world->body[i].mass * world->gravity;
        locked->r[i] = r;
        locked->height[i] = lock->state[FST_BEAD_NUMBERS * i + 2];
        locked->phi_deg[i] = r > 1e-9 ? atan2(x[1], x[0]) * FST_DEGREES : NAN;
        locked->load_weights[i] = weight != 0 ? look.held[i] / weight : NAN;
    }
    for (int k = 0; k < world->contacts; ++k)
        if (lock->modes.contact[k] != BEADS_OPEN)
            locked->touches[locked->touch_count++] =
                (fst_bead_touch){{world->contact[k].first, world->contact[k].second}, look.held[k]};
    locked->forces_unique = look.unique;
    locked->power = look.power[BEADS_DRIVE];
    locked->omega = world->omega;
    locked->free = lock->free;
    locked->eigenvalues = lock->size;
    memcpy(locked->eigenvalue_re, lock->re, (size_t)lock->size * sizeof *lock->re);
    memcpy(locked->eigenvalue_im, lock->im, (size_t)lock->size * sizeof *lock->im);
    locked->stable = lock->unstable == 0;
    locked->residual = lock->residual;
}

fst_status fst_beads_locked_find(const fst_params *beads, int count, const fst_beads_options *options,
                                 fst_beads_locked *locked, fst_error *error)
{
    beads_scene *scene = malloc(sizeof *scene);
    beads_lock *lock = malloc(sizeof *lock);
    memset(locked, 0, sizeof *locked);
    fst_status status = scene && lock ? beads_scene_begin(beads, count, options, scene, error)
                                      : fst_fail(error, FST_NO_MEMORY, "locked", "out of memory");
    if (status == FST_OK)
        status = beads_scene_lock(scene, lock, error);
    if (status == FST_OK)
        beads_tell_lock(&scene->world, lock, locked);
    if (scene)
        fst_model_free(scene->model);
    free(scene);
    free(lock);
    return status;
}
