#include "timed_engine.h"

#include <stdint.h>
#include <time.h>

#if defined(__x86_64__) && defined(__GNUC__)
#include <x86intrin.h>
static uint64_t now(void)
{
    return __rdtsc();
}
#else
static uint64_t now(void)
{
    struct timespec t;
    clock_gettime(CLOCK_MONOTONIC, &t);
    return 1000000000u * (uint64_t)t.tv_sec + (uint64_t)t.tv_nsec;
}
#endif

static const fst_lane_engine *inner;
static timed_engine *account;
static double reading; /* ticks from one reading of the counter to the next */

double timed_engine_now(void)
{
    return (double)now();
}

#define TIMED(part, call)                                                                                      \
    const uint64_t began = now();                                                                              \
    call;                                                                                                      \
    account->ticks[part] += (double)(now() - began) - reading;                                                 \
    account->readings_ticks += 2.0 * reading

static fst_lane_tries try_steps(void *batch)
{
    TIMED(TIMED_STEPS, const fst_lane_tries tries = inner->try_steps(batch));
    account->rounds += 1;
    account->accepted += __builtin_popcount(tries.accepted);
    return tries;
}

static void advance(void *batch, unsigned accepted)
{
    TIMED(TIMED_STEPS, inner->advance(batch, accepted));
}

static fst_lane_events watch(void *batch, unsigned accepted, unsigned observed, unsigned in_window)
{
    TIMED(TIMED_WATCHING, const fst_lane_events events = inner->watch(batch, accepted, observed, in_window));
    return events;
}

static void observe(void *batch, unsigned accepted, unsigned in_window, unsigned tracked,
                    unsigned beaten[FST_RECORD_COUNT])
{
    TIMED(TIMED_OBSERVATION, inner->observe(batch, accepted, in_window, tracked, beaten));
    account->observed += __builtin_popcount(accepted);
}

static void set_aside(const void *batch, int lane, int record, void *waiting, int place)
{
    TIMED(TIMED_EXTREMES, inner->set_aside(batch, lane, record, waiting, place));
}

static void locate(void *waiting, double *values)
{
    TIMED(TIMED_EXTREMES, inner->locate(waiting, values));
}

static void load(void *batch, int lane, const fst_flow *flow, double t_limit)
{
    TIMED(TIMED_IN_AND_OUT, inner->load(batch, lane, flow, t_limit));
}

static void save(const void *batch, int lane, double *numbers)
{
    TIMED(TIMED_IN_AND_OUT, inner->save(batch, lane, numbers));
}

static void restore(void *batch, int lane, const double *numbers)
{
    TIMED(TIMED_IN_AND_OUT, inner->restore(batch, lane, numbers));
}

static void extract(const void *batch, int lane, fst_bead_step_double *step)
{
    TIMED(TIMED_IN_AND_OUT, inner->extract(batch, lane, step));
}

static void extract_path(const void *batch, int lane, fst_bead_step_double *step)
{
    TIMED(TIMED_IN_AND_OUT, inner->extract_path(batch, lane, step));
}

static void extract_integrals(const void *batch, int lane, fst_integrals_double *to)
{
    TIMED(TIMED_IN_AND_OUT, inner->extract_integrals(batch, lane, to));
}

static void extract_clock(const void *batch, int lane, fst_flow *flow)
{
    TIMED(TIMED_IN_AND_OUT, inner->extract_clock(batch, lane, flow));
}

fst_lane_engine timed_engine_of(const fst_lane_engine *engine, timed_engine *of)
{
    enum { READINGS = 1000 };
    fst_lane_engine timed = *engine;
    const uint64_t began = now();
    for (int i = 0; i < READINGS; ++i)
        (void)now();
    reading = (double)(now() - began) / (READINGS + 1);
    inner = engine;
    account = of;
    *account = (timed_engine){.rounds = 0};
    timed.try_steps = try_steps;
    timed.advance = advance;
    timed.watch = watch;
    timed.observe = observe;
    timed.set_aside = engine->set_aside ? set_aside : NULL;
    timed.locate = engine->locate ? locate : NULL;
    timed.load = load;
    timed.save = save;
    timed.restore = restore;
    timed.extract = extract;
    timed.extract_path = extract_path;
    timed.extract_integrals = extract_integrals;
    timed.extract_clock = extract_clock;
    return timed;
}

double timed_engine_ns_of_tick(void)
{
    const double shortest = 2e7;
    struct timespec from, to;
    double ns;
    clock_gettime(CLOCK_MONOTONIC, &from);
    const uint64_t began = now();
    do {
        clock_gettime(CLOCK_MONOTONIC, &to);
        ns = 1e9 * (double)(to.tv_sec - from.tv_sec) + (double)(to.tv_nsec - from.tv_nsec);
    } while (ns < shortest);
    return ns / (double)(now() - began);
}
