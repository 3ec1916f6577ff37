/* What water does to the paper's bead of steel-like density: rates by Stokes, buoyancy, added mass; rates that are given.
 * tests: model/medium.c model/worlds.c */
#include <stdio.h>

#include <festoon/beads.h>

#include "keys.h"

#include "model/medium.h"

static fst_medium medium_of(const fst_params *p)
{
    fst_model *model;
    assert_int_equal(fst_field_model_new(p, NAN, &model, NULL), FST_OK);
    const fst_groups g = fst_model_groups(model);
    const fst_medium m = fst_medium_of(p, &g);
    fst_model_free(model);
    return m;
}

static void test_rates(void **unused)
{
    (void)unused;
    static const double betas[] = {0.4, 2.0 / 3.0};
    for (int i = 0; i < 2; ++i) {
        fst_params p = fst_default_params();
        p.bead_inertia = betas[i];
        p.medium_density = 1000;
        p.medium_viscosity = 1e-3;
        p.medium_drag_coefficient = 0.44;
        const double radius = p.bead_radius, gamma = p.friction_gamma;
        const double density = p.bead_mass / (2 * TWO_PI / 3 * radius * radius * radius);
        const fst_medium m = medium_of(&p);
        CHECK_CLOSE(m.displaced, 1000 / density, 1e-14);
        CHECK_CLOSE(m.added, 500 / density, 1e-14);
        CHECK_CLOSE(m.drag * gamma, 4.5e-3 / (density * radius * radius), 1e-13);
        CHECK_CLOSE(m.spin_drag * gamma, 6e-3 / (betas[i] * density * radius * radius), 1e-13);
        CHECK_CLOSE(m.fast_drag, 0.375 * 0.44 * 1000 / (density * radius) * p.magnet_half_length, 1e-13);
        CHECK_CLOSE(m.drag / m.spin_drag, 0.75 * betas[i], 1e-14); /* 0.3 of a solid sphere, in air too */
        p = fst_default_params();
        p.medium_drag_rate = 3;
        p.medium_spin_drag_rate = 5;
        const fst_medium given = medium_of(&p);
        CHECK_CLOSE(given.drag * gamma, 3, 1e-14);
        CHECK_CLOSE(given.spin_drag * gamma, 5, 1e-14);
    }
}

/* Down a plane tilted by b a bead without a magnet rolls with g sin b/(M + beta) while tan b < (1/M + 1/beta) mu, and
 * beyond slides with (g sin b - mu g cos b)/M; dry friction, and M of the medium. */
static void test_dry_incline(void **unused)
{
    (void)unused;
    static const struct {
        double tilt, density, beta;
        int rolls;
    } cases[] = {{19.0, 0, 0.4, 1},       {19.6, 0, 0.4, 0},    {13.8, 0, 2.0 / 3.0, 1},
                 {14.3, 0, 2.0 / 3.0, 0}, {16.0, 2000, 0.4, 1}, {23.0, 2000, 0.4, 0}};
    for (size_t i = 0; i < sizeof cases / sizeof *cases; ++i) {
        fst_params p = fst_default_params();
        const fst_beads_options options = fst_default_beads_options();
        fst_world_result run;
        fst_error error = {FST_OK, "", ""};
        char text[40];
        (void)snprintf(text, sizeof text, "%.17g", cases[i].tilt);
        set(&p, "plate.tilt", text);
        set(&p, "friction.law", "coulomb");
        set(&p, "friction.mu", "0.1");
        set(&p, "model.kappa", "0");
        set(&p, "start.spin", "rest");
        set(&p, "start.position[0]", "0");
        set(&p, "start.position[1]", "0");
        set(&p, "start.position[2]", "2.5 mm");
        set(&p, "run.duration", "0.1");
        set(&p, "plate.radius", "10 m");
        p.bead_inertia = cases[i].beta;
        if (cases[i].density > 0)
            p.medium_density = cases[i].density;
        if (fst_world_run(&p, &options, &run, &error) != FST_OK)
            fail_msg("%s", error.sentence);
        const fst_medium m = cases[i].density > 0 ? medium_of(&p) : (fst_medium){0, 0, 0, 0, 0};
        const double moved = 1 + m.added, weight = p.plate_gravity * (1 - m.displaced);
        const double b = cases[i].tilt / DEGREES;
        assert_int_equal(cases[i].rolls, tan(b) < (1 / moved + 1 / cases[i].beta) * 0.1);
        const double rate = cases[i].rolls ? weight * sin(b) / (moved + cases[i].beta)
                                           : weight * (sin(b) - 0.1 * cos(b)) / moved;
        CHECK_CLOSE(run.final_lab_si[3] / (0.1 * rate), 1, 1e-9);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_rates),
        cmocka_unit_test(test_dry_incline),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
