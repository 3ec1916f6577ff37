/* main.c - the program: finding the command, reading its options, running it, and turning its status into an
 * exit status. */
#include <stdlib.h>
#include <string.h>

#include "cli/command.h"
#include "cli/completion.h"
#include "cli/fields.h"
#include "cli/help.h"
#include "cli/terminal.h"

/* ---------------------------------------------------------------- doing it */

static int asks_for_help(int count, char **words)
{
    for (int i = 0; i < count; ++i)
        if (strcmp(words[i], "--help") == 0 || strcmp(words[i], "-h") == 0)
            return 1;
    return 0;
}

/* words[0] is the first word after the program's name. */
static fst_status perform(int count, char **words, FILE *out, fst_error *error)
{
    if (count == 0) {
        print_greeting(out);
        return FST_OK;
    }
    if (strcmp(words[0], "--version") == 0) {
        (void)fprintf(out, "festoon %s\n%s\n", fst_version(), fst_tools_components());
        return FST_OK;
    }
    if (strcmp(words[0], "--help") == 0 || strcmp(words[0], "-h") == 0)
        return help(0, words, out, error);
    if (strcmp(words[0], "help") == 0)
        return help(count - 1, words + 1, out, error);
    if (strcmp(words[0], "completion") == 0)
        return print_completion(count - 1, words + 1, out, error);
    const command *wanted = find_command(words[0]);
    if (!wanted)
        return unknown_command(words[0], error);
    if (asks_for_help(count - 1, words + 1)) {
        print_command_help(out, wanted);
        return FST_OK;
    }
    arguments given;
    fst_field_map *map = NULL;
    fst_status status =
        read_arguments(wanted->options, wanted->most_operands, count - 1, words + 1, &given, error);
    if (status != FST_OK)
        return status;
    given.map = &map;
    status = wanted->perform(&given, out, error);
    fst_field_map_free(map);
    /* The signal reached a helper program such as gnuplot first. */
    if (wanted->has_helpers && status != FST_OK && status != FST_INTERRUPTED && interrupted())
        status = fail(error, FST_INTERRUPTED, "", "interrupted");
    return status;
}

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
    const char *where = option_of_field(error->where);
    char sentence[2 * sizeof error->sentence];
    name_commands(error->sentence, sentence, sizeof sentence);
    (void)fprintf(stderr, "festoon: %s%s%s\n", where, where[0] ? ": " : "", sentence);
}

/* Standard output is written only if all went well.  Until then it waits in memory or, where there is much of
 * it, in a file. */
typedef struct waiting_output {
    FILE *stream;
    char *text; /* NULL: it is in a file */
    size_t size;
} waiting_output;

static fst_status begin_output(waiting_output *out, const char *name, fst_error *error)
{
    const command *wanted = name ? find_command(name) : NULL;
    *out = (waiting_output){NULL, NULL, 0};
    if (wanted && wanted->much_output)
        out->stream = spool_open();
    if (!out->stream)
        out->stream = open_memstream(&out->text, &out->size);
    return out->stream ? FST_OK : fail(error, FST_NO_MEMORY, "", "out of memory");
}

static fst_status end_output(waiting_output *out, fst_status status, fst_error *error)
{
    int reason = 0;
    if ((fflush(out->stream) != 0 || ferror(out->stream)) && status == FST_OK)
        status =
            fail(error, FST_IO, "standard output", "there is no room to collect it, in memory or in $TMPDIR");
    if (status == FST_OK)
        reason =
            out->text ? write_standard_output(out->text, out->size) : spool_to_standard_output(out->stream);
    if (reason)
        status = fail(error, FST_IO, "standard output", "writing failed: %s", strerror(reason));
    (void)fclose(out->stream);
    free(out->text);
    return status;
}

int main(int argc, char **argv)
{
    terminal_prepare();
    fst_error error = {FST_OK, "", ""};
    waiting_output out;
    fst_status status = begin_output(&out, argc > 1 ? argv[1] : NULL, &error);
    if (status == FST_OK) {
        status = perform(argc > 0 ? argc - 1 : 0, argv + 1, out.stream, &error);
        status = end_output(&out, status, &error);
    }
    if (status != FST_OK)
        print_error(&error);
    return exit_status(status);
}
