/* returns.c - how the bead comes back to the section X = 0.
 *
 * A bead that turns about the magnet's axis crosses the section twice a turn, on the half Y > 0 and on the half
 * Y < 0, always in the same direction:
 *
 *                 Y
 *             --<-- x --<--           x  crossing on the half Y > 0: Phi = pi/2
 *            /      |      \          o  crossing on the half Y < 0: Phi = -pi/2
 *           |       |       |
 *      -----+-------+-------+--- X    Half a turn of the magnet reverses its field.  A bead at the opposite
 *           |       |       |         place with its moment reversed moves in the same way: this is the
 *            \      |      /          symmetry S2, which maps each o to its image on the half Y > 0.
 *             -->-- o -->--
 *
 * Regular turning is alternation, x o x o ..., in one direction; one break of it makes a window irregular. Each
 * state at a crossing, mapped to Y > 0, is compared with the one before (half a return ago) and with the one
 * before that (a whole return ago).  An orbit whose half returns come to the same point has the symmetry S2;
 * one whose whole returns alone do is closed without it.
 *
 * Every second crossing completes a whole return and is offered to the series of marks.  The means are taken
 * between marks of one half, so that the time between them is a whole number of returns.
 */
#include "observe/returns.h"

#include <math.h>
#include <string.h>

enum { LEAST_CROSSINGS = 6 }; /* of the section: for regular turning */

static int sign_of(double x)
{
    return (x > 0) - (x < 0);
}

void fst_returns_begin(fst_returns *r)
{
    memset(r, 0, sizeof *r);
    fst_marks_begin(&r->marks);
}

/* Alternating halves in one direction are what regular turning looks like. */
static void judge_alternation(fst_returns *r, int half, int direction)
{
    if (r->crossings > 0 && (half == r->last_half || direction != r->last_direction)) {
        r->irregular = 1;
        r->since_break = 0;
    }
    r->last_half = half;
    r->last_direction = direction;
    r->crossings += 1;
    r->since_break += 1;
}

void fst_returns_see_side(fst_returns *r, const fst_flow *flow)
{
    const int side = sign_of(flow->step.y[FST_X]);
    r->side = side ? side : r->side;
}

/* Whether a return that ends by the end of the flow's last step is needed whole: it may be kept, or be the last
 * of a regular turning, which lies no more than two returns before the window's end
 * (fst_returns_are_regular()). */
static int is_needed(const fst_returns *r, const fst_span *span, const fst_flow *flow)
{
    const fst_mark_series *marks = &r->marks;
    if (span->states_only)
        return 0;
    if (!span->asked_at_end || r->need_whole || marks->offered % marks->stride == 0 ||
        fst_left_out_needs_integrals(&r->left_out))
        return 1;
    const double turning = fst_twofold_difference(flow->t, marks->kept[0].t);
    return (span->until - flow->t.high) * (double)marks->offered <= 2.01 * turning;
}

int fst_returns_need_integrals(const fst_returns *r, const fst_span *span, const fst_flow *flow)
{
    /* Before the returns that were left out are counted, it is not known which crossing completes one. */
    const int completes =
        r->crossings % 2 == 0 || (r->left_out.state == FST_LEFT_OUT_FIRST && !r->left_out.is_counted);
    return completes && is_needed(r, span, flow);
}

/* Keep the state at a crossing on the half Y > 0, and how far it is from the two before. */
static void keep_section(fst_returns *r, fst_mark *mark, int half)
{
    double image[FST_STATE_SIZE];
    if (half > 0)
        memcpy(image, mark->state, sizeof image);
    else
        fst_apply_s2(mark->state, image);
    mark->half_distance = r->since_break > 1 ? fst_state_distance(image, r->section[0]) : NAN;
    mark->full_distance = r->since_break > 2 ? fst_state_distance(image, r->section[1]) : NAN;
    memmove(r->section[1], r->section[0], sizeof r->section - sizeof r->section[0]);
    memcpy(r->section[0], image, sizeof image);
}

/* Go on counting at the first crossing after returns that were left out, where an odd number of crossings
 * changes the halves. */
static void pass_left_out(fst_returns *r)
{
    const int64_t crossings = fst_left_out_count(&r->left_out, &r->crossing);
    r->crossings += crossings;
    r->since_break += crossings;
    if (crossings % 2 == 0)
        return;
    double section[FST_STATE_SIZE];
    r->last_half = -r->last_half;
    memcpy(section, r->section[0], sizeof section);
    memcpy(r->section[0], r->section[1], sizeof section);
    memcpy(r->section[1], section, sizeof section);
}

void fst_returns_step(fst_returns *r, const fst_span *span, fst_quadrature *q, fst_flow *flow)
{
    const double *start = flow->step.y, *end = flow->step.end;
    r->crossed = 0;
    if (!r->side)
        r->side = sign_of(start[FST_X]);
    const int side = sign_of(end[FST_X]), before = r->side;
    if (!side || side == before)
        return;
    r->side = side;
    const fst_twofold from = {span->from, 0.0};
    if (!before || fst_twofold_difference(flow->t, from) < 0)
        return;
    const double f_start = start[FST_X] != 0.0 && sign_of(start[FST_X]) == before ? start[FST_X] : 0.0;
    const double x =
        f_start == 0.0 ? 0.0 : fst_flow_locate(flow, fst_section_function, 0.0, 1.0, f_start, end[FST_X]);
    if (fst_twofold_difference(fst_flow_time(flow, x), from) < 0)
        return;
    const int whole = !span->states_only && (!span->asked_at_end || fst_returns_need_integrals(r, span, flow));
    fst_mark_take(&r->crossing, q, flow, x, whole);
    r->crossed = 1;
    const int half = sign_of(r->crossing.state[FST_Y]);
    if (r->left_out.state == FST_LEFT_OUT_FIRST && !r->left_out.is_counted)
        pass_left_out(r);
    judge_alternation(r, half, half > 0 ? -side : side);
    keep_section(r, &r->crossing, half);
    if (r->crossings % 2 == 0 || r->of_cycles)
        return;
    if (r->left_out.state == FST_LEFT_OUT_FIRST || r->left_out.state == FST_LEFT_OUT_SECOND)
        fst_left_out_end(&r->left_out, &r->crossing, &r->marks, q);
    else
        fst_marks_offer(&r->marks, &r->crossing);
}

int fst_returns_are_regular(const fst_returns *r, fst_twofold now)
{
    if (r->irregular || r->of_cycles || r->crossings < LEAST_CROSSINGS)
        return 0;
    /* Turning that stopped within the window is not regular: the last crossing may lie two returns back. */
    const double turning = fst_twofold_difference(r->marks.latest.t, r->marks.kept[0].t);
    const double since = fst_twofold_difference(now, r->marks.latest.t);
    return since * (double)(r->marks.offered - 1) <= 2.0 * turning;
}
