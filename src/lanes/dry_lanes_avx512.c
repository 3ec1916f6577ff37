/* dry_lanes_avx512.c - eight lanes of AVX-512 with fused operations, for dry contacts */
#define ENGINE fst_dry_lanes_avx512
#define FST_LANES 8
#define FST_FUSED
#define FST_DRY_LANES
#include "lanes/lanes.inl"
