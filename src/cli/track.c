/* track.c - festoon track: where the bead is in every frame of a film. */
#include <math.h>
#include <string.h>

#include "cli/command.h"
#include "cli/terminal.h"

enum { SHOWN_DOUBTS = 8 };

static const option options[] = {
    {"output", 'o', "TRACK.csv",
     "columns frame,t [s],x [mm],y [mm] (px without a scale), a row a frame; y points up"},
    {"beads", '\0', "N", "how many beads of one size are followed, 1 to 4 (1)"},
    {"scale", '\0', "SCALE",
     "\"bead 5 mm\", \"plate 460 mm\", \"X1,Y1:X2,Y2=50mm\", or four corners \"...=80x60mm\""},
    {"fps", '\0', "F", "frames a second, instead of the film's clock; a folder of images needs it"},
    {"distance", '\0', "LENGTH", "from the camera to the plate: allows for the bead's height above it"},
    {"overlay", '\0', "FILM.mp4",
     "a film (mp4, mov) that shows what was found, slowed down to 30 frames a second"},
    {"picture", '\0', "FIG.png", "one picture to check by eye: the path, the plate's edge, and beads enlarged"},
    QUIET_OPTION,
    {NULL, '\0', NULL, NULL},
};

static fst_status read_options(const arguments *given, fst_film_track_options *track, fst_error *error)
{
    *track = fst_default_film_track_options();
    track->scale = option_value(given, "scale");
    track->overlay = option_value(given, "overlay");
    track->picture = option_value(given, "picture");
    double beads = 1.0;
    const value_option rows[] = {{"beads", VALUE_WHOLE, &beads, 1, FST_TRACKED_BEADS},
                                 {"fps", FST_UNIT_NUMBER, &track->fps, 0, 0},
                                 {"distance", FST_UNIT_LENGTH, &track->distance, 0, 0}};
    const fst_status status = read_values(given, rows, sizeof rows / sizeof *rows, error);
    track->beads = (int)beads;
    return status;
}

/* Print the edge that was taken for the plate's, then the others, so that a wrong choice is seen. */
static void print_edges(const fst_film_track_report *r, FILE *out)
{
    (void)fprintf(out, "plate       %.1f x %.1f pixels; its edge is within %.2f pixels of an ellipse\n",
                  r->plate[0], r->plate[1], r->rim_error);
    if (r->edge_count > 1)
        (void)fprintf(out,
                      "            the outermost edge that is not faint, %.0f gray levels steep; others:\n",
                      r->edges[r->edge_taken].contrast);
    for (int i = 0; i < r->edge_count; ++i)
        if (i != r->edge_taken)
            (void)fprintf(out, "            %.1f x %.1f pixels, %.0f gray levels, along %.0f %% of it\n",
                          r->edges[i].diameter[0], r->edges[i].diameter[1], r->edges[i].contrast,
                          100.0 * r->edges[i].share);
}

/* Which of several beads may have exchanged their names, and when. */
static void print_names(const fst_film_track_report *r, FILE *out)
{
    if (r->beads == 1)
        return;
    (void)fprintf(out,
                  "names       1 to %d, from the left to the right in the first frame that shows all beads\n",
                  r->beads);
    if (r->doubt_count == 0)
        (void)fputs("            each bead has kept its name\n", out);
    for (int i = 0; i < r->doubt_count && i < SHOWN_DOUBTS; ++i) {
        (void)fprintf(out, "uncertain   from frame %d, %.6g s, the names", r->doubts[i].frame, r->doubts[i].t);
        for (int bead = 0, told = 0; bead < r->beads; ++bead)
            if (r->doubts[i].beads >> bead & 1)
                (void)fprintf(out, "%s %d", told++ > 0 ? " and" : "", bead + 1);
        (void)fputs(" may be exchanged\n", out);
    }
    if (r->doubt_count > SHOWN_DOUBTS)
        (void)fprintf(out, "            and %d times more\n", r->doubt_count - SHOWN_DOUBTS);
}

static void print_report(const fst_film_track_report *r, int by_bead, FILE *out)
{
    (void)fprintf(out, "film        %s, %s, %d x %d pixels\n", r->format, r->codec, r->width, r->height);
    (void)fprintf(out, "frames      %d, %.6g a second on average\n", r->frames, r->fps);
    if (r->most_step - r->least_step > fmax(0.01 * r->least_step, 1.5 * r->tick)) /* a coarse clock rounds */
        (void)fprintf(out, "            the frame rate varies: %.4g to %.4g ms from frame to frame\n",
                      1e3 * r->least_step, 1e3 * r->most_step);
    if (r->missing)
        (void)fprintf(out, "            the clock leaves room for %d more, which the film does not have\n",
                      r->missing);
    (void)fprintf(out, "duplicates  %d\n", r->twins);
    (void)fprintf(out, "lost        %d", r->lost);
    if (r->lost)
        (void)fprintf(out, ", first frame %d", r->first_lost);
    (void)fprintf(out, "\nbead        %.1f pixels wide; noise of a pixel %.1f gray levels\n", r->diameter,
                  r->noise);
    print_names(r, out);
    if (!isnan(r->jitter))
        (void)fprintf(out, "scatter     %.2f pixels about a smooth path\n", r->jitter);
    if (!isnan(r->scale))
        (void)fprintf(out, "scale       %.5g mm a pixel in the middle of the path\n", r->scale);
    if (by_bead)
        (void)fprintf(
            out, "            by the bead's width, which half a pixel more or less would change by %.1f %%\n",
            50.0 / r->diameter);
    if (r->edge_count > 0)
        print_edges(r, out);
}

/* What makes a person look twice. */
static void warn(const fst_film_track_report *r)
{
    if (r->remark[0])
        (void)fprintf(stderr, "festoon: warning: %s\n", r->remark);
    if (r->twins > r->frames / 50)
        (void)fprintf(
            stderr,
            "festoon: warning: %d frames repeat the one before: the film was converted to another frame "
            "rate, and its clock is wrong by as much as a frame; take the original\n",
            r->twins);
    if (r->lost > r->frames / 50)
        (void)fprintf(stderr,
                      "festoon: warning: %s lost in %d of %d frames: look at them with an overlay; shorter "
                      "exposure, more light and a plain plate help\n",
                      r->beads == 1 ? "the bead was" : "beads were", r->lost, r->frames);
    if (r->doubt_count > 0)
        (void)fprintf(
            stderr,
            "festoon: warning: beads may have exchanged their names, as told above, first in frame %d; "
            "a higher frame rate tells them apart\n",
            r->doubts[0].frame);
}

static fst_status perform(const arguments *given, FILE *out, fst_error *error)
{
    fst_film_track_options film;
    fst_film_track_report report;
    fst_track tracks[FST_TRACKED_BEADS];
    progress_line line;
    const fst_progress progress = {&line, progress_tell};
    const char *path = operand(given), *to = option_value(given, "output");
    if (!path)
        return fail(error, FST_BAD_INPUT, "", "a film is missing, or a folder of images");
    if (!to)
        return fail(error, FST_BAD_INPUT, "", "say where the track goes: -o TRACK.csv");
    fst_status status = read_options(given, &film, error);
    if (status != FST_OK)
        return status;
    film.progress = &progress;
    film.csv = to;
    progress_begin(&line);
    status = fst_film_track(path, &film, tracks, &report, error);
    progress_end(&line);
    if (status != FST_OK)
        return status;
    print_report(&report, film.scale && strncmp(film.scale, "bead", 4) == 0, out);
    warn(&report);
    tell_written(to, "");
    for (int bead = 0; bead < film.beads; ++bead)
        fst_track_free(&tracks[bead]);
    return FST_OK;
}

const command track_command = {
    .name = "track",
    .synopsis = "FILM|FOLDER -o TRACK.csv [--scale SCALE] [options]",
    .summary = "Find the bead, or several, in every frame of a film, for festoon measure",
    .details =
        "FILM is what ffmpeg reads of mp4, mov, webm, gif, avi ...; FOLDER has images (PNG, JPEG, BMP, PGM, "
        "PPM),\n"
        "taken in the order of their names and numbers.  The camera must stand still; the bead must be darker\n"
        "or brighter than the plate.  With --beads a row is a bead in a frame: column track has its name, "
        "doubts how\n"
        "often until there it may have exchanged it with another one's.  Pixels of a scale count from the top "
        "left, as in viewers of pictures.\n",
    .options = options,
    .most_operands = 1,
    .has_helpers = 1,
    .perform = perform,
};
