/* bench_beads.c - what a turn of the drive costs with several beads, at 30 Hz: exactly, two to four of them, and by
 * time stepping, 64 and 1000; and what the rate of a walker costs with an error of 1e-4, exactly and by the steps of
 * Moreau and Jean, which Siconos makes too.  (LAMMPS and LIGGGHTS have no field with a gradient that turns.) */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

#include <festoon/beads.h>

static const double EPS = 2.5 / 23;

static double now(void)
{
    struct timespec t;
    (void)clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &t);
    return (double)t.tv_sec + 1e-9 * (double)t.tv_nsec;
}

/* Beads on a square lattice with a spacing of so many radii; all on the plate and at rest. */
static void place(int count, double spacing, double *state)
{
    const int side = (int)ceil(sqrt(count));
    memset(state, 0, (size_t)(FST_BEAD_NUMBERS * count) * sizeof *state);
    for (int i = 0; i < count; ++i) {
        double *bead = state + FST_BEAD_NUMBERS * i;
        const double angle = 2.4 * i;
        bead[0] = spacing * EPS * (i % side - 0.5 * (side - 1));
        bead[1] = spacing * EPS * (i / side - 0.5 * (side - 1));
        bead[2] = EPS;
        bead[6] = cos(angle);
        bead[7] = sin(angle);
    }
}

/* A straight bar across the axis, which turns with the magnet. */
static void place_bar(int count, double omega, double *state)
{
    place(count, 2.0, state);
    for (int i = 0; i < count; ++i) {
        double *bead = state + FST_BEAD_NUMBERS * i;
        bead[0] = (2.0 * EPS + 1e-10) * (i - 0.5 * (count - 1));
        bead[1] = bead[7] = 0.0;
        bead[4] = omega * bead[0];
        bead[6] = 1.0;
        bead[11] = omega;
    }
}

/* `state` NULL: beads evenly spread on a circle, from the rolling start. */
static int measure(const char *name, int count, const double *state, fst_beads_options options, double turns)
{
    fst_params *beads = malloc((size_t)count * sizeof *beads);
    fst_error error;
    fst_beads_result result;
    if (!beads)
        return 1;
    for (int i = 0; i < count; ++i) {
        beads[i] = fst_default_params();
        beads[i].drive_frequency = 30;
        beads[i].plate_radius = 5;
        beads[i].start_phi = 3 + 360.0 * i / count;
        beads[i].run_rtol = 1e-10;
        beads[i].run_periods = turns;
        beads[i].run_discard = 0.5 * turns;
    }
    options.state = state;
    options.chi = 1.243e-3;
    const double began = now();
    if (fst_beads_run(beads, count, &options, &result, &error) != FST_OK)
        return puts(error.sentence), 1;
    const double took = now() - began;
    (void)printf("%-28s %8.3f ms a turn", name, 1e3 * took / turns);
    if (options.method == FST_BEADS_STEPPING)
        (void)printf("  %8.1f us a step  %6.1f sweeps  residual %.1e", 1e6 * took / (double)result.accepted,
                     (double)result.solver_sweeps / (double)result.accepted, result.solver_residual);
    (void)printf("  %s, energy %.1e\n", fst_beads_outcome_name(result.outcome), result.energy_residual);
    fst_beads_free(&result);
    free(beads);
    return 0;
}

/* The rate at which a walker's centre circles, over 500 turns, and the time that this takes. */
static double walk(double rtol, double steps_per_turn, double *took)
{
    fst_params beads[2];
    fst_beads_options options = fst_default_beads_options();
    fst_beads_result result;
    options.chi = 1.243e-3;
    options.method = steps_per_turn > 0 ? FST_BEADS_STEPPING : FST_BEADS_EXACT;
    options.steps_per_turn = steps_per_turn;
    for (int i = 0; i < 2; ++i) {
        beads[i] = fst_default_params();
        beads[i].drive_frequency = 30;
        beads[i].start_phi = 3 + 37 * i;
        beads[i].run_rtol = rtol;
        beads[i].run_periods = 600;
        beads[i].run_discard = 100;
    }
    const double began = now();
    const int good = fst_beads_run(beads, 2, &options, &result, NULL) == FST_OK && result.group_count > 0;
    *took = now() - began;
    const double rate = good ? result.groups[0].centre_rate : NAN;
    fst_beads_free(&result);
    return rate;
}

static int compare_walkers(void)
{
    double took, exact, stepped;
    const double right = walk(1e-11, 0, &took), loose = walk(1e-4, 0, &exact),
                 steps = walk(1e-9, 16000, &stepped);
    const double wrong[2] = {fabs(loose / right - 1), fabs(steps / right - 1)};
    (void)printf("a walker's rate: exact to %.1e in %.2f s, stepped to %.1e in %.2f s: %.0f times as long\n",
                 wrong[0], exact, wrong[1], stepped, stepped / exact);
    return !(wrong[0] < wrong[1] && wrong[1] < 3e-4);
}

int main(void)
{
    (void)setvbuf(stdout, NULL, _IOLBF, 0);
    static double state[FST_BEAD_NUMBERS * FST_BEADS_MANY];
    fst_params params = fst_default_params();
    fst_beads_options options = fst_default_beads_options();
    params.drive_frequency = 30;
    fst_model *model;
    fst_error error;
    if (fst_model_new(&params, &model, &error) != FST_OK)
        return puts(error.sentence), 1;
    const double omega = fst_model_groups(model).omega;
    fst_model_free(model);
    int failed = measure("2 beads, exact, apart", 2, NULL, options, 200);
    failed |= measure("4 beads, exact, apart", 4, NULL, options, 60); /* after 60 turns they meet */
    for (int count = 2; count <= 4; ++count) {
        char name[64];
        (void)snprintf(name, sizeof name, "%d beads, exact, a bar", count);
        place_bar(count, omega, state);
        failed |= measure(name, count, state, options, 1000);
    }
    options.method = FST_BEADS_STEPPING;
    place_bar(3, omega, state);
    failed |= measure("3 beads, stepping, a bar", 3, state, options, 100);
    place(64, 3.0, state);
    failed |= measure("64 beads, stepping", 64, state, options, 20);
    place(1000, 2.2, state);
    failed |= measure("1000 beads, stepping", 1000, state, options, 0.1);
    return failed | compare_walkers();
}
