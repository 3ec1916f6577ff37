/* beads.h - several beads on one plate: they attract each other as dipoles, touch, rub and collide.
 *
 * A bead has twelve numbers: place, velocity, direction n of the moment, angular velocity W, three each, as in a
 * state of one bead (festoon.h): X Y Z vX vY vZ nX nY nZ WX WY WZ.  Z is the height of the centre over the
 * plate's surface.  Beads move in three dimensions always: one that two others lift leaves the plate before
 * they touch.  The equations and the rule of contacts stand in src/beads, from look.c, select.c and flow.c on.
 */
#ifndef FESTOON_BEADS_H
#define FESTOON_BEADS_H

#include <festoon/orbits.h>

#ifdef __cplusplus
extern "C" {
#endif

/* Increased when the same beads give other numbers than before; a sweep goes on only under the same version. */
#define FST_BEADS_RESULTS_VERSION 5

enum { FST_BEAD_TOUCHES = 36, FST_BEADS_EVENTS = 1000 };

/* Names by rows, as in lists.def. */
#define FST_BEAD_EVENT_LIST(ROW)                                                                               \
    ROW(BEAD_EVENT_LIFT, "lift", "a bead leaves the plate")                                                    \
    ROW(BEAD_EVENT_LAND, "land", "a bead falls on the plate")                                                  \
    ROW(BEAD_EVENT_TOUCH, "touch", "two beads meet")                                                           \
    ROW(BEAD_EVENT_PART, "part", "two beads part")                                                             \
    ROW(BEAD_EVENT_GRAZE, "graze", "a contact keeps a part of its friction and no load")                       \
    ROW(BEAD_EVENT_PRESS, "press", "a contact that grazed bears load again")                                   \
    ROW(BEAD_EVENT_STICK, "stick", "a contact with dry friction stops slipping")                               \
    ROW(BEAD_EVENT_SLIP, "slip", "a contact with dry friction begins to slip")

#define FST_BEAD_GROUPS(ROW)                                                                                   \
    ROW(BEAD_GROUP_SINGLE, "single", "a bead apart")                                                           \
    ROW(BEAD_GROUP_PAIR, "pair", "two beads in touch")                                                         \
    ROW(BEAD_GROUP_CHAIN, "chain", "three or more in a row")                                                   \
    ROW(BEAD_GROUP_RING, "ring", "a chain that is closed")                                                     \
    ROW(BEAD_GROUP_CLUSTER, "cluster", "any other group")

/* Then: the colour in figures, FST_COLOUR_*. */
#define FST_BEADS_OUTCOMES(ROW)                                                                                \
    ROW(BEADS_APART, "apart", "no two beads stay together for a turn of the magnet", BLUE)                     \
    ROW(BEADS_WALKER, "walker", "the largest group turns with the magnet, and its centre circles otherwise",   \
        VERMILION)                                                                                             \
    ROW(BEADS_BAR, "bar", "the largest group turns with the magnet about the axis", GREEN)                     \
    ROW(BEADS_RING, "ring", "the largest group is a ring", PURPLE)                                             \
    ROW(BEADS_CLUSTER, "cluster", "the largest group is neither chain nor ring", ORANGE)                       \
    ROW(BEADS_EJECTED, "ejected", "a bead passed the plate's edge", BLACK)                                     \
    ROW(BEADS_UNDECIDED, "undecided", "the motion has not settled", GREY)

typedef enum { FST_BEAD_EVENT_LIST(FST_ROW_ENUM) FST_BEAD_EVENTS } fst_bead_event_kind;
typedef enum { FST_BEAD_GROUPS(FST_ROW_ENUM) FST_BEAD_GROUP_KINDS } fst_bead_group_kind;
typedef enum { FST_BEADS_OUTCOMES(FST_ROW_ENUM) FST_BEADS_OUTCOME_COUNT } fst_beads_outcome;
FST_API const char *fst_bead_event_name(fst_bead_event_kind kind);
FST_API const char *fst_bead_group_name(fst_bead_group_kind kind);
FST_API const char *fst_beads_outcome_name(fst_beads_outcome outcome);
FST_API const char *fst_beads_method_name(fst_beads_method method);

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
    double
        force; /* per mass of the first bead of the list, l gamma^2; of stepping: the mean over the last step */
} fst_bead_touch;

/* Why an exact run could not go on: its contacts allow no motion, or several (the paradox of Painleve, under dry friction
 * alone), or impacts follow each other without end.  It lists the contacts that touched then. */
typedef struct fst_beads_paradox {
    double time; /* 1/gamma; NAN: there was none */
    int motions; /* 0: no state of these contacts is consistent, or of more than ten none was found; 2: two are, with
                    different accelerations; 1: more than 1000 impacts and releases follow each other within a
                    thousandth of 1/gamma */
    int touch_count, touches[FST_BEAD_TOUCHES][2]; /* as in fst_bead_touch */
} fst_beads_paradox;

/* One bead in the window of the means. */
typedef struct fst_bead_result {
    fst_regime regime;
    double mean_r, mean_alpha_dot; /* NAN: the bead is gone; the rate also of one that ends on the axis */
    double mean_r_error, mean_alpha_dot_error; /* limits of their errors, by how the bead swings */
    double mean_load_weights; /* load on the plate over the bead's weight; NAN without gravity or plate */
    double
        mean_height; /* of the centre over the plate or the bowl's lowest point; without a plate over the magnet's
                           reference plane; NAN: the bead is gone */
    double ejected_at; /* 1/gamma; NAN: it was not */
    double mean_velocity,
        mean_velocity_error; /* along a wave; the limit of its error; NAN: no wave, or the bead is gone */
    double final_state[FST_BEAD_NUMBERS];
} fst_bead_result;

/* Beads that touch each other. */
typedef struct fst_bead_group {
    fst_bead_group_kind kind;
    int count;
    const int *members; /* of a chain: its ends first and last */
    double mean_r;      /* of the centre of mass */
    double centre_rate; /* at which that circles the axis, gamma; NAN: it stays at the axis */
    double axis_rate;   /* at which the line through the group's ends turns; NAN of a single bead */
} fst_bead_group;

/* All a run tells; free it with fst_beads_free(). */
typedef struct fst_beads_result {
    int count;
    fst_bead_result *beads;
    int group_count;
    fst_bead_group *groups;
    int *members; /* of all groups, one after the other */
    fst_beads_outcome outcome;
    char reason[256]; /* why this outcome */
    int touch_count;
    fst_bead_touch *touches;
    int forces_unique; /* 0: more contacts than directions, so that the forces are one choice of many, or stepping,
                          which does not ask */
    double drive_power, plate_power, pair_power, impact_power; /* means per mass of the first; NAN: all gone */
    double medium_power;                                       /* the same, to the medium */
    double restitution;                                        /* of impacts, as used */
    fst_beads_paradox paradox;                                 /* it ended the run, which is undecided */
    double energy_residual; /* of the whole run, per mass of the first bead */
    double energy_scale;    /* the works that it is the rest of, or the energy if that is greater */
    int event_count;        /* length of `events`, which has the first FST_BEADS_EVENTS of all */
    fst_bead_event *events;
    int64_t counts[FST_BEAD_EVENTS];
    double omega, periods;
    uint64_t rhs_calls, accepted, rejected; /* of stepping: steps, steps and 0 */
    fst_beads_method method;
    double steps_per_turn;  /* of stepping; these four are NAN or 0 otherwise */
    double solver_residual; /* greatest speed that the contact solver left wrong in any step, l gamma */
    double deepest;         /* greatest overlap in the middle of a step, l */
    uint64_t solver_sweeps;
} fst_beads_result;
FST_API void fst_beads_free(fst_beads_result *result);

/* All beads at one moment. */
typedef struct fst_beads_sample {
    double t, drive_turns; /* 1/gamma; turns of the magnet */
    int count;
    const double *states; /* FST_BEAD_NUMBERS of each bead; one that is gone rests in the laboratory */
    int touch_count;
    const fst_bead_touch *touches; /* contacts that are closed */
} fst_beads_sample;

typedef struct fst_beads_options {
    uint32_t cookie;
    double
        pair_rate; /* friction between beads, 1/s as friction.gamma; NAN: as at the plate, 0 where that has none */
    double
        pair_mu; /* dry friction between beads; NAN: as at the plate, friction.mu; for friction.law coulomb */
    double chi;  /* mu_0 moment^2/(4 pi m l^5 gamma^2) of the first bead; NAN: of its moment, 1.2 T if nothing
                         says it */
    fst_beads_method method;
    double steps_per_turn; /* of stepping, 2000 unless given: halving the step halves its error, which is of the
                              second order where contacts last; a walker's rate is then off by 5e-4 */
    const double *state;   /* 12 numbers for each bead, at the start; NULL: those of start.* */
    const fst_progress *progress;
    /* Called for each sample, run.samples a turn from the start to the end, or in steps of sample_spacing (1/gamma) where
     * that is a number.  Another status than FST_OK ends the run with it. */
    fst_status (*sample)(void *user, const fst_beads_sample *sample, fst_error *error);
    void *user;
    double sample_spacing;
} fst_beads_options;
FST_API fst_beads_options fst_default_beads_options(void);

/* Simulate several beads.  Each is given by whole parameters, which differ in bead.* and start.*
 * alone; the means are those of the drive periods behind run.discard.  impact.restitution counts under every
 * law, 0 unless given; friction is viscous, coulomb or none, beads are hard magnets, and the magnet is known at any
 * height (lines, parts).  FST_BAD_INPUT: it is not so, or beads overlap; Where contacts have no consistent state or
 * impacts do not end the result is that of the time till then, undecided.  After a failure the result is empty. */
FST_API fst_status fst_beads_run(const fst_params *beads, int count, const fst_beads_options *options,
                                 fst_beads_result *result, fst_error *error);

/* The same of a scene with a list of beads, whose keys also say what of the options is not given: contact.pair_rate,
 * contact.pair_mu, model.chi; and run.method and run.step. */
FST_API fst_status fst_beads_run_scene(const fst_params *scene, const fst_beads_options *options,
                                       fst_beads_result *result, fst_error *error);

/* ------------------------------------------------------------------ locked states and orbits; they need LAPACK */

enum { FST_BEADS_DIRECTIONS = 11 * FST_BEADS_MOST };

/* The beads turn with the magnet: an equilibrium of the turning frame.  Its contacts stay as they are. */
typedef struct fst_beads_locked {
    int count;
    double state[FST_BEADS_MOST][FST_BEAD_NUMBERS];
    double r[FST_BEADS_MOST], phi_deg[FST_BEADS_MOST]; /* Phi, NAN on the axis */
    double height
        [FST_BEADS_MOST]; /* of the centre over that of the bead at rest on the plate; without one as in state */
    double load_weights[FST_BEADS_MOST]; /* load on the plate over the weight; NAN without gravity */
    int touch_count;
    fst_bead_touch touches[FST_BEAD_TOUCHES];
    int forces_unique;   /* as of a run */
    double power, omega; /* of the drive, per mass of the first bead; its rate */
    int free;        /* directions along which this is one of a continuum of states, as where spins are free */
    int eigenvalues; /* of the linearised motion, as many as the contacts leave directions */
    double eigenvalue_re[FST_BEADS_DIRECTIONS], eigenvalue_im[FST_BEADS_DIRECTIONS]; /* by falling real part */
    int stable;      /* no eigenvalue on the right; those of a continuum are 0 */
    double residual; /* the greatest rate that is left, over the radius or the drive's rate */
} fst_beads_locked;

/* The locked state to which the start leads: simulated until it is near, for run.periods at most, then by Newton's
 * method. FST_NO_CONVERGENCE: it leads to none; the sentence says why. */
FST_API fst_status fst_beads_locked_find(const fst_params *beads, int count, const fst_beads_options *options,
                                         fst_beads_locked *locked, fst_error *error);

/* These and the following of a scene with a list of beads, as fst_beads_run_scene(). */
FST_API fst_status fst_beads_locked_scene(const fst_params *scene, const fst_beads_options *options,
                                          fst_beads_locked *locked, fst_error *error);

/* A periodic orbit of the turning frame, with the same contacts all the way. */
typedef struct fst_beads_orbit {
    int count;
    int exchanges;         /* two beads change places in half a period */
    fst_symmetry symmetry; /* S2: of one bead, as of its fst_orbit */
    double period, omega;
    double state[FST_BEADS_MOST][FST_BEAD_NUMBERS];
    double mean_r[FST_BEADS_MOST], mean_alpha_dot[FST_BEADS_MOST];
    double drive_power, plate_power, pair_power; /* means per mass of the first bead */
    int multipliers; /* of half a turn, where that exchanges beads or maps one onto its image, else of the period */
    double multiplier_re[FST_BEADS_DIRECTIONS], multiplier_im[FST_BEADS_DIRECTIONS]; /* the largest first */
    int stable;
    double residual, trivial_error; /* as of an fst_orbit */
} fst_beads_orbit;

/* The orbit by which the motion from the start passes, within run.periods, stable or not.  FST_NO_CONVERGENCE: there
 * is none, or contacts open and close on it. */
FST_API fst_status fst_beads_orbit_find(const fst_params *beads, int count, const fst_beads_options *options,
                                        fst_beads_orbit *orbit, fst_error *error);
FST_API fst_status fst_beads_orbit_scene(const fst_params *scene, const fst_beads_options *options,
                                         fst_beads_orbit *orbit, fst_error *error);

typedef struct fst_beads_special {
    fst_special_type type;
    double value; /* of the parameter */
    fst_beads_locked at;
} fst_beads_special;

/* Locked states over one parameter. */
typedef struct fst_beads_branch {
    char key[64];
    double from, to;
    size_t point_count;
    double *values;
    fst_beads_locked *points; /* in order along the curve, one for each of the values */
    size_t special_count;
    fst_beads_special *specials;
    fst_branch_end ends[2]; /* before the first point and behind the last */
} fst_beads_branch;

/* Follow the locked state to which the start leads, at the scene's value of the parameter `key` or, where that is not
 * between them, at `from`, both ways through the range or to where a contact opens or closes.  Free the branch with
 * fst_beads_branch_free(). */
FST_API fst_status fst_beads_branch_follow(const fst_params *beads, int count, const fst_beads_options *options,
                                           const char *key, double from, double to, fst_beads_branch *branch,
                                           fst_error *error);
FST_API fst_status fst_beads_branch_scene(const fst_params *scene, const fst_beads_options *options,
                                          const char *key, double from, double to, fst_beads_branch *branch,
                                          fst_error *error);
FST_API void fst_beads_branch_free(fst_beads_branch *branch);

/* One bead in a world in which it needs three dimensions (fst_key_of_world()): a bowl, a medium, no plate, a start above
 * the plate; or in fields that stand still or travel, on a tilted plate, or under a magnet that turns unsteadily. */
typedef struct fst_world_result {
    fst_run_result run; /* numbers that a world does not have are NAN */
    double mean_height; /* as of an fst_bead_result */
    double mean_medium_power;
    double mean_velocity, mean_velocity_error; /* along a wave, as of an fst_bead_result */
    int frame;         /* fst_frame: of the computation and of final_state, turning or laboratory */
    double final_time; /* 1/gamma */
    double final_state[FST_BEAD_NUMBERS], final_lab[FST_BEAD_NUMBERS]; /* on the laboratory's axes */
    double final_lab_si[FST_BEAD_NUMBERS];                             /* m, m/s, 1 and 1/s */
} fst_world_result;
FST_API fst_status fst_world_run(const fst_params *params, const fst_beads_options *options,
                                 fst_world_result *result, fst_error *error);

typedef struct fst_levitation_list {
    fst_levitation *states; /* stable ones first, then by height */
    size_t count;
} fst_levitation_list;

/* Find where a bead floats (plate.shape: none); fst_branch_follow() follows these places over a parameter.  Free the list
 * with fst_levitation_free(). */
FST_API fst_status fst_levitation_find(const fst_params *params, const fst_progress *progress,
                                       fst_levitation_list *list, fst_error *error);
FST_API void fst_levitation_free(fst_levitation_list *list);

/* Of the places on one side of the magnet, above it or where the weight pulls, the first stable one, or else that where a
 * disturbance grows least; NULL: there is none. */
FST_API const fst_levitation *fst_levitation_best(const fst_params *params, const fst_levitation_list *list,
                                                  int above);

/* What becomes of a bead at such a place, or at none. */
#define FST_FLOATINGS(ROW)                                                                                     \
    ROW(FLOATS_NOWHERE, "none", "there is no place", GREY)                                                     \
    ROW(FLOATS_STABLY, "stable", "it stays", TEAL)                                                             \
    ROW(FLOATS_OSCILLATING, "oscillates", "a swing about the place grows", ORANGE)                             \
    ROW(FLOATS_AWAY, "leaves", "it goes away without a swing", VERMILION)
typedef enum { FST_FLOATINGS(FST_ROW_ENUM) FST_FLOATING_COUNT } fst_floating;
FST_API fst_floating fst_levitation_word(const fst_levitation *place);

/* The field of everything that makes one (magnet, parts that stand still, coils, a uniform field, a wave) at a time and
 * a place on the laboratory's axes, z over the magnet's reference plane; scaled.  grad[i][j] = dB_i/dx_j. */
FST_API fst_status fst_field_at(const fst_params *params, double time, const double place[3], double b[3],
                                double grad[3][3], fst_error *error);

/* A motion that repeats itself with the drive's period: a fixed point of the map from one period to the next, which
 * Newton's method finds from the bead's start.  Multipliers: of the directions in which the bead can move. */
typedef struct fst_world_orbit {
    double period; /* 1/gamma */
    int frame;     /* fst_frame: of the state and the map */
    int count;
    double multipliers[FST_BEAD_NUMBERS][2]; /* real and imaginary part, the greatest first */
    int stable;
    double state[FST_BEAD_NUMBERS]; /* at the start of a period */
    double residual;                /* greatest difference of the state after a period */
} fst_world_orbit;
FST_API fst_status fst_world_orbit_find(const fst_params *params, const fst_beads_options *options,
                                        fst_world_orbit *orbit, fst_error *error);

#ifdef __cplusplus
}
#endif

#endif
