/* caption.h - what of a scene is not the default. */
#ifndef FST_DRAW_CAPTION_H
#define FST_DRAW_CAPTION_H

#include <festoon/festoon.h>

/* Append "friction.law coulomb, bead.radius 2 mm" to `text`, behind a comma where there is a text already: what differs from
 * the default scene, but for the `count` keys that the figure shows anyway. */
void fst_caption(const fst_params *params, const char *const *shown, int count, char *text, size_t size);

#endif
