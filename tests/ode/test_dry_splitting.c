/* Dry friction by a method that knows neither modes nor events: its means, extrapolated to steps of no length,
 * agree with those of runs.  They share the magnet's pull and nothing else.
 *
 * A step of length h is half a drift (x moves with v, n turns about W, the axes turn with the magnet), a kick
 * at a place that stays, and half a drift.  In the kick the slip V obeys V' = A - c V/|V| with a constant push
 * A and c = (7/2) mu N.  Measured in sigma, dt = |V| dsigma, this is linear for the pair (|V|, V): along A
 *
 *     |V| + V_A = 2 ahead e^(-(c - |A|) sigma),  |V| - V_A = 2 against e^(-(c + |A|) sigma)
 *
 * and across A V decays as e^(-c sigma), so that a step goes through captures and releases in closed form.  Its
 * error is of order h^2.
 * tests: ode/contact.c
 * labels: numbers */
#include "physics.h"

#include "model/model.h"

/* ------------------------------------------------------------------ a kick */

/* The integral of e^(-rate x) from 0 to sigma. */
static double decayed(double rate, double sigma)
{
    return rate == 0.0 ? sigma : -expm1(-rate * sigma) / rate;
}

/* The slip after the time h. */
static void slip_on(const double push[2], double c, double h, double slip[2])
{
    const double a = hypot(push[0], push[1]), s = hypot(slip[0], slip[1]);
    const double p[2] = {a > 0.0 ? push[0] / a : 1.0, a > 0.0 ? push[1] / a : 0.0};
    const double along = slip[0] * p[0] + slip[1] * p[1], across = p[0] * slip[1] - p[1] * slip[0];
    const double greater = s + fabs(along), lesser = greater > 0.0 ? across * across / greater : 0.0;
    const double slow = c - a, fast = c + a, against = 0.5 * (along >= 0.0 ? lesser : greater);
    const double ahead = fmax(0.5 * (along >= 0.0 ? greater : lesser), 1e-40); /* a slip that is let go grows */
    if (slow > 0.0 && ahead / slow + against / fast <= h) {
        slip[0] = slip[1] = 0.0;
        return;
    }
    double least = 0.0, most = 1.0, sigma = 0.0;
    while (ahead * decayed(slow, most) + against * decayed(fast, most) < h)
        most *= 2.0;
    for (int i = 0; i < 200; ++i) { /* Newton's steps, within bounds that close in */
        const double missing = h - ahead * decayed(slow, sigma) - against * decayed(fast, sigma);
        const double speed = ahead * exp(-slow * sigma) + against * exp(-fast * sigma);
        *(missing > 0.0 ? &least : &most) = sigma;
        const double next = sigma + missing / speed;
        if (fabs(missing) <= 1e-15 * h)
            break;
        sigma = next > least && next < most ? next : 0.5 * (least + most);
    }
    const double end = ahead * exp(-slow * sigma) - against * exp(-fast * sigma);
    const double aside = across * exp(-c * sigma);
    slip[0] = end * p[0] - aside * p[1];
    slip[1] = end * p[1] + aside * p[0];
}

/* Force, torque and friction act for the time h.  Returns the power of the drive. */
static double kick(const fst_world_double *c, double mu, double h, double *y)
{
    double *v = y + FST_VX, *w = y + FST_WX, twist[3];
    const double lever = 2.5 / c->eps;
    fst_pull_double p;
    fst_pull_at_double(c, y, c->height, &p);
    cross(y + FST_NX, p.b, twist);
    const double free[2] = {p.force[0] - lever * p.strength * twist[1],
                            p.force[1] + lever * p.strength * twist[0]};
    double slip[2] = {v[0] - c->eps * w[1], v[1] + c->eps * w[0]};
    const double unbraked[2] = {slip[0] + h * free[0], slip[1] + h * free[1]};
    slip_on(free, 3.5 * mu * (c->gravity - p.force[2]), h, slip);
    const double impulse[2] = {(unbraked[0] - slip[0]) / 3.5, (unbraked[1] - slip[1]) / 3.5};
    for (int i = 0; i < 2; ++i)
        v[i] += h * p.force[i] - impulse[i];
    for (int i = 0; i < 3; ++i)
        w[i] += h * lever / c->eps * p.strength * twist[i];
    w[0] -= lever * impulse[1];
    w[1] += lever * impulse[0];
    return c->omega * (p.strength * twist[2] + y[FST_X] * p.force[1] - y[FST_Y] * p.force[0]);
}

static void drift(double omega, double h, double *y)
{
    const double *w = y + FST_WX, rate = sqrt(dot(w, w));
    y[FST_X] += h * y[FST_VX];
    y[FST_Y] += h * y[FST_VY];
    if (rate > 0.0) {
        const double axis[3] = {w[0] / rate, w[1] / rate, w[2] / rate};
        double n[3];
        turn_about(axis, h * rate, y + FST_NX, n);
        memcpy(y + FST_NX, n, sizeof n);
    }
    turn_state(y, -omega * h, y);
}

/* ------------------------------------------------------------------ means */

enum { R, ALPHA_DOT, NZ, DRIVE_POWER, MEANS };
static const char *const NAMES[MEANS] = {"mean_r", "mean_alpha_dot", "mean_nz", "mean_drive_power"};

/* Over a window whose weights vanish at its ends, where it may begin and end anywhere: over n repetitions of a
 * motion that errs by some (2 pi n)^-5. */
static void means_by_steps(const fst_world_double *c, double mu, const double *start, double step,
                           double mean[MEANS])
{
    enum { DISCARD = 50, WINDOW = 60 };
    const double period = TWO_PI / c->omega;
    const long per_period = (long)ceil(period / step), count = (DISCARD + WINDOW) * per_period;
    const double h = period / (double)per_period;
    double y[FST_STATE_SIZE], weights = 0.0;
    memcpy(y, start, sizeof y);
    memset(mean, 0, MEANS * sizeof *mean);
    drift(c->omega, 0.5 * h, y);
    for (long i = 0; i < count; ++i) {
        const double before[2] = {y[FST_VX], y[FST_VY]}, power = kick(c, mu, h, y);
        const double x = ((double)i + 0.5) / (double)per_period / WINDOW - (double)DISCARD / WINDOW;
        const double weight = x > 0.0 ? pow(x * (1.0 - x), 4) : 0.0, r = hypot(y[FST_X], y[FST_Y]);
        const double v[2] = {0.5 * (before[0] + y[FST_VX]), 0.5 * (before[1] + y[FST_VY])};
        weights += weight;
        mean[R] += weight * r;
        mean[ALPHA_DOT] += weight * (y[FST_X] * v[1] - y[FST_Y] * v[0]) / (r * r);
        mean[NZ] += weight * y[FST_NZ];
        mean[DRIVE_POWER] += weight * power;
        drift(c->omega, h, y);
    }
    for (int i = 0; i < MEANS; ++i)
        mean[i] /= weights;
}

/* Periodic motions with captures and without. */
static void test_means_agree(void **unused)
{
    (void)unused;
    static const double motions[][2] = {{0.1, 14.0}, {0.2, 10.7}, {0.3, 26.0}}; /* mu, Hz */
    for (size_t k = 0; k < sizeof motions / sizeof *motions; ++k) {
        fst_params p = fst_default_params();
        p.friction_law = FST_FRICTION_COULOMB;
        p.friction_mu = motions[k][0];
        p.drive_frequency = motions[k][1];
        p.run_rtol = 1e-12;
        p.run_periods = 250.0;
        p.run_discard = 120.0;
        const fst_run_result run = run_of(&p);
        const double exact[MEANS] = {run.mean_r, run.mean_alpha_dot, run.mean_nz, run.mean_drive_power};
        double coarse[MEANS], fine[MEANS];
        fst_model *model = model_of(&p);
        means_by_steps(&model->world, p.friction_mu, run.final_state, 0.004, coarse);
        means_by_steps(&model->world, p.friction_mu, run.final_state, 0.002, fine);
        fst_model_free(model);
        for (int i = 0; i < MEANS; ++i) {
            const double off = (4.0 * fine[i] - coarse[i]) / 3.0 - exact[i];
            print_message("mu %g, %g Hz: %s off by %.1e, extrapolated by %.1e\n", p.friction_mu,
                          p.drive_frequency, NAMES[i], fine[i] - exact[i], off);
            CHECK_CLOSE(off, 0.0, 3e-8);
        }
        CHECK_CLOSE(log2((coarse[R] - exact[R]) / (fine[R] - exact[R])), 2.0, 0.1);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(test_means_agree)};
    return cmocka_run_group_tests_name("dry_splitting", tests, NULL, NULL);
}
