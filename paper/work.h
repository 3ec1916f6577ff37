/* work.h - how a part of the repetition is done: on all processors, with its time noted. */
#ifndef FST_PAPER_WORK_H
#define FST_PAPER_WORK_H

#include "paper/state.h"

#include <stdio.h>

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

/* Set parameters by words with formats as of printf(), "friction.law=coulomb friction.mu=%g". */
fst_status fst_paper_set(fst_params *params, fst_error *error, const char *settings, ...)
    __attribute__((format(printf, 3, 4)));

/* Arithmetic, compiler and machine in words. */
void fst_paper_machine(char *text, size_t size);

/* Make the directory of the results, unless it exists; and see that files can be made in it. */
fst_status fst_paper_make_directory(const fst_paper_state *paper, fst_error *error);

/* A file of the results, which is kept in memory until it is whole. */
typedef struct fst_paper_file {
    FILE *stream; /* write here */
    fst_printed printed;
} fst_paper_file;
fst_status fst_paper_file_begin(fst_paper_file *file, fst_error *error);
/* Write it to DIRECTORY/NAME.ENDING if `status` is FST_OK; returns the first failure.  The file is finished in
 * either case. */
fst_status fst_paper_file_end(fst_paper_file *file, const fst_paper_state *paper, const char *name,
                              const char *ending, fst_status status, fst_error *error);

/* DIRECTORY/NAME.ENDING; free() it, NULL: no memory. */
char *fst_paper_path(const fst_paper_state *paper, const char *name, const char *ending);

#endif
