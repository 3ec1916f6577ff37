/* winding.c - how often the bead goes round the axis.
 *
 * The strongest line of the places x + i y need not be the bead's rate: where r swings far, as it does of a bead that goes
 * with the magnet, the places have a stronger one beside it, off by the rate f0 of the swings.  So the bead is followed
 * from place to place, where each step turns it by little.  Where a step is too large for that, the places are laid on the
 * phase of f0, seen from axes that turn with the line: there they make a closed curve,
 *
 *   z(t) exp(-2 pi i f t) = sum over k of c_k exp(2 pi i k f0 t)
 *
 * and if it goes round the axis, the line is not the bead's rate.
 */
#include "measure/work.h"

#include "base/constants.h"
#include "base/dot.h"

/* The largest step that is followed, rad, also where frames are lost in which the bead went as fast as it ever did: the
 * other way round it would be three halves of it. */
#define LARGEST_STEP (0.8 * FST_PI)
/* What of the places' size a curve may leave over that repeats itself. */
#define IRREGULAR 0.25
/* Waves on either side of the line, and moments of a swing at which their sum is looked at. */
enum { SIDES = 6, WAVES = 2 * SIDES + 1, MOMENTS = 256 };

int measure_follow(measure_work *work, double middle)
{
    double *turns = work->scratch, fastest = 0.0, longest = 1.0; /* of a frame; frames */
    turns[0] = 0.0;
    for (size_t i = 1; i < work->count; ++i) {
        const double step = work->alpha[i] - work->alpha[i - 1], whole = round(step / FST_TWO_PI);
        const double frames = fmax(1.0, round((work->t[i] - work->t[i - 1]) * work->fps));
        fastest = fmax(fastest, fabs(step - FST_TWO_PI * whole) / frames);
        longest = fmax(longest, frames);
        turns[i] = turns[i - 1] - whole;
    }
    if (fastest * longest > LARGEST_STEP)
        return 0;
    const size_t at = work->count / 2;
    const double off = round((middle - work->alpha[at]) / FST_TWO_PI) - turns[at];
    for (size_t i = 0; i < work->count; ++i)
        work->alpha[i] += FST_TWO_PI * (turns[i] + off);
    return 1;
}

/* The waves of the closed curve, by least squares over both coordinates. */
static void fit_curve(const measure_work *work, measure_regression *fit)
{
    measure_regression_begin(fit, 2 * WAVES);
    for (size_t i = 0; i < work->count; ++i) {
        const double turned = work->alpha[i] - FST_TWO_PI * work->bead * work->t[i];
        for (int part = 0; part < 2; ++part) {
            double row[2 * WAVES];
            for (int k = -SIDES; k <= SIDES; ++k) {
                const double angle = FST_TWO_PI * k * work->f0 * work->t[i], c = cos(angle), s = sin(angle);
                row[2 * (k + SIDES)] = part ? s : c;
                row[2 * (k + SIDES) + 1] = part ? c : -s;
            }
            measure_regression_add(fit, row, work->r[i] * (part ? sin(turned) : cos(turned)));
        }
    }
    measure_regression_solve(fit);
}

/* How often the curve goes round the axis in a swing. */
static double winding_of(const measure_regression *fit)
{
    double before = 0.0, turned = 0.0;
    for (int m = 0; m <= MOMENTS; ++m) {
        double x = 0.0, y = 0.0;
        for (int k = -SIDES; k <= SIDES; ++k) {
            const double angle = FST_TWO_PI * k * m / MOMENTS, c = cos(angle), s = sin(angle);
            const double *wave = fit->coefficient + 2 * (k + SIDES);
            x += wave[0] * c - wave[1] * s;
            y += wave[0] * s + wave[1] * c;
        }
        const double angle = atan2(y, x);
        turned += m > 0 ? remainder(angle - before, FST_TWO_PI) : 0.0;
        before = angle;
    }
    return turned / FST_TWO_PI;
}

measure_rate measure_look_at_rate(const measure_work *work)
{
    if (!(work->f0 > 0) || work->count < 8 * WAVES)
        return MEASURE_RATE_SURE;
    measure_regression fit;
    const double all = fst_dot(work->r, work->r, (int)work->count);
    fit_curve(work, &fit);
    const double left = all - fst_dot(fit.coefficient, fit.right, fit.columns);
    if (left > IRREGULAR * IRREGULAR * all)
        return work->followed ? MEASURE_RATE_IRREGULAR : MEASURE_RATE_UNKNOWN;
    return !work->followed && fabs(winding_of(&fit)) > 0.5 ? MEASURE_RATE_UNKNOWN : MEASURE_RATE_SURE;
}
