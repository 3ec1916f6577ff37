/* departure.c - skipping the long way out of a weakly unstable equilibrium.
 *
 * Beside a Hopf point a bead may come within rounding of the equilibrium before it leaves it, with a growth
 * that is next to nothing: thousands of swings pass before they saturate.  But all ways out lie on one surface,
 * the unstable manifold of the pair, and wind outward on it to the same orbit.  So the swings are started on it
 * at several amplitudes, and the amplitude a is sought at which the growth g per swing, mu - c a^2 near the
 * Hopf point, vanishes:
 *
 *     g |*                      * : measured, after a few swings in which all else dies out
 *       |    *
 *     --+--------*---------     the orbit
 *       |            *    a^2
 */
#include "orbit/search.h"

#include <string.h>

#include "base/bracket.h"
#include "base/constants.h"
#include "base/dot.h"
#include "ode/flow.h"
#include "orbit/describe.h"

#define TOLERANCE 1e-9
#define LEAST_AMPLITUDE 1e-3
#define GREATEST_AMPLITUDE 1.0

/* Swings that are let pass, and over which the growth is taken; steps by which the zero is narrowed down. */
enum { PASSED = 4, MEASURED = 3, MOST_NARROWINGS = 12 };

typedef struct departure {
    const fst_family *family;
    fst_solution rest;
    double way[FST_STATE_SIZE]; /* along the plane of the pair, of length 1 */
    double frequency;
    double y[FST_STATE_SIZE], period, gap; /* of the latest swings */
} departure;

static double distance(const double *a, const double *b)
{
    double sum = 0.0;
    for (int i = 0; i < FST_STATE_SIZE; ++i)
        sum += (a[i] - b[i]) * (a[i] - b[i]);
    return sqrt(sum);
}

/* The frequency of the only unstable pair; 0: no pair is unstable, or something else is too. */
static double unstable_pair(const fst_solution *rest, double *growth)
{
    double frequency = 0.0;
    int unstable = 0;
    for (int i = 0; i < rest->multipliers; ++i)
        if (rest->re[i] > -1e-13) {
            unstable += 1;
            if (rest->im[i] > 0.0) {
                frequency = rest->im[i];
                *growth = rest->re[i];
            }
        }
    return unstable == 2 ? frequency : 0.0;
}

static int find_equilibrium(departure *d, const double *near, double reach)
{
    fst_error ignored;
    double growth = 0.0;
    memset(&d->rest, 0, sizeof d->rest);
    memcpy(d->rest.y[0], near, sizeof d->rest.y[0]);
    if (fst_solution_correct(d->family, &d->rest, NULL, &ignored) != FST_OK ||
        fst_solution_spectrum(d->family, &d->rest, &ignored) != FST_OK ||
        !(distance(near, d->rest.y[0]) < reach))
        return 0;
    d->frequency = unstable_pair(&d->rest, &growth);
    if (!(d->frequency > 0.0 && growth < 0.02 * d->frequency) ||
        fst_solution_eigenvector(d->family, &d->rest, growth, d->frequency, d->way, NULL, &ignored) != FST_OK)
        return 0;
    const double size = sqrt(fst_dot(d->way, d->way, FST_STATE_SIZE));
    for (int i = 0; i < FST_STATE_SIZE; ++i)
        d->way[i] /= size;
    return size > 0.0;
}

/* Follow the swings from one place of greatest r to the next; the growth over the last of them.  0: there were
 * no regular ones. */
static int watch_swings(departure *d, fst_flow *flow, double *growth)
{
    const double period = FST_TWO_PI / d->frequency, end = (PASSED + MEASURED + 3) * period;
    double first = 0.0, first_time = 0.0, last_time = 0.0;
    fst_error ignored;
    for (int tops = 0; tops < PASSED + MEASURED + 1 && flow->t.high < end;) {
        if (fst_flow_step(flow, end, &ignored) != FST_OK ||
            fst_watch_count(d->family->watch, FST_FLOW_STEP_WORK, &ignored) != FST_OK)
            return 0;
        const double before = fst_radial_function(flow, flow->step.y, NULL);
        const double after = fst_radial_function(flow, flow->step.end, NULL);
        if (!(before > 0 && after <= 0))
            continue;
        double y[FST_STATE_SIZE];
        const double x = fst_flow_locate(flow, fst_radial_function, 0.0, 1.0, before, after);
        fst_flow_at(flow, x, y);
        d->gap = distance(y, d->y);
        d->period = fst_flow_time(flow, x).high - last_time;
        last_time += d->period;
        memcpy(d->y, y, sizeof y);
        if (tops == PASSED) {
            first = distance(y, d->rest.y[0]);
            first_time = last_time;
        }
        tops += 1;
        *growth = log(distance(y, d->rest.y[0]) / first) / MEASURED;
        if (tops == PASSED + MEASURED + 1)
            return fabs((last_time - first_time) / (MEASURED * period) - 1.0) < 0.1;
    }
    return 0;
}

/* The growth of swings of this amplitude. */
static int growth_at(departure *d, double amplitude, double *growth)
{
    fst_model *model = NULL;
    fst_flow *flow = NULL;
    fst_error ignored;
    double start[FST_STATE_SIZE];
    for (int i = 0; i < FST_STATE_SIZE; ++i)
        start[i] = d->rest.y[0][i] + amplitude * d->way[i];
    const int found =
        fst_solution_flow(d->family, d->rest.value, start, TOLERANCE, &model, &flow, &ignored) == FST_OK &&
        watch_swings(d, flow, growth);
    fst_flow_free(flow);
    fst_model_free(model);
    return found && isfinite(*growth);
}

int fst_departure_guess(const fst_family *family, const double *near, double reach, fst_solution *guess,
                        double *gap)
{
    departure d = {.family = family};
    double amplitude = LEAST_AMPLITUDE, growth, least;
    if (!find_equilibrium(&d, near, reach) || !growth_at(&d, amplitude, &least) || !(least > 0.0))
        return 0;
    fst_bracket z = {amplitude * amplitude, 0.0, least, 0.0, 0};
    do {
        amplitude *= 2.0;
        if (!(amplitude < GREATEST_AMPLITUDE) || !growth_at(&d, amplitude, &growth))
            return 0;
        if (growth > 0.0)
            z.lo = amplitude * amplitude, z.f_lo = growth;
    } while (growth > 0.0);
    z.hi = amplitude * amplitude;
    z.f_hi = growth;
    for (int i = 0; i < MOST_NARROWINGS && fabs(growth) > 0.01 * least; ++i) {
        const double x = fst_bracket_next(&z);
        if (!growth_at(&d, sqrt(x), &growth))
            return 0;
        fst_bracket_take(&z, x, growth);
    }
    memset(guess, 0, sizeof *guess);
    memcpy(guess->y[0], d.y, sizeof d.y);
    guess->period = d.period;
    *gap = d.gap;
    return 1;
}
