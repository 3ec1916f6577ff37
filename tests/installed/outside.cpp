// outside.cpp - a program of somebody else's, in C++: a scene read and a field taken, with both libraries.
#include <festoon/festoon.h>
#include <festoon/festoon_tools.h>

#include <cstdio>
#include <cstring>

int main()
{
    const char *scene = "drive:\n  frequency: 19.9 Hz\n";
    fst_params params = fst_default_params();
    fst_error error{};
    fst_model *model = nullptr;
    if (fst_scene_parse(scene, std::strlen(scene), "scene", &params, &error) != FST_OK ||
        fst_model_new(&params, &model, &error) != FST_OK) {
        std::fprintf(stderr, "%s: %s\n", error.where, error.sentence);
        return 1;
    }
    double b[3];
    double gradient[3][3];
    fst_field(model, 0.5, 0.25, b, gradient);
    const double divergence = gradient[0][0] + gradient[1][1] + gradient[2][2];
    std::printf("festoon %s: omega = %.6f, div B = %g\n", fst_version(), fst_model_groups(model).omega,
                divergence);
    fst_model_free(model);
    return divergence < 1e-12 && divergence > -1e-12 ? 0 : 1;
}
