/* map.c - a map over two parameters: many runs side by side in the lanes of the processor, and on two threads.
 *
 *     cc -std=c11 -pthread map.c $(pkg-config --cflags --libs festoon) -o map
 *     ./map > map.csv
 *
 * fst_rows() takes runs from a function of ours, does 4 or 8 at once in one thread (AVX2, AVX-512), and gives
 * each result to another function of ours.  Several threads may call it with the same source of runs.  A row's
 * numbers depend on its parameters and on the form of arithmetic alone: not on threads, nor on the runs beside
 * it.  The program does the same into a file that survives any interruption:
 *
 *     festoon sweep --over drive.frequency=6Hz:20Hz:8 --over model.kappa=1,1.5 --set run.periods=120 -o map.db
 */
#include <pthread.h>
#include <stdatomic.h>
#include <stdio.h>
#include <stdlib.h>

#include <festoon/festoon.h>

static const char *const AXES[] = {"drive.frequency=6Hz:20Hz:8", "model.kappa=1,1.5"};
enum { AXIS_COUNT = sizeof AXES / sizeof *AXES, THREADS = 2 };

typedef struct map {
    fst_grid *grid;
    _Atomic int64_t next;    /* point that the next free lane gets */
    fst_run_result *results; /* by point; each is written by one thread */
    fst_status *statuses;
} map;

/* Where the runs come from.  Asked by all threads. */
static int next_run(void *user, fst_row_job *job)
{
    map *m = user;
    job->point = atomic_fetch_add(&m->next, 1);
    job->has_start = 0; /* it starts where start.* says */
    return job->point < fst_grid_points(m->grid) &&
           fst_grid_params(m->grid, job->point, &job->params, NULL) == FST_OK;
}

/* Where the results go, in the order in which runs end. */
static int keep_result(void *user, fst_row_job *job, fst_status status, const fst_run_result *result,
                       const fst_error *error)
{
    map *m = user;
    m->statuses[job->point] = status;
    m->results[job->point] = *result;
    if (status != FST_OK)
        (void)fprintf(stderr, "point %lld: %s\n", (long long)job->point, error->sentence);
    return 0; /* no run is to follow this one at once */
}

static void *work(void *user)
{
    const fst_row_work rows = {
        .user = user, .arithmetic = fst_best_arithmetic(), .next = next_run, .done = keep_result};
    fst_error error;
    if (fst_rows(&rows, &error) != FST_OK)
        (void)fprintf(stderr, "%s: %s\n", error.where, error.sentence);
    return NULL;
}

static void print_map(const map *m)
{
    printf("%s,%s,regime,mean_r,festoons\n", fst_grid_key(m->grid, 0), fst_grid_key(m->grid, 1));
    for (int64_t point = 0; point < fst_grid_points(m->grid); ++point) {
        const fst_run_result *r = &m->results[point];
        if (m->statuses[point] == FST_OK)
            printf("%.17g,%.17g,%s,%.17g,%.17g\n", fst_grid_value(m->grid, 0, point),
                   fst_grid_value(m->grid, 1, point), fst_regime_name(r->regime), r->mean_r, r->festoons);
    }
}

int main(void)
{
    fst_error error;
    fst_params bead = fst_default_params();
    bead.run_periods = 120; /* of the drive; means are taken over the second half */
    map m = {.grid = NULL};
    if (fst_grid_new(&bead, AXES, AXIS_COUNT, 0, &m.grid, &error) != FST_OK) {
        (void)fprintf(stderr, "%s: %s\n", error.where, error.sentence);
        return 1;
    }
    const size_t points = (size_t)fst_grid_points(m.grid);
    m.results = calloc(points, sizeof *m.results);
    m.statuses = calloc(points, sizeof *m.statuses);
    pthread_t threads[THREADS];
    int started = 0, failed = !m.results || !m.statuses;
    while (!failed && started < THREADS && pthread_create(&threads[started], NULL, work, &m) == 0)
        ++started;
    for (int i = 0; i < started; ++i)
        (void)pthread_join(threads[i], NULL);
    failed = failed || started == 0;
    if (!failed)
        print_map(&m);
    free(m.results);
    free(m.statuses);
    fst_grid_free(m.grid);
    return failed;
}
