/* loop.inl - the field of a circular loop of current, over REAL.
 *
 * A loop is a uniformly magnetised disc without height (Ampere): B_i = (mu_0 I/(4 pi)) d_i d_z of the integral of
 * 1/distance over its disc, whose derivatives along z are what one rim adds to the field of a cylinder.  So the rim of
 * cylinder.inl is the loop, with no differences of like terms on the axis, near the wire or far away:
 *
 *     B_z = s zzz,   B_x + i B_y = s zz+,   and G by zzzz, zzz+, zz++,   s = mu_0 I/(4 pi).
 *
 * Written with K and E these are the formulas of Smythe (Static and Dynamic Electricity, 7.10) and their derivatives,
 * which lose their digits near the axis.  A solenoid is a cylinder.
 *
 * A loop is an FN(part) with its radius in half[0] and half[1], no height, and s in j[2].
 */
PART_KIND void FN(loop_field)(const FN(part) * loop, const REAL d[3], REAL b[3], FN(gradient) * g)
{
    const FN(cylinder_place) at = FN(see_cylinder)(loop, d);
    const REAL zeta[2] = {at.z, at.z}, s = loop->j[2], half = R(0.5);
    FN(rim) rims[2];
    FN(axial) v;
    FN(see_rims)(&at, zeta, rims);
    FN(rim_derivatives)(&at, &rims[0], 1, &v);
    const REAL across = s * v.zzp_1, upward = s * v.zzzp_1, zz = s * v.zzzz, pp = s * v.zzpp;
    const REAL share = pp * at.per_rho2; /* zz++ = share (x + i y)^2 */
    b[0] = across * d[0];
    b[1] = across * d[1];
    b[2] = s * v.zzz;
    const REAL real = share * REAL_MULSUB(d[0], d[0], d[1] * d[1]);
    g->xx = half * (real - zz);
    g->yy = -(half * (real + zz));
    g->xy = share * (d[0] * d[1]);
    g->xz = upward * d[0];
    g->yz = upward * d[1];
    FN(no_curl)(g);
}
