/* ramp.h - a slow ramp of the drive: its pieces and their means. */
#ifndef FST_STUDY_RAMP_H
#define FST_STUDY_RAMP_H

#include "observe/means.h"

/* The last whole returns since a ramp began to wait. */
enum { FST_WAIT_RETURNS = 8 };
typedef struct fst_ramp_wait {
    int64_t returns;                      /* whole ones, and the first crossing */
    fst_mark marks[FST_WAIT_RETURNS + 1]; /* ring: return i is at i % (FST_WAIT_RETURNS + 1) */
    double asymmetry[FST_WAIT_RETURNS + 1];
} fst_ramp_wait;

typedef struct fst_ramp {
    const fst_run_options *options;
    int is_given;                /* whether there is a ramp; if not, the members below mean nothing */
    double rate;                 /* of the drive; 0 where both ends are the same */
    double from, until;          /* times */
    int piece;                   /* number of the present one */
    fst_mark start, first, last; /* of the present piece: its beginning, its first and its last whole return */
    int64_t returns;             /* crossings of the section in it */
    /* a ramp that waits half way through each piece */
    int waits, is_waiting;
    int unsettled; /* pieces that did not settle */
    fst_ramp_wait wait;
} fst_ramp;

/* The ramp of a run whose window is that of its parameters, of which `discard` and `periods` are in drive
 * periods; the window is made to end with the ramp. */
void fst_ramp_begin(fst_ramp *ramp, const fst_run_options *options, double discard, double periods,
                    fst_window *window);

/* After each step that the window took in: crossings of the section, and the pieces that end in it. */
fst_status fst_ramp_step(fst_ramp *ramp, fst_window *window, fst_flow *flow, fst_error *error);

/* A piece is over: its means go to the caller of fst_run(). */
fst_status fst_ramp_tell(fst_ramp *ramp, const fst_ramp_point *point, fst_error *error);

/* Why a ramp has no regime, and where it did not settle. */
void fst_ramp_explain(const fst_ramp *ramp, fst_run_result *result);

#endif
