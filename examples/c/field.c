/* field.c - a magnet of your own: its field, and what the bead does over it.
 *
 * The magnet is two opposite charges.  Its formulas are in own/charges.inl, its name and its parameters in
 * own/festoon/own.def; nothing else knows of it.  A build of festoon with that folder has it everywhere: in
 * scenes, runs, sweeps, orbits and films, and in the program (festoon run --set magnet.shape=charges).
 *
 * It takes festoon's source, not its installed headers and libraries alone (force.c needs no more than these), because
 * it is compiled into the lanes of every instruction set.  In the folder of the source:
 *
 *     cmake -B build-own -DCMAKE_BUILD_TYPE=Release -DFESTOON_OWN_PHYSICS=examples/c/own
 *     cmake --build build-own
 *     cc -std=c11 -Iexamples/c/own -Iinclude examples/c/field.c -Lbuild-own -lfestoon -o field
 *     LD_LIBRARY_PATH=build-own ./field
 */
#include <stdio.h>

#include <festoon/festoon.h>

static int fail(const fst_error *error)
{
    (void)fprintf(stderr, "%s: %s\n", error->where, error->sentence);
    return 1;
}

/* The field and its gradient at the height of the bead's centre, along a line across the magnet. */
static fst_status print_field(const fst_params *bead, fst_error *error)
{
    fst_model *model;
    const fst_status status = fst_model_new(bead, &model, error);
    if (status != FST_OK)
        return status;
    for (int i = -2; i <= 2; ++i) {
        double b[3], gradient[3][3];
        fst_field(model, 0.5 * i, 0.3, b, gradient);
        printf("x = %.17g: B = %.17g %.17g %.17g, dB_x/dx = %.17g\n", 0.5 * i, b[0], b[1], b[2],
               gradient[0][0]);
    }
    fst_model_free(model);
    return FST_OK;
}

int main(void)
{
    fst_error error;
    fst_params bead = fst_default_params();
    /* Sources and their parameters are set as those of festoon itself, by name or from text. */
    bead.magnet_shape = FST_MAGNET_CHARGES;
    bead.own_reach = 0.9;
    if (fst_params_set(&bead, "own.charge", "4.5", &error) != FST_OK ||
        fst_params_set(&bead, "drive.frequency", "20 Hz", &error) != FST_OK)
        return fail(&error);
    if (print_field(&bead, &error) != FST_OK)
        return fail(&error);

    fst_run_options options = fst_default_run_options();
    fst_run_result result;
    if (fst_run(&bead, &options, &result, &error) != FST_OK)
        return fail(&error);
    printf("two charges: %s, r = %.17g\n", fst_regime_name(result.regime), result.mean_r);

    /* At the distance 1 and with the charge 5 they are one of the lines of the paper's magnet. */
    bead.own_reach = 1.0;
    bead.own_charge = 5.0;
    if (fst_run(&bead, &options, &result, &error) != FST_OK)
        return fail(&error);
    printf("as a line: %s, r = %.17g\n", fst_regime_name(result.regime), result.mean_r);
    bead.magnet_shape = FST_MAGNET_LINES;
    bead.magnet_lines = 1;
    if (fst_run(&bead, &options, &result, &error) != FST_OK)
        return fail(&error);
    printf("a line: %s, r = %.17g\n", fst_regime_name(result.regime), result.mean_r);
    return 0;
}
