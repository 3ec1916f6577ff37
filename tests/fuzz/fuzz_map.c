/* fuzz_map.c - maps of a field as CSV and VTK: a refusal has a sentence, and an accepted map has a field that
 * is a number at its first sample. */
#include <stdlib.h>

#include "io/map_points.h"

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size);

/* VTK's file begins as no table does. */
static fst_status read_map(const char *text, size_t size, fst_map_points *points)
{
    const int vtk = size > 6 && text[0] == '#' && text[2] == 'v';
    return vtk ? fst_map_vtk_read(text, size, points) : fst_map_csv_read(text, size, points);
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    fst_error error = {FST_OK, "", ""};
    fst_map_points points = {.path = "fuzz", .called = "line", .error = &error};
    fst_field_map *map = NULL;
    fst_status status = read_map((const char *)data, size, &points);
    if (status == FST_OK)
        status = fst_map_points_arrange(&points, &map);
    if (status != FST_OK && (error.code == FST_OK || !error.sentence[0]))
        abort();
    if (status == FST_OK && !isfinite(fst_field_map_describe(map).greatest))
        abort();
    fst_field_map_free(map);
    fst_map_points_free(&points);
    return 0;
}
