/* dry_lanes_portable8.c - eight lanes of AVX-512 in the portable form, for dry contacts */
#define ENGINE fst_dry_lanes_portable8
#define FST_LANES 8
#define FST_DRY_LANES
#include "lanes/lanes.inl"
