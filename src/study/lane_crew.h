/* lane_crew.h - runs at work in lanes, shared by the files of fst_lane_rows(). */
#ifndef FST_STUDY_LANE_CREW_H
#define FST_STUDY_LANE_CREW_H

#include "ensemble/lanes.h"
#include "study/run_image.h"

enum { FST_MOST_MISFITS = 2 * FST_MOST_LANES };

typedef struct fst_lane {
    fst_run_state *run; /* NULL: idle */
    fst_row_job job;
    fst_run_options options;
    double saved; /* when its last image was made, or it was begun */
    /* A run that goes on from an image: that, until it is in its lane. */
    void *image;
    size_t image_size;
    fst_run_place place;
    const double *numbers;
} fst_lane;

/* A batch and the runs in it. */
typedef struct fst_squad {
    void *batch;
    fst_lane_view view;
    fst_lane lanes[FST_MOST_LANES];
    int occupied;
} fst_squad;

typedef struct fst_crew {
    const fst_row_work *work;
    const fst_row_images *images; /* NULL: none are made */
    const fst_lane_engine *engine;
    fst_squad run_up;                   /* the fast form: runs that are not observed yet */
    fst_squad observed;                 /* the others */
    unsigned in_window;                 /* lanes of these that are in their window */
    unsigned tracked;                   /* those in which extremes are looked for */
    unsigned turning;                   /* those whose Phi has gone so far that its range no longer matters */
    fst_lane ready[2 * FST_MOST_LANES]; /* runs that are to be observed as soon as a lane is free */
    int ready_count;
    /* The fast form: steps that were set aside, and for what. */
    void *slots;
    struct {
        int lane, record;
    } set_aside[FST_MOST_LANES];
    int aside;
    /* Runs to their ends whose exponents are wanted: less than a batch, and those that end in one step. */
    fst_lane parked[2 * FST_MOST_LANES];
    int parked_count;
    /* Jobs to come: at most one for each run that was begun; and those that do not fit those at work. */
    fst_row_job waiting[8 * FST_MOST_LANES], misfits[FST_MOST_MISFITS];
    int waiting_count, misfit_count;
    fst_coefficients_double kind; /* of the runs at work, which share its integers */
    int no_more;
} fst_crew;

static inline unsigned fst_lane_bit(int l)
{
    return 1u << l;
}

static inline double fst_next_mark(const fst_run_state *run)
{
    return run->t_discard + (double)run->next_period * run->drive_period;
}

/* A lane's step as the run's own flow has it, the clock, and Phi at its end. */
void fst_crew_extract_step(const fst_crew *c, const fst_squad *s, int l);

/* Whether such a step, which may end the run, does. */
int fst_crew_ends_run(const fst_crew *c, const fst_squad *s, int l);

/* Look at the accepted steps of the observed runs that may hold something; the lanes whose runs are over. */
unsigned fst_crew_look(fst_crew *c, fst_lane_events events);

/* The fast form: set the steps aside in which a record may be beaten; locate the extremes of those that are. */
void fst_crew_set_aside(fst_crew *c, const unsigned *beaten);
void fst_crew_locate(fst_crew *c);

/* Tell a lane of the observed runs between which directions Phi has stayed; where that is more than half a
 * turn, it cannot know. */
void fst_crew_keep_phi_range(fst_crew *c, int l);

/* A job that was just begun goes on where its image says, if there is one. */
void fst_crew_take_up(const fst_crew *c, fst_lane *at);

/* Put what the image of a run knows of its lane into the lane, which was loaded; the image is done with. */
void fst_crew_restore(fst_crew *c, fst_squad *s, int l);

/* Whether to stop; before that, make the images that are due: of all runs if so. */
int fst_crew_stopped(fst_crew *c);

#endif
