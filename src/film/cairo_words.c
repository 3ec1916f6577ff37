/* cairo_words.c - colours and words of a frame: the scale, the colours of trails, beads and poles. */
#include "film/cairo_words.h"

#include <math.h>
#include <stdio.h>

#include "base/constants.h"

/* The colours of the figures (style.c): from light green to violet, and from blue over grey to vermilion. */
static const double line_palette[][4] = {{0.0, 0.659, 0.859, 0.204}, {0.2, 0.290, 0.757, 0.427},
                                         {0.4, 0.122, 0.631, 0.529}, {0.6, 0.176, 0.439, 0.557},
                                         {0.8, 0.255, 0.267, 0.529}, {1.0, 0.267, 0.004, 0.329}};
static const double diverging_palette[][4] = {{0.0, 0.071, 0.247, 0.549},
                                              {0.25, 0.310, 0.525, 0.812},
                                              {0.5, 0.741, 0.741, 0.741},
                                              {0.75, 0.910, 0.537, 0.290},
                                              {1.0, 0.690, 0.188, 0.0}};
const double fst_pen_north[3] = {0.835, 0.369, 0.0}, fst_pen_south[3] = {0.0, 0.447, 0.698};

void fst_pen_shade(cairo_t *pen, int both_signs, double shade)
{
    const double(*palette)[4] = both_signs ? diverging_palette : line_palette;
    int last = both_signs ? 4 : 5, i = 0;
    shade = shade > 0.0 ? (shade < 1.0 ? shade : 1.0) : 0.0;
    while (i < last - 1 && shade > palette[i + 1][0])
        ++i;
    double part = (shade - palette[i][0]) / (palette[i + 1][0] - palette[i][0]), c[3];
    for (int k = 0; k < 3; ++k)
        c[k] = palette[i][k + 1] + part * (palette[i + 1][k + 1] - palette[i][k + 1]);
    cairo_set_source_rgb(pen, c[0], c[1], c[2]);
}

void fst_pen_write(cairo_t *pen, double x, double y, double size, const char *text)
{
    cairo_set_font_size(pen, size);
    cairo_move_to(pen, x, y);
    cairo_show_text(pen, text);
    cairo_set_scaled_font(pen, cairo_get_scaled_font(pen)); /* what failed in a font is the pen's failure too */
}

/* The greatest 1, 2 or 5 times a power of ten that is not above `most`. */
double fst_round_length(double most)
{
    static const double steps[] = {1.0, 2.0, 5.0};
    const double power = pow(10.0, floor(log10(most)));
    double length = power;
    for (size_t i = 0; i < sizeof steps / sizeof *steps; ++i)
        if (steps[i] * power <= most)
            length = steps[i] * power;
    return length;
}

void fst_pen_scale_bar(cairo_t *pen, const fst_film_layout *layout, double scale)
{
    const double millimetres = fst_round_length(layout->width / (6.0 * scale)); /* a sixth of the width */
    double length = millimetres * scale, x = layout->width - 24.0 - length, y = layout->height - 24.0;
    char words[32];
    cairo_text_extents_t extents;
    cairo_set_source_rgb(pen, 0.13, 0.13, 0.13);
    cairo_set_line_width(pen, 3.0);
    cairo_move_to(pen, x, y);
    cairo_line_to(pen, x + length, y);
    cairo_stroke(pen);
    (void)snprintf(words, sizeof words, "%g mm", millimetres);
    cairo_set_font_size(pen, 0.026 * layout->height);
    cairo_text_extents(pen, words, &extents);
    fst_pen_write(pen, layout->width - 24.0 - fmax(length, extents.x_advance), y - 8.0, 0.026 * layout->height,
                  words);
}

/* What the colours of the poles mean, and the arrow. */
void fst_pen_key(cairo_t *pen, const fst_film_layout *layout)
{
    const double size = 0.024 * layout->height, x = 0.34 * layout->width, dot = 0.38 * size;
    const char *const words[2] = {"north pole", "south pole"};
    const int turns = layout->body_count && !layout->follows;
    double y = layout->height - 14.0 - (turns ? 1.5 * size : 0.0), at = x;
    for (int i = 0; i < 2; ++i) {
        const double *colour = i == 0 ? fst_pen_north : fst_pen_south;
        cairo_text_extents_t extents;
        cairo_arc(pen, at + dot, y - 0.36 * size, dot, 0.0, 2.0 * FST_PI);
        cairo_set_source_rgb(pen, colour[0], colour[1], colour[2]);
        cairo_fill(pen);
        cairo_set_source_rgb(pen, 0.35, 0.35, 0.35);
        fst_pen_write(pen, at + 3.0 * dot, y, size, words[i]);
        cairo_text_extents(pen, words[i], &extents);
        at += 4.5 * dot + extents.x_advance;
    }
    if (!turns)
        return;
    fst_pen_write(pen, x, y + 1.5 * size, size, "arrow: the magnet turns so");
}

/* The numbers of the beads in their colours, and what rims and dots mean. */
void fst_pen_bead_key(cairo_t *pen, const fst_film_layout *layout, const fst_film_frame *frame)
{
    const double size = 0.024 * layout->height, right = layout->width - 24.0;
    const char *const words[2] = {"rim with gaps: in the air", "black dot: beads touch"};
    const int shown = frame->count > FST_BEADS_MOST ? 0 : frame->count;
    cairo_text_extents_t extents;
    cairo_set_font_size(pen, size);
    for (int i = 0; i < shown; ++i) {
        const double *colour = frame->beads[i].colour, x = right - 1.5 * size * (shown - i);
        char number[12];
        (void)snprintf(number, sizeof number, "%d", i + 1);
        cairo_arc(pen, x + 0.75 * size, 16.0 + 0.7 * size, 0.66 * size, 0.0, 2.0 * FST_PI);
        cairo_set_source_rgb(pen, colour[0], colour[1], colour[2]);
        cairo_fill(pen);
        cairo_set_source_rgb(pen, 1.0, 1.0, 1.0);
        cairo_text_extents(pen, number, &extents);
        fst_pen_write(pen, x + 0.75 * size - 0.5 * extents.x_advance, 16.0 + 1.06 * size, size, number);
    }
    cairo_set_source_rgb(pen, 0.35, 0.35, 0.35);
    for (int i = 0; i < 2; ++i) {
        cairo_text_extents(pen, words[i], &extents);
        fst_pen_write(pen, right - extents.x_advance, 16.0 + (2.6 + 1.25 * i) * size, size, words[i]);
    }
}

void fst_pen_colour_bar(cairo_t *pen, const fst_film_layout *layout)
{
    enum { STEPS = 64 };
    double width = 0.3 * layout->width, x = layout->width - width - 24.0, y = 16.0,
           size = 0.024 * layout->height;
    for (int i = 0; i < STEPS; ++i) {
        fst_pen_shade(pen, layout->both_signs, (i + 0.5) / STEPS);
        cairo_rectangle(pen, x + i * width / STEPS, y, width / STEPS + 1.0, 10.0);
        cairo_fill(pen);
    }
    char low[32], high[32];
    cairo_text_extents_t extents;
    /* Three digits, but 6020 and not 6.02e+03. */
    (void)snprintf(low, sizeof low, fabs(layout->colour_low) < 1000.0 ? "%.3g" : "%.0f", layout->colour_low);
    (void)snprintf(high, sizeof high, fabs(layout->colour_high) < 1000.0 ? "%.3g" : "%.0f",
                   layout->colour_high);
    cairo_set_source_rgb(pen, 0.13, 0.13, 0.13);
    fst_pen_write(pen, x, y + 14.0 + size, size, low);
    cairo_text_extents(pen, high, &extents);
    fst_pen_write(pen, x + width - extents.x_advance, y + 14.0 + size, size, high);
    cairo_text_extents(pen, layout->colour_label, &extents);
    fst_pen_write(pen, x + width - extents.x_advance, y + 17.0 + 2.0 * size, size, layout->colour_label);
}
