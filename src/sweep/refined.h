/* refined.h - how a sweep is refined: the options, and their line in the table `festoon`. */
#ifndef FST_SWEEP_REFINED_H
#define FST_SWEEP_REFINED_H

#include "sweep/file.h"
#include "sweep/refine.h"

typedef struct fst_refining { /* declared in journal.h too */
    int levels;               /* 0: every point is computed */
    char key[48];
    double step; /* corners differ where the key differs by more */
} fst_refining;

/* FST_BAD_INPUT: no key of a run, or a step that does not fit it. */
fst_status fst_refining_of(const fst_sweep_options *options, fst_refining *refining, fst_error *error);

/* Whether the values of a key are names, regimes or symmetries: nothing lies between two of them. */
int fst_sweep_has_names(const char *key);

/* Note it in the database, whose identity is `lines`, within the present transaction. */
fst_status fst_refining_write(sqlite3 *database, const char *path, const fst_identity_lines *lines,
                              const fst_refining *refining, fst_error *error);

/* What was noted.  FST_BAD_INPUT: damaged. */
fst_status fst_refining_read(const fst_identity_lines *lines, const char *path, fst_refining *refining,
                             fst_error *error);

#endif
