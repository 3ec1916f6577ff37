/* normal_form.h - whether a Hopf or Neimark-Sacker point is super- or subcritical, by its cubic coefficient. */
#ifndef FST_ORBIT_NORMAL_FORM_H
#define FST_ORBIT_NORMAL_FORM_H

#include "orbit/solution.h"

enum { FST_NORMAL_FORM_MOST = FST_TANGENT_SIZE };

/* A vector field or a map with the origin as its equilibrium or fixed point, smooth beside it. */
typedef struct fst_local_map {
    int size;     /* at most FST_NORMAL_FORM_MOST */
    int is_map;   /* 0: a vector field */
    double reach; /* arguments of the differences are about as long as this */
    void *user;
    fst_status (*at)(void *user, const double *x, double *out, fst_error *error);
} fst_local_map;

/* The cubic coefficient of the normal form on the centre manifold of the pair nearest to the border, of about
 * this frequency (angle): for a field the first Lyapunov coefficient (Kuznetsov, Elements of Applied
 * Bifurcation Theory, Eq. (5.39)), for a map Re(e^-i theta c1) (Eq. (5.65)); negative: supercritical.  `matrix`
 * is the derivative at the origin, by rows.  *spread: how much it changes with steps twice as long.
 * FST_NO_CONVERGENCE: no such pair, or a resonance. */
fst_status fst_cubic_coefficient(const fst_lapack *lapack, const fst_local_map *map, const double *matrix,
                                 double frequency, double *coefficient, double *spread, fst_error *error);

/* That coefficient of a Hopf point or of a Neimark-Sacker point: of the field in the tangent space, or of the
 * return to the section across the flow. */
fst_status fst_pair_coefficient(const fst_family *family, const fst_solution *s, double frequency,
                                double *coefficient, double *spread, fst_error *error);

/* Its sign: 1 supercritical, -1 subcritical, 0 undecided. */
int fst_pair_criticality(const fst_family *family, const fst_solution *s, double frequency);

#endif
