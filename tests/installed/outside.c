/* outside.c - a user's program in C: it simulates a short run with libfestoon alone. */
#include <festoon/festoon.h>

#include <stdio.h>

int main(void)
{
    fst_params params = fst_default_params();
    params.run_periods = 2.0;
    params.run_discard = 1.0;
    fst_error error = {FST_OK, "", ""};
    fst_run_options options = fst_default_run_options();
    fst_run_result result;
    if (fst_run(&params, &options, &result, &error) != FST_OK) {
        fprintf(stderr, "%s: %s\n", error.where, error.sentence);
        return 1;
    }
    printf("festoon %s: r = %.6f\n", fst_version(), result.mean_r);
    return result.mean_r > 0.0 ? 0 : 1;
}
