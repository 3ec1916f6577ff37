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
