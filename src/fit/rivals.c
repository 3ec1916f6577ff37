/* rivals.c - the same numbers by another law of friction, or by other equations of motion.
 *
 * Each rival has the same number of parameters: where friction is dry, its coefficient takes the place of
 * gamma, which is a mere unit there.  Akaike's criterion then says how much better one explains the numbers
 * than another.
 */
#include "fit/report.h"

#include <math.h>
#include <string.h>

static int is_dry(int law)
{
    return law == FST_FRICTION_COULOMB;
}

/* The key that a rival seeks where the fit sought `key`. */
static const char *key_of(const char *key, int law)
{
    if (is_dry(law))
        return strcmp(key, "friction.gamma") == 0 ? "friction.mu" : key;
    return strcmp(key, "friction.mu") == 0 ? "friction.gamma" : key;
}

/* Fit one rival. */
static fst_status fit_rival(const fit_problem *p, const fst_points *points, const fst_fit_options *options,
                            const fst_params *found, fst_fit_rival *rival, fst_error *error)
{
    const char *keys[FST_FIT_MOST_KEYS];
    fst_params params = *found;
    fst_fit_options mine = *options;
    fit_problem q;
    double u[FIT_MOST] = {0.0}, chi2 = NAN;
    params.friction_law = rival->law;
    params.model_dynamics = rival->dynamics;
    if (rival->law != found->friction_law && is_dry(rival->law))
        params.friction_mu = p->space.base.friction_mu;
    for (int i = 0; i < options->free_count; ++i)
        keys[i] = key_of(options->free[i], rival->law);
    mine.free = keys;
    fst_status status = fit_problem_begin(&q, &params, points, &mine, p->rows.progress, error);
    q.tolerance = 1e-3; /* of chi^2, of which differences of 10 count */
    q.most_calls = 30;
    for (int i = 0; i < q.count && i < p->count; ++i) {
        q.numbers[i].weight = p->numbers[i].weight;
        q.numbers[i].value = p->numbers[i].value;
    }
    if (status == FST_OK)
        status = fit_find_start(&q, u, error);
    if (status == FST_OK)
        status = fit_take_frequency_slopes(&q, error);
    if (status == FST_OK)
        status = fit_solve(&q, u, &chi2, error);
    rival->fitted = status == FST_OK;
    rival->chi2 = chi2;
    rival->aicc = fit_aicc(chi2, fit_used(p), options->free_count);
    fit_problem_free(&q);
    return status;
}

fst_status fit_rivals(const fit_problem *p, fit_stage *stage, const fst_points *points,
                      const fst_fit_options *options, fst_fit *fit, fst_error *error)
{
    static const int laws[] = {FST_FRICTION_VISCOUS, FST_FRICTION_COULOMB};
    static const int dynamics[] = {FST_DYNAMICS_RIGID, FST_DYNAMICS_FARAGO2020};
    fst_error ignored;
    for (int i = 0; i < FST_FIT_MOST_RIVALS; ++i) {
        fst_fit_rival *rival = &fit->rivals[fit->rival_count++];
        *rival = (fst_fit_rival){.law = laws[i / 2], .dynamics = dynamics[i % 2]};
        fit_stage_begin(stage, "other laws", 0.7 + 0.05 * i, 0.75 + 0.05 * i, 20.0);
        if (rival->law == fit->params.friction_law && rival->dynamics == fit->params.model_dynamics) {
            rival->fitted = 1;
            rival->chi2 = fit->chi2;
            rival->aicc = fit->aicc;
            continue;
        }
        const fst_status status = fit_rival(p, points, options, &fit->params, rival, &ignored);
        if (status == FST_INTERRUPTED || status == FST_NO_MEMORY) {
            if (error)
                *error = ignored;
            return status;
        }
    }
    return FST_OK;
}
