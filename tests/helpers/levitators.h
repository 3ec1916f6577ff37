/* levitators.h - the floater of docs/levitation.md for tests: a magnet turns at 200 Hz, a bead is held by its field. */
#ifndef FST_TESTS_LEVITATORS_H
#define FST_TESTS_LEVITATORS_H

#include "keys.h"

/* A rotor of 19 mm whose moment lies `tilt` degrees under the plane of its turn, and a floater of 12.7 mm, 1.2 T and
 * 7500 kg/m^3. */
static inline fst_params rotor_and_floater(const char *tilt)
{
    static const char *const keys[][2] = {{"magnet.shape", "parts"},
                                          {"magnet.parts[0].kind", "sphere"},
                                          {"magnet.parts[0].size[0]", "19 mm"},
                                          {"magnet.parts[0].remanence[0]", "1.2 T"},
                                          {"magnet.parts[0].rotation[2]", "-1"},
                                          {"bead.density", "7500"},
                                          {"bead.radius", "6.35 mm"},
                                          {"bead.remanence", "1.2 T"},
                                          {"drive.frequency", "200 Hz"}};
    fst_params p = fst_default_params();
    for (size_t i = 0; i < sizeof keys / sizeof *keys; ++i)
        set(&p, keys[i][0], keys[i][1]);
    set(&p, "magnet.parts[0].rotation[0]", tilt);
    return p;
}

/* The same without a plate, with drags of 1/s. */
static inline fst_params levitator(const char *tilt, const char *gravity)
{
    fst_params p = rotor_and_floater(tilt);
    set(&p, "plate.shape", "none");
    set(&p, "plate.gravity", gravity);
    set(&p, "medium.drag_rate", "1");
    set(&p, "medium.spin_drag_rate", "1");
    return p;
}

#endif
