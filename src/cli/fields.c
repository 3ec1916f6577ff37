/* fields.c - by which option a field of the library's options is given. */
#include "cli/fields.h"

#include <stddef.h>
#include <string.h>

static const struct {
    const char *field, *option;
} table[] = {
    {"fst_grid.axes", "--over"},
    {"fst_sweep_options.lanes", "--lanes"},
    {"fst_sweep_options.carry", "--carry"},
    {"fst_sweep_options.checkpoint_seconds", "--checkpoint"},
    {"fst_sweep_export.out", "-o"},
    {"fst_sweep_read.keys", "--key"},
    {"fst_figure_sweep.keys", "--key"},
    {"fst_figure_sweep.units", "--units"},
    {"fst_figure_branch.observable", "--observable"},
    {"fst_figure_options.colour", "--colour"},
    {"fst_figure_options.from", "--from"},
    {"fst_figure_options.zoom", "--zoom"},
    {"fst_film_options.width", "--size"},
    {"fst_film_options.fps", "--fps"},
    {"fst_film_options.seconds_per_turn", "--turn"},
    {"fst_film_options.from", "--from"},
    {"fst_film_options.colour", "--colour"},
    {"fst_paper_options.only", "--only"},
    {"fst_festoons_find.festoons", "--festoons"},
    {"fst_branch_options.key", "--over"},
    {"fst_branch_options.from", "--over"},
    {"fst_branch_options.tolerance", "--tolerance"},
    {"fst_branch_options.longest_step", "--step"},
    {"fst_branch_options.second_key", "--with"},
    {"fst_branch_options.second_from", "--with"},
    {"fst_branch_options.special", "--follow"},
};

const char *option_of_field(const char *field)
{
    for (size_t i = 0; i < sizeof table / sizeof *table; ++i)
        if (strcmp(table[i].field, field) == 0)
            return table[i].option;
    return field;
}
