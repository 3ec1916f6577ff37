/* columns.h - a sample as a row of numbers. */
#ifndef FST_IO_COLUMNS_H
#define FST_IO_COLUMNS_H

#include <festoon/festoon_tools.h>

enum {
#define FST_COLUMN(name, unit, value, doc) FST_COLUMN_##name,
#include "io/columns.def"
#undef FST_COLUMN
    FST_COLUMN_COUNT
};

/* The values of a sample, in the order of the columns. */
void fst_column_values(const fst_sample *sample, double values[FST_COLUMN_COUNT]);

#endif
