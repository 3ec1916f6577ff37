/* near.c - the orbit of one setup from that of a neighbouring one, for work that asks for many orbits of setups
 * that differ little. */
#include "orbit/describe.h"

#include <string.h>

#include "base/error.h"
#include "study/conclude.h"

/* The guess as a chain: of an orbit that turns the first state lies on X = 0. */
static void begin_chain(const fst_orbit *guess, fst_solution *s)
{
    memset(s, 0, sizeof *s);
    s->symmetric = guess->symmetry == FST_SYMMETRY_S2;
    s->on_section = guess->turns != 0 && guess->state[FST_X] == 0.0; /* else the bead flies over it */
    s->period = s->symmetric ? 0.5 * guess->means.period : guess->means.period;
    memcpy(s->y[0], guess->state, sizeof s->y[0]);
    double *n = s->y[0] + FST_NX;
    const double norm = sqrt(n[0] * n[0] + n[1] * n[1] + n[2] * n[2]);
    for (int i = 0; i < 3; ++i)
        n[i] /= norm;
}

static fst_status not_there(const fst_params *params, const char *what, fst_error *error)
{
    return fst_fail(error, FST_NO_CONVERGENCE, "orbit",
                    "what lies beside the guess at a drive of %.10g Hz %s. Try fst_orbit_find()",
                    params->drive_frequency, what);
}

fst_status fst_orbit_near(const fst_params *params, const fst_orbit *guess, double tolerance,
                          const fst_progress *progress, fst_orbit *orbit, fst_error *error)
{
    fst_family family;
    fst_solution s;
    fst_watch watch;
    fst_description d;
    memset(orbit, 0, sizeof *orbit);
    fst_result_clear(&orbit->means);
    orbit->outcome = FST_ORBIT_UNSETTLED;
    if (guess->outcome != FST_ORBIT_FOUND || !(guess->means.period > 0.0))
        return fst_fail(error, FST_BAD_INPUT, "fst_orbit_near", "the guess is not an orbit");
    if (!(tolerance >= 1e-14 && tolerance <= 1e-6))
        return fst_fail(error, FST_BAD_INPUT, "fst_orbit_near", "the tolerance must lie from 1e-14 to 1e-6");
    fst_watch_begin(&watch, progress);
    fst_status status = fst_family_begin(&family, params, NULL, error);
    if (status != FST_OK)
        return status;
    family.watch = &watch;
    family.tolerance = tolerance;
    family.residual = fmax(family.residual, 10.0 * tolerance);
    begin_chain(guess, &s);
    status = fst_solution_chain(&family, &s, s.symmetric ? 1 : 2, error);
    if (status == FST_OK)
        status = fst_solution_correct(&family, &s, NULL, error);
    if (status == FST_OK)
        status = fst_solution_spectrum(&family, &s, error);
    if (status == FST_OK && !fst_solution_moves(&family, &s))
        status = not_there(params, "stands still in the turning frame", error);
    if (status == FST_OK && !fst_solution_is_stable(&s))
        status = not_there(params, "repels", error);
    if (status == FST_OK)
        status = fst_describe_orbit(&family, &s, 1, &d, error);
    if (status == FST_OK && d.turns != guess->turns)
        status = not_there(params, "turns otherwise", error);
    if (status != FST_OK)
        return status;
    fst_orbit_fill(&d, &s, orbit);
    orbit->outcome = FST_ORBIT_FOUND;
    return FST_OK;
}
