/* tangent.inl - the derivative of the equations of motion (dynamics.inl) along a tangent vector, over REAL.
 *
 * With the bead's dipole u = s n + 2 a B, the magnet's force is F = G u and its torque u x B = s n x B, so that
 * along the tangent vector, whose changes are written d:
 *
 *     dB = G dx,     ds = 2 b (dn.B + n.dB),     du = ds n + s dn + 2 a dB,     dF = dG u + G du,
 *     d(s n x B) = s dn x B + n x (ds B + s dB),
 *     dV = dv - eps dW x e,      dN = -dF_z,     df by the contact law from dV and dN.
 *
 * What does not depend on the tangent vector, the field at the place above all, is made once by linearise() and
 * serves all the vectors there: change_along() of each.  The columns of a Jacobian are such changes.
 */

/* The equations of motion at a state, ready to be differentiated. */
typedef struct FN(linear) {
    FN(local_field) at;
    REAL strength, dipole[3]; /* s and u */
    FN(contact) contact;
} FN(linear);

/* From the field at the place, l->at. */
static inline __attribute__((always_inline)) void FN(linearise_in_field)(const FN(world) * c,
                                                                         const FN(modes) * m, REAL omega,
                                                                         const REAL *y, FN(linear) * l,
                                                                         REAL *dy)
{
    const REAL *n = y + FST_NX, *b = l->at.b;
    FN(pull) p;
    const REAL s = p.strength = l->strength = FN(strength)(c, n, b);
    for (int i = 0; i < 3; ++i) {
        p.b[i] = b[i];
        if (c->kinds.magnetisable)
            l->dipole[i] = REAL_MULADD(s, n[i], c->twice_a * b[i]);
        else
            l->dipole[i] = s * n[i];
    }
    FN(times_gradient)(&l->at.gradient, l->dipole, p.force);
    l->contact = FN(contact_of)(c, m, y, &p);
    FN(kinematics)(omega, y, dy);
    FN(dynamics)(c, m, omega, y, &p, dy);
}

static inline __attribute__((always_inline)) void
FN(linearise)(const FN(world) * c, const FN(modes) * m, REAL omega, const REAL *y, FN(linear) * l, REAL *dy)
{
#ifdef FST_COUNT_EVALUATION
    FST_COUNT_EVALUATION(); /* as in magnetic_pull() */
#endif
    FN(source_look)(&c->source, &c->kinds, y[FST_X], y[FST_Y], FN(height_of)(c, m, y), &l->at);
    FN(linearise_in_field)(c, m, omega, y, l, dy);
}

/* dF, and in `turning` ds B + s dB, as the field changes by db, its gradient by dg, and n by dn. */
static inline void FN(pull_change_by)(const FN(world) * c, const FN(linear) * l, const REAL *n, const REAL *dn,
                                      const REAL db[3], const FN(gradient) * dg, REAL force[3], REAL turning[3])
{
    const REAL *b = l->at.b, s = l->strength;
    REAL du[3], gdu[3];
    if (c->kinds.magnetisable) {
        const REAL ds =
            c->twice_b * SUM_6(dn[0], b[0], dn[1], b[1], dn[2], b[2], n[0], db[0], n[1], db[1], n[2], db[2]);
        for (int i = 0; i < 3; ++i) {
            du[i] = REAL_MULADD(ds, n[i], REAL_MULADD(s, dn[i], c->twice_a * db[i]));
            turning[i] = REAL_MULADD(ds, b[i], s * db[i]);
        }
    } else {
        for (int i = 0; i < 3; ++i) {
            du[i] = s * dn[i];
            turning[i] = s * db[i];
        }
    }
    FN(times_gradient)(&l->at.gradient, du, gdu);
    FN(times_gradient)(dg, l->dipole, force);
    for (int i = 0; i < 3; ++i)
        force[i] = force[i] + gdu[i];
}

/* The same as the place and n change. */
static inline void FN(pull_change)(const FN(world) * c, const FN(linear) * l, const REAL *y,
                                   const REAL *tangent, REAL force[3], REAL turning[3])
{
    const REAL ex = tangent[FST_X], ey = tangent[FST_Y];
    FN(gradient) dg;
    REAL db[3];
    FN(field_change)(&l->at.gradient, ex, ey, db);
    FN(gradient_change)(&l->at.bend, ex, ey, &dg);
    FN(pull_change_by)(c, l, y + FST_NX, tangent + FST_NX, db, &dg, force, turning);
}

/* farago2020: the change of (W.n) W x n. */
static inline void FN(add_lost_change)(const REAL *n, const REAL *w, const REAL *dn, const REAL *dw, REAL *out)
{
    const REAL spin = SUM_3(w[0], n[0], w[1], n[1], w[2], n[2]);
    const REAL dspin = SUM_6(dw[0], n[0], dw[1], n[1], dw[2], n[2], w[0], dn[0], w[1], dn[1], w[2], dn[2]);
    REAL wxn[3], dwxn[3], wxdn[3];
    FN(cross)(w, n, wxn);
    FN(cross)(dw, n, dwxn);
    FN(cross)(w, dn, wxdn);
    for (int i = 0; i < 3; ++i)
        out[i] = REAL_MULADD(dspin, wxn[i], REAL_MULADD(spin, dwxn[i] + wxdn[i], out[i]));
}

/* The change of the torque of a plate that resists rolling, from that of the magnet's torque, `turning`. */
static inline void FN(resist_rolling_change)(const FN(world) * c, const FN(linear) * l, const REAL *y,
                                             const REAL *tangent, const REAL force[3], const REAL turning[3],
                                             const REAL lost[3], FN(contact) * by)
{
    REAL df[2];
    if (FN(resist_asks_balance)(l->contact.modes)) {
        for (int i = 0; i < 2; ++i)
            by->push[i] = c->yielding * force[i];
        FN(friction_change)(&c->law, &c->kinds, &l->contact, by, df);
        by->balance[0] = turning[0] + lost[0] / c->torque - c->eps * df[1];
        by->balance[1] = turning[1] + lost[1] / c->torque + c->eps * df[0];
    }
    FN(resist_change)
    (&c->resistance, l->contact.modes, l->contact.time, y + FST_WX, l->contact.load, l->contact.balance,
     tangent + FST_WX, by->load, by->balance, by->torque);
}

/* The changes of the resistances' torque and of A, from those of the load, the force and the magnet's torque,
 * which is strength * twist + torque. */
static inline void FN(dry_change)(const FN(world) * c, const FN(linear) * l, const REAL *y, const REAL *tangent,
                                  const REAL force[3], const REAL twist[3], const REAL torque[3],
                                  FN(contact) * by)
{
    const REAL *n = y + FST_NX, *w = y + FST_WX, *dn = tangent + FST_NX, *dw = tangent + FST_WX;
    REAL turning[3], lost[3] = {R(0.0), R(0.0), R(0.0)};
    for (int i = 0; i < 3; ++i) {
        turning[i] = REAL_MULADD(l->strength, twist[i], torque[i]);
        by->torque[i] = R(0.0);
    }
    by->push[0] = by->push[1] = by->balance[0] = by->balance[1] = R(0.0);
    if (c->kinds.gyroscopic_term_lost)
        FN(add_lost_change)(n, w, dn, dw, lost);
    by->patch = HAS(c->kinds, patch);
    by->pivot = dw[2];
    if (HAS(c->kinds, resists))
        FN(resist_rolling_change)(c, l, y, tangent, force, turning, lost, by);
    const REAL kept[2] = {by->push[0], by->push[1]};
    for (int i = 0; i < 3; ++i)
        turning[i] = turning[i] + by->torque[i];
    FN(push)(c, force, turning, c->kinds.gyroscopic_term_lost ? lost : NULL, by->push);
    for (int i = 0; HAS(c->kinds, resists) && i < 2; ++i)
        by->push[i] = REAL_SELECT(FN(rests)(l->contact.modes), kept[i], by->push[i]);
    if (HAS(c->kinds, patch))
        by->torque[2] =
            FN(coulomb_pivoting_change)(&c->law.coulomb, &l->contact, by, turning[2] + lost[2] / c->torque);
}

/* The change of d(state)/dt along `tangent` at the state that was linearised, where pull_change() is known. */
static inline void FN(change_by_pull)(const FN(world) * c, REAL omega, const REAL *y, const FN(linear) * l,
                                      const REAL *tangent, const REAL force[3], const REAL turning[3],
                                      REAL *change)
{
    const REAL *n = y + FST_NX, *w = y + FST_WX, *dn = tangent + FST_NX, *dw = tangent + FST_WX;
    REAL friction[2], twist[3], torque[3], dwxn[3];
    FN(contact) by;
    FN(slip)(c, tangent, by.slip);
    by.load = -force[2];
    by.push[0] = by.push[1] = by.torque[0] = by.torque[1] = by.torque[2] = by.pivot = R(0.0);
    by.balance[0] = by.balance[1] = R(0.0);
    by.patch = FST_PATCH_POINT;
    FN(cross)(dn, l->at.b, twist);
    FN(cross)(n, turning, torque);
    if (HAS(c->kinds, dry))
        FN(dry_change)(c, l, y, tangent, force, twist, torque, &by);
    FN(friction_change)(&c->law, &c->kinds, &l->contact, &by, friction);
    FN(accelerations)(c, omega, tangent, force, friction, l->strength, twist, change);
    for (int i = 0; i < 3; ++i)
        change[FST_WX + i] = REAL_MULADD(c->torque, torque[i], change[FST_WX + i]);
    for (int i = 0; HAS(c->kinds, dry) && i < 3; ++i)
        change[FST_WX + i] = REAL_MULADD(c->torque, by.torque[i], change[FST_WX + i]);
    /* Of the kinematics, which are linear but for the product W x n, that of the tangent's own dW x dn is not
     * wanted: (W - omega e) x dn + dW x n stands in its place. */
    FN(kinematics)(omega, tangent, change);
    REAL turn[3];
    FN(turning_seen)(omega, w, turn);
    FN(cross)(turn, dn, change + FST_NX);
    FN(cross)(dw, n, dwxn);
    for (int i = 0; i < 3; ++i)
        change[FST_NX + i] = change[FST_NX + i] + dwxn[i];
    if (c->kinds.gyroscopic_term_lost)
        FN(add_lost_change)(n, w, dn, dw, change + FST_WX);
    if (HAS(c->kinds, resists))
        FN(keep_at_rest)(c, l->contact.modes, change);
}

/* The same, from the tangent vector alone. */
static inline void FN(change_along)(const FN(world) * c, REAL omega, const REAL *y, const FN(linear) * l,
                                    const REAL *tangent, REAL *change)
{
    REAL force[3], turning[3];
    FN(pull_change)(c, l, y, tangent, force, turning);
    FN(change_by_pull)(c, omega, y, l, tangent, force, turning, change);
}

#ifdef REAL_IS_SCALAR
/* The change of the contact along a tangent vector: of its slip, load, push and what else friction sees. */
static inline FN(contact)
    FN(contact_change)(const FN(world) * c, const FN(linear) * l, const REAL *y, const REAL *tangent)
{
    REAL force[3], turning[3], twist[3], torque[3];
    FN(contact) by = {.slip = {R(0.0)}};
    FN(pull_change)(c, l, y, tangent, force, turning);
    FN(slip)(c, tangent, by.slip);
    by.load = l->contact.load > 0 ? -force[2] : R(0.0);
    FN(cross)(tangent + FST_NX, l->at.b, twist);
    FN(cross)(y + FST_NX, turning, torque);
    FN(dry_change)(c, l, y, tangent, force, twist, torque, &by);
    return by;
}

/* The change of d(state)/dt of all numbers of a bead in the air (contact/modes.inl). */
static inline void FN(change_aloft)(const FN(world) * c, REAL omega, const REAL *y, const FN(linear) * l,
                                    const REAL *tangent, REAL *change)
{
    const REAL ex = tangent[FST_X], ey = tangent[FST_Y];
    FN(gradient) dg;
    REAL db[3], force[3], turning[3];
    FN(field_change)(&l->at.gradient, ex, ey, db);
    FN(gradient_change)(&l->at.bend, ex, ey, &dg);
    FN(add_rise)(&l->at, tangent[FST_HEIGHT], db, &dg);
    FN(pull_change_by)(c, l, y + FST_NX, tangent + FST_NX, db, &dg, force, turning);
    FN(change_by_pull)(c, omega, y, l, tangent, force, turning, change);
    change[FST_STEP_TIME] = R(0.0);
    change[FST_HEIGHT] = tangent[FST_CLIMB];
    change[FST_CLIMB] = force[2];
}
#endif

/* d(state)/dt at the drive `omega`, and its change along `tangent`. */
static inline void FN(rhs_and_tangent)(const FN(world) * c, const FN(modes) * m, REAL omega, const REAL *y,
                                       const REAL *tangent, REAL *dy, REAL *change)
{
    FN(linear) l;
    FN(linearise)(c, m, omega, y, &l, dy);
    FN(change_along)(c, omega, y, &l, tangent, change);
}

/* jacobian[i][j] = d(y'_i)/d(y_j) at the drive `omega`: column j is the change along axis j. */
static inline void FN(jacobian)(const FN(world) * c, const FN(modes) * m, REAL omega, const REAL *y,
                                REAL jacobian[FST_STATE_SIZE][FST_STATE_SIZE])
{
    FN(linear) l;
    REAL dy[FST_STATE_SIZE], axis[FST_STATE_SIZE], column[FST_STATE_SIZE];
    FN(linearise)(c, m, omega, y, &l, dy);
    for (int i = 0; i < FST_STATE_SIZE; ++i)
        axis[i] = R(0.0);
    for (int j = 0; j < FST_STATE_SIZE; ++j) {
        axis[j] = R(1.0);
        FN(change_along)(c, omega, y, &l, axis, column);
        axis[j] = R(0.0);
        for (int i = 0; i < FST_STATE_SIZE; ++i)
            jacobian[i][j] = column[i];
    }
}
