/* layout.h - what of a scene a film shows, and how large. */
#ifndef FST_FILM_LAYOUT_H
#define FST_FILM_LAYOUT_H

#include "film/cast.h"

/* A layout with the room for its words.  The layout points into it: do not copy it. */
typedef struct fst_film_look {
    fst_film_layout layout;
    char title[192], label[128], slower[48];
} fst_film_look;

void fst_film_look_at(fst_film_look *look, const fst_film_cast *cast, const fst_film_options *options);

#endif
