/* read_imagej.c - the data files of MTrackJ, a plugin of ImageJ.  (ImageJ's Manual Tracking: read_columns.c.)
 *
 *   MTrackJ 1.5.1 Data File
 *   ...
 *   Track 1
 *   Point 1 111.3 126.1 1.0 1.0 1.0           ID x y z t c; t is the frame, from 1; pixels, y down
 */
#include "tracks/read_formats.h"

#include <string.h>

#include "base/text.h"

static fst_status take_point(const fst_text_table *table, int track, track_raw *raw)
{
    static const char *const names[] = {"x", "y", "z", "t"};
    double values[4];
    fst_status status = FST_OK;
    if (table->count < 6 || track < 0)
        return fst_text_fail(table->text->path, table->line, table->error,
                             "a point of a track has ID x y z t c, and stands behind its track");
    for (int k = 0; k < 4 && status == FST_OK; ++k) {
        const fst_text_column column = {.names = names[k], .kind = FST_UNIT_NUMBER, .place = k + 3};
        status = fst_text_value(table, &column, &values[k]);
        if (status == FST_OK && isnan(values[k]))
            status = fst_text_fail_cell(table, &column, NULL, "is empty");
    }
    const track_spot spot = {track, values[3], NAN, values[0], values[1], table->line, 0, 0};
    return status == FST_OK ? track_raw_add(raw, spot, table->error) : status;
}

fst_status track_read_mtrackj(const fst_text *text, size_t header, int variant, track_raw *raw,
                              fst_error *error)
{
    (void)variant;
    fst_text_table table;
    char cluster[32] = "", name[TRACK_NAME_SIZE];
    int track = -1;
    fst_status status = FST_OK;
    raw->y_down = 1;
    (void)snprintf(raw->length_unit, sizeof raw->length_unit, "px");
    fst_text_begin(&table, text, error);
    for (size_t i = header + 1; i < text->count && status == FST_OK; ++i) {
        status = fst_text_split(&table, i + 1, ' ');
        if (status != FST_OK || table.count < 2)
            continue;
        if (strcmp(table.cells[0], "Cluster") == 0) {
            (void)snprintf(cluster, sizeof cluster, "%.30s", table.cells[1]);
        } else if (strcmp(table.cells[0], "Track") == 0) {
            const int first = !cluster[0] || strcmp(cluster, "1") == 0;
            (void)snprintf(name, sizeof name, "%s%s%.30s", first ? "" : cluster, first ? "" : ".",
                           table.cells[1]);
            status = track_raw_name(raw, name, &track, error);
        } else if (strcmp(table.cells[0], "Point") == 0) {
            status = take_point(&table, track, raw);
        }
    }
    fst_text_end(&table);
    return status;
}
