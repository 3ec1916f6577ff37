/* engines.c - choosing an engine by the processor. */
#include "lanes/engines.h"

#ifdef FST_HAVE_LANES
/* What the flags of the engines' files ask of the processor and the operating system (src/CMakeLists.txt). */
static int processor_has(int width)
{
    __builtin_cpu_init();
    if (!__builtin_cpu_supports("avx2") || !__builtin_cpu_supports("fma"))
        return 0;
    return width == 4 || (__builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512dq"));
}
#endif

const fst_lane_engine *fst_lane_engine_of(fst_arithmetic arithmetic, int lanes)
{
#ifdef FST_HAVE_LANES
    static const fst_lane_engine *const engines[] = {&fst_lanes_avx512, &fst_lanes_avx2, &fst_lanes_portable8,
                                                     &fst_lanes_portable4};
    static const fst_arithmetic forms[] = {FST_ARITHMETIC_AVX512, FST_ARITHMETIC_AVX2, FST_ARITHMETIC_PORTABLE,
                                           FST_ARITHMETIC_PORTABLE};
    for (int i = 0; i < 4; ++i)
        if (forms[i] == arithmetic && (lanes == 0 || lanes == engines[i]->width) &&
            processor_has(engines[i]->width))
            return engines[i];
#else
    (void)arithmetic;
    (void)lanes;
#endif
    return NULL;
}
