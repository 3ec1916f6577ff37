/* camera.h - festoon movie --camera, which shares the command with films of another kind. */
#ifndef FST_CLI_CAMERA_H
#define FST_CLI_CAMERA_H

#include "cli/command.h"

#include <festoon/bead_files.h>

/* The options of films by a camera alone. */
#define CAMERA_OPTIONS                                                                                         \
    {"camera", '\0', NULL, "a film as a camera over the plate takes it, with the truth in FILM.truth.csv"},    \
        {"exposure", '\0', "T", "camera: how long a row is exposed, as 1/500s or 2ms (1ms)"},                  \
        {"noise", '\0', "LEVELS", "camera: deviation of a pixel in gray levels of 255 (2)"},                   \
        {"tilt", '\0', "ANGLE", "camera: its angle off the vertical (5deg)"},                                  \
        {"distance", '\0', "LENGTH", "camera: from the middle of the plate (1.5 plates)"},                     \
        {"plate", '\0', "LENGTH", "camera: diameter of the plate (what the motion needs)"},                    \
        {"marks", '\0', "MARKS",                                                                               \
         "camera: black paint on a coated bead, half or dots; the truth then tells how it turns (none)"},      \
        SEED_OPTION,                                                                                           \
        {"readout", EXPERT, "T", "camera: from the first row to the last, a rolling shutter (3ms)"},           \
        {"uneven", EXPERT, "PART", "camera: how much darker the darkest corner is (0.2)"},                     \
        {"flicker", EXPERT, "PART", "camera: how much lamps at 100 Hz flicker (0)"},                           \
        {"side", EXPERT, "ANGLE", "camera: where it stands, from the x axis (-90deg: at the lower edge)"},     \
        {"quality", EXPERT, "N", "camera: compression, from 0, lossless, to 51 (23)"},                         \
        {"drop", EXPERT, "N", "camera: it loses every Nth frame, so that the times jump"},                     \
    {                                                                                                          \
        "stored-fps", EXPERT, "F", "camera: frames a second that the film claims (the truth)"                  \
    }

/* Whether one of these options was given; its name, or NULL. */
const char *camera_option(const arguments *given);

/* Read these options, and --size, --fps, --from and --to. */
fst_status read_camera(const arguments *given, fst_camera_options *camera, fst_error *error);

/* Film the trajectory, or where `beads` is given that of a list, and print what the film shows. */
fst_status film_by_camera(const fst_table *table, const fst_beads_table *beads, const char *to,
                          const fst_camera_options *camera, FILE *out, fst_error *error);

/* Read --size. */
fst_status read_size(const char *text, int *width, int *height, fst_error *error);

#endif
