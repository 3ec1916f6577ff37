/* units.h - the units that values may carry. */
#ifndef FST_BASE_UNITS_H
#define FST_BASE_UNITS_H

#include <festoon/festoon.h>

/* Write `value`, which is in SI, in the unit that people use for this kind ("2.5 mm", "10.7 Hz", "3 deg"; a
 * bare number for a pure one).  Reading it back gives the same bits: where the customary unit would not, the SI
 * unit is taken.  Returns the length, as snprintf does. */
int fst_value_write(char *text, size_t size, double value, fst_unit unit);

#endif
