/* units.h - the units that values may carry. */
#ifndef FST_BASE_UNITS_H
#define FST_BASE_UNITS_H

#include <festoon/festoon.h>

/* Write `value`, which is in SI, in the unit that people use for this kind ("2.5 mm", "10.7 Hz", "3 deg"; a
 * bare number for a pure one).  Reading it back gives the same bits: where the customary unit would not, the SI
 * unit is taken.  Returns the length, as snprintf does. */
int fst_value_write(char *text, size_t size, double value, fst_unit unit);

/* The unit in which a bare number would come nearest to the value that is usual; NULL where it is so without a unit. */
const char *fst_unit_meant(fst_unit unit, double number, double usual);

/* Why a text is not a value. */
typedef enum {
    FST_VALUE_READ, /* it is one */
    FST_VALUE_MISSING,
    FST_VALUE_NO_NUMBER,
    FST_VALUE_COMMA,      /* the sentence says how to write it */
    FST_VALUE_WRONG_UNIT, /* the sentence names the units that fit */
    FST_VALUE_TOO_LARGE
} fst_value_fault;

/* As fst_parse_value(), but returns only whether there is a value. */
fst_value_fault fst_value_read(const char *text, fst_unit unit, double *value, fst_error *error);

#endif
