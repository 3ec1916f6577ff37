/* film_slip.h - the measured slip of one film: fitted together with the places, or judged by them. */
#ifndef FST_FIT_FILM_SLIP_H
#define FST_FIT_FILM_SLIP_H

#include "fit/film.h"

/* From v, where the places alone are explained best with this scatter (in residuals), seek what explains the slip too.  v
 * stays where too little slip was measured, or where it contradicts the places; no slip is fitted then. */
fst_status fit_slip_join(fit_film *f, double *v, double scatter, fst_error *error);

/* Report how well the model's slip at v agrees with the measured one. */
fst_status fit_slip_report(fit_film *f, const double *v, fst_fit *fit, fst_error *error);

#endif
