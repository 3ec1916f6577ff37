/* columns.h - a sample as a row of numbers. */
#ifndef FST_IO_COLUMNS_H
#define FST_IO_COLUMNS_H

#include <festoon/festoon_tools.h>

enum {
#define FST_COLUMN(name, unit, value, doc) FST_COLUMN_##name,
#include "io/columns.def"
#undef FST_COLUMN
    FST_COLUMN_COUNT,
    /* Trajectories of before beads could fly end here.  Their beads stay on the plate: the columns from here
     * on, z, vz and flying, are zeros, and readers fill them. */
    FST_COLUMNS_BEFORE_FLIGHTS = FST_COLUMN_z
};

/* The values of a sample, in the order of the columns. */
void fst_column_values(const fst_sample *sample, double values[FST_COLUMN_COUNT]);

#endif
