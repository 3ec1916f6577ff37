/* watched_run.h - one run: a model, its flow, the window in which it is observed, and how it ended. */
#ifndef FST_STUDY_WATCHED_RUN_H
#define FST_STUDY_WATCHED_RUN_H

#include "observe/cycle.h"
#include "observe/window.h"

/* The bead left the plate in the last step. */
typedef struct fst_run_end {
    int happened;
    fst_regime regime; /* ejected or lifted */
    double fraction;   /* where in the step */
} fst_run_end;

/* What a motion is known to be. */
typedef enum fst_settled_as {
    FST_SETTLED_NOT,
    FST_SETTLED_RETURNS, /* whole returns repeat */
    FST_SETTLED_CYCLE,   /* a libration repeats */
    FST_SETTLED_REST     /* the bead stands still */
} fst_settled_as;

/* Of a run that ends once its motion is known (settle.h). */
typedef struct fst_settling {
    int asked;
    fst_settled_as as;
    double discard, until;            /* the window and the end of the run, if the motion is not known before */
    double settled_at;                /* drive periods after which it was known; NAN: it is not */
    double way;                       /* that the states had still to go then */
    int64_t periods, crossings;       /* marks of periods in the window, and crossings, when it was looked at */
    int64_t at_rest, without_turning; /* the last periods in which the bead stood still, or Phi did not turn */
    int has_moved;                    /* once it was far too fast to stand still */
    fst_closing returns;
    fst_cycle cycle;
} fst_settling;

typedef struct fst_watched_run {
    const fst_params *params; /* the caller's, who keeps them */
    fst_model *model;
    fst_flow *flow;
    fst_window window; /* from the end of the discard to the end of the run */
    fst_run_end end;
    fst_settling settling;
} fst_watched_run;

/* Model, start state, flow and window of `params`; `start`: the state to begin from, NULL: what start.* says.
 * Free the run also where this fails. */
fst_status fst_watched_run_begin(fst_watched_run *run, const fst_params *params, const double *start,
                                 fst_error *error);

/* What the run holds, not the run itself. */
void fst_watched_run_free(fst_watched_run *run);

/* Look at the flow's last step: has the bead left the plate?  Then 1, and run->end. */
int fst_watched_run_ends(fst_watched_run *run);

/* One step towards t_limit, and what it holds, unless it ends the run. */
fst_status fst_watched_run_step(fst_watched_run *run, double t_limit, fst_error *error);

/* At most so many steps towards the run's end; *over: whether that is reached. */
fst_status fst_watched_run_go_on(fst_watched_run *run, int steps, int *over, fst_error *error);

#endif
