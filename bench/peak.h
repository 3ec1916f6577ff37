/* peak.h - how fast this core does nothing but fused multiplications and additions. */
#ifndef FST_BENCH_PEAK_H
#define FST_BENCH_PEAK_H

/* Seconds for one operation on `doubles` numbers at once (4 or 8) on a core that does nothing else; with two
 * threads, while two cores do so side by side. The best of some tries; 0 if the processor lacks the
 * instructions. */
double peak_seconds(int doubles, int threads);

#endif
