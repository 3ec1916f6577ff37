/* branch.c - a branch of periodic orbits over the drive, with its bifurcations.
 *
 *     cc -std=c11 branch.c $(pkg-config --cflags --libs festoon) -o branch
 *     ./branch
 *
 * The counter-rotating orbit is followed from omega = 0.15 to 0.6, stable or not, round folds and along what
 * branches off.  Each point has its multipliers; where one of them passes 1 in absolute value, the special
 * point is located and named.  The program does the same by
 *
 *     festoon branch --kind counter --over drive.omega=0.15:0.6
 */
#include <stdio.h>

#include <festoon/festoon.h>

/* A call that may take long tells how far it is, and ends where tell() returns another status than FST_OK (as
 * FST_INTERRUPTED): the branch then holds what was found until then. */
static fst_status tell(void *user, double fraction, const char *what, fst_error *error)
{
    (void)what;
    (void)error;
    double *told = user;
    if (fraction > *told + 0.1) {
        *told = fraction;
        (void)fprintf(stderr, "%.0f %%\n", 100.0 * fraction);
    }
    return FST_OK;
}

int main(void)
{
    const fst_params bead = fst_default_params();
    fst_branch_options options = fst_default_branch_options();
    double told = 0.0;
    options.kind = FST_BRANCH_COUNTER;
    options.key = "drive.omega";
    options.from = 0.15;
    options.to = 0.6;
    const fst_progress progress = {&told, tell};
    options.progress = &progress;

    fst_branch branch;
    fst_error error;
    const fst_status status = fst_branch_follow(&bead, &options, &branch, &error);
    if (status == FST_UNAVAILABLE) {
        (void)fprintf(stderr, "%s\n", error.sentence); /* this build has no LAPACK */
        return 77;
    }
    if (status != FST_OK) {
        (void)fprintf(stderr, "%s: %s\n", error.where, error.sentence);
        fst_branch_free(&branch); /* an interrupted call leaves what it found */
        return 1;
    }

    size_t stable = 0;
    for (size_t i = 0; i < branch.point_count; ++i)
        stable += branch.points[i].stable != 0;
    printf("%zu orbits on %d branches, %zu of them stable\n", branch.point_count, branch.branches, stable);
    for (size_t i = 0; i < branch.special_count; ++i) {
        const fst_special *s = &branch.specials[i];
        printf("%s at omega = %.17g on branch %d, r = %.17g\n", fst_special_name(s->type), s->value, s->branch,
               s->at.mean_r);
    }
    for (size_t i = 0; i < branch.end_count; ++i)
        printf("branch %d ends at %.17g: %s\n", branch.ends[i].branch, branch.ends[i].value,
               branch.ends[i].reason);
    fst_branch_free(&branch);
    return 0;
}
