/* drive.c - the phase of the drive, to twice the digits of a double, and vectors in the laboratory (drive.inl).
 */
#include "model/drive.h"

/* What the magnet has turned since the time 0, in radians. */
static fst_twofold phase(const fst_drive_double *d, fst_twofold t)
{
    const double on_ramp = fst_twofold_difference(t, d->since);
    const fst_twofold time = fst_twofold_add(fst_twofold_add(t, -d->since.high), -d->since.low);
    fst_twofold angle = fst_twofold_times(time, d->omega);
    if (on_ramp > 0)
        angle = fst_twofold_add(angle, 0.5 * d->ramp * (on_ramp * on_ramp));
    return fst_twofold_add(fst_twofold_add(angle, d->before.high), d->before.low);
}

void fst_drive_change(fst_drive_double *d, fst_twofold t, double ramp)
{
    *d = (fst_drive_double){
        .omega = fst_drive_rate_double(d, t), .ramp = ramp, .since = t, .before = phase(d, t)};
}

void fst_drive_turns(const fst_drive_double *d, fst_twofold t, double *whole, double *rest)
{
    /* The angle over 2 pi, with 1/(2 pi) as the sum of two doubles. */
    static const double inverse_high = 0.15915494309189535, inverse_low = -9.839338337591243e-18;
    const fst_twofold angle = phase(d, t);
    fst_twofold turns = fst_twofold_times(angle, inverse_high);
    turns = fst_twofold_add(turns, angle.high * inverse_low);
    *whole = floor(turns.high);
    *rest = (turns.high - *whole) + turns.low;
    if (*rest < 0) {
        *whole -= 1.0;
        *rest += 1.0;
    }
}

void fst_drive_to_laboratory(double rest, const double turning[3], double laboratory[3])
{
    const double c = cos(FST_TWO_PI * rest), s = sin(FST_TWO_PI * rest);
    laboratory[0] = c * turning[0] - s * turning[1];
    laboratory[1] = s * turning[0] + c * turning[1];
    laboratory[2] = turning[2];
}
