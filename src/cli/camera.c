/* camera.c - festoon movie --camera: its options, and what it prints. */
#include "cli/camera.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

static const option rows[] = {CAMERA_OPTIONS, {NULL, '\0', NULL, NULL}};

const char *camera_option(const arguments *given)
{
    for (int i = 0; i < given->option_count; ++i)
        for (const option *row = rows; row->name; ++row)
            if (strcmp(given->options[i].row->name, row->name) == 0)
                return row->name;
    return NULL;
}

fst_status read_size(const char *text, int *width, int *height, fst_error *error)
{
    char *end;
    const long across = strtol(text, &end, 10), down = *end == 'x' ? strtol(end + 1, &end, 10) : 0;
    if (*end || across < 1 || down < 1 || across > 100000 || down > 100000)
        return fail(error, FST_BAD_INPUT, "--size", "\"%.40s\" is not a size: write it as 720x720", text);
    *width = (int)across;
    *height = (int)down;
    return FST_OK;
}

fst_status read_camera(const arguments *given, fst_camera_options *camera, fst_error *error)
{
    *camera = fst_default_camera_options();
    const char *size = option_value(given, "size");
    camera->marks = option_value(given, "marks");
    double quality = camera->quality, drop = camera->drop, seed = (double)camera->seed;
    const value_option values[] = {{"fps", FST_UNIT_NUMBER, &camera->fps, 0, 0},
                                   {"stored-fps", FST_UNIT_NUMBER, &camera->stored_fps, 0, 0},
                                   {"from", FST_UNIT_NUMBER, &camera->from, 0, 0},
                                   {"to", FST_UNIT_NUMBER, &camera->to, 0, 0},
                                   {"exposure", VALUE_TIME, &camera->exposure, 0, 0},
                                   {"readout", VALUE_TIME, &camera->readout, 0, 0},
                                   {"noise", FST_UNIT_NUMBER, &camera->noise, 0, 0},
                                   {"uneven", FST_UNIT_NUMBER, &camera->uneven, 0, 0},
                                   {"flicker", FST_UNIT_NUMBER, &camera->flicker, 0, 0},
                                   {"tilt", FST_UNIT_ANGLE, &camera->tilt, 0, 0},
                                   {"side", FST_UNIT_ANGLE, &camera->side, 0, 0},
                                   {"distance", FST_UNIT_LENGTH, &camera->distance, 0, 0},
                                   {"plate", FST_UNIT_LENGTH, &camera->plate, 0, 0},
                                   {"quality", VALUE_WHOLE, &quality, 0, 1e9},
                                   {"drop", VALUE_WHOLE, &drop, 0, 1e9},
                                   {"seed", VALUE_WHOLE, &seed, 0, 1e9}};
    fst_status status = size ? read_size(size, &camera->width, &camera->height, error) : FST_OK;
    if (status == FST_OK)
        status = read_values(given, values, sizeof values / sizeof *values, error);
    if (status == FST_OK) {
        camera->quality = (int)quality;
        camera->drop = (int)drop;
        camera->seed = (uint64_t)seed;
    }
    return status;
}

/* FILM.truth.csv of FILM.mp4, or FOLDER.truth.csv. */
static fst_status name_truth(const char *film, char *truth, size_t size, fst_error *error)
{
    const char *slash = strrchr(film, '/'), *name = slash ? slash + 1 : film, *dot = strrchr(name, '.');
    size_t length = dot && dot > name ? (size_t)(dot - film) : strlen(film);
    while (length > 1 && film[length - 1] == '/')
        --length;
    if (snprintf(truth, size, "%.*s.truth.csv", (int)length, film) >= (int)size)
        return fail(error, FST_BAD_INPUT, film, "the name is too long");
    return FST_OK;
}

static void print_facts(const fst_camera_options *camera, const fst_camera_facts *facts, FILE *out)
{
    (void)fprintf(out, "frames       %d of %d x %d pixels, %.6g a second, exposed for %.4g ms", facts->frames,
                  camera->width, camera->height, camera->fps, 1e3 * camera->exposure);
    if (facts->lost)
        (void)fprintf(out, "; %d were lost", facts->lost);
    (void)fprintf(out, "\nscale        %.4f mm a pixel in the middle, on the plate\n", 1e3 * facts->scale);
    (void)fprintf(out, "plate        \"plate %.6g mm\", seen from %.6g mm, tilted by %.4g degrees\n",
                  1e3 * facts->plate, 1e3 * facts->distance, camera->tilt);
    (void)fprintf(out, "marks        \"");
    for (int i = 0; i < 4; ++i)
        (void)fprintf(out, "%s%.1f,%.1f", i ? ":" : "", facts->marks[i][0], facts->marks[i][1]);
    (void)fprintf(out, "=%.6gmm\"\n", 1e3 * facts->square);
}

fst_status film_by_camera(const fst_table *table, const fst_beads_table *beads, const char *to,
                          const fst_camera_options *camera, FILE *out, fst_error *error)
{
    char truth[4096];
    fst_camera_facts facts;
    fst_status status = name_truth(to, truth, sizeof truth, error);
    if (status == FST_OK)
        status = beads ? fst_camera_film_beads(beads, to, truth, camera, &facts, error)
                       : fst_camera_film(table, to, truth, camera, &facts, error);
    if (status == FST_OK)
        print_facts(camera, &facts, out);
    return status;
}
