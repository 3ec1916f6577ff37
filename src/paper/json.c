/* json.c - paper.json: the comparison for programs. */
#include "paper/dry.h"
#include "paper/dry_json.h"
#include "paper/magnets_json.h"
#include "paper/figures.h"
#include "paper/report.h"
#include "paper/runs.h"
#include "paper/work.h"

#include "base/error.h"
#include "host/whole_file.h"
#include "io/json_parts.h"

#include <jansson.h>
#include <stdlib.h>

static json_t *symmetry(double a)
{
    return isfinite(a) ? json_string(a < 1.5 ? "S1" : "S2") : json_null();
}

static json_t *closed_symmetry(const fst_paper_pattern *pattern)
{
    const char *name = isfinite(pattern->omega) ? fst_symmetry_name(pattern->symmetry) : NULL;
    return name ? json_string(name) : json_null();
}

/* What the branch of periodic orbits tells or, where it is missing, why it is. */
static json_t *orbits_object(const fst_paper_state *paper)
{
    json_t *object = json_object();
    for (int d = FST_PAPER_DYNAMICS - 1; d >= 0; --d) {
        const fst_paper_exact *exact = &paper->exact[d];
        json_t *one = json_object();
        json_object_set_new(one, "period_halving", fst_json_number(exact->halving));
        json_object_set_new(one, "end_of_counter_rotation", fst_json_number(exact->fold));
        json_object_set_new(one, "missing", exact->missing[0] ? json_string(exact->missing) : json_null());
        json_object_set_new(object, fst_dynamics_name((fst_dynamics)d), one);
    }
    return object;
}

static json_t *table1_array(const fst_paper_state *paper)
{
    json_t *rows = json_array();
    int known = fst_paper_has(paper, FST_PAPER_STEP_RUNS, FST_SCAN_TABLE);
    for (int row = 0; row < FST_TABLE1_ROWS && known; ++row) {
        json_t *object = json_object();
        json_object_set_new(object, "omega", json_real(fst_table1[row].omega));
        json_object_set_new(object, "published", json_real(fst_table1[row].published));
        json_object_set_new(object, "count", json_integer(fst_table1[row].count));
        json_object_set_new(object, "published_symmetry", symmetry(fst_table1[row].published_a));
        for (int d = FST_PAPER_DYNAMICS - 1; d >= 0; --d) {
            const fst_run_result *result = &paper->scans[FST_SCAN_TABLE][d][row].result;
            const char *name = fst_symmetry_name(result->symmetry),
                       *dynamics = fst_dynamics_name((fst_dynamics)d);
            char key[48], command[320];
            fst_paper_table1_command(paper, row, (fst_dynamics)d, command, sizeof command);
            (void)snprintf(key, sizeof key, "%s_command", dynamics);
            json_object_set_new(object, key, json_string(command));
            json_object_set_new(object, dynamics, fst_json_number(result->festoons));
            (void)snprintf(key, sizeof key, "%s_symmetry", dynamics);
            json_object_set_new(object, key, name ? json_string(name) : json_null());
            (void)snprintf(key, sizeof key, "%s_deviation", dynamics);
            json_object_set_new(object, key,
                                fst_json_number(fst_table1_deviation(paper, row, (fst_dynamics)d)));
            (void)snprintf(key, sizeof key, "%s_closes_at", dynamics);
            json_object_set_new(object, key, fst_json_number(paper->exact[d].closed[row].omega));
            (void)snprintf(key, sizeof key, "%s_closes_with", dynamics);
            json_object_set_new(object, key, closed_symmetry(&paper->exact[d].closed[row]));
            (void)snprintf(key, sizeof key, "%s_verdict", dynamics);
            json_object_set_new(object, key,
                                json_string(fst_verdict_name(fst_table1_verdict(paper, row, (fst_dynamics)d))));
        }
        json_array_append_new(rows, object);
    }
    return rows;
}

static json_t *figure_verdict(const fst_paper_state *paper, const fst_paper_figure *figure,
                              fst_dynamics dynamics)
{
    fst_verdict verdict;
    return fst_paper_figure_verdict(paper, figure, dynamics, &verdict) ? json_string(fst_verdict_name(verdict))
                                                                       : json_null();
}

static json_t *figures_array(const fst_paper_state *paper)
{
    json_t *array = json_array();
    for (int i = 0; i < fst_paper_figure_count(); ++i) {
        fst_paper_figure figure = fst_paper_figure_at(i);
        if (!paper->drawn[i])
            continue;
        char file[64];
        (void)snprintf(file, sizeof file, "%s.svg", figure.file);
        json_t *object = json_object();
        json_object_set_new(object, "name", json_string(figure.file));
        json_object_set_new(object, "file", json_string(file));
        json_object_set_new(object, "source", json_string(figure.source));
        json_object_set_new(object, "title", json_string(figure.title));
        char command[512];
        fst_paper_figure_command(paper, &figure, command, sizeof command);
        json_object_set_new(object, "command", json_string(command));
        json_object_set_new(object, "dynamics",
                            figure.each ? json_string(fst_dynamics_name(figure.dynamics)) : json_null());
        json_object_set_new(object, "verdict", figure_verdict(paper, &figure, figure.dynamics));
        if (!figure.each)
            json_object_set_new(object, "rigid_verdict", figure_verdict(paper, &figure, FST_DYNAMICS_RIGID));
        json_array_append_new(array, object);
    }
    return array;
}

static json_t *statement_value(const fst_statement *statement, double value)
{
    return statement->rule == FST_RULE_SYMMETRY ? symmetry(value) : fst_json_number(value);
}

/* The printed equations are what was published.  So their verdict, command and so on have the plain names, and
 * those of the exact equations begin with "rigid_". */
static void add_dynamics(json_t *object, const fst_statement *statement, const fst_paper_state *paper,
                         const fst_finding *finding, fst_dynamics dynamics)
{
    const char *name = fst_dynamics_name(dynamics), *prefix = dynamics == FST_DYNAMICS_RIGID ? "rigid_" : "";
    char key[48], command[320];
    json_object_set_new(object, name, statement_value(statement, finding->value[dynamics]));
    (void)snprintf(key, sizeof key, "%s_verdict", name);
    json_object_set_new(object, key, json_string(fst_verdict_name(finding->verdict[dynamics])));
    (void)snprintf(key, sizeof key, "%s_note", name);
    json_object_set_new(object, key, json_string(finding->note[dynamics]));
    (void)snprintf(key, sizeof key, "%s_undecided", name);
    json_object_set_new(object, key, json_boolean(finding->undecided[dynamics]));
    fst_statement_command(statement, paper, dynamics, command, sizeof command);
    (void)snprintf(key, sizeof key, "%scommand", prefix);
    json_object_set_new(object, key, json_string(command));
    (void)snprintf(key, sizeof key, "%sreads", prefix);
    json_object_set_new(object, key, json_string(fst_statement_reads(statement, dynamics)));
}

static void add_dry(json_t *object, const fst_statement *statement, const fst_paper_state *paper,
                    const fst_finding *finding)
{
    if (!finding->dry)
        return;
    char command[384];
    json_object_set_new(object, "coulomb", statement_value(statement, finding->dry_value));
    json_object_set_new(object, "coulomb_mu", json_real(FST_DRY_MU));
    json_object_set_new(object, "coulomb_verdict", json_string(fst_verdict_name(finding->dry_verdict)));
    json_object_set_new(object, "coulomb_note", json_string(finding->dry_note));
    json_object_set_new(object, "coulomb_undecided", json_boolean(finding->dry_undecided));
    fst_statement_dry_command(statement, paper, command, sizeof command);
    json_object_set_new(object, "coulomb_command", json_string(command));
    json_object_set_new(object, "coulomb_reads", json_string(fst_statement_dry_reads(statement)));
}

/* The distance from the border that is nearest, as a share of what it allows; where the verdict hangs by a
 * hair, and at which value it turns. */
static void add_margin(json_t *object, const fst_statement *statement, const char *name, double value)
{
    char key[48];
    double border;
    (void)snprintf(key, sizeof key, "%s_margin", name);
    json_object_set_new(object, key, fst_json_number(fst_statement_margin(statement, value, &border)));
    (void)snprintf(key, sizeof key, "%s_border", name);
    json_object_set_new(object, key, fst_json_number(border));
}

/* Another way to read the same sentence; the verdict of the statement is the first's. */
static json_t *second_object(const fst_statement *statement, const fst_paper_state *paper)
{
    const fst_reading *reading = fst_statement_reading(statement);
    if (!reading)
        return json_null();
    const fst_statement *second = &reading->second;
    const fst_finding finding = fst_reading_check(reading, statement, paper);
    char criterion[320];
    fst_statement_criterion(second, criterion, sizeof criterion);
    json_t *object = json_object();
    json_object_set_new(object, "first", json_string(reading->first));
    json_object_set_new(object, "reading", json_string(reading->words));
    json_object_set_new(object, "chosen", json_string(reading->chosen));
    json_object_set_new(object, "published", statement_value(second, second->published));
    json_object_set_new(object, "unit", json_string(second->unit));
    json_object_set_new(object, "scale", json_real(second->scale));
    json_object_set_new(object, "criterion", json_string(criterion));
    for (int d = FST_PAPER_DYNAMICS - 1; d >= 0; --d) {
        const char *name = fst_dynamics_name((fst_dynamics)d);
        char key[48];
        json_object_set_new(object, name, statement_value(second, finding.value[d]));
        (void)snprintf(key, sizeof key, "%sverdict", d == FST_DYNAMICS_RIGID ? "rigid_" : "");
        json_object_set_new(object, key, json_string(fst_verdict_name(finding.verdict[d])));
        (void)snprintf(key, sizeof key, "%s_note", name);
        json_object_set_new(object, key, json_string(finding.note[d]));
    }
    if (finding.dry) {
        json_object_set_new(object, "coulomb", statement_value(second, finding.dry_value));
        json_object_set_new(object, "coulomb_verdict", json_string(fst_verdict_name(finding.dry_verdict)));
    }
    return object;
}

static json_t *statement_object(const fst_statement *statement, const fst_paper_state *paper)
{
    fst_finding finding = fst_statement_check(statement, paper);
    char criterion[320];
    fst_statement_criterion(statement, criterion, sizeof criterion);
    json_t *object = json_object();
    json_object_set_new(object, "id", json_string(statement->id));
    json_object_set_new(object, "section", json_string(statement->section));
    json_object_set_new(object, "statement", json_string(statement->text));
    json_object_set_new(object, "published", statement_value(statement, statement->published));
    char printed[64];
    fst_statement_published(statement, printed, sizeof printed);
    json_object_set_new(object, "published_words",
                        statement->said ? json_string(statement->said) : json_null());
    json_object_set_new(object, "printed", json_string(printed));
    json_object_set_new(object, "group", json_string(fst_groups_of_statements[statement->group].name));
    json_object_set_new(object, "same_for_both", json_boolean(statement->still));
    json_object_set_new(object, "claim", json_boolean(!statement->check));
    json_object_set_new(object, "unit", json_string(statement->unit));
    json_object_set_new(object, "scale", json_real(statement->scale));
    json_object_set_new(object, "criterion", json_string(criterion));
    json_object_set_new(object, "verdict",
                        json_string(fst_verdict_name(finding.verdict[FST_DYNAMICS_FARAGO2020])));
    add_dynamics(object, statement, paper, &finding, FST_DYNAMICS_FARAGO2020);
    add_dynamics(object, statement, paper, &finding, FST_DYNAMICS_RIGID);
    add_dry(object, statement, paper, &finding);
    for (int d = FST_PAPER_DYNAMICS - 1; d >= 0; --d)
        add_margin(object, statement, fst_dynamics_name((fst_dynamics)d), finding.value[d]);
    if (finding.dry)
        add_margin(object, statement, "coulomb", finding.dry_value);
    json_object_set_new(object, "second_reading", second_object(statement, paper));
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

enum { JSON_STYLE = JSON_INDENT(1) | JSON_REAL_PRECISION(17) };

char *fst_paper_statement_json(const fst_paper_state *paper, const fst_statement *statement)
{
    char *text = NULL;
    size_t size = 0;
    json_t *object = statement_object(statement, paper);
    FILE *out = open_memstream(&text, &size);
    int failed = !out || !object || json_dumpf(object, out, JSON_STYLE) != 0 || fputc('\n', out) == EOF;
    failed = (out && fclose(out) != 0) || failed;
    json_decref(object);
    if (failed) {
        free(text);
        text = NULL;
    }
    return text;
}

static json_t *provenance_object(const fst_paper_state *paper)
{
    const fst_params *params = &fst_paper_single(paper, FST_SCAN_FOLD15, FST_DYNAMICS_RIGID)->params;
    char *scene = fst_scene_text(params, 0);
    json_t *object = json_object();
    json_object_set_new(object, "version", json_string(fst_version()));
    json_object_set_new(object, "reduced", json_boolean(paper->options->reduced));
    json_object_set_new(object, "rtol", json_real(params->run_rtol));
    json_object_set_new(object, "periods", json_real(params->run_periods));
    json_object_set_new(object, "discard", json_real(params->run_discard));
    json_object_set_new(object, "seconds", json_real(paper->seconds));
    json_object_set_new(object, "processor_seconds", json_real(paper->processor_seconds));
    json_t *parts = json_object();
    for (int i = 0; i < paper->part_count; ++i)
        json_object_set_new(parts, paper->parts[i].what, json_real(paper->parts[i].seconds));
    json_object_set_new(object, "parts", parts);
    char machine[512];
    fst_paper_machine(machine, sizeof machine);
    json_object_set_new(object, "machine", json_string(machine));
    json_object_set_new(object, "scene", scene ? json_string(scene) : json_null());
    free(scene);
    return object;
}

fst_status fst_paper_write_json(const fst_paper_state *paper, fst_error *error)
{
    char *path = fst_paper_path(paper, "paper", "json");
    json_t *document = json_object();
    json_object_set_new(document, "complete", json_boolean(paper->complete));
    json_object_set_new(document, "table1", table1_array(paper));
    json_object_set_new(document, "table1_criterion", json_string(FST_TABLE1_CRITERION));
    json_object_set_new(document, "orbits", orbits_object(paper));
    json_object_set_new(document, "statements", statements_array(paper));
    json_object_set_new(document, "dry", fst_paper_dry_json(paper));
    json_object_set_new(document, "magnets", fst_paper_magnets_json(paper));
    json_object_set_new(document, "figures", figures_array(paper));
    json_t *films = json_array();
    for (int i = 0; i < paper->films; ++i)
        json_array_append_new(films, json_sprintf("%s.mp4", fst_film_names[i]));
    json_object_set_new(document, "films", films);
    json_object_set_new(document, "provenance", provenance_object(paper));
    fst_whole_file file;
    fst_status status = path && document ? fst_whole_file_open(&file, path, error)
                                         : fst_fail(error, FST_NO_MEMORY, "paper.json", "out of memory");
    if (status == FST_OK) {
        int failed = json_dumpf(document, file.stream, JSON_STYLE) != 0;
        failed = fputc('\n', file.stream) == EOF || failed;
        if (failed) {
            fst_whole_file_discard(&file);
            status = fst_fail(error, FST_IO, path, "writing this file failed");
        } else {
            status = fst_whole_file_commit(&file, error);
        }
    }
    json_decref(document);
    free(path);
    return status;
}
