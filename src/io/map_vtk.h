/* map_vtk.h - what the two formats of VTK, legacy and XML, have in common as maps of a field. */
#ifndef FST_IO_MAP_VTK_H
#define FST_IO_MAP_VTK_H

#include "io/map_points.h"

/* A grid as the file tells it: places along each axis, and vectors of which x runs fastest. */
typedef struct vtk_grid {
    int count[3];
    double *places[3];
    double *vectors;
    char name[64]; /* of the vectors */
    fst_map_points *points;
} vtk_grid;

/* Set the counts; FST_BAD_INPUT where they make no grid that could be a map. */
fst_status vtk_set_counts(vtk_grid *grid, const double counts[3]);

/* The samples of the grid, x fastest. */
size_t vtk_samples(const vtk_grid *grid);

/* Evenly spaced places along an axis. */
fst_status vtk_space_evenly(vtk_grid *grid, int axis, double first, double spacing);

/* Room for the places along an axis or, with axis 3, for the vectors: numbers, all zero, or NULL: no memory. */
double *vtk_room(vtk_grid *grid, int axis);

/* Add the samples in the units that the name of the vectors tells, "B[mT,mm]": T and m where it tells none. */
fst_status vtk_add_samples(vtk_grid *grid);
void vtk_free(vtk_grid *grid);

/* Numbers of 4 or 8 bytes, of the lowest or the highest byte first. */
void vtk_floats(const unsigned char *bytes, size_t count, int size, int highest_first, double *numbers);

/* The XML formats (map_vtk_xml.c). */
fst_status vtk_read_xml(const char *text, size_t size, vtk_grid *grid);

#endif
