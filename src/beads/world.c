/* world.c - the contacts that beads may have, and their energy. */
#include "beads/world.h"

#include <math.h>

static void add_contact(beads_world *world, int first, int second)
{
    const double inverse = 1.0 / beads_moved_mass(&world->body[first]);
    world->contact[world->contacts++] =
        (beads_contact){first,
                        second,
                        second < 0 ? 0.0 : world->body[first].radius + world->body[second].radius,
                        beads_friction(world, first, second),
                        second < 0 ? world->plate_mu : world->pair_mu,
                        {inverse, second < 0 ? 0.0 : 1.0 / beads_moved_mass(&world->body[second])}};
}

void beads_number_contacts(beads_world *world, double plate_rate, double pair_rate)
{
    world->plate_rate = plate_rate;
    world->pair_rate = pair_rate;
    world->contacts = 0;
    if (world->count > FST_BEADS_MOST)
        return;
    for (int i = 0; i < world->count; ++i)
        add_contact(world, i, -1);
    for (int i = 0; i < world->count; ++i)
        for (int j = i + 1; j < world->count; ++j)
            add_contact(world, i, j);
}

void beads_model_field(const void *model, double x, double y, double z, double b[3], fst_gradient_double *g)
{
    const fst_world_double *c = &((const fst_model *)model)->world;
    fst_source_field_double(&c->source, &c->kinds, x, y, z, b, g);
}

double beads_model_clearance(const void *model, double x, double y, double z)
{
    const fst_params *p = &((const fst_model *)model)->params;
    const double l = p->magnet_half_length, place[3] = {x * l, y * l, z * l};
    if (p->magnet_shape != FST_MAGNET_PARTS)
        return z;
    double least = INFINITY;
    for (int i = 0; i < p->magnet_part_count; ++i)
        if (p->magnet_parts[i].motion == FST_PART_TURNING)
            least = fmin(least, fst_part_distance(&p->magnet_parts[i], place));
    return least / l;
}

double beads_plate_gap(const beads_world *world, int i, const double *y)
{
    const double *x = y + FST_BEAD_NUMBERS * i, rho = world->bowl - world->body[i].radius;
    if (isnan(world->plate))
        return INFINITY;
    if (!(world->bowl > 0))
        return x[2];
    return rho - sqrt(x[0] * x[0] + x[1] * x[1] + (x[2] - rho) * (x[2] - rho));
}

/* The way to the sources of a wave, one length of it above or, without a plate, below where its amplitude is told. */
static double way_to_sources(const beads_world *world, double height)
{
    const fst_surroundings *s = &world->around;
    const double rise = height - s->wave_height;
    if (!world->surrounded || s->drive.kind != FST_WAVEFORM_WAVE || (rise > 0 ? s->backward : s->forward) == 0)
        return INFINITY;
    return FST_TWO_PI / s->wave_number - fabs(rise);
}

double beads_way_out(const beads_world *world, int i, const double *y, int *what)
{
    const double *bead = y + FST_BEAD_NUMBERS * i, z = isnan(world->plate) ? bead[2] : 0.0;
    const double edge = world->plate_radius - sqrt(bead[0] * bead[0] + bead[1] * bead[1] + z * z);
    const double place[3] = {bead[0], bead[1], beads_height(world, i, y)}, radius = world->body[i].radius;
    const double sources = way_to_sources(world, place[2]);
    double magnet = INFINITY, own[3] = {place[0], place[1], place[2]};
    if (world->clearance && world->surrounded)
        fst_place_on_magnet(&world->around, beads_time(world, y), place, own);
    if (world->clearance)
        magnet = world->clearance(world->source, own[0], own[1], own[2]) - radius;
    if (world->surrounded) /* beside coils the axes are those of the laboratory, in which they stand */
        magnet = fmin(magnet, fst_distance_to_wire(&world->around, place) - radius);
    *what = sources < fmin(magnet, edge) ? BEADS_AT_SOURCES : magnet < edge ? BEADS_AT_MAGNET : BEADS_AT_EDGE;
    return fmin(fmin(magnet, sources), edge);
}

double beads_kinetic_energy(const beads_world *world, const int *gone, const double *y)
{
    double sum = 0.0;
    for (int i = 0; i < world->count; ++i) {
        const double *bead = y + FST_BEAD_NUMBERS * i;
        const beads_body *body = &world->body[i];
        if (!gone[i])
            sum += 0.5 * (beads_moved_mass(body) * beads_dot(bead + BEADS_V, bead + BEADS_V) +
                          body->inertia * beads_dot(bead + BEADS_W, bead + BEADS_W));
    }
    return sum;
}

static double energy_in_field(const beads_world *world, int i, const double *y)
{
    const double *bead = y + FST_BEAD_NUMBERS * i;
    fst_gradient_double unused;
    double b[3] = {0.0, 0.0, 0.0};
    if (world->surrounded) {
        const double x[3] = {bead[0], bead[1], beads_height(world, i, y)};
        double change[3];
        fst_surroundings_field(&world->around, beads_time(world, y), x, b, &unused, change);
    } else if (world->field)
        world->field(world->source, bead[0], bead[1], beads_height(world, i, y), b, &unused);
    const double *aside = world->sideways, along = aside[0] * bead[0] + aside[1] * bead[1];
    return (world->body[i].mass - world->body[i].displaced) * (world->gravity * bead[2] - along) -
           world->body[i].strength * beads_dot(bead + BEADS_N, b);
}

static double energy_of_pair(const beads_world *world, int i, int j, const double *y)
{
    const double *n = y + FST_BEAD_NUMBERS * i + BEADS_N, *m = y + FST_BEAD_NUMBERS * j + BEADS_N;
    double d[3];
    beads_way(world, y, i, j, d);
    const double d2 = beads_dot(d, d), along = beads_dot(n, d) * beads_dot(m, d) / d2;
    return world->body[i].dipole * world->body[j].dipole * (beads_dot(n, m) - 3.0 * along) / (d2 * sqrt(d2));
}

double beads_energy(const beads_world *world, const int *gone, const double *y)
{
    double sum = beads_kinetic_energy(world, gone, y);
    for (int i = 0; i < world->count; ++i) {
        if (gone[i])
            continue;
        sum += energy_in_field(world, i, y);
        for (int j = i + 1; j < world->count; ++j)
            sum += gone[j] ? 0.0 : energy_of_pair(world, i, j, y);
    }
    return sum;
}
