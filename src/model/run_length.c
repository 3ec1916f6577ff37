/* run_length.c - how long a run is: in periods of the drive, which has a frequency in one of two forms. */
#include <math.h>

#include "base/constants.h"
#include "model/params.h"

double fst_run_discard(const fst_params *params)
{
    static const double unless_told = 200.0;
    const double periods = fst_run_periods(params);
    const int whole = periods > unless_told && isnan(params->run_duration);
    return params->run_discard == unless_told && !whole ? 0.5 * periods : params->run_discard;
}

double fst_drive_frequency(const fst_params *params)
{
    return isnan(params->drive_omega) ? params->drive_frequency
                                      : params->drive_omega * params->friction_gamma / FST_TWO_PI;
}

double fst_drive_periods(const fst_params *params, double t, double turns)
{
    return params->drive_waveform == FST_WAVEFORM_STEADY
               ? turns
               : t * fst_drive_frequency(params) / params->friction_gamma;
}

double fst_run_periods(const fst_params *params)
{
    return isnan(params->run_duration) ? params->run_periods
                                       : params->run_duration * fst_drive_frequency(params);
}
