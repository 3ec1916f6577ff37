/* init.c - festoon init: a commented scene to begin with. */
#include <string.h>
#include <sys/stat.h>

#include "cli/command.h"

#define DEFAULT_FILE "festoon.yaml"

/* The scenes of examples/worlds (src/CMakeLists.txt): "|bowl|levitation...", and their texts. */
static const char world_list[] =
#define WORLD(name, text) "|" #name
#include "cli/worlds.def"
#undef WORLD
    ;
#define world_names (&world_list[1])
static const char *const world_texts[] = {
#define WORLD(name, text) text,
#include "cli/worlds.def"
#undef WORLD
};

static const option options[] = {
    SCENE_OPTIONS,
    {"world", '\0', world_names, "a short scene of such a world with comments, in place of every parameter"},
    {"force", 'f', NULL, "overwrite FILE if it is there"},
    {NULL, '\0', NULL, NULL},
};

static fst_status perform(const arguments *given, FILE *out, fst_error *error)
{
    fst_params params;
    const char *path = operand(given) ? operand(given) : DEFAULT_FILE;
    const char *world = option_value(given, "world");
    int place = 0;
    fst_status status = world ? read_choice("--world", world, "world", world_names, &place, error)
                              : read_scene(given, NULL, &params, error);
    if (status == FST_OK && world && option_value(given, "set"))
        status = fail(error, FST_BAD_INPUT, "", "--set is not for --world: change the scene that it writes");
    if (status == FST_OK && !world && (params.bead_count || fst_key_of_world(&params)))
        status = check_world(&params, error);
    if (status != FST_OK)
        return status;
    if (strcmp(path, "-") == 0 && world)
        return fputs(world_texts[place], out) < 0 ? fail(error, FST_IO, "", "cannot write") : FST_OK;
    if (strcmp(path, "-") == 0)
        return print_and_free(fst_scene_text(&params, 1), out, error);
    const int force = option_value(given, "force") != NULL;
    struct stat there;
    if (!force && stat(path, &there) == 0)
        return fail(error, FST_BAD_INPUT, path,
                    S_ISDIR(there.st_mode) ? "this is a directory: expected the name of a file"
                                           : "this file is there already; --force overwrites it");
    status = world ? fst_file_write(path, world_texts[place], strlen(world_texts[place]), error)
                   : fst_scene_write(path, &params, 1, force, error);
    char text[SHOWN_SIZE], remark[SHOWN_SIZE + 40];
    (void)snprintf(remark, sizeof remark, "; run it with: festoon run %s", shown(path, text));
    if (status == FST_OK)
        tell_written(path, remark);
    return status;
}

const command init_command = {
    .name = "init",
    .synopsis = "[FILE] [--world WORLD] [--force]",
    .summary = "Write a scene with every parameter and a comment on each",
    .details = "FILE is " DEFAULT_FILE " unless given; - writes to standard output.\n",
    .options = options,
    .most_operands = 1,
    .perform = perform,
};
