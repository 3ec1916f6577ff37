/* lab.c - festoon lab: the page of the lab with a scene in its address, opened on a desktop. */
#include "cli/command.h"

static const option options[] = {
    SCENE_OPTIONS,
    {"print", 'p', NULL, "print the address of the page, and open nothing"},
    {NULL, '\0', NULL, NULL},
};

static fst_status perform(const arguments *given, FILE *out, fst_error *error)
{
    fst_params params;
    fst_model *model = NULL;
    char address[FST_LAB_ADDRESS_SIZE];
    int opened = 0;
    fst_status status = read_scene(given, operand(given), &params, error);
    if (status == FST_OK) /* as it must be, and with a map where it names one */
        status = fst_field_model_new(&params, NAN, &model, error);
    fst_model_free(model);
    if (status == FST_OK)
        status = fst_lab_address(&params, address, error);
    if (status == FST_OK && !option_value(given, "print"))
        status = fst_lab_open(address, &opened, error);
    if (status != FST_OK)
        return status;
    (void)fprintf(out, "%s\n", address);
    if (!opened && !option_value(given, "print"))
        (void)fprintf(stderr, "festoon lab: there is no desktop here; open this address in a browser\n");
    return FST_OK;
}

const command lab_command = {
    .name = "lab",
    .synopsis = "[SCENE.yaml] [--print]",
    .summary = "Open the lab, a page on which the bead is seen rolling, with a scene",
    .details =
        "The page is festoon-lab.html, which make lab builds: one file that needs no network and no server.\n"
        "Where there is no desktop its address is printed alone.\n",
    .options = options,
    .most_operands = 1,
    .perform = perform,
};
