/* world.c - the contacts that beads may have, and their energy. */
#include "beads/world.h"

#include <math.h>

static void add_contact(beads_world *world, int first, int second, double friction)
{
    const double inverse = 1.0 / world->body[first].mass;
    world->contact[world->contacts++] =
        (beads_contact){first,
                        second,
                        second < 0 ? 0.0 : world->body[first].radius + world->body[second].radius,
                        friction,
                        {inverse, second < 0 ? 0.0 : 1.0 / world->body[second].mass}};
}

void beads_number_contacts(beads_world *world, double plate_rate, double pair_rate)
{
    world->contacts = 0;
    for (int i = 0; i < world->count; ++i)
        add_contact(world, i, -1, plate_rate * world->body[i].mass);
    for (int i = 0; i < world->count; ++i)
        for (int j = i + 1; j < world->count; ++j) {
            const double m = world->body[i].mass, n = world->body[j].mass;
            add_contact(world, i, j, pair_rate * (2.0 * m * n / (m + n)));
        }
}

void beads_model_field(const void *model, double x, double y, double z, double b[3], fst_gradient_double *g)
{
    const fst_world_double *c = &((const fst_model *)model)->world;
    fst_source_field_double(&c->source, &c->kinds, x, y, z, b, g);
}

double beads_kinetic_energy(const beads_world *world, const int *gone, const double *y)
{
    double sum = 0.0;
    for (int i = 0; i < world->count; ++i) {
        const double *bead = y + FST_BEAD_NUMBERS * i;
        const beads_body *body = &world->body[i];
        if (!gone[i])
            sum += 0.5 * (body->mass * beads_dot(bead + BEADS_V, bead + BEADS_V) +
                          body->inertia * beads_dot(bead + BEADS_W, bead + BEADS_W));
    }
    return sum;
}

static double energy_in_field(const beads_world *world, int i, const double *y)
{
    const double *bead = y + FST_BEAD_NUMBERS * i;
    fst_gradient_double unused;
    double b[3] = {0.0, 0.0, 0.0};
    if (world->field)
        world->field(world->source, bead[0], bead[1], beads_height(world, i, y), b, &unused);
    return world->body[i].mass * world->gravity * bead[2] -
           world->body[i].strength * beads_dot(bead + BEADS_N, b);
}

static double energy_of_pair(const beads_world *world, int i, int j, const double *y)
{
    const double *a = y + FST_BEAD_NUMBERS * i, *b = y + FST_BEAD_NUMBERS * j;
    const double lift = isnan(world->plate) ? 0.0 : world->body[j].radius - world->body[i].radius;
    const double d[3] = {b[0] - a[0], b[1] - a[1], b[2] - a[2] + lift}, d2 = beads_dot(d, d);
    const double along = beads_dot(a + BEADS_N, d) * beads_dot(b + BEADS_N, d) / d2;
    return world->body[i].dipole * world->body[j].dipole * (beads_dot(a + BEADS_N, b + BEADS_N) - 3.0 * along) /
           (d2 * sqrt(d2));
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
