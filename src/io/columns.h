/* columns.h - the number of columns of a trajectory, and their places by name. */
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

#endif
