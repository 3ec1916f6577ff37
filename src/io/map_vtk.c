/* map_vtk.c - reading a map of the field from a legacy file of VTK.
 *
 * It is lines of words, with blocks of numbers between them, as text or as binary numbers of the
 * highest byte first:
 *
 *     # vtk DataFile Version 3.0            the first line
 *     a title                               the second
 *     ASCII or BINARY
 *     DATASET STRUCTURED_POINTS             or RECTILINEAR_GRID, with X_COORDINATES n type and so on
 *     DIMENSIONS nx ny nz
 *     ORIGIN x y z
 *     SPACING dx dy dz
 *     POINT_DATA n
 *     VECTORS name type                     or FIELD with an array of three components
 *     numbers
 */
#include <ctype.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/error.h"
#include "base/number.h"
#include "base/text.h"
#include "io/map_points.h"

enum { WORD_SIZE = 64 };

/* ------------------------------------------------------------------ the grid */

/* A grid as the file has it: places along each axis, and vectors, of which x runs fastest. */
typedef struct vtk_grid {
    int count[3];
    double *places[3];
    double *vectors;
    char name[64]; /* of the vectors */
    fst_map_points *points;
} vtk_grid;

static size_t samples_of(const vtk_grid *grid)
{
    return (size_t)grid->count[0] * (size_t)grid->count[1] * (size_t)grid->count[2];
}

static fst_status set_counts(vtk_grid *grid, const double counts[3])
{
    double all = 1.0;
    for (int axis = 0; axis < 3; ++axis) {
        if (!(counts[axis] >= 1 && counts[axis] <= 1e6) || counts[axis] != floor(counts[axis]))
            return fst_map_points_refuse(grid->points, "%g samples along %c make no grid", counts[axis],
                                         "xyz"[axis]);
        grid->count[axis] = (int)counts[axis];
        all *= counts[axis];
    }
    if (all > FST_MAP_SAMPLES_LIMIT)
        return fst_map_points_refuse(grid->points, "a grid of %.0f samples is larger than a map may be, %d",
                                     all, FST_MAP_SAMPLES_LIMIT);
    return FST_OK;
}

static double *room_for(vtk_grid *grid, int axis)
{
    double **room = axis < 3 ? &grid->places[axis] : &grid->vectors;
    free(*room);
    *room = calloc(axis < 3 ? (size_t)grid->count[axis] : 3 * samples_of(grid), sizeof **room);
    if (!*room)
        (void)fst_fail(grid->points->error, FST_NO_MEMORY, grid->points->path, "no memory for this map");
    return *room;
}

static fst_status space_evenly(vtk_grid *grid, int axis, double first, double spacing)
{
    double *places = room_for(grid, axis);
    if (!places)
        return FST_NO_MEMORY;
    for (int i = 0; i < grid->count[axis]; ++i)
        places[i] = first + i * spacing;
    return FST_OK;
}

/* The factors to T and m of "B[mT,mm]". */
static fst_status read_units(const vtk_grid *grid, double *tesla, double *metre)
{
    char unit[2][24] = {"T", "m"}, whole[32];
    const char *open = strchr(grid->name, '[');
    fst_error why;
    if (open) {
        const char *comma = strchr(open, ','), *close = strchr(open, ']');
        const size_t first = strcspn(open + 1, ",]");
        (void)snprintf(unit[0], sizeof unit[0], "%.*s", (int)(first < 20 ? first : 20), open + 1);
        if (comma && close && comma < close)
            (void)snprintf(unit[1], sizeof unit[1], "%.*s",
                           (int)(close - comma - 1 < 20 ? close - comma - 1 : 20), comma + 1);
    }
    (void)snprintf(whole, sizeof whole, "1 %s", unit[0]);
    if (fst_parse_value(whole, FST_UNIT_FIELD, tesla, &why) != FST_OK)
        return fst_map_points_refuse(grid->points, "the vectors \"%s\": %s", grid->name, why.sentence);
    (void)snprintf(whole, sizeof whole, "1 %s", unit[1]);
    if (fst_parse_value(whole, FST_UNIT_LENGTH, metre, &why) != FST_OK)
        return fst_map_points_refuse(grid->points, "the vectors \"%s\": %s", grid->name, why.sentence);
    return FST_OK;
}

static fst_status add_samples(vtk_grid *grid)
{
    double tesla, metre;
    static const double farthest = 10.0; /* m: nobody measures a magnet so far away */
    if (!grid->vectors || !grid->places[0] || !grid->places[1] || !grid->places[2])
        return fst_map_points_refuse(grid->points, "the %s missing",
                                     grid->vectors ? "places of the grid are" : "vectors of the field are");
    fst_status status = read_units(grid, &tesla, &metre);
    for (int axis = 0; axis < 3 && status == FST_OK; ++axis)
        for (int i = 0; i < grid->count[axis]; ++i)
            if (!(fabs(grid->places[axis][i] * metre) <= farthest))
                return fst_map_points_refuse(
                    grid->points,
                    "a place of the map along %c is %g m from the origin: VTK knows no units, so places are "
                    "in metres and fields in tesla unless the name of the vectors says, as in B[mT,mm]",
                    "xyz"[axis], grid -> places[axis][i] * metre);
    const size_t samples = status == FST_OK ? samples_of(grid) : 0;
    for (size_t i = 0; i < samples && status == FST_OK; ++i) {
        double row[MAP_COLUMNS];
        size_t rest = i;
        for (int axis = 0; axis < 3; ++axis) {
            row[axis] = grid->places[axis][rest % (size_t)grid->count[axis]] * metre;
            rest /= (size_t)grid->count[axis];
            row[MAP_BX + axis] = grid->vectors[3 * i + (size_t)axis] * tesla;
        }
        for (int c = 0; c < 3; ++c)
            if (!isfinite(row[MAP_BX + c]))
                return fst_map_points_fail(grid->points, i + 1, "B%c is %g, not finite", "xyz"[c],
                                           row[MAP_BX + c]);
        status = fst_map_points_add(grid->points, row, i + 1);
    }
    return status;
}

static void free_grid(vtk_grid *grid)
{
    for (int axis = 0; axis < 3; ++axis)
        free(grid->places[axis]);
    free(grid->vectors);
}

/* Numbers of 4 or 8 bytes, of the highest byte first. */
static void take_floats(const unsigned char *bytes, size_t count, int size, double *numbers)
{
    for (size_t i = 0; i < count; ++i, bytes += size) {
        uint64_t word = 0;
        for (int k = 0; k < size; ++k)
            word |= (uint64_t)bytes[size - 1 - k] << (8 * k);
        if (size == 8) {
            memcpy(&numbers[i], &word, sizeof word);
        } else {
            const uint32_t half = (uint32_t)word;
            float number;
            memcpy(&number, &half, sizeof half);
            numbers[i] = (double)number;
        }
    }
}

/* ------------------------------------------------------------------ the file */

typedef struct legacy {
    const char *at, *end;
    int binary;
    vtk_grid *grid;
} legacy;

/* The next line's text after the first two; what is cut off of a long one says nothing. */
static void skip_line(legacy *file)
{
    const char *stop = memchr(file->at, '\n', (size_t)(file->end - file->at));
    file->at = stop ? stop + 1 : file->end;
}

/* The next word; 0 at the end of the file. */
static int next_word(legacy *file, char word[WORD_SIZE])
{
    size_t length = 0;
    while (file->at < file->end && isspace((unsigned char)*file->at))
        ++file->at;
    while (file->at < file->end && !isspace((unsigned char)*file->at)) {
        if (length + 1 < WORD_SIZE)
            word[length++] = *file->at;
        ++file->at;
    }
    word[length] = '\0';
    return length > 0;
}

static int is(const char *word, const char *known)
{
    for (; *word && tolower((unsigned char)*word) == tolower((unsigned char)*known); ++word, ++known)
        ;
    return *word == '\0' && *known == '\0';
}

static fst_status next_number(legacy *file, double *number)
{
    char word[WORD_SIZE], quoted[FST_QUOTE_SIZE];
    const int found = next_word(file, word);
    const size_t length = found ? fst_number_length(word) : 0;
    if (length == 0 || word[length])
        return fst_map_points_refuse(file->grid->points, "%s stands where a number is expected",
                                     found ? fst_quote(word, quoted) : "the end of the file");
    *number = fst_number_read(word, length, 0);
    return FST_OK;
}

/* A block of numbers of a type. */
static fst_status read_block(legacy *file, const char *type, size_t count, double *numbers)
{
    char quoted[FST_QUOTE_SIZE];
    const int size = is(type, "float") ? 4 : is(type, "double") ? 8 : 0;
    fst_status status = FST_OK;
    if (!file->binary) {
        for (size_t i = 0; i < count && status == FST_OK; ++i)
            status = next_number(file, &numbers[i]);
        return status;
    }
    if (!size)
        return fst_map_points_refuse(file->grid->points,
                                     "the binary numbers of type %s: float or double is expected",
                                     fst_quote(type, quoted));
    skip_line(file);
    if ((size_t)(file->end - file->at) / (size_t)size < count)
        return fst_map_points_refuse(file->grid->points,
                                     "the file is cut off: %zu numbers of %d bytes are expected at its end",
                                     count, size);
    take_floats((const unsigned char *)file->at, count, size, numbers);
    file->at += count * (size_t)size;
    return FST_OK;
}

static fst_status read_three(legacy *file, double numbers[3])
{
    fst_status status = FST_OK;
    for (int axis = 0; axis < 3 && status == FST_OK; ++axis)
        status = next_number(file, &numbers[axis]);
    return status;
}

/* X_COORDINATES n type, and the places. */
static fst_status read_places(legacy *file, int axis)
{
    char type[WORD_SIZE];
    double count = 0.0;
    fst_status status = next_number(file, &count);
    if (status == FST_OK && (!next_word(file, type) || count != file->grid->count[axis]))
        status = fst_map_points_refuse(file->grid->points, "%g places along %c, where DIMENSIONS says %d",
                                       count, "xyz"[axis], file -> grid -> count[axis]);
    double *places = status == FST_OK ? room_for(file->grid, axis) : NULL;
    if (status == FST_OK && !places)
        return FST_NO_MEMORY;
    return status == FST_OK ? read_block(file, type, (size_t)count, places) : status;
}

/* The vectors `name`; the first ones of the file are the field. */
static fst_status read_vectors(legacy *file, const char *name, const char *type, double samples)
{
    if (samples != (double)samples_of(file->grid))
        return fst_map_points_refuse(file->grid->points, "%g vectors on a grid of %zu samples", samples,
                                     samples_of(file->grid));
    (void)snprintf(file->grid->name, sizeof file->grid->name, "%.60s", name);
    double *vectors = room_for(file->grid, 3);
    return vectors ? read_block(file, type, 3 * samples_of(file->grid), vectors) : FST_NO_MEMORY;
}

/* FIELD name arrays, each: name components tuples type; the first of three components is the field. */
static fst_status read_field(legacy *file)
{
    char name[WORD_SIZE], type[WORD_SIZE];
    double arrays = 0.0, components = 0.0, tuples = 0.0;
    (void)next_word(file, name);
    fst_status status = next_number(file, &arrays);
    for (double i = 0; i < arrays && status == FST_OK && !file->grid->vectors; ++i) {
        (void)next_word(file, name);
        status = next_number(file, &components);
        if (status == FST_OK)
            status = next_number(file, &tuples);
        if (status == FST_OK && !next_word(file, type))
            status = fst_map_points_refuse(file->grid->points, "the file ends within its FIELD");
        if (status == FST_OK && components != 3)
            status = fst_map_points_refuse(
                file->grid->points, "the array \"%s\" of %g components comes first: a map has vectors only",
                name, components);
        if (status == FST_OK)
            status = read_vectors(file, name, type, tuples);
    }
    return status;
}

static fst_status read_keyword(legacy *file, const char *word, double origin[3], double spacing[3],
                               double *samples)
{
    static const char *const coordinates[] = {"X_COORDINATES", "Y_COORDINATES", "Z_COORDINATES"};
    char name[WORD_SIZE], type[WORD_SIZE], quoted[FST_QUOTE_SIZE];
    double counts[3];
    for (int axis = 0; axis < 3; ++axis)
        if (is(word, coordinates[axis]))
            return read_places(file, axis);
    if (is(word, "DIMENSIONS")) {
        const fst_status status = read_three(file, counts);
        return status == FST_OK ? set_counts(file->grid, counts) : status;
    }
    if (is(word, "ORIGIN"))
        return read_three(file, origin);
    if (is(word, "SPACING") || is(word, "ASPECT_RATIO"))
        return read_three(file, spacing);
    if (is(word, "POINT_DATA"))
        return next_number(file, samples);
    if (is(word, "VECTORS")) {
        if (!next_word(file, name) || !next_word(file, type))
            return fst_map_points_refuse(file->grid->points, "the file ends after VECTORS");
        return read_vectors(file, name, type, *samples);
    }
    if (is(word, "FIELD") && *samples > 0)
        return read_field(file);
    return fst_map_points_refuse(
        file->grid->points,
        "unexpected word %s: DIMENSIONS, ORIGIN, SPACING, X_COORDINATES, POINT_DATA, VECTORS "
        "or FIELD is expected",
        fst_quote(word, quoted));
}

static fst_status read_head(legacy *file, int *even)
{
    char word[WORD_SIZE], kind[WORD_SIZE], quoted[FST_QUOTE_SIZE];
    skip_line(file);
    skip_line(file);
    (void)next_word(file, word);
    file->binary = is(word, "BINARY");
    if (!file->binary && !is(word, "ASCII"))
        return fst_map_points_refuse(file->grid->points,
                                     "the third line of a legacy VTK file is ASCII or BINARY, not %s",
                                     fst_quote(word, quoted));
    if (!next_word(file, word) || !is(word, "DATASET") || !next_word(file, kind))
        return fst_map_points_refuse(file->grid->points,
                                     "the fourth line of a legacy VTK file is DATASET and its kind");
    *even = is(kind, "STRUCTURED_POINTS");
    if (!*even && !is(kind, "RECTILINEAR_GRID"))
        return fst_map_points_refuse(file->grid->points,
                                     "a map is a DATASET STRUCTURED_POINTS or RECTILINEAR_GRID, not %s",
                                     fst_quote(kind, quoted));
    return FST_OK;
}

static fst_status read_legacy(const char *text, size_t size, vtk_grid *grid)
{
    legacy file = {text, text + size, 0, grid};
    double origin[3] = {0.0, 0.0, 0.0}, spacing[3] = {1.0, 1.0, 1.0}, samples = 0.0;
    char word[WORD_SIZE];
    int even;
    fst_status status = read_head(&file, &even);
    while (status == FST_OK && !grid->vectors && next_word(&file, word)) {
        if (!is(word, "DIMENSIONS") && grid->count[0] == 0)
            return fst_map_points_refuse(grid->points, "DIMENSIONS must come first");
        status = read_keyword(&file, word, origin, spacing, &samples);
    }
    for (int axis = 0; axis < 3 && even && status == FST_OK && grid->count[0]; ++axis)
        status = space_evenly(grid, axis, origin[axis], spacing[axis]);
    return status;
}

fst_status fst_map_vtk_read(const char *text, size_t size, fst_map_points *points)
{
    static const char mark[] = "# vtk DataFile";
    vtk_grid grid = {.points = points};
    points->called = "sample";
    if (size <= sizeof mark || memcmp(text, mark, sizeof mark - 1) != 0)
        return fst_map_points_refuse(points, "this is not a legacy file of VTK: it does not begin with \"%s\"",
                                     mark);
    fst_status status = read_legacy(text, size, &grid);
    if (status == FST_OK)
        status = add_samples(&grid);
    free_grid(&grid);
    return status;
}
