/* A magnetic disc that rolls at a fixed distance from the axis, in time, from its magnetic energy alone: it stays on the
 * corotation that was found where that is called stable, and leaves it where not.
 * tests: paper/disc.c */
#include <math.h>

#include "base/constants.h"
#include "physics.h"

#include "paper/disc.h"

typedef struct wheel {
    fst_disc disc;
    double eps, kappa, phi_0;
} wheel;

/* n.B of the disc at the angle alpha of the laboratory at time t. */
static double energy(const wheel *w, double alpha, double t)
{
    const double psi = alpha - w->disc.omega * t, phi = w->phi_0 - w->disc.r / w->eps * alpha;
    double b[3], g[3][3];
    fst_field(w->disc.model, w->disc.r * cos(psi), w->disc.r * sin(psi), b, g);
    return cos(phi) * (cos(psi) * b[1] - sin(psi) * b[0]) + sin(phi) * b[2];
}

static double acceleration(const wheel *w, double alpha, double t)
{
    const double d = 1e-3, r = w->disc.r;
    const double slope = (8.0 * (energy(w, alpha + d, t) - energy(w, alpha - d, t)) -
                          (energy(w, alpha + 2 * d, t) - energy(w, alpha - 2 * d, t))) /
                         (12.0 * d);
    return w->kappa * w->eps * w->eps * slope / (1.5 * r * r);
}

/* How far the disc is from even corotation after so many turns of the magnet. */
static double lag_after(const wheel *w, const fst_disc_orbit *orbit, int turns)
{
    const int steps = 800;
    const double h = 2.0 * FST_PI / w->disc.omega / steps;
    const double even = w->eps * w->disc.omega / (w->disc.r + w->eps);
    double alpha = -0.5 * orbit->u, rate = orbit->rate;
    for (int i = 0; i < turns * steps; ++i) { /* Störmer and Verlet, in the form of velocities */
        const double half = rate + 0.5 * h * acceleration(w, alpha, i * h);
        alpha += h * half;
        rate = half + 0.5 * h * acceleration(w, alpha, (i + 1) * h);
    }
    return alpha + 0.5 * orbit->u - even * turns * steps * h;
}

static void test_disc(void **unused)
{
    (void)unused;
    static const double radii[] = {0.77, 1.0},
                        drives[] = {1.0904, 1.4629}; /* by another program, solve_ivp of SciPy */
    const fst_params params = fst_default_params();
    fst_model *model;
    fst_error error;
    assert_int_equal(fst_model_new(&params, &model, &error), FST_OK);
    const fst_groups groups = fst_model_groups(model);
    for (int i = 0; i < 2; ++i) {
        fst_disc_orbit orbit;
        const double least = fst_disc_least_drive(model, radii[i], 2.4, &orbit);
        CHECK_CLOSE(least, drives[i], 2e-4);
        for (int above = 0; above < 2; ++above) {
            wheel w = {{model, radii[i], least * (above ? 1.03 : 0.9)}, groups.eps, groups.kappa, 0.0};
            fst_disc_orbit at = orbit;
            assert_true(fst_disc_find(&w.disc, &at));
            assert_true((fabs(at.trace) < 2.0) == above);
            w.phi_0 = 0.5 * at.u - radii[i] / groups.eps * 0.5 * at.u;
            CHECK_CLOSE(fst_disc_acceleration(&w.disc, -0.5 * at.u, 0.5 * at.u),
                        acceleration(&w, -0.5 * at.u, 0.0), 1e-9);
            at.rate *= 1.0 + 1e-4;
            const double lag = fabs(lag_after(&w, &at, 60));
            assert_true(above ? lag < 0.1 : lag > 0.3);
        }
    }
    assert_true(isnan(fst_disc_least_drive(model, 1.0, 0.5, NULL)));
    fst_model_free(model);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(test_disc)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
