/* frame.h - one frame of a film, and the module that paints it.  Cairo takes long to load, so only a film loads
 * the module. */
#ifndef FST_FILM_FRAME_H
#define FST_FILM_FRAME_H

#include <festoon/festoon.h>

#include <stdio.h>

#include "draw/poles.h"

/* What is the same in all frames of a film.  Lengths are in mm. */
typedef struct fst_film_layout {
    int width, height;                     /* pixels, both even */
    double reach;                          /* half the side of the square of plate that is shown */
    fst_magnet_body bodies[FST_PARTS_MAX]; /* of the magnet */
    int body_count;                        /* 0: a source without a known shape is not painted */
    double low, high;                      /* of the bodies, over the magnet's reference plane */
    double depth;                          /* of the magnet's reference plane below the plate */
    double radius;                         /* of the bead */
    const char *title;                     /* frequency and dynamics */
    const char *slower;                    /* "10.7 times slower" */
    const char *colour_label;              /* of the trail */
    double colour_low, colour_high;
    int both_signs; /* use the palette for both signs */
} fst_film_layout;

/* Whether the contact slips; under a law by which it may do both, and by which the bead may leave the plate. */
typedef enum { FST_CONTACT_UNTOLD, FST_CONTACT_STICKS, FST_CONTACT_SLIPS, FST_CONTACT_FLIES } fst_contact_shown;

/* What changes from frame to frame.  The trail runs from its oldest point to the bead; `shade`, from 0 to 1,
 * picks a colour of the palette. */
typedef struct fst_film_frame {
    double x, y, z;      /* the bead, and its height over the plate */
    double magnet_angle; /* rad */
    double turn[3][3]; /* rotation of the bead, from body to laboratory; the moment is the body's third axis */
    const char *clock; /* "t = 0.0123 s" */
    fst_contact_shown contact;
    const double *trail_x, *trail_y, *trail_shade;
    int trail;
} fst_film_frame;

typedef struct fst_film_canvas fst_film_canvas;

/* The module's one symbol is a table of this type, named FST_FILM_MODULE_SYMBOL. */
#define FST_FILM_MODULE_SYMBOL "fst_film_module"
typedef struct fst_film_module_table {
    const char *version; /* FST_VERSION_STRING at the module's build; a module of another version is refused */
    fst_status (*open)(const fst_film_layout *layout, fst_film_canvas **canvas, fst_error *error);
    void (*paint)(fst_film_canvas *canvas, const fst_film_layout *layout, const fst_film_frame *frame);
    /* Rows of pixels from the top, four bytes a pixel in the order blue, green, red, unused, and `*stride`
     * bytes a row. */
    const unsigned char *(*pixels)(fst_film_canvas *canvas, int *stride);
    /* A failed write is seen at the stream. */
    fst_status (*write_png)(fst_film_canvas *canvas, FILE *out, fst_error *error);
    void (*close)(fst_film_canvas *canvas);
} fst_film_module_table;

#endif
