/* charge_field.c - the field of fitted charges, the covariance of its errors, and charges drawn by that covariance. */
#include "model/charges.h"

#include <math.h>
#include <stdlib.h>

#include "base/chance.h"
#include "base/constants.h"
#include "model/cholesky.h"

/* A number of the normal distribution, by Box and Muller. */
static double draw_normal(uint64_t *state)
{
    const double parts = 1.0 / 9007199254740992.0; /* 2^-53 */
    const double u = ((double)(fst_draw(state) >> 11) + 0.5) * parts,
                 v = (double)(fst_draw(state) >> 11) * parts;
    return sqrt(-2.0 * log(u)) * cos(FST_TWO_PI * v);
}

void fst_charges_draw(const fst_charges *charges, uint64_t seed, double *strength)
{
    const int n = charge_columns(&charges->sites), all = CHARGE_CLASSES * n;
    double turn[3];
    for (int j = 0; j < 3; ++j)
        turn[j] = draw_normal(&seed);
    for (int i = 0; i < all; ++i)
        strength[i] = draw_normal(&seed);
    for (int c = 0; c < CHARGE_CLASSES; ++c) /* R^-1 z has the covariance (R'R)^-1 */
        solve_upper(n, charges->factor[c], &strength[c * n]);
    for (int i = 0; i < all; ++i) {
        for (int j = 0; j < 3 && charges->turning; ++j)
            strength[i] += turn[j] * charges->turning[j * all + i];
        strength[i] = charges->strength[i] + charges->fit.noise * strength[i];
    }
}

double *fst_charges_room(const fst_charges *charges)
{
    return calloc((size_t)(CHARGE_CLASSES * CHARGE_VALUES * charge_columns(&charges->sites)), sizeof(double));
}

void fst_charges_look(const fst_charges *charges, const double place[3], int values, double *room, double *out,
                      double *covariance)
{
    const int n = charge_columns(&charges->sites);
    const double noise = charges->fit.noise;
    double with_angles[3][CHARGE_VALUES] = {{0}};
    charge_rows(&charges->sites, place, values, room);
    for (int v = 0; v < values; ++v)
        out[v] = 0.0;
    for (int c = 0; c < CHARGE_CLASSES; ++c) {
        double *rows = &room[c * CHARGE_VALUES * n];
        for (int v = 0; v < values; ++v) {
            if (charges->sites.offset)
                rows[v * n + n - 1] = 0.0; /* the probe's, and not the field's */
            out[v] += dot(n, &rows[v * n], &charges->strength[c * n]);
            for (int j = 0; j < 3 && charges->turning; ++j)
                with_angles[j][v] +=
                    noise * dot(n, &rows[v * n], &charges->turning[(j * CHARGE_CLASSES + c) * n]);
        }
        if (covariance)
            solve_lower(n, charges->factor[c], rows, values, 0);
        for (int i = 0; i < values * values && covariance; ++i)
            covariance[i] = (c ? covariance[i] : 0.0) +
                            noise * noise * dot(n, &rows[i / values * n], &rows[i % values * n]);
    }
    for (int i = 0; i < values * values && covariance; ++i)
        for (int j = 0; j < 3; ++j)
            covariance[i] += with_angles[j][i / values] * with_angles[j][i % values];
}
