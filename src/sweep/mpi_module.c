/* mpi_module.c - festoon-mpi.so: messages between the ranks of a sweep, by MPI. */
#include "sweep/ranks_module.h"

#include <mpi.h>
#include <stdlib.h>
#include <string.h>

/* A message on its way; it is freed once MPI has sent it. */
typedef struct letter {
    struct letter *next;
    MPI_Request request;
    unsigned char data[];
} letter;

struct fst_mpi_link {
    letter *outgoing;
    int own; /* MPI was started here, not by the program around */
};

static fst_mpi_link *open_link(int *rank, int *ranks, int *neighbours)
{
    int started = 0, over = 0, level;
    if (MPI_Finalized(&over) != MPI_SUCCESS || over || MPI_Initialized(&started) != MPI_SUCCESS)
        return NULL;
    fst_mpi_link *link = calloc(1, sizeof *link);
    if (!link)
        return NULL;
    link->own = !started;
    MPI_Comm machine;
    /* Only one thread of each rank calls MPI; the others compute. */
    if ((!started && MPI_Init_thread(NULL, NULL, MPI_THREAD_FUNNELED, &level) != MPI_SUCCESS) ||
        MPI_Comm_rank(MPI_COMM_WORLD, rank) != MPI_SUCCESS ||
        MPI_Comm_size(MPI_COMM_WORLD, ranks) != MPI_SUCCESS ||
        MPI_Comm_split_type(MPI_COMM_WORLD, MPI_COMM_TYPE_SHARED, 0, MPI_INFO_NULL, &machine) != MPI_SUCCESS) {
        free(link);
        return NULL;
    }
    (void)MPI_Comm_size(machine, neighbours);
    (void)MPI_Comm_free(&machine);
    return link;
}

static int broadcast(fst_mpi_link *link, void *data, int size)
{
    (void)link;
    return MPI_Bcast(data, size, MPI_BYTE, 0, MPI_COMM_WORLD) == MPI_SUCCESS;
}

/* Free the messages that were sent; returns how many are still on their way. */
static int pending(fst_mpi_link *link)
{
    int count = 0;
    for (letter **place = &link->outgoing; *place;) {
        letter *here = *place;
        int gone = 0;
        (void)MPI_Test(&here->request, &gone, MPI_STATUS_IGNORE);
        if (gone) {
            *place = here->next;
            free(here);
        } else {
            place = &here->next;
            count += 1;
        }
    }
    return count;
}

static int post(fst_mpi_link *link, int to, int tag, const void *data, size_t size)
{
    letter *made = malloc(sizeof *made + size);
    if (!made)
        return 0;
    (void)pending(link);
    if (size > 0)
        memcpy(made->data, data, size);
    if (MPI_Isend(made->data, (int)size, MPI_BYTE, to, tag, MPI_COMM_WORLD, &made->request) != MPI_SUCCESS) {
        free(made);
        return 0;
    }
    made->next = link->outgoing;
    link->outgoing = made;
    return 1;
}

static int probe(fst_mpi_link *link, int *from, int *tag, size_t *size)
{
    (void)pending(link);
    MPI_Status status;
    int there = 0, count = 0;
    if (MPI_Iprobe(MPI_ANY_SOURCE, MPI_ANY_TAG, MPI_COMM_WORLD, &there, &status) != MPI_SUCCESS || !there)
        return 0;
    (void)MPI_Get_count(&status, MPI_BYTE, &count);
    *from = status.MPI_SOURCE;
    *tag = status.MPI_TAG;
    *size = (size_t)count;
    return 1;
}

static int receive(fst_mpi_link *link, int from, int tag, void *data, size_t size)
{
    (void)link;
    return MPI_Recv(data, (int)size, MPI_BYTE, from, tag, MPI_COMM_WORLD, MPI_STATUS_IGNORE) == MPI_SUCCESS;
}

static void close_link(fst_mpi_link *link, int together)
{
    if (!together)
        return; /* MPI may still read the messages */
    while (link->outgoing) {
        letter *here = link->outgoing;
        (void)MPI_Wait(&here->request, MPI_STATUS_IGNORE);
        link->outgoing = here->next;
        free(here);
    }
    if (link->own)
        (void)MPI_Finalize();
    free(link);
}

FST_API extern const fst_mpi_module_table fst_mpi_module;
const fst_mpi_module_table fst_mpi_module = {
    .version = FST_VERSION_STRING,
    .open = open_link,
    .broadcast = broadcast,
    .post = post,
    .probe = probe,
    .receive = receive,
    .pending = pending,
    .close = close_link,
};
