/* coefficients.inl - what the bodies of the model need of a setup, over REAL.
 *
 * With lanes each lane has its own REALs, which all come after `eps`; the kinds are shared by a batch.
 */
typedef struct FN(coefficients) {
    fst_kinds kinds;
    REAL eps;
    REAL hard; /* kappa eps^2: force of a hard magnet */
    REAL hard_over_eps;
    REAL twice_a, twice_b;
    REAL torque;   /* 5/(2 eps^2): from a torque per mass to dW/dt */
    REAL traction; /* 5/(2 eps): from a contact force per mass to dW/dt */
    REAL gravity;
    REAL omega; /* drive */
    FN(source_numbers) source;
    FN(law_numbers) law;
    FN(resistance) resistance;
    REAL holding; /* coefficient of static friction, which says how much of it a motion uses */
} FN(coefficients);

static inline FN(coefficients) FN(make_coefficients)(const fst_params *params, const fst_groups *g)
{
    FN(coefficients) c;
    c.kinds.source = (int)g->shape;
    fst_count_pieces(&c.kinds, params, g);
    c.kinds.contact = fst_law_in_effect(params, g->friction);
    c.kinds.dry = c.kinds.contact == FST_FRICTION_COULOMB || c.kinds.contact == FST_FRICTION_ROLLING;
    c.kinds.paced = c.kinds.contact == FST_FRICTION_COULOMB;
    c.kinds.resists = c.kinds.paced && params->friction_rolling_resistance > 0;
    c.kinds.flies = g->friction == FST_FRICTION_COULOMB && c.kinds.paced && !isnan(params->impact_restitution);
    c.kinds.patch =
        g->friction == FST_FRICTION_COULOMB && c.kinds.paced ? params->contact_patch : FST_PATCH_POINT;
    c.kinds.magnetisable = g->material != FST_MATERIAL_HARD;
    c.kinds.gyroscopic_term_lost = g->dynamics == FST_DYNAMICS_FARAGO2020;
    c.eps = REAL_OF(g->eps);
    c.hard = REAL_OF(g->kappa) * (REAL_OF(g->eps) * REAL_OF(g->eps));
    c.hard_over_eps = c.hard / c.eps;
    c.twice_a = R(2.0) * REAL_OF(g->a);
    c.twice_b = R(2.0) * REAL_OF(g->b);
    c.torque = R(2.5) / (REAL_OF(g->eps) * REAL_OF(g->eps));
    c.traction = R(2.5) / REAL_OF(g->eps);
    c.gravity = REAL_OF(g->gravity);
    c.omega = REAL_OF(g->omega);
    c.source = FN(make_source_numbers)(&c.kinds, params, g);
    c.law = FN(make_law_numbers)(&c.kinds, params, g);
    c.resistance = FN(make_resistance)(params, g);
    c.holding = REAL_OF(isnan(params->friction_mu_static) ? params->friction_mu : params->friction_mu_static);
    return c;
}
