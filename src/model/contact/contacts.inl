/* contacts.inl - what the plate does: the one in use of the contact laws of festoon/physics.def, over REAL.
 *
 * A law NAME is a file NAME.inl, included here, with a row in physics.def.  It supplies
 */
/* clang-format off */
/*
 *     NAME           a struct of its numbers, REALs alone (with lanes each lane has its own);
 *     make_NAME()    these numbers of the parameters and the scaled groups;
 *     NAME_force()   f of a contact: minus the plate's horizontal force on the bead, per mass;
 *     NAME_change()  the change of f as the contact changes by `by`: the exact derivative along that direction;
 *     NAME_loss()    the power that it takes from the motion, f.V and what else the law dissipates; at least 0.
 */
/* clang-format on */
/*
 * All by + - * / and square roots.  The equations of motion, their tangents, energies, orbits and lanes follow.
 *
 * Modes.  A law that is no single smooth function, such as dry friction, which slips or sticks, has several
 * smooth modes (the column `modes` of physics.def).  Such a law will supply, besides, for each mode: f and its
 * change in that mode (contact.mode says which; with lanes, a number of each lane, by which f is selected
 * without a branch); the functions of the state whose zeros end the mode, located as other events are
 * (ode/events.c); and the transition there: the mode that follows, the state's jump if there is one, and the
 * matrix by which tangents jump.  Between two transitions it may have smooth variables of its own (a slip speed
 * and direction, a stretched time), to and from which it maps the state.  No law has this yet, so the flow has
 * no transitions, and a row with more than one mode does not compile.
 */

/* What a law sees of the contact.  A law that needs more, as the angular velocity for rolling resistance, adds
 * it here and in contact_of() and its tangent (dynamics.inl, tangent.inl). */
typedef struct FN(contact) {
    REAL slip[2]; /* V, velocity of the contact point */
    REAL load;    /* N, normal load per mass */
} FN(contact);

#include "model/contact/none.inl"
#include "model/contact/viscous.inl"
#ifdef FST_OWN_CONTACT_BODIES
#include FST_OWN_CONTACT_BODIES
#endif

#define ONE_MODE(NAME, name, modes, brakes, doc)                                                               \
    _Static_assert((modes) == 1, "contact law " #name ": the flow has no transitions between modes yet");
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
    if (kinds->contact == FST_FRICTION_##NAME) {                                                               \
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
    if (kinds->contact == FST_FRICTION_##NAME) {                                                               \
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
    if (kinds->contact == FST_FRICTION_##NAME)                                                                 \
        return FN(name##_loss)(&law->name, at);
    FST_CONTACTS(LOSS)
#undef LOSS
    __builtin_unreachable();
}
