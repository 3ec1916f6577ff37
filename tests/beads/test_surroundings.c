/* One bead in fields that stand still, travel or turn as they like (model/surroundings.c), in both frames.
 * tests: model/surroundings.c model/waveform.c beads/look.c beads/flow.c beads/world.c */
#include <stdio.h>

#include "some_beads.h"

#include "model/drive.h"

#define COUNT(array) (sizeof(array) / sizeof *(array))
static const double DEGREE = TURN / 360;

static void set(fst_params *p, const char *key, const char *text)
{
    fst_error error = {FST_OK, "", ""};
    if (fst_params_set(p, key, text, &error) != FST_OK)
        fail_msg("%s", error.sentence);
}

static void set_of_coil(fst_params *p, int coil, const char *what, const char *text)
{
    char key[40];
    (void)snprintf(key, sizeof key, "coils[%d].%s", coil, what);
    set(p, key, text);
}

/* Two coils with a current of 1 Hz. */
static void set_coils(fst_params *p, const char *radius, const char *current)
{
    for (int i = 0; i < 2; ++i) {
        set_of_coil(p, i, "radius", radius);
        set_of_coil(p, i, "ac", current);
        set_of_coil(p, i, "frequency", "1 Hz");
    }
}

static fst_model *field_model(const fst_params *p)
{
    fst_model *model;
    fst_error error = {FST_OK, "", ""};
    if (fst_field_model_new(p, NAN, &model, &error) != FST_OK)
        fail_msg("%s", error.sentence);
    return model;
}

static fst_surroundings surroundings_of(const fst_model *model)
{
    fst_surroundings s;
    fst_error error = {FST_OK, "", ""};
    if (fst_make_surroundings(model, &s, &error) != FST_OK)
        fail_msg("%s", error.sentence);
    return s;
}

/* The paper's bead with everything around it. */
static beads_world surrounded_bead(const fst_model *model)
{
    beads_world world = paper_beads(1, model, 0);
    world.surrounded = 1;
    world.around = surroundings_of(model);
    return world;
}

static fst_params in_tesla(void)
{
    fst_params p = fst_default_params();
    set(&p, "magnet.b0", "7.3 mT");
    return p;
}

/* Everything that makes a field. */
static fst_params everything(void)
{
    fst_params p = fst_default_params();
    set(&p, "magnet.shape", "parts");
    set(&p, "magnet.parts[0].kind", "cuboid");
    set(&p, "magnet.parts[0].size[0]", "50 mm");
    set(&p, "magnet.parts[0].size[1]", "20 mm");
    set(&p, "magnet.parts[0].size[2]", "8 mm");
    set(&p, "magnet.parts[0].remanence[0]", "0.4 T");
    set(&p, "magnet.parts[1].kind", "dipole");
    set(&p, "magnet.parts[1].centre[0]", "-30 mm");
    set(&p, "magnet.parts[1].moment[1]", "0.3 A m^2");
    set(&p, "magnet.parts[1].motion", "fixed");
    set(&p, "field.uniform[0]", "50 uT");
    set(&p, "field.uniform[2]", "-1 mT");
    set(&p, "coils[0].radius", "40 mm");
    set(&p, "coils[0].centre[1]", "10 mm");
    set(&p, "coils[0].axis[0]", "1");
    set(&p, "coils[0].axis[1]", "0.4");
    set(&p, "coils[0].turns", "200");
    set(&p, "coils[0].current", "1.5 A");
    set(&p, "coils[0].ac", "1 A");
    set(&p, "coils[0].frequency", "7 Hz");
    set(&p, "coils[0].phase", "30 deg");
    return p;
}

/* ------------------------------------------------------------------ fields */

/* G and dB/dt are the derivatives of B, which is free of divergence and curl, at any time. */
static void check_derivatives(const fst_surroundings *s, double t)
{
    const double x[3] = {0.6, -0.35, 0.83}, d = 2e-3;
    static const double weights[] = {4.0 / 5, -1.0 / 5, 4.0 / 105, -1.0 / 280};
    double b[3], change[3], unused[3], slope[4][3] = {{0}};
    fst_gradient_double g, other;
    fst_surroundings_field(s, t, x, b, &g, change);
    for (int axis = 0; axis < 4; ++axis)
        for (int k = 1; k <= 4; ++k)
            for (int sign = -1; sign <= 1; sign += 2) {
                double at[3] = {x[0], x[1], x[2]}, when = t, there[3];
                *(axis < 3 ? &at[axis] : &when) += sign * k * d;
                fst_surroundings_field(s, when, at, there, &other, unused);
                for (int i = 0; i < 3; ++i)
                    slope[axis][i] += sign * weights[k - 1] * there[i] / d;
            }
    const double all[3][3] = {{g.xx, g.yx, g.xz}, {g.xy, g.yy, g.yz}, {g.xz, g.yz, -(g.xx + g.yy)}};
    for (int i = 0; i < 3; ++i) {
        CHECK_CLOSE(slope[3][i], change[i], 2e-11);
        for (int axis = 0; axis < 3; ++axis)
            CHECK_CLOSE(slope[axis][i], all[axis][i], 2e-11);
    }
    CHECK_CLOSE(g.xy, g.yx, 1e-13);
}

static void test_derivatives(void **unused)
{
    (void)unused;
    static const char *const drives[] = {"steady", "oscillating", "chirp", "table", "carried"};
    for (size_t i = 0; i < COUNT(drives); ++i) {
        fst_params p = everything();
        set(&p, "drive.waveform", drives[i]);
        set(&p, "drive.chirp", "30");
        set(&p, "drive.table", "0:0 0.05:200 0.2:90");
        set(&p, "drive.velocity[0]", "200 mm/s");
        set(&p, "drive.velocity[1]", "-70 mm/s");
        set(&p, "drive.velocity[2]", "10 mm/s");
        fst_model *model = field_model(&p);
        const fst_surroundings s = surroundings_of(model);
        assert_int_equal(s.laboratory, 1);
        check_derivatives(&s, 0.3);
        check_derivatives(&s, 11.7);
        fst_model_free(model);
    }
    fst_params p = in_tesla();
    set(&p, "drive.waveform", "wave");
    set(&p, "wave.length", "60 mm");
    set(&p, "wave.amplitude", "7.3 mT");
    set(&p, "wave.ratio", "0.3");
    fst_model *model = field_model(&p);
    const fst_surroundings s = surroundings_of(model);
    check_derivatives(&s, 3.1);
    double b[3], change[3];
    fst_gradient_double g;
    fst_surroundings_field(&s, 0.0, (const double[3]){0, 0, fst_model_groups(model).h}, b, &g, change);
    CHECK_CLOSE(b[0], 1.3, 1e-14);
    fst_model_free(model);
}

/* A coil on the axis: mu_0 N I/(2 a) in its centre. A cylinder that stands still and one that does not turn agree. */
static void test_known_fields(void **unused)
{
    (void)unused;
    fst_params p = in_tesla();
    set(&p, "magnet.shape", "parts");
    set(&p, "coils[0].radius", "50 mm");
    set(&p, "coils[0].turns", "100");
    set(&p, "coils[0].current", "2 A");
    set(&p, "coils[0].axis[0]", "3");
    set(&p, "coils[0].axis[1]", "-4");
    set(&p, "coils[0].axis[2]", "0");
    fst_model *model = field_model(&p);
    const fst_surroundings s = surroundings_of(model);
    double b[3], change[3];
    fst_gradient_double g;
    fst_surroundings_field(&s, 1.0, (const double[3]){0, 0, 0}, b, &g, change);
    const double centre = FST_MU_0 * 200 / 0.1 / 7.3e-3;
    CHECK_CLOSE(b[0], 0.6 * centre, 1e-15);
    CHECK_CLOSE(b[1], -0.8 * centre, 1e-15);
    CHECK_CLOSE(b[2], 0, 1e-15);
    fst_model_free(model);
}

/* ------------------------------------------------------------------ frames and energy */

/* The state of one bead on the laboratory's axes. */
static void to_laboratory(const beads_world *world, double t, const double *y, double out[FST_BEAD_NUMBERS])
{
    const double angle = world->around.laboratory ? 0.0 : fst_waveform_angle(&world->around.drive, t);
    for (int v = 0; v < 4; ++v)
        fst_drive_to_laboratory(angle / TURN, y + 3 * v, out + 3 * v);
}

/* Both frames tell the same motion, for every waveform that both serve; and without surroundings it is the same too. */
static void test_frames_agree(void **unused)
{
    (void)unused;
    static const char *const drives[] = {"steady", "oscillating", "chirp", "table"};
    for (size_t i = 0; i < COUNT(drives); ++i) {
        double told[2][FST_BEAD_NUMBERS], start[FST_BEAD_NUMBERS];
        for (int laboratory = 0; laboratory < 2; ++laboratory) {
            fst_params p = in_tesla();
            set(&p, "drive.frequency", "12");
            set(&p, "drive.waveform", drives[i]);
            set(&p, "drive.amplitude", "70");
            set(&p, "drive.chirp", "20");
            set(&p, "drive.table", "0:0 0.06:250 0.09:250 0.4:-100");
            set(&p, "field.uniform[2]", "0.4 mT");
            fst_model *of_start = field_model(&p);
            place_bead(p, of_start, 40, start);
            set(&p, "world.frame", laboratory ? "laboratory" : "turning");
            beads_world world = surrounded_bead(of_start);
            world.around.laboratory = laboratory;
            beads_flow *flow = begin_beads(&world, start, 1e-13);
            const double energy = beads_energy_now(flow);
            go_to(flow, 60);
            to_laboratory(&flow->world, 60, flow->step.y, told[laboratory]);
            CHECK_CLOSE(beads_residual(flow, energy), 0, 1e-12);
            free(flow);
            fst_model_free(of_start);
        }
        CHECK_CLOSE(greatest_difference(told[0], told[1], FST_BEAD_NUMBERS), 0, 1e-11);
    }
}

/* The power of everything that changes keeps the balance, also of a magnet that is carried and of parts that stand. */
static void test_energy(void **unused)
{
    (void)unused;
    static const char *const drives[] = {"steady", "oscillating", "carried"};
    for (size_t i = 0; i < COUNT(drives); ++i) {
        fst_params p = everything();
        set(&p, "drive.waveform", drives[i]);
        set(&p, "drive.velocity[0]", "20 mm/s");
        fst_model *model = field_model(&p);
        beads_world world = surrounded_bead(model);
        double start[FST_BEAD_NUMBERS] = {0.5, 0.3, 0, 0, 0, 0, 0.6, 0, 0.8, 0, 0, 0};
        beads_flow *flow = begin_beads(&world, start, 1e-12);
        const double energy = beads_energy_now(flow);
        go_to(flow, 30);
        const double work = flow->step.y[FST_BEAD_NUMBERS + BEADS_DRIVE];
        assert_true(fabs(work) > 1e-3);
        CHECK_CLOSE(beads_residual(flow, energy) / work, 0, 1e-10);
        free(flow);
        fst_model_free(model);
    }
}

/* ------------------------------------------------------------------ facts */

/* On an incline a bead without magnet rolls with g sin b/(M + beta): viscous friction lets it slip a little at first,
 * and the slip keeps the value at which friction gives W its growth. */
static void test_incline(void **unused)
{
    (void)unused;
    fst_params p = in_tesla();
    fst_model *model = field_model(&p);
    beads_world world = paper_beads(1, model, 0);
    const double g = world.gravity, tilt = 5 * DEGREE;
    world.field = NULL;
    world.omega = 0;
    world.body[0].added = 0.3;
    world.plate_radius = INFINITY;
    world.gravity = g * cos(tilt);
    world.sideways[0] = g * sin(tilt) * cos(1.0);
    world.sideways[1] = g * sin(tilt) * sin(1.0);
    beads_number_contacts(&world, 1.0, 0.0);
    double start[FST_BEAD_NUMBERS] = {0, 0, 0, 0, 0, 0, 1, 0, 0, 0, 0, 0};
    beads_flow *flow = begin_beads(&world, start, 1e-13);
    const double energy = beads_energy_now(flow);
    go_to(flow, 40);
    const double v0 = hypot(flow->step.y[3], flow->step.y[4]);
    go_to(flow, 50);
    const double rate = (hypot(flow->step.y[3], flow->step.y[4]) - v0) / 10;
    CHECK_CLOSE(rate / (g * sin(tilt) / (1.3 + 0.4)), 1, 1e-11);
    CHECK_CLOSE(atan2(flow->step.y[1], flow->step.y[0]), 1.0, 1e-12);
    CHECK_CLOSE(beads_residual(flow, energy), 0, 1e-12);
    free(flow);
    fst_model_free(model);
}

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
        cmocka_unit_test(test_derivatives),      cmocka_unit_test(test_known_fields),
        cmocka_unit_test(test_frames_agree),     cmocka_unit_test(test_energy),
        cmocka_unit_test(test_incline),          cmocka_unit_test(test_step_out),
        cmocka_unit_test(test_rolling_step_out), cmocka_unit_test(test_wave_is_a_pendulum),
        cmocka_unit_test(test_wave_thresholds),  cmocka_unit_test(test_forward_lock),
        cmocka_unit_test(test_compass),          cmocka_unit_test(test_larmor),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
