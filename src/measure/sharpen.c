/* sharpen.c - undoing a long exposure.
 *
 * A frame shows the bead's place averaged over the exposure T.  An oscillation of the place with the frequency
 * f keeps the fraction sinc = sin(pi f T)/(pi f T).  The place as a complex number oscillates with f_bead + k
 * f0 for whole k: these waves are fitted, and what each of them lost is added again.
 */
#include "measure/work.h"

#include <stdlib.h>

#include "base/constants.h"

enum { WAVES = 6 }; /* k from -6 to 6: twice 13 columns */

typedef struct wave {
    double frequency, lost; /* 1/sinc - 1 */
} wave;

double measure_kept(double frequency, double exposure)
{
    const double angle = FST_PI * frequency * exposure;
    return fabs(angle) > 1e-9 ? sin(angle) / angle : 1.0;
}

/* The waves that this frame rate tells apart.  Returns their number. */
static int choose_waves(const measure_work *work, double exposure, wave waves[2 * WAVES + 1], int *too_long)
{
    const double apart = 1.5 / measure_duration(work);
    const int most = work->f0 > 0 ? WAVES : 0;
    int count = 0;
    *too_long = 0;
    for (int i = 0; i <= 2 * most; ++i) {
        const int k = i % 2 ? (i + 1) / 2 : -i / 2; /* 0, 1, -1, 2, -2, ... */
        const double f = work->bead + k * work->f0;
        int hidden = 0;
        for (int j = 0; j < count; ++j) {
            const double difference = f - waves[j].frequency;
            hidden |= fabs(difference - work->fps * round(difference / work->fps)) < apart;
        }
        const double kept = measure_kept(f, exposure);
        if (hidden) {
            *too_long |= abs(k) <= 2 && kept < 0.98;
            continue;
        }
        if (kept < MEASURE_LEAST_KEPT) { /* what is still seen is mostly noise */
            *too_long |= k == 1 || k == 2;
            continue;
        }
        waves[count++] = (wave){f, 1.0 / kept - 1.0};
    }
    return count;
}

/* The columns of x (part 0) and of y (part 1) of the waves. */
static void wave_row(const wave *waves, int count, double t, int part, double *row)
{
    for (int i = 0; i < count; ++i) {
        const double angle = FST_TWO_PI * waves[i].frequency * t, c = cos(angle), s = sin(angle);
        row[2 * i] = part ? s : c;
        row[2 * i + 1] = part ? c : -s;
    }
}

int measure_sharpen(measure_work *work)
{
    wave waves[2 * WAVES + 1];
    double row[MEASURE_MOST_COLUMNS];
    int too_long;
    const int count = choose_waves(work, work->exposure, waves, &too_long);
    const double *m = work->stretch, det = m[0] * m[2] - m[1] * m[1];
    measure_regression fit;
    measure_regression_begin(&fit, 2 * count);
    for (size_t i = 0; i < work->count; ++i)
        for (int part = 0; part < 2; ++part) {
            wave_row(waves, count, work->t[i], part, row);
            measure_regression_add(&fit, row, work->r[i] * (part ? sin(work->alpha[i]) : cos(work->alpha[i])));
        }
    measure_regression_solve(&fit);
    for (int i = 0; i < 2 * count; ++i)
        fit.coefficient[i] *= waves[i / 2].lost;
    for (size_t i = 0; i < work->count; ++i) {
        wave_row(waves, count, work->t[i], 0, row);
        const double px = measure_regression_value(&fit, row);
        wave_row(waves, count, work->t[i], 1, row);
        const double py = measure_regression_value(&fit, row);
        work->x[i] += (m[2] * px - m[1] * py) / det;
        work->y[i] += (m[0] * py - m[1] * px) / det;
    }
    return too_long;
}
