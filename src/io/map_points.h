/* map_points.h - samples of a field as a file lists them, before they are known to form a grid. */
#ifndef FST_IO_MAP_POINTS_H
#define FST_IO_MAP_POINTS_H

#include <festoon/festoon.h>

enum { MAP_X, MAP_Y, MAP_Z, MAP_BX, MAP_BY, MAP_BZ, MAP_COLUMNS };

/* No map is larger than this file; a map of a million samples takes about 60 MB as text. */
#define FST_MAP_FILE_LIMIT ((size_t)512 << 20)

/* The most samples of a map. */
#define FST_MAP_SAMPLES_LIMIT 32000000

typedef struct fst_map_points {
    const char *path;
    const char *called; /* what a row is in the file: "line", "sample" */
    size_t count, room;
    double (*rows)[MAP_COLUMNS]; /* m and T; z is NAN where the file does not tell it */
    size_t *numbers;             /* of each row: its line, or its sample from 1 */
    const fst_progress *progress;
    fst_error *error;
} fst_map_points;

/* Add a row.  FST_NO_MEMORY, or what progress said. */
fst_status fst_map_points_add(fst_map_points *points, const double row[MAP_COLUMNS], size_t number);
void fst_map_points_free(fst_map_points *points);

/* "FILE:LINE: ..." */
fst_status fst_map_points_fail(const fst_map_points *points, size_t number, const char *format, ...)
    __attribute__((format(printf, 3, 4)));

/* "FILE: ..." */
fst_status fst_map_points_refuse(const fst_map_points *points, const char *format, ...)
    __attribute__((format(printf, 2, 3)));

/* Find the rectangular grid that the rows fill, in whatever order, and make a map of it.  FST_BAD_INPUT: a
 * hole, a sample that is there twice, unequal spacing; the sentence says which and where. */
fst_status fst_map_points_arrange(const fst_map_points *points, fst_field_map **map);

/* Let the parameters use a map of a checksum.  FST_BAD_INPUT: they have another magnet.checksum. */
fst_status fst_map_lend(fst_params *params, fst_field_map *map, const char checksum[17], fst_error *error);

/* Readers, a format each: add the samples of a file. */
fst_status fst_map_csv_read(const char *text, size_t size, fst_map_points *points);
fst_status fst_map_vtk_read(const char *text, size_t size, fst_map_points *points);
fst_status fst_map_hdf5_read(fst_map_points *points);

#endif
