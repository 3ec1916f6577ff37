/* paper.h - what festoon-paper can be asked for. */
#ifndef FST_PAPER_PAPER_H
#define FST_PAPER_PAPER_H

#include <festoon/festoon_tools.h>

typedef struct fst_paper_options {
    int reduced; /* fewer points and shorter runs, for tests */
    int starts;  /* starts of the search for a paramagnetic bead that counter-rotates; 0: the usual number */
    int films;   /* make the supplement's two films too, film_0215.mp4 and film_04.mp4 */
    const char *only; /* compute only this statement, by its id in paper.json; NULL: all */
    char **summary;   /* becomes Table 1 and a count of the verdicts as text or, with `only`, the statement as
                         JSON; free() it */
    const fst_progress *progress; /* `what` names the stage */
} fst_paper_options;

/* Compute what the paper shows, by both dynamics, and write paper.json, the figures and report.html into
 * `directory` (made if missing).  After an interruption or a failure they hold what was done until then, and
 * say "complete": false.  With `only` nothing is computed that the statement does not need, nothing is written,
 * and `directory` may be NULL. */
fst_status fst_paper(const char *directory, const fst_paper_options *options, fst_error *error);

/* Compute maps of what becomes of a bead that rubs dry, over the coefficient of friction and the drive, from
 * four starts, into `directory` (made if missing): for each start a sweep's database, its rows as CSV and
 * figures; and a table of outcomes, as Markdown.  They take many minutes.  Killed or interrupted at any moment,
 * the same call goes on. */
fst_status fst_paper_dry_maps(const char *directory, const fst_progress *progress, fst_error *error);

/* The rules of the verdicts, and the list of the paper's statements with their criteria, as Markdown; free()
 * it.  NULL: no memory. */
char *fst_paper_statements_text(void);

#endif
