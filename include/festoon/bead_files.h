/* bead_files.h - what a run of several beads leaves: a sentence, JSON, trajectories in files, and figures of these. */
#ifndef FESTOON_BEAD_FILES_H
#define FESTOON_BEAD_FILES_H

#include <festoon/beads.h>
#include <festoon/charts.h>

#ifdef __cplusplus
extern "C" {
#endif

/* ------------------------------------------------------------------ words and JSON */

/* What the beads of a run do, in one line: "a chain of four turns with the magnet about the axis, one bead apart". */
enum { FST_BEADS_SENTENCE_SIZE = 512 };
FST_API void fst_beads_sentence(const fst_beads_result *result, char *text, size_t size);

/* The result of a run of several beads, and its scene, as JSON; with FST_SHOWN_LAB or FST_SHOWN_SI numbers in SI stand
 * beside the scaled ones.  free() it; NULL: no memory. */
FST_API char *fst_beads_json(const fst_params *scene, const fst_beads_result *result, fst_shown_units units);

/* The same of what beads do for ever.  In a locked state `z` is a centre's height over that of the bead at rest on the
 * plate, and `state` has its numbers, Z over the plate's surface. */
FST_API char *fst_beads_locked_json(const fst_params *scene, const fst_beads_locked *locked,
                                    fst_shown_units units);
FST_API char *fst_beads_orbit_json(const fst_params *scene, const fst_beads_orbit *orbit,
                                   fst_shown_units units);
FST_API char *fst_beads_branch_json(const fst_params *scene, const fst_beads_branch *branch,
                                    fst_shown_units units);

/* ------------------------------------------------------------------ trajectories */

/* A file into which a run of several beads, or of one in a world, streams its samples, as fst_trajectory
 * (festoon_tools.h): it has the columns t and drive_turns; then of each bead i its twelve numbers,
 * X_i to WZ_i, and load_i, the force on the plate; then of each pair force_i_j.  A force is NAN where the two do not touch.
 * Of more than FST_BEADS_MOST beads, which time stepping takes, a file has no pairs. */
typedef struct fst_beads_trajectory fst_beads_trajectory;
FST_API fst_status fst_beads_trajectory_create(const char *path, const fst_params *scene, fst_shown_units units,
                                               fst_beads_trajectory **trajectory, fst_error *error);
FST_API fst_status fst_beads_trajectory_append(fst_beads_trajectory *trajectory, const fst_beads_sample *sample,
                                               fst_error *error);
FST_API fst_status fst_beads_trajectory_close(fst_beads_trajectory *trajectory, const fst_beads_result *result,
                                              int complete, fst_error *error);
/* The same, of a world. */
FST_API fst_status fst_world_trajectory_close(fst_beads_trajectory *trajectory, const fst_world_result *result,
                                              int complete, fst_error *error);
FST_API void fst_beads_trajectory_discard(fst_beads_trajectory *trajectory);

/* Such a file, read; free it with fst_beads_table_free(). */
typedef struct fst_beads_table {
    size_t rows;
    int count, columns;      /* beads; columns of the file */
    double *t, *drive_turns; /* of each row */
    double *states;          /* FST_BEAD_NUMBERS of each bead, bead after bead, row after row */
    double *radii;           /* of each bead, l */
    size_t *first;           /* row r has touches[first[r]] to touches[first[r + 1] - 1] */
    fst_bead_touch *touches;
    fst_params scene;
    fst_bead_params *beads; /* of a scene that lists more than FST_BEADS_MOST */
    int complete;
    fst_beads_outcome outcome; /* of the run; FST_BEADS_OUTCOME_COUNT: the file does not say */
    int frame;                 /* fst_frame: of the states */
} fst_beads_table;
FST_API fst_status fst_beads_trajectory_read(const char *path, fst_beads_table *table, fst_error *error);
FST_API void fst_beads_table_free(fst_beads_table *table);

/* The numbers of a bead in a row of it. */
FST_API const double *fst_beads_table_state(const fst_beads_table *table, size_t row, int bead);

/* A vector of a bead from its number `from` on (0: place, 3: velocity, 6: moment, 9: angular velocity) on the laboratory's
 * axes, or on those of the turning magnet. */
FST_API void fst_beads_table_vector(const fst_beads_table *table, size_t row, int bead, int from,
                                    int from_magnet, double vector[3]);

/* The rows first <= row < last of one bead, as of a trajectory of it alone; free it with fst_table_free().  Columns that
 * need the field are absent (NULL). */
FST_API fst_status fst_beads_table_alone(const fst_beads_table *table, int bead, size_t first, size_t last,
                                         struct fst_table *alone, fst_error *error);

/* Whether the trajectory in a file is such a one: of several beads, or of one in a world, which no fst_table holds. */
FST_API fst_status fst_trajectory_has_beads(const char *path, int *has_beads, fst_error *error);

/* ------------------------------------------------------------------ figures */

/* The figure of kind `path` or `groups`, as fst_figure_trajectory() draws others, and its chart, which fst_chart_free()
 * frees.  Of the options a path takes from_magnet and zoom, both from, to, title and units; a path is shown from the
 * discard on for as long as makes a good picture, groups from the start to the end. */
FST_API fst_status fst_figure_beads(const fst_beads_table *table, const char *out,
                                    const struct fst_figure_options *options, fst_error *error);
FST_API fst_status fst_chart_of_beads(const fst_beads_table *table, const struct fst_figure_options *options,
                                      fst_chart **chart, fst_error *error);

/* ------------------------------------------------------------------ films */

struct fst_film_options;

/* Films of such a trajectory, as fst_film() and fst_camera_film() make them of one bead: all beads with their poles and
 * contacts, each with its trail in its colour.  Without a plate the view is from the front; where the magnet is carried
 * along or the field travels, it goes with the beads.  A camera's truth of several has columns x_0, y_0, u_0, v_0, x_1 ...
 * FST_BAD_INPUT: a colour of several beads, or a camera without a flat plate. */
FST_API fst_status fst_film_beads(const fst_beads_table *table, const char *out,
                                  const struct fst_film_options *options, fst_error *error);
struct fst_camera_options;
struct fst_camera_facts;
FST_API fst_status fst_camera_film_beads(const fst_beads_table *table, const char *out, const char *truth,
                                         const struct fst_camera_options *options,
                                         struct fst_camera_facts *facts, fst_error *error);

/* The colour of a bead in all pictures; colours come again after FST_BEADS_MOST beads. */
FST_API fst_colour fst_bead_colour(int bead);

#ifdef __cplusplus
}
#endif

#endif
