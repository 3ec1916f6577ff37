/* completion_offer.c - what can stand in the place of the last word of a command line, from the tables of
 * commands, options, parameters, results and columns. */
#include "cli/completion.h"

#include <string.h>

/* The last word: what of it stays, and what is typed of the name that is sought. */
typedef struct place {
    FILE *out;
    const char *word, *typed; /* typed points into word; the part before it stays */
} place;

/* Offer a name, with what stands behind it, where it begins as typed. */
static void offer(const place *p, const char *name, size_t length, const char *behind, const char *description)
{
    const size_t typed = strlen(p->typed);
    char words[256];
    if (typed > length || memcmp(name, p->typed, typed) != 0)
        return;
    (void)snprintf(words, sizeof words, "%s", description);
    for (char *c = words; *c; ++c)
        *c = *c == '\n' ? ' ' : *c;
    (void)fprintf(p->out, "%.*s%.*s%s%s%s\n", (int)(p->typed - p->word), p->word, (int)length, name, behind,
                  *words ? "\t" : "", words);
}

static void offer_name(const place *p, const char *name, const char *description)
{
    offer(p, name, strlen(name), "", description);
}

static void offer_option(const place *p, const char *name, const char *description)
{
    char text[64];
    (void)snprintf(text, sizeof text, "--%s", name);
    offer_name(p, text, description);
}

/* The words of "a|b|c". */
static void offer_list(const place *p, const char *names)
{
    size_t length;
    for (int i = 0; *fst_name_at(names, i, &length); ++i)
        offer(p, fst_name_at(names, i, &length), length, "", "");
}

/* All parameters, and behind them those of a magnet's first part, which the others have too. */
static const fst_param_info *offered_param(int index)
{
    return index < fst_param_count() || fst_param_part(index) == 0 ? fst_param_at(index) : NULL;
}

static void offer_keys(const place *p, const char *behind)
{
    for (int i = 0; offered_param(i); ++i)
        offer(p, offered_param(i)->key, strlen(offered_param(i)->key), behind, "");
}

/* A key with "=", or the choices of the parameter that is named already. */
static void offer_setting(place *p, int with_choices)
{
    const char *sign = strchr(p->typed, '=');
    (void)fputs(sign ? "words\n" : "open\n", p->out);
    if (!sign) {
        offer_keys(p, "=");
        return;
    }
    for (int i = 0; with_choices && offered_param(i); ++i) {
        const fst_param_info *info = offered_param(i);
        const size_t length = (size_t)(sign - p->typed);
        if (info->kind == FST_KIND_CHOICE && strlen(info->key) == length &&
            memcmp(info->key, p->typed, length) == 0) {
            p->typed = sign + 1;
            offer_list(p, info->names);
            return;
        }
    }
}

/* The next name of a list with commas: of parameters ("KEY,KEY"), or of keys of festoon run ("KEY,..."), and columns
 * ("NAME,..."). */
static void offer_next(place *p, const char *value)
{
    const char *comma = strrchr(p->typed, ',');
    p->typed = comma ? comma + 1 : p->typed;
    (void)fputs("open\n", p->out);
    if (strcmp(value, "KEY,KEY") == 0) {
        offer_keys(p, "");
        return;
    }
    offer_name(p, "regime", "");
    for (int i = 0; i < fst_result_count(); ++i)
        offer_name(p, fst_result_at(i)->name, "");
    for (int i = 0; value[0] == 'N' && i < fst_column_count(); ++i)
        offer_name(p, fst_column_at(i)->name, "");
}

/* Files: the shell finds them, by the endings in "[SCENE.yaml] ..." or "FILE.(h5|csv) ...", if it names some.
 */
static void offer_files(const place *p, const char *synopsis)
{
    const char *point = synopsis + strcspn(synopsis, ". ");
    const char *from = *point == '.' ? point + 1 + (point[1] == '(') : "";
    (void)fprintf(p->out, "files %.*s\n", (int)strspn(from, "abcdefghijklmnopqrstuvwxyz0123456789|"), from);
}

/* The value of an option, by what the help calls it. */
static void offer_value(place *p, const char *value)
{
    static const char files[] = "FILE|FIG|FILM|DIR|FOLDER";
    size_t length;
    for (int i = 0; *fst_name_at(files, i, &length); ++i)
        if (strncmp(value, fst_name_at(files, i, &length), length) == 0) {
            offer_files(p, value);
            return;
        }
    if (strncmp(value, "KEY=", 4) == 0) {
        offer_setting(p, strcmp(value, "KEY=VALUE") == 0);
        return;
    }
    if (strncmp(value, "KEY", 3) == 0 || strcmp(value, "NAME,...") == 0) {
        offer_next(p, value);
        return;
    }
    (void)fputs("words\n", p->out);
    for (int i = 0; strcmp(value, "COLUMN") == 0 && i < fst_column_count(); ++i)
        offer_name(p, fst_column_at(i)->name, "");
    if (strchr(value, '|') && strspn(value, "abcdefghijklmnopqrstuvwxyz0123456789|-") == strlen(value))
        offer_list(p, value);
}

static void offer_commands(const place *p)
{
    (void)fputs("words\n", p->out);
    for (const command *const *row = all_commands; *row; ++row)
        offer_name(p, (*row)->name, (*row)->summary);
    offer_name(p, "help", "The help of a command");
    offer_name(p, "completion", "What lets a shell complete these words");
    offer_option(p, "help", "The list of commands");
    offer_option(p, "version", "Version and optional parts");
}

static void offer_in_command(place *p, const command *shown, const char *before)
{
    const char *sign = strncmp(p->word, "--", 2) == 0 ? strchr(p->word, '=') : NULL;
    const option *row = find_option(shown, sign ? p->word : before);
    if (row && row->value && (sign || !strchr(before, '='))) {
        p->typed = sign ? sign + 1 : p->word;
        offer_value(p, row->value);
        return;
    }
    if (p->word[0] != '-' && shown->most_operands > 0) {
        offer_files(p, shown->synopsis);
        return;
    }
    (void)fputs("words\n", p->out);
    const option *const tables[] = {shown->options, common_options};
    for (int i = 0; p->word[0] == '-' && i < 2; ++i)
        for (row = tables[i]; row->name; ++row)
            offer_option(p, row->name, row->help);
}

void offer_words(int count, char **words, FILE *out)
{
    place p = {out, count > 0 ? words[count - 1] : "", count > 0 ? words[count - 1] : ""};
    const command *shown = count > 1 ? find_command(words[0]) : NULL;
    for (const char *c = p.word; *c; ++c)
        if ((unsigned char)*c < ' ') /* which would look like the end of an offer */
            return;
    if (count < 2 || strcmp(words[0], "help") == 0) {
        offer_commands(&p);
    } else if (strcmp(words[0], "completion") == 0) {
        (void)fputs("words\n", out);
        offer_list(&p, "bash|zsh|fish");
    } else if (shown) {
        offer_in_command(&p, shown, words[count - 2]);
    }
}
