/* ranks_module.h - the few calls of MPI that a sweep needs.
 *
 * MPI is heavy to load, and most sweeps have one process: what calls it is a module, festoon-mpi.so, loaded
 * when this process was started as one of several.  Ranks are numbered from 0; messages are bytes with a tag.
 */
#ifndef FST_SWEEP_RANKS_MODULE_H
#define FST_SWEEP_RANKS_MODULE_H

#include <stddef.h>

#include <festoon/festoon.h>

typedef struct fst_mpi_link fst_mpi_link;

/* The module's one symbol is a table of this type, named FST_MPI_MODULE_SYMBOL.  Functions that return int give
 * 0 where MPI failed. */
#define FST_MPI_MODULE_SYMBOL "fst_mpi_module"
typedef struct fst_mpi_module_table {
    const char *version; /* FST_VERSION_STRING at the module's build: another version is refused */

    /* Start MPI: number of this rank, of all, and of those on this machine.  NULL where it failed. */
    fst_mpi_link *(*open)(int *rank, int *ranks, int *neighbours);

    /* Rank 0 sends `size` bytes to all, the others receive them. */
    int (*broadcast)(fst_mpi_link *link, void *data, int size);

    /* Send a copy of `data` without waiting for the receiver. */
    int (*post)(fst_mpi_link *link, int to, int tag, const void *data, size_t size);

    /* Whether a message has come: from whom, of what tag and size. */
    int (*probe)(fst_mpi_link *link, int *from, int *tag, size_t *size);

    /* Receive the message that probe() found. */
    int (*receive)(fst_mpi_link *link, int from, int tag, void *data, size_t size);

    /* Number of messages posted that are not yet on their way. */
    int (*pending)(fst_mpi_link *link);

    /* End MPI together with all ranks; where one of them no longer answers (`together` is 0), leave it as it
     * is: the end of this process then ends them. */
    void (*close)(fst_mpi_link *link, int together);
} fst_mpi_module_table;

#endif
