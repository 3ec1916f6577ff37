/* path_stages.h - the stages of a step that approximate the trajectory well: those that carry weight in the
 * step and in its dense output, 1 and 6 to 13, in the order of their nodes.  The three stages that the dense
 * output adds follow them.  Other rooms count places on the path, 0 to FST_DENSE_STAGES - 1 (path.inl), and
 * never the stages of the method.
 */
#ifndef FST_ODE_PATH_STAGES_H
#define FST_ODE_PATH_STAGES_H

enum { FST_PATH_STAGES = 9, FST_DENSE_STAGES = FST_PATH_STAGES + 3 };
static const int FST_PATH_STAGE[FST_DENSE_STAGES] = {0, 6, 7, 5, 9, 8, 10, 11, 12, 13, 14, 15};

/* Their nodes. */
static const double FST_PATH_NODE[FST_DENSE_STAGES] = {
    0.0, 0.25, 4.0 / 13.0, 1.0 / 3.0, 0.6, 127.0 / 195.0, 6.0 / 7.0, 1.0, 1.0, 0.1, 0.2, 7.0 / 9.0};

/* The distance from each to the one before over that to the one after (negative); at the ends, where there are
 * no two, that to the next one of another node over that to the one beyond. */
static const double FST_PATH_RATIO[FST_PATH_STAGES] = {13.0 / 16.0,    -13.0 / 3.0,   -9.0 / 4.0,
                                                       -5.0 / 52.0,    -26.0 / 5.0,   -70.0 / 281.0,
                                                       -281.0 / 195.0, 195.0 / 476.0, 195.0 / 476.0};

#endif
