/* material.c - whether a bead of these parameters can be made of anything, and which strengths it uses. */
#include <stdio.h>
#include <string.h>

#include "base/constants.h"
#include "base/error.h"
#include "model/params.h"

/* From light plastics filled with magnetic powder to tungsten and gold, kg/m^3. */
static const double LIGHTEST = 1000.0, HEAVIEST = 23000.0;

static double density_of(const fst_params *params)
{
    const double radius = params->bead_radius;
    return fst_bead_mass(params) / (4.0 / 3.0 * FST_PI * radius * radius * radius);
}

/* Mass and radius enter kappa = mu B0/(m R^2 gamma^2) too, and the unit of a and b: a strength that is the
 * default's belongs to the default's bead. */
static int strength_is_default(const fst_params *params, const fst_params *usual)
{
    if (params->bead_material == FST_MATERIAL_PARAMAGNETIC)
        return 1;
    return !fst_kappa_follows(params) && params->model_kappa == usual->model_kappa;
}

int fst_bead_contradiction(const fst_params *params, char *sentence, size_t size)
{
    const fst_params usual = fst_default_params();
    const double density = density_of(params);
    if (size > 0)
        sentence[0] = '\0';
    if (!isnan(params->model_eps)) /* a scaled bead, whose radius in metres plays no part */
        return 0;
    if (!(density >= LIGHTEST && density <= HEAVIEST))
        return snprintf(sentence, size,
                        "the bead's mass (%.4g kg) and radius (%.4g m) make a density of %.0f kg/m^3, which no "
                        "material has (%g to %g): give bead.mass and bead.radius that belong together",
                        fst_bead_mass(params), params->bead_radius, density, LIGHTEST, HEAVIEST);
    if (params->bead_radius != usual.bead_radius && fst_bead_mass(params) == usual.bead_mass &&
        strength_is_default(params, &usual))
        return snprintf(
            sentence, size,
            "bead.radius is %.4g m, but the bead's mass and magnetic strength are still those of the "
            "default's %.4g m: its density is %.0f kg/m^3 instead of %.0f; give bead.mass and "
            "model.kappa (or bead.moment and magnet.b0) as well",
            params->bead_radius, usual.bead_radius, density, density_of(&usual));
    return 0;
}

/* ------------------------------------------------------------------ strengths without effect */

/* The laws of the table that the library has by itself; what another one reads is not known here. */
static const char *missing_law(const fst_params *params, const char *key)
{
    static const char *const of_coulomb[] = {
        "contact.radius",     "contact.modulus",         "impact.restitution",   "contact.patch",
        "friction.mu_static", "friction.stribeck_speed", "friction.contact_rate"};
    const int law = params->friction_law;
    if (law == FST_FRICTION_COULOMB || law > FST_FRICTION_ROLLING)
        return NULL;
    if (strcmp(key, "friction.rolling_resistance") == 0 && law != FST_FRICTION_ROLLING)
        return "coulomb or rolling";
    for (size_t i = 0; i < sizeof of_coulomb / sizeof *of_coulomb; ++i)
        if (strcmp(key, of_coulomb[i]) == 0)
            return "coulomb";
    return NULL;
}

static int of_spacing(const char *key)
{
    return strcmp(key, "magnet.width") == 0 || strcmp(key, "model.lambda") == 0;
}

static const char *missing_shape(const fst_params *params, const char *key)
{
    const int shape = params->magnet_shape;
    if (strncmp(key, "magnet.parts", strlen("magnet.parts")) == 0 && shape != FST_MAGNET_PARTS)
        return "parts";
    const int of_lines = strcmp(key, "magnet.lines") == 0 || of_spacing(key);
    if (of_lines && (shape == FST_MAGNET_PARTS || shape == FST_MAGNET_GRID))
        return "lines";
    return NULL;
}

static const char *missing_material(const fst_params *params, const char *key)
{
    if (strcmp(key, "bead.a") == 0 && params->bead_material == FST_MATERIAL_HARD)
        return "paramagnetic or mixed";
    if (strcmp(key, "bead.b") == 0 && params->bead_material != FST_MATERIAL_MIXED)
        return "mixed";
    if (strcmp(key, "model.kappa") == 0 && params->bead_material == FST_MATERIAL_PARAMAGNETIC)
        return "hard or mixed";
    return NULL;
}

const char *fst_param_missing_choice(const fst_params *params, const char *key, const char **of)
{
    static const struct {
        const char *of;
        const char *(*missing)(const fst_params *params, const char *key);
    } choices[] = {
        {"friction.law", missing_law}, {"magnet.shape", missing_shape}, {"bead.material", missing_material}};
    for (size_t i = 0; i < sizeof choices / sizeof *choices; ++i) {
        const char *found = choices[i].missing(params, key);
        *of = choices[i].of;
        if (found)
            return found;
    }
    const int of_disc = strcmp(key, "contact.radius") == 0 || strcmp(key, "contact.modulus") == 0;
    *of = "contact.patch";
    if (of_disc && params->contact_patch == FST_PATCH_POINT)
        return "hertz or pade";
    *of = "friction.mu_static";
    if (strcmp(key, "friction.stribeck_speed") == 0 && isnan(params->friction_mu_static))
        return "one greater than friction.mu";
    *of = "magnet.lines";
    if (of_spacing(key) && params->magnet_lines == 1)
        return "at least 2";
    return NULL;
}

/* A key of the contact that is given, and what is wanted for it. Under another law it waits, as friction.mu
 * does: scenes are compared by changing friction.law alone. */
static fst_status check_contact(const fst_params *params, const char *key, double value, fst_error *error)
{
    const int waits = isnan(value) || params->friction_law != FST_FRICTION_COULOMB;
    const char *of, *choice = waits ? NULL : fst_param_missing_choice(params, key, &of);
    if (!choice)
        return FST_OK;
    return fst_fail(error, FST_BAD_INPUT, key, "%s = %g has no effect with this %s: choose %s, or leave %s out",
                    key, value, of, choice, key);
}

/* How much slower than static friction sliding friction is reached, where both are alike. */
static fst_status check_stribeck(const fst_params *params, fst_error *error)
{
    const int waits = isnan(params->friction_stribeck_speed) || params->friction_law != FST_FRICTION_COULOMB;
    if (waits || !isnan(params->friction_mu_static))
        return FST_OK;
    return fst_fail(error, FST_BAD_INPUT, "friction.stribeck_speed",
                    "friction.stribeck_speed = %g has no effect where static friction is as great as sliding "
                    "friction: give friction.mu_static too, or leave friction.stribeck_speed out",
                    params->friction_stribeck_speed);
}

/* What only lines have; one line has no spacing, but a width then waits, as magnet.lines alone is changed. */
static fst_status check_lines(const fst_params *params, const char *shape, fst_error *error)
{
    const fst_params usual = fst_default_params();
    const struct {
        const char *key;
        double value;
        int given;
    } keys[] = {{"magnet.lines", params->magnet_lines, params->magnet_lines != usual.magnet_lines},
                {"magnet.width", params->magnet_width, params->magnet_width != usual.magnet_width},
                {"model.lambda", params->model_lambda, !isnan(params->model_lambda)}};
    for (size_t i = 0; i < sizeof keys / sizeof *keys; ++i)
        if (keys[i].given && missing_shape(params, keys[i].key))
            return fst_fail(error, FST_BAD_INPUT, keys[i].key,
                            "%s = %g has no effect with magnet.shape %s: choose lines, or leave %s out",
                            keys[i].key, keys[i].value, shape, keys[i].key);
    return FST_OK;
}

/* What belongs to one shape of the magnet, given beside another.  A map may wait beside parts: a sweep over
 * magnet.shape needs both. */
static fst_status check_shape(const fst_params *params, fst_error *error)
{
    char shape[FST_PARAM_TEXT_SIZE];
    (void)fst_params_get(params, fst_param_find("magnet.shape"), shape, sizeof shape);
    const char *key = NULL, *choice = NULL;
    if (params->magnet_part_count > 0 && missing_shape(params, "magnet.parts"))
        key = "magnet.parts", choice = "parts";
    else if (params->magnet_shape == FST_MAGNET_LINES && params->magnet_file[0])
        key = "magnet.file", choice = "grid";
    else if (params->magnet_shape == FST_MAGNET_LINES && params->magnet_checksum[0])
        key = "magnet.checksum", choice = "grid";
    if (!key)
        return check_lines(params, shape, error);
    return fst_fail(error, FST_BAD_INPUT, key,
                    "%s has no effect with magnet.shape %s: choose %s, or leave %s out", key, shape, choice,
                    key);
}

/* Strengths that the bead's material does not have.  model.kappa of a paramagnetic bead waits: beads are
 * compared by changing bead.material alone. */
static fst_status check_material(const fst_params *params, fst_error *error)
{
    if (params->bead_a != 0.0 && missing_material(params, "bead.a"))
        return fst_fail(error, FST_BAD_INPUT, "bead.a",
                        "bead.a = %g has no effect on a bead of bead.material hard: choose paramagnetic or "
                        "mixed, or leave bead.a out",
                        params->bead_a);
    if (params->bead_b != 0.0 && missing_material(params, "bead.b"))
        return fst_fail(
            error, FST_BAD_INPUT, "bead.b",
            "bead.b = %g has an effect on a bead of bead.material mixed only: choose that, or leave "
            "bead.b out",
            params->bead_b);
    return FST_OK;
}

static fst_status check_method(const fst_params *params, fst_error *error)
{
    if (params->run_method == FST_METHOD_EVENTS && params->run_step != fst_default_params().run_step)
        return fst_fail(error, FST_BAD_INPUT, "run.step",
                        "run.step = %g has no effect on run.method events, whose steps follow run.rtol: choose "
                        "splitting, or leave run.step out",
                        params->run_step);
    if (params->run_method == FST_METHOD_SPLITTING && params->run_controller != FST_CONTROLLER_PLAIN)
        return fst_fail(error, FST_BAD_INPUT, "run.controller",
                        "run.controller damped has no effect with run.method splitting, whose steps are fixed: "
                        "choose events, or leave run.controller out");
    if (params->run_method == FST_METHOD_SPLITTING && params->run_until == FST_UNTIL_SETTLED)
        return fst_fail(
            error, FST_BAD_INPUT, "run.until",
            "run.until settled has no effect with run.method splitting, which does not look whether a "
            "motion repeats itself: choose events, or leave run.until out");
    return FST_OK;
}

fst_status fst_params_check_effects(const fst_params *params, fst_error *error)
{
    const struct {
        const char *key;
        double value;
    } given[] = {{"contact.radius", params->contact_radius},
                 {"contact.modulus", params->contact_modulus},
                 {"impact.restitution", params->impact_restitution}};
    fst_status status = check_shape(params, error);
    for (size_t i = 0; i < sizeof given / sizeof *given && status == FST_OK; ++i)
        status = check_contact(params, given[i].key, given[i].value, error);
    if (status == FST_OK)
        status = check_stribeck(params, error);
    if (status == FST_OK)
        status = check_material(params, error);
    return status == FST_OK ? check_method(params, error) : status;
}
