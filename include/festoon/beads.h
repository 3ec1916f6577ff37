/* beads.h - several beads on one plate: they attract each other as dipoles, touch, rub and collide.
 *
 * A bead has twelve numbers: place, velocity, direction n of the moment, angular velocity W, three each, as in a
 * state of one bead (festoon.h): X Y Z vX vY vZ nX nY nZ WX WY WZ.  Z is the height of the centre over the
 * plate's surface.  Beads move in three dimensions always: one that two others lift leaves the plate before
 * they touch.  The equations and the rule of contacts stand in src/beads, from look.c, select.c and flow.c on.
 */
#ifndef FESTOON_BEADS_H
#define FESTOON_BEADS_H

#include <festoon/festoon.h>

#ifdef __cplusplus
extern "C" {
#endif

enum { FST_BEADS_MOST = 8, FST_BEAD_NUMBERS = 12, FST_BEAD_TOUCHES = 36, FST_BEADS_EVENTS = 1000 };

/* Names by rows, as in lists.def. */
#define FST_BEAD_EVENT_LIST(ROW)                                                                               \
    ROW(BEAD_EVENT_LIFT, "lift", "a bead leaves the plate")                                                    \
    ROW(BEAD_EVENT_LAND, "land", "a bead falls on the plate")                                                  \
    ROW(BEAD_EVENT_TOUCH, "touch", "two beads meet")                                                           \
    ROW(BEAD_EVENT_PART, "part", "two beads part")                                                             \
    ROW(BEAD_EVENT_GRAZE, "graze", "a contact keeps a part of its friction and no load")                       \
    ROW(BEAD_EVENT_PRESS, "press", "a contact that grazed bears load again")

#define FST_BEAD_GROUPS(ROW)                                                                                   \
    ROW(BEAD_GROUP_SINGLE, "single", "a bead apart")                                                           \
    ROW(BEAD_GROUP_PAIR, "pair", "two beads in touch")                                                         \
    ROW(BEAD_GROUP_CHAIN, "chain", "three or more in a row")                                                   \
    ROW(BEAD_GROUP_RING, "ring", "a chain that is closed")                                                     \
    ROW(BEAD_GROUP_CLUSTER, "cluster", "any other group")

#define FST_BEADS_OUTCOMES(ROW)                                                                                \
    ROW(BEADS_APART, "apart", "no bead touches another")                                                       \
    ROW(BEADS_WALKER, "walker", "the largest group turns with the magnet, and its centre circles otherwise")   \
    ROW(BEADS_BAR, "bar", "the largest group turns with the magnet about the axis")                            \
    ROW(BEADS_RING, "ring", "the largest group is a ring")                                                     \
    ROW(BEADS_CLUSTER, "cluster", "the largest group is neither chain nor ring")                               \
    ROW(BEADS_EJECTED, "ejected", "a bead passed the plate's edge")                                            \
    ROW(BEADS_UNDECIDED, "undecided", "the motion has not settled")

typedef enum { FST_BEAD_EVENT_LIST(FST_ROW_ENUM) FST_BEAD_EVENTS } fst_bead_event_kind;
typedef enum { FST_BEAD_GROUPS(FST_ROW_ENUM) FST_BEAD_GROUP_KINDS } fst_bead_group_kind;
typedef enum { FST_BEADS_OUTCOMES(FST_ROW_ENUM) FST_BEADS_OUTCOME_COUNT } fst_beads_outcome;
FST_API const char *fst_bead_event_name(fst_bead_event_kind kind);
FST_API const char *fst_bead_group_name(fst_bead_group_kind kind);
FST_API const char *fst_beads_outcome_name(fst_beads_outcome outcome);

/* What happened at a contact. */
typedef struct fst_bead_event {
    double time; /* 1/gamma */
    fst_bead_event_kind kind;
    int beads[2]; /* the second is -1 for the plate */
    double speed; /* with which the contact closed, l gamma */
} fst_bead_event;

/* A contact at the end. */
typedef struct fst_bead_touch {
    int beads[2]; /* the second is -1 for the plate */
    double force; /* per mass of the first bead of the list, l gamma^2 */
} fst_bead_touch;

/* One bead in the window of the means. */
typedef struct fst_bead_result {
    fst_regime regime;
    double mean_r, mean_alpha_dot;
    double mean_load_weights; /* load on the plate over the bead's weight; NAN without gravity */
    double ejected_at;        /* 1/gamma; NAN: it was not */
    double final_state[FST_BEAD_NUMBERS];
} fst_bead_result;

/* Beads that touch each other. */
typedef struct fst_bead_group {
    fst_bead_group_kind kind;
    int count, members[FST_BEADS_MOST];
    double mean_r;      /* of the centre of mass */
    double centre_rate; /* at which that circles the axis, gamma; NAN: it stays at the axis */
    double axis_rate;   /* at which the line through the group's ends turns; NAN of a single bead */
} fst_bead_group;

typedef struct fst_beads_result {
    int count;
    fst_bead_result beads[FST_BEADS_MOST];
    int group_count;
    fst_bead_group groups[FST_BEADS_MOST];
    fst_beads_outcome outcome;
    char reason[256]; /* why this outcome */
    int touch_count;
    fst_bead_touch touches[FST_BEAD_TOUCHES];
    int forces_unique; /* 0: more contacts than directions, so that the forces are one choice of many */
    double drive_power, plate_power, pair_power, impact_power; /* means per mass of the first bead */
    double restitution;                                        /* of impacts, as used */
    double energy_residual; /* of the whole run, per mass of the first bead */
    int event_count;        /* of those that are listed, the first ones */
    fst_bead_event events[FST_BEADS_EVENTS];
    int64_t counts[FST_BEAD_EVENTS];
    double omega, periods;
    uint64_t rhs_calls, accepted, rejected;
} fst_beads_result;

typedef struct fst_beads_options {
    uint32_t cookie;
    double
        pair_rate; /* friction between beads, 1/s as friction.gamma; NAN: as at the plate, 0 where that has none */
    double chi;    /* mu_0 moment^2/(4 pi m l^5 gamma^2) of the first bead; NAN: of its moment, 1.2 T if nothing
                         says it */
    const double *state; /* 12 numbers for each bead, at the start; NULL: those of start.* */
    const fst_progress *progress;
} fst_beads_options;
FST_API fst_beads_options fst_default_beads_options(void);

/* Simulate 1 to FST_BEADS_MOST beads.  Each is given by whole parameters, which differ in bead.* and start.*
 * alone; the means are those of the drive periods behind run.discard.  impact.restitution counts under every
 * law, 0 unless given; friction is viscous or none, beads are hard magnets, and the magnet is known at any
 * height (lines, parts).  FST_BAD_INPUT: it is not so, or beads overlap; FST_NO_CONVERGENCE: contacts have no
 * consistent state, or impacts do not end. */
FST_API fst_status fst_beads_run(const fst_params *beads, int count, const fst_beads_options *options,
                                 fst_beads_result *result, fst_error *error);

#ifdef __cplusplus
}
#endif

#endif
