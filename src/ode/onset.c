/* onset.c - how a slip begins: its direction, from which onset (contact.c) follows the bead while it is slow.
 * And how a bead begins to roll that a plate's resistance had kept from it (rest.c), which is the same for
 * another velocity: W_h, with the push a T and the strength a rho N, a = 1/(beta k eps^2) of a contact that
 * sticks and 1/(beta eps^2) of one that slips.
 *
 * Let delta be the angle by which V lags behind A, B the rate at which A turns in space, s = |V|, a = |A|, and
 * c = k mu N.  In a slip
 *
 *     s' = a cos(delta) - c,        delta' = B - (a/s) sin(delta)
 *
 * At a release s = 0, a = c, and a - c then grows from 0 at some rate k: s = k t^2/2.  (A bead may also be put
 * down at rest where a > c.)  Of all solutions one is bounded, and a bead that was at rest follows that one.
 * With delta = s e it is, to orders in s and t,
 *
 *     s' e + s e' = B - a e + O(s^2):       e = lean + lean_slip s + O(s^2, s t),
 *     lean(t) = B/(2 a - c),                lean_slip = -lean'/(3 a - 2 c)
 *
 * lean(t) is known where the slip begins, with two derivatives, from states a little before and after on the
 * motion that begins there.  What is left out is of the order s t^3 in delta, of t^6 in the impulse of the
 * plate, and of t^7 in the place and the direction of the bead afterwards, for slip mends its own direction:
 * s^(7/2).  With the first value of `lean` alone it would be s^(5/2).
 *
 * A slip that creeps (creep.c) follows the same bounded solution from any s, without a tie of s to t.  It takes two
 * terms more: lean_slip as it changes in time, and the next order,
 *
 *     e = lean + lean_slip s + third s^2,    third = ((2/3) a lean^3 - lean_slip')/(4 a - 3 c)
 *
 * The tangent of delta over s cos(delta), in which a lag is given (lag.inl), has (5/6) lean^3 more.
 */
#include "ode/onset.h"

#include "model/tangent.inl"

static const double APART = 1e-3; /* of the states before and after, in 1/gamma, */
static const double PART = 0.1;   /* or of the time in which the push doubles */
static const double TURNS = 2.0;  /* how far an onset may go while its push turns, over radians */

/* A push a and its change, with the strength c of what it works against. */
typedef struct pushed {
    double a[2], da[2], c, dc;
} pushed;

static pushed push_of_slip(const fst_world_double *c, const fst_contact_double *at,
                           const fst_contact_double *by)
{
    /* A bead that does not roll feels A as A/k: model/dynamics.inl */
    const double share = c->kinds.resists && fst_rests_double(at->modes) ? c->share : 1.0;
    const double mu = c->yielding * share * fst_coulomb_mu_double(&c->law.coulomb, 0.0);
    const pushed p = {{share * at->push[0], share * at->push[1]},
                      {share * by->push[0], share * by->push[1]},
                      mu * fst_coulomb_load_double(at),
                      mu * by->load};
    return p;
}

static pushed push_of_roll(const fst_world_double *c, const fst_contact_double *at,
                           const fst_contact_double *by)
{
    const double share = fst_sticks_double(c, at->modes) > 0.5 ? c->share * c->torque : c->torque;
    const pushed p = {{share * at->balance[0], share * at->balance[1]},
                      {share * by->balance[0], share * by->balance[1]},
                      share * c->resistance.arm * fst_coulomb_load_double(at),
                      share * c->resistance.arm * by->load};
    return p;
}

typedef pushed (*push_function)(const fst_world_double *, const fst_contact_double *,
                                const fst_contact_double *);

/* Whose push it is: a bead in these modes, on a drive of this rate, which itself changes at the rate `ramp`. */
typedef struct pushed_bead {
    const fst_world_double *world;
    const fst_modes_double *modes;
    push_function push;
    double omega, ramp;
} pushed_bead;

static pushed_bead bead_of(const fst_flow *flow, const fst_modes_double *modes, push_function push)
{
    const pushed_bead b = {fst_flow_world(flow), modes, push, fst_drive_rate_double(&flow->drive, flow->t),
                           flow->drive.ramp};
    return b;
}

/* The push on it in a state, and its change in time. */
static pushed push_in(const pushed_bead *b, double omega, const double *state)
{
    const fst_world_double *c = b->world;
    fst_linear_double l;
    double dy[FST_STATE_SIZE];
    fst_linearise_double(c, b->modes, omega, state, &l, dy);
    const fst_contact_double by = fst_contact_change_double(c, &l, state, dy);
    return b->push(c, &l.contact, &by);
}

/* `lean` in a state, with a and a - c there. */
typedef struct leaning {
    double lean, size, excess;
} leaning;

static leaning leaning_by(const pushed *p, double omega)
{
    const double size2 = p->a[0] * p->a[0] + p->a[1] * p->a[1], size = sqrt(size2);
    const double turns = omega + (p->a[0] * p->da[1] - p->a[1] * p->da[0]) / size2;
    const double excess = size - p->c;
    const leaning l = {turns / (size + excess), size, excess};
    return l;
}

static leaning leaning_in(const pushed_bead *b, double omega, const double *state)
{
    const pushed p = push_in(b, omega, state);
    return leaning_by(&p, omega);
}

/* 3 a - 2 c. */
static double across(const leaning *l)
{
    return l->size + 2.0 * l->excess;
}

/* The states `apart` before (0) and after (1) the given one, to the second order in time. */
static void states_around(const pushed_bead *b, const double *state, double apart,
                          double around[2][FST_NUMBERS])
{
    const fst_world_double *c = b->world;
    double slope[FST_STATE_SIZE], slopes[2][FST_STATE_SIZE];
    fst_pull_double unused;
    memset(around, 0, 2 * sizeof *around);
    fst_rhs_double(c, b->modes, b->omega, state, slope, &unused);
    for (int side = 0; side < 2; ++side) {
        const double time = around[side][FST_STEP_TIME] = side ? apart : -apart;
        for (int i = 0; i < FST_STATE_SIZE; ++i)
            around[side][i] = state[i] + time * slope[i];
        fst_rhs_double(c, b->modes, b->omega + time * b->ramp, around[side], slopes[side], &unused);
    }
    for (int side = 0; side < 2; ++side)
        for (int i = 0; i < FST_STATE_SIZE; ++i)
            around[side][i] += 0.25 * apart * (slopes[1][i] - slopes[0][i]); /* y'' apart^2/2 */
}

/* The lag of a motion in this state.  Its rates come from the states `apart` before and after it, which `at` tells. */
static fst_lag_double lag_in(const pushed_bead *b, double apart, const double *state, leaning at[3])
{
    double around[2][FST_NUMBERS];
    const double turn = apart * b->ramp;
    states_around(b, state, apart, around);
    at[0] = leaning_in(b, b->omega - turn, around[0]);
    at[2] = leaning_in(b, b->omega + turn, around[1]);
    at[1] = leaning_in(b, b->omega, state);
    const double before = at[0].lean, lean = at[1].lean, after = at[2].lean;
    fst_lag_double lag = {.since = 0.0};
    lag.lean[0] = lean;
    lag.lean[1] = (after - before) / (2.0 * apart);
    lag.lean[2] = 0.5 * (after - 2.0 * lean + before) / (apart * apart);
    lag.slip = -lag.lean[1] / across(&at[1]);
    return lag;
}

/* ------------------------------------------------------------------ a disc */

/* The rate, in space, at which the slip of a disc that creeps changes in a state: of V = p (nu/|f|) f, p = a |w|. */
static void rate_of_slip(const pushed_bead *b, double omega, const double *state, double rate[2])
{
    const fst_coulomb_double *law = &b->world->law.coulomb;
    const fst_modes_double *m = b->modes;
    fst_linear_double l;
    double dy[FST_STATE_SIZE], df[2];
    fst_linearise_double(b->world, m, omega, state, &l, dy);
    const fst_contact_double by = fst_contact_change_double(b->world, &l, state, dy), *at = &l.contact;
    const fst_disc_creep_double k = fst_coulomb_creep_double(law, at);
    const double *f = k.force, *v = k.slip, size = fst_norm_2_double(f) + 1e-290;
    for (int i = 0; i < 2; ++i)
        df[i] = at->share * (by.push[i] - m->gain[i][1] - 2.0 * at->time * m->gain[i][2]);
    const double da = fst_patch_radius_by_load_double(&law->patch, at->load, k.radius) * by.load;
    const double p = k.radius * m->way * at->pivot;
    const double dp = m->way * (k.radius * by.pivot + da * at->pivot);
    const double dsize = (f[0] * df[0] + f[1] * df[1]) / size;
    const double s2 = at->slip[0] * at->slip[0] + at->slip[1] * at->slip[1];
    const double ds2 = 2.0 * (at->slip[0] * by.slip[0] + at->slip[1] * by.slip[1]);
    const double ddry =
        fst_coulomb_mu_double(law, s2) * by.load + fst_coulomb_mu_by_s2_double(law, s2) * ds2 * at->load;
    const double dnu = fst_disc_eases(&k) * (dsize - k.share * ddry) / k.dry;
    const double along = dp * k.nu + p * (dnu - k.nu * dsize / size);
    for (int i = 0; i < 2; ++i)
        rate[i] = (along * f[i] + p * k.nu * df[i]) / size;
    rate[0] -= omega * v[1];
    rate[1] += omega * v[0];
}

void fst_fit_gain(const fst_flow *flow, const double *state, fst_modes_double *modes, int rounds)
{
    const pushed_bead b = bead_of(flow, modes, push_of_slip);
    const double turn = APART * b.ramp;
    double now[FST_NUMBERS] = {0.0}, around[2][FST_NUMBERS], before[2], at[2], after[2];
    memcpy(now, state, FST_STATE_SIZE * sizeof *now);
    for (int round = 0; round < rounds; ++round) {
        states_around(&b, now, APART, around);
        rate_of_slip(&b, b.omega - turn, around[0], before);
        rate_of_slip(&b, b.omega, now, at);
        rate_of_slip(&b, b.omega + turn, around[1], after);
        for (int i = 0; i < 2; ++i) {
            modes->gain[i][0] = at[i];
            modes->gain[i][1] = (after[i] - before[i]) / (2.0 * APART);
            modes->gain[i][2] = 0.5 * (after[i] - 2.0 * at[i] + before[i]) / (APART * APART);
        }
    }
}

/* ------------------------------------------------------------------ a point */

double fst_hand_over(double rtol)
{
    const double quarter = sqrt(sqrt(rtol));
    return quarter * sqrt(sqrt(quarter));
}

/* The time, in 1/gamma but at most 1, in which the push on a slip may turn.  It does so at the rate at which
 * the direction of a slow rotation does, from which the plate's torque comes. */
static double time_of_turning(const fst_flow *flow, const double *state)
{
    const fst_world_double *c = fst_flow_world(flow);
    const fst_modes_double *m = fst_flow_modes(flow);
    if (!c->kinds.resists || m->rolling != FST_ROLL_ROLLS)
        return 1.0;
    fst_pull_double p;
    fst_magnetic_pull_double(c, m, state, &p);
    const double spin = fst_norm_2_double(state + FST_WX);
    const double strength = c->share * c->torque * c->resistance.arm * fmax(fst_load_double(c, p.force), 0.0);
    return fmin(1.0, TURNS * spin / (strength + 1e-290));
}

double fst_begin_onset(fst_flow *flow, const double *state)
{
    fst_modes_double *modes = &flow->step.context.modes;
    leaning at[3];
    modes->contact = FST_MODE_ONSET;
    modes->onset = fst_new_modes_double().onset;
    const double time = time_of_turning(flow, state);
    const pushed_bead b = bead_of(flow, modes, push_of_slip);
    modes->onset = lag_in(&b, fmin(APART, PART * time), state, at);
    return time;
}

/* Whether the push depends on velocities, so that it changes as friction, and with it the lag, has it. */
static int push_sees_friction(const fst_kinds *kinds)
{
    return kinds->gyroscopic_term_lost || kinds->resists;
}

fst_creeping fst_creeping_at(const fst_flow *flow, const double *state)
{
    fst_modes_double modes = *fst_flow_modes(flow);
    leaning at[3];
    modes.contact = FST_MODE_CREEP;
    modes.onset = fst_new_modes_double().onset;
    const pushed_bead b = bead_of(flow, &modes, push_of_slip);
    const double apart = fmin(APART, PART * time_of_turning(flow, state));
    double now[FST_NUMBERS] = {0.0}; /* at no time */
    memcpy(now, state, FST_STATE_SIZE * sizeof *now);
    const pushed p = push_in(&b, b.omega, now);
    modes.onset.lean[0] = leaning_by(&p, b.omega).lean;
    if (push_sees_friction(&b.world->kinds))
        modes.onset = lag_in(&b, apart, now, at);
    fst_creeping k = {.lag = lag_in(&b, apart, now, at), .push = {p.a[0], p.a[1]}};
    fst_lag_double *lag = &k.lag;
    const double a = at[1].size, e = lag->lean[0], x = across(&at[1]);
    k.size = a;
    k.excess = at[1].excess;
    k.growth = (p.a[0] * p.da[0] + p.a[1] * p.da[1]) / a - p.dc;
    lag->faster = (lag->slip * (across(&at[0]) - across(&at[2])) / (2.0 * apart) - 2.0 * lag->lean[2]) / x;
    const double third = (2.0 / 3.0 * a * e * e * e - lag->faster) / (a + 3.0 * k.excess);
    lag->curve = third + 5.0 / 6.0 * e * e * e;
    return k;
}

void fst_begin_rolling(fst_flow *flow, const double *state, double *strength, double *growth, double *turning)
{
    fst_modes_double *modes = &flow->step.context.modes;
    leaning at[3];
    modes->rolling = FST_ROLL_STARTS;
    modes->start = fst_new_modes_double().start;
    const pushed_bead b = bead_of(flow, modes, push_of_roll);
    const pushed p = push_in(&b, b.omega, state);
    const double size = fst_norm_2_double(p.a) + 1e-290;
    *turning = fst_norm_2_double(p.da) + 1e-290;
    *strength = p.c;
    *growth = (p.a[0] * p.da[0] + p.a[1] * p.da[1]) / size - p.dc;
    modes->start = lag_in(&b, fmin(APART, PART * size / *turning), state, at);
}
