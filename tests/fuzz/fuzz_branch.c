/* fuzz_branch.c - branches as JSON: a refusal has a sentence, and an accepted branch has its points. */
#include <festoon/festoon_tools.h>

#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size);

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    char path[256];
    const char *folder = getenv("TMPDIR");
    (void)snprintf(path, sizeof path, "%.200s/festoon-fuzz-XXXXXX", folder ? folder : "/tmp");
    const int descriptor = mkstemp(path);
    if (descriptor < 0)
        return 0;
    const int whole = write(descriptor, data, size) == (ssize_t)size;
    (void)close(descriptor);
    fst_branch branch;
    fst_error error = {FST_OK, "", ""};
    double sum = 0.0;
    if (whole && fst_branch_read(path, &branch, &error) == FST_OK) {
        for (size_t i = 0; i < branch.point_count; ++i)
            sum += branch.points[i].value;
        if (memchr(branch.key, '\0', sizeof branch.key) == NULL)
            abort();
        fst_branch_free(&branch);
    } else if (whole && (error.code == FST_OK || !error.sentence[0])) {
        abort();
    }
    const volatile double sink = sum;
    (void)sink;
    (void)unlink(path);
    return 0;
}
