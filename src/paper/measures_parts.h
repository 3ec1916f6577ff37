/* measures_parts.h - what the files of measures share: macros, and short ways to runs and models. */
#ifndef FST_PAPER_MEASURES_PARTS_H
#define FST_PAPER_MEASURES_PARTS_H

#include "base/constants.h"
#include "paper/measures.h"
#include "paper/runs.h"

#include "io/collect.h"

#include <stdio.h>

#define MEASURE(name)                                                                                          \
    double fst_measure_##name(const fst_paper_state *paper, fst_dynamics dynamics, char *note, size_t size)
#define NO_NOTE ((void)note, (void)size)

/* The result of a scan that has only one run. */
static inline const fst_run_result *single(const fst_paper_state *paper, fst_scan scan, fst_dynamics dynamics)
{
    return &fst_paper_single(paper, scan, dynamics)->result;
}

/* Whether friction was -m gamma V in that run.  The paper's equations and balances take V for it, and say
 * nothing of another law: a measure of theirs then has no value, and the note tells why. */
static inline int is_viscous(const fst_paper_run *run, char *note, size_t size)
{
    if (run->params.friction_law == FST_FRICTION_VISCOUS)
        return 1;
    char law[64];
    (void)fst_params_get(&run->params, fst_param_find("friction.law"), law, sizeof law);
    (void)snprintf(note, size, "not measured: the equation takes −mγV for the friction, and here it is %s",
                   law);
    return 0;
}

static inline double eps_of(const fst_paper_run *run)
{
    return run->params.bead_radius / run->params.magnet_half_length;
}

/* The model of that run; NULL: no memory. */
static inline fst_model *model_of(const fst_paper_state *paper, fst_scan scan, fst_dynamics dynamics)
{
    fst_model *model = NULL;
    return fst_model_new(&fst_paper_single(paper, scan, dynamics)->params, &model, NULL) == FST_OK ? model
                                                                                                   : NULL;
}

#endif
