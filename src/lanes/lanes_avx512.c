/* lanes_avx512.c - eight lanes of AVX-512 with fused operations */
#define ENGINE fst_lanes_avx512
#define FST_LANES 8
#define FST_FUSED
#include "lanes/lanes.inl"
