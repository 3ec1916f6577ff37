/* timed_engine.h - an engine of lanes with a clock around each of its functions. */
#ifndef FST_BENCH_TIMED_ENGINE_H
#define FST_BENCH_TIMED_ENGINE_H

#include "lanes/lanes.h"

typedef enum timed_part {
    TIMED_STEPS,       /* try_steps(), advance() */
    TIMED_WATCHING,    /* watch(): whether something may have happened */
    TIMED_OBSERVATION, /* observe(): integrands, their integrals, whether a record may be beaten */
    TIMED_EXTREMES,    /* set_aside(), locate() */
    TIMED_IN_AND_OUT,  /* copies of lanes */
    TIMED_PARTS
} timed_part;

typedef struct timed_engine {
    double ticks[TIMED_PARTS]; /* of the processor's counter, without what reading it takes */
    double readings_ticks;     /* what reading it took */
    double rounds;             /* calls of try_steps() */
    double accepted, observed; /* steps of lanes */
} timed_engine;

/* A copy of `engine` that adds to `*account`, to be used by one thread at a time. */
fst_lane_engine timed_engine_of(const fst_lane_engine *engine, timed_engine *account);

/* The counter that it reads, and how long a tick of it lasts. */
double timed_engine_now(void);
double timed_engine_ns_of_tick(void);

#endif
