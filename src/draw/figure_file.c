/* figure_file.c - the way of a figure from a script in memory to three files.
 *
 *  drawing functions --> script, data (memory) --> OUT.gp, OUT.dat under temporary names --> gnuplot
 *                                                                                              |  a pipe
 *               OUT.gp, OUT.dat, OUT.svg  <-- renamed together, once all are synced  <-- OUT.svg, checked
 */
#include "draw/figure_file.h"

#include "base/error.h"
#include "draw/gnuplot.h"
#include "host/whole_file.h"

#include <errno.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

/* ------------------------------------------------------------------ names */

static char *copy_of(const char *text, size_t size)
{
    char *copy = malloc(size + 1);
    if (copy) {
        memcpy(copy, text, size);
        copy[size] = '\0';
    }
    return copy;
}

static fst_status check_tame(const char *name, const char *out, fst_error *error)
{
    char *tame = copy_of(name, strlen(name));
    if (!tame)
        return fst_fail(error, FST_NO_MEMORY, out, "no memory for a figure");
    fst_text_tame(tame);
    const int same = strcmp(tame, name) == 0;
    free(tame);
    return same ? FST_OK
                : fst_fail(error, FST_BAD_INPUT, out,
                           "a figure's name may hold neither control characters nor bytes that are not UTF-8");
}

/* Split OUT into directory, stem and ending. */
static fst_status take_apart(fst_figure_file *figure, const char *out, fst_error *error)
{
    const char *slash = strrchr(out, '/');
    const char *name = slash ? slash + 1 : out;
    const fst_status status = check_tame(name, out, error); /* the name stands in the script */
    if (status != FST_OK)
        return status;
    const char *point = strrchr(name, '.');
    int known = point && (!strcmp(point, ".svg") || !strcmp(point, ".pdf") || !strcmp(point, ".png"));
    if (!known || point == name)
        return fst_fail(error, FST_BAD_INPUT, out,
                        "a figure's name must end in .svg, .pdf or .png: the ending decides the format");
    memcpy(figure->ending, point + 1, 4);
    figure->out = copy_of(out, strlen(out));
    figure->directory = slash == out ? copy_of("/", 1)
                        : slash      ? copy_of(out, (size_t)(slash - out))
                                     : copy_of(".", 1);
    figure->stem = copy_of(name, (size_t)(point - name));
    if (!figure->out || !figure->directory || !figure->stem)
        return fst_fail(error, FST_NO_MEMORY, out, "no memory for a figure");
    return FST_OK;
}

/* DIRECTORY/STEM.ENDING; free() it. */
static char *beside(const fst_figure_file *figure, const char *ending)
{
    size_t room = strlen(figure->directory) + strlen(figure->stem) + strlen(ending) + 3;
    char *path = malloc(room);
    if (path)
        (void)snprintf(path, room, "%s/%s.%s", figure->directory, figure->stem, ending);
    return path;
}

/* ------------------------------------------------------------------ size */

static const double PIXEL = 25.4 / 96.0; /* mm */

fst_canvas fst_canvas_for(const double *size, int usual, int give)
{
    fst_canvas canvas = {.height = usual};
    if (!size || (size[0] == 0.0 && size[1] == 0.0))
        return canvas;
    const double wide = size[0] == 0.0 ? FST_FIGURE_WIDTH * PIXEL : 1e3 * size[0];
    const double tall = size[1] == 0.0 ? wide * usual / FST_FIGURE_WIDTH : 1e3 * size[1];
    const double wanted = FST_FIGURE_WIDTH * fmin(fmax(tall / wide, 0.0), 1e3), least = usual - give;
    canvas.millimetres[0] = wide;
    canvas.millimetres[1] = tall;
    canvas.height = (int)lround(fmax(wanted, least));
    canvas.more = canvas.height - usual;
    if (wanted < least) /* too low: the whole layout becomes smaller */
        canvas.pad = (int)lround(0.5 * (fmin(fmax(least * wide / tall, 0.0), 1e6) - FST_FIGURE_WIDTH));
    return canvas;
}

static fst_status check_size(const fst_canvas *canvas, fst_error *error)
{
    enum { LEAST = 20, MOST = 1000 }; /* mm; a PNG of the greatest takes 230 MB while it is drawn */
    char meant[64] = "";
    for (int i = 0; i < 2; ++i) {
        const double length = canvas->millimetres[i], without_unit = 1e-3 * length;
        if (canvas->millimetres[0] == 0.0 || (length >= LEAST && length <= MOST))
            continue;
        if (without_unit >= LEAST && without_unit <= MOST)
            (void)snprintf(meant, sizeof meant, "; a length without a unit is in m: %gmm?", without_unit);
        return fst_fail(error, FST_BAD_INPUT, "fst_figure_options.size",
                        "a figure is %d to %d mm wide and high, not %.4g mm%s", LEAST, MOST, length, meant);
    }
    return FST_OK;
}

/* gnuplot gives an SVG its size in pixels, those of the layout; the head has to state the size that is wanted. */
static void write_sized(const char *svg, const fst_canvas *canvas, FILE *out)
{
    const char *size = strstr(svg, " width=\""), *box = size ? strstr(size, "\n viewBox=") : NULL;
    if (box)
        (void)fprintf(out, "%.*s width=\"%.6gmm\" height=\"%.6gmm\"", (int)(size - svg), svg,
                      canvas->millimetres[0], canvas->millimetres[1]);
    (void)fputs(box ? box : svg, out);
}

/* gnuplot does not say how many pixels of a PNG make a metre: put that chunk behind the header, which is always as
 * long.  Its words are the same in each figure, and so is their check sum at the end. */
static void write_resolved(const char *png, size_t size, FILE *out)
{
    enum { HEADER = 8 + 4 + 4 + 13 + 4 }; /* the signature; length, name, words and check sum of IHDR */
    static const char chunk[] = "\0\0\0\x09pHYs"
                                "\0\0\x1d\x87\0\0\x1d\x87\x01" /* 192 in an inch are 7559 in a metre */
                                "\x8f\xe5\xf1\x65";
    const size_t head = size < HEADER ? size : HEADER;
    (void)fwrite(png, 1, head, out); /* a failure is seen when the file is synced */
    (void)fwrite(chunk, 1, sizeof chunk - 1, out);
    (void)fwrite(png + head, 1, size - head, out);
}

/* ------------------------------------------------------------------ the script's head */

void fst_figure_quote(fst_figure_file *figure, const char *text)
{
    fst_gnuplot_quote(&figure->script_text, text);
}

/* Name a file beside the script so that gnuplot takes it for a file and nothing else. */
static void quote_name(fst_figure_file *figure, const char *ending)
{
    (void)fputs("'./'.", figure->script);
    fst_figure_quote(figure, figure->stem);
    (void)fprintf(figure->script, ".'.%s'", ending);
}

/* Each terminal has units of its own for letters, lines, points and dashes: the scales make them look alike.  A
 * PNG is drawn at twice the size, for fine screens.  A path in changing colours is made of pieces, between which
 * gaps would show if their ends were not round. */
static void write_terminal(fst_figure_file *figure)
{
    FILE *script = figure->script;
    const fst_canvas *canvas = &figure->canvas;
    const int width = FST_FIGURE_WIDTH + 2 * canvas->pad, height = canvas->height;
    const double scale = canvas->millimetres[0] > 0.0 ? canvas->millimetres[0] / (width * PIXEL) : 1.0;
    if (!strcmp(figure->ending, "svg"))
        (void)fprintf(script,
                      "set terminal svg size %d,%d enhanced rounded background 'white' font 'sans-serif,13'\n",
                      width, height);
    else if (!strcmp(figure->ending, "pdf"))
        (void)fprintf(script,
                      "set terminal pdfcairo size %.4fin,%.4fin enhanced rounded fontscale %.4g linewidth "
                      "%.4g pointscale %.4g "
                      "dashlength 1.3 font 'sans,13'\n",
                      scale * width / 96.0, scale * height / 96.0, scale * 0.5625, scale * 1.5, scale * 0.8);
    else
        (void)fprintf(
            script,
            "set terminal pngcairo size %d,%d enhanced rounded fontscale %.4g linewidth %.4g pointscale %.4g "
            "dashlength 1.6 "
            "background 'white' font 'sans,13'\n",
            (int)lround(2 * scale * width), (int)lround(2 * scale * height), scale * 1.5, scale * 2,
            scale * 3.2);
}

static void write_head(fst_figure_file *figure)
{
    FILE *script = figure->script;
    (void)fprintf(script,
                  "# Made by festoon %s.  gnuplot, run in this directory on this script, draws the\n"
                  "# figure again; -e \"figure='OTHER'\" before it draws into another file.\n",
                  fst_version());
    (void)fputs("if (!exists('data')) data = ", script);
    quote_name(figure, "dat");
    (void)fputs("\nif (!exists('figure')) figure = ", script);
    quote_name(figure, figure->ending);
    (void)fputs("\nset encoding utf8\nset datafile missing 'nan'\n", script);
    write_terminal(figure);
    (void)fputs("if (figure ne '') set output figure\n"
                "set border back lc rgb '#333333' lw 1\n"
                "set tics textcolor rgb '#333333' nomirror font ',12'\n"
                "set style line 101 lc rgb '#e4e4e4' lw 1\n",
                script);
}

/* ------------------------------------------------------------------ life */

static void release(fst_figure_file *figure)
{
    free(fst_print_end(&figure->script_text));
    free(fst_print_end(&figure->data_text));
    free(figure->out);
    free(figure->directory);
    free(figure->stem);
    fst_c_locale_leave(figure->locale);
    *figure = (fst_figure_file){0};
}

fst_status fst_figure_begin(fst_figure_file *figure, const char *out, const fst_canvas *canvas,
                            fst_error *error)
{
    *figure = (fst_figure_file){.canvas = *canvas, .locale = fst_c_locale_enter()};
    fst_status status = take_apart(figure, out, error);
    if (status == FST_OK)
        status = check_size(canvas, error);
    if (status == FST_OK) {
        figure->script = fst_print_begin(&figure->script_text);
        figure->data = fst_print_begin(&figure->data_text);
        if (!figure->script || !figure->data)
            status = fst_fail(error, FST_NO_MEMORY, out, "no memory for a figure");
    }
    if (status != FST_OK) {
        release(figure);
        return status;
    }
    write_head(figure);
    return FST_OK;
}

static void write_comment(FILE *out, const char *text)
{
    char line[256];
    (void)snprintf(line, sizeof line, "%s", text);
    fst_text_tame(line);
    (void)fprintf(out, "# %s\n", line);
}

void fst_figure_scene(fst_figure_file *figure, const char *scene)
{
    if (scene)
        write_comment(figure->script, "The scene:");
    for (const char *line = scene; line && *line; line += strcspn(line, "\n"), line += *line == '\n') {
        char text[256];
        (void)snprintf(text, sizeof text, "%.*s", (int)fmin(sizeof text - 1, (double)strcspn(line, "\n")),
                       line);
        write_comment(figure->script, text);
    }
    if (scene)
        (void)fputs("#\n", figure->script); /* a line that ends in "\" goes on here, and no further */
}

void fst_figure_scene_of(fst_figure_file *figure, const fst_params *params)
{
    char *scene = fst_scene_text(params, 0);
    fst_figure_scene(figure, scene);
    free(scene);
}

void fst_figure_block(fst_figure_file *figure, const char *name, const char *columns)
{
    /* Two empty lines end a block.  `index` finds a block by the comment line right before it. */
    if (figure->blocks++)
        (void)fputs("\n\n", figure->data);
    write_comment(figure->data, name);
    write_comment(figure->data, columns);
}

/* A gnuplot that was stopped half way may still report success; the last bytes of the figure tell whether it is
 * complete. */
static int is_complete(const fst_whole_file *file, const char *ending)
{
    char tail[64];
    const int descriptor = fst_whole_file_descriptor(file);
    const off_t size = lseek(descriptor, 0, SEEK_END), from = size > 64 ? size - 64 : 0;
    ssize_t got;
    do
        got = size > 0 ? pread(descriptor, tail, sizeof tail, from) : 0;
    while (got < 0 && errno == EINTR);
    const char *mark = !strcmp(ending, "svg") ? "</svg>" : !strcmp(ending, "pdf") ? "%%EOF" : "IEND";
    const size_t length = strlen(mark);
    for (size_t i = 0; got > 0 && i + length <= (size_t)got; ++i)
        if (memcmp(tail + i, mark, length) == 0)
            return 1;
    return 0;
}

/* Script, data and figure are written under temporary names, and renamed once all of them are on the disk. */
enum { DATA, SCRIPT, FIGURE, FILES };

/* How gnuplot, which runs in the figure's directory, calls a temporary file. */
static const char *name_there(const fst_whole_file *file)
{
    const char *slash = strrchr(file->temporary, '/');
    return slash && file->temporary[0] != '/' ? slash + 1 : file->temporary;
}

static fst_status draw_by_gnuplot(const fst_figure_file *figure, fst_whole_file files[FILES], fst_error *error)
{
    const int sized = figure->canvas.millimetres[0] > 0.0 && !strcmp(figure->ending, "svg");
    const int changed = sized || !strcmp(figure->ending, "png");
    fst_printed printed;
    FILE *out = changed ? fst_print_begin(&printed) : files[FIGURE].stream;
    if (!out)
        return fst_fail(error, FST_NO_MEMORY, figure->out, "no memory for a figure");
    fst_status status =
        fst_gnuplot_run(figure->directory, name_there(&files[SCRIPT]), name_there(&files[DATA]), out, error);
    char *drawn = changed ? fst_print_end(&printed) : NULL;
    if (changed && !drawn && status == FST_OK)
        status = fst_fail(error, FST_NO_MEMORY, figure->out, "no memory for a figure");
    if (drawn && sized)
        write_sized(drawn, &figure->canvas, files[FIGURE].stream);
    else if (drawn)
        write_resolved(drawn, printed.size, files[FIGURE].stream);
    free(drawn);
    return status;
}

static fst_status draw(const fst_figure_file *figure, const char *const texts[FIGURE],
                       fst_whole_file files[FILES], fst_error *error)
{
    (void)fputs(texts[DATA], files[DATA].stream);
    (void)fputs(texts[SCRIPT], files[SCRIPT].stream);
    fst_status status = fst_whole_file_sync(&files[DATA], error);
    if (status == FST_OK)
        status = fst_whole_file_sync(&files[SCRIPT], error);
    if (status == FST_OK)
        status = draw_by_gnuplot(figure, files, error);
    if (status != FST_OK && error) { /* the script's temporary name would tell the reader nothing */
        (void)snprintf(error->where, sizeof error->where, "%s", figure->out);
        fst_text_tame(error->where);
    }
    if (status == FST_OK)
        status = fst_whole_file_sync(&files[FIGURE], error);
    if (status == FST_OK && !is_complete(&files[FIGURE], figure->ending))
        status = fst_fail(error, FST_IO, figure->out, "gnuplot left an incomplete figure");
    return status;
}

static fst_status write_files(const fst_figure_file *figure, const char *const texts[FIGURE],
                              const char *const paths[FILES], fst_error *error)
{
    fst_whole_file files[FILES];
    fst_status status = FST_OK;
    int opened = 0, committed = 0;
    while (opened < FILES && status == FST_OK) {
        status = fst_whole_file_open(&files[opened], paths[opened], error);
        opened += status == FST_OK;
    }
    if (status == FST_OK)
        status = draw(figure, texts, files, error);
    for (; committed < FILES && status == FST_OK; ++committed)
        status = fst_whole_file_commit(&files[committed], error);
    for (int i = committed; i < opened; ++i)
        fst_whole_file_discard(&files[i]);
    return status;
}

fst_status fst_figure_finish(fst_figure_file *figure, fst_error *error)
{
    (void)fputs("unset output\n", figure->script);
    char *texts[FIGURE] = {
        [DATA] = fst_print_end(&figure->data_text), [SCRIPT] = fst_print_end(&figure->script_text)};
    char *script = beside(figure, "gp");
    char *data = beside(figure, "dat");
    fst_status status = FST_OK;
    if (!texts[DATA] || !texts[SCRIPT] || !script || !data)
        status = fst_fail(error, FST_NO_MEMORY, figure->out, "no memory for a figure");
    const char *const paths[FILES] = {[DATA] = data, [SCRIPT] = script, [FIGURE] = figure->out};
    if (status == FST_OK)
        status = write_files(figure, (const char *const *)texts, paths, error);
    free(texts[DATA]);
    free(texts[SCRIPT]);
    free(script);
    free(data);
    release(figure);
    return status;
}

void fst_figure_abandon(fst_figure_file *figure)
{
    release(figure);
}
