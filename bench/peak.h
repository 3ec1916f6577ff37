/* peak.h - how fast this core does nothing but fused multiplications and additions. */
#ifndef FST_BENCH_PEAK_H
#define FST_BENCH_PEAK_H

/* Seconds that one operation on `doubles` numbers at once (4 or 8) takes where a core works at nothing else;
 * with two threads, where two do so side by side.  The best of some tries; 0 where the processor has no such
 * instructions. */
double peak_seconds(int doubles, int threads);

#endif
