/* dry_json.c - the object "dry" of paper.json: the table of facts, and the small map. */
#include "paper/dry.h"
#include "paper/dry_json.h"
#include "paper/runs.h"

#include "io/json_parts.h"

static json_t *fact_object(const fst_paper_state *paper, int fact)
{
    const fst_statement *about = &fst_dry_facts[fact];
    json_t *object = json_object(), *laws = json_array();
    json_object_set_new(object, "id", json_string(about->id));
    json_object_set_new(object, "fact", json_string(about->text));
    json_object_set_new(object, "published", fst_json_number(about->published));
    json_object_set_new(object, "unit", json_string(about->unit));
    for (int law = 0; law < FST_DRY_LAWS; ++law) {
        const double value = fst_dry_fact(paper, fact, law);
        char name[48];
        fst_dry_law_name(law, name, sizeof name);
        json_t *one = json_object();
        json_object_set_new(one, "law", json_string(name));
        json_object_set_new(one, "mu",
                            law < FST_PAPER_DYNAMICS ? json_null()
                                                     : json_real(fst_dry_mus[law - FST_PAPER_DYNAMICS]));
        json_object_set_new(one, "value", fst_json_number(value));
        json_object_set_new(one, "distance", fst_json_number(value - about->published));
        json_object_set_new(one, "verdict", json_string(fst_verdict_name(fst_statement_verdict(about, value))));
        json_array_append_new(laws, one);
    }
    json_object_set_new(object, "laws", laws);
    return object;
}

json_t *fst_paper_dry_run_json(const fst_paper_run *run)
{
    const fst_run_result *result = &run->result;
    json_t *object = json_object();
    json_object_set_new(object, "mu",
                        run->params.friction_law == FST_FRICTION_COULOMB ? json_real(run->params.friction_mu)
                                                                         : json_null());
    json_object_set_new(object, "frequency_hz", json_real(result->frequency_hz));
    json_object_set_new(object, "start",
                        json_string(run->params.start_spin == FST_SPIN_REST ? "rest" : "rolling"));
    const char *symmetry = fst_symmetry_name(result->symmetry);
    json_object_set_new(object, "symmetry", symmetry ? json_string(symmetry) : json_null());
    json_object_set_new(object, "outcome", json_string(fst_outcome_names[fst_outcome(result)]));
    json_object_set_new(object, "regime", json_string(fst_regime_name(result->regime)));
    json_object_set_new(object, "settled", json_boolean(fst_paper_is_settled(result)));
    json_object_set_new(object, "mean_r", fst_json_number(result->mean_r));
    json_object_set_new(object, "std_r", fst_json_number(result->std_r));
    json_object_set_new(object, "mean_alpha_dot", fst_json_number(result->mean_alpha_dot));
    json_object_set_new(object, "festoons", fst_json_number(result->festoons));
    json_object_set_new(object, "sticking", fst_json_number(result->sticking));
    json_object_set_new(object, "captures_per_return", fst_json_number(result->captures_per_return));
    json_object_set_new(object, "effective_rate", fst_json_number(result->effective_rate));
    return object;
}

json_t *fst_paper_dry_json(const fst_paper_state *paper)
{
    if (!paper->dry || !paper->done[FST_PAPER_STEP_DRY])
        return json_null();
    json_t *object = json_object(), *facts = json_array(), *map = json_array();
    json_object_set_new(object, "mu", json_real(FST_DRY_MU));
    for (int fact = 0; fact < FST_FACT_COUNT; ++fact)
        json_array_append_new(facts, fact_object(paper, fact));
    json_object_set_new(object, "facts", facts);
    for (int mu = 0; mu < FST_DRY_MUS; ++mu)
        for (int drive = 0; drive < FST_DRY_DRIVES; ++drive)
            for (int start = 0; start < FST_DRY_STARTS; ++start)
                if (paper->dry->map[mu][drive][start].done)
                    json_array_append_new(map, fst_paper_dry_run_json(&paper->dry->map[mu][drive][start]));
    json_object_set_new(object, "map", map);
    return object;
}
