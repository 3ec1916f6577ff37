/* ranks_module.h - the few calls of MPI that a sweep needs.
 *
 * MPI takes long to load, and most sweeps have one process.  So the code that calls MPI is a module,
 * festoon-mpi.so, loaded only when this process was started as one of several.  Ranks are numbered from 0; a
 * message is bytes with a tag.
 */
#ifndef FST_SWEEP_RANKS_MODULE_H
#define FST_SWEEP_RANKS_MODULE_H

#include <stddef.h>

#include <festoon/festoon.h>

typedef struct fst_mpi_link fst_mpi_link;

/* The module's one symbol is a table of this type, named FST_MPI_MODULE_SYMBOL.  A function that returns int
 * returns 0 where MPI failed. */
#define FST_MPI_MODULE_SYMBOL "fst_mpi_module"
typedef struct fst_mpi_module_table {
    const char *version; /* FST_VERSION_STRING at the module's build; a module of another version is refused */

    /* Start MPI.  Sets the number of this rank, of all ranks, and of the ranks on this machine.  NULL: it
     * failed. */
    fst_mpi_link *(*open)(int *rank, int *ranks, int *neighbours);

    /* Rank 0 sends `size` bytes to all; the others receive them. */
    int (*broadcast)(fst_mpi_link *link, void *data, int size);

    /* Send a copy of `data` without waiting for the receiver. */
    int (*post)(fst_mpi_link *link, int to, int tag, const void *data, size_t size);

    /* Whether a message has come, and its sender, tag and size. */
    int (*probe)(fst_mpi_link *link, int *from, int *tag, size_t *size);

    /* Receive the message that probe() found. */
    int (*receive)(fst_mpi_link *link, int from, int tag, void *data, size_t size);

    /* The number of messages posted but not sent yet. */
    int (*pending)(fst_mpi_link *link);

    /* End MPI together with all ranks.  Where one of them no longer answers (`together` is 0), do not: the end
     * of this process then ends them. */
    void (*close)(fst_mpi_link *link, int together);
} fst_mpi_module_table;

#endif
