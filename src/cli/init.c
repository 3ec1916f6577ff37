/* init.c - festoon init: a commented scene to begin with. */
#include <string.h>
#include <sys/stat.h>

#include "cli/command.h"

#define DEFAULT_FILE "festoon.yaml"

static const option options[] = {
    SCENE_OPTIONS,
    {"force", 'f', NULL, "overwrite FILE if it is there"},
    {NULL, '\0', NULL, NULL},
};

static fst_status perform(const arguments *given, FILE *out, fst_error *error)
{
    fst_params params;
    const char *path = operand(given) ? operand(given) : DEFAULT_FILE;
    fst_status status = read_scene(given, NULL, &params, error);
    if (status != FST_OK)
        return status;
    if (strcmp(path, "-") == 0)
        return print_and_free(fst_scene_text(&params, 1), out, error);
    const int force = option_value(given, "force") != NULL;
    struct stat there;
    if (!force && stat(path, &there) == 0)
        return fail(error, FST_BAD_INPUT, path,
                    S_ISDIR(there.st_mode) ? "this is a directory: expected the name of a file"
                                           : "this file is there already; --force overwrites it");
    status = fst_scene_write(path, &params, 1, force, error);
    char text[SHOWN_SIZE], remark[SHOWN_SIZE + 40];
    (void)snprintf(remark, sizeof remark, "; run it with: festoon run %s", shown(path, text));
    if (status == FST_OK)
        tell_written(path, remark);
    return status;
}

const command init_command = {
    .name = "init",
    .synopsis = "[FILE] [--set KEY=VALUE]... [--force]",
    .summary = "Write a scene with every parameter and a comment on each",
    .details = "FILE is " DEFAULT_FILE " unless given; - writes to standard output.\n",
    .options = options,
    .most_operands = 1,
    .perform = perform,
};
