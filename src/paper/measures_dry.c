/* measures_dry.c - numbers of a bead that rubs dry, where those of the viscous law rest on its branches. */
#include "paper/dry.h"
#include "paper/measures_parts.h"

MEASURE(dry_corotation)
{
    const fst_paper_run *runs = paper->scans[FST_SCAN_SLOW][dynamics];
    const int count = paper->counts[FST_SCAN_SLOW];
    int next = 0;
    while (next < count && fst_outcome(&runs[next].result) == FST_OUTCOME_WITH)
        ++next;
    if (next == 0 || next == count)
        return NAN;
    (void)snprintf(note, size,
                   "released at rest, the bead goes with the magnet at %.2f Hz; at the next drive, %.2f Hz: %s",
                   runs[next - 1].result.frequency_hz, runs[next].result.frequency_hz,
                   fst_outcome_names[fst_outcome(&runs[next].result)]);
    return 0.5 * (runs[next - 1].result.frequency_hz + runs[next].result.frequency_hz);
}

MEASURE(dry_irregular)
{
    static const fst_scan both[] = {FST_SCAN_COMPARISON, FST_SCAN_SLOW};
    int all = 0, gone = 0, chaotic = 0;
    for (int s = 0; s < 2; ++s) {
        for (int i = 0; i < paper->counts[both[s]]; ++i) {
            const fst_run_result *result = &paper->scans[both[s]][dynamics][i].result;
            if (result->frequency_hz < 7.0 || result->frequency_hz > 10.0)
                continue;
            const fst_dry_outcome outcome = fst_outcome(result);
            ++all;
            gone += outcome == FST_OUTCOME_EJECTED || outcome == FST_OUTCOME_LIFTED;
            chaotic += result->regime == FST_REGIME_CHAOTIC;
        }
    }
    (void)snprintf(
        note, size,
        "%d of %d runs between 7 and 10 Hz leave the plate, %d are chaotic on it; undecided ones, most "
        "of which roll ever longer, are not counted",
        gone, all, chaotic);
    return all > 0 ? 100.0 * (gone + chaotic) / all : NAN;
}
