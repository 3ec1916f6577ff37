/* bead_files.h - what a run of several beads leaves: a sentence, JSON, and trajectories in files. */
#ifndef FESTOON_BEAD_FILES_H
#define FESTOON_BEAD_FILES_H

#include <festoon/beads.h>
#include <festoon/look.h>

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
FST_API char *fst_beads_locked_json(const fst_params *scene, const fst_beads_locked *locked);
FST_API char *fst_beads_orbit_json(const fst_params *scene, const fst_beads_orbit *orbit);
FST_API char *fst_beads_branch_json(const fst_params *scene, const fst_beads_branch *branch);

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
    int frame; /* fst_frame: of the states */
} fst_beads_table;
FST_API fst_status fst_beads_trajectory_read(const char *path, fst_beads_table *table, fst_error *error);
FST_API void fst_beads_table_free(fst_beads_table *table);

/* The numbers of a bead in a row of it. */
FST_API const double *fst_beads_table_state(const fst_beads_table *table, size_t row, int bead);

/* Whether the trajectory in a file is such a one: of several beads, or of one in a world, which no fst_table holds. */
FST_API fst_status fst_trajectory_has_beads(const char *path, int *has_beads, fst_error *error);

#ifdef __cplusplus
}
#endif

#endif
