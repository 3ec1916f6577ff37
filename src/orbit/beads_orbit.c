/* beads_orbit.c - the periodic orbit to which a start of several beads leads.
 *
 * The motion is simulated, and after 5, 10, 20 ... turns of the drive Newton's method is tried from where it is.  The
 * guess of the period is the time between passages of bead 0 through X = 0, which lie half a turn of Phi apart.  Two
 * equal beads may change places in that time, and one bead may come to its image under S2; else the whole turn counts.
 */
#include <stdlib.h>
#include <string.h>

#include "base/constants.h"
#include "base/error.h"
#include "base/watch.h"
#include "orbit/beads_cycle.h"
#include "orbit/beads_scene.h"

static const double FIRST_TRY = 5.0; /* turns of the drive */
static const double RTOL = 1e-13, SEARCH_TOLERANCE = 1e-9;
static const double GAP = 0.5,
                    NEAR = 2.0; /* greatest defect of a guess, and its way to the orbit, in the units */

typedef struct search {
    beads_scene scene;
    beads_flow flow;
    double passed[3]; /* times of the latest passages */
    int passages;     /* since contacts changed last */
    int events;
    fst_error why; /* the latest try failed */
} search;

static fst_status go_on(search *s, fst_error *error)
{
    const double x = s->flow.step.y[0], t = s->flow.t.high;
    fst_status status = beads_go(&s->flow, s->scene.longest, error);
    const double at = s->flow.step.y[0];
    if (s->flow.event_count != s->events || s->events == FST_BEADS_EVENTS)
        s->passages = 0;
    s->events = s->flow.event_count;
    if (x * at < 0) {
        memmove(s->passed + 1, s->passed, 2 * sizeof *s->passed);
        s->passed[0] = t + (s->flow.t.high - t) * x / (x - at);
        ++s->passages;
    }
    if (status == FST_OK)
        status = fst_tell(s->scene.progress, fmin(s->flow.t.high / s->scene.longest, 1.0), NULL, error);
    return status;
}

/* How far the place of each bead is from that of another state, at most, in radii. */
static double apart(const beads_world *world, const double *a, const double *b)
{
    double greatest = 0.0;
    for (int i = 0; i < FST_BEAD_NUMBERS * world->count; ++i)
        if (i % FST_BEAD_NUMBERS < BEADS_V)
            greatest = fmax(greatest, fabs(a[i] - b[i]) / world->body[i / FST_BEAD_NUMBERS].radius);
    return greatest;
}

static fst_status try_closing(search *s, beads_closing closing, double period, beads_cycle *cycle)
{
    memset(cycle, 0, sizeof *cycle);
    cycle->closing = closing;
    cycle->period = period;
    cycle->modes = s->flow.modes;
    memcpy(cycle->state, s->flow.step.y, (size_t)(FST_BEAD_NUMBERS * s->scene.world.count) * sizeof(double));
    const fst_status status = beads_cycle_correct(s->scene.lapack, &s->scene.world, RTOL, GAP, cycle, &s->why);
    const int near = status == FST_OK && fabs(cycle->period / period - 1.0) < 0.2 &&
                     apart(&s->scene.world, cycle->state, s->flow.step.y) < NEAR;
    return status == FST_OK && !near ? FST_NO_CONVERGENCE : status;
}

static int are_equal(const beads_world *world)
{
    return world->count == 2 && memcmp(&world->body[0], &world->body[1], sizeof world->body[0]) == 0;
}

/* The orbits that may close here, the most symmetric first.  Where memory runs out the others are not tried. */
static fst_status try_newton(search *s, beads_cycle *cycle)
{
    const struct {
        beads_closing closing;
        int may, passages;
    } ways[] = {{BEADS_EXCHANGES, are_equal(&s->scene.world), 1},
                {BEADS_IMAGES, s->scene.world.count == 1 && s->scene.model->has_s2, 1},
                {BEADS_CLOSES, 1, 2}};
    fst_status status = fst_fail(
        &s->why, FST_NO_CONVERGENCE, "orbit",
        "contacts between beads, or with the plate, keep opening and closing, or bead 1 does not turn");
    for (int i = 0; i < 3 && s->passages >= 3 && status != FST_OK && status != FST_NO_MEMORY; ++i)
        if (ways[i].may)
            status = try_closing(s, ways[i].closing, s->passed[0] - s->passed[ways[i].passages], cycle);
    return status;
}

static fst_status find(search *s, beads_cycle *cycle, fst_error *error)
{
    fst_status status = beads_begin(&s->flow, &s->scene.world, s->scene.state, SEARCH_TOLERANCE, error);
    const double turn = FST_TWO_PI / fabs(s->scene.world.omega);
    for (double next = FIRST_TRY * turn; status == FST_OK;) {
        const int last = s->flow.t.high >= s->scene.longest;
        if (last || s->flow.t.high >= next) {
            const fst_status found = try_newton(s, cycle);
            if (found == FST_OK)
                break;
            if (found == FST_NO_MEMORY)
                return fst_fail(error, found, "orbit", "out of memory");
            next = 2.0 * s->flow.t.high;
        }
        status = last ? fst_fail(error, FST_NO_CONVERGENCE, "orbit",
                                 "from this start the beads come to no periodic orbit within run.periods: %s",
                                 s->why.sentence)
                      : go_on(s, error);
    }
    return status;
}

static void tell(const beads_world *world, const beads_cycle *c, fst_beads_orbit *orbit)
{
    const int halves = c->closing == BEADS_CLOSES ? 1 : 2;
    orbit->count = world->count;
    orbit->exchanges = c->closing == BEADS_EXCHANGES;
    orbit->symmetry = c->closing == BEADS_IMAGES ? FST_SYMMETRY_S2 : FST_SYMMETRY_NONE;
    orbit->period = halves * c->period;
    orbit->omega = world->omega;
    beads_tell_state(world, c->state, orbit->state);
    for (int i = 0; i < world->count; ++i) {
        const int other = orbit->exchanges ? 1 - i : i; /* whose second half is this one's */
        orbit->mean_r[i] = 0.5 * (c->mean_r[i] + c->mean_r[other]);
        orbit->mean_alpha_dot[i] = world->omega + 0.5 * (c->turned[i] + c->turned[other]) / c->period;
    }
    orbit->drive_power = c->power[BEADS_DRIVE];
    orbit->plate_power = c->power[BEADS_PLATE];
    orbit->pair_power = c->power[BEADS_PAIR];
    orbit->multipliers = c->size;
    memcpy(orbit->multiplier_re, c->re, (size_t)c->size * sizeof *c->re);
    memcpy(orbit->multiplier_im, c->im, (size_t)c->size * sizeof *c->im);
    orbit->stable = hypot(c->re[0], c->im[0]) < 1.0;
    orbit->residual = c->residual;
    orbit->trivial_error = c->trivial_error;
}

fst_status fst_beads_orbit_find(const fst_params *beads, int count, const fst_beads_options *options,
                                fst_beads_orbit *orbit, fst_error *error)
{
    search *s = calloc(1, sizeof *s);
    beads_cycle *cycle = malloc(sizeof *cycle);
    memset(orbit, 0, sizeof *orbit);
    fst_status status = s && cycle ? beads_scene_begin(beads, count, options, &s->scene, error)
                                   : fst_fail(error, FST_NO_MEMORY, "orbit", "out of memory");
    if (status == FST_OK)
        status = find(s, cycle, error);
    if (status == FST_OK)
        tell(&s->scene.world, cycle, orbit);
    if (s)
        fst_model_free(s->scene.model);
    free(s);
    free(cycle);
    return status;
}
