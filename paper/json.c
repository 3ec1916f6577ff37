/* json.c - paper.json: the comparison for programs. */
#include "paper/beads.h"
#include "paper/waves.h"
#include "paper/dry.h"
#include "paper/figures.h"
#include "paper/magnets.h"
#include "paper/report.h"
#include "paper/runs.h"
#include "paper/work.h"

#include "base/error.h"

#include <jansson.h>
#include <stdarg.h>
#include <stdlib.h>

enum { JSON_STYLE = JSON_INDENT(1) | JSON_REAL_PRECISION(17) };

/* Put a value under a key.  No value becomes null: jansson makes none of NULL and of numbers that are not
 * finite. */
__attribute__((format(printf, 3, 4))) static void put(json_t *object, json_t *value, const char *key, ...)
{
    char name[64];
    va_list words;
    va_start(words, key);
    (void)vsnprintf(name, sizeof name, key, words);
    va_end(words);
    json_object_set_new(object, name, value ? value : json_null());
}

static void put_text(json_t *object, const char *key, const char *text)
{
    put(object, json_string(text), "%s", key);
}

static void put_number(json_t *object, const char *key, double value)
{
    put(object, json_real(value), "%s", key);
}

static json_t *verdict(fst_verdict found)
{
    return json_string(fst_verdict_name(found));
}

static json_t *symmetry(double a)
{
    return isfinite(a) ? json_string(fst_symmetry_name(a < 1.5 ? FST_SYMMETRY_S1 : FST_SYMMETRY_S2)) : NULL;
}

/* ------------------------------------------------------------------ Table 1 and the figures */

/* What the branch of periodic orbits tells or, where it is missing, why it is. */
static json_t *orbits_object(const fst_paper_state *paper)
{
    json_t *object = json_object();
    for (int i = 0; i < FST_PAPER_DYNAMICS; ++i) {
        const fst_paper_exact *exact = &paper->exact[fst_paper_order[i]];
        json_t *one = json_object();
        put_number(one, "period_halving", exact->halving);
        put_number(one, "end_of_counter_rotation", exact->fold);
        put_text(one, "missing", exact->missing[0] ? exact->missing : NULL);
        put(object, one, "%s", fst_dynamics_name(fst_paper_order[i]));
    }
    return object;
}

static json_t *table1_row(const fst_paper_state *paper, int row)
{
    const fst_table1_row *printed = &fst_table1[row];
    json_t *object = json_object();
    put_number(object, "omega", printed->omega);
    put_number(object, "published", printed->published);
    put(object, json_integer(printed->count), "count");
    put(object, symmetry(printed->published_a), "published_symmetry");
    for (int i = 0; i < FST_PAPER_DYNAMICS; ++i) {
        const fst_dynamics d = fst_paper_order[i];
        const fst_run_result *result = &paper->scans[FST_SCAN_TABLE][d][row].result;
        const fst_paper_pattern *closed = &paper->exact[d].closed[row];
        const char *name = fst_dynamics_name(d);
        char command[320];
        fst_paper_table1_command(paper, row, d, command, sizeof command);
        put(object, json_string(command), "%s_command", name);
        put_number(object, name, result->festoons);
        put(object, json_string(fst_symmetry_name(result->symmetry)), "%s_symmetry", name);
        put(object, json_real(fst_table1_deviation(paper, row, d)), "%s_deviation", name);
        put(object, json_real(closed->omega), "%s_closes_at", name);
        put(object, isfinite(closed->omega) ? json_string(fst_symmetry_name(closed->symmetry)) : NULL,
            "%s_closes_with", name);
        put(object, verdict(fst_table1_verdict(paper, row, d)), "%s_verdict", name);
    }
    return object;
}

static json_t *table1_array(const fst_paper_state *paper)
{
    json_t *rows = json_array();
    const int known = fst_paper_has(paper, FST_PAPER_STEP_RUNS, FST_SCAN_TABLE);
    for (int row = 0; row < FST_TABLE1_ROWS && known; ++row)
        json_array_append_new(rows, table1_row(paper, row));
    return rows;
}

static json_t *figure_verdict(const fst_paper_state *paper, const fst_paper_figure *figure,
                              fst_dynamics dynamics)
{
    fst_verdict found;
    return fst_paper_figure_verdict(paper, figure, dynamics, &found) ? verdict(found) : NULL;
}

static json_t *figures_array(const fst_paper_state *paper)
{
    json_t *array = json_array();
    for (int i = 0; i < fst_paper_figure_count(); ++i) {
        const fst_paper_figure figure = fst_paper_figure_at(i);
        if (!paper->drawn[i])
            continue;
        char command[512];
        fst_paper_figure_command(paper, &figure, command, sizeof command);
        json_t *object = json_object();
        put_text(object, "name", figure.file);
        put(object, json_sprintf("%s.svg", figure.file), "file");
        put_text(object, "source", figure.source);
        put_text(object, "title", figure.title);
        put_text(object, "command", command);
        put_text(object, "dynamics", figure.each ? fst_dynamics_name(figure.dynamics) : NULL);
        put(object, figure_verdict(paper, &figure, figure.dynamics), "verdict");
        if (!figure.each)
            put(object, figure_verdict(paper, &figure, FST_DYNAMICS_RIGID), "rigid_verdict");
        json_array_append_new(array, object);
    }
    return array;
}

/* ------------------------------------------------------------------ statements */

static json_t *statement_value(const fst_statement *statement, double value)
{
    return statement->rule == FST_RULE_SYMMETRY ? symmetry(value) : json_real(value);
}

/* The printed equations are what was published.  So their verdict, command and so on have the plain names, and
 * those of the exact equations begin with "rigid_". */
static void add_dynamics(json_t *object, const fst_statement *statement, const fst_paper_state *paper,
                         const fst_finding *finding, fst_dynamics dynamics)
{
    const char *name = fst_dynamics_name(dynamics), *prefix = dynamics == FST_DYNAMICS_RIGID ? "rigid_" : "";
    char command[320];
    fst_statement_command(statement, paper, dynamics, command, sizeof command);
    put(object, statement_value(statement, finding->value[dynamics]), "%s", name);
    put(object, verdict(finding->verdict[dynamics]), "%s_verdict", name);
    put(object, json_string(finding->note[dynamics]), "%s_note", name);
    put(object, json_boolean(finding->undecided[dynamics]), "%s_undecided", name);
    put(object, json_string(command), "%scommand", prefix);
    put(object, json_string(fst_statement_reads(statement, dynamics)), "%sreads", prefix);
}

static void add_dry(json_t *object, const fst_statement *statement, const fst_paper_state *paper,
                    const fst_finding *finding)
{
    if (!finding->dry)
        return;
    char command[384];
    fst_statement_dry_command(statement, paper, command, sizeof command);
    put(object, statement_value(statement, finding->dry_value), "coulomb");
    put_number(object, "coulomb_mu", FST_DRY_MU);
    put(object, verdict(finding->dry_verdict), "coulomb_verdict");
    put_text(object, "coulomb_note", finding->dry_note);
    put(object, json_boolean(finding->dry_undecided), "coulomb_undecided");
    put_text(object, "coulomb_command", command);
    put_text(object, "coulomb_reads", fst_statement_dry_reads(statement));
}

/* The distance from the border that is nearest, as a share of what it allows; where the verdict hangs by a
 * hair, and at which value it turns. */
static void add_margin(json_t *object, const fst_statement *statement, const char *name, double value)
{
    double border;
    put(object, json_real(fst_statement_margin(statement, value, &border)), "%s_margin", name);
    put(object, json_real(border), "%s_border", name);
}

/* Another way to read the same sentence; the verdict of the statement is the first's. */
static json_t *second_object(const fst_statement *statement, const fst_paper_state *paper)
{
    const fst_reading *reading = fst_statement_reading(statement);
    if (!reading)
        return NULL;
    const fst_statement *second = &reading->second;
    const fst_finding finding = fst_reading_check(reading, statement, paper);
    char criterion[320];
    fst_statement_criterion(second, criterion, sizeof criterion);
    json_t *object = json_object();
    put_text(object, "first", reading->first);
    put_text(object, "reading", reading->words);
    put_text(object, "chosen", reading->chosen);
    put(object, statement_value(second, second->published), "published");
    put_text(object, "unit", second->unit);
    put_number(object, "scale", second->scale);
    put_text(object, "criterion", criterion);
    for (int i = 0; i < FST_PAPER_DYNAMICS; ++i) {
        const fst_dynamics d = fst_paper_order[i];
        const char *name = fst_dynamics_name(d);
        put(object, statement_value(second, finding.value[d]), "%s", name);
        put(object, verdict(finding.verdict[d]), "%sverdict", d == FST_DYNAMICS_RIGID ? "rigid_" : "");
        put(object, json_string(finding.note[d]), "%s_note", name);
    }
    if (finding.dry) {
        put(object, statement_value(second, finding.dry_value), "coulomb");
        put(object, verdict(finding.dry_verdict), "coulomb_verdict");
    }
    return object;
}

static json_t *statement_object(const fst_statement *statement, const fst_paper_state *paper)
{
    const fst_finding finding = fst_statement_check(statement, paper);
    char criterion[320], printed[64];
    fst_statement_criterion(statement, criterion, sizeof criterion);
    fst_statement_published(statement, printed, sizeof printed);
    json_t *object = json_object();
    put_text(object, "id", statement->id);
    put_text(object, "section", statement->section);
    put_text(object, "statement", statement->text);
    put(object, statement_value(statement, statement->published), "published");
    put_text(object, "published_words", statement->said);
    put_text(object, "printed", printed);
    put_text(object, "group", fst_groups_of_statements[statement->group].name);
    put(object, json_boolean(statement->still), "same_for_both");
    put(object, json_boolean(!statement->check), "claim");
    put_text(object, "unit", statement->unit);
    put_number(object, "scale", statement->scale);
    put_text(object, "criterion", criterion);
    put(object, verdict(finding.verdict[FST_DYNAMICS_FARAGO2020]), "verdict");
    add_dynamics(object, statement, paper, &finding, FST_DYNAMICS_FARAGO2020);
    add_dynamics(object, statement, paper, &finding, FST_DYNAMICS_RIGID);
    add_dry(object, statement, paper, &finding);
    for (int i = 0; i < FST_PAPER_DYNAMICS; ++i)
        add_margin(object, statement, fst_dynamics_name(fst_paper_order[i]), finding.value[fst_paper_order[i]]);
    if (finding.dry)
        add_margin(object, statement, "coulomb", finding.dry_value);
    put(object, second_object(statement, paper), "second_reading");
    return object;
}

static json_t *statements_array(const fst_paper_state *paper)
{
    json_t *array = json_array();
    for (int i = 0; i < fst_statement_count(); ++i)
        if (fst_statement_known(fst_statement_at(i), paper))
            json_array_append_new(array, statement_object(fst_statement_at(i), paper));
    return array;
}

char *fst_paper_statement_json(const fst_paper_state *paper, const fst_statement *statement)
{
    fst_paper_file file;
    if (fst_paper_file_begin(&file, NULL) != FST_OK)
        return NULL;
    json_t *object = statement_object(statement, paper);
    const int failed = json_dumpf(object, file.stream, JSON_STYLE) != 0 || fputc('\n', file.stream) == EOF;
    json_decref(object);
    file.printed.failed |= failed;
    return fst_print_end(&file.printed);
}

/* ------------------------------------------------------------------ dry friction and real magnets */

static json_t *fact_object(const fst_statement *about, const char *name, json_t *values)
{
    json_t *object = json_object();
    put_text(object, "id", about->id);
    put_text(object, "fact", about->text);
    put_number(object, "published", about->published);
    put_text(object, "unit", about->unit);
    put(object, values, "%s", name);
    return object;
}

static json_t *dry_fact(const fst_paper_state *paper, int fact)
{
    const fst_statement *about = &fst_dry_facts[fact];
    json_t *laws = json_array();
    for (int law = 0; law < FST_DRY_LAWS; ++law) {
        const double value = fst_dry_fact(paper, fact, law);
        char name[48];
        fst_dry_law_name(law, name, sizeof name);
        json_t *one = json_object();
        put_text(one, "law", name);
        put_number(one, "mu", law < FST_PAPER_DYNAMICS ? NAN : fst_dry_mus[law - FST_PAPER_DYNAMICS]);
        put_number(one, "value", value);
        put_number(one, "distance", value - about->published);
        put(one, verdict(fst_statement_verdict(about, value)), "verdict");
        json_array_append_new(laws, one);
    }
    return fact_object(about, "laws", laws);
}

/* A run of either chapter: drive, start, outcome, means. */
static json_t *run_object(const fst_paper_run *run)
{
    const fst_run_result *result = &run->result;
    const int dry = run->params.friction_law == FST_FRICTION_COULOMB;
    json_t *object = json_object();
    put_number(object, "mu", dry ? run->params.friction_mu : NAN);
    put_number(object, "frequency_hz", result->frequency_hz);
    put_text(object, "start", run->params.start_spin == FST_SPIN_REST ? "rest" : "rolling");
    put_text(object, "symmetry", fst_symmetry_name(result->symmetry));
    put_text(object, "outcome", fst_outcome_names[fst_outcome(result)]);
    put_text(object, "regime", fst_regime_name(result->regime));
    put(object, json_boolean(fst_paper_is_settled(result)), "settled");
    put_number(object, "mean_r", result->mean_r);
    put_number(object, "std_r", result->std_r);
    put_number(object, "mean_alpha_dot", result->mean_alpha_dot);
    put_number(object, "festoons", result->festoons);
    put_number(object, "sticking", result->sticking);
    put_number(object, "captures_per_return", result->captures_per_return);
    put_number(object, "effective_rate", result->effective_rate);
    return object;
}

static json_t *dry_object(const fst_paper_state *paper)
{
    if (!paper->dry || !paper->done[FST_PAPER_STEP_DRY])
        return NULL;
    json_t *object = json_object(), *facts = json_array(), *map = json_array();
    for (int fact = 0; fact < FST_FACT_COUNT; ++fact)
        json_array_append_new(facts, dry_fact(paper, fact));
    const fst_paper_run *runs = &paper->dry->map[0][0][0];
    for (size_t i = 0; i < sizeof paper->dry->map / sizeof *runs; ++i)
        if (runs[i].done)
            json_array_append_new(map, run_object(&runs[i]));
    put_number(object, "mu", FST_DRY_MU);
    put(object, facts, "facts");
    put(object, map, "map");
    return object;
}

static json_t *magnet_fact(const fst_paper_state *paper, int fact)
{
    const fst_statement *about = fst_magnet_fact_about(fact);
    json_t *values = json_array();
    for (int i = 0; i < FST_MAGNETS * FST_MAGNET_LAWS; ++i) {
        const int magnet = i / FST_MAGNET_LAWS, law = i % FST_MAGNET_LAWS;
        const double value = fst_magnet_fact(paper, fact, magnet, law);
        const int judged = isfinite(value) && (isfinite(about->published) || about->rule != FST_RULE_NUMBER);
        json_t *one = json_object();
        put_text(one, "magnet", fst_shown_magnets[magnet].id);
        put_text(one, "law", fst_magnet_law_name(law));
        put_number(one, "value", value);
        put(one, judged ? verdict(fst_statement_verdict(about, value)) : NULL, "verdict");
        json_array_append_new(values, one);
    }
    return fact_object(about, "values", values);
}

static json_t *part_object(const fst_magnet_part *part, double remanence)
{
    const double *at = part->centre, *size = part->size, *j = part->remanence;
    return json_pack("{s:s, s:[fff], s:[fff], s:[fff]}", "kind", "cuboid", "centre_m", at[0], at[1], at[2],
                     "size_m", size[0], size[1], size[2], "remanence_t", remanence * j[0], remanence * j[1],
                     remanence * j[2]);
}

static json_t *magnet_object(const fst_paper_state *paper, int magnet)
{
    const fst_shown_magnet *shown = &fst_shown_magnets[magnet];
    const fst_magnet_column *column = &paper->magnets->of[magnet];
    json_t *object = json_object(), *parts = json_array(), *runs = json_array();
    put_text(object, "id", shown->id);
    put_text(object, "name", shown->name);
    put_text(object, "about", shown->about);
    put_number(object, "remanence_t", column->remanence);
    put_number(object, "maxima_mm", column->apart);
    put_number(object, "maxima_on_plate_mm", column->apart_plate);
    for (int part = 0; part < shown->part_count; ++part)
        json_array_append_new(parts, part_object(&shown->parts[part], column->remanence));
    for (int i = 0; i < FST_MAGNET_LAWS * FST_MAGNET_RUNS; ++i) {
        const int law = i / FST_MAGNET_RUNS;
        const fst_paper_run *made = &column->runs[law][i % FST_MAGNET_RUNS];
        if (!made->done)
            continue;
        json_t *run = run_object(made);
        put_text(run, "law", fst_magnet_law_name(law));
        json_array_append_new(runs, run);
    }
    put(object, parts, "parts");
    put(object, runs, "runs");
    return object;
}

static json_t *magnets_object(const fst_paper_state *paper)
{
    if (!fst_paper_has_magnets(paper))
        return NULL;
    json_t *object = json_object(), *facts = json_array(), *magnets = json_array();
    for (int fact = 0; fact < FST_MAGNET_FACTS; ++fact)
        json_array_append_new(facts, magnet_fact(paper, fact));
    for (int magnet = 0; magnet < FST_MAGNETS; ++magnet)
        json_array_append_new(magnets, magnet_object(paper, magnet));
    put_number(object, "bead_remanence_t", FST_MAGNET_BEAD);
    put_number(object, "kappa_of_lines", FST_MAGNET_KAPPA);
    put_number(object, "greatest_field_t", paper->magnets->greatest);
    put(object, facts, "facts");
    put(object, magnets, "magnets");
    return object;
}

static json_t *beads_array(const fst_paper_state *paper)
{
    if (!paper->beads)
        return NULL;
    json_t *array = json_array();
    for (int i = 0; i < FST_BEADS_CASES; ++i) {
        const fst_beads_case *of = &fst_beads_cases[i];
        const fst_beads_answer *answer = &paper->beads->answers[i];
        const int ran = of->question == FST_ASK_BORDER || of->question == FST_ASK_WALKER;
        if (!answer->done)
            continue;
        json_t *one = json_object();
        put_text(one, "question", fst_beads_question_names[of->question]);
        put_number(one, "frequency_hz", of->hertz);
        put_number(one, "given", of->given);
        put_text(one, "outcome", ran ? fst_beads_outcome_name(answer->outcome) : NULL);
        put_number(one, "value", answer->value);
        put_number(one, "r", answer->r);
        json_array_append_new(array, one);
    }
    return array;
}

static json_t *waves_object(const fst_paper_state *paper)
{
    static const char *const ways[FST_WAVE_WAYS] = {"up", "down", "forward"};
    const fst_paper_waves *w = paper->waves;
    if (!w || !paper->done[FST_PAPER_STEP_WAVES])
        return NULL;
    json_t *object = json_object(), *numbers = json_object(), *shares = json_array();
    for (int way = 0; way < FST_WAVE_WAYS; ++way) {
        json_t *runs = json_array();
        for (int i = 0; i < w->drives; ++i) {
            json_t *run = json_object();
            put_number(run, "frequency_hz", w->hertz[i]);
            put_number(run, "mean_velocity_mm_s", w->velocity[way][i]);
            put_text(run, "regime", fst_regime_name(w->regime[way][i]));
            json_array_append_new(runs, run);
        }
        put(object, runs, "%s", ways[way]);
    }
    for (int i = 0; i < FST_WAVE_NUMBERS; ++i) {
        json_t *one = json_object();
        put_number(one, "found", fst_wave_found(w, (fst_wave_number)i));
        put_number(one, "formula", fst_wave_formula((fst_wave_number)i));
        put(numbers, one, "%s", fst_wave_names[i]);
    }
    for (int i = 0; i < FST_WAVE_RATIOS && isfinite(w->share[i]); ++i) {
        json_t *one = json_object();
        put_number(one, "ratio", fst_wave_ratios[i]);
        put_number(one, "forward", w->share[i]);
        json_array_append_new(shares, one);
    }
    put(object, numbers, "numbers");
    put(object, shares, "from_rest");
    return object;
}

/* ------------------------------------------------------------------ the document */

static json_t *provenance_object(const fst_paper_state *paper)
{
    const fst_params *params = &fst_paper_single(paper, FST_SCAN_FOLD15, FST_DYNAMICS_RIGID)->params;
    char *scene = fst_scene_text(params, 0), machine[512];
    fst_paper_machine(machine, sizeof machine);
    json_t *object = json_object(), *parts = json_object();
    put_text(object, "version", fst_version());
    put(object, json_boolean(paper->options->reduced), "reduced");
    put_number(object, "rtol", params->run_rtol);
    put_number(object, "periods", params->run_periods);
    put_number(object, "discard", params->run_discard);
    put_number(object, "seconds", paper->seconds);
    put_number(object, "processor_seconds", paper->processor_seconds);
    for (int i = 0; i < paper->part_count; ++i)
        put_number(parts, paper->parts[i].what, paper->parts[i].seconds);
    put(object, parts, "parts");
    put_text(object, "machine", machine);
    put_text(object, "scene", scene);
    free(scene);
    return object;
}

fst_status fst_paper_write_json(const fst_paper_state *paper, fst_error *error)
{
    fst_paper_file file;
    fst_status status = fst_paper_file_begin(&file, error);
    if (status != FST_OK)
        return status;
    json_t *document = json_object(), *films = json_array();
    for (int i = 0; i < paper->films; ++i)
        json_array_append_new(films, json_sprintf("%s.mp4", fst_film_names[i]));
    put(document, json_boolean(paper->complete), "complete");
    put(document, table1_array(paper), "table1");
    put_text(document, "table1_criterion", FST_TABLE1_CRITERION);
    put(document, orbits_object(paper), "orbits");
    put(document, statements_array(paper), "statements");
    put(document, dry_object(paper), "dry");
    put(document, magnets_object(paper), "magnets");
    put(document, beads_array(paper), "beads");
    put(document, waves_object(paper), "waves");
    put(document, figures_array(paper), "figures");
    put(document, films, "films");
    put(document, provenance_object(paper), "provenance");
    if (json_dumpf(document, file.stream, JSON_STYLE) != 0 || fputc('\n', file.stream) == EOF)
        status = fst_fail(error, FST_NO_MEMORY, "paper.json", "no memory for this file");
    json_decref(document);
    return fst_paper_file_end(&file, paper, "paper", "json", status, error);
}
