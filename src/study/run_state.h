/* run_state.h - what a run carries along, shared by the files of fst_run(). */
#ifndef FST_STUDY_RUN_STATE_H
#define FST_STUDY_RUN_STATE_H

#include "study/exponent.h"
#include "study/marks.h"

/* Returns of the bead to the section X = 0 (Phi = pi/2 or -pi/2). */
typedef struct fst_returns {
    int side;                          /* sign of X where the bead is; 0 before the first step */
    int64_t crossings;                 /* since the discard */
    int last_half;                     /* sign of Y at the last crossing */
    int last_direction;                /* sign of Phi' there */
    int irregular;                     /* a crossing broke the alternation of halves or the direction */
    int64_t since_break;               /* crossings since the last break */
    double section[2][FST_STATE_SIZE]; /* the last two section states, on the side Y > 0 (images under S2) */
} fst_returns;

/* Of the progress that a run reports, the steps' part; the rest is that of an exponent, if one is needed. */
#define FST_RUN_SHARE 0.7

/* The last whole returns since a ramp began to wait. */
enum { FST_WAIT_RETURNS = 8 };
typedef struct fst_ramp_wait {
    int64_t returns;                      /* whole ones, and the first crossing */
    fst_mark marks[FST_WAIT_RETURNS + 1]; /* ring: return i is at i % (FST_WAIT_RETURNS + 1) */
    double asymmetry[FST_WAIT_RETURNS + 1];
} fst_ramp_wait;

typedef struct fst_run_state {
    const fst_params *params;
    const fst_run_options *options;
    fst_model *model;
    fst_flow *flow;
    fst_quadrature q;
    fst_returns returns;
    fst_mark_series section_marks; /* one mark a whole return */
    fst_mark_series period_marks;  /* one mark a whole drive period */
    double drive_period, t_discard, t_end;
    int64_t next_period; /* index of the next whole drive period to mark */
    int64_t next_sample;
    double activity;                     /* greatest speed in the turning frame since the last period mark */
    double least_phi, greatest_phi;      /* range of Phi since the discard */
    double window_start[FST_STATE_SIZE]; /* state at the first period mark, for the exponent */
    int in_window;
    double window_from;     /* where in the last step the window begins; 0 in the steps after it */
    int extremes_elsewhere; /* someone else looks for them */
    int sparse_marks;       /* those that no conclusion needs are left out: the run is not interrupted */
    int exponent_elsewhere; /* someone else computes it, and asks for the conclusion once more */
    enum { FST_EXPONENT_UNASKED, FST_EXPONENT_WANTED, FST_EXPONENT_KNOWN } exponent_is;
    fst_exponent exponent;
    int ended; /* an event ended the run: ejected or lifted */
    fst_regime end_regime;
    double end_fraction; /* where in the last step */
    /* a ramp; its rate is 0 where both ends are the same */
    int is_ramp;
    double ramp_rate;
    int ramp_piece;
    fst_mark piece_start, piece_first, piece_last; /* marks of the present piece */
    int64_t piece_returns;
    /* a ramp that waits half way through each piece */
    int ramp_waits, is_waiting;
    int unsettled_pieces;
    double unsettled_first, unsettled_last; /* drive of the first and the last of them */
    fst_ramp_wait wait;
} fst_run_state;

/* Model, start state, flow and times of a run whose params and options are set. */
fst_status fst_run_begin(fst_run_state *run, fst_error *error);

/* At most so many steps of a run without a ramp, towards its end; *over tells whether that is reached. */
fst_status fst_run_go_on(fst_run_state *run, int steps, int *over, fst_error *error);

/* Look at the flow's last step, whose integrals are taken in: has the bead left the plate (then 1)? */
int fst_run_watch_end(fst_run_state *run);

/* If it has not: marks, returns, extremes.  The quiet form is for a step of which it is known that it holds
 * none of these; `activity` is the greatest component of |d(state)/dt| at its end. */
void fst_run_watch_step(fst_run_state *run);
void fst_run_watch_quietly(fst_run_state *run, double activity);

/* The whole drive periods that end in the flow's last step: marks, and the beginning of the window.  Where no
 * integrals are needed, the flow's clock is all that is looked at. */
void fst_run_mark_periods(fst_run_state *run);

/* Whether the integrals are needed of a mark in the flow's last step: of a period that ends in it, of a return.
 */
int fst_run_period_needs_integrals(const fst_run_state *run);
int fst_returns_need_integrals(const fst_run_state *run);

/* The side of the section where the bead is, before a step of which more will be asked. */
void fst_returns_begin(fst_run_state *run);

/* Crossings of the section in the last step: marks and statistics of the returns. */
void fst_returns_step(fst_run_state *run);

/* Decide regime and symmetry and fill in the result from what the run carries; reads docs/regimes.md's
 * criteria.  Where the exponent is computed elsewhere and is wanted (exponent_is), the result means nothing
 * until it is known. */
fst_status fst_run_conclude(fst_run_state *run, fst_run_result *result, fst_error *error);

/* Means between the first and the latest mark of a series, and the extremes met. */
void fst_fill_window(const fst_run_state *run, const fst_mark_series *series, fst_run_result *result);

/* Every number of a result set to NAN, the rest to zero. */
void fst_result_clear(fst_run_result *result);

/* Means over [first, last]: what both the result and a ramp's pieces need. */
void fst_means_between(const fst_run_state *run, const fst_mark *first, const fst_mark *last,
                       fst_ramp_point *means);

/* One step towards t_limit, and what it holds; steps up to a time, landing on it. */
fst_status fst_run_one_step(fst_run_state *run, double t_limit, fst_error *error);
fst_status fst_run_steps_until(fst_run_state *run, double t, fst_error *error);

/* The ramp of a run at the end of its discard, waiting half way through each piece; how much of it is done. */
fst_status fst_ramp_with_waiting(fst_run_state *run, fst_error *error);
double fst_ramp_progress(const fst_run_state *run);

/* A crossing of the section while the ramp waits: `image` is its state on the side Y > 0, before it is kept. */
void fst_ramp_crossing(fst_run_state *run, const fst_mark *mark, const double *image);

/* Why a ramp has no regime, and where it did not settle. */
void fst_ramp_conclude(const fst_run_state *run, fst_run_result *result);

/* A ramp's bookkeeping after each step, and the piece that ends with the run. */
fst_status fst_ramp_step(fst_run_state *run, fst_error *error);

#endif
