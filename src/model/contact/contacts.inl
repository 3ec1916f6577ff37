/* contacts.inl - what the plate does: the one in use of the contact laws of festoon/physics.def, over REAL.
 *
 * A law NAME is a file NAME.inl, included here, with a row in physics.def.  It supplies
 *
 *     NAME           a struct of its numbers, REALs alone (with lanes each lane has its own);
 *     make_NAME()    these numbers of the parameters and the scaled groups;
 *     NAME_force()   f of a contact: minus the plate's horizontal force on the bead, per mass;
 *     NAME_change()  the change of f as the contact changes by `by`: the exact derivative along that direction;
 *     NAME_loss()    the power that it takes from the motion, f.V and what else the law dissipates; at least 0.
 *
 * All by + - * / and square roots.  The equations of motion, their tangents, energies, orbits and lanes follow.
 *
 * Modes.  A law that is not a single smooth function, such as dry friction, which slips or sticks, has several
 * smooth modes (the column `modes` of physics.def).  The motion says in which mode the bead is (modes.inl).
 * Only dry friction has that, so a row of your own with more than one mode does not compile.
 *
 * Resistances.  The dry laws also act by a torque on a bead that rolls (resistance.inl), and where the contact
 * is a disc, on one that pivots (patch.inl).
 */

/* Whether the contact has what only dry laws have: kinds.dry, modes, resists, patch, flies.  Lanes are compiled
 * once for the dry laws (FST_DRY_LANES), at a point of contact, without flight and on a plate that does not
 * resist rolling, and once for all others: saying so here keeps the formulas of the ones out of the loops of
 * the others.
 */
#undef HAS
#undef LAW_IS
#undef IS_DRY
#undef KNOWS_DRY
#define IS_DRY(NAME)                                                                                           \
    (FST_FRICTION_##NAME == FST_FRICTION_COULOMB || FST_FRICTION_##NAME == FST_FRICTION_ROLLING)
#ifdef REAL_IS_SCALAR
#define KNOWS_DRY 1
#define HAS(kinds, what) ((kinds).what)
#define LAW_IS(NAME) (kinds->contact == FST_FRICTION_##NAME)
#elif defined FST_DRY_LANES
#define KNOWS_DRY 1
#define DRY_LANES_dry(kinds) 1
#define DRY_LANES_modes(kinds) ((kinds).modes)
#define DRY_LANES_resists(kinds) 0
#define DRY_LANES_patch(kinds) FST_PATCH_POINT
#define DRY_LANES_flies(kinds) 0
#define HAS(kinds, what) DRY_LANES_##what(kinds)
#define LAW_IS(NAME) (IS_DRY(NAME) && kinds->contact == FST_FRICTION_##NAME)
#else
#define KNOWS_DRY 0
#define HAS(kinds, what) 0
#define LAW_IS(NAME) (!IS_DRY(NAME) && kinds->contact == FST_FRICTION_##NAME)
#endif

/* The length of a horizontal vector. */
static inline REAL FN(norm_2)(const REAL v[2])
{
    return REAL_SQRT(v[0] * v[0] + v[1] * v[1]);
}

#include "model/contact/lag.inl"
#include "model/contact/modes.inl"

/* What a law sees of the contact.  A law that needs more adds it here and in contact_of() and its tangent
 * (dynamics.inl, tangent.inl). */
typedef struct FN(contact) {
    REAL slip[2]; /* V, velocity of the contact point */
    REAL load;    /* N, normal load per mass */
    /* For the dry laws only (kinds.dry): */
    const FN(modes) * modes; /* of the motion, */
    REAL time;               /* and how long ago the step began, where a mode needs it */
    REAL push[2];            /* A: V' = A - k f */
    REAL share;              /* 1/k: f = A/k keeps a contact at rest */
    REAL torque[3];          /* m, that of the resistances, per mass */
    REAL balance[2];         /* T, of a bead that is kept from rolling (kinds.resists) */
    /* Where the contact is a disc (kinds.patch): */
    int patch;  /* FST_PATCH_* */
    REAL pivot; /* w = W.e */
} FN(contact);

#include "model/contact/patch.inl"
#include "model/contact/resistance.inl"

#include "model/contact/coulomb.inl"
#include "model/contact/none.inl"
#include "model/contact/rolling.inl"
#include "model/contact/viscous.inl"
#ifdef FST_OWN_CONTACT_BODIES
#include FST_OWN_CONTACT_BODIES
#endif

#define ONE_MODE(NAME, name, modes, brakes, doc)                                                               \
    _Static_assert((modes) == 1 || FST_FRICTION_##NAME == FST_FRICTION_COULOMB,                                \
                   "contact law " #name ": the flow knows the transitions of dry friction only");
FST_CONTACTS(ONE_MODE)
#undef ONE_MODE

/* The numbers of the law in use. */
#define MEMBER(NAME, name, modes, brakes, doc) FN(name) name;
typedef union FN(law_numbers) {
    FST_CONTACTS(MEMBER)
} FN(law_numbers);
#undef MEMBER

static inline FN(law_numbers)
    FN(make_law_numbers)(const fst_kinds *kinds, const fst_params *params, const fst_groups *g)
{
    static const FN(law_numbers) nothing;
    FN(law_numbers) numbers = nothing;
#define MAKE(NAME, name, modes, brakes, doc)                                                                   \
    if (kinds->contact == FST_FRICTION_##NAME)                                                                 \
        numbers.name = FN(make_##name)(params, g);
    FST_CONTACTS(MAKE)
#undef MAKE
    return numbers;
}

static inline __attribute__((always_inline)) void
FN(friction)(const FN(law_numbers) * law, const fst_kinds *kinds, const FN(contact) * at, REAL force[2])
{
#define FORCE(NAME, name, modes, brakes, doc)                                                                  \
    if (LAW_IS(NAME)) {                                                                                        \
        FN(name##_force)(&law->name, at, force);                                                               \
        return;                                                                                                \
    }
    FST_CONTACTS(FORCE)
#undef FORCE
    __builtin_unreachable();
}

static inline __attribute__((always_inline)) void FN(friction_change)(const FN(law_numbers) * law,
                                                                      const fst_kinds *kinds,
                                                                      const FN(contact) * at,
                                                                      const FN(contact) * by, REAL change[2])
{
#define CHANGE(NAME, name, modes, brakes, doc)                                                                 \
    if (LAW_IS(NAME)) {                                                                                        \
        FN(name##_change)(&law->name, at, by, change);                                                         \
        return;                                                                                                \
    }
    FST_CONTACTS(CHANGE)
#undef CHANGE
    __builtin_unreachable();
}

static inline __attribute__((always_inline)) REAL
FN(friction_loss)(const FN(law_numbers) * law, const fst_kinds *kinds, const FN(contact) * at)
{
#define LOSS(NAME, name, modes, brakes, doc)                                                                   \
    if (LAW_IS(NAME))                                                                                          \
        return FN(name##_loss)(&law->name, at);
    FST_CONTACTS(LOSS)
#undef LOSS
    __builtin_unreachable();
}
