/* One bead in fields that stand still, travel or turn as they like (model/surroundings.c), in both frames.
 * tests: model/surroundings.c model/waveform.c beads/look.c beads/flow.c beads/world.c */
#include "surrounded.h"

#include "model/drive.h"

#define COUNT(array) (sizeof(array) / sizeof *(array))
static const double DEGREE = TURN / 360;

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

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_derivatives),  cmocka_unit_test(test_known_fields),
        cmocka_unit_test(test_frames_agree), cmocka_unit_test(test_energy),
        cmocka_unit_test(test_incline),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
