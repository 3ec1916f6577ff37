/* world.h - what never changes while several beads move: bodies, contacts, plate, magnet.
 *
 * Units are those of festoon.h; masses are in that of the scene's bead.  A motion has twelve numbers for each
 * bead, vectors of the laboratory in components along axes that turn with the magnet:
 *
 *     place (3)   velocity (3)   moment n (3)   angular velocity W (3)
 *
 * The third component of a place is the height of the centre over that of the bead at rest in the middle of the
 * plate, which on a flat plate is the gap of its contact; without a plate it is the height over the magnet's
 * reference plane.  Behind the beads' numbers a step carries integrals over time, which judge no error.
 *
 * Contacts are numbered: bead i with the plate is i, and behind these come the pairs.
 */
#ifndef FST_BEADS_WORLD_H
#define FST_BEADS_WORLD_H

#include <festoon/beads.h>

#include "model/surroundings.h"

enum { BEADS_PAIRS = FST_BEADS_MOST * (FST_BEADS_MOST - 1) / 2, BEADS_CONTACTS = FST_BEADS_MOST + BEADS_PAIRS };

/* Where the vectors of a bead begin among its numbers. */
enum { BEADS_V = 3, BEADS_N = 6, BEADS_W = 9 };

/* Integrals over time: the work of the drive, the losses at the plate, between beads and to the medium; then r
 * of each bead, the load on the plate under each, and its height over that of a bead at rest on the plate, or without a
 * plate over the reference plane; the time since the start of the step. */
enum { BEADS_DRIVE, BEADS_PLATE, BEADS_PAIR, BEADS_MEDIUM, BEADS_R, BEADS_LOAD = BEADS_R + FST_BEADS_MOST };
enum {
    BEADS_HEIGHT = BEADS_LOAD + FST_BEADS_MOST,
    BEADS_TIME = BEADS_HEIGHT + FST_BEADS_MOST,
    BEADS_INTEGRALS
};
enum { BEADS_NUMBERS = FST_BEADS_MOST * FST_BEAD_NUMBERS, BEADS_DIM = BEADS_NUMBERS + BEADS_INTEGRALS };

typedef struct beads_body {
    double radius, mass;
    double inertia;   /* moment of inertia, beta m R^2 */
    double strength;  /* moment times B0: the energy in the field B is -strength n.B */
    double dipole;    /* square root of its chi: two beads have the energy dipole_i dipole_j/|d|^3 times ... */
    double added;     /* mass of the medium that moves with it */
    double displaced; /* mass of the medium in its place, by which gravity pulls it less */
    double drag, fast_drag; /* the medium's force -(drag + fast_drag |v|) v */
    double spin_drag;       /* and its torque -spin_drag W */
} beads_body;

/* How far the surface of the magnet is from a place. */
typedef double beads_clearance(const void *source, double x, double y, double z);

/* The field at a place, z over the magnet's reference plane. */
typedef void beads_field(const void *source, double x, double y, double z, double b[3],
                         fst_gradient_double *gradient);

typedef struct beads_contact {
    int first, second;    /* second: -1 for the plate */
    double reach;         /* distance of the centres in touch; 0: the plate */
    double friction;      /* force over the speed of the contact's slip */
    double mu;            /* of dry friction; 0: there is none */
    double inertia_of[2]; /* 1/m of either bead, added mass included; 0 for the plate */
} beads_contact;

/* Contacts are listed for the exact method alone, which takes FST_BEADS_MOST beads. */
typedef struct beads_world {
    int count, contacts;
    beads_body body[FST_BEADS_MANY];
    beads_contact contact[BEADS_CONTACTS];
    beads_field *field; /* NULL: no magnet */
    const void *source;
    beads_clearance
        *clearance; /* a bead that comes as near as its radius is gone; NULL: it does not come near */
    double plate; /* height of the plate's surface over the magnet's reference plane; NAN: there is no plate */
    double bowl;  /* radius of the bowl whose lowest point is the plate's middle; 0: the plate is flat */
    double gravity, omega; /* gravity: downwards */
    double sideways[2];    /* gravity along a tilted plate, in the frame of the laboratory */
    int surrounded; /* `around` is in the place of `field`, and its frame in that of one that turns at omega */
    fst_surroundings around;
    double now; /* the time at the start of the step */
    double plate_rate,
        pair_rate; /* friction of contacts per mass: at the plate; of two beads per reduced mass, doubled */
    double plate_radius;      /* a bead is gone whose centre passes it, without a plate in any direction */
    double plate_mu, pair_mu; /* dry friction */
    double still;             /* a contact that slips more slowly sticks if friction holds it */
    double free_at;           /* a slip that began goes on by its own direction at this speed */
    double restitution;
    double bounce_least; /* no contact bounces that closes more slowly */
} beads_world;

/* Set the rates of friction, and number the contacts if they are to be listed. */
void beads_number_contacts(beads_world *world, double plate_rate, double pair_rate);

/* Whether a contact has dry friction. */
static inline int beads_is_dry(const beads_world *world)
{
    return world->plate_mu > 0 || world->pair_mu > 0;
}

/* The field of a model, and the clearance: of a magnet of parts from the nearest one, of lines from their plane. */
void beads_model_field(const void *model, double x, double y, double z, double b[3], fst_gradient_double *g);
double beads_model_clearance(const void *model, double x, double y, double z);

/* The gap between bead i and the plate; INFINITY: there is none. */
double beads_plate_gap(const beads_world *world, int i, const double *y);

/* What lies where a bead is gone: the edge, the magnet or the wire of a coil, or the sources of a wave, of which a wave's
 * length in their direction is as much as this program believes: its field grows without bound. */
enum { BEADS_AT_EDGE, BEADS_AT_MAGNET, BEADS_AT_SOURCES };

/* The way to where bead i is gone, and what lies there. */
double beads_way_out(const beads_world *world, int i, const double *y, int *what);

/* Kinetic energy, and with it that in gravity, in the magnet's field and of the dipoles in each other's; of
 * the beads that are not `gone`. */
double beads_kinetic_energy(const beads_world *world, const int *gone, const double *y);
double beads_energy(const beads_world *world, const int *gone, const double *y);

/* The time of a step's numbers, or of those of a stage. */
static inline double beads_time(const beads_world *world, const double *y)
{
    return world->now + y[FST_BEAD_NUMBERS * world->count + BEADS_TIME];
}

/* What a force accelerates. */
static inline double beads_moved_mass(const beads_body *body)
{
    return body->mass + body->added;
}

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

/* The angle about the axis from one vector to another. */
static inline double beads_turned_by(const double *from, const double *to)
{
    return atan2(from[0] * to[1] - from[1] * to[0], from[0] * to[0] + from[1] * to[1]);
}

/* The way from the centre of bead i to that of bead j. */
static inline void beads_way(const beads_world *world, const double *y, int i, int j, double d[3])
{
    const double *a = y + FST_BEAD_NUMBERS * i, *b = y + FST_BEAD_NUMBERS * j;
    d[0] = b[0] - a[0];
    d[1] = b[1] - a[1];
    d[2] = b[2] - a[2] + (isnan(world->plate) ? 0.0 : world->body[j].radius - world->body[i].radius);
}

/* Force over the speed of the slip of a contact; j = -1: with the plate. */
static inline double beads_friction(const beads_world *world, int i, int j)
{
    const double m = world->body[i].mass, n = j < 0 ? 0.0 : world->body[j].mass;
    return j < 0 ? world->plate_rate * m : world->pair_rate * (2.0 * m * n / (m + n));
}

#endif
