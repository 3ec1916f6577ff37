/* Scenes that list beads: every way to write a key, what is refused and on which line, and the text of a scene.
 * tests: io/scene_beads.c */
#include "same_params.h"

#include <stdlib.h>

#include <festoon/festoon_tools.h>

static fst_status parse(const char *text, fst_params *params, fst_error *error)
{
    *params = fst_default_params();
    return fst_scene_parse(text, strlen(text), "s.yaml", params, error);
}

static fst_params good(const char *text)
{
    fst_params params;
    fst_error error;
    if (parse(text, &params, &error) != FST_OK)
        fail_msg("%s: %s", error.where, error.sentence);
    return params;
}

static void keys_nest_or_are_dotted(void **unused)
{
    (void)unused;
    const fst_params p = good("beads:\n"
                              "  - start: {phi: 3 deg, spin: rest}\n"
                              "    radius: 2 mm\n"
                              "  - start.spin: rolling\n"
                              "    bead:\n"
                              "      mass: 0.4 g\n"
                              "    start.position: [20 mm, 0, 7.5 mm]\n"
                              "  - {}\n");
    (void)unused;
    assert_int_equal(p.bead_count, 3);
    CHECK_SAME_BITS(p.beads[0].start_phi, 3.0);
    assert_int_equal(p.beads[0].start_spin, FST_SPIN_REST);
    CHECK_SAME_BITS(p.beads[0].bead_radius, 2e-3);
    assert_true(isnan(p.beads[0].bead_mass));
    CHECK_SAME_BITS(p.beads[1].bead_mass, 0.4e-3);
    CHECK_SAME_BITS(p.beads[1].start_position[2], 7.5e-3);
    assert_true(isnan(p.beads[2].start_phi));
    assert_int_equal(p.beads[2].bead_material, -1);
}

static void written_and_read_back(void **unused)
{
    (void)unused;
    const fst_params p = good("start:\n  velocity: [1 mm/s, 2 mm/s, 0]\n"
                              "beads:\n"
                              "  - {}\n"
                              "  - {radius: 1.1 mm, material: mixed, start.n: [0, 0.1, 1]}\n"
                              "  - start.r: 0.3\n");
    for (int commented = 0; commented < 2; ++commented) {
        char *text = fst_scene_text(&p, commented);
        assert_non_null(text);
        const fst_params again = good(text);
        check_same_params(&again, &p);
        free(text);
    }
}

static void refused(void **unused)
{
    (void)unused;
    static const struct {
        const char *text, *where, *sentence;
    } bad[] = {
        {"beads: 3\n", "s.yaml:1", "list of beads"},
        {"beads: []\n", "s.yaml:1", "lists no bead"},
        {"beads:\n  - 3\n", "s.yaml:2", "keys and values"},
        {"beads:\n  - radius: 2 mm\n  - raduis: 2 mm\n", "s.yaml:3", "beads[1].radius"},
        {"beads:\n  - radius: 2 Hz\n", "s.yaml:2", "um mm cm m"},
        {"beads:\n  - radius: [2 mm]\n", "s.yaml:2", "beads[0].radius"},
        {"beads:\n  - radius:\n", "s.yaml:2", "one value"},
        {"beads:\n  - radius: 2 mm\n    bead: {radius: 3 mm}\n", "s.yaml:3", "first on line 2"},
        {"beads:\n  - mass: 1 g\n    density: 7500\n", "s.yaml:3", "bead.mass on line 2"},
        {"beads:\n  - start.phi: 3\n    start.position: [1 mm, 0, 0]\n", "s.yaml:3", "start.phi on line 2"},
        {"beads:\n  - start.position: [1 mm, 0]\n", "s.yaml:2", "three numbers"},
        {"beads:\n  - start.position: [1 mm, 0, 0, 0]\n", "s.yaml:2", "three numbers"},
        {"beads:\n  - start.position: [1 mm, [0], 0]\n", "s.yaml:2", "one value"},
        {"beads:\n  - magnet.depth: 3 mm\n", "s.yaml:2", "beads[0]"},
        {"beads:\n  - {}\nbeads:\n  - {}\n", "s.yaml:3", "twice"},
        {"beads[0].start.phi: 3\n", "s.yaml:1", "lists its beads whole"},
        {"beads: [{}, {}, {}, {}, {}, {}, {}, {}, {}]\n", "s.yaml:1", "more than 8"},
    };
    for (size_t i = 0; i < sizeof bad / sizeof *bad; ++i) {
        fst_params params;
        fst_error error;
        assert_int_equal(parse(bad[i].text, &params, &error), FST_BAD_INPUT);
        if (strcmp(error.where, bad[i].where) != 0 || !strstr(error.sentence, bad[i].sentence))
            fail_msg("%s: %s: %s", bad[i].text, error.where, error.sentence);
        assert_int_equal(params.bead_count, 0);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(keys_nest_or_are_dotted),
                                       cmocka_unit_test(written_and_read_back), cmocka_unit_test(refused)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
