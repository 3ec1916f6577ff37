/* map_vtk_xml.c - reading a map of the field from VTK's XML: ImageData (.vti) and RectilinearGrid (.vtr).
 *
 * Only what such a file needs is read: elements and their attributes, no entities, no document types.  The
 * numbers of a DataArray stand in it as text (format ascii) or in base 64 (binary), or all arrays follow each
 * other behind the underscore of AppendedData (appended, in base 64 or raw); binary arrays begin with their
 * length in bytes. Compressed arrays are refused.
 */
#include <ctype.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/number.h"
#include "base/text.h"
#include "io/map_vtk.h"

enum { VALUE_SIZE = 128 };

typedef struct xml_file {
    const char *text, *end;
    vtk_grid *grid;
    int highest_first; /* byte_order */
    int long_lengths;  /* header_type UInt64 */
} xml_file;

/* An element's tag: from '<' to '>'. */
typedef struct tag {
    const char *from, *to;
} tag;

/* The next tag of this name at or behind `at`; 0: there is none before `end`. */
static int find_tag(const char *at, const char *end, const char *name, tag *found)
{
    const size_t length = strlen(name);
    while (at < end && (at = memchr(at, '<', (size_t)(end - at))) != NULL) {
        const size_t left = (size_t)(end - at);
        if (left > length + 1 && memcmp(at + 1, name, length) == 0 &&
            (isspace((unsigned char)at[length + 1]) || at[length + 1] == '>' || at[length + 1] == '/')) {
            const char *close = memchr(at, '>', left);
            if (!close)
                return 0;
            *found = (tag){at, close};
            return 1;
        }
        ++at;
    }
    return 0;
}

/* An attribute's value; "" where there is none. */
static const char *attribute(const tag *t, const char *name, char value[VALUE_SIZE])
{
    const size_t length = strlen(name);
    value[0] = '\0';
    for (const char *at = t->from; at + length + 2 < t->to; ++at) {
        if (!isspace((unsigned char)at[0]) || memcmp(at + 1, name, length) != 0 || at[length + 1] != '=')
            continue;
        const char quote = at[length + 2], *from = at + length + 3;
        const char *stop = quote == '"' || quote == '\'' ? memchr(from, quote, (size_t)(t->to - from)) : NULL;
        if (stop)
            (void)snprintf(value, VALUE_SIZE, "%.*s",
                           (int)(stop - from < VALUE_SIZE - 1 ? stop - from : VALUE_SIZE - 1), from);
        return value;
    }
    return value;
}

/* The numbers in a text, exactly `count`; returns how many there are, at most one more. */
static size_t read_numbers(const char *at, const char *end, size_t count, double *numbers)
{
    size_t found = 0;
    while (at < end) {
        char word[48];
        size_t length = 0;
        while (at < end && isspace((unsigned char)*at))
            ++at;
        for (; at < end && !isspace((unsigned char)*at); ++at)
            if (length + 1 < sizeof word)
                word[length++] = *at;
        word[length] = '\0';
        if (length == 0)
            break;
        if (found == count)
            return count + 1;
        if (fst_number_length(word) != length)
            return found;
        numbers[found++] = fst_number_read(word, length, 0);
    }
    return found;
}

/* ------------------------------------------------------------------ binary arrays */

static int sextet(char c)
{
    static const char digits[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    const char *found = c ? strchr(digits, c) : NULL;
    return found ? (int)(found - digits) : -1;
}

/* Decode base 64 until `size` bytes are there; returns the number of bytes. */
static size_t decode(const char *at, const char *end, size_t size, unsigned char *bytes)
{
    size_t made = 0;
    unsigned bits = 0;
    int held = 0;
    for (; at < end && made < size; ++at) {
        const int digit = sextet(*at);
        if (digit < 0) {
            if (*at == '=' || isspace((unsigned char)*at))
                continue;
            break;
        }
        bits = bits << 6 | (unsigned)digit;
        held += 6;
        if (held >= 8) {
            held -= 8;
            bytes[made++] = (unsigned char)(bits >> held);
            bits &= (1u << held) - 1u;
        }
    }
    return made;
}

/* The length that stands before an array of bytes. */
static double length_before(const xml_file *file, const unsigned char *bytes)
{
    double length = 0.0;
    const int size = file->long_lengths ? 8 : 4;
    for (int k = 0; k < size; ++k)
        length = 256.0 * length + bytes[file->highest_first ? k : size - 1 - k];
    return length;
}

/* How binary arrays stand in the file: alone between their tags in base 64, or one behind the other. */
typedef enum { INLINE, APPENDED_BASE64, APPENDED_RAW } placement;

static fst_status read_binary(const xml_file *file, const char *from, const char *end, placement how, int size,
                              size_t count, double *numbers)
{
    const size_t head = file->long_lengths ? 8 : 4, wanted = head + count * (size_t)size;
    const unsigned char *bytes = (const unsigned char *)from;
    unsigned char *decoded = NULL;
    size_t there = (size_t)(end - from);
    if (how != APPENDED_RAW) {
        decoded = malloc(wanted + 1);
        if (!decoded)
            return FST_NO_MEMORY;
        there = decode(from, end, wanted + 1, decoded);
        bytes = decoded;
    }
    fst_status status = FST_OK;
    if (there < wanted || (how == INLINE && there > wanted) ||
        length_before(file, bytes) != (double)(count * (size_t)size))
        status = fst_map_points_refuse(
            file->grid->points,
            "a binary array of %zu numbers of %d bytes is expected, but %s: is it compressed, or of "
            "another header_type?",
            count, size, there < wanted ? "the data end before" : "the file has another number of bytes");
    else
        vtk_floats(bytes + head, count, size, file->highest_first, numbers);
    free(decoded);
    return status;
}

/* Where the appended arrays begin, behind the underscore; NULL: nowhere. */
static const char *appended(const xml_file *file, int *raw)
{
    tag t;
    char value[VALUE_SIZE];
    if (!find_tag(file->text, file->end, "AppendedData", &t))
        return NULL;
    *raw = strcmp(attribute(&t, "encoding", value), "raw") == 0;
    const char *mark = memchr(t.to, '_', (size_t)(file->end - t.to));
    return mark ? mark + 1 : NULL;
}

/* The numbers of the array whose tag this is. */
static fst_status read_array(const xml_file *file, const tag *t, size_t count, double *numbers)
{
    char format[VALUE_SIZE], type[VALUE_SIZE], value[VALUE_SIZE], quoted[FST_QUOTE_SIZE];
    const char *stop = memchr(t->to, '<', (size_t)(file->end - t->to));
    (void)attribute(t, "format", format);
    if (!format[0] || strcmp(format, "ascii") == 0) {
        const size_t found = read_numbers(t->to + 1, stop ? stop : file->end, count, numbers);
        return found == count
                   ? FST_OK
                   : fst_map_points_refuse(file->grid->points,
                                           "an array has %s than the %zu numbers of its grid, or no number",
                                           found > count ? "more" : "less", count);
    }
    (void)attribute(t, "type", type);
    const int size = strcmp(type, "Float32") == 0 ? 4 : strcmp(type, "Float64") == 0 ? 8 : 0;
    if (!size)
        return fst_map_points_refuse(file->grid->points, "an array of type %s: Float32 or Float64 is expected",
                                     fst_quote(type, quoted));
    if (strcmp(format, "binary") == 0) {
        const char *from = t->to + 1;
        while (from < file->end && isspace((unsigned char)*from))
            ++from;
        return read_binary(file, from, stop ? stop : file->end, INLINE, size, count, numbers);
    }
    int raw = 0;
    const char *begin = strcmp(format, "appended") == 0 ? appended(file, &raw) : NULL;
    double offset = NAN;
    (void)attribute(t, "offset", value);
    if (!begin || read_numbers(value, value + strlen(value), 1, &offset) != 1 || !(offset >= 0) ||
        !(offset <= (double)(file->end - begin)))
        return fst_map_points_refuse(file->grid->points, "an array of format %s has no place in the file",
                                     fst_quote(format, quoted));
    return read_binary(file, begin + (size_t)offset, file->end, raw ? APPENDED_RAW : APPENDED_BASE64, size,
                       count, numbers);
}

/* ------------------------------------------------------------------ the grid */

/* The counts of "0 60 0 40 0 0". */
static fst_status read_extent(const xml_file *file, const tag *t, const char *name)
{
    char value[VALUE_SIZE];
    double ends[6], counts[3];
    (void)attribute(t, name, value);
    if (read_numbers(value, value + strlen(value), 6, ends) != 6)
        return fst_map_points_refuse(file->grid->points, "the attribute %s must have six numbers", name);
    for (int axis = 0; axis < 3; ++axis)
        counts[axis] = ends[2 * axis + 1] - ends[2 * axis] + 1.0;
    return vtk_set_counts(file->grid, counts);
}

/* Of image data. */
static fst_status read_even_places(const xml_file *file, const tag *t)
{
    char value[VALUE_SIZE];
    double origin[3] = {0.0, 0.0, 0.0}, spacing[3] = {1.0, 1.0, 1.0}, ends[6], turned[9];
    static const double straight[9] = {1, 0, 0, 0, 1, 0, 0, 0, 1};
    (void)attribute(t, "Origin", value);
    if (value[0] && read_numbers(value, value + strlen(value), 3, origin) != 3)
        return fst_map_points_refuse(file->grid->points, "the attribute Origin must have three numbers");
    (void)attribute(t, "Spacing", value);
    if (value[0] && read_numbers(value, value + strlen(value), 3, spacing) != 3)
        return fst_map_points_refuse(file->grid->points, "the attribute Spacing must have three numbers");
    (void)attribute(t, "Direction", value);
    if (value[0] && (read_numbers(value, value + strlen(value), 9, turned) != 9 ||
                     memcmp(turned, straight, sizeof turned) != 0))
        return fst_map_points_refuse(
            file->grid->points,
            "the image is turned (attribute Direction): a map lies along the magnet's axes");
    (void)attribute(t, "WholeExtent", value);
    (void)read_numbers(value, value + strlen(value), 6, ends);
    fst_status status = FST_OK;
    for (int axis = 0; axis < 3 && status == FST_OK; ++axis)
        status =
            vtk_space_evenly(file->grid, axis, origin[axis] + ends[2 * axis] * spacing[axis], spacing[axis]);
    return status;
}

/* Of a rectilinear grid: the three arrays of Coordinates. */
static fst_status read_places(const xml_file *file)
{
    tag t, array;
    if (!find_tag(file->text, file->end, "Coordinates", &t))
        return fst_map_points_refuse(file->grid->points, "the element Coordinates is missing");
    const char *at = t.to;
    for (int axis = 0; axis < 3; ++axis) {
        if (!find_tag(at, file->end, "DataArray", &array))
            return fst_map_points_refuse(file->grid->points, "Coordinates must have three arrays");
        double *places = vtk_room(file->grid, axis);
        const fst_status status =
            places ? read_array(file, &array, (size_t)file->grid->count[axis], places) : FST_NO_MEMORY;
        if (status != FST_OK)
            return status;
        at = array.to;
    }
    return FST_OK;
}

/* The first array of three components of PointData. */
static fst_status read_vectors(const xml_file *file)
{
    tag data, array;
    char value[VALUE_SIZE];
    if (!find_tag(file->text, file->end, "PointData", &data))
        return fst_map_points_refuse(file->grid->points,
                                     "the element PointData is missing: a map has its vectors at points");
    const char *close = file->end, *at = data.to;
    tag end;
    if (find_tag(at, file->end, "/PointData", &end))
        close = end.from;
    while (find_tag(at, close, "DataArray", &array)) {
        at = array.to;
        if (strcmp(attribute(&array, "NumberOfComponents", value), "3") != 0)
            continue;
        (void)snprintf(file->grid->name, sizeof file->grid->name, "%.60s", attribute(&array, "Name", value));
        double *vectors = vtk_room(file->grid, 3);
        return vectors ? read_array(file, &array, 3 * vtk_samples(file->grid), vectors) : FST_NO_MEMORY;
    }
    return fst_map_points_refuse(file->grid->points, "PointData has no array of three components");
}

fst_status vtk_read_xml(const char *text, size_t size, vtk_grid *grid)
{
    xml_file file = {text, text + size, grid, 0, 0};
    tag t, piece, another;
    char value[VALUE_SIZE], quoted[FST_QUOTE_SIZE];
    if (!find_tag(text, file.end, "VTKFile", &t))
        return fst_map_points_refuse(
            grid->points,
            "this is no file of VTK: it begins neither with \"# vtk DataFile\" nor with <VTKFile>");
    file.highest_first = strcmp(attribute(&t, "byte_order", value), "BigEndian") == 0;
    file.long_lengths = strcmp(attribute(&t, "header_type", value), "UInt64") == 0;
    if (attribute(&t, "compressor", value)[0])
        return fst_map_points_refuse(grid->points,
                                     "the arrays are compressed: write the file without compression");
    const int even = strcmp(attribute(&t, "type", value), "ImageData") == 0;
    if (!even && strcmp(value, "RectilinearGrid") != 0)
        return fst_map_points_refuse(grid->points, "a map is ImageData or a RectilinearGrid, not %s",
                                     fst_quote(value, quoted));
    if (!find_tag(t.to, file.end, even ? "ImageData" : "RectilinearGrid", &t) ||
        !find_tag(t.to, file.end, "Piece", &piece))
        return fst_map_points_refuse(grid->points, "the grid's element or its Piece is missing");
    if (find_tag(piece.to, file.end, "Piece", &another))
        return fst_map_points_refuse(grid->points, "the grid is cut into pieces: a map has one");
    fst_status status = read_extent(&file, &t, "WholeExtent");
    if (status == FST_OK)
        status = even ? read_even_places(&file, &t) : read_places(&file);
    return status == FST_OK ? read_vectors(&file) : status;
}
