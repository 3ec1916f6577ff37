/* dry_lanes_portable4.c - four lanes of AVX2 in the portable form, for dry contacts */
#include "lanes/engines.h"

#ifdef FST_HAVE_LANES
#define FST_DRY_LANES
#define FST_LANES 4

#include "base/wide.h"

#define ENGINE fst_dry_lanes_portable4
#define ENGINE_NAME "portable"
#define ENGINE_FUSED 0
#include "lanes/lanes.inl"
#endif
