/* figure_trajectory.c - fst_figure_trajectory(): a figure of a trajectory by its kind. */
#include "draw/figure_trajectory.h"

#include "base/error.h"

enum { OPTIONS_COOKIE = 0x46494721 };

fst_figure_options fst_default_figure_options(void)
{
    return (fst_figure_options){.cookie = OPTIONS_COOKIE,
                                .kind = FST_FIGURE_PATH,
                                .arrows = 1,
                                .from = NAN,
                                .to = NAN,
                                .zoom = {NAN, NAN, NAN, NAN}};
}

fst_status fst_figure_trajectory(const fst_table *table, const char *out, const fst_figure_options *options,
                                 fst_error *error)
{
    fst_figure_options defaults = fst_default_figure_options();
    if (!options)
        options = &defaults;
    if (options->cookie != OPTIONS_COOKIE)
        return fst_fail(error, FST_BAD_INPUT, "fst_figure_trajectory",
                        "the options were not made by fst_default_figure_options()");
    const int chooses = options->kind == FST_FIGURE_TIME || options->kind == FST_FIGURE_SECTION ||
                        options->kind == FST_FIGURE_RAMP;
    if (options->keys[0] && !chooses)
        return fst_fail(error, FST_BAD_INPUT, "fst_figure_options.keys",
                        "only figures of time, sections and ramps show columns of choice");
    switch (options->kind) {
    case FST_FIGURE_PATH:
        return fst_figure_path(table, out, options, error);
    case FST_FIGURE_LOCAL_N:
        return fst_figure_local_n(table, out, options, error);
    case FST_FIGURE_RADIUS_FIELD:
        return fst_figure_radius_field(table, out, options, error);
    case FST_FIGURE_TIME:
        return fst_figure_time(table, out, options, error);
    case FST_FIGURE_SECTION:
        return fst_figure_section(table, out, options, error);
    case FST_FIGURE_RAMP:
        return fst_figure_ramp(table, out, options, error);
    case FST_FIGURE_LAG:
        return fst_fail(error, FST_BAD_INPUT, "fst_figure_options.kind",
                        "a figure of the lag is of a bead in a world, and this one is on a plate: the kind "
                        "time shows its angles");
    case FST_FIGURE_GROUPS:
        return fst_fail(error, FST_BAD_INPUT, "fst_figure_options.kind",
                        "a figure of groups is of several beads, and this trajectory is of one");
    default:
        return fst_fail(error, FST_BAD_INPUT, "fst_figure_trajectory", "no such kind of figure");
    }
}
