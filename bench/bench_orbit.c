/* bench_orbit.c - how long orbits and branches take: one orbit with multipliers from a cold start, and the
 * whole counter-rotating branch with all its special points.  tests/orbit/test_auto.py, run by the target `bench`
 * after this, lets AUTO-07p follow the same branches and prints both programs' times. */
#include <stdio.h>
#include <stdlib.h>
#include <time.h>

#include <festoon/festoon.h>

enum { ROUNDS = 9 };

static double now(void)
{
    struct timespec t;
    (void)clock_gettime(CLOCK_MONOTONIC, &t);
    return (double)t.tv_sec + 1e-9 * (double)t.tv_nsec;
}

static int rising(const void *a, const void *b)
{
    const double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}

static double median(double *times)
{
    qsort(times, ROUNDS, sizeof *times, rising);
    return times[ROUNDS / 2];
}

int main(void)
{
    fst_error error;
    double times[ROUNDS];
    static const double omegas[] = {0.21513626, 0.25, 0.352, 1.0};
    for (size_t i = 0; i < sizeof omegas / sizeof *omegas; ++i) {
        fst_params params = fst_default_params();
        fst_orbit orbit;
        params.drive_omega = omegas[i];
        for (int k = 0; k < ROUNDS; ++k) {
            const double began = now();
            if (fst_orbit_find(&params, NULL, &orbit, &error) != FST_OK)
                return puts(error.sentence), 1;
            times[k] = now() - began;
        }
        (void)printf("orbit at omega = %-10.8g  N = %-16.12g  residual %.1e  %6.1f ms\n", omegas[i],
                     orbit.means.festoons, orbit.residual, 1e3 * median(times));
    }
    const fst_params params = fst_default_params();
    fst_branch_options o = fst_default_branch_options();
    o.from = 0.2;
    o.to = 5.0;
    size_t points = 0, specials = 0;
    for (int k = 0; k < ROUNDS; ++k) {
        fst_branch branch;
        const double began = now();
        if (fst_branch_follow(&params, &o, &branch, &error) != FST_OK)
            return puts(error.sentence), 1;
        times[k] = now() - began;
        points = branch.point_count;
        specials = branch.special_count;
        fst_branch_free(&branch);
    }
    (void)printf(
        "counter-rotating branch, omega 0.2 to its upper end: %zu points, %zu special points  %6.1f ms\n",
        points, specials, 1e3 * median(times));
    return 0;
}
