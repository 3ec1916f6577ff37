/* measures.h - numbers read off the runs, for the table of statements. */
#ifndef FST_APP_MEASURES_H
#define FST_APP_MEASURES_H

#include "app/paper.h"

/* Each has the signature of fst_statement.measure. */
#define FST_MEASURE(name)                                                                                      \
    double fst_measure_##name(const fst_paper_state *paper, fst_dynamics dynamics, char *note, size_t size);

FST_MEASURE(maxima_distance) /* between the field's maxima, mm */
FST_MEASURE(fold4_festoons)  /* omega = 0.215: number of festoons */
FST_MEASURE(fold4_angle)     /* greatest angle of n and B, degrees */
FST_MEASURE(fold4_nz)        /* |<n_z>| */
FST_MEASURE(fold4_field)     /* standard deviation of |B| over its mean, % */
FST_MEASURE(fold15_festoons) /* omega = 0.4: the same */
FST_MEASURE(fold15_angle)
FST_MEASURE(fold15_tilt)         /* of the best-fit plane of n against the vertical, degrees */
FST_MEASURE(fold15_roundness)    /* ratio of the two widths of the path of n in that plane */
FST_MEASURE(fold15_symmetry)     /* 1: S1, 2: S2, NAN: n is not closed */
FST_MEASURE(least_radius)        /* omega = 0.4: least r */
FST_MEASURE(least_radius_phi)    /* where in Phi, modulo half a turn, degrees from alignment */
FST_MEASURE(greatest_radius_phi) /* where r is greatest, degrees */
FST_MEASURE(halving)             /* omega of the period halving */
FST_MEASURE(corotation)          /* greatest frequency of corotation from rest, Hz */
FST_MEASURE(irregular)           /* share of irregular runs between 7 and 10 Hz, % */
FST_MEASURE(bell)                /* frequency of least |alpha'|, Hz */
FST_MEASURE(slowness)            /* omega/|alpha'|, mean over the counter-rotating range */
FST_MEASURE(rolling_alpha)       /* greatest deviation of <alpha'> from free rolling, omega from 0.5, % */
FST_MEASURE(rolling_phi)         /* the same for <phi'> */
FST_MEASURE(friction_share)      /* omega = 0.4: |<V_r>| over the magnetic term of Eq. (eq21), % */
FST_MEASURE(energy)              /* |<drive power> - <f.V>| over the latter, greatest over Table 1 */

#undef FST_MEASURE

#endif
