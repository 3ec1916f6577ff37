/* waveform.h - how the magnet moves: its angle, rate and place at any time (drive.waveform). */
#ifndef FST_MODEL_WAVEFORM_H
#define FST_MODEL_WAVEFORM_H

#include <festoon/festoon.h>

enum { FST_TABLE_MOST = FST_PARAM_TEXT_SIZE / 4 };

/* In scaled time and radians. */
typedef struct fst_waveform {
    int kind; /* fst_drive_waveform */
    double omega, amplitude, chirp;
    double velocity[3];
    int count, piece; /* rows of the table; the one that begins the piece in use, -1: before all of them */
    double times[FST_TABLE_MOST], angles[FST_TABLE_MOST];
} fst_waveform;

/* That of settled parameters, with the scaled rate omega. FST_BAD_INPUT: the table of drive.table is none. */
fst_status fst_make_waveform(const fst_params *params, const fst_groups *g, fst_waveform *wave,
                             fst_error *error);

/* Use the piece of the table that begins at t, or in which t lies, for all times until another one is entered: a step
 * that ends where the rate jumps has the rate before the jump. 0: it is in use already. */
int fst_waveform_enter(fst_waveform *wave, double t);

double fst_waveform_angle(const fst_waveform *wave, double t);
double fst_waveform_rate(const fst_waveform *wave, double t);

/* The time after which the drive repeats itself; INFINITY: it does not. */
double fst_waveform_period(const fst_waveform *wave);

/* The time at which the piece in use ends; INFINITY: it does not. */
double fst_waveform_jump(const fst_waveform *wave);

#endif
