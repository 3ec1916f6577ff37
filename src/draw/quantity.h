/* quantity.h - how figures name parameters, results and columns, and in which units they show them. */
#ifndef FST_DRAW_QUANTITY_H
#define FST_DRAW_QUANTITY_H

#include <festoon/festoon_tools.h>

/* What an axis shows: the values times `factor`, with the label "mean radius ⟨r⟩ (mm)". */
typedef struct fst_quantity {
    double factor;
    char label[128];
} fst_quantity;

/* A parameter, whose values are SI (angles in degrees, scaled for numbers). */
fst_quantity fst_quantity_of_parameter(const char *key, fst_shown_units units, const fst_scales *scales);

/* A number that describes a run or a point of a branch, in `unit` as the tables name it. */
fst_quantity fst_quantity_of_result(const char *key, const char *unit, fst_shown_units units,
                                    const fst_scales *scales);

/* A column of a trajectory; the load is shown in weights of the bead, in all units. */
fst_quantity fst_quantity_of_column(const fst_column_info *column, fst_shown_units units,
                                    const fst_params *params);

/* The units in which a figure over this parameter is shown where nobody asked for any. */
fst_shown_units fst_units_of_parameter(const char *key);

#endif
