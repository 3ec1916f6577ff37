/* track.c - festoon track: where the bead is in every frame of a film. */
#include <math.h>
#include <string.h>
#include <sys/stat.h>

#include "cli/command.h"
#include "cli/terminal.h"

enum { SHOWN_DOUBTS = 8 };
/* A bead that differs less is poorly seen. */
#define FAINT_LEVELS 20.0   /* of 255 */
#define FAINT_OF_NOISE 12.0 /* deviations of a pixel */

static const option options[] = {
    {"output", 'o', "TRACK.csv",
     "columns frame,t [s],x [mm],y [mm] (px without a scale), a row a frame; y points up"},
    {"beads", '\0', "N", "how many beads of one size are followed, 1 to 4 (1)"},
    {"scale", '\0', "SCALE",
     "\"bead 5 mm\", \"plate 460 mm\", \"X1,Y1:X2,Y2=50mm\", or four corners \"...=80x60mm\"; \"A; B\": "
     "A, compared with B"},
    {"fps", '\0', "F", "frames a second, whatever the film says; images need it"},
    {"distance", '\0', "LENGTH", "from the camera to the plate: allows for the bead's height above it"},
    {"turning", '\0', "DIAMETER",
     "how a bead with marks turns: adds columns for n, W and the slip; its diameter, as 5mm, by callipers"},
    {"overlay", '\0', "FILM.mp4", "a slow film (mp4, mov) of what was found"},
    {"figure", '\0', "FIG.png", "one picture to check by eye: the path, the plate's edge, and beads enlarged"},
    {NULL, '\0', NULL, NULL},
};

static fst_status read_options(const arguments *given, fst_film_track_options *track, fst_error *error)
{
    *track = fst_default_film_track_options();
    track->scale = option_value(given, "scale");
    track->overlay = option_value(given, "overlay");
    track->picture = option_value(given, "figure");
    double beads = 1.0;
    const value_option rows[] = {{"beads", VALUE_WHOLE, &beads, 1, FST_TRACKED_BEADS},
                                 {"fps", FST_UNIT_NUMBER, &track->fps, 0, 0},
                                 {"distance", FST_UNIT_LENGTH, &track->distance, 0, 0},
                                 {"turning", FST_UNIT_LENGTH, &track->turning, 0, 0}};
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

/* Which clock it was. */
static void tell_slow_motion(const fst_film_track_report *r, FILE *out)
{
    if (r->taken_fps > 0.0)
        (void)fprintf(
            out,
            "            the film says that it was taken at %.6g frames a second, and is stored at %.6g: "
            "times are those at\n"
            "            which it was taken (--fps gives others)\n",
            r->taken_fps, r->stored_fps);
}

static void print_report(const fst_film_track_report *r, FILE *out)
{
    char text[SHOWN_SIZE];
    (void)fprintf(out, "film        %s, %s, %d x %d pixels\n", r->format, r->codec, r->width, r->height);
    (void)fprintf(out, "frames      %d, %.6g a second on average\n", r->frames, r->fps);
    if (r->most_step - r->least_step > fmax(0.01 * r->least_step, 1.5 * r->tick)) /* a coarse clock rounds */
        (void)fprintf(out, "            the frame rate varies: %.4g to %.4g ms from frame to frame\n",
                      1e3 * r->least_step, 1e3 * r->most_step);
    tell_slow_motion(r, out);
    if (r->missing)
        (void)fprintf(out, "            the clock leaves room for %d more, which the film does not have\n",
                      r->missing);
    (void)fprintf(out, "duplicates  %d\n", r->twins);
    (void)fprintf(out, "lost        %d", r->lost);
    if (r->lost)
        (void)fprintf(out, ", first frame %d", r->first_lost);
    (void)fprintf(out, "\nbead        %.1f +- %.1f pixels wide; noise of a pixel %.1f gray levels\n",
                  r->diameter, r->diameter_error, r->noise);
    if (r->shadow > 0.0)
        (void)fprintf(out, "shadow      beside the bead, %.0f %% as dark; it is left out\n", 100.0 * r->shadow);
    if (r->shake > 0.0)
        (void)fprintf(out, "camera      moved by %.2g pixels (rms), which the track is corrected for\n",
                      r->shake);
    if (r->roll > 0.0)
        (void)fprintf(out,
                      "camera      turned about its own axis by %.2g degrees (rms): the track is not corrected "
                      "for this\n",
                      r->roll);
    print_names(r, out);
    if (!isnan(r->jitter))
        (void)fprintf(out, "scatter     %.2f pixels about a smooth path\n", r->jitter);
    for (int i = 0; i < r->scale_count; ++i)
        (void)fprintf(out, "%s%.5g mm a pixel in the middle of the path, +- %.2g %% (%s)\n",
                      i == 0 ? "scale       " : "            ", r->scales[i].value, 100.0 * r->scales[i].error,
                      shown(r->scales[i].text, text));
    if (r->edge_count > 0)
        print_edges(r, out);
    if (r->turned_share > 0.0) {
        (void)fprintf(
            out,
            "turning     n in %d frames, W and slip in %d; the marks explain %.0f %% of what changes on the "
            "bead\n",
            r->turned, r->slips, 100.0 * r->turned_share);
        (void)fprintf(
            out, "slip        %.1f %% of the velocity; in %.0f %% of the frames more than twice its error\n",
            100.0 * r->slip, 100.0 * r->slipping);
    } else if (!isnan(r->turned_share))
        (void)fprintf(out, "turning     not found: no marks that turn with the bead could be followed\n");
}

/* Two scales of the same film that do not agree within their errors. */
static void warn_of_scales(const fst_film_track_report *r)
{
    const fst_film_scale *first = &r->scales[0];
    char text[2][SHOWN_SIZE];
    for (int i = 1; i < r->scale_count; ++i) {
        const fst_film_scale *other = &r->scales[i];
        if (fst_film_scales_differ(first, other))
            (void)fprintf(
                stderr,
                "festoon: warning: the scales contradict each other: %.5g +- %.2g mm a pixel by \"%s\", "
                "which is used, and %.5g +- %.2g by \"%s\"\n",
                first->value, first->value * first->error, shown(first->text, text[0]), other->value,
                other->value * other->error, shown(other->text, text[1]));
    }
}

/* A whole edge outside of the one that was taken may be the plate's, where a dark ring is printed on it. */
static void warn_of_edges(const fst_film_track_report *r)
{
    for (int i = 0; i < r->edge_count; ++i)
        if (r->edges[i].share > 0.9 && r->edges[i].diameter[0] > 1.02 * r->plate[0])
            (void)fprintf(
                stderr,
                "festoon: warning: a fainter edge of %.4g pixels lies all around the edge of %.4g pixels that "
                "was taken for the plate's: look at --figure, and give points as the scale if it is the "
                "wrong one\n",
                r->edges[i].diameter[0], r->plate[0]);
}

/* What makes a person look twice. */
static void warn(const fst_film_track_report *r)
{
    const int faint = r->contrast < FAINT_LEVELS || r->contrast < FAINT_OF_NOISE * r->noise;
    if (r->remark[0])
        (void)fprintf(stderr, "festoon: warning: %s\n", r->remark);
    warn_of_scales(r);
    warn_of_edges(r);
    if (faint)
        (void)fprintf(
            stderr,
            "festoon: warning: the bead differs from the plate by %.0f gray levels of 255 only, where the "
            "noise "
            "of a pixel is %.1f: its places are poor, and its width is worse; take more light, or a plain "
            "sheet under it\n",
            r->contrast, r->noise);
    if (r->diameter_error > 0.05 * r->diameter)
        (void)fprintf(
            stderr,
            "festoon: warning: how wide the bead is shows only to %.0f %%: it is blurred, unevenly lit, or its "
            "shadow cannot be told from it\n",
            100.0 * r->diameter_error / r->diameter);
    if (r->twins > r->frames / 50 && !faint) /* compression repeats dark frames of any film */
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
        (void)fprintf(stderr,
                      "festoon: warning: beads may have exchanged their names, as column doubts tells, first "
                      "in frame %d; "
                      "a higher frame rate tells them apart\n",
                      r->doubts[0].frame);
}

static fst_status track_film(const char *path, fst_film_track_options *film, fst_film_track_report *report,
                             fst_error *error)
{
    fst_track tracks[FST_TRACKED_BEADS];
    progress_line line;
    const fst_progress progress = {&line, progress_tell};
    film->progress = &progress;
    progress_begin(&line);
    const fst_status status = fst_film_track(path, film, tracks, report, error);
    progress_end(&line);
    for (int bead = 0; bead < film->beads && status == FST_OK; ++bead)
        fst_track_free(&tracks[bead]);
    return status;
}

/* ------------------------------------------------------------------ several films */

/* FOLDER/NAME.csv of the film .../NAME.mp4. */
static void name_track(const char *folder, const char *film, char text[SHOWN_SIZE])
{
    size_t length = strlen(film);
    while (length > 1 && film[length - 1] == '/')
        --length;
    size_t begin = length, end = length;
    while (begin > 0 && film[begin - 1] != '/')
        --begin;
    for (size_t i = begin + 1; i < length; ++i)
        end = film[i] == '.' ? i : end;
    (void)snprintf(text, SHOWN_SIZE, "%.2000s/%.*s.csv", folder, (int)(end - begin > 2000 ? 2000 : end - begin),
                   film + begin);
}

static fst_status check_several(const arguments *given, const char *folder, fst_error *error)
{
    static const char *const of_one[] = {"overlay", "figure"};
    char one[SHOWN_SIZE], other[SHOWN_SIZE];
    struct stat there;
    for (size_t i = 0; i < sizeof of_one / sizeof *of_one; ++i)
        if (option_value(given, of_one[i]))
            return fail(error, FST_BAD_INPUT, "",
                        "--%s is of one film: leave it away, or track the films one by one", of_one[i]);
    if (stat(folder, &there) != 0 || !S_ISDIR(there.st_mode))
        return fail(error, FST_BAD_INPUT, folder,
                    "this is not a folder, into which the tracks of several films would go");
    for (int i = 0; i < given->operand_count; ++i)
        for (int k = 0; k < i; ++k) {
            name_track(folder, given->operands[i], one);
            name_track(folder, given->operands[k], other);
            if (strcmp(one, other) == 0)
                return fail(error, FST_BAD_INPUT, given->operands[i],
                            "its track would be %.200s, as that of %.200s", one, given->operands[k]);
        }
    return FST_OK;
}

/* A film that fails is told, and the next one follows. */
static fst_status track_several(const arguments *given, fst_film_track_options *film, const char *folder,
                                FILE *out, fst_error *error)
{
    fst_status status = check_several(given, folder, error), failed = FST_OK;
    if (status != FST_OK)
        return status;
    output_keep();
    (void)fprintf(out, "%8s %10s %6s %10s %12s  %s\n", "frames", "fps", "lost", "bead [px]", "mm a pixel",
                  "track");
    for (int i = 0; i < given->operand_count; ++i) {
        char to[SHOWN_SIZE], text[SHOWN_SIZE];
        fst_film_track_report report;
        name_track(folder, given->operands[i], to);
        film->csv = to;
        status = track_film(given->operands[i], film, &report, error);
        if (status == FST_INTERRUPTED || status == FST_NO_MEMORY)
            return status;
        if (status != FST_OK) {
            failed = failed ? failed : status;
            (void)fprintf(stderr, "festoon: %s: %s\n", shown(error->where, text), error->sentence);
            (void)fprintf(out, "%8s %10s %6s %10s %12s  failed: %s\n", "-", "-", "-", "-", "-",
                          shown(given->operands[i], text));
            continue;
        }
        char scale[32] = "-";
        if (!isnan(report.scale))
            (void)snprintf(scale, sizeof scale, "%.5g", report.scale);
        (void)fprintf(out, "%8d %10.6g %6d %10.1f %12s  %s\n", report.frames, report.fps, report.lost,
                      report.diameter, scale, shown(to, text));
        tell_slow_motion(&report, out);
        char told[64];
        (void)snprintf(told, sizeof told, ": %d frames, %d lost", report.frames, report.lost);
        tell_written(to, told);
        warn(&report);
        if (film->turning > 0.0 && !(report.turned_share > 0.0))
            (void)fprintf(stderr, "festoon: warning: no marks that turn with the bead could be followed\n");
    }
    if (failed != FST_OK)
        return fail(error, failed, "", "not all films could be tracked, as told above");
    return FST_OK;
}

static fst_status perform(const arguments *given, FILE *out, fst_error *error)
{
    fst_film_track_options film;
    fst_film_track_report report;
    const char *path = operand(given), *to = option_value(given, "output");
    if (!path)
        return fail(error, FST_BAD_INPUT, "", "a film is missing, or a folder of images");
    if (!to)
        return fail(error, FST_BAD_INPUT, "", "say where the track goes: -o TRACK.csv");
    fst_status status = read_options(given, &film, error);
    if (status == FST_OK && given->operand_count > 1)
        return track_several(given, &film, to, out, error);
    film.csv = to;
    if (status == FST_OK)
        status = track_film(path, &film, &report, error);
    if (status != FST_OK)
        return status;
    print_report(&report, out);
    warn(&report);
    tell_written(to, "");
    return FST_OK;
}

const command track_command = {
    .name = "track",
    .synopsis = "FILM|FOLDER... -o TRACK.csv|FOLDER [--scale SCALE] [options]",
    .summary = "Find the bead, or several, in every frame of a film, for festoon measure",
    .details =
        "FILM is what ffmpeg reads; FOLDER has images (PNG, JPEG, BMP, PGM, PPM), taken in the order of their "
        "names and\n"
        "numbers.  The camera should stand still; the bead must be darker or brighter than the plate.  With "
        "--beads a row\n"
        "is a bead in a frame: column track has its name, doubts how often until there it may have exchanged "
        "it.  Pixels\n"
        "of a scale count from the top left.  The tracks of several films go into the folder behind -o.\n",
    .options = options,
    .most_operands = OPERAND_LIMIT,
    .has_helpers = 1,
    .perform = perform,
};
