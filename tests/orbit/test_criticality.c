/* Whether bifurcations are super- or subcritical, seen from the motion itself: oscillations beside Hopf and
 * Neimark-Sacker points grow or decay as the cubic coefficients say, and the right number of states exists on
 * either side of a pitchfork.
 * tests: orbit/criticality.c orbit/normal_form.c
 * labels: long */
#include "branches.h"

#include "ode/flow.h"
#include "orbit/normal_form.h"

#define TWO_PI 6.283185307179586476925287

/* ------------------------------------------------------------------ Hopf points */

static fst_family family_over_omega(void)
{
    const fst_params params = scene_of(0.15, "rigid");
    fst_family family;
    fst_error error;
    if (fst_family_begin(&family, &params, "drive.omega", &error) != FST_OK)
        fail_msg("%s", error.sentence);
    return family;
}

/* The equilibrium at a drive, near a state, with its spectrum. */
static fst_solution equilibrium(const fst_family *family, double omega, const double *state)
{
    fst_solution s;
    memset(&s, 0, sizeof s);
    s.value = omega;
    memcpy(s.y[0], state, sizeof s.y[0]);
    assert_int_equal(fst_solution_correct(family, &s, NULL, NULL), FST_OK);
    assert_int_equal(fst_solution_spectrum(family, &s, NULL), FST_OK);
    return s;
}

/* The pair nearest to the imaginary axis. */
static int critical(const fst_solution *s)
{
    int best = -1;
    for (int i = 0; i < s->multipliers; ++i)
        if (s->im[i] > 1e-6 && (best < 0 || fabs(s->re[i]) < fabs(s->re[best])))
            best = i;
    assert_true(best >= 0);
    return best;
}

static double distance2(const double *a, const double *b)
{
    double sum = 0.0;
    for (int i = 0; i < FST_STATE_SIZE; ++i)
        sum += (a[i] - b[i]) * (a[i] - b[i]);
    return sum;
}

static fst_flow *flow_from(fst_model **model, double omega, const double *state)
{
    const fst_params params = scene_of(omega, "rigid");
    fst_flow_options options = fst_default_flow_options();
    fst_flow *flow;
    options.rtol = 1e-13;
    for (int i = 0; i < FST_STATE_SIZE; ++i)
        options.atol[i] = 1e-14;
    assert_int_equal(fst_model_new(&params, model, NULL), FST_OK);
    assert_int_equal(fst_flow_new(*model, &options, state, &flow, NULL), FST_OK);
    return flow;
}

/* |z|^2 of the oscillation about `rest`, x = z q + conj with |q| = 1, as the mean over some periods from t on.
 */
static double amplitude2(fst_flow *flow, const double *rest, double t, double period)
{
    enum { PERIODS = 4, SAMPLES = 64 * PERIODS };
    double sum = 0.0;
    for (int i = 0; i < SAMPLES; ++i) {
        fst_stop stop;
        assert_int_equal(fst_flow_next(flow, t + PERIODS * period * i / SAMPLES, 0, &stop, NULL), FST_OK);
        sum += distance2(fst_flow_get(flow).state, rest) / SAMPLES;
    }
    return 0.5 * sum;
}

/* At the Hopf point |z|' = c |z|^3, so 1/|z|^2 falls by 2 c in each unit of time. */
static double measured_hopf(const fst_solution *hopf, const double *along, double amplitude)
{
    double start[FST_STATE_SIZE];
    const double period = TWO_PI / hopf->im[critical(hopf)], settled = 200.0 * period, later = 600.0 * period;
    for (int i = 0; i < FST_STATE_SIZE; ++i)
        start[i] = hopf->y[0][i] + 2.0 * amplitude * along[i];
    fst_model *model;
    fst_flow *flow = flow_from(&model, hopf->value, start);
    const double first = amplitude2(flow, hopf->y[0], settled, period);
    const double last = amplitude2(flow, hopf->y[0], later, period);
    fst_flow_free(flow);
    fst_model_free(model);
    return -0.5 * (1.0 / last - 1.0 / first) / (later - settled);
}

/* Hopf points at which all other modes decay; at others the motion does not stay close. Both are supercritical;
 * growth beside a subcritical point is tested at the libration's Neimark-Sacker point. */
static const struct {
    double from, to, omega;
} HOPF[] = {{0.091, 0.093, 0.0921063451694}, {0.152, 0.153, 0.152636630556}};
enum { HOPF_COUNT = sizeof HOPF / sizeof *HOPF };

static void oscillations_beside_hopf_points(void **state)
{
    (void)state;
    const fst_family family = family_over_omega();
    for (int k = 0; k < HOPF_COUNT; ++k) {
        const fst_params params = scene_of(HOPF[k].omega, "rigid");
        const fst_branch_options o = over_omega(FST_BRANCH_LOCKED, HOPF[k].from, HOPF[k].to);
        fst_branch b = followed(&params, &o);
        const fst_special *at = special_near(&b, FST_SPECIAL_HOPF, HOPF[k].omega);
        CHECK_CLOSE(at->value, HOPF[k].omega, 1e-9);
        assert_int_equal(at->criticality, 1);
        const fst_solution hopf = equilibrium(&family, at->value, at->at.state);
        fst_branch_free(&b);
        const double frequency = hopf.im[critical(&hopf)];
        double coefficient, spread, real[FST_STATE_SIZE], imaginary[FST_STATE_SIZE];
        assert_int_equal(fst_pair_coefficient(&family, &hopf, frequency, &coefficient, &spread, NULL), FST_OK);
        assert_int_equal(fst_solution_eigenvector(&family, &hopf, 0.0, frequency, real, imaginary, NULL),
                         FST_OK);
        /* 1/|z|^2 stays far from zero during the measurement; two amplitudes are extrapolated to zero amplitude
         */
        const double rate = fabs(coefficient * frequency), periods = 600.0 * TWO_PI / frequency;
        const double amplitude = fmin(2e-3, sqrt(0.05 / (rate * periods)));
        const double wide = measured_hopf(&hopf, real, amplitude);
        const double narrow = measured_hopf(&hopf, real, 0.5 * amplitude);
        CHECK_CLOSE((4.0 * narrow - wide) / 3.0 / (coefficient * frequency), 1.0, 0.01);
    }
}

/* Beyond a supercritical Hopf point the libration has the amplitude at which linear growth and the cubic term
 * balance. */
static void librations_grow_from_a_hopf_point(void **state)
{
    (void)state;
    const fst_family family = family_over_omega();
    const double hopf_omega = HOPF[1].omega;
    double ratio[2];
    for (int k = 0; k < 2; ++k) {
        const double omega = hopf_omega + (k ? 4e-5 : 8e-5);
        fst_params params = scene_of(omega, "rigid");
        fst_orbit orbit;
        fst_error error;
        params.run_periods = 4000;
        if (fst_orbit_find(&params, NULL, &orbit, &error) != FST_OK)
            fail_msg("%s", error.sentence);
        assert_int_equal(orbit.turns, 0);
        const fst_solution rest = equilibrium(&family, omega, orbit.state);
        const fst_solution hopf = equilibrium(&family, hopf_omega, orbit.state);
        const int pair = critical(&rest);
        double coefficient, spread;
        assert_true(rest.re[pair] > 0);
        assert_int_equal(
            fst_pair_coefficient(&family, &hopf, hopf.im[critical(&hopf)], &coefficient, &spread, NULL),
            FST_OK);
        fst_model *model;
        fst_flow *flow = flow_from(&model, omega, orbit.state);
        const double found = amplitude2(flow, rest.y[0], 0.0, orbit.means.period);
        fst_flow_free(flow);
        fst_model_free(model);
        ratio[k] = found / (-rest.re[pair] / (coefficient * hopf.im[critical(&hopf)]));
    }
    CHECK_CLOSE(ratio[1], 1.0, 0.02);
    CHECK_CLOSE(2.0 * ratio[1] - ratio[0], 1.0, 0.002); /* the error falls with the distance */
}

/* ------------------------------------------------------------------ the first libration's Neimark-Sacker point
 */

/* The plane across the flow through a state of the orbit. */
typedef struct section {
    double at[FST_STATE_SIZE], normal[FST_STATE_SIZE];
} section;

static double height(const section *p, const double *y)
{
    double sum = 0.0;
    for (int i = 0; i < FST_STATE_SIZE; ++i)
        sum += p->normal[i] * (y[i] - p->at[i]);
    return sum;
}

/* Follow the flow to its next upward passage of the plane near the orbit. */
static void next_return(fst_flow *flow, const section *p, double y[FST_STATE_SIZE])
{
    for (int steps = 0; steps < 100000; ++steps) {
        const double before = height(p, fst_flow_get(flow).state);
        assert_int_equal(fst_flow_step(flow, 1e9, NULL), FST_OK);
        const double after = height(p, fst_flow_get(flow).state);
        if (!(before < 0 && after >= 0))
            continue;
        double lo = 0.0, hi = 1.0;
        for (int i = 0; i < 50; ++i) {
            const double x = 0.5 * (lo + hi);
            fst_flow_at(flow, x, y);
            if (height(p, y) < 0)
                lo = x;
            else
                hi = x;
        }
        if (distance2(y, p->at) < 0.1)
            return;
    }
    fail_msg("%s", "the orbit did not return");
}

/* The functional that gives z of a state on the section: a left eigenvector of the return's derivative, with
 * <p, q> = 1 and |q| = 1. */
typedef struct critical_part {
    double re[FST_STATE_SIZE], im[FST_STATE_SIZE];
} critical_part;

static critical_part critical_part_of(const fst_family *family, const fst_solution *s, int pair)
{
    enum { N = FST_TANGENT_SIZE - 1 };
    double matrix[N * N], transposed[N * N], basis[FST_STATE_SIZE][FST_TANGENT_SIZE], re[N], im[N], left[N * N];
    double q_re[FST_STATE_SIZE], q_im[FST_STATE_SIZE], size = 0.0, along_re = 0.0, along_im = 0.0;
    critical_part p;
    int best = 0;
    assert_int_equal(fst_solution_section(family, s, matrix, basis, NULL), FST_OK);
    for (int i = 0; i < N; ++i)
        for (int j = 0; j < N; ++j)
            transposed[i * N + j] = matrix[j * N + i];
    assert_int_equal(family->lapack->eigen(N, transposed, re, im, left), 0);
    for (int i = 1; i < N; ++i)
        if (hypot(re[i] - s->re[pair], im[i] - s->im[pair]) <
            hypot(re[best] - s->re[pair], im[best] - s->im[pair]))
            best = i;
    assert_int_equal(fst_solution_eigenvector(family, s, s->re[pair], s->im[pair], q_re, q_im, NULL), FST_OK);
    for (int k = 0; k < FST_STATE_SIZE; ++k) {
        p.re[k] = p.im[k] = 0.0;
        for (int i = 0; i < N; ++i) {
            p.re[k] += basis[k][i + 1] * left[i * N + best];
            p.im[k] += basis[k][i + 1] * left[i * N + best + 1];
        }
        size += q_re[k] * q_re[k] + q_im[k] * q_im[k];
        along_re += p.re[k] * q_re[k] - p.im[k] * q_im[k];
        along_im += p.re[k] * q_im[k] + p.im[k] * q_re[k];
    }
    const double scale = hypot(along_re, along_im) / sqrt(size);
    for (int k = 0; k < FST_STATE_SIZE; ++k) {
        p.re[k] /= scale;
        p.im[k] /= scale;
    }
    return p;
}

/* |z|^2 at the returns: its mean over `window` returns after `skip`, and again after `skip` further ones.
 * Hann's window is the weight, which averages oscillations away. */
static void returns(const section *plane, const critical_part *p, double omega, const double *from, int skip,
                    int window, double mean[2])
{
    fst_model *model;
    fst_flow *flow = flow_from(&model, omega, from);
    double y[FST_STATE_SIZE];
    for (int part = 0; part < 2; ++part) {
        mean[part] = 0.0;
        for (int i = 0; i < skip + window; ++i) {
            double re = 0.0, im = 0.0;
            next_return(flow, plane, y);
            for (int k = 0; k < FST_STATE_SIZE; ++k) {
                re += p->re[k] * (y[k] - plane->at[k]);
                im += p->im[k] * (y[k] - plane->at[k]);
            }
            const double weight = 2.0 * pow(sin(0.5 * TWO_PI * (i - skip + 0.5) / window), 2) / window;
            mean[part] += i >= skip ? weight * (re * re + im * im) : 0.0;
        }
    }
    fst_flow_free(flow);
    fst_model_free(model);
}

/* The libration at a drive, near a state of it, with its multipliers, in four segments. */
static fst_solution libration(const fst_family *family, double omega, const fst_branch_point *near)
{
    fst_solution s;
    memset(&s, 0, sizeof s);
    s.value = omega;
    s.period = near->period;
    memcpy(s.y[0], near->state, sizeof s.y[0]);
    assert_int_equal(fst_solution_chain(family, &s, 4, NULL), FST_OK);
    assert_int_equal(fst_solution_correct(family, &s, NULL, NULL), FST_OK);
    assert_int_equal(fst_solution_spectrum(family, &s, NULL), FST_OK);
    return s;
}

static int nearest_pair(const fst_solution *s)
{
    int best = -1;
    for (int i = 0; i < s->multipliers; ++i)
        if (s->im[i] > 1e-6 &&
            (best < 0 || fabs(hypot(s->re[i], s->im[i]) - 1.0) < fabs(hypot(s->re[best], s->im[best]) - 1.0)))
            best = i;
    assert_true(best >= 0);
    return best;
}

static section section_of(const fst_solution *s)
{
    section p;
    const fst_params params = scene_of(s->value, "rigid");
    fst_model *model;
    memcpy(p.at, s->y[0], sizeof p.at);
    assert_int_equal(fst_model_new(&params, &model, NULL), FST_OK);
    fst_rhs(model, p.at, p.normal);
    fst_model_free(model);
    return p;
}

/* |z| after some returns, where each return takes |z| to |z| (modulus + c |z|^2). */
static double iterated(double size2, double modulus, double coefficient, double count)
{
    for (int i = 0; i < (int)count; ++i)
        size2 *= pow(modulus + coefficient * size2, 2);
    return size2;
}

static void iterates_beside_a_neimark_sacker_point(void **state)
{
    (void)state;
    enum { SKIP = 200, WINDOW = 200 };
    const fst_family family = family_over_omega();
    const fst_params params = scene_of(0.129, "rigid");
    const fst_branch_options o = over_omega(FST_BRANCH_ALL, 0.1288, 0.1305);
    fst_branch b = followed(&params, &o);
    const fst_special at = *special_near(&b, FST_SPECIAL_NEIMARK_SACKER, 0.129014691545);
    fst_branch_free(&b);
    CHECK_CLOSE(at.value, 0.129014691545, 1e-9);
    assert_int_equal(at.criticality, -1);
    const fst_solution point = libration(&family, at.value, &at.at);
    const int pair = nearest_pair(&point);
    double coefficient, spread;
    assert_int_equal(fst_pair_coefficient(&family, &point, atan2(point.im[pair], point.re[pair]), &coefficient,
                                          &spread, NULL),
                     FST_OK);
    assert_true(coefficient > 0);
    /* At the Neimark-Sacker point and on both sides of it, inside and outside the unstable torus: the distance
     * of the returns from the orbit grows or shrinks as multiplier and coefficient say. */
    for (int side = -1; side <= 1; ++side) {
        const fst_solution s = libration(&family, at.value + side * 1e-7, &at.at);
        const int k = nearest_pair(&s);
        const double modulus = hypot(s.re[k], s.im[k]);
        const section plane = section_of(&s);
        const critical_part p = critical_part_of(&family, &s, k);
        assert_true(side == 0 || (modulus > 1.0) == (side > 0));
        double real[FST_STATE_SIZE], imaginary[FST_STATE_SIZE], length = 0.0;
        assert_int_equal(fst_solution_eigenvector(&family, &s, s.re[k], s.im[k], real, imaginary, NULL),
                         FST_OK);
        for (int i = 0; i < FST_STATE_SIZE; ++i)
            length += real[i] * real[i] + imaginary[i] * imaginary[i];
        const double torus = sqrt(fabs(modulus - 1.0) / coefficient);
        for (int outside = 0; outside < 2; ++outside) {
            const double size = side == 0 ? (outside ? 4e-3 : 2e-3) : (outside ? 1.6 : 0.6) * torus;
            double start[FST_STATE_SIZE], mean[2];
            for (int i = 0; i < FST_STATE_SIZE; ++i)
                start[i] = plane.at[i] + 2.0 * size * real[i] / sqrt(length);
            returns(&plane, &p, s.value, start, SKIP, WINDOW, mean);
            const double grown = log(mean[1] / mean[0]);
            const double expected = log(iterated(mean[0], modulus, coefficient, SKIP + WINDOW) / mean[0]);
            assert_int_equal(grown > 0, side > 0 || (side == 0 || outside));
            CHECK_CLOSE(grown / expected, 1.0, 0.02);
        }
    }
}

/* ------------------------------------------------------------------ branch points of equilibria */

static int states_at(double omega, const char *dynamics, int *index_sum)
{
    const fst_params params = scene_of(omega, dynamics);
    fst_locked_list list;
    assert_int_equal(fst_locked_find(&params, NULL, &list, NULL), FST_OK);
    const int count = (int)list.count;
    *index_sum = list.index_sum;
    fst_locked_free(&list);
    return count;
}

/* Number of unstable directions of a branch at both ends of a range. */
static void count_unstable(const fst_branch *b, int branch, int unstable[2])
{
    for (size_t i = 0; i < b->point_count; ++i) {
        const fst_branch_point *p = &b->points[i];
        if (p->branch != branch || (p->value != b->from && p->value != b->to))
            continue;
        const int end = p->value == b->to;
        unstable[end] = 0;
        for (int m = 0; m < p->multipliers; ++m)
            unstable[end] += p->multiplier_re[m] > 1e-9;
    }
}

/* On the axis the symmetry S2 can break: one side has two states more, and if the pitchfork is supercritical it
 * is the side on which the old state has more unstable directions. Off the axis two families pass through each
 * other, and both sides have the same number of states. */
static void states_beside_branch_points(void **state)
{
    (void)state;
    static const struct {
        const char *dynamics;
        double omega;
        fst_special_type type;
    } cases[] = {{"rigid", 0.197583961, FST_SPECIAL_PITCHFORK},
                 {"rigid", 0.251595368, FST_SPECIAL_PITCHFORK},
                 {"farago2020", 3.654213591, FST_SPECIAL_PITCHFORK},
                 {"rigid", 0.089075086, FST_SPECIAL_TRANSCRITICAL}};
    for (size_t k = 0; k < sizeof cases / sizeof *cases; ++k) {
        const double omega = cases[k].omega, beside = 5e-4 * omega;
        const fst_params params = scene_of(omega, cases[k].dynamics);
        const fst_branch_options o = over_omega(FST_BRANCH_LOCKED, omega - beside, omega + beside);
        fst_branch b = followed(&params, &o);
        const fst_special *at = special_near(&b, cases[k].type, omega);
        int sum[2], unstable[2] = {0, 0};
        const int more = states_at(omega + beside, cases[k].dynamics, &sum[1]) -
                         states_at(omega - beside, cases[k].dynamics, &sum[0]);
        count_unstable(&b, at->branch, unstable);
        assert_int_equal(sum[0], sum[1]);
        assert_int_equal(abs(unstable[1] - unstable[0]), 1);
        if (cases[k].type == FST_SPECIAL_TRANSCRITICAL) {
            assert_int_equal(more, 0);
            assert_int_equal(at->criticality, 0);
        } else {
            assert_int_equal(abs(more), 2);
            assert_int_equal(at->criticality, (more > 0) == (unstable[1] > unstable[0]) ? 1 : -1);
        }
        fst_branch_free(&b);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(oscillations_beside_hopf_points),
        cmocka_unit_test(librations_grow_from_a_hopf_point),
        cmocka_unit_test(iterates_beside_a_neimark_sacker_point),
        cmocka_unit_test(states_beside_branch_points),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
