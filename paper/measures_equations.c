/* measures_equations.c - the paper's printed equations of motion, tested on the motions that were computed. */
#include "paper/measures_parts.h"

enum { STRIDE = 16 }; /* samples of a trajectory from one test to the next */

/* The squares of an equation's error and of its left side, summed over a motion. */
typedef struct leftover {
    double off, all;
} leftover;

static void add(leftover *sum, double left, double right)
{
    sum->off += (left - right) * (left - right);
    sum->all += left * left;
}

static double share(leftover sum)
{
    return sqrt(sum.off / sum.all);
}

static void state_at(const fst_table *table, size_t row, double y[FST_STATE_SIZE])
{
    static const char *const names[FST_STATE_SIZE] = {"X", "Y", "vX", "vY", "nX", "nY", "nZ", "WX", "WY", "WZ"};
    for (int i = 0; i < FST_STATE_SIZE; ++i)
        y[i] = fst_collected(table, names[i])[row];
}

/* The rate of change of a vector of the state in the laboratory, in components along the turning axes. */
static void laboratory_rate(const double *y, const double *rates, double omega, int first, int size,
                            double rate[3])
{
    rate[0] = rates[first] - omega * y[first + 1];
    rate[1] = rates[first + 1] + omega * y[first];
    rate[2] = size == 3 ? rates[first + 2] : 0.0;
}

static void cross(const double a[3], const double b[3], double out[3])
{
    out[0] = a[1] * b[2] - a[2] * b[1];
    out[1] = a[2] * b[0] - a[0] * b[2];
    out[2] = a[0] * b[1] - a[1] * b[0];
}

static double dot(const double a[3], const double b[3])
{
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

/* ------------------------------------------------------------------ section IV */

/* The errors of the equations of section IV along a motion. */
typedef struct section_iv {
    leftover centre;  /* Eqs. (9), (10) */
    leftover printed; /* Eqs. (7), (8), for n and psi */
    leftover euler;   /* Euler's equation for W, which the paper does not print */
} section_iv;

/* n'' as Eq. (7) prints it, less the computed one, and psi'' by Eq. (8).  `axis` is V x e. */
static void printed_turning(const fst_groups *g, const double *y, const double n1[3], const double w1[3],
                            const double b[3], const double slip[2], leftover *sum)
{
    const double *n = y + FST_NX, axis[3] = {slip[1], -slip[0], 0.0};
    double friction[3], n2[3], turned[3];
    cross(axis, n, friction);
    cross(w1, n, n2); /* n'' = W' x n + W x n' */
    cross(y + FST_WX, n1, turned);
    for (int i = 0; i < 3; ++i)
        add(sum, n2[i] + turned[i],
            -dot(n1, n1) * n[i] - 2.5 / g->eps * friction[i] + 2.5 * g->kappa * (b[i] - n[i] * dot(n, b)));
    /* V.(e x n), and psi' = W.n */
    add(sum, dot(w1, n) + dot(y + FST_WX, n1), -2.5 / g->eps * (slip[1] * n[0] - slip[0] * n[1]));
}

/* Forces and torques computed here directly, to compare with the accelerations of the dynamics. */
static void newton_and_euler(const fst_model *model, const double y[FST_STATE_SIZE], section_iv *sums)
{
    const fst_groups g = fst_model_groups(model);
    double rates[FST_STATE_SIZE], b[3], grad[3][3], v_rate[3], n_rate[3], w_rate[3], n_cross_b[3];
    fst_rhs(model, y, rates);
    fst_field(model, y[FST_X], y[FST_Y], b, grad);
    laboratory_rate(y, rates, g.omega, FST_VX, 2, v_rate);
    laboratory_rate(y, rates, g.omega, FST_NX, 3, n_rate);
    laboratory_rate(y, rates, g.omega, FST_WX, 3, w_rate);
    cross(y + FST_NX, b, n_cross_b);
    double slip[2];
    fst_slip(model, y, slip);
    const double friction[3] = {-slip[1], slip[0], 0.0}; /* e x V */
    for (int i = 0; i < 2; ++i) {
        double pull = y[FST_NX] * grad[0][i] + y[FST_NY] * grad[1][i] + y[FST_NZ] * grad[2][i];
        add(&sums->centre, g.kappa * g.eps * g.eps * pull - slip[i], v_rate[i]);
    }
    for (int i = 0; i < 3; ++i)
        add(&sums->euler, w_rate[i], 2.5 * (g.kappa * n_cross_b[i] + friction[i] / g.eps));
    printed_turning(&g, y, n_rate, w_rate, b, slip, &sums->printed);
}

static section_iv along_path(const fst_measuring *m)
{
    const fst_paper_run *run = run_of(m, FST_SCAN_FOLD15);
    fst_model *model = NULL;
    section_iv sums = {{0.0, 0.0}, {0.0, 0.0}, {0.0, 0.0}};
    if (fst_model_new(&run->params, &model, NULL) != FST_OK)
        return sums;
    for (size_t row = 0; row < run->trajectory.rows; row += STRIDE) {
        double y[FST_STATE_SIZE];
        state_at(&run->trajectory, row, y);
        newton_and_euler(model, y, &sums);
    }
    fst_model_free(model);
    return sums;
}

VISCOUS(centre_equations, FOLD15, share(along_path(m).centre), "%s", "");

VISCOUS(turning_equations, FOLD15, share(along_path(m).printed),
        "root mean square along the motion at the drive 0.4. A bead has ψ′ n × n′ on the right of Eq. (7) as "
        "well: ψ′ is not a rate of a coordinate, so that Lagrange's equations for n and ψ are not enough");

VISCOUS(euler_equation, FOLD15, share(along_path(m).euler), "the same motion");

/* ------------------------------------------------------------------ the appendix */

/* The angles of the appendix with their rates: n = cos(theta) e_r + sin(theta) (sin(phi) e_alpha - cos(phi)
 * e_z). */
typedef struct angles {
    double S, C, s, c; /* sines and cosines of theta and phi */
    double theta1, phi1, alpha1, psi1;
    double theta2, phi2, alpha2, psi2;
} angles;

/* Components along e_r, e_alpha, e_z. */
static void to_local(const double *y, const double u[3], double out[3])
{
    double r = hypot(y[FST_X], y[FST_Y]), c = y[FST_X] / r, s = y[FST_Y] / r;
    out[0] = u[0] * c + u[1] * s;
    out[1] = u[1] * c - u[0] * s;
    out[2] = u[2];
}

/* First and second rates of the local components of n, whose axes turn at alpha'. */
static void local_rates(const angles *a, const double n[3], const double n1[3], const double n2[3],
                        double u1[3], double u2[3])
{
    double w = a->alpha1;
    u1[0] = n1[0] + w * n[1];
    u1[1] = n1[1] - w * n[0];
    u1[2] = n1[2];
    u2[0] = n2[0] + a->alpha2 * n[1] + 2.0 * w * u1[1] + w * w * n[0];
    u2[1] = n2[1] - a->alpha2 * n[0] - 2.0 * w * u1[0] + w * w * n[1];
    u2[2] = n2[2];
}

static angles read_angles(const fst_model *model, const double y[FST_STATE_SIZE], const fst_observation *seen)
{
    double rates[FST_STATE_SIZE], v1[3], n1[3], w1[3], n2[3], turned[3];
    double v[3], a_local[3], n1_local[3], n2_local[3], u1[3], u2[3], omega = fst_model_groups(model).omega;
    const double velocity[3] = {y[FST_VX], y[FST_VY], 0.0};
    fst_rhs(model, y, rates);
    laboratory_rate(y, rates, omega, FST_VX, 2, v1);
    laboratory_rate(y, rates, omega, FST_NX, 3, n1);
    laboratory_rate(y, rates, omega, FST_WX, 3, w1);
    cross(w1, y + FST_NX, n2); /* n'' = W' x n + W x n' */
    cross(y + FST_WX, n1, turned);
    for (int i = 0; i < 3; ++i)
        n2[i] += turned[i];
    to_local(y, velocity, v);
    to_local(y, v1, a_local);
    to_local(y, n1, n1_local);
    to_local(y, n2, n2_local);
    angles a = {.alpha1 = v[1] / seen->r, .psi1 = seen->spin};
    a.alpha2 = (a_local[1] - 2.0 * v[0] * a.alpha1) / seen->r;
    local_rates(&a, seen->n, n1_local, n2_local, u1, u2);
    double p = seen->n[1], q = -seen->n[2], sine2 = p * p + q * q;
    a.C = seen->n[0];
    a.S = sqrt(sine2);
    a.s = p / a.S;
    a.c = q / a.S;
    a.theta1 = -u1[0] / a.S;
    a.theta2 = -(u2[0] + a.C * a.theta1 * a.theta1) / a.S;
    a.phi1 = (q * u1[1] + p * u1[2]) / sine2;
    a.phi2 = (q * u2[1] + p * u2[2]) / sine2 - 2.0 * a.phi1 * (p * u1[1] - q * u1[2]) / sine2;
    a.psi2 = dot(w1, y + FST_NX) + dot(y + FST_WX, n1);
    return a;
}

/* The appendix's equations, each as it is printed. */
typedef enum { SLIP, THETA, PHI, PSI, EQUATION_COUNT } equation;

static void put_appendix(const angles *a, const fst_observation *seen, const fst_groups *g, double r_dot,
                         leftover sums[EQUATION_COUNT])
{
    double S = a->S, C = a->C, s = a->s, c = a->c, w = a->alpha1, V_r = seen->slip[0], V_a = seen->slip[1];
    const double *B = seen->b;
    add(&sums[SLIP], V_r,
        r_dot - g->eps * (a->theta1 * c + w * S * S * s * c - a->phi1 * S * C * s + a->psi1 * S * s));
    add(&sums[SLIP], V_a, seen->r * w + g->eps * (a->phi1 * S * S + w * S * C * c + a->psi1 * C));
    add(&sums[THETA], a->theta2 + a->alpha2 * s + w * c * a->phi1,
        a->phi1 * a->phi1 * S * C + w * w * S * C * s * s + w * a->phi1 * (C * C - S * S) * c +
            2.5 * g->kappa * (-S * B[0] + C * s * B[1] - C * c * B[2]) + 2.5 / g->eps * V_r * c);
    add(&sums[PHI],
        a->phi2 * S * S + 2.0 * a->phi1 * S * C * a->theta1 + a->alpha2 * S * C * c +
            w * ((C * C - S * S) * a->theta1 * c - S * C * s * a->phi1),
        w * w * S * S * s * c + w * a->theta1 * c - w * a->phi1 * S * C * s +
            2.5 * g->kappa * S * (c * B[1] + s * B[2]) -
            2.5 * g->kappa / g->eps * (V_r * S * C * s + V_a * S * S));
    add(&sums[PSI], a->psi2, 2.5 / g->eps * (V_r * S * s - V_a * C));
}

/* The error of the equation along the motion at the drive 0.215. */
static double appendix(const fst_measuring *m, const fst_model *model, equation which)
{
    static const double POLE = 0.95; /* where |n_r| is greater the angles lose their meaning */
    const fst_paper_run *run = run_of(m, FST_SCAN_FOLD4);
    leftover sums[EQUATION_COUNT] = {{0.0, 0.0}};
    if (which != SLIP && !fst_measure_is_viscous(m, run))
        return NAN;
    const fst_groups g = fst_model_groups(model);
    for (size_t row = 0; row < run->trajectory.rows; row += STRIDE) {
        double y[FST_STATE_SIZE];
        state_at(&run->trajectory, row, y);
        const fst_observation seen = fst_observe(model, y);
        if (fabs(seen.n[0]) > POLE)
            continue;
        const angles a = read_angles(model, y, &seen);
        put_appendix(&a, &seen, &g, (y[FST_X] * y[FST_VX] + y[FST_Y] * y[FST_VY]) / seen.r, sums);
    }
    return share(sums[which]);
}

MEASURE_IN(appendix_slip, FOLD4)
{
    return appendix(m, model, SLIP);
}

MEASURE_IN(appendix_theta, FOLD4)
{
    NOTE("the printed + α′² sin θ cos θ sin² φ should read − α′² sin θ cos θ cos² φ, and the gyroscopic term "
         "is missing");
    return appendix(m, model, THETA);
}

MEASURE_IN(appendix_phi, FOLD4)
{
    NOTE("the printed factor 5κ/(2ε) of the friction should read 5/(2ε), and the gyroscopic term is missing");
    return appendix(m, model, PHI);
}

MEASURE_IN(appendix_psi, FOLD4)
{
    return appendix(m, model, PSI);
}

/* ------------------------------------------------------------------ section VI */

/* Eq. (13) with theta = pi/2 and the phi of the motion: its magnetic mean over r <V_alpha>. */
MEASURE_IN(second_balance, FOLD15)
{
    const fst_paper_run *run = run_of(m, FST_SCAN_FOLD15);
    const fst_table *table = &run->trajectory;
    const fst_groups g = fst_model_groups(model);
    double sum = 0.0;
    if (!fst_measure_is_viscous(m, run))
        return NAN;
    for (size_t row = 0; row < table->rows; ++row) {
        double b[3], grad[3][3], y[FST_STATE_SIZE];
        state_at(table, row, y);
        const fst_observation seen = fst_observe(model, y);
        double c = seen.cos_bead_angle, s = seen.sin_bead_angle, size_n = hypot(seen.n[1], seen.n[2]);
        /* n without its radial part, in the turning frame, and the change of the field along the circle. */
        const double n[3] = {-s * seen.n[1] / size_n, c * seen.n[1] / size_n, seen.n[2] / size_n};
        fst_field(model, y[FST_X], y[FST_Y], b, grad);
        for (int k = 0; k < 3; ++k)
            sum += n[k] * seen.r * (grad[k][1] * c - grad[k][0] * s);
    }
    const double printed = g.kappa * g.eps * g.eps * sum / (double)table->rows;
    const double friction = run->result.mean_r * run->result.mean_v_alpha;
    NOTE("magnetic %+.2e with θ = π/2, %+.2e exactly; r⟨V_α⟩ = %+.2e, ⟨rV_α⟩ = %+.2e", printed,
         run->result.eq22_magnetic, friction, -run->result.eq22_friction);
    return 100.0 * fabs(printed / friction - 1.0);
}
