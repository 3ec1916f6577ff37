/* merge.c - festoon merge: the shards of a sweep in one database. */
#include <string.h>

#include "cli/command.h"
#include "cli/terminal.h"

static const option options[] = {
    {"output", 'o', "FILE.db", "the new database"},
    JSON_OPTION,
    {NULL, '\0', NULL, NULL},
};

/* Say which points have no row, and what computes them. */
static void tell_of_missing(const char *path, const fst_sweep_merged *merged)
{
    char name[SHOWN_SIZE];
    if (merged->rows < merged->points)
        (void)fprintf(
            stderr,
            "festoon: %s: %lld of %lld points have no row: %s; the sweep command of the shards, with -o "
            "%s and without --shard, computes them\n",
            shown(path, name), (long long)(merged->points - merged->rows), (long long)merged->points,
            merged->missing, name);
}

static void print_merged(FILE *out, const char *path, const fst_sweep_merged *merged, int json)
{
    char name[SHOWN_SIZE];
    const long long points = merged->points, rows = merged->rows;
    if (json)
        (void)fprintf(out, "{\n  \"points\": %lld,\n  \"rows\": %lld,\n  \"missing\": %lld\n}\n", points, rows,
                      points - rows);
    else if (rows == points)
        (void)fprintf(out, points == 1 ? "%s: %lld point\n" : "%s: all %lld points\n", shown(path, name),
                      points);
    else
        (void)fprintf(out, "%s: %lld of %lld points\n", shown(path, name), rows, points);
}

static fst_status perform(const arguments *given, FILE *out, fst_error *error)
{
    const char *to = option_value(given, "output");
    progress_line line;
    const fst_progress progress = {&line, progress_tell};
    fst_sweep_merged merged;
    if (given->operand_count == 0)
        return fail(error, FST_BAD_INPUT, "",
                    "databases are missing: make them with festoon sweep --shard I/N");
    if (!to)
        return fail(error, FST_BAD_INPUT, "", "say where the rows go: -o ALL.db");
    progress_begin(&line);
    const fst_status status =
        fst_sweep_merge(given->operands, given->operand_count, to, &progress, &merged, error);
    progress_end(&line);
    if (status == FST_OK || merged.damaged > 0)
        tell_of_missing(to, &merged);
    if (status == FST_OK)
        print_merged(out, to, &merged, option_value(given, "json") != NULL);
    return status;
}

const command merge_command = {
    .name = "merge",
    .synopsis = "FILE.db... -o ALL.db [--json]",
    .summary = "Join the shards of a sweep, made by sweep --shard I/N, in one database",
    .details = "The files are only read, in any order, and may overlap; the command of the shards without "
               "--shard goes on with\n"
               "the new one.  Points without a row are named.  Files of other sweeps, or rows of a point that "
               "differ, are refused;\n"
               "damaged rows are left out, with status 2.\n",
    .options = options,
    .most_operands = OPERAND_LIMIT,
    .perform = perform,
};
