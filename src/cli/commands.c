/* commands.c - the table of commands: a new command is a file of its own and a word here. */
#include <string.h>

#include "cli/command.h"

const command *const all_commands[] = {
    &run_command,      &sweep_command,   &merge_command,
    &export_command,   &field_command,   &orbit_command,
    &locked_command,   &branch_command,  &lyapunov_command,
    &critical_command, &plot_command,    &movie_command,
    &paper_command,    &init_command,    &check_command,
    &schema_command,   &measure_command, &track_command,
    &fit_command,      &lab_command,     NULL,
};

const command *find_command(const char *name)
{
    for (const command *const *row = all_commands; *row; ++row)
        if (strcmp((*row)->name, name) == 0)
            return *row;
    return NULL;
}
