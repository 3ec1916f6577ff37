/* switching.c - the first point of the branch that is born at a special point. */
#include "orbit/special.h"

#include <string.h>

#include "base/constants.h"
#include "base/error.h"
#include "observe/marks.h"

#define AWAY 2e-2 /* how far along the critical direction the new branch is first sought */

/* Correct the new branch's guess across the direction along which it leaves. */
static fst_status settle(const fst_family *family, fst_solution *s, fst_direction *way, fst_node *born,
                         fst_error *error)
{
    const double length = sqrt(fst_direction_product(family, s, way, way));
    for (int i = 0; i < FST_SEGMENTS; ++i)
        for (int k = 0; k < FST_STATE_SIZE; ++k)
            way->y[i][k] /= length;
    const fst_solution from = *s;
    fst_status status = FST_NO_CONVERGENCE;
    for (double away = AWAY; away > 1e-4 && status != FST_OK; away *= 0.25) {
        *s = from;
        fst_solution_move(s, way, away);
        status = fst_solution_correct(family, s, way, error);
    }
    return status == FST_OK ? fst_node_make(family, s, born, error) : status;
}

fst_status fst_switch_at_minus_one(const fst_family *family, const fst_node *at, fst_node *born,
                                   fst_error *error)
{
    double v[FST_STATE_SIZE];
    const fst_status status = fst_solution_eigenvector(family, &at->s, -1.0, 0.0, v, NULL, error);
    if (status != FST_OK)
        return status;
    fst_solution s = at->s;
    fst_direction way;
    memset(&way, 0, sizeof way);
    s.segments = 2;
    s.symmetric = 0;
    s.on_section = 0;
    s.period = 2.0 * at->s.period;
    memcpy(s.y[1], at->s.y[0], sizeof s.y[1]);
    memcpy(way.y[0], v, sizeof v);
    for (int k = 0; k < FST_STATE_SIZE; ++k)
        way.y[1][k] = -v[k];
    if (at->s.symmetric) {
        fst_apply_s2(s.y[1], s.y[1]);
        fst_apply_s2(way.y[1], way.y[1]);
    }
    return settle(family, &s, &way, born, error);
}

/* An orbit of four segments that is its own image under S2 is followed as such, by the half map. */
static void prefer_symmetric(const fst_family *family, fst_node *born)
{
    fst_solution s = born->s;
    fst_node half;
    fst_error ignored;
    double image[FST_STATE_SIZE];
    fst_apply_s2(s.y[2], image);
    if (!(fst_state_distance(image, s.y[0]) < 1e-6 * fst_state_distance(s.y[2], s.y[0])))
        return;
    s.symmetric = 1;
    s.segments = 2;
    s.period *= 0.5;
    /* The tangent is found anew, pointing the way the old one did. */
    const fst_direction across = s.tangent;
    if (fst_solution_correct(family, &s, &across, &ignored) == FST_OK &&
        fst_node_make(family, &s, &half, &ignored) == FST_OK)
        *born = half;
}

fst_status fst_switch_at_hopf(const fst_family *family, const fst_node *at, double frequency, fst_node *born,
                              fst_error *error)
{
    int best = -1;
    for (int i = 0; i < at->s.multipliers; ++i)
        if (at->s.im[i] > 1e-9 &&
            (best < 0 || fabs(at->s.im[i] - frequency) < fabs(at->s.im[best] - frequency)))
            best = i;
    if (best < 0)
        return fst_fail(error, FST_NO_CONVERGENCE, "Hopf point", "no complex pair");
    double u[FST_STATE_SIZE], v[FST_STATE_SIZE];
    const fst_status status =
        fst_solution_eigenvector(family, &at->s, at->s.re[best], at->s.im[best], u, v, error);
    if (status != FST_OK)
        return status;
    fst_solution s = at->s;
    fst_direction way;
    memset(&way, 0, sizeof way);
    /* Four segments, a quarter of the period each: y + u cos - v sin.  Beside an unstable equilibrium a longer
     * flow would lose every digit. */
    s.segments = 4;
    s.period = FST_TWO_PI / at->s.im[best];
    for (int i = 1; i < 4; ++i)
        memcpy(s.y[i], at->s.y[0], sizeof s.y[i]);
    for (int k = 0; k < FST_STATE_SIZE; ++k) {
        way.y[0][k] = u[k];
        way.y[1][k] = -v[k];
        way.y[2][k] = -u[k];
        way.y[3][k] = v[k];
    }
    const fst_status found = settle(family, &s, &way, born, error);
    if (found == FST_OK)
        prefer_symmetric(family, born);
    return found;
}

fst_status fst_switch_at_pitchfork(const fst_family *family, const fst_node *at, fst_node *born,
                                   fst_error *error)
{
    fst_solution s = at->s;
    fst_direction way;
    memset(&way, 0, sizeof way);
    const fst_status status = fst_solution_eigenvector(family, &s, 0.0, 0.0, way.y[0], NULL, error);
    return status == FST_OK ? settle(family, &s, &way, born, error) : status;
}
