/* Measures behind the verdicts on the paper's statements, on trajectories with known answers and on the field,
 * written here again.
 * tests: paper/measures.c paper/measures_field.c paper/measures_motion.c */
#include "physics.h"

#include <stdlib.h>

#include "paper/measures.h"
#include "paper/state.h"

enum { ROWS = 20000 };

typedef struct stage {
    fst_paper_state paper;
    fst_paper_run runs[2];
} stage;

/* A comparison that holds one run at each of two drives; x + iy = e^(iat) + p e^(ibt) + q e^(ict) in the first.
 */
static stage *set_up(double second, double third)
{
    stage *s = test_calloc(1, sizeof *s);
    for (int i = 0; i < 2; ++i) {
        fst_paper_run *run = &s->runs[i];
        const double omega = 0.215, circling = -0.07, meeting = omega - circling;
        run->params = fst_default_params();
        run->result.omega = omega;
        run->result.mean_alpha_dot = circling;
        run->result.mean_r = 0.8;
        run->result.max_angle_deg = 10.0;
        run->trajectory = (fst_table){.rows = ROWS, .params = run->params, .complete = 1};
        run->trajectory.columns = test_calloc((size_t)fst_column_count(), sizeof(double *));
        for (int c = 0; c < fst_column_count(); ++c) {
            const char *name = fst_column_at(c)->name;
            double *column = test_calloc(ROWS, sizeof *column);
            for (int row = 0; row < ROWS; ++row) {
                const double t = 0.05 * row, a = circling * t, b = (circling + meeting) * t;
                const double d = (circling + 3 * meeting) * t;
                column[row] = !strcmp(name, "t")       ? t
                              : !strcmp(name, "x")     ? cos(a) + second * cos(b) + third * cos(d)
                              : !strcmp(name, "y")     ? sin(a) + second * sin(b) + third * sin(d)
                              : !strcmp(name, "angle") ? (row % 8 == 0 ? 5.1 : 4.9)
                                                       : 0.0;
            }
            run->trajectory.columns[c] = column;
        }
        s->paper.scans[i ? FST_SCAN_FOLD15 : FST_SCAN_FOLD4][0] = run;
        s->paper.counts[i ? FST_SCAN_FOLD15 : FST_SCAN_FOLD4] = 1;
    }
    return s;
}

static void take_down(stage *s)
{
    for (int i = 0; i < 2; ++i) {
        for (int c = 0; c < fst_column_count(); ++c)
            test_free(s->runs[i].trajectory.columns[c]);
        test_free(s->runs[i].trajectory.columns);
    }
    test_free(s);
}

/* The share of one circular motion in what remains of a path beside the bead's circling; shares are by squares
 * of amplitudes. */
static void test_share_of_a_trochoid(void **unused)
{
    (void)unused;
    static const double parts[][2] = {{0.3, 0.0}, {0.3, 0.1}, {0.2, 0.2}, {0.05, 0.4}};
    for (size_t i = 0; i < sizeof parts / sizeof *parts; ++i) {
        char note[512];
        stage *s = set_up(parts[i][0], parts[i][1]);
        const double one = parts[i][0] * parts[i][0], other = parts[i][1] * parts[i][1];
        CHECK_CLOSE(fst_measure_trochoid(&(fst_measuring){&s->paper, FST_DYNAMICS_RIGID, note, sizeof note}),
                    fmax(one, other) / (one + other), 1e-2);
        take_down(s);
    }
}

static void test_share_of_rare_moments(void **unused)
{
    (void)unused;
    char note[512] = "";
    stage *s = set_up(0.3, 0.0);
    CHECK_CLOSE(fst_measure_rare_moments(&(fst_measuring){&s->paper, FST_DYNAMICS_RIGID, note, sizeof note}),
                12.5, 1e-6);
    take_down(s);
}

/* The paper's equations take V for the friction: of a motion under another law they are not measured. */
static void test_equations_of_a_viscous_plate(void **unused)
{
    (void)unused;
    static const fst_measure measures[] = {fst_measure_friction_share,   fst_measure_third_balance,
                                           fst_measure_second_balance,   fst_measure_dropped_part,
                                           fst_measure_centre_equations, fst_measure_turning_equations,
                                           fst_measure_appendix_theta,   fst_measure_appendix_phi,
                                           fst_measure_appendix_psi,     fst_measure_asymptotic_frequency};
    stage *s = set_up(0.3, 0.0);
    s->paper.scans[FST_SCAN_ASYMPTOTIC][0] = s->paper.scans[FST_SCAN_FAST][0] = &s->runs[1];
    s->paper.counts[FST_SCAN_ASYMPTOTIC] = s->paper.counts[FST_SCAN_FAST] = 1;
    for (int viscous = 0; viscous < 2; ++viscous)
        for (size_t i = 0; i < sizeof measures / sizeof *measures; ++i) {
            char note[512] = "";
            for (int k = 0; k < 2; ++k)
                s->runs[k].params.friction_law = viscous ? FST_FRICTION_VISCOUS : FST_FRICTION_NONE;
            const double value =
                measures[i](&(fst_measuring){&s->paper, FST_DYNAMICS_RIGID, note, sizeof note});
            if (viscous) {
                assert_null(strstr(note, "not measured"));
            } else {
                assert_true(isnan(value));
                CHECK_CONTAINS(note, "here it is none");
            }
        }
    take_down(s);
}

/* Mean radial force on a circle where n turns at `rate` times the angle, for both phases. */
static double mean_force(const fst_model *model, double r, int rate)
{
    enum { ANGLES = 720 };
    double sum[2] = {0.0, 0.0};
    for (int i = 0; i < ANGLES; ++i) {
        const double turn = TWO_PI * i / ANGLES, c = cos(turn), s = sin(turn);
        double b[3], g[3][3];
        fst_field(model, r * c, r * s, b, g);
        for (int phase = 0; phase < 2; ++phase) {
            const double chi = rate * turn + phase * 0.25 * TWO_PI;
            const double n[3] = {-sin(chi) * s, sin(chi) * c, -cos(chi)};
            for (int k = 0; k < 3; ++k)
                sum[phase] += n[k] * (g[k][0] * c + g[k][1] * s) / ANGLES;
        }
    }
    return hypot(sum[0], sum[1]);
}

/* The greatest mean force of the whole rates from -3 to 3 but +-1, over that of -1. */
static void test_the_resonance(void **unused)
{
    (void)unused;
    static const int others[] = {-3, -2, 0, 2, 3};
    char note[512];
    stage *s = set_up(0.3, 0.0);
    fst_model *model = model_of(&s->runs[1].params);
    const double r = s->runs[1].result.mean_r;
    double greatest = 0.0;
    for (size_t i = 0; i < sizeof others / sizeof *others; ++i)
        greatest = fmax(greatest, mean_force(model, r, others[i]));
    CHECK_CLOSE(fst_measure_resonance(&(fst_measuring){&s->paper, FST_DYNAMICS_RIGID, note, sizeof note}),
                greatest / mean_force(model, r, -1), 1e-6);
    assert_true(greatest > 1e-3 * mean_force(model, r, -1));
    fst_model_free(model);
    take_down(s);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_share_of_a_trochoid),
        cmocka_unit_test(test_share_of_rare_moments),
        cmocka_unit_test(test_the_resonance),
        cmocka_unit_test(test_equations_of_a_viscous_plate),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
