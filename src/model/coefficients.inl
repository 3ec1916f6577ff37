/* coefficients.inl - what the bodies of the model need of a setup, over REAL.
 *
 * With lanes each lane has its own REALs; the integers are shared by a batch.
 */
typedef struct FN(coefficients) {
    int lines;                /* number of lines of dipoles */
    int magnetisable;         /* the material has a or b: the general force and torque */
    int gyroscopic_term_lost; /* dynamics farago2020 */
    REAL eps;
    REAL height;        /* h */
    REAL spacing;       /* lambda */
    REAL first_line;    /* -(lines - 1)/2: the lines lie at Y = lambda (first_line, first_line + 1, ...) */
    REAL line_strength; /* 5/lines */
    REAL hard;          /* kappa eps^2: force of a hard magnet */
    REAL hard_over_eps;
    REAL twice_a, twice_b;
    REAL torque;   /* 5/(2 eps^2): from a torque per mass to dW/dt */
    REAL traction; /* 5/(2 eps): from a contact force per mass to dW/dt */
    REAL friction; /* 1, or 0 on a frictionless plate */
    REAL gravity;
    REAL omega; /* drive */
} FN(coefficients);

static inline FN(coefficients) FN(make_coefficients)(const fst_groups *g)
{
    FN(coefficients) c;
    c.lines = g->lines;
    c.magnetisable = g->material != FST_MATERIAL_HARD;
    c.gyroscopic_term_lost = g->dynamics == FST_DYNAMICS_FARAGO2020;
    c.eps = REAL_OF(g->eps);
    c.height = REAL_OF(g->h);
    c.spacing = REAL_OF(g->lambda);
    c.first_line = -(R(0.5) * REAL_OF(g->lines - 1));
    c.line_strength = R(5.0) / REAL_OF(g->lines);
    c.hard = REAL_OF(g->kappa) * (REAL_OF(g->eps) * REAL_OF(g->eps));
    c.hard_over_eps = c.hard / c.eps;
    c.twice_a = R(2.0) * REAL_OF(g->a);
    c.twice_b = R(2.0) * REAL_OF(g->b);
    c.torque = R(2.5) / (REAL_OF(g->eps) * REAL_OF(g->eps));
    c.traction = R(2.5) / REAL_OF(g->eps);
    c.friction = REAL_OF(g->friction == FST_FRICTION_NONE ? 0 : 1);
    c.gravity = REAL_OF(g->gravity);
    c.omega = REAL_OF(g->omega);
    return c;
}
