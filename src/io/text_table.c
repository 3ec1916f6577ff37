/* text_table.c - the dialects of tables of text: what separates cells, quotes, comments, decimal commas,
 * missing numbers, names of columns and their units.  (Encodings and line ends: text_lines.c.) */
#include "io/text_table.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/error.h"
#include "base/number.h"
#include "base/text.h"

/* ---------------------------------------------------------------- cells */

static int is_comment(const char *line)
{
    const char first = line[strspn(line, " \t")];
    return first == '#' || first == '%';
}

int fst_text_says_nothing(const char *line)
{
    return !line[strspn(line, " \t")] || is_comment(line);
}

void fst_text_begin(fst_text_table *table, const fst_text *text, fst_error *error)
{
    table->text = text;
    table->error = error;
    table->ragged = table->count = table->columns = table->wanted_count = 0;
    table->line = table->room = 0;
    table->separator = ',';
    table->memory = NULL;
    table->wanted = NULL;
}

void fst_text_end(fst_text_table *table)
{
    free(table->memory);
    table->memory = NULL;
}

static int is_blank(char c)
{
    return c == ' ' || c == '\t';
}

static int separates(char c, char separator)
{
    return separator == ' ' ? is_blank(c) : c == separator;
}

/* Behind the quotes that a cell begins with; NULL: it begins with none, or they do not close it. */
static char *behind_quotes(char *at, char separator)
{
    if (*at != '"')
        return NULL;
    for (++at; *at; ++at) {
        if (*at == '"' && at[1] == '"')
            ++at;
        else if (*at == '"') {
            char *end = at + 1;
            while (is_blank(*end) && !separates(*end, separator))
                ++end;
            return !*end || separates(*end, separator) ? end : NULL;
        }
    }
    return NULL;
}

/* Where the cell that begins at `at` ends.  In a head, units in brackets belong to the name before them. */
static char *end_of_cell(char *at, char separator, int head)
{
    while (is_blank(*at) && !separates(*at, separator))
        ++at;
    char *end = behind_quotes(at, separator);
    if (end)
        return end;
    for (int depth = 0; *at; ++at) {
        depth += head && (*at == '[' || *at == '(');
        depth -= depth > 0 && (*at == ']' || *at == ')');
        if (depth > 0 || !separates(*at, separator))
            continue;
        const char *next = at + strspn(at, " \t");
        if (!(head && separator == ' ' && (*next == '[' || *next == '(')))
            break;
    }
    return at;
}

/* Strip blanks and one pair of quotes. */
static char *stripped(char *from, char *to)
{
    for (int again = 0; again < 2; ++again) {
        while (from < to && is_blank(*from))
            ++from;
        while (to > from && is_blank(to[-1]))
            --to;
        if (again || to - from < 2 || *from != '"' || to[-1] != '"')
            break;
        ++from;
        --to;
    }
    *to = '\0';
    return from;
}

/* The most frequent of tab, semicolon and comma outside of quotes and brackets; ' ' where there is none of
 * them, which means any run of blanks and tabs. */
static char separator_of(const char *line)
{
    static const char candidates[] = "\t;,";
    int best = 0, count[3] = {0}, quoted = 0, depth = 0;
    for (; *line; ++line) {
        quoted ^= *line == '"';
        depth += (*line == '[' || *line == '(') - ((*line == ']' || *line == ')') && depth > 0);
        const char *found = quoted || depth ? NULL : strchr(candidates, *line);
        if (found)
            ++count[found - candidates];
    }
    for (int i = 1; i < 3; ++i)
        best = count[i] > count[best] ? i : best;
    return count[best] ? candidates[best] : ' ';
}

/* Cut a line, without what a comment begins with, at the table's separator. */
static fst_status cut(fst_text_table *table, size_t number, int head)
{
    const char *line = table->text->lines[number - 1];
    line += strspn(line, " \t");
    if (head && is_comment(line))
        line += strspn(line, "#% \t");
    else if (table->separator == '\t')
        line = table->text->lines[number - 1];
    const size_t size = strlen(line) + 1;
    table->count = 0;
    table->line = number;
    if (size > table->room) {
        char *longer = realloc(table->memory, 2 * size);
        if (!longer)
            return fst_fail(table->error, FST_NO_MEMORY, table->text->path, "no memory for a line");
        table->memory = longer;
        table->room = 2 * size;
    }
    memcpy(table->memory, line, size);
    for (char *at = table->memory; at;) {
        char *end = end_of_cell(at, table->separator, head), *next = *end ? end + 1 : NULL;
        if (next && table->separator == ' ') {
            next += strspn(next, " \t");
            next = *next ? next : NULL;
        }
        if (table->count == FST_TEXT_CELLS)
            return fst_text_fail(table->text->path, number, table->error,
                                 "this line has more than %d cells: no table that is read here has",
                                 FST_TEXT_CELLS);
        table->cells[table->count++] = stripped(at, end);
        at = next;
    }
    return FST_OK;
}

fst_status fst_text_split(fst_text_table *table, size_t line, char separator)
{
    table->separator = separator ? separator : separator_of(table->text->lines[line - 1]);
    return cut(table, line, 1);
}

/* ---------------------------------------------------------------- numbers */

enum { LONGEST_NUMBER = 512 };

/* Copy a cell with plain signs: '-' for U+2212, '.' for a decimal comma (a comma within a cell can be nothing
 * else, because the line was cut already), no non-breaking blanks.  Tells whether it is a number. */
static fst_text_kind plain_number(const char *cell, char plain[LONGEST_NUMBER])
{
    static const char nothing[] = "|nan|+nan|-nan|na|n/a|null|none|-|";
    size_t length = 0;
    for (const char *c = cell; *c;) {
        if (length + 2 > LONGEST_NUMBER)
            return FST_TEXT_WORD;
        if ((unsigned char)*c < 0x80) {
            plain[length++] = *c == ',' ? '.' : *c;
            ++c;
        } else if (strncmp(c, "\xe2\x88\x92", 3) == 0) {
            plain[length++] = '-';
            c += 3;
        } else if (strncmp(c, "\xc2\xa0", 2) == 0) {
            c += 2;
        } else if (strncmp(c, "\xe2\x80\xaf", 3) == 0) { /* the narrow form */
            c += 3;
        } else {
            return FST_TEXT_WORD;
        }
    }
    plain[length] = '\0';
    const size_t number = fst_number_length(plain);
    if (number > 0 && number == length)
        return FST_TEXT_NUMBER;
    char small[16] = "|";
    for (size_t i = 0; i < length && length < 8; ++i)
        small[i + 1] = (char)fst_lower(plain[i]);
    if (length < 8)
        small[length + 1] = '|';
    return length == 0 || (length < 8 && strstr(nothing, small)) ? FST_TEXT_NOTHING : FST_TEXT_WORD;
}

fst_text_kind fst_text_number(const char *cell, double *value)
{
    char plain[LONGEST_NUMBER];
    const fst_text_kind kind = plain_number(cell, plain);
    *value = NAN;
    if (kind != FST_TEXT_NUMBER)
        return kind;
    fst_c_locale locale = fst_c_locale_enter();
    const double number = strtod(plain, NULL);
    fst_c_locale_leave(locale);
    if (!isfinite(number))
        return FST_TEXT_WORD;
    *value = number;
    return FST_TEXT_NUMBER;
}

/* ---------------------------------------------------------------- names and units of columns */

/* Take "x [mm]", "x (mm)" or "x/mm" apart; `name` points into the cell. */
static void take_apart(const char *cell, const char **name, size_t *length, char unit[FST_TEXT_UNIT])
{
    cell += strspn(cell, "#% \t");
    size_t open = strcspn(cell, "[(");
    if (!cell[open])
        open = strcspn(cell, "/");
    const char *from = cell + open + (cell[open] != '\0');
    size_t in_unit = cell[open] == '/' ? strlen(from) : strcspn(from, "])");
    from += strspn(from, " \t");
    in_unit = in_unit < strlen(from) ? in_unit : strlen(from);
    while (in_unit > 0 && strchr(" \t])", from[in_unit - 1]))
        --in_unit;
    (void)snprintf(unit, FST_TEXT_UNIT, "%.*s", (int)(in_unit < FST_TEXT_UNIT ? in_unit : FST_TEXT_UNIT - 1),
                   from);
    while (open > 0 && strchr(" \t/", cell[open - 1]))
        --open;
    *name = cell;
    *length = open;
}

/* The unit that ends a name without brackets, "x_mm", and the length of the name before it. */
static size_t unit_at_end(const char *name, size_t length, char unit[FST_TEXT_UNIT])
{
    static const char *const units[] = {"px", "um", "mm", "cm", "m", "s", "ms", "mT", "uT", "Hz"};
    for (size_t i = 0; i < sizeof units / sizeof *units; ++i) {
        const size_t ending = strlen(units[i]);
        size_t same = 0;
        while (same < ending && same + 1 < length &&
               fst_lower(name[length - ending + same]) == fst_lower(units[i][same]))
            ++same;
        if (length > ending + 1 && same == ending && name[length - ending - 1] == '_') {
            (void)snprintf(unit, FST_TEXT_UNIT, "%s", units[i]);
            return length - ending - 1;
        }
    }
    return length;
}

/* Whether a name is `known`; `exact`: to the letter, else but for capitals, blanks and underscores. */
static int same_name(const char *name, size_t length, const char *known, size_t known_length, int exact)
{
    if (exact)
        return length > 0 && length == known_length && memcmp(name, known, length) == 0;
    const char *end = name + length, *known_end = known + known_length;
    for (;; ++name, ++known) {
        while (name < end && (is_blank(*name) || *name == '_'))
            ++name;
        while (known < known_end && (is_blank(*known) || *known == '_'))
            ++known;
        if (known == known_end || *known == '*')
            return known_length > 0 && (name == end || known < known_end);
        if (name == end || fst_lower(*name) != fst_lower(*known))
            return 0;
    }
}

static int is_one_of(const char *name, size_t length, const char *names, int exact)
{
    size_t known;
    for (;; names += known + 1) {
        known = strcspn(names, "|");
        if (same_name(name, length, names, known, exact))
            return 1;
        if (!names[known])
            return 0;
    }
}

int fst_text_is_named(const char *cell, const char *names)
{
    char unit[FST_TEXT_UNIT];
    const char *name;
    size_t length;
    take_apart(cell, &name, &length, unit);
    return is_one_of(name, length, names, 0) ||
           (!unit[0] && is_one_of(name, unit_at_end(name, length, unit), names, 0));
}

/* Which of the wanted columns a cell of the head names, and in which unit; -1: none.  *way: 0 to the letter, 1
 * nearly, 2 if what ends it is a unit ("x/y" may be none): the plainest name of a column counts. */
static int column_named(const char *cell, const fst_text_column *wanted, int count, char unit[FST_TEXT_UNIT],
                        int *way)
{
    const char *name;
    size_t length;
    take_apart(cell, &name, &length, unit);
    const int slash = unit[0] && name[strcspn(name, "[(/")] == '/';
    for (int exact = 1; exact >= 0; --exact)
        for (int i = 0; i < count; ++i)
            if (is_one_of(name, length, wanted[i].names, exact)) {
                *way = slash ? 2 : !exact;
                return i;
            }
    const size_t shorter = unit[0] ? length : unit_at_end(name, length, unit);
    *way = 2;
    for (int i = 0; i < count && shorter < length; ++i)
        if (is_one_of(name, shorter, wanted[i].names, 0))
            return i;
    return -1;
}

/* ---------------------------------------------------------------- heads */

static const char *shown_name(const fst_text_column *column, char name[40])
{
    (void)snprintf(name, 40, "%.*s", (int)strcspn(column->names, "|*"), column->names);
    return name;
}

fst_status fst_text_fail_cell(const fst_text_table *table, const fst_text_column *column, const char *quoted,
                              const char *sentence)
{
    char quote[FST_QUOTE_SIZE], name[40];
    return fst_text_fail(table->text->path, table->line, table->error, "column %d (%s): %s%s%s", column->place,
                         shown_name(column, name), quoted ? fst_quote(quoted, quote) : "", quoted ? " " : "",
                         sentence);
}

static fst_status check_unit(const fst_text_table *table, const fst_text_column *column)
{
    char one[FST_TEXT_UNIT + 4], sentence[256], name[40];
    double value;
    int power;
    if (column->kind == FST_UNIT_NUMBER || !column->place)
        return FST_OK;
    (void)snprintf(one, sizeof one, "1 %s", column->unit);
    if (!column->unit[0])
        (void)snprintf(sentence, sizeof sentence, "has no unit; write %s [%s] (units here: %s)",
                       shown_name(column, name), fst_unit_customary(column->kind, &power),
                       fst_unit_accepted(column->kind));
    else if (fst_parse_value(one, column->kind, &value, NULL) != FST_OK)
        (void)snprintf(sentence, sizeof sentence, "is an unknown unit of this column (units here: %s)",
                       fst_unit_accepted(column->kind));
    else
        return FST_OK;
    return fst_text_fail_cell(table, column, column->unit[0] ? column->unit : NULL, sentence);
}

/* Find the wanted columns among the cells of this line.  Returns whether all that are needed are there. */
static int find_columns(const fst_text_table *table, fst_text_column *wanted, int count)
{
    int all = 1;
    for (int i = 0; i < count; ++i)
        wanted[i].place = 0;
    for (int cell = 0; cell < table->count; ++cell) {
        char unit[FST_TEXT_UNIT];
        int way;
        const int found = column_named(table->cells[cell], wanted, count, unit, &way);
        if (found < 0 || (wanted[found].place && way > wanted[found].way))
            continue;
        wanted[found].twice = wanted[found].place && way == wanted[found].way && !wanted[found].repeats;
        wanted[found].way = way;
        wanted[found].place = cell + 1;
        memcpy(wanted[found].unit, unit, sizeof unit);
    }
    for (int i = 0; i < count; ++i)
        all = all && (wanted[i].place || !wanted[i].needed);
    return all;
}

/* The line of the head, by its number; 0: there is none. */
static fst_status find_head(fst_text_table *table, fst_text_column *wanted, int count, size_t *head)
{
    *head = 0;
    for (size_t i = table->line; i < table->text->count; ++i) {
        const char *line = table->text->lines[i];
        const int comment = is_comment(line);
        if (!comment && fst_text_says_nothing(line))
            continue;
        const fst_status status = fst_text_split(table, i + 1, '\0');
        if (status != FST_OK && !comment)
            return status;
        if (status == FST_OK && (find_columns(table, wanted, count) || (!comment && !*head)))
            *head = i + 1;
        if (!comment)
            break;
    }
    return FST_OK;
}

fst_status fst_text_head(fst_text_table *table, fst_text_column *wanted, int count, const char *example)
{
    size_t head;
    char name[40];
    table->wanted = wanted;
    table->wanted_count = count;
    fst_status status = find_head(table, wanted, count, &head);
    if (status == FST_OK && !head)
        return fst_fail(table->error, FST_BAD_INPUT, table->text->path,
                        "it is empty: the line of column names is missing, as in \"%s\"", example);
    if (status == FST_OK)
        status = fst_text_split(table, head, '\0');
    if (status != FST_OK)
        return status;
    (void)find_columns(table, wanted, count);
    while (table->count > 1 && !table->cells[table->count - 1][0])
        --table->count; /* separators behind the last name */
    table->columns = table->count;
    for (int i = 0; i < count; ++i) {
        if (wanted[i].place && wanted[i].twice)
            return fst_text_fail_cell(table, &wanted[i], NULL, "this column is there twice");
        if (wanted[i].needed && !wanted[i].place)
            return fst_text_fail(table->text->path, head, table->error,
                                 "the column %s is missing in this head: \"%s\" is one, in any order",
                                 shown_name(&wanted[i], name), example);
    }
    for (int i = 0; i < count && status == FST_OK; ++i)
        status = check_unit(table, &wanted[i]);
    return status;
}

/* ---------------------------------------------------------------- rows */

/* A row that is shorter or longer than the head. */
static fst_status wrong_length(const fst_text_table *table)
{
    char name[40] = "";
    for (int i = 0; i < table->wanted_count; ++i)
        if (table->wanted[i].place == table->count + 1)
            (void)shown_name(&table->wanted[i], name);
    if (table->count < table->columns)
        return fst_text_fail(table->text->path, table->line, table->error,
                             "the row has %d cells: it ends before column %d%s%s%s", table->count,
                             table->count + 1, name[0] ? " (" : "", name, name[0] ? ")" : "");
    return fst_text_fail(table->text->path, table->line, table->error,
                         "the row has %d cells: it goes on after column %d, the last of the head", table->count,
                         table->columns);
}

fst_status fst_text_row(fst_text_table *table, int *more)
{
    size_t next = table->line;
    while (next < table->text->count && fst_text_says_nothing(table->text->lines[next]))
        ++next;
    *more = next < table->text->count;
    if (!*more)
        return FST_OK;
    fst_status status = cut(table, next + 1, 0);
    if (status == FST_OK && table->count == 1 && table->columns > 1) {
        /* Programs that write a head of a person's own separate the rows in their own way. */
        table->separator = separator_of(table->text->lines[next]);
        status = cut(table, next + 1, 0);
    }
    while (table->count > table->columns && table->columns && !table->cells[table->count - 1][0])
        --table->count;
    return status == FST_OK && table->count != table->columns && !table->ragged ? wrong_length(table) : status;
}

const char *fst_text_cell(const fst_text_table *table, const fst_text_column *column)
{
    return column->place && column->place <= table->count ? table->cells[column->place - 1] : "";
}

fst_status fst_text_value(const fst_text_table *table, const fst_text_column *column, double *value)
{
    char text[LONGEST_NUMBER + FST_TEXT_UNIT + 2];
    *value = NAN;
    if (!column->place)
        return FST_OK;
    if (column->place > table->count)
        return wrong_length(table);
    const char *cell = table->cells[column->place - 1];
    switch (plain_number(cell, text)) {
    case FST_TEXT_NOTHING:
        return FST_OK;
    case FST_TEXT_WORD:
        return fst_text_fail_cell(table, column, cell, "is not a number");
    case FST_TEXT_NUMBER:
        break;
    }
    const size_t length = strlen(text);
    const int read = column->kind == FST_UNIT_NUMBER
                         ? fst_text_number(cell, value) == FST_TEXT_NUMBER
                         : (snprintf(text + length, sizeof text - length, " %s", column->unit),
                            fst_parse_value(text, column->kind, value, NULL) == FST_OK);
    return read ? FST_OK : fst_text_fail_cell(table, column, cell, "is too large for a number");
}
