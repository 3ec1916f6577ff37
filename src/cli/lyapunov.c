/* lyapunov.c - festoon lyapunov: the spectrum of Lyapunov exponents of a motion. */
#include "cli/command.h"
#include "cli/terminal.h"

static const option options[] = {
    SCENE_OPTIONS,
    JSON_OPTION,
    {NULL, '\0', NULL, NULL},
};

static void print_spectrum(FILE *out, const fst_lyapunov *l)
{
    (void)fprintf(out, "Lyapunov exponents over %.6g/gamma: %s\n", l->time,
                  l->converged ? "converged" : "undecided, take a longer run.periods");
    double sum = 0.0;
    int erased = 0;
    for (int i = 0; i < FST_EIGENVALUE_COUNT; ++i) {
        sum += l->exponents[i];
        if (!isfinite(l->exponents[i])) {
            (void)fprintf(out, "  %14s\n", "-inf");
            erased = 1;
            continue;
        }
        (void)fprintf(out, "  %14.9f +- %.2g%s\n", unsigned_zero(l->exponents[i], 9), l->errors[i],
                      i == l->flow_direction ? "   (the flow direction: zero)" : "");
    }
    if (erased)
        (void)fputs(
            "  a contact that comes to rest erases directions, two at a point and three of a disc: -inf\n",
            out);
    if (isnan(l->divergence))
        (void)fprintf(out, "  sum %.9f (the bead flew: nine of eleven, and impacts have no divergence)\n",
                      unsigned_zero(sum, 9));
    else if (!erased)
        (void)fprintf(out, "  sum %.9f, mean divergence of the flow %.9f\n", unsigned_zero(sum, 9),
                      unsigned_zero(l->divergence, 9));
}

/* Only the equations of one bead on a flat plate are there in their derivatives too. */
static fst_status check_alone(const fst_params *params, fst_error *error)
{
    const char *key = params->bead_count ? "beads" : fst_key_of_world(params);
    if (!key)
        return FST_OK;
    return fail(error, FST_BAD_INPUT, key,
                "festoon lyapunov takes one bead on a flat plate in air: only of its equations it has the "
                "derivatives.  Whether a small disturbance grows, the multipliers of festoon orbit and the "
                "eigenvalues of festoon locked say; of another motion compare the trajectories of two runs "
                "(festoon run -o) whose starts differ by little");
}

static fst_status perform(const arguments *given, FILE *out, fst_error *error)
{
    fst_params params;
    fst_lyapunov spectrum;
    fst_status status = read_scene(given, operand(given), &params, error);
    if (status == FST_OK)
        status = check_alone(&params, error);
    if (status != FST_OK)
        return status;
    warn_of_material(&params);
    progress_line line;
    const fst_progress progress = {&line, progress_tell};
    progress_begin(&line);
    status = fst_lyapunov_find(&params, &progress, &spectrum, error);
    progress_end(&line);
    if (status != FST_OK)
        return status;
    if (option_value(given, "json"))
        return print_and_free(fst_lyapunov_json(&params, &spectrum), out, error);
    print_spectrum(out, &spectrum);
    return FST_OK;
}

const command lyapunov_command = {
    .name = "lyapunov",
    .synopsis = "[SCENE.yaml] [--json]",
    .summary = "The spectrum of Lyapunov exponents of the motion from the start",
    .details = "run.discard drive periods are left out, the rest of run.periods is averaged over.  "
               "\"Converged\" means that every\n"
               "sign is decided.\n",
    .options = options,
    .most_operands = 1,
    .perform = perform,
};
