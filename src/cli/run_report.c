/* run_report.c - the result of a run in words: a sentence, then the numbers. */
#include "cli/run_report.h"

#include <string.h>

#include "cli/command.h"
#include "cli/groups.h"

/* ---------------------------------------------------------------- the sentence */

static double millimetres(const fst_groups *groups, double length)
{
    return 1e3 * groups->length_unit * length;
}

/* The angle between bead and magnet at the end, in degrees. */
static double final_phi_degrees(const fst_run_result *result)
{
    return unsigned_zero(atan2(result->final_state[FST_Y], result->final_state[FST_X]) * 360.0 / TWO_PI, 4);
}

static double final_r(const fst_run_result *result)
{
    return hypot(result->final_state[FST_X], result->final_state[FST_Y]);
}

static void print_rotation(FILE *out, const fst_groups *groups, const fst_run_result *result, const char *verb,
                           const char *way)
{
    (void)fprintf(out, "%s: the bead circles %s once every %.3g turns of the magnet", verb, way,
                  result->omega / fabs(result->mean_alpha_dot));
    if (isfinite(result->festoons))
        (void)fprintf(out, ", %.3g festoons", result->festoons);
    (void)fprintf(out, ", radius %.3g mm\n", millimetres(groups, result->mean_r));
}

/* Say where and when the bead left the plate. */
static void print_end(FILE *out, const fst_groups *groups, const fst_run_result *result, const char *what)
{
    (void)fprintf(out,
                  "%s after %.4g turns of the magnet (%.4g s), %.4g mm from the axis, at Phi = %.4g degrees\n",
                  what, result->periods, result->end_time * groups->time_unit,
                  millimetres(groups, final_r(result)), final_phi_degrees(result));
}

static void print_sentence(FILE *out, const fst_groups *groups, const fst_run_result *result)
{
#define MEANING(NAME, name, doc, colour) doc,
    static const char *const meanings[] = {FST_REGIMES(MEANING)};
#undef MEANING
    switch (result->regime) {
    case FST_REGIME_COUNTER_ROTATING:
        print_rotation(out, groups, result, "counter-rotates", "backwards");
        break;
    case FST_REGIME_COROTATING:
        print_rotation(out, groups, result, "corotates", "forwards");
        break;
    case FST_REGIME_LOCKED:
        (void)fprintf(out,
                      "locked: the bead turns with the magnet, %.4g mm from the axis, at Phi = %.4g degrees\n",
                      millimetres(groups, final_r(result)), final_phi_degrees(result));
        break;
    case FST_REGIME_LIBRATING:
        (void)fprintf(out, "librates: the bead turns with the magnet, swinging about it, mean radius %.4g mm\n",
                      millimetres(groups, result->mean_r));
        break;
    case FST_REGIME_CHAOTIC:
        (void)fprintf(out,
                      "chaotic: two beads started side by side part e-fold in %.3g s; mean radius %.4g mm\n",
                      groups->time_unit / result->largest_exponent, millimetres(groups, result->mean_r));
        break;
    case FST_REGIME_EJECTED:
        print_end(out, groups, result, "ejected: the bead passed the plate's edge");
        break;
    case FST_REGIME_LIFTED:
        print_end(out, groups, result, "lifted: the bead lost contact with the plate, where this model ends,");
        break;
    default:
        (void)fprintf(out, "%s: %s\n", fst_regime_name(result->regime), meanings[result->regime]);
    }
    (void)fprintf(out, "  %s\n", result->reason);
}

/* ---------------------------------------------------------------- the numbers */

/* Print a line with a scaled number, its error bar (NAN: none), and the number in another unit (NULL: there is
 * none): value * factor. */
static void print_both(const page *p, const char *name, double value, double bar, const char *scaled_unit,
                       double factor, const char *unit)
{
    char scaled[96];
    if (!isfinite(value))
        return;
    value = unsigned_zero(value, ALL_DIGITS);
    if (isfinite(bar))
        (void)snprintf(scaled, sizeof scaled, "%.8g +- %.1g %s", value, bar, scaled_unit);
    else
        (void)snprintf(scaled, sizeof scaled, "%.8g %s", value, scaled_unit);
    if (unit)
        (void)fprintf(p->out, "  %-32s %-36s %.6g %s\n", name, scaled, value * factor, unit);
    else
        (void)fprintf(p->out, "  %-32s %s\n", name, scaled);
}

static void print_line(const page *p, const char *name, double value, double bar, const char *scaled_unit)
{
    const char *unit;
    const double factor = fst_unit_shown(scaled_unit, p->units, &p->scales, &unit);
    print_both(p, name, value, bar, scaled_unit, factor, unit == scaled_unit ? NULL : unit);
}

/* How fast something turns, which is called `key` in JSON. */
static void print_turning(const page *p, const char *name, const char *key, double value, double bar)
{
    const char *unit;
    const double factor = fst_number_shown(key, "gamma", p->units, &p->scales, &unit);
    print_both(p, name, value, bar, "gamma", factor, unit);
}

/* A load, in weights of the bead. */
static void print_load(const page *p, const char *name, double weights, const fst_groups *g)
{
    const char *unit;
    const double factor = fst_unit_shown("l gamma^2", p->units, &p->scales, &unit);
    print_both(p, name, weights, NAN, "weights", g->gravity * factor, unit);
}

static void print_motion(const page *p, const fst_run_result *s)
{
    print_turning(p, "drive omega", "omega", s->omega, NAN);
    print_line(p, "distance from the axis <r>", s->mean_r, s->mean_r_error, "l");
    print_line(p, "  its variation delta r", s->std_r, NAN, "l");
    print_line(p, "  least", s->min_r, NAN, "l");
    print_line(p, "  greatest", s->max_r, NAN, "l");
    print_turning(p, "bead's circling <alpha'>", "mean_alpha_dot", s->mean_alpha_dot, s->mean_alpha_dot_error);
    print_turning(p, "moment's turning <phi'>", "mean_phi_dot", s->mean_phi_dot, NAN);
    print_line(p, "mean n_z", s->mean_nz, s->mean_nz_error, "");
    print_line(p, "festoons", s->festoons, NAN, "");
    print_line(p, "one whole turn of Phi", s->period, NAN, "1/gamma");
    print_line(p, "angle(n, B), greatest", s->max_angle_deg, NAN, "degrees");
    print_line(p, "tilt of the plane of n", s->tilt_deg, NAN, "degrees");
    print_line(p, "largest Lyapunov exponent", s->largest_exponent, s->largest_exponent_error, "gamma");
}

/* Dry friction: how the contact moves. */
static void print_contact(const page *p, const fst_run_result *s)
{
    if (s->never_slips > 0)
        (void)fprintf(p->out, "  the contact never slips: the motion that is reached depends on the start\n");
    print_line(p, "contact at rest, share of time", s->sticking, NAN, "");
    print_line(p, "  slips that end, a turn of Phi", s->captures_per_return, NAN, "");
    print_line(p, "viscous rate of the same power", s->effective_rate, NAN, "gamma");
    print_line(p, "power lost to rolling", s->mean_rolling_power, NAN, "l^2 gamma^3");
    print_line(p, "power lost to pivoting", s->mean_pivoting_power, NAN, "l^2 gamma^3");
    if (s->flying > 0) {
        print_line(p, "in the air, share of time", s->flying, NAN, "");
        print_line(p, "  impacts, a turn of Phi", s->impacts_per_return, NAN, "");
        print_line(p, "power lost to impacts", s->mean_impact_power, NAN, "l^2 gamma^3");
    }
}

static void print_forces(const page *p, const fst_groups *g, const fst_run_result *s)
{
    print_line(p, "field <|B|>", s->mean_b, NAN, "B0");
    print_line(p, "  its variation", s->std_b, NAN, "B0");
    print_line(p, "  least", s->min_b, NAN, "B0");
    print_line(p, "  greatest", s->max_b, NAN, "B0");
    print_line(p, "slip of the contact, rms", s->rms_slip, NAN, "l gamma");
    print_load(p, "load on the plate", s->mean_load_weights, g);
    print_load(p, "  least", s->min_load_weights, g);
    print_load(p, "  greatest", s->max_load_weights, g);
    if (!isnan(s->sticking))
        print_contact(p, s);
    else
        print_line(p, "friction rate if it were dry", s->dry_friction_rate, NAN, "1/s");
    print_line(p, "power lost to friction", s->mean_friction_power, NAN, "l^2 gamma^3");
    print_line(p, "power of the drive", s->mean_drive_power, NAN, "l^2 gamma^3");
    print_line(p, "energy residual", s->energy_residual, NAN, "");
}

void print_run(FILE *out, const fst_groups *groups, const fst_run_result *result, int si)
{
    const page p = {out,
                    si ? FST_SHOWN_SI : FST_SHOWN_LAB,
                    {groups->length_unit, groups->time_unit, groups->mass, groups->field_unit}};
    const char *dynamics = fst_dynamics_name(groups->dynamics);
    print_sentence(out, groups, result);
    (void)fprintf(out, "\n  dynamics %s, symmetry %s, %.6g turns of the magnet", dynamics,
                  fst_symmetry_name(result->symmetry) ? fst_symmetry_name(result->symmetry) : "none",
                  result->periods);
    if (isfinite(result->window_periods))
        (void)fprintf(out, ", means over the last %.6g", result->window_periods);
    (void)fprintf(out, "\n");
    print_motion(&p, result);
    print_forces(&p, groups, result);
    (void)fprintf(out, "\nScaled groups:\n");
    print_groups(out, groups);
}

void print_ramp(FILE *out, const fst_groups *groups, const fst_run_result *result, const fst_ramp_point *points,
                size_t count)
{
    if (result->regime == FST_REGIME_EJECTED || result->regime == FST_REGIME_LIFTED)
        print_sentence(out, groups, result);
    else
        (void)fprintf(out, "%s\n", result->reason);
    const double mm = 1e3 * groups->length_unit, hertz = 1.0 / (TWO_PI * groups->time_unit);
    (void)fprintf(out,
                  "A ramp of the drive to %.6g Hz, means over its pieces (*: not settled):\n  %10s %10s %10s "
                  "%12s %14s %14s %10s\n",
                  result->frequency_hz, "drive Hz", "omega", "<r> mm", "delta r mm", "<alpha'> Hz", "<phi'> Hz",
                  "<n_z>");
    for (size_t i = 0; i < count; ++i)
        (void)fprintf(out, "  %10.5g %10.6g %10.5g %12.4g %14.6g %14.6g %10.3g%s\n", points[i].frequency_hz,
                      points[i].omega, mm * points[i].mean_r, mm * points[i].std_r,
                      unsigned_zero(hertz * points[i].mean_alpha_dot, ALL_DIGITS),
                      unsigned_zero(hertz * points[i].mean_phi_dot, ALL_DIGITS),
                      unsigned_zero(points[i].mean_nz, ALL_DIGITS), points[i].settled ? "" : " *");
}
