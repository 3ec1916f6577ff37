/* manual_tables.c - completes the manual page while festoon is built.
 *
 * Copies the template from standard input to standard output; the lines @OPTIONS@, @PARAMETERS@ and
 * @RESULTS@ give way to the program's tables of options and to those of params.def and run.def, @VERSION@
 * within a line to the version, so that the page cannot disagree with the program.
 */
#include "cli/command.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* Text as roff wants it: a minus that copies as a minus, backslashes and leading dots taken literally. */
static void put_text(const char *text)
{
    if (*text == '.' || *text == '\'')
        fputs("\\&", stdout);
    for (; *text; text++) {
        if (*text == '-')
            fputs("\\-", stdout);
        else if (*text == '\\')
            fputs("\\e", stdout);
        else
            putchar(*text);
    }
}

/* "number 0.95 (0 to 1000)", "5 mm", "rigid or farago2020": what a parameter may be and what it is unless told.
 */
static void put_range(const fst_params *defaults, int index)
{
    const fst_param_info *row = fst_param_at(index);
    char initial[64];
    (void)fst_params_get(defaults, index, initial, sizeof initial);
    if (row->kind == FST_KIND_CHOICE) {
        put_text(row->names);
    } else if (row->kind == FST_KIND_TEXT) {
        put_text("a text");
    } else {
        if (row->kind == FST_KIND_REAL && row->unit != FST_UNIT_NUMBER) {
            put_text(fst_unit_name(row->unit));
            fputs(", ", stdout);
        }
        char range[64];
        (void)snprintf(range, sizeof range, "%g to %g", row->least, row->greatest);
        put_text(range);
    }
    if (*initial) {
        fputs("; default ", stdout);
        put_text(initial);
    }
}

static void put_parameters(void)
{
    const fst_params defaults = fst_default_params();
    for (int i = 0; i < fst_param_count(); i++) {
        fputs(".TP\n.B ", stdout);
        put_text(fst_param_at(i)->key);
        putchar('\n');
        put_text(fst_param_at(i)->doc);
        fputs("\n(", stdout);
        put_range(&defaults, i);
        fputs(")\n", stdout);
    }
}

static void put_results(void)
{
    for (int i = 0; i < fst_result_count(); i++) {
        const fst_result_info *row = fst_result_at(i);
        printf(".TP\n.B %s\n", row->name);
        put_text(row->doc);
        fputs(" [", stdout);
        put_text(row->unit);
        fputs("]\n", stdout);
    }
}

/* Of each command its usage and its options; "a\nb" in a help is one line. */
static void put_options(void)
{
    for (const command *const *row = all_commands; *row; row++) {
        printf(".SS %s\n.B festoon %s\n", (*row)->name, (*row)->name);
        put_text((*row)->synopsis);
        putchar('\n');
        for (const option *o = (*row)->options; o->name; o++) {
            fputs(".TP\n", stdout);
            if (o->letter)
                printf("\\fB\\-%c\\fR, ", o->letter);
            fputs("\\fB\\-\\-", stdout);
            put_text(o->name);
            fputs("\\fR", stdout);
            if (o->value) {
                fputs(" \\fI", stdout);
                put_text(o->value);
                fputs("\\fR", stdout);
            }
            putchar('\n');
            put_text(o->help);
            putchar('\n');
        }
    }
}

int main(void)
{
    char line[1024];
    while (fgets(line, sizeof line, stdin)) {
        char *version = strstr(line, "@VERSION@");
        if (strcmp(line, "@OPTIONS@\n") == 0) {
            put_options();
        } else if (strcmp(line, "@PARAMETERS@\n") == 0) {
            put_parameters();
        } else if (strcmp(line, "@RESULTS@\n") == 0) {
            put_results();
        } else if (version) {
            *version = '\0';
            printf("%s%s%s", line, fst_version(), version + strlen("@VERSION@"));
        } else {
            fputs(line, stdout);
        }
    }
    return ferror(stdin) || fflush(stdout) != 0 ? EXIT_FAILURE : EXIT_SUCCESS;
}
