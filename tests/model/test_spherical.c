/* The paper's appendix: its spherical equations, corrected (PHYSICS, section 4), are the vector form, and each
 * printed error is one.
 *
 * n = cos(theta) e_r + sin(theta) (sin(phi) e_alpha - cos(phi) e_z) in the bead's own directions e_r, e_alpha.
 * From a state and fst_rhs() follow theta, phi and their first and second derivatives; the appendix's equations
 * are then numbers on both sides.
 * tests: model/dynamics.inl */
#include "physics.h"

typedef struct angles {
    double S, C, s, c;                /* sine and cosine of theta and of phi */
    double theta1, phi1, alpha1, psi; /* first derivatives; psi' = W.n */
    double theta2, phi2, alpha2;      /* second derivatives */
    double psi2;
    double v_r, v_alpha;     /* slip */
    double dr;               /* r' */
    double by_theta, by_phi; /* (5 kappa/2) dn/dtheta.B and dn/dphi.B */
    double r, eps, kappa;
} angles;

/* Components of a vector in e_r, e_alpha, e_z at the state's position. */
static void local(const double *y, const double u[3], double out[3])
{
    const double r = hypot(y[FST_X], y[FST_Y]), ex = y[FST_X] / r, ey = y[FST_Y] / r;
    out[0] = u[0] * ex + u[1] * ey;
    out[1] = u[1] * ex - u[0] * ey;
    out[2] = u[2];
}

/* The derivative of one of the state's vectors in the laboratory: the library's plus omega e x. */
static void lab_rate(const double *y, const double *dy, double omega, int first, int size, double out[3])
{
    out[0] = dy[first] - omega * y[first + 1];
    out[1] = dy[first + 1] + omega * y[first];
    out[2] = size == 3 ? dy[first + 2] : 0;
}

/* Rates of n's local components, first and second, with the directions turning at alpha': for components u(t),
 * u' = n' - alpha' e x n and u'' = n'' - alpha'' e x n - 2 alpha' e x u' - alpha'^2 e x (e x n). */
static void local_rates(const double n[3], const double n1[3], const double n2[3], double alpha1, double alpha2,
                        double u1[3], double u2[3])
{
    u1[0] = n1[0] + alpha1 * n[1];
    u1[1] = n1[1] - alpha1 * n[0];
    u1[2] = n1[2];
    u2[0] = n2[0] + alpha2 * n[1] + 2 * alpha1 * u1[1] + alpha1 * alpha1 * n[0];
    u2[1] = n2[1] - alpha2 * n[0] - 2 * alpha1 * u1[0] + alpha1 * alpha1 * n[1];
    u2[2] = n2[2];
}

static void rates_of_angles(angles *a, const double n[3], const double u1[3], const double u2[3])
{
    a->C = n[0];
    a->S = sqrt(n[1] * n[1] + n[2] * n[2]);
    a->s = n[1] / a->S;
    a->c = -n[2] / a->S;
    a->theta1 = -u1[0] / a->S;
    a->theta2 = -(u2[0] + a->C * a->theta1 * a->theta1) / a->S;
    const double p = n[1], q = -n[2], p1 = u1[1], q1 = -u1[2], p2 = u2[1], q2 = -u2[2], s2 = a->S * a->S;
    a->phi1 = (q * p1 - p * q1) / s2;
    a->phi2 = (q * p2 - p * q2) / s2 - 2 * a->phi1 * (p * p1 + q * q1) / s2;
}

static angles angles_of(const fst_model *model, const double *y)
{
    const fst_groups g = fst_model_groups(model);
    const fst_observation o = fst_observe(model, y);
    double dy[FST_STATE_SIZE], a3[3], n1[3], w1[3], n2[3], part[3];
    fst_rhs(model, y, dy);
    lab_rate(y, dy, g.omega, FST_VX, 2, a3);
    lab_rate(y, dy, g.omega, FST_NX, 3, n1);
    lab_rate(y, dy, g.omega, FST_WX, 3, w1);
    cross(w1, y + FST_NX, n2); /* n'' = W' x n + W x n' */
    cross(y + FST_WX, n1, part);
    for (int i = 0; i < 3; ++i)
        n2[i] += part[i];
    const double v[3] = {y[FST_VX], y[FST_VY], 0};
    double v_local[3], a_local[3], n1_local[3], n2_local[3], u1[3], u2[3];
    local(y, v, v_local);
    local(y, a3, a_local);
    local(y, n1, n1_local);
    local(y, n2, n2_local);
    angles a = {.r = o.r, .eps = g.eps, .kappa = g.kappa, .psi = o.spin, .dr = v_local[0]};
    a.alpha1 = v_local[1] / o.r;
    a.alpha2 = (a_local[1] - 2 * a.dr * a.alpha1) / o.r;
    local_rates(o.n, n1_local, n2_local, a.alpha1, a.alpha2, u1, u2);
    rates_of_angles(&a, o.n, u1, u2);
    a.psi2 = dot(w1, y + FST_NX) + dot(y + FST_WX, n1);
    a.v_r = o.slip[0];
    a.v_alpha = o.slip[1];
    a.by_theta = 2.5 * g.kappa * (-a.S * o.b[0] + a.C * a.s * o.b[1] - a.C * a.c * o.b[2]);
    a.by_phi = 2.5 * g.kappa * a.S * (a.c * o.b[1] + a.s * o.b[2]);
    return a;
}

/* d/dt [theta' + alpha' sin(phi)] minus the corrected right-hand side; `gyroscopic` adds the term of `rigid`.
 */
static double theta_defect(const angles *a, int gyroscopic)
{
    const double left = a->theta2 + a->alpha2 * a->s + a->alpha1 * a->c * a->phi1;
    double right = a->phi1 * a->phi1 * a->S * a->C - a->alpha1 * a->alpha1 * a->S * a->C * a->c * a->c +
                   a->alpha1 * a->phi1 * (a->C * a->C - a->S * a->S) * a->c + a->by_theta +
                   2.5 / a->eps * a->v_r * a->c;
    if (gyroscopic)
        right -= a->psi * (a->phi1 * a->S + a->alpha1 * a->C * a->c);
    return left - right;
}

/* d/dt [phi' sin^2 + alpha' sin cos cos(phi)] minus the corrected right-hand side. */
static double phi_defect(const angles *a, int gyroscopic)
{
    const double left =
        a->phi2 * a->S * a->S + 2 * a->phi1 * a->S * a->C * a->theta1 + a->alpha2 * a->S * a->C * a->c +
        a->alpha1 * ((a->C * a->C - a->S * a->S) * a->theta1 * a->c - a->S * a->C * a->s * a->phi1);
    double right = a->alpha1 * a->alpha1 * a->S * a->S * a->s * a->c + a->alpha1 * a->theta1 * a->c -
                   a->alpha1 * a->phi1 * a->S * a->C * a->s + a->by_phi -
                   2.5 / a->eps * (a->v_r * a->S * a->C * a->s + a->v_alpha * a->S * a->S);
    if (gyroscopic)
        right += a->psi * a->S * (a->theta1 + a->alpha1 * a->s);
    return left - right;
}

/* The angles of a random state away from their poles, where they lose digits. */
static angles random_angles(const fst_model *model, uint64_t *seed)
{
    double y[FST_STATE_SIZE], r, nr;
    do {
        random_state(seed, y);
        r = hypot(y[FST_X], y[FST_Y]);
        nr = (y[FST_NX] * y[FST_X] + y[FST_NY] * y[FST_Y]) / r;
    } while (r < 0.4 || fabs(nr) > 0.9);
    return angles_of(model, y);
}

/* The rounding error of the terms, some of which reach 1e3, is 1e-12 of their sum. */
static double roundoff(const angles *a)
{
    return 1e-12 * (1 + a->theta1 * a->theta1 + a->phi1 * a->phi1 + a->psi * a->psi + a->alpha1 * a->alpha1 +
                    fabs(a->by_theta) + fabs(a->by_phi) + 2.5 / a->eps * hypot(a->v_r, a->v_alpha));
}

enum { TRIALS = 300 };

static void test_corrected_form_is_the_vector_form(void **unused)
{
    (void)unused;
    uint64_t seed = 51;
    for (int dynamics = 0; dynamics < 2; ++dynamics) {
        const fst_params p = bead_at(0.37, (fst_dynamics)dynamics);
        fst_model *model = model_of(&p);
        const int gyroscopic = dynamics == FST_DYNAMICS_RIGID;
        for (int trial = 0; trial < TRIALS; ++trial) {
            const angles a = random_angles(model, &seed);
            CHECK_CLOSE(theta_defect(&a, gyroscopic), 0, roundoff(&a));
            CHECK_CLOSE(phi_defect(&a, gyroscopic), 0, roundoff(&a));
            /* V_r, V_alpha and the psi equation are right as printed. */
            CHECK_CLOSE(a.v_r,
                        a.dr - a.eps * (a.theta1 * a.c + a.alpha1 * a.S * a.S * a.s * a.c -
                                        a.phi1 * a.S * a.C * a.s + a.psi * a.S * a.s),
                        1e-13);
            CHECK_CLOSE(a.v_alpha,
                        a.r * a.alpha1 +
                            a.eps * (a.phi1 * a.S * a.S + a.alpha1 * a.S * a.C * a.c + a.psi * a.C),
                        1e-13);
            CHECK_CLOSE(a.psi2, 2.5 / a.eps * (a.v_r * a.S * a.s - a.v_alpha * a.C), roundoff(&a));
        }
        fst_model_free(model);
    }
}

/* Each printed error is off by its own term, far above rounding, with farago2020, which is the printed dynamics
 * but for these two slips. */
static void test_printed_slips_are_errors(void **unused)
{
    (void)unused;
    uint64_t seed = 52;
    const fst_params p = bead_at(0.37, FST_DYNAMICS_FARAGO2020);
    fst_model *model = model_of(&p);
    double theta_worst = 0, phi_worst = 0;
    for (int trial = 0; trial < TRIALS; ++trial) {
        const angles a = random_angles(model, &seed);
        /* printed +alpha'^2 sin cos sin^2(phi) for -alpha'^2 sin cos cos^2(phi): too much by alpha'^2 sin cos
         */
        const double theta_slip =
            a.alpha1 * a.alpha1 * a.S * a.C * a.s * a.s + a.alpha1 * a.alpha1 * a.S * a.C * a.c * a.c;
        const double theta_printed = theta_defect(&a, 0) - theta_slip;
        CHECK_CLOSE(theta_printed, -a.alpha1 * a.alpha1 * a.S * a.C, roundoff(&a));
        /* printed 5 kappa/(2 eps) for 5/(2 eps): the friction is kappa times too strong */
        const double bracket = a.v_r * a.S * a.C * a.s + a.v_alpha * a.S * a.S;
        const double phi_printed = phi_defect(&a, 0) + 2.5 / a.eps * (a.kappa - 1) * bracket;
        CHECK_CLOSE(phi_printed, 2.5 / a.eps * 0.5 * bracket, roundoff(&a));
        theta_worst = fmax(theta_worst, fabs(theta_printed));
        phi_worst = fmax(phi_worst, fabs(phi_printed));
    }
    CHECK_WITHIN(theta_worst, 0.5, INFINITY);
    CHECK_WITHIN(phi_worst, 5, INFINITY);
    fst_model_free(model);
}

/* The printed equations lack the gyroscopic terms: without these they are not those of a rigid sphere. */
static void test_gyroscopic_terms_are_missing(void **unused)
{
    (void)unused;
    uint64_t seed = 53;
    const fst_params p = bead_at(0.37, FST_DYNAMICS_RIGID);
    fst_model *model = model_of(&p);
    double theta_worst = 0, phi_worst = 0;
    for (int trial = 0; trial < TRIALS; ++trial) {
        const angles a = random_angles(model, &seed);
        theta_worst = fmax(theta_worst, fabs(theta_defect(&a, 0)));
        phi_worst = fmax(phi_worst, fabs(phi_defect(&a, 0)));
    }
    CHECK_WITHIN(theta_worst, 1, INFINITY);
    CHECK_WITHIN(phi_worst, 1, INFINITY);
    fst_model_free(model);
}

/* Eq. (7) with the term psi' n x n' is `rigid`, and without it, as printed, farago2020. */
static void test_nseconde(void **unused)
{
    (void)unused;
    uint64_t seed = 54;
    for (int dynamics = 0; dynamics < 2; ++dynamics) {
        const fst_params p = bead_at(0.37, (fst_dynamics)dynamics);
        fst_model *model = model_of(&p);
        const fst_groups g = fst_model_groups(model);
        for (int trial = 0; trial < TRIALS; ++trial) {
            double y[FST_STATE_SIZE], dy[FST_STATE_SIZE], n1[3], w1[3], n2[3], part[3], b[3], grad[3][3];
            random_state(&seed, y);
            const double *n = y + FST_NX, *w = y + FST_WX;
            fst_rhs(model, y, dy);
            fst_field(model, y[FST_X], y[FST_Y], b, grad);
            lab_rate(y, dy, g.omega, FST_NX, 3, n1);
            lab_rate(y, dy, g.omega, FST_WX, 3, w1);
            cross(w1, n, n2);
            cross(w, n1, part);
            const double slip[3] = {y[FST_VX] - g.eps * w[1], y[FST_VY] + g.eps * w[0], 0}, up[3] = {0, 0, 1};
            double vxe[3], vxexn[3], nxn1[3];
            cross(slip, up, vxe);
            cross(vxe, n, vxexn);
            cross(n, n1, nxn1);
            const double gyroscopic = dynamics == FST_DYNAMICS_RIGID ? dot(w, n) : 0;
            for (int i = 0; i < 3; ++i)
                CHECK_CLOSE(n2[i] + part[i],
                            -dot(n1, n1) * n[i] + gyroscopic * nxn1[i] - 2.5 / g.eps * vxexn[i] +
                                2.5 * g.kappa * (b[i] - n[i] * dot(n, b)),
                            1e-12);
        }
        fst_model_free(model);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_corrected_form_is_the_vector_form),
        cmocka_unit_test(test_printed_slips_are_errors),
        cmocka_unit_test(test_gyroscopic_terms_are_missing),
        cmocka_unit_test(test_nseconde),
    };
    return cmocka_run_group_tests_name("spherical", tests, NULL, NULL);
}
