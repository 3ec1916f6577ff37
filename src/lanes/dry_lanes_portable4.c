/* dry_lanes_portable4.c - four lanes of AVX2 in the portable form, for dry contacts */
#define ENGINE fst_dry_lanes_portable4
#define FST_LANES 4
#define FST_DRY_LANES
#include "lanes/lanes.inl"
