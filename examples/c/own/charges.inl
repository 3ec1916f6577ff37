/* charges.inl - a source of one's own: two opposite point charges on the X axis, over REAL.
 *
 * With d from a charge q to the bead, B = sum of q d/|d|^3 and so on, as for the lines of festoon: lines of one
 * piece are this source with own.reach = 1 and own.charge = 5.
 */
typedef struct FN(charges) {
    REAL charge, reach, shift;
} FN(charges);

static inline FN(charges) FN(make_charges)(const fst_params *params, const fst_groups *g)
{
    (void)g;
    FN(charges) numbers;
    numbers.charge = REAL_OF(params->own_charge);
    numbers.reach = REAL_OF(params->own_reach);
    numbers.shift = REAL_OF(params->own_shift);
    return numbers;
}

static inline __attribute__((always_inline)) void FN(add_charge)(REAL q, REAL x, REAL y, REAL z,
                                                                 FN(local_field) * at)
{
    FN(gradient) *g = &at->gradient;
    FN(bend) *t = &at->bend;
    const REAL inverse = REAL_RECIPROCAL_SQRT(x * x + y * y + z * z), inverse2 = inverse * inverse;
    const REAL q3 = q * inverse2 * inverse, q5 = R(3.0) * q3 * inverse2, q7 = R(5.0) * q5 * inverse2;
    at->b[0] = at->b[0] + q3 * x;
    at->b[1] = at->b[1] + q3 * y;
    at->b[2] = at->b[2] + q3 * z;
    g->xx = g->xx + (q3 - q5 * x * x);
    g->yy = g->yy + (q3 - q5 * y * y);
    g->xy = g->xy - q5 * x * y;
    g->xz = g->xz - q5 * x * z;
    g->yz = g->yz - q5 * y * z;
    t->xxx = t->xxx + x * (q7 * x * x - R(3.0) * q5);
    t->xxy = t->xxy + y * (q7 * x * x - q5);
    t->xyy = t->xyy + x * (q7 * y * y - q5);
    t->yyy = t->yyy + y * (q7 * y * y - R(3.0) * q5);
    t->xxz = t->xxz + z * (q7 * x * x - q5);
    t->xyz = t->xyz + z * (q7 * x * y);
    t->yyz = t->yyz + z * (q7 * y * y - q5);
}

static inline __attribute__((always_inline)) void FN(charges_look)(const FN(charges) * numbers,
                                                                   const fst_kinds *kinds, REAL x, REAL y,
                                                                   REAL z, FN(local_field) * at)
{
    (void)kinds;
    const REAL zero = R(0.0), one = R(1.0);
    const FN(local_field) nothing = {{zero, zero, zero},
                                     {zero, zero, zero, zero, zero, zero},
                                     {one, one, zero, zero, zero, zero, zero, zero, zero, zero, zero}};
    *at = nothing;
    FN(add_charge)(numbers->charge, x - (numbers->shift + numbers->reach), y, z, at);
    FN(add_charge)(-numbers->charge, x - (numbers->shift - numbers->reach), y, z, at);
}

SOURCE_ALONG_BY_LOOK(charges)
