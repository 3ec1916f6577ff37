/* modes.c - which modes a bead has that is put down in a state (contact/modes.inl).
 *
 * A trajectory that begins or changes its modes, the equations of motion of a single state and Newton's method
 * ask the same questions, here.  Each answer needs the one before:
 *
 *     is its rotation nothing?          then the push on the contact is that on a bead that does not roll
 *     does it leave the plate?          N < 0 by more than rounding, where the bead may fly
 *     is its slip nothing?              then it sticks if static friction can hold it, k mu_s N >= |A|
 *                                       (law rolling: always; a disc: disc.c)
 *     can the resistance hold it?       rho N >= |T|, with the friction of the contact's mode; if not, the
 *                                       contact is asked once more, because a bead that starts to roll pushes
 *                                       it in another way
 */
#include "model/modes.h"

#include "model/disc.h"

static const double LIFT = 1e-12; /* how far the load may fall below 0 before a bead flies, in weights */
static const double FALLS_AT_ONCE = 1.01; /* static friction over sliding */

double fst_load_left(const fst_world_double *c, const fst_pull_double *p)
{
    return fst_load_double(c, p->force) + LIFT * (c->gravity + c->hard);
}

double fst_rotation_of_rest(const fst_world_double *c, double rtol)
{
    /* The load of a motion hardly changes the strength of the resistance: that of the weight does. */
    const double strength = c->torque * c->resistance.arm * (c->gravity + c->hard);
    return fst_captured_double(rtol) * fmin(1.0, strength * strength);
}

double fst_resistance_left(const fst_world_double *c, const fst_contact_double *at)
{
    const double most = c->resistance.arm * fst_coulomb_load_double(at);
    return most * (1.0 + FST_RELEASE_SLACK) - fst_norm_2_double(at->balance);
}

int fst_released_mode(const fst_world_double *c)
{
    const fst_coulomb_double *law = &c->law.coulomb;
    const int falls = law->holding > FALLS_AT_ONCE * fst_coulomb_mu_double(law, 0.0);
    return falls || c->kinds.patch != FST_PATCH_POINT ? FST_MODE_SLIP : FST_MODE_ONSET;
}

int fst_held_mode(const fst_world_double *c, const fst_modes_double *m, const double *y)
{
    fst_pull_double p;
    if (c->kinds.patch != FST_PATCH_POINT)
        return FST_MODE_STICK;
    fst_magnetic_pull_double(c, m, y, &p);
    const fst_contact_double at = fst_contact_of_double(c, m, y, &p);
    return fst_static_grip_double(c, &at) >= 0 ? FST_MODE_STICK : fst_released_mode(c);
}

int fst_contact_mode_at(const fst_world_double *c, const fst_modes_double *m, const double *y,
                        const fst_pull_double *p, double rtol)
{
    if (c->kinds.rolls)
        return FST_MODE_STICK;
    if (c->kinds.flies && fst_load_left(c, p) < 0)
        return FST_MODE_FLIGHT;
    if (c->kinds.patch != FST_PATCH_POINT)
        return fst_disc_rests(c, m, y, p) ? FST_MODE_STICK : FST_MODE_SLIP;
    const fst_contact_double at = fst_contact_of_double(c, m, y, p);
    if (fst_norm_2_double(at.slip) > fst_captured_double(rtol))
        return FST_MODE_SLIP;
    return fst_held_mode(c, m, y);
}

fst_motion_double fst_motion_at(const fst_world_double *c, const double state[FST_STATE_SIZE], double rtol)
{
    fst_motion_double motion = {.modes = fst_new_modes_double()};
    fst_modes_double *m = &motion.modes;
    fst_pull_double p;
    memcpy(motion.numbers, state, FST_STATE_SIZE * sizeof *state);
    if (!c->kinds.modes)
        return motion;
    m->slow_2 = fst_disc_slow_2(rtol);
    fst_magnetic_pull_double(c, m, motion.numbers, &p);
    const int still = c->kinds.resists && fst_norm_2_double(state + FST_WX) <= fst_rotation_of_rest(c, rtol);
    m->rolling = still ? FST_ROLL_RESTS : FST_ROLL_ROLLS;
    m->contact = fst_contact_mode_at(c, m, motion.numbers, &p, rtol);
    if (!still)
        return motion;
    const fst_contact_double at = fst_contact_of_double(c, m, motion.numbers, &p);
    if (m->contact == FST_MODE_FLIGHT)
        m->rolling = FST_ROLL_ROLLS;
    else if (fst_resistance_left(c, &at) < 0)
        m->rolling = m->contact == FST_MODE_ONSET ? FST_ROLL_ROLLS : FST_ROLL_STARTS;
    if (m->rolling == FST_ROLL_STARTS && m->contact == FST_MODE_STICK)
        m->contact = fst_held_mode(c, m, motion.numbers);
    if (m->rolling == FST_ROLL_STARTS && m->contact == FST_MODE_ONSET)
        m->rolling = FST_ROLL_ROLLS; /* both cannot begin at once: it is set rolling (ode/contact.c) */
    return motion;
}
