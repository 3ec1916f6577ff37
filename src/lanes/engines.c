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

typedef struct engines {
    const fst_lane_engine *usual, *dry;
    fst_arithmetic arithmetic;
} engines;

static const engines ALL[] = {{&fst_lanes_avx512, &fst_dry_lanes_avx512, FST_ARITHMETIC_AVX512},
                              {&fst_lanes_avx2, &fst_dry_lanes_avx2, FST_ARITHMETIC_AVX2},
                              {&fst_lanes_portable8, &fst_dry_lanes_portable8, FST_ARITHMETIC_PORTABLE},
                              {&fst_lanes_portable4, &fst_dry_lanes_portable4, FST_ARITHMETIC_PORTABLE}};
#endif

const fst_lane_engine *fst_lane_engine_of(fst_arithmetic arithmetic, int lanes)
{
#ifdef FST_HAVE_LANES
    for (size_t i = 0; i < sizeof ALL / sizeof *ALL; ++i) {
        const int width = ALL[i].usual->width;
        if (ALL[i].arithmetic == arithmetic && (lanes == 0 || lanes == width) && processor_has(width))
            return ALL[i].usual;
    }
#else
    (void)arithmetic;
    (void)lanes;
#endif
    return NULL;
}

const fst_lane_engine *fst_dry_lane_engine_of(const fst_lane_engine *engine)
{
#ifdef FST_HAVE_LANES
    for (size_t i = 0; i < sizeof ALL / sizeof *ALL; ++i)
        if (ALL[i].usual->width == engine->width && ALL[i].usual->fused == engine->fused)
            return ALL[i].dry;
#else
    (void)engine;
#endif
    return NULL;
}
