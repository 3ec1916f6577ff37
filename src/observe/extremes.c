/* extremes.c - the greatest and least r, |B|, angle, slip and load of a window, located within steps.
 *
 * Most steps hold no new extreme, and to look into a step is dear: the dense output costs three evaluations of
 * the field, each value of a quantity on it another one.  So every step is asked first whether it may hold one:
 *
 *      record - - - - - - - - - - - - - - - - - - -
 *                         . ^ .                        a parabola through the best place and its neighbours
 *                     x           x                    rises by less than what lacks to the record:
 *          x                            x      x       nothing is looked for
 *     places of the step (ode/path.h)
 *
 * peaks.inl is that question, with margins that leave none out (tests/observe/test_extremes.c).  Where the answer is
 * yes, the extreme is located on the dense output between the best place's neighbours.
 *
 * Lanes ask the same question of all their steps at once.  Those of the portable form bring the step here, so
 * that a row has the bits of a run; those of the fast form locate extremes in lanes too (lane_extremes.inl) and
 * hand in what they found by fst_extremes_offer().
 */
#include "observe/extremes.h"

#include <math.h>

#include "base/constants.h"
#include "observe/peaks.inl"

void fst_extremes_begin(fst_extreme extremes[FST_TRACK_COUNT])
{
    for (int i = 0; i < FST_TRACK_COUNT; ++i)
        extremes[i] = (fst_extreme){INFINITY, -INFINITY};
}

double fst_extremes_record(const fst_extreme extremes[FST_TRACK_COUNT], int record)
{
    const fst_extreme *e = &extremes[FST_RECORD_TRACKS[record]];
    return fst_record_sign(record) > 0 ? e->greatest : -e->least;
}

void fst_extremes_offer(fst_extreme extremes[FST_TRACK_COUNT], int record, double value)
{
    fst_extreme *e = &extremes[FST_RECORD_TRACKS[record]];
    if (fst_record_sign(record) > 0)
        e->greatest = value > e->greatest ? value : e->greatest;
    else
        e->least = -value < e->least ? -value : e->least;
}

/* ------------------------------------------------------------------ within a step */

/* A tracked quantity at the fraction x of the last step; what it does not look at, of the state and of the
 * magnet's pull, is not made. */
static double tracked_at(fst_flow *flow, double x, const void *what)
{
    const fst_world_double *c = fst_flow_world(flow);
    const fst_modes_double *m = fst_flow_modes(flow);
    const int which = *(const int *)what;
    const int first = which == FST_TRACK_SLIP ? FST_VX : FST_X;
    const int count = which == FST_TRACK_R || which == FST_TRACK_B ? 2 : FST_STATE_SIZE - first;
    double y[FST_NUMBERS] = {0.0}, unused[3];
    fst_pull_double p = {.strength = 0.0};
    fst_seen_double seen;
    fst_flow_components_at(flow, x, first, count, y + first);
    if (c->kinds.modes)
        fst_flow_components_at(flow, x, FST_STATE_SIZE, FST_NUMBERS - FST_STATE_SIZE, y + FST_STATE_SIZE);
    if (which == FST_TRACK_GAP || which == FST_TRACK_LOAD)
        (void)fst_renormalise_double(y);
    if (which == FST_TRACK_B || which == FST_TRACK_GAP)
        fst_field_along_double(c, y[FST_X], y[FST_Y], fst_height_of_double(c, m, y), y + FST_NX, p.b, unused);
    else if (which == FST_TRACK_LOAD)
        fst_magnetic_pull_double(c, m, y, &p);
    fst_see_double(c, m, 0.0, y, &p, &seen);
    return which == FST_TRACK_R      ? seen.r
           : which == FST_TRACK_B    ? seen.b_norm
           : which == FST_TRACK_GAP  ? seen.gap2
           : which == FST_TRACK_SLIP ? seen.slip2
                                     : seen.load;
}

/* The greatest sign * value of one quantity in the last step, if it may beat the record. */
static double best_in_step(const fst_quadrature *q, fst_flow *flow, int which, double sign, double record)
{
    const double end = sign * q->sums.tracked[FST_PATH_END][which]; /* the end lies on the trajectory exactly */
    if (end > record)
        record = end;
    const fst_peak_double top = fst_find_peak_double(&q->sums.tracked[0][which], FST_TRACK_COUNT, sign);
    if (!(fst_may_exceed_double(&top, record) > 0.0))
        return record;
    double value;
    (void)fst_flow_extreme(flow, tracked_at, &which, sign, top.before, top.after, &value);
    return sign * value > record ? sign * value : record;
}

/* The same from the fraction `from` on, looked for between all stages. */
static double best_in_rest(const fst_quadrature *q, fst_flow *flow, int which, double sign, double record,
                           double from)
{
    double best = fmax(sign * q->sums.tracked[FST_PATH_END][which], sign * tracked_at(flow, from, &which));
    for (int n = 1; n < FST_PATH_END; ++n) {
        const double before = fmax(FST_PATH_NODE[n - 1], from), after = FST_PATH_NODE[n + 1];
        double value;
        if (!(before < after))
            continue;
        (void)fst_flow_extreme(flow, tracked_at, &which, sign, before, after, &value);
        best = fmax(best, sign * value);
    }
    return fmax(record, best);
}

static double best_from(const fst_quadrature *q, fst_flow *flow, int which, double sign, double record,
                        double from)
{
    return from > 0.0 ? best_in_rest(q, flow, which, sign, record, from)
                      : best_in_step(q, flow, which, sign, record);
}

void fst_extremes_step(fst_extreme extremes[FST_TRACK_COUNT], const fst_quadrature *q, fst_flow *flow,
                       double from)
{
    for (int i = 0; i < FST_TRACK_COUNT; ++i) {
        fst_extreme *e = &extremes[i];
        const int has_least = i != FST_TRACK_GAP && i != FST_TRACK_SLIP;
        e->greatest = best_from(q, flow, i, 1.0, e->greatest, from);
        if (has_least)
            e->least = -best_from(q, flow, i, -1.0, -e->least, from);
    }
}

/* ------------------------------------------------------------------ what a result has */

void fst_extremes_fill(const fst_extreme extremes[FST_TRACK_COUNT], double gravity, fst_run_result *result)
{
    const fst_extreme *e = extremes;
    if (!(e[FST_TRACK_R].greatest > 0))
        return;
    result->min_r = e[FST_TRACK_R].least;
    result->max_r = e[FST_TRACK_R].greatest;
    result->min_b = e[FST_TRACK_B].least;
    result->max_b = e[FST_TRACK_B].greatest;
    result->max_angle_deg = FST_DEGREES * fst_angle_of_gap(e[FST_TRACK_GAP].greatest);
    result->max_slip = sqrt(e[FST_TRACK_SLIP].greatest);
    if (gravity > 0) {
        result->min_load_weights = e[FST_TRACK_LOAD].least / gravity;
        result->max_load_weights = e[FST_TRACK_LOAD].greatest / gravity;
    }
}
