/* fuzz_scene.c - the scene reader under libFuzzer: whatever the bytes, it returns, and what it accepts reads
 * back the same.
 *
 *   clang -g -O1 -fsanitize=fuzzer,address,undefined -Iinclude -Isrc tests/fuzz/fuzz_scene.c src/base/[a-z]*.c
 * ...
 */
#include <festoon/festoon_tools.h>

#include <stdlib.h>
#include <string.h>

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size);

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    fst_params params = fst_default_params(), again = fst_default_params();
    fst_error error;
    if (fst_scene_parse((const char *)data, size, "fuzz", &params, &error) != FST_OK)
        return 0;
    char *text = fst_scene_text(&params, 0);
    if (!text || fst_scene_parse(text, strlen(text), "again", &again, &error) != FST_OK)
        abort();
    char *second = fst_scene_text(&again, 0);
    if (!second || strcmp(text, second) != 0)
        abort();
    free(text);
    free(second);
    return 0;
}
