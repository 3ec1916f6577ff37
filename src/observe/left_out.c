/* left_out.c - what becomes of a window in which the motion repeats itself.
 *
 * Observing costs more than integrating.  Where successive returns agree to the accuracy of the integration, the
 * next ones bring nothing new: the motion still goes on step by step, but is not looked at until shortly before
 * the window's end.
 *
 *     observed      |--o--o--o--o--o                              o--o--o--o--|
 *     left out                      . . . . . . . . . . . . . . .
 *     marks               P  L                                    R  S
 *
 * How many returns were left out follows from Phi, which is always followed.  The mean of a quantity q over
 * them lies between that of the return P L and that of the return R S: where returns approach a limit by a
 * factor rho each, the means of q do so too, and
 *
 *     mean over n returns = m + w (m_PL - m),   w = rho (1 - rho^n)/(n (1 - rho)),   m = m_RS.
 *
 * rho is the ratio of the distances at L and P.  The integral at R is that at L and this mean times the time
 * between them; the marks of the returns left out lie on the straight line from L to R.
 *
 * An orbit that repeats may still be left: neighbours of an unstable one come close and part again.  Then R is
 * another state than L, and the caller observes the whole run anew.
 */
#include "observe/left_out.h"

#include <math.h>
#include <string.h>

#include "base/constants.h"

/* In returns: what is observed before the window's end, and what is worth the trouble. */
static const double OBSERVED_AT_END = 6.0, WORTHWHILE = 4.0;
/* The state may have moved by so many times the limit over the part. */
static const double STILL_THE_SAME = 100.0;

/* Greatest error of a mean that may come in, in the integration's tolerance or the default one. */
static const double CERTAIN = 0.5;

/* The marks of a part. */
enum { FIRST, BEFORE, LAST, AFTER };

double fst_left_out_turn(const fst_left_out *part)
{
    return fst_time_between(&part->mark[BEFORE], &part->mark[LAST]);
}

double fst_left_out_until(const fst_left_out *part, const fst_span *span)
{
    return span->until - OBSERVED_AT_END * fst_left_out_turn(part);
}

/* The factor by which successive returns come closer; 1: they do not, or it is not known. */
static double approach(const fst_left_out *part)
{
    const double rho = part->mark[LAST].full_distance / part->mark[BEFORE].full_distance;
    return rho >= 0 && rho < 1.0 ? rho : 1.0;
}

/* Whether the means over so many returns are known from those at both ends.  Means that still approach a limit
 * sum up to their last change over (1 - rho)^2; what changes without approaching one is an error of quadrature,
 * which only many returns average out. */
static int is_certain(const fst_left_out *part, double returns)
{
    const double slowness = fmax(1.0 - approach(part), 1.0 / returns),
                 sum = 1.0 / (slowness * slowness * returns);
    const double certain = CERTAIN * fmax(part->rtol, FST_DEFAULT_RTOL);
    for (int i = 0; i < FST_Q_COUNT; ++i) {
        const double now = fst_mean_between(&part->mark[BEFORE], &part->mark[LAST], i);
        const double change = fabs(now - fst_mean_between(&part->mark[FIRST], &part->mark[BEFORE], i));
        if (!(change * fmax(sum, 1.0) <= certain * fmax(fabs(now), 1.0)))
            return 0;
    }
    return 1;
}

int fst_left_out_begin(fst_left_out *part, const fst_mark_series *marks, const fst_span *span)
{
    const fst_mark *now = &marks->latest;
    const int repeats = marks->offered >= 3 && now->full_distance < part->limit;
    if (part->state >= FST_LEFT_OUT_AWAY)
        return 0;
    if (part->state > FST_LEFT_OUT_NOTHING)
        part->mark[part->state - FST_LEFT_OUT_BEFORE] = *now;
    if (part->state < FST_LEFT_OUT_LAST || !repeats) {
        part->state = repeats ? part->state + 1 : FST_LEFT_OUT_NOTHING;
        return 0;
    }
    const double returns = (fst_left_out_until(part, span) - now->t.high) / fst_left_out_turn(part);
    if (!(returns > WORTHWHILE))
        part->state = FST_LEFT_OUT_NEVER;
    else if (is_certain(part, returns))
        part->state = FST_LEFT_OUT_AWAY;
    else /* the three marks move on by one return */
        memmove(part->mark, part->mark + 1, 2 * sizeof *part->mark);
    return part->state == FST_LEFT_OUT_AWAY;
}

int64_t fst_left_out_count(fst_left_out *part, const fst_mark *crossing)
{
    const double half_turns = fabs(crossing->bead_angle - part->mark[LAST].bead_angle) / (0.5 * FST_TWO_PI);
    part->crossings = llround(half_turns) - 1;
    part->is_counted = 1;
    return part->crossings;
}

/* w of the scheme above. */
static double weight_of_before(const fst_left_out *part)
{
    const double rho = approach(part), n = (double)part->returns;
    return rho < 0.999 ? rho * (1.0 - pow(rho, n)) / (n * (1.0 - rho)) : 0.5;
}

/* A mark between two others. */
static fst_mark between(const fst_mark *from, const fst_mark *to, double x)
{
    fst_mark mark = *from;
    mark.t = fst_twofold_add(from->t, x * fst_time_between(from, to));
    for (int i = 0; i < FST_Q_COUNT; ++i)
        mark.integrals[i] += x * (to->integrals[i] - from->integrals[i]);
    mark.bead_angle += x * (to->bead_angle - from->bead_angle);
    mark.moment_angle += x * (to->moment_angle - from->moment_angle);
    mark.captures += llround(x * (double)(to->captures - from->captures));
    return mark;
}

/* Add to q, and to a mark, what the part lacks. */
static void complete(const fst_left_out *part, const fst_mark *second, fst_mark *first, fst_quadrature *q)
{
    const fst_mark *p = &part->mark[BEFORE], *l = &part->mark[LAST];
    const double time = fst_time_between(l, first), w = weight_of_before(part);
    for (int i = 0; i < FST_Q_COUNT; ++i) {
        const double late = fst_mean_between(first, second, i), early = fst_mean_between(p, l, i);
        q->left_out[i] = l->integrals[i] + (late + w * (early - late)) * time - first->integrals[i];
        first->integrals[i] += q->left_out[i];
    }
    q->lacks_part = 1;
    const double turn = second->moment_angle - first->moment_angle;
    q->left_out_moment_angle = l->moment_angle + (double)part->returns * turn - first->moment_angle;
    first->moment_angle += q->left_out_moment_angle;
}

void fst_left_out_end(fst_left_out *part, const fst_mark *crossing, fst_mark_series *marks, fst_quadrature *q)
{
    if (part->state == FST_LEFT_OUT_FIRST) {
        part->mark[AFTER] = *crossing;
        part->returns = llround(fabs(crossing->bead_angle - part->mark[LAST].bead_angle) / FST_TWO_PI);
        part->state =
            crossing->full_distance < STILL_THE_SAME * part->limit ? FST_LEFT_OUT_SECOND : FST_LEFT_OUT_FAILED;
        return;
    }
    fst_mark first = part->mark[AFTER], second = *crossing;
    complete(part, crossing, &first, q);
    for (int64_t i = 1; i < part->returns; ++i) {
        const fst_mark left_out = between(&part->mark[LAST], &first, (double)i / (double)part->returns);
        fst_marks_offer(marks, &left_out);
    }
    fst_marks_offer(marks, &first);
    for (int i = 0; i < FST_Q_COUNT; ++i)
        second.integrals[i] += q->left_out[i];
    second.moment_angle += q->left_out_moment_angle;
    fst_marks_offer(marks, &second);
    part->state = FST_LEFT_OUT_DONE;
}
