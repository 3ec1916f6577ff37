/* dry_lanes_avx512.c - eight lanes of AVX-512 with fused operations, for dry contacts */
#include "lanes/engines.h"

#ifdef FST_HAVE_LANES
#define FST_DRY_LANES
#define FST_LANES 8
#define FST_FUSED
#include "base/wide.h"

#define ENGINE fst_dry_lanes_avx512
#define ENGINE_NAME "avx512"
#define ENGINE_FUSED 1
#include "lanes/lanes.inl"
#endif
