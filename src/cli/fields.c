/* fields.c - the library's names in its errors, and what a person types for them. */
#include "cli/fields.h"

#include <stdio.h>
#include <string.h>

static const struct {
    const char *field, *option;
} options[] = {
    {"fst_figure_sweep", "plot"},
    {"fst_grid.axes", "--over"},
    {"fst_sweep_options.lanes", "--lanes"},
    {"fst_sweep_options.carry", "--carry"},
    {"fst_sweep_options.refine", "--refine"},
    {"fst_sweep_options.refine_by", "--refine-by"},
    {"fst_sweep_options.checkpoint_seconds", "--checkpoint"},
    {"fst_sweep_export.out", "-o"},
    {"fst_sweep_read.keys", "--key"},
    {"fst_figure_sweep.keys", "--key"},
    {"fst_figure_sweep.units", "--units"},
    {"fst_figure_branch.observable", "--observable"},
    {"fst_figure_options.colour", "--colour"},
    {"fst_figure_options.from", "--from"},
    {"fst_figure_options.zoom", "--zoom"},
    {"fst_figure_options.keys", "--key"},
    {"fst_figure_options.kind", "--kind"},
    {"fst_figure_branch.units", "--units"},
    {"fst_film_options.width", "--size"},
    {"fst_film_options.fps", "--fps"},
    {"fst_film_options.seconds_per_turn", "--turn"},
    {"fst_film_options.from", "--from"},
    {"fst_film_options.colour", "--colour"},
    {"fst_camera_options.width", "--size"},
    {"fst_camera_options.fps", "--fps"},
    {"fst_camera_options.stored_fps", "--stored-fps"},
    {"fst_camera_options.from", "--from"},
    {"fst_camera_options.exposure", "--exposure"},
    {"fst_camera_options.readout", "--readout"},
    {"fst_camera_options.noise", "--noise"},
    {"fst_camera_options.uneven", "--uneven"},
    {"fst_camera_options.flicker", "--flicker"},
    {"fst_camera_options.tilt", "--tilt"},
    {"fst_camera_options.side", "--side"},
    {"fst_camera_options.distance", "--distance"},
    {"fst_camera_options.plate", "--plate"},
    {"fst_camera_options.quality", "--quality"},
    {"fst_camera_options.drop", "--drop"},
    {"fst_film_track_options.fps", "--fps"},
    {"fst_film_track_options.scale", "--scale"},
    {"fst_film_track_options.distance", "--distance"},
    {"fst_paper_options.only", "--only"},
    {"fst_fit_options.free", "--free"},
    {"fst_fit_options.given", "--given"},
    {"fst_fit_options.drive", "--drive"},
    {"fst_fit", ""},
    {"fst_festoons_find.festoons", "--festoons"},
    {"fst_branch_options.key", "--over"},
    {"fst_branch_options.from", "--over"},
    {"fst_branch_options.tolerance", "--tolerance"},
    {"fst_branch_options.longest_step", "--step"},
    {"fst_branch_options.second_key", "--with"},
    {"fst_branch_options.second_from", "--with"},
    {"fst_branch_options.special", "--follow"},
    {"fst_track_options.format", "--format"},
    {"fst_track_options.scale", "--scale"},
    {"fst_track_options.fps", "--fps"},
    {"fst_measure_options.drive", "--drive"},
    {"fst_measure_options.exposure", "--exposure"},
    {"fst_figure_measurement.compare", "--compare"},
};

const char *option_of_field(const char *field)
{
    for (size_t i = 0; i < sizeof options / sizeof *options; ++i)
        if (strcmp(options[i].field, field) == 0)
            return options[i].option;
    return field;
}

static const struct {
    const char *function, *command;
} commands[] = {
    {"fst_param_at()", "festoon schema"},        {"fst_lyapunov_find()", "festoon lyapunov"},
    {"fst_locked_find()", "festoon locked"},     {"fst_sweep_export()", "festoon export"},
    {"fst_sweep()", "festoon sweep -o FILE.db"}, {"fst_branch_write()", "festoon branch -o FILE.json"},
    {"fst_run_json()", "festoon run --json"},    {"fst_track_options.scale", "--scale"},
    {"fst_measure_options.drive", "--drive"},
};

void name_commands(const char *sentence, char *text, size_t size)
{
    size_t length = 0;
    for (const char *at = sentence; *at && length + 1 < size;) {
        size_t row = 0;
        while (row < sizeof commands / sizeof *commands &&
               strncmp(at, commands[row].function, strlen(commands[row].function)) != 0)
            ++row;
        if (row < sizeof commands / sizeof *commands) {
            (void)snprintf(text + length, size - length, "%s", commands[row].command);
            length += strlen(text + length);
            at += strlen(commands[row].function);
        } else {
            text[length++] = *at++;
        }
    }
    text[length] = '\0';
}
