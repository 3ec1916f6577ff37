/* figures.h - the table of the paper's figures, the functions that draw them, and the two films. */
#ifndef FST_PAPER_FIGURES_H
#define FST_PAPER_FIGURES_H

#include "paper/statements.h"

typedef struct fst_paper_figure {
    const char *name;   /* "f4" */
    const char *source; /* the paper's figure or section */
    const char *title, *caption;
    int each;        /* one figure for each dynamics */
    const char *own; /* the id of the statement that says what the figure shows; NULL: no verdict */
    fst_scan scan;   /* the runs that it shows */
    fst_status (*draw)(const fst_paper_state *paper, const struct fst_paper_figure *figure, const char *out,
                       fst_error *error);
    fst_paper_step step;  /* after which it can be drawn */
    fst_figure_kind kind; /* this and the next four: of figures of a trajectory */
    const char *colour;
    int zoomed;            /* the upper right corner only */
    int plain;             /* without arrows */
    int inset;             /* with the path of the moment */
    fst_dynamics dynamics; /* of a figure that each dynamics has */
    char file[48];         /* "f4-rigid" */
} fst_paper_figure;

/* The figures; one that each dynamics has counts twice. */
int fst_paper_figure_count(void);
fst_paper_figure fst_paper_figure_at(int index);
/* The verdict on what the figure itself shows; returns 0 where the figure has none. */
int fst_paper_figure_verdict(const fst_paper_state *paper, const fst_paper_figure *figure,
                             fst_dynamics dynamics, fst_verdict *verdict);
/* The command lines that draw it again. */
void fst_paper_figure_command(const fst_paper_state *paper, const fst_paper_figure *figure, char *text,
                              size_t size);
/* Draw every figure that can be drawn and is not drawn yet; the progress goes from `from` to `to`. */
fst_status fst_paper_draw_figures(fst_paper_state *paper, double from, double to, fst_error *error);

/* Values of fst_paper_figure.draw: curves over the drive (charts.c) ... */
#define FST_PAPER_DRAW(name)                                                                                   \
    fst_status fst_paper_draw_##name(const fst_paper_state *paper, const fst_paper_figure *figure,             \
                                     const char *out, fst_error *error);
FST_PAPER_DRAW(radius)
FST_PAPER_DRAW(comparison)
FST_PAPER_DRAW(dotal)
FST_PAPER_DRAW(test)
FST_PAPER_DRAW(evolution)
/* ... and the probes, the sketch and the camera's figure (probe_charts.c). */
FST_PAPER_DRAW(supercritical)
FST_PAPER_DRAW(remanence)
FST_PAPER_DRAW(sketch)
FST_PAPER_DRAW(camera)
/* ... and the chapter on real magnets (magnets_charts.c). */
FST_PAPER_DRAW(magnet_fields)
FST_PAPER_DRAW(magnet_speeds)
/* ... and of several beads (beads.c). */
FST_PAPER_DRAW(opposition)
/* ... and of a travelling field (waves.c). */
FST_PAPER_DRAW(waves)
#undef FST_PAPER_DRAW

/* The supplement's two films, beside the figures (films.c); paper->films counts the films that are made, in
 * this order. */
enum { FST_FILM_COUNT = 2 };
extern const char *const fst_film_names[FST_FILM_COUNT];
fst_status fst_paper_make_films(fst_paper_state *paper, fst_error *error);

#endif
