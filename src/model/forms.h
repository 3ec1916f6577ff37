/* forms.h - quantities that can be given in several forms, and which form counts. */
#ifndef FST_MODEL_FORMS_H
#define FST_MODEL_FORMS_H

#include <festoon/festoon.h>

/* Whether the field of a key plays no part because another form of its quantity is given. */
int fst_form_overridden(const fst_params *params, const char *key);

/* Before the setter gives a key its value: forget what a program wrote into the forms of the key's quantity. */
void fst_form_will_be_set(fst_params *params, const char *key);

/* After the setter gave a key its value: take back what says the same quantity otherwise.  Any key may be
 * named.
 */
void fst_form_was_set(fst_params *params, const char *key);

/* After a key was taken back to what it is where nothing was said of it. */
void fst_form_was_unset(fst_params *params, const char *key);

/* The parameters as fst_params_settle() leaves them: `params` itself, or `room`, where it settles a copy. Where
 * two forms contradict each other, `params` as it is. */
const fst_params *fst_params_settled(const fst_params *params, fst_params *room);

/* Whether model.kappa was given, also with the value that is its default. */
int fst_kappa_given(const fst_params *params);

/* Whether kappa follows from the bead and the magnet, so that model.kappa plays no part. */
int fst_kappa_follows(const fst_params *params);

#endif
