/* derivatives.inl - what a uniformly magnetised body of any form needs of its form, over REAL.
 *
 * With Phi = the integral of 1/|x - x'| over the body, and J its remanence,
 *
 *     4 pi B_i = Phi_ij J_j,     4 pi G_ij = Phi_ijk J_k,     4 pi T_ijk = Phi_ijkl J_l,
 *
 * the indices being derivatives.  Outside the body Phi is harmonic, so that a second derivative along z is
 * minus the sum of those along x and y: 5 + 7 + 9 numbers.
 */
enum { FN(form_of_field) = 12, FN(form_all) = 21 }; /* without and with the fourth derivatives */

typedef union FN(form) {
    struct {
        REAL xx, xy, yy, xz, yz;
        REAL xxx, xxy, xyy, yyy, xxz, xyz, yyz;
        REAL xxxx, xxxy, xxyy, xyyy, yyyy, xxxz, xxyz, xyyz, yyyz;
    };
    REAL all[FN(form_all)];
} FN(form);

static inline __attribute__((always_inline)) void FN(field_of_form)(const FN(form) * f, const REAL j[3],
                                                                    REAL b[3], FN(gradient) * g)
{
    const REAL weight = R(0.07957747154594766788444188168626); /* 1/(4 pi) */
    const REAL x = weight * j[0], y = weight * j[1], z = weight * j[2];
    b[0] = REAL_MULADD(f->xz, z, REAL_MULADD(f->xy, y, f->xx * x));
    b[1] = REAL_MULADD(f->yz, z, REAL_MULADD(f->yy, y, f->xy * x));
    b[2] = REAL_NEGMULADD(f->xx + f->yy, z, REAL_MULADD(f->yz, y, f->xz * x));
    g->xx = REAL_MULADD(f->xxz, z, REAL_MULADD(f->xxy, y, f->xxx * x));
    g->xy = REAL_MULADD(f->xyz, z, REAL_MULADD(f->xyy, y, f->xxy * x));
    g->yy = REAL_MULADD(f->yyz, z, REAL_MULADD(f->yyy, y, f->xyy * x));
    g->xz = REAL_NEGMULADD(f->xxx + f->xyy, z, REAL_MULADD(f->xyz, y, f->xxz * x));
    g->yz = REAL_NEGMULADD(f->xxy + f->yyy, z, REAL_MULADD(f->yyz, y, f->xyz * x));
}

static inline __attribute__((always_inline)) void FN(bend_of_form)(const FN(form) * f, const REAL j[3],
                                                                   FN(bend) * t)
{
    const REAL weight = R(0.07957747154594766788444188168626); /* 1/(4 pi) */
    const REAL x = weight * j[0], y = weight * j[1], z = weight * j[2];
    t->scale = t->vertical = R(1.0);
    t->xxx = REAL_MULADD(f->xxxz, z, REAL_MULADD(f->xxxy, y, f->xxxx * x));
    t->xxy = REAL_MULADD(f->xxyz, z, REAL_MULADD(f->xxyy, y, f->xxxy * x));
    t->xyy = REAL_MULADD(f->xyyz, z, REAL_MULADD(f->xyyy, y, f->xxyy * x));
    t->yyy = REAL_MULADD(f->yyyz, z, REAL_MULADD(f->yyyy, y, f->xyyy * x));
    t->xxz = REAL_NEGMULADD(f->xxxx + f->xxyy, z, REAL_MULADD(f->xxyz, y, f->xxxz * x));
    t->xyz = REAL_NEGMULADD(f->xxxy + f->xyyy, z, REAL_MULADD(f->xyyz, y, f->xxyz * x));
    t->yyz = REAL_NEGMULADD(f->xxyy + f->yyyy, z, REAL_MULADD(f->yyyz, y, f->xyyz * x));
}
