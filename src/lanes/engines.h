/* engines.h - the engines that this build has. */
#ifndef FST_LANES_ENGINES_H
#define FST_LANES_ENGINES_H

#include "lanes/lanes.h"

#if defined(__x86_64__) && defined(__GNUC__)
#define FST_HAVE_LANES 1
extern const fst_lane_engine fst_lanes_portable4, fst_lanes_portable8, fst_lanes_avx2, fst_lanes_avx512;
extern const fst_lane_engine fst_dry_lanes_portable4, fst_dry_lanes_portable8, fst_dry_lanes_avx2,
    fst_dry_lanes_avx512;
#endif

#endif
