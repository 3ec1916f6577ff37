/* The two methods for dry friction against each other: means of the splitting method, extrapolated to steps of
 * no length, agree with those of runs by events to 1e-8.  They share the magnet's pull and nothing else:
 * neither steps, nor modes, nor events, nor the way in which means are taken. */
#include "physics.h"

typedef struct motion {
    double mu, frequency;
} motion;

/* Periodic motions with and without captures, symmetric and not. */
static const motion MOTIONS[] = {{0.1, 14.0}, {0.2, 10.7}, {0.2, 20.0}, {0.3, 26.0}, {0.3, 32.0}, {0.4, 32.0}};
enum { COUNT = sizeof MOTIONS / sizeof *MOTIONS, STEPS = 3 };
static const double STEP[STEPS] = {0.004, 0.002, 0.001};

static fst_params bead_of(int which)
{
    fst_params p = fst_default_params();
    p.friction_law = FST_FRICTION_COULOMB;
    p.friction_mu = MOTIONS[which].mu;
    p.drive_frequency = MOTIONS[which].frequency;
    p.run_periods = 250.0;
    p.run_discard = 120.0;
    return p;
}

/* Rows by the splitting method: job k is the motion k/STEPS with the step k % STEPS. */
typedef struct rows {
    int next;
    fst_run_result result[COUNT * STEPS];
} rows;

static int next_job(void *user, fst_row_job *job)
{
    rows *r = user;
    if (r->next == COUNT * STEPS)
        return 0;
    memset(job, 0, sizeof *job);
    job->params = bead_of(r->next / STEPS);
    job->params.run_method = FST_METHOD_SPLITTING;
    job->params.run_step = STEP[r->next % STEPS];
    job->point = r->next++;
    return 1;
}

static int job_done(void *user, fst_row_job *job, fst_status status, const fst_run_result *result,
                    const fst_error *error)
{
    rows *r = user;
    if (status != FST_OK)
        fail_msg("%s", error->sentence);
    r->result[job->point] = *result;
    return 0;
}

static const struct {
    const char *name;
    size_t offset;
    double tolerance;
} MEANS[] = {{"mean_r", offsetof(fst_run_result, mean_r), 1e-8},
             {"mean_alpha_dot", offsetof(fst_run_result, mean_alpha_dot), 1e-8},
             {"mean_nz", offsetof(fst_run_result, mean_nz), 1e-8},
             {"mean_b", offsetof(fst_run_result, mean_b), 1e-7},
             {"mean_friction_power", offsetof(fst_run_result, mean_friction_power), 1e-10},
             {"mean_drive_power", offsetof(fst_run_result, mean_drive_power), 1e-10},
             {"std_r", offsetof(fst_run_result, std_r), 1e-8},
             {"rms_slip", offsetof(fst_run_result, rms_slip), 1e-8},
             {"sticking", offsetof(fst_run_result, sticking), 1e-4}};

static double value_of(const fst_run_result *result, size_t offset)
{
    double value;
    memcpy(&value, (const char *)result + offset, sizeof value);
    return value;
}

static void test_means_agree(void **unused)
{
    (void)unused;
    static rows split;
    const fst_row_work work = {
        .user = &split, .arithmetic = fst_best_arithmetic(), .next = next_job, .done = job_done};
    fst_error error = {FST_OK, "", ""};
    if (fst_rows(&work, &error) != FST_OK)
        fail_msg("%s", error.sentence);
    double size[STEPS] = {0};
    for (int k = 0; k < COUNT; ++k) {
        fst_params p = bead_of(k);
        p.run_rtol = 1e-12;
        const fst_run_result exact = run_of(&p);
        const fst_run_result *of = &split.result[k * STEPS];
        assert_int_equal(of[STEPS - 1].regime, exact.regime);
        for (size_t i = 0; i < sizeof MEANS / sizeof *MEANS; ++i) {
            const double want = value_of(&exact, MEANS[i].offset);
            const double coarse = value_of(&of[1], MEANS[i].offset), fine = value_of(&of[2], MEANS[i].offset);
            const double off = (4 * fine - coarse) / 3 - want;
            if (!(fabs(off) <= MEANS[i].tolerance))
                fail_msg("mu %g, %g Hz: %s extrapolated is off by %.2g", p.friction_mu, p.drive_frequency,
                         MEANS[i].name, off);
        }
        for (int i = 0; i < STEPS; ++i)
            size[i] += fabs(of[i].mean_r - exact.mean_r);
    }
    /* of order 2 in the means too */
    for (int i = 0; i + 1 < STEPS; ++i)
        CHECK_WITHIN(log2(size[i] / size[i + 1]), 1.95, 2.05);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(test_means_agree)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
