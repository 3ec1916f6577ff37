/* sources.inl - what makes the field: the one in use of the sources of festoon/physics.def, over REAL.
 *
 * A source NAME is a file NAME.inl, included here, with a row in physics.def.  It supplies
 *
 *     NAME          a struct of its numbers, REALs alone (with lanes each lane has its own), which hold no height:
 *                   z is asked for with x and y, in l over the magnet's reference plane;
 *     make_NAME()   these numbers, made of the parameters and the scaled groups;
 *     NAME_look()   B, G and T at (x, y, z) (local_field.inl), by + - * / and square roots; always inlined, so
 *                   that what a caller does not use is not computed;
 *     NAME_field()  B and G;
 *     NAME_along()  B and G u.
 *
 * SOURCE_ALONG_BY_LOOK(NAME) makes the last two of NAME_look(), for a source without a quicker way.
 *
 * A field that has no curl needs not say so: what it has twice is filled in here.
 *
 * Integers that it needs, as a number of pieces, are in fst_kinds (model/kinds.h); lanes of a batch share them.
 * All else follows from these: the field, the equations of motion and their tangents, orbits, lanes.
 */
#ifdef REAL_INVERSE_FIFTH
/* Lanes with fused operations get the whole gradient with B at the price of G u, and keep it for G u along
 * other directions at the same place. */
#define FIELD_KEEPS_GRADIENT
#endif

#include "base/elementary.inl"
#include "model/source/local_field.inl"

#include "model/source/lines.inl"
#include "model/source/parts.inl"
#include "model/source/loop.inl"
#include "model/source/grid.inl"
#ifdef FST_OWN_SOURCE_BODIES
#include FST_OWN_SOURCE_BODIES
#endif

/* The numbers of the source in use. */
#define MEMBER(NAME, name, doc) FN(name) name;
typedef union FN(source_numbers) {
    FST_SOURCES(MEMBER)
} FN(source_numbers);
#undef MEMBER

static inline FN(source_numbers)
    FN(make_source_numbers)(const fst_kinds *kinds, const fst_params *params, const fst_groups *g)
{
    static const FN(source_numbers) nothing;
    FN(source_numbers) numbers = nothing;
#define MAKE(NAME, name, doc)                                                                                  \
    if (kinds->source == FST_MAGNET_##NAME)                                                                    \
        numbers.name = FN(make_##name)(params, g);
    FST_SOURCES(MAKE)
#undef MAKE
    return numbers;
}

/* B, G and T at (x, y), at the height z over the magnet's reference plane. */
static inline __attribute__((always_inline)) void FN(source_look)(const FN(source_numbers) * source,
                                                                  const fst_kinds *kinds, REAL x, REAL y,
                                                                  REAL z, FN(local_field) * at)
{
#define LOOK(NAME, name, doc)                                                                                  \
    if (kinds->source == FST_MAGNET_##NAME) {                                                                  \
        FN(name##_look)(&source->name, kinds, x, y, z, at);                                                    \
        if (FST_MAGNET_##NAME != FST_MAGNET_GRID)                                                              \
            FN(no_curl_anywhere)(at);                                                                          \
        return;                                                                                                \
    }
    FST_SOURCES(LOOK)
#undef LOOK
    __builtin_unreachable();
}

/* B and G there. */
static inline __attribute__((always_inline)) void FN(source_field)(const FN(source_numbers) * source,
                                                                   const fst_kinds *kinds, REAL x, REAL y,
                                                                   REAL z, REAL b[3], FN(gradient) * g)
{
#define FIELD(NAME, name, doc)                                                                                 \
    if (kinds->source == FST_MAGNET_##NAME) {                                                                  \
        FN(name##_field)(&source->name, kinds, x, y, z, b, g);                                                 \
        if (FST_MAGNET_##NAME != FST_MAGNET_GRID)                                                              \
            FN(no_curl)(g);                                                                                    \
        return;                                                                                                \
    }
    FST_SOURCES(FIELD)
#undef FIELD
    __builtin_unreachable();
}

/* B and G u there. */
static inline void FN(source_along)(const FN(source_numbers) * source, const fst_kinds *kinds, REAL x, REAL y,
                                    REAL z, const REAL u[3], REAL b[3], REAL gu[3])
{
#define ALONG(NAME, name, doc)                                                                                 \
    if (kinds->source == FST_MAGNET_##NAME) {                                                                  \
        FN(name##_along)(&source->name, kinds, x, y, z, u, b, gu);                                             \
        return;                                                                                                \
    }
    FST_SOURCES(ALONG)
#undef ALONG
    __builtin_unreachable();
}
