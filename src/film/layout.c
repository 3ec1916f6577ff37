/* layout.c - what of a scene a film shows, and how large: over a plate the square about the axis to which the beads come,
 * from above; without a plate all from the front; of a field that travels, or a magnet that is carried along, the
 * surroundings of the beads. */
#include "film/layout.h"

#include "base/constants.h"
#include "draw/bar.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

/* The magnet.  Returns how far it reaches from the axis. */
static double add_bodies(fst_film_layout *layout, const fst_params *p)
{
    double reach = 0.0;
    layout->body_count = fst_magnet_bodies(p, 1e3, FST_BAR_OVER_LINES, layout->bodies);
    layout->high = 0.5 * FST_BAR_THICKNESS;
    layout->low = -layout->high;
    for (int i = 0; i < layout->body_count; ++i) {
        const fst_part_shape *seen = &layout->bodies[i].seen;
        layout->high = i ? fmax(layout->high, seen->high) : seen->high;
        layout->low = i ? fmin(layout->low, seen->low) : seen->low;
        for (int k = 0; k < seen->count; ++k)
            reach = fmax(reach, 1.05 * hypot(seen->corners[k][0], seen->corners[k][1]));
        if (p->magnet_shape != FST_MAGNET_PARTS)
            continue;
        layout->fixed |= (unsigned)(p->magnet_parts[i].motion == FST_PART_FIXED) << i;
        layout->round |= (unsigned)(p->magnet_parts[i].kind == FST_PART_SPHERE) << i;
    }
    return reach;
}

static void add_world(fst_film_layout *layout, const fst_params *p)
{
    layout->depth = 1e3 * p->magnet_depth;
    layout->plate = (fst_plate_shape)p->plate_shape;
    layout->bowl = 1e3 * p->plate_bowl_radius;
    layout->coil_count = p->coil_count;
    memcpy(layout->coils, p->coils, sizeof layout->coils);
    if (p->drive_waveform == FST_WAVEFORM_WAVE)
        layout->wave = copysign(1e3 * p->wave_length, 1.0 - p->wave_ratio);
    layout->follows = p->drive_waveform == FST_WAVEFORM_WAVE || p->drive_waveform == FST_WAVEFORM_CARRIED;
}

/* Where beads come: how far along x or y from the axis, and between which heights their centres are. */
typedef struct extent {
    double reach, low, high;
} extent;

static extent extent_of(const fst_film_cast *cast)
{
    extent all = {0.0, INFINITY, -INFINITY};
    for (int bead = 0; bead < cast->count; ++bead) {
        const fst_film_motion *m = &cast->motions[bead];
        for (size_t row = m->first; row <= m->last; ++row) {
            const double z = m->z ? m->z[row] * m->millimetres : 0.0;
            all.reach = fmax(all.reach, fmax(fabs(m->x[row]), fabs(m->y[row])));
            all.low = fmin(all.low, z + m->radius);
            all.high = fmax(all.high, z + m->radius);
        }
    }
    return all;
}

/* Without a plate: a square that holds magnet and beads from the front, and a small one that holds them from above. */
static void look_from_the_front(fst_film_layout *layout, double magnet, extent all, double mm)
{
    const int has = layout->body_count > 0;
    const double low = fmin(all.low - layout->radius, has ? layout->low - layout->depth : INFINITY);
    const double high = fmax(all.high + layout->radius, has ? layout->high - layout->depth : -INFINITY);
    const double across = fmax(magnet, all.reach * mm + layout->radius);
    layout->view = FST_FILM_FRONT;
    layout->middle = 0.5 * (low + high);
    layout->reach = fmax(1.15 * across, 0.6 * (high - low));
    layout->small_reach = 1.15 * across;
    layout->seen_as = "along the axis";
}

static void set_sizes(fst_film_layout *layout, const fst_film_cast *cast)
{
    const double mm = 1e3 * cast->params.magnet_half_length;
    const double magnet = add_bodies(layout, &cast->params);
    const extent all = extent_of(cast);
    for (int bead = 0; bead < cast->count; ++bead)
        layout->radius = fmax(layout->radius, cast->motions[bead].radius);
    layout->view = FST_FILM_ABOVE;
    layout->seen_as = "from the front";
    layout->top = fmax(all.high - layout->radius, 0.0);
    if (layout->plate == FST_PLATE_NONE) {
        layout->upside_down = cast->params.plate_gravity < 0.0;
        look_from_the_front(layout, magnet, all, mm);
        return;
    }
    layout->reach = layout->follows ? fmax(0.75 * fabs(layout->wave), fmax(1.35 * mm, 8.0 * layout->radius))
                                    : fmax(fmax(1.25 * all.reach, 1.35) * mm, magnet);
    layout->small_reach = layout->reach;
}

static void set_words(fst_film_look *look, const fst_film_cast *cast, const fst_film_options *options)
{
    static const char *const plates[] = {
        [FST_PLATE_FLAT] = "", [FST_PLATE_BOWL] = "bowl", [FST_PLATE_NONE] = "no plate, from the front"};
    const fst_params *p = &cast->params;
    const double hertz = cast->omega * p->friction_gamma / FST_TWO_PI;
    const char *what = plates[p->plate_shape];
    char beads[32] = "";
    if (cast->count > 1)
        (void)snprintf(beads, sizeof beads, "%d beads", cast->count);
    else if (!what[0])
        what = look->layout.wave != 0.0      ? "travelling field"
               : look->layout.coil_count > 0 ? "coils"
               : p->medium_density > 0.0     ? "in a fluid"
                                             : fst_dynamics_name((fst_dynamics)p->model_dynamics);
    (void)snprintf(look->title, sizeof look->title, "%.3g Hz (ω = %.4g), %s%s%s", hertz, cast->omega, beads,
                   beads[0] && what[0] ? ", " : "", what);
    (void)snprintf(look->slower, sizeof look->slower, "%.3g times slower", hertz * options->seconds_per_turn);
    look->layout.title = look->title;
    look->layout.slower = look->slower;
}

static void set_colours(fst_film_look *look, const fst_film_cast *cast, const fst_film_options *options)
{
    const fst_film_motion *m = &cast->motions[0];
    fst_shown_units units = options->units;
    if (!m->colour)
        return;
    if (units == FST_SHOWN_AS_GIVEN)
        units = isfinite(cast->params.drive_omega) ? FST_SHOWN_SCALED : FST_SHOWN_LAB;
    const fst_quantity colour = fst_quantity_of_column(m->colour_info, units, &cast->params);
    (void)snprintf(look->label, sizeof look->label, "%s", colour.label);
    look->layout.colour_label = look->label;
    look->layout.colour_low = colour.factor * m->low;
    look->layout.colour_high = colour.factor * m->high;
    look->layout.both_signs = m->both_signs;
}

void fst_film_look_at(fst_film_look *look, const fst_film_cast *cast, const fst_film_options *options)
{
    *look = (fst_film_look){.layout = {.width = options->width, .height = options->height}};
    add_world(&look->layout, &cast->params);
    set_sizes(&look->layout, cast);
    set_words(look, cast, options);
    set_colours(look, cast, options);
}
