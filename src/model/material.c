/* material.c - whether a bead of these parameters can be made of anything, and which strengths it uses. */
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "base/constants.h"
#include "base/error.h"
#include "model/bead_list.h"
#include "model/bead_rows.h"
#include "model/forms.h"
#include "model/params.h"
#include "model/worlds.h"

/* From light plastics filled with magnetic powder to tungsten and gold, kg/m^3. */
static const double LIGHTEST = 1000.0, HEAVIEST = 23000.0;

static double density_of(const fst_params *params)
{
    const double radius = params->bead_radius;
    return fst_bead_mass(params) / (4.0 / 3.0 * FST_PI * radius * radius * radius);
}

/* Mass and radius enter kappa = mu B0/(m R^2 gamma^2) too: a strength that nobody gave belongs to the default's bead. */
static int strength_is_default(const fst_params *params)
{
    return params->bead_material != FST_MATERIAL_PARAMAGNETIC && !fst_kappa_follows(params) &&
           !fst_kappa_given(params);
}

int fst_bead_contradiction(const fst_params *params, char *sentence, size_t size)
{
    fst_params room;
    const fst_params usual = fst_default_params();
    params = fst_params_settled(params, &room);
    const double density = density_of(params);
    if (size > 0)
        sentence[0] = '\0';
    if (params->bead_material == FST_MATERIAL_PARAMAGNETIC && params->bead_a == 0.0)
        return snprintf(sentence, size, "bead.a is 0: the bead feels no magnet");
    if (params->bead_material == FST_MATERIAL_HARD &&
        (params->bead_remanence == 0.0 || params->bead_moment == 0.0))
        return snprintf(sentence, size, "bead.%s is 0: the bead feels no magnet",
                        params->bead_remanence == 0.0 ? "remanence" : "moment");
    if (params->friction_law == FST_FRICTION_COULOMB && params->contact_patch != FST_PATCH_POINT &&
        params->contact_radius >= params->bead_radius)
        return snprintf(
            sentence, size,
            "contact.radius is %g mm and bead.radius %g mm: a real disc of contact is a small part of the "
            "bead's surface",
            1e3 * params->contact_radius, 1e3 * params->bead_radius);
    if (!isnan(params->model_eps)) /* a scaled bead, whose radius in metres plays no part */
        return 0;
    if (!(density >= LIGHTEST && density <= HEAVIEST))
        return snprintf(sentence, size,
                        "the bead's mass (%.4g kg) and radius (%.4g m) make a density of %.0f kg/m^3, which no "
                        "material has (%g to %g): give bead.mass and bead.radius that belong together",
                        fst_bead_mass(params), params->bead_radius, density, LIGHTEST, HEAVIEST);
    if (params->bead_radius == usual.bead_radius || !strength_is_default(params))
        return 0;
    if (!isnan(params->bead_density))
        return snprintf(
            sentence, size,
            "bead.radius is %.4g m and its mass follows from bead.density, but its magnetic strength "
            "is still that of the default's %.4g m: give model.kappa (or bead.moment and magnet.b0) as "
            "well",
            params->bead_radius, usual.bead_radius);
    if (fst_bead_mass(params) == usual.bead_mass)
        return snprintf(sentence, size,
                        "bead.radius is %.4g m, but the bead's mass and magnetic strength are still those of "
                        "the default's %.4g m: its density is %.0f kg/m^3 instead of %.0f; give bead.mass and "
                        "model.kappa (or bead.moment and magnet.b0) as well",
                        params->bead_radius, usual.bead_radius, density, density_of(&usual));
    return 0;
}

/* ------------------------------------------------------------------ keys without effect */

/* Whether a scene that gives a key without effect is refused.  Where scenes are compared by changing one choice
 * alone, keys of the other choices wait: those of dry friction under another law, model.kappa beside a
 * paramagnetic bead, a width beside one line, a map beside parts. */
enum { WAITS, REFUSED, REFUSED_IF_DRY };

/* What a law or a source of your own (own.def) reads is not known here. */
#define NOT_DRY "friction.law", "viscous|none|rolling", "coulomb", WAITS
#define NO_PLATE "plate.shape", "none", "flat or bowl", REFUSED
#define NO_FLUID "medium.density", "", "one", REFUSED
#define NO_WAVE "drive.waveform", "steady|oscillating|chirp|table|carried", "wave", REFUSED
#define NOT_CARRIED "drive.waveform", "steady|oscillating|chirp|table|wave", "carried", REFUSED
#define NO_LINES "magnet.shape", "parts|grid", "lines", REFUSED

static const struct effect {
    const char *key, *of, *without; /* the key plays no part where the key `of` has one of these values */
    const char *choose;             /* what must be chosen of it instead */
    int when;
} effects[] = {
    {"contact.radius", NOT_DRY},
    {"contact.modulus", NOT_DRY},
    {"contact.patch", NOT_DRY},
    {"impact.restitution", NOT_DRY},
    {"friction.mu_static", NOT_DRY},
    {"friction.stribeck_speed", NOT_DRY},
    {"friction.rolling_resistance", "friction.law", "viscous|none", "coulomb or rolling", WAITS},
    {"magnet.parts", "magnet.shape", "lines|grid", "parts", REFUSED},
    {"magnet.file", "magnet.shape", "lines", "grid", REFUSED},
    {"magnet.checksum", "magnet.shape", "lines", "grid", REFUSED},
    {"magnet.lines", NO_LINES},
    {"magnet.width", NO_LINES},
    {"model.lambda", NO_LINES},
    {"magnet.width", "magnet.lines", "1", "at least 2", WAITS},
    {"model.lambda", "magnet.lines", "1", "at least 2", WAITS},
    {"contact.radius", "contact.patch", "point", "hertz", REFUSED_IF_DRY},
    {"contact.modulus", "contact.patch", "point", "hertz", REFUSED_IF_DRY},
    {"friction.stribeck_speed", "friction.mu_static", "", "one greater than friction.mu", REFUSED_IF_DRY},
    {"bead.a", "bead.material", "hard", "paramagnetic or mixed", REFUSED},
    {"bead.b", "bead.material", "hard|paramagnetic", "mixed", REFUSED},
    {"model.kappa", "bead.material", "paramagnetic", "hard or mixed", WAITS},
    {"contact.pair_mu", NOT_DRY},
    {"run.step", "run.method", "exact", "stepping", REFUSED},
    {"plate.bowl_radius", "plate.shape", "flat|none", "bowl", REFUSED},
    {"drive.amplitude", "drive.waveform", "steady|chirp|table|carried|wave", "oscillating", REFUSED},
    {"drive.chirp", "drive.waveform", "steady|oscillating|table|carried|wave", "chirp", REFUSED},
    {"drive.table", "drive.waveform", "steady|oscillating|chirp|carried|wave", "table", REFUSED},
    {"wave.length", NO_WAVE},
    {"wave.amplitude", NO_WAVE},
    {"wave.ratio", NO_WAVE},
    {"plate.tilt", "plate.shape", "none", "flat or bowl", REFUSED},
    {"plate.tilt_azimuth", "plate.tilt", "0", "one above 0", REFUSED},
    {"drive.velocity[0]", NOT_CARRIED},
    {"drive.velocity[1]", NOT_CARRIED},
    {"drive.velocity[2]", NOT_CARRIED},
    {"friction.mu", NO_PLATE},
    {"friction.mu_static", NO_PLATE},
    {"friction.rolling_resistance", NO_PLATE},
    {"impact.restitution", NO_PLATE},
    {"contact.patch", NO_PLATE},
    {"magnet.depth", "plate.shape", "none", "flat or bowl", WAITS},
    {"model.h", "plate.shape", "none", "flat or bowl", WAITS},
    {"medium.drag_coefficient", NO_FLUID},
    {"medium.added_mass", NO_FLUID},
};
enum { EFFECTS = sizeof effects / sizeof *effects };

/* Whether the engine of src/beads reads the row's key all the same: restitution under every law, also where beads meet each
 * other alone, whose dry friction is that at the plate unless contact.pair_mu is given. */
static int is_read_by_beads(const struct effect *row, const fst_params *params, const fst_params *scene)
{
    const int no_plate = strcmp(row->of, "plate.shape") == 0, meet = scene->bead_count > 1;
    if (strcmp(row->key, "impact.restitution") == 0)
        return no_plate ? meet : scene->bead_count || fst_key_of_world(params);
    return no_plate && meet && strcmp(row->key, "friction.mu") == 0 && isnan(scene->contact_pair_mu);
}

/* Whether the row takes its key's effect in the scene away, of which `params` are those of one bead; `value` is then that
 * of the key `of`. */
static int strikes(const struct effect *row, const fst_params *params, const fst_params *scene,
                   char value[FST_PARAM_TEXT_SIZE])
{
    if (is_read_by_beads(row, params, scene))
        return 0;
    (void)fst_params_get(params, fst_param_find(row->of), value, FST_PARAM_TEXT_SIZE);
    return strcmp(value, row->without) == 0 || fst_name_place(value, row->without) >= 0;
}

/* Keys that say something of a list of beads alone, the first three of two and more. */
static const char *const of_beads[] = {"contact.pair_rate", "contact.pair_mu", "model.chi", "run.method"};
enum { BETWEEN_TWO = 3, OF_BEADS = sizeof of_beads / sizeof *of_beads };

static int needs_beads(const char *key)
{
    int i = 0;
    while (i < OF_BEADS && strcmp(of_beads[i], key) != 0)
        ++i;
    return i < OF_BEADS;
}

const char *fst_param_missing_choice(const fst_params *params, const char *key, const char **of)
{
    char value[FST_PARAM_TEXT_SIZE];
    *of = "bead";
    if (!params->bead_count && needs_beads(key))
        return "several, in a list of beads";
    for (int i = 0; i < EFFECTS; ++i) {
        const size_t length = strlen(effects[i].key);
        *of = effects[i].of;
        if (strncmp(key, effects[i].key, length) == 0 && (key[length] == '\0' || key[length] == '[') &&
            strikes(&effects[i], params, params, value))
            return effects[i].choose;
    }
    return NULL;
}

/* Whether a scene says something else of the key than its default. */
static int is_given(const fst_params *params, const char *key)
{
    char value[FST_PARAM_TEXT_SIZE], initial[FST_PARAM_TEXT_SIZE];
    const fst_params usual = fst_default_params();
    const int index = fst_param_find(key);
    if (index < 0) /* magnet.parts, a list */
        return params->magnet_part_count > 0;
    (void)fst_params_get(&usual, index, initial, sizeof initial);
    return fst_params_get(params, index, value, sizeof value) && strcmp(value, initial) != 0;
}

/* Of settled parameters of one bead of the scene. */
static fst_status check_one(const fst_params *params, const fst_params *scene, fst_error *error)
{
    char value[FST_PARAM_TEXT_SIZE];
    const int dry = params->friction_law == FST_FRICTION_COULOMB;
    for (const struct effect *row = effects; row < effects + EFFECTS; ++row)
        if ((row->when == REFUSED || (row->when == REFUSED_IF_DRY && dry)) && is_given(params, row->key) &&
            strikes(row, params, scene, value))
            return fst_fail(error, FST_BAD_INPUT, row->key,
                            "%s has no effect %s %s%s%s: choose %s, or leave %s out", row->key,
                            value[0] ? "with" : "without", row->of, value[0] ? " " : "", value, row->choose,
                            row->key);
    return FST_OK;
}

/* What one bead alone does not have: what is between two, and in no list a method. */
static fst_status check_alone(const fst_params *params, fst_error *error)
{
    for (int i = 0; i < (params->bead_count ? BETWEEN_TWO : OF_BEADS); ++i)
        if (is_given(params, of_beads[i]))
            return fst_fail(error, FST_BAD_INPUT, of_beads[i],
                            "%s has no effect on one bead: list several in beads, or leave %s out", of_beads[i],
                            of_beads[i]);
    return FST_OK;
}

/* Whether the bead itself gives the key of the setup. */
static int bead_gives(const fst_params *params, int bead, const char *key)
{
    fst_params said = fst_default_params();
    char own[64], value[FST_PARAM_TEXT_SIZE];
    said.bead_count = 1;
    said.beads[0] = *fst_bead_own(params, bead);
    (void)snprintf(own, sizeof own, "beads[0].%.50s", key);
    const int row = fst_param_find(own);
    return row >= 0 && fst_params_get(&said, row, value, sizeof value) > 0;
}

/* A key may be without effect on some beads, unless these give it themselves. */
static fst_status check_beads(const fst_params *params, fst_error *error)
{
    fst_error why;
    int struck = 0;
    if (params->bead_count > FST_BEADS_MOST && params->run_method == FST_BEADS_EXACT)
        return fst_fail(error, FST_BAD_INPUT, "run.method",
                        "run.method: exact takes at most %d beads, and the scene lists %d: choose stepping",
                        FST_BEADS_MOST, params->bead_count);
    for (int bead = 0; bead < params->bead_count; ++bead) {
        fst_params alone;
        fst_status status = fst_params_of_bead(params, bead, &alone, error);
        if (status != FST_OK)
            return status;
        if (check_one(&alone, params, &why) == FST_OK)
            continue;
        if (++struck == params->bead_count || bead_gives(params, bead, why.where))
            return fst_fail(error, FST_BAD_INPUT, why.where, "bead %d: %s", bead + 1, why.sentence);
    }
    return params->bead_count == 1 ? check_alone(params, error) : FST_OK;
}

fst_status fst_params_check_effects(const fst_params *params, fst_error *error)
{
    fst_params room;
    params = fst_params_settled(params, &room);
    if (params->bead_count)
        return check_beads(params, error);
    const fst_status status = check_one(params, params, error);
    return status == FST_OK ? check_alone(params, error) : status;
}
