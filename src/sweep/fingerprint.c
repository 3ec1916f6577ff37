/* fingerprint.c - a hash of a short fixed run, by which a sweep knows that it still computes the same bits.
 *
 * A sweep may be continued by another build or on another machine.  If the hash differs there, new rows would
 * not fit the old ones, and the sweep refuses to go on.
 */
#include <string.h>

#include "sweep/sweep.h"

typedef struct probe {
    int taken;
    fst_status status;
    fst_error *error;
    uint64_t hash;
} probe;

static int next_probe(void *user, fst_row_job *job)
{
    probe *p = user;
    if (p->taken)
        return 0;
    p->taken = 1;
    memset(job, 0, sizeof *job);
    job->params = fst_default_params();
    job->params.run_periods = 3;
    job->params.run_discard = 1;
    return 1;
}

/* Add a number's bits to the hash (FNV-1a).  The numbers are chosen so that every part of a run goes
 * into them. */
static void add(uint64_t *hash, double number)
{
    unsigned char bytes[sizeof number];
    memcpy(bytes, &number, sizeof number);
    for (size_t i = 0; i < sizeof bytes; ++i)
        *hash = (*hash ^ bytes[i]) * 0x100000001b3u;
}

static int probe_done(void *user, fst_row_job *job, fst_status status, const fst_run_result *result,
                      const fst_error *error)
{
    probe *p = user;
    (void)job;
    p->status = status;
    if (status != FST_OK && p->error)
        *p->error = *error;
    for (int i = 0; i < FST_STATE_SIZE; ++i)
        add(&p->hash, result->final_state[i]);
    add(&p->hash, result->mean_r);
    add(&p->hash, result->max_b);
    return 0;
}

fst_status fst_arithmetic_fingerprint(fst_arithmetic arithmetic, int lanes, uint64_t *fingerprint,
                                      fst_error *error)
{
    probe p = {0, FST_OK, error, 0xcbf29ce484222325u};
    const fst_row_work work = {
        .user = &p, .arithmetic = arithmetic, .lanes = lanes, .next = next_probe, .done = probe_done};
    const fst_status status = fst_rows(&work, error);
    *fingerprint = p.hash;
    return status == FST_OK ? p.status : status;
}
