/* command.h - what a command of the program is, and what the commands share. */
#ifndef FST_CLI_COMMAND_H
#define FST_CLI_COMMAND_H

#include <stdio.h>

#include <festoon/festoon.h>
#include <festoon/festoon_tools.h>

#include "cli/options.h"

/* One row of the table of commands. */
typedef struct command {
    const char *name;
    const char *synopsis; /* what follows the name: "[SCENE.yaml] [options]" */
    const char *summary;  /* one line */
    const char *details;  /* further help in whole lines, or "" */
    const option *options;
    int most_operands;   /* how many arguments that are not options it takes */
    int much_output;     /* its standard output may be larger than memory */
    int has_helpers;     /* it starts other programs, which a signal from the terminal also reaches */
    const char *program; /* the program that does it, "festoon-paper"; NULL: this one, by the next line */
    /* Do it.  What is written to `out` reaches standard output only if this returns FST_OK (or after output_keep()). */
    fst_status (*perform)(const arguments *given, FILE *out, fst_error *error);
} command;

/* The commands, a file each. */
extern const command run_command, sweep_command, merge_command, export_command, field_command, plot_command,
    movie_command, paper_command, init_command, check_command, schema_command, orbit_command, locked_command,
    branch_command, lyapunov_command, critical_command, measure_command, track_command, fit_command,
    lab_command;

/* All of them, in the order of the help, with NULL behind the last; and the one of this name, or NULL. */
extern const command *const all_commands[];
const command *find_command(const char *name);

/* The options of every command that reads a scene: the first rows of its table. */
#define SCENE_OPTIONS                                                                                          \
    {                                                                                                          \
        "set", '\0', "KEY=VALUE",                                                                              \
            "override one key of the scene (again for more keys); festoon schema lists them"                   \
    }
#define JSON_OPTION                                                                                            \
    {                                                                                                          \
        "json", '\0', NULL, "one JSON document on standard output instead of text"                             \
    }

#define SEED_OPTION                                                                                            \
    {                                                                                                          \
        "seed", '\0', "N", "seed of what is random (1)"                                                        \
    }

/* How a track that another program may have made is understood. */
#define TRACK_OPTIONS                                                                                          \
    {"fps", '\0', "F", "frames a second of the film, instead of the file's clock"},                            \
        {"from", '\0', "FRAME", "the first frame that is taken, by the track's own numbers"},                  \
        {"to", '\0', "FRAME", "the last one"},                                                                 \
    {                                                                                                          \
        "scale", '\0', "L[+-E]",                                                                               \
            "the length of one unit of the file (of a pixel, mostly), as 0.123mm or 0.123+-0.001mm"            \
    }

#define UNITS_DOC "as given, lab (Hz, mm, s, mT, mN, mW), scaled (l, 1/gamma, B0) or si"
#define UNITS_OPTION                                                                                           \
    {                                                                                                          \
        "units", '\0', FST_WORDS(FST_SHOWN), UNITS_DOC                                                         \
    }
/* The same where there is --json. */
#define UNITS_JSON_OPTION                                                                                      \
    {                                                                                                          \
        "units", '\0', FST_WORDS(FST_SHOWN),                                                                   \
            UNITS_DOC "; to --json lab and si both add the numbers in SI, beside the scaled ones"              \
    }

/* Of the commands that draw figures. */
#define LOOK_OPTIONS                                                                                           \
    {"title", '\0', "TEXT", "what stands above the figure; an empty text: nothing"},                           \
    {                                                                                                          \
        "size", '\0', "WxH",                                                                                   \
            "width and height, 86mmx60mm, or the width alone (127mm); letters grow with it, and a PNG "        \
            "has 192 pixels an inch"                                                                           \
    }

/* Fill in `error` and return `code`. */
fst_status fail(fst_error *error, fst_status code, const char *where, const char *format, ...)
    __attribute__((format(printf, 4, 5)));

/* The parameters of the scene `path` (NULL: the defaults; "-": standard input), with all --set applied. */
fst_status read_scene(const arguments *given, const char *path, fst_params *params, fst_error *error);

/* Warn on standard error where mass and radius of the bead contradict any material. */
void warn_of_material(const fst_params *params);

/* Print a text that the library made, and free it.  NULL becomes FST_NO_MEMORY. */
fst_status print_and_free(char *text, FILE *out, fst_error *error);

/* A file's name made fit for a terminal; returns `text`. */
#define SHOWN_SIZE 4200
const char *shown(const char *path, char text[SHOWN_SIZE]);

/* Say "wrote PATH", with a remark behind it, on standard error. */
void tell_written(const char *path, const char *remark);

/* The value as a person reads it: 0 without a sign where all `decimals` that are printed are zeros (ALL_DIGITS:
 * where the value is zero). */
enum { ALL_DIGITS = 300 };
double unsigned_zero(double value, int decimals);

/* The place of an option's value among its names, "one|two|...", which name each a `what`; it stays as it was
 * where `text` is NULL. */
fst_status read_choice(const char *option_name, const char *text, const char *what, const char *names,
                       int *place, fst_error *error);

/* Read --units; as given where it is missing. */
fst_status read_units(const arguments *given, fst_shown_units *units, fst_error *error);

/* Read the names of --quantity, "mean_r,std_r", at most `most`; they point into `words`.  Those behind the last stay. */
enum { KEY_LIMIT = 16, KEYS_SIZE = 512 };
fst_status read_quantities(const arguments *given, char words[KEYS_SIZE], const char **names, int most,
                           fst_error *error);

/* Read --title and --size, in m; they stay as they were where they are missing. */
fst_status read_look(const arguments *given, const char **title, double size[2], fst_error *error);

/* A value with a unit; errors name the option. */
fst_status read_unit(const char *name, const char *text, fst_unit unit, double *value, fst_error *error);

/* Read a time with its unit: "2ms", "0.002 s", "500us", or "1/500s" as cameras write it. */
fst_status read_time(const char *option_name, const char *text, double *seconds, fst_error *error);

/* Where numbers go, and their units. */
typedef struct page {
    FILE *out;
    fst_shown_units units;
    fst_scales scales;
} page;

/* A line with scaled numbers of the unit `unit`, which tables call `key`, in the page's units. */
void print_shown(const page *p, const char *name, const double *values, int count, const char *key,
                 const char *unit);

/* How the values of a parameter are shown: in SI times `factor`, with their unit behind a blank. */
typedef struct shown_parameter {
    double factor;
    char unit[16];
} shown_parameter;
shown_parameter show_parameter(const page *p, const char *key);

/* "omega = 0.215" as it is given; in other units "omega = 10.7 Hz". */
void print_omega(const page *p, double omega);

/* Read exactly `count` numbers separated by commas. */
fst_status read_numbers(const char *option_name, const char *text, double *numbers, int count,
                        fst_error *error);

/* Read the options of a table that were given, each one value; the others' values stay. */
typedef struct value_option {
    const char *name; /* "fps" */
    int kind;         /* a fst_unit, or one of the kinds below */
    double *value;
    double least, greatest; /* of whole numbers */
} value_option;
enum { VALUE_TIME = -1 /* as cameras write it */, VALUE_WHOLE = -2, MOST_FRAMES = 1000000000 };
fst_status read_values(const arguments *given, const value_option *rows, size_t count, fst_error *error);

/* "0.123mm", "0.123 +- 0.001 mm" or "2px": the length of one unit of a track's file, with its error.  `unit` has to live as
 * long as `how`. */
fst_status read_track_scale(const char *text, fst_track_options *how, char unit[FST_LENGTH_UNIT_SIZE],
                            fst_error *error);

/* FST_BAD_INPUT where an output file is one that the command reads, or a scene: it would be lost. */
fst_status check_outputs(const arguments *given, fst_error *error);

/* The same for one file that is read because another one names it. */
fst_status check_outputs_spare(const arguments *given, const char *read, fst_error *error);

/* The same of one file, whose name follows from an option. */
fst_status check_spared(const char *where, const char *path, const char *read, fst_error *error);

/* Whether a file's name has this ending, and more before it. */
int ends_in(const char *path, const char *ending);

/* Whether the beads of a list, or the bead of a world, can begin a run, as one of no length finds out (check.c). */
fst_status check_world(const fst_params *scene, fst_error *error);

#endif
