/* A trajectory's bits depend on its parameters alone: one hash of the end states of short trajectories of every
 * material, friction law and dynamics, of a start given in degrees and of events, and another of the Jacobians
 * at their ends, which are to be the same from gcc and clang, with and without optimisation.
 *
 * The expected values are what this program printed when it was last known to be right, the tests of the
 * physics passing; a change that alters results on purpose changes them, and says so in the CHANGELOG.
 * tests: ode/trajectory.c ode/dop853.inl
 * labels: bits */
#include "physics.h"

#include <inttypes.h>

static const uint64_t TRAJECTORIES = UINT64_C(0xad5fb563e4ce8b39), JACOBIANS = UINT64_C(0x51e2a06eba6c6e5f);
static const uint64_t EMPTY = UINT64_C(14695981039346656037);

/* Fowler, Noll and Vo's hash (FNV-1a) of the bits of some doubles. */
static uint64_t hash_of(uint64_t hash, const double *numbers, int count)
{
    for (int i = 0; i < count; ++i) {
        uint64_t bits;
        memcpy(&bits, &numbers[i], sizeof bits);
        for (int byte = 0; byte < 8; ++byte)
            hash = (hash ^ (bits >> 8 * byte & 0xff)) * UINT64_C(1099511628211);
    }
    return hash;
}

static uint64_t hash_of_trajectory(uint64_t hash, uint64_t *jacobians, const fst_params *p, double ramp)
{
    fst_model *model = model_of(p);
    double start[FST_STATE_SIZE], jacobian[FST_STATE_SIZE][FST_STATE_SIZE];
    start_of(p, model, start);
    hash = hash_of(hash, start, FST_STATE_SIZE);
    fst_flow_options options = fst_default_flow_options();
    options.ramp = ramp;
    fst_flow *flow;
    assert_int_equal(fst_flow_new(model, &options, start, &flow, NULL), FST_OK);
    for (int i = 0; i < 4; ++i) {
        (void)advance_to(flow, 120, FST_AT_SECTION);
        const fst_flow_info info = fst_flow_get(flow);
        hash = hash_of(hash, info.state, FST_STATE_SIZE);
        hash = hash_of(hash, (const double[]){info.t, info.t_low, info.step, info.norm_drift}, 4);
    }
    (void)advance_to(flow, 240, 0);
    const fst_flow_info info = fst_flow_get(flow);
    hash = hash_of(hash, info.state, FST_STATE_SIZE);
    fst_jacobian(model, info.state, jacobian, NULL);
    *jacobians = hash_of(*jacobians, &jacobian[0][0], FST_STATE_SIZE * FST_STATE_SIZE);
    fst_flow_free(flow);
    fst_model_free(model);
    return hash;
}

static void test_bits(void **unused)
{
    (void)unused;
    uint64_t hash = EMPTY, jacobians = EMPTY;
    for (int which = 0; which < 12; ++which) {
        fst_params p = bead_at(0.18 + 0.03 * which, which & 1 ? FST_DYNAMICS_FARAGO2020 : FST_DYNAMICS_RIGID);
        p.friction_law = which & 2 ? FST_FRICTION_NONE : FST_FRICTION_VISCOUS;
        p.bead_material = which / 4;
        p.bead_a = 1e-3;
        p.bead_b = -5e-4;
        p.start_phi = 3 + 37 * which;
        p.magnet_lines = which < 10 ? 5 : which;
        hash = hash_of_trajectory(hash, &jacobians, &p, which % 3 == 2 ? 1e-4 : 0);
    }
    if (hash != TRAJECTORIES || jacobians != JACOBIANS)
        fail_msg("the bits of the trajectories hash to 0x%016" PRIx64 ", expected 0x%016" PRIx64
                 "; those of the Jacobians to 0x%016" PRIx64 ", expected 0x%016" PRIx64,
                 hash, TRAJECTORIES, jacobians, JACOBIANS);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(test_bits)};
    return cmocka_run_group_tests_name("golden", tests, NULL, NULL);
}
