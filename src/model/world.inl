/* world.inl - what never changes along a motion: source, plate, gravity, the bead and its drive, over REAL.
 *
 * With lanes each lane has its own REALs, from `eps` on; the kinds are shared by a batch.
 */
typedef struct FN(world) {
    fst_kinds kinds;
    REAL eps;
    REAL hard; /* kappa eps^2: force of a hard magnet */
    REAL hard_over_eps;
    REAL twice_a, twice_b;
    REAL half_inertia; /* I/(2 m R^2), 1/5 of a solid sphere */
    REAL torque;       /* 1/(beta eps^2): from a torque per mass to dW/dt */
    REAL traction;     /* 1/(beta eps): from a contact force per mass to dW/dt */
    REAL yielding;     /* k = 1 + 1/beta: from a contact force per mass to dV/dt */
    REAL share;        /* 1/k: of the push on a contact, what keeps it at rest */
    REAL spin_up;      /* 1/(beta k eps): from an impulse that changes V to the change of W */
    REAL gravity;
    REAL omega;  /* rate of the drive at the start */
    REAL height; /* of the bead's centre over the magnet's reference plane */
    FN(source_numbers) source;
    FN(law_numbers) law;
    FN(resistance) resistance;
    REAL holding; /* mu_s as given, in terms of which observers say how much friction is used */
} FN(world);

static inline FN(world) FN(make_world)(const fst_params *params, const fst_groups *g)
{
    FN(world) c;
    c.kinds.source = (int)g->shape;
    fst_count_pieces(&c.kinds, params, g);
    c.kinds.contact = fst_law_in_effect(params, g->friction);
    c.kinds.dry = c.kinds.contact == FST_FRICTION_COULOMB || c.kinds.contact == FST_FRICTION_ROLLING;
    c.kinds.modes = c.kinds.contact == FST_FRICTION_COULOMB;
    c.kinds.rolls = g->friction == FST_FRICTION_ROLLING;
    c.kinds.resists = c.kinds.modes && params->friction_rolling_resistance > 0;
    c.kinds.flies = g->friction == FST_FRICTION_COULOMB && c.kinds.modes && !isnan(params->impact_restitution);
    c.kinds.patch =
        g->friction == FST_FRICTION_COULOMB && c.kinds.modes ? params->contact_patch : FST_PATCH_POINT;
    c.kinds.magnetisable = g->material != FST_MATERIAL_HARD;
    c.kinds.gyroscopic_term_lost = g->dynamics == FST_DYNAMICS_FARAGO2020;
    c.eps = REAL_OF(g->eps);
    c.hard = REAL_OF(g->kappa) * (REAL_OF(g->eps) * REAL_OF(g->eps));
    c.hard_over_eps = c.hard / c.eps;
    c.twice_a = R(2.0) * REAL_OF(g->a);
    c.twice_b = R(2.0) * REAL_OF(g->b);
    const REAL inverse_inertia = REAL_OF(1.0 / g->inertia);
    c.half_inertia = R(0.5) / inverse_inertia;
    c.torque = inverse_inertia / (REAL_OF(g->eps) * REAL_OF(g->eps));
    c.traction = inverse_inertia / REAL_OF(g->eps);
    c.yielding = R(1.0) + inverse_inertia;
    c.share = R(1.0) / c.yielding;
    c.spin_up = inverse_inertia / (c.yielding * REAL_OF(g->eps));
    c.gravity = REAL_OF(g->gravity);
    c.omega = REAL_OF(g->omega);
    c.height = REAL_OF(g->h);
    c.source = FN(make_source_numbers)(&c.kinds, params, g);
    c.law = FN(make_law_numbers)(&c.kinds, params, g);
    c.resistance = FN(make_resistance)(params, g);
    c.holding = REAL_OF(isnan(params->friction_mu_static) ? params->friction_mu : params->friction_mu_static);
    return c;
}
