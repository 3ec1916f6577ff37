/* fit.h - measured points, and the parameters of the model that follow from them; festoon_tools.h includes it.
 *
 * A point is what was measured at one frequency of the drive: the mean distance of the bead from the axis, its
 * deviation, and how often the bead goes round in a second.  docs/fit.md explains how parameters are found.
 */
#ifndef FESTOON_FIT_H
#define FESTOON_FIT_H

#include <festoon/festoon.h>
#include <festoon/tracks.h>

#ifdef __cplusplus
extern "C" {
#endif

/* ------------------------------------------------------------------ the table of points */

/* What may be measured at a frequency of the drive. */
typedef enum { FST_MEASURED_QUANTITIES(FST_ROW_ENUM) FST_MEASURED_COUNT } fst_measured;

/* The name of its column: "mean_r", "std_r", "bead_frequency". */
FST_API const char *fst_measured_name(fst_measured what);
/* FST_UNIT_LENGTH or FST_UNIT_FREQUENCY */
FST_API fst_unit fst_measured_unit(fst_measured what);

/* A row of the table, in SI units; NAN: an empty cell, or no such column. */
typedef struct fst_point {
    double frequency, frequency_error; /* of the drive, Hz; the error is NAN where it is not known */
    double value[FST_MEASURED_COUNT], error[FST_MEASURED_COUNT]; /* both or neither; errors are positive */
    double
        scale_error; /* relative, of the scale that all lengths share, of all rows: a fit takes them for wrong by the
                           same number of these deviations; NAN or 0: there is none */
    int line;        /* in the file, from 1 */
} fst_point;

/* Begin with {0}; free with fst_points_free(). */
typedef struct fst_points {
    fst_point *rows;
    size_t count;
    int column[FST_MEASURED_COUNT]; /* the number of the column of a quantity in the file, from 1; 0: none */
} fst_points;
FST_API void fst_points_free(fst_points *points);

/* Read a table with a line of column names with units, `frequency [Hz]`, `mean_r [mm]`, `mean_r_error [mm]`,
 * and so on, and optionally `frequency_error [Hz]`, in any order and with any units of their kinds, in any
 * dialect of text.  FST_BAD_INPUT: error->where is "FILE:LINE", the sentence names the column. */
FST_API fst_status fst_points_read(const char *path, fst_points *points, fst_error *error);

/* A measured track as a row of such a table.  Numbers without an error stay out; `drive` is for a track that
 * does not tell the drive itself (Hz; NAN: unknown).  FST_BAD_INPUT: the track is in pixels, or nothing tells
 * the drive. */
FST_API fst_status fst_point_of(const fst_measurement *measured, double drive, fst_point *row,
                                fst_error *error);

/* Write such a table, in mm and Hz, whole or not at all; fst_points_read() gets the same numbers from it. */
FST_API fst_status fst_points_write(const char *path, const fst_points *points, fst_error *error);

/* ------------------------------------------------------------------ fits */

/* Whether cminpack is there, so that fst_fit() can be called. */
FST_API int fst_fit_present(void);

enum { FST_FIT_MOST_KEYS = 16, FST_FIT_MOST_RIVALS = 4 };

typedef struct fst_fit_options {
    uint32_t cookie;
    const char *const *free; /* keys of the parameters that are sought */
    int free_count;
    const char *const *given; /* what is known otherwise, "magnet.depth=16.2+-0.2 mm": of a free key, a further
                                 measurement; of any other key, its uncertainty enters all errors */
    int given_count;
    int rivals;       /* fit the other dynamics and friction laws as well, and compare */
    int bootstrap;    /* how many times the numbers are drawn anew and fitted again; 0: not at all */
    uint64_t seed;    /* of the bootstrap */
    int curve_points; /* frequencies at which the model's curves are computed for a figure; 0: none */
    /* Of a track only. */
    double drive; /* Hz, negative where the magnet turns clockwise; NAN: as the track tells it */
    double exposure,
        exposure_error; /* s that a frame was exposed; NAN: not at all; its error makes it an unknown */
    const fst_progress *progress; /* NULL: nobody is told */
} fst_fit_options;
FST_API fst_fit_options fst_default_fit_options(void);

/* A parameter that was sought.  A number that is not known is NAN. */
typedef struct fst_fit_parameter {
    char key[64];
    fst_unit unit;
    double value, error; /* SI; one standard deviation */
    double interval[2];  /* where the least chi^2 over all others is error_scale^2 above its minimum: 68.3 % */
    double prior[2];     /* what was given, and its error */
    double bootstrap_error; /* half the width of the middle 68.3 % of the bootstrap's values */
} fst_fit_parameter;

/* A number that was left out, because nothing explains it. */
typedef struct fst_fit_outlier {
    int line, column; /* in the file, both from 1 */
    fst_measured what;
    double value, expected; /* measured; by the model without it */
    double deviation;       /* their difference in standard deviations */
} fst_fit_outlier;

/* A number of the table beside the model's. */
typedef struct fst_fit_number {
    size_t row;
    fst_measured what;
    double value;     /* as it was taken: of the sign that a remark may speak of */
    double expected;  /* by the model; NAN: it has no such motion there */
    double deviation; /* in standard deviations */
    int used;         /* 0: an outlier */
} fst_fit_number;

/* The same numbers by another law of friction or other equations of motion. */
typedef struct fst_fit_rival {
    int law, dynamics; /* fst_friction_law, fst_dynamics */
    int fitted;        /* 0: no fit was found */
    double chi2, aicc; /* Akaike's criterion with its correction for few numbers: the least is the best */
} fst_fit_rival;

/* The model at one frequency, with the uncertainty that the parameters leave. */
typedef struct fst_fit_curve_point {
    double frequency, value[FST_MEASURED_COUNT], spread[FST_MEASURED_COUNT];
} fst_fit_curve_point;

/* Free with fst_fit_free(). */
typedef struct fst_fit {
    fst_params params; /* with the values that were found */
    fst_fit_parameter parameters[FST_FIT_MOST_KEYS];
    int count;      /* of all parameters */
    int free_count; /* free parameters come first, in the order asked for; given ones follow */
    double correlation[FST_FIT_MOST_KEYS][FST_FIT_MOST_KEYS];
    double kappa_gamma2,
        kappa_gamma2_error; /* mu B0/(m R^2), 1/s^2; NAN: nothing that is sought enters it, or a part's
                                                strength is sought, of which B0 is but the unit */
    double chi2;            /* with the priors' */
    int points, dof;        /* numbers that were fitted; fewer by the free parameters */
    double error_scale; /* all errors were multiplied by it: 1, or the root of chi2/dof where that is too great
                           for chance */
    double
        widened; /* 1; or, where chi2 is not a parabola, by how much the error of the parameter of which that is most
                           true exceeds the curvature's: kappa_gamma2_error was multiplied by it */
    int slip_frames; /* of a track: frames whose slip was measured (fst_turning) ... */
    int slip_fitted; /* ... and in how many of them it was fitted, far enough apart to err independently; 0: in none */
    double
        slip_misfit; /* how far the model's slip is from it: the root of the mean square of a component's difference
                           over its error; NAN: none was measured */
    double slip_chi2; /* of the two components of each fitted one; NAN: none.  Laws of friction differ by it */
    /* Of a track, Hz: how the magnet turned, which is sought too, and from where (NAN: from what the track told).  0: of a
     * table. */
    double drive, drive_error, drive_given;
    double aicc;
    fst_fit_outlier *outliers;
    size_t outlier_count;
    fst_fit_number *numbers;
    size_t number_count;
    fst_fit_curve_point *curve;
    size_t curve_count;
    fst_fit_rival rivals[FST_FIT_MOST_RIVALS];
    int rival_count;
    int bootstrap_count; /* refits that succeeded */
    char weakest[1280];  /* the direction in which parameters are least known, and what would help */
    char *remarks;       /* for people, a line each; "" where there is nothing to say */
} fst_fit;

/* Find the parameters with which the model comes nearest to the points.  FST_BAD_INPUT: a key that cannot be
 * fitted, fewer numbers than parameters, or parameters that these numbers cannot tell apart (the sentence names
 * them); FST_NO_CONVERGENCE: no motion of the model comes near; FST_UNAVAILABLE: no cminpack or no LAPACK. */
FST_API fst_status fst_fit_points(const fst_params *params, const fst_points *points,
                                  const fst_fit_options *options, fst_fit *fit, fst_error *error);
FST_API void fst_fit_free(fst_fit *fit);

/* The same from one track, its places against the model's path: centre, phases, the exact drive and, if its
 * error is given, the exposure are unknowns too.  Where the track has the slip (fst_turning), it is fitted with them, with the
 * bead's radius as one more unknown.  `points` counts coordinates, and chi^2 says nothing, for the
 * noise is measured by what is left over.  Rows of the track may become rejected, as by fst_measure_track(). */
FST_API fst_status fst_fit_track(const fst_params *params, fst_track *track, const fst_fit_options *options,
                                 fst_fit *fit, fst_error *error);

/* One JSON document, as festoon_tools.h says of the others. */
FST_API char *fst_fit_json(const fst_params *params, const fst_fit *fit);

/* The chart of such a figure, or of one quantity alone: `what` it is, or -1 for all.  Each has two panels, the points
 * over the curve, and what is left of them.  fst_chart_free() frees it.  FST_BAD_INPUT: the fit has no curves. */
struct fst_chart;
FST_API fst_status fst_chart_of_fit(const fst_points *points, const fst_fit *fit, int what,
                                    struct fst_chart **chart, fst_error *error);

/* Draw the points with their errors over the model's curves with their bands, to OUT.(svg|pdf|png). */
FST_API fst_status fst_figure_fit(const fst_points *points, const fst_fit *fit, const char *out,
                                  fst_error *error);

#ifdef __cplusplus
}
#endif

#endif
