/* cylinder_fields.h - the field of a magnetised cylinder in long double and in double, and the errors of one
 * over the other. */
#ifndef FST_TESTS_CYLINDER_FIELDS_H
#define FST_TESTS_CYLINDER_FIELDS_H

#include "both_precisions.h"

#include "charged_surfaces.h"

#define COUNT(array) (sizeof(array) / sizeof *(array))

typedef struct cylinder {
    double radius, half, j[3];
} cylinder;

#define FLAT(f)                                                                                                \
    {                                                                                                          \
        (f).b[0], (f).b[1], (f).b[2], (f).gradient.xx, (f).gradient.yy, (f).gradient.xy, (f).gradient.xz,      \
            (f).gradient.yz, (f).bend.xxx, (f).bend.xxy, (f).bend.xyy, (f).bend.yyy, (f).bend.xxz,             \
            (f).bend.xyz, (f).bend.yyz                                                                         \
    }

static inline fst_part_long_double part_ld(const cylinder *c)
{
    fst_part_long_double part;
    memset(&part, 0, sizeof part);
    part.half[0] = part.half[1] = c->radius;
    part.half[2] = c->half;
    for (int i = 0; i < 3; ++i)
        part.j[i] = c->j[i];
    return part;
}

static inline void field_ld(const cylinder *c, const long double place[3], long double *out)
{
    const fst_part_long_double part = part_ld(c);
    fst_local_field_long_double f;
    fst_cylinder_look_long_double(&part, place, &f);
    const long double flat[FIELD_NUMBERS] = FLAT(f);
    memcpy(out, flat, sizeof flat);
}

static inline void field_double(const cylinder *c, const double place[3], long double *out)
{
    fst_part_double part;
    memset(&part, 0, sizeof part);
    part.half[0] = part.half[1] = c->radius;
    part.half[2] = c->half;
    memcpy(part.j, c->j, sizeof part.j);
    fst_local_field_double f;
    fst_cylinder_look_double(&part, place, &f);
    const long double flat[FIELD_NUMBERS] = FLAT(f);
    memcpy(out, flat, sizeof flat);
}

/* Errors of B, G and T over their greatest components.  T vanishes at places on the axis: there G over the
 * distance from the centre is its measure. */
typedef struct errors {
    double b, g, t;
} errors;

static inline long double greatest(const long double *a, int from, int to)
{
    long double size = 0;
    for (int i = from; i < to; ++i)
        size = fmaxl(size, fabsl(a[i]));
    return size;
}

static inline errors errors_of(const long double *found, const long double *exact, const long double place[3])
{
    long double off[FIELD_NUMBERS];
    for (int i = 0; i < FIELD_NUMBERS; ++i) {
        off[i] = found[i] - exact[i];
        if (!isfinite(off[i]))
            fail_msg("number %d of the field is %Lg, expected %Lg", i, found[i], exact[i]);
    }
    const long double g = greatest(exact, FIELD_G, FIELD_T), t = greatest(exact, FIELD_T, FIELD_NUMBERS);
    const long double distance = sqrtl(place[0] * place[0] + place[1] * place[1] + place[2] * place[2]);
    return (errors){(double)(greatest(off, FIELD_B, FIELD_G) / greatest(exact, FIELD_B, FIELD_G)),
                    (double)(greatest(off, FIELD_G, FIELD_T) / g),
                    (double)(greatest(off, FIELD_T, FIELD_NUMBERS) / fmaxl(t, g / distance))};
}

static inline void check_errors(errors found, double b, double g, double t)
{
    CHECK_WITHIN(found.b, 0, b);
    CHECK_WITHIN(found.g, 0, g);
    CHECK_WITHIN(found.t, 0, t);
}

#endif
