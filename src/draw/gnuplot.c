/* gnuplot.c - running gnuplot: its figure and its words come back through pipes, and it has a time limit. */
#include "draw/gnuplot.h"

#include <stdlib.h>
#include <string.h>

#include "base/error.h"
#include "base/text.h"
#include "host/process.h"

enum { PATIENCE = 60 /* seconds */ };

void fst_gnuplot_quote(fst_printed *printed, const char *text)
{
    FILE *out = printed->stream;
    char *tame = strdup(text);
    (void)fputc('\'', out);
    if (tame)
        fst_text_tame(tame);
    else
        printed->failed = 1;
    for (const char *c = tame; c && *c; ++c)
        if (*c != '\'')
            (void)fputc(*c, out);
        else if (c > tame && c[-1] != '\'')
            (void)fputs("''", out);
        else /* gnuplot takes two quotes for one behind another sign alone */
            (void)fputs("'.\"'\".'", out);
    (void)fputc('\'', out);
    free(tame);
}

/* What gnuplot is told before the script.  An empty name for the figure means standard output. "./" before the
 * data's name keeps gnuplot from taking it for a command ("< command"). free() it. */
static char *settings(const char *data)
{
    fst_printed printed;
    FILE *out = fst_print_begin(&printed);
    char *path = malloc(strlen(data) + sizeof "./");
    printed.failed |= !path;
    if (out && path) {
        (void)sprintf(path, "%s%s", data[0] == '/' ? "" : "./", data);
        (void)fputs("figure=''; data=", out);
        fst_gnuplot_quote(&printed, path);
    }
    free(path);
    return fst_print_end(&printed);
}

/* Run it on the file `path`, and write the figure that comes back. */
static fst_status run_on(const char *directory, const char *setting, const char *path, const char *script,
                         FILE *figure, fst_error *error)
{
    const char *const arguments[] = {"gnuplot", "--default-settings", "-e", setting, path, NULL};
    const fst_program program = {.arguments = arguments,
                                 .directory = directory,
                                 .input = FST_INPUT_NONE,
                                 .is_read = 1,
                                 .purpose = "figures need gnuplot",
                                 .package = "gnuplot-nox"};
    fst_process gnuplot = {.patience = PATIENCE};
    char piece[16384];
    size_t got = 1;
    fst_status status = fst_process_start(&gnuplot, &program, script, error);
    if (status != FST_OK)
        return status;
    while (status == FST_OK && got > 0) {
        status = fst_process_read(&gnuplot, piece, sizeof piece, &got, error);
        (void)fwrite(piece, 1, got, figure); /* a failure is seen when the file is synced */
    }
    const fst_status ended = fst_process_end(&gnuplot, status != FST_OK, error);
    return status == FST_OK ? ended : status;
}

fst_status fst_gnuplot_run(const char *directory, const char *script, const char *data, FILE *figure,
                           fst_error *error)
{
    /* "./" keeps gnuplot from taking a name that begins with a minus for an option. */
    char *setting = settings(data), *path = malloc(strlen(script) + sizeof "./");
    fst_status status = FST_OK;
    if (setting && path) {
        (void)sprintf(path, "%s%s", script[0] == '/' ? "" : "./", script);
        status = run_on(directory, setting, path, script, figure, error);
    } else {
        status = fst_fail(error, FST_NO_MEMORY, script, "no memory for a file name");
    }
    free(setting);
    free(path);
    return status;
}
