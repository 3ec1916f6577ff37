/* dop853.inl - one step of Dormand and Prince's method of order 8(5,3), and its dense output, over REAL.
 *
 * The scheme.  A step of size h from the state y evaluates the derivative at twelve trial states, the stages.
 * Each is y plus h times a weighted sum of the derivatives k of the stages before it, and the end of the step
 * is y plus h times a weighted sum of all of them:
 *
 *     stage 1:  y                                  k1 = f(y)           the derivative that the step before left
 *     stage 2:  y + h a21 k1                       k2 = f(stage 2)
 *     stage 3:  y + h (a31 k1 + a32 k2)            k3 = f(stage 3)
 *     ...
 *     stage 12                                     k12
 *     end:      y + h (b1 k1 + b6 k6 + ... + b12 k12)
 *     stage 13: the end, projected by the caller   k13 = f(end)        stage 1 of the next step
 *
 * The weights (dop853_tableau.h) are chosen so that the end is wrong by O(h^9) only.  Two other sums of the
 * same derivatives have the orders 5 and 3; how far they are from the end is the error by which the step is
 * judged (step_error).
 *
 * The dense output.  Where something happens within a step, the state is wanted there.  A polynomial of degree
 * 7 in the fraction x of the step meets the states and derivatives of both ends; four of its coefficients need
 * three more stages, 14 to 16, at x = 0.1, 0.2 and 7/9, which are evaluated only if somebody asks (make_dense).
 * It is written so that both ends come out exactly:
 *
 *     y(x) = c0 + x (c1 + (1-x) (c2 + x (c3 + (1-x) (c4 + x (c5 + (1-x) (c6 + x c7))))))
 *
 *     c0 = y,   c1 = end - y,   c2 = h k1 - c1,   c3 = c1 - h k13 - c2,   c4 ... c7 = h times sums of the k
 *
 * Anything that is integrated along with the state, by its values at the stages, has a dense output by the same
 * coefficients (path.inl).
 *
 * For speed, what the older stages add to the next one is summed before the newest derivative is evaluated, so
 * that a processor can do both at once.  Do not reorder: every sum has one order, and the published bits are
 * those of it.
 *
 * The including file defines STEP_DIM (number of components), STEP_CONTEXT (what the right-hand side needs
 * besides the state), STEP_NAME(name), by which what this body defines is named, and either STEP_RHS(context,
 * drive, y, dy), the right-hand side, or STEP_DERIVATIVES(s, drive, j): fill k[j - 1] of the step with the
 * derivative at its stage[j - 1].  Stages are numbered from 1 as in Hairer's code, and no number leaves this
 * room (path.h).
 *
 * Instead of STEP_DERIVATIVES it may define its parts.  The place at a stage is then known before the forces at
 * the stage before it are, and the forces at both, which take most of the time, do not wait for each other:
 *
 * - STEP_KNOWN(i): whether the derivative of component i follows from the state alone, without forces;
 * - STEP_KINEMATICS(s, drive, j): fill these derivatives;
 * - STEP_FORCES(s, j): compute what the other derivatives need, from the known components of a stage;
 * - STEP_DYNAMICS(s, drive, j): fill the other derivatives;
 * - STEP_FORCES_AND_DYNAMICS(s, next, drive, j): the forces at stage `next`, and the dynamics at stage j.
 *
 * It may also define STEP_FEWER and STEP_TAKES_ALL(s): a step for which this is 0 has the first STEP_FEWER
 * components only, by code of its own; and STEP_JUDGED: the error is that of so many components.
 */
#ifdef STEP_RHS
#define STEP_DERIVATIVES(s, drive, j) STEP_RHS(&(s)->context, drive, (s)->stage[(j)-1], (s)->k[(j)-1])
#endif
#ifdef STEP_DERIVATIVES
#define STEP_KINEMATICS(s, drive, j) ((void)0)
#define STEP_FORCES(s, j) ((void)0)
#define STEP_DYNAMICS STEP_DERIVATIVES
#define STEP_FORCES_AND_DYNAMICS(s, next, drive, j) STEP_DERIVATIVES(s, drive, j)
#endif

#ifndef STEP_FEWER
#define STEP_FEWER STEP_DIM
#define STEP_TAKES_ALL(s) 1
#endif
#ifndef STEP_JUDGED
#define STEP_JUDGED STEP_DIM
#endif
#define STEP_ROW ((STEP_DIM + 1) / 2 * 2) /* states begin where a processor loads two numbers at once */

typedef struct STEP_NAME(step) {
    STEP_CONTEXT context;
    REAL h;           /* size of the step */
    REAL omega, ramp; /* drive at the start of the step, and its rate of change */
    REAL y[STEP_ROW], end[STEP_ROW];
    REAL stage[16][STEP_ROW]; /* states at the stages: observables are integrated over them */
    REAL k[16][STEP_ROW];
    REAL slope[STEP_ROW];    /* mean derivative over the step, sum of b_j k_j */
    REAL dense[8][STEP_ROW]; /* coefficients of the dense output, once formed */
} STEP_NAME(step);

#define K(j) s->k[(j)-1][i]
#define STATE(j) s->stage[(j)-1][i]
#ifdef STEP_DERIVATIVES
#define EACH_KNOWN(i) for (int i = 0; 0; ++i)
#define EACH_OTHER(i) for (int i = 0; i < count; ++i)
#else
#define EACH_KNOWN(i) _Pragma("GCC unroll 32") for (int i = 0; i < count; ++i) if (STEP_KNOWN(i))
#define EACH_OTHER(i) _Pragma("GCC unroll 32") for (int i = 0; i < count; ++i) if (!STEP_KNOWN(i))
#endif
#define DRIVE(node) (s->omega + (h * (node)) * s->ramp)

/* The derivative at stage j - 1, of the given node, and the state at stage j: y + h (older + a k), where
 * `older` is the sum over the stages before. */
#define GO_ON(j, node, a)                                                                                      \
    do {                                                                                                       \
        const REAL drive = DRIVE(node);                                                                        \
        STEP_KINEMATICS(s, drive, (j)-1);                                                                      \
        EACH_KNOWN(i) STATE(j) = REAL_MULADD(h, REAL_MULADD(a, K((j)-1), older[i]), s->y[i]);                  \
        STEP_FORCES_AND_DYNAMICS(s, j, drive, (j)-1);                                                          \
        EACH_OTHER(i) STATE(j) = REAL_MULADD(h, REAL_MULADD(a, K((j)-1), older[i]), s->y[i]);                  \
    } while (0)

/* Stages 2 to 12 and the end of the step, for the first `count` components, a constant. */
static inline __attribute__((always_inline)) void STEP_NAME(try_components)(STEP_NAME(step) * s,
                                                                            const int count)
{
    const REAL h = s->h, one = R(1.0);
    REAL older[STEP_DIM];
    for (int i = 0; i < count; ++i)
        STATE(2) = REAL_MULADD(h, SUM_1(DOP_A2_1, K(1)), s->y[i]);
    STEP_FORCES(s, 2);
    for (int i = 0; i < count; ++i)
        older[i] = SUM_1(DOP_A3_1, K(1));
    GO_ON(3, DOP_C2, DOP_A3_2);
    for (int i = 0; i < count; ++i)
        older[i] = SUM_1(DOP_A4_1, K(1));
    GO_ON(4, DOP_C3, DOP_A4_3);
    for (int i = 0; i < count; ++i)
        older[i] = SUM_2(DOP_A5_1, K(1), DOP_A5_3, K(3));
    GO_ON(5, DOP_C4, DOP_A5_4);
    for (int i = 0; i < count; ++i)
        older[i] = SUM_2(DOP_A6_1, K(1), DOP_A6_4, K(4));
    GO_ON(6, DOP_C5, DOP_A6_5);
    for (int i = 0; i < count; ++i)
        older[i] = SUM_3(DOP_A7_1, K(1), DOP_A7_4, K(4), DOP_A7_5, K(5));
    GO_ON(7, DOP_C6, DOP_A7_6);
    for (int i = 0; i < count; ++i)
        older[i] = SUM_4(DOP_A8_1, K(1), DOP_A8_4, K(4), DOP_A8_5, K(5), DOP_A8_6, K(6));
    GO_ON(8, DOP_C7, DOP_A8_7);
    for (int i = 0; i < count; ++i)
        older[i] = SUM_5(DOP_A9_1, K(1), DOP_A9_4, K(4), DOP_A9_5, K(5), DOP_A9_6, K(6), DOP_A9_7, K(7));
    GO_ON(9, DOP_C8, DOP_A9_8);
    for (int i = 0; i < count; ++i)
        older[i] = SUM_6(DOP_A10_1, K(1), DOP_A10_4, K(4), DOP_A10_5, K(5), DOP_A10_6, K(6), DOP_A10_7, K(7),
                         DOP_A10_8, K(8));
    GO_ON(10, DOP_C9, DOP_A10_9);
    for (int i = 0; i < count; ++i)
        older[i] = SUM_7(DOP_A11_1, K(1), DOP_A11_4, K(4), DOP_A11_5, K(5), DOP_A11_6, K(6), DOP_A11_7, K(7),
                         DOP_A11_8, K(8), DOP_A11_9, K(9));
    GO_ON(11, DOP_C10, DOP_A11_10);
    for (int i = 0; i < count; ++i)
        older[i] = SUM_8(DOP_A12_1, K(1), DOP_A12_4, K(4), DOP_A12_5, K(5), DOP_A12_6, K(6), DOP_A12_7, K(7),
                         DOP_A12_8, K(8), DOP_A12_9, K(9), DOP_A12_10, K(10));
    GO_ON(12, DOP_C11, DOP_A12_11);
    for (int i = 0; i < count; ++i)
        older[i] = SUM_7(DOP_B1, K(1), DOP_B6, K(6), DOP_B7, K(7), DOP_B8, K(8), DOP_B9, K(9), DOP_B10, K(10),
                         DOP_B11, K(11));
    STEP_KINEMATICS(s, DRIVE(one), 12);
    STEP_DYNAMICS(s, DRIVE(one), 12);
    for (int i = 0; i < count; ++i) {
        s->slope[i] = REAL_MULADD(DOP_B12, K(12), older[i]);
        s->end[i] = REAL_MULADD(h, s->slope[i], s->y[i]);
    }
}

/* Stages 2 to 12 and the end of the step, s->end; stage 1 must be there.  Stage 13 is left to the caller, who
 * may first project the end state. */
static inline void STEP_NAME(try_step)(STEP_NAME(step) * s)
{
    if (STEP_TAKES_ALL(s))
        STEP_NAME(try_components)(s, STEP_DIM);
    else
        STEP_NAME(try_components)(s, STEP_FEWER);
}

/* Error of the step over its tolerance, the combination of the orders 5 and 3 of Hairer's code; at most 1 for a
 * step to be accepted.  The step's size counts as positive. */
static inline REAL STEP_NAME(step_error)(const STEP_NAME(step) * s, REAL rtol, const REAL *atol)
{
    REAL square5[STEP_JUDGED], square3[STEP_JUDGED];
    for (int i = 0; i < STEP_JUDGED; ++i) {
        const REAL weight =
            REAL_ROUGH_RECIPROCAL(REAL_MULADD(rtol, REAL_MAX(REAL_ABS(s->y[i]), REAL_ABS(s->end[i])), atol[i]));
        const REAL e5 = SUM_8(DOP_E5_1, K(1), DOP_E5_6, K(6), DOP_E5_7, K(7), DOP_E5_8, K(8), DOP_E5_9, K(9),
                              DOP_E5_10, K(10), DOP_E5_11, K(11), DOP_E5_12, K(12));
        const REAL e3 = s->slope[i] - (SUM_3(DOP_E3_1, K(1), DOP_E3_9, K(9), DOP_E3_12, K(12)));
        const REAL r5 = e5 * weight, r3 = e3 * weight;
        square5[i] = r5 * r5;
        square3[i] = r3 * r3;
    }
    REAL sum5 = square5[0], sum3 = square3[0];
    for (int i = 1; i < STEP_JUDGED; ++i) {
        sum5 = sum5 + square5[i];
        sum3 = sum3 + square3[i];
    }
    const REAL denominator = sum5 + R(0.01) * sum3;
    return REAL_OVER_SQRT(REAL_ABS(s->h) * sum5, REAL_OF(STEP_JUDGED) * denominator + R(1e-290));
}

/* Coefficients of the dense output over a whole step of size h: from y0 to y1 with the derivatives k[0..15]
 * (stages 1 to 16) of `dim` components lying `stride` apart. */
static inline void STEP_NAME(dense_coefficients)(int dim, REAL h, const REAL *y0, const REAL *y1,
                                                 const REAL *k_flat, int stride, REAL *c_flat)
{
#define SLOPE(j) k_flat[(j)*stride + i]
#define TERM(j) c_flat[(j)*stride + i]
    for (int i = 0; i < dim; ++i) {
        const REAL difference = y1[i] - y0[i], bend = h * SLOPE(0) - difference;
        TERM(0) = y0[i];
        TERM(1) = difference;
        TERM(2) = bend;
        TERM(3) = (difference - h * SLOPE(12)) - bend;
        TERM(4) = h * (SUM_12(DOP_D4_1, SLOPE(0), DOP_D4_6, SLOPE(5), DOP_D4_7, SLOPE(6), DOP_D4_8, SLOPE(7),
                              DOP_D4_9, SLOPE(8), DOP_D4_10, SLOPE(9), DOP_D4_11, SLOPE(10), DOP_D4_12,
                              SLOPE(11), DOP_D4_13, SLOPE(12), DOP_D4_14, SLOPE(13), DOP_D4_15, SLOPE(14),
                              DOP_D4_16, SLOPE(15)));
        TERM(5) = h * (SUM_12(DOP_D5_1, SLOPE(0), DOP_D5_6, SLOPE(5), DOP_D5_7, SLOPE(6), DOP_D5_8, SLOPE(7),
                              DOP_D5_9, SLOPE(8), DOP_D5_10, SLOPE(9), DOP_D5_11, SLOPE(10), DOP_D5_12,
                              SLOPE(11), DOP_D5_13, SLOPE(12), DOP_D5_14, SLOPE(13), DOP_D5_15, SLOPE(14),
                              DOP_D5_16, SLOPE(15)));
        TERM(6) = h * (SUM_12(DOP_D6_1, SLOPE(0), DOP_D6_6, SLOPE(5), DOP_D6_7, SLOPE(6), DOP_D6_8, SLOPE(7),
                              DOP_D6_9, SLOPE(8), DOP_D6_10, SLOPE(9), DOP_D6_11, SLOPE(10), DOP_D6_12,
                              SLOPE(11), DOP_D6_13, SLOPE(12), DOP_D6_14, SLOPE(13), DOP_D6_15, SLOPE(14),
                              DOP_D6_16, SLOPE(15)));
        TERM(7) = h * (SUM_12(DOP_D7_1, SLOPE(0), DOP_D7_6, SLOPE(5), DOP_D7_7, SLOPE(6), DOP_D7_8, SLOPE(7),
                              DOP_D7_9, SLOPE(8), DOP_D7_10, SLOPE(9), DOP_D7_11, SLOPE(10), DOP_D7_12,
                              SLOPE(11), DOP_D7_13, SLOPE(12), DOP_D7_14, SLOPE(13), DOP_D7_15, SLOPE(14),
                              DOP_D7_16, SLOPE(15)));
    }
#undef SLOPE
#undef TERM
}

/* The three further stages of the dense output, and its coefficients in s->dense; stage 13 must be there. */
static inline void STEP_NAME(make_dense)(STEP_NAME(step) * s)
{
    const int count = STEP_TAKES_ALL(s) ? STEP_DIM : STEP_FEWER;
    const REAL h = s->h;
    REAL older[STEP_DIM];
    for (int i = 0; i < count; ++i)
        older[i] = SUM_7(DOP_A14_1, K(1), DOP_A14_7, K(7), DOP_A14_8, K(8), DOP_A14_9, K(9), DOP_A14_10, K(10),
                         DOP_A14_11, K(11), DOP_A14_12, K(12));
    for (int i = 0; i < count; ++i)
        STATE(14) = REAL_MULADD(h, REAL_MULADD(DOP_A14_13, K(13), older[i]), s->y[i]);
    STEP_FORCES(s, 14);
    for (int i = 0; i < count; ++i)
        older[i] = SUM_7(DOP_A15_1, K(1), DOP_A15_6, K(6), DOP_A15_7, K(7), DOP_A15_8, K(8), DOP_A15_11, K(11),
                         DOP_A15_12, K(12), DOP_A15_13, K(13));
    GO_ON(15, DOP_C14, DOP_A15_14);
    for (int i = 0; i < count; ++i)
        older[i] = SUM_7(DOP_A16_1, K(1), DOP_A16_6, K(6), DOP_A16_7, K(7), DOP_A16_8, K(8), DOP_A16_9, K(9),
                         DOP_A16_13, K(13), DOP_A16_14, K(14));
    GO_ON(16, DOP_C15, DOP_A16_15);
    STEP_KINEMATICS(s, DRIVE(DOP_C16), 16);
    STEP_DYNAMICS(s, DRIVE(DOP_C16), 16);
    STEP_NAME(dense_coefficients)(count, h, s->y, s->end, &s->k[0][0], STEP_ROW, &s->dense[0][0]);
}

/* The dense output at the fraction x of the step, of `dim` components. */
static inline void STEP_NAME(evaluate_dense)(int dim, const REAL *c_flat, int stride, REAL x, REAL *y)
{
#define TERM(j) c_flat[(j)*stride + i]
    const REAL rest = R(1.0) - x;
    for (int i = 0; i < dim; ++i) {
        REAL sum = TERM(6) + x * TERM(7);
        sum = TERM(5) + rest * sum;
        sum = TERM(4) + x * sum;
        sum = TERM(3) + rest * sum;
        sum = TERM(2) + x * sum;
        sum = TERM(1) + rest * sum;
        y[i] = TERM(0) + x * sum;
    }
#undef TERM
}

#ifdef STEP_RHS
/* The first stage of a step from s->y. */
static inline void STEP_NAME(begin)(STEP_NAME(step) * s)
{
    STEP_RHS(&s->context, s->omega, s->y, s->k[0]);
}

/* The last stage of an accepted step, whose end needs no projection; and the end as the start of the next step.
 */
static inline REAL STEP_NAME(finish)(STEP_NAME(step) * s)
{
    STEP_RHS(&s->context, s->omega + s->h * s->ramp, s->end, s->k[12]);
    return R(0.0);
}

static inline void STEP_NAME(next)(STEP_NAME(step) * s, REAL omega)
{
    s->omega = omega;
    for (int i = 0; i < STEP_DIM; ++i) {
        s->y[i] = s->end[i];
        s->k[0][i] = s->k[12][i];
    }
}
#endif

#undef K
#undef STATE
#undef EACH_KNOWN
#undef EACH_OTHER
#undef DRIVE
#undef GO_ON
#undef STEP_DIM
#undef STEP_ROW
#undef STEP_FEWER
#undef STEP_TAKES_ALL
#undef STEP_JUDGED
#undef STEP_CONTEXT
#undef STEP_NAME
#undef STEP_RHS
#undef STEP_DERIVATIVES
#undef STEP_KNOWN
#undef STEP_KINEMATICS
#undef STEP_FORCES
#undef STEP_DYNAMICS
#undef STEP_FORCES_AND_DYNAMICS
