/* describe.h - what an orbit looks like: one turn of it, with the integrals and extremes of a run. */
#ifndef FST_ORBIT_DESCRIBE_H
#define FST_ORBIT_DESCRIBE_H

#include "orbit/solution.h"

typedef struct fst_description {
    fst_run_result means; /* over one whole turn, or one period of a libration */
    int turns;            /* of Phi in the whole orbit: -1 counter-rotating, 0 librating */
    double closest;       /* least distance from the axis, negative where the axis lies on the right: it changes
                           * sign where the orbit passes through r = 0 */
    int has_section;      /* the orbit passes Phi = pi/2 downward ... */
    double section[FST_STATE_SIZE]; /* ... here */
    double swing_ratio;             /* of the two falls of r, minus 1; NAN: there are not two */
    double least_load;              /* least normal load per mass */
    int captures;                   /* slips that come to rest in a period, under a law with modes, */
    int flights;                    /* and how often the bead leaves the plate */
    double shortest; /* of its slips, rests and flights that begin and end on the way; INFINITY: none does */
} fst_description;

/* Follow a corrected orbit once round.  `extremes`: locate them too. */
fst_status fst_describe_orbit(const fst_family *family, const fst_solution *s, int extremes,
                              fst_description *out, fst_error *error);

/* The period of the whole orbit. */
static inline double fst_whole_period(const fst_solution *s)
{
    return s->symmetric ? 2.0 * s->period : s->period;
}

/* Fill in the public description of a corrected orbit with its spectrum. */
void fst_orbit_fill(const fst_description *d, const fst_solution *at, fst_orbit *orbit);

/* The same of any solution, which is not described yet; the state is moved to the section Phi = pi/2 where the
 * orbit passes it. */
fst_status fst_orbit_from_solution(const fst_family *family, const fst_solution *s, fst_orbit *orbit,
                                   fst_error *error);

#endif
