/* kinds.h - the choices of a model that its bodies branch on; what runs that share a batch of lanes share. */
#ifndef FST_MODEL_KINDS_H
#define FST_MODEL_KINDS_H

#include <string.h>

#include <festoon/festoon.h>

#include "model/field_map.h"

typedef struct fst_kinds {
    int source;               /* row of FST_SOURCES (festoon/physics.def) */
    int pieces;               /* that the source is made of: lines, parts */
    int contact;              /* row of FST_CONTACTS */
    int magnetisable;         /* the material has a or b: the general force and torque */
    int gyroscopic_term_lost; /* dynamics farago2020 */
    int dry;                  /* the law sees the push A and the rotation, and may resist rolling */
    int patch;                /* FST_PATCH_*: of a contact with modes, its shape */
    int flies;                /* a bead on which the load vanishes leaves the plate and comes down again */
    int resists;              /* the plate resists rolling, in modes of its own */
    int modes;                /* the law has modes (contact/modes.inl) */
    int rolls;                /* the law is that of a bead that never slips */
    unsigned char part[FST_PARTS_MAX];        /* fst_part_kind of each part of the magnet */
    unsigned char part_turned[FST_PARTS_MAX]; /* whether its axes are not those of the magnet */
    const fst_map_plane *plane; /* of a measured map: the plane in which the bead's centre moves */
} fst_kinds;

/* B0 in T of a real or measured magnet unless magnet.b0 is given: there it is only a unit. */
#define FST_PARTS_FIELD_UNIT 0.01

/* What the magnet is made of, which lanes of a batch share. */
static inline void fst_count_pieces(fst_kinds *kinds, const fst_params *p, const fst_groups *g)
{
    kinds->plane = NULL;
    if (kinds->source == FST_MAGNET_GRID && p->magnet_map)
        kinds->plane = fst_map_plane_at(p->magnet_map, g->h * g->length_unit);
    memset(kinds->part, 0, sizeof kinds->part);
    memset(kinds->part_turned, 0, sizeof kinds->part_turned);
    kinds->pieces = kinds->source == FST_MAGNET_PARTS ? p->magnet_part_count : p->magnet_lines;
    for (int i = 0; kinds->source == FST_MAGNET_PARTS && i < kinds->pieces; ++i) {
        kinds->part[i] = (unsigned char)p->magnet_parts[i].kind;
        kinds->part_turned[i] = p->magnet_parts[i].rotation[0] != 0;
    }
}

/* The contact law that acts: dry friction of no strength is not friction, and rolling against a resistance is
 * dry friction that nothing overcomes, because it has modes. */
static inline int fst_law_in_effect(const fst_params *p, fst_friction_law law)
{
    const int acts = p->friction_mu > 0 || p->friction_mu_static > 0 || p->friction_rolling_resistance > 0;
    if (law == FST_FRICTION_ROLLING && p->friction_rolling_resistance > 0)
        return FST_FRICTION_COULOMB;
    return law == FST_FRICTION_COULOMB && !acts ? FST_FRICTION_NONE : (int)law;
}

static inline int fst_kinds_equal(const fst_kinds *a, const fst_kinds *b)
{
    return a->source == b->source && a->pieces == b->pieces && a->contact == b->contact &&
           a->magnetisable == b->magnetisable && a->gyroscopic_term_lost == b->gyroscopic_term_lost &&
           a->dry == b->dry && a->patch == b->patch && a->flies == b->flies && a->resists == b->resists &&
           a->modes == b->modes && a->rolls == b->rolls && memcmp(a->part, b->part, sizeof a->part) == 0 &&
           memcmp(a->part_turned, b->part_turned, sizeof a->part_turned) == 0 && a->plane == b->plane;
}

/* Whether the contact law takes energy from a bead that slips.  A bead that rolls may lose some all the same.
 */
static inline int fst_kinds_brake(const fst_kinds *kinds)
{
#define BRAKES(NAME, name, modes, brakes, doc) brakes,
    static const int brakes_of[] = {FST_CONTACTS(BRAKES)};
#undef BRAKES
    return brakes_of[kinds->contact];
}

#endif
