/* file_kind.c - what a file is that was given to a command that takes no such file. */
#include "cli/file_kind.h"

#include <string.h>
#include <sys/stat.h>

enum { HEAD_SIZE = 4096 };

/* How a kind of file begins, and which commands take one as an operand or by an option. */
typedef struct file_kind {
    const char
        *mark; /* the bytes at `place`, or words of the first line that is not a comment, one after the other */
    size_t size; /* of the mark; 0: words "one|two" */
    size_t place;
    const char *what;
    const char *takers; /* "plot|fit --track" */
} file_kind;

#define BYTES(mark, place) mark, sizeof(mark) - 1, place
#define WORDS(words) words, 0, 0

static const char trajectory[] = "a trajectory", trajectory_takers[] = "plot|movie|measure|fit --track";

static const file_kind kinds[] = {
    {BYTES("SQLite format 3", 0), "the database of a sweep", "plot|export|merge|sweep -o"},
    {BYTES("# festoon trajectory", 0), trajectory, trajectory_takers},
    {BYTES("ftyp", 4), "a film", "track"},
    {BYTES("\x1a\x45\xdf\xa3", 0), "a film", "track"},
    {BYTES("GIF8", 0), "a film", "track"},
    {BYTES("RIFF", 0), "a film", "track"},
    {BYTES("\x89PNG", 0),
     "a picture, which no command reads (festoon track takes a film, or a folder of pictures)", ""},
    {BYTES("\xff\xd8\xff", 0),
     "a picture, which no command reads (festoon track takes a film, or a folder of pictures)", ""},
    {BYTES("%PDF", 0), "a document, which no command reads", ""},
    {BYTES("<", 0), "a figure or another document in XML", "measure|fit --track"},
    {WORDS("x [|y [|Bx ["), "a map of a field, for scenes (magnet.shape: grid, magnet.file: FILE)", ""},
    {WORDS("frequency [|mean_r ["), "a table of measured points", "fit|plot --points"},
    {WORDS("point|,status,|,regime,"),
     "what festoon export wrote of a sweep, for other programs; the database itself is for festoon plot and "
     "export",
     ""},
    {WORDS("t [|x [|y ["), "a track", "measure|fit --track"},
    {WORDS("frame|x|y"), "a track", "measure|fit --track"},
};

/* What begins otherwise than it can be told by the first bytes. */
static const file_kind branch = {WORDS(""), "a branch", "plot"},
                       document = {WORDS(""), "a document of festoon run --json", "plot --runs"},
                       hdf5_trajectory = {WORDS(""), trajectory, trajectory_takers},
                       hdf5 = {WORDS(""),
                               "an HDF5 file without a trajectory (rows of a sweep, or a map of a field)", ""},
                       scene = {WORDS(""), "a scene",
                                "run|sweep|field|orbit|locked|branch|lyapunov|check|lab|fit"},
                       empty = {WORDS(""), "an empty file", ""};

/* Whether the words "one|two" come in this order in a line. */
static int has_words(const char *line, size_t length, const char *words)
{
    const char *at = line;
    while (*words) {
        const size_t size = strcspn(words, "|");
        while (at + size <= line + length && memcmp(at, words, size) != 0)
            ++at;
        if (at + size > line + length)
            return 0;
        at += size;
        words += size + (words[size] == '|');
    }
    return 1;
}

/* The kind of a document in JSON, of a file in HDF5, or of a text that may be a scene. */
static const file_kind *kind_by_reading(const char *path, const char *head)
{
    fst_error unheard;
    if (memcmp(head, "\x89HDF", 4) == 0) {
        fst_table table;
        if (fst_trajectory_read(path, &table, &unheard) != FST_OK)
            return &hdf5;
        fst_table_free(&table);
        return &hdf5_trajectory;
    }
    if (head[strspn(head, " \t\r\n")] == '{') {
        const char *kind = strstr(head, "\"kind\":");
        return kind && strstr(kind, "\"parameter\":") ? &branch
               : strstr(head, "\"regime\":")          ? &document
                                                      : NULL;
    }
    fst_params params = fst_default_params();
    return fst_scene_read(path, &params, &unheard) == FST_OK ? &scene : NULL;
}

static const file_kind *kind_of(const char *path)
{
    char head[HEAD_SIZE + 1];
    struct stat there;
    /* To open a pipe would wait for a writer. */
    FILE *file = stat(path, &there) == 0 && S_ISREG(there.st_mode) ? fopen(path, "rb") : NULL;
    if (!file)
        return NULL;
    const size_t size = fread(head, 1, HEAD_SIZE, file);
    const int unread = ferror(file);
    (void)fclose(file);
    head[size] = '\0';
    if (size == 0)
        return unread ? NULL : &empty;
    const char *line = head;
    while (*line == '#' && strchr(line, '\n'))
        line = strchr(line, '\n') + 1;
    for (size_t i = 0; i < sizeof kinds / sizeof *kinds; ++i) {
        const file_kind *kind = &kinds[i];
        if (kind->size ? kind->place + kind->size <= size && !memcmp(head + kind->place, kind->mark, kind->size)
                       : has_words(line, strcspn(line, "\n"), kind->mark))
            return kind;
    }
    return kind_by_reading(path, head);
}

/* Whether `taker`, "plot" or "fit --track", is among the takers of a kind. */
static int takes(const file_kind *kind, const char *taker)
{
    return fst_name_place(taker, kind->takers) >= 0;
}

static void tell(const file_kind *kind, fst_error *error)
{
    char takers[256] = "";
    for (const char *at = kind->takers; *at;) {
        const size_t used = strlen(takers), size = strcspn(at, "|");
        const char *between = !used ? "; festoon " : strchr(at, '|') ? ", " : " or ";
        (void)snprintf(takers + used, sizeof takers - used, "%s%.*s", between, (int)size, at);
        at += size + (at[size] == '|');
    }
    char where[sizeof error->where], sentence[sizeof error->sentence];
    memcpy(where, error->where, sizeof where);
    memcpy(sentence, error->sentence, sizeof sentence);
    if (kind == &empty) /* which says nothing of what belongs there */
        (void)fail(error, FST_BAD_INPUT, where, "this is %s; %s", kind->what, sentence);
    else
        (void)fail(error, FST_BAD_INPUT, where, "this is %s%s%s", kind->what, takers,
                   takers[0] ? " reads it" : "");
}

void tell_file_kind(const command *wanted, const arguments *given, fst_error *error)
{
    if (wanted == &init_command) /* which writes its file */
        return;
    for (int i = 0; i < given->operand_count + given->option_count; ++i) {
        const int is_operand = i < given->operand_count;
        const given_option *by = is_operand ? NULL : &given->options[i - given->operand_count];
        const char *path = is_operand ? given->operands[i] : by->value;
        char taker[64], name[SHOWN_SIZE];
        (void)snprintf(taker, sizeof taker, "%s%s%s", wanted->name, by ? " --" : "", by ? by->row->name : "");
        const size_t length = strlen(shown(path, name));
        if (by && fst_name_place(taker, "fit --track|plot --points|plot --runs") < 0)
            continue;
        if (!length || strncmp(error->where, name, length) != 0 || !strchr(":", error->where[length]))
            continue;
        const file_kind *kind = kind_of(path);
        if (kind == &hdf5 && takes(&hdf5_trajectory, taker)) /* the reader has said what is wrong in it */
            return;
        if (kind && !takes(kind, taker)) {
            error->where[length] = '\0'; /* no line of it is to blame */
            tell(kind, error);
        }
        return;
    }
}
