/* outputs.c - no command writes over what it reads, or over a scene; databases are guarded by whole_file.c. */
#include <string.h>
#include <sys/stat.h>

#include "cli/command.h"

#define LOST "%.200s is %s, and would be lost: choose another name"

static int is_output(const given_option *one)
{
    static const char *const names[] = {"output", "csv", "overlay", "figure"};
    for (size_t i = 0; i < sizeof names / sizeof *names && one->value[0]; ++i)
        if (strcmp(one->row->name, names[i]) == 0)
            return 1;
    return 0;
}

static int is_same_file(const char *one, const char *other)
{
    struct stat first, second;
    return stat(one, &first) == 0 && stat(other, &second) == 0 && first.st_dev == second.st_dev &&
           first.st_ino == second.st_ino && S_ISREG(first.st_mode);
}

static fst_status refuse(const given_option *one, const char *what, fst_error *error)
{
    char where[32];
    (void)snprintf(where, sizeof where, one->row->letter == 'o' ? "-o" : "--%s", one->row->name);
    return fail(error, FST_BAD_INPUT, where, LOST, one->value, what);
}

fst_status check_outputs_spare(const arguments *given, const char *read, fst_error *error)
{
    for (int i = 0; i < given->option_count; ++i)
        if (is_output(&given->options[i]) && is_same_file(given->options[i].value, read))
            return refuse(&given->options[i], "read", error);
    return FST_OK;
}

fst_status check_spared(const char *where, const char *path, const char *read, fst_error *error)
{
    return is_same_file(path, read) ? fail(error, FST_BAD_INPUT, where, LOST, path, "read") : FST_OK;
}

fst_status check_outputs(const arguments *given, fst_error *error)
{
    fst_status status = FST_OK;
    for (int i = 0; i < given->operand_count && status == FST_OK; ++i)
        status = check_outputs_spare(given, given->operands[i], error);
    for (int i = 0; i < given->option_count && status == FST_OK; ++i) {
        const given_option *one = &given->options[i];
        if (!is_output(one))
            status = check_outputs_spare(given, one->value, error);
        else if (strcmp(one->value, "-") == 0)
            status =
                fail(error, FST_BAD_INPUT, "",
                     "--%s: - is no file; write ./- for one of this name, or leave this out where a command "
                     "prints",
                     one->row->name);
        else if ((ends_in(one->value, ".yaml") || ends_in(one->value, ".yml")) &&
                 is_same_file(one->value, one->value))
            status = refuse(one, "a scene", error);
    }
    return status;
}
