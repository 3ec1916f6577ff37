/* drive.inl - how the magnet turns, over REAL: rate, transport, period and power (its phase: drive.c).
 *
 * Every vector is written in components along axes that turn with the magnet at the rate omega about e, but
 * stays an inertial vector: each derivative gains -omega e x (.).  The drive turns steadily, or on a ramp from
 * the time `since` on:
 *
 *     omega |          .'          phase(t) = before + omega (t - since) + ramp (t - since)^2/2,   t > since
 *           |........'
 *           +--------+-----> t     the ramp begins at `since`; ask for no time before
 *                  since
 *
 * The phase is kept to twice the digits of a number, because laboratory positions after a million turns need
 * the fraction of a turn (drive.c).  The including file brings base/twofold.inl.
 */
typedef struct FN(drive) {
    REAL omega, ramp; /* the rate at the time `since`, and how it changes from then on */
    FN(twofold) since;
    FN(twofold) before; /* the phase at that time */
} FN(drive);

/* The rate at a time, which on a ramp must not lie before its start. */
static inline REAL FN(drive_rate)(const FN(drive) * d, FN(twofold) t)
{
    return d->omega + d->ramp * FN(twofold_difference)(t, d->since);
}

/* d(u)/dt in the turning axes of a vector's horizontal part, of which `rate` is the change in space. */
static inline void FN(transport)(REAL omega, const REAL u[2], const REAL rate[2], REAL out[2])
{
    out[0] = REAL_MULADD(omega, u[1], rate[0]);
    out[1] = REAL_NEGMULADD(omega, u[0], rate[1]);
}

/* The rate W - omega e at which a vector turns in these axes that turns with the bead in space. */
static inline void FN(turning_seen)(REAL omega, const REAL w[3], REAL turn[3])
{
    turn[0] = w[0];
    turn[1] = w[1];
    turn[2] = w[2] - omega;
}

/* d(y')/d(omega) = -e x (.) of every vector of a state. */
static inline void FN(rhs_by_omega)(const REAL *y, REAL *out)
{
    static const int vectors[] = {FST_X, FST_VX, FST_NX, FST_WX};
    for (int i = 0; i < FST_STATE_SIZE; ++i)
        out[i] = R(0.0);
    for (int i = 0; i < 4; ++i) {
        const int first = vectors[i];
        out[first] = y[first + 1];
        out[first + 1] = -y[first];
    }
}

/* The power of the drive, dU/dt at fixed x, n and W: omega e.(x x F + tau), tau_z = strength * twist. */
static inline REAL FN(drive_power)(REAL omega, REAL r, REAL force_alpha, REAL strength, REAL twist)
{
    return omega * SUM_2(r, force_alpha, strength, twist);
}

/* The time of a turn. */
static inline REAL FN(drive_period)(REAL omega)
{
    return REAL_OF(FST_TWO_PI) / omega;
}
