/* disc.c - a magnetic disc that rolls upright at a fixed distance r from the axis (Conclusion of the paper).
 *
 * Its moment turns in the plane of the vertical and of its path, n = cos phi e_alpha + sin phi e_z, and rolling ties it to
 * the place, phi = phi_0 - (r/eps) alpha.  With I = m R^2/2 and psi = alpha - omega t,
 *
 *     (3/2) r^2 alpha'' = kappa eps^2 d(n.B)/d alpha.
 *
 * The part of the field that turns as psi - phi carries the disc with the magnet, alpha' = eps omega/(r + eps) on average,
 * and the greater part, which turns as psi + phi, shakes it.  Taking v = phi + psi for the time leaves u = phi - psi and
 * alpha', whose equations repeat themselves after a turn of v: corotation is a fixed point of a map of the plane.
 */
#include "paper/disc.h"

#include "base/constants.h"

#include <math.h>

const double fst_disc_radii[FST_DISC_PLACES] = {0.77, 1.0};

double fst_disc_acceleration(const fst_disc *disc, double psi, double phi)
{
    const fst_groups groups = fst_model_groups(disc->model);
    const double r = disc->r, c = cos(psi), s = sin(psi);
    double b[3], g[3][3];
    fst_field(disc->model, r * c, r * s, b, g);
    const double along = c * b[1] - s * b[0], out = c * b[0] + s * b[1];
    /* d/d psi: the disc goes r along e_alpha, and e_alpha turns by -e_r */
    const double gradient = s * (s * g[0][0] - c * g[0][1]) - c * (s * g[1][0] - c * g[1][1]);
    const double along_rate = r * gradient - out, up_rate = r * (c * g[2][1] - s * g[2][0]);
    const double slope =
        along_rate * cos(phi) + up_rate * sin(phi) + r / groups.eps * (along * sin(phi) - b[2] * cos(phi));
    return groups.kappa * groups.eps * groups.eps * slope / (1.5 * r * r);
}

/* How u and alpha' change with v. */
static void rates(const fst_disc *disc, double v, const double y[2], double rate[2])
{
    const double rolls = disc->r / fst_model_groups(disc->model).eps;
    const double v_rate = (1.0 - rolls) * y[1] - disc->omega;
    rate[0] = (disc->omega - (1.0 + rolls) * y[1]) / v_rate;
    rate[1] = fst_disc_acceleration(disc, 0.5 * (v - y[0]), 0.5 * (v + y[0])) / v_rate;
}

/* From v = 0 to the next turn of v, which goes down, by the method of Runge and Kutta. */
static void turn(const fst_disc *disc, double y[2])
{
    enum { STEPS = 400 };
    const double h = -2.0 * FST_PI / STEPS;
    for (int i = 0; i < STEPS; ++i) {
        static const double at[4] = {0.0, 0.5, 0.5, 1.0}, weight[4] = {1.0 / 6, 1.0 / 3, 1.0 / 3, 1.0 / 6};
        double k[4][2], sum[2] = {0.0, 0.0};
        for (int stage = 0; stage < 4; ++stage) {
            double here[2];
            for (int m = 0; m < 2; ++m)
                here[m] = y[m] + (stage ? at[stage] * h * k[stage - 1][m] : 0.0);
            rates(disc, (i + at[stage]) * h, here, k[stage]);
            for (int m = 0; m < 2; ++m)
                sum[m] += weight[stage] * k[stage][m];
        }
        for (int m = 0; m < 2; ++m)
            y[m] += h * sum[m];
    }
}

int fst_disc_find(const fst_disc *disc, fst_disc_orbit *orbit)
{
    enum { MOST = 30 };
    double y[2] = {orbit->u, orbit->rate}, step = INFINITY;
    for (int i = 0; i < MOST && step > 1e-9; ++i) {
        const double d = 1e-5;
        double to[2] = {y[0], y[1]}, map[2][2];
        turn(disc, to);
        for (int m = 0; m < 2; ++m) {
            double up[2] = {y[0], y[1]}, down[2] = {y[0], y[1]};
            up[m] += d;
            down[m] -= d;
            turn(disc, up);
            turn(disc, down);
            map[0][m] = (up[0] - down[0]) / (2.0 * d);
            map[1][m] = (up[1] - down[1]) / (2.0 * d);
        }
        const double det = (map[0][0] - 1.0) * (map[1][1] - 1.0) - map[0][1] * map[1][0];
        const double off[2] = {y[0] - to[0], y[1] - to[1]};
        const double by[2] = {((map[1][1] - 1.0) * off[0] - map[0][1] * off[1]) / det,
                              ((map[0][0] - 1.0) * off[1] - map[1][0] * off[0]) / det};
        step = hypot(by[0], by[1]);
        const double part = fmin(1.0, 0.3 / step);
        for (int m = 0; m < 2; ++m)
            y[m] += part * by[m];
        *orbit = (fst_disc_orbit){y[0], y[1], map[0][0] + map[1][1]};
    }
    return step <= 1e-9;
}

double fst_disc_least_drive(const fst_model *model, double r, double from, fst_disc_orbit *orbit)
{
    const double eps = fst_model_groups(model).eps, down = 0.05;
    fst_disc disc = {model, r, from};
    fst_disc_orbit now = {1.4, eps * from / (r + eps), 0.0}, last;
    if (!fst_disc_find(&disc, &now) || !(fabs(now.trace) < 2.0))
        return NAN;
    do {
        last = now;
        disc.omega -= down;
    } while (disc.omega > down && fst_disc_find(&disc, &now) && now.trace > -2.0);
    double low = disc.omega, high = disc.omega + down;
    for (int i = 0; i < 20; ++i) { /* it doubles its period there */
        disc.omega = 0.5 * (low + high);
        now = last;
        if (fst_disc_find(&disc, &now) && now.trace > -2.0) {
            high = disc.omega;
            last = now;
        } else {
            low = disc.omega;
        }
    }
    if (orbit)
        *orbit = last;
    return high;
}
