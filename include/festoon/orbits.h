/* orbits.h - periodic orbits, equilibria, their branches and bifurcations, Lyapunov spectra; festoon.h includes
 * it.
 *
 * Everything here needs LAPACK; FST_UNAVAILABLE where this build or machine has none.  docs/inside/orbits.md explains
 * the methods and criteria.
 */
#ifndef FESTOON_ORBITS_H
#define FESTOON_ORBITS_H

#include <festoon/festoon.h>

#ifdef __cplusplus
extern "C" {
#endif

/* Whether LAPACK is there, so that the functions below can be called. */
FST_API int fst_lapack_present(void);

enum { FST_MULTIPLIER_COUNT = 8, FST_EIGENVALUE_COUNT = 9, FST_LYAPUNOV_TRACE = 64 };

/* Where a start leads. */
typedef enum {
    FST_ORBIT_FOUND,
    FST_ORBIT_LOCKED,    /* no orbit: the bead comes to rest in the turning frame */
    FST_ORBIT_EJECTED,   /* no orbit: it flies away */
    FST_ORBIT_UNSETTLED, /* it settles on no stable orbit in the time that it was given */
    FST_ORBIT_ROLLS,     /* no orbit that attracts: the contact no longer slips, and the start decides */
    FST_ORBIT_SEVERAL /* it settles on an orbit that closes only after several returns, which is not looked for */
} fst_orbit_outcome;

/* A periodic orbit of the turning frame. */
typedef struct fst_orbit {
    fst_orbit_outcome outcome; /* other than FST_ORBIT_FOUND: nothing else is filled in */
    fst_run_result
        means; /* over one whole turn of Phi (of a libration: over one period); `period` is that time */
    fst_symmetry symmetry; /* S1 or S2; none for a libration */
    int turns;             /* turns of Phi in the period: -1 for counter-rotation, 0 for a libration */
    int stable;
    /* Multipliers of the half map composed with S2 for an S2 orbit, otherwise of the full map; the flow
     * direction and |n| are split off. */
    double multiplier_re[FST_MULTIPLIER_COUNT], multiplier_im[FST_MULTIPLIER_COUNT];
    double relaxation_time; /* in which a small disturbance falls by a factor e, from the leading multiplier;
                               NAN: unstable */
    double swing_ratio;   /* the paper's p: r falls twice in a turn; the larger fall over the smaller one, minus
                             1; NAN: it does not fall twice */
    double trivial_error; /* how exactly the flow direction was mapped onto itself */
    double residual;      /* the greatest component of the residual of Newton's equations */
    double state[FST_STATE_SIZE]; /* on Phi = pi/2, passed downward; of a libration where r is greatest */
} fst_orbit;

/* The stable orbit to which start.* leads: integrated until its returns come close to each other, then refined
 * by Newton's method.  The plate's edge is ignored.  FST_NO_CONVERGENCE: there is no such orbit;
 * orbit->outcome says where the bead went, the sentence the details.  `progress` may be NULL. */
FST_API fst_status fst_orbit_find(const fst_params *params, const fst_progress *progress, fst_orbit *orbit,
                                  fst_error *error);

/* The stable orbit beside a guess: another setup's orbit, of which state, means.period, symmetry and turns are
 * used. Newton's method alone, no integration to the orbit: many times quicker than fst_orbit_find() where
 * parameters change little.  `tolerance` is that of the integration, 1e-12 in fst_orbit_find(); the residual is
 * at most ten times it.  FST_NO_CONVERGENCE: Newton's method did not converge, or what it found repels, stands
 * still or turns otherwise than the guess.  `progress` may be NULL. */
FST_API fst_status fst_orbit_near(const fst_params *params, const fst_orbit *guess, double tolerance,
                                  const fst_progress *progress, fst_orbit *orbit, fst_error *error);

/* An equilibrium of the turning frame: the bead goes round with the magnet. */
typedef struct fst_locked {
    double state[FST_STATE_SIZE];
    double r, bead_angle_deg; /* Phi, NAN on the axis */
    double slip;              /* |V| */
    double friction_power;
    double eigenvalue_re[FST_EIGENVALUE_COUNT], eigenvalue_im[FST_EIGENVALUE_COUNT];
    int stable;
    double residual;
    int found; /* the number of starts from which Newton's method came here */
} fst_locked;

/* Why a family of locked states whose contact does not slip ends. */
typedef enum { FST_ROLLING_ENDS(FST_ROW_ENUM) FST_ROLLING_COUNT } fst_rolling_end;
FST_API const char *fst_rolling_end_name(fst_rolling_end end);

typedef struct fst_rolling_lock {
    double state[FST_STATE_SIZE];
    double r, bead_angle_deg; /* Phi, NAN on the axis */
    double use;               /* |f|/(mu_s N); NAN under the law rolling */
    fst_rolling_end end;      /* why the family ends here */
} fst_rolling_lock;

typedef struct fst_rolling_family {
    fst_rolling_lock from, to;
} fst_rolling_family;

typedef struct fst_locked_list {
    fst_locked *states; /* ordered by falling stability, then by r */
    size_t count;
    int starts;    /* of the search */
    int index_sum; /* the sum of the signs of det(-J): the same at every omega, unless a state comes from
                      infinity */
    int truncated; /* there are more states than the list can hold: they form continua */
    fst_rolling_family *families; /* of states that roll, under dry friction */
    size_t family_count;
} fst_locked_list;

/* Find every equilibrium, by Newton's method from many starts.  Free the list with fst_locked_free().
 * `progress` may be NULL. */
FST_API fst_status fst_locked_find(const fst_params *params, const fst_progress *progress,
                                   fst_locked_list *list, fst_error *error);
FST_API void fst_locked_free(fst_locked_list *list);

typedef enum { FST_BRANCH_KINDS(FST_ROW_ENUM) FST_BRANCH_COUNT } fst_branch_kind;
FST_API const char *fst_branch_kind_name(fst_branch_kind kind);
typedef enum { FST_SPECIALS(FST_ROW_ENUM) FST_SPECIAL_COUNT } fst_special_type;
FST_API const char *fst_special_name(fst_special_type type);

/* Numbers of a bead in three dimensions: X Y Z vX vY vZ nX nY nZ WX WY WZ. */
enum { FST_BEAD_NUMBERS = 12 };

/* A place where a bead floats without a plate, at rest in the turning frame. */
enum { FST_LEVITATION_DIRECTIONS = 11 }; /* in which it can move: |n| = 1 */
typedef struct fst_levitation {
    double state[FST_BEAD_NUMBERS]; /* in the turning frame; Z over the magnet's reference plane */
    double position_m[3], w_per_s[3];
    double height_mm;     /* from that plane along the axis, to either side */
    double tilt_deg;      /* of n from the axis */
    double circle_mm;     /* distance of the centre from the axis */
    double gap_mm;        /* between bead and magnet */
    int stable, unstable; /* eigenvalues on the right, and whether there is none */
    int family; /* without a drag on W the spin W.n is conserved, and this is one of a family with all spins: the one
                   without spin */
    double eigenvalue_re[FST_LEVITATION_DIRECTIONS],
        eigenvalue_im[FST_LEVITATION_DIRECTIONS]; /* 1/s, falling */
    double residual;
} fst_levitation;

/* A point of a branch. */
typedef struct fst_branch_point {
    double value;  /* of the parameter */
    double second; /* of the second parameter; NAN where there is none */
    double omega, mean_r, mean_alpha_dot, mean_nz, festoons, period, min_r, bead_angle_deg, slip;
    double relaxation_time, swing_ratio; /* as of an orbit; an equilibrium has only the former */
    fst_symmetry symmetry;
    int stable, turns, branch;
    int multipliers; /* 8 multipliers of an orbit, 9 eigenvalues of an equilibrium */
    double multiplier_re[FST_EIGENVALUE_COUNT], multiplier_im[FST_EIGENVALUE_COUNT];
    double state[FST_STATE_SIZE];
    fst_levitation
        levitation; /* of a place where a bead floats, which has no multipliers above; of a motion with the
                                  drive's period its state alone, and above the nine greatest multipliers */
} fst_branch_point;

typedef struct fst_special {
    fst_special_type type;
    double value, omega;
    int branch;
    int criticality; /* 1 supercritical, -1 subcritical, 0 undecided or meaningless */
    int born;        /* the branch that leaves here, or -1 */
    fst_branch_point at;
} fst_special;

/* Why a branch ends. */
typedef enum { FST_ENDS(FST_ROW_ENUM) FST_END_COUNT } fst_end_type;
FST_API const char *fst_end_name(fst_end_type type);

/* An end of a branch, and why it ends there. */
typedef struct fst_branch_end {
    int branch;
    fst_end_type type;
    int family; /* the branch from which it was born, or -1 */
    int image;  /* the branch of the images of its states under S2: its own number where it is its own image,
                   another branch, or -1: that branch exists but is not listed */
    double value;
    char reason[192]; /* the same for people, with numbers */
} fst_branch_end;

typedef struct fst_branch {
    fst_branch_kind kind;
    char key[64];
    double from, to;
    /* Over two parameters (otherwise second_key is empty) a point is a special point of the type `followed`,
     * and each branch is the curve of one.  `stable` then says whether all directions except the critical one
     * attract. */
    char second_key[64];
    double second_from, second_to;
    fst_special_type followed;
    fst_branch_point *points; /* in order along each branch */
    size_t point_count;
    fst_special *specials;
    size_t special_count;
    fst_branch_end *ends; /* two for each branch */
    size_t end_count;
    int branches;
    int complete;              /* 0: the caller stopped it before its end */
    double half_length, gamma; /* magnet.half_length (m) and friction.gamma (1/s), by which everything here is
                                  scaled; NAN: the file from which it was read does not say */
    fst_params
        *scene; /* of the file from which it was read; NULL: it does not say, or the branch is of no file */
} fst_branch;

typedef struct fst_branch_options {
    uint32_t cookie;
    fst_branch_kind kind;
    const char *key; /* "drive.omega" */
    double from, to;
    double tolerance;    /* of the integration; 1e-12 */
    double longest_step; /* along the curve, scaled; 0.5 */
    int follow;          /* switch branches at pitchforks, period doublings and Hopf points */
    /* A second parameter (NULL: none) and its range.  Special points of the type `special` are sought over
     * `key` at the scene's value of the second parameter, and each is then followed as a curve over both. */
    const char *second_key;
    double second_from, second_to;
    fst_special_type special;
    const fst_progress *progress; /* NULL: nobody is told */
} fst_branch_options;
FST_API fst_branch_options fst_default_branch_options(void);

/* Follow the counter-rotating family (the S2 branch both ways, the S1 branches that leave it, through r = 0 and
 * beyond), or every family of equilibria, or all of these, or the places where a bead
 * floats, or the motion with the drive's period to which the start leads, over a parameter; or the
 * curves of special points over two.  Free the branch with fst_branch_free(), also after FST_INTERRUPTED (from `progress`): it then
 * holds what was found until then. */
FST_API fst_status fst_branch_follow(const fst_params *params, const fst_branch_options *options,
                                     fst_branch *branch, fst_error *error);
FST_API void fst_branch_free(fst_branch *branch);

/* Patterns that close in the laboratory after N festoons. */
typedef struct fst_festoon_list {
    double *omegas; /* rising; each has a stable orbit with N festoons */
    fst_orbit *orbits;
    size_t count;
    double least[2], greatest[2]; /* N on the stable S1 orbits, on the stable S2 orbits; inf, -inf: no such
                                     orbit is stable */
    double from, to;              /* the range of omega of both */
} fst_festoon_list;

/* Find every omega at which a stable counter-rotating pattern has exactly N festoons.  FST_NO_CONVERGENCE:
 * there is none; the sentence says how far the branch reaches.  `progress` may be NULL. */
FST_API fst_status fst_festoons_find(const fst_params *params, double festoons, const fst_progress *progress,
                                     fst_festoon_list *list, fst_error *error);

/* The same on a branch of the kind FST_BRANCH_COUNTER over drive.omega that fst_branch_follow() made from the
 * same parameters; it saves time for many N. */
FST_API fst_status fst_festoons_on(const fst_params *params, const fst_branch *branch, double festoons,
                                   const fst_progress *progress, fst_festoon_list *list, fst_error *error);
FST_API void fst_festoons_free(fst_festoon_list *list);

/* The spectrum of Lyapunov exponents. */
typedef struct fst_lyapunov {
    double
        exponents[FST_EIGENVALUE_COUNT]; /* falling; gamma; -INFINITY: erased by a contact that comes to rest;
                                               of a bead that flew the nine greatest of eleven */
    double errors[FST_EIGENVALUE_COUNT]; /* standard errors, from blocks */
    double error;                        /* the greatest of the errors */
    int converged;      /* every exponent has a sure sign, or is zero within an error below 1e-4 */
    int flow_direction; /* the index of the exponent that belongs to the flow; -1 at an equilibrium */
    double divergence;  /* the mean divergence of the flow, measured independently; it equals the sum of the
                           exponents; NAN where the bead flew, because impacts contract too */
    double time;        /* the time over which they are averaged */
    int trace_count;
    double trace_time[FST_LYAPUNOV_TRACE], trace[FST_LYAPUNOV_TRACE][FST_EIGENVALUE_COUNT]; /* running means */
} fst_lyapunov;

/* From start.*, after run.discard drive periods, over the rest of run.periods.  `progress` may be NULL. */
FST_API fst_status fst_lyapunov_find(const fst_params *params, const fst_progress *progress, fst_lyapunov *out,
                                     fst_error *error);

#ifdef __cplusplus
}
#endif
#endif
