/* even.inl - a vertical field and a gradient of it, both the same everywhere, over REAL.  No magnet has both,
 * but the equations of motion ask for nothing else: a bead with an isotropic magnetisability is pulled along X
 * by a constant force and feels no torque, and a hard bead without slope feels a torque and no force.
 */
typedef struct FN(even) {
    REAL field, slope;
} FN(even);

static inline FN(even) FN(make_even)(const fst_params *params, const fst_groups *g)
{
    (void)g;
    const FN(even) numbers = {REAL_OF(params->own_field), REAL_OF(params->own_slope)};
    return numbers;
}

static inline __attribute__((always_inline)) void
FN(even_look)(const FN(even) * numbers, const fst_kinds *kinds, REAL x, REAL y, REAL z, FN(local_field) * at)
{
    (void)kinds, (void)x, (void)y, (void)z;
    const REAL zero = R(0.0), one = R(1.0);
    const FN(local_field) here = {{zero, zero, numbers->field},
                                  {zero, zero, zero, numbers->slope, zero, zero},
                                  {one, one, zero, zero, zero, zero, zero, zero, zero, zero, zero}};
    *at = here;
}

SOURCE_ALONG_BY_LOOK(even)
