/* magnets_json.c - the object "magnets" of paper.json: the magnets, the facts, and the runs. */
#include "paper/dry_json.h"
#include "paper/magnets.h"
#include "paper/magnets_json.h"

#include "io/json_parts.h"

static json_t *fact_object(const fst_paper_state *paper, int fact)
{
    const fst_statement *about = fst_magnet_fact_about(fact);
    json_t *object = json_object(), *values = json_array();
    json_object_set_new(object, "id", json_string(about->id));
    json_object_set_new(object, "fact", json_string(about->text));
    json_object_set_new(object, "published", fst_json_number(about->published));
    json_object_set_new(object, "unit", json_string(about->unit));
    for (int magnet = 0; magnet < FST_MAGNETS; ++magnet)
        for (int law = 0; law < FST_MAGNET_LAWS; ++law) {
            const double value = fst_magnet_fact(paper, fact, magnet, law);
            json_t *one = json_object();
            json_object_set_new(one, "magnet", json_string(fst_shown_magnets[magnet].id));
            json_object_set_new(one, "law", json_string(fst_magnet_law_name(law)));
            json_object_set_new(one, "value", fst_json_number(value));
            json_object_set_new(one, "verdict",
                                isfinite(value) &&
                                        (isfinite(about->published) || about->rule != FST_RULE_NUMBER)
                                    ? json_string(fst_verdict_name(fst_statement_verdict(about, value)))
                                    : json_null());
            json_array_append_new(values, one);
        }
    json_object_set_new(object, "values", values);
    return object;
}

static json_t *part_object(const fst_magnet_part *part, double remanence)
{
    json_t *object = json_object();
    json_object_set_new(object, "kind", json_string("cuboid"));
    json_object_set_new(object, "centre_m",
                        json_pack("[fff]", part->centre[0], part->centre[1], part->centre[2]));
    json_object_set_new(object, "size_m", json_pack("[fff]", part->size[0], part->size[1], part->size[2]));
    json_object_set_new(object, "remanence_t",
                        json_pack("[fff]", remanence * part->remanence[0], remanence * part->remanence[1],
                                  remanence * part->remanence[2]));
    return object;
}

static json_t *magnet_object(const fst_paper_state *paper, int magnet)
{
    const fst_shown_magnet *shown = &fst_shown_magnets[magnet];
    const fst_magnet_column *column = &paper->magnets->of[magnet];
    json_t *object = json_object(), *parts = json_array(), *runs = json_array();
    json_object_set_new(object, "id", json_string(shown->id));
    json_object_set_new(object, "name", json_string(shown->name));
    json_object_set_new(object, "about", json_string(shown->about));
    json_object_set_new(object, "remanence_t", fst_json_number(column->remanence));
    json_object_set_new(object, "maxima_mm", fst_json_number(column->apart));
    json_object_set_new(object, "maxima_on_plate_mm", fst_json_number(column->apart_plate));
    for (int part = 0; part < shown->part_count; ++part)
        json_array_append_new(parts, part_object(&shown->parts[part], column->remanence));
    for (int law = 0; law < FST_MAGNET_LAWS; ++law)
        for (int i = 0; i < FST_MAGNET_RUNS; ++i) {
            if (!column->runs[law][i].done)
                continue;
            json_t *run = fst_paper_dry_run_json(&column->runs[law][i]);
            json_object_set_new(run, "law", json_string(fst_magnet_law_name(law)));
            json_array_append_new(runs, run);
        }
    json_object_set_new(object, "parts", parts);
    json_object_set_new(object, "runs", runs);
    return object;
}

json_t *fst_paper_magnets_json(const fst_paper_state *paper)
{
    if (!fst_paper_has_magnets(paper))
        return json_null();
    json_t *object = json_object(), *facts = json_array(), *magnets = json_array();
    json_object_set_new(object, "bead_remanence_t", json_real(FST_MAGNET_BEAD));
    json_object_set_new(object, "kappa_of_lines", json_real(FST_MAGNET_KAPPA));
    json_object_set_new(object, "greatest_field_t", json_real(paper->magnets->greatest));
    for (int fact = 0; fact < FST_MAGNET_FACTS; ++fact)
        json_array_append_new(facts, fact_object(paper, fact));
    for (int magnet = 0; magnet < FST_MAGNETS; ++magnet)
        json_array_append_new(magnets, magnet_object(paper, magnet));
    json_object_set_new(object, "facts", facts);
    json_object_set_new(object, "magnets", magnets);
    return object;
}
