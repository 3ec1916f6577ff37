/* lanes_avx2.c - four lanes of AVX2 with fused operations */
#define ENGINE fst_lanes_avx2
#define FST_LANES 4
#define FST_FUSED
#include "lanes/lanes.inl"
