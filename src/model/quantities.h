/* quantities.h - the numbers of the quantities that are integrated and tracked along a trajectory
 * (observe.inl). */
#ifndef FST_MODEL_QUANTITIES_H
#define FST_MODEL_QUANTITIES_H

/* Quantities whose time integrals a run accumulates with the step's own stages. */
enum {
    FST_Q_R,
    FST_Q_R2,
    FST_Q_B,
    FST_Q_B2, /* R2, B2: squared deviations from reference values */
    FST_Q_FRICTION_POWER,
    FST_Q_DRIVE_POWER,
    FST_Q_SLIP2,
    FST_Q_LOAD,
    FST_Q_SLIP_R,
    FST_Q_SLIP_ALPHA,
    FST_Q_R_SLIP_ALPHA,
    FST_Q_SPIN_TERM,
    FST_Q_CENTRIFUGAL,
    FST_Q_FORCE_R,
    FST_Q_FORCE_R_PRINTED,
    FST_Q_TORQUE_ALPHA,
    FST_Q_EQ23,
    FST_Q_N_R,
    FST_Q_N_ALPHA,
    FST_Q_N_Z, /* first and second moments of n in local components */
    FST_Q_N_RR,
    FST_Q_N_RALPHA,
    FST_Q_N_RZ,
    FST_Q_N_ALPHAALPHA,
    FST_Q_N_ALPHAZ,
    FST_Q_N_ZZ,
    FST_Q_STICKING, /* of dry contacts, from here on; 1 while the contact sticks */
    FST_Q_ROLLING_POWER,
    FST_Q_PIVOTING_POWER,
    FST_Q_FLYING, /* 1 while the bead is in the air */
    FST_Q_COUNT,
    FST_Q_OTHERS = FST_Q_STICKING /* lanes of other contacts add up those before */
};

/* Quantities whose extremes a run locates. */
enum { FST_TRACK_R, FST_TRACK_B, FST_TRACK_GAP, FST_TRACK_SLIP, FST_TRACK_LOAD, FST_TRACK_COUNT };

/* The records that a run keeps: the greatest of each tracked quantity at its number, then the least of some. */
enum { FST_LEAST_R = FST_TRACK_COUNT, FST_LEAST_B, FST_LEAST_LOAD, FST_RECORD_COUNT };
static const int FST_RECORD_TRACKS[FST_RECORD_COUNT] = {FST_TRACK_R,    FST_TRACK_B,    FST_TRACK_GAP,
                                                        FST_TRACK_SLIP, FST_TRACK_LOAD, FST_TRACK_R,
                                                        FST_TRACK_B,    FST_TRACK_LOAD};
static inline double fst_record_sign(int record)
{
    return record < FST_TRACK_COUNT ? 1.0 : -1.0;
}

#endif
