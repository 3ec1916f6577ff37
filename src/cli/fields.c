/* fields.c - the library's names in its errors, and what a person types for them. */
#include "cli/fields.h"

#include <stdio.h>
#include <string.h>

/* What is not called as a field of options is. */
static const struct {
    const char *field, *option;
} options[] = {
    {"fst_figure_sweep", "plot"},
    {"fst_grid.axes", "--over"},
    {"fst_sweep_options.checkpoint_seconds", "--checkpoint"},
    {"fst_sweep_export.out", "-o"},
    {"fst_sweep_read.keys", "--quantity"},
    {"fst_sweep_figure.keys", "--quantity"},
    {"fst_sweep_figure.at", "--only"},
    {"fst_sweep_figure.kind", "--kind"},
    {"fst_figure_over", "plot"},
    {"fst_sweep_export_keys.keys", "--quantity"},
    {"fst_figure_sweep.units", "--units"},
    {"fst_figure_branch.units", "--units"},
    {"fst_figure_branch.observable", "--quantity"},
    {"fst_figure_measurement.compare", "--compare"},
    {"fst_festoons_find.festoons", "--festoons"},
    {"fst_figure_options.keys", "--quantity"},
    {"fst_figure_options.colour", "--quantity"},
    {"fst_film_options.colour", "--quantity"},
    {"fst_film_options.width", "--size"},
    {"fst_film_options.seconds_per_turn", "--turn"},
    {"fst_camera_options.width", "--size"},
    {"fst_branch_options.key", "--over"},
    {"fst_branch_options.from", "--over"},
    {"fst_branch_options.longest_step", "--step"},
    {"fst_branch_options.second_key", "--with"},
    {"fst_branch_options.second_from", "--with"},
    {"fst_branch_options.special", "--follow"},
};

const char *option_of_field(const char *field, char text[FIELD_SIZE])
{
    static const char of_options[] = "_options.";
    const char *member = strstr(field, of_options);
    if (strncmp(field, "fst_", 4) != 0)
        return field;
    for (size_t i = 0; i < sizeof options / sizeof *options; ++i)
        if (strcmp(options[i].field, field) == 0)
            return options[i].option;
    if (!member) /* the name of a function says nothing to a person; a file may begin so too */
        return field[strspn(field, "abcdefghijklmnopqrstuvwxyz_")] ? field : "";
    (void)snprintf(text, FIELD_SIZE, "--%.60s", member + sizeof of_options - 1);
    for (char *at = text; *at; ++at)
        if (*at == '_')
            *at = '-';
    return text;
}

static const struct {
    const char *function, *command;
} commands[] = {
    {"fst_param_at()", "festoon schema"},
    {"fst_lyapunov_find()", "festoon lyapunov"},
    {"fst_locked_find()", "festoon locked"},
    {"fst_sweep_export()", "festoon export"},
    {"fst_sweep()", "festoon sweep -o FILE.db"},
    {"fst_branch_write()", "festoon branch -o FILE.json"},
    {"fst_run_json()", "festoon run --json"},
    {"fst_track_options.scale", "--scale"},
    {"fst_track_options.from", "--from"},
    {"fst_track_options.to", "--to"},
    {"fst_measure_options.drive", "--drive"},
    {"fst_sweep_figure.at", "--only KEY=VALUE"},
    {"fst_branch_follow()", "festoon branch --kind counter --over drive.frequency=LO:HI"},
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
