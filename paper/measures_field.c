/* measures_field.c - statements about the field: on the magnet's axis, on circles round it, over the ball; the
 * arithmetic of the model's magnet; and the forces along a path. */
#include "base/constants.h"
#include "paper/measures_parts.h"

/* ------------------------------------------------------------------ the maxima */

MEASURE(maxima_distance)
{
    fst_params params = run_of(m, FST_SCAN_FOLD15)->params;
    double unit = 2e3 * params.magnet_half_length;
    double at_centre = unit * fst_maximum_on_axis(&params);
    params.model_h = params.magnet_depth / params.magnet_half_length;
    NOTE("at the height of the bead's centre; on the plate's surface %.1f mm",
         unit * fst_maximum_on_axis(&params));
    return at_centre;
}

/* The length of the lines for which the maxima are 41 mm apart at the bead's height, with all other lengths as
 * they are in millimetres. */
MEASURE(fitted_length)
{
    fst_params params = run_of(m, FST_SCAN_FOLD15)->params;
    double low = 15e-3, high = 30e-3, at_length[2];
    for (int at_plate = 0; at_plate < 2; ++at_plate) {
        double below = low, above = high;
        for (int i = 0; i < 40; ++i) {
            double height = params.magnet_depth + (at_plate ? 0.0 : params.bead_radius);
            params.magnet_half_length = 0.5 * (below + above);
            params.model_h = height / params.magnet_half_length;
            double apart = 2.0 * params.magnet_half_length * fst_maximum_on_axis(&params);
            *(apart < 41e-3 ? &below : &above) = params.magnet_half_length;
        }
        at_length[at_plate] = 1e3 * below;
    }
    NOTE("for maxima at that height; on the plate's surface %.2f mm", at_length[1]);
    return at_length[0];
}

/* ------------------------------------------------------------------ on circles */

fst_averages fst_averages_on_circle(const fst_model *model, double r, double rate, double chi)
{
    enum { ANGLES = 256 }; /* the mean of a smooth periodic function converges faster than any power of this */
    fst_averages mean = {0.0, 0.0, 0.0, 0.0};
    for (int i = 0; i < ANGLES; ++i) {
        double turn = 2.0 * FST_PI * i / ANGLES, c = cos(turn), s = sin(turn), angle = chi + rate * turn, b[3],
               g[3][3];
        fst_field(model, r * c, r * s, b, g);
        const double n[3] = {-sin(angle) * s, sin(angle) * c, -cos(angle)};
        for (int k = 0; k < 3; ++k) {
            mean.radial += n[k] * (g[k][0] * c + g[k][1] * s) / ANGLES;
            mean.moment += n[k] * r * (g[k][1] * c - g[k][0] * s) / ANGLES;
            mean.n_b += n[k] * b[k] / ANGLES;
        }
        mean.torque += ((b[1] * c - b[0] * s) * cos(angle) + b[2] * sin(angle)) / ANGLES;
    }
    return mean;
}

double fst_ansatz_force(const fst_model *model, double r, int sense)
{
    const fst_groups g = fst_model_groups(model);
    return g.kappa * g.eps * g.eps * fst_averages_on_circle(model, r, sense, FST_PI).radial;
}

fst_circle_field fst_field_on_circle(const fst_model *model, double r)
{
    enum { ANGLES = 360 };
    fst_circle_field mean = {0.0, 0.0, 0.0};
    for (int i = 0; i < ANGLES; ++i) {
        const double turn = 2.0 * FST_PI * i / ANGLES, c = cos(turn), s = sin(turn);
        double b[3], g[3][3];
        fst_field(model, r * c, r * s, b, g);
        const double radial = b[0] * c + b[1] * s;
        mean.radial += radial * radial / ANGLES;
        mean.square += (b[0] * b[0] + b[1] * b[1] + b[2] * b[2]) / ANGLES;
        mean.structured += ((b[1] * c - b[0] * s) * s + b[2] * c) / ANGLES;
    }
    mean.structured = fabs(mean.structured);
    return mean;
}

MEASURE_IN(orthoradial, FOLD4)
{
    const fst_circle_field mean = fst_field_on_circle(model, 0.9);
    NOTE("share of the radial part in the field (root mean squares) on the circle r = 0.9");
    return 100.0 * sqrt(mean.radial / mean.square);
}

/* The square of the radial part. */
MEASURE_IN(orthoradial_energy, FOLD4)
{
    const fst_circle_field mean = fst_field_on_circle(model, 0.9);
    const double r = fst_maximum_on_axis(&run_of(m, FST_SCAN_FOLD15)->params);
    double b[3], g[3][3];
    fst_field(model, r, 0.0, b, g);
    NOTE("the same circle; at the maximum itself, r = %.3f, the radial part is %.0f %% of the field", r,
         100.0 * fabs(b[0]) / fst_length(b));
    return 100.0 * (mean.radial / mean.square);
}

/* With the better sign of the magnet. */
MEASURE_IN(field_structure, FOLD15)
{
    const fst_circle_field mean = fst_field_on_circle(model, 0.9);
    NOTE("on the circle r = 0.9: mean of the field along that direction over its root mean square");
    return mean.structured / sqrt(mean.square);
}

MEASURE_IN(force_beyond_own_maximum, FOLD4)
{
    double greatest = 0.0, best = 0.3;
    for (int i = 0; i <= 240; ++i) {
        const double r = 0.3 + 5e-3 * i, here = fst_field_on_circle(model, r).structured;
        best = here > greatest ? r : best;
        greatest = fmax(greatest, here);
    }
    int outwards = 0, radii = 0;
    for (double r = best + 0.01; r < 1.505; r += 0.01, ++radii)
        outwards += !(fst_ansatz_force(model, r, -1) < 0.0);
    NOTE("of %d radii; B̂(r) is greatest near r = %.2f", radii, best);
    return outwards;
}

MEASURE_IN(counter_force, FOLD4)
{
    int outwards = 0, radii = 0;
    double turns = NAN; /* beyond this radius the force points inwards */
    for (double r = 0.9; r < 1.505; r += 0.01, ++radii) {
        const int inwards = fst_ansatz_force(model, r, -1) < 0.0;
        outwards += !inwards;
        turns = inwards && isnan(turns) ? r : turns;
    }
    NOTE("of %d radii from 0.9 to 1.5; the field is greatest at 0.88, but this force points inwards from %.2f "
         "on, and at the drive 0.4 the bead circles at 0.91: what holds it there is n_r",
         radii, turns);
    return outwards;
}

MEASURE_IN(corotation_force, FOLD4)
{
    const double with = fst_ansatz_force(model, 1.05, 1), against = fst_ansatz_force(model, 1.05, -1);
    NOTE("at r = 1.05: corotating %+.4f, counter-rotating %+.4f; with the whole field the corotating force is "
         "not small but points outwards, so it precludes that motion all the more",
         with, against);
    return fabs(with / against);
}

/* The mean radial force is A cos(chi) + B sin(chi).  Compare it at each other whole rate with that at -1. */
MEASURE_IN(resonance, FOLD15)
{
    const double r = run_of(m, FST_SCAN_FOLD15)->result.mean_r;
    double size_of[7], greatest = 0.0;
    int worst = 0;
    for (int rate = -3; rate <= 3; ++rate)
        size_of[rate + 3] = hypot(fst_averages_on_circle(model, r, rate, 0.0).radial,
                                  fst_averages_on_circle(model, r, rate, 0.5 * FST_PI).radial);
    for (int rate = -3; rate <= 3; ++rate) {
        if (rate == 1 || rate == -1 || size_of[rate + 3] <= greatest)
            continue;
        greatest = size_of[rate + 3];
        worst = rate;
    }
    NOTE("φ = kΦ + χ on the circle r = %.3f, k from −3 to 3 save ±1; greatest for k = %d. Even and broken k "
         "give nothing, by the magnet's symmetry",
         r, worst);
    return greatest / size_of[2];
}

MEASURE_IN(sine_law, FOLD15)
{
    const double r = run_of(m, FST_SCAN_FOLD15)->result.mean_r;
    const fst_averages in_phase = fst_averages_on_circle(model, r, -1.0, 0.0),
                       quarter = fst_averages_on_circle(model, r, -1.0, 0.5 * FST_PI);
    double worst = 0.0;
    for (int i = 0; i < 24; ++i) {
        const double chi = 2.0 * FST_PI * i / 24.0 + 0.1;
        const fst_averages now = fst_averages_on_circle(model, r, -1.0, chi);
        worst = fmax(worst, fabs(now.radial - in_phase.radial * cos(chi)) / fabs(in_phase.radial));
        worst = fmax(worst, fabs(now.moment - quarter.moment * sin(chi)) / fabs(quarter.moment));
        worst = fmax(worst, fabs(now.torque - quarter.torque * sin(chi)) / fabs(quarter.torque));
    }
    NOTE("on the circle r = %.3f, 24 phases χ", r);
    return worst;
}

/* The energy is -n.B. -1: it changes its sign between 0 and pi; it is negative at pi if n.B is positive there.
 */
MEASURE_IN(least_energy, FOLD15)
{
    const double r = run_of(m, FST_SCAN_FOLD15)->result.mean_r;
    const double at_pi = fst_averages_on_circle(model, r, -1.0, FST_PI).n_b;
    return at_pi > 0.0 ? at_pi / fst_averages_on_circle(model, r, -1.0, 0.0).n_b : NAN;
}

/* ------------------------------------------------------------------ the ball and the model's magnet */

/* Add weight times B(x, 0) at `up` above the bead's centre; the height is a parameter of the model. */
static int add_field(const fst_params *scene, const double place[3], double weight, double sum[3])
{
    fst_params params = *scene;
    fst_model *model = NULL;
    double b[3], gradient[3][3];
    params.model_h = (params.magnet_depth + params.bead_radius) / params.magnet_half_length + place[2];
    if (fst_model_new(&params, &model, NULL) != FST_OK)
        return 0;
    fst_field(model, place[0], place[1], b, gradient);
    fst_model_free(model);
    for (int i = 0; i < 3; ++i)
        sum[i] += weight * b[i];
    return 1;
}

/* The mean of B over the ball, on three shells, by Gauss's rule in z (six points) and twelve points round.  On
 * each shell it is exact to the eleventh degree; the error falls as (eps/h)^12. */
MEASURE(ball_mean)
{
    static const double zs[6] = {-0.932469514203152, -0.661209386466265, -0.238619186083197,
                                 0.238619186083197,  0.661209386466265,  0.932469514203152};
    static const double zw[6] = {0.171324492379170, 0.360761573048139, 0.467913934572691,
                                 0.467913934572691, 0.360761573048139, 0.171324492379170};
    static const double ss[3] = {0.112701665379258, 0.5, 0.887298334620742};
    static const double sw[3] = {5.0 / 18.0, 8.0 / 18.0, 5.0 / 18.0};
    const fst_params *p = &run_of(m, FST_SCAN_FOLD4)->params;
    double eps = eps_of(p), centre[3] = {0}, mean[3] = {0}, all = 0.0, off = 0.0;
    const double place[3] = {0.9, 0.0, 0.0};
    int good = add_field(p, place, 1.0, centre);
    for (int i = 0; i < 3 * 6 * 12 && good; ++i) {
        double s = ss[i / 72], z = zs[i / 12 % 6], turn = 2.0 * FST_PI * (i % 12) / 12.0;
        double weight = sw[i / 72] * s * s * zw[i / 12 % 6], flat = s * eps * sqrt(1.0 - z * z);
        const double here[3] = {0.9 + flat * cos(turn), flat * sin(turn), s * eps * z};
        good = add_field(p, here, weight, mean);
        all += weight;
    }
    for (int i = 0; i < 3; ++i)
        off += (mean[i] / all - centre[i]) * (mean[i] / all - centre[i]);
    NOTE("no approximation: each component of B is harmonic, so that its mean over the ball is its value at "
         "the centre (216 points of the ball at r = 0.9)");
    return good ? sqrt(off) / fst_length(centre) : NAN;
}

/* The field of dipoles along one line, integrated by Gauss's rule with five points on each of 40 pieces, to
 * compare with that of the charges at its ends. */
MEASURE(line_of_dipoles)
{
    static const double nodes[5] = {-0.906179845938664, -0.538469310105683, 0.0, 0.538469310105683,
                                    0.906179845938664};
    static const double weights[5] = {0.236926885056189, 0.478628670499366, 0.568888888888889,
                                      0.478628670499366, 0.236926885056189};
    enum { PIECES = 40 };
    fst_params params = run_of(m, FST_SCAN_FOLD4)->params;
    fst_model *model = NULL;
    double worst = 0.0;
    params.magnet_lines = 1;
    if (fst_model_new(&params, &model, NULL) != FST_OK)
        return NAN;
    double h = fst_model_groups(model).h;
    for (int place = 0; place < 12; ++place) {
        double x = 0.15 * place, y = 0.1 * place - 0.4, b[3], grad[3][3], sum[3] = {0.0, 0.0, 0.0}, off = 0.0;
        for (int i = 0; i < 5 * PIECES; ++i) {
            double at = -1.0 + (2 * (i / 5) + 1 + nodes[i % 5]) / PIECES, weight = weights[i % 5] / PIECES;
            const double d[3] = {x - at, y, h};
            double square = d[0] * d[0] + d[1] * d[1] + d[2] * d[2], cube = square * sqrt(square);
            for (int k = 0; k < 3; ++k) /* the field of a dipole along the line */
                sum[k] += weight * (3.0 * d[0] * d[k] / square - (k == 0)) / cube;
        }
        fst_field(model, x, y, b, grad);
        for (int k = 0; k < 3; ++k) /* one line has the strength of all five */
            off += (5.0 * sum[k] - b[k]) * (5.0 * sum[k] - b[k]);
        worst = fmax(worst, sqrt(off) / fst_length(b));
    }
    fst_model_free(model);
    return worst;
}

/* The pulsation from the moment and the field in SI units, which are set here so that the model has to make
 * kappa of them. */
MEASURE(kappa_ratio)
{
    fst_params params = run_of(m, FST_SCAN_FOLD4)->params;
    const double energy = params.model_kappa * params.bead_mass * params.bead_radius * params.bead_radius *
                          params.friction_gamma * params.friction_gamma;
    const double moment = 0.05, field = energy / moment;
    char text[2][40];
    fst_model *model = NULL;
    (void)snprintf(text[0], sizeof text[0], "%.17g", moment);
    (void)snprintf(text[1], sizeof text[1], "%.17g", field);
    params.model_kappa = NAN;
    if (fst_params_set(&params, "bead.moment", text[0], NULL) != FST_OK ||
        fst_params_set(&params, "magnet.b0", text[1], NULL) != FST_OK ||
        fst_model_new(&params, &model, NULL) != FST_OK)
        return NAN;
    const double kappa = fst_model_groups(model).kappa;
    double b[3], g[3][3];
    fst_field(model, fst_maximum_on_axis(&params), 0.0, b, g);
    fst_model_free(model);
    const double strength = fst_length(b);
    const double pulsation =
        sqrt(moment * field / (params.bead_mass * params.bead_radius * params.bead_radius)) /
        params.friction_gamma;
    NOTE("a free bead at the field's maximum swings faster: its field is %.2f B₀ and its inertia (2/5)mR², so "
         "that the square is %.1f κ",
         strength, 2.5 * strength);
    return pulsation * pulsation / kappa;
}

/* ------------------------------------------------------------------ forces along a path */

/* The magnet's force on the bead of a sample, along the turning axes and upwards. */
static void pull_at(const fst_model *model, const fst_path *path, size_t row, double pull[3])
{
    const fst_groups groups = fst_model_groups(model);
    double b[3], g[3][3];
    fst_field(model, path->X[row], path->Y[row], b, g);
    for (int i = 0; i < 3; ++i)
        pull[i] = groups.kappa * groups.eps * groups.eps *
                  (path->nX[row] * g[0][i] + path->nY[row] * g[1][i] + path->nZ[row] * g[2][i]);
}

/* The mean size of the magnet's force along the plate, and of all of it, where the bead is within pi/8 of an
 * end of the magnet, and of its middle; and how strongly it pulls inwards at both. */
typedef struct pulls {
    double force[2], whole[2], inwards[2];
} pulls;

static pulls pulls_of(const fst_measuring *m, const fst_model *model)
{
    const fst_path path = fst_path_of(run_of(m, FST_SCAN_FOLD15));
    pulls sum = {{0.0, 0.0}, {0.0, 0.0}, {0.0, 0.0}};
    int count[2] = {0, 0};
    for (size_t row = 0; row < path.rows; ++row) {
        const double along = fabs(path.X[row]) / path.r[row];
        const int across = along < sin(FST_PI / 8.0);
        double pull[3];
        if (!across && along < cos(FST_PI / 8.0))
            continue;
        pull_at(model, &path, row, pull);
        sum.force[across] += hypot(pull[0], pull[1]);
        sum.whole[across] += fst_length(pull);
        sum.inwards[across] -= (pull[0] * path.X[row] + pull[1] * path.Y[row]) / path.r[row];
        ++count[across];
    }
    for (int i = 0; i < 2; ++i) {
        sum.force[i] /= count[i];
        sum.whole[i] /= count[i];
        sum.inwards[i] /= count[i];
    }
    return sum;
}

MEASURE_IN(force_at_ends, FOLD15)
{
    const pulls mean = pulls_of(m, model);
    NOTE("|F| = %.4f within π/8 of an end of the magnet, %.4f as near to its middle", mean.force[0],
         mean.force[1]);
    return 100.0 * (mean.force[0] / mean.force[1] - 1.0);
}

MEASURE_IN(whole_force_at_ends, FOLD15)
{
    const pulls mean = pulls_of(m, model);
    NOTE("%.3f near the ends, %.3f near the middle: most of it presses the bead on the plate", mean.whole[0],
         mean.whole[1]);
    return 100.0 * (mean.whole[0] / mean.whole[1] - 1.0);
}

MEASURE_IN(pull_weakens, FOLD15)
{
    const pulls mean = pulls_of(m, model);
    NOTE("pull inwards %+.2g at the ends of the magnet, %+.2g at its middle: the other way round. The bead is "
         "driven faster than it could swing by itself, so that r is greatest where the pull is",
         mean.inwards[0], mean.inwards[1]);
    return 100.0 * (mean.inwards[0] - mean.inwards[1]) / fmax(fabs(mean.inwards[0]), fabs(mean.inwards[1]));
}

MEASURE_IN(modulation, FOLD15)
{
    const fst_path path = fst_path_of(run_of(m, FST_SCAN_FOLD15));
    fst_scatter points = {0};
    for (size_t row = 0; row < path.rows; ++row) {
        double pull[3];
        pull_at(model, &path, row, pull);
        fst_scatter_add(&points, path.r[row], (pull[0] * path.X[row] + pull[1] * path.Y[row]) / path.r[row]);
    }
    const double correlation = fst_scatter_correlation(&points);
    NOTE("correlation %+.2f of r with the radial force, outwards positive", correlation);
    return correlation * correlation;
}

/* Taken over the samples with r in the topmost tenth of its range. */
MEASURE_IN(friction_outside, FOLD4)
{
    const fst_run_result *result = &run_of(m, FST_SCAN_FOLD4)->result;
    const fst_path path = fst_path_of(run_of(m, FST_SCAN_FOLD4));
    const double limit = result->max_r - 0.1 * (result->max_r - result->min_r);
    double friction[2] = {0.0, 0.0}, all[2] = {0.0, 0.0}; /* inside and outside */
    for (size_t row = 0; row < path.rows; ++row) {
        double pull[3];
        pull_at(model, &path, row, pull);
        friction[path.r[row] > limit] += path.slip[row];
        all[path.r[row] > limit] += path.slip[row] + hypot(pull[0], pull[1]);
    }
    NOTE("|V| over |V| + |F|, where r is in the topmost tenth of its range; outside of these samples %.0f %%",
         100.0 * friction[0] / all[0]);
    return 100.0 * friction[1] / all[1];
}
