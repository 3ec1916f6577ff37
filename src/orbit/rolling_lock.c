/* rolling_lock.c - locked beads whose contact does not slip: families, and where they end.
 *
 * A bead that goes round with the magnet and rolls has W = omega e + psi n, and its place follows from v =
 * omega e x x = eps W x e: x = -(eps psi/omega) n_h.  What is left are the three components of W' = 0 for psi
 * and the two angles of n.  The magnets at hand have a plane of symmetry, Y = 0.  With n and x in it, two of
 * the three vanish by themselves, and one equation remains for the place X on the axis and the angle a of n,
 *
 *     g(X, a) = W_Y' = 0,      n = (sin a, 0, cos a),     psi sin a = -omega X/eps
 *
 * so that such beads form curves.  Friction decides how far they reach: |f| = mu_s N ends them, or N = 0.
 *
 *      a |        .---.                 1. zeros of g are looked for on a grid;
 *        |      .'     '.               2. from each that the contact can hold, and that no curve met before
 *        |     *         *  use = 1        passes, the curve is followed both ways by steps along its tangent;
 *        |    '.                        3. where a limit is passed, the step is cut at it.
 *        +------------------------- X
 *
 * A bead off the plane would be an isolated state; those are not looked for.  Where the plate resists rolling,
 * two of the three equations do not vanish in the plane, and there are no families.
 */
#include "orbit/rolling_lock.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/constants.h"
#include "base/error.h"
#include "base/grow.h"
#include "base/listed.h"

static const double LARGEST_PLACE = 8.0, LARGEST_SPIN = 1000.0;
static const double STEP = 0.01, NEAR = 0.03; /* along a curve; to one that was followed already */
static const double SYMMETRIC = 1e-9;         /* what may be left of the two that vanish */
enum { PLACES = 801, ANGLES = 180, MOST_STEPS = 20000, MOST_POINTS = 200000 };

typedef struct place {
    double x, a;
} place;

typedef struct tracer {
    const fst_world_double *c;
    fst_modes_double sticks; /* the modes of a contact that does */
    double holding;          /* mu_s; infinite under the law rolling */
    place *seen;             /* points of the curves that were followed */
    size_t count;
} tracer;

const char *fst_rolling_end_name(fst_rolling_end end)
{
    FST_NAME_IN(FST_ROLLING_ENDS, end, "unknown");
}

/* ------------------------------------------------------------------ one state */

static void state_at(const tracer *t, place p, double y[FST_STATE_SIZE])
{
    const double omega = t->c->omega, eps = t->c->eps, across = sin(p.a);
    const double psi = p.x == 0.0 ? 0.0 : -omega * p.x / (eps * across);
    memset(y, 0, FST_STATE_SIZE * sizeof *y);
    y[FST_X] = p.x;
    y[FST_VY] = omega * p.x;
    y[FST_NX] = across;
    y[FST_NZ] = cos(p.a);
    y[FST_WX] = -omega * p.x / eps;
    y[FST_WZ] = omega + psi * y[FST_NZ];
}

static double g_at(const tracer *t, place p)
{
    double y[FST_STATE_SIZE], rate[FST_STATE_SIZE];
    fst_pull_double pull;
    state_at(t, p, y);
    fst_rhs_double(t->c, &t->sticks, t->c->omega, y, rate, &pull);
    return rate[FST_WY];
}

/* |f|/(mu_s N), and N. */
static double use_at(const tracer *t, const double *y, double *load)
{
    fst_pull_double pull;
    double force[2];
    fst_magnetic_pull_double(t->c, &t->sticks, y, &pull);
    const fst_contact_double at = fst_contact_of_double(t->c, &t->sticks, y, &pull);
    fst_friction_double(&t->c->law, &t->c->kinds, &at, force);
    *load = at.load;
    return sqrt(force[0] * force[0] + force[1] * force[1]) / (t->holding * at.load);
}

/* How much is left until the nearest limit, negative beyond it; *end names it. */
static double room(const tracer *t, place p, fst_rolling_end *end)
{
    double y[FST_STATE_SIZE], load;
    state_at(t, p, y);
    const double use = use_at(t, y, &load);
    const double left[] = {1.0 - use, load / t->c->gravity, 1.0 - fabs(y[FST_WZ]) / LARGEST_SPIN,
                           1.0 - fabs(p.x) / LARGEST_PLACE};
    static const fst_rolling_end ends[] = {FST_ROLLING_CONE, FST_ROLLING_LIFTED, FST_ROLLING_SPIN,
                                           FST_ROLLING_RADIUS};
    int least = load > 0 ? 0 : 1; /* without a load its friction means nothing */
    for (int i = least + 1; i < 4; ++i)
        if (!(left[i] >= left[least]))
            least = i;
    *end = ends[least];
    return isfinite(left[least]) ? left[least] : -1.0;
}

/* Whether the two other equations hold: the magnet has the plane of symmetry, and nothing resists rolling. */
static int is_at_rest(const tracer *t, place p)
{
    double y[FST_STATE_SIZE], rate[FST_STATE_SIZE];
    fst_pull_double pull;
    state_at(t, p, y);
    fst_rhs_double(t->c, &t->sticks, t->c->omega, y, rate, &pull);
    return fabs(rate[FST_WX]) < SYMMETRIC && fabs(rate[FST_WZ]) < SYMMETRIC;
}

/* ------------------------------------------------------------------ along a curve */

static void gradient(const tracer *t, place p, double by[2])
{
    const double d = 1e-6;
    by[0] = (g_at(t, (place){p.x + d, p.a}) - g_at(t, (place){p.x - d, p.a})) / (2.0 * d);
    by[1] = (g_at(t, (place){p.x, p.a + d}) - g_at(t, (place){p.x, p.a - d})) / (2.0 * d);
}

/* To the nearest place of the curve; 0 where the curve has no place. */
static int correct(const tracer *t, place *p)
{
    for (int i = 0; i < 12; ++i) {
        double by[2];
        gradient(t, *p, by);
        const double square = by[0] * by[0] + by[1] * by[1], g = g_at(t, *p);
        if (!(square > 0.0) || !isfinite(g))
            return 0;
        p->x -= g * by[0] / square;
        p->a -= g * by[1] / square;
        if (fabs(g) < 1e-14 * sqrt(square) || (i > 3 && fabs(g) < 1e-13 * sqrt(square)))
            return 1;
    }
    return 0;
}

/* On from p by `length` along the tangent; `way` keeps the sense. */
static int go_on(const tracer *t, place p, double length, double way[2], place *next)
{
    double by[2];
    gradient(t, p, by);
    const double size = hypot(by[0], by[1]), sense = by[0] * way[1] - by[1] * way[0] >= 0 ? 1.0 : -1.0;
    if (!(size > 0.0))
        return 0;
    way[0] = -sense * by[1] / size;
    way[1] = sense * by[0] / size;
    *next = (place){p.x + length * way[0], p.a + length * way[1]};
    return correct(t, next) && hypot(next->x - p.x, next->a - p.a) < 2.0 * length + 1e-12;
}

static double apart(place p, place q)
{
    return hypot(p.x - q.x, remainder(p.a - q.a, FST_TWO_PI));
}

static int was_met(const tracer *t, place p)
{
    for (size_t i = 0; i < t->count; ++i)
        if (apart(p, t->seen[i]) < NEAR)
            return 1;
    return 0;
}

static void note(tracer *t, place p)
{
    if (t->count < MOST_POINTS)
        t->seen[t->count++] = p;
}

/* From p, whose room is positive, to the limit that is passed on the next step. */
static place cut(const tracer *t, place p, const double way[2], fst_rolling_end *end)
{
    double inside = 0.0, outside = STEP;
    place at = p;
    for (int i = 0; i < 60 && outside - inside > 1e-15; ++i) {
        const double middle = 0.5 * (inside + outside);
        double along[2] = {way[0], way[1]};
        fst_rolling_end which;
        place next;
        if (go_on(t, p, middle, along, &next) && room(t, next, &which) > 0.0) {
            inside = middle;
            at = next;
        } else {
            outside = middle;
        }
    }
    (void)room(t, at, end);
    return at;
}

/* One way along the curve, to its end. */
static place follow(tracer *t, place start, double sense, fst_rolling_end *end)
{
    double by[2], way[2];
    gradient(t, start, by);
    way[0] = -sense * by[1];
    way[1] = sense * by[0];
    place at = start, next;
    for (int i = 0; i < MOST_STEPS; ++i) {
        const double before[2] = {way[0], way[1]};
        fst_rolling_end which;
        if (!go_on(t, at, STEP, way, &next) || !(room(t, next, &which) > 0.0))
            return cut(t, at, before, end);
        at = next;
        note(t, at);
        if (i > 5 && apart(at, start) < 0.75 * STEP) {
            *end = FST_ROLLING_CLOSED;
            return start;
        }
    }
    *end = FST_ROLLING_LOST;
    return at;
}

/* ------------------------------------------------------------------ all of them */

static void fill(const tracer *t, place p, fst_rolling_end end, fst_rolling_lock *out)
{
    double load;
    state_at(t, p, out->state);
    out->use = isfinite(t->holding) ? use_at(t, out->state, &load) : NAN;
    out->r = fabs(p.x);
    out->bead_angle_deg = p.x == 0.0 ? NAN : p.x > 0 ? 0.0 : 180.0;
    out->end = end;
}

static fst_status trace_from(tracer *t, place start, fst_locked_list *list, fst_error *error)
{
    fst_rolling_end which[2] = {FST_ROLLING_CLOSED, FST_ROLLING_CLOSED};
    note(t, start);
    const place from = follow(t, start, -1.0, &which[0]);
    const place to = which[0] == FST_ROLLING_CLOSED ? from : follow(t, start, 1.0, &which[1]);
    if (!fst_grow(&list->families, list->family_count, sizeof *list->families))
        return fst_fail(error, FST_NO_MEMORY, "locked", "out of memory");
    fst_rolling_family *made = &list->families[list->family_count++];
    const int turned = from.x > to.x;
    fill(t, turned ? to : from, which[turned], &made->from);
    fill(t, turned ? from : to, which[!turned], &made->to);
    return FST_OK;
}

/* A zero of g between two angles. */
static int zero_between(const tracer *t, double x, double lo, double hi, place *at)
{
    const double g_lo = g_at(t, (place){x, lo}), g_hi = g_at(t, (place){x, hi});
    if (!isfinite(g_lo) || !isfinite(g_hi) || (g_lo > 0) == (g_hi > 0))
        return 0;
    for (int i = 0; i < 50; ++i) {
        const double middle = 0.5 * (lo + hi);
        if ((g_at(t, (place){x, middle}) > 0) == (g_lo > 0))
            lo = middle;
        else
            hi = middle;
    }
    *at = (place){x, 0.5 * (lo + hi)};
    return correct(t, at);
}

static fst_status search(tracer *t, fst_locked_list *list, fst_error *error)
{
    fst_status status = FST_OK;
    for (int i = 0; i < PLACES && status == FST_OK; ++i) {
        const double x = LARGEST_PLACE * (2.0 * i / (PLACES - 1) - 1.0) + 1e-3; /* not on the axis itself */
        for (int j = 0; j < ANGLES && status == FST_OK; ++j) {
            /* Between angles that are not a multiple of pi, where psi is infinite. */
            const double lo = FST_TWO_PI * (j + 0.5) / ANGLES, hi = FST_TWO_PI * (j + 1.5) / ANGLES;
            fst_rolling_end which;
            place start;
            if (zero_between(t, x, lo, hi, &start) && room(t, start, &which) > 0.0 && is_at_rest(t, start) &&
                !was_met(t, start))
                status = trace_from(t, start, list, error);
        }
    }
    return status;
}

fst_status fst_rolling_locks_find(const fst_setup *setup, fst_locked_list *list, fst_error *error)
{
    const fst_world_double *c = &setup->model.world;
    if (!c->kinds.dry || c->resistance.arm > 0.0 || c->kinds.patch)
        return FST_OK;
    tracer t = {.c = c,
                .sticks = fst_new_modes_double(),
                .holding = c->kinds.rolls ? INFINITY : c->law.coulomb.holding};
    t.sticks.contact = FST_MODE_STICK;
    t.seen = malloc(MOST_POINTS * sizeof *t.seen);
    if (!t.seen)
        return fst_fail(error, FST_NO_MEMORY, "locked", "out of memory");
    const fst_status status = search(&t, list, error);
    free(t.seen);
    return status;
}
