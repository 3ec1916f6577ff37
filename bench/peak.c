#include "peak.h"

#include <time.h>

#if defined(__x86_64__) && defined(__GNUC__)
#include <immintrin.h>
#include <pthread.h>

enum {
    CHAINS = 12,
    TURNS = 1000000,
    TRIES = 40
}; /* more chains than the latency of the operation times the ports that do it */

static double seconds(void)
{
    struct timespec t;
    clock_gettime(CLOCK_MONOTONIC, &t);
    return (double)t.tv_sec + 1e-9 * (double)t.tv_nsec;
}

/* Every chain has its own register, and converges to 1. */
#define LOOP(type, fused, chains)                                                                              \
    for (int i = 0; i < CHAINS; ++i)                                                                           \
        (chains)[i] = (type){0.5} + (double)i;                                                                 \
    for (int turn = 0; turn < TURNS; ++turn) {                                                                 \
        _Pragma("GCC unroll 12") for (int i = 0; i < CHAINS; ++i)(chains)[i] =                                 \
            fused((chains)[i], factor, addend);                                                                \
    }                                                                                                          \
    for (int i = 1; i < CHAINS; ++i)                                                                           \
        (chains)[0] += (chains)[i];                                                                            \
    *(double *)result = (chains)[0][0];

__attribute__((target("avx2,fma"))) static void *fours(void *result)
{
    const __m256d factor = _mm256_set1_pd(0.999), addend = _mm256_set1_pd(1e-3);
    __m256d chains[CHAINS];
    LOOP(__m256d, _mm256_fmadd_pd, chains)
    return NULL;
}

__attribute__((target("avx512f"))) static void *eights(void *result)
{
    const __m512d factor = _mm512_set1_pd(0.999), addend = _mm512_set1_pd(1e-3);
    __m512d chains[CHAINS];
    LOOP(__m512d, _mm512_fmadd_pd, chains)
    return NULL;
}

double peak_seconds(int doubles, int threads)
{
    __builtin_cpu_init();
    if (!__builtin_cpu_supports("fma") || (doubles == 8 && !__builtin_cpu_supports("avx512f")))
        return 0.0;
    void *(*work)(void *) = doubles == 8 ? eights : fours;
    double best = 1e9, results[2];
    for (int i = 0; i < TRIES; ++i) {
        pthread_t thread;
        const double start = seconds();
        const int two = threads == 2 && pthread_create(&thread, NULL, work, &results[1]) == 0;
        (void)work(&results[0]);
        if (two)
            pthread_join(thread, NULL);
        const double one = (seconds() - start) / ((double)CHAINS * TURNS);
        best = one < best ? one : best;
    }
    return best;
}
#else
double peak_seconds(int doubles, int threads)
{
    (void)doubles, (void)threads;
    return 0.0;
}
#endif
