/* work.h - how a part of the repetition is done: on all processors, with its time noted. */
#ifndef FST_PAPER_WORK_H
#define FST_PAPER_WORK_H

#include "paper/state.h"

/* A part of the work, in `count` pieces that may be done at the same time. */
typedef struct fst_paper_pieces {
    const char *what; /* its name in the progress and in the report */
    double from, to;  /* the progress goes from here to there */
    int count;
    fst_paper_step step; /* the step that is done when all pieces are */
    fst_status (*piece)(fst_paper_state *paper, int index, fst_error *error);
} fst_paper_pieces;
fst_status fst_paper_do(fst_paper_state *paper, const fst_paper_pieces *part, fst_error *error);

/* Note that `what` took the time since `began` of fst_clock_seconds(); time that was noted before
 * is added to. */
void fst_paper_note_time(fst_paper_state *paper, const char *what, double began);

/* Arithmetic, compiler and machine in words. */
void fst_paper_machine(char *text, size_t size);

/* Make the directory of the results, unless it exists; and see that files can be made in it. */
fst_status fst_paper_make_directory(const fst_paper_state *paper, fst_error *error);

/* DIRECTORY/NAME.ENDING; free() it, NULL: no memory. */
char *fst_paper_path(const fst_paper_state *paper, const char *name, const char *ending);

#endif
