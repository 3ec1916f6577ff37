/* columns.c - the table of the columns of a trajectory, and a sample as a row of numbers. */
#include "io/columns.h"

#include "base/constants.h"

static const fst_column_info infos[FST_COLUMN_COUNT] = {
#define FST_COLUMN(name, unit, value, doc) {#name, unit, doc},
#include "io/columns.def"
#undef FST_COLUMN
};

int fst_column_count(void)
{
    return FST_COLUMN_COUNT;
}

const fst_column_info *fst_column_at(int index)
{
    return index >= 0 && index < FST_COLUMN_COUNT ? &infos[index] : NULL;
}

void fst_column_values(const fst_sample *s, double *values)
{
#define FST_COLUMN(name, unit, value, doc) values[FST_COLUMN_##name] = (value);
#include "io/columns.def"
#undef FST_COLUMN
}
