/* lanes_avx2.c - four lanes of AVX2 with fused operations */
#include "ensemble/engines.h"

#ifdef FST_HAVE_LANES
#include "ode/path_stages.h"

/* The bodies are compiled once more, for lanes. */
#undef ENDS
#undef ENDS_GROUPS
#undef ENDS_OF
#undef ENDS_SQRT
#undef END
#undef REAL
#undef R
#undef FN
#undef REAL_SQRT
#undef REAL_ABS
#undef REAL_MAX
#undef REAL_RECIPROCAL_SQRT
#undef REAL_OF
#undef REAL_MULADD
#undef REAL_MULSUB
#undef REAL_NEGMULADD

#define FST_LANES 4
#define FST_FUSED
#include "base/wide.h"

#define ENGINE fst_lanes_avx2
#define ENGINE_NAME "avx2"
#define ENGINE_FUSED 1
#include "ensemble/lanes.inl"
#endif
