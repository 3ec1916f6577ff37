/* charged_surfaces.h - B, G and T of a uniformly magnetised cylinder by quadrature in long double: the charge
 * J.n on its surface, each piece with the field of a point charge.  Exact to rounding some way off the surface.
 */
#ifndef FST_TESTS_CHARGED_SURFACES_H
#define FST_TESTS_CHARGED_SURFACES_H

#include <math.h>
#include <string.h>

/* B; xx yy xy xz yz of G; xxx xxy xyy yyy xxz xyz yyz of T. */
enum { FIELD_B = 0, FIELD_G = 3, FIELD_T = 8, FIELD_NUMBERS = 15 };

#define SURFACE_PI 3.14159265358979323846264338327950288L
enum { SURFACE_NODES = 48, SURFACE_ANGLES = 240 };

/* Nodes and weights of Gauss and Legendre on [-1, 1], by Newton's method. */
static inline void gauss_legendre(int count, long double *node, long double *weight)
{
    for (int i = 0; i < count; ++i) {
        long double x = cosl(SURFACE_PI * (i + 0.75L) / (count + 0.5L)), slope = 0;
        for (int again = 0; again < 8; ++again) {
            long double before = 1, p = x;
            for (int k = 2; k <= count; ++k) {
                const long double next = ((2 * k - 1) * x * p - (k - 1) * before) / k;
                before = p;
                p = next;
            }
            slope = count * (x * p - before) / (x * x - 1);
            x -= p / slope;
        }
        node[i] = x;
        weight[i] = 2 / ((1 - x * x) * slope * slope);
    }
}

static inline void add_charge_at(long double charge, const long double place[3], const long double from[3],
                                 long double *sum)
{
    const long double x = place[0] - from[0], y = place[1] - from[1], z = place[2] - from[2];
    const long double r2 = x * x + y * y + z * z, q3 = charge / (r2 * sqrtl(r2)), q5 = 3 * q3 / r2,
                      q7 = 5 * q5 / r2;
    const long double field[FIELD_NUMBERS] = {x * q3,
                                              y * q3,
                                              z * q3,
                                              q3 - x * x * q5,
                                              q3 - y * y * q5,
                                              -x * y * q5,
                                              -x * z * q5,
                                              -y * z * q5,
                                              x * x * x * q7 - 3 * x * q5,
                                              x * x * y * q7 - y * q5,
                                              x * y * y * q7 - x * q5,
                                              y * y * y * q7 - 3 * y * q5,
                                              x * x * z * q7 - z * q5,
                                              x * y * z * q7,
                                              y * y * z * q7 - z * q5};
    for (int i = 0; i < FIELD_NUMBERS; ++i)
        sum[i] += field[i];
}

/* Of radius R and half height h, at a place from its centre. */
static inline void charged_cylinder(long double radius, long double half, const double j[3],
                                    const long double place[3], long double *sum)
{
    long double node[SURFACE_NODES], weight[SURFACE_NODES];
    gauss_legendre(SURFACE_NODES, node, weight);
    memset(sum, 0, FIELD_NUMBERS * sizeof *sum);
    for (int n = 0; n < SURFACE_ANGLES; ++n) {
        const long double angle = 2 * SURFACE_PI * (n + 0.5L) / SURFACE_ANGLES, c = cosl(angle),
                          s = sinl(angle);
        const long double shell = (j[0] * c + j[1] * s) * radius * half / (2 * SURFACE_ANGLES);
        for (int i = 0; i < SURFACE_NODES; ++i) {
            const long double r = radius * (1 + node[i]) / 2;
            const long double disc = j[2] * r * radius * weight[i] / (4 * SURFACE_ANGLES);
            const long double on_shell[3] = {radius * c, radius * s, half * node[i]};
            const long double on_top[3] = {r * c, r * s, half}, on_bottom[3] = {r * c, r * s, -half};
            add_charge_at(shell * weight[i], place, on_shell, sum);
            add_charge_at(disc, place, on_top, sum);
            add_charge_at(-disc, place, on_bottom, sum);
        }
    }
}

#endif
