/* force.c - a field and a force of your own: a coil whose field stands still in the laboratory, and a draught.
 *
 *     cc -std=c11 force.c $(pkg-config --cflags --libs festoon) -lm -o force
 *     ./force
 *
 * fst_flow_options.outside gives the bead's trajectory a function of time and state, which says what acts besides
 * the magnet and the plate.  Nothing needs to be built anew, and libfestoon alone is enough.  festoon.h says what
 * does not go with it (dry friction, fst_run(), sweeps, orbits); field.c and law.c are the way to those.
 */
#include <math.h>
#include <stdio.h>

#include <festoon/festoon.h>

typedef struct surroundings {
    double coil; /* field along the laboratory's x, in units of B0, the same everywhere */
    double wind; /* force per mass along the laboratory's y, l gamma^2 */
} surroundings;

/* What acts, on the axes that turn with the magnet, which are `phase` ahead of the laboratory's. */
static fst_status act(void *user, double t, double phase, const double state[FST_STATE_SIZE],
                      fst_action *action, fst_error *error)
{
    const surroundings *s = user;
    (void)t, (void)state,
        (void)error; /* a draught that changes with time, a trap that depends on the place, ... */
    action->field[0] = s->coil * cos(phase);
    action->field[1] = -s->coil * sin(phase);
    action->force[0] = s->wind * sin(phase);
    action->force[1] = s->wind * cos(phase);
    return FST_OK;
}

static int fail(const fst_error *error)
{
    (void)fprintf(stderr, "%s: %s\n", error->where, error->sentence);
    return 1;
}

/* Follow the bead for 60 turns of the magnet; print how far it is from the axis on average, and how often it went
 * round. */
static fst_status follow(const fst_model *model, const double *start, surroundings *around, fst_error *error)
{
    enum { TURNS = 60, SAMPLES = 32 };
    const fst_outside outside = {around, act};
    const double period = 2.0 * acos(-1.0) / fst_model_groups(model).omega;
    fst_flow_options options = fst_default_flow_options();
    fst_flow *flow;
    fst_stop stop;
    double sum = 0.0;
    options.outside = &outside;
    fst_status status = fst_flow_new(model, &options, start, &flow, error);
    if (status != FST_OK)
        return status;
    const double from = fst_flow_get(flow).alpha;
    for (int i = 1; i <= TURNS * SAMPLES && status == FST_OK; ++i) {
        status = fst_flow_next(flow, i * period / SAMPLES, 0, &stop, error);
        const fst_flow_info at = fst_flow_get(flow);
        sum += hypot(at.state[FST_X], at.state[FST_Y]);
    }
    if (status == FST_OK)
        printf("coil %g B0, draught %g: r = %.17g l, %.17g times round\n", around->coil, around->wind,
               sum / (TURNS * SAMPLES), (fst_flow_get(flow).alpha - from) / (2.0 * acos(-1.0)));
    fst_flow_free(flow);
    return status;
}

int main(void)
{
    static const surroundings cases[] = {{0.0, 0.0}, {0.05, 0.0}, {0.0, 0.001}};
    const fst_params bead = fst_default_params();
    fst_model *model;
    fst_error error;
    double start[FST_STATE_SIZE];
    fst_status status = fst_model_new(&bead, &model, &error);
    if (status == FST_OK)
        status = fst_start_state(&bead, model, start, &error);
    for (size_t i = 0; i < sizeof cases / sizeof *cases && status == FST_OK; ++i) {
        surroundings around = cases[i];
        status = follow(model, start, &around, &error);
    }
    fst_model_free(model);
    return status == FST_OK ? 0 : fail(&error);
}
