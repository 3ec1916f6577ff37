/* schema.c - festoon schema: the table of all parameters. */
#include <stdlib.h>
#include <string.h>

#include "cli/command.h"

static const option options[] = {JSON_OPTION, {NULL, '\0', NULL, NULL}};

/* "1e-07 to 1 m", or the choices. */
static void print_limits(FILE *out, const fst_param_info *info)
{
    const char *accepted = fst_unit_accepted(info->unit);
    if (info->kind == FST_KIND_CHOICE)
        (void)fprintf(out, "      one of %s\n", info->names);
    else if (info->kind == FST_KIND_TEXT)
        (void)fprintf(out, "      a text of at most %g bytes\n", info->greatest);
    else
        (void)fprintf(out, "      %s%g to %g%s%s%s%s\n", info->kind == FST_KIND_INT ? "integer, " : "",
                      info->least, info->greatest, accepted[0] ? " " : "",
                      accepted[0] ? fst_unit_name(info->unit) : "", accepted[0] ? "; units: " : "", accepted);
}

/* The keys that only experts need, or the others. */
static void print_table(FILE *out, int expert)
{
    const fst_params defaults = fst_default_params();
    for (int i = 0; i < fst_param_count(); ++i) {
        const fst_param_info *info = fst_param_at(i);
        char value[64];
        if ((fst_name_place(info->key, FST_EXPERT_KEYS) >= 0) != expert)
            continue;
        (void)fst_params_get(&defaults, i, value, sizeof value);
        int with_unit = value[0] && fst_unit_accepted(info->unit)[0];
        (void)fprintf(out, "%-20s %s%s%s\n", info->key, value[0] ? value : "(not given)", with_unit ? " " : "",
                      with_unit ? fst_unit_name(info->unit) : "");
        print_limits(out, info);
        (void)fprintf(out, "      %s\n", info->doc);
    }
}

/* The numbers of a part, which are the same of each: those of part 0. */
static void print_part(FILE *out)
{
    (void)fprintf(out,
                  "\nOf each part of a magnet of shape parts, N from 0 to %d; scenes list them (festoon init "
                  "shows how):\n",
                  FST_PARTS_MAX - 1);
    for (int i = fst_param_count(); fst_param_part(i) == 0; ++i) {
        const fst_param_info *info = fst_param_at(i);
        (void)fprintf(out, "magnet.parts[N]%s\n", strchr(info->key, ']') + 1);
        print_limits(out, info);
        (void)fprintf(out, "      %s\n", info->doc);
    }
}

/* Vectors, and what a bead of a list may say. */
static void print_lists(FILE *out)
{
    (void)fprintf(out, "\nVectors; a scene writes them as lists (position: [20 mm, 0, 2.5 mm]):\n");
    for (int i = fst_param_count(); fst_param_coil(i) < 0; ++i) {
        const fst_param_info *info = fst_param_at(i);
        if (fst_param_part(i) >= 0)
            continue;
        (void)fprintf(out, "%s\n", info->key);
        print_limits(out, info);
        (void)fprintf(out, "      %s\n", info->doc);
    }
    (void)fprintf(
        out,
        "\nOf each coil, N from 0 to %d; scenes list them (coils: [{radius: 5 cm, turns: 100, current: 1 "
        "A}]):\n",
        FST_COILS_MAX - 1);
    for (int i = fst_param_find("coils[0].radius"); fst_param_coil(i) == 0; ++i) {
        const fst_param_info *info = fst_param_at(i);
        (void)fprintf(out, "coils[N]%s\n", strchr(info->key, ']') + 1);
        print_limits(out, info);
        (void)fprintf(out, "      %s\n", info->doc);
    }
    (void)fprintf(
        out,
        "\nOf each bead of a list, N from 0 to %d; what a bead does not say, the keys above say for it.  A "
        "scene lists them (beads: [{start.phi: 3 deg}, {start.phi: 183 deg, radius: 2 mm}]):\n",
        FST_BEADS_MOST - 1);
    for (int i = fst_param_count(); fst_param_bead(i) < 1; ++i)
        if (fst_param_bead(i) == 0)
            (void)fprintf(out, "beads[N]%s\n", strchr(fst_param_at(i)->key, ']') + 1);
}

static fst_status perform(const arguments *given, FILE *out, fst_error *error)
{
    if (option_value(given, "json"))
        return print_and_free(fst_schema_json(), out, error);
    print_table(out, 0);
    print_part(out);
    print_lists(out);
    (void)fputs("\nExpert:\n", out);
    print_table(out, 1);
    return FST_OK;
}

const command schema_command = {
    .name = "schema",
    .synopsis = "[--json]",
    .summary = "List all parameters: key, default, range, units, what it is",
    .details = "",
    .options = options,
    .perform = perform,
};
