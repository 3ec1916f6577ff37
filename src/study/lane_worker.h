/* lane_worker.h - runs at work in lanes, shared by the files of fst_lane_rows(); lane_rows.c explains the
 * scheme. */
#ifndef FST_STUDY_LANE_WORKER_H
#define FST_STUDY_LANE_WORKER_H

#include "study/lane_contact.h"
#include "study/run_image.h"

enum { FST_MOST_DEFERRED = 2 * FST_MOST_LANES };

/* A place for a run: a lane of a batch, or a place in a queue between two batches. */
typedef struct fst_lane {
    fst_watched_run *run; /* NULL: idle */
    fst_row_job job;
    fst_exponent *exponent; /* what a run at its end waits for; else NULL */
    double saved;           /* when its last image was made, or it was begun */
    /* A run that goes on from an image: that, until it is in its lane. */
    void *image;
    size_t image_size;
    fst_run_place place;
    const double *numbers;
} fst_lane;

/* A batch of the engine and the runs in its lanes. */
typedef struct fst_lane_batch {
    void *memory;
    fst_lane_view view;
    fst_lane lanes[FST_MOST_LANES];
    int occupied;
} fst_lane_batch;

/* One thread's work on rows in lanes. */
typedef struct fst_row_worker {
    const fst_row_work *work;
    const fst_row_images *images;       /* NULL: none are made */
    const fst_lane_engine *usual, *dry; /* engines: of most contacts, and of dry ones; */
    const fst_lane_engine *engine;      /* the one of the runs at work */
    fst_lane_batch run_up;              /* the fast form: runs before their windows */
    fst_lane_batch observed;            /* the others */
    unsigned seeking; /* lanes of run_up, one bit each: their runs end once they have settled */
    /* Lanes of the observed batch, one bit each: */
    unsigned in_window;                 /* the window is open */
    unsigned tracked;                   /* extremes are looked for */
    unsigned turning;                   /* Phi has gone so far that its range no longer matters */
    unsigned leaving;                   /* after this step the run need not be observed */
    unsigned settled;                   /* another window begins after this step */
    unsigned failed;                    /* the motion that left is not the one that came back */
    fst_lane ready[2 * FST_MOST_LANES]; /* runs that are to be observed as soon as a lane is free */
    int ready_count;
    /* The fast form: runs that wait for a lane of the run-up batch, in which nobody looks at them: they repeat
     * themselves, or have to begin anew. */
    fst_lane unwatched[2 * FST_MOST_LANES];
    int unwatched_count;
    /* The fast form: steps that wait for their extremes to be located, and whose they are. */
    void *pending_steps;
    struct {
        int lane, record;
    } pending[FST_MOST_LANES];
    int pending_count;
    /* Finished runs waiting for a Lyapunov exponent: less than a batch, and those that end in one step. */
    fst_lane parked[2 * FST_MOST_LANES];
    int parked_count;
    fst_dry_exponents *exponents; /* of dry contacts, some of which go on while other runs are made */
    /* Jobs to come: at most one for each run that was begun; and those whose models do not fit the batches. */
    fst_row_job waiting[8 * FST_MOST_LANES], deferred[FST_MOST_DEFERRED];
    int waiting_count, deferred_count;
    fst_world_double kind; /* of the runs at work, which share its integers */
    int no_more;
    fst_status answer; /* of the caller during a run that was done alone, whether to go on, */
    fst_error said;    /* and what it said */
} fst_row_worker;

/* ------------------------------------------------------------------ places (lane_places.c) */

/* What became of a job that was to begin. */
typedef enum fst_beginning {
    FST_BEGUN,
    FST_BEGUN_REFUSED, /* it has to wait until nothing is at work */
    FST_BEGUN_ALONE,   /* it is one for no lane */
    FST_BEGUN_FAILED   /* `error` says why */
} fst_beginning;

/* Begin the job of `at`. */
fst_beginning fst_worker_begin(fst_row_worker *w, fst_lane *at, fst_status *status, fst_error *error);

/* A run that was begun, or taken up, goes to its place. */
void fst_worker_place(fst_row_worker *w, fst_lane *fresh);

void fst_worker_free_run(fst_lane *at);
void fst_worker_move_run(fst_lane *to, fst_lane *from);

/* The run of a lane is no longer there. */
void fst_worker_vacate(fst_row_worker *w, fst_lane_batch *b, int l);

/* Runs that are on their way to their ends; these, and those at their ends whose exponents are wanted. */
int fst_worker_on_their_way(const fst_row_worker *w);
int fst_worker_at_work(const fst_row_worker *w);

/* Change the engine, while nothing is at work. */
void fst_worker_use_engine(fst_row_worker *w, const fst_lane_engine *engine);

/* Idle lanes take runs that are ready, then new jobs.  A job whose model does not fit the batch waits until
 * nothing is at work. */
void fst_worker_occupy_idle(fst_row_worker *w);

/* ------------------------------------------------------------------ watching */

/* A lane's step as the run's own flow has it, the clock, and Phi at its end. */
void fst_worker_extract_step(const fst_row_worker *w, const fst_lane_batch *b, int l);

/* Whether such a step, which may end the run, does. */
int fst_worker_ends_run(const fst_row_worker *w, const fst_lane_batch *b, int l);

/* Dry contacts: look at the steps that may end a mode or the way (lane_contact.h). */
fst_lane_contacts fst_worker_look_at_contacts(fst_row_worker *w, fst_lane_batch *b, fst_lane_tries tries);

/* After advance(): the mode of a lane begins. */
void fst_worker_begin_mode(fst_row_worker *w, fst_lane_batch *b, int l);

/* The last step of a lane up to the end of its way, by the flow of its run; 1 if the bead left the plate in it.
 */
int fst_worker_land(fst_row_worker *w, fst_lane_batch *b, int l);

/* Look at the accepted steps of the observed runs that may hold something; the lanes whose runs are over. */
unsigned fst_worker_look(fst_row_worker *w, fst_lane_events events);

/* After a step of an observed run was looked at that ends once it has settled: does another window begin? */
void fst_worker_look_at_settling(fst_row_worker *w, int l);

/* The same for a step of a run before its window that ends once it has settled: 1 if it begins another window.
 * The step is in the run's flow. */
int fst_worker_seek(fst_row_worker *w, int l);

/* The fast form: set the steps aside in which a record may be beaten; locate the extremes of those that are. */
void fst_worker_set_aside(fst_row_worker *w, const unsigned *beaten);
void fst_worker_locate(fst_row_worker *w);

/* Tell a lane of the observed runs between which directions Phi has stayed; where that is more than half a
 * turn, the lane cannot use it. */
void fst_worker_keep_angle_range(fst_row_worker *w, int l);

/* A job that was just begun goes on where its image says, if there is one. */
void fst_worker_take_up(const fst_row_worker *w, fst_lane *at);

/* Put what the image of a run knows of its lane into the lane, which was loaded; the image is done with. */
void fst_worker_restore(fst_row_worker *w, fst_lane_batch *b, int l);

/* Ask the caller whether to go on, and make the images that are due: of all runs if not. */
fst_status fst_worker_ask(fst_row_worker *w, fst_error *error);

#endif
