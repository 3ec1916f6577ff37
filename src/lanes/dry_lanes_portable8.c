/* dry_lanes_portable8.c - eight lanes of AVX-512 in the portable form, for dry contacts */
#include "lanes/engines.h"

#ifdef FST_HAVE_LANES
#define FST_DRY_LANES
#define FST_LANES 8

#include "base/wide.h"

#define ENGINE fst_dry_lanes_portable8
#define ENGINE_NAME "portable"
#define ENGINE_FUSED 0
#include "lanes/lanes.inl"
#endif
