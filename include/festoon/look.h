/* look.h - how numbers are shown: in which units, under which words, in which colours; festoon_tools.h includes
 * it.
 *
 * Programs that draw their own figures use it to look like festoon's; nothing here touches a file.
 */
#ifndef FESTOON_LOOK_H
#define FESTOON_LOOK_H

#include <festoon/festoon.h>

#ifdef __cplusplus
extern "C" {
#endif

struct fst_column_info; /* a column of a trajectory, festoon_tools.h */

/* ------------------------------------------------------------------ units */

/* The units of numbers that leave: those in which they were given; those of a laboratory (Hz, mm, s, mm/s, mT,
 * mN, mW); scaled ones (l, 1/gamma, B0, per mass); or SI. */
typedef enum { FST_SHOWN(FST_ROW_ENUM) FST_SHOWN_COUNT } fst_shown_units;

/* What the scaled units are: l in m, 1/gamma in s, the bead's mass in kg, B0 in T (NAN: it does not follow from
 * the parameters). */
typedef struct fst_scales {
    double length, time, mass, field;
} fst_scales;
FST_API fst_scales fst_scales_of(const fst_params *params);

/* The factor that turns a value in `unit`, as the tables of columns and results name it ("l gamma"), into the
 * wanted units, and the name of the unit there ("mm/s").  A unit without counterpart stays: the factor is 1. */
FST_API double fst_unit_shown(const char *unit, fst_shown_units units, const fst_scales *scales,
                              const char **name);

/* As fst_unit_shown(), for the number of a run, a branch or a trajectory that has this name: what turns is in Hz in
 * units of a laboratory, and in rad/s in SI. */
FST_API double fst_number_shown(const char *number, const char *unit, fst_shown_units units,
                                const fst_scales *scales, const char **name);

/* The same for a column. */
FST_API double fst_column_shown(const struct fst_column_info *column, fst_shown_units units,
                                const fst_scales *scales, const char **name);

/* ------------------------------------------------------------------ words */

/* What an axis of a figure shows: the values times `factor`, with the label "mean radius ⟨r⟩ (mm)".  An
 * underscore in it lowers the letter behind it. */
typedef struct fst_quantity {
    double factor;
    char label[128];
} fst_quantity;

/* A parameter, whose values are SI (angles in degrees, scaled for numbers). */
FST_API fst_quantity fst_quantity_of_parameter(const char *key, fst_shown_units units,
                                               const fst_scales *scales);

/* A number that describes a run or a point of a branch, in `unit` as the tables name it. */
FST_API fst_quantity fst_quantity_of_result(const char *key, const char *unit, fst_shown_units units,
                                            const fst_scales *scales);

/* A column of a trajectory; the load is shown in weights of the bead, in all units. */
FST_API fst_quantity fst_quantity_of_column(const struct fst_column_info *column, fst_shown_units units,
                                            const fst_params *params);

/* The units in which a figure over these parameters is shown where nobody asked for any: as given where one of
 * them is a scaled unit itself. */
FST_API fst_shown_units fst_units_over(const char *const *keys, int count);

/* ------------------------------------------------------------------ colours and lines */

/* Colours of curves (Okabe and Ito's palette), which colour-blind readers can tell apart. */
typedef enum { FST_COLOURS(FST_ROW_ENUM) FST_COLOUR_COUNT } fst_colour;

/* "#0072b2" */
FST_API const char *fst_colour_code(fst_colour colour);

/* Colours of a quantity: of both signs from blue over grey to vermilion; of one sign by its use.  `line`, from
 * light green to dark violet, is for lines on white; `map`, from nearly white to blue, is for areas with dark
 * lines on them. The definition is a list of places and colours, "0 '#fbfdff', 0.35 '#d3e3f2', ...". */
typedef enum { FST_PALETTE_DIVERGING, FST_PALETTE_LINE, FST_PALETTE_MAP } fst_palette;
FST_API const char *fst_palette_definition(fst_palette palette);

/* A smooth curve through points that are few: `parts` points for each piece between neighbours, and the last
 * point, are put into `to_x` and `to_y`, which need room for parts (count - 1) + 1; returns how many there are.
 * The curve passes every point, and is drawn for axes on which lengths `wide` and `tall` look alike.  All
 * numbers must be finite. */
FST_API size_t fst_smooth(const double *x, const double *y, size_t count, int parts, double wide, double tall,
                          double *to_x, double *to_y);

/* How all figures name and colour a regime and a type of special points: "families cross", "#009e73". */
typedef struct fst_look {
    const char *words, *colour;
} fst_look;
FST_API fst_look fst_regime_look(fst_regime regime);
FST_API fst_look fst_special_look(fst_special_type type);

/* What figures show of the points of a branch: the index-th observable, NULL beyond the end. */
typedef struct fst_observable_info {
    const char *name, *unit;
    size_t offset; /* of the double in fst_branch_point */
} fst_observable_info;
FST_API const fst_observable_info *fst_branch_observable_at(int index);
FST_API const char *
fst_branch_observable(const fst_branch *branch); /* what its figure shows unless it is told */

#ifdef __cplusplus
}
#endif

#endif
