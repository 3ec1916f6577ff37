/* lanes_portable4.c - four lanes of AVX2 in the portable form */
#define ENGINE fst_lanes_portable4
#define FST_LANES 4
#include "lanes/lanes.inl"
