/* drive.h - the phase of the drive over double, and vectors in the laboratory (drive.c). */
#ifndef FST_MODEL_DRIVE_H
#define FST_MODEL_DRIVE_H

#include "model/model.h"

/* From the time t on the rate changes at `ramp`; the rate and the phase at t stay what they were. */
void fst_drive_change(fst_drive_double *d, fst_twofold t, double ramp);

/* Turns of the magnet since the time 0: whole turns, and the rest in [0, 1). */
void fst_drive_turns(const fst_drive_double *d, fst_twofold t, double *whole, double *rest);

/* A vector of the turning axes on those of the laboratory, which the magnet's were at the time 0; `rest` is the
 * part of a turn that it has made since. */
void fst_drive_to_laboratory(double rest, const double turning[3], double laboratory[3]);

#endif
