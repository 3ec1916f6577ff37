/* measure_cases.h - one film of a bead that the library moves, measured. */
#ifndef FST_TESTS_MEASURE_CASES_H
#define FST_TESTS_MEASURE_CASES_H

#include "measure_coverage.h"

/* The settled motion at a drive, followed for so many seconds. */
static inline made_motion motion_at(double hertz, double seconds)
{
    made_motion motion;
    fst_params params = fst_default_params();
    params.drive_frequency = hertz;
    params.run_periods = ceil((seconds + 1.0) * hertz) + 150.0;
    params.run_discard = 150.0;
    params.run_rtol = 1e-9;
    made_motion_follow(&motion, &params);
    return motion;
}

static inline fst_measurement measured(const made_motion *motion, const made_film *film, double drive,
                                       double exposure, fst_track *track)
{
    fst_measure_options options = fst_default_measure_options();
    fst_measurement m;
    fst_error error = {FST_OK, "", ""};
    options.drive = drive;
    options.exposure = exposure;
    made_track(motion, film, track);
    if (fst_measure_track(track, &options, &m, &error) != FST_OK)
        fail_msg("%s", error.sentence);
    return m;
}

static inline void assert_near(double found, double error, double truth)
{
    if (!(fabs(found - truth) < 4.0 * error))
        fail_msg("%.9g +- %.3g, but the truth is %.9g", found, error, truth);
}

#endif
