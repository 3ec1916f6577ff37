/* dry_lanes_avx2.c - four lanes of AVX2 with fused operations, for dry contacts */
#define ENGINE fst_dry_lanes_avx2
#define FST_LANES 4
#define FST_FUSED
#define FST_DRY_LANES
#include "lanes/lanes.inl"
