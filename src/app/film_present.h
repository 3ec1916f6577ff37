/* film_present.h - whether this build can paint films. */
#ifndef FST_APP_FILM_PRESENT_H
#define FST_APP_FILM_PRESENT_H

/* 1 if the module that paints lies where it would be loaded from. */
int fst_film_present(void);

#endif
