/* rows.c - many runs, one after another or side by side. */
#include <festoon/festoon.h>

#include "base/error.h"
#include "study/lane_rows.h"

const char *fst_arithmetic_name(fst_arithmetic arithmetic)
{
    static const char *const names[] = {"portable", "avx2", "avx512"};
    return (unsigned)arithmetic < sizeof names / sizeof *names ? names[arithmetic] : "unknown";
}

fst_arithmetic fst_best_arithmetic(void)
{
    return fst_lane_engine_of(FST_ARITHMETIC_AVX512, 0) ? FST_ARITHMETIC_AVX512
           : fst_lane_engine_of(FST_ARITHMETIC_AVX2, 0) ? FST_ARITHMETIC_AVX2
                                                        : FST_ARITHMETIC_PORTABLE;
}

static fst_status watch(void *user, double fraction, fst_error *error)
{
    const fst_row_work *work = user;
    (void)fraction;
    return work->stopped(work->user) ? fst_fail(error, FST_INTERRUPTED, "", "interrupted") : FST_OK;
}

/* One run after another. */
static fst_status single_rows(const fst_row_work *work, fst_error *error)
{
    fst_row_job job;
    int more = work->next(work->user, &job);
    while (more) {
        fst_run_options options = fst_default_run_options();
        union {
            const fst_row_work *constant;
            void *plain;
        } user = {work};
        options.sink.user = user.plain;
        options.sink.progress = watch;
        options.start = job.has_start ? job.start : NULL;
        fst_run_result result;
        fst_error own = {FST_OK, "", ""};
        const fst_status status = fst_run(&job.params, &options, &result, &own);
        if (status == FST_INTERRUPTED)
            return fst_fail(error, FST_INTERRUPTED, "", "interrupted");
        more = work->done(work->user, &job, status, &result, &own) || work->next(work->user, &job);
    }
    return FST_OK;
}

fst_status fst_rows(const fst_row_work *work, fst_error *error)
{
    const fst_lane_engine *engine = fst_lane_engine_of(work->arithmetic, work->lanes);
    if (engine)
        return fst_lane_rows(work, engine, error);
    if (work->arithmetic == FST_ARITHMETIC_PORTABLE && work->lanes <= 1)
        return single_rows(work, error);
    return fst_fail(error, FST_UNAVAILABLE, "", "this processor or build has no %d lanes of the arithmetic %s",
                    work->lanes, fst_arithmetic_name(work->arithmetic));
}
