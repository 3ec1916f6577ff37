/* map_vtk.c - reading a map of the field from a file of VTK, in whichever of its formats; here the legacy one.
 *
 * A legacy file is lines of words, with blocks of numbers between them, as text or as binary numbers of the
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
#include "io/map_vtk.h"

#include <ctype.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/error.h"
#include "base/number.h"
#include "base/text.h"

enum { WORD_SIZE = 64 };

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
    vtk_floats((const unsigned char *)file->at, count, size, 1, numbers);
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
    double *places = status == FST_OK ? vtk_room(file->grid, axis) : NULL;
    if (status == FST_OK && !places)
        return FST_NO_MEMORY;
    return status == FST_OK ? read_block(file, type, (size_t)count, places) : status;
}

/* The vectors `name`; the first ones of the file are the field. */
static fst_status read_vectors(legacy *file, const char *name, const char *type, double samples)
{
    if (samples != (double)vtk_samples(file->grid))
        return fst_map_points_refuse(file->grid->points, "%g vectors on a grid of %zu samples", samples,
                                     vtk_samples(file->grid));
    (void)snprintf(file->grid->name, sizeof file->grid->name, "%.60s", name);
    double *vectors = vtk_room(file->grid, 3);
    return vectors ? read_block(file, type, 3 * vtk_samples(file->grid), vectors) : FST_NO_MEMORY;
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
        return status == FST_OK ? vtk_set_counts(file->grid, counts) : status;
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
        status = vtk_space_evenly(grid, axis, origin[axis], spacing[axis]);
    return status;
}

fst_status fst_map_vtk_read(const char *text, size_t size, fst_map_points *points)
{
    static const char legacy_mark[] = "# vtk DataFile";
    vtk_grid grid = {.points = points};
    points->called = "sample";
    const int is_legacy = size > sizeof legacy_mark && memcmp(text, legacy_mark, sizeof legacy_mark - 1) == 0;
    fst_status status = is_legacy ? read_legacy(text, size, &grid) : vtk_read_xml(text, size, &grid);
    if (status == FST_OK)
        status = vtk_add_samples(&grid);
    vtk_free(&grid);
    return status;
}
