/* movie.c - festoon movie: a trajectory as a film. */
#include <stdlib.h>
#include <string.h>

#include "cli/command.h"
#include "cli/terminal.h"

static const option options[] = {
    {"output", 'o', "FILM", "FILM.mp4, FILM.gif, or a folder for PNG frames (a name without an ending)"},
    {"size", '\0', "WxH", "pixels, both even (720x720)"},
    {"fps", '\0', "F", "frames a second (30)"},
    {"turn", '\0', "S", "seconds of film for a turn of the magnet (1)"},
    {"from", '\0', "P", "first drive period shown (the beginning)"},
    {"to", '\0', "P", "last drive period shown (20 after the first)"},
    {"colour", '\0', "COLUMN", "the column that colours the trail: slip, n_z, angle, ..."},
    UNITS_OPTION,
    {NULL, '\0', NULL, NULL},
};

static fst_status read_size(const char *text, fst_film_options *film, fst_error *error)
{
    char *end;
    long width = strtol(text, &end, 10), height = *end == 'x' ? strtol(end + 1, &end, 10) : 0;
    if (*end || width < 1 || height < 1 || width > 100000 || height > 100000)
        return fail(error, FST_BAD_INPUT, "--size", "\"%.40s\" is no size: write it as 720x720", text);
    film->width = (int)width;
    film->height = (int)height;
    return FST_OK;
}

static fst_status read_film(const arguments *given, fst_film_options *film, fst_error *error)
{
    *film = fst_default_film_options();
    film->colour = option_value(given, "colour");
    const char *size = option_value(given, "size");
    const struct {
        const char *name;
        double *value;
    } numbers[] = {
        {"fps", &film->fps}, {"turn", &film->seconds_per_turn}, {"from", &film->from}, {"to", &film->to}};
    fst_status status = read_units(given, &film->units, error);
    if (status == FST_OK && size)
        status = read_size(size, film, error);
    for (size_t i = 0; i < sizeof numbers / sizeof numbers[0] && status == FST_OK; ++i) {
        char name[16];
        (void)snprintf(name, sizeof name, "--%s", numbers[i].name);
        const char *text = option_value(given, numbers[i].name);
        if (text)
            status = read_numbers(name, text, numbers[i].value, 1, error);
    }
    if (status == FST_OK && !isnan(film->from) && !isnan(film->to) && !(film->from < film->to))
        status = fail(error, FST_BAD_INPUT, "--to", "it must be greater than --from");
    return status;
}

static fst_status perform(const arguments *given, FILE *out, fst_error *error)
{
    (void)out;
    enum { USUAL_PERIODS = 20 };
    fst_film_options film;
    fst_table table;
    progress_line line;
    const fst_progress progress = {&line, progress_tell};
    const char *path = operand(given), *to = option_value(given, "output");
    if (!path)
        return fail(error, FST_BAD_INPUT, "", "a trajectory is missing: make one with festoon run -o FILE.h5");
    if (!to)
        return fail(error, FST_BAD_INPUT, "", "say where the film goes: -o FILM.mp4");
    fst_status status = read_film(given, &film, error);
    if (status == FST_OK)
        status = fst_trajectory_read(path, &table, error);
    if (status != FST_OK)
        return status;
    if (isnan(film.to))
        film.to = (isnan(film.from) ? 0.0 : film.from) + USUAL_PERIODS;
    progress_begin(&line);
    film.progress = &progress;
    status = fst_film(&table, to, &film, error);
    progress_end(&line);
    if (status == FST_OK)
        tell_written(to, table.complete ? "" : " (of an interrupted run)");
    fst_table_free(&table);
    return status;
}

const command movie_command = {
    .name = "movie",
    .synopsis = "FILE.(h5|csv) -o FILM.(mp4|gif)|FOLDER [options]",
    .summary = "Make a film of a trajectory that run -o or run --csv wrote",
    .details = "",
    .options = options,
    .most_operands = 1,
    .has_helpers = 1,
    .perform = perform,
};
