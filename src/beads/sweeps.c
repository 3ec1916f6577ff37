/* sweeps.c - the impulses of all contacts of a time step, by projected Gauss-Seidel.
 *
 * A contact has a push p along u and a rub q across it.  With V the slip, before the step and after it:
 *
 *     push          0 <= p   complementary to   d(gap)/dt after - least >= 0
 *     viscous rub   q = -(h c/2) (V before + V after)             while p > 0
 *     dry rub       |q| <= mu p;  V after = 0, or q is opposite to it and |q| = mu p
 *
 * One contact alone is solved exactly, because a push changes no slip of its own contact and a rub not its gap, and
 * spheres answer a rub in its own direction, by ease[1] = 1/m + 1/m' + R^2/I + R'^2/I'.  A sweep solves one contact after
 * the other, forwards and then backwards, with what the others have become.
 *
 * With viscous friction there may be no solution (select.c): a contact that grazes presses if it does not rub, and
 * does not press if it rubs.  After MOST_FREE sweeps contacts rub that press then and no others, for the rest of
 * the step; so the problem is convex and sweeps end.  In the mean over steps a contact that grazes has its share of
 * the friction.
 */
#include "beads/sweeps.h"

#include <math.h>

#include "beads/act.h"

enum { MOST_FREE = 200, MOST_SWEEPS = 2000 };

/* As fmax(), of numbers that are some: a comparison and no call. */
static inline double larger(double a, double b)
{
    return a > b ? a : b;
}

#define ALWAYS static inline __attribute__((always_inline)) /* a call would cost as much as its work */

ALWAYS void slip_of(const beads_touch *touch, const double *speeds, double slip[3], double *rate)
{
    const double *a = speeds + BEADS_SPEEDS * touch->first, *b = speeds + BEADS_SPEEDS * touch->second;
    const double v[3] = {a[0] - b[0], a[1] - b[1], a[2] - b[2]};
    const double turning[3] = {touch->arm[0] * a[3] + touch->arm[1] * b[3],
                               touch->arm[0] * a[4] + touch->arm[1] * b[4],
                               touch->arm[0] * a[5] + touch->arm[1] * b[5]};
    beads_slip(touch->u, v, turning, slip);
    *rate = -beads_dot(v, touch->u);
}

void beads_touch_slip(const beads_touch *touch, const double *speeds, double slip[3], double *rate)
{
    slip_of(touch, speeds, slip, rate);
}

ALWAYS void apply(const beads_touch *touch, double push, const double rub[3], double *speeds)
{
    double *a = speeds + BEADS_SPEEDS * touch->first, *b = speeds + BEADS_SPEEDS * touch->second, turn[3];
    fst_cross_double(touch->u, rub, turn);
    for (int m = 0; m < 3; ++m) {
        const double impulse = rub[m] - push * touch->u[m];
        a[m] += touch->inverse[0] * impulse;
        b[m] -= touch->inverse[1] * impulse;
        a[3 + m] += touch->spin[0] * turn[m];
        b[3 + m] += touch->spin[1] * turn[m];
    }
}

/* The rub that this contact wants, the push being as it is. */
ALWAYS void rub_wanted(const beads_touch *touch, const double slip[3], double push, double wanted[3])
{
    if (touch->mu > 0) {
        double size = 0.0;
        for (int m = 0; m < 3; ++m) {
            wanted[m] = touch->rubbed[m] - slip[m] / touch->ease[1];
            size += wanted[m] * wanted[m];
        }
        const double most = touch->mu * push;
        const double share = size > most * most ? most / sqrt(size) : 1.0;
        for (int m = 0; m < 3; ++m)
            wanted[m] *= share;
        return;
    }
    for (int m = 0; m < 3; ++m)
        wanted[m] = -touch->rub * (touch->slip[m] + slip[m] - touch->ease[1] * touch->rubbed[m]);
}

/* What a contact wants to be changed: of its push, and of its rub.  Returns how far it is in the wrong, a speed. */
ALWAYS double change_wanted(const beads_touch *touch, const double *speeds, double *push, double rub[3])
{
    double slip[3], rate;
    slip_of(touch, speeds, slip, &rate);
    const double wanted = touch->push - (rate - touch->least) / touch->ease[0],
                 found = wanted > 0 ? wanted : 0.0;
    *push = found - touch->push;
    rub[0] = rub[1] = rub[2] = 0.0;
    double wrong = touch->ease[0] * fabs(*push);
    if (touch->rub > 0 || touch->mu > 0) {
        if (touch->rubs == BEADS_RUBS || (touch->rubs == BEADS_RUBS_PRESSING && found > 0))
            rub_wanted(touch, slip, found, rub);
        for (int m = 0; m < 3; ++m) {
            rub[m] -= touch->rubbed[m];
            wrong = larger(wrong, touch->ease[1] * fabs(rub[m]));
        }
    }
    return wrong;
}

ALWAYS double solve_one(beads_touch *touch, double *speeds)
{
    double push, rub[3];
    const double wrong = change_wanted(touch, speeds, &push, rub);
    if (wrong == 0.0)
        return 0.0;
    touch->push += push;
    for (int m = 0; m < 3; ++m)
        touch->rubbed[m] += rub[m];
    apply(touch, push, rub, speeds);
    return wrong;
}

/* Contacts go on as they are: with friction, or without. */
static void freeze(beads_touch *touches, int count)
{
    for (int c = 0; c < count; ++c)
        if (touches[c].rub > 0)
            touches[c].rubs = touches[c].push > 0 ? BEADS_RUBS : BEADS_RUBS_NOT;
}

double beads_sweep(beads_touch *touches, int count, double tolerance, double *speeds, uint64_t *sweeps)
{
    double worst = INFINITY, push, rub[3];
    for (int c = 0; c < count; ++c)
        apply(&touches[c], touches[c].push, touches[c].rubbed, speeds);
    for (int sweep = 0; sweep < MOST_SWEEPS && worst > tolerance && count; ++sweep, ++*sweeps) {
        worst = 0.0;
        if (sweep == MOST_FREE)
            freeze(touches, count);
        for (int c = 0; c < count; ++c)
            worst = larger(worst, solve_one(&touches[sweep % 2 ? count - 1 - c : c], speeds));
    }
    worst = 0.0;
    for (int c = 0; c < count; ++c)
        worst = larger(worst, change_wanted(&touches[c], speeds, &push, rub));
    return worst;
}
