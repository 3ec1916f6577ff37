/* program.c - what festoon and the programs it starts have in common: a command with its options, output that
 * waits until all went well, and the exit status. */
#include <errno.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "cli/program.h"

#include "cli/fields.h"
#include "cli/file_kind.h"
#include "cli/help.h"
#include "cli/terminal.h"

/* ---------------------------------------------------------------- a command */

static int asks_for_help(int count, char **words)
{
    for (int i = 0; i < count; ++i)
        if (strcmp(words[i], "--help") == 0 || strcmp(words[i], "-h") == 0)
            return 1;
    return 0;
}

/* Become the program that does the work, with the same process, streams and signals; words[0] gives its place
 * to the program's path.  It lies beside this one, as in a build tree, or where an installation has programs
 * that others start. */
static fst_status become(const char *name, char **words, fst_error *error)
{
    static const char *const places[] = {"", FESTOON_PROGRAMS};
    char self[4096], path[8192];
    const ssize_t length = readlink("/proc/self/exe", self, sizeof self - 1);
    self[length > 0 ? length : 0] = '\0';
    const char *slash = strrchr(self, '/');
    for (size_t i = 0; slash && i < sizeof places / sizeof places[0]; ++i) {
        (void)snprintf(path, sizeof path, "%.*s%s%s", (int)(slash - self) + 1, self, places[i], name);
        words[0] = path;
        (void)execv(path, words);
        if (errno != ENOENT && errno != ENOTDIR)
            return fail(error, FST_IO, path, "this program cannot be started: %s", strerror(errno));
    }
    return fail(error, FST_UNAVAILABLE, "",
                "the program %s, which does this, lies neither beside festoon nor in %s", name,
                FESTOON_PROGRAMS);
}

fst_status perform_command(const command *wanted, int count, char **words, FILE *out, fst_error *error)
{
    if (asks_for_help(count - 1, words + 1)) {
        print_command_help(out, wanted);
        return FST_OK;
    }
    arguments given;
    fst_field_map *map = NULL;
    fst_bead_params *beads = NULL;
    fst_status status = read_arguments(wanted, count - 1, words + 1, &given, error);
    if (status == FST_OK)
        status = check_outputs(&given, error);
    if (status == FST_OK && wanted->program)
        status = become(wanted->program, words, error);
    if (status != FST_OK)
        return status;
    if (option_value(&given, "quiet"))
        progress_silence();
    given.map = &map;
    given.beads = &beads;
    status = wanted->perform(&given, out, error);
    fst_field_map_free(map);
    free(beads);
    if (status == FST_BAD_INPUT)
        tell_file_kind(wanted, &given, error);
    /* The signal reached a helper program such as gnuplot first. */
    if (wanted->has_helpers && status != FST_OK && status != FST_INTERRUPTED && interrupted())
        status = fail(error, FST_INTERRUPTED, "", "interrupted");
    return status;
}

/* ---------------------------------------------------------------- the program */

static int exit_status(fst_status status)
{
    switch (status) {
    case FST_OK:
        return 0;
    case FST_BAD_INPUT:
        return 2;
    case FST_INTERRUPTED:
        return 130;
    default:
        return 1;
    }
}

/* An error without a sentence was reported by another process of the same job. */
static void print_error(const fst_error *error)
{
    if (!error->sentence[0])
        return;
    char typed[FIELD_SIZE];
    const char *where = option_of_field(error->where, typed);
    char sentence[2 * sizeof error->sentence];
    name_commands(error->sentence, sentence, sizeof sentence);
    (void)fprintf(stderr, "festoon: %s%s%s\n", where, where[0] ? ": " : "", sentence);
}

/* Standard output is written only if all went well, or as much of it as a command keeps.  Until then it waits in memory or, where there is much of
 * it, in a file. */
typedef struct waiting_output {
    FILE *stream;
    fst_printed printed; /* its stream is NULL where it waits in a file */
} waiting_output;

static fst_status begin_output(waiting_output *out, int much_output, fst_error *error)
{
    *out = (waiting_output){.stream = much_output ? spool_open() : NULL};
    if (!out->stream)
        out->stream = fst_print_begin(&out->printed);
    return out->stream ? FST_OK : fail(error, FST_NO_MEMORY, "", "out of memory");
}

static fst_status end_output(waiting_output *out, fst_status status, fst_error *error)
{
    int reason = 0;
    FILE *spool = out->printed.stream ? NULL : out->stream;
    const int spooled = spool && fflush(spool) == 0 && !ferror(spool);
    char *text = fst_print_end(&out->printed);
    if (!text && !spooled && status == FST_OK)
        status =
            fail(error, FST_IO, "standard output", "there is no room to collect it, in memory or in $TMPDIR");
    if (status == FST_OK || (output_is_kept() && text))
        reason = text ? write_standard_output(text, out->printed.size) : spool_to_standard_output(spool);
    if (reason)
        status = fail(error, FST_IO, "standard output", "writing failed: %s", strerror(reason));
    if (spool)
        (void)fclose(spool);
    free(text);
    return status;
}

int run_program(int count, char **words, int much_output,
                fst_status (*perform)(int count, char **words, FILE *out, fst_error *error))
{
    terminal_prepare();
    fst_error error = {FST_OK, "", ""};
    waiting_output out;
    fst_status status = begin_output(&out, much_output, &error);
    if (status == FST_OK) {
        terminal_work_begins();
        status = perform(count, words, out.stream, &error);
        status = end_output(&out, status, &error);
        terminal_work_ends();
    }
    if (status != FST_OK)
        print_error(&error);
    return exit_status(status);
}
