/* law.c - a friction law of your own: what the bead does with it, and its closed orbit by Newton's method.
 *
 * The friction force is own.grip N |V| V, with the normal load N and the velocity V of the contact point: it is
 * neither linear nor blind to the load.  Its formula and its derivative are in own/quadratic.inl, its name and
 * its parameter in own/festoon/own.def; nothing else knows of it.
 *
 * It takes festoon's source, not its installed headers and libraries alone (force.c needs no more than these), because
 * it is compiled into the lanes of every instruction set.  In the folder of the source:
 *
 *     cmake -B build-own -DCMAKE_BUILD_TYPE=Release -DFESTOON_OWN_PHYSICS=examples/c/own
 *     cmake --build build-own
 *     cc -std=c11 -Iexamples/c/own -Iinclude examples/c/law.c -Lbuild-own -lfestoon -o law
 *     LD_LIBRARY_PATH=build-own ./law
 */
#include <stdio.h>

#include <festoon/festoon.h>

static int fail(const fst_error *error)
{
    (void)fprintf(stderr, "%s: %s\n", error->where, error->sentence);
    return 1;
}

int main(void)
{
    static const double grips[] = {50, 250, 1000};
    fst_error error;
    fst_params bead = fst_default_params();
    bead.friction_law = FST_FRICTION_QUADRATIC;

    /* What the drive does must be what friction takes: the law's loss is f.V. */
    for (int i = 0; i < 3; ++i) {
        const fst_run_options options = fst_default_run_options();
        fst_run_result run;
        bead.own_grip = grips[i];
        if (fst_run(&bead, &options, &run, &error) != FST_OK)
            return fail(&error);
        printf("grip %g: %s, %.17g festoons, power of the drive %.17g, of friction %.17g\n", grips[i],
               fst_regime_name(run.regime), run.festoons, run.mean_drive_power, run.mean_friction_power);
    }

    /* Newton's method takes the law's derivative: it finds the orbit to rounding, and says whether it is
     * stable. */
    fst_orbit orbit;
    bead.own_grip = 250;
    const fst_status status = fst_orbit_find(&bead, NULL, &orbit, &error);
    if (status == FST_UNAVAILABLE)
        return 77; /* this build has no LAPACK */
    if (status != FST_OK)
        return fail(&error);
    printf("orbit: %s, %.17g festoons, %s, residual %.2g\n", fst_symmetry_name(orbit.symmetry),
           orbit.means.festoons, orbit.stable ? "stable" : "unstable", orbit.residual);
    return 0;
}
