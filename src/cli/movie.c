/* movie.c - festoon movie: a trajectory as a film, drawn or as a camera takes it. */
#include <stdlib.h>
#include <string.h>

#include "cli/camera.h"
#include "cli/command.h"
#include "cli/terminal.h"

static const option options[] = {
    {"output", 'o', "FILM",
     "FILM.mp4, FILM.gif, or a folder for frames (a name without an ending); camera: FILM.mov too"},
    {"size", '\0', "WxH", "pixels, both even (720x720; camera: 1280x720)"},
    {"fps", '\0', "F", "frames a second (30; camera: 240)"},
    {"turn", '\0', "S", "seconds of film for a turn of the magnet (1)"},
    {"from", '\0', "P", "first drive period shown (the beginning)"},
    {"to", '\0', "P", "last drive period shown (20 after the first; camera: the last)"},
    {"quantity", '\0', "COLUMN", "the column that colours the trail of one bead: slip, n_z, angle, ..."},
    CAMERA_OPTIONS,
    UNITS_OPTION,
    {NULL, '\0', NULL, NULL},
};

static fst_status read_film(const arguments *given, fst_film_options *film, fst_error *error)
{
    *film = fst_default_film_options();
    film->colour = option_value(given, "quantity");
    const char *size = option_value(given, "size");
    const value_option rows[] = {{"fps", FST_UNIT_NUMBER, &film->fps, 0, 0},
                                 {"turn", FST_UNIT_NUMBER, &film->seconds_per_turn, 0, 0},
                                 {"from", FST_UNIT_NUMBER, &film->from, 0, 0},
                                 {"to", FST_UNIT_NUMBER, &film->to, 0, 0}};
    fst_status status = read_units(given, &film->units, error);
    if (status == FST_OK && size)
        status = read_size(size, &film->width, &film->height, error);
    if (status == FST_OK)
        status = read_values(given, rows, sizeof rows / sizeof *rows, error);
    return status;
}

static fst_status check_range(double from, double to, fst_error *error)
{
    return isnan(from) || isnan(to) || from < to
               ? FST_OK
               : fail(error, FST_BAD_INPUT, "--to", "it must be greater than --from");
}

/* Options of one kind of film do not go with the other. */
static fst_status check_kind(const arguments *given, int camera, fst_error *error)
{
    static const char *const drawn[] = {"turn", "quantity"};
    const char *other = camera ? NULL : camera_option(given);
    for (size_t i = 0; i < sizeof drawn / sizeof *drawn && camera && !other; ++i)
        other = option_value(given, drawn[i]) ? drawn[i] : NULL;
    if (!other)
        return FST_OK;
    return camera ? fail(error, FST_BAD_INPUT, "", "--%s has no meaning with --camera", other)
                  : fail(error, FST_BAD_INPUT, "", "--%s needs --camera", other);
}

static fst_status perform(const arguments *given, FILE *out, fst_error *error)
{
    enum { USUAL_PERIODS = 20 };
    fst_film_options film;
    fst_camera_options camera;
    fst_table table = {.rows = 0};
    fst_beads_table beads = {.rows = 0};
    int listed = 0;
    progress_line line;
    const fst_progress progress = {&line, progress_tell};
    const char *path = operand(given), *to = option_value(given, "output");
    const int by_camera = option_value(given, "camera") != NULL;
    if (!path)
        return fail(error, FST_BAD_INPUT, "", "a trajectory is missing: make one with festoon run -o FILE.h5");
    if (!to)
        return fail(error, FST_BAD_INPUT, "", "say where the film goes: -o FILM.mp4");
    fst_status status = check_kind(given, by_camera, error);
    if (status == FST_OK)
        status = by_camera ? read_camera(given, &camera, error) : read_film(given, &film, error);
    if (status == FST_OK)
        status = check_range(by_camera ? camera.from : film.from, by_camera ? camera.to : film.to, error);
    if (status == FST_OK)
        status = fst_trajectory_has_beads(path, &listed, error);
    if (status == FST_OK)
        status =
            listed ? fst_beads_trajectory_read(path, &beads, error) : fst_trajectory_read(path, &table, error);
    if (status != FST_OK)
        return status;
    progress_begin(&line);
    if (by_camera) {
        camera.progress = &progress;
        status = film_by_camera(&table, listed ? &beads : NULL, to, &camera, out, error);
    } else {
        if (isnan(film.to))
            film.to = (isnan(film.from) ? 0.0 : film.from) + USUAL_PERIODS;
        film.progress = &progress;
        status = listed ? fst_film_beads(&beads, to, &film, error) : fst_film(&table, to, &film, error);
    }
    progress_end(&line);
    if (status == FST_OK)
        tell_written(to, table.complete || beads.complete ? "" : " (of an interrupted run)");
    fst_table_free(&table);
    fst_beads_table_free(&beads);
    return status;
}

const command movie_command = {
    .name = "movie",
    .synopsis = "FILE.(h5|csv) -o FILM.(mp4|gif)|FOLDER [--camera] [options]",
    .summary = "Make a film of a trajectory that run -o or run --csv wrote",
    .details = "With --camera the film is gray, as quick as the motion, and has what a camera adds; "
               "FILM.truth.csv tells where\n"
               "each bead was.  It is what festoon track can be tried on.\n",
    .options = options,
    .most_operands = 1,
    .has_helpers = 1,
    .perform = perform,
};
