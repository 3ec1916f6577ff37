/* surroundings.c - the fields of a world, at any time.
 *
 * The magnet has turned by Phi and been carried to p: its source is asked at the place turned back, R(-Phi)(x - p), and
 * B and G are turned forward.  At a place that stands still the field changes by
 *
 *     dB/dt = Phi' [e x B - G (e x (x - p))] - G p'.
 *
 * The wave is that of an array of magnets under the plate (p) and one above it (q), th = k x - omega t:
 *
 *     B = p exp(-k (z - z0)) (cos th, 0, -sin th) + q exp(k (z - z0)) (cos th, 0, sin th).
 */
#include "model/surroundings.h"

#include <math.h>
#include <string.h>

#include "base/error.h"
#include "model/params.h"
#include "model/worlds.h"

/* ------------------------------------------------------------------ from parameters */

/* A component of a vector of the scene. */
static double given(double component)
{
    return isnan(component) ? 0.0 : component;
}

static fst_status check_tesla(const fst_params *p, const fst_groups *g, fst_error *error)
{
    const int wave = p->drive_waveform == FST_WAVEFORM_WAVE;
    const double *even = p->field_uniform;
    const int asked =
        given(even[0]) != 0 || given(even[1]) != 0 || given(even[2]) != 0 || p->coil_count || wave;
    if (wave && (isnan(p->wave_length) || isnan(p->wave_amplitude)))
        return fst_fail(error, FST_BAD_INPUT, "drive.waveform",
                        "drive.waveform: wave needs wave.length and wave.amplitude");
    if (asked && isnan(g->field_unit))
        return fst_fail(
            error, FST_BAD_INPUT, "magnet.b0",
            "field.uniform, coils and wave.amplitude are told in tesla and ampere, and nothing tells B0 in "
            "tesla: give magnet.b0, or bead.moment");
    return FST_OK;
}

static fst_loop make_loop(const fst_coil *coil, const fst_groups *g)
{
    const double l = g->length_unit, *axis = coil->axis, across = hypot(axis[0], axis[1]);
    fst_loop loop;
    memset(&loop, 0, sizeof loop);
    for (int i = 0; i < 3; ++i)
        loop.part.centre[i] = coil->centre[i] / l;
    loop.part.half[0] = loop.part.half[1] = coil->radius / l;
    loop.part.j[2] = FST_MU_0 / (4.0 * FST_PI * l * g->field_unit) * coil->turns;
    /* about the horizontal axis e_z x axis, from e_z to the coil's axis */
    const double turn[4] = {atan2(across, axis[2]) / FST_TWO_PI * 360.0, across > 0 ? -axis[1] : 1.0, axis[0],
                            0.0};
    loop.turned = turn[0] != 0;
    fst_set_axes_double(turn, loop.part.axes);
    loop.current = coil->current;
    loop.ac = coil->ac;
    loop.rate = FST_TWO_PI * coil->frequency * g->time_unit;
    loop.phase = coil->phase / 360.0 * FST_TWO_PI;
    return loop;
}

static void make_fixed(const fst_params *p, const fst_groups *g, fst_surroundings *s)
{
    fst_params fixed = *p;
    fixed.magnet_part_count = 0;
    for (int i = 0; i < p->magnet_part_count && p->magnet_shape == FST_MAGNET_PARTS; ++i)
        if (p->magnet_parts[i].motion == FST_PART_FIXED)
            fixed.magnet_parts[fixed.magnet_part_count++] = p->magnet_parts[i];
    s->fixed_kinds.source = FST_MAGNET_PARTS;
    fixed.magnet_shape = FST_MAGNET_PARTS;
    fst_count_pieces(&s->fixed_kinds, &fixed, g);
    s->fixed = fst_make_parts_double(&fixed, g);
}

fst_status fst_make_surroundings(const fst_model *model, fst_surroundings *s, fst_error *error)
{
    const fst_params *p = &model->params;
    const fst_groups *g = &model->groups;
    const char *still = fst_stands_still(p);
    memset(s, 0, sizeof *s);
    fst_status status = check_tesla(p, g, error);
    if (status == FST_OK)
        status = fst_make_waveform(p, g, &s->drive, error);
    if (status != FST_OK)
        return status;
    if (still && p->world_frame == FST_FRAME_TURNING)
        return fst_fail(
            error, FST_BAD_INPUT, "world.frame",
            "world.frame: turning is not a frame in which %s stays what it is: choose laboratory, or auto",
            still);
    s->model = model;
    s->laboratory = fst_frame_of_world(p) == FST_FRAME_LABORATORY;
    make_fixed(p, g, s);
    for (int i = 0; i < 3; ++i)
        s->uniform[i] = given(p->field_uniform[i]) != 0 ? p->field_uniform[i] / g->field_unit : 0.0;
    s->loop_count = p->coil_count;
    for (int i = 0; i < p->coil_count; ++i)
        s->loops[i] = make_loop(&p->coils[i], g);
    if (s->drive.kind == FST_WAVEFORM_WAVE) {
        s->wave_number = FST_TWO_PI * g->length_unit / p->wave_length;
        s->forward = p->wave_amplitude / g->field_unit; /* p: of the array under the plate */
        s->backward = p->wave_ratio * s->forward;
        s->wave_height = fst_bead_height(p); /* also of a model that is asked at another height */
    }
    return FST_OK;
}

/* ------------------------------------------------------------------ fields */

static void add_field(const double of[3], const fst_gradient_double *og, double b[3], fst_gradient_double *g)
{
    for (int k = 0; k < 3; ++k)
        b[k] += of[k];
    fst_add_gradient_double(g, og);
    g->yx += og->yx;
}

/* G about the vertical axis, by the cosine and sine of the angle. */
static fst_gradient_double turn_gradient(const fst_gradient_double *o, double c, double s)
{
    fst_gradient_double g;
    g.xx = c * c * o->xx - c * s * (o->xy + o->yx) + s * s * o->yy;
    g.yy = s * s * o->xx + c * s * (o->xy + o->yx) + c * c * o->yy;
    g.xy = c * c * o->xy - s * s * o->yx + c * s * (o->xx - o->yy);
    g.yx = c * c * o->yx - s * s * o->xy + c * s * (o->xx - o->yy);
    g.xz = c * o->xz - s * o->yz;
    g.yz = s * o->xz + c * o->yz;
    return g;
}

static void add_magnet(const fst_surroundings *s, double t, const double x[3], double b[3],
                       fst_gradient_double *g, double change[3])
{
    const fst_world_double *world = &s->model->world;
    const double angle = s->laboratory ? fst_waveform_angle(&s->drive, t) : 0.0, c = cos(angle),
                 sine = sin(angle);
    const double rate = fst_waveform_rate(&s->drive, t), *u = s->drive.velocity;
    double place[3], own[3];
    fst_gradient_double og;
    fst_place_on_magnet(s, t, x, place);
    fst_source_field_double(&world->source, &world->kinds, place[0], place[1], place[2], own, &og);
    const double of[3] = {c * own[0] - sine * own[1], sine * own[0] + c * own[1], own[2]};
    const fst_gradient_double here = turn_gradient(&og, c, sine);
    /* how the place would move with the magnet */
    const double moved[3] = {-rate * (x[1] - u[1] * t) + u[0], rate * (x[0] - u[0] * t) + u[1], u[2]};
    double db[3];
    fst_times_gradient_double(&here, moved, db);
    change[0] += -rate * of[1] - db[0];
    change[1] += rate * of[0] - db[1];
    change[2] -= db[2];
    add_field(of, &here, b, g);
}

static void add_fixed(const fst_surroundings *s, const double x[3], double b[3], fst_gradient_double *g)
{
    double of[3];
    fst_gradient_double og;
    if (s->fixed_kinds.pieces) {
        fst_parts_field_double(&s->fixed, &s->fixed_kinds, x[0], x[1], x[2], of, &og);
        fst_no_curl_double(&og);
        add_field(of, &og, b, g);
    }
}

double fst_distance_to_wire(const fst_surroundings *s, const double x[3])
{
    double nearest = INFINITY;
    for (int i = 0; i < s->loop_count; ++i) {
        const fst_part_double *part = &s->loops[i].part;
        const double from[3] = {x[0] - part->centre[0], x[1] - part->centre[1], x[2] - part->centre[2]};
        double own[3];
        fst_into_part_double(part, from, own);
        nearest = fmin(nearest, hypot(hypot(own[0], own[1]) - part->half[0], own[2]));
    }
    return nearest;
}

static void add_loops(const fst_surroundings *s, double t, const double x[3], double b[3],
                      fst_gradient_double *g, double change[3])
{
    for (int i = 0; i < s->loop_count; ++i) {
        const fst_loop *loop = &s->loops[i];
        const fst_part_double *part = &loop->part;
        const double from[3] = {x[0] - part->centre[0], x[1] - part->centre[1], x[2] - part->centre[2]};
        const double turn = loop->rate * t + loop->phase;
        const double current = loop->current + loop->ac * cos(turn), rate = -loop->ac * loop->rate * sin(turn);
        double own[3], of[3];
        fst_gradient_double og;
        fst_into_part_double(part, from, own);
        fst_loop_field_double(part, own, of, &og);
        if (loop->turned) {
            fst_turn_field_double(part, of, &og);
            fst_no_curl_double(&og);
        }
        for (int k = 0; k < 3; ++k) {
            change[k] += rate * of[k];
            of[k] *= current;
        }
        const fst_gradient_double scaled = {current * og.xx, current * og.yy, current * og.xy,
                                            current * og.xz, current * og.yz, current * og.yx};
        add_field(of, &scaled, b, g);
    }
}

static void add_wave(const fst_surroundings *s, double t, const double x[3], double b[3],
                     fst_gradient_double *g, double change[3])
{
    const double k = s->wave_number, omega = s->drive.omega, th = k * x[0] - omega * t, c = cos(th),
                 sine = sin(th);
    const double rise = exp(k * (x[2] - s->wave_height)), p = s->forward / rise, q = s->backward * rise;
    b[0] += (p + q) * c;
    b[2] += (q - p) * sine;
    change[0] += omega * (p + q) * sine;
    change[2] -= omega * (q - p) * c;
    g->xx -= k * (p + q) * sine; /* zz is minus this */
    g->xz += k * (q - p) * c;
}

void fst_surroundings_field(const fst_surroundings *s, double t, const double x[3], double b[3],
                            fst_gradient_double *g, double change[3])
{
    memset(g, 0, sizeof *g);
    memset(change, 0, 3 * sizeof *change);
    memcpy(b, s->uniform, sizeof s->uniform);
    if (s->drive.kind == FST_WAVEFORM_WAVE)
        add_wave(s, t, x, b, g, change);
    else
        add_magnet(s, t, x, b, g, change);
    add_fixed(s, x, b, g);
    add_loops(s, t, x, b, g, change);
}

void fst_place_on_magnet(const fst_surroundings *s, double t, const double x[3], double own[3])
{
    const double angle = s->laboratory ? fst_waveform_angle(&s->drive, t) : 0.0, c = cos(angle),
                 sine = sin(angle);
    const double *u = s->drive.velocity, d[2] = {x[0] - u[0] * t, x[1] - u[1] * t};
    own[0] = c * d[0] + sine * d[1];
    own[1] = c * d[1] - sine * d[0];
    own[2] = x[2] - u[2] * t;
}

/* By how much the magnet has turned. */
static double magnet_angle(const fst_surroundings *s, double t)
{
    fst_waveform drive = s->drive;
    (void)fst_waveform_enter(&drive, t);
    return fst_waveform_angle(&drive, t);
}

double fst_magnet_turns(const fst_surroundings *s, double t)
{
    return magnet_angle(s, t) / FST_TWO_PI;
}

double fst_frame_angle(const fst_surroundings *s, double t)
{
    return s->laboratory ? 0.0 : magnet_angle(s, t);
}

double fst_frame_rate(const fst_surroundings *s, double t)
{
    return s->laboratory ? 0.0 : fst_waveform_rate(&s->drive, t);
}
