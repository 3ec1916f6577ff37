/* fit_words.h - what a fit knows least, in words. */
#ifndef FST_TRACK_FIT_WORDS_H
#define FST_TRACK_FIT_WORDS_H

#include "track/fit_errors.h"

/* The weakest direction, and which measurement would help most. */
fst_status fit_weakest(const fit_problem *p, const fit_estimate *e, double scale, char *text, size_t size,
                       fst_error *error);

/* The direction alone, without asking for further numbers of a table. */
void fit_say_weakest(const fit_problem *p, const fit_estimate *e, double scale, char *text, size_t size);

#endif
