/* map_csv.c - reading a map of the field from a table of text.
 *
 * A head of column names with units, "x [mm],y [mm],z [mm],Bx [mT],By [mT],Bz [mT]", in any order, between
 * commas, semicolons or tabs; then a row a sample.  z may be missing, other columns are passed over, and lines
 * that begin with # are comments (the head may be one, as numpy writes it).
 */
#include <ctype.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/number.h"
#include "base/text.h"
#include "base/units.h"
#include "io/map_points.h"

/* The longest line and the most columns that are read. */
enum { LINE_SIZE = 4096, COLUMN_LIMIT = 64, UNIT_SIZE = 24 };

typedef struct csv_map {
    fst_map_points *points;
    size_t line;
    char separator;
    int cells;                /* of the head */
    int column[COLUMN_LIMIT]; /* MAP_X, ...; -1: another */
    char unit[MAP_COLUMNS][UNIT_SIZE];
    int given[MAP_COLUMNS];
} csv_map;

static const char *const NAMES[MAP_COLUMNS] = {"x", "y", "z", "Bx", "By", "Bz"};

/* The next cell of a line, trimmed and ended with a zero, or NULL; *at goes on behind it. */
static char *next_cell(char **at, char separator)
{
    char *cell = *at;
    if (!cell)
        return NULL;
    char *end = strchr(cell, separator);
    *at = end ? end + 1 : NULL;
    if (end)
        *end = '\0';
    size_t length;
    const char *trimmed = fst_trim(cell, &length);
    cell += trimmed - cell;
    if (length > 1 && cell[0] == '"' && cell[length - 1] == '"') {
        ++cell;
        length -= 2;
    }
    cell[length] = '\0';
    return cell;
}

/* Which column "Bx [mT]" or "B_x (mT)" is; -1: none that is asked for.  *unit: what stands in brackets, ended
 * with a zero. */
static int column_named(char *cell, char **unit)
{
    char name[16];
    size_t length = 0;
    *unit = cell + strcspn(cell, "[(");
    for (const char *c = cell; c < *unit && length + 1 < sizeof name; ++c)
        if (!isspace((unsigned char)*c) && *c != '_')
            name[length++] = (char)tolower((unsigned char)*c);
    name[length] = '\0';
    if (**unit) {
        ++*unit;
        (*unit)[strcspn(*unit, "])")] = '\0';
    }
    for (int column = 0; column < MAP_COLUMNS; ++column) {
        char known[4];
        for (size_t i = 0; i < sizeof known; ++i)
            known[i] = (char)tolower(
                (unsigned char)NAMES[column][i < strlen(NAMES[column]) ? i : strlen(NAMES[column])]);
        if (strcmp(name, known) == 0)
            return column;
    }
    return -1;
}

static fst_unit kind_of(int column)
{
    return column <= MAP_Z ? FST_UNIT_LENGTH : FST_UNIT_FIELD;
}

/* Note a column of the head. */
static fst_status read_name(csv_map *map, char *cell)
{
    char *unit, whole[UNIT_SIZE + 4];
    const int column = column_named(cell, &unit);
    map->column[map->cells++] = column;
    if (column < 0)
        return FST_OK;
    const char *accepted = fst_unit_accepted(kind_of(column));
    if (map->given[column])
        return fst_map_points_fail(map->points, map->line, "the column %s is there twice", NAMES[column]);
    map->given[column] = 1;
    if (!unit[0])
        return fst_map_points_fail(map->points, map->line,
                                   "the column %s has no unit: name it as in \"%s [%s]\" (units here: %s)",
                                   NAMES[column], NAMES[column], column <= MAP_Z ? "mm" : "mT", accepted);
    double value;
    fst_error why;
    (void)snprintf(map->unit[column], UNIT_SIZE, "%s", unit);
    (void)snprintf(whole, sizeof whole, "1 %s", map->unit[column]);
    if (fst_parse_value(whole, kind_of(column), &value, &why) != FST_OK) {
        char quoted[FST_QUOTE_SIZE];
        return fst_map_points_fail(map->points, map->line,
                                   "the column %s is in the unknown unit %s (units here: %s)", NAMES[column],
                                   fst_quote(unit, quoted), accepted);
    }
    return FST_OK;
}

static fst_status read_head(csv_map *map, char *line)
{
    map->separator = strchr(line, ';') ? ';' : strchr(line, '\t') ? '\t' : ',';
    char *at = line, *cell;
    while ((cell = next_cell(&at, map->separator)) != NULL) {
        if (map->cells == COLUMN_LIMIT)
            return fst_map_points_fail(map->points, map->line, "this head has more than %d columns",
                                       COLUMN_LIMIT);
        const fst_status status = read_name(map, cell);
        if (status != FST_OK)
            return status;
    }
    for (int column = 0; column < MAP_COLUMNS; ++column)
        if (!map->given[column] && column != MAP_Z)
            return fst_map_points_fail(
                map->points, map->line,
                "the column %s is missing: the head of a map is \"x [mm],y [mm],z [mm],Bx "
                "[mT],By [mT],Bz [mT]\", in any order and unit, z where it is known",
                NAMES[column]);
    return FST_OK;
}

static fst_status read_cell(const csv_map *map, int column, const char *cell, double *value)
{
    char text[96];
    fst_error why;
    const size_t digits = fst_number_length(cell);
    if (digits == 0 || cell[digits]) {
        char quoted[FST_QUOTE_SIZE];
        return fst_map_points_fail(map->points, map->line, "column %s: %s is no number%s", NAMES[column],
                                   fst_quote(cell, quoted), strchr(cell, ',') ? ": write a decimal point" : "");
    }
    (void)snprintf(text, sizeof text, "%.64s %s", cell, map->unit[column]);
    if (fst_parse_value(text, kind_of(column), value, &why) != FST_OK)
        return fst_map_points_fail(map->points, map->line, "column %s: %s", NAMES[column], why.sentence);
    return FST_OK;
}

static fst_status read_row(csv_map *map, char *line)
{
    double row[MAP_COLUMNS];
    int cells = 0;
    char *at = line, *cell;
    row[MAP_Z] = NAN;
    for (; (cell = next_cell(&at, map->separator)) != NULL; ++cells) {
        if (cells < map->cells && map->column[cells] >= 0) {
            const fst_status status = read_cell(map, map->column[cells], cell, &row[map->column[cells]]);
            if (status != FST_OK)
                return status;
        }
    }
    if (cells != map->cells)
        return fst_map_points_fail(map->points, map->line, "this row has %d cells, and the head has %d", cells,
                                   map->cells);
    return fst_map_points_add(map->points, row, map->line);
}

/* Whether a comment is the head: it names x and Bx. */
static int names_columns(const char *comment)
{
    char copy[LINE_SIZE];
    int x = 0, bx = 0;
    (void)snprintf(copy, sizeof copy, "%s", comment);
    char *at = copy, *cell, *unit;
    const char separator = strchr(copy, ';') ? ';' : strchr(copy, '\t') ? '\t' : ',';
    while ((cell = next_cell(&at, separator)) != NULL) {
        const int column = column_named(cell, &unit);
        x = x || column == MAP_X;
        bx = bx || column == MAP_BX;
    }
    return x && bx;
}

static fst_status read_line(csv_map *map, char *line)
{
    size_t length;
    const char *trimmed = fst_trim(line, &length);
    const int comment = trimmed[0] == '#';
    if (length == 0)
        return FST_OK;
    if (map->cells > 0)
        return comment ? FST_OK : read_row(map, line);
    if (comment && !names_columns(trimmed + 1))
        return FST_OK;
    return read_head(map, line + (trimmed - line) + comment);
}

fst_status fst_map_csv_read(const char *text, size_t size, fst_map_points *points)
{
    csv_map map = {.points = points};
    const char *end = text + size, *at = text;
    fst_status status = FST_OK;
    if (size >= 3 && memcmp(text, "\xef\xbb\xbf", 3) == 0) /* a mark that some programs begin UTF-8 with */
        at += 3;
    while (at < end && status == FST_OK) {
        char line[LINE_SIZE];
        const char *stop = memchr(at, '\n', (size_t)(end - at));
        const size_t length = (size_t)((stop ? stop : end) - at);
        ++map.line;
        if (length >= sizeof line || memchr(at, '\0', length))
            return fst_map_points_fail(points, map.line,
                                       "this is no line of text: a map is a table of numbers");
        memcpy(line, at, length);
        line[length] = '\0';
        status = read_line(&map, line);
        at = stop ? stop + 1 : end;
    }
    if (status == FST_OK && map.cells == 0)
        return fst_map_points_fail(
            points, map.line ? map.line : 1,
            "the line of column names is missing: \"x [mm],y [mm],z [mm],Bx [mT],By [mT],Bz "
            "[mT]\"");
    return status;
}
