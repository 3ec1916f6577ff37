/* surrounded.h - a bead in fields that stand still, travel or turn as they like, for tests. */
#ifndef FST_TESTS_SURROUNDED_H
#define FST_TESTS_SURROUNDED_H

#include <stdio.h>

#include "keys.h"
#include "some_beads.h"

static inline void set_of_coil(fst_params *p, int coil, const char *what, const char *text)
{
    char key[40];
    (void)snprintf(key, sizeof key, "coils[%d].%s", coil, what);
    set(p, key, text);
}

/* Two coils with a current of 1 Hz. */
static inline void set_coils(fst_params *p, const char *radius, const char *current)
{
    for (int i = 0; i < 2; ++i) {
        set_of_coil(p, i, "radius", radius);
        set_of_coil(p, i, "ac", current);
        set_of_coil(p, i, "frequency", "1 Hz");
    }
}

static inline fst_model *field_model(const fst_params *p)
{
    fst_model *model;
    fst_error error = {FST_OK, "", ""};
    if (fst_field_model_new(p, NAN, &model, &error) != FST_OK)
        fail_msg("%s", error.sentence);
    return model;
}

static inline fst_surroundings surroundings_of(const fst_model *model)
{
    fst_surroundings s;
    fst_error error = {FST_OK, "", ""};
    if (fst_make_surroundings(model, &s, &error) != FST_OK)
        fail_msg("%s", error.sentence);
    return s;
}

/* The paper's bead with everything around it. */
static inline beads_world surrounded_bead(const fst_model *model)
{
    beads_world world = paper_beads(1, model, 0);
    world.surrounded = 1;
    world.around = surroundings_of(model);
    return world;
}

static inline fst_params in_tesla(void)
{
    fst_params p = fst_default_params();
    set(&p, "magnet.b0", "7.3 mT");
    return p;
}

#endif
