/* manual_tables.c - completes the manual page while festoon is built.
 *
 * Copies the template from standard input to standard output.  The lines @COMMANDS@, @OPTIONS@, @EXPERT OPTIONS@,
 * @PARAMETERS@, @LISTS@, @EXPERT PARAMETERS@, @RESULTS@, @BEADS@, @WORLDS@ and @PLACES@ give way to the program's tables of
 * commands and options and to those of params.def, run.def and keys.def, @VERSION@ within a line to the version, so that the page cannot disagree with the program.
 * An option that several commands take stands once, with what it means in each.
 */
#include "cli/command.h"

#include <festoon/bead_files.h>

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

/* Behind the tables of params.def stand vectors and the parts, coils and beads of lists, each number by itself. */
enum { VECTOR, PART, COIL, BEAD, ANOTHER /* part, coil or bead than the first */ };

static int kind_of(int index)
{
    const int part = fst_param_part(index), coil = fst_param_coil(index), bead = fst_param_bead(index);
    return part > 0 || coil > 0 || bead > 0 ? ANOTHER
           : part == 0                      ? PART
           : coil == 0                      ? COIL
           : bead == 0                      ? BEAD
                                            : VECTOR;
}

/* How many numbers from this one on are of one vector: start.n[0] to start.n[2]. */
static int components_from(int index)
{
    const char *key = fst_param_at(index)->key;
    const size_t length = strlen(key) - 2;
    int count = 1;
    if (key[length + 1] != ']')
        return 1;
    while (fst_param_at(index + count) && kind_of(index + count) == kind_of(index) &&
           strncmp(fst_param_at(index + count)->key, key, length) == 0)
        count++;
    return count;
}

/* The key of a number or a vector, of an element of a list with N in the place of its number; returns how long it is. */
static void put_key(int index, int count)
{
    const char *key = fst_param_at(index)->key, *number = kind_of(index) == VECTOR ? NULL : strchr(key, '[');
    const int length = (int)strlen(key) - (count > 1 ? 3 : 0);
    if (number)
        printf("%.*s[N]%.*s", (int)(number - key), key, length - (int)(number + 3 - key), number + 3);
    else
        printf("%.*s", length, key);
}

/* Where the docs of two components differ, if it is in one letter alone, x in the first; NULL: they differ otherwise. */
static const char *one_letter(const char *doc, const char *next)
{
    const char *at = doc;
    while (*at && *at == next[at - doc])
        at++;
    return !*at || (*at == 'x' && strcmp(at + 1, next + (at - doc) + 1) == 0) ? at : NULL;
}

/* The docs of the components of a vector; once where they are the same but for the axis. */
static void put_docs(int index, int count)
{
    for (int k = 0, same; k < count; k += same) {
        const char *doc = fst_param_at(index + k)->doc, *axis = NULL;
        for (same = 1; k + same < count && one_letter(doc, fst_param_at(index + k + same)->doc); same++)
            axis = *one_letter(doc, fst_param_at(index + k + same)->doc)
                       ? one_letter(doc, fst_param_at(index + k + same)->doc)
                       : axis;
        fputs(k > 0 ? " " : "", stdout);
        char text[512];
        snprintf(text, sizeof text, "%.*s%s%s", axis ? (int)(axis - doc) : 0, doc, axis ? "x, y, z" : "",
                 axis ? axis + 1 : doc);
        put_text(text);
    }
    putchar('\n');
}

static void put_list(int kind)
{
    for (int i = fst_param_count(), count; fst_param_at(i); i += count) {
        count = components_from(i);
        if (kind_of(i) != kind)
            continue;
        fputs(".HP 4\n.B ", stdout);
        put_key(i, count);
        fputs(count > 1 ? "\\fR (" : "\\fR", stdout);
        printf(count > 1 ? "%d numbers)\n" : "\n", count);
        put_docs(i, count);
    }
}

/* What a bead of a list may say has the docs of what a scene says. */
static void put_list_of_beads(void)
{
    fputs(".HP 4\n.B beads[N]\\fR\n", stdout);
    fputs("A bead of a list, in which the keys above say what it does not: ", stdout);
    for (int i = fst_param_count(), count, told = 0; fst_param_at(i); i += count) {
        count = components_from(i);
        if (kind_of(i) == BEAD) {
            fputs(told++ ? ", " : "", stdout);
            const char *name = strchr(fst_param_at(i)->key, ']') + 2;
            printf("%.*s", (int)strlen(name) - (count > 1 ? 3 : 0), name);
        }
    }
    fputs(".\n", stdout);
}

static void put_result(const char *paragraph, const char *name, const char *unit, const char *doc)
{
    printf("%s\n.B %s\\fR", paragraph, name);
    if (*unit) {
        fputs(" [", stdout);
        put_text(unit);
        putchar(']');
    }
    putchar('\n');
    put_text(doc);
    putchar('\n');
}

static void put_results(void)
{
    for (int i = 0; i < fst_result_count(); i++)
        put_result(".TP 28", fst_result_at(i)->name, fst_result_at(i)->unit, fst_result_at(i)->doc);
}

static const struct {
    char document;
    const char *name, *unit, *doc;
} keys[] = {
#define FST_BEADS_KEY(name, unit, doc) {'b', name, unit, doc},
#define FST_WORLD_KEY(name, unit, doc) {'w', name, unit, doc},
#define FST_PLACE_KEY(name, unit, doc) {'p', name, unit, doc},
#include "io/keys.def"
};

static void put_keys(char document)
{
    for (size_t i = 0; i < sizeof keys / sizeof *keys; i++)
        if (keys[i].document == document)
            put_result(".HP 4", keys[i].name, keys[i].unit, keys[i].doc);
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
        } else if (strcmp(line, "@LISTS@\n") == 0) {
            put_list(VECTOR);
            put_list(PART);
            put_list(COIL);
            put_list_of_beads();
        } else if (strcmp(line, "@BEADS@\n") == 0) {
            put_keys('b');
        } else if (strcmp(line, "@WORLDS@\n") == 0) {
            put_keys('w');
        } else if (strcmp(line, "@PLACES@\n") == 0) {
            put_keys('p');
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
