/* style.c - colours, palettes and logarithmic axes of all figures. */
#include "draw/style.h"

#include <festoon/bead_files.h>

#include <math.h>
#include <stdio.h>
#include <string.h>

const char *fst_colour_code(fst_colour colour)
{
#define CODE(NAME, name, code) code,
    static const char *const codes[] = {FST_COLOURS(CODE)};
#undef CODE
    return codes[colour];
}

fst_colour fst_bead_colour(int bead)
{
    /* Vermilion and blue are the magnet's poles. */
    static const fst_colour colours[FST_BEADS_MOST] = {FST_COLOUR_GREEN, FST_COLOUR_PURPLE, FST_COLOUR_OLIVE,
                                                       FST_COLOUR_SKY,   FST_COLOUR_ORANGE, FST_COLOUR_WINE,
                                                       FST_COLOUR_SAND,  FST_COLOUR_TEAL};
    return colours[bead % FST_BEADS_MOST];
}

void fst_unit_symbols(const char *unit, char *text, size_t size)
{
    static const struct {
        const char *word, *symbol;
    } symbols[] = {{"gamma", "γ"}, {"deg", "°"}, {"B0", "B₀"}, {"l", "ℓ"},
                   {"^2", "²"},    {"^3", "³"},  {"uJ", "µJ"}, {" ", ""}};
    enum { COUNT = sizeof symbols / sizeof symbols[0] };
    size_t used = 0;
    text[0] = '\0';
    if (strcmp(unit, "m g") == 0 || strcmp(unit, "weights of the bead") == 0) {
        (void)snprintf(text, size, "weights of the bead");
        return;
    }
    while (*unit && used + 1 < size) {
        int i = 0;
        while (i < COUNT && strncmp(unit, symbols[i].word, strlen(symbols[i].word)) != 0)
            ++i;
        used += (size_t)(i < COUNT ? snprintf(text + used, size - used, "%s", symbols[i].symbol)
                                   : snprintf(text + used, size - used, "%c", *unit));
        unit += i < COUNT ? strlen(symbols[i].word) : 1;
    }
}

const char *fst_palette_definition(fst_palette palette)
{
    /* "line" is viridis in reverse order, without its yellow end, which cannot be seen on white. */
    static const char *const definitions[] = {
        [FST_PALETTE_DIVERGING] = "-1 '#123f8c', -0.5 '#4f86cf', 0 '#bdbdbd', 0.5 '#e8894a', 1 '#b03000'",
        [FST_PALETTE_LINE] =
            "0 '#a8db34', 0.2 '#4ac16d', 0.4 '#1fa187', 0.6 '#2d708e', 0.8 '#414487', 1 '#440154'",
        [FST_PALETTE_MAP] = "0 '#f4f9fe', 0.3 '#c0dbef', 0.65 '#6fb0da', 1 '#2c7cba'"};
    return definitions[palette];
}

void fst_figure_palette(fst_figure_file *figure, fst_palette palette)
{
    (void)fprintf(figure->script, "set palette defined (%s)\n", fst_palette_definition(palette));
}

double fst_round_step(double rough)
{
    const double ten = pow(10.0, floor(log10(rough)));
    return rough < 1.5 * ten ? ten : rough < 3.5 * ten ? 2.0 * ten : rough < 7.5 * ten ? 5.0 * ten : 10.0 * ten;
}

void fst_figure_logarithmic(fst_figure_file *figure, const char *axis, double low, double high)
{
    static const double mantissas[] = {1.0, 2.0, 5.0};
    const int first = (int)floor(log10(low)), last = (int)floor(log10(high));
    const char *separator = "";
    const double step = fst_round_step((high - low) / 5.0), start = ceil(low / step - 1e-6);
    const int few = high < 5.0 * low && high - low > 1e-5 * low; /* it may have one of 1, 2, 5 or none */
    (void)fprintf(figure->script, "set logscale %s\nset %stics (", axis, axis);
    for (int i = 0; few && step * (start + i) <= high + 1e-6 * step; ++i) {
        (void)fprintf(figure->script, "%s%.6g", separator, step * (start + i));
        separator = ", ";
    }
    for (int decade = first; decade <= last && !few; ++decade)
        for (int i = 0; i < (last - first > 3 ? 1 : 3); ++i) {
            const double tic = mantissas[i] * pow(10.0, decade);
            if (tic < 0.999999 * low || tic > 1.000001 * high)
                continue;
            (void)fprintf(figure->script, "%s%.6g", separator, tic);
            separator = ", ";
        }
    (void)fputs(")\n", figure->script);
}
