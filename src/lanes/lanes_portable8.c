/* lanes_portable8.c - eight lanes of AVX-512 in the portable form */
#define ENGINE fst_lanes_portable8
#define FST_LANES 8
#include "lanes/lanes.inl"
