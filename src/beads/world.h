/* world.h - what never changes while several beads move: bodies, contacts, plate, magnet.
 *
 * Units are those of festoon.h; masses are in that of the scene's bead.  A motion has twelve numbers for each
 * bead, vectors of the laboratory in components along axes that turn with the magnet:
 *
 *     place (3)   velocity (3)   moment n (3)   angular velocity W (3)
 *
 * The third component of a place is the height of the centre over that of the bead at rest on the plate, which
 * is the gap of its contact there.  Behind the beads' numbers a step carries integrals over time, which judge
 * no error.
 *
 * Contacts are numbered: bead i with the plate is i, and behind these come the pairs.
 */
#ifndef FST_BEADS_WORLD_H
#define FST_BEADS_WORLD_H

#include <festoon/beads.h>

#include "model/model.h"

enum { BEADS_PAIRS = FST_BEADS_MOST * (FST_BEADS_MOST - 1) / 2, BEADS_CONTACTS = FST_BEADS_MOST + BEADS_PAIRS };

/* Where the vectors of a bead begin among its numbers. */
enum { BEADS_V = 3, BEADS_N = 6, BEADS_W = 9 };

/* Integrals over time: the work of the drive, the losses at the plate and between beads; then r of each bead,
 * and the load on the plate under each. */
enum { BEADS_DRIVE, BEADS_PLATE, BEADS_PAIR, BEADS_R, BEADS_LOAD = BEADS_R + FST_BEADS_MOST };
enum { BEADS_INTEGRALS = BEADS_LOAD + FST_BEADS_MOST };
enum { BEADS_NUMBERS = FST_BEADS_MOST * FST_BEAD_NUMBERS, BEADS_DIM = BEADS_NUMBERS + BEADS_INTEGRALS };

typedef struct beads_body {
    double radius, mass;
    double inertia;  /* moment of inertia, beta m R^2 */
    double strength; /* moment times B0: the energy in the field B is -strength n.B */
    double dipole;   /* square root of its chi: two beads have the energy dipole_i dipole_j/|d|^3 times ... */
} beads_body;

/* The field at a place, z over the magnet's reference plane. */
typedef void beads_field(const void *source, double x, double y, double z, double b[3],
                         fst_gradient_double *gradient);

typedef struct beads_contact {
    int first, second;    /* second: -1 for the plate */
    double reach;         /* distance of the centres in touch; 0: the plate */
    double friction;      /* force over the speed of the contact's slip */
    double inertia_of[2]; /* 1/m of either bead, 0 for the plate */
} beads_contact;

typedef struct beads_world {
    int count, contacts;
    beads_body body[FST_BEADS_MOST];
    beads_contact contact[BEADS_CONTACTS];
    beads_field *field; /* NULL: no magnet */
    const void *source;
    double plate; /* height of the plate's surface over the magnet's reference plane; NAN: there is no plate */
    double gravity, omega;
    double plate_radius; /* a bead whose centre passes it is ejected */
    double restitution;
    double bounce_least; /* no contact bounces that closes more slowly */
} beads_world;

/* Number the contacts of bodies whose plate has the friction `plate_rate`, and whose pairs have `pair_rate`,
 * per mass of the bead; of two beads per twice their reduced mass. */
void beads_number_contacts(beads_world *world, double plate_rate, double pair_rate);

/* The field of a model. */
void beads_model_field(const void *model, double x, double y, double z, double b[3], fst_gradient_double *g);

/* Kinetic energy, and with it that in gravity, in the magnet's field and of the dipoles in each other's; of
 * the beads that are not `gone`. */
double beads_kinetic_energy(const beads_world *world, const int *gone, const double *y);
double beads_energy(const beads_world *world, const int *gone, const double *y);

/* The place of a bead's centre over the reference plane. */
static inline double beads_height(const beads_world *world, int bead, const double *y)
{
    const double base = isnan(world->plate) ? 0.0 : world->plate + world->body[bead].radius;
    return base + y[FST_BEAD_NUMBERS * bead + 2];
}

static inline double beads_dot(const double a[3], const double b[3])
{
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

#endif
