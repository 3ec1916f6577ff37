/* field_map.h - what a map of the magnet's field shows, and over which piece of the plane. */
#ifndef FST_DRAW_FIELD_MAP_H
#define FST_DRAW_FIELD_MAP_H

#include <festoon/festoon_tools.h>

enum {
    FST_MAP_COLUMNS = 181,
    FST_MAP_ROWS = 145,
    FST_MAP_MAXIMA = 8 /* the most maxima that are marked */
};

typedef struct fst_drawn_map {
    const fst_model *model;
    const fst_params *params;
    fst_groups groups;
    fst_field_quantity quantity;
    int other_height;               /* than that of a bead on the plate */
    int bar;                        /* whether the source is the bar of lines, which is marked */
    double half_width, half_height; /* of the map, in l */
    double maxima[FST_MAP_MAXIMA][2];
    int maximum_count;
    double length, value;           /* how many of the figure's units make l, and the quantity's scaled unit */
    const char *length_unit, *unit; /* their names */
    double least, greatest;         /* of the quantity, in the figure's unit */
} fst_drawn_map;

/* Model, units and the extent of the map; fst_drawn_map_free() frees the model, also after a failure. */
fst_status fst_drawn_map_make(fst_drawn_map *map, const fst_params *params, const fst_field_options *options,
                              fst_error *error);
void fst_drawn_map_free(fst_drawn_map *map);

/* The place of a column and a row, in l. */
double fst_drawn_map_x(const fst_drawn_map *map, int column);
double fst_drawn_map_y(const fst_drawn_map *map, int row);

/* The quantity at a place, in the figure's unit; NAN in a part of the magnet. */
double fst_drawn_map_value(const fst_drawn_map *map, double x, double y);

/* What the arrows show there: the part of the field in the plane (B0), or of the force (l gamma^2). */
void fst_drawn_map_arrow(const fst_drawn_map *map, double x, double y, double arrow[2]);

/* Whether the quantity is a force on a bead. */
int fst_drawn_map_of_bead(const fst_drawn_map *map);

/* Least and greatest of the quantity, and the maxima of |B|. */
void fst_drawn_map_survey(fst_drawn_map *map);

#endif
