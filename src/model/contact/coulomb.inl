/* coulomb.inl - the contact law `coulomb`: dry friction, over REAL.
 *
 * The plate's force on a contact that slips is mu N against the slip, whatever the speed.  A contact at rest
 * takes any force up to mu_s N, just what it needs to stay at rest: the bead rolls.  With A, the rate at which
 * the slip V would change without the plate's friction, V' = A - k f (dynamics.inl), and so
 *
 *     mode    while                f
 *     slip    V != 0               mu(|V|) N V/|V|
 *     stick   |A| <= k mu_s N      A/k:  V stays 0
 *     onset   just released        mu(|V|) N u, u near A/|A|
 *     flight  in the air           0 (dynamics.inl leaves it no load; ode/flight.c)
 *
 * Onset.  Where |A| grows past k mu_s N and sliding friction is no weaker than static, the slip begins with
 * no speed and hardly any acceleration, in a direction that is known: lag.inl, with c = k mu N.
 *
 * A disc.  Where the contact is a disc (patch.inl), f in a slip is mu N tau V/|V|, and the plate resists
 * pivoting. Then slip includes the creep of a bead that pivots, stick is for a bead that does not pivot either,
 * the plate holds its W.e too, and there is no onset.  Where the creep is so stiff that V is known (ode/creep.c),
 * f = (A - V')/k in the mode creep, and nu, which gives the torque, follows from f.
 *
 * Stribeck: mu(s) = mu_d + (mu_s - mu_d)/(1 + (s/v_S)^2).  Without a speed v_S friction falls at once.
 */
typedef struct FN(coulomb) {
    REAL sliding;      /* mu_d */
    REAL fall;         /* mu_s - mu_d where a Stribeck speed is given, else 0 */
    REAL holding;      /* mu_s */
    REAL stribeck;     /* 1/v_S^2, else 0 */
    REAL usual_slip_2; /* s_r^2 of the pace */
    REAL restitution;  /* e_n of an impact, where a bead may fly */
    FN(patch) patch;
} FN(coulomb);

static inline FN(coulomb) FN(make_coulomb)(const fst_params *params, const fst_groups *g)
{
    const int rolls = g->friction == FST_FRICTION_ROLLING; /* that law, with a resistance (model/kinds.h) */
    const double unlimited = 1e30, speed_si = rolls ? NAN : params->friction_stribeck_speed;
    const double sliding = rolls ? unlimited : params->friction_mu;
    const double holding = rolls || isnan(params->friction_mu_static) ? sliding : params->friction_mu_static;
    const double speed = speed_si * g->time_unit / g->length_unit;
    const FN(coulomb) law = {
        .sliding = REAL_OF(sliding),
        .fall = REAL_OF(isnan(speed) ? 0.0 : holding - sliding),
        .holding = REAL_OF(holding),
        .stribeck = REAL_OF(isnan(speed) ? 0.0 : 1.0 / (speed * speed)),
        .usual_slip_2 = R(0.0025),
        .restitution = REAL_OF(isnan(params->impact_restitution) ? 0.0 : params->impact_restitution),
        .patch = FN(make_patch)(params, g),
    };
    return law;
}

/* mu at the slip speed whose square is s2, and its derivative by s2. */
static inline REAL FN(coulomb_mu)(const FN(coulomb) * law, REAL s2)
{
    return law->sliding + law->fall / (R(1.0) + s2 * law->stribeck);
}

static inline REAL FN(coulomb_mu_by_s2)(const FN(coulomb) * law, REAL s2)
{
    const REAL part = R(1.0) + s2 * law->stribeck;
    return -(law->fall * law->stribeck / (part * part));
}

/* A bead that has lost the plate is not pulled by it. */
static inline REAL FN(coulomb_load)(const FN(contact) * at)
{
    return REAL_MAX(at->load, R(0.0));
}

static inline REAL_MASK FN(coulomb_sticks)(const FN(contact) * at)
{
    return FN(is_mode)(at->modes->contact, FST_MODE_STICK);
}

/* The grip: what friction of the coefficient mu could still take of the push, k mu N - |A|, with a relative
 * slack; negative where the push is stronger. */
static inline REAL FN(grip)(const FN(contact) * at, REAL yielding, REAL mu, REAL slack)
{
    const REAL most = yielding * mu * FN(coulomb_load)(at);
    return most * (R(1.0) + slack) - FN(norm_2)(at->push);
}

/* ------------------------------------------------------------------ a disc */

/* Not inlined: a point contact, which shares the equations of motion with a disc, should not pay for it. */
#define OF_DISC static __attribute__((noinline, unused))

/* A disc in motion: the greatest force mu N, its radius, |w| with its derivatives (pivoting_rate()), and the
 * shares that it gets of them. */
typedef struct FN(rubbing) {
    REAL s2, dry, radius, rate, side, bend;
    FN(shares) shares;
} FN(rubbing);

static inline FN(rubbing) FN(coulomb_rubbing)(const FN(coulomb) * law, const FN(contact) * at)
{
    const REAL load = FN(coulomb_load)(at);
    FN(rubbing) r;
    r.s2 = SUM_2(at->slip[0], at->slip[0], at->slip[1], at->slip[1]);
    r.dry = FN(coulomb_mu)(law, r.s2) * load;
    r.radius = FN(patch_radius)(&law->patch, load);
    FN(pivoting_rate)(at->modes->slow_2, at->pivot, &r.rate, &r.side, &r.bend);
    r.shares = FN(hertz_shares)(REAL_SQRT(r.s2), r.radius * r.rate);
    return r;
}

/* How that changes with the contact. */
typedef struct FN(rubbing_change) {
    REAL along, dry, radius, rate, p; /* V.dV and the changes of mu N, a, |w| and a |w| */
} FN(rubbing_change);

static inline FN(rubbing_change) FN(coulomb_rubbing_change)(const FN(coulomb) * law, const FN(contact) * at,
                                                            const FN(contact) * by, const FN(rubbing) * r)
{
    const REAL load = FN(coulomb_load)(at), dload = REAL_SELECT(REAL_LESS(R(0.0), at->load), by->load, R(0.0));
    FN(rubbing_change) d;
    d.along = SUM_2(at->slip[0], by->slip[0], at->slip[1], by->slip[1]);
    d.dry = REAL_MULADD(FN(coulomb_mu)(law, r->s2), dload,
                        R(2.0) * d.along * FN(coulomb_mu_by_s2)(law, r->s2) * load);
    d.radius = FN(patch_radius_by_load)(&law->patch, load, r->radius) * dload;
    d.rate = r->side * by->pivot;
    d.p = REAL_MULADD(r->radius, d.rate, d.radius * r->rate);
    return d;
}

/* The contact of a disc that creeps: its force, the share of mu N that this is, nu, and V. */
typedef struct FN(disc_creep) {
    REAL force[2], dry, radius, share, nu, slip[2];
} FN(disc_creep);

OF_DISC FN(disc_creep) FN(coulomb_creep)(const FN(coulomb) * law, const FN(contact) * at)
{
    const FN(modes) *m = at->modes;
    const REAL s2 = SUM_2(at->slip[0], at->slip[0], at->slip[1], at->slip[1]), load = FN(coulomb_load)(at);
    FN(disc_creep) k = {.dry = FN(coulomb_mu)(law, s2) * load, .radius = FN(patch_radius)(&law->patch, load)};
    for (int i = 0; i < 2; ++i) {
        const REAL *p = m->gain[i];
        const REAL gained = REAL_MULADD(at->time, REAL_MULADD(at->time, p[2], p[1]), p[0]);
        k.force[i] = at->share * (at->push[i] - gained);
    }
    const REAL size = FN(norm_2)(k.force) + R(1e-290);
    k.share = size / (k.dry + R(1e-290));
    k.nu = FN(hertz_nu)(k.share);
    for (int i = 0; i < 2; ++i)
        k.slip[i] = k.radius * (m->way * at->pivot) * k.nu * (k.force[i] / size);
    return k;
}

/* The torque against pivoting; while the bead is held, what balances the torque `held`. */
OF_DISC REAL FN(coulomb_pivoting)(const FN(coulomb) * law, const FN(contact) * at, REAL held)
{
    const REAL_MASK creeps = FN(is_mode)(at->modes->contact, FST_MODE_CREEP);
    const FN(rubbing) r = FN(coulomb_rubbing)(law, at);
    REAL torque = r.dry * r.radius * r.shares.twist * r.side;
    if (REAL_ANY(creeps)) {
        const FN(disc_creep) k = FN(coulomb_creep)(law, at);
        const REAL twist = FN(hertz_near)(k.nu, R(1.0)).twist;
        torque = REAL_SELECT(creeps, k.dry * k.radius * twist * at->modes->way, torque);
    }
    return REAL_SELECT(FN(coulomb_sticks)(at), -held, -torque);
}

OF_DISC REAL FN(coulomb_pivoting_change)(const FN(coulomb) * law, const FN(contact) * at,
                                         const FN(contact) * by, REAL dheld)
{
    const FN(rubbing) r = FN(coulomb_rubbing)(law, at);
    const FN(rubbing_change) d = FN(coulomb_rubbing_change)(law, at, by, &r);
    const REAL dtwist = REAL_MULADD(r.shares.across, d.along, r.shares.twist_p * d.p);
    const REAL dmost = REAL_MULADD(d.dry, r.radius, r.dry * d.radius), most = r.dry * r.radius;
    const REAL change = SUM_3(dmost, r.shares.twist * r.side, most, dtwist * r.side, most,
                              r.shares.twist * (r.bend * by->pivot));
    return REAL_SELECT(FN(coulomb_sticks)(at), -dheld, -change);
}

static inline REAL FN(coulomb_pivoting_loss)(const FN(coulomb) * law, const FN(contact) * at)
{
    return -(FN(coulomb_pivoting)(law, at, R(0.0)) * at->pivot);
}

/* ------------------------------------------------------------------ the force */

OF_DISC void FN(disc_force)(const FN(coulomb) * law, const FN(contact) * at, REAL force[2])
{
    const REAL_MASK creeps = FN(is_mode)(at->modes->contact, FST_MODE_CREEP);
    const FN(rubbing) r = FN(coulomb_rubbing)(law, at);
    const REAL grip = r.dry * r.shares.grip;
    for (int i = 0; i < 2; ++i)
        force[i] = REAL_SELECT(FN(coulomb_sticks)(at), at->share * at->push[i], grip * at->slip[i]);
    if (!REAL_ANY(creeps))
        return;
    const FN(disc_creep) k = FN(coulomb_creep)(law, at);
    for (int i = 0; i < 2; ++i)
        force[i] = REAL_SELECT(creeps, k.force[i], force[i]);
}

OF_DISC void FN(disc_change)(const FN(coulomb) * law, const FN(contact) * at, const FN(contact) * by,
                             REAL change[2])
{
    const FN(rubbing) r = FN(coulomb_rubbing)(law, at);
    const FN(rubbing_change) d = FN(coulomb_rubbing_change)(law, at, by, &r);
    const REAL dgrip = REAL_MULADD(r.shares.bend, d.along, r.shares.across * d.p);
    const REAL turned = REAL_MULADD(d.dry, r.shares.grip, r.dry * dgrip);
    const REAL grip = r.dry * r.shares.grip;
    for (int i = 0; i < 2; ++i) {
        const REAL slipping = REAL_MULADD(grip, by->slip[i], turned * at->slip[i]);
        change[i] = REAL_SELECT(FN(coulomb_sticks)(at), at->share * by->push[i], slipping);
    }
}

static inline void FN(coulomb_force)(const FN(coulomb) * law, const FN(contact) * at, REAL force[2])
{
    if (at->patch != FST_PATCH_POINT) {
        FN(disc_force)(law, at, force);
        return;
    }
    const REAL *v = at->slip, *a = at->push;
    const REAL s2 = SUM_2(v[0], v[0], v[1], v[1]), dry = FN(coulomb_mu)(law, s2) * FN(coulomb_load)(at);
    const REAL inverse_s = REAL_RECIPROCAL_SQRT(s2 + R(1e-290));
    const REAL_MASK sticks = FN(coulomb_sticks)(at), slips = FN(is_moving)(at->modes->contact);
    REAL u[2] = {R(0.0), R(0.0)};
    if (REAL_ANY(REAL_LESS(R(1.5), at->modes->contact)))
        FN(lag_direction)(&at->modes->onset, at->time, a, v, u);
    for (int i = 0; i < 2; ++i) {
        const REAL slipping = dry * REAL_SELECT(slips, v[i] * inverse_s, u[i]);
        force[i] = REAL_SELECT(sticks, at->share * a[i], slipping);
    }
}

static inline void FN(coulomb_change)(const FN(coulomb) * law, const FN(contact) * at, const FN(contact) * by,
                                      REAL change[2])
{
    if (at->patch != FST_PATCH_POINT) {
        FN(disc_change)(law, at, by, change);
        return;
    }
    const REAL *v = at->slip, *dv = by->slip;
    const REAL s2 = SUM_2(v[0], v[0], v[1], v[1]), inverse_s = REAL_RECIPROCAL_SQRT(s2 + R(1e-290));
    const REAL u[2] = {v[0] * inverse_s, v[1] * inverse_s};
    const REAL mu = FN(coulomb_mu)(law, s2), load = FN(coulomb_load)(at);
    const REAL dload = REAL_SELECT(REAL_LESS(R(0.0), at->load), by->load, R(0.0));
    const REAL across = SUM_2(u[0], dv[1], -u[1], dv[0]);
    const REAL ds2 = R(2.0) * SUM_2(v[0], dv[0], v[1], dv[1]);
    const REAL ddry = REAL_MULADD(mu, dload, FN(coulomb_mu_by_s2)(law, s2) * ds2 * load);
    const REAL turning = mu * load * across * inverse_s;
    const REAL turned[2] = {-u[1], u[0]};
    const REAL_MASK sticks = FN(coulomb_sticks)(at), slips = FN(is_moving)(at->modes->contact);
    REAL onset[2] = {R(0.0), R(0.0)};
    if (REAL_ANY(REAL_LESS(R(1.5), at->modes->contact)))
        FN(lag_change)(&at->modes->onset, at->time, at->push, v, by->push, dv, mu * load, ddry, onset);
    for (int i = 0; i < 2; ++i) {
        const REAL slipping = REAL_MULADD(ddry, u[i], turning * turned[i]);
        const REAL released = REAL_SELECT(slips, slipping, onset[i]);
        change[i] = REAL_SELECT(sticks, at->share * by->push[i], released);
    }
}

static inline REAL FN(coulomb_loss)(const FN(coulomb) * law, const FN(contact) * at)
{
    const REAL s2 = SUM_2(at->slip[0], at->slip[0], at->slip[1], at->slip[1]);
    if (at->patch != FST_PATCH_POINT) {
        REAL force[2];
        FN(disc_force)(law, at, force);
        return REAL_SELECT(FN(coulomb_sticks)(at), R(0.0), SUM_2(force[0], at->slip[0], force[1], at->slip[1]));
    }
    const REAL loss = FN(coulomb_mu)(law, s2) * FN(coulomb_load)(at) * REAL_SQRT(s2);
    return REAL_SELECT(FN(coulomb_sticks)(at), R(0.0), loss);
}

/* dt/dtheta of the time theta in which slip is integrated: sigma = s/sqrt(s^2 + s_r^2), with s how fast the
 * contact moves (motion_2 = s^2).  In theta a slip that dies in a finite time decays exponentially, its
 * direction turns no faster than at a bounded rate, and all is smooth (more in ode/contact.c).  On a disc, s
 * counts pivoting: the rate k (3 pi/8) mu N/(a |w|) at which a creep settles is bounded in theta too,
 * however slowly the bead pivots.  A bead that sticks, or has just been released, is integrated in time. */
static inline REAL FN(coulomb_pace)(const FN(coulomb) * law, REAL mode, REAL motion_2)
{
    const REAL pace = REAL_SQRT(motion_2 / (motion_2 + law->usual_slip_2));
    return REAL_SELECT(FN(is_moving)(mode), pace, R(1.0));
}

/* Its change as motion_2 changes. */
static inline REAL FN(coulomb_pace_change)(const FN(coulomb) * law, REAL mode, REAL motion_2, REAL change)
{
    const REAL whole = motion_2 + law->usual_slip_2;
    const REAL by =
        R(0.5) * change * law->usual_slip_2 * REAL_RECIPROCAL_SQRT((motion_2 + R(1e-290)) * whole) / whole;
    return REAL_SELECT(FN(is_moving)(mode), by, R(0.0));
}

#undef OF_DISC
