/* fuzz_scene.c - the scene reader: whatever the bytes, it returns, a refusal has a sentence, and what it
 * accepts reads back the same. */
#include <festoon/festoon_tools.h>

#include <stdlib.h>
#include <string.h>

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size);

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    fst_params params = fst_default_params(), again = fst_default_params();
    fst_error error = {FST_OK, "", ""};
    if (fst_scene_parse((const char *)data, size, "fuzz", &params, &error) != FST_OK) {
        if (error.code == FST_OK || !error.sentence[0])
            abort();
        return 0;
    }
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
