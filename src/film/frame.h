/* frame.h - one frame of a film, and the module that paints it.  Cairo takes long to load, so only a film loads
 * the module. */
#ifndef FST_FILM_FRAME_H
#define FST_FILM_FRAME_H

#include <festoon/festoon.h>

#include <stdio.h>

#include "draw/poles.h"

/* From where a picture is seen: from above, or along y with z upwards. */
typedef enum { FST_FILM_ABOVE, FST_FILM_FRONT } fst_film_view;

/* What is the same in all frames of a film.  Lengths are in mm, heights over the plate, or, where there is none, over
 * where it would be. */
typedef struct fst_film_layout {
    int width, height;                     /* pixels, both even */
    fst_film_view view;                    /* of the whole picture; the small one in its corner is the other */
    double reach;                          /* half the side of the square that is shown */
    double middle;                         /* from the front: the height that is shown in the middle */
    double small_reach;                    /* of the small picture */
    double top;                            /* how high beads rise */
    int upside_down;                       /* gravity pulls up along z: z is shown downwards */
    fst_magnet_body bodies[FST_PARTS_MAX]; /* of the magnet */
    int body_count;                        /* 0: a source without a known shape is not painted */
    unsigned fixed, round;                 /* bit i: body i stands still; it is a sphere */
    double low, high;                      /* of the bodies, over the magnet's reference plane */
    double depth;                          /* of the magnet's reference plane below the plate */
    fst_coil coils[FST_COILS_MAX];         /* over the magnet's reference plane */
    int coil_count;
    fst_plate_shape plate;
    double bowl;        /* radius of a bowl */
    double wave;        /* length of a travelling field, minus where it turns the other way; 0: there is none */
    double radius;      /* of the greatest bead */
    int follows;        /* the picture moves along, over marks on the plate */
    const char *title;  /* frequency and dynamics */
    const char *slower; /* "10.7 times slower" */
    const char *seen_as;      /* in the small picture: "from the front" */
    const char *colour_label; /* of the trail; NULL: trails have the colours of their beads */
    double colour_low, colour_high;
    int both_signs; /* use the palette for both signs */
} fst_film_layout;

/* Whether the contact slips; under a law by which it may do both, and by which the bead may leave the plate. */
typedef enum { FST_CONTACT_UNTOLD, FST_CONTACT_STICKS, FST_CONTACT_SLIPS, FST_CONTACT_FLIES } fst_contact_shown;

/* A bead.  Its trail runs from the oldest point to the bead, in the plane of the whole picture; `shade`, from 0 to 1,
 * picks a colour of the palette. */
typedef struct fst_film_bead {
    double place[3];   /* of its centre */
    double turn[3][3]; /* its rotation, from body to laboratory; the moment is the body's third axis */
    double radius;
    fst_contact_shown contact;
    int flies;            /* one of several, or without a plate: it is in the air */
    const double *colour; /* red, green and blue of its rim and trail; NULL: contact and shades tell theirs */
    const double *trail_x, *trail_y, *trail_shade;
    int trail;
} fst_film_bead;

/* What changes from frame to frame. */
typedef struct fst_film_frame {
    double magnet_angle; /* rad */
    double magnet_place[2];
    double phase;     /* of a travelling field, rad */
    double centre[2]; /* the place in the middle of a picture from above */
    int count;
    const fst_film_bead *beads;
    int touch_count;
    const int (*touches)[2]; /* pairs of beads */
    const char *clock;       /* "t = 0.0123 s" */
} fst_film_frame;

typedef struct fst_film_canvas fst_film_canvas;

/* The module's one symbol is a table of this type, named FST_FILM_MODULE_SYMBOL. */
#define FST_FILM_MODULE_SYMBOL "fst_film_module"
typedef struct fst_film_module_table {
    const char *version; /* FST_VERSION_STRING at the module's build; a module of another version is refused */
    fst_status (*open)(const fst_film_layout *layout, fst_film_canvas **canvas, fst_error *error);
    fst_status (*paint)(fst_film_canvas *canvas, const fst_film_layout *layout, const fst_film_frame *frame,
                        fst_error *error);
    /* Rows of pixels from the top, four bytes a pixel in the order blue, green, red, unused, and `*stride`
     * bytes a row. */
    const unsigned char *(*pixels)(fst_film_canvas *canvas, int *stride);
    /* A failed write is seen at the stream. */
    fst_status (*write_png)(fst_film_canvas *canvas, FILE *out, fst_error *error);
    void (*close)(fst_film_canvas *canvas);
} fst_film_module_table;

#endif
