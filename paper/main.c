/* main.c - the program festoon-paper, which `festoon paper` starts: the options of that command, done. */
#include "paper/paper.h"

#include "cli/program.h"
#include "cli/terminal.h"

#include <math.h>
#include <stdlib.h>

static fst_status list_statements(FILE *out, fst_error *error)
{
    char *text = fst_paper_statements_text();
    if (!text)
        return fail(error, FST_NO_MEMORY, "", "no memory for the list");
    (void)fputs(text, out);
    free(text);
    return FST_OK;
}

static fst_status map_dry_friction(const arguments *given, fst_error *error)
{
    static const char *const others[] = {"reduced", "films", "only", "starts"};
    const char *directory = option_value(given, "output");
    for (size_t i = 0; i < sizeof others / sizeof others[0]; ++i)
        if (option_value(given, others[i]))
            return fail(error, FST_BAD_INPUT, "--dry-maps", "it makes the maps alone: leave --%s away",
                        others[i]);
    if (!directory)
        return fail(error, FST_BAD_INPUT, "", "say where the maps go: -o DIR");
    progress_line line;
    const fst_progress progress = {&line, progress_tell};
    progress_begin(&line);
    const fst_status status = fst_paper_dry_maps(directory, &progress, error);
    progress_end(&line);
    char text[SHOWN_SIZE];
    if (status == FST_OK)
        tell_written(directory, "/dry-maps.csv");
    else if (status == FST_INTERRUPTED)
        (void)fprintf(stderr, "%s keeps what was done; the same command goes on\n", shown(directory, text));
    return status;
}

static fst_status perform(const arguments *given, FILE *out, fst_error *error)
{
    if (option_value(given, "statements"))
        return list_statements(out, error);
    if (option_value(given, "dry-maps"))
        return map_dry_friction(given, error);
    const char *directory = option_value(given, "output"), *only = option_value(given, "only");
    if (only && (directory || option_value(given, "films")))
        return fail(error, FST_BAD_INPUT, "--only", "it writes no files: leave -o and --films away");
    if (!directory && !only)
        return fail(error, FST_BAD_INPUT, "", "say where the results go: -o DIR");
    progress_line line;
    const fst_progress progress = {&line, progress_tell};
    fst_paper_options paper = {0};
    paper.reduced = option_value(given, "reduced") != NULL;
    paper.films = option_value(given, "films") != NULL;
    const char *starts = option_value(given, "starts");
    double count = 0.0;
    if (starts) {
        fst_status read = read_numbers("--starts", starts, &count, 1, error);
        if (read == FST_OK && !(count >= 1.0 && count <= 1e6 && count == floor(count)))
            read = fail(error, FST_BAD_INPUT, "--starts", "a whole number from 1 to 1000000");
        if (read != FST_OK)
            return read;
    }
    paper.starts = (int)count;
    progress_begin(&line);
    paper.only = only;
    paper.progress = &progress;
    char *summary = NULL;
    paper.summary = &summary;
    fst_status status = fst_paper(directory, &paper, error);
    progress_end(&line);
    if (status == FST_OK && summary)
        (void)fputs(summary, out);
    free(summary);
    if (status == FST_OK && directory)
        tell_written(directory, "/report.html");
    char text[SHOWN_SIZE];
    if (status == FST_INTERRUPTED && directory)
        (void)fprintf(stderr, "%s/report.html has what was done until then, marked incomplete\n",
                      shown(directory, text));
    return status;
}

static fst_status perform_words(int count, char **words, FILE *out, fst_error *error)
{
    command here = paper_command;
    here.program = NULL;
    here.perform = perform;
    return perform_command(&here, count, words, out, error);
}

int main(int argc, char **argv)
{
    return run_program(argc, argv, 0, perform_words);
}
