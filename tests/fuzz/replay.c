/* replay.c - a fuzz target without the fuzzer: the files of a corpus, each as it is, cut short at every byte,
 * and with every byte spoilt in turn.
 *
 *   fuzz_NAME CORPUS_DIR
 */
#include <dirent.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size);

enum { MOST_BYTES = 1 << 16, MOST_PLACES = 200 };

static void replay(const uint8_t *data, size_t size)
{
    uint8_t *exact =
        malloc(size > 0 ? size : 1); /* a copy of exactly this size, so that reading beyond it is noticed */
    if (!exact)
        abort();
    memcpy(exact, data, size);
    (void)LLVMFuzzerTestOneInput(exact, size);
    free(exact);
}

static int replay_file(const char *directory, const char *name)
{
    static uint8_t data[MOST_BYTES];
    static const uint8_t spoils[] = {0, '\n', ':', '9', 0xff};
    char path[4096];
    (void)snprintf(path, sizeof path, "%s/%s", directory, name);
    FILE *in = fopen(path, "rb");
    if (!in)
        return 0;
    const size_t size = fread(data, 1, sizeof data, in);
    (void)fclose(in);
    replay(data, size);
    const size_t step = 1 + size / MOST_PLACES;
    for (size_t place = 0; place < size; place += step) {
        const uint8_t sound = data[place];
        replay(data, place);
        data[place] = spoils[place / step % sizeof spoils];
        replay(data, size);
        data[place] = sound;
    }
    return 1;
}

int main(int count, char **words)
{
    DIR *directory = count == 2 ? opendir(words[1]) : NULL;
    int files = 0;
    if (!directory) {
        fprintf(stderr, "usage: %s CORPUS_DIR\n", words[0]);
        return 2;
    }
    for (const struct dirent *entry = readdir(directory); entry; entry = readdir(directory))
        if (entry->d_name[0] != '.')
            files += replay_file(words[1], entry->d_name);
    (void)closedir(directory);
    printf("%d files\n", files);
    return files > 0 ? 0 : 1;
}
