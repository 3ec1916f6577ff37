/* modes.inl - the discrete part of a motion under a law with modes, over REAL.
 *
 * The numbers of a motion change all the time; its modes change at instants only and are constant within a
 * step. A contact slips or sticks, or its slip has just begun (coulomb.inl), or goes on so slowly that its
 * direction is known (ode/creep.c), or the bead is in the air (ode/flight.c). Where the plate resists rolling,
 * the bead also rolls or rests, or has just started to roll (resistance.inl):
 *
 *     what moves        in motion    held     just let go    what pushes it
 *     slip V            slip         stick    onset          the push A
 *     rotation W_h      rolls        rests    starts         the balance T
 *
 * A flow alone changes the modes of a motion on its way (ode/contact.c); model/modes.c answers which modes
 * belong to a state.  Everyone else reads them.  To ask what would happen in another mode, copy the modes, not
 * the world.
 */
#ifndef FST_MODEL_MODES
#define FST_MODEL_MODES
#define FST_RELEASE_SLACK 1e-13 /* by how much, relatively, a push must exceed what holds it: for rounding */

/* What a plate can hold, and what the contact and the rolling of a bead call it. */
enum { FST_MOVES, FST_HELD, FST_BEGINS };
enum {
    FST_MODE_SLIP = FST_MOVES,
    FST_MODE_STICK = FST_HELD,
    FST_MODE_ONSET = FST_BEGINS,
    FST_MODE_CREEP,
    FST_MODE_FLIGHT,
    FST_MODES /* how many there are */
};
enum { FST_ROLL_ROLLS = FST_MOVES, FST_ROLL_RESTS = FST_HELD, FST_ROLL_STARTS = FST_BEGINS, FST_ROLL_MODES };

/* The numbers of a motion: those of a state, and under a law with modes the time since the start of the step,
 * and the height and the climb of a bead in the air (0 on the plate). */
enum {
    FST_STEP_TIME = FST_STATE_SIZE,
    FST_HEIGHT,
    FST_CLIMB,
    FST_NUMBERS /* how many there are */
};
#endif

typedef struct FN(modes) {
    REAL contact;  /* FST_MODE_* */
    REAL rolling;  /* FST_ROLL_* */
    FN(lag) onset; /* of the slip that has just begun, or creeps */
    FN(lag) start; /* of the rotation that has just begun */
    REAL slow_2;   /* square of the slowest pivoting of a disc that is not taken for rest (patch.inl) */
    REAL way;      /* which way a disc pivots that creeps, 1 or -1, and the rate at which its slip changes in */
    REAL gain[2][3]; /* space: polynomials in the time since the start of the step */
} FN(modes);

/* What moves: numbers and modes. */
typedef struct FN(motion) {
    REAL numbers[FST_NUMBERS];
    FN(modes) modes;
} FN(motion);

/* Those of a motion of which nothing is known yet: it slips and rolls. */
static inline FN(modes) FN(new_modes)(void)
{
    const REAL zero = R(0.0);
    const FN(lag) none = {zero, zero, zero, {zero, zero, zero}, zero};
    const FN(modes) m = {zero, zero, none, none, R(1e-12), zero, {{zero, zero, zero}, {zero, zero, zero}}};
    return m;
}

/* A slip, in l gamma, that nothing feels at a tolerance: a thousandth of it, but no less than rounding leaves
 * of its digits. */
static inline REAL FN(captured)(REAL rtol)
{
    return REAL_MAX(R(1e-3) * rtol, R(1e-14));
}

/* The mask of a mode. */
static inline REAL_MASK FN(is_mode)(REAL mode, int which)
{
    return REAL_LESS(REAL_ABS(mode - REAL_OF(which)), R(0.5));
}

/* Whether a slip or a rotation (in some lane) has just begun, or creeps, so that the time matters. */
static inline int FN(something_begins)(const FN(modes) * m)
{
    return REAL_ANY(FN(is_mode)(m->contact, FST_MODE_ONSET)) ||
           REAL_ANY(FN(is_mode)(m->contact, FST_MODE_CREEP)) ||
           REAL_ANY(FN(is_mode)(m->rolling, FST_ROLL_STARTS));
}

/* In motion: the mode is the first, number 0. */
static inline REAL_MASK FN(is_moving)(REAL mode)
{
    return REAL_LESS(mode, R(0.5));
}
