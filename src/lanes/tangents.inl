/* tangents.inl - the engine of beads with a tangent vector, over REAL.
 *
 * The including file brings the bodies of tangent_step.inl and load_world(), and defines TANGENT_WIDTH.
 */
typedef struct tangents {
    FN(tangent_step) step;
    REAL rtol, atol[FST_TANGENT_DIM];
} tangents;

static double *numbers(void *reals)
{
    return reals;
}

static void load_tangent(void *memory, int lane, const fst_world_double *world, const double y[FST_TANGENT_DIM],
                         double rtol, const double atol[FST_TANGENT_DIM])
{
    tangents *t = memory;
    load_world(TANGENT_WORLD(&t->step), lane, world);
    numbers(&t->step.omega)[lane] = world->omega;
    numbers(&t->rtol)[lane] = rtol;
    for (int i = 0; i < FST_TANGENT_DIM; ++i) {
        numbers(t->step.y)[i * TANGENT_WIDTH + lane] = y[i];
        numbers(t->atol)[i * TANGENT_WIDTH + lane] = atol[i];
    }
}

static void view_tangents(void *memory, double **y, const double **slope)
{
    tangents *t = memory;
    *y = numbers(t->step.y);
    *slope = numbers(FST_PATH_SLOPE(&t->step, FST_PATH_START));
}

static void evaluate_tangents(void *memory)
{
    tangents *t = memory;
    FN(tangent_begin)(&t->step);
}

static void try_tangents(void *memory, const double *h, double *errors, double *factors)
{
    tangents *t = memory;
    memcpy(&t->step.h, h, sizeof t->step.h);
    FN(tangent_try_step)(&t->step);
    const REAL error = FN(tangent_step_error)(&t->step, t->rtol, t->atol), factor = FN(step_factor)(error);
    memcpy(errors, &error, sizeof error);
    memcpy(factors, &factor, sizeof factor);
}

static void accept_tangents(void *memory, unsigned lanes)
{
    tangents *t = memory;
    (void)FN(renormalise)(t->step.end);
    double *y = numbers(t->step.y);
    const double *end = numbers(t->step.end);
    for (int l = 0; l < TANGENT_WIDTH; ++l)
        for (int i = 0; (lanes & 1u << l) && i < FST_TANGENT_DIM; ++i)
            y[i * TANGENT_WIDTH + l] = end[i * TANGENT_WIDTH + l];
    evaluate_tangents(memory);
}

#define TANGENT_ENGINE                                                                                         \
    {                                                                                                          \
        .width = TANGENT_WIDTH, .bytes = sizeof(tangents), .load = load_tangent, .view = view_tangents,        \
        .evaluate = evaluate_tangents, .try_steps = try_tangents, .accept = accept_tangents,                   \
    }
