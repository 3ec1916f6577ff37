/* lanes_portable8.c - eight lanes of AVX-512 in the portable form */
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

#define FST_LANES 8

#include "base/wide.h"

#define ENGINE fst_lanes_portable8
#define ENGINE_NAME "portable"
#define ENGINE_FUSED 0
#include "ensemble/lanes.inl"
#endif
