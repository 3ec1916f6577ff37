/* run.c - one bead: what does it do, and along which path?
 *
 *     cc -std=c11 run.c $(pkg-config --cflags --libs festoon) -o run
 *     ./run                            the paper's bead at 10.7 Hz
 *     ./run "642 rpm" path.csv         at another frequency, with its path in a file
 *
 * A setup is a struct of parameters in SI units; fst_run() simulates it and describes the motion.  The program
 * says the same by
 *
 *     festoon run --set drive.frequency="642 rpm" --csv path.csv
 */
#include <stdio.h>

#include <festoon/festoon.h>

/* A run pushes its samples into functions of ours: here a line of the path in the laboratory, in units of l.  A
 * sink that returns anything but FST_OK ends the run. */
static fst_status write_point(void *user, const fst_sample *sample, fst_error *error)
{
    (void)error;
    FILE *path = user;
    (void)fprintf(path, "%.17g,%.17g,%.17g\n", sample->t, sample->x, sample->y);
    return FST_OK;
}

/* Every failure comes with a place and a sentence. */
static int fail(const fst_error *error)
{
    (void)fprintf(stderr, "%s: %s: %s\n", fst_status_text(error->code), error->where, error->sentence);
    return 1;
}

int main(int count, char **words)
{
    fst_error error;
    fst_params bead = fst_default_params();
    /* Fields may be set by name (bead.drive_frequency = 10.7), or from text, with units and checks: */
    if (fst_params_set(&bead, "drive.frequency", count > 1 ? words[1] : "10.7 Hz", &error) != FST_OK)
        return fail(&error);

    fst_run_options options = fst_default_run_options();
    FILE *path = count > 2 ? fopen(words[2], "w") : NULL;
    if (count > 2 && !path) {
        perror(words[2]);
        return 1;
    }
    if (path) {
        (void)fputs("t,x,y\n", path);
        options.sink.user = path;
        options.sink.sample = write_point;
    }

    fst_run_result result;
    if (fst_run(&bead, &options, &result, &error) != FST_OK)
        return fail(&error);
    if (path && fclose(path) != 0) {
        perror(words[2]);
        return 1;
    }

    printf("%s: %s\n", fst_regime_name(result.regime), result.reason);
    printf("mean_r = %.17g\n", result.mean_r); /* distance from the axis, in l */
    printf("mean_alpha_dot = %.17g\n",
           result.mean_alpha_dot); /* angular velocity in the laboratory, in gamma */
    printf("festoons = %.17g\n", result.festoons);
    /* All numbers of a result by their names, as the program prints them: */
    int defined = 0;
    for (int i = 0; i < fst_result_count(); ++i) {
        const double value = *(const double *)((const char *)&result + fst_result_at(i)->offset);
        defined += !isnan(value); /* NAN: the number means nothing in this regime */
    }
    printf("%d of %d numbers are defined\n", defined, fst_result_count());
    return 0;
}
