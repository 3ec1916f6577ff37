/* step_control.inl - how long each step is, over REAL: the one controller of runs, lanes, exponents and
 * tangents.
 *
 * A step of a method of order 8 has an error that grows as the eighth power of its size, so the size that would
 * just have met the tolerance is the present one times error^(-1/8), where `error` counts in units of the
 * tolerance.  The next step gets nine tenths of that, within a factor of 6 either way:
 *
 *                   +--------------------------------------------------+
 *                   v                                                  |
 *     plan ----> try a step ----> error <= 1: accept ----> plan the next one
 *                   ^                  |
 *                   |                  > 1: reject ----> too small, or too many tries: give up
 *                   +--------- a smaller size
 *
 * - plan: the proposed size, but no longer than the greatest allowed.  Where the end of the way is no more than
 *   1 % farther than that, the step is made to end there exactly: it "lands".
 * - accept: the next proposal.  A step that was cut short to land says nothing against a proposal that was
 *   longer, which stays.  After a failed try the next step may be kept from growing at once (Hairer's rule).
 * - reject: the same rule makes the step smaller; a number that is not finite makes it ten times smaller.
 *
 * Every function takes a mask of the lanes that it is meant for, REAL_EVERYWHERE where there is only one.
 * The time belongs to the caller, who says how far it is to the end.  The including file brings
 * base/twofold.inl.
 */
typedef struct FN(step_control) {
    REAL proposal;    /* size of the next step, positive */
    REAL greatest;    /* no step is longer; infinity where nothing bounds them */
    REAL size;        /* of the present try, negative where time runs backwards */
    REAL lands;       /* 1 where the present try ends at the end of the way, else 0 */
    REAL rejections;  /* tries of the present step that failed */
    REAL worst_error; /* error of the last of them, infinity where a number was not finite */
    REAL root; /* error of the last accepted step to the power -1/32, in the fast lanes: damped_factor() */
} FN(step_control);

#ifndef STEP_LEAST
/* A step is given up where its size falls below this part of the time (or of 1), or after so many failed tries.
 */
#define STEP_LEAST 1e-14
#define STEP_MOST_REJECTIONS 401.0

/* Whether the step after one that needed several tries must be no longer than it, or may grow.  Runs take the
 * first, tangents the second: the published digits of either were computed so. */
enum { FST_HOLD_AFTER_REJECTION, FST_GROW_AFTER_REJECTION };
#endif

static inline FN(step_control) FN(begin_control)(REAL proposal, REAL greatest)
{
    const REAL zero = R(0.0);
    const FN(step_control) control = {proposal, greatest, zero, zero, zero, zero, R(1.0)};
    return control;
}

/* The factor by which the step size may change after a step of this error (<= 1: accepted): 0.9 error^(-1/8)
 * within [1/6, 6]. */
static inline REAL FN(step_factor)(REAL error)
{
#ifdef REAL_INVERSE_EIGHTH_ROOT
    const REAL factor = R(0.9) * REAL_INVERSE_EIGHTH_ROOT(REAL_MAX(error, R(2.562890625e-7))); /* 0.15^8 */
#else
    const REAL eighth = REAL_SQRT(REAL_SQRT(REAL_SQRT(error)));
    const REAL factor = R(0.9) / REAL_MAX(eighth, R(0.15));
#endif
    return REAL_MAX(factor, R(1.0) / R(6.0));
}

/* The first size of a step, from the sizes of the state, of its derivative, and of how that changes over a
 * small Euler step of the size `trial` (Hairer, Norsett and Wanner, section II.4, with eighth roots by square
 * roots).  Each is a root mean square in units of the tolerance. */
static inline REAL FN(first_trial)(REAL state, REAL slope)
{
    const REAL least = R(1e-5), usual = R(0.01) * state / slope;
    return REAL_SELECT(REAL_LESS(state, least), R(1e-6), REAL_SELECT(REAL_LESS(slope, least), R(1e-6), usual));
}

static inline REAL FN(first_size)(REAL trial, REAL slope, REAL bend)
{
    const REAL steepest = REAL_MAX(slope, bend), most = R(100.0) * trial;
    const REAL size = REAL_SELECT(REAL_LESS_EQUAL(steepest, R(1e-15)), R(1e-3),
                                  REAL_SQRT(REAL_SQRT(REAL_SQRT(R(0.01) / steepest))));
    return REAL_SELECT(REAL_LESS(size, most), size, most);
}

/* Choose the size of the first try towards the end of the way, which is `rest` away. */
static inline void FN(plan_step)(FN(step_control) * c, REAL_MASK mask, REAL rest)
{
    const REAL one = R(1.0), zero = R(0.0);
    const REAL size = -REAL_MAX(-c->proposal, -c->greatest);
    const REAL_MASK lands = REAL_LESS_EQUAL(REAL_ABS(rest), size * R(1.01));
    const REAL forth_or_back = REAL_SELECT(REAL_LESS(rest, zero), -size, size);
    c->size = REAL_SELECT(mask, REAL_SELECT(lands, rest, forth_or_back), c->size);
    c->lands = REAL_SELECT(mask, REAL_SELECT(lands, one, zero), c->lands);
    c->rejections = REAL_SELECT(mask, zero, c->rejections);
    c->worst_error = REAL_SELECT(mask, zero, c->worst_error);
}

/* The time at the end of an accepted step that began at t: the end of the way exactly, where the step landed.
 */
static inline FN(twofold) FN(step_end)(const FN(step_control) * c, FN(twofold) t, REAL limit)
{
    const REAL_MASK lands = REAL_LESS(R(0.0), c->lands);
    const FN(twofold) sum = FN(twofold_add)(t, c->size);
    const FN(twofold) end = {REAL_SELECT(lands, limit, sum.high), REAL_SELECT(lands, R(0.0), sum.low)};
    return end;
}

/* A try was accepted, and the step size may change by `factor`: the next proposal. */
static inline void FN(accept_step)(FN(step_control) * c, REAL_MASK mask, REAL factor, int after_rejection)
{
    const REAL zero = R(0.0), tried = REAL_ABS(c->size), proposal = tried * factor;
    const REAL planned = REAL_MAX(c->proposal, proposal);
    REAL next = REAL_SELECT(REAL_LESS(zero, c->lands), planned, proposal);
    if (after_rejection == FST_HOLD_AFTER_REJECTION) {
        const REAL held = -REAL_MAX(-next, -tried);
        next = REAL_SELECT(REAL_LESS(zero, c->rejections), held, next);
    }
    c->proposal = REAL_SELECT(mask, next, c->proposal);
}

/* A try of a step at this time failed: the size of the next one.  Returns 1 where the step is given up, because
 * it has become too small or was tried too often, else 0. */
static inline REAL FN(reject_step)(FN(step_control) * c, REAL_MASK mask, REAL error, REAL factor, REAL time)
{
    const REAL one = R(1.0), zero = R(0.0), infinity = REAL_OF(INFINITY);
    const REAL_MASK finite = REAL_LESS(REAL_ABS(error), infinity);
    const REAL size = c->size * REAL_SELECT(finite, factor, R(0.1));
    c->rejections = REAL_SELECT(mask, c->rejections + one, c->rejections);
    c->worst_error = REAL_SELECT(mask, REAL_SELECT(finite, error, infinity), c->worst_error);
    c->size = REAL_SELECT(mask, size, c->size);
    c->lands = REAL_SELECT(mask, zero, c->lands);
    const REAL least = REAL_OF(STEP_LEAST) * (one + REAL_ABS(time));
    const REAL too_small = REAL_SELECT(REAL_LESS_EQUAL(least, REAL_ABS(size)), zero, one);
    const REAL given_up =
        REAL_SELECT(REAL_LESS_EQUAL(c->rejections, REAL_OF(STEP_MOST_REJECTIONS)), too_small, one);
    return REAL_SELECT(mask, given_up, zero);
}

/* In place of step_factor() = 0.9 e^(-1/8) of the error e of an accepted step, with the error e_0 of the one
 * before it: 0.9 e^(-3/32) e_0^(1/32), a proportional-integral controller (K. Gustafsson, ACM Trans. Math.
 * Softw. 17 (1991) 533).  Along an orbit errors rise and fall over some steps.  Because this controller sees
 * that, 0.3 % of the steps are rejected at a tolerance of 1e-10 instead of 5 %, and the same error of a final
 * state takes an eighth less work.  The fast lanes use it; runs and the portable form keep the plain rule,
 * which has the published bits.
 */
static inline REAL FN(damped_factor)(FN(step_control) * c, REAL_MASK mask, REAL factor)
{
    const REAL inverse = R(1.0 / 0.9); /* of the 0.9 in it */
    const REAL eighth = factor * inverse, sixteenth = REAL_OVER_SQRT(eighth, eighth);
    const REAL root = REAL_OVER_SQRT(sixteenth, sixteenth), before = c->root;
    c->root = REAL_SELECT(mask, root, before);
    return factor * REAL_ROUGH_RECIPROCAL(root * before);
}
