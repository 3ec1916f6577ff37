/* smooth_map.c - from a measured map to the map of charges that fit it, at any height, and the errors of its field.
 *
 * A bead's steps never see the charges: their field is sampled so finely that the splines of the new map add less
 * than a millionth to it, and runs keep the speed of maps.
 */
#include "model/charges.h"
#include "model/model.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/error.h"
#include "base/listed.h"
#include "base/watch.h"

static const char PLACE[] = "fst_field_map_smooth";

static fst_status check(const fst_field_map *map, const fst_smoothing *how, fst_error *error)
{
    const fst_field_map_facts facts = fst_field_map_describe(map);
    const double samples = (double)facts.count[0] * facts.count[1] * facts.count[2];
    const int most = 100000;
    if (samples > most)
        return fst_fail(
            error, FST_BAD_INPUT, PLACE,
            "the map has %.0f samples: charges are fitted to %d at most; leave every second row and "
            "column out",
            samples, most);
    if (!(facts.greatest > 0))
        return fst_fail(error, FST_BAD_INPUT, PLACE, "the field of the map is zero everywhere");
    if (!isnan(how->noise) && !(how->noise > 0 && how->noise <= facts.greatest))
        return fst_fail(
            error, FST_BAD_INPUT, PLACE,
            "the noise is %g T, where a positive field below the map's greatest of %g T is expected",
            how->noise, facts.greatest);
    if (!isfinite(how->height) || (isnan(facts.first[2]) && !isfinite(how->lies)))
        return fst_fail(error, FST_BAD_INPUT, PLACE, "the height of the map or of the plane is not known");
    return FST_OK;
}

/* The field of charges on a plane, over the map's samples' rectangle. */
static fst_status sample(const fst_charges *charges, fst_field_samples *samples, double *b,
                         const fst_progress *progress, fst_error *error)
{
    double *room = fst_charges_room(charges);
    fst_status status = room ? FST_OK : fst_fail(error, FST_NO_MEMORY, PLACE, "out of memory");
    for (int j = 0; j < samples->count[1] && status == FST_OK; ++j) {
        for (int i = 0; i < samples->count[0]; ++i) {
            const double place[3] = {samples->first[0] + i * samples->spacing[0],
                                     samples->first[1] + j * samples->spacing[1], samples->first[2]};
            fst_charges_look(charges, place, 3, room, &b[3 * (j * samples->count[0] + i)], NULL);
        }
        status = fst_tell(progress, (j + 1.0) / samples->count[1], "the field of the charges", error);
    }
    free(room);
    samples->b = b;
    return status;
}

static fst_status map_of(const fst_charges *charges, fst_field_samples *samples, const fst_progress *progress,
                         fst_field_map **map, fst_error *error)
{
    double *b = calloc(3 * (size_t)samples->count[0] * (size_t)samples->count[1], sizeof *b);
    fst_status status = b ? sample(charges, samples, b, progress, error)
                          : fst_fail(error, FST_NO_MEMORY, PLACE, "out of memory");
    if (status == FST_OK)
        status = fst_field_map_new(samples, NULL, map, error);
    free(b);
    return status;
}

static fst_status make_map(const fst_field_map *measured, const fst_charges *charges, double height,
                           const fst_progress *progress, fst_field_map **smooth, fst_error *error)
{
    const fst_field_map_facts facts = fst_field_map_describe(measured);
    const double bottom = isnan(facts.first[2]) ? charges->sites.lies : facts.first[2];
    const double over = height - (bottom - charges->fit.depth), finest = over / 6.0;
    fst_field_samples samples = {.count = {0, 0, 1}, .first = {facts.first[0], facts.first[1], height}};
    if (!(over >= 0.5 * charges->fit.depth))
        return fst_fail(
            error, FST_BAD_INPUT, PLACE,
            "the height of %.6g mm is too near to the charges, which are %.6g mm below the map: from "
            "%.6g mm on their field is known",
            1e3 * height, 1e3 * charges->fit.depth, 1e3 * (bottom - 0.5 * charges->fit.depth));
    for (int axis = 0; axis < 2; ++axis) {
        const int times = (int)ceil(facts.spacing[axis] / finest);
        samples.count[axis] = (facts.count[axis] - 1) * times + 1;
        samples.spacing[axis] = facts.spacing[axis] / times;
    }
    return map_of(charges, &samples, progress, smooth, error);
}

fst_status fst_field_map_draw(const fst_field_map *smooth, uint64_t seed, const fst_progress *progress,
                              fst_field_map **drawn, fst_error *error)
{
    const fst_charges *charges = fst_map_charges(smooth);
    const fst_field_map_facts facts = fst_field_map_describe(smooth);
    fst_field_samples samples = {.count = {facts.count[0], facts.count[1], 1}};
    *drawn = NULL;
    if (!charges)
        return fst_fail(error, FST_BAD_INPUT, PLACE, "fields are drawn of a smoothed map, which this is not");
    memcpy(samples.first, facts.first, sizeof samples.first);
    memcpy(samples.spacing, facts.spacing, sizeof samples.spacing);
    fst_charges one = *charges;
    one.strength = calloc((size_t)(CHARGE_CLASSES * charge_columns(&charges->sites)), sizeof *one.strength);
    if (one.strength)
        fst_charges_draw(charges, seed, one.strength);
    const fst_status status = one.strength ? map_of(&one, &samples, progress, drawn, error)
                                           : fst_fail(error, FST_NO_MEMORY, PLACE, "out of memory");
    free(one.strength);
    return status;
}

const char *fst_noise_verdict_name(fst_noise_verdict verdict)
{
    FST_NAME_IN(FST_NOISE_VERDICTS, verdict, "unknown");
}

void fst_map_fit_sentence(const fst_map_fit *fit, char *sentence, size_t size)
{
    static const char causes[] = "a turned probe, exchanged axes, wrong places?";
    const double times = sqrt(fit->chi2), milli = 1e3;
    sentence[0] = '\0';
    if (fit->verdict == FST_NOISE_MISFIT && isnan(fit->told))
        (void)snprintf(sentence, size, "more is left than noise: %s", causes);
    else if (fit->verdict == FST_NOISE_AGREES)
        (void)snprintf(sentence, size,
                       "the residuals are %.4g times the noise told, with which %.4g to %.4g agree", times,
                       sqrt(fit->bound[0]), sqrt(fit->bound[1]));
    else if (fit->verdict == FST_NOISE_MISFIT)
        (void)snprintf(
            sentence, size,
            "the residuals are %.3g times the noise told, of which neighbouring samples show %.3g mT: "
            "more is left than noise: %s",
            times, milli * fit->rough, causes);
    else if (fit->verdict != FST_NOISE_NOT_TOLD)
        (void)snprintf(sentence, size,
                       "the residuals are %.3g times the noise told: it is probably %.4g mT (%.4g to %.4g mT)",
                       times, milli * fit->seen[0], milli * fit->seen[1], milli * fit->seen[2]);
}

fst_status fst_field_map_smooth(const fst_field_map *measured, const fst_smoothing *how,
                                const fst_progress *progress, fst_field_map **smooth, fst_error *error)
{
    fst_charges *charges = NULL;
    const fst_part parts[2] = {{progress, 0.0, 0.9, NULL}, {progress, 0.9, 1.0, NULL}};
    const fst_progress told[2] = {{(void *)(uintptr_t)&parts[0], fst_part_tell},
                                  {(void *)(uintptr_t)&parts[1], fst_part_tell}};
    *smooth = NULL;
    fst_status status = check(measured, how, error);
    if (status == FST_OK)
        status = fst_charges_fit(measured, how, &told[0], &charges, error);
    if (status == FST_OK)
        status = make_map(measured, charges, how->height, &told[1], smooth, error);
    if (status == FST_OK)
        fst_map_own_charges(*smooth, charges, fst_charges_free, &charges->fit);
    else
        fst_charges_free(charges);
    return status;
}

/* Where the gradient's elements are among CHARGE_VALUES. */
static const int OF[3][3] = {{3, 4, 5}, {4, 6, 7}, {5, 7, 8}};

/* How a component of the force of fst_field_pull() changes with CHARGE_VALUES, B and gradient in T and T/m:
 * F = (p/|B| + 2 (a + b)) G'B with p = kappa eps^2. */
static void change_of_force(const fst_groups *g, const double b[3], double grad[3][3], int j,
                            double change[CHARGE_VALUES])
{
    const double norm = sqrt(b[0] * b[0] + b[1] * b[1] + b[2] * b[2]);
    const double hard = g->kappa * (g->eps * g->eps) / norm, all = hard + 2.0 * (g->a + g->b);
    const double slope = b[0] * grad[0][j] + b[1] * grad[1][j] + b[2] * grad[2][j];
    for (int v = 3; v < CHARGE_VALUES; ++v)
        change[v] = 0.0;
    for (int i = 0; i < 3; ++i) {
        change[i] = (all * grad[i][j] - hard * slope * b[i] / (norm * norm)) / g->field_unit;
        change[OF[i][j]] = all * b[i] / g->field_unit * g->length_unit;
    }
}

int fst_field_error(const fst_model *model, double x, double y, double b[3], double grad[3][3], double force[3])
{
    const fst_groups *g = &model->groups;
    const fst_charges *charges = model->map ? fst_map_charges(model->map) : NULL;
    double out[CHARGE_VALUES], covariance[CHARGE_VALUES][CHARGE_VALUES], here[3], slope[3][3], *room;
    const double place[3] = {x * g->length_unit, y * g->length_unit, g->h * g->length_unit};
    fst_field(model, x, y, here, slope);
    if (!charges || !isnan(model->field_time) || isnan(here[0]) || !(room = fst_charges_room(charges)))
        return 0;
    fst_charges_look(charges, place, CHARGE_VALUES, room, out, covariance[0]);
    free(room);
    for (int i = 0; i < 3; ++i) {
        double change[CHARGE_VALUES], variance = 0.0;
        change_of_force(g, here, slope, i, change);
        for (int k = 0; k < CHARGE_VALUES; ++k)
            for (int v = 0; v < CHARGE_VALUES; ++v)
                variance += change[k] * covariance[k][v] * change[v];
        force[i] = sqrt(variance);
        b[i] = sqrt(covariance[i][i]) / g->field_unit;
        for (int k = 0; k < 3; ++k)
            grad[i][k] = sqrt(covariance[OF[i][k]][OF[i][k]]) / g->field_unit * g->length_unit;
    }
    return 1;
}

const fst_field_map *fst_model_map(const fst_model *model)
{
    return model->map;
}
