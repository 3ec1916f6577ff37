/* Exact motions of one bead in a field of the laboratory: it swings, precesses, steps out of a turning field, and locks to
 * a wave.
 * tests: model/surroundings.c beads/look.c beads/flow.c
 * labels: numbers */
#include "surrounded.h"

#define COUNT(array) (sizeof(array) / sizeof *(array))

/* ------------------------------------------------------------------ free beads */

/* A free bead in the middle of two coils whose field turns, with a torque -c_W I W: the lag obeys the equation of a
 * Josephson junction, delta'' + c_W delta' + (kappa b/beta) sin delta = c_W Omega. */
static double mean_rate(double drag, double rate, double from_rate, double until)
{
    fst_params p = in_tesla();
    set(&p, "magnet.shape", "parts");
    set_coils(&p, "80 mm", "100 A");
    for (int i = 0; i < 2; ++i) {
        set_of_coil(&p, i, i ? "axis[1]" : "axis[0]", "1");
        set_of_coil(&p, i, "axis[2]", "0");
    }
    set(&p, "coils[1].phase", "-90 deg");
    fst_model *model = field_model(&p);
    beads_world world = free_beads(1);
    world.surrounded = 1;
    world.around = surroundings_of(model);
    double b[3], change[3];
    fst_gradient_double g;
    fst_surroundings_field(&world.around, 0, (const double[3]){0, 0, 0}, b, &g, change);
    world.body[0].strength = world.body[0].inertia / b[0]; /* kappa b/beta = 1 */
    world.body[0].spin_drag = drag * world.body[0].inertia;
    world.around.loops[0].rate = world.around.loops[1].rate = rate;
    double start[FST_BEAD_NUMBERS] = {0, 0, 0, 0, 0, 0, 1, 0, 0, 0, 0, from_rate};
    beads_flow *flow = begin_beads(&world, start, 1e-9);
    double turned = 0, n[2] = {start[6], start[7]};
    for (double t = 0; t < until; t += 0.25) {
        go_to(flow, t + 0.25);
        const double *now = flow->step.y + BEADS_N;
        if (t >= until / 2)
            turned += atan2(n[0] * now[1] - n[1] * now[0], n[0] * now[0] + n[1] * now[1]);
        n[0] = now[0];
        n[1] = now[1];
    }
    free(flow);
    fst_model_free(model);
    return turned / (until / 2);
}

static void test_step_out(void **unused)
{
    (void)unused;
    /* overdamped, c_W = 50: lock is lost at Oc = 1/c_W, and then the lag grows by sqrt(Omega^2 - Oc^2) */
    const double oc = 1.0 / 50;
    CHECK_CLOSE(mean_rate(50, 0.9 * oc, 0, 2000), 0.9 * oc, 1e-5);
    const double omega = 1.5 * oc;
    CHECK_CLOSE(mean_rate(50, omega, 0, 6 * TURN / sqrt(omega * omega - oc * oc)) / oc, 1.5 - sqrt(1.25), 4e-3);
    /* weakly damped, c_W = 0.1: locked up to Oc = 10; a bead that does not follow is caught only below about 4/pi */
    CHECK_CLOSE(mean_rate(0.1, 1.15, -3, 400), 1.15, 1e-3);
    assert_true(mean_rate(0.1, 1.45, -3, 400) < 1.0);
    CHECK_CLOSE(mean_rate(0.1, 5.0, 5.0, 400), 5.0, 1e-3);
    assert_true(mean_rate(0.1, 10.5, 10.5, 400) < 5.0);
    /* without drag it follows at any rate, and swings about the field */
    CHECK_CLOSE(mean_rate(0, 11, 11.5, 400), 11, 6e-3);
}

/* A free bead in a field that stands still, with kappa b/beta = 1: begin with the moment and the angular velocity. */
static beads_flow *in_uniform_field(fst_model **model, beads_world *world, const double n[3],
                                    const double spin[3])
{
    fst_params p = in_tesla();
    set(&p, "magnet.shape", "parts");
    set(&p, "field.uniform[0]", "1 mT");
    *model = field_model(&p);
    *world = free_beads(1);
    world->surrounded = 1;
    world->around = surroundings_of(*model);
    double b[3], change[3], start[FST_BEAD_NUMBERS] = {0};
    fst_gradient_double g;
    fst_surroundings_field(&world->around, 0, (const double[3]){0, 0, 0}, b, &g, change);
    world->body[0].strength = world->body[0].inertia / b[0];
    memcpy(start + 6, n, 3 * sizeof *n);
    memcpy(start + 9, spin, 3 * sizeof *spin);
    return begin_beads(world, start, 1e-12);
}

/* A compass swings like a pendulum: let go at an angle a it is back after 2 pi/M(1, cos(a/2)), M the arithmetic-geometric
 * mean. */
static void test_compass(void **unused)
{
    (void)unused;
    static const double angles[] = {0.1, 1.5, 3.0};
    for (size_t i = 0; i < COUNT(angles); ++i) {
        const double n[3] = {cos(angles[i]), sin(angles[i]), 0}, still[3] = {0, 0, 0};
        double mean = 1, other = cos(angles[i] / 2);
        for (int k = 0; k < 8; ++k) {
            const double next = (mean + other) / 2;
            other = sqrt(mean * other);
            mean = next;
        }
        fst_model *model;
        beads_world world;
        beads_flow *flow = in_uniform_field(&model, &world, n, still);
        go_to(flow, TURN / mean / 2);
        CHECK_CLOSE(flow->step.y[7], -n[1], 1e-9);
        go_to(flow, TURN / mean);
        CHECK_CLOSE(flow->step.y[7], n[1], 1e-9);
        CHECK_CLOSE(flow->step.y[11], 0, 1e-9);
        free(flow);
        fst_model_free(model);
    }
}

/* Larmor's precession: a sphere that spins by s about its moment, which turns about the field at the rate -1/s, keeps
 * their angle. */
static void test_larmor(void **unused)
{
    (void)unused;
    static const double spins[] = {30, 2, -0.7};
    for (size_t i = 0; i < COUNT(spins); ++i) {
        const double s = spins[i], rate = -1 / s, until = 20, n[3] = {cos(1.1), sin(1.1), 0};
        fst_model *model;
        beads_world world;
        beads_flow *flow = in_uniform_field(&model, &world, n, (const double[3]){s * n[0] + rate, s * n[1], 0});
        go_to(flow, until);
        CHECK_CLOSE(flow->step.y[6], n[0], 1e-9);
        CHECK_CLOSE(flow->step.y[7], n[1] * cos(rate * until), 1e-9);
        CHECK_CLOSE(flow->step.y[8], n[1] * sin(rate * until), 1e-9);
        free(flow);
        fst_model_free(model);
    }
}

/* The moment turns in a vertical plane, as the field of two wide coils does, and the bead rolls along: viscous friction
 * brakes its turning by what the drag holds back, so that the lock is lost at kappa b/(c_v/(1 + c_v) + beta c_W). */
static void test_rolling_step_out(void **unused)
{
    (void)unused;
    const double c_v = 0.5, c_w = 0.1, torque = 0.3;
    const double lost = torque / (c_v / (1 + c_v) + 0.4 * c_w);
    for (int above = 0; above < 2; ++above) {
        const double omega = (above ? 1.03 : 0.97) * lost, lag = asin(fmin(omega / lost, 1));
        fst_params p = in_tesla();
        set(&p, "magnet.shape", "parts");
        set_coils(&p, "9 m", "10000 A");
        set(&p, "coils[0].axis[0]", "1");
        set(&p, "coils[0].axis[2]", "0");
        set(&p, "coils[1].phase", "90 deg"); /* B = b (cos Omega t, 0, -sin Omega t) */
        fst_model *model = field_model(&p);
        beads_world world = free_beads(1);
        const double eps = world.body[0].radius;
        world.plate = 0;
        world.gravity = 1;
        world.surrounded = 1;
        world.around = surroundings_of(model);
        world.around.loops[0].rate = world.around.loops[1].rate = omega;
        double b[3], change[3];
        fst_gradient_double g;
        fst_surroundings_field(&world.around, 0, (const double[3]){0, 0, 0}, b, &g, change);
        world.body[0].strength = torque * eps * eps / b[0];
        world.body[0].drag = c_v;
        world.body[0].spin_drag = c_w * world.body[0].inertia;
        beads_number_contacts(&world, 1.0, 0.0);
        double start[FST_BEAD_NUMBERS] = {0, 0,     0, eps * omega / (1 + c_v), 0, 0, cos(lag), 0, sin(lag),
                                          0, omega, 0};
        beads_flow *flow = begin_beads(&world, start, 1e-10);
        go_to(flow, 100);
        const double half = flow->step.y[0];
        go_to(flow, 200);
        const double speed = (flow->step.y[0] - half) / 100 / (eps * omega / (1 + c_v));
        if (above)
            assert_true(speed < 0.9);
        else
            CHECK_CLOSE(speed, 1, 1e-4); /* the field is less a little away from the middle */
        free(flow);
        fst_model_free(model);
    }
}

/* ------------------------------------------------------------------ waves */

/* The bead rolls along x under a wave of the array below (p) and one above (q). */
typedef struct wave_case {
    double ratio, omega, drag, friction;
    double phi, spin; /* at the start: n = (cos phi, 0, -sin phi), W about y */
} wave_case;

static const double WAVE_KAPPA = 0.05; /* so weak that the weight keeps the bead down */

static beads_flow *wave_flow(const wave_case *c, const fst_model *model, beads_world *world)
{
    *world = surrounded_bead(model);
    beads_number_contacts(world, c->friction, 0);
    world->around.drive.omega = c->omega;
    world->around.backward = c->ratio * world->around.forward;
    world->plate_radius = INFINITY;
    const double eps = world->body[0].radius;
    world->body[0].strength = WAVE_KAPPA * eps * eps;
    world->body[0].drag = c->drag;
    const double start[FST_BEAD_NUMBERS] = {0, 0,       0, eps * c->spin, 0, 0, cos(c->phi), 0, -sin(c->phi),
                                            0, c->spin, 0};
    return begin_beads(world, start, 1e-11);
}

static fst_model *wave_model(void)
{
    fst_params p = in_tesla();
    set(&p, "drive.waveform", "wave");
    set(&p, "wave.length", "60 mm");
    set(&p, "wave.amplitude", "7.3 mT");
    return field_model(&p);
}

/* delta'' = -Om0^2 sin delta - C (delta' - w), by steps of Runge and Kutta; the angle after t. */
static double pendulum(double square, double damping, double w, double delta, double rate, double t)
{
    const int steps = 20000;
    const double h = t / steps;
    for (int i = 0; i < steps; ++i) {
        double d[4], r[4], at = delta, speed = rate;
        for (int k = 0; k < 4; ++k) {
            d[k] = speed;
            r[k] = -square * sin(at) - damping * (speed - w);
            const double part = k == 2 ? h : h / 2;
            at = delta + part * d[k];
            speed = rate + part * r[k];
        }
        delta += h / 6 * (d[0] + 2 * d[1] + 2 * d[2] + d[3]);
        rate += h / 6 * (r[0] + 2 * r[1] + 2 * r[2] + r[3]);
    }
    return delta;
}

/* The lag of a bead that rolls is a pendulum, exactly: what viscous friction lets it slip falls as one over the rate of
 * friction, so that two rates tell its limit. */
static void test_wave_is_a_pendulum(void **unused)
{
    (void)unused;
    fst_model *model = wave_model();
    double lag[3], square = 0, k_eps = 0;
    wave_case c = {.omega = 0.11, .drag = 0.03, .phi = 1.1, .spin = 0.02};
    const double until = 60;
    for (int i = 0; i < 3; ++i) {
        beads_world world;
        c.friction = 40 << i;
        beads_flow *flow = wave_flow(&c, model, &world);
        const double energy = beads_energy_now(flow);
        go_to(flow, until);
        CHECK_CLOSE(beads_residual(flow, energy), 0, 1e-12);
        const double *y = flow->step.y;
        k_eps = world.around.wave_number * world.body[0].radius;
        square = WAVE_KAPPA * (1 - k_eps) * (1 - k_eps) / 1.4;
        lag[i] = atan2(-y[8], y[6]) - (world.around.wave_number * y[0] - c.omega * until);
        free(flow);
    }
    const double exact = pendulum(square, c.drag / 1.4, c.omega, c.phi, c.spin * (1 - k_eps) + c.omega, until);
    for (int i = 0; i < 3; ++i)
        lag[i] = remainder(lag[i] - exact, TURN);
    CHECK_CLOSE(lag[1] / lag[0], 0.5, 0.02);
    /* the error in 1/friction and 1/friction^2 taken away */
    CHECK_CLOSE((8 * lag[2] - 6 * lag[1] + lag[0]) / 3, 0, 1e-6);
    fst_model_free(model);
}

/* The mean of U from half of `until` on, over that of the lock against the wave, -eps w/(1 - k eps). */
static double part_of_lock(const wave_case *c, const fst_model *model, double until)
{
    beads_world world;
    beads_flow *flow = wave_flow(c, model, &world);
    go_to(flow, until / 2);
    const double half = flow->step.y[0];
    go_to(flow, until);
    const double eps = world.body[0].radius, k = world.around.wave_number;
    const double speed = (flow->step.y[0] - half) / (until / 2);
    free(flow);
    return speed / (-eps * c->omega / (1 - k * eps));
}

static void test_wave_thresholds(void **unused)
{
    (void)unused;
    fst_model *model = wave_model();
    const double k_eps = TURN / 60e-3 * 2.5e-3, om0 = sqrt(WAVE_KAPPA / 1.4) * (1 - k_eps);
    const double damping = 0.15 * om0, lost = om0 * om0 / damping;
    const double slip = 4e-3; /* that balances the drag */
    wave_case c = {.drag = 1.4 * damping, .friction = 20};
    /* without drag the friction of the contact pulls the bead into the lock */
    const wave_case pulled = {.omega = 0.1, .friction = 1, .phi = 2.0};
    CHECK_CLOSE(part_of_lock(&pulled, model, 6000), 1, 1e-3);
    /* a bead that does not follow is caught below about 4/pi of Om0, and not above */
    c.spin = 0.5;
    c.omega = 1.1 * om0;
    CHECK_CLOSE(part_of_lock(&c, model, 1500), 1, slip);
    c.omega = 1.5 * om0;
    assert_true(part_of_lock(&c, model, 1500) < 0.5);
    /* a bead in the lock stays in it up to w_c = Om0^2/C */
    for (int above = 0; above < 2; ++above) {
        c.omega = (above ? 1.06 : 0.94) * lost;
        c.spin = -c.omega / (1 - k_eps);
        c.phi = asin(fmin(c.omega / lost, 1.0));
        const double part = part_of_lock(&c, model, 1500);
        if (above)
            assert_true(part < 0.5);
        else
            CHECK_CLOSE(part, 1, slip);
    }
    fst_model_free(model);
}

/* The field of an array above turns the other way, and drives the bead along with the wave: U = eps w/(1 + k eps). */
static void test_forward_lock(void **unused)
{
    (void)unused;
    fst_model *model = wave_model();
    const double k_eps = TURN / 60e-3 * 2.5e-3, om0 = sqrt(WAVE_KAPPA / 1.4) * (1 + k_eps);
    wave_case c = {.ratio = 1.0, .omega = 4 * om0, .friction = 20};
    c.spin = c.omega / (1 + k_eps);
    CHECK_CLOSE(part_of_lock(&c, model, 600), -(1 - k_eps) / (1 + k_eps), 2e-3);
    /* the two locks leave each other alone where their widths do not overlap, by Chirikov's rule; well below, it is lost */
    for (int overlap = 0; overlap < 2; ++overlap) {
        c.omega = (overlap ? 0.3 : 1.1) * (1 - k_eps * k_eps) * 2 * sqrt(WAVE_KAPPA / 1.4);
        c.spin = c.omega / (1 + k_eps);
        const double part = part_of_lock(&c, model, 1500) * -(1 + k_eps) / (1 - k_eps);
        if (overlap)
            assert_true(part < 0.5);
        else
            CHECK_CLOSE(part, 1, 2e-3);
    }
    fst_model_free(model);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_step_out),
        cmocka_unit_test(test_compass),
        cmocka_unit_test(test_larmor),
        cmocka_unit_test(test_rolling_step_out),
        cmocka_unit_test(test_wave_is_a_pendulum),
        cmocka_unit_test(test_wave_thresholds),
        cmocka_unit_test(test_forward_lock),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
