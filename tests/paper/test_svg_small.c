/* Pieces of the report: figures made small, with the same lines in the same colours in fewer letters, and
 * prose.
 * tests: paper/svg_small.c paper/report_parts.c */
#include "numeric.h"

#include "paper/report_parts.h"
#include "paper/svg_small.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static void becomes(const char *svg, const char *expected)
{
    char *text = strdup(svg), *made = fst_svg_small(text);
    assert_string_equal(text, svg); /* the argument is as it was */
    assert_string_equal(made, expected);
    free(text);
    free(made);
}

/* Lines that join in one colour are one path; a bend, another colour and a gap are kept. */
static void lines_that_join_become_one(void **state)
{
    (void)state;
    becomes("<g>\t<path stroke='rgb(255, 255, 255)'  d='M1.00,1.00 L2.00,3.00  '/>\n"
            "<path stroke='rgb(250, 251, 252)'  d='M2.00,3.00 L5.00,3.04  '/></g>",
            "<g><path stroke='#fff' d='M1,1l1,2 3,0'/></g>");
    becomes("<path stroke='rgb(255, 0, 0)'  d='M1.00,1.00 L2.00,3.00  '/>"
            "<path stroke='rgb(0, 255, 0)'  d='M2.00,3.00 L5.00,3.00  '/>",
            "<path stroke='#f00' d='M1,1l1,2'/><path stroke='#0f0' d='M2,3l3,0'/>");
    becomes("<path stroke='rgb(255, 0, 0)'  d='M1.00,1.00 L2.00,3.00  '/>"
            "<path stroke='rgb(255, 0, 0)'  d='M2.50,3.00 L5.00,3.00  '/>",
            "<path stroke='#f00' d='M1,1l1,2'/><path stroke='#f00' d='M2.5,3l2.5,0'/>");
}

/* Of points on a straight line the ends stay.  Places are summed from rounded ones, so that no error grows. */
static void points_on_a_line_go_and_no_error_grows(void **state)
{
    (void)state;
    char svg[60000] = "", *made;
    size_t used = 0;
    for (int i = 0; i < 400; ++i) /* a zigzag whose steps are not whole tenths */
        used += (size_t)snprintf(svg + used, sizeof svg - used,
                                 "<path stroke='rgb(0, 0, 0)'  d='M%.2f,%.2f L%.2f,%.2f  '/>", 0.33 * i,
                                 i % 2 ? 7.04 : 1.04, 0.33 * (i + 1), i % 2 ? 1.04 : 7.04);
    made = fst_svg_small(svg);
    double x = 0.0, y = 1.0, dx, dy;
    const char *at = strchr(made, 'l');
    int lines = 0;
    for (int length = 0; at && sscanf(at + 1, "%lf,%lf%n", &dx, &dy, &length) >= 1; ++lines) {
        if (strchr(at + 1, ',') == NULL || strchr(at + 1, ',') > strpbrk(at + 2, " '")) /* "3-6" */
            assert_int_equal(sscanf(at + 1, "%lf%lf%n", &dx, &dy, &length), 2);
        x += dx;
        y += dy;
        assert_true(fabs(y - (lines % 2 ? 1.0 : 7.0)) < 0.051);
        at += 1 + length;
    }
    assert_int_equal(lines, 400);
    assert_true(fabs(x - 132.0) < 0.051);
    free(made);
    becomes("<path stroke='rgb(0, 0, 0)'  d='M0.00,0.00 L1.00,0.00  '/>"
            "<path stroke='rgb(0, 0, 0)'  d='M1.00,0.00 L2.00,0.00  '/>"
            "<path stroke='rgb(0, 0, 0)'  d='M2.00,0.00 L3.00,0.05  '/>",
            "<path stroke='#000' d='M0,0l3,.1'/>");
}

/* What shows nothing goes; marks keep their shape, text its letters, and other paths their kind. */
static void the_rest_keeps_its_meaning(void **state)
{
    (void)state;
    becomes("<?xml version=\"1.0\"?>\n<svg \n width=\"690\" >\n<title>Gnuplot</title>\n<!-- a > b -->\n"
            "<path id='m' stroke-width='0.190' d='M0,-1.33 L-1.33,0.67 z'/><g fill=\"none\">\n</g>\n</svg>\n",
            "<svg width='690'><path id='m' stroke-width='0.190' d='M0,-1.33 L-1.33,0.67 z'/></svg>");
    becomes("<text> 0.25 &lt; x</text>", "<text> 0.25 &lt; x</text>");
    becomes("<g transform=\"translate(60.17,502.51)\" fill=\"rgb(51,51,51)\"><text>it's</text></g>",
            "<g transform='translate(60.2,502.5)' fill='#333333'><text>it's</text></g>");
    becomes("<path d='M1.04,2.06 L3.04,4.04 L9,9 Z M5,5 L4,4'/>", "<path d='M1,2.1l2,1.9 6,5zM5,5l-1-1'/>");
    becomes("<path d='M1,1 C2.11,2 3,3 4,4'/>", "<path d='M1,1 C2.11,2 3,3 4,4'/>");
    becomes("<a b=\"it's\" c='\"'/>", "<a b=\"it's\" c='\"'/>");
}

/* Subscripts of symbols are set low; what is not a symbol, and what a page would take for its own, is safe. */
static void prose(void **state)
{
    (void)state;
    static const char *const cases[][2] = {
        {"e_r and V_α", "e<sub>r</sub> and V<sub>α</sub>"},
        {"BH_max/B_rem", "BH<sub>max</sub>/B<sub>rem</sub>"},
        {"n_z² <b> & _x a_", "n<sub>z</sub>² &lt;b&gt; &amp; _x a_"},
        {"film_0215", "film_0215"},
    };
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; ++i) {
        char *text = NULL;
        size_t size = 0;
        FILE *out = open_memstream(&text, &size);
        assert_non_null(out);
        fst_report_prose(out, cases[i][0]);
        (void)fclose(out);
        assert_string_equal(text, cases[i][1]);
        free(text);
    }
}

/* Text that is not a figure, or a piece of one, comes to an end too. */
static void anything_may_come(void **state)
{
    (void)state;
    static const char *const odd[] = {"",
                                      "<",
                                      "<g",
                                      "<g ",
                                      "<g x='",
                                      "</g>",
                                      "<?",
                                      "<!--",
                                      "a<b>c</b",
                                      "<path d='M",
                                      "<path stroke='rgb(1,2,3)'  d='M1,2 L3,4 '/>",
                                      "< >",
                                      "<a =>",
                                      "<a b= >"};
    for (size_t i = 0; i < sizeof odd / sizeof odd[0]; ++i) {
        char *text = strdup(odd[i]), *made = fst_svg_small(text);
        assert_non_null(made);
        assert_string_equal(text, odd[i]);
        free(text);
        free(made);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(lines_that_join_become_one),
        cmocka_unit_test(points_on_a_line_go_and_no_error_grows),
        cmocka_unit_test(the_rest_keeps_its_meaning),
        cmocka_unit_test(anything_may_come),
        cmocka_unit_test(prose),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
