/* waves.h - a bead that rolls in a field that travels along a line: the paper's free rolling with the field alone. */
#ifndef FST_PAPER_WAVES_H
#define FST_PAPER_WAVES_H

#include "paper/state.h"

#include <festoon/beads.h>

#include <stdio.h>

/* Sequences of runs, each from the end of the one before it: through the lock against the wave up and down, and, with as
 * much field from above as from below, through the lock with the wave, down. */
typedef enum { FST_WAVE_UP, FST_WAVE_DOWN, FST_WAVE_FORWARD, FST_WAVE_WAYS } fst_wave_way;
enum { FST_WAVE_DRIVES = 51, FST_WAVE_RATIOS = 9, FST_WAVE_STARTS = 8 };

/* What is asked in a number: where locks end, Hz, and the share of the field from above at which it wins. */
typedef enum { FST_WAVE_LOST, FST_WAVE_CAUGHT, FST_WAVE_KEPT, FST_WAVE_WINS, FST_WAVE_NUMBERS } fst_wave_number;
extern const char *const fst_wave_names[FST_WAVE_NUMBERS];

typedef struct fst_paper_waves {
    int drives;                                                              /* of a reduced paper fewer */
    double hertz[FST_WAVE_DRIVES], velocity[FST_WAVE_WAYS][FST_WAVE_DRIVES]; /* mm/s */
    fst_regime regime[FST_WAVE_WAYS][FST_WAVE_DRIVES];
    double
        share[FST_WAVE_RATIOS]; /* of beads let go at rest that end in the lock with the wave; NAN: not asked */
} fst_paper_waves;
extern const double fst_wave_ratios[FST_WAVE_RATIOS];

fst_status fst_paper_make_waves(fst_paper_state *paper, fst_error *error);

/* What was found, and what the pendulum's formulas say; NAN: it was not found. */
double fst_wave_found(const fst_paper_waves *waves, fst_wave_number number);
double fst_wave_formula(fst_wave_number number);

void fst_report_waves(FILE *out, const fst_paper_state *paper);

#endif
