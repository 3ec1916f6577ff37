/* Error bars of Lyapunov exponents cover the exact values: a hundred regular motions whose exponents are known.
 * tests: study/growth.c orbit/lyapunov.c
 * labels: long slow */
#include "exponent_states.h"

enum { STATES = 100, MOST_SCENES = 200 };

typedef struct found {
    coverage spectrum, across;
    int orbits, locked, converged;
} found;

/* Prints each exact value that its error bar does not cover. */
static void take(coverage *c, const fst_params *params, double value, double error, double truth)
{
    cover(c, value, error, truth);
    if (fabs(value - truth) > error)
        print_message(
            "omega %.6g, kappa %.6g, %s: %.9g +- %.2g for %.9g\n", params->drive_omega, params->model_kappa,
            params->model_dynamics == FST_DYNAMICS_RIGID ? "rigid" : "farago2020", value, error, truth);
}

static void look_at(const fst_params *params, const known_exponents *known, found *f)
{
    fst_lyapunov l;
    fst_error error = {FST_OK, "", ""};
    if (fst_lyapunov_find(params, NULL, &l, &error) != FST_OK)
        fail_msg("%s", error.sentence);
    for (int i = 0; i < known->count; ++i)
        take(&f->spectrum, params, l.exponents[i], l.errors[i], known->exponents[i]);
    f->converged += l.converged;
    f->orbits += known->is_orbit;
    f->locked += !known->is_orbit;
    if (!known->is_orbit)
        return;
    const fst_exponent across = exponent_across_flow(params, known->state);
    take(&f->across, params, across.value, across.standard_error, known->across_flow);
}

static void tell(const char *what, const coverage *c)
{
    print_message("%s: %d exponents, %.1f %% within one error, %.1f %% within three, at most %.2f errors off\n",
                  what, c->all, 100.0 * c->within_one / c->all, 100.0 * c->within_three / c->all, c->greatest);
}

static void errors_cover(void **state)
{
    (void)state;
    found f;
    memset(&f, 0, sizeof f);
    for (int i = 0; i < MOST_SCENES && f.orbits + f.locked < STATES; ++i) {
        const fst_params params = exponent_scene(i);
        known_exponents known;
        if (exponents_known(&params, &known))
            look_at(&params, &known, &f);
    }
    print_message("%d orbits, %d locked states; every sign decided in %d\n", f.orbits, f.locked, f.converged);
    tell("spectrum", &f.spectrum);
    tell("across the flow", &f.across);
    assert_int_equal(f.orbits + f.locked, STATES);
    assert_true(f.spectrum.within_one >= 0.68 * f.spectrum.all);
    assert_true(f.spectrum.within_three >= 0.99 * f.spectrum.all);
    assert_true(f.across.within_one >= 0.68 * f.across.all);
    assert_true(f.across.within_three >= 0.99 * f.across.all);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(errors_cover)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
