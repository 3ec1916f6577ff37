/* plot.c - festoon plot: figures of trajectories, branches and sweeps. */
#include <stdlib.h>
#include <string.h>

#include "cli/command.h"

#include <festoon/bead_files.h>

static const option options[] = {
    {"output", 'o', "FIG", "the figure: FIG.svg, .pdf or .png; script and data are left beside it"},
    {"kind", '\0', FST_WORDS(FST_FIGURES),
     "of a trajectory: path, local-n (the moment in the local frame), radius-field (r and |B| against Phi), "
     "time, "
     "section (where Phi passes 90 degrees) or ramp; of several beads path or groups, in a world path or lag; "
     "of a "
     "sweep curves or map"},
    {"quantity", '\0', "NAME,...",
     "what is drawn: of a trajectory the column that colours the path, or the columns of time, section and "
     "ramp; of a "
     "sweep keys of festoon run (regime: a map of regimes); of a branch mean_r, festoons, multipliers, ..."},
    {"only", '\0', "KEY=VALUE",
     "of a sweep: only the points where this axis has this value; once for each axis"},
    UNITS_OPTION,
    LOOK_OPTIONS,
    {"no-arrows", '\0', NULL, "draw no arrows of the horizontal moment along the path"},
    {"frame", '\0', "lab|magnet", "from where the path is seen: the laboratory, or the turning magnet"},
    {"inset", EXPERT, NULL, "draw the moment's path in the local frame in the middle of the bead's path"},
    {"from", '\0', "P", "first drive period shown"},
    {"to", '\0', "P", "last drive period shown"},
    {"zoom", '\0', "X0,X1,Y0,Y1", "the part of the plate shown, in mm"},
    {"points", '\0', "DATA.csv",
     "of sweeps and branches over the drive: lay measured points with errors over them, and tell chi^2, of all "
     "or of --quantity (mean_r, std_r, bead_frequency); again for more tables"},
    {"runs", EXPERT, "FILE", "lay runs over a branch as dots, from documents of festoon run --json"},
    {NULL, '\0', NULL, NULL},
};

/* Refuse the options that play no part for such a file.  `words` lists those that do, as a|b|c, beside those that every
 * figure takes. */
static fst_status refuse_others(const arguments *given, const char *words, const char *what, fst_error *error)
{
    for (int i = 0; i < given->option_count; ++i) {
        const char *name = given->options[i].row->name;
        char wanted[32], all[160];
        (void)snprintf(wanted, sizeof wanted, "|%s|", name);
        (void)snprintf(all, sizeof all, "|output|quiet|%s|title|size|", words);
        if (strstr(all, wanted))
            continue;
        size_t used = 0;
        for (const char *c = words; *c && used + 5 < sizeof all; ++c)
            used += (size_t)snprintf(all + used, sizeof all - used, *c == '|' ? ", --" : "%c", *c);
        return fail(error, FST_BAD_INPUT, "", "--%s does not belong to %s; what does: --%s, --title, --size",
                    name, what, all);
    }
    return FST_OK;
}

static fst_status read_figure(const arguments *given, fst_figure_options *figure, fst_error *error)
{
    *figure = fst_default_figure_options();
    const char *zoom = option_value(given, "zoom"), *frame = option_value(given, "frame");
    const value_option rows[] = {{"from", FST_UNIT_NUMBER, &figure->from, 0, 0},
                                 {"to", FST_UNIT_NUMBER, &figure->to, 0, 0}};
    figure->arrows = option_value(given, "no-arrows") == NULL;
    figure->inset = option_value(given, "inset") != NULL;
    int place = (int)figure->kind;
    fst_status status =
        read_choice("--kind", option_value(given, "kind"), "kind", FST_WORDS(FST_FIGURES), &place, error);
    figure->kind = (fst_figure_kind)place;
    if (status == FST_OK)
        status = read_look(given, &figure->title, figure->size, error);
    if (status == FST_OK && figure->kind != FST_FIGURE_PATH)
        status = refuse_others(given, "kind|quantity|units|from|to", "this kind of figure", error);
    if (status == FST_OK)
        status = read_units(given, &figure->units, error);
    if (status == FST_OK)
        status = read_choice("--frame", frame, "frame", "lab|magnet", &figure->from_magnet, error);
    if (status == FST_OK)
        status = read_values(given, rows, sizeof rows / sizeof *rows, error);
    if (status == FST_OK && isfinite(figure->from) && isfinite(figure->to) && !(figure->from < figure->to))
        status = fail(error, FST_BAD_INPUT, "--to", "it must be greater than --from");
    if (status == FST_OK && zoom)
        status = read_numbers("--zoom", zoom, figure->zoom, 4, error);
    if (status == FST_OK && zoom && !(figure->zoom[0] < figure->zoom[1] && figure->zoom[2] < figure->zoom[3]))
        status = fail(error, FST_BAD_INPUT, "--zoom", "X0 must be less than X1, and Y0 less than Y1");
    return status;
}

/* --quantity of a trajectory, whose kind of figure is known: columns against something, or one that colours the path. */
static fst_status read_columns(const arguments *given, fst_figure_options *figure, char words[KEYS_SIZE],
                               fst_error *error)
{
    const int against = figure->kind == FST_FIGURE_TIME || figure->kind == FST_FIGURE_SECTION ||
                        figure->kind == FST_FIGURE_RAMP;
    const char *columns[FST_FIGURE_KEYS] = {NULL};
    const fst_status status = read_quantities(given, words, columns, against ? FST_FIGURE_KEYS : 1, error);
    for (int i = 0; i < FST_FIGURE_KEYS && against; ++i)
        figure->keys[i] = columns[i];
    if (!against)
        figure->colour = columns[0];
    return status;
}

static fst_status plot_branch(const arguments *given, const char *path, const char *to, fst_error *error)
{
    fst_branch branch;
    const char *observable = NULL, *runs = option_value(given, "runs");
    char words[KEYS_SIZE];
    double *dots = NULL;
    fst_chart *chart = NULL;
    size_t dot_count = 0;
    fst_shown_units units;
    fst_status status = refuse_others(given, "quantity|runs|units|points", "a branch", error);
    if (status == FST_OK)
        status = read_units(given, &units, error);
    if (status == FST_OK)
        status = read_quantities(given, words, &observable, 1, error);
    if (status == FST_OK)
        status = fst_branch_read(path, &branch, error);
    if (status != FST_OK)
        return status;
    if (!observable)
        observable = fst_branch_observable(&branch);
    if (runs)
        status = fst_run_dots_read(runs, branch.key, observable, &dots, &dot_count, error);
    if (status == FST_OK)
        status = fst_chart_of_branch(&branch, observable, units, dots, dot_count, &chart, error);
    if (status == FST_OK)
        status = read_look(given, &chart->title, chart->size, error);
    if (status == FST_OK)
        status = fst_figure_chart(to, chart, error);
    if (status == FST_OK)
        tell_written(to, "");
    fst_chart_free(chart);
    free(dots);
    fst_branch_free(&branch);
    return status;
}

/* --kind, --quantity, --units and every --only of a sweep. */
static fst_status read_sweep_figure(const arguments *given, fst_sweep_figure *figure, char words[KEYS_SIZE],
                                    fst_error *error)
{
    int place = FST_FIGURE_PATH, at = 0;
    *figure = (fst_sweep_figure){.kind = FST_FIGURE_PATH};
    fst_status status =
        read_choice("--kind", option_value(given, "kind"), "kind", FST_WORDS(FST_FIGURES), &place, error);
    figure->kind = (fst_figure_kind)place;
    if (status == FST_OK)
        status = read_look(given, &figure->title, figure->size, error);
    if (status == FST_OK)
        status = read_units(given, &figure->units, error);
    if (status == FST_OK)
        status = read_quantities(given, words, figure->keys, FST_SWEEP_FIGURE_KEYS, error);
    for (int i = 0; i < given->option_count && status == FST_OK; ++i)
        if (strcmp(given->options[i].row->name, "only") == 0) {
            if (at < FST_AXIS_LIMIT)
                figure->at[at++] = given->options[i].value;
            else
                status = fail(error, FST_BAD_INPUT, "--only", "a sweep has at most %d axes", FST_AXIS_LIMIT);
        }
    return status;
}

/* Draw a sweep: curves over one axis, a map or a family of curves over two. */
static fst_status plot_sweep(const arguments *given, const char *path, const char *to, fst_error *error)
{
    fst_sweep_figure figure;
    char words[KEYS_SIZE];
    fst_status status = refuse_others(given, "kind|quantity|only|units|points", "a sweep", error);
    if (status == FST_OK)
        status = read_sweep_figure(given, &figure, words, error);
    if (status == FST_OK)
        status = fst_figure_sweep(path, &figure, to, error);
    if (status == FST_OK)
        tell_written(to, "");
    return status;
}

/* Say chi^2 of each table before each file; of one alone behind the figure's name. */
static void tell_fits(const arguments *given, const char *const *tables, int table_count,
                      const fst_points_fit *fits, const char *to, FILE *out)
{
    const int count = given->operand_count * table_count;
    char remark[96] = "", names[2][SHOWN_SIZE];
    for (int i = 0; i < count; ++i) {
        const fst_points_fit *fit = &fits[i];
        (void)snprintf(remark, sizeof remark, ": chi^2 = %.6g of %d measured numbers (%d in the table)",
                       fit->chi2, fit->counted, fit->all);
        if (count > 1)
            (void)fprintf(out, "%s over %s%s\n", shown(tables[i % table_count], names[0]),
                          shown(given->operands[i / table_count], names[1]), remark);
        if (fit->left_out[0])
            (void)fprintf(stderr, "%s over %s, left out:\n%s", shown(tables[i % table_count], names[0]),
                          shown(given->operands[i / table_count], names[1]), fit->left_out);
    }
    tell_written(to, count > 1 ? "" : remark);
}

static fst_status plot_points(const arguments *given, const char *to, FILE *out, fst_error *error)
{
    fst_points_fit fits[FST_CHARTS_OVER * FST_CHARTS_OVER];
    fst_sweep_figure figure = {.kind = FST_FIGURE_PATH};
    const char *tables[FST_CHARTS_OVER + 1];
    char words[KEYS_SIZE];
    int is_sweep = 0, table_count = 0;
    fst_status status =
        refuse_others(given, "points|quantity|only|units", "a figure with measured points", error);
    for (int i = 0; i < given->option_count && table_count <= FST_CHARTS_OVER; ++i)
        if (strcmp(given->options[i].row->name, "points") == 0)
            tables[table_count++] = given->options[i].value;
    for (int i = 0; i < given->operand_count && status == FST_OK; ++i) {
        const char *path = given->operands[i];
        if (ends_in(path, ".json") || ends_in(path, ".db"))
            continue;
        status = fst_is_sweep(path, &is_sweep, error);
        if (status == FST_OK && !is_sweep)
            status = fail(error, FST_BAD_INPUT, path,
                          "--points belongs to sweeps and branches; this file is neither");
    }
    if (status == FST_OK)
        status = read_sweep_figure(given, &figure, words, error);
    if (status == FST_OK)
        status = fst_figure_points(given->operands, given->operand_count, tables, table_count, &figure, to,
                                   fits, error);
    if (status == FST_OK)
        tell_fits(given, tables, table_count, fits, to, out);
    return status;
}

/* Draw a trajectory of several beads. */
static fst_status plot_beads(const arguments *given, const fst_figure_options *figure, const char *path,
                             const char *to, fst_error *error)
{
    fst_beads_table table;
    fst_status status = refuse_others(given, "kind|units|frame|from|to|zoom",
                                      "a trajectory of several beads or in a world", error);
    if (status == FST_OK)
        status = fst_beads_trajectory_read(path, &table, error);
    if (status != FST_OK)
        return status;
    status = fst_figure_beads(&table, to, figure, error);
    if (status == FST_OK)
        tell_written(to, table.complete ? "" : " (of an interrupted run)");
    fst_beads_table_free(&table);
    return status;
}

/* Lay several files over each other. */
static fst_status plot_several(const arguments *given, const char *to, fst_error *error)
{
    fst_sweep_figure sweeps;
    fst_figure_options trajectories = fst_default_figure_options();
    char words[KEYS_SIZE];
    fst_status status =
        refuse_others(given, "kind|quantity|only|units|frame|from|to|zoom", "several files", error);
    if (status == FST_OK)
        status = read_sweep_figure(given, &sweeps, words, error);
    if (status == FST_OK && sweeps.kind != FST_FIGURE_CURVES && sweeps.kind != FST_FIGURE_MAP)
        status = read_figure(given, &trajectories, error);
    trajectories.kind = sweeps.kind;
    trajectories.units = sweeps.units;
    for (int i = 0; i < FST_FIGURE_KEYS; ++i)
        trajectories.keys[i] = sweeps.keys[i];
    if (status == FST_OK)
        status =
            fst_figure_over(given->operands, given->operand_count, &trajectories, &sweeps, NULL, to, error);
    if (status == FST_OK)
        tell_written(to, "");
    return status;
}

static fst_status perform(const arguments *given, FILE *out, fst_error *error)
{
    fst_figure_options figure;
    fst_table table;
    const char *path = operand(given), *to = option_value(given, "output");
    if (!path)
        return fail(error, FST_BAD_INPUT, "", "a trajectory is missing: make one with festoon run -o FILE.h5");
    if (!to)
        return fail(error, FST_BAD_INPUT, "", "say where the figure goes: -o FIG.svg");
    if (option_value(given, "points"))
        return plot_points(given, to, out, error);
    if (given->operand_count > 1)
        return plot_several(given, to, error);
    if (ends_in(path, ".json")) /* a branch */
        return plot_branch(given, path, to, error);
    char words[KEYS_SIZE];
    int is_sweep = ends_in(path, ".db"), has_beads = 0;
    fst_status status = is_sweep ? FST_OK : fst_is_sweep(path, &is_sweep, error);
    if (status == FST_OK && is_sweep)
        return plot_sweep(given, path, to, error);
    if (status == FST_OK)
        status = refuse_others(given, "kind|quantity|units|no-arrows|inset|frame|from|to|zoom", "a trajectory",
                               error);
    if (status == FST_OK)
        status = read_figure(given, &figure, error);
    if (status == FST_OK)
        status = fst_trajectory_has_beads(path, &has_beads, error);
    if (status == FST_OK && has_beads)
        return plot_beads(given, &figure, path, to, error);
    if (status == FST_OK)
        status = fst_trajectory_read(path, &table, error);
    if (status != FST_OK)
        return status;
    if (!option_value(given, "kind") && !given->draws_path && !figure.inset && isnan(figure.zoom[0]) &&
        !option_value(given, "frame"))
        figure.kind = fst_figure_kind_of(&table);
    status = read_columns(given, &figure, words, error);
    if (status == FST_OK)
        status = fst_figure_trajectory(&table, to, &figure, error);
    if (status == FST_OK)
        tell_written(to, table.complete ? "" : " (of an interrupted run)");
    fst_table_free(&table);
    return status;
}

const command plot_command = {
    .name = "plot",
    .synopsis = "FILE.(h5|csv|json|db)... -o FIG.(svg|pdf|png) [options]",
    .summary =
        "Draw a trajectory of run, a branch of branch -o, or the rows of a sweep; or several over each other",
    .details = "  festoon plot run.h5 -o f.svg                           the path\n"
               "  festoon plot run.h5 -o f.svg --kind time --quantity r  radius\n"
               "  festoon plot map.db -o f.svg --quantity mean_r         a sweep\n",
    .options = options,
    .most_operands = FST_CHARTS_OVER,
    .has_helpers = 1,
    .perform = perform,
};
