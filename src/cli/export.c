/* export.c - festoon export: the rows of a sweep as CSV, JSON or HDF5. */
#include "cli/command.h"
#include "cli/terminal.h"

#define FORMAT(NAME, name, doc) {name, '\0', NULL, doc},
static const option options[] = {
    FST_EXPORTS(FORMAT){"quantity", '\0', "KEY,...",
                        "of CSV: only the varied parameters and these keys of festoon run, each with its unit, "
                        "as in mean_r,std_r,regime, or all"},
    UNITS_OPTION,
    {"output", 'o', "FILE", "write to FILE instead of standard output"},
    {NULL, '\0', NULL, NULL},
};

/* A table of few columns, in units that people use. */
static fst_status export_keys(const arguments *given, const char *to, FILE *out, const fst_progress *progress,
                              fst_error *error)
{
    const char *keys[KEY_LIMIT] = {NULL};
    char words[KEYS_SIZE];
    int count = 0;
    fst_shown_units units;
    fst_status status = read_units(given, &units, error);
    if (status == FST_OK)
        status = read_quantities(given, words, keys, KEY_LIMIT, error);
    while (count < KEY_LIMIT && keys[count])
        ++count;
    if (status == FST_OK)
        status = fst_sweep_export_keys(operand(given), keys, count, units, to, out, progress, error);
    return status;
}

/* Say how many points of a sweep that is not complete have a row. */
static fst_status tell_of_missing(const char *path, fst_error *error)
{
    char name[SHOWN_SIZE];
    fst_sweep_table table;
    const fst_status status = fst_sweep_read(path, NULL, 0, &table, error);
    if (status == FST_OK && !table.refine && table.rows < table.wanted)
        (void)fprintf(stderr, "festoon: %s: %lld of %lld points have a row%s%s\n", shown(path, name),
                      (long long)table.rows, (long long)table.wanted,
                      table.at_work ? " so far: a sweep is at work on it"
                                    : "; the command of the sweep computes the others with -o ",
                      table.at_work ? "" : name);
    if (status == FST_OK)
        fst_sweep_table_free(&table);
    return status;
}

static fst_status perform(const arguments *given, FILE *out, fst_error *error)
{
    static const char *const names[] = {FST_EXPORTS(FST_ROW_NAME)};
    int chosen = -1, count = 0;
    for (int i = 0; i < FST_EXPORT_COUNT; ++i)
        if (option_value(given, names[i])) {
            chosen = i;
            ++count;
        }
    if (!operand(given))
        return fail(error, FST_BAD_INPUT, "", "a database is missing: make one with festoon sweep -o FILE.db");
    if (count != 1)
        return fail(error, FST_BAD_INPUT, "", "say which: --csv, --json or --hdf5");
    const char *to = option_value(given, "output");
    const int columns = option_value(given, "quantity") || option_value(given, "units");
    if (columns && !option_value(given, "csv"))
        return fail(error, FST_BAD_INPUT, "", "--quantity and --units belong to --csv");
    progress_line line;
    const fst_progress progress = {&line, progress_tell};
    progress_begin(&line);
    fst_status status =
        columns ? export_keys(given, to, out, &progress, error)
                : fst_sweep_export(operand(given), (fst_export_format)chosen, to, out, &progress, error);
    progress_end(&line);
    if (status == FST_OK && to)
        tell_written(to, "");
    return status == FST_OK ? tell_of_missing(operand(given), error) : status;
}

const command export_command = {
    .name = "export",
    .synopsis = "FILE.db --csv|--json|--hdf5 [-o FILE] [options]",
    .summary = "Print the rows of a sweep in the order of its points",
    .details = "With --quantity or --units the CSV has the varied parameters and the keys (with --units alone "
               "a few usual\n"
               "ones) with their units, as in \"mean_r [mm]\", and the status of each point: done, missing, or "
               "why a run failed.\n"
               "Damaged rows are named, with status 2, and -o FILE has the others; the command of the sweep "
               "computes them again.\n",
    .options = options,
    .most_operands = 1,
    .much_output = 1,
    .perform = perform,
};
