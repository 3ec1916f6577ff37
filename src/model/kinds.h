/* kinds.h - the choices of a model that its bodies branch on; what runs that share a batch of lanes share. */
#ifndef FST_MODEL_KINDS_H
#define FST_MODEL_KINDS_H

#include <festoon/festoon.h>

/* The modes of dry friction (contact/coulomb.inl). */
enum { FST_MODE_SLIP, FST_MODE_STICK, FST_MODE_ONSET, FST_MODE_FLIGHT, FST_MODES };

/* And of rolling resistance (contact/resistance.inl). */
enum { FST_ROLL_ROLLS, FST_ROLL_RESTS, FST_ROLL_STARTS, FST_ROLL_MODES };

typedef struct fst_kinds {
    int source;               /* row of FST_SOURCES (festoon/physics.def) */
    int pieces;               /* that the source is made of: lines */
    int contact;              /* row of FST_CONTACTS */
    int magnetisable;         /* the material has a or b: the general force and torque */
    int gyroscopic_term_lost; /* dynamics farago2020 */
    int dry;                  /* the law sees the push A and the rotation, and may resist rolling */
    int patch;                /* FST_PATCH_*: of a contact with modes, its shape */
    int flies;                /* a bead on which the load vanishes leaves the plate and comes down again */
    int resists;              /* the plate resists rolling, in modes of its own */
    int paced;                /* the law has modes, and while the bead slips a step measures its own time */
} fst_kinds;

/* The contact law that acts: dry friction of no strength is no friction, and rolling against a resistance is
 * dry friction that nothing overcomes, because it has modes. */
static inline int fst_law_in_effect(const fst_params *p, fst_friction_law law)
{
    const int acts = p->friction_mu > 0 || p->friction_mu_static > 0 || p->friction_contact_rate > 0 ||
                     p->friction_rolling_resistance > 0;
    if (law == FST_FRICTION_ROLLING && p->friction_rolling_resistance > 0)
        return FST_FRICTION_COULOMB;
    return law == FST_FRICTION_COULOMB && !acts ? FST_FRICTION_NONE : (int)law;
}

static inline int fst_kinds_equal(const fst_kinds *a, const fst_kinds *b)
{
    return a->source == b->source && a->pieces == b->pieces && a->contact == b->contact &&
           a->magnetisable == b->magnetisable && a->gyroscopic_term_lost == b->gyroscopic_term_lost &&
           a->dry == b->dry && a->patch == b->patch && a->flies == b->flies && a->resists == b->resists &&
           a->paced == b->paced;
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
