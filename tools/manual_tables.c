/* manual_tables.c - completes the manual page while festoon is built.
 *
 * Copies the template from standard input to standard output.  The lines @COMMANDS@, @OPTIONS@, @EXPERT OPTIONS@,
 * @PARAMETERS@, @EXPERT PARAMETERS@ and @RESULTS@ give way to the program's tables of commands and options and to those
 * of params.def and run.def, @VERSION@ within a line to the version, so that the page cannot disagree with the program.
 * An option that several commands take stands once, with what it means in each.
 */
#include "cli/command.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* Text as roff wants it: a minus that copies as a minus, backslashes and leading dots taken literally. */
static void put_text(const char *text)
{
    int begins = 1;
    for (; *text; text++) {
        if (begins && (*text == '.' || *text == '\''))
            fputs("\\&", stdout);
        begins = *text == '\n';
        if (*text == '-')
            fputs("\\-", stdout);
        else if (*text == '\\')
            fputs("\\e", stdout);
        else
            putchar(*text);
    }
}

static void put_commands(void)
{
    for (const command *const *row = all_commands; *row; row++) {
        printf(".TP 4\n.B %s \\fI", (*row)->name);
        put_text((*row)->synopsis);
        fputs("\\fR\n", stdout);
        put_text((*row)->summary);
        fputs(".\n", stdout);
        put_text((*row)->details);
    }
}

/* ------------------------------------------------------------------ options */

/* An option of a command. */
typedef struct taken {
    const option *row;
    const char *by;
} taken;

static int by_name(const void *one, const void *other)
{
    const taken *a = one, *b = other;
    const int order = strcmp(a->row->name, b->row->name);
    return order ? order : strcmp(a->by, b->by);
}

static int same_text(const char *one, const char *other)
{
    return one == other || (one && other && strcmp(one, other) == 0);
}

static int same_meaning(const option *one, const option *other)
{
    return same_text(one->value, other->value) && strcmp(one->help, other->help) == 0;
}

static void put_value(const option *row)
{
    if (!row->value)
        return;
    fputs(" \\fI", stdout);
    put_text(row->value);
    fputs("\\fR", stdout);
}

/* The rows of one name: each meaning once, behind the commands in which it has it. */
static void put_option(const taken *rows, size_t count)
{
    int one_value = 1;
    for (size_t i = 1; i < count; i++)
        one_value &= same_text(rows[i].row->value, rows[0].row->value);
    fputs(".HP 4\n", stdout);
    if (rows[0].row->letter > EXPERT)
        printf("\\fB\\-%c\\fR, ", rows[0].row->letter);
    fputs("\\fB\\-\\-", stdout);
    put_text(rows[0].row->name);
    fputs("\\fR", stdout);
    if (one_value)
        put_value(rows[0].row);
    putchar('\n');
    for (size_t i = 0, told = 0; i < count; i++) {
        size_t first = 0;
        while (!same_meaning(rows[first].row, rows[i].row))
            first++;
        if (first < i)
            continue;
        if (told++)
            fputs(".br\n", stdout);
        for (size_t k = i; k < count; k++)
            if (same_meaning(rows[k].row, rows[i].row))
                printf("%s%s", k > i ? ", " : "", rows[k].by);
        if (!one_value)
            put_value(rows[i].row);
        fputs(": ", stdout);
        put_text(rows[i].row->help);
        putchar('\n');
    }
}

/* Every option that only experts need, or every other one, in the order of the alphabet. */
static void put_options(int expert)
{
    enum { MOST = 1000 };
    static taken all[MOST];
    size_t count = 0;
    for (const command *const *by = all_commands; *by; by++)
        for (const option *row = (*by)->options; row->name && count < MOST; row++)
            if ((row->letter == EXPERT) == expert)
                all[count++] = (taken){row, (*by)->name};
    qsort(all, count, sizeof *all, by_name);
    for (size_t i = 0, end; i < count; i = end) {
        for (end = i + 1; end < count && strcmp(all[end].row->name, all[i].row->name) == 0; end++)
            ;
        put_option(&all[i], end - i);
    }
}

/* ------------------------------------------------------------------ parameters and results */

/* "(10.7 Hz)", "(rigid)", "(m)": what a parameter is unless told, and the unit of a bare number. */
static void put_default(const fst_params *defaults, int index)
{
    const fst_param_info *row = fst_param_at(index);
    char initial[64];
    (void)fst_params_get(defaults, index, initial, sizeof initial);
    const char *unit =
        row->kind == FST_KIND_REAL && row->unit != FST_UNIT_NUMBER ? fst_unit_name(row->unit) : "";
    if (!*initial && !*unit)
        return;
    fputs("\\fR (", stdout);
    put_text(initial);
    fputs(*initial && *unit ? " " : "", stdout);
    put_text(unit);
    putchar(')');
}

static void put_parameters(int expert)
{
    const fst_params defaults = fst_default_params();
    for (int i = 0; i < fst_param_count(); i++) {
        const fst_param_info *row = fst_param_at(i);
        if ((fst_name_place(row->key, FST_EXPERT_KEYS) >= 0) != expert)
            continue;
        fputs(".HP 4\n.B ", stdout);
        put_text(row->key);
        put_default(&defaults, i);
        putchar('\n');
        put_text(row->doc);
        putchar('\n');
    }
}

static void put_results(void)
{
    for (int i = 0; i < fst_result_count(); i++) {
        const fst_result_info *row = fst_result_at(i);
        printf(".TP 28\n.B %s\\fR [", row->name);
        put_text(row->unit);
        fputs("]\n", stdout);
        put_text(row->doc);
        putchar('\n');
    }
}

int main(void)
{
    char line[1024];
    while (fgets(line, sizeof line, stdin)) {
        char *version = strstr(line, "@VERSION@");
        if (strcmp(line, "@COMMANDS@\n") == 0) {
            put_commands();
        } else if (strcmp(line, "@OPTIONS@\n") == 0) {
            put_options(0);
        } else if (strcmp(line, "@EXPERT OPTIONS@\n") == 0) {
            put_options(1);
        } else if (strcmp(line, "@PARAMETERS@\n") == 0) {
            put_parameters(0);
        } else if (strcmp(line, "@EXPERT PARAMETERS@\n") == 0) {
            put_parameters(1);
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
