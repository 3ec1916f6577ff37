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

const char *fst_param_missing_choice(const fst_params *params, const char *key, const char **of)
{
    const int of_disc = strcmp(key, "contact.radius") == 0 || strcmp(key, "contact.modulus") == 0;
    const int of_flight = strcmp(key, "impact.restitution") == 0;
    if ((of_disc || of_flight) && params->friction_law != FST_FRICTION_COULOMB) {
        *of = "friction.law";
        return "coulomb";
    }
    const int of_lines = strcmp(key, "magnet.lines") == 0 || strcmp(key, "magnet.width") == 0 ||
                         strcmp(key, "model.lambda") == 0;
    *of = "magnet.shape";
    if (strncmp(key, "magnet.parts", strlen("magnet.parts")) == 0 && params->magnet_shape != FST_MAGNET_PARTS)
        return "parts";
    if (of_lines && params->magnet_shape == FST_MAGNET_PARTS)
        return "lines";
    if (of_disc && params->contact_patch == FST_PATCH_POINT) {
        *of = "contact.patch";
        return "hertz or pade";
    }
    *of = "bead.material";
    if (strcmp(key, "bead.a") == 0 && params->bead_material == FST_MATERIAL_HARD)
        return "paramagnetic or mixed";
    if (strcmp(key, "bead.b") == 0 && params->bead_material != FST_MATERIAL_MIXED)
        return "mixed";
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

/* What only lines have. */
static fst_status check_lines(const fst_params *params, fst_error *error)
{
    const fst_params usual = fst_default_params();
    const struct {
        const char *key;
        double value;
        int given;
    } keys[] = {{"magnet.lines", params->magnet_lines, params->magnet_lines != usual.magnet_lines},
                {"magnet.width", params->magnet_width, params->magnet_width != usual.magnet_width},
                {"model.lambda", params->model_lambda, !isnan(params->model_lambda)}};
    for (size_t i = 0; i < sizeof keys / sizeof *keys; ++i) {
        const char *of, *choice = keys[i].given ? fst_param_missing_choice(params, keys[i].key, &of) : NULL;
        if (choice)
            return fst_fail(error, FST_BAD_INPUT, keys[i].key,
                            "%s = %g has no effect with magnet.shape parts: choose %s, or leave %s out",
                            keys[i].key, keys[i].value, choice, keys[i].key);
    }
    return FST_OK;
}

fst_status fst_params_check_effects(const fst_params *params, fst_error *error)
{
    const char *of;
    if (params->magnet_part_count > 0 && params->magnet_shape != FST_MAGNET_PARTS) {
        char shape[48];
        (void)fst_params_get(params, fst_param_find("magnet.shape"), shape, sizeof shape);
        return fst_fail(
            error, FST_BAD_INPUT, "magnet.parts",
            "magnet.parts has no effect with magnet.shape %s: choose parts, or leave magnet.parts out", shape);
    }
    if (check_lines(params, error) != FST_OK)
        return FST_BAD_INPUT;
    const struct {
        const char *key;
        double value;
    } given[] = {{"contact.radius", params->contact_radius},
                 {"contact.modulus", params->contact_modulus},
                 {"impact.restitution", params->impact_restitution}};
    for (size_t i = 0; i < sizeof given / sizeof *given; ++i) {
        const fst_status status = check_contact(params, given[i].key, given[i].value, error);
        if (status != FST_OK)
            return status;
    }
    if (params->bead_a != 0.0 && fst_param_missing_choice(params, "bead.a", &of))
        return fst_fail(error, FST_BAD_INPUT, "bead.a",
                        "bead.a = %g has no effect on a bead of bead.material hard: choose paramagnetic or "
                        "mixed, or leave bead.a out",
                        params->bead_a);
    if (params->bead_b != 0.0 && fst_param_missing_choice(params, "bead.b", &of))
        return fst_fail(
            error, FST_BAD_INPUT, "bead.b",
            "bead.b = %g has an effect on a bead of bead.material mixed only: choose that, or leave "
            "bead.b out",
            params->bead_b);
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
