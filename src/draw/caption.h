/* caption.h - what of a scene is not the default. */
#ifndef FST_DRAW_CAPTION_H
#define FST_DRAW_CAPTION_H

#include <festoon/festoon.h>

/* Append "friction.law coulomb, bead.radius 2 mm" to `text`, behind a comma where there is a text already: what differs from
 * the default scene, but for the `count` keys that the figure shows anyway. */
void fst_caption(const fst_params *params, const char *const *shown, int count, char *text, size_t size);

enum { FST_CAPTION_SIZE = 224 };

/* What differs between scenes, for each of them: "friction.law coulomb" beside "friction.law viscous"; "" for all where nothing
 * does.  `same`: what is equal in all and not the default. */
void fst_caption_differences(const fst_params *const *scenes, int count, const char *const *shown,
                             int shown_count, char (*names)[FST_CAPTION_SIZE], char *same, size_t size);

/* A name for each file: what differs between their scenes (NULL: not known), and the file's name where that does not
 * tell it from another. */
void fst_caption_of_files(const fst_params *const *scenes, const char *const *paths, int count,
                          const char *const *shown, int shown_count, char (*names)[FST_CAPTION_SIZE],
                          char *same, size_t size);

/* The name of a file without its folder. */
const char *fst_file_name(const char *path);

/* Add "at friction.mu 0.2", the values that slices of sweeps have, where all have the same and neither this text nor the
 * first file's name tells it, as what is as by default. */
void fst_caption_slices(const char *const *slices, int count, const char *name, char *same, size_t size);

#endif
