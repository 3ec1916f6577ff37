/* map_csv.c - reading a map of the field from a table of text, in any dialect of text_table.h.
 *
 * A head of column names with units, "x [mm],y [mm],z [mm],Bx [mT],By [mT],Bz [mT]", in any order; then a row a
 * sample.  z may be missing, and other columns are passed over.
 */
#include "io/map_points.h"
#include "io/text_table.h"

static fst_status read_rows(fst_text_table *table, const fst_text_column *columns, fst_map_points *points)
{
    for (;;) {
        double row[MAP_COLUMNS];
        int more;
        fst_status status = fst_text_row(table, &more);
        if (status != FST_OK || !more)
            return status;
        for (int c = 0; c < MAP_COLUMNS && status == FST_OK; ++c) {
            status = fst_text_value(table, &columns[c], &row[c]);
            if (status == FST_OK && isnan(row[c]) && columns[c].place)
                status = fst_text_fail_cell(table, &columns[c], fst_text_cell(table, &columns[c]),
                                            "is not a number");
        }
        if (status == FST_OK)
            status = fst_map_points_add(points, row, table->line);
        if (status != FST_OK)
            return status;
    }
}

fst_status fst_map_csv_read(const char *bytes, size_t size, fst_map_points *points)
{
    fst_text_column columns[MAP_COLUMNS] = {
        [MAP_X] = {"x", FST_UNIT_LENGTH, .needed = 1}, [MAP_BX] = {"Bx", FST_UNIT_FIELD, .needed = 1},
        [MAP_Y] = {"y", FST_UNIT_LENGTH, .needed = 1}, [MAP_BY] = {"By", FST_UNIT_FIELD, .needed = 1},
        [MAP_Z] = {"z", FST_UNIT_LENGTH, .needed = 0}, [MAP_BZ] = {"Bz", FST_UNIT_FIELD, .needed = 1},
    };
    fst_text text = {.path = NULL};
    fst_text_table table;
    fst_text_begin(&table, &text, points->error);
    fst_status status = fst_text_take(&text, points->path, bytes, size, points->error);
    if (status == FST_OK)
        status = fst_text_head(&table, columns, MAP_COLUMNS, "x [mm],y [mm],z [mm],Bx [mT],By [mT],Bz [mT]");
    if (status == FST_OK)
        status = read_rows(&table, columns, points);
    fst_text_end(&table);
    fst_text_free(&text);
    return status;
}
