/* ranks.c - finding out whether this process is one of several, and joining the others. */
#include "sweep/ranks.h"

#include <stdlib.h>
#include <string.h>

#include "base/error.h"
#include "host/module.h"

static int number_in(const char *variable)
{
    const char *text = getenv(variable);
    return text ? atoi(text) : 0;
}

/* The number of processes that were started together, according to the environment that mpirun or srun sets;
 * *by_mpi: whether they were started so that MPI can join them. */
static int started_together(int *by_mpi)
{
    static const char *const sizes[] = {"OMPI_COMM_WORLD_SIZE", "PMI_SIZE"};
    *by_mpi = 1;
    for (size_t i = 0; i < sizeof sizes / sizeof *sizes; ++i)
        if (number_in(sizes[i]) > 0)
            return number_in(sizes[i]);
    /* srun starts the tasks of a step for MPI (--mpi=pmix), or without MPI. */
    *by_mpi = getenv("PMIX_RANK") != NULL;
    return number_in("SLURM_STEP_NUM_TASKS");
}

static fst_status load(fst_ranks *ranks, int processes, fst_error *error)
{
    int found;
    ranks->mpi = fst_module_table(FST_MPI_MODULE, FST_MPI_MODULE_SYMBOL, &found);
    if (!ranks->mpi)
        return fst_fail(
            error, FST_UNAVAILABLE, "MPI",
            "this is one of %d processes that were started together, but this festoon has no MPI (%s): "
            "start it alone, or install libopenmpi-dev and build festoon again",
            processes,
            found ? FST_MPI_MODULE " is not a module of festoon" : FST_MPI_MODULE " cannot be loaded");
    if (strcmp(ranks->mpi->version, fst_version()) != 0)
        return fst_fail(error, FST_UNAVAILABLE, "MPI",
                        "%s belongs to festoon %s, not to %s: install festoon again", FST_MPI_MODULE,
                        ranks->mpi->version, fst_version());
    return FST_OK;
}

fst_status fst_ranks_open(fst_ranks *ranks, fst_error *error)
{
    *ranks = (fst_ranks){.count = 1, .neighbours = 1};
    int by_mpi;
    const int processes = started_together(&by_mpi);
    if (processes <= 1)
        return FST_OK;
    if (!by_mpi)
        return fst_fail(
            error, FST_UNAVAILABLE, "MPI",
            "this is one of %d processes that srun started without MPI: srun --mpi=pmix, mpirun, or a "
            "single task",
            processes);
    const fst_status status = load(ranks, processes, error);
    if (status != FST_OK)
        return status;
    ranks->link = ranks->mpi->open(&ranks->rank, &ranks->count, &ranks->neighbours);
    if (!ranks->link || ranks->count != processes)
        return fst_fail(error, FST_UNAVAILABLE, "MPI",
                        "this is one of %d processes that were started together, but MPI %s: start them by the "
                        "mpirun of Open MPI or by srun --mpi=pmix",
                        processes, ranks->link ? "sees another number of them" : "did not start");
    return FST_OK;
}

void fst_ranks_close(fst_ranks *ranks, int together)
{
    if (ranks->link)
        ranks->mpi->close(ranks->link, together);
    ranks->link = NULL;
}

fst_status fst_ranks_share_start(const fst_ranks *ranks, fst_ranks_start *start, fst_error *error)
{
    if (ranks->link && !ranks->mpi->broadcast(ranks->link, start, (int)sizeof *start))
        return fst_fail(error, FST_IO, "MPI", "the ranks cannot speak to each other");
    return FST_OK;
}
