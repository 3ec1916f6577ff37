/* rows.c - many runs, one after another or side by side. */
#include "base/error.h"
#include "base/listed.h"
#include "study/lane_rows.h"

const char *fst_arithmetic_name(fst_arithmetic arithmetic)
{
    FST_NAME_IN(FST_ARITHMETICS, arithmetic, "unknown");
}

fst_arithmetic fst_best_arithmetic(void)
{
    return fst_lane_engine_of(FST_ARITHMETIC_AVX512, 0) ? FST_ARITHMETIC_AVX512
           : fst_lane_engine_of(FST_ARITHMETIC_AVX2, 0) ? FST_ARITHMETIC_AVX2
                                                        : FST_ARITHMETIC_PORTABLE;
}

static fst_status single_rows(const fst_row_work *work, const fst_row_images *images, fst_error *error)
{
    fst_row_job job;
    int more = work->next(work->user, &job) > 0;
    while (more) {
        const fst_status status = fst_row_alone(work, images, &job, &more, error);
        if (status != FST_OK)
            return status;
        more = more || work->next(work->user, &job) > 0;
    }
    return FST_OK;
}

fst_status fst_rows(const fst_row_work *work, fst_error *error)
{
    return fst_rows_with_images(work, NULL, error);
}

fst_status fst_rows_with_images(const fst_row_work *work, const fst_row_images *images, fst_error *error)
{
    const fst_lane_engine *engine = fst_lane_engine_of(work->arithmetic, work->lanes);
    if (!engine && (work->arithmetic != FST_ARITHMETIC_PORTABLE || work->lanes > 1))
        return fst_fail(error, FST_UNAVAILABLE, "",
                        "this processor or build has no %d lanes of the arithmetic %s", work->lanes,
                        fst_arithmetic_name(work->arithmetic));
    return engine ? fst_lane_rows(work, images, engine, error) : single_rows(work, images, error);
}
