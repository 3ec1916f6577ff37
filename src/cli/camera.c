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
        return fail(error, FST_BAD_INPUT, "--size", "\"%.40s\" is no size: write it as 720x720", text);
    *width = (int)across;
    *height = (int)down;
    return FST_OK;
}

/* The options that are times, lengths, angles and numbers. */
static fst_status read_values(const arguments *given, fst_camera_options *camera, fst_error *error)
{
    enum { TIME = -1 };
    const struct {
        const char *name;
        int unit; /* of fst_unit, or TIME */
        double *value;
    } values[] = {
        {"fps", FST_UNIT_NUMBER, &camera->fps},         {"stored-fps", FST_UNIT_NUMBER, &camera->stored_fps},
        {"from", FST_UNIT_NUMBER, &camera->from},       {"to", FST_UNIT_NUMBER, &camera->to},
        {"exposure", TIME, &camera->exposure},          {"readout", TIME, &camera->readout},
        {"noise", FST_UNIT_NUMBER, &camera->noise},     {"uneven", FST_UNIT_NUMBER, &camera->uneven},
        {"flicker", FST_UNIT_NUMBER, &camera->flicker}, {"tilt", FST_UNIT_ANGLE, &camera->tilt},
        {"side", FST_UNIT_ANGLE, &camera->side},        {"distance", FST_UNIT_LENGTH, &camera->distance},
        {"plate", FST_UNIT_LENGTH, &camera->plate}};
    for (size_t i = 0; i < sizeof values / sizeof *values; ++i) {
        char name[32];
        const char *text = option_value(given, values[i].name);
        if (!text)
            continue;
        (void)snprintf(name, sizeof name, "--%s", values[i].name);
        fst_status status = FST_OK;
        if (values[i].unit == TIME)
            status = read_time(name, text, values[i].value, error);
        else if (values[i].unit == FST_UNIT_NUMBER)
            status = read_numbers(name, text, values[i].value, 1, error);
        else if ((status = fst_parse_value(text, (fst_unit)values[i].unit, values[i].value, error)) != FST_OK)
            (void)snprintf(error->where, sizeof error->where, "%s", name);
        if (status != FST_OK)
            return status;
    }
    return FST_OK;
}

/* The options that are whole numbers. */
static fst_status read_whole_numbers(const arguments *given, fst_camera_options *camera, fst_error *error)
{
    double quality = camera->quality, drop = camera->drop, seed = (double)camera->seed;
    const struct {
        const char *name;
        double *value;
    } values[] = {{"quality", &quality}, {"drop", &drop}, {"seed", &seed}};
    for (size_t i = 0; i < sizeof values / sizeof *values; ++i) {
        char name[32];
        const char *text = option_value(given, values[i].name);
        if (!text)
            continue;
        (void)snprintf(name, sizeof name, "--%s", values[i].name);
        const fst_status status = read_numbers(name, text, values[i].value, 1, error);
        if (status != FST_OK)
            return status;
        if (!(*values[i].value >= 0.0 && *values[i].value <= 1e9 &&
              *values[i].value == floor(*values[i].value)))
            return fail(error, FST_BAD_INPUT, name, "\"%.40s\" must be a whole number, 0 or more", text);
    }
    camera->quality = (int)quality;
    camera->drop = (int)drop;
    camera->seed = (uint64_t)seed;
    return FST_OK;
}

fst_status read_camera(const arguments *given, fst_camera_options *camera, fst_error *error)
{
    *camera = fst_default_camera_options();
    const char *size = option_value(given, "size");
    fst_status status = size ? read_size(size, &camera->width, &camera->height, error) : FST_OK;
    if (status == FST_OK)
        status = read_values(given, camera, error);
    if (status == FST_OK)
        status = read_whole_numbers(given, camera, error);
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

fst_status film_by_camera(const fst_table *table, const char *to, const fst_camera_options *camera, FILE *out,
                          fst_error *error)
{
    char truth[4096];
    fst_camera_facts facts;
    fst_status status = name_truth(to, truth, sizeof truth, error);
    if (status == FST_OK)
        status = fst_camera_film(table, to, truth, camera, &facts, error);
    if (status == FST_OK)
        print_facts(camera, &facts, out);
    return status;
}
