/* parallel.h - independent pieces of work on several threads. */
#ifndef FST_HOST_PARALLEL_H
#define FST_HOST_PARALLEL_H

#include <festoon/festoon.h>

typedef struct fst_work {
    void *user;
    int count;
    /* Do piece `index`.  Pieces may run at the same time and in any order.  If each writes only into its own
     * place, the results do not depend on the threads. */
    fst_status (*piece)(void *user, int index, fst_error *error);
    /* Told every 20 ms or more often, by the calling thread alone, which fraction of the pieces is done; NULL:
     * nobody is told.  A status other than FST_OK ends the work: no new piece begins.  A piece at work is not
     * broken off, so a long piece must ask the caller by itself. */
    const fst_progress *progress;
} fst_work;

/* Do all pieces on as many threads as this process has processors, and wait for them.  If a piece fails, no new
 * one begins; the status and error are those of the failed piece with the lowest index. */
fst_status fst_parallel(const fst_work *work, fst_error *error);

#endif
