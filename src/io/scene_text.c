/* scene_text.c - writing scenes: parameters as YAML that fst_scene_parse() reads back to the same bits. */
#include <festoon/festoon_tools.h>

#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "base/error.h"
#include "base/units.h"
#include "host/whole_file.h"

/* The width of a comment line. */
#define WIDTH 100

/* Write a doc as comment lines, broken between words. */
static void write_comment(FILE *out, const char *text)
{
    while (*text) {
        size_t length = strlen(text);
        if (length > WIDTH) {
            length = WIDTH;
            while (length > 0 && text[length] != ' ')
                --length;
            if (length == 0)
                length = strcspn(text, " ");
        }
        (void)fprintf(out, "  # %.*s\n", (int)length, text);
        text += length;
        text += strspn(text, " ");
    }
}

/* "0.0001 mm to 1000 mm; um mm cm m", or the choices. */
static void write_limits(FILE *out, const fst_param_info *info)
{
    if (info->kind == FST_KIND_CHOICE) {
        (void)fprintf(out, "  # one of: %s\n", info->names);
        return;
    }
    if (info->kind == FST_KIND_TEXT) {
        (void)fprintf(out, "  # a text of at most %g bytes\n", info->greatest);
        return;
    }
    char least[64], greatest[64];
    const char *accepted = fst_unit_accepted(info->unit);
    (void)fst_value_write(least, sizeof least, info->least, info->unit);
    (void)fst_value_write(greatest, sizeof greatest, info->greatest, info->unit);
    (void)fprintf(out, "  # %s%s to %s", info->kind == FST_KIND_INT ? "integer, " : "", least, greatest);
    if (accepted[0])
        (void)fprintf(out, "; units: %s; bare numbers are in %s", accepted, fst_unit_name(info->unit));
    (void)fprintf(out, "\n");
}

/* Room for a text in quotes of which every byte is escaped. */
enum { VALUE_SIZE = 2 * FST_PARAM_TEXT_SIZE + 3 };

/* A text in YAML's double quotes, in which nothing but these two has a meaning. */
static void quote(char text[VALUE_SIZE])
{
    char plain[FST_PARAM_TEXT_SIZE], *to = text;
    (void)snprintf(plain, sizeof plain, "%s", text);
    *to++ = '"';
    for (const char *from = plain; *from; ++from) {
        if (*from == '"' || *from == '\\')
            *to++ = '\\';
        *to++ = *from;
    }
    *to++ = '"';
    *to = '\0';
}

/* Write a value as people write it: numbers in their customary unit. */
static void value_text(const fst_params *params, int index, char text[VALUE_SIZE])
{
    const fst_param_info *info = fst_param_at(index);
    int length = fst_params_get(params, index, text, FST_PARAM_TEXT_SIZE);
    if (length > 0 && info->kind == FST_KIND_TEXT)
        quote(text);
    if (length == 0 || info->kind != FST_KIND_REAL)
        return;
    double value;
    memcpy(&value, (const char *)params + info->offset, sizeof value);
    (void)fst_value_write(text, VALUE_SIZE, value, info->unit);
}

/* Whether any key of the group that begins at a parameter has a value. */
static int group_has_value(const fst_params *params, int index, size_t group_length)
{
    const char *group = fst_param_at(index)->key;
    char value[VALUE_SIZE];
    for (int i = index; i < fst_param_count(); ++i)
        if (strncmp(fst_param_at(i)->key, group, group_length + 1) == 0) {
            value_text(params, i, value);
            if (value[0])
                return 1;
        }
    return 0;
}

/* "size: [56 mm, 40 mm, 9 mm]": the numbers of a part under one key, from a row on; nothing where the kind of
 * part has none, and for a part that is not turned.  Returns how many rows that were. */
static int write_part_numbers(FILE *out, const fst_params *params, int row)
{
    const char *key = strrchr(fst_param_at(row)->key, '.') + 1;
    const size_t length = strcspn(key, "[");
    const fst_magnet_part *part = &params->magnet_parts[fst_param_part(row)];
    const double *turn = part->rotation;
    const int stays = turn[0] == 0.0 && turn[1] == 0.0 && turn[2] == 0.0 && turn[3] == 0.0;
    const int silent = strncmp(key, "rotation", length) == 0 && stays;
    char value[VALUE_SIZE];
    int count = 0, written = 0;
    for (; fst_param_part(row + count) >= 0; ++count) {
        if (strncmp(key, strrchr(fst_param_at(row + count)->key, '.') + 1, length + 1) != 0)
            break;
        value_text(params, row + count, value);
        if (!value[0] || silent)
            continue;
        if (written++)
            (void)fprintf(out, ", %s", value);
        else
            (void)fprintf(out, "      %.*s: [%s", (int)length, key, value);
    }
    (void)fputs(written ? "]\n" : "", out);
    return count;
}

/* The list of parts, below the group `magnet`. */
static void write_parts(FILE *out, const fst_params *params)
{
    char kind[32];
    if (params->magnet_part_count)
        (void)fputs("  parts:\n", out);
    for (int row = fst_param_count();
         fst_param_part(row) >= 0 && fst_param_part(row) < params->magnet_part_count;) {
        if (fst_param_at(row)->kind == FST_KIND_CHOICE) {
            const char *name = strrchr(fst_param_at(row)->key, '.') + 1;
            const int begins = strcmp(name, "kind") == 0;
            (void)fst_params_get(params, row, kind, sizeof kind);
            if (begins || params->magnet_parts[fst_param_part(row)].motion != FST_PART_TURNING)
                (void)fprintf(out, "    %s %s: %s\n", begins ? "-" : " ", name, kind);
            ++row;
        } else {
            row += write_part_numbers(out, params, row);
        }
    }
}

static const char parts_example[] =
    "  # The bodies of a magnet of shape parts, at most 16: kind cuboid, cylinder, sphere or dipole.\n"
    "  # Axes from the axis of rotation at the reference plane, z up. size: three edges; diameter and height;\n"
    "  # diameter. A dipole has a moment in place of size and remanence. rotation: degrees, axis (optional).\n"
    "  # parts:\n"
    "  #   - kind: cuboid\n"
    "  #     centre: [0 mm, 0 mm, 0 mm]\n"
    "  #     size: [56 mm, 40 mm, 9 mm]\n"
    "  #     remanence: [1.2 T, 0 T, 0 T]\n"
    "  #     rotation: [0 deg, 0, 0, 1]\n"
    "  #     motion: turning\n";

/* Vectors and coils, as far as they are given, below all groups. */
static void write_lists(FILE *out, const fst_params *params)
{
    const fst_params usual = fst_default_params();
    char value[VALUE_SIZE], initial[VALUE_SIZE];
    for (int i = fst_param_count(); i < fst_params_row_count(params); ++i) {
        if (fst_param_part(i) >= 0 || fst_param_bead(i) >= 0)
            continue;
        value_text(params, i, value);
        value_text(&usual, i, initial);
        if (value[0] && strcmp(value, initial) != 0)
            (void)fprintf(out, "%s: %s\n", fst_param_at(i)->key, value);
    }
}

static const char beads_example[] =
    "\n# Several beads, each with what it says of its own: keys of bead and start.\n"
    "# beads:\n"
    "#   - start.phi: 3 deg\n"
    "#   - start.phi: 183 deg\n";

/* One bead of the list, which is the first of `alone`: what it says of its own, key by key. */
static void write_bead(FILE *out, const fst_params *alone)
{
    char value[VALUE_SIZE];
    int said = 0;
    for (int i = fst_param_count(); i < fst_params_row_count(alone); ++i) {
        if (fst_param_bead(i) < 0)
            continue;
        value_text(alone, i, value);
        if (value[0])
            (void)fprintf(out, "  %s %s: %s\n", said++ ? " " : "-", strchr(fst_param_at(i)->key, ']') + 2,
                          value);
    }
    (void)fputs(said ? "" : "  - {}\n", out);
}

static void write_beads(FILE *out, const fst_params *params, int commented)
{
    fst_params alone = fst_default_params();
    if (commented && !params->bead_count)
        (void)fputs(beads_example, out);
    if (params->bead_count)
        (void)fputs("beads:\n", out);
    alone.bead_count = 1;
    for (int bead = 0; bead < params->bead_count; ++bead) {
        alone.beads[0] = params->bead_count > FST_BEADS_MOST ? params->bead_list[bead] : params->beads[bead];
        write_bead(out, &alone);
    }
}

/* What stands behind the keys of the group that ends. */
static void end_group(FILE *out, const fst_params *params, const char *group, int commented)
{
    if (strcmp(group, "magnet") != 0)
        return;
    if (commented)
        (void)fputs(parts_example, out);
    write_parts(out, params);
}

/* Whether kappa was given, also by a program that wrote it into the struct.  One that nobody gave stays so in a scene that
 * people edit: it belongs to the default's bead alone. */
static int kappa_is_given(const fst_params *params)
{
    fst_params settled = *params;
    return fst_params_settle(&settled, NULL) != FST_OK || settled.notes.kappa_given;
}

static void write_scene(FILE *out, const fst_params *params, int commented)
{
    char group[32] = "", value[VALUE_SIZE];
    if (commented)
        (void)fprintf(out,
                      "# A festoon scene.  A line that is missing keeps its default.\n"
                      "# festoon schema lists all keys, festoon check reads a scene without running it.\n");
    for (int i = 0; i < fst_param_count(); ++i) {
        const fst_param_info *info = fst_param_at(i);
        size_t group_length = strcspn(info->key, ".");
        value_text(params, i, value);
        if (!value[0] && !commented)
            continue;
        if (strncmp(group, info->key, group_length) != 0 || group[group_length]) {
            end_group(out, params, group, commented);
            (void)snprintf(group, sizeof group, "%.*s", (int)group_length, info->key);
            /* YAML wants something below a key: a group without a value is a comment itself. */
            (void)fprintf(out, "%s%s%s:\n", commented ? "\n" : "",
                          group_has_value(params, i, group_length) ? "" : "# ", group);
        }
        if (commented) {
            write_comment(out, info->doc);
            write_limits(out, info);
        }
        const char *name = info->key + group_length + 1;
        const int given = strcmp(info->key, "model.kappa") != 0 || !commented || kappa_is_given(params);
        (void)fprintf(out, "  %s%s:%s%s\n", value[0] && given ? "" : "# ", name, value[0] ? " " : "", value);
    }
    write_lists(out, params);
    write_beads(out, params, commented);
}

char *fst_scene_text(const fst_params *params, int commented)
{
    fst_printed printed;
    FILE *out = fst_print_begin(&printed);
    if (!out)
        return NULL;
    write_scene(out, params, commented);
    return fst_print_end(&printed);
}

fst_status fst_scene_write(const char *path, const fst_params *params, int commented, int overwrite,
                           fst_error *error)
{
    if (!overwrite && access(path, F_OK) == 0)
        return fst_fail(error, FST_BAD_INPUT, path, "this file is there already");
    char *text = fst_scene_text(params, commented);
    if (!text)
        return fst_fail(error, FST_NO_MEMORY, path, "out of memory");
    fst_whole_file file;
    fst_status status = fst_whole_file_open(&file, path, error);
    if (status == FST_OK) {
        (void)fputs(text, file.stream); /* a failure is seen at the commit */
        status = fst_whole_file_commit(&file, error);
    }
    free(text);
    return status;
}
